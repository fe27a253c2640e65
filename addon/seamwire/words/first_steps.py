# SPDX-License-Identifier: GPL-3.0-or-later
"""The first steps, and where the guide is."""

from __future__ import annotations

from functools import cache
from pathlib import Path

STEPS = (
    ("MOUSE_LMB", "Click to begin, and click again to keep a wire"),
    ("MOUSE_LMB_DRAG", "Drag to draw a seam by hand"),
    ("MOUSE_LMB", "Hold Alt to pick a whole loop"),
    ("MOUSE_LMB_DRAG", "Hold Shift and drag to guide the wires"),
)
"""Blender's icon of each gesture, and what it does."""
FIRST_LINES = (*(text for _, text in STEPS), "Press F1 for all keys, and to hide these lines")
"""The lines in the corner of the view for newcomers."""

_PLACES = ("guide/index.md", "../../docs/guide/index.md")
"""Where the guide lies, in a package and in a checkout."""


@cache
def guide() -> str:
    """Return the address of the guide; an empty string if it is missing."""
    here = Path(__file__).parents[1]
    found = next((path.resolve() for place in _PLACES if (path := here / place).is_file()), None)
    return "" if found is None else found.as_uri()
