# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool in the toolbar of edit mode."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..mesh.settings import TOOL
from ..operators import hover, select_islands, undo_steps
from ..operators.bindings import HELP_PANEL, NAME
from . import keymap, properties

OPERATOR = "mesh.seamwire_draw"
KEYMAP = f"3D View Tool: Edit Mesh, {NAME}"
"""The name of the tool's keymap in Blender."""
_MODE = "EDIT_MESH"
_OTHER = "builtin.select_box"
_NOTHING_ELSE = dict.fromkeys(
    ("keymap", "gizmo_group", "data_block", "operator", "idname_fallback", "keymap_fallback"), ""
)
"""Blender 3.4 crashes if a text is left out."""
_ICON = Path(__file__).parent.parent / "icons" / "seamwire.draw"


def _key(first: str, type: str = "LEFTMOUSE", **held: bool) -> tuple[str, dict[str, object], dict[str, object]]:
    return OPERATOR, {"type": type, "value": "PRESS", **held}, {"properties": [("first", first)]}


class SeamwireTool(bpy.types.WorkSpaceTool):
    """The tool in the toolbar. A click begins a chain, and most other keys keep Blender's meaning."""

    bl_space_type = "VIEW_3D"
    bl_context_mode = _MODE
    bl_idname = TOOL
    bl_label = NAME
    bl_description = (
        "Draw UV seams that follow the shape of the mesh.\n"
        "Click to begin, click to keep a wire, right-click to end.\n"
        "Drag to draw by hand or to move seeds. Hold Alt for loops. X removes a wire"
    )
    bl_icon = str(_ICON) if _ICON.with_suffix(".draw.dat").exists() else "ops.mesh.knife_tool"
    bl_cursor = "CROSSHAIR"
    bl_widget = hover.GROUP
    bl_keymap = (
        _key("CLICK"),
        _key("CLICK", ctrl=True),
        _key("LOOP", alt=True),
        _key("BEND", shift=True, alt=True),
        _key("GUIDE", shift=True),
        _key("AVOID", shift=True, ctrl=True),
        _key("REMOVE", "X"),
        _key("REMOVE", "DEL"),
        _key("NEXT", "W"),
        _key("PEEK", "LEFT_ALT", any=True),
        # Systems differ in whether the pressed key counts as held.
        _key("PEEK", "LEFT_SHIFT", alt=True),
        _key("PEEK", "LEFT_SHIFT", alt=True, shift=True),
        (
            select_islands.OPERATOR,
            {"type": "W", "value": "PRESS", "shift": True, "ctrl": True},
            {"properties": [("which", "WORST")]},
        ),
        ("wm.call_panel", {"type": "F1", "value": "PRESS"}, {"properties": [("name", HELP_PANEL)]}),
        (undo_steps.HINT, {"type": "F9", "value": "PRESS"}, None),
        (hover.OPERATOR, {"type": "MOUSEMOVE", "value": "ANY", "any": True}, None),
    )

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Show the settings in the tool's header or in the sidebar."""
        properties.draw_settings(context, layout)


def register() -> None:
    """Add the tool in a separate slot at the end of the toolbar."""
    if bpy.context.window_manager.keyconfigs.addon is not None:  # Blender as a module has no keymaps for a tool
        bpy.utils.register_tool(SeamwireTool)


def leave() -> None:
    """Choose Blender's first tool wherever this tool is chosen, shown or not: a tool without keys fills the console."""
    for window in bpy.context.window_manager.windows:
        area = next((area for area in window.screen.areas if area.type == "VIEW_3D"), None)
        if area is None:
            continue
        with bpy.context.temp_override(window=window, area=area, region=area.regions[-1]):
            tool = bpy.context.workspace.tools.from_space_view3d_mode(bpy.context.mode, create=False)
            if tool is not None and tool.idname == TOOL:
                bpy.ops.wm.tool_set_by_id(name=_OTHER)
    # Blender sets up the tools of other workspaces and modes when it shows them.
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        for workspace in bpy.data.workspaces:
            for tool in workspace.tools:
                if tool.idname == TOOL:
                    tool.setup(idname=_OTHER, **_NOTHING_ELSE)


def unregister() -> None:
    """Remove it."""
    if hasattr(SeamwireTool, "_bl_tool"):
        leave()
        keymap.empty(KEYMAP)
        bpy.utils.unregister_tool(SeamwireTool)
