# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept wires that take another course between their seeds, as soon as it is computed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import Refused
from .seed_drag import Courses, Leg

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..network.network import Network, Wire
    from ..solver.solver import Engines, LiveWire


class Retraces:
    """The kept wires that are to take their next way, while that is computed.

    Parameters
    ----------
    engines
        Have the live wires that those of the legs are forks of.
    points
        (n, 3) vertices of the mesh.
    """

    def __init__(self, engines: Engines, points: NDArray[np.float64]) -> None:
        self._engines = engines
        self._points = points
        self._legs: list[Leg] = []

    def __len__(self) -> int:
        return len(self._legs)

    def add(self, network: Network, wire: Wire) -> None:
        """Begin with one more wire of a network, not a loop.

        Raises
        ------
        ValueError
            Where its start is not part of the surface.
        """
        self._legs.append(Leg(self._engines.get(wire.along).fork(), network, wire, "end", self._points))

    def drop_last(self) -> bool:
        """Forget the wire that was added last; return whether there was one."""
        return bool(self._legs) and self._legs.pop() is not None

    def clear(self) -> None:
        """Forget all."""
        self._legs.clear()

    def lives(self) -> list[LiveWire]:
        """Return what computes them."""
        return [leg.live for leg in self._legs]

    def poll(self) -> Iterator[tuple[Wire, Courses | ValueError]]:
        """Yield each old wire whose new courses are ready, or the reason why it has none, and forget it."""
        for leg in list(self._legs):
            try:
                courses = leg.trace(leg.wire.end, leg.wire.end)
            except ValueError as error:
                self._legs.remove(leg)
                yield leg.wire, error
                continue
            if courses.final:
                self._legs.remove(leg)
                yield leg.wire, courses


def retraced(network: Network, own: Wire, others: tuple[Wire, ...]) -> Network:
    """Return a network where a wire runs the next other way.

    Parameters
    ----------
    network
        Has the wire.
    own
        The wire.
    others
        The other ways, the next one first.

    Raises
    ------
    Refused
        Where no way is left.
    """
    if not others:
        raise Refused("same-edges")
    other, *rest = others
    after = network.after(own)
    if after is not None and isinstance(own.end, tuple) and other.last_edge == own.last_edge[::-1]:
        # What goes on from the edge leaves it over this vertex: arriving there is enough.
        other = replace(other, vertices=other.vertices[:-1], points=other.points[:-1])
        if len(other.vertices) < 2:
            raise Refused("no-other-way-to-seed")
    return network.with_courses({own.id: replace(own, alternatives=(other, *rest)).retraced()})
