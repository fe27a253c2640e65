# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pictures of a drawing and its gestures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..network.picks import undirected
from .intent import Intent
from .picture import Choice, Offered, Picture, Work, kept_wires, shown_seeds, shown_wires

if TYPE_CHECKING:
    from ..base.messages import Message
    from ..network.network import Network
    from .drawing import Drawing
    from .gestures import Gestures
    from .picture import ShownWire


class Painter:
    """Makes a picture when something has changed, otherwise returns the last one.

    Parameters
    ----------
    drawing, gestures
        Everything to be shown.
    """

    def __init__(self, drawing: Drawing, gestures: Gestures) -> None:
        self._drawing = drawing
        self._gestures = gestures
        self._last: tuple[object, Picture] | None = None
        self._kept: tuple[Network, tuple[ShownWire, ...]] | None = None

    @property
    def work(self) -> Work:
        """The running computation."""
        gestures = self._gestures
        return Work(gestures.computing, self._drawing.progress, gestures.waiting)

    def picture(self, revision: int, message: Message) -> Picture:
        """Return a picture with a revision and a message."""
        key = (revision, self._drawing.network_revision, message, self.work)
        if self._last is None or self._last[0] != key:
            self._last = (key, self._painted(revision, message))
        return self._last[1]

    def _painted(self, revision: int, message: Message) -> Picture:
        drawing, gestures = self._drawing, self._gestures
        options, loop, live, drag = drawing.options, gestures.loop, gestures.wire.candidates, gestures.drag
        network = drawing.network if drag is None else drag.network
        lines, offers, target = gestures.lines, loop.offers, live.target
        seed = drawing.network.seed
        closing = drawing.network.closing_point
        hovered = target.pick if target is not None and target.to == "SEED" else None
        begins = [wire.start for line in lines for wire in line.wires]
        shown = shown_wires(
            self._kept_wires(network),
            network,
            options,
            live,
            drag,
            lines,
            offers.wire,
            gestures.extension.wire,
            lambda wire: drawing.images.of(wire, network, False),
        )
        hovered = hovered if drag is None else undirected(drag.place)
        under_way = gestures.queue or drag or gestures.line or gestures.retraces
        return Picture(
            options=options,
            revision=revision,
            network_revision=drawing.network_revision,
            wires=shown,
            seeds=shown_seeds(drawing.seeds(network), drawing.seed_place, closing, hovered, begins),
            strokes=network.strokes,
            line=None if gestures.line is None else gestures.line.points,
            target=target,
            seed=None if seed is None else seed.begins(options.along),
            choice=Choice(live.number, 1 + len(live.others), live.straight_active, live.ring_active),
            offered=Offered(offers.kinds, offers.choice, loop.bends),
            intent=self._intent,
            can_close=closing is not None,
            can_bend=options.along == "SURFACE" and loop.cuts.bendable(network) is not None,
            can_undo=bool(under_way) or drawing.history.can_undo(drawing.network),
            can_redo=drawing.history.can_redo,
            strength=drawing.strength,
            work=self.work,
            message=message,
        )

    def _kept_wires(self, network: Network) -> tuple[ShownWire, ...]:
        if self._kept is None or self._kept[0] is not network:
            drag = self._gestures.drag
            self._kept = (network, kept_wires(network, () if drag is None else drag.moved))
        return self._kept[1]

    @property
    def _intent(self) -> Intent:
        """The effect of a click."""
        gestures, along = self._gestures, self._drawing.options.along
        live, seed = gestures.wire.candidates, self._drawing.network.seed
        if gestures.drag is not None:
            return Intent.MOVE
        if gestures.line is not None:
            return Intent.DRAW
        if gestures.extension.wire is not None:
            return Intent.RUN
        if gestures.loop.offers.wire is not None:
            return Intent.LOOP
        if live.target is None or (along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if live.active_final:
            return gestures.wire.ending(live.target) or Intent.KEEP
        waits = gestures.computing and not seed.at(live.target.pick, along)
        return Intent.WAIT if waits else Intent.NOTHING
