# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes on the surface that wires near them follow, or keep from; Section 5 of the paper."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..base import native
from ..base.geometry import barycentric, length_of
from ..base.refused import Refused

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

ActsOn = Literal["both", "min", "max", "concave", "euclidean"]
"""Which of `FOLLOWS` a stroke acts on; "both": on all of them. Files have these words; "euclidean" is for the library only."""

_OFF_MESH = 0.05
"""How far from its triangle a point may be, as part of the mesh's longest side: what the library takes."""
_STEP = 2.5e-4
"""Points nearer to each other than this part of the longest side are left out: triangles are larger in any mesh."""
_SMOOTHINGS = 2

_ids = itertools.count()


@dataclass(frozen=True, eq=False)
class Stroke:
    """A stroke.

    Parameters
    ----------
    points
        (n, 3), in drawing order, as the mesh's points are given.
    corners
        (n, 3) the vertices of the triangle that each point lies in; three times the same: the vertex it is at.
    faces
        (n,) the triangles' numbers; -1: the point is at a vertex, or the triangle is to be found by `on_mesh`.
    attracts
        Whether wires follow it; else they keep from it: crossing it is short, following it long.
    acts_on
        Which of the wires it is meant for.
    eta
        The eigenvalues of the metric along it are eta and 1 / eta.
    rings
        How many rings of vertices around it it reaches.
    radius
        How far it reaches instead, in the points' units.
    id
        Its own number.
    """

    points: NDArray[np.float64]
    corners: NDArray[np.int32]
    faces: NDArray[np.int32]
    attracts: bool = True
    acts_on: ActsOn = "both"
    eta: float = 20.0
    rings: int = 10
    radius: float | None = None
    id: int = field(default_factory=_ids.__next__)

    @property
    def vertices(self) -> NDArray[np.int32]:
        """(n,) the vertex that each point is at; -1: it lies in a triangle."""
        return np.where(self.faces >= 0, -1, self.corners[:, 0]).astype(np.int32)


class OffMeshError(Refused):
    """A stroke cannot be drawn."""


def drawn(
    points: ArrayLike, faces: ArrayLike, mesh: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Return a stroke as a hand drew it, smoothed a little: its points, their triangles' corners and numbers.

    The points, (n, 3), lie in faces of a mesh with vertices, (k, 3), and triangles, (m, 3). Raises OffMeshError where the stroke has no
    length, or a point is not in its triangle, nor near.
    """
    path = np.array(points, dtype=np.float64).reshape(-1, 3)
    numbers = np.array(faces, dtype=np.int32).reshape(-1)
    if len(path) != len(numbers) or not np.isfinite(path).all():
        raise OffMeshError("The stroke is damaged: each point needs a place and a face")
    if ((numbers < 0) | (numbers >= len(triangles))).any():
        raise OffMeshError("The stroke leaves the visible part of the mesh")
    size = longest_side(mesh)
    rows = _thinned(path, _STEP * size)
    path, numbers = path[rows], numbers[rows]
    closed = len(path) > 3 and bool(np.array_equal(path[0], path[-1]))
    if closed:
        numbers[-1] = numbers[0]
    corners = triangles[numbers]
    inside = into_triangles(path, mesh[corners])
    if (np.linalg.norm(inside - path, axis=1) > _OFF_MESH * size).any():
        raise OffMeshError("The stroke leaves the mesh")
    _check_length(inside, size)
    for _ in range(_SMOOTHINGS):
        before, after = np.roll(inside, 1, axis=0), np.roll(inside, -1, axis=0)
        if closed:
            before[0], after[-1] = inside[-2], inside[1]
        smooth = 0.25 * (before + 2.0 * inside + after)
        if not closed:
            smooth[[0, -1]] = inside[[0, -1]]
        # Each point stays in its triangle: what zigzags less than that changes no edge's direction.
        inside = into_triangles(smooth, mesh[corners])
    return inside, corners.astype(np.int32), numbers


def through_vertices(
    vertices: ArrayLike, mesh: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Return a stroke through vertices: its points, three times the vertex of each, and -1 for each.

    Raises OffMeshError where it has no length, or a vertex is not there.
    """
    numbers = np.array(vertices, dtype=np.int64).reshape(-1)
    missing = numbers[(numbers < 0) | (numbers >= len(mesh))]
    if len(missing):
        raise OffMeshError(f"There is no vertex {missing[0]} for the stroke: the mesh has {len(mesh)}, numbered from 0")
    path = mesh[numbers]
    _check_length(path, longest_side(mesh))
    corners = np.repeat(numbers[:, None], 3, axis=1).astype(np.int32)
    return path, corners, np.full(len(numbers), -1, dtype=np.int32)


def longest_side(mesh: NDArray[np.float64]) -> float:
    """Return how long the mesh is in that of the axes' directions where it is longest."""
    return max((float(np.ptp(column)) for column in mesh.T), default=0.0)  # column by column: ten times as fast


def _thinned(path: NDArray[np.float64], step: float) -> NDArray[np.int64]:
    if len(path) < 2 or not step > 0.0:
        return np.arange(len(path))
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    rows = np.unique(np.floor(along / step), return_index=True)[1]
    return np.union1d(rows, [len(path) - 1])


def _check_length(path: NDArray[np.float64], size: float) -> None:
    length = length_of(path) if len(path) > 1 else 0.0
    if not length > _STEP * size:
        raise OffMeshError("A stroke needs a direction: drag along the surface")


def into_triangles(places: NDArray[np.float64], triangles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n, 3) places moved into their (n, 3, 3) triangles: one that lies in its own stays where it is."""
    weights, off = barycentric(triangles, places)
    weights[~np.isfinite(off)] = [1.0, 0.0, 0.0]  # of a triangle without an area, the first corner will do
    return np.einsum("ij,ijk->ik", weights, triangles)


def on_mesh(stroke: Stroke, mesh: NDArray[np.float64], triangles: NDArray[np.int32]) -> Stroke:
    """Return a stroke with its points in the triangles, (m, 3), between its corners, or else at the nearest of those."""
    corners = np.sort(stroke.corners, axis=1)
    at_vertex = corners[:, 0] == corners[:, 2]
    number_of: dict[tuple[int, ...], int] = {}
    if not at_vertex.all():
        touched = np.zeros(len(mesh), dtype=bool)
        touched[corners[~at_vertex]] = True
        rows = np.flatnonzero(touched[triangles].all(axis=1))
        number_of = dict(zip(map(tuple, np.sort(triangles[rows], axis=1).tolist()), rows.tolist(), strict=True))
    faces = np.array([number_of.get(tuple(triple), -1) for triple in corners.tolist()], dtype=np.int32)
    points = into_triangles(stroke.points, mesh[corners])
    lost = faces < 0
    gaps = np.linalg.norm(mesh[corners[lost]] - points[lost, None], axis=2)
    nearest = np.take_along_axis(corners[lost], gaps.argmin(axis=1)[:, None], axis=1)
    corners[lost] = nearest
    points[lost] = mesh[nearest[:, 0]]
    return replace(stroke, points=points, corners=corners.astype(np.int32), faces=faces)


def for_library(stroke: Stroke) -> object:
    return native.load().Scribble(
        stroke.points,
        faces=stroke.faces,
        vertices=stroke.vertices,
        eta=stroke.eta,
        rings=stroke.rings,
        radius=stroke.radius,
        attracts=stroke.attracts,
        acts_on=stroke.acts_on,
    )
