# SPDX-License-Identifier: GPL-3.0-or-later
"""Links from one page of the documentation to another file."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGES = sorted(path for path in (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")))


def linked(page: Path) -> list[str]:
    """Return the files that a page links to, relative to its folder. Blocks of code have no links."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"\]\((?!https?:)([^)#]+)", text)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_linked_file_exists(page: Path) -> None:
    assert [link for link in linked(page) if not (page.parent / link).exists()] == []


def test_links_are_found() -> None:
    assert {"docs/guide.md", "docs/install.md"} <= set(linked(ROOT / "README.md"))
