# SPDX-License-Identifier: GPL-3.0-or-later
"""Where curves over a mesh cut its edges and faces, as a plan that somebody else carries out. Knows neither Blender nor the library.

A curve is a list of points on the mesh. A walk along it, from triangle to triangle, finds the edges and faces that it passes. Then
all curves are joined: they meet in shared points where they cross or run close to each other.
"""

from __future__ import annotations

import heapq
import itertools
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments
from ..base.messages import Refused
from ..network.network import FacePoint, vertices_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.network import Edge

NEAR = 0.05
"""A cut that passes a vertex or an edge nearer than that, as part of an edge or of a triangle's height, goes through it: no slivers."""
WIDE = 0.25
"""Two cuts that part and meet again are merged if they are nowhere farther apart than this fraction of the heights of the triangles that
they cross. Otherwise curves that run side by side would enclose tiny islands."""
OFF = 0.25
"""How far from the mesh a curve's points may be, as part of the longest side of the triangle beside. Mirror images of curves are off
if the halves of a mesh are cut into other triangles, and so are the curves of slid wires. The cuts lie on the mesh all the same."""
BEND = 0.1
"""By how much of its length a cut may leave the straight line within a polygon and be straight."""
ON = 1e-4
"""Which vertex or edge a curve's point is on: stored curves are rounded."""
FLAT = 1e-3
"""A polygon's side has no length below this part of its longest one. Two sides lie on each other below this sine of the angle
between them. A triangle has no area below this part of the square of its longest side."""
SIDE = 0.05
"""The least cosine between the normal of a triangle and the direction along which its polygon is seen."""
_HOP = 1e-3
"""The cost of a step over a triangle in a single point, which is how a curve passes triangles without area. Costs are added to how far
points are from triangles, as part of their longest sides."""
_LEAP = 0.25
"""The cost of a step from one triangle of a polygon to another: between them, the polygon may not be there."""
_REACH = 0.1
"""The extra cost allowed for a walk that ends at the requested vertex instead of another point in the same place."""
_STRAIGHT = 1e-2
"""The cost of a step over a triangle in which the curve has no point; curves found on other triangles need such steps."""


class CutError(Refused):
    """A curve cannot be cut into the mesh."""


class Faces(Protocol):
    """The polygons of a mesh, and the triangles that they are seen as."""

    points: NDArray[np.float64]
    """(n, 3) vertices."""
    triangles: NDArray[np.int32]
    """(m, 3)"""

    def polygons_at(self, vertex: int) -> Sequence[int]:
        """Return the polygons around a vertex."""

    def rows_of(self, polygon: int) -> Sequence[int]:
        """Return the triangles of a polygon."""

    def corners(self, polygon: int) -> Sequence[int]:
        """Return the vertices around a polygon."""


@dataclass(frozen=True)
class Node:
    """A place on the mesh: a vertex, a point between two, or one inside a triangle.

    Parameters
    ----------
    vertices
        One, two or three, ascending.
    weights
        Of each vertex, all positive; their sum is 1.
    polygon
        The polygon that it lies inside; -1 if it is a vertex or lies on an edge.
    """

    vertices: tuple[int, ...]
    weights: tuple[float, ...] = (1.0,)
    polygon: int = -1

    @classmethod
    def between(cls, vertices: Sequence[int], weights: Sequence[float], near: float = 0.0) -> Node:
        """Return the node of barycentric coordinates, moved to an edge or a vertex that it is near to."""
        kept = [(int(v), float(w)) for v, w in zip(vertices, weights, strict=True) if w > near]
        if len(kept) < 3:
            # Points near an edge may still be near one of its ends.
            total = sum(w for _, w in kept)
            kept = [(v, w / total) for v, w in kept if w > near * total]
        kept.sort()
        total = sum(w for _, w in kept)
        return cls(tuple(v for v, _ in kept), tuple(w / total for _, w in kept))

    def place(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where it is, (3,)."""
        return np.asarray(self.weights) @ points[list(self.vertices)]

    def near(self, other: Node) -> bool:
        """Whether both are between the same vertices, and near each other."""
        weights = zip(self.weights, other.weights, strict=True)
        return self.vertices == other.vertices and max(abs(one - two) for one, two in weights) < NEAR

    def weight(self, vertex: int) -> float:
        """Return the weight of any vertex."""
        return dict(zip(self.vertices, self.weights, strict=True)).get(vertex, 0.0)


Segment = tuple[Node, Node]
"""A straight cut between two nodes."""

Piece = tuple[Node, Node, int]
"""One in a polygon, by that polygon's number."""

Spot = int | FacePoint
"""A vertex, or a point in a triangle."""

_Trail = tuple[Piece, "_Trail"] | None
"""The pieces up to one, the last first."""


@dataclass
class CutPlan:
    """The changes to the mesh.

    Parameters
    ----------
    splits
        For each edge that is cut, its smaller vertex first, the nodes on it, from that vertex on.
    along
        Cuts between two neighboring vertices or nodes of one edge.
    across
        For each polygon, the cuts inside it. Their nodes are its corners, on its edges or inside it.
    folded
        Polygons whose cuts were planned on a regular one, see `regular_corners`: they are folded or have no area.
    left_out
        The numbers of the curves that do not run over the mesh.
    """

    splits: dict[Edge, list[Node]] = field(default_factory=dict)
    along: list[Segment] = field(default_factory=list)
    across: dict[int, list[Segment]] = field(default_factory=dict)
    folded: set[int] = field(default_factory=set)
    left_out: list[int] = field(default_factory=list)

    def segments(self) -> list[Segment]:
        """Return all cuts."""
        return [*self.along, *(segment for own in self.across.values() for segment in own)]

    def nodes(self) -> list[Node]:
        """Return all nodes, each once."""
        return list(dict.fromkeys(node for segment in self.segments() for node in segment))

    def node_at(self, vertices: Sequence[int], weights: Sequence[float]) -> Node | None:
        """Return the node at barycentric coordinates, or the one that was moved away from there, or None."""
        wanted = Node.between(vertices, weights, NEAR)
        same = (node for node in self.nodes() if node.vertices == wanted.vertices and node.near(wanted))
        return next(same, None)

    def inside(self) -> list[Node]:
        """Return the nodes inside polygons."""
        return [node for node in self.nodes() if node.polygon >= 0]


Curve = tuple[Spot, "NDArray[np.float64]"] | tuple[Spot, "NDArray[np.float64]", Spot]
"""Where to begin, points, and perhaps where to end; see `plan`."""


def plan(faces: Faces, curves: Iterable[Curve], images: Mapping[int, int] | None = None) -> CutPlan:
    """Find what curves cut.

    Parameters
    ----------
    faces
        The mesh.
    curves
        For each, the vertex that it begins at, or a corner of the triangle that it begins in, or the point in a triangle;
        and its points, (k, 3). An end inside a polygon that no other curve leads on from goes back to the last edge. A third item is the
        vertex or the point in a triangle where a curve ends, because other vertices and edges may lie in the same place.
    images
        For each curve that is a mirror image, by its number, the number of the curve before it that it is an image of.
        The image of a curve that is left out is not cut either, and not named.

    Raises
    ------
    CutError
        If no curve runs over the mesh.
    """
    pieces: list[Piece] = []
    ends: list[Node] = []
    left_out: list[int] = []
    problem: CutError | None = None
    for number, (start, points, *end) in enumerate(curves):
        if images and images.get(number) in left_out:
            continue
        try:
            own = _without_detours(_walk(faces, start, points, *end))
        except CutError as error:
            problem = problem or error
            left_out.append(number)
            continue
        ends += _ends(own)
        pieces += own
    if problem is not None and not pieces:
        raise problem
    together = _parted(faces, _together(_crossed(faces, _together(pieces))))
    seeds = _Ends(ends)
    result = _sorted_out(faces, _without_spurs(_without_slivers(faces, together, seeds), seeds))
    result.left_out = left_out
    return result


class _Ends:
    """Where curves begin and end."""

    def __init__(self, ends: Iterable[Node]) -> None:
        self._at: dict[tuple[int, ...], list[Node]] = defaultdict(list)
        for node in ends:
            self._at[node.vertices].append(node)

    def __contains__(self, node: Node) -> bool:
        return any(node.near(end) for end in self._at.get(node.vertices, ()))


def _ends(pieces: Sequence[Piece]) -> Iterator[Node]:
    """Yield the first and the last node of a curve's pieces that are not inside a polygon."""
    nodes = [node for one, two, _ in pieces for node in (one, two)]
    for way in (nodes, nodes[::-1]):
        yield from itertools.islice((node for node in way if node.polygon < 0), 1)


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
    trail: _Trail


def _walk(faces: Faces, start: Spot, points: NDArray[np.float64], end: Spot | None = None) -> list[Piece]:
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
        return _in_polygon(faces, polygon, Node.between(spot.corners, spot.weights, ON), ON)
    own = Node((spot,))
    is_there = any(off == 0.0 and on == own for off, _, _, on in _nodes_at(faces, faces.polygons_at(spot), place))
    return own if is_there else None


def _pieces_of(trail: _Trail) -> list[Piece]:
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
    return around if len(on.vertices) == 1 else [one for one in around if _is_side(faces, one, on.vertices)]


def _is_side(faces: Faces, polygon: int, pair: Sequence[int]) -> bool:
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
            yield cost, polygon, row, _in_polygon(faces, polygon, node, ON)


def _step_to(faces: Faces, step: _Step, number: int, polygon: int, on: Node, place: NDArray[np.float64]) -> _Step:
    """Return the step from another one to a node in a polygon beside it."""
    there = _moved(faces, on)
    leads_on = step.here is not None and there != step.here
    return _Step(number, on, place, there, ((step.here, there, polygon), step.trail) if leads_on else step.trail)


def _moved(faces: Faces, on: Node) -> Node:
    """Return a node as the vertex, or on the edge, that it is near to."""
    moved = Node.between(on.vertices, on.weights, NEAR)
    return moved if on.polygon < 0 else _in_polygon(faces, on.polygon, moved, NEAR)


def _in_polygon(faces: Faces, polygon: int, node: Node, near: float) -> Node:
    """Return a node of a polygon's triangles as one on the polygon's side, or else as one inside it."""
    node = _on_side(faces, polygon, node, near)
    is_inside = len(node.vertices) == 3 or (len(node.vertices) == 2 and not _is_side(faces, polygon, node.vertices))
    return replace(node, polygon=polygon) if is_inside else node


def _on_side(faces: Faces, polygon: int, node: Node, near: float) -> Node:
    """Return a node that lies on a polygon's side as one between its ends, which diagonals past corners in a row do as well.

    One that is `near` one of these ends, as part of the side, is that vertex.
    """
    corners = faces.corners(polygon)
    if len(corners) < 4 or len(node.vertices) == 1:
        return node
    if len(node.vertices) == 2 and _is_side(faces, polygon, node.vertices):
        return node
    starts = faces.points[list(corners)]
    ends = np.roll(starts, -1, axis=0)
    part, gap = nearest_on_segments(node.place(faces.points), starts, ends)
    best = int(np.argmin(gap))
    if not gap[best] < ON * np.linalg.norm(ends[best] - starts[best]):
        return node
    share = float(part[best, 0])
    return Node.between((corners[best], corners[(best + 1) % len(corners)]), (1.0 - share, share), near)


def _without_detours(pieces: Iterable[Piece]) -> list[Piece]:
    """Leave out what leads away from a node and back: places that were near a vertex before and after others that were not."""
    kept: list[Piece] = []
    number_at: dict[Node, int] = {}
    for piece in pieces:
        number_at.setdefault(piece[0], len(kept))
        kept.append(piece)
        before = number_at.get(piece[1], 0)
        if before > 0:  # at 0 a closed curve ends where it began
            for dropped in kept[before:]:
                if dropped[0] != piece[1]:
                    number_at.pop(dropped[0], None)
            del kept[before:]
    return kept


def _together(pieces: Iterable[Piece]) -> list[Piece]:
    """Let nodes that are near each other between the same vertices be one, and keep each piece once."""
    pieces = list(pieces)
    same: dict[Node, Node] = {}
    for nodes in _on_pairs(pieces).values():
        first = nodes[0]
        for node in nodes:
            if node.weights[1] - first.weights[1] > NEAR:
                first = node
            same[node] = first
    inside: dict[tuple[tuple[int, ...], int], list[Node]] = defaultdict(list)
    for node in dict.fromkeys(node for one, two, _ in pieces for node in (one, two)):
        if len(node.vertices) == 3:
            beside = inside[node.vertices, node.polygon]
            first = next((other for other in beside if node.near(other)), None)
            if first is None:
                beside.append(node)
            same[node] = first or node
    kept: dict[frozenset[Node], Piece] = {}
    for one, two, polygon in pieces:
        begin, end = same.get(one, one), same.get(two, two)
        if begin != end:
            kept.setdefault(frozenset((begin, end)), (begin, end, polygon))
    return list(kept.values())


def _without_slivers(faces: Faces, pieces: list[Piece], ends: _Ends) -> list[Piece]:
    """Leave out the longer one of two cuts between the same nodes that enclose next to nothing; not where both nodes are ends."""
    beside: dict[Node, set[int]] = defaultdict(set)
    for number, (one, two, _) in enumerate(pieces):
        beside[one].add(number)
        beside[two].add(number)
    left_out: set[int] = set()
    waiting = [node for node, own in beside.items() if len(own) > 2]
    while waiting:
        start = waiting.pop()
        routes: dict[Node, list[_Route]] = defaultdict(list)
        for first in sorted(beside[start]):
            route = _Route(faces, pieces, beside, ends, start, first)
            end = route.nodes[-1]
            if end != start and not (start in ends and end in ends):
                routes[end].append(route)
        pairs = (pair for own in routes.values() for pair in itertools.combinations(own, 2))
        for one, other in pairs:
            if one.is_close_to(other):
                longer = max(one, other, key=lambda route: route.length)
                for number, ends_of in zip(longer.pieces, itertools.pairwise(longer.nodes), strict=True):
                    for node in ends_of:
                        beside[node].discard(number)
                left_out.update(longer.pieces)
                waiting += [start, longer.nodes[-1]]
                break
    return [piece for number, piece in enumerate(pieces) if number not in left_out]


class _Route:
    """Pieces from a node on to where they branch or end.

    Attributes
    ----------
    nodes
        The nodes that they pass, including both ends.
    pieces
        Their numbers.
    length
    """

    def __init__(
        self,
        faces: Faces,
        pieces: Sequence[Piece],
        beside: Mapping[Node, set[int]],
        ends: _Ends,
        start: Node,
        first: int,
    ) -> None:
        self.nodes, self.pieces = [start], [first]
        while True:
            one, two, _ = pieces[self.pieces[-1]]
            here = two if one == self.nodes[-1] else one
            self.nodes.append(here)
            following = beside[here] - {self.pieces[-1]}
            if len(following) != 1 or here == start or here in ends:
                break
            self.pieces += following
        self._faces = faces
        self._polygons = [pieces[number][2] for number in self.pieces]
        self._places = np.array([node.place(faces.points) for node in self.nodes])
        self.length = float(np.linalg.norm(np.diff(self._places, axis=0), axis=1).sum())

    def is_close_to(self, other: _Route) -> bool:
        """Whether another one between the same nodes is so close that both enclose next to nothing."""
        if {*self.pieces} & {*other.pieces}:
            return False
        widest = WIDE * self._mean_height(other)
        return all(
            nearest_on_segments(place, there._places[:-1], there._places[1:])[1].min() <= widest
            for here, there in ((self, other), (other, self))
            for place in here._places
        )

    def _mean_height(self, other: _Route) -> float:
        """Return the mean height, over its longest side, of the triangles that two routes pass."""
        rows = [row for polygon in {*self._polygons, *other._polygons} for row in self._faces.rows_of(polygon)]
        corners = self._faces.points[self._faces.triangles[rows]]
        sides = np.roll(corners, -1, axis=1) - corners
        areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        longest = np.linalg.norm(sides, axis=2).max(axis=1)
        return float(np.mean(np.divide(areas, longest, out=np.zeros_like(areas), where=longest > 0.0)))


def _without_spurs(pieces: list[Piece], ends: _Ends) -> list[Piece]:
    """Leave out pieces that lead nowhere, to none of the ends: what moving nodes leaves behind, and ends inside polygons."""

    def may_go(node: Node) -> bool:
        return len(node.vertices) > 1 and node not in ends

    beside: dict[Node, set[int]] = defaultdict(set)
    for number, (one, two, _) in enumerate(pieces):
        beside[one].add(number)
        beside[two].add(number)
    waiting = [node for node, own in beside.items() if len(own) == 1 and may_go(node)]
    left_out: set[int] = set()
    while waiting:
        for number in beside.pop(waiting.pop()):
            left_out.add(number)
            for node in pieces[number][:2]:
                if node in beside:
                    beside[node].discard(number)
                    if len(beside[node]) == 1 and may_go(node):
                        waiting.append(node)
    return [piece for number, piece in enumerate(pieces) if number not in left_out]


def _on_pairs(pieces: Iterable[Piece]) -> dict[tuple[tuple[int, ...], int], list[Node]]:
    """Return the nodes between each two vertices, in order from the smaller one; those of diagonals by their polygon."""
    found: dict[tuple[tuple[int, ...], int], set[Node]] = defaultdict(set)
    for one, two, _ in pieces:
        for node in (one, two):
            if len(node.vertices) == 2:
                found[node.vertices, node.polygon].add(node)
    return {pair: sorted(nodes, key=lambda node: node.weights[1]) for pair, nodes in found.items()}


def _crossed(faces: Faces, pieces: list[Piece]) -> Iterator[Piece]:
    """Yield the pieces, cut where they cross others in the same polygon."""
    by_polygon: dict[int, list[Piece]] = defaultdict(list)
    for piece in pieces:
        by_polygon[piece[2]].append(piece)
    for polygon, own in by_polygon.items():
        if len(own) == 1:
            yield own[0]
            continue
        shape = _Shape(faces, polygon)
        stops: list[list[tuple[float, Node]]] = [[(0.0, one), (1.0, two)] for one, two, _ in own]
        lines = [(shape.seen(one), shape.seen(two)) for one, two, _ in own]
        for i, j in itertools.combinations(range(len(own)), 2):
            at = None if {*own[i][:2]} & {*own[j][:2]} else _crossing(*lines[i], *lines[j])
            if at is None:
                continue
            # An end that lies near the other piece is where both meet.
            parts = zip((*own[i][:2], *own[j][:2]), (at[0], 1.0 - at[0], at[1], 1.0 - at[1]), strict=True)
            ends = [node for node, part in parts if part < NEAR]
            node = ends[0] if ends else shape.node_at(lines[i][0] + at[0] * (lines[i][1] - lines[i][0]))
            stops[i].append((at[0], node))
            stops[j].append((at[1], node))
        for places in stops:
            nodes = [node for _, node in sorted(places, key=lambda place: place[0])]
            yield from ((one, two, polygon) for one, two in itertools.pairwise(nodes) if one != two)


def _crossing(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64], d: NDArray[np.float64]
) -> tuple[float, float] | None:
    """Return which parts of a-b and c-d, in the plane, lie before where they cross; None where they do not."""
    u, v, w = b - a, d - c, c - a
    area = u[0] * v[1] - u[1] * v[0]
    if area == 0.0:
        return None
    s, t = (w[0] * v[1] - w[1] * v[0]) / area, (w[0] * u[1] - w[1] * u[0]) / area
    return (float(s), float(t)) if 0.0 <= s <= 1.0 and 0.0 <= t <= 1.0 else None


def _parted(faces: Faces, pieces: list[Piece]) -> list[Piece]:
    """Return the pieces, each once, those along an edge or a diagonal parted at the nodes of others that they pass."""
    on_pairs = _on_pairs(pieces)
    kept: dict[frozenset[Node], Piece] = {}
    for one, two, polygon in pieces:
        passed = [one, two]
        pair = tuple(sorted({*one.vertices, *two.vertices}))
        if len(pair) == 2:
            passing = on_pairs.get((pair, -1 if _is_side(faces, polygon, pair) else polygon), ())
            part = {node: node.weight(pair[1]) for node in (one, two, *passing)}
            low, high = sorted((part[one], part[two]))
            passed = sorted((node for node in part if low <= part[node] <= high), key=part.__getitem__)
        for begin, end in itertools.pairwise(passed):
            kept.setdefault(frozenset((begin, end)), (begin, end, polygon))
    return list(kept.values())


def _sorted_out(faces: Faces, pieces: list[Piece]) -> CutPlan:
    """Tell cuts along edges from those across polygons."""
    result = CutPlan()
    across: dict[int, list[Segment]] = defaultdict(list)
    for one, two, polygon in pieces:
        if _is_side(faces, polygon, (*one.vertices, *two.vertices)):
            result.along.append((one, two))
        else:
            across[polygon].append((one, two))
    for polygon, segments in across.items():
        shape = _Shape(faces, polygon)
        result.across[polygon] = _straightened(shape, segments)
        if shape.is_folded:
            result.folded.add(polygon)
    used = set(result.nodes())
    for (pair, polygon), nodes in _on_pairs(pieces).items():
        if polygon < 0 and not used.isdisjoint(nodes):
            result.splits[pair] = [node for node in nodes if node in used]
    return result


def _straightened(shape: _Shape, segments: list[Segment]) -> list[Segment]:
    """Lead cuts straight over a polygon, without vertices inside, where they hardly bend and nothing is in the way."""
    beside: dict[Node, list[Node]] = defaultdict(list)
    for one, two in segments:
        beside[one].append(two)
        beside[two].append(one)
    inner = {node for node, ends in beside.items() if len(ends) == 2 and not shape.on_rim(node)}
    kept = {frozenset(segment) for segment in segments if inner.isdisjoint(segment)}
    chains = {chain for node in beside if node not in inner for chain in _chains(node, beside, inner)}
    waiting = [chain for chain in sorted(chains, key=len) if chain[0] != chain[-1]]
    bent = {frozenset(segment) for chain in waiting for segment in itertools.pairwise(chain)}
    while waiting:
        chain = waiting.pop()
        bent -= {frozenset(segment) for segment in itertools.pairwise(chain)}
        line = frozenset((chain[0], chain[-1]))
        if len(chain) == 2:
            kept.add(line)
            continue
        farthest = shape.farthest(chain)
        if farthest < 0 and (line in kept or shape.lets_through(chain[0], chain[-1], [tuple(s) for s in kept | bent])):
            kept.add(line)
            continue
        middle = len(chain) // 2 if farthest < 0 else farthest
        waiting += [chain[: middle + 1], chain[middle:]]
        bent |= {frozenset(segment) for segment in itertools.pairwise(chain)}
    return [(one, two) for one, two in kept]


def _chains(start: Node, beside: dict[Node, list[Node]], inner: set[Node]) -> Iterator[tuple[Node, ...]]:
    """Yield the chains over inner nodes that begin at a node, each the same way round from both its ends."""
    for following in beside[start]:
        if following not in inner:
            continue
        chain = [start, following]
        while chain[-1] in inner:
            one, two = beside[chain[-1]]
            chain.append(two if one == chain[-2] else one)
        yield min(tuple(chain), tuple(reversed(chain)), key=lambda nodes: [(n.vertices, n.weights) for n in nodes])


def regular_corners(count: int) -> NDArray[np.float64]:
    """Return the corners of a regular polygon, (count, 2)."""
    angles = 2.0 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _has_spike(rim: NDArray[np.float64]) -> bool:
    """Whether a polygon with these corners, (n, 3), has a side without length, or two sides that lie on each other."""
    back, on = np.roll(rim, 1, axis=0) - rim, np.roll(rim, -1, axis=0) - rim
    lengths = np.linalg.norm(on, axis=1)
    if lengths.min() <= FLAT * lengths.max():
        return True
    products = np.linalg.norm(back, axis=1) * lengths
    straight = np.linalg.norm(np.cross(back, on), axis=1) <= FLAT * products
    return bool((straight & (np.einsum("ij,ij->i", back, on) > 0.0)).any())


def _is_folded(corners: NDArray[np.float64], axis: int, sign: float) -> bool:
    """Whether triangles, (k, 3, 3), that have an area are seen from behind or from the side along an axis."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = sign * normals[:, axis]
    return bool((seen < SIDE * np.linalg.norm(normals, axis=1)).any()) or not seen.any()


class _Shape:
    """A polygon, seen along its normal.

    A polygon that is folded or has no area is seen as a regular one, where its triangles lie beside each other as well.

    Attributes
    ----------
    is_folded
        Whether the polygon is replaced by a regular one.
    """

    def __init__(self, faces: Faces, polygon: int) -> None:
        self._faces, self._polygon = faces, polygon
        corners = faces.corners(polygon)
        rim = faces.points[list(corners)]
        self._sides = [{a, b} for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
        self._triangles = faces.triangles[list(faces.rows_of(polygon))]
        normal = np.cross(rim, np.roll(rim, -1, axis=0)).sum(axis=0)
        axis = int(np.argmax(np.abs(normal)))
        sign = float(np.sign(normal[axis]))
        self.is_folded = _has_spike(rim) or _is_folded(faces.points[self._triangles], axis, sign)
        self._points = regular_corners(len(rim)) if self.is_folded else np.delete(rim, axis, axis=1)
        self._place_of = dict(zip(corners, self._points, strict=True))

    def on_rim(self, node: Node) -> bool:
        """Whether a node is a corner or on a side."""
        return any({*node.vertices} <= side for side in self._sides)

    def farthest(self, chain: Sequence[Node]) -> int:
        """Return the number of the node that is farthest from the line between the ends; -1: the chain hardly bends."""
        places = np.array([self.seen(node) for node in chain])
        along = places[-1] - places[0]
        length = float(np.hypot(*along))
        off = np.abs(along[0] * (places[:, 1] - places[0, 1]) - along[1] * (places[:, 0] - places[0, 0]))
        worst = int(np.argmax(off[1:-1])) + 1
        return -1 if off[worst] < BEND * length * length else worst

    def seen(self, node: Node) -> NDArray[np.float64]:
        """Return where a node is, (2,)."""
        return sum(weight * self._place_of[vertex] for vertex, weight in zip(node.vertices, node.weights, strict=True))

    def node_at(self, place: NDArray[np.float64]) -> Node:
        """Return the node at a place inside, (2,)."""
        corners = np.array([[self._place_of[vertex] for vertex in triangle] for triangle in self._triangles.tolist()])
        weights, off = barycentric(corners, place)
        best = int(np.argmin(off))
        return _in_polygon(self._faces, self._polygon, Node.between(self._triangles[best], weights[best], NEAR), NEAR)

    def lets_through(self, one: Node, two: Node, segments: Sequence[Segment]) -> bool:
        """Whether the straight line between two nodes lies inside, and meets none of some segments."""
        if any({*one.vertices, *two.vertices} <= side for side in self._sides):
            return False
        a, b = self.seen(one), self.seen(two)
        for side, c, d in zip(self._sides, self._points, np.roll(self._points, -1, axis=0), strict=True):
            if not ({*one.vertices} <= side or {*two.vertices} <= side) and _crossing(a, b, c, d) is not None:
                return False
        if any({*ends}.isdisjoint((one, two)) and _crossing(a, b, *map(self.seen, ends)) for ends in segments):
            return False
        return self._holds(0.5 * (a + b))

    def _holds(self, place: NDArray[np.float64]) -> bool:
        inside = False
        for (ax, ay), (bx, by) in zip(self._points, np.roll(self._points, -1, axis=0), strict=True):
            if (ay > place[1]) != (by > place[1]) and place[0] < ax + (place[1] - ay) * (bx - ax) / (by - ay):
                inside = not inside
        return inside
