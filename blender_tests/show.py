# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's themes and the shadings of its viewport, to look at the tool in each of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    import ui as driver


SHADINGS = ("SOLID", "FLAT", "WHITE", "MATCAP", "FACE_ORIENTATION", "WIREFRAME", "XRAY", "MATERIAL")


def shading(ui: driver.Ui, name: str) -> None:
    """Show the viewport in one of its ways."""
    space = ui.space
    space.overlay.show_face_orientation = name == "FACE_ORIENTATION"
    space.shading.show_xray = name == "XRAY"
    space.shading.type = {"WIREFRAME": "WIREFRAME", "MATERIAL": "MATERIAL"}.get(name, "SOLID")
    if name == "MATCAP":
        space.shading.light = "MATCAP"
        space.shading.studio_light = "basic_1.exr" if bpy.app.version < (5, 0, 0) else "basic_grey.exr"
    elif space.shading.type == "SOLID":
        space.shading.light = "FLAT" if name == "FLAT" else "STUDIO"
    if space.shading.type == "SOLID":
        space.shading.color_type = "SINGLE"
        space.shading.single_color = (1.0, 1.0, 1.0) if name in {"WHITE", "MATCAP"} else (0.8, 0.8, 0.8)


def theme(name: str) -> None:
    """Take Blender's default theme, DARK, or the one that comes with it, LIGHT."""
    bpy.ops.preferences.reset_default_theme()
    if name == "LIGHT":
        folders = map(Path, bpy.utils.preset_paths("interface_theme"))
        found = [file for folder in folders for file in folder.glob("*ight.xml")]
        bpy.ops.script.execute_preset(filepath=str(found[0]), menu_idname="USERPREF_MT_interface_theme_presets")
