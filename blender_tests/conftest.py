# SPDX-License-Identifier: GPL-3.0-or-later
"""What every test in Blender starts from."""

import bpy
import pytest


@pytest.fixture(autouse=True)
def empty_scene() -> None:
    """Start every test in object mode in a scene without objects."""
    if bpy.context.view_layer.objects.active is not None and bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
