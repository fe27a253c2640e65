# SPDX-License-Identifier: GPL-3.0-or-later
"""Highlights the edge or vertex that a click would pick, while no operator runs.

Blender asks a gizmo of the tool at each motion of the mouse. In views without gizmos, an operator in the tool's keymap
receives the motion and ends at once.
"""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import tool_is_active
from .chain_state import running

GROUP = "SEAMWIRE_GGT_hover"
OPERATOR = "mesh.seamwire_hover"
_NOWHERE = -1


def _hover(context: bpy.types.Context, location: tuple[int, int]) -> None:
    # Imported only when the tool is used, so that Blender's start does not wait for NumPy.
    from ..view.edited_objects import edited
    from ..view.viewport import place_in

    if not running:
        edited.hover(place_in(context.area, context.region, location))


class MESH_OT_seamwire_hover(bpy.types.Operator):
    """Highlight the edge or vertex under the mouse in views without gizmos"""  # noqa: D400 - a tooltip

    bl_idname = OPERATOR
    bl_label = "Seamwire Hover"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the mouse is over such a view and the tool is active."""
        space = context.space_data
        hidden = space is not None and space.type == "VIEW_3D" and not (space.show_gizmo and space.show_gizmo_tool)
        return hidden and tool_is_active(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Receive the motion of the mouse."""
        _hover(context, (event.mouse_region_x, event.mouse_region_y))
        return {"PASS_THROUGH"}


class SEAMWIRE_GT_hover(bpy.types.Gizmo):
    """Receives the position of the mouse. It is invisible and cannot be grabbed."""

    bl_idname = "SEAMWIRE_GT_hover"

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw nothing, because the overlay draws the highlight."""

    def test_select(self, context: bpy.types.Context, location: tuple[int, int]) -> int:
        """Receive the position of the mouse, and return that no gizmo is there."""
        if context.area is not None and context.area.type == "VIEW_3D":
            _hover(context, location)
        return _NOWHERE


class SEAMWIRE_GGT_hover(bpy.types.GizmoGroup):
    """The gizmo of the tool."""

    bl_idname = GROUP
    bl_label = "Seamwire Hover"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the tool is active in Edit Mode."""
        return tool_is_active(context)

    def setup(self, _context: bpy.types.Context) -> None:
        """Create the gizmo."""
        self.gizmos.new(SEAMWIRE_GT_hover.bl_idname)


register, unregister = together(*classes(MESH_OT_seamwire_hover, SEAMWIRE_GT_hover, SEAMWIRE_GGT_hover))
