# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that the library finds, and seams that it plans, as wires of a network, and what an artist changes about them. Knows no Blender.

Interfaces speak of the *stretch* s of a UV map, the library of its symmetric Dirichlet energy E_d. A triangle that is 1 + s times as long
one way, and as many times as short the other way, has E_d = 2 ((1 + s)^2 + (1 + s)^-2) (Smith and Schaefer, Bijective parameterization
with free boundaries, 2015, Section 3.1).
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ...terms.choices import PARTS_BY
from ..base import native
from ..network.picks import undirected
from ..network.wires import FOLLOWS, Wire

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    import seamwire_core
    from numpy.typing import NDArray

    from ...terms.choices import Along, PartsBy
    from ..network.picks import Edge
    from ..network.strokes import Stroke

CRUMB = 0.004
"""An island with a smaller part of the mesh's area becomes part of a larger one after wires were cut into the faces."""
LIMITS = (0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 13.0, 17.0, 22.0, 30.0, 40.0, 60.0, 100.0, 200.0, 500.0, 1000.0)
"""The limits of the stretch, in percent, that the wheel goes through."""
_ISOMETRY = 4.0
"""E_d where nothing is stretched."""
_SAME_LIMIT = 1e-3
"""Blender rounds properties: limits that differ by a smaller part are the same."""
_STROKE_RINGS = 3
"""How many rings of vertices a stroke without a radius reaches."""
_UNDER = 0.75
"""A vertex lies under a stroke without a radius if it is nearer than this part of the length of the edges there."""
_STROKE_STRENGTH = 8.0
"""By how much a stroke makes seams under it cheaper or more expensive."""


def energy_of(stretch: float) -> float:
    """Return the energy E_d of a map that stretches by `stretch` (0.17: 17 %) everywhere."""
    square = (1.0 + stretch) ** 2
    return 2.0 * (square + 1.0 / square)


def stretch_of(energy: float) -> float:
    """Return the stretch whose energy is E_d, the inverse of `energy_of`; infinite where the energy is."""
    if not math.isfinite(energy):
        return math.inf
    return math.exp(0.5 * math.acosh(max(energy, _ISOMETRY) / _ISOMETRY)) - 1.0


def turned_limit(percent: float, notches: int, first: float = LIMITS[0]) -> float:
    """Return the next limit in percent after a turn of the wheel, by 1 or by -1: one of `LIMITS`, or the `first` limit that was shown."""
    beyond = [limit for limit in (*LIMITS, first) if notches * (limit - percent) > _SAME_LIMIT * percent]
    return min(beyond, key=lambda limit: abs(limit - percent), default=percent)


def planned_wires(
    plan: seamwire_core.SeamPlan, along: Along, strength: float, from_object: NDArray[np.float64]
) -> list[Wire]:
    """Return the wires of a plan in object coordinates. `from_object`, (3, 3), takes these to the coordinates of the session."""
    return [
        Wire(
            along, tuple(wire.vertices.tolist()), np.asarray(wire.points) @ from_object.T, *wire.seeds,
            faces=np.array(wire.faces) if along == "SURFACE" else None, follow=FOLLOWS.index(wire.follow),
            strength=strength, planned=True,
        )
        for wire in plan.wires
    ]  # fmt: skip


def cut_edges(plan: seamwire_core.SeamPlan, seams: NDArray[np.int32]) -> NDArray[np.int32]:
    chains = [np.stack([wire.vertices[:-1], wire.vertices[1:]], axis=1) for wire in plan.wires]
    return np.concatenate([seams, *chains]).astype(np.int32)


def keep_out(triangles: NDArray[np.int32], is_planned: NDArray[np.bool_], count: int) -> NDArray[np.float64]:
    """Return weights of n vertices, (count,): infinite at those that no planned triangle has, so that wires keep out of the others."""
    weights = np.full(count, np.inf)
    weights[triangles[is_planned]] = 1.0
    return weights


def stroke_weights(
    points: NDArray[np.float64], edges: NDArray[np.int32], strokes: Collection[Stroke]
) -> NDArray[np.float64]:
    """Return how strokes weigh the cost of wires at vertices, (n,): guide strokes make it smaller, avoid strokes larger.

    The weight fades, in equal factors, from the stroke to the end of its reach, and is 1 elsewhere. Where strokes overlap, weights are
    multiplied. Points, (n, 3), are in the coordinates of the strokes. A stroke without a radius reaches along the edges, (e, 2).
    """
    logarithms = np.zeros(len(points))
    for stroke in strokes:
        near = np.zeros(len(points))
        near[stroke.corners] = 1.0
        if stroke.radius is None:
            beside = edges[(near[edges] > 0.0).any(axis=1)]
            length = float(np.linalg.norm(np.diff(points[beside], axis=1), axis=2).mean()) if len(beside) else 0.0
            near[_distances(points, stroke.points) < _UNDER * length] = 1.0
            for ring in range(1, _STROKE_RINGS):
                reached = near[edges] > 0.0
                border = np.unique(edges[reached.any(axis=1) & ~reached.all(axis=1)])
                near[border[near[border] == 0.0]] = 1.0 - ring / _STROKE_RINGS
        else:
            near = np.maximum(near, 1.0 - _distances(points, stroke.points) / stroke.radius)
        logarithms += -near if stroke.attracts else near
    return _STROKE_STRENGTH**logarithms


def _distances(points: NDArray[np.float64], line: NDArray[np.float64]) -> NDArray[np.float64]:
    starts = np.arange(len(line))
    sides = np.stack([starts[:-1], starts[1:], starts[1:]], axis=1) if len(line) > 1 else np.zeros((1, 3), dtype=int)
    return native.load().NearestPoints(line, sides).find(points)[2]


def mean_stretch(energies: Sequence[float], areas: Sequence[float]) -> float:
    total = sum(areas)
    if total <= 0.0:
        return 0.0
    return stretch_of(sum(energy * area for energy, area in zip(energies, areas, strict=True)) / total)


STEP = 0.05
"""The amount of parts that a notch of the wheel adds, or several times as much if the number of parts stays the same."""


def edges_of(chain: NDArray[np.int32]) -> frozenset[Edge]:
    return frozenset(undirected(pair) for pair in pairwise(chain.tolist()))


@dataclass(frozen=True)
class PartEdits:
    """An artist's changes to the parts of one mesh: edges that have to be borders, and edges that must not be.

    `parted` has a polygon for each part that is cut in two, one after another.
    """

    kept: frozenset[Edge] = frozenset()
    dropped: frozenset[Edge] = frozenset()
    parted: tuple[int, ...] = ()

    def keep(self, edges: frozenset[Edge]) -> PartEdits:
        return replace(self, kept=self.kept | edges, dropped=self.dropped - edges)

    def drop(self, edges: frozenset[Edge]) -> PartEdits:
        return replace(self, kept=self.kept - edges, dropped=self.dropped | edges)

    def part(self, polygon: int) -> PartEdits:
        return replace(self, parted=(*self.parted, polygon))

    def on(self, edges: NDArray[np.int32], polygons: NDArray[np.int32]) -> dict[str, NDArray[np.int32]]:
        """Return the edits as arguments of the library's finder, as far as a mesh has their edges and polygons.

        Edges are (e, 2), and the polygons of triangles, (m,), ascend.
        """
        rows = np.searchsorted(polygons, self.parted)
        parted = [row for row, at in zip(rows, self.parted, strict=True) if row < len(polygons) and polygons[row] == at]
        there = set(map(tuple, np.sort(edges, axis=1).tolist())) if self.kept or self.dropped else set()
        kept, dropped = (
            np.array(sorted(own & there), dtype=np.int32).reshape(-1, 2) for own in (self.kept, self.dropped)
        )
        return {"kept": kept, "dropped": dropped, "parted": np.array(parted, dtype=np.int32)}


@dataclass(frozen=True)
class PartChoice:
    """An artist's choice while parts are shown. It determines the parts completely."""

    amount: float  # of parts, from 0 to 1
    stretch: float  # the limit, in percent
    islands: int = 1  # the least number of each object
    edits: Mapping[str, PartEdits] = field(default_factory=dict)  # the changes by clicks, by the name of the object
    by: PartsBy = "AUTO"  # what separates parts


def parted_by_next(made: Sequence[PartChoice]) -> PartChoice:
    """Return the choice after a change to the next row of `PARTS_BY`. Each row keeps the amount and the edits that it had last."""
    rows = list(PARTS_BY)
    by = rows[(rows.index(made[-1].by) + 1) % len(rows)]
    last = next((choice for choice in reversed(made) if choice.by == by), PartChoice(made[0].amount, 0.0, by=by))
    return replace(last, stretch=made[-1].stretch, islands=made[-1].islands)


def edits_text(edits: Mapping[str, PartEdits]) -> str:
    return json.dumps(
        {
            name: {"kept": sorted(own.kept), "dropped": sorted(own.dropped), "parted": own.parted}
            for name, own in edits.items()
            if own != PartEdits()
        }
    )


def edits_of_text(text: str) -> dict[str, PartEdits]:
    """Return the edits of each mesh. Raise ValueError if the text is not from `edits_text`."""
    try:
        return {
            name: PartEdits(
                *(frozenset(undirected((int(a), int(b))) for a, b in own[kind]) for kind in ("kept", "dropped")),
                tuple(map(int, own["parted"])),
            )
            for name, own in (json.loads(text) if text else {}).items()
        }
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(str(error)) from error


def turned(
    amount: float, notches: int, count: Callable[[float], int], may_go_on: Callable[[], bool] = lambda: True
) -> float:
    """Return the amount of parts, 0 to 1, after a turn of the wheel by one notch: 1 for more parts, -1 for fewer.

    It stays if the number of parts, which `count` tells for an amount, cannot change that way. A larger amount can have fewer parts.
    Amounts that change the number the wrong way are skipped unless nothing better follows. If it `may_go_on` no longer, the first of these
    is returned, or else the last amount that was tried.
    """
    before = count(amount)
    place = round(amount / STEP, 6)
    # From between two steps to the nearest one in this direction.
    place = np.floor(place) + 1 if notches > 0 else np.ceil(place) - 1
    against = None
    while 0 <= place <= round(1.0 / STEP):
        found = min(float(place) * STEP, 1.0)
        more = notches * (count(found) - before)
        if more < 0 and against is None:
            against = found
        if more > 0 or not may_go_on():
            return found if more > 0 or against is None else against
        place += notches
    return amount if against is None else against


def border_wires(borders: list[NDArray[np.int32]], points: NDArray[np.float64]) -> list[Wire]:
    """Return the borders of parts, chains of vertices, as wires. A closed chain ends with its first vertex. Points are (n, 3)."""
    wires = []
    for chain in borders:
        vertices = chain.tolist()
        closed = vertices[0] == vertices[-1]
        own = tuple(vertices[:-1] if closed else vertices)
        wires.append(Wire("EDGES", own, points[vertices], vertices[0], vertices[-1], closed=closed, planned=True))
    return wires
