# SPDX-License-Identifier: GPL-3.0-or-later
"""What a picker finds on a mesh that was read from Blender. How it finds it is tested without Blender."""

from functools import partial

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix, Vector
from mathutils.bvhtree import BVHTree
from scene import add_grid, add_suzanne, edit
from seamwire.core.picking.camera import Camera
from seamwire.core.picking.picker import Picker
from seamwire.mesh import edit_mesh

pytestmark = pytest.mark.every_blender

SIZE = 400.0


def from_above(half: float = 1.25) -> Camera:
    """Return a view down on the square of this half size around the origin: x to the right, y up."""
    return Camera(SIZE, SIZE, np.diag([1.0 / half, 1.0 / half, -0.1, 1.0]))


def picked(found: Picker, *where: object, vertices_only: bool) -> object:
    """Return what a click would take of the plain mesh."""
    snap = found.snap(*where, vertices_only=vertices_only)
    return None if snap is None else snap.pick


def pixel(view: Camera, point: Vector) -> tuple[float, float]:
    return tuple(view.to_pixels(np.array([point]))[0].tolist())


def picker(obj: bpy.types.Object) -> Picker:
    """Return a picker for an object in edit mode."""
    return Picker(edit_mesh.read(obj))


def test_picks_follow_an_objects_rotation_and_its_uneven_scale() -> None:
    obj = add_suzanne()
    obj.matrix_world = (
        Matrix.Translation((0.2, -0.1, 0.0))
        @ Euler((0.4, -0.8, 1.9)).to_matrix().to_4x4()
        @ Matrix.Diagonal((0.9, 0.4, 0.6, 1.0))
    )
    bpy.context.view_layer.update()
    edit()
    pick, view = partial(picked, picker(obj)), from_above()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    bm.faces.index_update()
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
            v.index: np.hypot(*np.subtract(pixel(view, obj.matrix_world @ v.co), at))
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
    for face in list(bm.faces)[:16]:
        face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    view = from_above()
    find, at = picker(obj), pixel(view, (0.25, 0.0, 0.0))
    for xray in (False, True):
        found = find.snap(view, Matrix(), at, vertices_only=False, xray=xray)
        assert set(found.pick) == {37, 38}


def test_edges_without_faces_are_picked_too() -> None:
    obj = add_grid(2)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.edges.new((bm.verts[3], bm.verts.new((1.0, 1.2, 0.0))))
    bmesh.update_edit_mesh(obj.data)
    view = from_above()
    assert set(picked(picker(obj), view, Matrix(), pixel(view, (1.0, 1.1, 0.0)), vertices_only=False)) == {3, 4}


def test_numbers_that_other_operators_leave_in_the_mesh_do_not_count() -> None:
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.select_history.clear()
    bm.select_history.add(bm.verts[7])
    cage = edit_mesh.Cage(obj)
    cage.write([(6, 7)], labels={(6, 7): 1})

    def renumber() -> None:
        # What Camera Selected does to vertices that are not selected.
        for v in bm.verts:
            v.index = -1

    renumber()
    assert cage.active_vertex() == 7
    renumber()
    assert np.sort(cage.labels().pairs).tolist() == [[6, 7]]
    renumber()
    view = from_above()
    assert set(picked(picker(obj), view, Matrix(), pixel(view, (0.25, 0.0, 0.0)), vertices_only=False)) == {12, 13}
