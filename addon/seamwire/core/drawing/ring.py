# SPDX-License-Identifier: GPL-3.0-or-later
"""The wire that closes a chain of one wire around the limb that it lies on, instead of beside the chain."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of, nearest_on_segments
from ..network.picks import place_of, undirected, vertices_of
from ..network.wires import Wire
from ..solver.solver import by_number, for_live

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Sequence
    from typing import TypeVar

    from numpy.typing import NDArray

    from ...terms.choices import Along
    from ..network.network import Network, Snap
    from ..network.picks import Edge, Pick
    from ..solver.solver import ClosedCut, Engines, LiveWire

    Found = TypeVar("Found")
    Search = Generator[None, None, Wire | None]
    """Yields while the library computes."""

_LEAST_BACK = 4
"""Vertices of a ring behind the chain: of fewer no wire can be led around."""


class RingSearch:
    """Finds the wire from the end of a chain of one wire around a limb to the chain's beginning."""

    def __init__(self, engines: Engines, points: NDArray[np.float64], edges: NDArray[np.int32]) -> None:
        self._engines = engines
        self._points = points
        self._edges = edges
        self._key: tuple[object, ...] | None = None
        self._search: Search | None = None
        self.lives: tuple[LiveWire, ...] = ()
        """What computes now."""
        self.wire: Wire | None = None
        """The wire around the limb, once it is found."""
        self.joints: tuple[int, ...] = ()
        """The vertices where it needs seeds, so that it stays around the limb."""

    def find(self, network: Network, target: Snap, along: Along) -> bool:
        """Search the wire that closes a network's chain; return whether the search has ended. Call again until then."""
        chain = _only_wire(network) if network.closes(target) else None
        engines = self._engines
        key = (chain, undirected(target.pick), along, engines.metric, engines.strengths[along], engines.strokes)
        if key != self._key:
            self.forget()
            self._key = key
            if chain is not None:
                way = self._along_edges if along == "EDGES" else self._across
                self._search = way(chain, network, target.pick)
        if self._search is not None:
            try:
                next(self._search)
            except StopIteration as end:
                self._search, self.lives, self.wire = None, (), end.value
            except ValueError:  # no ring leads through both seeds
                self._search, self.lives = None, ()
        return self._search is None

    def forget(self) -> None:
        """Stop the search, and forget what was found."""
        self._key, self._search, self.lives, self.wire, self.joints = None, None, (), None, ()

    # Along edges

    def _along_edges(self, chain: Wire, network: Network, end: Pick) -> Search:
        """Follow the shortest straight loop at the middle of a chain behind it, and lead wires from its ends there."""
        seed = network.seed
        assert seed is not None
        live = self._engines.get("EDGES").fork()
        self.lives = (live,)
        middle = chain.vertices[len(chain.vertices) // 2]
        ring = yield from self._ring(live, chain, middle)
        back = () if ring is None else self._behind(ring, chain, middle)
        if len(back) < _LEAST_BACK:
            return None
        third = max(1, len(back) // 3)
        on_ring = back[third:-third]
        if len(on_ring) < 2:
            return None
        begins = seed.begins("EDGES")
        there = yield from _wire_between(live, begins, seed.forward, on_ring[0])
        home = yield from self._home(live, on_ring[-2:], chain)
        vertices = (*there[:-1], *on_ring[:-1], *home)
        inner = vertices[1:-1]
        if not there or not home or len(set(inner)) < len(inner) or not set(inner).isdisjoint(chain.vertices):
            return None
        self.joints = on_ring[0], on_ring[-1]
        heading = seed.pick if seed.forward and isinstance(seed.pick, tuple) else None
        return Wire("EDGES", vertices, self._points[list(vertices)], seed.place, end, heading=heading)

    def _home(self, live: LiveWire, begin: Edge, chain: Wire) -> Generator[None, None, tuple[int, ...]]:
        """Return the vertices of a wire from the end of an edge to the beginning of a chain, not along the chain."""
        first = chain.vertices[0]
        vertices = yield from _wire_between(live, begin, True, first)
        if set(vertices[:-1]).isdisjoint(chain.vertices):
            return vertices
        pairs = self._edges[(self._edges == first).any(axis=1)]
        beside = [vertex for vertex in (pairs.sum(axis=1) - first).tolist() if vertex not in chain.vertices]
        gaps = np.linalg.norm(self._points[beside] - self._points[begin[1]], axis=1)
        vertices = yield from _wire_between(live, begin, True, beside[int(np.argmin(gaps))])
        return (*vertices, first)

    def _ring(self, live: LiveWire, chain: Wire, middle: int) -> Generator[None, None, tuple[int, ...] | None]:
        """Return the shorter of the straight loops along a chain and across it at a vertex; None if neither is straight."""
        rings = []
        for edge in self._edges_at(chain, middle):
            loop = yield from _final(lambda edge=edge: live.loop(edge))
            around = tuple(int(vertex) for vertex in loop.vertices)
            if len(around) > _LEAST_BACK and not loop.corners:
                rings.append(around)
        return min(rings, key=lambda around: length_of(self._points[[*around, around[0]]]), default=None)

    def _edges_at(self, chain: Wire, middle: int) -> list[Edge]:
        """Return an edge of a chain at one of its vertices, and the edge that crosses it most squarely there."""
        at = max(1, chain.vertices.index(middle))
        own = chain.vertices[at - 1], chain.vertices[at]
        pairs = self._edges[(self._edges == middle).any(axis=1)]
        ends = pairs.sum(axis=1) - middle
        along = self._points[own[1]] - self._points[own[0]]
        ways = self._points[ends] - self._points[middle]
        sizes = np.linalg.norm(ways, axis=1) * np.linalg.norm(along)
        if not len(ends) or sizes.min() <= 0.0:
            return []
        return [own, (middle, int(ends[np.argmin(np.abs(ways @ along) / sizes)]))]

    def _behind(self, ring: tuple[int, ...], chain: Wire, middle: int) -> tuple[int, ...]:
        """Return the part of a ring from nearest the end of a chain to nearest its beginning, away from its middle."""
        places = self._points[list(ring)]
        first, last = (
            int(np.argmin(np.linalg.norm(places - self._points[chain.vertices[at]], axis=1))) for at in (0, -1)
        )
        forth = [(last + step) % len(ring) for step in range((first - last) % len(ring) + 1)]
        back = [(last - step) % len(ring) for step in range((last - first) % len(ring) + 1)]
        if first == last:
            return ()  # the chain runs along the limb
        front = ring.index(middle) if middle in ring else -1
        if front in forth[1:-1] or (front not in back[1:-1] and len(back) > len(forth)):
            forth = back
        return tuple(ring[at] for at in forth)

    # Across the surface

    def _across(self, chain: Wire, network: Network, end: Pick) -> Search:
        """Bend the closed cuts through the beginning of a chain to its end, and take the part behind the chain."""
        seed = network.seed
        assert seed is not None
        begin = seed.begins("SURFACE")
        # A live wire answers only its newest request, and offers are asked for at the same time.
        live = self._engines.cuts().fork()
        self.lives = (live,)
        first, second = for_live(end, "SURFACE"), for_live(begin, "SURFACE")
        found = yield from _final(lambda: live.closed_wires(first))
        for cut in found.cuts:
            bent = yield from _final(lambda cut=cut: live.bent_wire(first, second, cut.id))
            for each in bent.cuts:
                wire = self._part_behind(each, chain, begin, end)
                if wire is not None:
                    return wire
        return None

    def _part_behind(self, cut: ClosedCut, chain: Wire, begin: Pick, end: Pick) -> Wire | None:
        """Return the part of a closed cut that runs from one pick to another, away from a chain between both."""
        ends = np.array([piece.points[-1] for piece in cut.pieces])
        gaps = np.linalg.norm(ends[:-1] - place_of(begin, self._points), axis=1)
        if not len(gaps):
            return None
        at = int(np.argmin(gaps)) + 1
        parts = [
            [
                (np.asarray(piece.points), [int(v) for v in piece.vertices], np.asarray(piece.faces))
                for piece in cut.pieces[at:]
            ],
            [
                (np.asarray(piece.points)[::-1], [int(v) for v in piece.vertices][::-1], np.asarray(piece.faces)[::-1])
                for piece in cut.pieces[at - 1 :: -1]
            ],
        ]
        behind = max((part for part in parts if part), key=lambda part: _away(part, chain.points))
        vertices = (*itertools.chain.from_iterable(piece[:-1] for _, piece, _ in behind), behind[-1][1][-1])
        points = np.concatenate([*(piece[:-1] for piece, _, _ in behind), behind[-1][0][-1:]])
        faces = np.concatenate([piece for _, _, piece in behind])
        self.joints = tuple(piece[-1] for _, piece, _ in behind[:-1])
        return Wire("SURFACE", vertices, points, begin, end, faces)


def _only_wire(network: Network) -> Wire | None:
    """Return the wire of a chain that has no other; None if it has more."""
    seed = network.seed
    assert seed is not None
    return next(
        (
            wire
            for wire, at in network.at(seed.began)
            if at == "start" and undirected(wire.end) == undirected(seed.place)
        ),
        None,
    )


def _final(ask: Callable[[], Found]) -> Generator[None, None, Found]:
    """Ask until the answer is final."""
    while not (found := ask()).final:
        yield
    return found


def _wire_between(live: LiveWire, begin: Pick, forward: bool, end: int) -> Generator[None, None, tuple[int, ...]]:
    """Return the vertices of the leading wire along edges to a vertex, without the edge that it goes on from."""
    if vertices_of(begin)[-1] == end:
        return (end,)
    live.seed(for_live(begin, "EDGES"), forward=forward)
    found = yield from _final(lambda: live.wires(end))
    wires, leading = by_number(found)
    vertices = tuple(int(vertex) for vertex in wires[leading].vertices)
    return vertices[1:] if forward else vertices


def _away(part: Sequence[tuple[NDArray[np.float64], object, object]], course: NDArray[np.float64]) -> float:
    """Return how far pieces run from a course, in the mean."""
    points = np.concatenate([piece for piece, *_ in part])
    return float(np.mean([np.nanmin(nearest_on_segments(at, course[:-1], course[1:])[1]) for at in points]))
