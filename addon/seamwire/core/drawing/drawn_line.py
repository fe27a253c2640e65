# SPDX-License-Identifier: GPL-3.0-or-later
"""A line drawn by dragging, or a ridge that was clicked on, and the network that its wires are kept in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..network.network import vertices_of
from ..network.symmetry import among

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.network import Network, Pick, Seed, Snap, Wire
    from ..network.stops import Stops
    from .line import Line


@dataclass
class DrawnLine:
    """A line that wires follow, drawn by dragging or a ridge.

    Parameters
    ----------
    line
        Knows its wires.
    begin
        The pick under the cursor at its beginning.
    goes_on
        Whether it goes on from the live wire's seed, so that the chain goes on behind it.
    end
        The pick under the cursor at its current end.
    apart
        Whether its wires are no part of a chain, and leave that which is drawn as it is.
    """

    line: Line
    begin: Snap
    goes_on: bool
    end: Snap | None = None
    apart: bool = False

    @property
    def joined(self) -> Snap | None:
        """The pick under the cursor if a chain would end there, otherwise None."""
        return self.end if self.end is not None and self.end.ends_chains else None

    def kept_in(self, network: Network, wires: tuple[Wire, ...], points: NDArray[np.float64], stops: Stops) -> Network:
        """Return a network with the line's wires, joined to those that it meets.

        Parameters
        ----------
        network
            That the line was drawn in.
        wires
            The line's, in its direction, at least one.
        points
            (n, 3) the mesh's vertices.
        stops
            Knows where chains end.
        """
        if self.apart:
            return replace(network, wires=(*network.wires, *wires))
        for pick in (wires[0].start, wires[-1].end):
            network = self._with_seed_at(network, pick, points)
        seed = network.seed if self.goes_on else None
        if seed is not None:
            wires = (replace(wires[0], start=seed.shown(wires[0].along)), *wires[1:])
        ends = seed is None or self._ends_chain(network, wires[-1].end, seed, stops)
        for number, wire in enumerate(wires):
            network = network.with_drawn(wire, wire.end, ends and number == len(wires) - 1)
        return replace(network, seed=None) if ends else network

    def _with_seed_at(self, network: Network, pick: Pick, points: NDArray[np.float64]) -> Network:
        """Return a network with a seed where the line meets one of its wires."""
        for snap in (self.begin, self.end):
            if snap is not None and snap.to == "WIRE" and pick in (snap.pick, *vertices_of(snap.pick)):
                network = network.joined(replace(snap, pick=pick), points)
        if isinstance(pick, int):
            for wire in network.wires:
                if wire.along == "EDGES" and not wire.closed and pick in wire.vertices[1:-1]:
                    network = network.with_seed_in(wire, pick, points) or network
        return network

    def _ends_chain(self, network: Network, end: Pick, seed: Seed, stops: Stops) -> bool:
        """Whether a line that went on from a chain ends that: on a seed, a wire or a seam, the chain's first seed too."""
        if self.joined is not None or end == seed.began:
            return True
        return isinstance(end, int) and bool(among(np.array([end]), stops.kept(network))[0])
