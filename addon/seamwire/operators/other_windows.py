# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets a chain, or an operator that takes steps, have the events of other windows.

Blender sends an operator only the events of the window where it began. So an operator of `draw.py` listens in each other window meanwhile.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import MutableSet

OPERATOR = "mesh.seamwire_listen"
listening: MutableSet[int] = set()
"""The addresses of the windows where the operator runs."""


def listen(home: bpy.types.Window) -> None:
    """Listen in all windows beside that of what runs."""
    for window in bpy.context.window_manager.windows:
        if window != home and window.as_pointer() not in listening:
            with bpy.context.temp_override(window=window):
                bpy.ops.mesh.seamwire_listen("INVOKE_DEFAULT")
