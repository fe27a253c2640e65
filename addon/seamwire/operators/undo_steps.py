# SPDX-License-Identifier: GPL-3.0-or-later
"""Named steps of Blender's undo for what a chain did.

Blender's *Adjust Last Operation* undoes everything back to the operator that was registered last, then runs that operator again.
A plain `ed.undo_push` registers nothing, so adjusting an operator from before the chain would remove the chain. Therefore each step
has an operator that pushes it. These operators have no properties and no `execute`, so Blender offers nothing to adjust or repeat.
Blender's own box would be empty, so `SeamwireShowHint` takes its key (F9) and says how to change what was drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..words.reports import ADJUST_STROKE, ADJUST_WIRE, NOTHING_TO_ADJUST

if TYPE_CHECKING:
    from collections.abc import Sequence

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


HINTS = {
    REMOVE_WIRE: NOTHING_TO_ADJUST,
    REMOVE_STROKE: NOTHING_TO_ADJUST,
    GUIDE_STROKE: ADJUST_STROKE,
    AVOID_STROKE: ADJUST_STROKE,
}
"""The text after a step. After all other steps it says how to change a wire."""


def _name(title: str) -> str:
    return f"seamwire_step_{title.lower().replace(' ', '_')}"


def _invoke(_self: bpy.types.Operator, _context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
    """Let Blender push a step of undo."""
    return {"FINISHED"}


def _operator(title: str) -> type[bpy.types.Operator]:
    """Return the operator that pushes the step with a title."""
    body = {
        "__doc__": "Push a step of undo for a chain",
        "bl_idname": f"mesh.{_name(title)}",
        "bl_label": title,
        "bl_options": {"REGISTER", "UNDO", "INTERNAL"},
        "invoke": _invoke,
    }
    return type(f"MESH_OT_{_name(title)}", (bpy.types.Operator,), body)


_CLASSES = tuple(_operator(title) for title in _TITLES)
_TITLE_OF = {cls.__name__: cls.bl_label for cls in _CLASSES}
HINT = "mesh.seamwire_show_hint"


class SeamwireShowHint(bpy.types.Operator):
    """A box that says how to change what was drawn."""

    bl_idname = HINT
    bl_label = "Adjust Last Operation"
    bl_description = "Say how to change what was drawn"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether the last operator pushed a step of undo for a chain. After other operators the key is Blender's."""
        return _last_title(context) is not None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Show the text until the mouse leaves it."""
        title = _last_title(context)
        hints: Sequence[str] = HINTS.get(title, ADJUST_WIRE)

        def show(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
            for hint in hints:
                menu.layout.label(text=hint)

        context.window_manager.popup_menu(show, title=title)
        return {"FINISHED"}


def _last_title(context: bpy.types.Context) -> str | None:
    operators = context.window_manager.operators
    return _TITLE_OF.get(operators[-1].bl_idname) if operators else None


def push(title: str) -> None:
    """Push a step of undo, and let it be the last operator.

    Parameters
    ----------
    title
        One of the constants of this module.
    """
    getattr(bpy.ops.mesh, _name(title))("INVOKE_DEFAULT", True)


register, unregister = together(*classes(*_CLASSES, SeamwireShowHint))
