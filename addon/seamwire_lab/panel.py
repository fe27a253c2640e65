# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of Object Mode and Edit Mode."""

from __future__ import annotations

import bpy

from . import tool
from .follower import follower
from .lab_settings import LINES, settings
from .store_fields import ITEMS, OPERATOR


class VIEW3D_PT_seamwire_lab(bpy.types.Panel):
    """Views of the metric on the active object"""  # noqa: D400 - a tooltip

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Seamwire Lab"
    bl_label = "Views"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether a mesh is active, in Object Mode or Edit Mode."""
        obj = context.active_object
        return obj is not None and obj.type == "MESH" and obj.mode in {"OBJECT", "EDIT"}

    def draw(self, context: bpy.types.Context) -> None:
        """Show the views. In Object Mode, show the tool's settings too, because they decide what is seen."""
        layout, chosen = self.layout, settings()
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(chosen, "heat")
        column = layout.column(heading="Show")
        for name in LINES:
            column.prop(chosen, name)
        layout.prop(chosen, "shown_metric")
        if context.mode == "OBJECT":
            of_tool = tool.settings(context)
            layout.prop(of_tool, "along")
            layout.prop(of_tool, tool.strength_name(follower.along))
            layout.prop(of_tool, "metric")
        layout.menu(VIEW3D_MT_seamwire_lab_store.bl_idname)


class VIEW3D_MT_seamwire_lab_store(bpy.types.Menu):
    """Store a view as an attribute of the vertices"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_lab_store"
    bl_label = "Store View as Attribute"

    def draw(self, _context: bpy.types.Context) -> None:
        """Show the views that can be stored."""
        for view, name, *_ in ITEMS:
            self.layout.operator(OPERATOR, text=name).view = view


register, unregister = bpy.utils.register_classes_factory((VIEW3D_MT_seamwire_lab_store, VIEW3D_PT_seamwire_lab))
