# SPDX-License-Identifier: GPL-3.0-or-later
"""UV maps as arrays: where the corners of faces lie, what is wrong there, how much faces are stretched, and how full the UV square is.

All islands of a map share one texel density. So the longest island limits the scale of all islands.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ..base import native
from ..base.geometry import area_normals, triangle_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..base.mesh_arrays import Arrays

    Side = Literal["-x", "+x", "-y", "+y", "-z", "+z"]

_SIDE_TO_SIDE = 0.95
"""The length of an island that reaches from side to side of the square."""
_MOSTLY = 0.5
_OUTSIDE = 1e-3
"""A map may leave the square by so much and still count as packed into it."""
_CANDIDATES = 8
"""So many islands with much empty space around them are compared exactly."""
_ASIDE = 0.25
"""The distance from the middle of an object at which an island lies on a side, as a fraction of half the object's longest side."""


@dataclass(frozen=True)
class Corners:
    """The corners of a mesh's faces, face by face, hidden ones included.

    Each corner, (c,), has a vertex and the edge to the next corner of its face. Each face, (f,), has a number of corners.
    """

    vertices: NDArray[np.int32]
    edges: NDArray[np.int32]
    sizes: NDArray[np.int32]

    @cached_property
    def faces(self) -> NDArray[np.int64]:
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    def of_triangles(self, arrays: Arrays) -> NDArray[np.int64]:
        count = len(arrays.points)
        keys = self.faces * count + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = arrays.polygons[:, None].astype(np.int64) * count + arrays.triangles
        return order[np.searchsorted(keys, wanted.reshape(-1), sorter=order)].reshape(-1, 3)


def uv_areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


class MapFaults(NamedTuple):
    """The numbers of faults of some islands of a UV map.

    Faces are flipped if they are turned over against their island, or have no area in the map. Islands overlap that cover a part of
    themselves or of another island. Islands are outside that lie neither in the UV square nor in the tile that they had before.
    """

    flipped: int = 0
    overlapping: int = 0
    outside: int = 0

    def __bool__(self) -> bool:
        return any(self)


NO_FAULTS = MapFaults()


@dataclass(frozen=True)
class MappedSurface:
    """The visible faces of a mesh with the UVs of the triangles' corners, (m, 3, 2).

    Edges are those of faces, without the diagonals that cut these into triangles. Labels are islands, numbered from 0. The name is that of
    the object, and `to_scene` takes its coordinates to the axes of the scene.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    labels: NDArray[np.int32]
    uvs: NDArray[np.floating]
    edges: NDArray[np.int32]
    name: str = ""
    to_scene: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))

    @property
    def count(self) -> int:
        return int(self.labels.max(initial=-1)) + 1

    @property
    def area(self) -> float:
        return float(triangle_areas(self.points, self.triangles).sum())

    def energy(self, aspect: float = 1.0) -> float:
        """Return the mean symmetric Dirichlet energy E_d: 4 if nothing is stretched, infinite if there is nothing to measure.

        `aspect` is the width over the height of the image that the UVs lie on.
        """
        rows = np.flatnonzero(np.isfinite(self.uvs).all(axis=(1, 2)))
        if not len(rows):
            return np.inf
        numbers, uvs = np.unique(self.labels[rows], return_inverse=True)[1], self.uvs[rows] * (aspect, 1.0)
        return native.load().map_energy(self.points, self.triangles[rows], uvs, islands=numbers, edges=self.edges)


class Stretch:
    """How much a UV map stretches the faces of a mesh, in octaves, see ``seamwire_core.map_stretch``.

    `polygons`, (m,), are the faces that the triangles are part of, ascending. `corners`, (m, 3), are the rows of the UV map that belong to
    the triangles' corners.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        polygons: NDArray[np.int32],
        corners: NDArray[np.int64],
    ) -> None:
        self._mesh = points, triangles, polygons
        self._corners = corners
        self._areas = triangle_areas(points, triangles)
        self._uvs: NDArray[np.float32] | None = None
        self.angle = self.area = np.zeros(len(triangles))

    def update(self, uvs: NDArray[np.float32]) -> bool:
        if not len(self._areas) or (self._uvs is not None and np.array_equal(uvs, self._uvs)):
            return False
        self.angle, self.area = native.load().map_stretch(*self._mesh, uvs[self._corners])
        self._uvs = np.array(uvs, dtype=np.float32)
        return True

    def values(self, kind: str) -> NDArray[np.float64]:
        """Return the stretch of the face of each triangle, (m,), in octaves by ``ANGLE`` or ``AREA``, zero and more."""
        return self.angle if kind == "ANGLE" else np.abs(self.area)

    def islands(self, labels: NDArray[np.int32], kind: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the stretch and the area on the model of the islands that labels, (m,), tell apart, (count,) each.

        The stretch is the mean of the faces, weighted by their areas, and zero for islands without area.
        """
        count = int(labels.max(initial=-1)) + 1
        areas = np.bincount(labels, self._areas, count)
        sums = np.bincount(labels, self.values(kind) * self._areas, count)
        return np.divide(sums, areas, out=np.zeros(count), where=areas > 0.0), areas


@dataclass(frozen=True)
class CostlyIsland:
    number: int  # in its map, from 0
    others: int = 0  # if it is long: how many others are about as long, and would limit the scale in its place
    empty: float | None = None  # if it is not long: the empty fraction of the box around it
    name: str = ""  # of its object, if there are several maps
    is_only: bool = False  # whether there is no other island
    side: Side | None = None  # the side of the object on which it lies; None near the middle


@dataclass(frozen=True)
class SquareUse:
    """The fraction of the UV square that maps cover, and the island that costs most of the rest. Faces that overlap count twice."""

    share: float
    costly: CostlyIsland | None = None


def square_use(maps: Sequence[MappedSurface]) -> SquareUse:
    """Measure how maps use the UV square together.

    An island is long if it reaches from side to side of the square, and most of the free space lies beside the box around it. Otherwise
    the island counts whose box has most free space, if that is most of the box. Islands in the free space of another island fill it.
    """
    uvs = np.concatenate([np.empty((0, 3, 2)), *(each.uvs for each in maps)]).astype(np.float64)
    starts = np.cumsum([0, *(each.count for each in maps)])
    islands = np.concatenate(
        [np.empty(0, dtype=np.int64), *(each.labels + start for each, start in zip(maps, starts, strict=False))]
    )
    is_placed = np.isfinite(uvs).all(axis=(1, 2))
    areas = np.where(is_placed, uv_areas(uvs), 0.0)
    share = float(areas.sum())
    found = _costliest(uvs[is_placed], islands[is_placed], areas[is_placed])
    if found is None:
        return SquareUse(share)
    island, others, empty = found
    mesh = int(np.searchsorted(starts, island, side="right")) - 1
    own, number = maps[mesh], int(island - starts[mesh])
    name = own.name if len(maps) > 1 else ""
    costly = CostlyIsland(number, others, empty, name, bool((islands == island).all()), _side_of(own, number))
    return SquareUse(share, costly)


def _costliest(
    uvs: NDArray[np.float64], islands: NDArray[np.int64], areas: NDArray[np.float64]
) -> tuple[int, int, float | None] | None:
    """Return the island that costs most, how many others are as long, and how empty its box is if it is not long."""
    if not len(uvs) or uvs.min() < -_OUTSIDE or uvs.max() > 1.0 + _OUTSIDE:
        return None
    order = np.argsort(islands, kind="stable")
    numbers, first = np.unique(islands[order], return_index=True)
    low = np.minimum.reduceat(uvs[order].min(axis=1), first)
    high = np.maximum.reduceat(uvs[order].max(axis=1), first)
    boxes = (high - low).prod(axis=1)
    middles = uvs.mean(axis=1)

    def free_in(row: int) -> float:
        inside = ((middles >= low[row]) & (middles <= high[row])).all(axis=1)
        return float(boxes[row] - areas[inside].sum())

    lengths = (high - low).max(axis=1)
    longest = int(lengths.round(3).argmax())
    loosest = np.argsort(np.add.reduceat(areas[order], first) - boxes, kind="stable")[:_CANDIDATES].tolist()
    worst = max(loosest, key=lambda row: round(free_in(row), 6))
    free = free_in(worst)
    is_empty = free > _MOSTLY * boxes[worst]
    beside = 1.0 - float(areas.sum()) - free_in(longest)
    if lengths[longest] >= _SIDE_TO_SIDE and not (is_empty and free > beside):
        others = int((lengths >= _SIDE_TO_SIDE * lengths[longest]).sum()) - 1
        return int(numbers[longest]), others, None
    return (int(numbers[worst]), 0, free / float(boxes[worst])) if is_empty else None


def _side_of(own: MappedSurface, number: int) -> Side | None:
    """Return the side of its object on which an island lies, by its center of area."""
    points = own.points @ own.to_scene.T
    rows = own.triangles[own.labels == number]
    weights = np.linalg.norm(area_normals(points, rows), axis=1)
    seen = points[np.unique(own.triangles)]
    low, high = seen.min(axis=0), seen.max(axis=0)
    if not weights.sum() > 0.0:
        return None
    away = np.average(points[rows].mean(axis=1), axis=0, weights=weights) - 0.5 * (low + high)
    axis = int(np.abs(away).argmax())
    if abs(away[axis]) < _ASIDE * 0.5 * (high - low).max():
        return None
    return f"{'+' if away[axis] > 0.0 else '-'}{'xyz'[axis]}"
