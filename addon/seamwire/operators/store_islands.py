# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that stores islands with the mesh, for shaders, geometry nodes and other add-ons."""

from __future__ import annotations

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item

ISLAND_ITEMS = (
    ("ATTRIBUTE", "Face Attribute", "Numbers from 0 in the attribute 'island', the largest island first", 0),
    ("MATERIALS", "Materials", "Up to twelve materials in new slots, so that neighbors differ", 2),
)


class MESH_OT_seamwire_store(EditMeshOperator, bpy.types.Operator):
    """Store islands with the mesh, for shaders, geometry nodes and other add-ons"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store"
    bl_label = "Store Islands"

    what: bpy.props.EnumProperty(
        name="Store",
        description="How to store the islands that seams make",
        items=ISLAND_ITEMS,
    )
    description = description_of_item("what")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Store the islands of all objects in Edit Mode."""
        from ..mesh.seam_islands import store

        with changing():
            found = self.for_each_object(context, lambda obj: store(obj, self.what))
        if not found:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(sum(found.values()), 'island')} stored")
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_store,))
