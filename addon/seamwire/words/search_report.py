# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of Suggest Seamwires."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.islands.map_faults import NO_FAULTS, MapFaults
from ..terms.choices import PARTS_BY
from .reports import count, in_words, not_reached, percent, square_used

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..core.islands.square_use import SquareUse
    from ..terms.choices import PartsBy


LIVE_HINTS = (
    "Click Border: Drop or Keep",
    "Click Part: Cut",
    "Ctrl Z: Undo",
    "Enter: Keep",
)
"""The artist's choices while the parts are shown, without those that the corner of the view has."""
OTHER_KEY = "Only the wheel, clicks, W, Ctrl Z, Enter, Esc and keys that move the view work here"
NOTHING_TO_UNDO = "Nothing to undo: the parts are as they were first shown"
NOTHING_TO_REDO = "Nothing to redo"


def parts_text(by: PartsBy, amount: float, number: int, stretch: float) -> str:
    """Return the text on an amount of parts, from 0 to 1, their number, and the limit of the stretch in percent."""
    parts = "Parts" if by == "AUTO" else f"Parts by {PARTS_BY[by].name}"
    return f"{parts}: {100.0 * amount:.0f} %, {count(number, 'part')}    Stretch: up to {stretch:.3g} %"


@dataclass(frozen=True)
class Outcome:
    """The result of a suggestion for all objects together. Stretch is in percent."""

    wires: int
    marked: int  # edges
    islands: int
    exposed: int = 0  # the wires in full view, which islands need to lie flat
    islands_wanted: int = 0  # the number of islands that was asked for but not reached; 0 if it was reached
    stretch: float | None = None  # the mean of all maps; None if there are no maps
    stretches: Sequence[float] = ()  # of each object's map
    stretch_wanted: float = 0.0
    unwrapped: int | None = None  # the number of islands; None if nothing was to be unwrapped, or could be
    faults: MapFaults = NO_FAULTS  # of these islands
    used: SquareUse | None = None  # by the maps in the meshes; None if there are no maps

    @property
    def is_good(self) -> bool:
        return not (self._problems() or self.faults)

    @property
    def text(self) -> str:
        if not self.wires:
            return self._text_without_wires()
        parts = [count(self.wires, "wire")]
        if self.exposed:
            parts.append(f"{self.exposed} in full view")
        if self.marked:
            parts.append(f"{count(self.marked, 'edge')} marked")
        parts.append(count(self.islands, "island"))
        return ", ".join([*parts, *self._of_map(), *self._problems(), *self._of_square()])

    def _text_without_wires(self) -> str:
        if self._problems():
            return f"No useful seam found: {', '.join([*self._of_map(), *self._problems()])}"
        if self.unwrapped:
            return ", ".join([f"No seam needed: {count(self.unwrapped, 'island')} unwrapped", *in_words(self.faults)])
        return "Nothing to add: all islands already unwrap within the limit"

    def _of_map(self) -> list[str]:
        parts = []
        if self.stretch is not None and math.isfinite(self.stretch):
            parts.append(f"stretch {percent(self.stretch)}")
        if self.faults:
            parts += in_words(self.faults)
        elif self.unwrapped:
            parts.append("no overlap")
        return parts

    def _of_square(self) -> list[str]:
        return [] if self.used is None else [square_used(self.used)]

    def _problems(self) -> list[str]:
        parts = []
        if self.islands_wanted:
            parts.append(f"fewer than {self.islands_wanted} because no island can be cut further")
        missed = not_reached(self.stretches, self.stretch_wanted)
        return [*parts, missed] if missed else parts
