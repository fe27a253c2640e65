# SPDX-License-Identifier: GPL-3.0-or-later
"""What the card of first steps says, and where the guide is."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Literal

Icon = Literal["CLICK", "DRAG", "ALT", "SHIFT"]
"""A drawn icon of a gesture."""

TITLE = "First Steps"
STEPS: tuple[tuple[Icon, str], ...] = (
    ("CLICK", "Click to begin, and click again to keep a wire"),
    ("DRAG", "Drag to draw a seam by hand"),
    ("ALT", "Hold Alt to pick a whole loop"),
    ("SHIFT", "Hold Shift and drag to guide the wires"),
)
LINK = "Open the Guide"

_PLACES = ("guide/index.md", "../../docs/guide/index.md")
"""Where the guide lies, in a package and in a checkout."""


@cache
def guide() -> str:
    """Return the address of the guide; an empty string if it is missing."""
    here = Path(__file__).parents[1]
    found = next((path.resolve() for place in _PLACES if (path := here / place).is_file()), None)
    return "" if found is None else found.as_uri()
