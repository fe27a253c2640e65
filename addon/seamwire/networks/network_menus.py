# SPDX-License-Identifier: GPL-3.0-or-later
"""The Network submenu, and the entries in Blender's Import and Export menus."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, menu_entry, together


class VIEW3D_MT_seamwire_network(bpy.types.Menu):
    """Save wires, load them, or draw them on other meshes"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_MT_seamwire_network"
    bl_label = "Network"

    def draw(self, _context: bpy.types.Context) -> None:
        """Show what is done with all wires of a mesh."""
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator("mesh.seamwire_load_network", text="Load...")
        layout.operator("mesh.seamwire_save_network", text="Save...")
        layout.separator()
        layout.operator("mesh.seamwire_transfer", text="Transfer")
        layout.operator("mesh.seamwire_repeat", text="Repeat")
        layout.operator("mesh.seamwire_take_over", text="From Seams")


def _draw_import(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_load_network", text="Seamwire Network (.json)")


def _draw_export(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_save_network", text="Seamwire Network (.json)")


register, unregister = together(
    *classes(VIEW3D_MT_seamwire_network),
    menu_entry("TOPBAR_MT_file_import", _draw_import),
    menu_entry("TOPBAR_MT_file_export", _draw_export),
)
