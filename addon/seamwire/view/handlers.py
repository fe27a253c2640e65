# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on what Blender draws and loads to the objects that are drawn on. As long as the tool is not used, nothing else is imported."""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING

import bpy
from bpy.app.handlers import persistent

from ..mesh.registration import Timer, handler, together
from ..mesh.settings import ADDON, listeners, tool_is_active

if TYPE_CHECKING:
    from collections.abc import Callable


_PARTS = {"POST_VIEW": "draw_in_scene", "POST_PIXEL": "draw_on_screen"}
"""When Blender draws each part of an overlay."""
_RECORDS = "mesh.object_session"
"""The module that knows the records of wires."""
_handles: list[object] = []


def _draw(part: str) -> None:
    objects = sys.modules.get(f"{__package__}.edited_objects")
    if objects is not None:
        objects.edited.draw(part)
    elif tool_is_active(bpy.context):
        _start.start()  # not at once: importing NumPy takes a moment


def _import() -> None:
    from .edited_objects import edited

    edited.watch()


_start = Timer(_import)


def _hand_on(name: str, module: str = "view.edited_objects") -> Callable[..., None]:
    """Return a function that calls a function of a module, or a method of `edited`, with what Blender gives it."""

    @persistent
    def call(*given: object) -> None:
        loaded = sys.modules.get(f"{ADDON}.{module}")
        if loaded is not None:
            getattr(getattr(loaded, "edited", loaded), name)(*given)

    return call


def _begin() -> None:
    if not bpy.app.background:
        add = bpy.types.SpaceView3D.draw_handler_add
        _handles.extend(add(_draw, (part,), "WINDOW", when) for when, part in _PARTS.items())


def _end() -> None:
    _start.stop()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")


_follow = _hand_on("on_settings")

register, unregister = together(
    (_begin, _end),
    (partial(listeners.append, _follow), partial(listeners.remove, _follow)),
    handler("depsgraph_update_post", _hand_on("on_update")),
    handler("frame_change_post", _hand_on("on_frame")),
    handler("undo_post", _hand_on("on_undo")),
    handler("redo_post", _hand_on("on_undo")),
    handler("save_pre", _hand_on("refresh")),
    handler("save_pre", _hand_on("complete_records", _RECORDS)),
    handler("load_pre", _hand_on("clear")),
    handler("load_post", _hand_on("forget_records", _RECORDS)),
)
