# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an artist placed the edges of a mesh, and what *Auto* stands for on it.

Artists let edges run along and across the bends of the surface, and make faces small where the shape needs it. Scans and sculpts have
edges in all directions. Remeshed surfaces have edges of one length.
"""

from __future__ import annotations

import itertools
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...terms.options import PLACED, SCANNED
from ..base.geometry import triangle_areas, triangle_normals, units

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...terms.options import Auto

_FEW = 2_000
"""The edges of a mesh with fewer triangles count as placed: its maker had to spare triangles."""
_MOST = 25_000
"""The number of triangles that are looked at in larger meshes."""
_BANDS = 8
"""The number of bands across the mesh in which they lie."""
_FOLLOWS = 0.28
"""Placed edges follow the bends at least so well, see `EdgeSigns`."""
_SPREAD = 0.33
"""The lengths of placed edges differ at least so much, unless the mesh is regular."""
_UNEVEN = 0.6
"""Edges whose lengths differ so much are placed, even if they do not follow the bends: those of scans differ by at most 0.5."""
_FLAT_SHARE = 0.2
"""The share of the area in flat faces from which on edges are placed, even if they do not follow the bends."""
_REGULAR = 0.96
"""The least share of regular vertices in a regular mesh."""
_MARK = 0.5
"""Each mark divides `_FOLLOWS` and `_SPREAD` by 1, and by so much more."""
_SKEW = 0.57
"""The largest cosine of a corner of a quad: corners have 55 to 125 degrees."""
_FLAT = 1e-3
"""Triangles that meet at a smaller angle, in radians, do not bend."""
_IN_PLANE = float(np.radians(0.5))
"""Triangles that meet at a smaller angle, in radians, lie in a plane."""


def auto_for(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    polygons: NDArray[np.int32],
    rigged: bool = False,
    marks: int = 0,
) -> Auto:
    """Return what Auto stands for on a mesh.

    Parameters
    ----------
    polygons
        (m,) the face that each triangle is part of, ascending.
    rigged
        Whether the mesh has shape keys or vertex groups.
    marks
        How many other signs of an artist it has: a UV map, sharp edges, custom normals, several materials. Scans may have them too.
    """
    _, sizes = np.unique(polygons, return_counts=True)
    most_are_quads = (sizes > 1).sum() > 0.5 * len(sizes)
    if rigged or len(triangles) < _FEW or most_are_quads:
        return PLACED
    signs = EdgeSigns(points, triangles, polygons)
    trust = 1.0 + _MARK * marks
    is_uniform = trust * signs.spread < _SPREAD and signs.regular < _REGULAR
    if is_uniform:
        return SCANNED
    is_hard = signs.spread >= _UNEVEN or signs.flat >= _FLAT_SHARE
    return SCANNED if trust * signs.follows < _FOLLOWS and not is_hard else PLACED


def _sample(
    points: NDArray[np.float64], triangles: NDArray[np.int32], polygons: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.integer], NDArray[np.int32]]:
    """Return what is looked at of a mesh: all if it is small, and bands across the longest side if it is large."""
    if len(triangles) <= _MOST:
        return points, triangles, polygons
    places = points[triangles[:, 0]]
    places = places[:, np.ptp(places, axis=0).argmax()]
    half = 0.5 * _MOST / len(triangles)
    bounds = np.quantile(places, (np.arange(_BANDS)[:, None] + [0.5 - half, 0.5 + half]).reshape(-1) / _BANDS)
    rows = np.searchsorted(bounds, places) % 2 == 1
    used, triangles = np.unique(triangles[rows], return_inverse=True)
    return points[used], triangles.reshape(-1, 3), polygons[rows]


class EdgeSigns:
    """Four numbers that tell whether an artist placed the edges of triangles. Without shared edges, they are those of a plane.

    They come from the pairs of triangles that share an edge. Parameters are those of `auto_for`.
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], polygons: NDArray[np.int32]) -> None:
        points, triangles, polygons = _sample(points, triangles, polygons)
        self._points, self._triangles = points, triangles
        # Each corner gets the number of the edge opposite to it. Sorted, the two corners of an edge lie side by side.
        opposite = triangles.reshape(-1)
        one, other = (np.roll(triangles, by, axis=1).reshape(-1) for by in (-1, 1))
        numbers = np.minimum(one, other).astype(np.int64) * len(points) + np.maximum(one, other)
        order = np.argsort(numbers)
        ordered = numbers[order]
        first = np.flatnonzero(np.diff(ordered, prepend=-1))
        counts = np.diff(first, append=len(order))
        self._open_ends = np.concatenate([part[order[first[counts != 2]]] for part in (one, other)])
        here, there = order[first[counts == 2]], order[first[counts == 2] + 1]
        lengths = np.linalg.norm(points[other[here]] - points[one[here]], axis=1)
        here, there, self._lengths = here[lengths > 0.0], there[lengths > 0.0], lengths[lengths > 0.0]
        self._sides = np.stack([here, there])
        self._starts, self._ends = one[here], other[here]
        self._tips = opposite[self._sides]
        self._is_inner = polygons[here // 3] == polygons[there // 3]
        normals = triangle_normals(points, triangles)
        turned = np.where(one[here] == one[there], -1.0, 1.0)[:, None]
        self._normals = np.stack([normals[here // 3], turned * normals[there // 3]])

    @cached_property
    def _is_diagonal(self) -> NDArray[np.bool_]:
        """Which edges are diagonals of quads, (k,). Two triangles are a quad if each is the other's best partner for it."""
        quads = self._points[np.stack([self._starts, self._tips[0], self._ends, self._tips[1]])]
        sides = units(np.roll(quads, -1, axis=0) - quads)
        skew = np.abs(np.einsum("ckx,ckx->ck", sides, np.roll(sides, 1, axis=0))).max(axis=0)
        best = np.full(self._triangles.size, np.inf)
        best[self._sides] = skew
        best = best.reshape(-1, 3).min(axis=1)
        return self._is_inner | (skew <= _SKEW) & (skew <= best[self._sides // 3]).all(axis=0)

    @cached_property
    def flat(self) -> float:
        """The share of the area in triangles that lie in a plane with each of their neighbors."""
        most = np.zeros(len(self._triangles))
        for side in self._sides // 3:
            np.maximum.at(most, side, np.abs(self._bends()))
        areas = triangle_areas(self._points, self._triangles)
        return float(areas[most < _IN_PLANE].sum() / areas.sum()) if areas.any() else 1.0

    def _bends(self) -> NDArray[np.float64]:
        """Return the angle at each edge, (k,), positive on ridges and negative in valleys, in radians."""
        here, there = self._normals
        angles = 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(there - here, axis=1), 0.0, 1.0))
        outward = np.einsum("kx,kx->k", here, self._points[self._tips[1]] - self._points[self._starts])
        return np.where(angles > _FLAT, np.where(outward > 0.0, -angles, angles), 0.0)

    @cached_property
    def spread(self) -> float:
        """The standard deviation of the logarithms of the lengths of the edges."""
        return float(np.log(self._lengths).std()) if len(self._lengths) else 0.0

    @cached_property
    def follows(self) -> float:
        """How well edges run along or across the bends of the surface: 1 if all do, 0 if their directions are random.

        It is -1 if all run halfway between. Strong bends count more, and diagonals of quads do not count. It is 1 without bends.

        The curvature tensor of an edge sums the bends of the edges around it (Cohen-Steiner and Morvan, Restricted Delaunay
        triangulations and normal cycle, 2003). The difference of its two curvatures is the weight of the edge.
        """
        along = (self._points[self._ends] - self._points[self._starts]) / self._lengths[:, None]
        beside = units(np.cross(self._normals.sum(axis=0), along))
        bends = self._bends() * self._lengths
        difference, twist = np.zeros_like(bends), np.zeros_like(bends)
        for i, j in itertools.product(range(3), repeat=2):
            part = bends * along[:, i] * along[:, j]
            near = self._summed(part, part)
            near += self._summed(near[self._ends], near[self._starts])
            tensor = near[self._starts] + near[self._ends]
            difference += tensor * (along[:, i] * along[:, j] - beside[:, i] * beside[:, j])
            twist += tensor * (along[:, i] * beside[:, j] + along[:, j] * beside[:, i])
        weights = np.where(self._is_diagonal, 0.0, np.hypot(difference, twist))
        if not weights.any():
            return 1.0
        # The cosine of four times the angle between the edge and the bend: 1 along it and across it, -1 halfway between.
        cosines = 2.0 * (difference / np.where(weights > 0.0, weights, np.inf)) ** 2 - 1.0
        return float(np.average(cosines, weights=weights))

    @cached_property
    def regular(self) -> float:
        """The share of regular vertices inside the mesh, or 1 if all vertices lie on the border.

        They have six edges, or four edges beside the diagonals if all their faces are quads.
        """
        ones, diagonals = np.ones(len(self._lengths)), self._is_diagonal.astype(np.float64)
        edges = self._summed(ones, ones)
        inside = edges > 0.0
        inside[self._open_ends] = False
        if not inside.any():
            return 1.0
        alone = np.ones(len(self._triangles), dtype=bool)
        alone[self._sides[:, self._is_diagonal] // 3] = False
        without = edges - self._summed(diagonals, diagonals)
        without[self._triangles[alone]] = 0.0
        return max(float((edges[inside] == 6).mean()), float((without[inside] == 4).mean()))

    def _summed(self, at_starts: NDArray[np.float64], at_ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the sums at vertices, (n,), of what each edge brings to its two ends."""
        count = len(self._points)
        return np.bincount(self._starts, at_starts, count) + np.bincount(self._ends, at_ends, count)
