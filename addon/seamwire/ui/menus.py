# SPDX-License-Identifier: GPL-3.0-or-later
"""The Seamwire submenus in Blender's menus, the entry for the tool in the context menu, and the panel of help."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import ClassVar

import bpy

from ..mesh.registration import classes, menu_entry, together
from ..mesh.settings import TOOL, preferences, settings
from ..operators import keymaps
from ..operators.edit_mesh_operator import NeedsEditMode
from ..operators.island_operators import ISLAND_ITEMS
from ..operators.keymaps import HELP_PANEL
from ..terms.options import SETTINGS
from ..words.corner import STEPS
from .toolbar import VIEWS

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "IMAGE_MT_uvs")
"""Blender's menus that have the submenu."""
CONTEXT_MENU = "VIEW3D_MT_edit_mesh_context_menu"
"""Blender's menu that has only the entry for the tool."""


class VIEW3D_MT_seamwire(bpy.types.Menu):
    """Draw UV seams, or let Seamwire suggest them"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire"
    bl_label = "Seamwire"

    def draw(self, _context: bpy.types.Context) -> None:
        """Show what artists need most, and the submenus for everything else."""
        layout = self.layout
        layout.operator("mesh.seamwire_choose_tool")
        layout.operator("mesh.seamwire_suggest")
        layout.operator("mesh.seamwire_close_gaps")
        layout.operator("mesh.seamwire_unwrap")
        layout.separator()
        for menu in SUBMENUS:
            layout.menu(menu)


class VIEW3D_MT_seamwire_finish(bpy.types.Menu):
    """Make seams run exactly where wires across the surface run"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_finish"
    bl_label = "Finish"

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.operator_enum("mesh.seamwire_finish", "finish")


class VIEW3D_MT_seamwire_network(bpy.types.Menu):
    """Turn seams into wires, or save, load, transfer and repeat wires"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_network"
    bl_label = "Network"

    def draw(self, _context: bpy.types.Context) -> None:
        """Show what is done with all wires of a mesh. Seamwire Networks adds its entries."""
        self.layout.operator("mesh.seamwire_take_over", text="From Seams")
        if not hasattr(bpy.types, "MESH_OT_seamwire_transfer"):
            self.layout.label(
                text="To save, load, transfer and repeat wires, enable Seamwire Networks in the preferences"
            )


class VIEW3D_MT_seamwire_islands(bpy.types.Menu):
    """Select or store the islands that seams make"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_islands"
    bl_label = "Islands"

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        for which, text in (("TO_CUT", "Select Islands to Cut"), ("WORST", "Select Worst Stretched Island")):
            layout.operator("mesh.seamwire_select_islands", text=text).which = which
        layout.separator()
        for what, name, *_ in ISLAND_ITEMS:
            layout.operator("mesh.seamwire_store", text=f"Store as {name}").what = what


class VIEW3D_MT_seamwire_views(bpy.types.Menu):
    """Choose what to show over the mesh"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_views"
    bl_label = "Views"

    def draw(self, context: bpy.types.Context) -> None:
        layout, chosen = self.layout, settings(context)
        for name, setting in SETTINGS.items():
            if setting.group == VIEWS:
                (layout.prop if setting.choices is None else layout.prop_menu_enum)(chosen, name)


SUBMENUS = (
    "VIEW3D_MT_seamwire_finish",
    "VIEW3D_MT_seamwire_network",
    "VIEW3D_MT_seamwire_islands",
    "VIEW3D_MT_seamwire_views",
)


class MESH_OT_seamwire_choose_tool(NeedsEditMode, bpy.types.Operator):
    """Draw UV seams that follow the shape of the mesh: choose the tool"""  # noqa: D400 - a tooltip

    # Blender indents `wm.tool_set_by_id` differently in menus, as it does buttons in the toolbar.
    bl_idname = "mesh.seamwire_choose_tool"
    bl_label = "Draw Seamwires"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    def execute(self, _context: bpy.types.Context) -> set[str]:
        return bpy.ops.wm.tool_set_by_id(name=TOOL, space_type="VIEW_3D")


def _draw_submenu(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.menu(VIEW3D_MT_seamwire.bl_idname)


def _draw_entry(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.operator(MESH_OT_seamwire_choose_tool.bl_idname)


_GUIDES = ("guide/index.md", "../../docs/guide/index.md")
"""Where the guide lies, in a package and in a checkout."""


@cache
def guide() -> str:
    """Return the address of the guide; an empty string if it is missing."""
    here = Path(__file__).parents[1]
    found = next((path.resolve() for place in _GUIDES if (path := here / place).is_file()), None)
    return "" if found is None else found.as_uri()


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
        for number, (heading, rows) in enumerate(keymaps.keys(context).groups().items()):
            column = _box(left if number < 2 else right, heading)
            for keys, action in rows:
                row = column.split(factor=0.32 if number < 2 else 0.5)
                row.label(text=keys)
                row.label(text=action)


def _box(layout: bpy.types.UILayout, heading: str) -> bpy.types.UILayout:
    column = layout.box().column(align=True)
    column.label(text=heading)
    column.separator()
    return column


register, unregister = together(
    *classes(VIEW3D_MT_seamwire, VIEW3D_MT_seamwire_finish, VIEW3D_MT_seamwire_network),
    *classes(VIEW3D_MT_seamwire_islands, VIEW3D_MT_seamwire_views),
    *classes(VIEW3D_PT_seamwire_help, MESH_OT_seamwire_choose_tool),
    *(menu_entry(name, _draw_submenu) for name in MENUS),
    menu_entry(CONTEXT_MENU, _draw_entry),
)
