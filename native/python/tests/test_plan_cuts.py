# SPDX-License-Identifier: GPL-3.0-or-later
"""Plans of cuts, on flat meshes of quads and larger polygons, where what curves cross is known."""

from __future__ import annotations

import itertools
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray

NEAR = 0.05
"""A cut that passes a vertex or an edge at less than this goes through it."""
Curve = tuple[int, NDArray[np.float64]] | tuple[int, NDArray[np.float64], int]
"""Where it begins, its points, and perhaps where it ends."""


class Polygons:
    """Polygons in the plane or in space, as triangles that fan out from their first corners."""

    def __init__(self, points: NDArray[np.float64], polygons: list[list[int]]) -> None:
        self.points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
        self.corners = polygons
        cut = [(a, b, c, p) for p, (a, *rest) in enumerate(polygons) for b, c in itertools.pairwise(rest)]
        self.triangles, self.owners = np.array(cut)[:, :3], np.array(cut)[:, 3]

    def straight(self, start: int, end: int) -> tuple[int, NDArray[np.float64]]:
        """Return the straight curve between two vertices, with a point wherever it passes a side of a triangle."""
        a, b = self.points[start, :2], self.points[end, :2]
        parts = {0.0, 1.0}
        for triangle in self.triangles:
            for c, d in itertools.pairwise([*triangle, triangle[0]]):
                u, v, w = b - a, self.points[d, :2] - self.points[c, :2], self.points[c, :2] - a
                area = u[0] * v[1] - u[1] * v[0]
                if abs(area) < 1e-12:
                    continue
                s, t = (w[0] * v[1] - w[1] * v[0]) / area, (w[0] * u[1] - w[1] * u[0]) / area
                if 0.0 <= s <= 1.0 and -1e-12 <= t <= 1.0 + 1e-12:
                    parts.add(round(float(s), 12))
        places = np.array(sorted(parts))[:, None]
        return start, self.points[start] * (1.0 - places) + self.points[end] * places

    def triangles_below(self, points: NDArray[np.float64]) -> list[int]:
        """Return the triangle in the plane that the middle of each piece of a curve lies in."""
        corners = self.points[self.triangles, :2]
        found = []
        for x, y in 0.5 * (points[1:, :2] + points[:-1, :2]):
            (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
            wx, wy = x - corners[:, 0, 0], y - corners[:, 0, 1]
            area = ux * vy - uy * vx
            s, t = (wx * vy - wy * vx) / area, (ux * wy - uy * wx) / area
            found.append(int(np.argmax(np.minimum.reduce([s, t, 1.0 - s - t]))))
        return found


@dataclass(frozen=True)
class Node:
    """A place that cuts pass: its vertices with their weights, and the polygon that it lies inside."""

    vertices: tuple[int, ...]
    weights: tuple[float, ...] = (1.0,)
    polygon: int = -1

    def place(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(self.weights) @ points[list(self.vertices)]


class Plan:
    """A plan, with nodes in place of their numbers."""

    def __init__(self, found: sw.CutPlan) -> None:
        self._found = found
        rows = zip(found.vertices.tolist(), found.weights.tolist(), found.polygons.tolist(), strict=True)
        self._nodes = [
            Node(tuple(v for v in vertices if v >= 0), tuple(w for w in weights if w > 0.0), polygon)
            for vertices, weights, polygon in rows
        ]
        self.splits = {edge: [self._nodes[node] for node in nodes] for edge, nodes in found.splits}
        self.along = self._segments(found.along)
        self.across = {polygon: self._segments(cuts) for polygon, cuts, _ in found.across}
        self.left_out = [curve for curve, _ in found.left_out]

    def _segments(self, pairs: NDArray[np.int32]) -> list[tuple[Node, Node]]:
        return [(self._nodes[one], self._nodes[two]) for one, two in pairs.tolist()]

    def segments(self) -> list[tuple[Node, Node]]:
        return [*self.along, *itertools.chain(*self.across.values())]

    def nodes(self) -> list[Node]:
        named = set(itertools.chain(*self.segments()))
        assert named == set(self._nodes), "a plan has no other nodes"
        return self._nodes

    def inside(self) -> list[Node]:
        return [node for node in self._nodes if node.polygon >= 0]

    def node_at(self, vertices: Sequence[int], weights: Sequence[float]) -> Node | None:
        found = self._found.node_at(vertices, weights)
        return None if found is None else self._nodes[found]


def plan(
    faces: Polygons,
    curves: Iterable[Curve],
    images: Mapping[int, int] | None = None,
    triangles: Mapping[int, Sequence[int]] | None = None,
) -> Plan:
    """Plan cuts; with the originals of curves that are images, and the triangles of curves, by the numbers of the curves."""
    own = [
        sw.CutCurve(points, start, *end, faces=(triangles or {}).get(number), image_of=(images or {}).get(number))
        for number, (start, points, *end) in enumerate(curves)
    ]
    return Plan(sw.plan_cuts(faces.points, faces.triangles, faces.owners, own))


def grid(size: int, dice: np.random.Generator | None = None) -> Polygons:
    """Return a grid of size x size quads, vertex y * (size + 1) + x at (x, y); with dice its inner vertices are moved and some
    of its quads are triangles."""
    count = size + 1
    points = np.array([(x, y) for y in range(count) for x in range(count)], dtype=float)
    polygons = []
    for y, x in itertools.product(range(size), repeat=2):
        a = y * count + x
        quad = [a, a + 1, a + count + 1, a + count]
        polygons += [quad] if dice is None or dice.random() < 0.7 else [quad[:3], [quad[0], *quad[2:]]]
    if dice is not None:
        inner = (points > 0.0).all(axis=1) & (points < size).all(axis=1)
        points[inner] += dice.uniform(-0.2, 0.2, (int(inner.sum()), 2))
    return Polygons(points, polygons)


def reached(cuts: Plan, start: int) -> set[Node]:
    beside = defaultdict(set)
    for one, two in cuts.segments():
        beside[one].add(two)
        beside[two].add(one)
    found, waiting = {Node((start,))}, [Node((start,))]
    while waiting:
        new = beside[waiting.pop()] - found
        found |= new
        waiting += new
    return found


def crossings(faces: Polygons, own: list[tuple[Node, Node]]) -> int:
    """Count pairs of cuts that cross where they have no node."""

    def side(p: NDArray[np.float64], q: NDArray[np.float64], r: NDArray[np.float64]) -> float:
        return float((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    count = 0
    for one, two in itertools.combinations(own, 2):
        if {*one} & {*two}:
            continue
        (a, b), (c, d) = (tuple(node.place(faces.points) for node in segment) for segment in (one, two))
        count += side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0
    return count


def test_a_row_of_quads_is_cut_across_without_vertices_inside() -> None:
    faces = grid(4)
    cuts = plan(faces, [faces.straight(0, 14)])  # from (0, 0) to (4, 2)
    assert cuts.splits == {(1, 6): [Node((1, 6), (0.5, 0.5))], (8, 13): [Node((8, 13), (0.5, 0.5))]}
    assert {polygon: len(own) for polygon, own in cuts.across.items()} == {0: 1, 1: 1, 6: 1, 7: 1}
    assert cuts.inside() == [] and cuts.along == []


def test_far_from_the_origin_the_same_is_cut() -> None:
    faces = grid(6)
    curve = np.column_stack(
        [np.linspace(0.3, 5.7, 9), np.linspace(0.25, 5.6, 9) + 0.3 * np.sin(np.arange(9)), np.zeros(9)]
    )
    polygons = []
    for offset in (0.0, 1e6, 3e8):
        away = np.array([offset, 0.7 * offset, 0.3 * offset])
        found = sw.plan_cuts(
            faces.points + away, faces.triangles, faces.owners, [sw.CutCurve(curve + away, (1, (0.1, 0.45, 0.45)))]
        )
        polygons.append([polygon for polygon, *_ in found.across])
        assert not any(is_folded for _, _, is_folded in found.across), f"{offset:g} away"
    assert len(polygons[0]) > 3
    assert polygons[1:] == [polygons[0]] * 2


def test_along_edges_nothing_is_split() -> None:
    faces = grid(4)
    cuts = plan(faces, [faces.straight(5, 9)])
    assert cuts.splits == {} and cuts.across == {}
    assert [(one.vertices, two.vertices) for one, two in cuts.along] == [
        ((5,), (6,)),
        ((6,), (7,)),
        ((7,), (8,)),
        ((8,), (9,)),
    ]


def test_a_diagonal_of_a_quad_is_cut_from_corner_to_corner() -> None:
    faces = grid(2)
    for start, end in ((0, 8), (2, 6)):
        cuts = plan(faces, [faces.straight(start, end)])
        assert cuts.splits == {} and cuts.inside() == []
        assert sum(len(own) for own in cuts.across.values()) == 2


def test_what_passes_near_a_vertex_goes_through_it() -> None:
    faces = grid(3)
    faces.points[10] += (0.4 * NEAR, 0.0, 0.0)  # the straight line from 5 to 15 passes 10 on its left
    cuts = plan(faces, [faces.straight(5, 15)])
    assert cuts.splits == {}
    assert Node((10,)) in reached(cuts, 5)


def test_curves_that_cross_meet_in_a_vertex() -> None:
    faces = grid(3)
    cuts = plan(faces, [faces.straight(0, 11), faces.straight(1, 8)])
    (node,) = cuts.inside()
    assert node.place(faces.points) == pytest.approx([0.75, 0.5, 0.0])
    assert {Node((0,)), Node((11,)), Node((1,)), Node((8,))} <= reached(cuts, 0)
    on_an_edge = plan(faces, [faces.straight(0, 11), faces.straight(3, 8)])
    assert on_an_edge.inside() == []
    assert Node((5, 6), (0.5, 0.5)) in reached(on_an_edge, 3) & reached(on_an_edge, 0)


def test_curves_that_share_a_stretch_share_its_cuts() -> None:
    faces = grid(4)
    once = plan(faces, [faces.straight(0, 14)])
    twice = plan(faces, [faces.straight(0, 14), faces.straight(14, 0)])
    assert twice.splits == once.splits
    assert len(twice.segments()) == len(once.segments())


@pytest.mark.parametrize("number", range(40))
def test_random_lines_join_their_ends_and_cross_in_nodes_only(number: int) -> None:
    dice = np.random.default_rng(number)
    faces = grid(6, dice)
    ends = [tuple(dice.choice(len(faces.points), 2, replace=False).tolist()) for _ in range(4)]
    cuts = plan(faces, [faces.straight(*pair) for pair in ends])
    for start, end in ends:
        assert Node((end,)) in reached(cuts, start)
    for pair, nodes in cuts.splits.items():
        parts = [0.0, *(node.weights[1] for node in nodes), 1.0]
        assert min(np.diff(parts)) > 0.9 * NEAR, pair
        assert any({*pair} == {*side} for rim in faces.corners for side in itertools.pairwise([*rim, rim[0]]))
    for polygon, own in cuts.across.items():
        corners = {*faces.corners[polygon]}
        assert all({*node.vertices} <= corners for segment in own for node in segment)
        assert crossings(faces, own) == 0
        assert len({frozenset(segment) for segment in own}) == len(own)
    beside = defaultdict(int)
    for node in (node for segment in cuts.segments() for node in segment):
        beside[node] += 1
    assert all(count > 1 or len(node.vertices) == 1 for node, count in beside.items()), "cuts end at seeds only"
    # No cut leaves its line by more than what it is moved for slivers and bends.
    for node in {node for segment in cuts.segments() for node in segment}:
        place = node.place(faces.points)
        gaps = []
        for start, end in ends:
            a, b = faces.points[start], faces.points[end]
            part = np.clip((place - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
            gaps.append(np.linalg.norm(a + part * (b - a) - place))
        assert min(gaps) < 0.15


@pytest.mark.parametrize("number", range(20))
def test_curves_that_name_their_triangles_are_cut_as_others_are(number: int) -> None:
    dice = np.random.default_rng(number)
    faces = grid(6, dice)
    curves = [faces.straight(*dice.choice(len(faces.points), 2, replace=False).tolist()) for _ in range(4)]
    named = {number: faces.triangles_below(points) for number, (_, points) in enumerate(curves)}
    found, cuts = plan(faces, curves), plan(faces, curves, triangles=named)
    assert rounded(cuts) == rounded(found)
    wrong = {number: own[::-1] for number, own in named.items()}
    assert rounded(plan(faces, curves, triangles=wrong)) == rounded(found)


def rounded(cuts: Plan) -> set[frozenset[tuple[object, ...]]]:
    """Return the cuts of a plan, to be compared with another's."""
    return {
        frozenset((node.vertices, tuple(np.round(node.weights, 9)), node.polygon) for node in segment)
        for segment in cuts.segments()
    }


def in_row(*heights: float) -> tuple[int, NDArray[np.float64]]:
    """Return the curve over the columns of `grid(6)` at these heights in its row from 2 to 3, between corners."""
    places = [(0.0, heights[0])]
    for x, (y, following) in enumerate(itertools.pairwise(heights)):
        part = (y - 2.0) / (1.0 + y - following)  # where it passes the quad's diagonal
        if 0.0 < part < 1.0:
            places.append((x + part, 2.0 + part))
        places.append((x + 1.0, following))
    return int(7 * heights[0]), np.array([(x, y, 0.0) for x, y in places])


def enclosed(cuts: Plan) -> int:
    """Return how many islands cuts that hang together enclose."""
    return len(cuts.segments()) - len(cuts.nodes()) + 1


@pytest.mark.parametrize(("gap", "islands"), [(0.08, 1), (0.1, 1), (0.3, 2)])
def test_cuts_that_touch_again_and_again_leave_no_slivers_between(gap: float, islands: int) -> None:
    faces = grid(6)
    one = in_row(2.0, 2.5, 2.5, 2.5, 2.5, 2.5, 3.0)
    other = in_row(3.0, 2.5, 2.5 + gap, 2.5, 2.5, 2.5, 2.0)
    assert enclosed(plan(faces, [one])) == 0
    # Where both run side by side there is one cut, where they end there are two.
    cuts = plan(faces, [one, other])
    assert enclosed(cuts) == islands - 1
    assert {Node((21,)), Node((27,)), Node((20,))} <= reached(cuts, 14)


def test_around_a_vertex_no_sliver_is_left() -> None:
    faces = grid(6)
    over, under = in_row(3.0, 2.5, 2.94, 2.5, 2.5, 2.5, 2.0), in_row(2.0, 2.5, 2.96, 2.5, 2.5, 2.5, 3.0)
    assert any(node.vertices == (23,) for node in plan(faces, [under]).nodes()), "near the vertex it goes through it"
    assert enclosed(plan(faces, [over, under])) == 0


def test_two_cuts_between_the_same_seeds_stay_two() -> None:
    faces = grid(6)
    heights = (2.0, 2.5, 2.5, 2.5, 2.5, 2.5, 3.0)
    beside = tuple(y + 0.1 * (y == 2.5) for y in heights)
    more = faces.straight(14, 0)
    assert enclosed(plan(faces, [in_row(*heights), in_row(*beside), more])) == 1
    assert enclosed(plan(faces, [in_row(*heights), in_row(*heights), more])) == 0


def inside(faces: Polygons, *places: tuple[float, float]) -> tuple[int, NDArray[np.float64]]:
    """Return the curve through places, the first of them in the triangle of quad 0 that has the corner 1."""
    return 1, np.array([(x, y, 0.0) for x, y in places])


def test_curves_may_meet_inside_a_face() -> None:
    faces = grid(3)
    meeting = (0.6, 0.3)
    one = inside(faces, meeting, (1.0, 0.2), (2.0, 0.0))  # to vertex 2
    two = inside(faces, meeting, (0.55, 0.55), (0.6, 1.0), (1.0, 2.0))  # over the diagonal, to vertex 9
    cuts = plan(faces, [one, two])
    node = cuts.node_at((0, 1, 5), tuple(np.array([0.4, 0.3, 0.3])))
    assert node is not None and node.place(faces.points)[:2] == pytest.approx(meeting)
    assert {Node((2,)), Node((9,))} <= reached(cuts, 2), "one chain, over where both begin"
    assert cuts.inside() == [node]
    assert cuts.node_at((0, 1, 5), (0.8, 0.1, 0.1)) is None


def test_an_end_inside_a_face_goes_back_to_the_last_edge() -> None:
    faces = grid(3)
    cuts = plan(faces, [inside(faces, (0.6, 0.3), (1.0, 0.2), (2.0, 0.0))])
    assert cuts.inside() == []
    places = [node.place(faces.points)[:2].tolist() for node in reached(cuts, 2)]
    assert sorted(places) == [pytest.approx([1.0, 0.2]), [2.0, 0.0]]
    assert plan(faces, [inside(faces, (0.6, 0.3), (0.7, 0.2))]).segments() == []


def test_a_curve_that_goes_back_along_a_diagonal_leaves_no_spur() -> None:
    faces = grid(3)
    turn = np.array([(np.cos(1.0), np.sin(1.0), 0), (-np.sin(1.0), np.cos(1.0), 0), (0, 0, 1)])
    faces.points = faces.points @ turn  # by rounding the curves do not meet exactly
    there = np.array([(0, 0, 0), (0.8, 0.8, 0)]) @ turn
    on = np.array([(0.8, 0.8, 0), (0.6, 0.6, 0), (1.0, 0.2, 0), (2.0, 0.0, 0)]) @ turn
    cuts = plan(faces, [(0, there), (1, on)])
    assert Node((2,)) in reached(cuts, 0)
    counts = Counter(node for segment in cuts.segments() for node in segment)
    assert [node for node, count in counts.items() if count == 1] == [Node((0,)), Node((2,))]


FLAT = {
    "needle": ([(0, 0), (1, -1), (1, -1), (1, 1), (2, 0.2)], [[0, 1, 3], [1, 2, 3], [2, 4, 3]]),
    "cap": ([(0, 0), (1, -1), (1, 0.3), (1, 1), (2, 0.2)], [[0, 1, 3], [1, 2, 3], [1, 4, 2], [2, 4, 3]]),
    "caps in a row": (
        [(0, 0), (1, -1), (1, 0.3), (1, 0.4), (1, 1), (2, 0.2)],
        [[0, 1, 4], [1, 2, 4], [2, 3, 4], [1, 5, 2], [2, 5, 3], [3, 5, 4]],
    ),
    "all in one point": (
        [(0, 0), (1, 0), (1, 0), (1, 0), (2, 0), (1, 1), (1, -1)],
        [[1, 2, 3], [0, 1, 5], [0, 6, 1], [1, 6, 2], [6, 4, 2], [2, 4, 3], [3, 4, 5], [1, 3, 5]],
    ),
    "quad": (
        [(0, 0), (1, -1), (1, 0), (1, 1), (1, 0.5), (2, 0.2)],
        [[0, 1, 3], [1, 2, 4, 3], [1, 5, 2], [2, 5, 4], [4, 5, 3]],
    ),
}


@pytest.mark.parametrize("name", FLAT)
@pytest.mark.parametrize("height", [-0.5, 0.0, 0.05, 0.1, 0.3, 0.35])
def test_a_polygon_without_area_is_passed_in_one_point(name: str, height: float) -> None:
    points, polygons = FLAT[name]
    faces = Polygons(np.array(points, dtype=float), polygons)
    end = max(range(len(points)), key=lambda vertex: points[vertex][0])
    curve = np.array([(0, 0, 0), (1, height, 0), (*points[end], 0)], dtype=float)
    if name == "all in one point":
        curve[1, 1] = 0.0
    for start, way, goal in ((0, curve, end), (end, curve[::-1], 0)):
        cuts = plan(faces, [(start, way, goal)])
        assert Node((goal,)) in reached(cuts, start)
        for polygon, own in cuts.across.items():
            used = {vertex for segment in own for node in segment for vertex in node.vertices}
            assert used <= {*faces.corners[polygon]}


def test_of_vertices_in_one_place_a_curve_ends_at_its_own() -> None:
    points, polygons = FLAT["cap"]
    faces = Polygons(np.array(points, dtype=float), polygons)
    cuts = plan(faces, [(0, np.array([(0, 0, 0), (1, 0.3, 0)]), 2)])
    assert Node((2,)) in reached(cuts, 0)


def test_a_curve_of_other_triangles_is_led_straight_on() -> None:
    faces = grid(6, np.random.default_rng(2))
    start, straight = faces.straight(7, 34)
    few = straight[[0, len(straight) // 2, -1]]
    many, found = (plan(faces, [(start, curve)]) for curve in (straight, few))
    assert many.across.keys() == found.across.keys()
    places = [sorted(node.place(faces.points).tolist() for node in cuts.nodes()) for cuts in (many, found)]
    assert places[1] == [pytest.approx(place) for place in places[0]]


def test_a_curve_of_other_triangles_stays_within_a_concave_polygon() -> None:
    points = np.array([(0, 0), (2, 1), (4, 0), (4, 3), (0, 3), (0, -2), (4, -2)], dtype=float)
    faces = Polygons(points, [[1, 2, 3, 4, 0], [0, 5, 1], [5, 6, 1], [6, 2, 1]])
    cuts = plan(faces, [(0, np.array([(0, 0, 0), (1.0, 0.5, 0), (3.0, 0.5, 0), (4, 0, 0)]))])
    assert Node((2,)) in reached(cuts, 0)
    for one, two in cuts.across.get(0, ()):
        assert min(one.place(faces.points)[1], two.place(faces.points)[1]) >= 0.9


def test_a_diagonal_that_is_an_edge_of_other_polygons_is_inside() -> None:
    # A quad, and two triangles below that have an edge where its diagonal is.
    points = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0.5, 1.5, -1), (1.5, 0.5, -1)], dtype=float)
    faces = Polygons(points, [[0, 1, 2, 3], [0, 2, 4], [0, 5, 2]])
    cuts = plan(faces, [(1, np.array([(2, 0, 0), (0.5, 0.5, 0), (0, 2, 0)]))])
    assert cuts.splits == {} and cuts.along == []
    (bend,) = cuts.inside()
    assert {*itertools.chain(*cuts.across[0])} == {Node((1,)), bend, Node((3,))}


def test_what_does_not_run_over_the_mesh_is_left_out() -> None:
    faces = grid(4)
    off = (0, np.array([(0, 0, 0), (0.5, 0.5, 9.0), (4, 4, 0)]))
    good = faces.straight(0, 14)
    cuts = plan(faces, [off, good, off])
    assert cuts.left_out == [0, 2]
    assert cuts.across == plan(faces, [good]).across


def test_the_image_of_a_curve_that_is_left_out_is_not_cut() -> None:
    faces = grid(4)
    off = (0, np.array([(0, 0, 0), (0.5, 0.5, 9.0), (4, 4, 0)]))
    good, image = faces.straight(0, 14), faces.straight(20, 14)
    cuts = plan(faces, [off, good, image, off], {2: 0, 3: 1})
    assert cuts.left_out == [0, 3]
    assert cuts.across == plan(faces, [good]).across
    assert plan(faces, [off, good, image], {2: 1}).across == plan(faces, [good, image]).across


@pytest.mark.parametrize("short", [0.0, 1e-3, 0.015, 0.04])
def test_a_long_curve_may_end_a_little_before_its_vertex(short: float) -> None:
    count = 200
    points = np.array([(x, y) for y in range(2) for x in range(count)], dtype=float)
    faces = Polygons(points, [[x, x + 1, x + count + 1, x + count] for x in range(count - 1)])
    places = np.array([(x, x / (count - 1), 0.0) for x in range(count)])
    places[-1, 0] -= short
    start, end = 0, 2 * count - 1
    for curve in ((start, places, end), (end, places[::-1], start)):
        assert Node((end,)) in reached(plan(faces, [curve]), start)


def test_a_curve_may_end_before_a_vertex_that_only_a_larger_face_calls_near() -> None:
    # A long triangle on the left, and two small ones on the right that the curve runs over.
    points = np.array([(0, 0), (-10, 0), (-10, -5), (0.1, -0.05), (0.1, 0.05), (0.2, 0.0)])
    faces = Polygons(points, [[0, 1, 2], [0, 3, 4], [3, 5, 4]])
    curve = np.array([(0.2, 0.0, 0.0), (0.1, 0.0, 0.0), (5e-4, 0.0, 0.0)])
    assert Node((0,)) in reached(plan(faces, [(5, curve, 0)]), 5)


def test_of_faces_on_each_other_a_curve_cuts_those_that_it_runs_over() -> None:
    # Two rows of quads on each other that have the first vertex in common; the second one is longer.
    points = np.array([(x, y) for y in (0, 1) for x in range(4)], dtype=float)
    one = [[x, x + 1, x + 5, x + 4] for x in range(3)]
    more = [*points[1:].tolist(), (4.0, 0.0), (4.0, 1.0)]
    number = {tuple(place): 8 + i for i, place in enumerate(more)} | {(0.0, 0.0): 0}
    other = [[number[x, 0.0], number[x + 1, 0.0], number[x + 1, 1.0], number[x, 1.0]] for x in map(float, range(4))]
    faces = Polygons(np.concatenate([points, more]), [*one, *other])
    curve = np.array([(x, 0.25 * x, 0.0) for x in (0.0, 1.0, 4 / 3, 2.0, 8 / 3, 3.0, 4.0)])
    cuts = plan(faces, [(0, curve)])
    assert Node((number[4.0, 1.0],)) in reached(cuts, 0)
    assert set(cuts.across) <= set(range(3, 7))


def test_of_a_curve_beside_the_mesh_the_plan_names_the_vertex_where_it_leaves() -> None:
    faces = grid(2)
    for beside in ([-3.0, 0.5, 0.0], [0.5, 0.5, 9.0]):
        found = sw.plan_cuts(faces.points, faces.triangles, faces.owners, [sw.CutCurve([[0.0, 0.0, 0.0], beside], 0)])
        assert found.left_out == [(0, 0)]
        assert len(found.vertices) == 0 and found.across == []


def test_a_curve_leaves_a_polygon_over_a_side_with_corners_in_a_row() -> None:
    # A column of three unit quads beside one polygon with their four corners in a row, where diagonals lie on the sides.
    points = np.array([(0, 0), (1, 0), (1, 1), (1, 2), (1, 3), (0, 3), (2, 0), (2, 1), (2, 2), (2, 3)], dtype=float)
    # Its triangles fan out from a corner in the row: those along it have no area.
    faces = Polygons(points, [[1, 2, 3, 4, 5, 0], [1, 6, 7, 2], [2, 7, 8, 3], [3, 8, 9, 4]])
    curve = np.array([(0, 0, 0), (1, 1.5, 0), (4 / 3, 2, 0), (2, 3, 0)])
    cuts = plan(faces, [(0, curve)])
    assert set(cuts.splits) == {(2, 3), (3, 8)}
    assert set(cuts.across) == {0, 2, 3}


def test_a_curve_over_an_edge_of_three_faces_cuts_the_edge_and_both_faces() -> None:
    # Three quads share the edge from vertex 0 to 1. The curve runs from the first quad to the third.
    pages = [(np.cos(angle), np.sin(angle)) for angle in (0.0, 2.0, 4.0)]
    points = np.array([(0, 0, 0), (0, 0, 1), *((x, y, z) for x, y in pages for z in (0, 1))], dtype=float)
    faces = Polygons(points, [[0, 1, 3, 2], [0, 1, 5, 4], [0, 1, 7, 6]])
    curve = np.array([points[2], (0.0, 0.0, 0.5), points[7]])
    cuts = plan(faces, [(2, curve, 7)])
    spine = Node((0, 1), (0.5, 0.5))
    assert cuts.splits == {(0, 1): [spine]}
    assert {polygon: {*own[0]} for polygon, own in cuts.across.items()} == {
        0: {Node((2,)), spine},
        2: {spine, Node((7,))},
    }
