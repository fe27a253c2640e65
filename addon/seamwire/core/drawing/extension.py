# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wire extended straight on until it meets a seam, a wire, the boundary, the mirror or itself."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import Refused
from ..network.network import Wire

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..network.network import Edge, Network, Seed
    from ..network.stops import Stops
    from ..solver.solver import Engines, LiveWire


class Extension:
    """The live wire with its way on to the end, while it is asked for. Along edges only.

    Parameters
    ----------
    engines
        Find the way.
    stops
        Where it ends.
    points
        (n, 3) vertices of the mesh.
    """

    def __init__(self, engines: Engines, stops: Stops, points: NDArray[np.float64]) -> None:
        self._engines = engines
        self._stops = stops
        self._points = points
        self.wanted = False
        """Whether it is asked for."""
        self.wire: Wire | None = None
        """The one that is shown."""

    def clear(self) -> None:
        """Show none, and ask for none."""
        self.wanted, self.wire = False, None

    def show(self, wire: Wire | None) -> bool:
        """Show what was found; return whether it runs elsewhere than what was shown before."""
        before, self.wire = self.wire, wire
        if before is None or wire is None:
            return before is not wire
        return not before.like(wire)

    def find(self, network: Network, active: Wire | None, marks: bool) -> Wire | None:
        """Return the live wire with its way on; None where there is no way on.

        Parameters
        ----------
        network
            The wires that there are and the live wire's seed.
        active
            The live wire; None: the way begins at the seed.
        marks
            Whether it is to mark seams, or to clear them.

        Raises
        ------
        ValueError
            Where it has no direction yet, or is not part of the surface.
        """
        seed = network.seed
        if seed is None:
            return None
        if active is not None:
            edge = active.last_edge
        elif seed.forward and isinstance(seed.pick, tuple):
            edge = seed.pick
        else:
            raise Refused("point-where-to-run")
        stops = self._stops.of(network, active, edge[1:])
        wire = extended(self._engines.get("EDGES"), seed, active, edge, stops, self._points)
        strength = self._engines.strengths["EDGES"]
        return wire and replace(wire, marks=marks, mirror=network.mirror, strength=strength)


def extended(
    live: LiveWire, seed: Seed, active: Wire | None, edge: Edge, stops: NDArray[np.int64], points: NDArray[np.float64]
) -> Wire | None:
    """Return the way to the end from a directed edge, or None.

    Parameters
    ----------
    live
        Of the way along edges.
    seed
        Where the wire begins.
    active
        The live wire, which `edge` is the last one of; None: the wire begins with the seed, which is that edge.
    stops
        The vertices where it ends, without the edge's second one.
    points
        (n, 3) vertices of the mesh.

    Raises
    ------
    ValueError
        Where the edge is not part of the surface.
    """
    way = tuple(int(v) for v in live.extend_straight(edge, stops[stops != edge[1]]).vertices)
    if len(way) < 2:
        return None
    vertices = way if active is None else active.vertices + way[1:]
    heading = active.heading if active is not None else edge
    return Wire("EDGES", vertices, points[list(vertices)], seed.place, vertices[-1], heading=heading)
