# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators report, with numbers and picks by the names that artists read, and what keeps reports until they are shown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

from ..terms.choices import PARTS_BY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..core.islands.uv_maps import CostlyIsland, MapFaults, SquareUse
    from ..core.sketch.change import Change
    from ..terms.choices import PartsBy

LEVELS = ("INFO", "WARNING", "ERROR")


class Notice(NamedTuple):
    level: Literal["INFO", "WARNING", "ERROR"]
    text: str


class Notices:
    def __init__(self) -> None:
        self._waiting: dict[Notice, None] = {}

    def add(self, level: Literal["INFO", "WARNING", "ERROR"], text: str) -> None:
        """Add something to report, unless the same text waits already."""
        self._waiting[Notice(level, text)] = None

    def take(self) -> list[Notice]:
        """Return what waits to be reported, errors last, and forget it."""
        waiting, self._waiting = self._waiting, {}
        return sorted(waiting, key=lambda notice: LEVELS.index(notice.level))

    def tell(self, report: Callable[[set[str], str], None]) -> None:
        """Report what waits, once. `report` takes the level and the text, as operators of Blender do."""
        for level, text in self.take():
            report({level}, text)


def count(number: int, what: str, several: str = "") -> str:
    return f"{number} {what if number == 1 else several or what + 's'}"


ALL_HIDDEN = "All objects in Edit Mode are hidden: show them"
"""The report of an operator that finds no object, because Blender leaves out hidden ones."""
HALFWAY = "Stopped halfway"
"""The first words of an operator's report that an error came while meshes were changed."""


def summary(change: Change, marked: int, cleared: int) -> str:
    drawn_strokes, removed_strokes = change.strokes
    marks = any(wire.marks for wire in change.after.wires if wire.id in change.changed)
    parts = [
        (change.drawn, count(change.drawn, "wire")),
        (change.rerouted, f"{count(change.rerouted, 'wire')} changed"),
        (change.removed, f"{count(change.removed, 'wire')} removed"),
        (drawn_strokes, count(drawn_strokes, "stroke")),
        (removed_strokes, f"{count(removed_strokes, 'stroke')} removed"),
        (marked or (change.drawn and marks and not cleared), f"{count(marked, 'edge')} marked"),
        (cleared or (change.drawn and not marks), f"{count(cleared, 'edge')} cleared"),
    ]
    return ", ".join(text for is_said, text in parts if is_said) or "no edge has changed"


def not_cut(faces: int, wires: int) -> list[str]:
    why = "it does not run over the mesh" if wires == 1 else "they do not run over the mesh"
    found = [f"{count(faces, 'face')} could not be cut: the seams have gaps there"] if faces else []
    left_out = [f"{count(wires, 'wire or mirror image', 'wires or mirror images')} not cut: {why}"] if wires else []
    return found + left_out


def in_words(faults: MapFaults) -> list[str]:
    parts = [
        (faults.overlapping, count(faults.overlapping, "island overlaps", "islands overlap")),
        (faults.flipped, f"{count(faults.flipped, 'face')} turned over"),
        (faults.outside, f"{count(faults.outside, 'island')} outside the UV square"),
    ]
    return [text for number, text in parts if number]


_LITTLE = 0.45
"""If a map uses less of the UV square, reports tell why."""
_SIDES = {"-x": "left", "+x": "right", "-y": "front", "+y": "back", "-z": "bottom", "+z": "top"}
"""The sides of objects, as Blender calls its views."""


def square_used(use: SquareUse) -> str:
    """Return how much of the UV square a map uses, and which island costs most of it if that is little."""
    text = f"{100.0 * use.share:.0f} % of the UV square used"
    island = use.costly
    if island is None or use.share >= _LITTLE:
        return text
    name = _island_name(island)
    if island.empty is not None:
        return f"{text}: the box around {name} is {100.0 * island.empty:.0f} % empty"
    are_long = f"and {count(island.others, 'other')} are long" if island.others else "is long"
    return f"{text}: {name} {are_long}"


def _island_name(island: CostlyIsland) -> str:
    of = f" of {island.name}" if island.name else ""
    if island.is_only:
        return f"the only island{of}"
    side = f" ({_SIDES[island.side]})" if island.side else ""
    return f"island {island.number + 1}{of}{side}"


def percent(stretch: float) -> str:
    digits = 0 if stretch >= 10.0 else 1
    return f"{stretch:.{digits}f}".removesuffix(".0") + " %"


def is_beyond(stretch: float, wanted: float) -> bool:
    """Whether a stretch is higher than another one in the numbers that reports show."""
    return not math.isfinite(stretch) or float(percent(stretch)[:-2]) > float(percent(wanted)[:-2])


def not_reached(stretches: Sequence[float], wanted: float) -> str:
    beyond = sum(is_beyond(stretch, wanted) for stretch in stretches)
    if not beyond:
        return ""
    if len(stretches) > 1:
        return f"{beyond} of {len(stretches)} objects above {percent(wanted)}"
    return f"{percent(wanted)} was not reached"


def parts_text(by: PartsBy, amount: float, number: int, stretch: float) -> str:
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
    faults: MapFaults | None = None  # of these islands
    used: SquareUse | None = None  # by the maps in the meshes; None if there are no maps

    @property
    def is_good(self) -> bool:
        return not (self._problems() or self.faults)

    @property
    def text(self) -> str:
        problems, of_map, faults = self._problems(), [], [] if self.faults is None else in_words(self.faults)
        if self.stretch is not None and math.isfinite(self.stretch):
            of_map.append(f"stretch {percent(self.stretch)}")
        if faults or self.unwrapped:
            of_map += faults or ["no overlap"]
        if not self.wires:
            if problems:
                return f"No useful seam found: {', '.join([*of_map, *problems])}"
            if self.unwrapped:
                return ", ".join([f"No seam needed: {count(self.unwrapped, 'island')} unwrapped", *faults])
            return "Nothing to add: all islands already unwrap within the limit"
        parts = [count(self.wires, "wire")]
        if self.exposed:
            parts.append(f"{self.exposed} in full view")
        if self.marked:
            parts.append(f"{count(self.marked, 'edge')} marked")
        used = [] if self.used is None else [square_used(self.used)]
        return ", ".join([*parts, count(self.islands, "island"), *of_map, *problems, *used])

    def _problems(self) -> list[str]:
        short = f"fewer than {self.islands_wanted} because no island can be cut further" if self.islands_wanted else ""
        return [text for text in (short, not_reached(self.stretches, self.stretch_wanted)) if text]
