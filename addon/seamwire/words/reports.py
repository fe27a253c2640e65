# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators report, with numbers and picks by the names that artists read."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..core.islands.map_faults import MapFaults
    from ..core.islands.square_use import CostlyIsland, SquareUse
    from ..core.sketch.change import Change


def count(number: int, what: str, several: str = "") -> str:
    return f"{number} {what if number == 1 else several or what + 's'}"


ALL_HIDDEN = "All objects in Edit Mode are hidden: show them"
"""The report of an operator that finds no object, because Blender leaves out hidden ones."""
HALFWAY = "Stopped halfway"
"""The first words of an operator's report that an error came while meshes were changed."""


def summary(change: Change, marked: int, cleared: int) -> str:
    """Return a report of what was drawn, changed and removed, and of the numbers of edges that this marked and cleared."""
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
    """Return the warnings for faces, and for wires or mirror images, that could not be cut."""
    why = "it does not run over the mesh" if wires == 1 else "they do not run over the mesh"
    found = [f"{count(faces, 'face')} could not be cut: the seams have gaps there"] if faces else []
    left_out = [f"{count(wires, 'wire or mirror image', 'wires or mirror images')} not cut: {why}"] if wires else []
    return found + left_out


def in_words(faults: MapFaults) -> list[str]:
    """Return what is wrong with islands that were unwrapped. The list is empty if nothing is wrong."""
    parts = []
    if faults.overlapping:
        parts.append(count(faults.overlapping, "island overlaps", "islands overlap"))
    if faults.flipped:
        parts.append(f"{count(faults.flipped, 'face')} turned over")
    if faults.outside:
        parts.append(f"{count(faults.outside, 'island')} outside the UV square")
    return parts


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
    """Return a stretch, in percent, with one decimal place if it is small."""
    digits = 0 if stretch >= 10.0 else 1
    return f"{stretch:.{digits}f}".removesuffix(".0") + " %"


def is_beyond(stretch: float, wanted: float) -> bool:
    """Whether a stretch is higher than another one in the numbers that reports show."""
    return not math.isfinite(stretch) or float(percent(stretch)[:-2]) > float(percent(wanted)[:-2])


def not_reached(stretches: Sequence[float], wanted: float) -> str:
    """Return the report that the maps of objects have more stretch than wanted, in percent, or an empty text."""
    beyond = sum(is_beyond(stretch, wanted) for stretch in stretches)
    if not beyond:
        return ""
    if len(stretches) > 1:
        return f"{beyond} of {len(stretches)} objects above {percent(wanted)}"
    return f"{percent(wanted)} was not reached"
