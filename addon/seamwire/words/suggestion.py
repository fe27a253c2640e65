# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of Suggest Seamwires."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .names import count

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Outcome:
    """The result of a suggestion for all objects together.

    Parameters
    ----------
    wires, marked
        The numbers of wires and of marked edges.
    missing
        How many more cuts each island needs to become a disc.
    discs_wanted
        Whether every island was meant to become a disc. Otherwise islands may have holes.
    islands_wanted
        The number of islands that was asked for but not reached; 0 if it was reached.
    stretch
        The mean stretch in percent.
    stretch_wanted
        The stretch that was asked for but not reached; 0 if it was reached.
    overlapping
        The number of overlapping islands in the UV map, or None if nothing was unwrapped.
    """

    wires: int
    marked: int
    missing: Sequence[int]
    discs_wanted: bool = False
    islands_wanted: int = 0
    stretch: float = 0.0
    stretch_wanted: float = 0.0
    overlapping: int | None = None

    @property
    def is_good(self) -> bool:
        """Whether everything that was asked for was reached."""
        is_open = self.discs_wanted and any(self.missing)
        return not (is_open or self.islands_wanted or self.stretch_wanted or self.overlapping)

    @property
    def text(self) -> str:
        """The report as one line."""
        parts = [count(self.wires, "wire")]
        if self.marked:
            parts.append(f"{count(self.marked, 'edge')} marked")
        parts.append(count(len(self.missing), "island"))
        if self.islands_wanted:
            parts.append(f"fewer than {self.islands_wanted} because no island can be cut further")
        holed = sum(cuts > 0 for cuts in self.missing)
        if holed and self.discs_wanted:
            parts.append(
                f"{count(holed, 'island still needs', 'islands still need')} {count(sum(self.missing), 'cut')}"
            )
        elif holed:  # a cut to an eye would cross the face
            parts.append(f"{holed} with holes")
        parts.append(f"stretch {self.stretch:.0f} %")
        if self.overlapping:
            parts.append(f"{count(self.overlapping, 'island')} overlapping")
        elif self.overlapping is not None:
            parts.append("no overlap")
        if self.stretch_wanted:
            parts.append(f"{self.stretch_wanted:.0f} % was not reached")
        return ", ".join(parts)
