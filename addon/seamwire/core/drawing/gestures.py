# SPDX-License-Identifier: GPL-3.0-or-later
"""The gestures of a session: those at the cursor, and those that are committed and wait for the library."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message
from .bend import BendGesture
from .extension import Extension
from .line import LineGesture
from .loop import LoopGesture, NextOffer
from .wire import WireGesture

if TYPE_CHECKING:
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Waiting
    from .retrace import Retrace
    from .seed_drag import SeedDrag


class Gestures:
    """All gestures of a session.

    Parameters
    ----------
    drawing
        The state that they share.

    Attributes
    ----------
    wire, loop, bend, extension
        The gestures that a click can commit.
    drag, line
        The gesture while a button is held, otherwise None.
    retraces
        Kept wires that take another course once it is computed. Nothing waits for them.
    queue
        Committed gestures that wait, the oldest first. They are committed in this order.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.wire = WireGesture(drawing)
        self.loop = LoopGesture(drawing, self.wire)
        self.bend = BendGesture(drawing, self.loop)
        self.extension = Extension(drawing, self.wire)
        self.drag: SeedDrag | None = None
        self.line: LineGesture | None = None
        self.retraces: list[Retrace] = []
        self.queue: list[Waiting] = []
        self._told_none = False

    @property
    def lines(self) -> list[LineGesture]:
        """The lines whose wires are shown: those that wait, and the one that is drawn."""
        waiting = [one.gesture for one in self.queue if isinstance(one.gesture, LineGesture)]
        return [*waiting, *([] if self.line is None else [self.line])]

    @property
    def computing(self) -> bool:
        """Whether the library works on anything shown."""
        return self.wire.computing or not self.loop.final or (self.drag is not None and not self.drag.final)

    @property
    def waiting(self) -> int:
        """The number of committed gestures that wait."""
        return len(self.queue) + len(self.retraces) + (self.drag is not None and self.drag.ending)

    @property
    def settled(self) -> bool:
        """Whether nothing would change the picture."""
        return self.line is None and not self.computing and not self.queue and not self.retraces

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute something for what is shown or waits."""
        under_way = [self.wire, self.loop, *(one.gesture for one in self.queue), *self.retraces]
        under_way += [held for held in (self.drag, self.line) if held is not None]
        # A loop that waits is computed even if no offers are shown.
        cuts = self._drawing.options.along == "SURFACE" and any(one.gesture is self.loop for one in self.queue)
        return [
            *(live for gesture in under_way for live in gesture.lives()),
            *([self._drawing.engines.cuts()] if cuts else []),
        ]

    def read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self._drawing.progress = min(live.progress() for live in self.lives())

    def poll_offers(self, message: Message) -> tuple[bool, Message]:
        """Show the offers at the cursor once they are computed.

        Parameters
        ----------
        message
            The message that is shown.

        Returns
        -------
        tuple
            Whether other offers are to be seen, and the message from here on.
        """
        loop = self.loop
        if not any(isinstance(one.gesture, LoopGesture | BendGesture | NextOffer) for one in self.queue):
            loop.stop_waiting()
        changed = loop.poll()
        message = loop.problem or message
        offers = loop.offers
        none = bool(offers.NONE) and offers.missing and offers.final and not loop.cuts.bends
        if none != self._told_none and (not none or not message):
            self._told_none = none
            if none or message == loop.cuts.NONE:
                message = offers.NONE if none else NOTHING
        return changed, message

    def poll_extension(self, message: Message) -> tuple[bool, Message]:
        """Show the way to the end while it is asked for. The result is that of `poll_offers`."""
        if not self.extension.wanted:
            return False, message
        changed = self.extension.poll()
        return changed, self.extension.message or message
