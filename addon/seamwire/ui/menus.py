# SPDX-License-Identifier: GPL-3.0-or-later
"""Menu entries: choose the tool; what else is done to wires, their files, UV maps and islands."""

from __future__ import annotations

import bpy

from ..mesh.settings import TOOL

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_context_menu", "IMAGE_MT_uvs")


def _draw_menu(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    entry = menu.layout.operator("wm.tool_set_by_id", text="Draw Seamwires")
    entry.name, entry.space_type = TOOL, "VIEW_3D"
    menu.layout.operator("mesh.seamwire_suggest")
    menu.layout.operator("mesh.seamwire_take_over")
    menu.layout.operator("mesh.seamwire_repeat")
    menu.layout.operator("mesh.seamwire_close_gaps")
    menu.layout.operator("mesh.seamwire_transfer")
    menu.layout.operator("mesh.seamwire_load_network")
    menu.layout.operator("mesh.seamwire_save_network")
    menu.layout.operator("mesh.seamwire_cut")
    menu.layout.operator("mesh.seamwire_slide")
    menu.layout.operator("mesh.seamwire_unwrap")
    menu.layout.operator("mesh.seamwire_worst_island")
    menu.layout.operator_menu_enum("mesh.seamwire_store_view", "view")
    menu.layout.operator("mesh.seamwire_select_islands_to_cut")
    menu.layout.operator_menu_enum("mesh.seamwire_store_islands", "kind")
    menu.layout.operator_menu_enum("mesh.seamwire_mark_seams_as", "kind")


def _draw_import(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_load_network", text="Seamwire Network (.json)")


def _draw_export(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_save_network", text="Seamwire Network (.json)")


def register() -> None:
    """Add the menu entries."""
    for name in MENUS:
        getattr(bpy.types, name).append(_draw_menu)
    bpy.types.TOPBAR_MT_file_import.append(_draw_import)
    bpy.types.TOPBAR_MT_file_export.append(_draw_export)


def unregister() -> None:
    """Remove them."""
    bpy.types.TOPBAR_MT_file_export.remove(_draw_export)
    bpy.types.TOPBAR_MT_file_import.remove(_draw_import)
    for name in MENUS:
        getattr(bpy.types, name).remove(_draw_menu)
