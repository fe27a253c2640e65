# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a sketch."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ...terms.choices import DEFAULT_FINISH
from ..network.picks import undirected
from .dragging import Dragging
from .lining import Lining
from .network import Way
from .picture import Choice, Intent, Offered, Picture, Role, ShownWire, Work, shown_seeds

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...terms.choices import Finish
    from ..network.picks import Pick
    from ..network.wires import Wire
    from .sketch import Sketch


def paint(sketch: Sketch) -> Picture:
    """Return everything that is to be seen of a sketch now."""
    wiring, offering, network = sketch.wiring, sketch.offering, sketch.network
    drag, line, options = sketch.holds(Dragging), sketch.holds(Lining), sketch.options
    is_offering, target = sketch.interaction is offering, sketch.target
    seed, closing = network.seed, network.closing_point
    hovered = target.pick if target is not None and target.to == "SEED" else None
    wires = tuple(_wires(sketch))
    return Picture(
        options=options,
        revision=sketch.revision,
        network_revision=sketch.network_revision,
        wires=wires,
        missing=tuple(_missing(sketch)),
        seeds=shown_seeds(
            sketch.seeds() if drag is None else drag.seeds(),
            sketch.seed_place,
            closing,
            hovered if drag is None else undirected(drag.place),
            () if line is None else [wire.start for wire in line.line.wires],
        ),
        strokes=network.strokes,
        line=None if line is None else line.line.points,
        target=target,
        seed=None if seed is None else sketch.seed,
        choice=Choice(wiring.number, 1 + len(wiring.others), wiring.is_straight),
        offered=Offered(offering.offers.kinds, offering.offers.choice, offering.bends) if is_offering else Offered(),
        intent=_intent(sketch),
        can_close=closing is not None,
        can_bend=options.along == "SURFACE" and offering.cuts.bendable(sketch.drawn) is not None,
        can_undo=sketch.can_undo,
        can_redo=sketch.history.can_redo,
        strength=sketch.engines.strengths[options.along],
        work=Work(sketch.computing, sketch.progress, sketch.waiting),
        message=sketch.told,
    )


def _wires(sketch: Sketch) -> Iterator[ShownWire]:
    """Yield the wires from bottom to top: the kept ones, and everything live."""
    options, wiring, network = sketch.options, sketch.wiring, sketch.network
    drag, line = sketch.holds(Dragging), sketch.holds(Lining)
    moved = {} if drag is None else {wire.id: wire for wire in drag.moved}
    gone = set() if drag is None else drag.ids

    def live(wire: Wire, role: Role, finish: Finish) -> ShownWire:
        images = sketch.mirrored(wire)
        return ShownWire(wire, role, tuple(edge for image in images for edge in image.edges()), finish)

    for wire in sketch.drawn.wires if drag is None else drag.shown.wires:
        if wire.id not in gone:
            yield ShownWire(wire, Role.KEPT, tuple(wire.images or ()))
    target = sketch.target
    hovered = None if target is None or target.to != "WIRE" else sketch.drawn.find(target.wire)
    if hovered is not None:
        yield ShownWire(hovered, Role.HOVERED)
    for wire in moved.values():
        yield live(wire, Role.MOVED, wire.finish)
    for wire in () if line is None else line.line.wires:
        own = replace(wire, marks=options.marking, mirror=network.mirror)
        yield live(own, Role.FOLLOWING, options.finish)
    if sketch.interaction is wiring:
        for wire in reversed(wiring.others):
            yield ShownWire(wire, Role.OTHER)
        if wiring.active is not None:
            role = Role.ACTIVE if wiring.active_final else Role.COMPUTING
            yield live(wiring.active, role, options.finish)
        if wiring.extended is not None:
            yield live(wiring.extended, Role.EXTENSION, DEFAULT_FINISH)
    offer = sketch.offering.offers.wire if sketch.interaction is sketch.offering else None
    for wire in () if offer is None else (offer, *offer.beside):
        yield live(wire, Role.OFFER, options.finish)


def _missing(sketch: Sketch) -> Iterator[tuple[Pick, Pick]]:
    """Yield the ends of the requests that have no course, or not yet."""
    for own in sketch.network.requests:
        if isinstance(own, Way) and not sketch.courses.of(own).wires:
            yield own.start, own.end


def _intent(sketch: Sketch) -> Intent:
    """Return the effect of a click."""
    wiring, offering, target = sketch.wiring, sketch.offering, sketch.target
    along, seed = sketch.options.along, sketch.network.seed
    if sketch.holds(Dragging) is not None:
        return Intent.MOVE
    if sketch.holds(Lining) is not None:
        return Intent.DRAW
    if wiring.extended is not None:
        return Intent.RUN
    if sketch.interaction is offering and offering.offers.wire is not None:
        return Intent.LOOP
    if target is None or (along == "SURFACE" and isinstance(target.pick, tuple)):
        return Intent.NOTHING
    if seed is None:
        return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(target.to, Intent.SEED)
    begin = wiring.begin()
    if begin is None or begin.is_at(target.pick, seed.pick) or wiring.reason:
        return Intent.NOTHING
    return wiring.ending(target) or Intent.KEEP
