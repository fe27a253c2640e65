# SPDX-License-Identifier: GPL-3.0-or-later
"""The bend gesture: the last closed cut moves to a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..network.picks import pick_name
from .gesture import Gesture

if TYPE_CHECKING:
    from ..network.network import Snap
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Committed
    from .loop import LoopGesture


class BendGesture(Gesture):
    """The last closed cut, bent: the shortest one through its first point and the target that lies around the same.

    The next bend moves the second point. One step for undo restores the old cut.
    """

    needs_offers = True

    def __init__(self, drawing: Drawing, loops: LoopGesture) -> None:
        self._drawing = drawing
        self._loops = loops
        self._target: Snap | None = None

    def aim(self, target: Snap | None) -> str:
        """Bend the cut to a target, across the surface only."""
        self._target = target
        if target is None:
            return ""
        if self._drawing.options.along == "EDGES" or not self._loops.cuts.takes(target.pick):
            return f"Closed cuts bend to places on the surface, not to {pick_name(target.pick)}"
        self._loops.cuts.bend(True)
        return ""

    def commit(self) -> Committed:
        """Return the network with the bent cut."""
        assert self._target is not None
        done = self._loops.commit_cut(self._target)
        return self if done is self._loops else done

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute closed cuts."""
        return [self._drawing.engines.cuts()]
