# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators on the islands that seams make: select those that do not unwrap yet, store all of them."""

from __future__ import annotations

import bpy

from .report import count, for_each_object, in_edit_mode


class MESH_OT_seamwire_select_islands_to_cut(bpy.types.Operator):
    """Select the islands that are no discs: they do not unwrap without another cut"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_select_islands_to_cut"
    bl_label = "Select Islands to Cut"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select their faces, and nothing else."""
        from ..mesh import edit_mesh
        from ..mesh.seam_islands import faces_to_cut

        found = for_each_object(self, context, faces_to_cut)
        if not found:
            return {"CANCELLED"}
        bpy.ops.mesh.select_all(action="DESELECT")
        for obj, (faces, _) in found.items():
            edit_mesh.select_faces(obj, faces)
        missing = [int(cuts) for _, cuts_of in found.values() for cuts in cuts_of]
        if missing:
            self.report({"INFO"}, f"{count(len(missing), 'island')} to cut: {count(sum(missing), 'more cut')} needed")
        else:
            self.report({"INFO"}, "All islands are discs")
        return {"FINISHED"}


class MESH_OT_seamwire_store_islands(bpy.types.Operator):
    """Store the islands that seams make as a face attribute, face sets or materials"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store_islands"
    bl_label = "Store Islands"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(
        name="As",
        description="What islands are stored as",
        items=(
            ("ATTRIBUTE", "Face Attribute", "Numbers from 0, the largest island first, in the attribute 'island'"),
            ("FACE_SETS", "Face Sets", "Those of Sculpt Mode"),
            ("MATERIALS", "Materials", "Up to twelve, so that neighbors differ, in new slots"),
        ),
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Store those of all objects in edit mode."""
        from ..mesh.seam_islands import store

        if self.kind == "FACE_SETS" and bpy.app.version < (3, 6, 0):
            self.report({"ERROR"}, "Face sets can be stored from Blender 3.6 on")
            return {"CANCELLED"}
        found = for_each_object(self, context, lambda obj: store(obj, self.kind))
        if not found:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(sum(found.values()), 'island')} stored")
        return {"FINISHED"}


def register() -> None:
    """Add the operators."""
    bpy.utils.register_class(MESH_OT_seamwire_select_islands_to_cut)
    bpy.utils.register_class(MESH_OT_seamwire_store_islands)


def unregister() -> None:
    """Remove them."""
    bpy.utils.unregister_class(MESH_OT_seamwire_store_islands)
    bpy.utils.unregister_class(MESH_OT_seamwire_select_islands_to_cut)
