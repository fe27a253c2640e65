# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a UV map as it is stored: faces that are turned over, islands that overlap, and islands outside the UV square.

UVs are stored in single precision. A triangle whose height in the map is less than their spacing can be turned over, or lose its area,
when they are rounded. Then a corner moves by a few such spacings, as far as no other triangle is turned over.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.geometry import triangle_areas
from .uv_islands import signed_uv_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

    import seamwire_core
    from numpy.typing import NDArray

_ON_BORDER = 1e-5
"""An island may leave its tile by so much, because UVs are rounded."""


@dataclass(frozen=True)
class MapFaults:
    """The numbers of faults of some islands of a UV map.

    Faces are flipped if they are turned over against their island, or have no area in the map. Islands overlap that cover a part of
    themselves or of another island. Islands are outside that lie neither in the UV square nor in the tile that they had before.
    """

    flipped: int = 0
    overlapping: int = 0
    outside: int = 0

    def __bool__(self) -> bool:
        return any((self.flipped, self.overlapping, self.outside))


NO_FAULTS = MapFaults()


@dataclass(frozen=True)
class MappedSurface:
    """The visible faces of a mesh with the UVs of the triangles' corners, (m, 3, 2).

    Edges are those of faces, without the diagonals that cut these into triangles. Labels are islands, numbered from 0.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    polygons: NDArray[np.int32]
    labels: NDArray[np.int32]
    uvs: NDArray[np.floating]
    edges: NDArray[np.int32]

    @property
    def count(self) -> int:
        """The number of islands."""
        return int(self.labels.max(initial=-1)) + 1

    @property
    def area(self) -> float:
        """The area on the model."""
        return float(triangle_areas(self.points, self.triangles).sum())

    def energy(self, aspect: float = 1.0) -> float:
        """Return the mean symmetric Dirichlet energy E_d: 4 if nothing is stretched, infinite if there is nothing to measure.

        `aspect` is the width over the height of the image that the UVs lie on.
        """
        rows = np.flatnonzero(np.isfinite(self.uvs).all(axis=(1, 2)))
        if not len(rows):
            return np.inf
        points, triangles, uvs, islands, edges = self._arguments(rows)
        return native.load().map_energy(points, triangles, uvs * (aspect, 1.0), islands=islands, edges=edges)

    def measured(self, shown: NDArray[np.bool_]) -> tuple[NDArray[np.int64], seamwire_core.MapReport | None]:
        """Return the triangles whose UVs are numbers, and the library's report on them; None if there are no such triangles.

        The report numbers these triangles and their islands from 0. Triangles that are not `shown`, (m,), are left out.
        """
        rows = np.flatnonzero(np.isfinite(self.uvs).all(axis=(1, 2)) & shown)
        if not len(rows):
            return rows, None
        points, triangles, uvs, islands, edges = self._arguments(rows)
        return rows, native.load().measure_map(points, triangles, uvs, islands=islands, edges=edges)

    def _arguments(
        self, rows: NDArray[np.int64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
        """Return points, triangles, UVs, islands and edges of some triangles, as the library takes them."""
        numbers = np.unique(self.labels[rows], return_inverse=True)[1].astype(np.int32)
        points, triangles, edges = _with_doubles(self.points, self.triangles[rows], self.edges)
        return points, triangles, self.uvs[rows].astype(np.float64), numbers, edges


def _with_doubles(
    points: NDArray[np.float64], triangles: NDArray[np.int32], edges: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Return a mesh, (n, 3), (m, 3), (e, 2), in which each triangle that repeats another one has separate vertices.

    Otherwise the library leaves it out.
    """
    vertices = np.sort(triangles, axis=1)
    order = np.lexsort(vertices.T)
    repeats = order[1:][(vertices[order[1:]] == vertices[order[:-1]]).all(axis=1)]
    if not len(repeats):
        return points, triangles, edges
    own = (len(points) + np.arange(3 * len(repeats), dtype=np.int32)).reshape(-1, 3)
    points = np.concatenate([points, points[triangles[repeats]].reshape(-1, 3)])
    triangles = triangles.copy()
    triangles[repeats] = own
    return points, triangles, np.concatenate([edges, own[:, :2], own[:, 1:], own[:, [2, 0]]])


def joined(surfaces: Sequence[MappedSurface]) -> MappedSurface:
    """Return maps that share the UV square as the map of one mesh. Each keeps the order of its triangles.

    All meshes get the same size, because faces that are tiny beside the whole mesh have no shape that can be measured.
    """
    if len(surfaces) == 1:
        return surfaces[0]
    points, triangles, polygons, labels, edges = [], [], [], [], []
    vertices = faces = islands = 0
    for each in surfaces:
        size = float(np.ptp(each.points, axis=0).max(initial=0.0))
        points.append(each.points / size if size > 0.0 else each.points)
        triangles.append(each.triangles + vertices)
        polygons.append(each.polygons + faces)
        labels.append(each.labels + islands)
        edges.append(each.edges + vertices)
        vertices += len(each.points)
        faces += int(each.polygons.max(initial=-1)) + 1
        islands += each.count
    columns = (points, triangles, polygons, labels, [each.uvs for each in surfaces], edges)
    return MappedSurface(*map(np.concatenate, columns))


def find_faults(
    surface: MappedSurface,
    chosen: NDArray[np.bool_] | None = None,
    homes: NDArray[np.float64] | None = None,
    *,
    may_stack: bool = False,
) -> MapFaults:
    """Measure what is wrong with some islands of a map. The surface is all that lies in the map.

    Only islands that are `chosen`, (count,), are looked at; the others count as what these may overlap. An island may lie in the UV square,
    or in the tile with the low corner that it has in `homes`, (count, 2). If islands `may_stack`, they may lie exactly on each other.
    """
    chosen = np.ones(surface.count, dtype=bool) if chosen is None else chosen
    homes = np.zeros((surface.count, 2)) if homes is None else homes
    under = _under(surface) if may_stack else {}
    # A triangle whose corners lie in one place has no shape that its UVs could keep.
    has_size = np.ptp(surface.points[surface.triangles], axis=1).max(axis=1) > 0.0
    is_under = np.isin(surface.labels, list(under))
    rows, report = surface.measured(has_size & ~is_under)
    is_bad = ~np.isfinite(surface.uvs).all(axis=(1, 2))
    if under:
        is_bad |= has_size & is_under & _turned_over(surface)
    overlapping = np.empty(0, dtype=np.int32)
    outside = np.zeros(surface.count, dtype=bool)
    if report is not None:
        is_bad[rows[report.flipped]] = True
        islands = np.unique(surface.labels[rows])
        overlapping = islands[np.union1d(report.overlapping, report.colliding)]
        below = [island for island, first in under.items() if first in overlapping]
        overlapping = np.concatenate([overlapping, np.array(below, dtype=np.int32)])
        outside = _outside(surface, np.flatnonzero(np.isfinite(surface.uvs).all(axis=(1, 2))), homes)
    is_bad &= chosen[surface.labels]
    return MapFaults(
        flipped=len(np.unique(surface.polygons[is_bad])),
        overlapping=int(chosen[overlapping].sum()),
        outside=int((outside & chosen).sum()),
    )


def _under(surface: MappedSurface) -> dict[int, int]:
    """Return the islands whose corners lie exactly where those of an earlier island do, and that island."""
    order = np.argsort(surface.labels, kind="stable")
    islands, starts = np.unique(surface.labels[order], return_index=True)
    firsts: dict[bytes, int] = {}
    under: dict[int, int] = {}
    for island, uvs in zip(islands.tolist(), np.split(surface.uvs[order], starts[1:]), strict=True):
        first = firsts.setdefault(np.unique(uvs.reshape(-1, 2), axis=0).tobytes(), island)
        if first != island:
            under[island] = first
    return under


def _turned_over(surface: MappedSurface) -> NDArray[np.bool_]:
    """Return which triangles are turned over against most of their island, (m,)."""
    areas = signed_uv_areas(surface.uvs.astype(np.float64))
    return areas * np.bincount(surface.labels, areas, surface.count)[surface.labels] < 0.0


def _outside(surface: MappedSurface, rows: NDArray[np.int64], homes: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which islands lie neither in the UV square nor in their home, (count,)."""
    order = rows[np.argsort(surface.labels[rows], kind="stable")]
    islands, starts = np.unique(surface.labels[order], return_index=True)
    uvs = surface.uvs[order].astype(np.float64)
    low, high = np.minimum.reduceat(uvs.min(axis=1), starts), np.maximum.reduceat(uvs.max(axis=1), starts)
    found = np.zeros(surface.count, dtype=bool)

    def in_tile(corner: NDArray[np.float64] | float) -> NDArray[np.bool_]:
        return ((low >= corner - _ON_BORDER) & (high <= corner + 1.0 + _ON_BORDER)).all(axis=1)

    found[islands] = ~(in_tile(0.0) | in_tile(homes[islands]))
    return found


_MOST = 64.0
"""Spacings of numbers: a triangle that is turned over by more was not turned over by rounding."""
_PASSES = 3
"""A corner that moves makes room for others."""


def turn_back(
    uvs: NDArray[np.float32],
    corners: NDArray[np.int64],
    vertices: NDArray[np.int32],
    labels: NDArray[np.int32],
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """Turn back the triangles that rounding has turned over. Return the corners that move, (k,), and their new UVs, (k, 2).

    The faces' corners have UVs, (c, 2), and vertices, (c,). Corners of an island with one vertex and the same UVs move together. Triangles,
    (t, 3) corners, have the islands `labels`, (t,).
    """
    if not len(corners):
        return np.empty(0, dtype=np.int64), np.empty((0, 2), dtype=np.float32)
    areas = signed_uv_areas(uvs[corners].astype(np.float64))
    # An island may be mirrored as a whole.
    side = np.where(np.bincount(labels, areas)[labels] < 0.0, -1.0, 1.0)
    turned = np.flatnonzero(side * areas <= 0.0)
    if not len(turned):
        return np.empty(0, dtype=np.int64), np.empty((0, 2), dtype=np.float32)
    mended = _Mending(uvs, corners, vertices, labels, side)
    for _ in range(_PASSES):
        turned = np.array([row for row in turned.tolist() if not mended.turn_back(row)], dtype=np.int64)
    return mended.moved()


class _Mending:
    """A map whose corners move together where they are one point of an island."""

    def __init__(
        self,
        uvs: NDArray[np.float32],
        corners: NDArray[np.int64],
        vertices: NDArray[np.int32],
        labels: NDArray[np.int32],
        side: NDArray[np.float64],
    ) -> None:
        self._side = side
        flat = corners.reshape(-1)
        bits = np.ascontiguousarray(uvs[flat]).view(np.int32)
        keys = np.column_stack([np.repeat(labels, 3), vertices[flat], bits])
        order = np.lexsort(keys.T)
        first = np.ones(len(flat), dtype=bool)
        first[1:] = (keys[order][1:] != keys[order][:-1]).any(axis=1)
        of_corner = np.empty(len(flat), dtype=np.int64)
        of_corner[order] = np.cumsum(first) - 1
        self._triangles = of_corner.reshape(-1, 3)
        self._corners = flat[order]
        self._rows = order // 3
        self._begin = np.append(np.flatnonzero(first), len(flat))
        self._places = uvs[flat[order[first]]].astype(np.float64)
        self._changed: set[int] = set()

    def _area(self, rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the areas of triangles, positive where these are not turned over."""
        return self._side[rows] * signed_uv_areas(self._places[self._triangles[rows]])

    def turn_back(self, row: int) -> bool:
        """Turn one triangle back, and return whether it lies right."""
        points = self._triangles[row]
        places = self._places[points]
        if self._area(np.array([row]))[0] > 0.0:
            return True
        spacing = float(np.spacing(np.abs(places).max().astype(np.float32)))
        opposite = np.roll(places, -2, axis=0) - np.roll(places, -1, axis=0)
        lengths = np.hypot(*opposite.T)
        for corner in np.argsort(-lengths).tolist():
            if not lengths[corner] > 0.0:
                continue
            across = self._side[row] * np.array([-opposite[corner, 1], opposite[corner, 0]]) / lengths[corner]
            height = float(across @ (places[corner] - places[corner - 2]))
            if -height > _MOST * spacing:
                return False
            for step in (1.0, 2.0, 4.0, 8.0, 16.0):
                if self._move(int(points[corner]), places[corner] + (step * spacing - height) * across, row):
                    return True
        return False

    def _move(self, point: int, place: NDArray[np.float64], row: int) -> bool:
        """Move a point if that turns a triangle back and turns over no other; return whether it has moved."""
        around = self._rows[self._begin[point] : self._begin[point + 1]]
        before, old = self._area(around), self._places[point].copy()
        self._places[point] = place.astype(np.float32)
        after = self._area(around)
        if (after[(before > 0.0) | (around == row)] > 0.0).all():
            self._changed.add(point)
            return True
        self._places[point] = old
        return False

    def moved(self) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
        """Return the corners that have moved, each once, and their UVs."""
        found = [self._corners[self._begin[point] : self._begin[point + 1]] for point in sorted(self._changed)]
        points = np.repeat(sorted(self._changed), [len(each) for each in found]).astype(np.int64)
        corners, first = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *found]), return_index=True)
        return corners, self._places[points[first]].astype(np.float32)
