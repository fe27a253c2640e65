# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a board."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ...terms.choices import DEFAULT_FINISH
from ..network.network import Way
from ..network.picks import undirected
from .dragging import Dragging
from .lining import Lining
from .picture import Choice, Intent, Offered, Picture, Role, ShownWire, shown_seeds

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...terms.choices import Finish
    from ..network.picks import Pick
    from ..network.wires import Wire
    from .board import Board
    from .interaction import Interaction
    from .offering import Offering
    from .picture import Work
    from .wiring import Wiring


def paint(
    board: Board, wiring: Wiring, offering: Offering, now: Interaction, work: Work, undo: tuple[bool, bool]
) -> Picture:
    network, options, target = board.network, board.options, now.target
    drag = now if isinstance(now, Dragging) else None
    line = now if isinstance(now, Lining) else None
    seed, closing = network.seed, network.closing_point
    hovered = target.pick if target is not None and target.to == "SEED" else None
    return Picture(
        options=options,
        revision=board.revision,
        network_revision=board.network_revision,
        wires=tuple(_wires(board, wiring, offering, now)),
        missing=tuple(_missing(board)),
        seeds=shown_seeds(
            board.seeds() if drag is None else drag.seeds(),
            board.seed_place,
            closing,
            hovered if drag is None else undirected(drag.place),
            () if line is None else [wire.start for wire in line.line.wires],
        ),
        strokes=network.strokes,
        line=None if line is None else line.line.points,
        target=target,
        seed=None if seed is None else board.seed,
        choice=Choice(wiring.number, 1 + len(wiring.others), wiring.is_straight),
        offered=Offered(tuple(offer.kind for offer in offering.offers if offer.kind), offering.choice, offering.bends)
        if now is offering
        else Offered(),
        intent=_intent(board, wiring, offering, now),
        can_close=closing is not None,
        can_bend=options.along == "SURFACE" and offering.cuts.bendable(board.drawn) is not None,
        can_undo=undo[0],
        can_redo=undo[1],
        strength=board.engines.strengths[options.along],
        work=work,
        message=board.told,
    )


def _wires(board: Board, wiring: Wiring, offering: Offering, now: Interaction) -> Iterator[ShownWire]:
    """Yield the wires from bottom to top: the kept ones, and everything live."""
    options, target = board.options, now.target
    drag = now if isinstance(now, Dragging) else None
    line = now if isinstance(now, Lining) else None
    moved = {} if drag is None else {wire.id: wire for wire in drag.moved}
    gone = set() if drag is None else drag.ids

    def live(wire: Wire, role: Role, finish: Finish) -> ShownWire:
        images = board.mirrored(wire)
        return ShownWire(wire, role, tuple(edge for image in images for edge in image.edges()), finish)

    for wire in board.drawn.wires if drag is None else drag.shown.wires:
        if wire.id not in gone:
            yield ShownWire(wire, Role.KEPT, tuple(wire.images or ()))
    hovered = None if target is None or target.to != "WIRE" else board.drawn.find(target.wire)
    if hovered is not None:
        yield ShownWire(hovered, Role.HOVERED)
    for wire in moved.values():
        yield live(wire, Role.MOVED, wire.finish)
    for wire in () if line is None else line.line.wires:
        own = replace(wire, marks=options.marking, mirror=options.mirror)
        yield live(own, Role.FOLLOWING, options.finish)
    if now is wiring:
        for wire in reversed(wiring.others):
            yield ShownWire(wire, Role.OTHER)
        if wiring.active is not None:
            role = Role.ACTIVE if wiring.active_final else Role.COMPUTING
            yield live(wiring.active, role, options.finish)
        if wiring.extended is not None:
            yield live(wiring.extended, Role.EXTENSION, DEFAULT_FINISH)
    offer = offering.wire if now is offering else None
    for wire in () if offer is None else (offer, *offer.beside):
        yield live(wire, Role.OFFER, options.finish)


def _missing(board: Board) -> Iterator[tuple[Pick, Pick]]:
    for own in board.network.requests:
        if isinstance(own, Way) and not board.courses.of(own).wires:
            yield own.start, own.end


def _intent(board: Board, wiring: Wiring, offering: Offering, now: Interaction) -> Intent:
    along, seed, target = board.options.along, board.network.seed, now.target
    if isinstance(now, Dragging):
        return Intent.MOVE
    if isinstance(now, Lining):
        return Intent.DRAW
    if wiring.extended is not None:
        return Intent.RUN
    if now is offering and offering.wire is not None:
        return Intent.LOOP
    if target is None or (along == "SURFACE" and isinstance(target.pick, tuple)):
        return Intent.NOTHING
    if seed is None:
        return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(target.to, Intent.SEED)
    begin = board.begin
    if begin is None or begin.is_at(target.pick, seed.pick) or wiring.reason:
        return Intent.NOTHING
    return wiring.ending(target) or Intent.KEEP
