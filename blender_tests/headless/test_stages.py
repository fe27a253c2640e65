# SPDX-License-Identifier: GPL-3.0-or-later
"""The states of a chain: the documentation has the table of the code, and only one method changes the state."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from seamwire.tool.chain import STAGES

ROOT = Path(__file__).parents[2]


def rows() -> list[list[str]]:
    """Return the rows of the table in the documentation, without its heading."""
    text = (ROOT / "docs/development/structure.md").read_text(encoding="utf-8")
    table = text.split("## The states of a chain")[1].split("\n## ")[0]
    found = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line[:1] == "|"]
    return found[2:]


def test_the_documentation_has_the_table_of_the_code() -> None:
    pairs = [(stage, after) for stages, after, _ in rows() for stage in stages.split(", ")]
    assert {stage: {after for before, after in pairs if before == stage} for stage in STAGES} == {
        stage: set(after) for stage, after in STAGES.items()
    }


def test_the_documentation_says_what_each_state_is() -> None:
    text = (ROOT / "docs/development/structure.md").read_text(encoding="utf-8")
    assert re.findall("^- `([A-Z]+)`: the chain ", text, re.MULTILINE) == list(STAGES)


def test_each_state_is_reached() -> None:
    reached = {"READY"}
    for _ in STAGES:
        reached |= {after for before in reached for after in STAGES[before]}
    assert reached == set(STAGES)


def test_one_method_changes_the_state() -> None:
    found = []
    for path in (ROOT / "addon/seamwire").rglob("*.py"):
        for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(function, ast.FunctionDef):
                found += [
                    (path.name, function.name)
                    for node in ast.walk(function)
                    if isinstance(node, ast.Attribute)
                    and isinstance(node.ctx, ast.Store)
                    and re.fullmatch("stage|hold|peek", node.attr)
                ]
    assert set(found) == {("chain.py", "__init__"), ("chain.py", "go")}
