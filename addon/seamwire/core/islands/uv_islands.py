# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands in UV space: which ones are no longer what the seams say. Knows no Blender."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.components import components
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..base.mesh_arrays import Arrays

_SAME = 1e-5
"""UVs nearer than this are one place: unwrapping gives corners that belong together the same numbers, packing rounds them."""
_THIN = 1e-6
"""A face with less area, as a part of its squared length, lies on a line."""


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
