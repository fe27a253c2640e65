# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that rounding has turned over in a UV map, turned back.

UVs are stored in single precision. A triangle whose height in the map is less than their spacing can be turned over, or lose its area,
when they are rounded. Then a corner moves by a few such spacings, as far as no other triangle is turned over.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .uv_islands import signed_uv_areas

if TYPE_CHECKING:
    from numpy.typing import NDArray

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
    """Turn back the triangles that rounding has turned over.

    Parameters
    ----------
    uvs
        (c, 2) the UVs of the faces' corners.
    corners
        (t, 3) the corners of triangles.
    vertices
        (c,) the vertex of each corner. Corners of an island with one vertex and the same UVs move together.
    labels
        (t,) the island of each triangle.

    Returns
    -------
    (k,) array
        The corners that move.
    (k, 2) array
        Their new UVs.
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
