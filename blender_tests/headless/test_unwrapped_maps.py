# SPDX-License-Identifier: GPL-3.0-or-later
"""What the UV map holds after *Unwrap Changed Islands*, measured without the add-on, and what the reports say of it."""

import math

import bmesh
import bpy
import numpy as np
import pytest
from maps import flipped, in_square, overlapping_pairs, signed_areas, triangles
from scene import add_grid, add_object, edit, snapshot
from seamwire.core.islands import rounded_flips
from seamwire.mesh import unwrap as unwrapping
from seamwire.mesh import uv_map


def add_torus() -> None:
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=8)


SHAPES = {
    "cube": bpy.ops.mesh.primitive_cube_add,
    "cylinder": bpy.ops.mesh.primitive_cylinder_add,
    "torus": add_torus,
    "ball": lambda: bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8),
}


def add_shape(name: str) -> bpy.types.Object:
    """Add one of the shapes without seams and without a UV map, in edit mode."""
    SHAPES[name]()
    obj = bpy.context.active_object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    edit()
    return obj


def unwrap(**options: object) -> set[str]:
    return bpy.ops.mesh.seamwire_unwrap(**options)


@pytest.mark.every_blender
@pytest.mark.parametrize("shape", SHAPES)
def test_a_closed_mesh_of_polygons_without_seams_gets_a_valid_map(
    shape: str, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = add_shape(shape)
    assert unwrap() == {"FINISHED"}
    assert (flipped(obj), overlapping_pairs(obj), in_square(obj)) == (0, 0, True)
    assert "Info: 1 island unwrapped, 0 kept\n" in capfd.readouterr().out


@pytest.mark.parametrize("shape", SHAPES)
def test_a_single_seam_anywhere_leaves_the_map_valid(shape: str) -> None:
    obj = add_shape(shape)
    bm = bmesh.from_edit_mesh(obj.data)
    wrong = []
    for number in range(0, len(bm.edges), 1 if len(bm.edges) < 50 else 5):
        while obj.data.uv_layers:
            obj.data.uv_layers.remove(obj.data.uv_layers[0])
        for edge in bmesh.from_edit_mesh(obj.data).edges:
            edge.seam = edge.index == number
        assert unwrap(changed_only=False) == {"FINISHED"}
        found = flipped(obj), overlapping_pairs(obj)
        if any(found):
            wrong.append((number, *found))
    assert wrong == []
