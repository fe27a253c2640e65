# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor, in views made by hand."""

import sys
import tracemalloc
from dataclasses import dataclass
from types import FrameType

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix, Vector
from mathutils.bvhtree import BVHTree
from scene import add_grid, add_object, add_suzanne, edit
from seamwire.core.network import Edge, Pick, Snap, Wire
from seamwire.mesh import edit_mesh
from seamwire.view.picking import Picker, nearest_edge
from seamwire.view.viewport import View

SIZE = 400.0


def from_above(half: float = 1.25, perspective: bool = False) -> View:
    """Return a view down on the square of this half size around the origin: x to the right, y up."""
    if perspective:
        # The eye is at (0, 0, 5): at the height of the origin the view shows the same as without perspective.
        near, far, eye = 0.1, 100.0, 5.0
        depth = [[0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)], [0, 0, -1, 0]]
        projection = np.array([[eye / half, 0, 0, 0], [0, eye / half, 0, 0], *depth])
        return View(SIZE, SIZE, projection @ np.array(Matrix.Translation((0, 0, -eye))))
    return View(SIZE, SIZE, np.diag([1.0 / half, 1.0 / half, -0.1, 1.0]))


def pixel(view: View, point: tuple[float, float, float]) -> tuple[float, float]:
    return tuple(view.to_pixels(np.array([point]))[0])


def picker(obj: bpy.types.Object, seams: tuple[Edge, ...] = ()) -> Picker:
    edit()
    return again(obj, seams)


def again(obj: bpy.types.Object, seams: tuple[Edge, ...] = ()) -> Picker:
    """Return a picker for an object that is in edit mode already."""
    return Picker(bmesh.from_edit_mesh(obj.data), edit_mesh.read(obj), seams)


@pytest.mark.parametrize("perspective", [False, True])
def test_an_edge_is_picked_along_its_middle_and_a_vertex_at_its_end(perspective: bool) -> None:
    obj = add_grid(5)  # columns and rows 0.5 apart
    pick, view = picker(obj).pick, from_above(perspective=perspective)
    assert set(pick(view, Matrix(), pixel(view, (0.25, 0.03, 0.0)), vertices_only=False)) == {12, 13}
    assert pick(view, Matrix(), pixel(view, (0.03, 0.03, 0.0)), vertices_only=False) == 12
    assert pick(view, Matrix(), pixel(view, (0.2, 0.03, 0.0)), vertices_only=True) == 12
    assert pick(view, Matrix(), pixel(view, (0.3, 0.03, 0.0)), vertices_only=True) == 13


def test_every_edge_and_vertex_of_a_grid_can_be_picked() -> None:
    obj = add_grid(9)
    pick, view = picker(obj).pick, from_above()
    bm = bmesh.from_edit_mesh(obj.data)
    for v in bm.verts:
        assert pick(view, Matrix(), pixel(view, v.co), vertices_only=False) == v.index
    for e in bm.edges:
        middle = (e.verts[0].co + e.verts[1].co) / 2
        assert set(pick(view, Matrix(), pixel(view, middle), vertices_only=False)) == {v.index for v in e.verts}


def test_nothing_is_picked_far_from_the_mesh_and_the_rim_just_beside_it() -> None:
    obj = add_grid(5)
    pick, view = picker(obj).pick, from_above()
    x, y = pixel(view, (1.0, 0.25, 0.0))
    assert set(pick(view, Matrix(), (x + 8.0, y), vertices_only=False)) == {14, 19}
    assert pick(view, Matrix(), (x + 30.0, y), vertices_only=False) is None


@pytest.mark.parametrize("perspective", [False, True])
def test_picks_follow_an_objects_rotation_and_its_uneven_scale(perspective: bool) -> None:
    obj = add_suzanne()
    obj.matrix_world = (
        Matrix.Translation((0.2, -0.1, 0.0))
        @ Euler((0.4, -0.8, 1.9)).to_matrix().to_4x4()
        @ Matrix.Diagonal((0.9, 0.4, 0.6, 1.0))
    )
    bpy.context.view_layer.update()
    pick, view = picker(obj).pick, from_above(perspective=perspective)
    bm = bmesh.from_edit_mesh(obj.data)
    tree = BVHTree.FromBMesh(bm)
    to_object = obj.matrix_world.inverted()
    hits = 0
    for face in bm.faces:
        at = pixel(view, obj.matrix_world @ face.calc_center_median())
        start, end = (to_object @ Vector(point) for point in view.ray(at))
        if tree.ray_cast(start, (end - start).normalized())[2] != face.index:
            continue  # something lies before it
        hits += 1
        found = pick(view, obj.matrix_world, at, vertices_only=True)
        gaps = {
            v.index: np.hypot(*(np.array(pixel(view, obj.matrix_world @ v.co)) - at))
            for around in {f for v in face.verts for f in v.link_faces}
            for v in around.verts
        }
        assert gaps[found] <= min(gaps[v.index] for v in face.verts)
    assert hits > 20


def test_the_place_on_the_surface_is_given_as_the_mesh_has_it() -> None:
    obj = add_grid(5)
    obj.scale = (1.0, 3.0, 1.0)
    obj.location = (0.1, 0.0, -1.0)
    bpy.context.view_layer.update()
    finder = picker(obj)
    arrays = edit_mesh.read(obj)
    view = from_above(half=4.0)
    found = finder.surface_at(view, obj.matrix_world, pixel(view, (0.3, 1.2, -1.0)))
    assert found is not None
    point, triangle = found
    np.testing.assert_allclose(arrays.to_object @ point, (0.2, 0.4, 0.0), atol=1e-6)
    corners = arrays.points[arrays.triangles[triangle]]
    weights = np.linalg.solve(np.column_stack([corners[:, :2], np.ones(3)]).T, (*point[:2], 1.0))
    assert weights.min() > -1e-6, "it lies in the triangle named"
    assert finder.surface_at(view, obj.matrix_world, pixel(view, (3.0, 0.0, -1.0))) is None
    assert finder.sees(view, obj.matrix_world, np.array((0.2, 0.4, 0.0)))
    assert not finder.sees(view, obj.matrix_world, np.array((0.2, 0.4, -0.5)))


def test_hidden_faces_are_looked_through() -> None:
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bmesh.ops.duplicate(bm, geom=[*bm.verts, *bm.edges, *bm.faces])
    for v in list(bm.verts)[25:]:
        v.co.z = -1.0
    bm.verts.index_update()
    for face in list(bm.faces)[:16]:
        face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    find, view = again(obj), from_above()
    at = pixel(view, (0.25, 0.0, 0.0))
    found = find.pick(view, Matrix(), at, vertices_only=False)
    lower = {v.index for v in bm.verts if v.co.z < -0.5}
    assert set(found) <= lower


def test_of_two_layers_the_front_one_is_picked() -> None:
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bmesh.ops.duplicate(bm, geom=[*bm.verts, *bm.edges, *bm.faces])
    for v in list(bm.verts)[25:]:
        v.co.z = -1.0
    bm.verts.index_update()
    bmesh.update_edit_mesh(obj.data)
    find, view = again(obj), from_above()
    assert find.pick(view, Matrix(), pixel(view, (0.0, 0.0, 0.0)), vertices_only=False) == 12


def test_an_object_flattened_to_nothing_is_not_picked() -> None:
    find, view = picker(add_grid(5)), from_above()
    assert find.pick(view, Matrix.Diagonal((1.0, 0.0, 1.0, 1.0)), (200.0, 200.0), vertices_only=False) is None


def test_edges_without_faces_are_picked_too() -> None:
    find = picker(add_object([(0, 0, 0), (1, 0, 0)], [], [(0, 1)]))
    assert find.pick(from_above(), Matrix(), (200.0, 200.0), vertices_only=False) == 0
    assert find.pick(from_above(), Matrix(), (280.0, 205.0), vertices_only=False) == (0, 1)
    assert find.pick(from_above(), Matrix(), (280.0, 240.0), vertices_only=False) is None


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
    moved: tuple[Wire, ...] = ()
    network_revision: int = 0

    def seeds(self) -> list[Pick]:
        return list(self.placed)


def wire(obj: bpy.types.Object, *vertices: int, along: str = "EDGES", points: object = None) -> Wire:
    places = np.array([obj.data.vertices[v].co for v in vertices]) if points is None else np.array(points)
    return Wire(along, vertices, places, vertices[0], vertices[-1])


def beside(view: View, point: tuple[float, float, float], x: float, y: float) -> tuple[float, float]:
    at = pixel(view, point)
    return at[0] + x, at[1] + y


@pytest.mark.parametrize("perspective", [False, True])
def test_a_seed_is_found_a_few_pixels_beside_it_even_off_the_mesh(perspective: bool) -> None:
    obj = add_grid(5)
    find, view = picker(obj), from_above(perspective=perspective)
    session = Network(placed=(12, 14, (6, 7)))
    corner = obj.data.vertices[14].co
    assert find.snap(view, Matrix(), beside(view, corner, 6.0, 5.0), vertices_only=False, session=session) == Snap(
        14, "SEED"
    )
    assert find.snap(view, Matrix(), beside(view, (0, 0, 0), -5.0, 5.0), vertices_only=False, session=session) == Snap(
        12, "SEED"
    )
    middle = (-0.25, -0.5, 0.0)
    found = find.snap(view, Matrix(), beside(view, middle, 2.0, 5.0), vertices_only=True, session=session)
    assert found == Snap((6, 7), "SEED")
    away = find.snap(view, Matrix(), beside(view, (0, 0, 0), 20.0, 1.0), vertices_only=False, session=session)
    assert away.to == "MESH"


def test_what_was_drawn_wins_over_the_mesh_and_a_seed_over_a_wire_and_a_wire_over_a_seam() -> None:
    obj = add_grid(5)
    find, view = picker(obj, seams=((10, 11), (11, 12), (17, 18))), from_above()
    kept = wire(obj, 11, 12, 13)
    session = Network(placed=(11, 13), wires=(kept,))

    def at(point: tuple[float, float, float], x: float = 0.0, y: float = 3.0) -> Snap:
        return find.snap(view, Matrix(), beside(view, point, x, y), vertices_only=False, session=session)

    assert at((-0.5, 0.0, 0.0)) == Snap(11, "SEED")
    assert at((0.1, 0.0, 0.0)) == Snap(12, "WIRE", kept)
    assert at((-0.1, 0.0, 0.0)) == Snap(12, "WIRE", kept), "the wire lies on the seam"
    assert at((-0.75, 0.0, 0.0), x=-20.0) == Snap(10, "SEAM")
    assert at((0.2, 0.5, 0.0)) == Snap(17, "SEAM")
    assert at((0.25, -0.5, 0.0)).to == "MESH"
    without = find.snap(view, Matrix(), beside(view, (0.25, 0.0, 0.0), 0.0, 0.0), vertices_only=False)
    assert set(without.pick) == {12, 13}
    assert without.to == "MESH"


def test_a_wire_across_the_surface_is_found_by_its_curve() -> None:
    obj = add_grid(5)
    find, view = picker(obj), from_above()
    curve = [(-0.9, -0.6, 0.0), (0.9, -0.7, 0.0)]
    kept = wire(obj, 5, 6, 7, 8, 9, along="SURFACE", points=curve)
    session = Network(wires=(kept,))
    found = find.snap(view, Matrix(), pixel(view, (0.45, -0.675, 0.0)), vertices_only=True, session=session)
    assert found == Snap(8, "WIRE", kept)


def test_the_network_is_read_again_when_it_changes() -> None:
    obj = add_grid(5)
    find, view = picker(obj), from_above()
    session, at = Network(placed=(12,)), pixel(from_above(), (0.0, 0.0, 0.0))
    assert find.snap(view, Matrix(), at, vertices_only=True, session=session).to == "SEED"
    session.placed, session.network_revision = (13,), 1
    assert find.snap(view, Matrix(), at, vertices_only=True, session=session).to == "MESH"


def test_a_dragged_seed_and_its_wires_are_not_found() -> None:
    obj = add_grid(5)
    find, view = picker(obj), from_above()
    kept, staying = wire(obj, 11, 12, 13), wire(obj, 21, 22, 23)
    session = Network(placed=(11, 13, 21, 23), wires=(kept, staying), moved=(kept,))
    for point in ((-0.5, 0.0, 0.0), (0.1, 0.0, 0.0), (0.5, 0.0, 0.0)):
        assert find.snap(view, Matrix(), pixel(view, point), vertices_only=True, session=session).to == "MESH"
    assert find.snap(view, Matrix(), pixel(view, (-0.5, 1.0, 0.0)), vertices_only=True, session=session).to == "SEED"


def two_sheets() -> bpy.types.Object:
    """Return two grids, the second one below the first and moved by half an edge; its vertices are 25 to 49."""
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bmesh.ops.duplicate(bm, geom=[*bm.verts, *bm.edges, *bm.faces])
    for v in list(bm.verts)[25:]:
        v.co += Vector((0.25, 0.25, -1.0))
    bm.verts.index_update()
    bmesh.update_edit_mesh(obj.data)
    return obj


def test_xray_finds_what_lies_behind_and_nothing_that_is_hidden() -> None:
    obj = two_sheets()
    view, at = from_above(), pixel(from_above(), (0.25, 0.25, 0.0))
    session = Network(placed=(37,))
    for through in (False, True):
        found = again(obj).snap(view, Matrix(), at, vertices_only=True, xray=through)
        assert (found.pick == 37) == through
        seed = again(obj).snap(view, Matrix(), at, vertices_only=True, xray=through, session=session)
        assert (seed.to == "SEED") == through, "seeds behind the mesh as well"
    edge = again(obj).snap(view, Matrix(), pixel(view, (0.4, 0.25, 0.0)), vertices_only=False, xray=True)
    assert set(edge.pick) == {37, 38}
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if face.verts[0].co.z < -0.5:
            face.hide_set(True)
    for v in bm.verts:
        v.hide = v.co.z < -0.5
    for e in bm.edges:
        e.hide = e.verts[0].co.z < -0.5
    bmesh.update_edit_mesh(obj.data)
    assert again(obj).snap(view, Matrix(), at, vertices_only=True, xray=True).pick < 25


def test_of_two_vertices_at_the_same_place_xray_takes_the_one_in_front() -> None:
    obj = two_sheets()
    bm = bmesh.from_edit_mesh(obj.data)
    for v in list(bm.verts)[25:]:
        v.co -= Vector((0.25, 0.25, 0.0))
    bmesh.update_edit_mesh(obj.data)
    view = from_above()
    found = again(obj).snap(view, Matrix(), pixel(view, (0.0, 0.0, 0.0)), vertices_only=True, xray=True)
    assert found.pick == 12


def test_the_strongest_feature_within_reach_is_taken_and_none_where_all_is_plain() -> None:
    obj = add_grid(81)  # an edge is 4 pixels long
    find, view = picker(obj), from_above()
    strength = np.zeros(81 * 81)
    ridge = 42 * 81 + 40
    strength[ridge] = 5.0
    at = pixel(view, (0.0, 0.0, 0.0))
    assert find.snap(view, Matrix(), at, vertices_only=False, strength=strength) == Snap(ridge, "FEATURE")
    away = beside(view, (0.0, 0.0, 0.0), 30.0, -30.0)
    assert find.snap(view, Matrix(), away, vertices_only=False, strength=strength).to == "MESH"
    strength[45 * 81 + 40] = 50.0
    assert find.snap(view, Matrix(), at, vertices_only=False, strength=strength).pick == ridge, "that one is too far"


def test_a_feature_on_the_far_side_is_not_taken() -> None:
    obj = add_grid(81)
    for v in obj.data.vertices:
        if v.co.x > 0.01:  # folded under the other half
            v.co = (-v.co.x, v.co.y, -0.5)
    find, view = picker(obj), from_above()
    strength = np.zeros(81 * 81)
    under = 40 * 81 + 42
    strength[under] = 5.0
    at = pixel(view, (-0.02, 0.0, 0.0))
    assert find.snap(view, Matrix(), at, vertices_only=False, strength=strength).to == "MESH"
    through = find.snap(view, Matrix(), at, vertices_only=False, strength=strength, xray=True)
    assert through == Snap(under, "FEATURE")


def test_depth_tells_which_object_is_in_front() -> None:
    find, view = picker(add_grid(5)), from_above()
    at = pixel(view, (0.1, 0.1, 0.0))
    low = find.depth(view, Matrix.Translation((0.0, 0.0, -1.0)), at)
    high = find.depth(view, Matrix.Translation((0.0, 0.0, 1.0)), at)
    assert high == pytest.approx(low - 2.0)
    assert find.depth(view, Matrix(), (1.0, 1.0)) is None


def test_a_snap_takes_no_more_work_on_a_larger_mesh() -> None:
    def work(obj: bpy.types.Object) -> tuple[int, int]:
        """Return the most calls and the most bytes at a time that a snap takes."""
        find, view = picker(obj), from_above()
        count = len(obj.data.vertices)
        session = Network(placed=tuple(range(0, count, max(count // 50, 1))), wires=(wire(obj, *range(60)),))
        strength = np.random.default_rng(1).random(count)
        calls: list[int] = []

        def called(_frame: FrameType, event: str, _what: object) -> None:
            calls[-1] += event in {"call", "c_call"}

        sizes = []
        for step in range(40):
            at = (120.0 + 4.0 * step, 131.0 + 3.0 * step)
            calls.append(0)
            tracemalloc.start()
            sys.setprofile(called)
            try:
                find.snap(view, Matrix(), at, vertices_only=False, session=session, strength=strength)
            finally:
                sys.setprofile(None)
                sizes.append(tracemalloc.get_traced_memory()[1])
                tracemalloc.stop()
        bpy.ops.object.mode_set(mode="OBJECT")
        # The first one reads what is kept.
        return max(calls[1:]), max(sizes[1:])

    large, larger = work(add_grid(513)), work(add_grid(1025))
    # What grows is the number of vertices within reach, up to a limit that both meshes go beyond.
    assert larger[0] == large[0]
    assert larger[1] == pytest.approx(large[1], rel=0.01)
