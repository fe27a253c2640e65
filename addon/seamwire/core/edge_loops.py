# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge loops: what one click on an edge offers, where straight wires end, and how a wire is extended to its end."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .network import Wire, undirected

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from .live import LiveWire
    from .network import Edge, LoopKind, Network, Pick, Seed
    from .symmetry import Symmetry


_BY_KIND: Mapping[LoopKind, float] = {"CLOSED": 0.0, "PAST": 0.2, "STRIP": 0.5, "WHOLE": 0.7}
_LOOP_CROSSES = 0.7
_STRIP_CROSSES = 0.2
"""How unlikely an offer is, in corners of a loop; being of another kind than what was taken last counts as a corner, too.
Fitted to what artists' seams consist of, see docs/method.md."""
_MOST_CORNERS, _MOST_CROSSINGS = 3, 4
"""More than these say no more."""
_CORNER_COSINE = 0.5
_MOST_PIECES = 64
"""Straight pieces of a loop that are looked at: over triangles it may have as many as edges."""


@dataclass
class LoopPreview:
    """The offers for the edge under the cursor, while they are asked for.

    Parameters
    ----------
    wanted
        Whether they are asked for.
    edge
        The edge that they are for, smaller vertex first.
    offers
        No two alike, the likeliest first; empty: not computed.
    choice
        The one that is shown.
    final
        Whether nothing is computed for them any more.
    """

    wanted: bool = False
    edge: Pick | None = None
    offers: tuple[Wire, ...] = ()
    choice: int = 0
    final: bool = True

    @property
    def wire(self) -> Wire | None:
        """The offer that is shown."""
        return self.offers[self.choice] if self.offers else None

    def clear(self) -> None:
        """Show none, and forget what was chosen; what is asked for is asked for still."""
        self.edge, self.offers, self.choice, self.final = None, (), 0, True

    def next(self) -> None:
        """Show the next offer. There must be one."""
        self.choice = (self.choice + 1) % len(self.offers)


def taken(offers: tuple[Wire, ...], choice: int, marks: bool) -> Wire:
    """Return an offer as a wire to be kept, with the others in their order, the next one first."""
    return replace(offers[choice], marks=marks, offers=offers[choice + 1 :] + offers[:choice])


def others(kept: Wire, offers: tuple[Wire, ...]) -> tuple[Wire, ...]:
    """Return what else is offered where a wire is kept, in order: what comes after its kind first."""
    at = next((i for i, offer in enumerate(offers) if offer.kind == kept.kind), -1)
    edges = set(kept.edges())
    return tuple(offer for offer in offers[at + 1 :] + offers[: max(at, 0)] if set(offer.edges()) != edges)


def find_offers(
    live: LiveWire,
    edge: Edge,
    stops: Sequence[int] | None,
    points: NDArray[np.float64],
    strength: float,
    kept: Collection[int] = (),
    last: LoopKind | None = None,
) -> tuple[tuple[Wire, ...], bool]:
    """Return what one click on an edge may take, the likeliest first, and whether that is computed; until then nothing.

    Parameters
    ----------
    live
        Of the way along edges.
    edge
        Strips run in its direction.
    stops
        The vertices where a strip and the way past poles end, before the offer without stops; None: that alone is
        offered.
    points
        (n, 3) vertices of the mesh.
    strength
        The metric's largest anisotropy.
    kept
        The vertices of seams and kept wires: what leads across them is less likely.
    last
        What was taken last: that is likely to be taken again; None: nothing yet.

    Raises
    ------
    ValueError
        Where the edge is not part of the surface.
    """
    loop = live.loop(edge)
    if not loop.final:
        return (), False
    found = [_wire("CLOSED", loop.vertices, True, edge, points, strength)]
    if stops is not None:
        strip = live.strip(edge, stops)
        found.append(_wire("STRIP", strip.vertices, strip.closed, edge, points))
        found.append(_wire("PAST", *past_poles(live, edge, stops), edge, points))
    chain = live.strip(edge, ())
    found.append(_wire("WHOLE", chain.vertices, chain.closed, edge, points))
    # Of those that run along the same edges the first.
    different = {frozenset(wire.edges()): wire for wire in reversed(found) if wire is not None}
    offers = [wire for wire in found if wire in different.values()]
    if len(offers) > 1:
        offers.sort(key=lambda wire: _unlikeliness(live, wire, points, kept, last or "CLOSED"))
    return tuple(offers), True


def _unlikeliness(
    live: LiveWire, wire: Wire, points: NDArray[np.float64], kept: Collection[int], last: LoopKind
) -> float:
    """Return how unlikely an offer is to be what the artist wants, in corners of a loop."""
    assert wire.kind is not None
    inner = wire.vertices if wire.closed else wire.vertices[1:-1]
    crossings = min(sum(vertex in kept for vertex in inner), _MOST_CROSSINGS)
    cost = _BY_KIND[wire.kind] + (wire.kind != last)
    if wire.kind == "CLOSED":
        return cost + _LOOP_CROSSES * crossings + min(corners(live, wire.vertices, points), _MOST_CORNERS)
    return cost + _STRIP_CROSSES * crossings


def corners(live: LiveWire, loop: Sequence[int], points: NDArray[np.float64]) -> int:
    """Count the vertices where a closed chain turns off by 60 degrees or more, though straight ways go on there.

    From neither side does the straight way follow the chain at such a vertex. Where both lead into the same third edge,
    three edges meet, and no way is straight.

    Parameters
    ----------
    live
        Of the way along edges.
    loop
        The vertices of the chain, the first one not repeated.
    points
        (n, 3) vertices of the mesh.
    """
    forth = _straight_on(live, loop)
    ahead = np.roll(loop, -1)
    at = np.flatnonzero((forth >= 0) & (forth != ahead))
    if not len(at):
        return 0
    back = _straight_on(live, loop[::-1])[::-1]
    before = np.roll(loop, 1)
    at = at[(back[at] >= 0) & (back[at] != before[at]) & (back[at] != forth[at])]
    middle = points[np.asarray(loop)[at]]

    def turned(one: NDArray[np.int64], two: NDArray[np.int64]) -> NDArray[np.bool_]:
        to_one, to_two = points[one[at]] - middle, points[two[at]] - middle
        lengths = np.linalg.norm(to_one, axis=1) * np.linalg.norm(to_two, axis=1)
        return np.einsum("ij,ij->i", to_one, to_two) <= _CORNER_COSINE * lengths

    return int((turned(forth, ahead) & turned(back, before)).sum())


def _straight_on(live: LiveWire, loop: Sequence[int]) -> NDArray[np.int64]:
    """Return for each vertex of a closed chain the one after it if the chain went straight on there; -1: there is none."""
    after = np.full(len(loop), -1, dtype=np.int64)
    at = 0
    for _ in range(_MOST_PIECES):
        if at >= len(loop):
            break
        # As far as the chain follows it, one way tells of all vertices.
        way = np.asarray(live.run_on((loop[at - 1], loop[at]), ()).vertices, dtype=np.int64)[1 : len(loop) - at + 1]
        follows = way[:-1] == np.asarray(loop[at + 1 : at + len(way)])
        count = len(way) if follows.all() else int(np.argmin(follows)) + 1
        after[at : at + count] = way[:count]
        at += max(count, 1)
    return after


def past_poles(live: LiveWire, edge: Edge, stops: Sequence[int]) -> tuple[tuple[int, ...], bool]:
    """Return the way that runs on from both ends of an edge, and whether it is closed; no vertices: it meets itself."""

    def way(first: int, second: int) -> tuple[int, ...]:
        if second in stops:
            return (second,)
        return tuple(int(vertex) for vertex in live.run_on((first, second), stops).vertices)

    forth = way(*edge)
    if len(forth) > 2 and forth[-1] == edge[0]:
        return (edge[0], *forth[:-1]), True
    back = way(edge[1], edge[0])
    chain = (*back[::-1], *forth)
    return (chain if len(set(chain)) == len(chain) else ()), False


def _wire(
    kind: LoopKind,
    chain: Sequence[int] | NDArray[np.int32],
    closed: bool,
    edge: Edge,
    points: NDArray[np.float64],
    strength: float = 0.0,
) -> Wire | None:
    vertices = tuple(int(vertex) for vertex in chain)
    if len(vertices) < (3 if closed else 2):
        return None
    around = [*vertices, vertices[0]] if closed else list(vertices)
    start, end = (edge, edge) if closed else (vertices[0], vertices[-1])
    pair = (min(edge), max(edge))
    return Wire(
        "EDGES", vertices, points[around], start, end, closed=closed, strength=strength, kind=kind, through=pair
    )


class Stops:
    """The vertices where wires that run straight on end: those of seams and of wires, and those on the mirror's plane.

    Parameters
    ----------
    seams
        (k, 2) the edges that are seams already.
    mirror
        Knows the images of wires, and what lies on the plane.
    """

    def __init__(self, seams: ArrayLike, mirror: Symmetry) -> None:
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

    def kept(self, network: Network) -> frozenset[int]:
        """Return the vertices of seams, of kept wires and of their images."""
        return self._kept(network)[0]

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


def extension(
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
