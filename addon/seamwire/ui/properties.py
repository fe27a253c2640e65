# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings, shown in its header and in the sidebar."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..mesh.settings import settings

if TYPE_CHECKING:
    import bpy

    from ..mesh.settings import SeamwireSettings


VIEWS = (
    ("show_crests", "MOD_OUTLINE"),
    ("show_silhouette", "GHOST_ENABLED"),
    ("show_ellipses", "MESH_CIRCLE"),
    ("show_paths", "PARTICLE_PATH"),
    ("show_bands", "PHYSICS"),
    ("show_invalid", "MOD_TRIANGULATE"),
)
"""Toggles of what the metric sees, with their icons."""


def draw_views(chosen: SeamwireSettings, layout: bpy.types.UILayout) -> None:
    """Show what can be seen of the metric, in a column."""
    layout.prop(chosen, "heat")
    column = layout.column(heading="Show")
    for name, _ in VIEWS:
        column.prop(chosen, name)
    sub = layout.column()
    sub.active = any(getattr(chosen, name) for name, _ in VIEWS) or chosen.heat == "DISTANCE"
    sub.prop(chosen, "shown_metric")


def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the settings, in a row in headers and in a column elsewhere."""
    chosen = settings(context)
    wide = context.region is not None and context.region.type in {"TOOL_HEADER", "HEADER"}
    strength = "strength_edges" if chosen.along == "EDGES" else "strength_surface"
    obj = context.edit_object
    if wide:
        row = layout.row(align=True)
        row.prop(chosen, "along", expand=True)
        layout.prop(chosen, strength)
        if chosen.along == "SURFACE":
            layout.row(align=True).prop(chosen, "finish", expand=True)
            layout.prop(chosen, "straight", text="", icon="IPO_LINEAR")
        layout.prop(chosen, "clear", toggle=True)
        layout.prop(chosen, "snap", text="", icon="SNAP_ON" if chosen.snap else "SNAP_OFF")
        layout.prop(chosen, "xray", text="", icon="XRAY")
        layout.prop(chosen, "heat", text="Heat")
        row = layout.row(align=True)
        for name, icon in VIEWS:
            row.prop(chosen, name, text="", icon=icon)
        return  # Blender shows the mirror of the mesh right beside
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(chosen, "along")
    layout.prop(chosen, strength)
    column = layout.column()
    column.active = chosen.along == "SURFACE"
    column.row().prop(chosen, "finish", expand=True)
    column.prop(chosen, "straight")
    layout.prop(chosen, "clear")
    layout.prop(chosen, "stroke_radius")
    column = layout.column(heading="Snap")
    column.prop(chosen, "snap", text="Features")
    layout.prop(chosen, "xray")
    draw_views(chosen, layout)
    layout.prop(chosen, "unwrap")
    if obj is not None and obj.type == "MESH":
        row = layout.row(align=True, heading="Mirror")
        for axis in "xyz":
            row.prop(obj.data, f"use_mirror_{axis}", text=axis.upper(), toggle=True)
    column = layout.column(heading="Advanced")
    column.prop(chosen, "metric")
    sub = column.column()
    sub.active = chosen.metric != "euclidean"
    sub.prop(chosen, "clamp", slider=True)
