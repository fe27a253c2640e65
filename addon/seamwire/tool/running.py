# SPDX-License-Identifier: GPL-3.0-or-later
"""What runs at the moment, and its ways to Blender: other windows, the status bar and steps of undo.

It needs no NumPy, so that Blender's start does not wait for it.
"""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING, Any

import bpy

from ..mesh.registration import classes, together

if TYPE_CHECKING:
    from collections.abc import Iterable, MutableMapping

    from ..words.hints import Hint

chains: list[Any] = []
"""The chain that is being drawn."""
steps: list[Any] = []
"""The operators that take steps beside the interface at the moment."""


class NeedsEditMode:
    """Gives an operator its poll: a mesh must be in Edit Mode."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = context.active_object
        if context.mode == "EDIT_MESH" and obj is not None and obj.type == "MESH":
            return True
        cls.poll_message_set("Needs a mesh in Edit Mode")
        return False


# Other windows: Blender sends an operator only the events of the window where it began. So an operator listens in every other window.

LISTEN = "mesh.seamwire_listen"
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


# The status bar


def draw_hints(header: bpy.types.Header, shown: Iterable[Hint]) -> None:
    row = header.layout.row(align=False)
    for icon, text in shown:
        row.label(text=text, icon=icon)


def show_status(shown: Iterable[Hint] | None) -> None:
    """Show hints in the status bar, or Blender's own again.

    All workspaces share the status bar, and the one of a chain may have been deleted. A text would be of one workspace only. Blender makes
    the function a method of its header class, and crashes on a bound method.
    """
    draw = None if shown is None else lambda header, _context: draw_hints(header, shown)
    bpy.data.workspaces[0].status_text_set(draw)


# Steps of undo: *Adjust Last Operation* undoes everything back to the operator that was registered last, then runs that operator again.
# A plain `ed.undo_push` registers nothing, so adjusting an operator from before the chain would remove the chain. Therefore each step
# has an operator that pushes it. These operators have no properties and no `execute`, so Blender offers nothing to adjust or repeat.

DRAW = "Draw Seamwires"
"""The step of a chain that drew wires, loops or strokes."""
EDIT = "Edit Seamwires"
"""The step of a chain that moved, swapped, bent or removed wires or strokes."""


def _undo_step(name: str, title: str) -> type[bpy.types.Operator]:
    body = {
        "__doc__": "Push a step of undo for a chain",
        "bl_idname": f"mesh.seamwire_step_{name}",
        "bl_label": title,
        "bl_options": {"REGISTER", "UNDO", "INTERNAL"},
        "invoke": lambda _step, _context, _event: {"FINISHED"},
    }
    return type(f"MESH_OT_seamwire_step_{name}", (bpy.types.Operator,), body)


def push(title: str) -> None:
    """Push a step of undo, `DRAW` or `EDIT`, and let it be the last operator."""
    step = bpy.ops.mesh.seamwire_step_draw if title == DRAW else bpy.ops.mesh.seamwire_step_edit
    step("INVOKE_DEFAULT", True)


register, unregister = together(
    (lambda: None, stop_listening), *classes(_undo_step("draw", DRAW), _undo_step("edit", EDIT))
)
