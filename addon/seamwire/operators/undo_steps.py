# SPDX-License-Identifier: GPL-3.0-or-later
"""Named steps of Blender's undo for what a chain did.

Blender's *Adjust Last Operation* undoes everything back to the operator that was registered last, then runs that operator again.
A plain `ed.undo_push` registers nothing, so adjusting an operator from before the chain would remove the chain. Therefore each step
has an operator that pushes it. These operators have no properties and no `execute`, so Blender offers nothing to adjust or repeat.
Where the artist asks for it (F9), they say how to change what was drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..words.reports import ADJUST_STROKE, ADJUST_WIRE, NOTHING_TO_ADJUST

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

DRAW_SEVERAL = "Draw Seamwires"
"""The step of a chain that did several of these."""
DRAW_WIRES = "Draw Wires"
DRAW_LINE = "Draw Line"
ADD_LOOP = "Add Loop"
BEND_CUT = "Bend Closed Cut"
MOVE_SEED = "Move Seed"
RETRACE = "Swap Path"
REMOVE_WIRE = "Remove Wire"
GUIDE_STROKE = "Draw Guide Stroke"
AVOID_STROKE = "Draw Avoid Stroke"
REMOVE_STROKE = "Remove Stroke"

_TITLES = (
    DRAW_SEVERAL,
    DRAW_WIRES,
    DRAW_LINE,
    ADD_LOOP,
    BEND_CUT,
    MOVE_SEED,
    RETRACE,
    REMOVE_WIRE,
    GUIDE_STROKE,
    AVOID_STROKE,
    REMOVE_STROKE,
)


_HINTS = {
    REMOVE_WIRE: NOTHING_TO_ADJUST,
    REMOVE_STROKE: NOTHING_TO_ADJUST,
    GUIDE_STROKE: ADJUST_STROKE,
    AVOID_STROKE: ADJUST_STROKE,
}
"""The text of the panel after a step. After all other steps it says how to change a wire."""


def _name(title: str) -> str:
    return f"seamwire_step_{title.lower().replace(' ', '_')}"


def _invoke(_self: bpy.types.Operator, _context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
    """Let Blender push a step of undo."""
    return {"FINISHED"}


def _drawer(hints: Sequence[str]) -> Callable[[bpy.types.Operator, bpy.types.Context], None]:
    """Return what draws the panel of a step."""

    def draw(self: bpy.types.Operator, _context: bpy.types.Context) -> None:
        column = self.layout.column()
        for hint in hints:
            column.label(text=hint)

    return draw


def _operator(title: str) -> type[bpy.types.Operator]:
    """Return the operator that pushes the step with a title."""
    body = {
        "__doc__": "Push a step of undo for a chain",
        "bl_idname": f"mesh.{_name(title)}",
        "bl_label": title,
        "bl_options": {"REGISTER", "UNDO", "INTERNAL"},
        "invoke": _invoke,
        "draw": _drawer(_HINTS.get(title, ADJUST_WIRE)),
    }
    return type(f"MESH_OT_{_name(title)}", (bpy.types.Operator,), body)


_CLASSES = tuple(_operator(title) for title in _TITLES)


def push(title: str) -> None:
    """Push a step of undo, and let it be the last operator.

    Parameters
    ----------
    title
        One of the constants of this module.
    """
    getattr(bpy.ops.mesh, _name(title))("INVOKE_DEFAULT", True)


register, unregister = together(*classes(*_CLASSES))
