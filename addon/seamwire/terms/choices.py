# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists choose from: a table for each choice. The keys are the codes of the core, of files and of scripts.

Add new rows at the end of a table, because Blender stores the number of the row. In `KINDS` rows have the order of candidates instead, and
*euclidean* stays last.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping


class Term(NamedTuple):
    name: str
    tooltip: str


class Finishing(NamedTuple):
    """The name of a finish, its tooltip, and what it does. Code asks this row, and does not compare names."""

    name: str
    tooltip: str
    on_wire: bool = True  # whether the seam lies where the wire runs, instead of on the nearest edges
    edits: bool = True  # whether it does more to the mesh than marking seams
    cuts: bool = False  # whether it adds vertices; otherwise it may move vertices, and keeps their numbers


class Metric(NamedTuple):
    """The name of a metric, its tooltip, and the library's names of what its wires follow, by `Wire.follow`."""

    name: str
    tooltip: str
    follows: tuple[Kind, ...] = ("min", "max", "concave")


Along = Literal["EDGES", "SURFACE"]
"""Where wires run: along the mesh's edges, or across its surface."""
ALONG: Mapping[Along, Term] = {
    "EDGES": Term("Along Edges", "Wires are chains of the mesh's edges"),
    "SURFACE": Term("Across Surface", "Wires cross faces. Finish decides how they become seams"),
}
AUTO_ALONG = "Along the edges that an artist placed, across the surface of scans and sculpts"
"""The tooltip of Auto."""

PartsBy = Literal["AUTO", "RIMS", "LIMBS", "PANELS"]
"""What separates parts of a mesh."""
PARTS_BY: Mapping[PartsBy, Term] = {
    "AUTO": Term("Auto", "Limbs of bodies, heads, animals, scans and sculpts, front and back of clothes, or rims"),
    "RIMS": Term("Rims", "Sharp edges, as around the walls, lids and plugs of props"),
    "LIMBS": Term("Limbs", "Narrow and concave places, as between the head, arms and body of a figure"),
    "PANELS": Term("Front and Back", "The sides, as of clothes, as seen from Hide From"),
}
"""The key of the preview goes through the rows in this order."""

Finish = str
"""A row of `FINISHES`: what becomes the seam of a wire across the surface."""
FINISHES: Mapping[Finish, Finishing] = {
    "SNAP": Finishing("Snap", "Mark the nearest edges", on_wire=False, edits=False),
    "SLIDE": Finishing("Slide", "Mark the nearest edges, and slide their vertices onto the wire"),
    "CUT": Finishing("Cut", "Cut the wire into the faces", cuts=True),
}
"""`mesh/finishes.py` carries them out. The first is the default."""
DEFAULT_FINISH: Finish = next(iter(FINISHES))
AUTO_FINISH = "Cut scans and sculpts, snap to the edges that an artist placed"
"""The tooltip of Auto."""

Kind = Literal["min", "max", "concave", "euclidean"]
"""The library's name for what a wire follows: a direction of curvature, concave creases, or nothing."""
KINDS: Mapping[Kind, str] = {
    "min": "Along ridges",
    "max": "Across ridges",
    "concave": "In creases",
    "euclidean": "Shortest path",
}
"""The names of candidates, by what they follow."""

MetricName = str
"""A row of `METRICS`, as the library calls it."""
METRICS: Mapping[MetricName, Metric] = {
    "feature": Metric(
        "Features", "Follow ridges, valleys and lines of curvature. Across the surface, concave creases come first"
    ),
    "concave": Metric("Concave Creases", "Follow concave creases, where people usually cut", ("concave", "euclidean")),
    "euclidean": Metric("Shortest Path", "Run as short as possible and ignore the shape", ("euclidean",)),
}
"""What draws wires to features. The first is the default."""

LoopKind = str
"""A row of `LOOPS`: the kind of loop that a click takes as a whole."""
LOOPS: Mapping[LoopKind, str] = {
    "CLOSED": "closed loop",
    "CROSSING": "crossing loop",
    "STRIP": "strip",
    "PAST": "strip past poles",
    "WHOLE": "whole strip",
    "FLAT": "border of part",
    "ACROSS": "closed cut",
    "HANDLE": "cut of a handle",
    "RIDGE": "ridge",
    "VALLEY": "valley",
}
"""The names of loops.

An edge has the closed loop of the metric, the loop or strip that crosses the edge, and the border of a part or face. It also has the
straight strip up to what is there already, the same past poles, and the whole strip. A point of the surface has a closed cut that
separates, or a cut around or through a handle, which does not. Both have a ridge or a valley as far as it is one."""

STRETCHES: Mapping[str, Term] = {
    "ANGLE": Term("Angle", "How much the UV map stretches faces in one direction more than in the other"),
    "AREA": Term("Area", "How much larger or smaller faces are in the UV map than on average"),
}
"""The kinds of stretch."""
HEATS: Mapping[str, Term] = {
    "NONE": Term("None", "Tint the islands instead"),
    **{kind: Term(f"Stretch of {name}s", tooltip) for kind, (name, tooltip) in STRETCHES.items()},
}
"""What colors faces."""


def items(table: Mapping[str, Term | Finishing | Metric], auto: str = "") -> tuple[tuple[str, str, str, int], ...]:
    """Return the items of a property of Blender's. `auto` is the tooltip of the first item, Auto; without it there is no such item."""
    first = (("AUTO", "Auto", auto, 0),) if auto else ()
    return first + tuple((code, row[0], row[1], number) for number, (code, row) in enumerate(table.items(), start=1))


def ignores_shape(metric: MetricName) -> bool:
    return METRICS[metric].follows == ("euclidean",)
