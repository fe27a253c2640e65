# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pictures of a drawing and its gestures."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ...terms.choices import DEFAULT_FINISH
from ..network.picks import undirected
from .line import LineGesture
from .picture import Choice, Intent, Offered, Picture, Role, ShownWire, Work, shown_seeds
from .stroke import StrokeGesture

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...terms.choices import Finish
    from ..network.network import Network
    from ..network.wires import Wire
    from .cursor import Cursor
    from .drawing import Drawing
    from .line_wires import EdgeLine, SurfaceLine
    from .seed_drag import SeedDrag


class Painter:
    """Makes a picture when something has changed, otherwise returns the last one."""

    def __init__(self, drawing: Drawing, cursor: Cursor) -> None:
        self._drawing = drawing
        self._cursor = cursor
        self._last: tuple[object, Picture] | None = None
        self._kept: tuple[Network, tuple[ShownWire, ...]] | None = None

    def picture(self) -> Picture:
        """Return a picture of what there is now."""
        drawing, cursor = self._drawing, self._cursor
        work = Work(cursor.computing, drawing.progress, cursor.waiting)
        key = (drawing.revision, drawing.network_revision, drawing.told, work)
        if self._last is None or self._last[0] != key:
            self._last = (key, self._painted(work))
        return self._last[1]

    def _painted(self, work: Work) -> Picture:
        drawing, cursor, loops = self._drawing, self._cursor, self._cursor.loops
        options, live, drag = drawing.options, cursor.live, cursor.drag
        line = cursor.holds(LineGesture)
        network = drawing.network if drag is None else drag.network
        lines = [gesture.line for gesture in cursor.gestures if isinstance(gesture, LineGesture)]
        offers, target = loops.offers, live.target
        seed = drawing.network.seed
        closing = drawing.network.closing_point
        hovered = target.pick if target is not None and target.to == "SEED" else None
        begins = [wire.start for each in lines for wire in each.wires]
        hovered = hovered if drag is None else undirected(drag.place)
        return Picture(
            options=options,
            revision=drawing.revision,
            network_revision=drawing.network_revision,
            wires=self._wires(network, drag, lines),
            seeds=shown_seeds(drawing.seeds(network), drawing.seed_place, closing, hovered, begins),
            strokes=(*network.strokes, *(one.stroke for one in cursor.gestures if isinstance(one, StrokeGesture))),
            line=None if line is None else line.line.points,
            target=target,
            seed=None if seed is None else seed.begins(options.along),
            choice=Choice(live.number, 1 + len(live.others), live.straight_active),
            offered=Offered(offers.kinds, offers.choice, loops.bends),
            intent=self._intent(work.computing),
            can_close=closing is not None,
            can_bend=options.along == "SURFACE" and loops.cuts.bendable(network) is not None,
            can_undo=bool(cursor.gestures) or drawing.history.can_undo(drawing.network),
            can_redo=drawing.history.can_redo,
            strength=drawing.strength,
            work=work,
            message=drawing.told,
        )

    def _wires(
        self, network: Network, drag: SeedDrag | None, lines: Iterable[EdgeLine | SurfaceLine]
    ) -> tuple[ShownWire, ...]:
        """Return the wires from bottom to top: those of a network, and everything live."""
        options, cursor = self._drawing.options, self._cursor
        moved = () if drag is None else drag.moved
        if self._kept is None or self._kept[0] is not network:
            ids = {wire.id for wire in moved}
            own = (wire for wire in network.wires if wire.id not in ids)
            self._kept = network, tuple(ShownWire(wire, Role.KEPT, tuple(wire.images or ())) for wire in own)
        target, active = cursor.live.target, cursor.live.active
        hovered = None if target is None or target.to != "WIRE" else network.find(target.wire)
        following = [
            replace(wire, marks=options.marking, mirror=network.mirror) for line in lines for wire in line.wires
        ]
        role = Role.ACTIVE if cursor.live.active_final else Role.COMPUTING
        offer, extension = cursor.loops.offers.wire, cursor.extension.wire

        def live(wire: Wire, role: Role, finish: Finish) -> ShownWire:
            images = self._drawing.images.of(wire, network, False)
            return ShownWire(wire, role, tuple(edge for image in images for edge in image.edges()), finish)

        return (
            *self._kept[1],
            *([] if hovered is None else [ShownWire(hovered, Role.HOVERED)]),
            *(ShownWire(wire, Role.OTHER) for wire in reversed(cursor.live.others)),
            *(live(wire, Role.MOVED, wire.finish) for wire in moved),
            *(live(wire, Role.FOLLOWING, options.finish) for wire in following),
            *([] if active is None else [live(active, role, options.finish)]),
            *([] if offer is None else [live(each, Role.OFFER, options.finish) for each in (offer, *offer.beside)]),
            *([] if extension is None else [live(extension, Role.EXTENSION, DEFAULT_FINISH)]),
        )

    def _intent(self, computing: bool) -> Intent:
        """Return the effect of a click."""
        cursor, live = self._cursor, self._cursor.live
        along, seed = self._drawing.options.along, self._drawing.network.seed
        if cursor.drag is not None:
            return Intent.MOVE
        if cursor.holds(LineGesture) is not None:
            return Intent.DRAW
        if cursor.extension.wire is not None:
            return Intent.RUN
        if cursor.loops.offers.wire is not None:
            return Intent.LOOP
        if live.target is None or (along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if live.active_final:
            return live.ending(live.target) or Intent.KEEP
        waits = computing and not seed.at(live.target.pick, along)
        return Intent.WAIT if waits else Intent.NOTHING
