# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user's keymaps do: the keys of a chain, and events that move the view, save, or end a chain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..words.keys import KEYS, MODIFIERS, Action, Bindings, Key

if TYPE_CHECKING:
    from ..view.viewport import Place


ACTION_OPERATOR = "mesh.seamwire_key"
"""Stands for what a key does within a chain; it does nothing by itself."""
NAME = "Seamwire"
"""The name of the keymap that holds those keys."""
HELP_PANEL = "VIEW3D_PT_seamwire_help"
"""The panel with all keys."""


def key_of(item: bpy.types.KeyMapItem) -> Key:
    if item.any:
        return Key(item.type, item.value, -1, -1, -1, -1)
    # From 5.0 on a modifier of -1 means either; before, a flag tells.
    return Key(item.type, item.value, *(int(getattr(item, name)) for name in MODIFIERS))


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
    items = [item for item in items_of(keymap, ACTION_OPERATOR) if item.active and item.key_modifier == "NONE"]
    return Bindings([(Action[item.properties.action], key_of(item)) for item in items])


KEYMAPS = ("Mesh", "3D View Generic", "3D View", "Object Non-modal", "Frames", "Screen", "Screen Editing", "Window")
"""The keymaps of a 3D view in Edit Mode, in the order in which Blender asks them."""
_NAVIGATION = tuple(
    f"view3d.{name}"
    for name in ("rotate", "move", "zoom", "dolly", "view", "ndof", "navigate", "walk", "fly", "smoothview")
)
"""How the names of operators that move the view begin."""
_HARMLESS = (
    *_NAVIGATION,
    *(f"view3d.{name}" for name in ("clip_border", "cursor3d", "toggle_shading", "toggle_xray")),
    *(
        f"screen.{name}"
        for name in ("animation", "frame", "region", "screen_full_area", "screenshot", "space_", "header")
    ),
    *(f"wm.{name}" for name in ("context_", "save", "window_fullscreen")),
)
"""How the names of operators begin that change neither the mesh nor the mode."""
_HARMLESS_PIES = frozenset({"VIEW3D_MT_view_pie", "VIEW3D_MT_shading_pie", "VIEW3D_MT_shading_ex_pie"})
_GIZMO_MARGIN = 10.0
_GIZMO_BUTTON = 28.0
_GIZMO_BUTTONS = 5


def is_other(event: bpy.types.Event, manager: bpy.types.WindowManager) -> bool:
    """Return whether an event over a 3D view in Edit Mode does something that a chain must end for."""
    item = _item_for(event, manager)
    return item is not None and not _is_harmless(item)


def is_for_blender(event: bpy.types.Event, context: bpy.types.Context) -> bool:
    """Return whether an event beside running steps goes to Blender: it is harmless, or is neither over a 3D view nor undoes anything."""
    from ..view.viewport import place_of

    item, place = _item_for(event, context.window_manager), place_of(context.window, event)
    if event.type in {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"} or (item is not None and _is_harmless(item)):
        return True
    return not _undoes(item) if place is None else on_gizmo_with(event, place, context)


def undoes(event: bpy.types.Event, manager: bpy.types.WindowManager) -> bool:
    """Return whether an event would undo or redo a step of Blender's."""
    return _undoes(_item_for(event, manager))


def _undoes(item: bpy.types.KeyMapItem | None) -> bool:
    return item is not None and item.idname in {"ed.undo", "ed.redo", "ed.undo_history"}


def right_click_cancels(manager: bpy.types.WindowManager) -> bool:
    """Return whether a right click cancels what runs. It does not if the user's keymap selects or moves the view with it."""
    return not any(
        item.type == "RIGHTMOUSE"
        and item.idname.startswith(("view3d.select", *_NAVIGATION))
        and (item.any or not any(int(getattr(item, name)) == 1 for name in MODIFIERS))
        for item in _items_of_view(manager)
    )


def _items_of_view(manager: bpy.types.WindowManager) -> list[bpy.types.KeyMapItem]:
    keymap = user_keymap(manager, "3D View")
    return [] if keymap is None else [item for item in keymap.keymap_items if item.active]


def _item_for(event: bpy.types.Event, manager: bpy.types.WindowManager) -> bpy.types.KeyMapItem | None:
    if event.value not in {"PRESS", "CLICK", "DOUBLE_CLICK", "CLICK_DRAG", "ANY"} or event.type.startswith("TIMER"):
        return None
    for name in KEYMAPS:
        keymap = user_keymap(manager, name)
        item = keymap.keymap_items.match_event(event) if keymap is not None else None
        if item is not None and item.active:
            return item
    return None


def _is_harmless(item: bpy.types.KeyMapItem) -> bool:
    is_pie = item.idname == "wm.call_menu_pie" and item.properties.name in _HARMLESS_PIES
    return is_pie or item.idname.startswith(_HARMLESS)


def takes(key: Key, context: bpy.types.Context) -> bool:
    """Return whether the user's keymap moves the view with this button of the mouse. If so, the view comes first.

    With *Emulate 3 Button Mouse* in Blender's preferences, the left button can move the view as well.
    """
    if not key.type.endswith("MOUSE"):
        return False
    inputs = context.preferences.inputs
    if key.type == "LEFTMOUSE" and inputs.use_mouse_emulate_3_button:
        by_command = getattr(inputs, "mouse_emulate_3_button_modifier", "ALT") == "OSKEY"
        if (key.oskey if by_command else key.alt) == 1:
            return True
    inwards, outwards = ("DOWN", "UP") if inputs.invert_zoom_wheel else ("UP", "DOWN")
    wheel = {"WHEELINMOUSE": f"WHEEL{inwards}MOUSE", "WHEELOUTMOUSE": f"WHEEL{outwards}MOUSE"}
    return any(
        item.idname.startswith(_NAVIGATION)
        and wheel.get(item.type, item.type) == key.type
        and item.key_modifier == "NONE"
        and (item.any or all(int(getattr(item, name)) in {-1, getattr(key, name)} for name in MODIFIERS))
        for item in _items_of_view(context.window_manager)
    )


def keys(context: bpy.types.Context) -> Bindings:
    """Return the keys of a chain without the buttons that move the view."""
    return of_user(context.window_manager).without(lambda key: takes(key, context))


def on_gizmo_with(event: bpy.types.Event, place: Place, context: bpy.types.Context) -> bool:
    """Return whether a button of the mouse is pressed on the navigation gizmo."""
    return event.type.endswith("MOUSE") and not event.type.startswith("WHEEL") and on_gizmo(place, context.preferences)


def on_gizmo(place: Place, preferences: bpy.types.Preferences) -> bool:
    space = place.area.spaces.active
    if not (space.show_gizmo and space.show_gizmo_navigate):
        return False
    scale, view = preferences.system.ui_scale, preferences.view
    # Blender 3.4 does not tell its size.
    size = getattr(view, "gizmo_size_navigate_view", 80) if view.mini_axis_type == "GIZMO" else 0
    right, top = float(place.region.width), float(place.region.height)
    for other in place.area.regions:
        if other.type == "UI" and other.width > 1:
            right = min(right, float(other.x - place.region.x))
        elif other.type in {"HEADER", "TOOL_HEADER"} and other.height > 1 and other.y > place.region.y:
            top = min(top, float(other.y - place.region.y))
    wide = (size + 2.0 * _GIZMO_MARGIN) * scale if size else 2.0 * _GIZMO_BUTTON * scale
    high = (size + 2.0 * _GIZMO_MARGIN + _GIZMO_BUTTONS * _GIZMO_BUTTON) * scale
    if place.cursor[0] >= right - wide and place.cursor[1] >= top - (size + 2.0 * _GIZMO_MARGIN) * scale:
        return True
    return place.cursor[0] >= right - 2.0 * _GIZMO_BUTTON * scale and place.cursor[1] >= top - high


def zoom(context: bpy.types.Context, place: Place, event: bpy.types.Event) -> None:
    """Zoom by one notch of the wheel, as Blender does without Ctrl."""
    inwards = (event.type == "WHEELUPMOUSE") != context.preferences.inputs.invert_zoom_wheel
    x, y = (round(value) for value in place.cursor)
    with context.temp_override(area=place.area, region=place.region):
        bpy.ops.view3d.zoom(delta=1 if inwards else -1, mx=x, my=y, use_cursor_init=True)
