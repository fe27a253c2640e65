# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry of points, straight pieces of curves, and triangles, and things that hang together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

    from numpy.typing import ArrayLike, NDArray

_FLAT = 1e-4
"""How near to its longest side a triangle's corner is where the triangle has no area, as part of that side: vertices are placed on
edges in single precision."""


def length_of(curve: ArrayLike) -> float:
    return float(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())


def nearest_on_segments(
    point: ArrayLike, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find the nearest place to a point, (d,), on each of some segments, (k, d), which may be points.

    Returns how far along each segment that place lies, (k, 1), from 0 to 1, and how far from the point, (k,): NaN where an end is.
    """
    along = ends - starts
    square = np.einsum("ij,ij->i", along, along)
    part = np.einsum("ij,ij->i", point - starts, along) / np.where(square > 0.0, square, 1.0)
    part = np.clip(part, 0.0, 1.0)[:, None]
    return part, np.linalg.norm(starts + part * along - point, axis=1)


def barycentric(
    corners: NDArray[np.float64], point: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find a point, (d,), in triangles, (k, 3, d), or a point in each, (k, d).

    Returns barycentric coordinates, (k, 3), of a place in each triangle that is the point or near it. Also returns how far the point is
    from that place, (k,), as part of the triangle's longest edge: infinite if the triangle has no area.
    """
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    w = point - a
    uu, uv, vv, uw, vw = (np.einsum("ij,ij->i", p, q) for p, q in ((u, u), (u, v), (v, v), (u, w), (v, w)))
    area = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (vv * uw - uv * vw) / area, (uu * vw - uv * uw) / area
        weights = np.clip(np.stack([1.0 - s - t, s, t], axis=1), 0.0, None)
        weights /= weights.sum(axis=1, keepdims=True)
        gaps = np.linalg.norm(np.einsum("ij,ijk->ik", weights, corners) - point, axis=1)
        off = gaps / np.sqrt(np.maximum.reduce([uu, vv, uu - 2.0 * uv + vv]))
    return weights, np.where(np.isfinite(off), off, np.inf)


def triangle_areas(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    return 0.5 * np.linalg.norm(area_normals(points, triangles), axis=1)


def triangle_normals(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return unit normals of triangles, (m, 3). Triangles without area have zero. Parameters are those of `triangle_areas`."""
    return units(area_normals(points, triangles))


def relative_heights(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the smallest height of triangles, (m, 3, 3), divided by their longest side: (m,). It is 0 without a side."""
    sides = np.roll(corners, -1, axis=1) - corners
    squares = np.einsum("ijk,ijk->ij", sides, sides).max(axis=1, initial=0.0)
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return np.divide(areas, squares, out=np.zeros_like(areas), where=squares > 0.0)


def area_normals(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return normals of triangles, (m, 3), twice as long as the areas."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def units(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors, (..., 3), with length 1, or 0 if they have none."""
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0.0)


def without_flat_triangles(
    points: NDArray[np.float64], triangles: NDArray[np.int32], polygons: NDArray[np.int32]
) -> NDArray[np.int32]:
    """Return (m, 3) triangles with other diagonals where a corner between two others left one without area.

    Two polygons that have three corners in a row in common could share the diagonal past the middle one, and hang together there
    though both edges are cut. `polygons`, (m,), is the polygon of each triangle, ascending.
    """
    shares = np.flatnonzero(polygons[1:] == polygons[:-1])
    among = np.union1d(shares, shares + 1)
    flat = among[_flat_corners(points[triangles[among]]) >= 0]
    if not len(flat):
        return triangles
    triangles, turned = triangles.copy(), True
    while turned:
        turned = False
        for row in flat.tolist():
            middle = int(_flat_corners(points[triangles[[row]]])[0])
            if middle < 0:
                continue
            m, b, a = np.roll(triangles[row], -middle).tolist()
            for mate in range(*np.searchsorted(polygons, (polygons[row], polygons[row] + 1)).tolist()):
                other = {*triangles[mate].tolist()} - {a, b}
                if mate == row or len(other) != 1:
                    continue
                (x,) = other
                pair = np.array([(a, m, x), (m, b, x)], dtype=np.int32)
                if (_flat_corners(points[pair]) < 0).all():
                    triangles[[row, mate]], turned = pair, True
                    break
    return triangles


def _flat_corners(corners: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return which corner of each triangle, (m, 3, 3), lies on the side between the others, (m,), or -1."""
    sides = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)  # each opposite to its corner
    squares = np.einsum("ijk,ijk->ij", sides, sides)
    return np.where(relative_heights(corners) <= _FLAT, squares.argmax(axis=1), -1)


def groups(keys: Iterable[Iterable[Hashable]]) -> list[list[int]]:
    """Return the rows of things in groups. Things that share a key are in one group. Groups are in the order of their first rows."""
    first: dict[Hashable, int] = {}
    leads: list[int] = []  # from each row to a smaller one of its group, or to itself

    def begin(row: int) -> int:
        while leads[row] != row:
            leads[row] = row = leads[leads[row]]
        return row

    for row, own in enumerate(keys):
        leads.append(row)
        for key in own:
            low, high = sorted((begin(first.setdefault(key, row)), begin(row)))
            leads[high] = low
    found: dict[int, list[int]] = {}
    for row in range(len(leads)):
        found.setdefault(begin(row), []).append(row)
    return list(found.values())
