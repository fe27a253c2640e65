# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes the events of other windows to a chain, or to an operator that takes steps.

Blender sends an operator only the events of the window where it began. So an operator of `draw.py` listens in every other window meanwhile.
"""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import MutableMapping

OPERATOR = "mesh.seamwire_listen"
listening: MutableMapping[int, bpy.types.Timer | None] = {}
"""The timer of each window where the operator runs, by the window's address. None if the operator could not begin there."""


def listen(home: bpy.types.Window) -> None:
    """Listen in all windows beside that of what runs."""
    for window in bpy.context.window_manager.windows:
        if window == home or window.as_pointer() in listening:
            continue
        try:
            with bpy.context.temp_override(window=window):
                bpy.ops.mesh.seamwire_listen("INVOKE_DEFAULT")
        except (RuntimeError, ReferenceError, TypeError, AttributeError):
            traceback.print_exc()
            listening[window.as_pointer()] = None  # not tried again at each event


def stop_listening() -> None:
    """Remove all timers. Operators that are unregistered do not end by themselves."""
    for timer in listening.values():
        if timer is not None:
            bpy.context.window_manager.event_timer_remove(timer)
    listening.clear()
