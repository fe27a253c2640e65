# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor, in views made by hand."""

from dataclasses import dataclass

import numpy as np
import pytest
from polygon_meshes import arrays_of, grid_places, grid_polygons
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import FacePoint, Pick
from seamwire.core.network.wires import Wire
from seamwire.core.offers.crests import Crests
from seamwire.core.picking.picker import Camera, Picker
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


def test_the_place_on_the_surface_is_given_as_the_mesh_has_it() -> None:
    arrays = arrays_of(grid_places(5), grid_polygons(5), stretch=np.diag([1.0, 3.0, 1.0]))
    matrix = moved(0.1, 0.0, -1.0) @ np.diag([1.0, 3.0, 1.0, 1.0])
    find, view = Picker(arrays), from_above(half=4.0)
    found = find.surface_at(view, matrix, pixel(view, (0.3, 1.2, -1.0)))
    np.testing.assert_allclose(arrays.to_object @ found.place, (0.2, 0.4, 0.0), atol=1e-6)
    assert find.surface_at(view, matrix, pixel(view, (3.0, 0.0, -1.0))) is None


def test_the_direction_of_view_is_given_as_the_mesh_has_it() -> None:
    arrays = arrays_of(grid_places(5), grid_polygons(5), stretch=np.diag([1.0, 3.0, 1.0]))
    find, view = Picker(arrays), from_above(half=4.0, perspective=True)
    along = find.seen_along(view, np.diag([1.0, 3.0, 1.0, 1.0]), 14)
    np.testing.assert_allclose(np.cross(along, (1.0, 0.0, -5.0)), 0.0, atol=1e-6)
    assert along[2] < 0.0
    assert find.seen_along(view, moved(0.0, 0.0, 6.0), 14) is None, "it lies behind the viewer"


def test_an_object_flattened_to_nothing_is_not_picked() -> None:
    find, view, flat = Picker(grid()), from_above(), np.diag([1.0, 0.0, 1.0, 1.0])
    assert find.snap(view, flat, (200.0, 200.0), vertices_only=False) is None
    assert find.surface_at(view, flat, (200.0, 200.0)) is None
    assert find.seen_along(view, flat, 12) is None


def test_across_the_surface_a_point_is_picked_or_the_vertex_that_is_meant() -> None:
    find, view = Picker(grid()), from_above()
    found = find.snap(view, HERE, pixel(view, (0.3, 0.15, 0.0)), vertices_only=True, anywhere=True).pick
    assert isinstance(found, FacePoint)
    np.testing.assert_allclose(
        np.array(found.weights) @ grid().points[list(found.corners)], (0.3, 0.15, 0.0), atol=1e-9
    )
    assert find.snap(view, HERE, pixel(view, (0.03, 0.02, 0.0)), vertices_only=True, anywhere=True) == Snap(12)


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


def test_other_strengths_and_crests_are_found_from_the_next_pick_on() -> None:
    find, view = Picker(grid(81)), from_above()  # an edge is 4 pixels long
    at = pixel(view, (0.0, 0.0, 0.0))
    for ridge in (42 * 81 + 40, 40 * 81 + 42):
        strength = np.zeros(81 * 81)
        strength[ridge] = 5.0
        assert find.snap(view, HERE, at, vertices_only=False, strength=strength) == Snap(ridge, "FEATURE")
    flat = find.snap(view, HERE, at, vertices_only=False, strength=np.ones(81 * 81))
    assert flat.to == "MESH", "a quarter of the vertices would have to be stronger than the others"
    for x in (0.0, 0.5):
        line = np.array([(x, -1.0, 0.0), (x, 1.0, 0.0)])
        edges, none = np.array([(0, 1), (2, 3)]), np.zeros(1)
        crests = Crests(line, edges, np.zeros(2), np.array([7, -1]), np.ones(2), np.array([0, 2]), none)
        beside = pixel(view, (x + 0.03, 0.3, 0.0))
        found = find.snap(view, HERE, beside, vertices_only=True, anywhere=True, crests=crests)
        assert (found.pick.triangle, found.to) == (7, "FEATURE")


def test_the_curve_nearest_to_the_cursor_is_found_within_reach() -> None:
    find, view = Picker(grid()), from_above()
    curves = [np.array([(-1.0, y, z), (1.0, y, z)]) for y, z in ((0.1, 0.0), (0.2, 0.0), (0.5, -1.0))]
    assert find.curve_at(curves, 12.0, view, HERE, pixel(view, (0.0, 0.12, 0.0))) == (0, pytest.approx(10.0, abs=1e-3))
    assert find.curve_at(curves[1:], 12.0, view, HERE, pixel(view, (0.0, 0.13, 0.0)))[0] == 0
    assert find.curve_at(curves, 12.0, view, HERE, pixel(view, (0.0, 0.5, 0.0))) is None
    assert find.curve_at(curves, 12.0, view, HERE, pixel(view, (0.0, 0.5, 0.0)), xray=True)[0] == 2


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


def test_a_loop_learns_where_the_cursor_is() -> None:
    picker, view = Picker(grid(41)), from_above(5.0)
    at = pixel(view, (0.026, 0.02, 0.0))
    snap = picker.snap(view, HERE, at, vertices_only=False, edges_only=True)
    assert snap.is_close_call
    assert snap.triangle is not None
    assert picker.snap(view, HERE, at, vertices_only=False, edges_only=True, xray=True).triangle is None
    large, near = Picker(grid(3)), from_above(1.0)
    assert large.snap(near, HERE, pixel(near, (0.3, 0.5, 0.0)), vertices_only=False, edges_only=True).inside
