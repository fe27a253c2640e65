# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click would take lights up while no operator runs: Blender asks a gizmo of the tool at each motion of the mouse."""

from __future__ import annotations

import traceback

import bpy

from ..mesh.settings import tool_is_active
from .report import running

GROUP = "SEAMWIRE_GGT_hover"
_NOWHERE = -1


class SEAMWIRE_GT_hover(bpy.types.Gizmo):
    """Nothing to be seen or taken hold of; it hears where the mouse is."""

    bl_idname = "SEAMWIRE_GT_hover"

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw nothing: the overlay does."""

    def test_select(self, context: bpy.types.Context, location: tuple[int, int]) -> int:
        """Hear of the mouse, and be no gizmo under it."""
        # Not before the tool is used: Blender's start is not to wait for NumPy.
        from ..view.edited_objects import edited
        from ..view.viewport import place_in

        if running or context.area is None or context.area.type != "VIEW_3D":
            return _NOWHERE
        try:
            edited.hover(place_in(context.area, context.region, location))
        except Exception:
            # A gizmo that raises is asked again at each motion.
            traceback.print_exc()
            edited.pause()
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
        """Whether the tool is active in edit mode."""
        return tool_is_active(context)

    def setup(self, _context: bpy.types.Context) -> None:
        """Make it."""
        self.gizmos.new(SEAMWIRE_GT_hover.bl_idname)


_CLASSES = (SEAMWIRE_GT_hover, SEAMWIRE_GGT_hover)


def register() -> None:
    """Add the gizmo's types."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Remove them."""
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
