# SPDX-License-Identifier: GPL-3.0-or-later
"""Named steps of Blender's undo for what a chain did.

Blender's *Adjust Last Operation* undoes everything back to the operator that was registered last, then runs that operator again.
A plain `ed.undo_push` registers nothing, so adjusting an operator from before the chain would remove the chain. Therefore each step
has an operator that pushes it. These operators have no properties and no `execute`, so Blender offers nothing to adjust or repeat.
"""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..mesh.registration import classes, together

DRAW = "Draw Seamwires"
"""The step of a chain that drew wires, loops or strokes."""
EDIT = "Edit Seamwires"
"""The step of a chain that moved, swapped, bent or removed wires or strokes."""


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


def push(title: str) -> None:
    """Push a step of undo, `DRAW` or `EDIT`, and let it be the last operator."""
    step = bpy.ops.mesh.seamwire_step_draw if title == DRAW else bpy.ops.mesh.seamwire_step_edit
    step("INVOKE_DEFAULT", True)


register, unregister = together(*classes(MESH_OT_seamwire_step_draw, MESH_OT_seamwire_step_edit))
