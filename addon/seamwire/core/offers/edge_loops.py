# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge loops: what one click on an edge offers, closed loops, strips, and more."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of, nearest_on_segments
from ..base.half_edges import among
from ..network.picks import undirected
from ..network.wires import Wire
from .offers import Offers

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from ...terms.choices import LoopKind
    from ..network.drawn import Drawn
    from ..network.network import Snap
    from ..network.picks import Edge, Pick
    from ..network.stops import Stops
    from ..solver.solver import Engines, LiveWire
    from .part_borders import PartBorders, VertexChain

_MUCH_SHORTER = 0.8
"""Loops whose lengths differ by less count as equally long."""


@dataclass(frozen=True)
class Direction:
    """The likeliest loop in one direction, and both ends of its edge at the cursor, (2, 3)."""

    wire: Wire
    unlikeliness: float
    edge: NDArray[np.float64]


class Directions:
    """Chooses between the loop through an edge and the loop that crosses it, where edges are too short to point at one.

    The last loop that was shown counts until the artist stops asking for loops. So the direction stays while the cursor moves.
    """

    def __init__(self) -> None:
        self._last: Wire | None = None
        self._is_chosen = False

    def forget(self) -> None:
        """Forget the last loop: the artist asks for loops anew."""
        self._last, self._is_chosen = None, False

    def was_shown(self, wire: Wire | None, is_chosen: bool) -> None:
        """Remember the loop that was shown last; `is_chosen`: the artist asked for it in place of the first one."""
        if wire is not None:
            self._last, self._is_chosen = wire, self._is_chosen or is_chosen

    def crossing_first(self, own: Direction, crossing: Direction) -> bool:
        """Whether the crossing loop comes first: the chosen direction, the likelier one, the shorter one, the last one."""
        if self._is_chosen and self._last is not None:
            return self._follows(self._last, own, crossing)
        if own.unlikeliness != crossing.unlikeliness:
            return crossing.unlikeliness < own.unlikeliness
        own_length, crossing_length = length_of(own.wire.points), length_of(crossing.wire.points)
        if min(own_length, crossing_length) < _MUCH_SHORTER * max(own_length, crossing_length):
            return crossing_length < own_length
        return self._last is not None and self._follows(self._last, own, crossing)

    @staticmethod
    def _follows(last: Wire, own: Direction, crossing: Direction) -> bool:
        """Whether the crossing edge runs more like the last loop, where that is nearest, than the picked edge does."""
        starts, ends = last.points[:-1], last.points[1:]
        _, gaps = nearest_on_segments(own.edge.mean(axis=0), starts, ends)
        at = int(np.nanargmin(gaps))
        return _cosine(crossing.edge, (starts[at], ends[at])) > _cosine(own.edge, (starts[at], ends[at]))


def _cosine(one: ArrayLike, two: ArrayLike) -> float:
    """Return the cosine of the angle between two edges without directions."""
    along, other = np.diff(one, axis=0)[0], np.diff(two, axis=0)[0]
    size = float(np.linalg.norm(along) * np.linalg.norm(other))
    return abs(float(along @ other)) / size if size > 0.0 else 0.0


KIND_COSTS: Mapping[LoopKind, float] = {"CLOSED": 0.0, "PAST": 0.2, "STRIP": 0.5, "WHOLE": 0.7, "FLAT": 0.8}
_LOOPS = {"CLOSED", "FLAT"}
"""The kinds of loops that the metric finds, and whose corners count."""
_LOOP_CROSSES = 0.7
_STRIP_CROSSES = 0.2
"""How unlikely an offer is, in corners of a loop; being of another kind than what was taken last counts as a corner, too.
Fitted to what artists' seams consist of, see docs/method/edges.md."""
_MOST_CORNERS, _MOST_CROSSINGS = 3, 4
"""More than these say no more."""
_CORNER_COSINE = 0.5
_MOST_KNOWN = 64
"""So many edges whose offers are remembered."""
_MOST_PIECES = 64
"""Straight pieces of a loop that are looked at: over triangles it may have as many as edges."""


class LoopOffers(Offers):
    """The loops that a click on the edge under the cursor may add."""

    SINGLE = "No other loop through this edge"

    def __init__(self, engines: Engines, stops: Stops, points: NDArray[np.float64], parts: PartBorders) -> None:
        super().__init__()
        self._engines = engines
        self._stops = stops
        self._points = points
        self._parts = parts
        self._snap: Snap | None = None
        self._metric: tuple[object, ...] = ()
        self._known: dict[Edge, tuple[tuple[Wire, ...], frozenset[Edge]]] = {}
        self._with_parts = False
        self._directions = Directions()
        self._taken: tuple[Pick | None, Wire | None] = (None, None)

    def point_at(self, snap: Snap | None) -> None:
        """Learn which edge crosses the picked one at the cursor, and which face is under it."""
        before, self._snap = self._snap, snap
        if before is not None and snap is not None and self.edge == undirected(snap.pick):
            same = (before.crossing, before.triangle, before.inside) == (snap.crossing, snap.triangle, snap.inside)
            self.final = self.final and same and self._with_parts == self._parts.is_complete

    def wait(self) -> None:
        """Wait for what the offers need beside the library."""
        self._parts.wait()
        self.final = self.final and self._with_parts == self._parts.is_complete

    @property
    def _live(self) -> LiveWire:
        return self._engines.get("EDGES")

    def aim(self, pick: Pick | None) -> bool:
        """Ask for the offers for a pick, or for none; return whether others vanish because of that."""
        if pick is None:
            self._directions.forget()
            self.stop_search()
        elif self.edge != undirected(pick):
            self._directions.was_shown(self.wire, self.choice > 0)
        return super().aim(pick)

    def took(self, edge: Edge, wire: Wire) -> None:
        """Remember which wire a click on an edge took, even if it crosses the edge."""
        self._taken = undirected(edge), wire

    def taken_through(self, network: Drawn, edge: Edge) -> Wire | None:
        """Return the newest wire of a network that a click on an edge took."""
        pick, wire = self._taken
        last = network.find(wire) if pick == undirected(edge) else None
        return network.taken_through(edge) if last is None or last.through is None else last

    def forget(self) -> None:
        """Forget what was found: the seams of the mesh may be others now."""
        self._known.clear()
        self._parts.renew()

    def stop_search(self) -> None:
        """Let the search for parts end: nobody asks for them any more."""
        self._parts.stop()

    def takes(self, pick: Pick) -> bool:
        """Whether it is an edge."""
        return isinstance(pick, tuple)

    def part_border(self, edge: Edge) -> set[Edge]:
        """Return the edges of the likeliest border of a part beside an edge, or nothing."""
        return set(_sides(next(self._parts.borders(edge), ())))

    def find(self, pick: Pick, network: Drawn, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on an edge may take; nothing, too, while it is computed, see `final`.

        A vertex has no offers. The wire of the network that such a click took, `kept` or else the newest one, comes first. Raises
        ValueError where the edge is not part of the surface.
        """
        self.final = True
        if not isinstance(pick, tuple):
            return ()
        own = kept or self.taken_through(network, pick)
        if own is not None and own.offers:
            return own.all_offers()
        # Wires that were stored have lost their offers: they are those of a click made without them.
        if own is not None:
            network = network.without(own)
        offers = self._through(pick, network)
        if not self.final:
            return ()
        if own is not None:
            return (replace(own, offers=()), *others(own, offers))
        return self._with_part(pick, self._with_crossing(pick, self._with_face(pick, offers, network), network))

    def _through(self, edge: Edge, network: Drawn) -> tuple[Wire, ...]:
        """Return what leads through an edge, the likeliest first; nothing, too, while it is computed, see `final`.

        The library computes one loop at a time. The loops found are remembered as long as nothing else changes.
        """
        engines = self._engines
        self._parts.ready()  # begins the search again if it was stopped
        self._with_parts = self._parts.is_complete
        metric = network, engines.metric, engines.strengths["EDGES"], engines.clamp, self._with_parts
        if metric != self._metric or len(self._known) > _MOST_KNOWN:
            self._metric = metric
            self._known.clear()
        if edge not in self._known:
            found = self._compute(edge, network)
            self.final = found is not None
            if found is None:
                return ()
            self._known[edge] = found
        return self._known[edge][0]

    def _compute(self, edge: Edge, network: Drawn) -> tuple[tuple[Wire, ...], frozenset[Edge]] | None:
        """Find what leads through an edge, the likeliest first, and the edges of the offer that slits the tube around it from rim to rim.

        The result is None while it is computed. Raises ValueError if the edge is not part of the surface.
        """
        live, parts = self._live, self._parts
        loop = live.loop(edge)
        is_known = parts.ready()
        if not (loop.final and is_known):
            return None
        found = [self._wire("CLOSED", loop.vertices, True, edge)]
        # An edge that is taken already stops itself: what remains to be offered there is more than that.
        stops: NDArray[np.int64] | tuple[()] = ()
        if not self._stops.taken(network, edge):
            stops = self._stops.of(network, None, edge)
            strip = live.edge_loop(edge, stops)
            found.append(self._wire("STRIP", strip.vertices, strip.closed, edge))
            found.append(self._wire("PAST", *past_poles(live, edge, stops), edge))
        chain = live.edge_loop(edge, ())
        found.append(self._wire("WHOLE", chain.vertices, chain.closed, edge))
        slit = self._slit(edge, stops)
        found += [slit, *(self._wire("FLAT", border, True, edge) for border in parts.borders(edge))]
        edges: frozenset[Edge] = frozenset(() if slit is None else slit.edges())
        return self._likeliest_first(_distinct(found), network, edges), edges

    def _slit(self, edge: Edge, stops: NDArray[np.int64] | Sequence[int]) -> Wire | None:
        """Return the straight way that slits the tube around an edge, or None if the edge does not lead from rim to rim.

        Diagonals of a triangulated tube wind around it. So the shortest way through the edge or beside it is returned.
        """
        rims = [set(rim) for rim in self._parts.rims(edge)]
        if not rims:
            return None
        ends = np.union1d(np.asarray(stops, dtype=np.int64), [vertex for rim in rims for vertex in rim])

        def way(through: Edge) -> Wire | None:
            chain, closed = past_poles(self._live, through, ends)
            if closed or not chain or not among(np.array([chain[0], chain[-1]]), ends).all():
                return None
            if any(rim.issuperset((chain[0], chain[-1])) for rim in rims):
                return None
            return self._wire("STRIP", chain, False, through)

        own = way(edge)
        if own is None:
            return None
        beside = filter(None, map(way, self._parts.beside(edge)))
        # Of ways of the same length, the edge's own counts.
        return min((own, *beside), key=lambda wire: round(length_of(wire.points) / length_of(own.points), 6))

    def _likeliest_first(self, offers: Sequence[Wire], network: Drawn, slit: frozenset[Edge]) -> tuple[Wire, ...]:
        """Return offers in the order in which they are shown: the slit of a tube comes first, and hairpins come last."""

        def order(wire: Wire) -> tuple[bool, bool, float]:
            return slit != set(wire.edges()), self._doubles_back(wire), self._unlikeliness(wire, network)

        return tuple(sorted(offers, key=order)) if len(offers) > 1 else tuple(offers)

    def _doubles_back(self, wire: Wire) -> bool:
        """Return whether a loop is a hairpin.

        The exceptions are edge loops, which may be narrow, such as those around a mouth, and borders of parts.
        """
        if not wire.closed or wire.kind == "FLAT" or wire.through is None:
            return False
        ring = self._live.edge_loop(wire.through, ())
        if ring.closed and set(map(int, ring.vertices)) == set(wire.vertices):
            return False
        return self._parts.half_edges.is_hairpin(wire.vertices)

    def _unlikeliness(self, wire: Wire, network: Drawn) -> float:
        """Return how unlikely an offer is to be what the artist wants, in corners of a loop.

        What leads across seams and kept wires is less likely. The next loop is likely of the same kind as the last one.
        """
        assert wire.kind is not None
        inner = np.array(wire.vertices if wire.closed else wire.vertices[1:-1], dtype=np.int64)
        crossings = min(int(among(inner, self._stops.kept(network)).sum()), _MOST_CROSSINGS)
        last = next((own.kind for own in reversed(network.wires) if own.kind is not None), "CLOSED")
        cost = KIND_COSTS[wire.kind] + (wire.kind != last)
        if wire.kind not in _LOOPS:
            return cost + _STRIP_CROSSES * crossings
        return cost + _LOOP_CROSSES * crossings + min(corners(self._live, wire.vertices, self._points), _MOST_CORNERS)

    def _wire(self, kind: LoopKind, chain: Sequence[int] | NDArray[np.int32], closed: bool, edge: Edge) -> Wire | None:
        vertices = tuple(int(vertex) for vertex in chain)
        if len(vertices) < (3 if closed else 2):
            return None
        around = [*vertices, vertices[0]] if closed else list(vertices)
        start, end = (edge, edge) if closed else (vertices[0], vertices[-1])
        strength = self._engines.strengths["EDGES"] if kind in _LOOPS else 0.0
        return Wire(
            "EDGES", vertices, self._points[around], start, end,
            closed=closed, strength=strength, kind=kind, through=undirected(edge),
        )  # fmt: skip

    def _with_face(self, edge: Edge, offers: tuple[Wire, ...], network: Drawn) -> tuple[Wire, ...]:
        """Return offers with the border of the flat face under the cursor, even if the edge lies inside that face."""
        triangle = self._triangle_at(edge)
        if triangle is None or not offers:
            return offers
        border = self._parts.flat_face(triangle)
        wire = self._border(border, edge)
        if wire is None or any(set(offer.edges()) == set(wire.edges()) for offer in offers):
            return offers
        if self._parts.half_edges.is_hairpin(border):
            return (*offers, wire)
        return self._likeliest_first((*offers, wire), network, self._known[edge][1])

    def _with_part(self, edge: Edge, offers: tuple[Wire, ...]) -> tuple[Wire, ...]:
        """Return offers with the borders of the part under the cursor first, where the cursor is inside a face.

        At an edge inside a small part, such as a bung, the rim of the part comes first. Otherwise the nearest border comes first, then the
        slit of a tube, then all borders at once, then each of the others, and those of finer and coarser parts.
        """
        triangle, snap = self._triangle_at(edge), self._snap
        if snap is None or triangle is None or not offers:
            return offers
        if not snap.inside:
            rim = self._border(self._parts.plug_rim(triangle), edge)
            is_at_rim = rim is None or undirected(edge) in rim.edges()
            return offers if is_at_rim else _distinct([rim, *offers])
        nearest_first = [
            sorted(chains, key=lambda chain: self._gaps(_sides(chain), edge).min())
            for chains in self._parts.around(triangle)
        ]
        if not nearest_first or not nearest_first[0]:
            return offers
        (first, *others), *further = nearest_first
        slits = [self._known[own][1] for own in (edge, snap.crossing) if own in self._known]
        slit = [offer for offer in offers if frozenset(offer.edges()) in slits]
        nearest, *rest = (self._border(chain, edge) for chain in (first, *others))
        every = [] if nearest is None or not rest else [replace(nearest, beside=tuple(filter(None, rest)))]
        borders = (self._border(chains[0], edge) for chains in further if chains)
        return _distinct([nearest, *slit, *every, *rest, *borders, *offers])

    def _triangle_at(self, edge: Edge) -> int | None:
        """Return the triangle under the cursor if that points at an edge, or None."""
        snap = self._snap
        return None if snap is None or undirected(snap.pick) != undirected(edge) else snap.triangle

    def _gaps(self, sides: Sequence[Edge], edge: Edge) -> NDArray[np.float64]:
        """Return the distances of edges, (k,), from the middle of an edge."""
        middle = self._points[[*edge]].mean(axis=0)
        return nearest_on_segments(middle, *self._points[np.array(sides)].transpose(1, 0, 2))[1]

    def _border(self, chain: VertexChain, edge: Edge) -> Wire | None:
        """Return a border as the offer of an edge that it need not run along, or None if there is no border."""
        sides = _sides(chain)
        if not sides:
            return None
        through = edge if undirected(edge) in sides else sides[int(np.nanargmin(self._gaps(sides, edge)))]
        return self._wire("FLAT", chain, True, through)

    def _with_crossing(self, edge: Edge, offers: tuple[Wire, ...], network: Drawn) -> tuple[Wire, ...]:
        """Return offers with the loop that crosses the edge at the cursor: second, or first where edges are short."""
        snap = self._snap
        if snap is None or snap.crossing is None or not offers or undirected(snap.pick) != undirected(edge):
            return offers
        found = self._through(snap.crossing, network)
        if not self.final:
            return () if snap.is_close_call else offers
        known = [set(offer.edges()) for offer in offers]
        across = (wire for wire in found if wire.kind != "FLAT" and undirected(edge) not in wire.edges())
        others = (wire for wire in across if set(wire.edges()) not in known)
        crossing = next((wire for wire in others if not self._doubles_back(wire)), None)
        if crossing is None:
            return offers
        first, *rest = offers
        both = [first, replace(crossing, kind="CROSSING")]
        if snap.is_close_call and self._directions.crossing_first(
            self._direction(first, edge, network), self._direction(crossing, snap.crossing, network)
        ):
            both.reverse()
        return (*both, *rest)

    def _direction(self, wire: Wire, edge: Edge, network: Drawn) -> Direction:
        return Direction(wire, self._unlikeliness(wire, network), self._points[[*edge]])


def taken(offers: tuple[Wire, ...], choice: int, marks: bool) -> Wire:
    """Return an offer as a wire to be kept, with the others in their order, the next one first.

    A loop that crosses the picked edge is kept as a closed loop or a strip.
    """
    offers = tuple(
        replace(offer, kind="CLOSED" if offer.closed else "STRIP") if offer.kind == "CROSSING" else offer
        for offer in offers
    )
    others = tuple(offer for offer in offers[choice + 1 :] + offers[:choice] if not offer.beside)
    return offers[choice].anew(marks=marks, offers=others, beside=())


def others(kept: Wire, offers: tuple[Wire, ...]) -> tuple[Wire, ...]:
    """Return what else is offered where a wire is kept, in order: what comes after its kind first."""
    at = next((i for i, offer in enumerate(offers) if offer.kind == kept.kind), -1)
    edges = set(kept.edges())
    return tuple(offer for offer in offers[at + 1 :] + offers[: max(at, 0)] if set(offer.edges()) != edges)


def corners(live: LiveWire, loop: Sequence[int], points: NDArray[np.float64]) -> int:
    """Count the vertices where a closed chain turns off by 60 degrees or more, though straight ways go on there.

    From neither side does the straight way follow the chain at such a vertex. Where both lead into the same third edge, three edges meet,
    and no way is straight. `live` runs along edges. The first vertex of the loop is not repeated. Points are the mesh's vertices, (n, 3).
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
    """Return for each vertex of a closed chain its successor if the chain went straight on there, or -1."""
    after = np.full(len(loop), -1, dtype=np.int64)
    at = 0
    for _ in range(_MOST_PIECES):
        if at >= len(loop):
            break
        # As far as the chain follows it, one way tells of all vertices.
        way = np.asarray(live.extend_straight((loop[at - 1], loop[at]), ()).vertices, dtype=np.int64)[
            1 : len(loop) - at + 1
        ]
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
        return tuple(int(vertex) for vertex in live.extend_straight((first, second), stops).vertices)

    forth = way(*edge)
    if len(forth) > 2 and forth[-1] == edge[0]:
        return (edge[0], *forth[:-1]), True
    back = way(edge[1], edge[0])
    chain = (*back[::-1], *forth)
    return (chain if len(set(chain)) == len(chain) else ()), False


def _sides(chain: Sequence[int]) -> list[Edge]:
    """Return the edges of a closed chain."""
    return [undirected(pair) for pair in zip(chain, (*chain[1:], *chain[:1]), strict=True)]


def _distinct(offers: Iterable[Wire | None]) -> tuple[Wire, ...]:
    """Return offers without those that run along the same edges as an earlier one."""
    found: dict[frozenset[Edge], Wire] = {}
    for offer in offers:
        if offer is not None:
            found.setdefault(frozenset(edge for loop in (offer, *offer.beside) for edge in loop.edges()), offer)
    return tuple(found.values())
