# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of a chain as Blender's keymaps hold them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..words.keys import KEYS, Action, Bindings, Key

if TYPE_CHECKING:
    import bpy

ACTION_OPERATOR = "mesh.seamwire_key"
"""Stands for what a key does within a chain; it does nothing by itself."""
NAME = "Seamwire"
"""The name of the keymap that holds those keys."""
HELP_PANEL = "VIEW3D_PT_seamwire_help"
"""The panel with all keys."""


def key_of(item: bpy.types.KeyMapItem) -> Key:
    """Return the key of one of Blender's keymap items."""
    if item.any:
        return Key(item.type, item.value, -1, -1, -1, -1)
    # From 5.0 on a modifier of -1 means either; before, a flag tells.
    return Key(item.type, item.value, *(int(getattr(item, name)) for name in ("ctrl", "shift", "alt", "oskey")))


def user_keymap(manager: bpy.types.WindowManager, name: str = NAME) -> bpy.types.KeyMap | None:
    """Return a keymap with the user's changes, that of a chain's keys by default; None where there are no keymaps."""
    configuration = manager.keyconfigs.user
    return configuration.keymaps.get(name) if configuration is not None else None


def items_of(keymap: bpy.types.KeyMap | None, idname: str) -> list[bpy.types.KeyMapItem]:
    """Return a keymap's items of one operator, as the add-on has them: a chain's in the order of `KEYS`.

    Blender hands the items that add-ons added to the user's keymap on newest first. An action's keys that the user has
    changed come before its others.
    """
    items = [] if keymap is None else [item for item in reversed(keymap.keymap_items) if item.idname == idname]
    if idname != ACTION_OPERATOR:
        return items
    actions = [action.name for action, _ in KEYS]
    own = {(action.name, key): i for i, (action, key) in enumerate(KEYS)}

    def place(item: bpy.types.KeyMapItem) -> tuple[int, int]:
        action = item.properties.action
        return actions.index(action), own.get((action, key_of(item)), -1)

    return sorted((item for item in items if item.properties.action in actions), key=place)


def of_user(manager: bpy.types.WindowManager) -> Bindings:
    """Return what the user has set in Blender's preferences; the defaults where there are no keymaps."""
    keymap = user_keymap(manager)
    if keymap is None:
        return Bindings()
    items = items_of(keymap, ACTION_OPERATOR)
    return Bindings(
        [
            (Action[item.properties.action], key_of(item))
            for item in items
            if item.active and item.key_modifier == "NONE"
        ]
    )
