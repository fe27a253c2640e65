# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings: the most important ones in its header, all of them in the sidebar and in the Properties editor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..core.drawing.options import strength_name
from ..mesh.registration import classes, together
from ..mesh.settings import SeamwireSettings, settings, tool_is_active
from ..operators.bindings import HELP_PANEL

if TYPE_CHECKING:
    from ..core.network.picks import Along

_SHORT_ALONG = (("AUTO", "Auto"), ("EDGES", "Edges"), ("SURFACE", "Surface"))
"""How the header names the choices of *Along*, so that Blender's controls have room beside ours."""


def draw_views(chosen: SeamwireSettings, layout: bpy.types.UILayout) -> None:
    """Show the views of the mesh and of its UV map in a column."""
    layout.prop(chosen, "heat")
    layout.column(heading="Show").prop(chosen, "show_crests")


def draw_header(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show at most six controls in a row, and the help. Blender shows the mirror of the mesh beside them."""
    chosen, along = settings(context), along_of(context)
    row = layout.row(align=True)
    row.ui_units_x = 8.5
    for name, label in _SHORT_ALONG:
        row.prop_enum(chosen, "along", name, text=label)
    if along == "SURFACE":
        finish = layout.row()
        finish.ui_units_x = 5
        finish.prop(chosen, "finish")
    strength = layout.row()
    strength.ui_units_x = 6
    strength.prop(chosen, strength_name(along))
    if along == "SURFACE":
        layout.prop(chosen, "straight", text="Straight", toggle=True)
    layout.prop(chosen, "clear", toggle=True)
    panels = layout.row(align=True)
    panels.popover(VIEW3D_PT_seamwire_overlays.bl_idname, text="Views")
    panels.popover(HELP_PANEL, text="", icon="QUESTION")


def along_of(context: bpy.types.Context) -> Along:
    """Return how wires run on the active object."""
    along = settings(context).along
    if along != "AUTO":
        return along
    # Imported only when the tool is used, so that Blender's start does not wait for NumPy.
    from ..view.edited_objects import edited

    return edited.best_along(context.edit_object)


def draw_drawing(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show how wires are drawn."""
    chosen, obj = settings(context), context.edit_object
    along = along_of(context)
    layout.prop(chosen, "along")
    layout.prop(chosen, strength_name(along))
    toggles = _whole_width(layout)
    straight = toggles.row()
    straight.active = along == "SURFACE"
    straight.prop(chosen, "straight")
    toggles.prop(chosen, "clear")
    toggles.prop(chosen, "snap")
    toggles.prop(chosen, "xray")
    if obj is not None and obj.type == "MESH":
        row = layout.row(align=True, heading="Mirror")
        for axis in "xyz":
            row.prop(obj.data, f"use_mirror_{axis}", text=axis.upper(), toggle=True)


def draw_finish(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show how wires across the surface become seams."""
    chosen = settings(context)
    layout.active = along_of(context) == "SURFACE"
    layout.prop(chosen, "finish")


def draw_islands(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show what happens to the islands that seams make."""
    _whole_width(layout).prop(settings(context), "unwrap")


def draw_advanced(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show what artists seldom need."""
    chosen = settings(context)
    layout.prop(chosen, "metric")
    percentile = layout.column()
    percentile.active = chosen.metric != "euclidean"
    percentile.prop(chosen, "clamp", slider=True)
    layout.prop(chosen, "stroke_radius")


GROUPS = (("Drawing", draw_drawing), ("Finish", draw_finish), ("Islands", draw_islands), ("Advanced", draw_advanced))
"""The groups of settings, with what draws each."""


def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the settings where Blender shows those of the active tool. In the sidebar, panels of our own do."""
    region = context.region.type if context.region is not None else ""
    if region in {"TOOL_HEADER", "HEADER"}:
        draw_header(context, layout)
    elif region != "UI":
        for name, draw in GROUPS:
            box = layout.box()
            box.label(text=name)
            draw(context, _split(box.column()))


def _whole_width(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """Return a column for toggles whose names need the whole width of the sidebar."""
    column = layout.column()
    column.use_property_split = False
    return column


def _split(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """Return the layout, with names at the left and values at the right."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout


class VIEW3D_PT_seamwire_overlays(bpy.types.Panel):
    """Views of the mesh and of its UV map"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_PT_seamwire_overlays"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_label = "Seamwire Views"
    bl_ui_units_x = 13

    def draw(self, context: bpy.types.Context) -> None:
        """Show the views, as Blender shows its overlays."""
        self.layout.label(text="Seamwire Views")
        draw_views(settings(context), _split(self.layout))


def _panel(name: str) -> type[bpy.types.Panel]:
    """Return the panel of a group in the sidebar, below the active tool."""
    draw_group = dict(GROUPS)[name]

    def poll(_cls: type, context: bpy.types.Context) -> bool:
        return tool_is_active(context)

    def draw(self: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw_group(context, _split(self.layout))

    body = {
        "__doc__": f"Settings of the Seamwire tool: {name}",
        "bl_space_type": "VIEW_3D",
        "bl_region_type": "UI",
        "bl_category": "Tool",
        "bl_label": name,
        "bl_parent_id": "VIEW3D_PT_active_tool",
        "bl_options": {"DEFAULT_CLOSED"} if name == "Advanced" else set(),
        "poll": classmethod(poll),
        "draw": draw,
    }
    return type(f"VIEW3D_PT_seamwire_{name.lower()}", (bpy.types.Panel,), body)


register, unregister = together(*classes(VIEW3D_PT_seamwire_overlays, *(_panel(name) for name, _ in GROUPS)))
