# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor, in views made by hand."""

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix, Vector
from mathutils.bvhtree import BVHTree
from scene import add_grid, add_object, add_suzanne, edit
from seamwire.picking import Picker, View, nearest_edge

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


def picker(obj: bpy.types.Object) -> Picker:
    edit()
    return Picker(bmesh.from_edit_mesh(obj.data), size=2.0)


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
    find, view = Picker(bmesh.from_edit_mesh(obj.data), size=2.0), from_above()
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
    find, view = Picker(bmesh.from_edit_mesh(obj.data), size=2.0), from_above()
    assert find.pick(view, Matrix(), pixel(view, (0.0, 0.0, 0.0)), vertices_only=False) == 12


def test_an_object_flattened_to_nothing_is_not_picked() -> None:
    find, view = picker(add_grid(5)), from_above()
    assert find.pick(view, Matrix.Diagonal((1.0, 0.0, 1.0, 1.0)), (200.0, 200.0), vertices_only=False) is None


def test_an_empty_mesh_can_be_looked_at() -> None:
    find = picker(add_object([], []))
    assert find.pick(from_above(), Matrix(), (200.0, 200.0), vertices_only=False) is None


def test_the_nearest_segment_is_found_and_its_end_near_the_end() -> None:
    starts, ends = np.array([[0.0, 0.0], [0.0, 10.0]]), np.array([[100.0, 0.0], [100.0, 10.0]])
    assert nearest_edge((50.0, 2.0), starts, ends) == (0, None)
    assert nearest_edge((50.0, 7.0), starts, ends) == (1, None)
    assert nearest_edge((5.0, 2.0), starts, ends) == (0, 0)
    assert nearest_edge((95.0, 9.0), starts, ends) == (1, 1)
    assert nearest_edge((14.0, 2.0), starts, ends) == (0, None), "a vertex is a dozen pixels wide"


def test_a_segment_that_is_partly_behind_the_viewer_is_not_found() -> None:
    starts, ends = np.array([[np.nan, np.nan], [0.0, 10.0]]), np.array([[100.0, 0.0], [100.0, 10.0]])
    assert nearest_edge((50.0, 2.0), starts, ends) == (1, None)
    assert nearest_edge((50.0, 2.0), starts[:1], ends[:1]) == (-1, None)
