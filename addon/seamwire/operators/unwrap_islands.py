# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that unwraps the islands whose seams have changed."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..words.reports import count, in_words, square_used
from .steps import AfterChain


class MESH_OT_seamwire_unwrap(AfterChain, bpy.types.Operator):
    """Unwrap the islands whose seams have changed. All other UVs stay in place"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_unwrap"
    bl_label = "Unwrap Changed Islands"

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
        """Show the settings that have an effect."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "method")
        if self.method == "SEAMWIRE":
            layout.prop(self, "straight")
            layout.prop(self, "upright")
            layout.prop(self, "stack")
        layout.prop(self, "changed_only")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Unwrap, and report the number of islands."""
        from ..core.islands.uv_maps import square_use
        from ..mesh.unwrap import Layout, unwrap_changed
        from ..mesh.uv_islands import maps_of
        from .edit_mesh_operator import changing

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


register, unregister = together(*classes(MESH_OT_seamwire_unwrap))
