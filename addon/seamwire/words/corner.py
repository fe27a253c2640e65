# SPDX-License-Identifier: GPL-3.0-or-later
"""What the corner of the view says: what a click would take, how wires run, and what the seams have parted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .names import LOOP_NAMES, count

if TYPE_CHECKING:
    from ..core.drawing.picture import Picture
    from ..core.islands.islands import Islands

_METRICS = {
    "feature": "",
    "concave": "concave creases",
    "euclidean": "shortest paths",
}
FOLLOWS = ("Along ridges", "Across ridges", "In creases")
"""The names of candidates, by what they follow."""
_FOLLOWS_IN = {"concave": ("In creases", "Shortest path"), "euclidean": ("Shortest path",)}


def _islands(islands: Islands) -> str:
    """Say how many islands there are, and how many seams end just before another one."""
    found = count(islands.count, "island")
    return f"{found}, {count(len(islands.gaps), 'gap')} in seams" if islands.gaps else found


def _island(islands: Islands, number: int) -> str:
    """Say which island that is, and what it needs to lie flat."""
    size, cuts = int(islands.sizes[number]), int(islands.missing[number])
    found = f"Island {number + 1}: {count(size, 'triangle')}"
    return f"{found}, flat with {count(cuts, 'more cut')}" if cuts else found


def lines(picture: Picture) -> list[str]:
    """Return what is to be read, top line first. Lines about islands appear once cuts part the mesh."""
    found = []
    options, offered, choice, islands = picture.options, picture.offered, picture.choice, picture.islands
    if offered.kind is not None:
        which = f" ({offered.number + 1} of {len(offered.kinds)})" if len(offered.kinds) > 1 else ""
        found.append(LOOP_NAMES[offered.kind].capitalize() + which)
    if picture.active is not None and choice.count > 1:
        which = _FOLLOWS_IN.get(options.metric, FOLLOWS)[picture.active.follow]
        if choice.straight:
            which = "Straight in the view"
        elif choice.around:
            which = "Around the limb"
        found.append(f"{which} ({choice.number + 1} of {choice.count})")
    if islands is not None and islands.parted:
        found.append(_islands(islands))
        if picture.pointed_island is not None:
            found.append(_island(islands, picture.pointed_island))
    way = "Along edges" if options.along == "EDGES" else "Across the surface"
    metric = _METRICS.get(options.metric, options.metric)
    strength = "" if options.metric == "euclidean" else f"strength {picture.strength:.3g}"
    found.append(", ".join(part for part in (way, strength, metric) if part))
    modes = [
        "" if options.marking else "Clearing seams",
        "Mirror " + " ".join("XYZ"[axis] for axis in options.mirror) if options.mirror else "",
        "X-ray" if options.xray else "",
        "Snapping to features" if options.snap else "",
    ]
    said = ", ".join(mode for mode in modes if mode)
    return [*found, said] if said else found
