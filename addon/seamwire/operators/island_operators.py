# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that select islands and store them with the mesh."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
from mathutils import Vector

from ..mesh.registration import classes, together
from ..mesh.settings import settings
from ..terms.choices import STRETCHES, items
from ..words.reports import count
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item

if TYPE_CHECKING:
    from collections.abc import Sequence


OPERATOR = "mesh.seamwire_select_islands"
_SEEN = math.radians(60.0)
"""An island that is turned less from the viewer is seen well enough."""
_FACES = 0.2
"""Below this length of the mean normal, an island has no clear front. A closed island has length 0."""


class MESH_OT_seamwire_select_islands(EditMeshOperator, bpy.types.Operator):
    """Select the islands that need work"""  # noqa: D400 - a tooltip

    bl_idname = OPERATOR
    bl_label = "Select Islands"

    which: bpy.props.EnumProperty(
        name="Which",
        description="Islands to select",
        items=(
            (
                "TO_CUT",
                "Islands to Cut",
                "Islands that cannot lie flat yet: closed ones, tubes, and those with handles",
            ),
            ("WORST", "Worst Stretched Island", "The island that the UV map stretches most. The view turns to it"),
        ),
    )
    kind: bpy.props.EnumProperty(
        name="Stretch",
        description="Kind of stretch; if not given, the one that the tool shows, or angles",
        items=items(STRETCHES),
        options={"SKIP_SAVE"},
    )

    description = description_of_item("which")

    def draw(self, _context: bpy.types.Context) -> None:
        """Show the settings that count."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "which")
        if self.which == "WORST":
            layout.prop(self, "kind")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Select them. The stretch is the operator's own if it was given, otherwise the one that the tool shows."""
        if self.which == "TO_CUT":
            return self._select_islands_to_cut(context)
        is_given = self.properties.is_property_set("kind")
        self.kind = "AREA" if not is_given and settings(context).heat == "AREA" else self.kind
        return self._select_worst_island(context)

    def _select_islands_to_cut(self, context: bpy.types.Context) -> set[str]:
        from ..mesh import edit_mesh
        from ..mesh.uv_islands import faces_to_cut

        found = self.for_each_object(context, faces_to_cut)
        if not found:
            return {"CANCELLED"}
        bpy.ops.mesh.select_all(action="DESELECT")
        for obj, (faces, _) in found.items():
            edit_mesh.select_faces(obj, faces)
        missing = [int(cuts) for _, cuts_of in found.values() for cuts in cuts_of]
        if missing:
            self.report({"INFO"}, f"{count(len(missing), 'island')} to cut: {count(sum(missing), 'more cut')} needed")
        else:
            self.report({"INFO"}, "No island needs another cut")
        return {"FINISHED"}

    def _select_worst_island(self, context: bpy.types.Context) -> set[str]:
        from ..mesh import edit_mesh
        from ..mesh.uv_islands import worst_island

        found = self.for_each_object(context, lambda obj: worst_island(obj, self.kind))
        if not found:
            return {"CANCELLED"}
        with_uvs = {obj: worst for obj, worst in found.items() if worst is not None}
        if not with_uvs:
            raise ValueError("No visible face has UVs: unwrap first")
        obj, worst = max(with_uvs.items(), key=lambda one: one[1].value)
        bpy.ops.mesh.select_all(action="DESELECT")
        edit_mesh.select_faces(obj, worst.faces)
        if context.area is not None and context.area.type == "VIEW_3D" and context.region.type == "WINDOW":
            _turn(context.region_data, obj, worst.facing)
            bpy.ops.view3d.view_selected("INVOKE_DEFAULT")
        self.report({"INFO"}, f"{obj.name}: stretched {2.0**worst.value:.2f} times, worst of {worst.count} islands")
        return {"FINISHED"}


def _turn(view: bpy.types.RegionView3D, obj: bpy.types.Object, facing: Sequence[float]) -> None:
    """Turn a view towards faces, unless they are seen well already or face in all directions alike."""
    normal = obj.matrix_world.to_3x3().inverted_safe().transposed() @ Vector(facing)
    if view.lock_rotation or Vector(facing).length < _FACES or normal.length == 0.0:
        return
    if normal.angle(view.view_rotation @ Vector((0.0, 0.0, 1.0))) > _SEEN:
        view.is_orthographic_side_view = False
        view.view_rotation = normal.to_track_quat("Z", "Y")


ISLAND_ITEMS = (
    ("ATTRIBUTE", "Face Attribute", "Numbers from 0 in the attribute 'island', the largest island first", 0),
    ("MATERIALS", "Materials", "Up to twelve materials in new slots, so that neighbors differ", 2),
)


class MESH_OT_seamwire_store(EditMeshOperator, bpy.types.Operator):
    """Store islands with the mesh, for shaders, geometry nodes and other add-ons"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store"
    bl_label = "Store Islands"

    what: bpy.props.EnumProperty(
        name="Store", description="How to store the islands that seams make", items=ISLAND_ITEMS
    )
    description = description_of_item("what")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Store the islands of all objects in Edit Mode."""
        from ..mesh.uv_islands import store

        with changing():
            found = self.for_each_object(context, lambda obj: store(obj, self.what))
        if not found:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(sum(found.values()), 'island')} stored")
        return {"FINISHED"}


register, unregister = together(*classes(MESH_OT_seamwire_select_islands, MESH_OT_seamwire_store))
