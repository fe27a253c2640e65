# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons as triangles of which each has an area."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .geometry import relative_heights

if TYPE_CHECKING:
    from numpy.typing import NDArray

_FLAT = 1e-4
"""How near to its longest side a triangle's corner is where the triangle has no area, as part of that side: vertices are placed on
edges in single precision."""


def without_flat_triangles(
    points: NDArray[np.float64], triangles: NDArray[np.int32], polygons: NDArray[np.int32]
) -> NDArray[np.int32]:
    """Return (m, 3) triangles with other diagonals where a corner between two others left one without area.

    Two polygons that have three corners in a row in common could share the diagonal past the middle one, and hang together there
    though both edges are cut. `polygons`, (m,), is the polygon of each triangle, ascending.
    """
    shares = np.flatnonzero(polygons[1:] == polygons[:-1])
    among = np.union1d(shares, shares + 1)
    flat = among[_flat_corners(points, triangles[among]) >= 0]
    if not len(flat):
        return triangles
    triangles = triangles.copy()
    turned = True
    while turned:
        turned = False
        for row in flat.tolist():
            turned |= _turn_diagonal(
                points, triangles, row, np.searchsorted(polygons, (polygons[row], polygons[row] + 1))
            )
    return triangles


def _turn_diagonal(
    points: NDArray[np.float64], triangles: NDArray[np.int32], row: int, bounds: NDArray[np.int64]
) -> bool:
    """Give a flat triangle and the one beside it in its polygon, which has the rows within bounds, the other diagonal, where that helps."""
    middle = int(_flat_corners(points, triangles[[row]])[0])
    if middle < 0:
        return False
    m, b, a = np.roll(triangles[row], -middle).tolist()
    for mate in range(*bounds.tolist()):
        corners = {*triangles[mate].tolist()}
        if mate == row or not {a, b} <= corners:
            continue
        (x,) = corners - {a, b}
        turned = np.array([(a, m, x), (m, b, x)], dtype=np.int32)
        if (_flat_corners(points, turned) < 0).all():
            triangles[[row, mate]] = turned
            return True
    return False


def _flat_corners(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.int64]:
    """Return which corner of each triangle lies on the side between the others, (m,); -1: none."""
    corners = points[triangles]
    sides = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)  # each opposite to its corner
    squares = np.einsum("ijk,ijk->ij", sides, sides)
    return np.where(relative_heights(corners) <= _FLAT, squares.argmax(axis=1), -1)
