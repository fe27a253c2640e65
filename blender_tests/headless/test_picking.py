# SPDX-License-Identifier: GPL-3.0-or-later
"""What a picker finds on a mesh that was read from Blender. How it finds it is tested without Blender."""

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector
from scene import add_grid, edit
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
