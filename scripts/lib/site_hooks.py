# SPDX-License-Identifier: GPL-3.0-or-later
"""What MkDocs needs to know of this project.

- Links to files outside docs/ work on the forge as they are. The site has no such files. There these links lead to the forge if its address
  is known (``repo_url``), and otherwise become plain text.
- The API reference, which scripts/docs makes before, goes below api/.
- KaTeX, which typesets the equations, is copied from Debian's package. So the site loads nothing from elsewhere.
"""

from __future__ import annotations

import posixpath
import re
import shutil
from pathlib import Path
from typing import Any

API = Path(__file__).resolve().parents[2] / "build/docs"
KATEX = "/usr/share/javascript/katex"

LINK = re.compile(r"(!?)\[([^\]]*)\]\(((?:\.\./)+[^)\s#]+)(#[^)\s]*)?\)")


def outside(target: str, page: str) -> str | None:
    """Return the path from the project's root of a target that lies outside docs/, None for any other."""
    path = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), target))
    return None if path == "docs" or path.startswith("docs/") else path


def relinked(markdown: str, page: str, repository: str | None) -> str:
    """Return a page with its links to files outside docs/ led to the forge."""

    def replaced(found: re.Match[str]) -> str:
        picture, text, target, anchor = found.groups()
        path = outside(target, page)
        if path is None or picture:
            return found.group()
        if not repository:
            return text
        return f"[{text}]({repository.rstrip('/')}/blob/main/{path}{anchor or ''})"

    return LINK.sub(replaced, markdown)


def on_page_markdown(markdown: str, page: Any, config: Any, **_: Any) -> str:  # noqa: ANN401 (MkDocs' own types)
    """Lead the links of a page, as MkDocs asks for it."""
    return relinked(markdown, page.file.src_uri, config.repo_url)


def on_post_build(config: Any, **_: Any) -> None:  # noqa: ANN401
    """Add KaTeX, and the API reference if it is there."""
    unused = shutil.ignore_patterns("*.mjs", "*.ttf", "*.woff")
    shutil.copytree(KATEX, Path(config.site_dir) / "katex", ignore=unused, dirs_exist_ok=True)
    for language in ("cpp", "python"):
        if (API / language).exists():
            shutil.copytree(API / language, Path(config.site_dir) / "api" / language, dirs_exist_ok=True)
