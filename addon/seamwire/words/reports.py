# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators report of wires that became seams."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .names import count

if TYPE_CHECKING:
    from ..core.drawing.change import Change

ADJUST_DRAWN = ("Point at a wire to change it:", "swap its path, drag its seeds, or remove it")
"""The text of the panel Adjust Last Operation after something was drawn."""
ADJUST_EDITED = ("Undo takes it back. To edit more, point at a wire:", "swap its path, drag its seeds, or remove it")
"""The text after something was moved, swapped, bent or removed."""

HALFWAY = "Stopped halfway"
"""The first words of an operator's report that an error came while meshes were changed."""


def summary(change: Change, marked: int, cleared: int) -> str:
    """Return a report of what was drawn, changed and removed, and of the numbers of edges that this marked and cleared."""
    drawn_strokes, removed_strokes = change.strokes
    parts = [
        (change.drawn, count(change.drawn, "wire")),
        (change.rerouted, f"{count(change.rerouted, 'wire')} changed"),
        (change.removed, f"{count(change.removed, 'wire')} removed"),
        (drawn_strokes, count(drawn_strokes, "stroke")),
        (removed_strokes, f"{count(removed_strokes, 'stroke')} removed"),
        (marked or (change.drawn and not cleared), f"{count(marked, 'edge')} marked"),
        (cleared, f"{count(cleared, 'edge')} cleared"),
    ]
    return ", ".join(text for is_said, text in parts if is_said) or "no edge has changed"


def gaps(uncut: int) -> str:
    """Return the warning for faces that could not be cut."""
    return f"{count(uncut, 'face')} could not be cut: the seams have gaps there"


def left_out(number: int) -> str:
    """Return the warning for wires or mirror images that were not cut."""
    why = "it does not run over the mesh" if number == 1 else "they do not run over the mesh"
    return f"{count(number, 'wire or mirror image', 'wires or mirror images')} not cut: {why}"
