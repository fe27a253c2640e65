# SPDX-License-Identifier: GPL-3.0-or-later
"""Every code that the code sends has a sentence, every sentence is sent, and each gets the values that it needs."""

from __future__ import annotations

import ast
from pathlib import Path
from string import Formatter

import pytest
from seamwire.core.base.messages import Message
from seamwire.words.sentences import SENTENCES

ROOT = Path(__file__).parents[2] / "seamwire"
SENDERS = {
    "of",
    "refuse",
    "Refused",
    "CutError",
    "NativeError",
    "NewerError",
    "UnreadableError",
}
"""The functions and errors that take a code and its values."""


def constants(tree: ast.Module) -> dict[str, str]:
    """Return the texts that a module gives names to."""
    return {
        target.id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        for target in node.targets
        if isinstance(target, ast.Name)
    }


def codes_in(node: ast.expr, names: dict[str, str]) -> list[str]:
    """Return the codes that an argument may be; nothing if it comes from elsewhere."""
    if isinstance(node, ast.IfExp):
        return codes_in(node.body, names) + codes_in(node.orelse, names)
    if isinstance(node, ast.Name):
        return [names[node.id]] if node.id in names else []
    return [node.value] if isinstance(node, ast.Constant) and isinstance(node.value, str) else []


def sent() -> list[tuple[str, str, set[str]]]:
    """Return where each code is sent, the code, and the names of its values."""
    found = []
    for path in sorted(ROOT.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = constants(tree)
        for node in ast.walk(tree):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name not in SENDERS or (name == "of" and getattr(node.func.value, "id", "") != "Message"):
                continue
            values = {keyword.arg for keyword in node.keywords if keyword.arg}
            where = f"{path.relative_to(ROOT)}:{node.lineno}"
            found += [(where, code, values) for code in codes_in(node.args[0], names)]
    return found


def needed(code: str) -> set[str]:
    """Return the names of the values in a sentence. "it" follows from the count."""
    fields = {field.partition(", ")[0] for _, field, _, _ in Formatter().parse(SENTENCES[code]) if field}
    return fields - {"it"}


@pytest.mark.parametrize(("where", "code", "values"), sent(), ids=[f"{code} {where}" for where, code, _ in sent()])
def test_a_code_that_is_sent_has_a_sentence_and_brings_its_values(where: str, code: str, values: set[str]) -> None:
    assert code in SENTENCES, where
    assert needed(code) <= values, where
    vertices = {"pick": 3, "start": 3, "end": 7, "count": 2}
    text = str(Message.of(code, **{name: vertices.get(name, "7") for name in values}))
    assert "{" not in text
    assert text.strip() == text != ""


def test_every_sentence_is_sent() -> None:
    text = "\n".join(path.read_text(encoding="utf-8") for path in ROOT.rglob("*.py") if path.name != "messages.py")
    text += (ROOT / "core/base/messages.py").read_text(encoding="utf-8")
    assert [code for code in SENTENCES if f'"{code}"' not in text] == []


def test_many_codes_are_found() -> None:
    assert len({code for _, code, _ in sent()}) > 50
