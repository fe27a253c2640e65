# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings, which the add-on's preferences keep from one file to the next."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import bpy

from ..core.drawing.options import Options
from ..core.solver.defaults import CLAMP_PERCENTILE, CLAMP_RANGE, PLACED, STRENGTH_RANGE, STRENGTHS
from ..words.notices import Notices
from .redraw import redraw_views
from .registration import classes, together

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.network.picks import Along
    from ..core.solver.defaults import Auto

ADDON = __package__.rpartition(".")[0]
"""The add-on's name in this Blender."""
TOOL = "seamwire.draw"
"""The tool's name in Blender's toolbar."""
ALONG_ITEMS = (
    ("EDGES", "Along Edges", "Wires are chains of the mesh's edges", 0),
    ("SURFACE", "Across Surface", "Wires cross faces. Finish decides how they become seams", 1),
)
AUTO_ALONG_ITEMS = (
    ("AUTO", "Auto", "Along the edges that an artist placed, across the surface of scans and sculpts", 2),
    *ALONG_ITEMS,
)
FINISH_ITEMS = (
    ("SNAP", "Snap", "Mark the nearest edges", 0),
    ("SLIDE", "Slide", "Mark the nearest edges, and slide their vertices onto the wire", 2),
    ("CUT", "Cut", "Cut the wire into the faces", 1),
)
AUTO_FINISH_ITEMS = (
    ("AUTO", "Auto", "Cut scans and sculpts, snap to the edges that an artist placed", 3),
    *FINISH_ITEMS,
)
METRIC_ITEMS = (
    (
        "feature",
        "Features",
        "Follow ridges, valleys and lines of curvature. Across the surface, concave creases come first",
        0,
    ),
    (
        "concave",
        "Concave Creases",
        "Follow concave creases, where people usually cut",
        1,
    ),
    ("euclidean", "Shortest Path", "Run as short as possible and ignore the shape", 2),
)
STRETCH_ITEMS = (
    ("ANGLE", "Angle", "How much the UV map stretches faces in one direction more than in the other", 1),
    ("AREA", "Area", "How much larger or smaller faces are in the UV map than on average", 2),
)
HEAT_ITEMS = (
    ("NONE", "None", "Tint the islands instead", 0),
    ("ANGLE", "Stretch of Angles", STRETCH_ITEMS[0][2], 1),
    ("AREA", "Stretch of Areas", STRETCH_ITEMS[1][2], 2),
)


listeners: list[Callable[[], None]] = []
"""Functions to call when a setting has changed, so that the drawing follows at once."""


def _changed(_settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    tell_listeners()


def tell_listeners() -> None:
    """Let the drawing follow the settings, and draw all 3D views anew."""
    for listener in tuple(listeners):
        listener()
    redraw_views()


def strength_property(along: Along) -> object:
    """Return the property for the strength along edges or across the surface."""
    return bpy.props.FloatProperty(
        name="Strength",
        description="How strongly wires follow the shape. 1 gives the shortest path",
        default=STRENGTHS[along],
        min=STRENGTH_RANGE[0],
        max=STRENGTH_RANGE[1],
        update=_changed,
    )


class SeamwireSettings(bpy.types.PropertyGroup):
    """How wires are drawn: keys write these properties, and sessions follow snapshots of them."""

    along: bpy.props.EnumProperty(
        name="Along", description="How wires run on the mesh", items=AUTO_ALONG_ITEMS, default="AUTO", update=_changed
    )
    strength_edges: strength_property("EDGES")
    strength_surface: strength_property("SURFACE")
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="How a wire across the surface becomes a seam when its chain ends",
        items=AUTO_FINISH_ITEMS,
        default="AUTO",
        update=_changed,
    )
    straight: bpy.props.BoolProperty(
        name="Straight in View",
        description="Offer the wire that is straight on screen first",
        update=_changed,
    )
    metric: bpy.props.EnumProperty(name="Metric", description="What wires follow", items=METRIC_ITEMS, update=_changed)
    clamp: bpy.props.FloatProperty(
        name="Feature Percentile",
        description="Clip feature strength at this percentile, so that noise does not dominate",
        default=CLAMP_PERCENTILE,
        min=CLAMP_RANGE[0],
        max=CLAMP_RANGE[1],
        precision=1,
        update=_changed,
    )
    clear: bpy.props.BoolProperty(
        name="Clear Seams", description="Clear seams instead of marking them", default=False, update=_changed
    )
    stroke_radius: bpy.props.FloatProperty(
        name="Stroke Radius",
        description="How far strokes reach. 0 means ten rings of vertices",
        default=0.0,
        min=0.0,
        soft_max=1.0,
        precision=3,
        subtype="DISTANCE",
        update=_changed,
    )
    snap: bpy.props.BoolProperty(
        name="Snap to Features",
        description="Snap seeds to ridges, valleys and other features near the cursor",
        default=False,
        update=_changed,
    )
    xray: bpy.props.BoolProperty(
        name="X-Ray", description="Show wires through the mesh, and pick through it", default=False, update=_changed
    )
    heat: bpy.props.EnumProperty(
        name="Heat",
        description="Color faces by the stretch of the UV map",
        items=HEAT_ITEMS,
        update=_changed,
    )
    show_crests: bpy.props.BoolProperty(
        name="Ridges and Valleys",
        description="Show where the surface bends most sharply. Alt-click a line to draw wires along it",
        update=_changed,
    )
    unwrap: bpy.props.BoolProperty(
        name="Unwrap After Each Chain",
        description="When a chain ends, unwrap the islands whose seams it has changed. All other UVs stay in place",
        default=False,
    )


@dataclass(frozen=True)
class ToolOptions(Options):
    """A snapshot of all settings: those of drawing, and those of the views.

    Parameters
    ----------
    heat
        The kind of stretch that colors faces, or ``NONE``.
    show_crests
        Whether ridges and valleys are shown.
    """

    heat: str = "NONE"
    show_crests: bool = False


def snapshot(settings: SeamwireSettings, mesh: bpy.types.Mesh | None = None, auto: Auto = PLACED) -> ToolOptions:
    """Return the settings as they are now.

    Parameters
    ----------
    settings
        Blender's properties.
    mesh
        Its own options tell over which axes wires are mirrored; None: over none.
    auto
        The values that Auto stands for on that mesh.
    """
    values = {
        field.name: _exact(getattr(settings, field.name)) for field in fields(ToolOptions) if field.name != "mirror"
    }
    for name, best in auto._asdict().items():
        if values[name] == "AUTO":
            values[name] = best
    return ToolOptions(**values, mirror=() if mesh is None else mirror_axes(mesh))


def mirror_axes(mesh: bpy.types.Mesh) -> tuple[int, ...]:
    """Return the axes over which Blender mirrors what is done to a mesh."""
    return tuple(axis for axis, name in enumerate("xyz") if getattr(mesh, f"use_mirror_{name}"))


def _exact(value: object) -> object:
    """Return a value without the digits that single precision, which Blender's properties have, adds to it."""
    return float(f"{value:.7g}") if isinstance(value, float) else value


def preferences(context: bpy.types.Context | None = None) -> bpy.types.AddonPreferences:
    """Return the add-on's preferences."""
    return (context or bpy.context).preferences.addons[ADDON].preferences


def settings(context: bpy.types.Context | None = None) -> SeamwireSettings:
    """Return the tool's settings."""
    return preferences(context).tool


notices = Notices()
"""Reports for the next chain."""


def tool_is_active(context: bpy.types.Context) -> bool:
    """Return whether the tool is active in Edit Mode in the workspace."""
    if context.mode != "EDIT_MESH" or context.workspace is None:
        return False
    tool = context.workspace.tools.from_space_view3d_mode("EDIT_MESH", create=False)
    return tool is not None and tool.idname == TOOL


def _add_property() -> None:
    bpy.types.Mesh.seamwire_wires = bpy.props.StringProperty(
        name="Seamwires", description="The wires drawn on this mesh", options={"HIDDEN"}
    )


def _remove_property() -> None:
    """Remove the property in which meshes keep their wires. Meshes keep the stored wires."""
    del bpy.types.Mesh.seamwire_wires


register, unregister = together(*classes(SeamwireSettings), (_add_property, _remove_property))
