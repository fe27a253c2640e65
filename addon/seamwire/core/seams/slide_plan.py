# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the vertices of a snapped chain of edges slide to, so that the edges lie on the curve they were snapped from.

Each vertex moves within the faces around it, as long as no face flips or gets thin. Vertices on features, on the border, and those that
the caller names stay. Knows neither Blender nor the library.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments, relative_heights, triangle_normals

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from numpy.typing import NDArray

FEATURE_ANGLE = 30.0
"""Degrees: a vertex of an edge where triangles meet at more lies on a feature."""
_ON = 1e-3
"""How far a curve's point may be from the triangle that it lies in, as part of its longest edge: stored curves are rounded."""
_SMOOTHINGS = 4
"""Rounds in which places along a curve are moved apart: at a step of a staircase two nearest ones nearly are the same."""
_ROUNDS = 12
"""Times that a vertex is put onto each of several curves in turn, until it lies where they cross."""
_HALVINGS = 4
"""Times that a move is halved before it is given up."""
_TURNED = 0.5
"""The least cosine between a triangle's normal before and after."""
_THINNER = 0.25
"""The least part of its height over its longest edge that a triangle keeps."""

Course = tuple["Sequence[int]", "NDArray[np.float64]"]
"""The vertices of a snapped chain, and the points, (k, 3), of its curve."""


@dataclass(frozen=True)
class SlidFaces:
    """The polygons at the vertices of some chains, and the triangles that they are seen as."""

    points: NDArray[np.float64]  # (n, 3)
    triangles: NDArray[np.int32]  # (m, 3)
    polygons: NDArray[np.int32]  # (m,) the polygon of each triangle, in ascending order
    corners: Mapping[int, Sequence[int]]  # the vertices around each polygon

    @cached_property
    def at(self) -> dict[int, list[int]]:
        found: dict[int, list[int]] = defaultdict(list)
        for polygon, rim in self.corners.items():
            for vertex in rim:
                found[vertex].append(polygon)
        return found

    def rows_of(self, polygon: int) -> Sequence[int]:
        # Of the same type, or all of the array would be converted.
        bounds = np.array((polygon, polygon + 1), dtype=self.polygons.dtype)
        return range(*np.searchsorted(self.polygons, bounds).tolist())


@dataclass(frozen=True)
class Move:
    """Where a vertex goes: in a polygon around it, by some of the corners and their weights, which are 0 or more and sum to 1."""

    polygon: int
    corners: tuple[int, ...]
    weights: tuple[float, ...]


def plan(faces: SlidFaces, courses: Iterable[Course], fixed: Collection[int] = ()) -> dict[int, Move]:
    """Find where the vertices of courses go. The ends of a chain stay, because they are seeds, and those that are `fixed`."""
    curves: dict[int, list[NDArray[np.float64]]] = defaultdict(list)
    evenly: dict[int, NDArray[np.float64]] = {}
    staying: set[int] = set(fixed)
    for chain, curve in courses:
        staying |= {chain[0], chain[-1]}
        evenly.update(zip(chain, _spread(faces.points[list(chain)], curve), strict=True))
        for vertex in chain:
            curves[vertex].append(curve)
    moves = {}
    for vertex in curves.keys() - staying:
        if _is_on_feature(faces, vertex):
            continue
        owners = [(polygon, row) for polygon in faces.at[vertex] for row in faces.rows_of(polygon)]
        triangles = faces.triangles[[row for _, row in owners]]
        corners, own = faces.points[triangles], curves[vertex]
        found = _within(corners, evenly[vertex]) if len(own) == 1 else None
        if found is None:
            # The nearest point of the curve within the faces around the vertex, or where its curves cross.
            place = faces.points[vertex]
            for curve in own * (1 if len(own) == 1 else _ROUNDS):
                found = _nearest_within(corners, place, curve)
                if found is None:
                    break
                place = found[1] @ corners[found[0]]
        if found is not None:
            row, weights = found
            moves[vertex] = Move(owners[row][0], tuple(triangles[row].tolist()), tuple(weights.tolist()))
    return _without_damage(faces, moves)


def places(points: NDArray[np.float64], moves: Iterable[Move]) -> NDArray[np.float64]:
    return np.array([np.array(move.weights) @ points[list(move.corners)] for move in moves]).reshape(-1, 3)


def _is_on_feature(faces: SlidFaces, vertex: int) -> bool:
    """Whether a vertex lies on a sharp edge, on the border or where sheets meet."""
    beside: dict[int, list[NDArray[np.float64]]] = defaultdict(list)
    for polygon in faces.at[vertex]:
        triples = _corner_triples(faces.corners[polygon])
        normal = triangle_normals(faces.points, np.array(triples)).sum(axis=0)
        normal /= max(float(np.linalg.norm(normal)), 1e-300)
        for before, at, after in triples:
            if at == vertex:
                beside[before].append(normal)
                beside[after].append(normal)
    least = np.cos(np.radians(FEATURE_ANGLE))
    return any(len(normals) != 2 or normals[0] @ normals[1] < least for normals in beside.values())


def _corner_triples(rim: Sequence[int]) -> list[tuple[int, int, int]]:
    return [(rim[at - 1], rim[at], rim[(at + 1) % len(rim)]) for at in range(len(rim))]


def _spread(chain: NDArray[np.float64], curve: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a place on a curve for each vertex of its chain: near the nearest one, and not too near those of its neighbors."""
    steps = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.empty(len(chain))
    for number, place in enumerate(chain):
        part, gap = nearest_on_segments(place, curve[:-1], curve[1:])
        nearest = int(np.argmin(gap))
        at[number] = along[nearest] + part[nearest, 0] * steps[nearest]
    at[0], at[-1] = 0.0, along[-1]
    for _ in range(_SMOOTHINGS):
        at[1:-1] = 0.5 * at[1:-1] + 0.25 * (at[:-2] + at[2:])
    return np.stack([np.interp(at, along, curve[:, axis]) for axis in range(3)], axis=1)


def _within(corners: NDArray[np.float64], place: NDArray[np.float64]) -> tuple[int, NDArray[np.float64]] | None:
    weights, off = barycentric(corners, place)
    best = int(np.argmin(off))
    return (best, weights[best]) if off[best] <= _ON else None


def _nearest_within(
    corners: NDArray[np.float64], place: NDArray[np.float64], curve: NDArray[np.float64]
) -> tuple[int, NDArray[np.float64]] | None:
    """Return the point of a curve nearest to a place among those in some triangles, (k, 3, 3), as triangle and weights."""
    part, gap = nearest_on_segments(place, curve[:-1], curve[1:])
    reach = float(np.linalg.norm(corners - place, axis=2).max())
    near = np.flatnonzero(gap <= reach)
    for segment in near[np.argsort(gap[near], kind="stable")]:
        found = _within(corners, curve[segment] + part[segment] * (curve[segment + 1] - curve[segment]))
        if found is not None:
            return found
    return None


def _without_damage(faces: SlidFaces, moves: dict[int, Move]) -> dict[int, Move]:
    """Make moves shorter, or leave them out, until no corner of a face turns over or gets thin."""
    touched = {polygon for vertex in moves for polygon in faces.at[vertex]}
    triples = [triple for polygon in sorted(touched) for triple in _corner_triples(faces.corners[polygon])]
    triangles = np.array(triples, dtype=np.int64).reshape(-1, 3)
    normals, heights = triangle_normals(faces.points, triangles), relative_heights(faces.points[triangles])
    halved: dict[int, int] = defaultdict(int)
    moved = faces.points.copy()
    while moves:
        moved[list(moves)] = places(faces.points, moves.values())
        now = moved[triangles]
        cosines = np.einsum("ij,ij->i", normals, triangle_normals(moved, triangles))
        bad = ((cosines < _TURNED) | (relative_heights(now) < _THINNER * heights)) & (heights > 0.0)
        guilty = {vertex for vertex in triangles[bad].ravel().tolist() if vertex in moves}
        if not guilty:
            break
        for vertex in guilty:
            halved[vertex] += 1
            move = moves.pop(vertex)
            moved[vertex] = faces.points[vertex]
            if halved[vertex] <= _HALVINGS:
                weights = {corner: 0.5 * weight for corner, weight in zip(move.corners, move.weights, strict=True)}
                weights[vertex] = weights.get(vertex, 0.0) + 0.5
                moves[vertex] = Move(move.polygon, tuple(weights), tuple(weights.values()))
    return moves
