# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings: the most important ones in its header, all of them in the sidebar and in the Properties editor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import settings, tool_is_active
from ..operators.bindings import HELP_PANEL
from ..terms.choices import ALONG
from ..terms.options import SETTINGS, strength_name

if TYPE_CHECKING:
    from ..terms.choices import Along

VIEWS = "Views"
"""The group of settings that a popover and a menu show."""
GROUPS = tuple(dict.fromkeys(setting.group for setting in SETTINGS.values() if setting.group != VIEWS))
"""The groups of settings that have panels."""
_STRENGTHS = {strength_name(along) for along in ALONG}
_SHORT_ALONG = (("AUTO", "Auto"), ("EDGES", "Edges"), ("SURFACE", "Surface"))
"""How the header names the choices of *Along*, so that Blender's controls have room beside ours."""


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


def draw_group(context: bpy.types.Context, layout: bpy.types.UILayout, group: str) -> None:
    """Show the settings of a group. A setting without an effect is grayed out. Of both strengths only one is shown."""
    chosen, along = settings(context), along_of(context)
    # Names of toggles need the whole width of the sidebar.
    toggles: bpy.types.UILayout | None = None
    for name, setting in SETTINGS.items():
        if setting.group != group or name in _STRENGTHS - {strength_name(along)}:
            continue
        is_toggle = chosen.bl_rna.properties[name].type == "BOOLEAN"
        if is_toggle and toggles is None:
            toggles = layout.column(heading="Show") if group == VIEWS else layout.column()
            toggles.use_property_split = group == VIEWS
        row = (toggles if is_toggle else layout).row()
        row.active = setting.matters(along, chosen.metric)
        row.prop(chosen, name, slider=setting.slider)
    obj = context.edit_object if group == "Drawing" else None
    if obj is not None and obj.type == "MESH":
        row = layout.row(align=True, heading="Mirror")
        for axis in "xyz":
            row.prop(obj.data, f"use_mirror_{axis}", text=axis.upper(), toggle=True)


def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the settings where Blender shows those of the active tool. In the sidebar, panels of our own do."""
    region = context.region.type if context.region is not None else ""
    if region in {"TOOL_HEADER", "HEADER"}:
        draw_header(context, layout)
    elif region != "UI":
        for group in GROUPS:
            box = layout.box()
            box.label(text=group)
            draw_group(context, _split(box.column()), group)


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
        draw_group(context, _split(self.layout), VIEWS)


def _panel(name: str) -> type[bpy.types.Panel]:
    """Return the panel of a group in the sidebar, below the active tool."""

    def poll(_cls: type, context: bpy.types.Context) -> bool:
        return tool_is_active(context)

    def draw(self: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw_group(context, _split(self.layout), name)

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


register, unregister = together(*classes(VIEW3D_PT_seamwire_overlays, *map(_panel, GROUPS)))
