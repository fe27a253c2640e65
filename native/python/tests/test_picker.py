# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor, in views made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import ArrayLike

SIZE = 400.0
SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def from_above(half: float = 1.25, perspective: bool = False) -> np.ndarray:
    """Return a view down on the square of this half size around the origin: x to the right, y up."""
    if not perspective:
        return np.diag([1.0 / half, 1.0 / half, -0.1, 1.0])
    # The eye is at (0, 0, 5): at the height of the origin the view shows the same as without perspective.
    near, far, eye = 0.1, 100.0, 5.0
    depth = [[0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)], [0, 0, -1, 0]]
    return np.array([[eye / half, 0, 0, 0], [0, eye / half, 0, 0], *depth]) @ moved(0.0, 0.0, -eye)


def moved(x: float, y: float, z: float) -> np.ndarray:
    """Return the matrix of an object that was moved."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def turned(*angles: float) -> np.ndarray:
    """Return the matrix of an object that was rotated around x, then y, then z."""
    matrix = np.eye(4)
    for axis, angle in enumerate(angles):
        one, two = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(4)
        turn[[one, two], [one, two]] = np.cos(angle)
        turn[two, one], turn[one, two] = np.sin(angle), -np.sin(angle)
        matrix = turn @ matrix
    return matrix


def pixels(view: np.ndarray, places: ArrayLike) -> np.ndarray:
    """Return where (n, 3) places are seen."""
    clip = np.concatenate([places, np.ones((len(places), 1))], axis=1) @ view.T
    return (clip[:, :2] / clip[:, 3:] * 0.5 + 0.5) * SIZE


class Mesh:
    """Convex polygons and loose edges, and a picker for them. `picker` may be told more."""

    def __init__(
        self,
        places: ArrayLike,
        polygons: Sequence[Sequence[int]],
        loose: ArrayLike = (),
        to_object: ArrayLike | None = None,
    ) -> None:
        self.points, self.faces = np.asarray(places, dtype=np.float64), polygons
        rows = [(i, first, *pair) for i, (first, *rest) in enumerate(polygons) for pair in pairwise(rest)]
        table = np.array(rows, dtype=np.int32).reshape(-1, 4)
        self.polygons, self.triangles = table[:, 0], table[:, 1:]
        sides = [(min(pair), max(pair)) for polygon in polygons for pair in pairwise([*polygon, polygon[0]])]
        self.edges = np.array([*dict.fromkeys(sides), *loose], dtype=np.int32).reshape(-1, 2)
        to_object = np.eye(3) if to_object is None else to_object
        self.picker = sw.Picker(self.points, self.triangles, self.polygons, self.edges, to_object)

    def pick(
        self,
        view: np.ndarray,
        at: ArrayLike,
        matrix: ArrayLike | None = None,
        off: tuple[float, float] = (0.0, 0.0),
        scale: float = 1.0,
        xray: bool = False,
        clip_planes: ArrayLike = (),
        **options: object,
    ) -> sw.Picked | None:
        """Return what is picked where a place is seen, or so many pixels away from there."""
        cursor = pixels(view, [at])[0] + off
        matrix = np.eye(4) if matrix is None else matrix
        return self.picker.pick(view, matrix, (SIZE, SIZE), tuple(cursor), clip_planes, scale, xray, **options)


def grid(side: int = 5, sheets: Sequence[tuple[float, float, float]] = ((0.0, 0.0, 0.0),)) -> Mesh:
    """Return squares from (-1, -1, 0) to (1, 1, 0), each moved; vertex y * side + x is column x of row y of the first one."""
    steps = np.linspace(-1.0, 1.0, side)
    flat = np.stack([np.tile(steps, side), np.repeat(steps, side), np.zeros(side * side)], axis=1)
    corners = [y * side + x for y in range(side - 1) for x in range(side - 1)]
    polygons = [
        tuple(sheet * side * side + a + step for step in (0, 1, side + 1, side))
        for sheet in range(len(sheets))
        for a in corners
    ]
    return Mesh(np.concatenate([flat + sheet for sheet in sheets]), polygons)


def ball(rings: int = 8, around: int = 12) -> Mesh:
    """Return a dented ball of quads, with triangles at the poles."""
    heights = np.pi * (np.arange(1, rings) / rings - 0.5)
    turns = 2.0 * np.pi * np.arange(around) / around
    places = [(np.cos(h) * np.cos(t), np.cos(h) * np.sin(t), np.sin(h)) for h in heights for t in turns]
    places = np.array([(0.0, 0.0, -1.0), *places, (0.0, 0.0, 1.0)])
    places *= 1.0 - 0.3 * np.exp(-8.0 * ((places - (0.8, 0.3, 0.4)) ** 2).sum(axis=1, keepdims=True))
    following = [(i, (i + 1) % around) for i in range(around)]
    polygons = [
        (1 + around * r + a, 1 + around * r + b, 1 + around * (r + 1) + b, 1 + around * (r + 1) + a)
        for r in range(rings - 2)
        for a, b in following
    ]
    last = len(places) - 1
    polygons += [(0, 1 + b, 1 + a) for a, b in following]
    polygons += [(last, last - around + a, last - around + b) for a, b in following]
    return Mesh(places, polygons)


@pytest.mark.parametrize("perspective", [False, True])
def test_an_edge_is_picked_along_its_middle_and_a_vertex_at_its_end(perspective: bool) -> None:
    mesh, view = grid(), from_above(perspective=perspective)
    assert set(mesh.pick(view, (0.25, 0.03, 0.0)).pick) == {12, 13}
    assert mesh.pick(view, (0.03, 0.03, 0.0)).pick == 12
    assert set(mesh.pick(view, (0.03, 0.03, 0.0), edges_only=True).pick) == {12, 13}
    assert mesh.pick(view, (0.2, 0.03, 0.0), vertices_only=True).pick == 12
    assert mesh.pick(view, (0.3, 0.03, 0.0), vertices_only=True).pick == 13


def test_a_vertex_is_a_dozen_pixels_wide_but_never_more_than_a_quarter_of_its_edge() -> None:
    mesh, view = grid(3), from_above(half=1.0)  # edges of 200 pixels
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(11.0, 2.0)).pick == 4
    assert set(mesh.pick(view, (0.0, 0.0, 0.0), off=(14.0, 2.0)).pick) == {4, 5}
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(14.0, 2.0), scale=2.0).pick == 4, "of the display's pixels"
    small = grid(21)  # edges of 16 pixels
    middle = 10 * 21 + 10
    assert small.pick(from_above(), (0.0, 0.0, 0.0), off=(3.0, 1.0)).pick == middle
    assert set(small.pick(from_above(), (0.0, 0.0, 0.0), off=(5.0, 1.0)).pick) == {middle, middle + 1}


def test_nothing_is_picked_far_from_the_mesh_and_the_rim_just_beside_it() -> None:
    mesh, view = grid(), from_above()
    assert set(mesh.pick(view, (1.0, 0.25, 0.0), off=(8.0, 0.0)).pick) == {14, 19}
    assert mesh.pick(view, (1.0, 0.25, 0.0), off=(30.0, 0.0)) is None


def first_triangle(corners: np.ndarray, start: np.ndarray, end: np.ndarray) -> int:
    """Return which of (m, 3, 3) triangles a ray meets first, by the equations of each."""
    a, b, c = corners.transpose(1, 0, 2)
    systems = np.stack([b - a, c - a, np.broadcast_to(start - end, a.shape)], axis=2)
    u, v, far = np.linalg.solve(systems, (start - a)[:, :, None])[:, :, 0].T
    met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0)
    return int(np.argmin(np.where(met, far, np.inf)))


@pytest.mark.parametrize("perspective", [False, True])
def test_picks_follow_an_objects_rotation_and_its_uneven_scale(perspective: bool) -> None:
    mesh, view = ball(), from_above(perspective=perspective)
    matrix = moved(0.2, -0.1, 0.0) @ turned(0.4, -0.8, 1.9) @ np.diag([0.9, 0.4, 0.6, 1.0])
    world = mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
    seen = pixels(view, world)
    hits = 0
    for polygon in np.unique(mesh.polygons):
        corners = np.unique(mesh.triangles[mesh.polygons == polygon])
        middle = world[corners].mean(axis=0)
        x, y = 2.0 * pixels(view, [middle])[0] / SIZE - 1.0
        ends = np.array([(x, y, -1.0, 1.0), (x, y, 1.0, 1.0)]) @ np.linalg.inv(view).T
        start, end = ends[:, :3] / ends[:, 3:]
        if mesh.polygons[first_triangle(world[mesh.triangles], start, end)] != polygon:
            continue  # something lies before it
        hits += 1
        found = mesh.pick(view, middle, matrix, vertices_only=True).pick
        touching = np.isin(mesh.triangles, corners).any(axis=1)
        around = np.unique(mesh.triangles[np.isin(mesh.polygons, mesh.polygons[touching])])
        assert found in around
        gaps = np.linalg.norm(seen - pixels(view, [middle]), axis=1)
        rounding = 1e-9  # pixels: equally near vertices differ by less
        assert gaps[found] <= gaps[corners].min() + rounding
    assert hits > 20


def test_the_place_on_the_surface_is_given_as_the_mesh_has_it() -> None:
    stretched = grid()
    mesh = Mesh(stretched.points * (1.0, 3.0, 1.0), stretched.faces, to_object=np.diag([1.0, 1.0 / 3.0, 1.0]))
    matrix, view = moved(0.1, 0.0, -1.0) @ np.diag([1.0, 3.0, 1.0, 1.0]), from_above(half=4.0)
    found = mesh.pick(view, (0.3, 1.2, -1.0), matrix, surface_only=True)
    np.testing.assert_allclose(found.place, (0.2, 1.2, 0.0), atol=1e-6)
    corners = mesh.points[mesh.triangles[found.triangle]]
    weights = np.linalg.solve(np.column_stack([corners[:, :2], np.ones(3)]).T, (*found.place[:2], 1.0))
    assert weights.min() > -1e-6, "it lies in the triangle named"
    assert found.pick is None
    assert found.depth == pytest.approx(11.0), "the near plane is at the height 10"
    assert mesh.pick(view, (3.0, 0.0, -1.0), matrix, surface_only=True) is None


def test_the_front_one_of_two_layers_is_picked() -> None:
    mesh, view = grid(5, [(0.0, 0.0, 0.0), (0.0, 0.0, -1.0)]), from_above()
    assert mesh.pick(view, (0.0, 0.0, 0.0)).pick == 12
    assert mesh.pick(view, (0.1, 0.1, 0.0), surface_only=True).depth == pytest.approx(10.0)


def test_what_a_clipping_plane_cuts_off_is_looked_through() -> None:
    mesh, view = grid(5, [(0.0, 0.0, 0.0), (0.0, 0.0, -1.0)]), from_above()
    planes = [(0.0, 0.0, -1.0, -0.5)]  # what is higher than -0.5
    assert mesh.pick(view, (0.0, 0.0, 0.0), clip_planes=planes).pick == 37
    assert mesh.pick(view, (0.0, 0.0, 0.0), clip_planes=planes, xray=True).pick == 37


def with_flap(x: float, z: float) -> Mesh:
    """Return the square with another face at its right side, whose far edge is at x and z."""
    return Mesh([*SQUARE, (x, -0.8, z), (x, 0.8, z)], [(0, 1, 2, 3), (2, 1, 4, 5)])


def test_edges_of_faces_that_turn_away_are_not_picked_through_the_face_in_front() -> None:
    view = from_above()
    folded_under = with_flap(0.1, -0.3)
    for place, edge in (((0.1, 0.0, 0.0), {1, 2}), ((0.55, 0.9, 0.0), {2, 3})):
        assert set(folded_under.pick(view, place).pick) == edge
    folded_down = with_flap(1.1, -2.0)
    assert set(folded_down.pick(view, (1.09, 0.0, 0.0)).pick) == {4, 5}
    # The eye is above the middle of the square: from there the same face turns away.
    assert set(folded_down.pick(from_above(perspective=True), (1.1, 0.0, -2.0)).pick) == {1, 2}


def test_an_edge_below_a_diagonal_of_the_face_in_front_is_not_picked() -> None:
    mesh = Mesh([*SQUARE, (0, 0.3, -1)], [(0, 1, 2, 3), (0, 4, 2)])
    assert set(mesh.pick(from_above(), (0.1, 0.1, 0.0)).pick) in ({1, 2}, {2, 3})


def test_diagonals_that_cut_a_polygon_into_triangles_are_not_picked() -> None:
    turns = np.arange(8) * np.pi / 4.0
    mesh = Mesh(np.stack([np.cos(turns), np.sin(turns), np.zeros(8)], axis=1), [range(8)])
    a, b = mesh.pick(from_above(), mesh.points[[0, 3]].mean(axis=0)).pick
    assert abs(a - b) in {1, 7}


def test_an_object_flattened_to_nothing_is_not_picked() -> None:
    flat = np.diag([1.0, 0.0, 1.0, 1.0])
    assert grid().pick(from_above(), (0.0, 0.0, 0.0), flat) is None
    assert grid().pick(from_above(), (0.0, 0.0, 0.0), flat, surface_only=True) is None


def test_edges_without_faces_are_picked_too() -> None:
    mesh, view = Mesh([(0, 0, 0), (1, 0, 0)], [], loose=[(0, 1)]), from_above()
    assert mesh.pick(view, (0.0, 0.0, 0.0)).pick == 0
    assert mesh.pick(view, (0.5, 0.0, 0.0), off=(0.0, 5.0)).pick == (0, 1)
    assert mesh.pick(view, (0.5, 0.0, 0.0), off=(0.0, 40.0)) is None
    assert mesh.pick(view, (0.5, 0.0, 0.0), vertices_only=True) is None


def test_an_edge_that_is_partly_behind_the_viewer_is_not_picked() -> None:
    mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 0, 6), (1, 0, 1)], [], loose=[(2, 1), (0, 1)])
    assert mesh.pick(from_above(perspective=True), (0.5, 0.0, 0.0)).pick == (0, 1)


def test_a_point_is_picked_anywhere_or_the_vertex_that_is_meant() -> None:
    mesh, view = grid(), from_above()
    found = mesh.pick(view, (0.3, 0.15, 0.0), vertices_only=True, anywhere=True)
    assert found.pick is None
    np.testing.assert_allclose(found.place, (0.3, 0.15, 0.0), atol=1e-9)
    assert mesh.pick(view, (0.03, 0.02, 0.0), vertices_only=True, anywhere=True).pick == 12


def test_xray_finds_what_lies_behind() -> None:
    mesh, view = grid(5, [(0.0, 0.0, 0.0), (0.25, 0.25, -1.0)]), from_above()
    assert mesh.pick(view, (0.25, 0.25, 0.0), vertices_only=True).pick != 37
    assert mesh.pick(view, (0.25, 0.25, 0.0), vertices_only=True, xray=True).pick == 37
    assert set(mesh.pick(view, (0.4, 0.25, 0.0), xray=True).pick) == {37, 38}
    below = grid(5, [(0.0, 0.0, 0.0), (0.0, 0.0, -1.0)])
    found = below.pick(view, (0.0, 0.0, 0.0), vertices_only=True, xray=True)
    assert found.pick == 12, "of two vertices at the same place, the one in front"


def test_xray_finds_edges_of_large_meshes_too() -> None:
    mesh, view = grid(181), from_above(half=0.125)
    assert len(mesh.edges) > 50_000
    middle = 90 * 181 + 90
    found = mesh.pick(view, mesh.points[[middle, middle + 1]].mean(axis=0), off=(0.0, 3.0), xray=True)
    assert set(found.pick) == {middle, middle + 1}


def test_pieces_of_layers_are_found_before_the_mesh_in_the_order_of_the_layers() -> None:
    mesh, view = grid(5, [(0.0, 0.0, 0.0), (0.0, 0.0, -1.0)]), from_above()
    mesh.picker.set_layer(0, [(0.0, 0.0, 0.0)] * 2 + [(1.0, 0.0, 0.0)] * 2, [7, 3], 9.0)
    mesh.picker.set_layer(2, [(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.5, -1.0), (1.0, 0.5, -1.0)], [1, 2], 6.0)
    everything = {"layers": (0, 2)}
    point = mesh.pick(view, (0.0, 0.0, 0.0), off=(5.0, 5.0), **everything)
    assert (point.layer, point.owner, point.place.tolist()) == (0, 7, [0.0, 0.0, 0.0])
    line = mesh.pick(view, (0.0, 0.0, 0.0), off=(30.0, 4.0), **everything)
    assert (line.layer, line.owner) == (2, 1)
    np.testing.assert_allclose(line.place, (0.1875, 0.0, 0.0), atol=1e-12)
    assert line.depth == pytest.approx(10.0, abs=1e-3), "the place is four pixels beside the cursor"
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(30.0, 8.0), **everything).layer == -1
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(30.0, 8.0), layers_only=True, **everything) is None
    hidden = (0.5, 0.5, -1.0)
    assert mesh.pick(view, hidden, **everything).layer == -1, "a face hides it"
    assert mesh.pick(view, hidden, xray=True, **everything).owner == 2
    with pytest.raises(ValueError, match="layer"):
        mesh.pick(view, hidden, layers=(3,))
    with pytest.raises(ValueError, match="64"):
        mesh.picker.set_layer(64, [], [], 1.0)


def test_a_piece_in_a_crease_is_not_hidden_by_the_faces_beside_it() -> None:
    fold = Mesh([(0, -1, 0), (0, 1, 0), (1, 1, 1), (1, -1, 1), (-1, 1, 1), (-1, -1, 1)], [(0, 3, 2, 1), (1, 4, 5, 0)])
    fold.picker.set_layer(0, [(0.005, -1.0, 0.0), (0.005, 1.0, 0.0)], [0], 4.0)
    assert fold.pick(from_above(), (0.0, 0.0, 0.0), layers=(0,)).layer == 0
    fold.picker.set_layer(0, [(0.2, -1.0, 0.0), (0.2, 1.0, 0.0)], [0], 4.0)
    assert fold.pick(from_above(), (0.2, 0.0, 0.0), layers=(0,)).layer == -1


def test_the_strongest_feature_within_reach_is_taken_and_none_where_all_is_plain() -> None:
    mesh, view = grid(81), from_above()  # an edge is 4 pixels long
    strength = np.zeros(81 * 81)
    ridge = 42 * 81 + 40
    strength[[ridge, 45 * 81 + 40]] = 5.0, 50.0  # the other one is too far
    mesh.picker.set_vertices(strength, 0.0, [])
    found = mesh.pick(view, (0.0, 0.0, 0.0), features=True)
    assert (found.pick, found.is_feature) == (ridge, True)
    assert not mesh.pick(view, (0.0, 0.0, 0.0), off=(30.0, -30.0), features=True).is_feature
    mesh.picker.set_vertices(strength, 5.0, [])
    assert not mesh.pick(view, (0.0, 0.0, 0.0), features=True).is_feature
    mesh.picker.set_vertices(strength[1:], 0.0, [])
    with pytest.raises(ValueError, match="strengths"):
        mesh.pick(view, (0.0, 0.0, 0.0), features=True)


def test_the_nearest_of_preferred_vertices_within_reach_is_taken_before_features() -> None:
    mesh, view = grid(81), from_above()
    strength = np.zeros(81 * 81)
    strength[40 * 81 + 41] = 5.0
    mesh.picker.set_vertices(strength, 0.0, np.arange(40, 81 * 81, 81)[::-1])
    options = {"vertices_only": True, "preferred": True}
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(7.0, 1.0), vertices_only=True).pick == 40 * 81 + 42
    found = mesh.pick(view, (0.0, 0.0, 0.0), off=(7.0, 1.0), features=True, **options)
    assert (found.pick, found.is_feature) == (40 * 81 + 40, False)
    assert mesh.pick(view, (0.0, 0.0, 0.0), off=(11.0, 1.0), **options).pick % 81 != 40


def test_a_feature_on_the_far_side_is_not_taken() -> None:
    flat, view = grid(81), from_above()
    under_half = flat.points[:, 0] > 0.01
    places = np.where(under_half[:, None], flat.points * (-1.0, 1.0, 1.0) - (0.0, 0.0, 0.5), flat.points)
    mesh = Mesh(places, flat.faces)
    strength = np.zeros(81 * 81)
    under = 40 * 81 + 42  # folded under the other half
    strength[under] = 5.0
    mesh.picker.set_vertices(strength, 0.0, [])
    assert not mesh.pick(view, (-0.02, 0.0, 0.0), features=True).is_feature
    assert mesh.pick(view, (-0.02, 0.0, 0.0), features=True, xray=True).pick == under


def test_a_corner_is_taken_before_a_stronger_point_of_a_ridge() -> None:
    flat, view = grid(81), from_above()
    # Bent at the middle along three edges: left, down, and up to the right.
    places = flat.points.copy()
    places[:, 2] = np.minimum(0.0, -np.maximum(places[:, 0], places[:, 1]))
    mesh = Mesh(places, [half for a, b, c, d in flat.faces for half in ((a, b, c), (a, c, d))])
    corner = 40 * 81 + 40
    strength = np.zeros(81 * 81)
    strength[[corner - 1, corner - 10]] = 5.0
    mesh.picker.set_vertices(strength, 0.0, [])
    near = mesh.pick(view, places[corner], off=(-3.0, -1.0), vertices_only=True, features=True)
    assert (near.pick, near.is_feature) == (corner, True)
    assert mesh.pick(view, places[corner], off=(-40.0, -1.0), vertices_only=True, features=True).pick == corner - 10


def test_points_of_crest_lines_or_the_vertices_beside_them_are_taken_before_the_mesh() -> None:
    mesh, view = grid(), from_above()
    mesh.picker.set_layer(1, [(0.0, 0.05, 0.0), (0.5, 0.05, 0.0)], [5], 10.0, [(12, 13)])
    found = mesh.pick(view, (0.25, 0.05, 0.0), off=(0.0, 6.0), vertices_only=True, anywhere=True, crests=1)
    assert (found.pick, found.triangle, found.is_feature) == (None, 5, True)
    np.testing.assert_allclose(found.place, (0.25, 0.05, 0.0), atol=1e-9)
    assert mesh.pick(view, (0.46, 0.06, 0.0), vertices_only=True, crests=1).pick == 13
    assert not mesh.pick(view, (0.3, 0.06, 0.0), vertices_only=True, crests=1).is_feature, "the vertex is too far away"
    mesh.picker.set_layer(1, [(0.0, 0.05, 0.0), (0.5, 0.05, 0.0)], [5], 10.0, [(12, 25)])
    with pytest.raises(ValueError, match="25"):
        mesh.pick(view, (0.46, 0.06, 0.0), crests=1)


def test_an_edge_is_crossed_by_the_one_at_its_end_nearer_to_the_cursor() -> None:
    mesh, view = grid(), from_above()

    def crossing(x: float, y: float) -> tuple[int, ...]:
        found = mesh.pick(view, (x, y, 0.0), edges_only=True)
        assert set(found.pick) == {12, 13}
        assert not found.is_close_call
        return tuple(sorted(found.crossing))

    assert crossing(0.15, 0.03) == (12, 17)
    assert crossing(0.15, -0.03) == (7, 12)
    assert crossing(0.35, 0.03) == (13, 18)


def test_edges_of_a_few_pixels_are_a_close_call() -> None:
    mesh = grid(41)
    for half, is_close in ((1.25, True), (0.25, False)):
        assert mesh.pick(from_above(half), (0.025, 0.004, 0.0), edges_only=True).is_close_call is is_close
    assert not mesh.pick(from_above(), (0.025, 0.004, 0.0)).is_close_call, "only loops need to know"


def test_the_cursor_is_inside_a_face_where_it_is_far_from_the_nearest_edge() -> None:
    mesh, view = grid(3), from_above(half=1.0)

    def inside(x: float, y: float, **options: object) -> bool:
        return mesh.pick(view, (x, y, 0.0), **options).is_inside

    # A pixel is 0.005 wide here.
    assert inside(0.3, 0.5, edges_only=True)
    assert inside(0.08, 0.5, edges_only=True)
    assert not inside(0.06, 0.5, edges_only=True)
    assert not inside(0.06, 0.5, edges_only=True, xray=True)
    assert not inside(0.3, 0.5, edges_only=True, xray=True), "what lies under the cursor is not known"
    assert not inside(0.16, 0.5, edges_only=True, scale=2.5)
    assert not inside(0.3, 0.5), "only loops need to know"
