# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys, registered with Blender so that users can change them."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import TOOL
from ..operators.keymaps import ACTION_OPERATOR, NAME
from ..words.keys import KEYS, Action

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
    configurations = bpy.context.window_manager.keyconfigs
    if configurations.addon is None:  # background mode has no keymaps
        return
    keymap = configurations.addon.keymaps.new(name="Mesh", space_type="EMPTY")
    item = keymap.keymap_items.new("wm.tool_set_by_id", **START)
    _registered.append((keymap, item))
    item.properties.name = TOOL
    # Blender copies an add-on's keymap to the user's only if its own configuration has a keymap with this name.
    configurations.default.keymaps.new(name=NAME, **_SPACE)
    keymap = configurations.addon.keymaps.new(name=NAME, **_SPACE)
    for action, key in KEYS:
        held = {name: getattr(key, name) for name in ("ctrl", "shift", "alt")}
        given = {"any": True} if set(held.values()) == {-1} else {name: want == 1 for name, want in held.items()}
        item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, **given)
        item.properties.action = action.name


def _remove_keys() -> None:
    while _registered:
        keymap, item = _registered.pop()
        keymap.keymap_items.remove(item)
    empty(NAME)
    configurations = bpy.context.window_manager.keyconfigs
    for configuration in (configurations.addon, configurations.default):
        keymap = configuration.keymaps.get(NAME) if configuration is not None else None
        if keymap is not None:
            configuration.keymaps.remove(keymap)


def empty(name: str) -> None:
    """Remove the add-on's items from a keymap. Otherwise they would stay in the user's keymap."""
    configurations = bpy.context.window_manager.keyconfigs
    keymap = configurations.addon.keymaps.get(name) if configurations.addon is not None else None
    if keymap is not None:
        while keymap.keymap_items:
            keymap.keymap_items.remove(keymap.keymap_items[0])
        configurations.update()


# Keys that were added before an error are removed too.
register, unregister = together(*classes(MESH_OT_seamwire_key), (lambda: None, _remove_keys), (_add_keys, lambda: None))
