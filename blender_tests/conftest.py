# SPDX-License-Identifier: GPL-3.0-or-later
"""What every test in Blender starts from."""

import bpy
import pytest


def pytest_configure(config: pytest.Config) -> None:
    """Register the markers that choose what runs where."""
    config.addinivalue_line("markers", "every_blender: can differ between Blender versions; runs in every Blender")
    config.addinivalue_line("markers", "smoke: covers one operator or gesture; part of the default run with a window")
    config.addinivalue_line(
        "markers",
        "oldest_and_newest: pixels, random events and killed processes; runs in the oldest and the newest Blender",
    )


@pytest.fixture(autouse=True)
def empty_scene() -> None:
    """Start every test in object mode in a scene without objects."""
    if bpy.context.view_layer.objects.active is not None and bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
