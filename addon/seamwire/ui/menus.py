# SPDX-License-Identifier: GPL-3.0-or-later
"""The Seamwire submenus in Blender's menus, the entry for the tool in the context menu, and the panel of help."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import bpy

from ..mesh.registration import classes, menu_entry, together
from ..mesh.settings import TOOL, preferences, settings
from ..operators.island_operators import ISLAND_ITEMS
from ..terms.options import SETTINGS
from ..tool import keymaps
from ..tool.keymaps import HELP_PANEL
from ..tool.running import NeedsEditMode
from ..words.hints import STEPS
from .toolbar import VIEWS

if TYPE_CHECKING:
    from ..mesh.registration import Change

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "IMAGE_MT_uvs")
"""Blender's menus that have the submenu."""
CONTEXT_MENU = "VIEW3D_MT_edit_mesh_context_menu"
"""Blender's menu that has only the entry for the tool."""


def _draw_all(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    """Show what artists need most, and the submenus for everything else."""
    for name in ("choose_tool", "suggest", "close_gaps", "unwrap"):
        menu.layout.operator(f"mesh.seamwire_{name}")
    menu.layout.separator()
    for name in SUBMENUS:
        menu.layout.menu(name)


def _draw_network(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    """Show what is done with all wires of a mesh. Seamwire Networks adds its entries."""
    menu.layout.operator("mesh.seamwire_take_over", text="From Seams")
    if not hasattr(bpy.types, "MESH_OT_seamwire_transfer"):
        menu.layout.label(text="To save, load, transfer and repeat wires, enable Seamwire Networks in the preferences")


def _draw_islands(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    for which, text in (("TO_CUT", "Select Islands to Cut"), ("WORST", "Select Worst Stretched Island")):
        menu.layout.operator("mesh.seamwire_select_islands", text=text).which = which
    menu.layout.separator()
    for what, name, *_ in ISLAND_ITEMS:
        menu.layout.operator("mesh.seamwire_store", text=f"Store as {name}").what = what


def _draw_views(menu: bpy.types.Menu, context: bpy.types.Context) -> None:
    for name, setting in SETTINGS.items():
        if setting.group == VIEWS:
            show = menu.layout.prop if setting.choices is None else menu.layout.prop_menu_enum
            show(settings(context), name)


_ALL, *_SUBMENUS = (
    type(f"VIEW3D_MT_{name}", (bpy.types.Menu,), {"__doc__": tooltip, "bl_label": label, "draw": draw})
    for name, label, tooltip, draw in (
        ("seamwire", "Seamwire", "Draw UV seams, or let Seamwire suggest them", _draw_all),
        (
            "seamwire_finish",
            "Finish",
            "Make seams run exactly where wires across the surface run",
            lambda menu, _context: menu.layout.operator_enum("mesh.seamwire_finish", "finish"),
        ),
        (
            "seamwire_network",
            "Network",
            "Turn seams into wires, or save, load, transfer and repeat wires",
            _draw_network,
        ),
        ("seamwire_islands", "Islands", "Select or store the islands that seams make", _draw_islands),
        ("seamwire_views", "Views", "Choose what to show over the mesh", _draw_views),
    )
)
SUBMENUS = tuple(menu.__name__ for menu in _SUBMENUS)


class MESH_OT_seamwire_choose_tool(NeedsEditMode, bpy.types.Operator):
    """Draw UV seams that follow the shape of the mesh: choose the tool"""  # noqa: D400 - a tooltip

    # Blender indents `wm.tool_set_by_id` differently in menus, as it does buttons in the toolbar.
    bl_idname = "mesh.seamwire_choose_tool"
    bl_label = "Draw Seamwires"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    def execute(self, _context: bpy.types.Context) -> set[str]:
        return bpy.ops.wm.tool_set_by_id(name=TOOL, space_type="VIEW_3D")


def _entry(menu: str, kind: str, name: str) -> Change:
    """Return the change that adds a separator and an entry to a menu of Blender's, which is another menu or an operator."""

    def draw(own: bpy.types.Menu, _context: bpy.types.Context) -> None:
        own.layout.separator()
        getattr(own.layout, kind)(name)

    return menu_entry(menu, draw)


_GUIDES = ("guide/index.md", "../../docs/guide/index.md")
"""Where the guide lies, in a package and in a checkout."""


@cache
def guide() -> str:
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
    *classes(_ALL, *_SUBMENUS, VIEW3D_PT_seamwire_help, MESH_OT_seamwire_choose_tool),
    *(_entry(name, "menu", _ALL.__name__) for name in MENUS),
    _entry(CONTEXT_MENU, "operator", MESH_OT_seamwire_choose_tool.bl_idname),
)
