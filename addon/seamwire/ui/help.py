# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel with the first steps and all keys: a popover of the tool's header, and what F1 shows."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import preferences
from ..operators import navigation
from ..operators.bindings import HELP_PANEL
from ..words.first_steps import STEPS, guide


class VIEW3D_PT_seamwire_help(bpy.types.Panel):
    """First steps, and all keys"""  # noqa: D400 - a tooltip

    bl_idname = HELP_PANEL
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_label = "Seamwire Help"
    bl_ui_units_x = 44

    def draw(self, context: bpy.types.Context) -> None:
        """Show the first steps and the guide, and below them the keys in two columns."""
        columns = self.layout.split(factor=0.55)
        left, right = columns.column(), columns.column()
        steps = _box(left, "First Steps")
        for icon, text in STEPS:
            steps.label(text=text, icon=icon)
        more = _box(right, "More")
        more.prop(preferences(context), "text")
        if guide():
            more.operator("wm.url_open", text="Open the Guide", icon="URL").url = guide()
        for number, (heading, rows) in enumerate(navigation.keys(context).groups().items()):
            column = _box(left if number < 2 else right, heading)
            for keys, action in rows:
                row = column.split(factor=0.32 if number < 2 else 0.5)
                row.label(text=keys)
                row.label(text=action)


def _box(layout: bpy.types.UILayout, heading: str) -> bpy.types.UILayout:
    """Return a column in a box below a heading."""
    column = layout.box().column(align=True)
    column.label(text=heading)
    column.separator()
    return column


register, unregister = together(*classes(VIEW3D_PT_seamwire_help))
