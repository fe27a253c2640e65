# SPDX-License-Identifier: GPL-3.0-or-later
"""The states of a chain, and the chain that is being drawn. It needs no NumPy, so that Blender's start does not wait for it."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .chain import Chain


class Stage(Enum):
    """A state of a chain."""

    READY = "waits for its first click"
    PEEKING = "shows the loop under the mouse, while a key is held"
    DRAWING = "is drawn, and no button is held"
    HOLDING = "is drawn, and a button is held"
    ENDING = "ends as soon as all wires are computed"
    OVER = "has nothing live any more"
    CLOSED = "is in the mesh, or dropped"


class Cue(Enum):
    """A reason why a chain changes its state."""

    BEGIN = "something is done under the mouse"
    PEEK = "a key is pressed that shows the loop under the mouse"
    UNPEEK = "the key is released, another key is pressed, or the window loses the focus"
    PRESS = "a button is pressed that drags something"
    RELEASE = "the button is released"
    LET_GO = "Undo, Esc, a right click or a refusal cancels what is held"
    WAIT = "the end is asked for, and a wire is still computed"
    END = "the end is asked for, or the last wire is computed"
    SETTLE = "nothing is live any more"
    CLOSE = "the operator ends, or the wires cannot be written"


TRANSITIONS: dict[tuple[Stage, Cue], Stage] = {
    (Stage.READY, Cue.BEGIN): Stage.DRAWING,
    (Stage.READY, Cue.PEEK): Stage.PEEKING,
    (Stage.PEEKING, Cue.UNPEEK): Stage.DRAWING,
    (Stage.DRAWING, Cue.PRESS): Stage.HOLDING,
    (Stage.DRAWING, Cue.WAIT): Stage.ENDING,
    (Stage.DRAWING, Cue.END): Stage.OVER,
    (Stage.DRAWING, Cue.SETTLE): Stage.OVER,
    (Stage.HOLDING, Cue.RELEASE): Stage.DRAWING,
    (Stage.HOLDING, Cue.LET_GO): Stage.DRAWING,
    (Stage.ENDING, Cue.BEGIN): Stage.DRAWING,
    (Stage.ENDING, Cue.END): Stage.OVER,
    **{(stage, Cue.CLOSE): Stage.CLOSED for stage in Stage if stage not in {Stage.HOLDING, Stage.CLOSED}},
}
"""Every allowed change of the state. `docs/development/structure.md` has the same table with what happens."""

running: list[Chain] = []
"""The chain that is being drawn."""
