# SPDX-License-Identifier: GPL-3.0-or-later
"""Named steps of Blender's undo for what a chain did.

Blender's *Adjust Last Operation* undoes everything back to the operator that was registered last, then runs that operator again.
A plain `ed.undo_push` registers nothing, so adjusting an operator from before the chain would remove the chain. Therefore each step
has an operator that pushes it. These operators have no properties and no `execute`, so Blender offers nothing to adjust or repeat.
Blender's own box would be empty, so `SeamwireShowHint` takes its key (F9) and says how to change what was drawn.
"""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..mesh.registration import classes, together
from ..words.reports import ADJUST_DRAWN, ADJUST_EDITED

DRAW = "Draw Seamwires"
"""The step of a chain that drew wires, loops or strokes."""
EDIT = "Edit Seamwires"
"""The step of a chain that moved, swapped, bent or removed wires or strokes."""
HINTS = {DRAW: ADJUST_DRAWN, EDIT: ADJUST_EDITED}
"""The text after a step."""
HINT = "mesh.seamwire_show_hint"


class _UndoStep:
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "INTERNAL"}

    def invoke(self, _context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Let Blender push the step."""
        return {"FINISHED"}


class MESH_OT_seamwire_step_draw(_UndoStep, bpy.types.Operator):
    """Push a step of undo for a chain"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_step_draw"
    bl_label = DRAW


class MESH_OT_seamwire_step_edit(_UndoStep, bpy.types.Operator):
    """Push a step of undo for a chain"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_step_edit"
    bl_label = EDIT


_STEPS = (MESH_OT_seamwire_step_draw, MESH_OT_seamwire_step_edit)


class SeamwireShowHint(bpy.types.Operator):
    """A box that says how to change what was drawn."""

    bl_idname = HINT
    bl_label = "Adjust Last Operation"
    bl_description = "Say how to change what was drawn"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether the last operator pushed a step of undo for a chain. After other operators the key is Blender's."""
        return _last_title(context) is not None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Show the text until the mouse leaves it."""
        title = _last_title(context)

        def show(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
            for hint in HINTS[title]:
                menu.layout.label(text=hint)

        context.window_manager.popup_menu(show, title=title)
        return {"FINISHED"}


def _last_title(context: bpy.types.Context) -> str | None:
    operators = context.window_manager.operators
    last = operators[-1].bl_idname if operators else ""
    return next((step.bl_label for step in _STEPS if step.__name__ == last), None)


def push(title: str) -> None:
    """Push a step of undo, `DRAW` or `EDIT`, and let it be the last operator."""
    step = bpy.ops.mesh.seamwire_step_draw if title == DRAW else bpy.ops.mesh.seamwire_step_edit
    step("INVOKE_DEFAULT", True)


register, unregister = together(*classes(*_STEPS, SeamwireShowHint))
