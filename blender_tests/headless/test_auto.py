# SPDX-License-Identifier: GPL-3.0-or-later
"""The values that Auto stands for on an object."""

import random
from collections.abc import Callable

import bpy
import pytest
from scene import edit
from seamwire.mesh.object_session import ObjectSession
from seamwire.terms.options import PLACED, SCANNED, Auto


@pytest.fixture
def scan() -> bpy.types.Object:
    """A rough ball of 5,120 triangles, without UVs."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, calc_uvs=False)
    obj = bpy.context.active_object
    dice = random.Random(3)
    for v in obj.data.vertices:
        v.co *= 1.0 + 0.03 * dice.random()
    return obj


def auto(obj: bpy.types.Object) -> Auto:
    edit()
    return ObjectSession(obj).find_auto()


def add_keys(obj: bpy.types.Object) -> None:
    obj.shape_key_add(name="Basis")


def add_group(obj: bpy.types.Object) -> None:
    obj.vertex_groups.new(name="Bone")


@pytest.mark.every_blender
@pytest.mark.parametrize("rig", [None, add_keys, add_group])
def test_a_scan_is_cut_unless_it_is_rigged(
    rig: Callable[[bpy.types.Object], None] | None, scan: bpy.types.Object
) -> None:
    if rig is not None:
        rig(scan)
    assert auto(scan) == (SCANNED if rig is None else PLACED)
