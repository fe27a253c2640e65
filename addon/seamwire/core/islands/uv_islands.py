# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands in UV space: which ones are no longer what the seams say, and where new ones find room. Knows no Blender."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.components import components
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..base.mesh_arrays import Arrays

_SAME = 1e-5
"""UVs nearer than this are one place: unwrapping gives corners that belong together the same numbers, packing rounds them."""
_THIN = 1e-6
"""A face with less area, as a part of its squared length, lies on a line."""
_CELLS = 512
"""Cells along a side of the square in which room is looked for."""
_GAP = 1.0 / _CELLS
_REACHES = ((8, 1), (32, 1), (128, 2), (_CELLS, 3), (_CELLS, 1))
"""How far from its wanted place room for an island is looked for, in cells, and the cells from one try to the next."""


@dataclass(frozen=True)
class Corners:
    """The corners of a mesh's faces, face by face, hidden ones included. Each has the edge to the next corner of its face."""

    vertices: NDArray[np.int32]
    edges: NDArray[np.int32]
    faces: NDArray[np.int64]
    following: NDArray[np.int64]

    @cached_property
    def preceding(self) -> NDArray[np.int64]:
        """(c,) the corner before each."""
        preceding = np.empty_like(self.following)
        preceding[self.following] = np.arange(len(self.following))
        return preceding

    def of_triangles(self, arrays: Arrays) -> NDArray[np.int64]:
        """Return the corner that lies at each corner of the triangles, (m, 3)."""
        count = len(arrays.points)
        keys = self.faces * count + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = arrays.polygons[:, None].astype(np.int64) * count + arrays.triangles
        return order[np.searchsorted(keys, wanted.reshape(-1), sorter=order)].reshape(-1, 3)


def split_edges(
    vertices: NDArray[np.int32],
    edges: NDArray[np.int32],
    following: NDArray[np.int64],
    uvs: NDArray[np.float32],
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Find the edges between two faces over which a UV map is torn.

    `vertices`, `edges` and `following` have of each corner its vertex, the edge to the next corner of its face, and that corner. An edge
    of -1 is left out. UVs are (c, 2). Returns for each edge with two faces the corners at which they hold it, (k, 2), and whether the map
    is torn.
    """
    order = np.argsort(edges, kind="stable")
    order = order[edges[order] >= 0]
    _, first, counts = np.unique(edges[order], return_index=True, return_counts=True)
    first = first[counts == 2]
    pairs = np.stack([order[first], order[first + 1]], axis=1)
    one, two = pairs.T
    # Neighbors go along their edge in opposite ways, unless one is flipped.
    opposite = vertices[one] == vertices[following[two]]
    begin, end = np.where(opposite, following[two], two), np.where(opposite, two, following[two])
    gaps = np.abs(np.stack([uvs[one] - uvs[begin], uvs[following[one]] - uvs[end]]))
    return pairs, (gaps > _SAME).any(axis=(0, 2))


@dataclass(frozen=True)
class NewIsland:
    """An island that was unwrapped.

    Parameters
    ----------
    before, after
        (c, 2) its corners in the UV map before and after; `before` is all zero where it had no place.
    triangles
        (t, 3) its triangles, as rows of `after`.
    areas
        (t,) of those triangles on the model.
    density
        The wanted density: length in UVs over length on the model. Zero keeps the size.
    aspect
        The width over the height of the image that the UVs lie on: islands are turned as they are seen there.
    is_straight
        Whether its sides run along the axes, and stay so.
    """

    before: NDArray[np.float64]
    after: NDArray[np.float64]
    triangles: NDArray[np.int64]
    areas: NDArray[np.float64]
    density: float
    aspect: float = 1.0
    is_straight: bool = False


def in_rows(uvs: NDArray[np.float64], labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Lay islands out in rows in the UV square, the tallest first, none of them touching another, all at one scale.

    The corners, (c, 2), belong to islands with the numbers `labels`, (c,), from 0. Returns the corners between 0 and 1.
    """
    count = int(labels.max(initial=-1)) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, labels, uvs)
    np.maximum.at(high, labels, uvs)
    sizes = np.maximum(high - low, 0.0)  # a number without corners has no size
    gap = 0.02 * float(sizes.max(initial=0.0))
    width = max(float(sizes[:, 0].max(initial=0.0)), float(np.sqrt(np.prod(sizes + gap, axis=1).sum()))) + gap
    spots = np.zeros((count, 2))
    x = y = tall = 0.0
    for island in np.argsort(-sizes[:, 1], kind="stable").tolist():
        if x > 0.0 and x + sizes[island, 0] > width:
            x, y, tall = 0.0, y + tall + gap, 0.0
        spots[island] = x, y
        x, tall = x + sizes[island, 0] + gap, max(tall, sizes[island, 1])
    placed = uvs - low[labels] + spots[labels]
    return placed / max(float(placed.max(initial=0.0)), 1e-300)


def signed_uv_areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the areas of triangles, (t, 3, 2), negative for clockwise ones."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def uv_areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the areas of triangles, (t, 3, 2)."""
    return np.abs(signed_uv_areas(corners))


def flat_faces(
    points: NDArray[np.float64],
    corners: Corners,
    triangles: NDArray[np.int64],
    uvs: NDArray[np.float64],
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Find the faces that have a shape on the model, but lie on a line or a point in the map.

    `triangles` are corners, (t, 3), and `uvs` are of corners, (c, 2). Returns whether each face is flat, (f,), and how it goes around in
    the map, (f,): 1 against the clock, -1 with it, 0 if it lies on a line or has no triangles.
    """
    count = int(corners.faces.max(initial=-1)) + 1
    faces = corners.faces[triangles[:, 0]]
    signed = np.bincount(faces, signed_uv_areas(uvs[triangles]), count)
    areas = np.bincount(faces, triangle_areas(points, corners.vertices[triangles]), count)
    in_map, on_model = (_squared_sizes(places, corners.faces) for places in (uvs, points[corners.vertices]))
    has_area = np.abs(signed) > _THIN * in_map  # not if a place is not a number
    return (areas > _THIN * on_model) & ~has_area, np.where(has_area, np.sign(signed), 0.0)


def one_way_around(corners: Corners, joints: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return for each face, (f,), 1 or -1 so that faces which share an edge go around in one way after multiplying.

    `joints`, (k, 2), are the corners at which two faces hold an edge.
    """
    count = int(corners.faces.max(initial=-1)) + 1
    one, two = joints.T
    is_even = corners.vertices[one] == corners.vertices[corners.following[two]]
    if is_even.all():
        return np.ones(count, dtype=np.int64)
    pieces = components(count, corners.faces[joints[is_even]])
    signs = np.zeros(int(pieces.max(initial=-1)) + 1, dtype=np.int64)
    beside: dict[int, set[int]] = {}
    for a, b in np.unique(pieces[corners.faces[joints[~is_even]]], axis=0).tolist():
        beside.setdefault(a, set()).add(b)
        beside.setdefault(b, set()).add(a)
    for start in beside:
        waiting = [start] if signs[start] == 0 else []
        signs[waiting] = 1
        while waiting:
            piece = waiting.pop()
            for other in beside[piece]:
                if signs[other] == 0:
                    signs[other] = -signs[piece]
                    waiting.append(other)
    signs[signs == 0] = 1
    return signs[pieces]


def _squared_sizes(places: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the squared diagonals of the boxes around faces, (f,), whose corners, (c, d), come face by face."""
    if not len(faces):
        return np.zeros(0)
    starts = np.flatnonzero(np.diff(faces, prepend=-1))
    sizes = np.zeros(int(faces[-1]) + 1)
    extents = np.maximum.reduceat(places, starts) - np.minimum.reduceat(places, starts)
    sizes[faces[starts]] = (extents**2).sum(axis=1)
    return sizes


def boxes_of(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the bounds of triangles, (t, 3, 2), as low u, low v, high u, high v: (t, 4)."""
    return np.concatenate([corners.min(axis=1), corners.max(axis=1)], axis=1).reshape(-1, 4)


def place(islands: Sequence[NewIsland], taken: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Find a place for unwrapped islands among the triangles that stay, with the bounds `taken`, (b, 4), see `boxes_of`.

    Each island keeps its texel density and rotation. A straight one is turned along the axes, as near to its rotation as possible. Each is
    placed in the nearest free space of its square, or to the right of all islands if the square is full. Returns the corners of each, (c,
    2).
    """
    ready = [_fitted(island) for island in islands]
    sizes = [float(np.prod(np.ptp(corners, axis=0))) for corners in ready]
    placed: list[NDArray[np.float64]] = list(ready)
    squares: dict[tuple[float, ...], _Square] = {}
    boxes = [taken]
    left_over = []
    for number in sorted(range(len(ready)), key=lambda number: -sizes[number]):
        island, corners = islands[number], ready[number]
        middle = 0.5 * (island.before.min(axis=0) + island.before.max(axis=0))
        low = np.floor(middle)
        if tuple(low) not in squares:
            squares[tuple(low)] = _Square(low, np.concatenate(boxes))
        square = squares[tuple(low)]
        spot = square.free_spot(np.ptp(corners, axis=0), middle)
        if spot is None:
            left_over.append(number)
            continue
        placed[number] = corners + (spot - corners.min(axis=0))
        boxes.append(boxes_of(placed[number][island.triangles]))
        square.take(boxes[-1])
    edge = max(1.0, float(np.concatenate(boxes)[:, 2].max(initial=0.0)))
    left, bottom, widest = edge + 4.0 * _GAP, 0.0, 0.0
    for number in left_over:
        width, height = np.ptp(ready[number], axis=0)
        if bottom > 0.0 and bottom + height > 1.0:
            left, bottom, widest = left + widest + 4.0 * _GAP, 0.0, 0.0
        placed[number] = ready[number] + ((left, bottom) - ready[number].min(axis=0))
        bottom, widest = bottom + height + 4.0 * _GAP, max(widest, width)
    return placed


def _fitted(island: NewIsland) -> NDArray[np.float64]:
    """Return the corners of an island in the wanted size and the old rotation."""
    area, now = float(island.areas.sum()), float(uv_areas(island.after[island.triangles]).sum())
    wanted = island.density**2 * area
    on_image = (island.aspect, 1.0)
    corners = (island.after - island.after.mean(axis=0)) * on_image
    old = (island.before - island.before.mean(axis=0)) * on_image
    if now > 0.0 and wanted > 0.0:
        corners = corners * np.sqrt(wanted / now)
    # The turn that leaves least between the two: Kabsch in the plane.
    along, across = float((corners * old).sum()), float((corners[:, 0] * old[:, 1] - corners[:, 1] * old[:, 0]).sum())
    length = np.hypot(along, across)
    if length > 0.0:
        cos, sin = along / length, across / length
        if island.is_straight:
            cos, sin = (np.sign(cos), 0.0) if abs(cos) >= abs(sin) else (0.0, np.sign(sin))
        corners = corners @ np.array([[cos, sin], [-sin, cos]])
    return corners / on_image


class _Square:
    """One unit square of the UV plane, cell by cell. `taken`, (b, 4), are bounds of what lies in it, and elsewhere."""

    def __init__(self, low: NDArray[np.float64], taken: NDArray[np.float64]) -> None:
        self._low = low
        self._full = np.zeros((_CELLS, _CELLS), dtype=bool)
        # How many cells are taken below and left of each: four of these tell whether a rectangle is free.
        self._sums = np.zeros((_CELLS + 1, _CELLS + 1), dtype=np.int32)
        self._too_large: list[tuple[int, int]] = []  # rectangles for which there is no room
        self.take(taken)

    def take(self, boxes: NDArray[np.float64]) -> None:
        """Let bounds, (b, 4), be taken."""
        if not len(boxes):
            return
        low = np.clip(np.floor((boxes[:, :2] - self._low) * _CELLS), 0, _CELLS).astype(np.int64)
        high = np.clip(np.floor((boxes[:, 2:] - self._low) * _CELLS) + 1, 0, _CELLS).astype(np.int64)
        left, bottom = low.min(axis=0)
        right, top = high.max(axis=0)
        if left == right or bottom == top:
            return
        low, high = low - (left, bottom), high - (left, bottom)
        # Each is counted up at its low corner and down behind its high one: sums tell how many cover a cell.
        marks = np.zeros((right - left + 1, top - bottom + 1), dtype=np.int32)
        for u, v, sign in ((low, low, 1), (high, low, -1), (low, high, -1), (high, high, 1)):
            np.add.at(marks, (u[:, 0], v[:, 1]), sign)
        full = self._full[left:right, bottom:top]
        new = (marks.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0) & ~full
        full |= new
        more = new.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)
        sums = self._sums[left + 1 :, bottom + 1 :]
        wide, tall = more.shape
        sums[:wide, :tall] += more
        sums[:wide, tall:] += more[:, -1:]
        sums[wide:, :tall] += more[-1]
        sums[wide:, tall:] += more[-1, -1]

    def free_spot(self, size: NDArray[np.float64], middle: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Return the low corner of a free rectangle of a size whose center is near a place, the nearest within some cells, or None."""
        wide, tall = np.ceil((size + 2.0 * _GAP) * _CELLS).astype(np.int64).tolist()
        if max(wide, tall) > _CELLS or any(wide >= width and tall >= height for width, height in self._too_large):
            return None
        last = np.array([_CELLS - wide, _CELLS - tall])
        wanted = (middle - self._low - 0.5 * size - _GAP) * _CELLS
        begin = np.clip(np.rint(wanted), 0, last).astype(np.int64)
        beside = np.abs(wanted - begin)
        for reach, step in _REACHES:
            found, away = self._nearest(wide, tall, wanted, begin, reach, step)
            # Beyond the reach along either axis, everything is at least so far away.
            bound = min(np.hypot(reach + beside[0], beside[1]), np.hypot(beside[0], reach + beside[1]))
            if found is not None and away > bound and reach < _CELLS:
                found, away = self._nearest(wide, tall, wanted, begin, int(np.ceil(away)), step)
            if found is not None:
                return self._low + np.array(found) / _CELLS + _GAP
        self._too_large.append((wide, tall))
        return None

    def _nearest(
        self, wide: int, tall: int, wanted: NDArray[np.float64], begin: NDArray[np.int64], reach: int, step: int
    ) -> tuple[tuple[int, int] | None, float]:
        """Return the low cell of the nearest free rectangle that is within a reach from a cell, or None, and how far away it is."""
        # A step from the beginning leads to the beginning again.
        first = begin - np.minimum(begin, reach) // step * step
        end = np.minimum(begin + reach, np.array([_CELLS - wide, _CELLS - tall])) + 1
        (left, bottom), (right, top) = first.tolist(), end.tolist()
        sums = self._sums
        columns, rows = slice(left, right, step), slice(bottom, top, step)
        behind, above = slice(left + wide, right + wide, step), slice(bottom + tall, top + tall, step)
        taken = sums[behind, above] - sums[columns, above]
        free = np.flatnonzero(taken == sums[behind, rows] - sums[columns, rows])
        if not len(free):
            return None, np.inf
        u, v = np.divmod(free, taken.shape[1])
        u, v = left + step * u, bottom + step * v
        away = (u - wanted[0]) ** 2 + (v - wanted[1]) ** 2
        nearest = int(away.argmin())
        return (int(u[nearest]), int(v[nearest])), float(np.sqrt(away[nearest]))
