# SPDX-License-Identifier: GPL-3.0-or-later
"""Where curves over a mesh cut its edges and faces, as a plan that somebody else carries out. Knows neither Blender nor the library.

A curve is a list of points on the mesh. A walk along it, from triangle to triangle, finds the edges and faces that it passes. Then
all curves are joined: they meet in shared points where they cross or run close to each other.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments
from .cut_nodes import BEND, FLAT, NEAR, SIDE, WIDE, CutError, Faces, Node, Piece, Segment, Spot
from .cut_walk import in_polygon, is_side, walk

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge


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
            own = _without_detours(walk(faces, start, points, *end))
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
            passing = on_pairs.get((pair, -1 if is_side(faces, polygon, pair) else polygon), ())
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
        if is_side(faces, polygon, (*one.vertices, *two.vertices)):
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
        return in_polygon(self._faces, self._polygon, Node.between(self._triangles[best], weights[best], NEAR), NEAR)

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
