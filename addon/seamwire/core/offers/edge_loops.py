# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge loops: what one click on an edge offers, closed loops, strips, and more."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments
from ..base.messages import Message
from ..network.picks import undirected
from ..network.stops import ranked
from ..network.symmetry import among
from ..network.wires import Wire
from .crossing import Direction, Directions, as_crossing, as_kept, is_loop_of
from .hairpins import is_hairpin
from .offers import Offers

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from numpy.typing import NDArray

    from ..network.network import Network, Snap
    from ..network.picks import Edge, Pick
    from ..network.stops import Stops
    from ..network.wires import LoopKind
    from ..solver.solver import Engines, LiveWire
    from .flat_regions import FlatRegions


_BY_KIND: Mapping[LoopKind, float] = {"CLOSED": 0.0, "PAST": 0.2, "STRIP": 0.5, "WHOLE": 0.7, "FLAT": 0.8}
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
    """The loops that a click on the edge under the cursor may add.

    Parameters
    ----------
    engines
        Find it.
    stops
        Where strips end.
    points
        (n, 3) vertices of the mesh.
    flat
        Finds the borders of flat regions; None: they are not offered.
    """

    SINGLE = Message.of("nothing-else-through-edge")

    def __init__(
        self, engines: Engines, stops: Stops, points: NDArray[np.float64], flat: FlatRegions | None = None
    ) -> None:
        super().__init__()
        self._engines = engines
        self._stops = stops
        self._points = points
        self._flat = flat
        self._snap: Snap | None = None
        self._metric: tuple[object, ...] = ()
        self._known: dict[Edge, tuple[Wire, ...]] = {}
        self._directions = Directions()
        self._taken: tuple[Pick | None, Wire | None] = (None, None)

    def point_at(self, snap: Snap | None) -> None:
        """Learn which edge crosses the picked one at the cursor, and which face is under it."""
        before, self._snap = self._snap, snap
        if before is not None and snap is not None and self.edge == undirected(snap.pick):
            self.final = self.final and (before.crossing, before.triangle) == (snap.crossing, snap.triangle)

    def wait(self) -> None:
        """Wait for what the offers need beside the library."""
        if self._flat is not None:
            self._flat.wait()

    def aim(self, pick: Pick | None) -> bool:
        """Ask for the offers for a pick, or for none; return whether others vanish because of that."""
        if pick is None:
            self._directions.forget()
        elif self.edge != undirected(pick):
            self._directions.was_shown(self.wire, self.choice > 0)
        return super().aim(pick)

    def took(self, edge: Edge, wire: Wire) -> None:
        """Remember which wire a click on an edge took, even if it crosses the edge."""
        self._taken = undirected(edge), wire

    def taken_through(self, network: Network, edge: Edge) -> Wire | None:
        """Return the newest wire of a network that a click on an edge took."""
        pick, wire = self._taken
        last = network.find(wire) if pick == undirected(edge) else None
        return network.taken_through(edge) if last is None or last.through is None else last

    def forget(self) -> None:
        """Forget what was found: the seams of the mesh are others now."""
        self._known.clear()

    def takes(self, pick: Pick) -> bool:
        """Whether it is an edge."""
        return isinstance(pick, tuple)

    def flat_border(self, edge: Edge) -> set[Edge]:
        """Return the edges of the likeliest border of a flat region beside an edge, or nothing."""
        border = next(self._flat.borders(edge), ()) if self._flat is not None else ()
        return {undirected(pair) for pair in zip(border, border[1:] + border[:1], strict=True)}

    def find(self, pick: Pick, network: Network, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on an edge may take; nothing, too, while it is computed, see `final`.

        Parameters
        ----------
        pick
            The edge; a vertex has no offers.
        network
            The wires that there are.
        kept
            The one of them that such a click took, which comes first then; None: the newest one that did.

        Raises
        ------
        ValueError
            Where the edge is not part of the surface.
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
        return self._with_crossing(pick, self._with_face(pick, offers, network), network)

    def _through(self, edge: Edge, network: Network) -> tuple[Wire, ...]:
        """Return what leads through an edge, the likeliest first; nothing, too, while it is computed, see `final`.

        The library computes one loop at a time. The loops found are remembered as long as nothing else changes.
        """
        engines = self._engines
        metric = network, engines.metric, engines.strengths["EDGES"], engines.clamp
        if metric != self._metric or len(self._known) > _MOST_KNOWN:
            self._metric = metric
            self._known.clear()
        if edge not in self._known:
            offers, self.final = self._compute(edge, network)
            if not self.final:
                return ()
            self._known[edge] = offers
        return self._known[edge]

    def _compute(self, edge: Edge, network: Network) -> tuple[tuple[Wire, ...], bool]:
        # An edge that is taken already stops itself: what remains to be offered there is more than that.
        stops = None if self._stops.taken(network, edge) else self._stops.of(network, None, edge)
        return find_offers(
            self._engines.get("EDGES"),
            edge,
            stops,
            self._points,
            self._engines.strengths["EDGES"],
            kept=self._stops.kept(network),
            last=_last_kind(network),
            flat=self._flat,
        )

    def _with_face(self, edge: Edge, offers: tuple[Wire, ...], network: Network) -> tuple[Wire, ...]:
        """Return offers with the border of the flat face under the cursor, even if the edge lies inside that face."""
        snap = self._snap
        if self._flat is None or snap is None or snap.triangle is None or undirected(snap.pick) != undirected(edge):
            return offers
        border = self._flat.border_around(snap.triangle)
        if not border or not offers:
            return offers
        sides = [undirected(pair) for pair in zip(border, border[1:] + border[:1], strict=True)]
        middle = self._points[[*edge]].mean(axis=0)
        gaps = nearest_on_segments(middle, *self._points[np.array(sides)].transpose(1, 0, 2))[1]
        through = edge if undirected(edge) in sides else sides[int(np.nanargmin(gaps))]
        wire = _wire("FLAT", border, True, through, self._points, self._engines.strengths["EDGES"])
        if wire is None or any(set(offer.edges()) == set(sides) for offer in offers):
            return offers
        if is_hairpin(border, self._points, self._flat.half_edges):
            return (*offers, wire)
        kept = ranked(self._stops.kept(network))
        return _likeliest_first(
            self._engines.get("EDGES"), (*offers, wire), self._points, kept, _last_kind(network), self._flat
        )

    def _with_crossing(self, edge: Edge, offers: tuple[Wire, ...], network: Network) -> tuple[Wire, ...]:
        """Return offers with the loop that crosses the edge at the cursor: second, or first where edges are short."""
        snap = self._snap
        if snap is None or snap.crossing is None or not offers or undirected(snap.pick) != undirected(edge):
            return offers
        found = self._through(snap.crossing, network)
        if not self.final:
            return () if snap.is_close_call else offers
        known = [set(offer.edges()) for offer in offers]
        live = self._engines.get("EDGES")
        across = (wire for wire in found if wire.kind != "FLAT" and not is_loop_of(wire, edge))
        others = (wire for wire in across if set(wire.edges()) not in known)
        crossing = next((wire for wire in others if not _doubles_back(live, wire, self._points, self._flat)), None)
        if crossing is None:
            return offers
        first, *rest = offers
        both = [first, as_crossing(crossing)]
        if snap.is_close_call and self._directions.crossing_first(
            self._direction(first, edge, network), self._direction(crossing, snap.crossing, network)
        ):
            both.reverse()
        return (*both, *rest)

    def _direction(self, wire: Wire, edge: Edge, network: Network) -> Direction:
        live, kept = self._engines.get("EDGES"), ranked(self._stops.kept(network))
        unlikeliness = _unlikeliness(live, wire, self._points, kept, _last_kind(network) or "CLOSED")
        return Direction(wire, unlikeliness, self._points[[*edge]])


def _last_kind(network: Network) -> LoopKind | None:
    """Return what a click on an edge took last; None: nothing yet."""
    return next((wire.kind for wire in reversed(network.wires) if wire.kind is not None), None)


def taken(offers: tuple[Wire, ...], choice: int, marks: bool) -> Wire:
    """Return an offer as a wire to be kept, with the others in their order, the next one first."""
    offers = tuple(as_kept(offer) for offer in offers)
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
    flat: FlatRegions | None = None,
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
        The last kind of loop that was added, because the next one is likely of the same kind. None at first.
    flat
        Finds the borders of flat regions beside the edge; None: they are not offered.

    Raises
    ------
    ValueError
        Where the edge is not part of the surface.
    """
    loop = live.loop(edge)
    is_flat_known = flat is None or flat.ready()
    if not (loop.final and is_flat_known):
        return (), False
    found = [_wire("CLOSED", loop.vertices, True, edge, points, strength)]
    if stops is not None:
        strip = live.edge_loop(edge, stops)
        found.append(_wire("STRIP", strip.vertices, strip.closed, edge, points))
        found.append(_wire("PAST", *past_poles(live, edge, stops), edge, points))
    chain = live.edge_loop(edge, ())
    found.append(_wire("WHOLE", chain.vertices, chain.closed, edge, points))
    if flat is not None:
        found += [_wire("FLAT", border, True, edge, points, strength) for border in flat.borders(edge)]
    # Of those that run along the same edges the first.
    different = {frozenset(wire.edges()): wire for wire in reversed(found) if wire is not None}
    offers = [wire for wire in found if wire in different.values()]
    return _likeliest_first(live, offers, points, ranked(kept), last, flat), True


def _likeliest_first(
    live: LiveWire,
    offers: Sequence[Wire],
    points: NDArray[np.float64],
    kept: NDArray[np.int64],
    last: LoopKind | None,
    flat: FlatRegions | None,
) -> tuple[Wire, ...]:
    """Return offers in the order in which they are shown: hairpins come last."""
    if len(offers) < 2:
        return tuple(offers)

    def order(wire: Wire) -> tuple[bool, float]:
        return _doubles_back(live, wire, points, flat), _unlikeliness(live, wire, points, kept, last or "CLOSED")

    return tuple(sorted(offers, key=order))


def _doubles_back(live: LiveWire, wire: Wire, points: NDArray[np.float64], flat: FlatRegions | None) -> bool:
    """Return whether a loop is a hairpin.

    The exceptions are edge loops, which may be narrow, such as those around a mouth, and borders of flat regions.
    """
    if flat is None or not wire.closed or wire.kind == "FLAT" or wire.through is None:
        return False
    ring = live.edge_loop(wire.through, ())
    if ring.closed and set(map(int, ring.vertices)) == set(wire.vertices):
        return False
    return is_hairpin(wire.vertices, points, flat.half_edges)


def _unlikeliness(
    live: LiveWire, wire: Wire, points: NDArray[np.float64], kept: NDArray[np.int64], last: LoopKind
) -> float:
    """Return how unlikely an offer is to be what the artist wants, in corners of a loop."""
    assert wire.kind is not None
    inner = wire.vertices if wire.closed else wire.vertices[1:-1]
    crossings = min(int(among(np.array(inner, dtype=np.int64), kept).sum()), _MOST_CROSSINGS)
    cost = _BY_KIND[wire.kind] + (wire.kind != last)
    if wire.kind in {"CLOSED", "FLAT"}:
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
