# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings, which the add-on's preferences keep from one file to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..terms.choices import items
from ..terms.options import PLACED, SETTINGS, Options
from ..words.reports import Notices
from .registration import classes, together

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..terms.options import Auto, Setting


def redraw_views() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


ADDON = __package__.rpartition(".")[0]
"""The add-on's name in this Blender."""
TOOL = "seamwire.draw"
"""The tool's name in Blender's toolbar."""
listeners: list[Callable[[], None]] = []
"""Functions to call when a setting has changed, so that the drawing follows at once."""


def tell_listeners() -> None:
    for listener in tuple(listeners):
        listener()
    redraw_views()


def _property(name: str, setting: Setting) -> object:
    default = getattr(_DEFAULTS, name)
    values = {
        "name": setting.name,
        "description": setting.tooltip,
        "default": default,
        "update": lambda _settings, _context: tell_listeners(),
        **setting.others,
    }
    if setting.choices is not None:
        values["items"] = items(setting.choices, setting.auto)
        return bpy.props.EnumProperty(**{**values, "default": "AUTO" if setting.auto else default})
    if isinstance(default, bool):
        return bpy.props.BoolProperty(**values)
    if setting.limits is not None:
        values["min"], values["max"] = setting.limits
    return bpy.props.FloatProperty(**values)


_DEFAULTS = Options()


class SeamwireSettings(bpy.types.PropertyGroup):
    """How wires are drawn: keys write these properties, and sessions follow snapshots of them."""


def _describe() -> None:
    SeamwireSettings.__annotations__ = {name: _property(name, setting) for name, setting in SETTINGS.items()}


def _forget() -> None:
    """Let the class hold no functions of this module.

    Blender 4.2 never frees the class. The functions would keep `bpy` alive, and then Blender as a Python module crashes as it ends.
    """
    SeamwireSettings.__annotations__ = {}


def snapshot(settings: SeamwireSettings, data: bpy.types.Mesh | None = None, auto: Auto = PLACED) -> Options:
    """Return the settings as they are now, from Blender's properties.

    Wires are mirrored over the axes that a mesh says, or over none without a mesh. `auto` has the values that Auto stands for there.
    """
    values = {name: getattr(settings, name) for name in SETTINGS}
    # Blender's properties have single precision, which adds digits to a number.
    values = {name: float(f"{value:.7g}") if isinstance(value, float) else value for name, value in values.items()}
    for name, best in auto._asdict().items():
        if values[name] == "AUTO":
            values[name] = best
    return Options(**values, mirror=() if data is None else mirror_axes(data))


def mirror_axes(data: bpy.types.Mesh) -> tuple[int, ...]:
    return tuple(axis for axis, name in enumerate("xyz") if getattr(data, f"use_mirror_{name}"))


def preferences(context: bpy.types.Context | None = None) -> bpy.types.AddonPreferences | bpy.types.PropertyGroup:
    """Return the add-on's preferences. Blender lists no add-on that its option ``--addons`` enables: then they last until Blender ends."""
    context = context or bpy.context
    addon = context.preferences.addons.get(ADDON)
    return context.window_manager.seamwire_defaults if addon is None else addon.preferences


def settings(context: bpy.types.Context | None = None) -> SeamwireSettings:
    return preferences(context).tool


notices = Notices()
"""Reports for the next chain."""


def tool_is_active(context: bpy.types.Context) -> bool:
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


register, unregister = together((_describe, _forget), *classes(SeamwireSettings), (_add_property, _remove_property))
