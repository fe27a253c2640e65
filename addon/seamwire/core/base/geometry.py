# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry of points, straight pieces of curves, and triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def length_of(curve: ArrayLike) -> float:
    """Return the length of a curve through (k, d) points."""
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

    Returns
    -------
    weights
        (k, 3) barycentric coordinates of a place in each triangle that is the point or near it.
    off
        (k,) how far the point is from it, as part of the triangle's longest edge; infinite where that has no area.
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
    """Return the areas, (m,), of (m, 3) triangles of (n, 3) points."""
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
