# SPDX-License-Identifier: GPL-3.0-or-later
"""The snippets of docs/library.md and docs/library/*.md.

Runs the Python snippets of one page, in order, in the current folder: library_pages.py PAGE. The snippets of docs/library.md leave
geodesics.png there, which is docs/images/library-first.png.
"""

from __future__ import annotations

import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
FIRST = DOCS / "library.md"
PAGES = [FIRST, *sorted((DOCS / "library").glob("*.md"))]
EXAMPLES = ROOT / "native/examples"
PROJECT = EXAMPLES / "first"  # a project that uses the installed library


def blocks(page: Path, language: str) -> list[tuple[int, str]]:
    """Return the first line number and the text of each fenced block of a language."""
    text = page.read_text()
    pattern = re.compile(rf"^```{language}\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    return [(text.count("\n", 0, found.start(1)) + 1, found.group(1)) for found in pattern.finditer(text)]


def run_python(page: Path, names: dict) -> None:
    """Run the Python blocks of a page with the given names. Errors name the page and the line."""
    for line, code in blocks(page, "python"):
        exec(compile("\n" * (line - 1) + code, str(page), "exec"), names)


def first_program() -> dict:
    """Return the names with which the other pages begin: those of the first program, and of the torus."""
    names: dict = {}
    program, *_, torus = blocks(FIRST, "python")
    for _, code in (program, torus):
        exec(compile(code, str(FIRST), "exec"), names)
    return names


def example_of(page: Path) -> Path:
    """Return the source of a page's snippets in C++."""
    return PROJECT / "first.cpp" if page == FIRST else EXAMPLES / f"{page.stem}.cpp"


def example_snippets(source: Path) -> dict[str, str]:
    """Return the parts of an example between lines ``//! [name]``, by name, without their common indentation."""
    pattern = re.compile(r"^ *//! \[(.+?)\]\n(.*?)^ *//! \[\1\]$", re.MULTILINE | re.DOTALL)
    return {found.group(1): textwrap.dedent(found.group(2)) for found in pattern.finditer(source.read_text())}


if __name__ == "__main__":
    path = Path(sys.argv[1]).resolve()
    run_python(path, {} if path == FIRST else first_program())
