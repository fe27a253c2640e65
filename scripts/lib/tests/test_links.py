# SPDX-License-Identifier: GPL-3.0-or-later
"""Links from one page of the documentation to another file."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGES = sorted(path for path in (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")))


def prose(page: Path) -> str:
    """Return the text of a page without its blocks of code, which have neither links nor headings."""
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def links(page: Path) -> list[tuple[str, str]]:
    """Return the files that a page links to, relative to its folder ("" for itself), and the anchors in them."""
    return re.findall(r"\]\((?!https?:|mailto:)([^)#\s]*)#?([^)\s]*)\)", prose(page))


def anchors(page: Path) -> set[str]:
    """Return the anchors of a page's headings, as the forge and MkDocs name them."""
    titles = re.findall(r"^#+ (.+)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-") for title in titles}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_leads_somewhere(page: Path) -> None:
    for file, anchor in links(page):
        target = (page.parent / file).resolve() if file else page
        assert target.exists(), f"{file}#{anchor}"
        assert not anchor or anchor in anchors(target), f"{file}#{anchor}"


def test_links_and_anchors_are_found() -> None:
    assert {("docs/guide/index.md", ""), ("docs/install.md", "")} <= set(links(ROOT / "README.md"))
    assert {"seamwire", "try-it", "from-a-script"} <= anchors(ROOT / "README.md")
