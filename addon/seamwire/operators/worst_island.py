# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that shows the island which the UV map stretches most."""

from __future__ import annotations

import bpy

from ..mesh.settings import STRETCH_ITEMS, settings
from .report import for_each_object, in_edit_mode

OPERATOR = "mesh.seamwire_worst_island"


class MESH_OT_seamwire_worst_island(bpy.types.Operator):
    """Select the island that the active UV map stretches most, and move the view there"""  # noqa: D400 - a tooltip

    bl_idname = OPERATOR
    bl_label = "Select Worst Stretched Island"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(
        name="Stretch",
        description="What counts; where not given, what the tool shows, or else angles",
        items=STRETCH_ITEMS,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select it, of all objects in edit mode, in the user's select mode."""
        from ..mesh import edit_mesh
        from ..mesh.seam_islands import worst_island

        if not self.properties.is_property_set("kind") and settings(context).heat == "AREA":
            self.kind = "AREA"
        found = for_each_object(self, context, lambda obj: worst_island(obj, self.kind))
        if not found:
            return {"CANCELLED"}
        with_uvs = {obj: worst for obj, worst in found.items() if worst is not None}
        if not with_uvs:
            self.report({"ERROR"}, "No visible face has UVs: unwrap first")
            return {"CANCELLED"}
        obj, worst = max(with_uvs.items(), key=lambda one: one[1].value)
        bpy.ops.mesh.select_all(action="DESELECT")
        edit_mesh.select_faces(obj, worst.faces)
        if context.area is not None and context.area.type == "VIEW_3D" and context.region.type == "WINDOW":
            bpy.ops.view3d.view_selected("INVOKE_DEFAULT")
        self.report({"INFO"}, f"{obj.name}: stretched {2.0**worst.value:.2f} times, worst of {worst.count} islands")
        return {"FINISHED"}


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_worst_island)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_worst_island)
