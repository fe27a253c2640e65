# SPDX-License-Identifier: GPL-3.0-or-later
"""Has Blender draw its 3D views anew."""

from __future__ import annotations

import bpy


def redraw_views() -> None:
    """Let all 3D views be drawn anew."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
