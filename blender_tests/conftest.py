# SPDX-License-Identifier: GPL-3.0-or-later
"""What every test in Blender starts from."""

from collections.abc import Iterator

import bpy
import pytest
from lab import disable_lab, enable_lab, part

MARKERS = {
    "every_blender": "runs in every Blender, because its outcome can differ between Blender's versions.",
    "oldest_and_newest": "runs in the oldest and the newest Blender only: it compares pixels, plays at random, or kills Blender.",
    "smoke": "is one of the window tests of the default run: it covers one operator or gesture.",
}


def pytest_configure(config: pytest.Config) -> None:
    """Register the markers; ``run.py`` has pytest refuse others."""
    for name, meaning in MARKERS.items():
        config.addinivalue_line("markers", f"{name}: {meaning}")


@pytest.fixture(autouse=True)
def empty_scene() -> None:
    """Start every test in object mode, in a scene without objects, with vertices to be selected."""
    if bpy.context.view_layer.objects.active is not None and bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)


@pytest.fixture
def lab_settings() -> Iterator[bpy.types.PropertyGroup]:
    """Enable Seamwire Lab, and return its settings."""
    enable_lab()
    yield part("lab_settings").settings()
    disable_lab()
