# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that marks seams as sharp, creased, beveled or Freestyle edges as well."""

from __future__ import annotations

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item


class MESH_OT_seamwire_mark_seams_as(EditMeshOperator, bpy.types.Operator):
    """Mark the visible seams as sharp, creased, beveled or Freestyle edges as well"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_mark_seams_as"
    bl_label = "Mark Seams As"

    kind: bpy.props.EnumProperty(
        name="As",
        description="Additional mark for seams",
        items=(
            ("SHARP", "Sharp", "Edges that shading does not smooth"),
            ("CREASE", "Crease", "Edges that subdivision keeps, with weight 1"),
            ("BEVEL", "Bevel Weight", "Edges that the bevel modifier bevels, with weight 1"),
            ("FREESTYLE", "Freestyle Edge", "Edges that Freestyle can draw"),
        ),
    )

    description = description_of_item("kind")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Mark the seams of all objects in Edit Mode."""
        from ..mesh.edge_marks import copy_seams

        with changing():
            marked = copy_seams(list(context.objects_in_mode_unique_data), self.kind)
        if not marked:
            self.report({"WARNING"}, "No visible seams to mark")
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(marked, 'edge')} marked")
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_mark_seams_as,))
