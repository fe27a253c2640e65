# SPDX-License-Identifier: GPL-3.0-or-later
"""What the corner of the view says of the picture of a drawing, and of the parts that Suggest shows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..terms.choices import KINDS, LOOPS, METRICS, PARTS_BY, ignores_shape
from .reports import count, percent, square_used

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from ..core.islands.uv_maps import SquareUse
    from ..core.seams.seam_plan import PartChoice
    from ..core.sketch.picture import Picture
    from ..terms.choices import PartsBy


STEPS = (
    ("MOUSE_LMB", "Click to begin, and click again to keep a wire"),
    ("MOUSE_LMB_DRAG", "Drag to draw a seam by hand"),
    ("MOUSE_LMB", "Hold Alt to pick a whole loop"),
    ("MOUSE_LMB_DRAG", "Hold Shift and drag to guide the wires"),
)
"""Blender's icon of each gesture, and what it does."""
FIRST_LINES = (*(text for _, text in STEPS), "Press F1 for all keys, and to hide these lines")
"""The lines for newcomers."""


def lines(picture: Picture) -> list[str]:
    """Return what is to be read, top line first. Lines about islands appear once cuts part the mesh."""
    found = []
    options, offered, choice, islands = picture.options, picture.offered, picture.choice, picture.islands
    if offered.kind is not None:
        which = f" ({offered.number + 1} of {len(offered.kinds)})" if len(offered.kinds) > 1 else ""
        found.append(LOOPS[offered.kind].capitalize() + which)
    if picture.active is not None and choice.count > 1:
        which = KINDS[METRICS[options.metric].follows[picture.active.follow]]
        if choice.straight:
            which = "Straight in the view"
        found.append(f"{which} ({choice.number + 1} of {choice.count})")
    if islands is not None and islands.parted:
        gaps = f", {count(len(islands.gaps), 'gap')} in seams" if islands.gaps else ""
        found.append(f"{count(islands.count, 'island')}{gaps}")
        number = picture.pointed_island
        if number is not None:
            cuts = int(islands.missing[number])
            needs = f", flat with {count(cuts, 'more cut')}" if cuts else ""
            found.append(f"Island {number + 1}: {count(int(islands.sizes[number]), 'triangle')}{needs}")
    way = "Along edges" if options.along == "EDGES" else "Across the surface"
    default = next(iter(METRICS))
    metric = "" if options.metric == default else METRICS[options.metric].name.lower()
    strength = "" if ignores_shape(options.metric) else f"strength {picture.strength:.3g}"
    found.append(", ".join(part for part in (way, strength, metric) if part))
    modes = [
        "" if options.marking else "Clearing seams",
        "Mirror " + " ".join("XYZ"[axis] for axis in options.mirror) if options.mirror else "",
        "X-ray" if options.xray else "",
        "Snapping to features" if options.snap else "",
    ]
    said = ", ".join(mode for mode in modes if mode)
    return [*found, said] if said else found


@dataclass(frozen=True)
class FoundMap:
    """The best map so far of the parts that Suggest shows."""

    stretch: float  # the mean, in percent
    islands: int
    length: str  # of all seams, in the scene's units
    used: SquareUse | None = None  # of its islands, packed; None: not packed yet


def rows_of_parts(
    choice: PartChoice,
    parts: int,
    past: Mapping[str, int],
    found: FoundMap | None,
    is_final: bool,
    automatic: Collection[PartsBy] = (),
) -> list[tuple[str, str]]:
    """Return what is to be read while Suggest shows parts, top line first: each text, and the keys that change it.

    `past` counts the notches of the wheel that were turned past an end, by what they turn. `automatic` has what *Auto* has taken.
    """

    def beyond(what: str) -> str:
        return f", {count(abs(past[what]), 'notch', 'notches')} past the end" if past.get(what) else ""

    names = ", ".join(PARTS_BY[by].name for by in sorted(automatic))
    taken = f" ({names})" if choice.by == "AUTO" and names else ""
    islands = f"at least {choice.islands}{beyond('islands')}"
    stretch = f"at most {percent(choice.stretch)}{beyond('stretch')}"
    if found is not None:
        islands, stretch = f"{found.islands}, {islands}", f"{percent(found.stretch)}, {stretch}"
    rows = [
        (f"Parts by: {PARTS_BY[choice.by].name}{taken}", "W"),
        (f"Parts: {parts}, amount {100.0 * choice.amount:.0f} %{beyond('amount')}", "Wheel"),
        (f"Islands: {islands}", "Shift Wheel"),
        (f"Stretch: {stretch}", "Ctrl Wheel"),
    ]
    if found is not None:
        if found.used is not None:
            rows.append((square_used(found.used), ""))
        rows.append((f"Seams: {found.length}", ""))
        rows.append(("Search ended" if is_final else "Searching: this is the best map so far", "Enter: Keep"))
    return rows
