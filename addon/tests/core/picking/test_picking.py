# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor, in views made by hand."""

from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from polygon_meshes import arrays_of, grid_places, grid_polygons
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import FacePoint, Pick
from seamwire.core.network.wires import Wire
from seamwire.core.picking.camera import Camera, Sight, nearest_edge
from seamwire.core.picking.picker import Picker
from seamwire.core.picking.surface import VisibleSurface
from seamwire.terms.options import Options

pytest.importorskip("seamwire_core")

SIZE = 400.0
HERE = np.eye(4)


def from_above(half: float = 1.25, perspective: bool = False) -> Camera:
    """Return a view down on the square of this half size around the origin: x to the right, y up."""
    if perspective:
        # The eye is at (0, 0, 5): at the height of the origin the view shows the same as without perspective.
        near, far, eye = 0.1, 100.0, 5.0
        depth = [[0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)], [0, 0, -1, 0]]
        projection = np.array([[eye / half, 0, 0, 0], [0, eye / half, 0, 0], *depth])
        return Camera(SIZE, SIZE, projection @ moved(0.0, 0.0, -eye))
    return Camera(SIZE, SIZE, np.diag([1.0 / half, 1.0 / half, -0.1, 1.0]))


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


def picked(found: Picker, *where: object, vertices_only: bool) -> object:
    """Return what a click would take of the plain mesh."""
    snap = found.snap(*where, vertices_only=vertices_only)
    return None if snap is None else snap.pick


def pixel(view: Camera, point: tuple[float, float, float]) -> tuple[float, float]:
    return tuple(view.to_pixels(np.array([point]))[0].tolist())


def beside(view: Camera, point: tuple[float, float, float], x: float, y: float) -> tuple[float, float]:
    at = pixel(view, point)
    return at[0] + x, at[1] + y


def grid(side: int = 5) -> Arrays:
    """Return a square from (-1, -1, 0) to (1, 1, 0); vertex y * side + x is column x of row y."""
    return arrays_of(grid_places(side), grid_polygons(side))


def two_sheets(x: float = 0.0, y: float = 0.0) -> Arrays:
    """Return two grids, the second one below the first and moved by x and y; its vertices are 25 to 49."""
    places = grid_places(5)
    return arrays_of([*places, *np.add(places, (x, y, -1.0))], [*grid_polygons(5), *grid_polygons(5, first=25)])


def ball(rings: int = 8, around: int = 12) -> Arrays:
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
    return arrays_of(places, polygons)


@pytest.mark.parametrize("perspective", [False, True])
def test_an_edge_is_picked_along_its_middle_and_a_vertex_at_its_end(perspective: bool) -> None:
    pick, view = partial(picked, Picker(grid())), from_above(perspective=perspective)
    assert set(pick(view, HERE, pixel(view, (0.25, 0.03, 0.0)), vertices_only=False)) == {12, 13}
    assert pick(view, HERE, pixel(view, (0.03, 0.03, 0.0)), vertices_only=False) == 12
    assert pick(view, HERE, pixel(view, (0.2, 0.03, 0.0)), vertices_only=True) == 12
    assert pick(view, HERE, pixel(view, (0.3, 0.03, 0.0)), vertices_only=True) == 13


def test_nothing_is_picked_far_from_the_mesh_and_the_rim_just_beside_it() -> None:
    pick, view = partial(picked, Picker(grid())), from_above()
    x, y = pixel(view, (1.0, 0.25, 0.0))
    assert set(pick(view, HERE, (x + 8.0, y), vertices_only=False)) == {14, 19}
    assert pick(view, HERE, (x + 30.0, y), vertices_only=False) is None


def first_triangle(corners: np.ndarray, start: np.ndarray, end: np.ndarray) -> int:
    """Return which of (m, 3, 3) triangles a ray meets first, by the equations of each."""
    a, b, c = corners.transpose(1, 0, 2)
    systems = np.stack([b - a, c - a, np.broadcast_to(start - end, a.shape)], axis=2)
    u, v, far = np.linalg.solve(systems, (start - a)[:, :, None])[:, :, 0].T
    met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0)
    return int(np.argmin(np.where(met, far, np.inf)))


@pytest.mark.parametrize("perspective", [False, True])
def test_picks_follow_an_objects_rotation_and_its_uneven_scale(perspective: bool) -> None:
    arrays = ball()
    matrix = moved(0.2, -0.1, 0.0) @ turned(0.4, -0.8, 1.9) @ np.diag([0.9, 0.4, 0.6, 1.0])
    find, view = Picker(arrays), from_above(perspective=perspective)
    world = arrays.points @ matrix[:3, :3].T + matrix[:3, 3]
    pixels = view.to_pixels(world)
    hits = 0
    for polygon in np.unique(arrays.polygons):
        corners = np.unique(arrays.triangles[arrays.polygons == polygon])
        at = pixel(view, world[corners].mean(axis=0))
        if arrays.polygons[first_triangle(world[arrays.triangles], *view.ray(at))] != polygon:
            continue  # something lies before it
        hits += 1
        found = picked(find, view, matrix, at, vertices_only=True)
        touching = np.isin(arrays.triangles, corners).any(axis=1)
        around = np.unique(arrays.triangles[np.isin(arrays.polygons, arrays.polygons[touching])])
        assert found in around
        rounding = 1e-9  # pixels: equally near vertices differ by less
        assert np.linalg.norm(pixels[found] - at) <= np.linalg.norm(pixels[corners] - at, axis=1).min() + rounding
    assert hits > 20


def test_the_place_on_the_surface_is_given_as_the_mesh_has_it() -> None:
    arrays = arrays_of(grid_places(5), grid_polygons(5), stretch=np.diag([1.0, 3.0, 1.0]))
    matrix = moved(0.1, 0.0, -1.0) @ np.diag([1.0, 3.0, 1.0, 1.0])
    find, view = Picker(arrays), from_above(half=4.0)
    found = find.surface_at(view, matrix, pixel(view, (0.3, 1.2, -1.0)))
    assert found is not None
    point, triangle = found
    np.testing.assert_allclose(arrays.to_object @ point, (0.2, 0.4, 0.0), atol=1e-6)
    corners = arrays.points[arrays.triangles[triangle]]
    weights = np.linalg.solve(np.column_stack([corners[:, :2], np.ones(3)]).T, (*point[:2], 1.0))
    assert weights.min() > -1e-6, "it lies in the triangle named"
    assert find.surface_at(view, matrix, pixel(view, (3.0, 0.0, -1.0))) is None
    surface, sight = VisibleSurface(arrays), Sight.of(view, matrix, (0.0, 0.0))
    assert surface.sees(sight, np.array((0.2, 0.4, 0.0)))
    assert not surface.sees(sight, np.array((0.2, 0.4, -0.5)))


def test_the_direction_of_view_is_given_as_the_mesh_has_it() -> None:
    arrays = arrays_of(grid_places(5), grid_polygons(5), stretch=np.diag([1.0, 3.0, 1.0]))
    find, view = Picker(arrays), from_above(half=4.0, perspective=True)
    along = find.seen_along(view, np.diag([1.0, 3.0, 1.0, 1.0]), 14)
    np.testing.assert_allclose(np.cross(along, (1.0, 0.0, -5.0)), 0.0, atol=1e-6)
    assert along[2] < 0.0
    assert find.seen_along(view, moved(0.0, 0.0, 6.0), 14) is None, "it lies behind the viewer"


def test_hidden_faces_are_looked_through() -> None:
    sheets = two_sheets()
    at = pixel(from_above(), (0.25, 0.0, 0.0))
    assert set(picked(Picker(sheets), from_above(), HERE, at, vertices_only=False)) == {12, 13}
    lower = arrays_of(sheets.points, [*grid_polygons(5), *grid_polygons(5, first=25)], hidden=range(16))
    assert set(picked(Picker(lower), from_above(), HERE, at, vertices_only=False)) == {37, 38}


def test_of_two_layers_the_front_one_is_picked() -> None:
    find, view = Picker(two_sheets()), from_above()
    assert picked(find, view, HERE, pixel(view, (0.0, 0.0, 0.0)), vertices_only=False) == 12


SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def with_flap(x: float, z: float) -> Picker:
    """Return a picker for the square with another face at its right side, whose far edge is at x and z."""
    return Picker(arrays_of([*SQUARE, (x, -0.8, z), (x, 0.8, z)], [(0, 1, 2, 3), (2, 1, 4, 5)]))


def test_edges_of_faces_that_turn_away_are_not_picked_through_the_face_in_front() -> None:
    view = from_above()
    folded_under = with_flap(0.1, -0.3)
    for place, edge in (((0.1, 0.0, 0.0), {1, 2}), ((0.55, 0.9, 0.0), {2, 3})):
        assert set(picked(folded_under, view, HERE, pixel(view, place), vertices_only=False)) == edge
    folded_down = with_flap(1.1, -2.0)
    assert set(picked(folded_down, view, HERE, pixel(view, (1.09, 0.0, 0.0)), vertices_only=False)) == {4, 5}
    near = from_above(perspective=True)
    # The eye is above the middle of the square: from there the same face turns away.
    hidden = pixel(near, (1.1, 0.0, -2.0))
    assert set(picked(folded_down, near, HERE, hidden, vertices_only=False)) == {1, 2}


def test_an_edge_below_a_diagonal_of_the_face_in_front_is_not_picked() -> None:
    find, view = Picker(arrays_of([*SQUARE, (0, 0.3, -1)], [(0, 1, 2, 3), (0, 4, 2)])), from_above()
    assert set(picked(find, view, HERE, pixel(view, (0.1, 0.1, 0.0)), vertices_only=False)) in ({1, 2}, {2, 3})


def test_diagonals_that_cut_a_polygon_into_triangles_are_not_picked() -> None:
    turns = np.arange(8) * np.pi / 4.0
    places = np.stack([np.cos(turns), np.sin(turns), np.zeros(8)], axis=1)
    find, view = Picker(arrays_of(places, [range(8)])), from_above()
    diagonal = places[[0, 3]].mean(axis=0)
    a, b = picked(find, view, HERE, pixel(view, diagonal), vertices_only=False)
    assert abs(a - b) in {1, 7}


def test_an_object_flattened_to_nothing_is_not_picked() -> None:
    find, view, flat = Picker(grid()), from_above(), np.diag([1.0, 0.0, 1.0, 1.0])
    assert picked(find, view, flat, (200.0, 200.0), vertices_only=False) is None
    assert find.snap(view, flat, (200.0, 200.0), vertices_only=False) is None
    assert find.depth(view, flat, (200.0, 200.0)) is None
    assert find.surface_at(view, flat, (200.0, 200.0)) is None
    assert find.seen_along(view, flat, 12) is None


def test_edges_without_faces_are_picked_too() -> None:
    find = Picker(arrays_of([(0, 0, 0), (1, 0, 0)], [], loose=[(0, 1)]))
    assert picked(find, from_above(), HERE, (200.0, 200.0), vertices_only=False) == 0
    assert picked(find, from_above(), HERE, (280.0, 205.0), vertices_only=False) == (0, 1)
    assert picked(find, from_above(), HERE, (280.0, 240.0), vertices_only=False) is None


def test_edges_alone_are_picked_where_that_is_asked_for() -> None:
    find, view = Picker(grid()), from_above()
    at = pixel(view, (0.03, 0.02, 0.0))
    assert find.snap(view, HERE, at, vertices_only=False) == Snap(12)
    assert set(find.snap(view, HERE, at, vertices_only=False, edges_only=True).pick) == {12, 13}


def test_across_the_surface_a_point_is_picked_or_the_vertex_that_is_meant() -> None:
    find, view = Picker(grid()), from_above()
    found = find.snap(view, HERE, pixel(view, (0.3, 0.15, 0.0)), vertices_only=True, anywhere=True).pick
    assert isinstance(found, FacePoint)
    np.testing.assert_allclose(
        np.array(found.weights) @ grid().points[list(found.corners)], (0.3, 0.15, 0.0), atol=1e-9
    )
    assert find.snap(view, HERE, pixel(view, (0.03, 0.02, 0.0)), vertices_only=True, anywhere=True) == Snap(12)


def test_the_nearest_segment_is_found_and_its_end_near_the_end() -> None:
    starts, ends = np.array([[0.0, 0.0], [0.0, 10.0]]), np.array([[100.0, 0.0], [100.0, 10.0]])
    assert nearest_edge((50.0, 2.0), starts, ends) == (0, None)
    assert nearest_edge((50.0, 7.0), starts, ends) == (1, None)
    assert nearest_edge((5.0, 2.0), starts, ends) == (0, 0)
    assert nearest_edge((95.0, 9.0), starts, ends) == (1, 1)
    assert nearest_edge((14.0, 2.0), starts, ends) == (0, None), "a vertex is a dozen pixels wide"
    assert nearest_edge((14.0, 2.0), starts, ends, scale=2.0) == (0, 0), "of the display's pixels"


def test_a_segment_that_is_partly_behind_the_viewer_is_not_found() -> None:
    starts, ends = np.array([[np.nan, np.nan], [0.0, 10.0]]), np.array([[100.0, 0.0], [100.0, 10.0]])
    assert nearest_edge((50.0, 2.0), starts, ends) == (1, None)
    assert nearest_edge((50.0, 2.0), starts[:1], ends[:1]) == (-1, None)


# Seeds, wires, seams


@dataclass
class Network:
    """As much of a session as a picker asks for."""

    placed: tuple[Pick, ...] = ()
    wires: tuple[Wire, ...] = ()
    dragged: tuple[Wire, ...] = ()
    seed_place = None

    @property
    def moved(self) -> object:
        ends = {end for wire in self.dragged for end in (wire.start, wire.end)}
        return {wire.id for wire in self.dragged}, ends

    @property
    def drawn(self) -> object:
        return self.placed, self.wires

    @property
    def options(self) -> Options:
        return Options()

    def seeds(self) -> list[Pick]:
        return list(self.placed)


def wire(*vertices: int, along: str = "EDGES", points: object = None) -> Wire:
    """Return a wire on the grid of 5 x 5 vertices."""
    places = grid().points[list(vertices)] if points is None else np.array(points)
    return Wire(along, vertices, places, vertices[0], vertices[-1])


@pytest.mark.parametrize("perspective", [False, True])
def test_a_seed_is_found_a_few_pixels_beside_it_even_off_the_mesh(perspective: bool) -> None:
    find, view = Picker(grid()), from_above(perspective=perspective)
    session = Network(placed=(12, 14, (6, 7)))
    corner = grid().points[14]
    assert find.snap(view, HERE, beside(view, corner, 6.0, 5.0), vertices_only=False, session=session) == Snap(
        14, "SEED"
    )
    assert find.snap(view, HERE, beside(view, (0, 0, 0), -5.0, 5.0), vertices_only=False, session=session) == Snap(
        12, "SEED"
    )
    middle = (-0.25, -0.5, 0.0)
    found = find.snap(view, HERE, beside(view, middle, 2.0, 5.0), vertices_only=True, session=session)
    assert found == Snap((6, 7), "SEED")
    away = find.snap(view, HERE, beside(view, (0, 0, 0), 20.0, 1.0), vertices_only=False, session=session)
    assert away.to == "MESH"


def test_what_was_drawn_wins_over_the_mesh_and_a_seed_over_a_wire_and_a_wire_over_a_seam() -> None:
    find, view = Picker(grid(), seams=((10, 11), (11, 12), (17, 18))), from_above()
    kept = wire(11, 12, 13)
    session = Network(placed=(11, 13), wires=(kept,))

    def at(point: tuple[float, float, float], x: float = 0.0, y: float = 3.0) -> Snap:
        return find.snap(view, HERE, beside(view, point, x, y), vertices_only=False, session=session)

    assert at((-0.5, 0.0, 0.0)) == Snap(11, "SEED")
    assert at((0.1, 0.0, 0.0)) == Snap(12, "WIRE", kept)
    assert at((-0.1, 0.0, 0.0)) == Snap(12, "WIRE", kept), "the wire lies on the seam"
    assert at((-0.75, 0.0, 0.0), x=-20.0) == Snap(10, "SEAM")
    assert at((0.2, 0.5, 0.0)) == Snap(17, "SEAM")
    assert at((0.25, -0.5, 0.0)).to == "MESH"
    without = find.snap(view, HERE, beside(view, (0.25, 0.0, 0.0), 0.0, 0.0), vertices_only=False)
    assert set(without.pick) == {12, 13}
    assert without.to == "MESH"


def test_a_wire_across_the_surface_is_found_by_its_curve() -> None:
    find, view = Picker(grid()), from_above()
    curve = [(-0.9, -0.6, 0.0), (0.9, -0.7, 0.0)]
    kept = wire(5, 6, 7, 8, 9, along="SURFACE", points=curve)
    session = Network(wires=(kept,))
    found = find.snap(view, HERE, pixel(view, (0.45, -0.675, 0.0)), vertices_only=True, session=session)
    assert found == Snap(8, "WIRE", kept)


def test_a_dragged_seed_and_its_wires_are_not_found() -> None:
    find, view = Picker(grid()), from_above()
    kept, staying = wire(11, 12, 13), wire(21, 22, 23)
    session = Network(placed=(11, 13, 21, 23), wires=(kept, staying), dragged=(kept,))
    for point in ((-0.5, 0.0, 0.0), (0.1, 0.0, 0.0), (0.5, 0.0, 0.0)):
        assert find.snap(view, HERE, pixel(view, point), vertices_only=True, session=session).to == "MESH"
    assert find.snap(view, HERE, pixel(view, (-0.5, 1.0, 0.0)), vertices_only=True, session=session).to == "SEED"


def test_what_was_drawn_is_found_anew_only_if_it_changed() -> None:
    picker, asked = Picker(grid()), []
    view, session = from_above(), Network(placed=(12,), wires=(wire(11, 12, 13),))
    session.seeds = lambda: asked.append(1) or list(session.placed)
    for _ in range(3):
        picker.snap(view, HERE, pixel(view, (0.0, 0.0, 0.0)), vertices_only=True, session=session)
    assert len(asked) == 1
    session.placed = (14,)
    at = pixel(view, (1.0, 0.0, 0.0))
    assert picker.snap(view, HERE, at, vertices_only=True, session=session) == Snap(14, "SEED")


def test_xray_finds_what_lies_behind_and_nothing_that_is_hidden() -> None:
    sheets = two_sheets(0.25, 0.25)
    find, view, at = Picker(sheets), from_above(), pixel(from_above(), (0.25, 0.25, 0.0))
    session = Network(placed=(37,))
    for through in (False, True):
        found = find.snap(view, HERE, at, vertices_only=True, xray=through)
        assert (found.pick == 37) == through
        seed = find.snap(view, HERE, at, vertices_only=True, xray=through, session=session)
        assert (seed.to == "SEED") == through, "seeds behind the mesh as well"
    edge = find.snap(view, HERE, pixel(view, (0.4, 0.25, 0.0)), vertices_only=False, xray=True)
    assert set(edge.pick) == {37, 38}
    hidden = range(16, 32)
    upper = arrays_of(sheets.points, [*grid_polygons(5), *grid_polygons(5, first=25)], hidden=hidden)
    assert Picker(upper).snap(view, HERE, at, vertices_only=True, xray=True).pick < 25


def test_xray_finds_edges_of_large_meshes_too() -> None:
    arrays = grid(181)
    assert len(arrays.edges) > 50_000
    find, view = Picker(arrays), from_above(half=0.125)
    middle = 90 * 181 + 90
    at = beside(view, arrays.points[[middle, middle + 1]].mean(axis=0), 0.0, 3.0)
    assert set(find.snap(view, HERE, at, vertices_only=False, xray=True).pick) == {middle, middle + 1}


def test_of_two_vertices_at_the_same_place_xray_takes_the_one_in_front() -> None:
    view = from_above()
    found = Picker(two_sheets()).snap(view, HERE, pixel(view, (0.0, 0.0, 0.0)), vertices_only=True, xray=True)
    assert found.pick == 12


def test_the_strongest_feature_within_reach_is_taken_and_none_where_all_is_plain() -> None:
    find, view = Picker(grid(81)), from_above()  # an edge is 4 pixels long
    strength = np.zeros(81 * 81)
    ridge = 42 * 81 + 40
    strength[ridge] = 5.0
    at = pixel(view, (0.0, 0.0, 0.0))
    assert find.snap(view, HERE, at, vertices_only=False, strength=strength) == Snap(ridge, "FEATURE")
    away = beside(view, (0.0, 0.0, 0.0), 30.0, -30.0)
    assert find.snap(view, HERE, away, vertices_only=False, strength=strength).to == "MESH"
    strength[45 * 81 + 40] = 50.0
    assert find.snap(view, HERE, at, vertices_only=False, strength=strength).pick == ridge, "that one is too far"


def test_the_nearest_of_preferred_vertices_within_reach_is_taken_before_features() -> None:
    find, view = Picker(grid(81)), from_above()
    column = frozenset(range(40, 81 * 81, 81))
    strength = np.zeros(81 * 81)
    strength[40 * 81 + 41] = 5.0
    at = beside(view, (0.0, 0.0, 0.0), 7.0, 1.0)
    plain = find.snap(view, HERE, at, vertices_only=True)
    assert plain.pick == 40 * 81 + 42
    assert find.snap(view, HERE, at, vertices_only=True, preferred=column, strength=strength) == Snap(40 * 81 + 40)
    away = beside(view, (0.0, 0.0, 0.0), 11.0, 1.0)
    assert find.snap(view, HERE, away, vertices_only=True, preferred=column).pick not in column


def test_a_feature_on_the_far_side_is_not_taken() -> None:
    places = grid_places(81)
    under_half = places[:, 0] > 0.01
    places[under_half] = places[under_half] * (-1.0, 1.0, 1.0) - (0.0, 0.0, 0.5)  # folded under the other half
    find, view = Picker(arrays_of(places, grid_polygons(81))), from_above()
    strength = np.zeros(81 * 81)
    under = 40 * 81 + 42
    strength[under] = 5.0
    at = pixel(view, (-0.02, 0.0, 0.0))
    assert find.snap(view, HERE, at, vertices_only=False, strength=strength).to == "MESH"
    through = find.snap(view, HERE, at, vertices_only=False, strength=strength, xray=True)
    assert through == Snap(under, "FEATURE")


def test_depth_tells_which_object_is_in_front() -> None:
    find, view = Picker(grid()), from_above()
    at = pixel(view, (0.1, 0.1, 0.0))
    low = find.depth(view, moved(0.0, 0.0, -1.0), at)
    high = find.depth(view, moved(0.0, 0.0, 1.0), at)
    assert high == pytest.approx(low - 2.0)
    assert find.depth(view, HERE, (1.0, 1.0)) is None


def test_an_edge_is_crossed_by_the_one_at_its_end_nearer_to_the_cursor() -> None:
    view, picker = from_above(), Picker(grid())

    def crossing(x: float, y: float) -> tuple[int, ...]:
        snap = picker.snap(view, HERE, pixel(view, (x, y, 0.0)), vertices_only=False, edges_only=True)
        assert set(snap.pick) == {12, 13}
        assert not snap.is_close_call
        return tuple(sorted(snap.crossing))

    assert crossing(0.15, 0.03) == (12, 17)
    assert crossing(0.15, -0.03) == (7, 12)
    assert crossing(0.35, 0.03) == (13, 18)


def test_edges_of_a_few_pixels_are_a_close_call() -> None:
    picker = Picker(grid(41))
    for half, is_close in ((1.25, True), (0.25, False)):
        view = from_above(half)
        at = pixel(view, (0.025, 0.004, 0.0))
        assert picker.snap(view, HERE, at, vertices_only=False, edges_only=True).is_close_call is is_close
        assert not picker.snap(view, HERE, at, vertices_only=False).is_close_call, "only loops need to know"


def three_planes() -> Arrays:
    """Return a fine grid of triangles, bent at the middle along three edges: left, down, and up to the right."""
    places = grid_places(81)
    places[:, 2] = np.minimum(0.0, -np.maximum(places[:, 0], places[:, 1]))
    return arrays_of(places, [half for a, b, c, d in grid_polygons(81) for half in ((a, b, c), (a, c, d))])


def test_the_cursor_is_inside_a_face_where_it_is_far_from_the_nearest_edge() -> None:
    picker, view = (
        Picker(arrays_of(grid_places(3), grid_polygons(3))),
        Camera(400.0, 400.0, np.diag([1.0, 1.0, -0.1, 1.0])),
    )

    def inside(x: float, y: float, **options: object) -> bool:
        at = view.to_pixels(np.array([[x, y, 0.0]]))[0]
        return picker.snap(view, HERE, tuple(at), vertices_only=False, **options).inside

    # A pixel is 0.005 wide here.
    assert inside(0.3, 0.5, edges_only=True)
    assert inside(0.08, 0.5, edges_only=True)
    assert not inside(0.06, 0.5, edges_only=True)
    assert not inside(0.06, 0.5, edges_only=True, xray=True)
    assert not inside(0.3, 0.5, edges_only=True, xray=True), "what lies under the cursor is not known"
    assert not inside(0.16, 0.5, edges_only=True, scale=2.5)
    assert not inside(0.3, 0.5), "only loops need to know"


def test_a_corner_is_taken_before_a_stronger_point_of_a_ridge() -> None:
    arrays = three_planes()
    find, view = Picker(arrays), from_above()
    corner = 40 * 81 + 40
    strength = np.zeros(81 * 81)
    strength[40 * 81 + 39] = 5.0
    at = beside(view, arrays.points[corner], -3.0, -1.0)
    assert find.snap(view, HERE, at, vertices_only=True, strength=strength) == Snap(corner, "FEATURE")
    far = beside(view, arrays.points[corner], -40.0, -1.0)
    strength[40 * 81 + 30] = 5.0
    assert find.snap(view, HERE, far, vertices_only=True, strength=strength) == Snap(40 * 81 + 30, "FEATURE")
