# SPDX-License-Identifier: GPL-3.0-or-later
"""What edit mode's toolbar holds."""

from __future__ import annotations

import bpy
from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active


def slots() -> list[list[str | None] | None]:
    """Return the slots in order, each with its tools; None: a separator, or a gap in a group."""
    found = VIEW3D_PT_tools_active.tools_from_context(bpy.context, mode="EDIT_MESH")
    # A tool is a tuple of a special type.
    groups = [None if slot is None else slot if type(slot) in {tuple, list} else (slot,) for slot in found]
    return [group and [None if tool is None else tool.idname for tool in group] for group in groups]
