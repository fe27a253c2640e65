# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires that run straight on along edges, and where they end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .network import Wire, undirected

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from .live import LiveWire
    from .network import Edge, Network, Seed
    from .symmetry import Mirror


class Stops:
    """The vertices where wires that run straight on end: those of seams and of wires, and those on the mirror's plane.

    Parameters
    ----------
    seams
        (k, 2) the edges that are seams already.
    mirror
        Knows the images of wires, and what lies on the plane.
    """

    def __init__(self, seams: ArrayLike, mirror: Mirror) -> None:
        pairs = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        self._seam_vertices = frozenset(np.unique(pairs).tolist())
        self._seams = frozenset(map(tuple, np.sort(pairs, axis=1).tolist()))
        self._mirror = mirror
        self._last: tuple[Network, frozenset[int], frozenset[Edge]] | None = None

    def of(self, network: Network, live: Wire | None, begin: Iterable[int]) -> list[int]:
        """Return the stops of a wire.

        Parameters
        ----------
        network
            The kept wires and the mirror.
        live
            A wire that is not kept yet; None: no such one.
        begin
            The vertices that the wire has before it runs on. Where all lie on the mirror's plane, it runs along that.
        """
        stops = set(self._kept(network)[0])
        if live is not None:
            stops.update(*(one.vertices for one in self._with_images(live, network)))
        plane = self._mirror.on_plane(network.mirror)
        if not plane.issuperset(begin):
            stops |= plane
        return list(stops)

    def taken(self, network: Network, edge: Edge) -> bool:
        """Whether an edge belongs already to a seam, to a kept wire or to an image of one."""
        return undirected(edge) in self._kept(network)[1]

    def without(self, wire: Wire, network: Network) -> Stops:
        """Return the stops there would be without a wire's own edges, which are seams where it was finished before."""
        own = {edge for one in self._with_images(wire, network) for edge in one.edges()}
        return Stops(sorted(self._seams - own), self._mirror)

    def _kept(self, network: Network) -> tuple[frozenset[int], frozenset[Edge]]:
        """Return the vertices and edges of seams, kept wires and their images."""
        if self._last is None or self._last[0] is not network:
            wires = [one for wire in network.wires for one in self._with_images(wire, network)]
            vertices = self._seam_vertices.union(*(one.vertices for one in wires))
            self._last = (network, vertices, self._seams.union(*(one.edges() for one in wires)))
        return self._last[1:]

    def _with_images(self, wire: Wire, network: Network) -> list[Wire]:
        return [wire, *self._mirror.images(wire, network.mirror)]


def run_on(
    live: LiveWire, seed: Seed, active: Wire | None, edge: Edge, stops: Iterable[int], points: NDArray[np.float64]
) -> Wire | None:
    """Return the way to the end from a directed edge; None: there is none.

    Parameters
    ----------
    live
        Of the way along edges.
    seed
        Where the wire begins.
    active
        The live wire, which `edge` is the last one of; None: the wire begins with the seed, which is that edge.
    stops
        The vertices where it ends; the edge's second one is none of them.
    points
        (n, 3) vertices of the mesh.

    Raises
    ------
    ValueError
        Where the edge is not part of the surface.
    """
    way = tuple(int(v) for v in live.run_on(edge, [vertex for vertex in stops if vertex != edge[1]]).vertices)
    if len(way) < 2:
        return None
    vertices = way if active is None else active.vertices + way[1:]
    heading = active.heading if active is not None else edge
    return Wire("EDGES", vertices, points[list(vertices)], seed.place, vertices[-1], heading=heading)
