# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide and the tool say the same."""

import re
from pathlib import Path

import pytest
from seamwire.operators.bindings import Bindings

ROOT = Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs/guide.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("keys", "what"), Bindings().rows(), ids=lambda text: text)
def test_every_action_and_its_keys_are_in_the_table(keys: str, what: str) -> None:
    assert f"\n| {keys} | {what} |" in GUIDE


def test_the_table_has_no_key_that_the_tool_has_not() -> None:
    table = GUIDE[GUIDE.index("| key | does |") :].split("\n\n")[0]
    named = [tuple(part.strip() for part in row.split("|")[1:3]) for row in table.splitlines()[2:]]
    assert named == Bindings().rows()


@pytest.mark.parametrize("page", ["README.md", "docs/guide.md", "docs/install.md", "docs/batch.md"])
def test_every_picture_and_page_that_is_linked_is_there(page: str) -> None:
    path = ROOT / page
    links = re.findall(r"\]\((?!https?:)([^)#]+)\)", path.read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (path.parent / link).exists()] == []
