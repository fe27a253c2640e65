# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist has set: the tool's settings, and the add-on's preferences, which hold them from one file to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..core.solver.defaults import CLAMP_PERCENTILE, CLAMP_RANGE, STRENGTH_RANGE, STRENGTHS

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.network.network import Along

ADDON = __package__.rpartition(".")[0]
"""The add-on's name in this Blender."""
TOOL = "seamwire.draw"
"""The tool's name in Blender's toolbar."""
ALONG_ITEMS = (
    ("EDGES", "Along Edges", "Wires are chains of the mesh's edges", 0),
    ("SURFACE", "Across Surface", "Wires cross faces, and the chain of edges nearest to them is marked", 1),
)
FINISH_ITEMS = (
    ("SNAP", "Snap", "The edges that lie nearest to it", 0),
    ("SLIDE", "Slide", "The edges that lie nearest to it, with their vertices slid onto it", 2),
    ("CUT", "Cut", "The wire itself, cut into the faces", 1),
)
AUTO_FINISH_ITEMS = (
    ("AUTO", "Auto", "Cut where the mesh is of many triangles, as scans and sculpts are; else snap", 3),
    *FINISH_ITEMS,
)
METRIC_ITEMS = (
    (
        "feature",
        "Features",
        "Follow ridges, valleys and lines of curvature; across the surface concave creases first",
        0,
    ),
    ("campen", "Principal Directions", "Keep to the directions of curvature (Campen, Bommes, Kobbelt)", 1),
    ("pottmann_kovacs", "Surface Normals", "Turning normals make paths long (Pottmann, Kovacs)", 2),
    (
        "concave",
        "Concave Creases",
        "Follow creases as cuts that people make do; the other wire is the shortest path",
        4,
    ),
    ("euclidean", "Shortest Path", "Run as short as possible, whatever the shape", 3),
)
TOOL_METRIC_ITEMS = tuple(item for item in METRIC_ITEMS if item[0] in {"feature", "concave", "euclidean"})
"""The metrics that the tool offers. Scripts can use all of them."""
STRETCH_ITEMS = (
    ("ANGLE", "Angle", "How much longer faces are one way than the other in the UV map than on the model", 1),
    ("AREA", "Area", "How much larger or smaller faces are in the UV map than the mean of the mesh", 2),
)
HEAT_ITEMS = (
    ("NONE", "None", "The islands are tinted instead", 0),
    ("ANGLE", "Stretch of Angles", STRETCH_ITEMS[0][2], 1),
    ("AREA", "Stretch of Areas", STRETCH_ITEMS[1][2], 2),
    ("STRENGTH", "Feature Strength", "How much the surface bends more one way than the other: s of the metric", 3),
    ("CONCAVITY", "Concavity", "Which way the surface bends most, and how much: valleys and ridges", 4),
    ("DISTANCE", "Distance", "How far all is from the seed, or from a selected vertex, in the metric", 5),
)
SHOWN_METRIC_ITEMS = (
    ("MIN", "Along Features", "That of the wire along ridges and valleys", 0),
    ("MAX", "Across Features", "That of the other wire", 1),
)


listeners: list[Callable[[], None]] = []
"""Called when a setting was changed: what is drawn follows at once."""


def _changed(_settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    for listener in tuple(listeners):
        listener()
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def strength_property(along: Along) -> object:
    """Return a property for the strength of one way of running."""
    return bpy.props.FloatProperty(
        name="Strength",
        description="How strongly wires follow the shape. 1 is the shortest path",
        default=STRENGTHS[along],
        min=STRENGTH_RANGE[0],
        max=STRENGTH_RANGE[1],
        update=_changed,
    )


class SeamwireSettings(bpy.types.PropertyGroup):
    """How wires are drawn; sessions follow them, and they follow the keys of a chain."""

    along: bpy.props.EnumProperty(name="Along", description="Where wires run", items=ALONG_ITEMS, update=_changed)
    strength_edges: strength_property("EDGES")
    strength_surface: strength_property("SURFACE")
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="What becomes the seam of a wire across the surface when its chain ends",
        items=AUTO_FINISH_ITEMS,
        default="AUTO",
        update=_changed,
    )
    straight: bpy.props.BoolProperty(
        name="Straight in View",
        description="Across the surface, offer first the wire that is straight in the view: a cut by a plane. Moved, it follows features",
        update=_changed,
    )
    metric: bpy.props.EnumProperty(
        name="Metric", description="What draws wires to features", items=TOOL_METRIC_ITEMS, update=_changed
    )
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
        description="How far strokes reach, in the object's units; 0: ten rings of vertices",
        default=0.0,
        min=0.0,
        soft_max=1.0,
        precision=3,
        subtype="DISTANCE",
    )
    snap: bpy.props.BoolProperty(
        name="Snap to Features",
        description="Snap to ridges and valleys, else to the strongest feature, within a few pixels of the cursor",
        default=False,
        update=_changed,
    )
    xray: bpy.props.BoolProperty(
        name="X-Ray", description="Show wires, and pick, through the mesh", default=False, update=_changed
    )
    heat: bpy.props.EnumProperty(
        name="Heat",
        description="Color faces by a number, told by a legend",
        items=HEAT_ITEMS,
        update=_changed,
    )
    show_crests: bpy.props.BoolProperty(
        name="Ridges and Valleys",
        description="Show the lines along which the surface bends most sharply; with Alt a click on one draws wires along it",
        update=_changed,
    )
    show_silhouette: bpy.props.BoolProperty(
        name="Silhouette",
        description="Show where the surface turns away from the viewer: a guide for seams that are not to be seen from there",
        update=_changed,
    )
    show_ellipses: bpy.props.BoolProperty(
        name="Ellipses",
        description="Show the metric: in each ellipse's direction wires run as far as it is long at the same cost",
        update=_changed,
    )
    show_paths: bpy.props.BoolProperty(
        name="Shortest Paths",
        description="Show the shortest paths from the seed, or from a selected vertex, to many vertices, by their length",
        update=_changed,
    )
    show_bands: bpy.props.BoolProperty(
        name="Distance Bands",
        description="Show lines of equal distance from the seed, or from a selected vertex, evenly spaced",
        update=_changed,
    )
    show_invalid: bpy.props.BoolProperty(
        name="Invalid Triangles",
        description="Show triangles that the metric makes invalid, and what became of them",
        update=_changed,
    )
    shown_metric: bpy.props.EnumProperty(
        name="Shown Metric",
        description="Which of both wires' metrics is shown",
        items=SHOWN_METRIC_ITEMS,
        update=_changed,
    )
    views_in_object_mode: bpy.props.BoolProperty(
        name="Seamwire Views",
        description="Show what the metric sees of the active object in Object Mode too",
        update=_changed,
    )
    unwrap: bpy.props.BoolProperty(
        name="Unwrap After Each Chain",
        description="When a chain ends unwrap the islands whose seams it has changed; all other UVs stay as they are",
        default=False,
    )


def preferences(context: bpy.types.Context | None = None) -> bpy.types.AddonPreferences | bpy.types.PropertyGroup:
    """Return the add-on's preferences.

    If the add-on is enabled but not listed in Blender's preferences, as after ``blender --addons seamwire``, these are defaults.
    Changes to them are not stored.
    """
    context = context or bpy.context
    addon = context.preferences.addons.get(ADDON)
    return context.window_manager.seamwire_preferences if addon is None else addon.preferences


def settings(context: bpy.types.Context | None = None) -> SeamwireSettings:
    """Return the tool's settings."""
    return preferences(context).tool


notices: list[str] = []
"""Messages that the next chain reports."""


def replace_removed_metric() -> None:
    """Replace a stored metric that the tool no longer offers, and leave a notice."""
    chosen = settings()
    if not chosen.metric:
        chosen.property_unset("metric")
        notices.append("The tool no longer offers the metric in your preferences: wires follow Features instead")


def tool_is_active(context: bpy.types.Context) -> bool:
    """Whether the tool is the active one of edit mode in the workspace."""
    if context.mode != "EDIT_MESH" or context.workspace is None:
        return False
    tool = context.workspace.tools.from_space_view3d_mode("EDIT_MESH", create=False)
    return tool is not None and tool.idname == TOOL


def register() -> None:
    """Add the settings' type, and where meshes keep their wires."""
    bpy.utils.register_class(SeamwireSettings)
    bpy.types.Mesh.seamwire_wires = bpy.props.StringProperty(
        name="Seamwires", description="The wires drawn on this mesh", options={"HIDDEN"}
    )


def unregister() -> None:
    """Remove them; what meshes keep stays with them."""
    del bpy.types.Mesh.seamwire_wires
    bpy.utils.unregister_class(SeamwireSettings)
