# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that unwraps the islands whose seams have changed."""

from __future__ import annotations

import bpy

from ..mesh.settings import settings
from ..words.names import count
from .edit_mesh_operator import EditMeshOperator


class MESH_OT_seamwire_unwrap(EditMeshOperator, bpy.types.Operator):
    """Unwrap the islands whose seams have changed since they were unwrapped; all other UVs stay as they are"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_unwrap"
    bl_label = "Unwrap Changed Islands"

    method: bpy.props.EnumProperty(
        name="Method",
        description="How islands are flattened",
        items=(
            (
                "SEAMWIRE",
                "Symmetric Dirichlet",
                "Stretch as little as possible, in angles and areas: no flipped faces, no overlaps. Islands with pins: Angle Based",
            ),
            ("ANGLE_BASED", "Angle Based", "Blender's unwrap: keep angles, good for organic shapes"),
            ("CONFORMAL", "Conformal", "Blender's unwrap: keep angles, faster"),
        ),
    )
    changed_only: bpy.props.BoolProperty(
        name="Changed Only", description="Keep the UVs of islands whose seams have not changed", default=True
    )

    def run(self, context: bpy.types.Context) -> set[str]:
        """Unwrap, and say how many islands."""
        from ..mesh.unwrap import unwrap_changed

        done = unwrap_changed(context, method=self.method, every=not self.changed_only)
        if not done.islands:
            self.report({"INFO"}, "No island has changed since it was unwrapped")
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(done.islands, 'island')} unwrapped, {done.kept} kept")
        return {"FINISHED"}


def unwrap_after_chain(context: bpy.types.Context) -> str:
    """Unwrap as the tool and Blender are set, after seams have changed; return what could not be done, in words."""
    if not settings(context).unwrap:
        from ..mesh import edit_mesh

        edit_mesh.live_unwrap(context)
        return ""
    from ..core.base.native import NativeError
    from ..mesh.unwrap import unwrap_changed

    try:
        unwrap_changed(context)
    except (ValueError, NativeError) as error:
        return str(error)
    return ""


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_unwrap,))
