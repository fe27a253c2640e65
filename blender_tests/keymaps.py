# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's preset keymaps, and what moves the view in them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

KEYMAPS = {
    "Blender": ("Blender", "LEFT"),
    "Industry Compatible": ("Industry_Compatible", ""),
    "Blender 2.7x": ("Blender_27x", ""),
    "right-click select": ("Blender", "RIGHT"),
}
"""The files of Blender's preset keymaps, and the button that selects where there is a choice."""


Gesture = tuple[str, str, str, dict[str, bool]]
"""Type, value, direction and modifiers of an event."""
_MOVES = (
    "rotate",
    "move",
    "zoom",
    "dolly",
    "view_axis",
    "view_orbit",
    "view_pan",
    "view_roll",
    "view_all",
    "view_selected",
)
"""Blender's operators that move the view at once; the rest begins walking, or needs a camera."""


@contextmanager
def using(name: str) -> Iterator[None]:
    """Use one of `KEYMAPS`, and then again what was used before."""
    file, button = KEYMAPS[name]
    manager = bpy.context.window_manager
    before = manager.keyconfigs.active.name
    folders = [Path(folder) for folder in bpy.utils.preset_paths("keyconfig")]
    path = next(folder / f"{file}.py" for folder in folders if (folder / f"{file}.py").exists())
    bpy.utils.keyconfig_set(str(path))
    if button:
        manager.keyconfigs.active.preferences.select_mouse = button
    try:
        yield
    finally:
        if button:
            manager.keyconfigs.active.preferences.select_mouse = "LEFT"
        manager.keyconfigs.active = manager.keyconfigs[before]


def gestures(buttons: bool) -> list[Gesture]:
    """Return the buttons, or the keys, that move the view in the user's keymap."""
    found = []
    for item in bpy.context.window_manager.keyconfigs.user.keymaps["3D View"].keymap_items:
        simulated = not item.type.startswith("NDOF") and item.type not in {"MOUSEROTATE", "TRACKPADZOOM"}
        of_hand = item.type.endswith("MOUSE") or item.type == "TRACKPADPAN"
        if item.active and item.idname in {f"view3d.{name}" for name in _MOVES} and simulated and of_hand == buttons:
            held = {name: True for name in ("shift", "ctrl", "alt") if getattr(item, name) == 1}
            found.append((item.type, item.value, getattr(item, "direction", "ANY"), {} if item.any else held))
    assert len(found) > 7
    return found


def as_event(kind: str) -> str:
    """Return the type of the event that a keymap's type is of: what the wheel does depends on the user there."""
    return {"WHEELINMOUSE": "WHEELUPMOUSE", "WHEELOUTMOUSE": "WHEELDOWNMOUSE"}.get(kind, kind)
