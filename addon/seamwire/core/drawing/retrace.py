# SPDX-License-Identifier: GPL-3.0-or-later
"""Retracing: a kept wire takes another course between its seeds."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.refused import Refused
from .gesture import Gesture
from .seed_drag import Leg

if TYPE_CHECKING:
    from ..network.network import Network
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Committed


class Retrace(Gesture):
    """A kept wire, no loop, that takes its next way, that of another metric, as soon as it is computed.

    Raises ValueError if its start is not part of the surface.
    """

    def __init__(self, drawing: Drawing, wire: Wire) -> None:
        self._drawing = drawing
        self._leg = Leg(drawing.engines.get(wire.along).fork(), drawing.network, wire.uncut(), "end", drawing.points)

    def commit(self) -> Committed:
        """Return the network with the wire's next way, or None if the wire is gone."""
        wire = self._leg.wire
        courses = self._leg.trace(wire.end, wire.end)
        if not courses.final:
            return self
        network = self._drawing.network
        own = network.find(wire)
        return None if own is None else retraced(network, own, courses.others(own))

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it."""
        return [self._leg.live]


def retraced(network: Network, own: Wire, others: tuple[Wire, ...]) -> Network:
    """Return a network where its own wire runs the next other way, the first of `others`. Raises Refused where no way is left."""
    if not others:
        raise Refused("All wires run along the same edges here")
    other, *rest = others
    after = network.after(own)
    if after is not None and isinstance(own.end, tuple) and other.last_edge == own.last_edge[::-1]:
        # What goes on from the edge leaves it over this vertex: arriving there is enough.
        other = replace(other, vertices=other.vertices[:-1], points=other.points[:-1])
        if len(other.vertices) < 2:
            raise Refused("No other path to this seed")
    return network.with_courses({own.id: replace(own, alternatives=(other, *rest)).retraced()})
