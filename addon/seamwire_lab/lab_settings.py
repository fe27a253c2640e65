# SPDX-License-Identifier: GPL-3.0-or-later
"""Which views are shown. Blender does not store this with its preferences."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Callable

LINES = ("show_silhouette", "show_ellipses", "show_paths", "show_bands", "show_invalid")
"""The toggles of views that are drawn as lines or marks."""
listeners: list[Callable[[], None]] = []
"""Functions to call when a setting has changed."""


def _changed(_settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    for listener in tuple(listeners):
        listener()


def _toggle(name: str, description: str) -> object:
    return bpy.props.BoolProperty(name=name, description=description, update=_changed)


class SeamwireLabSettings(bpy.types.PropertyGroup):
    """The views that are shown.

    Blender 4.2 never frees this class. A method would keep this module alive with it after the add-on is removed, and `bpy` with the
    module. Then Blender as a Python module crashes as it ends.
    """

    heat: bpy.props.EnumProperty(
        name="Heat",
        description="Color faces by a measured value",
        items=(
            ("NONE", "None", "Color nothing"),
            ("STRENGTH", "Feature Strength", "How strongly wires follow the shape"),
            ("CONCAVITY", "Concavity", "How sharply the surface bends, in valleys and on ridges"),
            ("DISTANCE", "Distance", "Distance from the seed or the selected vertex, as wires measure it"),
        ),
        update=_changed,
    )
    show_silhouette: _toggle("Silhouette", "Show where the surface turns away from the viewer")
    show_ellipses: _toggle("Ellipses", "Show how cheaply wires run in each direction")
    show_paths: _toggle(
        "Shortest Paths", "Show the shortest paths from the seed or the selected vertex to many vertices"
    )
    show_bands: _toggle(
        "Distance Bands", "Show evenly spaced lines of equal distance from the seed or the selected vertex"
    )
    show_invalid: _toggle(
        "Invalid Triangles", "Show triangles that the metric makes invalid, and how they were repaired"
    )
    shown_metric: bpy.props.EnumProperty(
        name="Shown Metric",
        description="Which candidate's metric to show",
        items=(
            ("MIN", "Along Features", "The metric of the wire along ridges and valleys"),
            ("MAX", "Across Features", "The metric of the wire across ridges and valleys"),
        ),
        update=_changed,
    )


def settings() -> SeamwireLabSettings:
    """Return the settings."""
    return bpy.context.window_manager.seamwire_lab


def is_any_shown() -> bool:
    """Return whether a view is switched on."""
    chosen = settings()
    return chosen.heat != "NONE" or any(getattr(chosen, name) for name in LINES)


def register() -> None:
    """Add the settings to the window manager."""
    bpy.utils.register_class(SeamwireLabSettings)
    bpy.types.WindowManager.seamwire_lab = bpy.props.PointerProperty(type=SeamwireLabSettings, options={"HIDDEN"})


def unregister() -> None:
    """Remove them and their values."""
    bpy.context.window_manager.property_unset("seamwire_lab")
    del bpy.types.WindowManager.seamwire_lab
    bpy.utils.unregister_class(SeamwireLabSettings)
