# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on what Blender draws and loads to the objects that are drawn on. As long as the tool is not used, nothing else is imported."""

from __future__ import annotations

import sys

import bpy

from ..mesh.settings import tool_is_active
from .timer import Timer

_PARTS = {"POST_VIEW": "draw_in_scene", "POST_PIXEL": "draw_on_screen"}
"""When Blender draws each part of an overlay."""
_handles: list[object] = []
_OBJECTS = f"{__package__}.edited_objects"


def _draw(part: str) -> None:
    objects = sys.modules.get(_OBJECTS)
    if objects is not None:
        objects.edited.draw(part)
    elif tool_is_active(bpy.context):
        _start.start()  # not at once: importing NumPy takes a moment


def _import() -> None:
    from .edited_objects import edited

    edited.watch()


_start = Timer(_import)


@bpy.app.handlers.persistent
def _on_load(*_: object) -> None:
    """Forget what belongs to the file before."""
    session = sys.modules.get(f"{__package__.rpartition('.')[0]}.mesh.object_session")
    if session is not None:
        session.forget_records()


def register() -> None:
    """Begin to draw in all 3D views."""
    bpy.app.handlers.load_post.append(_on_load)
    if not bpy.app.background:
        add = bpy.types.SpaceView3D.draw_handler_add
        _handles.extend(add(_draw, (part,), "WINDOW", when) for when, part in _PARTS.items())


def unregister() -> None:
    """Draw nothing any more."""
    _start.stop()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    if _on_load in bpy.app.handlers.load_post:
        bpy.app.handlers.load_post.remove(_on_load)
