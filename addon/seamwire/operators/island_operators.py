# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that select islands, store them with the mesh, and unwrap them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
from mathutils import Vector

from ..mesh.registration import classes, together
from ..mesh.settings import settings
from ..terms.choices import STRETCHES, items
from ..words.reports import count, in_words, square_used
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
        self.layout.use_property_split = True
        for name in ("which", "kind") if self.which == "WORST" else ("which",):
            self.layout.prop(self, name)

    def run(self, context: bpy.types.Context) -> set[str]:
        """Select them. The stretch is the operator's own if it was given, otherwise the one that the tool shows."""
        if self.which == "TO_CUT":
            return self._select_islands_to_cut(context)
        is_given = self.properties.is_property_set("kind")
        # It is set in any case, so that Repeat Last measures the same.
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
        told = f"{count(len(missing), 'island')} to cut: {count(sum(missing), 'more cut')} needed"
        self.report({"INFO"}, told if missing else "No island needs another cut")
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
        from ..mesh.uv_islands import store

        with changing():
            found = self.for_each_object(context, lambda obj: store(obj, self.what))
        if not found:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(sum(found.values()), 'island')} stored")
        return {"FINISHED"}


class MESH_OT_seamwire_unwrap(EditMeshOperator, bpy.types.Operator):
    """Unwrap the islands whose seams have changed. All other UVs stay in place"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_unwrap"
    bl_label = "Unwrap Changed Islands"
    ends_chain = True

    method: bpy.props.EnumProperty(
        name="Method",
        description="How to flatten islands",
        items=(
            (
                "SEAMWIRE",
                "Symmetric Dirichlet",
                "Little stretch in angles and areas, without flipped faces or overlaps. Islands with pins use Angle Based",
            ),
            ("ANGLE_BASED", "Angle Based", "Blender's method for organic shapes. Preserves angles"),
            ("CONFORMAL", "Conformal", "Blender's faster method. Preserves angles"),
        ),
    )
    straight: bpy.props.BoolProperty(
        name="Straight Strips",
        description="Lay strips and rectangles of quads out straight and along the axes, if that hardly stretches them",
        default=True,
    )
    upright: bpy.props.BoolProperty(
        name="Upright",
        description="Turn new islands so that the object's Z axis points up. A quarter turn is made where it saves "
        "space. Otherwise islands lie in any direction that saves space",
        default=True,
    )
    stack: bpy.props.BoolProperty(
        name="Stack Copies",
        description="Lay new islands of the same shape on each other, mirrored ones too, so that they share the texture",
        default=False,
    )
    changed_only: bpy.props.BoolProperty(
        name="Changed Only", description="Keep the UVs of islands with unchanged seams", default=True
    )

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        own = ("straight", "upright", "stack") if self.method == "SEAMWIRE" else ()
        for name in ("method", *own, "changed_only"):
            self.layout.prop(self, name)

    def run(self, context: bpy.types.Context) -> set[str]:
        from ..core.islands.uv_maps import square_use
        from ..mesh.unwrap import Layout, unwrap_changed
        from ..mesh.uv_islands import maps_of

        layout = Layout(self.straight, self.upright, self.stack)
        done = unwrap_changed(context, method=self.method, layout=layout, every=not self.changed_only)
        for problem in done.problems:
            self.report({"WARNING"}, problem)
        if not done.islands:
            self.report({"INFO"}, "Nothing to unwrap: no island has changed")
            return {"CANCELLED"}
        parts = [f"{count(done.islands, 'island')} unwrapped", f"{done.kept} kept", *in_words(done.faults)]
        if done.unmapped:
            has = "hidden face has no place", "hidden faces have no place"
            parts.append(f"{count(done.unmapped, *has)} in the map")
        with changing():
            parts.append(square_used(square_use([*maps_of(done.objects).values()])))
        self.report({"WARNING"} if done.faults or done.unmapped else {"INFO"}, ", ".join(parts))
        return {"FINISHED"}


register, unregister = together(
    *classes(MESH_OT_seamwire_select_islands, MESH_OT_seamwire_store, MESH_OT_seamwire_unwrap)
)
