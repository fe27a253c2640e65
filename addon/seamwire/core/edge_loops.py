# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge loops: what one click on an edge offers, where straight wires end, and how a wire is extended to its end."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .network import Wire, undirected
from .symmetry import among

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from .network import Edge, LoopKind, Network, Pick, Seed
    from .solver import LiveWire
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
    return offers[choice].anew(marks=marks, offers=offers[choice + 1 :] + offers[:choice])


def others(kept: Wire, offers: tuple[Wire, ...]) -> tuple[Wire, ...]:
    """Return what else is offered where a wire is kept, in order: what comes after its kind first."""
    at = next((i for i, offer in enumerate(offers) if offer.kind == kept.kind), -1)
    edges = set(kept.edges())
    return tuple(offer for offer in offers[at + 1 :] + offers[: max(at, 0)] if set(offer.edges()) != edges)


def find_offers(
    live: LiveWire,
    edge: Edge,
    stops: NDArray[np.int64] | Sequence[int] | None,
    points: NDArray[np.float64],
    strength: float,
    kept: NDArray[np.int64] | Collection[int] = (),
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
        kept = _ranked(_numbers(kept))
        offers.sort(key=lambda wire: _unlikeliness(live, wire, points, kept, last or "CLOSED"))
    return tuple(offers), True


def _unlikeliness(
    live: LiveWire, wire: Wire, points: NDArray[np.float64], kept: NDArray[np.int64], last: LoopKind
) -> float:
    """Return how unlikely an offer is to be what the artist wants, in corners of a loop."""
    assert wire.kind is not None
    inner = wire.vertices if wire.closed else wire.vertices[1:-1]
    crossings = min(int(among(np.array(inner, dtype=np.int64), kept).sum()), _MOST_CROSSINGS)
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


def past_poles(live: LiveWire, edge: Edge, stops: NDArray[np.int64] | Sequence[int]) -> tuple[tuple[int, ...], bool]:
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
        self._seams = _ranked(_keys(np.asarray(seams, dtype=np.int64).reshape(-1, 2)))
        self._seam_vertices = _ranked(np.concatenate([self._seams >> _BITS, self._seams & _LOW]))
        self._mirror = mirror
        self._last: tuple[Network, NDArray[np.int64], frozenset[Edge]] | None = None
        self._plane: tuple[tuple[int, ...], frozenset[int], NDArray[np.int64]] | None = None

    def of(self, network: Network, live: Wire | None, begin: Iterable[int]) -> NDArray[np.int64]:
        """Return the stops of a wire, in rising order.

        Parameters
        ----------
        network
            The kept wires and the mirror.
        live
            A wire that is not kept yet; None: no such one.
        begin
            The vertices that the wire has before it runs on. Where all lie on the mirror's plane, it runs along that.
        """
        stops = self._kept(network)[0]
        if live is not None:
            images = self._mirror.images(live, network.mirror)
            stops = _joined(stops, itertools.chain(*(one.vertices for one in (live, *images))))
        if not network.mirror:
            return stops
        if self._plane is None or self._plane[0] != network.mirror:
            plane = self._mirror.on_plane(network.mirror)
            self._plane = (network.mirror, plane, np.fromiter(plane, dtype=np.int64, count=len(plane)))
        _, plane, vertices = self._plane
        return stops if plane.issuperset(begin) else _ranked(np.concatenate([stops, vertices]))

    def kept(self, network: Network) -> NDArray[np.int64]:
        """Return the vertices of seams, of kept wires and of their images, in rising order."""
        return self._kept(network)[0]

    def taken(self, network: Network, edge: Edge) -> bool:
        """Whether an edge belongs already to a seam, to a kept wire or to an image of one."""
        if undirected(edge) in self._kept(network)[1]:
            return True
        key = _keys(np.array([edge], dtype=np.int64))
        return bool(among(key, self._seams)[0])

    def _kept(self, network: Network) -> tuple[NDArray[np.int64], frozenset[Edge]]:
        """Return the vertices of seams, kept wires and their images, in rising order, and the edges of those wires."""
        if self._last is None or self._last[0] is not network:
            edges = frozenset(edge for wire in network.wires for edge in wire.claims())
            vertices = _joined(self._seam_vertices, itertools.chain.from_iterable(edges))
            self._last = (network, vertices, edges)
        return self._last[1:]


_BITS = 32
_LOW = (1 << _BITS) - 1


def _keys(edges: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return a number for each edge, (k, 2): its smaller vertex above its larger one."""
    return (edges.min(axis=1) << _BITS) | edges.max(axis=1)


def _numbers(vertices: Iterable[int]) -> NDArray[np.int64]:
    return vertices if isinstance(vertices, np.ndarray) else np.fromiter(vertices, dtype=np.int64)


def _ranked(numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return numbers in rising order, each once."""
    numbers = np.sort(numbers)
    return numbers[np.diff(numbers, prepend=-1) > 0]


def _joined(ranked: NDArray[np.int64], vertices: Iterable[int]) -> NDArray[np.int64]:
    """Return numbers in rising order with a few more among them."""
    more = _ranked(_numbers(vertices))
    more = more[~among(more, ranked)]
    return np.insert(ranked, np.searchsorted(ranked, more), more) if len(more) else ranked


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
    stops = _numbers(stops)
    way = tuple(int(v) for v in live.run_on(edge, stops[stops != edge[1]]).vertices)
    if len(way) < 2:
        return None
    vertices = way if active is None else active.vertices + way[1:]
    heading = active.heading if active is not None else edge
    return Wire("EDGES", vertices, points[list(vertices)], seed.place, vertices[-1], heading=heading)
