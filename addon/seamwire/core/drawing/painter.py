# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pictures of a drawing and its gestures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..network.picks import undirected
from .intent import Intent
from .line import LineGesture
from .picture import Choice, Offered, Picture, kept_wires, shown_seeds, shown_wires
from .seed_drag import SeedDrag

if TYPE_CHECKING:
    from ..base.messages import Message
    from ..network.network import Network
    from .drawing import Drawing
    from .extension import Extension
    from .gesture import UnderWay
    from .loop import LoopGesture
    from .picture import ShownWire, Work
    from .wire import WireGesture


class Painter:
    """Makes a picture when something has changed, otherwise returns the last one.

    Parameters
    ----------
    drawing
        The network and the settings.
    live, loops, extension
        The gestures at the cursor.
    under_way
        The gestures that are held or wait.
    """

    def __init__(
        self, drawing: Drawing, live: WireGesture, loops: LoopGesture, extension: Extension, under_way: UnderWay
    ) -> None:
        self._drawing = drawing
        self._live = live
        self._loops = loops
        self._extension = extension
        self._under_way = under_way
        self._last: tuple[object, Picture] | None = None
        self._kept: tuple[Network, tuple[ShownWire, ...]] | None = None

    def picture(self, revision: int, message: Message, work: Work) -> Picture:
        """Return a picture with a revision, a message, and the running computation."""
        key = (revision, self._drawing.network_revision, message, work)
        if self._last is None or self._last[0] != key:
            self._last = (key, self._painted(revision, message, work))
        return self._last[1]

    def _painted(self, revision: int, message: Message, work: Work) -> Picture:
        drawing, loops, under_way = self._drawing, self._loops, self._under_way
        options, live, drag = drawing.options, self._live.candidates, under_way.holds(SeedDrag)
        line = under_way.holds(LineGesture)
        network = drawing.network if drag is None else drag.network
        lines = [gesture for gesture in under_way.gestures if isinstance(gesture, LineGesture)]
        offers, target = loops.offers, live.target
        seed = drawing.network.seed
        closing = drawing.network.closing_point
        hovered = target.pick if target is not None and target.to == "SEED" else None
        begins = [wire.start for each in lines for wire in each.wires]
        shown = shown_wires(
            self._kept_wires(network),
            network,
            options,
            live,
            drag,
            lines,
            offers.wire,
            self._extension.wire,
            lambda wire: drawing.images.of(wire, network, False),
        )
        hovered = hovered if drag is None else undirected(drag.place)
        return Picture(
            options=options,
            revision=revision,
            network_revision=drawing.network_revision,
            wires=shown,
            seeds=shown_seeds(drawing.seeds(network), drawing.seed_place, closing, hovered, begins),
            strokes=network.strokes,
            line=None if line is None else line.points,
            target=target,
            seed=None if seed is None else seed.begins(options.along),
            choice=Choice(live.number, 1 + len(live.others), live.straight_active, live.ring_active),
            offered=Offered(offers.kinds, offers.choice, loops.bends),
            intent=self._intent(work.computing),
            can_close=closing is not None,
            can_bend=options.along == "SURFACE" and loops.cuts.bendable(network) is not None,
            can_undo=bool(under_way.gestures) or drawing.history.can_undo(drawing.network),
            can_redo=drawing.history.can_redo,
            strength=drawing.strength,
            work=work,
            message=message,
        )

    def _kept_wires(self, network: Network) -> tuple[ShownWire, ...]:
        if self._kept is None or self._kept[0] is not network:
            drag = self._under_way.holds(SeedDrag)
            self._kept = (network, kept_wires(network, () if drag is None else drag.moved))
        return self._kept[1]

    def _intent(self, computing: bool) -> Intent:
        """Return the effect of a click."""
        along, live, seed = self._drawing.options.along, self._live.candidates, self._drawing.network.seed
        if self._under_way.holds(SeedDrag) is not None:
            return Intent.MOVE
        if self._under_way.holds(LineGesture) is not None:
            return Intent.DRAW
        if self._extension.wire is not None:
            return Intent.RUN
        if self._loops.offers.wire is not None:
            return Intent.LOOP
        if live.target is None or (along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if live.active_final:
            return self._live.ending(live.target) or Intent.KEEP
        waits = computing and not seed.at(live.target.pick, along)
        return Intent.WAIT if waits else Intent.NOTHING
