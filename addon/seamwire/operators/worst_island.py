# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that shows the island which the UV map stretches most."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
from mathutils import Vector

from ..mesh.settings import STRETCH_ITEMS, settings
from .report import for_each_object, in_edit_mode

if TYPE_CHECKING:
    from collections.abc import Sequence

OPERATOR = "mesh.seamwire_worst_island"
_SEEN = math.radians(60.0)
"""An island that is turned less from the viewer is seen well enough."""
_FACES = 0.2
"""Below this length of the mean normal, an island has no clear front. A closed island has length 0."""


class MESH_OT_seamwire_worst_island(bpy.types.Operator):
    """Select the island that the active UV map stretches most, and turn and move the view there"""  # noqa: D400 - a tooltip

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
            _turn(context.region_data, obj, worst.facing)
            bpy.ops.view3d.view_selected("INVOKE_DEFAULT")
        self.report({"INFO"}, f"{obj.name}: stretched {2.0**worst.value:.2f} times, worst of {worst.count} islands")
        return {"FINISHED"}


def _turn(view: bpy.types.RegionView3D, obj: bpy.types.Object, facing: Sequence[float]) -> None:
    """Turn a view so that the viewer looks at what faces a way, unless it is seen well already or faces all ways alike."""
    normal = obj.matrix_world.to_3x3().inverted_safe().transposed() @ Vector(facing)
    if view.lock_rotation or Vector(facing).length < _FACES or normal.length == 0.0:
        return
    if normal.angle(view.view_rotation @ Vector((0.0, 0.0, 1.0))) > _SEEN:
        view.is_orthographic_side_view = False
        view.view_rotation = normal.to_track_quat("Z", "Y")


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_worst_island)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_worst_island)
