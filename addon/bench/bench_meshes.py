# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that benchmarks are given: files, or ``suzanne+N``, Blender's monkey subdivided N times."""

from pathlib import Path

import bpy

IMPORTERS = {
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".ply": lambda path: bpy.ops.import_mesh.ply(filepath=path),
    ".stl": lambda path: bpy.ops.import_mesh.stl(filepath=path),
}


def load(name: str) -> bpy.types.Object:
    """Add what is named to the scene."""
    if not name.startswith("suzanne+"):
        IMPORTERS[Path(name).suffix.lower()](name)
        return bpy.context.selected_objects[0]
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = int(name.split("+")[1])
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj
