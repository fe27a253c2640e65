# SPDX-License-Identifier: GPL-3.0-or-later
"""Chooses the tool on the demo's result: ``blender NAME.blend --python scripts/lib/demo_window.py``."""

import addon_utils
import bpy


def start() -> None:
    """Frame the model in edit mode and choose the tool."""
    addon_utils.enable("seamwire", default_set=True)
    window = bpy.context.window_manager.windows[0]
    areas = [area for area in window.screen.areas if area.type == "VIEW_3D"]
    area = max(areas, key=lambda one: one.width * one.height)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.view3d.view_all(center=True)
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")


bpy.context.preferences.view.show_splash = False
# The regions have no size before the window's first events are done.
bpy.app.timers.register(start, first_interval=0.5)
