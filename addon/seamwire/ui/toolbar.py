# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool in the toolbar of edit mode, and its settings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from .. import lazy
from ..core.engines import CLAMP_PERCENTILE, CLAMP_RANGE, STRENGTH_RANGE, STRENGTHS
from . import keymap

if TYPE_CHECKING:
    from ..operators import modal as drawing
else:
    drawing = lazy.Part("operators.modal")

ALONG_ITEMS = (
    ("EDGES", "Along Edges", "Wires are chains of the mesh's edges"),
    ("SURFACE", "Across Surface", "Wires cross faces, and the chain of edges nearest to them is marked"),
)
METRIC_ITEMS = (
    ("feature", "Features", "Ridges, valleys and lines of curvature draw wires to them"),
    ("campen", "Campen", "The metric of Campen, Bommes and Kobbelt: wires keep to the directions of curvature"),
    ("pottmann_kovacs", "Normals", "The metric of Pottmann and Kovacs: turning normals make ways long"),
    ("euclidean", "Shortest", "Wires are as short as they can be, whatever the shape"),
)
KEYMAP = f"3D View Tool: Edit Mesh, {keymap.NAME}"
"""What Blender calls the keymap of the tool."""
_ICON = Path(__file__).parent.parent / "icons" / "seamwire.draw"


def strength_property(along: str) -> object:
    """Return a property for the strength of one way of running."""
    return bpy.props.FloatProperty(
        name="Strength",
        description="How much longer than straight a way may be for following the shape; 1: not at all",
        default=STRENGTHS[along],
        min=STRENGTH_RANGE[0],
        max=STRENGTH_RANGE[1],
        update=_tell,
    )


def _tell(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    drawing.settings_changed(settings)


class SeamwireSettings(bpy.types.PropertyGroup):
    """How wires are drawn; a running drawing follows them, and they follow its keys."""

    along: bpy.props.EnumProperty(name="Along", description="Where wires run", items=ALONG_ITEMS, update=_tell)
    strength_edges: strength_property("EDGES")
    strength_surface: strength_property("SURFACE")
    metric: bpy.props.EnumProperty(
        name="Metric", description="What draws wires to features", items=METRIC_ITEMS, update=_tell
    )
    clamp: bpy.props.FloatProperty(
        name="Clamp",
        description="The percentile of the vertices' strengths from which on stronger ones count no more: single noisy"
        " vertices then do not decide",
        default=CLAMP_PERCENTILE,
        min=CLAMP_RANGE[0],
        max=CLAMP_RANGE[1],
        precision=1,
        update=_tell,
    )
    stroke_radius: bpy.props.FloatProperty(
        name="Reach of Strokes",
        description="How far strokes reach, in the object's units; 0: ten rings of vertices",
        default=0.0,
        min=0.0,
        soft_max=1.0,
        precision=3,
        subtype="DISTANCE",
    )
    snap: bpy.props.BoolProperty(
        name="Snap to Features",
        description="Take the strongest feature within a few pixels of the cursor",
        default=False,
        update=_tell,
    )
    xray: bpy.props.BoolProperty(
        name="X-Ray", description="Show wires, and pick, through the mesh", default=False, update=_tell
    )


def settings(context: bpy.types.Context | None = None) -> SeamwireSettings:
    """Return the settings."""
    return (context or bpy.context).window_manager.seamwire


class SeamwireTool(bpy.types.WorkSpaceTool):
    """The tool: its first click starts the drawing there."""

    bl_space_type = "VIEW_3D"
    bl_context_mode = "EDIT_MESH"
    bl_idname = "seamwire.draw"
    bl_label = keymap.NAME
    bl_description = (
        "Draw UV seams with live wires that follow the shape of the mesh.\n"
        "Click to begin, click to keep, right-click to end a chain, Enter to mark the seams"
    )
    bl_icon = str(_ICON) if _ICON.with_suffix(".draw.dat").exists() else "ops.mesh.knife_tool"
    bl_cursor = "CROSSHAIR"
    bl_keymap = (
        (keymap.OPERATOR, {"type": "LEFTMOUSE", "value": "PRESS"}, {"properties": [("first", "CLICK")]}),
        (keymap.OPERATOR, {"type": "LEFTMOUSE", "value": "PRESS", "ctrl": True}, {"properties": [("first", "CLICK")]}),
        (keymap.OPERATOR, {"type": "LEFTMOUSE", "value": "PRESS", "alt": True}, {"properties": [("first", "LOOP")]}),
        (
            keymap.OPERATOR,
            {"type": "LEFTMOUSE", "value": "PRESS", "shift": True},
            {"properties": [("first", "ATTRACT")]},
        ),
        (
            keymap.OPERATOR,
            {"type": "LEFTMOUSE", "value": "PRESS", "shift": True, "ctrl": True},
            {"properties": [("first", "REPEL")]},
        ),
    )

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Show the settings in the tool's header or in the sidebar."""
        draw_settings(context, layout)


def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the settings, in a row in headers and in a column elsewhere."""
    from . import preferences

    chosen = settings(context)
    wide = context.region is not None and context.region.type in {"TOOL_HEADER", "HEADER"}
    strength = "strength_edges" if chosen.along == "EDGES" else "strength_surface"
    obj = context.edit_object
    own = preferences.get(context)
    if wide:
        row = layout.row(align=True)
        row.prop(chosen, "along", expand=True)
        layout.prop(chosen, strength)
        layout.prop(chosen, "metric", text="")
        layout.prop(chosen, "snap", text="", icon="SNAP_ON" if chosen.snap else "SNAP_OFF")
        layout.prop(chosen, "xray", text="", icon="XRAY")
        return  # Blender shows the mirror of the mesh right beside
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(chosen, "along")
    layout.prop(chosen, strength)
    layout.prop(chosen, "metric")
    sub = layout.column()
    sub.active = chosen.metric != "euclidean"
    sub.prop(chosen, "clamp", slider=True)
    layout.prop(chosen, "stroke_radius")
    column = layout.column(heading="Snap")
    column.prop(chosen, "snap", text="Features")
    layout.prop(chosen, "xray")
    if obj is not None and obj.type == "MESH":
        row = layout.row(align=True, heading="Mirror")
        for axis in "xyz":
            row.prop(obj.data, f"use_mirror_{axis}", text=axis.upper(), toggle=True)
    if own is not None:
        layout.prop(own, "always_zoom")


_CLASSES = (SeamwireSettings,)


def register() -> None:
    """Add the settings and the tool."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.seamwire = bpy.props.PointerProperty(type=SeamwireSettings)
    if bpy.context.window_manager.keyconfigs.addon is not None:  # Blender as a module has no keymaps for a tool
        bpy.utils.register_tool(SeamwireTool, after={"builtin.knife"}, separator=True)


def unregister() -> None:
    """Remove them."""
    if hasattr(SeamwireTool, "_bl_tool"):
        keymap.empty(KEYMAP)
        bpy.utils.unregister_tool(SeamwireTool)
    del bpy.types.WindowManager.seamwire
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
