# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles drawn on a grid of pixels with NumPy: how often each pixel is covered, and which triangle is in front."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

_PIXELS_AT_ONCE = 1 << 20
_OFF_CENTER = (1.37e-5, 2.11e-5)
"""Pixels are sampled this far off their centers, so that no sample lies exactly on an edge that two triangles share."""


class Fragments(NamedTuple):
    """Pixels that triangles cover: triangle, column and row (k,), and the barycentric coordinates of the sample (k, 3)."""

    triangle: Integers
    column: Integers
    row: Integers
    weights: Floats


def fragments(corners: Floats, width: int, height: int) -> Iterator[Fragments]:
    """Yield the pixels that triangles cover, a bounded number at once; corners is (m, 3, 2), in pixels."""
    least = np.clip(np.floor(corners.min(axis=1)), 0, [width, height]).astype(np.int64)
    most = np.clip(np.ceil(corners.max(axis=1)), 0, [width, height]).astype(np.int64)
    size = np.maximum(most - least, 0)
    counts = size.prod(axis=1)
    first, ends = 0, np.cumsum(counts)
    while first < len(corners):
        done = ends[first - 1] if first else 0
        after = max(first + 1, int(np.searchsorted(ends, done + _PIXELS_AT_ONCE, side="right")))
        chosen = np.repeat(np.arange(first, after), counts[first:after])
        place = np.arange(len(chosen)) - (
            np.repeat(ends[first:after] - counts[first:after], counts[first:after]) - done
        )
        column = least[chosen, 0] + place % np.maximum(size[chosen, 0], 1)
        row = least[chosen, 1] + place // np.maximum(size[chosen, 0], 1)
        weights = _barycentric(corners[chosen], column + 0.5 + _OFF_CENTER[0], row + 0.5 + _OFF_CENTER[1])
        inside = (weights > 0).all(axis=1)
        yield Fragments(chosen[inside], column[inside], row[inside], weights[inside])
        first = after


def _barycentric(corners: Floats, x: Floats, y: Floats) -> Floats:
    """Return barycentric coordinates (k, 3) of points; those of triangles without an area are negative."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]

    def doubled_area(p: Floats, q: Floats) -> Floats:
        return (p[:, 0] - x) * (q[:, 1] - y) - (p[:, 1] - y) * (q[:, 0] - x)

    weights = np.stack([doubled_area(b, c), doubled_area(c, a), doubled_area(a, b)], axis=1)
    total = weights.sum(axis=1)
    flat = np.abs(total) < 1e-12
    return np.where(flat[:, None], -1.0, weights / np.where(flat, 1.0, total)[:, None])


def coverage(corners: Floats, width: int, height: int) -> Integers:
    """Return how many triangles cover each pixel, (height, width); corners is (m, 3, 2), in pixels."""
    counts = np.zeros(width * height, dtype=np.int64)
    for part in fragments(corners, width, height):
        counts += np.bincount(part.row * width + part.column, minlength=width * height)
    return counts.reshape(height, width)


class FrontView(NamedTuple):
    """For each pixel the triangle in front, or -1, its depth (larger is nearer), and the barycentric coordinates there."""

    triangle: Integers
    depth: Floats
    weights: Floats


def front_view(points: Floats, triangles: Integers, width: int, height: int) -> FrontView:
    """Draw triangles with a depth buffer; points is (n, 3): column, row, and a depth that is larger nearer to the viewer."""
    face = np.full(width * height, -1, dtype=np.int64)
    depth = np.full(width * height, -np.inf)
    weights = np.zeros((width * height, 3))
    for part in fragments(points[triangles][:, :, :2], width, height):
        near = (part.weights * points[triangles[part.triangle], 2]).sum(axis=1)
        pixel = part.row * width + part.column
        order = np.lexsort((near, pixel))
        nearest = order[np.r_[np.diff(pixel[order]) != 0, True]] if len(order) else order
        nearest = nearest[near[nearest] > depth[pixel[nearest]]]
        at = pixel[nearest]
        face[at], depth[at], weights[at] = part.triangle[nearest], near[nearest], part.weights[nearest]
    shape = (height, width)
    return FrontView(face.reshape(shape), depth.reshape(shape), weights.reshape(*shape, 3))
