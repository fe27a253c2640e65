# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks along curves over a mesh, from triangle to triangle, and finds the edges and faces that they pass."""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments
from ..network.picks import FacePoint, vertices_of
from .cut_nodes import FLAT, NEAR, OFF, ON, CutError, Faces, Node, Piece, Spot, Trail

if TYPE_CHECKING:
    from numpy.typing import NDArray


_HOP = 1e-3
"""The cost of a step over a triangle in a single point, which is how a curve passes triangles without area. Costs are added to how far
points are from triangles, as part of their longest sides."""

_LEAP = 0.25
"""The cost of a step from one triangle of a polygon to another: between them, the polygon may not be there."""

_REACH = 0.1
"""The extra cost allowed for a walk that ends at the requested vertex instead of another point in the same place."""

_STRAIGHT = 1e-2
"""The cost of a step over a triangle in which the curve has no point; curves found on other triangles need such steps."""


class _Step(NamedTuple):
    """How far a walk along a curve has come.

    Parameters
    ----------
    number
        Of the curve's point that it heads for.
    on
        Where it is: a vertex, on an edge or inside a polygon.
    place
        The same in space, (3,).
    here
        The node there, which may have been moved away from the place; None before the first point.
    trail
        The pieces up to there.
    """

    number: int
    on: Node
    place: NDArray[np.float64]
    here: Node | None
    trail: Trail


def walk(faces: Faces, start: Spot, points: NDArray[np.float64], end: Spot | None = None) -> list[Piece]:
    """Return what a curve passes: from node to node, and the polygon between them.

    The walk is the cheapest one (Dijkstra's algorithm). A step costs nothing if the curve's next point lies in a polygon beside.
    Where faces lie on each other, the curve therefore runs over those that its next points are on as well.
    """
    # The ways on from a step, each with the cost that it adds to the way before it. Most walks need only the first way, so a way is
    # tried only when the walk has come to its cost.
    ways: list[tuple[float, Callable[[_Step], Iterator[tuple[float, _Step]]]]] = [
        (0.0, lambda step: _forward(faces, points, step)),
        (_HOP, lambda step: _in_place(faces, step)),
        (_STRAIGHT, lambda step: _straight_on(faces, points, step)),
    ]
    first, goal = _node_of(faces, start, points[0]), _node_of(faces, end, points[-1])
    here = None if first is None else _moved(faces, first)
    farthest = _Step(int(here is not None), first or Node(vertices_of(start)), points[0], here, None)
    order = itertools.count()  # of steps that cost the same the older one is first
    waiting = [(0.0, -farthest.number, next(order), farthest, ways)]
    done: set[tuple[int, tuple[int, ...], int]] = set()
    arrived: _Step | None = None
    most = np.inf
    while waiting:
        cost, _, _, step, ways_left = heapq.heappop(waiting)
        if cost > most:
            break
        if ways_left is ways:
            key = (step.number, step.on.vertices, step.on.polygon)
            if key in done:
                continue
            done.add(key)
            farthest = max(farthest, step, key=lambda one: one.number)
            if step.number == len(points):
                if goal is None or step.on.vertices == goal.vertices:
                    return _pieces_of(step.trail)
                # Several vertices and edges may lie in one place: the requested one may be found a little later, or never.
                if arrived is None:
                    arrived, most = step, cost + _REACH
        (_, way), *more_ways = ways_left
        for more, following in way(step):
            heapq.heappush(waiting, (cost + more, -following.number, next(order), following, ways))
        if more_ways and step.here is not None:
            heapq.heappush(waiting, (cost + more_ways[0][0], -step.number, next(order), step, more_ways))
    if arrived is None:
        raise CutError("off-mesh-near", vertex=farthest.on.vertices[0])
    return _pieces_of(arrived.trail)


def _node_of(faces: Faces, spot: Spot | None, place: NDArray[np.float64]) -> Node | None:
    """Return the node of a curve's end; None if only a vertex beside is known."""
    if spot is None:
        return None
    if isinstance(spot, FacePoint):
        around = (polygon for vertex in spot.corners for polygon in faces.polygons_at(vertex))
        polygon = next((one for one in around if spot.triangle in faces.rows_of(one)), None)
        if polygon is None:
            return None
        return in_polygon(faces, polygon, Node.between(spot.corners, spot.weights, ON), ON)
    own = Node((spot,))
    is_there = any(off == 0.0 and on == own for off, _, _, on in _nodes_at(faces, faces.polygons_at(spot), place))
    return own if is_there else None


def _pieces_of(trail: Trail) -> list[Piece]:
    pieces = []
    while trail is not None:
        piece, trail = trail
        pieces.append(piece)
    return pieces[::-1]


def _polygons_beside(faces: Faces, on: Node) -> Sequence[int]:
    """Return the polygons that a node lies in."""
    if on.polygon >= 0:
        return [on.polygon]
    around = faces.polygons_at(on.vertices[0])
    return around if len(on.vertices) == 1 else [one for one in around if is_side(faces, one, on.vertices)]


def is_side(faces: Faces, polygon: int, pair: Sequence[int]) -> bool:
    """Whether two vertices are the ends of a side of a polygon; an edge between them may also be a side of others only."""
    corners = list(faces.corners(polygon))
    return any({*pair} == {*side} for side in zip(corners, [*corners[1:], corners[0]], strict=True))


def _forward(faces: Faces, points: NDArray[np.float64], step: _Step) -> Iterator[tuple[float, _Step]]:
    """Yield the steps to the curve's next point in a polygon beside, and what each costs."""
    if step.number < len(points):
        place = points[step.number]
        for off, polygon, row, on in _nodes_at(faces, _polygons_beside(faces, step.on), place):
            leaves = step.here is not None and not _is_in(faces, polygon, row, step)
            yield off + leaves * _LEAP, _step_to(faces, step, step.number + 1, polygon, on, place)


def _is_in(faces: Faces, polygon: int, row: int, step: _Step) -> bool:
    """Whether a step is in a triangle of a polygon."""
    if {*step.on.vertices} <= {*faces.triangles[row].tolist()}:
        return True
    return any(off == 0.0 for off, *_ in _nodes_at(faces, [polygon], step.place, row))


def _in_place(faces: Faces, step: _Step) -> Iterator[tuple[float, _Step]]:
    """Yield the steps to other vertices and edges of the polygons beside that lie in the same place."""
    for off, polygon, _, on in _nodes_at(faces, _polygons_beside(faces, step.on), step.place):
        if on.polygon < 0 and on.vertices != step.on.vertices:
            yield off, _step_to(faces, step, step.number, polygon, on, step.place)


def _straight_on(faces: Faces, points: NDArray[np.float64], step: _Step) -> Iterator[tuple[float, _Step]]:
    """Yield the steps toward the curve's next point to where that way leaves a triangle beside."""
    if not 0 < step.number < len(points):
        return
    place, goal, before = step.place, points[step.number], points[step.number - 1]
    for polygon in _polygons_beside(faces, step.on):
        for row in faces.rows_of(polygon):
            corners = faces.points[faces.triangles[row]]
            exit_place = _exit(corners, place, goal)
            if exit_place is None or np.linalg.norm(goal - exit_place) >= np.linalg.norm(goal - place):
                continue
            _, (gap,) = nearest_on_segments(exit_place, before[None], goal[None])
            longest = float(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).max())
            if gap > OFF * longest:
                continue
            for off, *_, on in _nodes_at(faces, [polygon], exit_place, row):
                yield off + float(gap) / longest, _step_to(faces, step, step.number, polygon, on, exit_place)


def _exit(
    corners: NDArray[np.float64], place: NDArray[np.float64], goal: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    """Return where the way from a place in a triangle, (3, 3), toward another place leaves it.

    None if the segment does not cross the triangle.
    """
    u, v = corners[1] - corners[0], corners[2] - corners[0]
    normal = np.cross(u, v)
    square = float(normal @ normal)
    longest = max(float(u @ u), float(v @ v), float((u - v) @ (u - v)))
    if square <= (FLAT * longest) ** 2:
        return None

    def coordinates(w: NDArray[np.float64]) -> NDArray[np.float64]:
        s, t = np.cross(w, v) @ normal / square, np.cross(u, w) @ normal / square
        return np.array([-s - t, s, t])

    own = np.array([1.0, 0.0, 0.0]) + coordinates(place - corners[0])
    slope = coordinates(goal - place)
    if own.min() < -OFF or np.linalg.norm(np.clip(own, 0.0, None) @ corners - place) > OFF * np.sqrt(longest):
        return None
    own = np.clip(own, 0.0, None)
    shrinking = slope < -ON
    if not shrinking.any() or (own[shrinking] <= ON).any():
        return None
    part = float((own[shrinking] / -slope[shrinking]).min())
    there = np.clip(own + part * slope, 0.0, None)
    return there / there.sum() @ corners if part < 1.0 else None


def _nodes_at(
    faces: Faces, polygons: Iterable[int], place: NDArray[np.float64], only: int = -1
) -> Iterator[tuple[float, int, int, Node]]:
    """Yield the vertices and edges that a place in some polygons, or in one row of their triangles, lies on.

    Yields
    ------
    off
        How far the triangle is from the place, as part of its longest side, minus the rounding tolerance.
    polygon, row
        The polygon, and the triangle.
    node
        A vertex that the place is on, an edge between whose ends it lies, or otherwise the place inside.
    """
    rows = [(row, polygon) for polygon in polygons for row in faces.rows_of(polygon) if only in (-1, row)]
    triangles = faces.triangles[[row for row, _ in rows]]
    corners = faces.points[triangles]
    ends = np.roll(corners, -1, axis=1)
    weights, off = barycentric(corners, place)
    part, gap = (
        item.reshape(-1, 3) for item in nearest_on_segments(place, corners.reshape(-1, 3), ends.reshape(-1, 3))
    )
    longest = np.linalg.norm(ends - corners, axis=2).max(axis=1)
    with np.errstate(invalid="ignore"):
        away = np.fmin(gap.min(axis=1), off * longest)
    to_corners = np.linalg.norm(corners - place, axis=2)
    for k in np.flatnonzero(away <= OFF * longest).tolist():
        reach = away[k] + ON * longest[k]
        (row, polygon), triangle = rows[k], triangles[k].tolist()
        at = to_corners[k] <= reach
        nodes = [Node((triangle[i],)) for i in range(3) if at[i]]
        for i, j in ((0, 1), (1, 2), (2, 0)):
            if gap[k, i] <= reach and not at[i] and not at[j]:
                share = float(part[k, i])
                nodes.append(Node.between((triangle[i], triangle[j]), (1.0 - share, share)))
        for node in nodes or [Node.between(triangle, weights[k])]:
            cost = max(0.0, float(away[k] / longest[k]) - ON) if longest[k] > 0.0 else 0.0
            yield cost, polygon, row, in_polygon(faces, polygon, node, ON)


def _step_to(faces: Faces, step: _Step, number: int, polygon: int, on: Node, place: NDArray[np.float64]) -> _Step:
    """Return the step from another one to a node in a polygon beside it."""
    there = _moved(faces, on)
    leads_on = step.here is not None and there != step.here
    return _Step(number, on, place, there, ((step.here, there, polygon), step.trail) if leads_on else step.trail)


def _moved(faces: Faces, on: Node) -> Node:
    """Return a node as the vertex, or on the edge, that it is near to."""
    moved = Node.between(on.vertices, on.weights, NEAR)
    return moved if on.polygon < 0 else in_polygon(faces, on.polygon, moved, NEAR)


def in_polygon(faces: Faces, polygon: int, node: Node, near: float) -> Node:
    """Return a node of a polygon's triangles as one on the polygon's side, or else as one inside it."""
    node = _on_side(faces, polygon, node, near)
    is_inside = len(node.vertices) == 3 or (len(node.vertices) == 2 and not is_side(faces, polygon, node.vertices))
    return replace(node, polygon=polygon) if is_inside else node


def _on_side(faces: Faces, polygon: int, node: Node, near: float) -> Node:
    """Return a node that lies on a polygon's side as one between its ends, which diagonals past corners in a row do as well.

    One that is `near` one of these ends, as part of the side, is that vertex.
    """
    corners = faces.corners(polygon)
    if len(corners) < 4 or len(node.vertices) == 1:
        return node
    if len(node.vertices) == 2 and is_side(faces, polygon, node.vertices):
        return node
    starts = faces.points[list(corners)]
    ends = np.roll(starts, -1, axis=0)
    part, gap = nearest_on_segments(node.place(faces.points), starts, ends)
    best = int(np.argmin(gap))
    if not gap[best] < ON * np.linalg.norm(ends[best] - starts[best]):
        return node
    share = float(part[best, 0])
    return Node.between((corners[best], corners[(best + 1) % len(corners)]), (1.0 - share, share), near)
