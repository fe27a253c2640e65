# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys, registered with Blender so that users can change them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import TOOL
from ..operators.keymaps import ACTION_OPERATOR, NAME
from ..words.keys import KEYS, Action

if TYPE_CHECKING:
    from collections.abc import Iterator

START = {"type": "W", "value": "PRESS", "ctrl": True, "alt": True}


class MESH_OT_seamwire_key(bpy.types.Operator):
    """Represents a key of a chain in the keymap"""  # noqa: D400 - a tooltip

    bl_idname = ACTION_OPERATOR
    bl_label = "Seamwire Key"
    bl_options = {"INTERNAL"}

    action: bpy.props.EnumProperty(
        name="Action",
        description="Action of the key",
        items=tuple((action.name, action.text, "", "NONE", action.number) for action in Action),
    )

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        """Return False, because a chain looks up its keys itself."""
        return False


_registered: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []
_SPACE = {"space_type": "VIEW_3D", "region_type": "WINDOW"}


def _add_keys() -> None:
    try:
        _registered.extend(_add())
    except BaseException:
        _remove_keys()
        raise


def _add() -> Iterator[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]]:
    configurations = bpy.context.window_manager.keyconfigs
    if configurations.addon is None:  # background mode has no keymaps
        return
    keymap = configurations.addon.keymaps.new(name="Mesh", space_type="EMPTY")
    item = keymap.keymap_items.new("wm.tool_set_by_id", **START)
    item.properties.name = TOOL
    yield keymap, item
    # Blender copies an add-on's keymap to the user's only if its own configuration has a keymap with this name.
    configurations.default.keymaps.new(name=NAME, **_SPACE)
    keymap = configurations.addon.keymaps.new(name=NAME, **_SPACE)
    for action, key in KEYS:
        if key.ctrl == key.shift == key.alt == -1:
            item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, any=True)
        else:
            held = {"ctrl": key.ctrl == 1, "shift": key.shift == 1, "alt": key.alt == 1}
            item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, **held)
        item.properties.action = action.name


def _remove_keys() -> None:
    while _registered:
        keymap, item = _registered.pop()
        keymap.keymap_items.remove(item)
    remove(NAME)


register, unregister = together(*classes(MESH_OT_seamwire_key), (_add_keys, _remove_keys))


def empty(name: str) -> None:
    """Remove the add-on's items from a keymap. Otherwise they would stay in the user's keymap."""
    configurations = bpy.context.window_manager.keyconfigs
    keymap = configurations.addon.keymaps.get(name) if configurations.addon is not None else None
    if keymap is not None:
        while keymap.keymap_items:
            keymap.keymap_items.remove(keymap.keymap_items[0])
        configurations.update()


def remove(name: str) -> None:
    """Remove a keymap that only the add-on uses."""
    empty(name)
    configurations = bpy.context.window_manager.keyconfigs
    for configuration in (configurations.addon, configurations.default):
        keymap = configuration.keymaps.get(name) if configuration is not None else None
        if keymap is not None:
            configuration.keymaps.remove(keymap)
