# SPDX-License-Identifier: GPL-3.0-or-later
"""How the library's wires from a seed to a target become ways of a request, and the search for the course of one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.refused import Refused
from ..network.network import surface_vertex
from ..network.picks import FacePoint, is_same, pick_name
from ..network.wires import Wire, distinct
from ..solver.solver import by_number, for_live
from .courses import Course, Search

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from ...terms.choices import Along
    from ..network.drawn import Drawn
    from ..network.network import Link, Network, Request, Way
    from ..network.picks import Edge, End, Pick
    from ..network.stops import Stops
    from ..solver.solver import Candidate, Candidates, LiveWire


@dataclass(frozen=True)
class Begin:
    """Where the library's wires begin. They may go `forward` from a directed edge, which `skips` says belongs to the wire before."""

    pick: Pick
    forward: bool = False
    skips: bool = False

    @classmethod
    def of(cls, pick: Pick, along: Along, heading: Edge | None = None) -> Begin:
        """Return where wires begin at a pick, going on along edges from the edge `heading`."""
        if along == "SURFACE":
            return cls(surface_vertex(heading or pick))
        return cls(pick) if heading is None else cls(heading, forward=True, skips=True)

    def sow(self, live: LiveWire, along: Along) -> None:
        """Let live wires begin there. Raise ValueError if that is not part of the surface."""
        live.seed(for_live(self.pick, along), forward=self.forward)

    def is_at(self, pick: Pick, clicked: Pick) -> bool:
        """Whether a wire to a pick would end where it begins, at the clicked place."""
        if is_same(pick, self.pick) or is_same(pick, clicked):
            return True
        return self.forward and isinstance(self.pick, tuple) and pick == self.pick[1]


def directed(wire: Wire | None, end: End) -> Edge | None:
    """Return the last edge of a wire along edges, towards one of its ends."""
    if wire is None or wire.closed or wire.along == "SURFACE" or len(wire.vertices) < 2:
        return None
    return wire.vertices[-2:] if end == "end" else wire.vertices[1::-1]


def heading_of(wire: Wire, end: End, start: Pick) -> Edge | None:
    """Return the directed edge that what begins at a pick goes on from, if an end of the wire is there."""
    return directed(wire, end) if is_same(getattr(wire, end), start) else None


def across(candidate: Candidate, follow: int, begin: Pick, end: Pick, moving: End = "end") -> Wire | None:
    vertices = tuple(int(v) for v in candidate.vertices)
    # Between points of one face there may be no edge to snap to.
    least = 1 if isinstance(begin, FacePoint) or isinstance(end, FacePoint) else 2
    if len(vertices) < least or len(candidate.points) < 2:
        return None
    points, faces = np.array(candidate.points, dtype=np.float64), np.array(candidate.faces)
    if moving == "start":
        vertices, points, faces = vertices[::-1], points[::-1], faces[::-1]
    return Wire("SURFACE", vertices, points, begin, end, faces, follow=follow)


def along_edges(
    candidate: Candidate,
    follow: int,
    begin: Begin,
    ends: tuple[Pick, Pick],
    avoid: int | None,
    points: NDArray[np.float64],
    moving: End = "end",
) -> Wire | None:
    """Return the library's wire along edges between two picks, found towards its `moving` end. It ends where it passes `avoid`."""
    vertices = tuple(int(v) for v in candidate.vertices)[begin.skips :]
    if avoid in vertices:
        vertices = vertices[: vertices.index(avoid) + 1]
    if len(vertices) < 2:
        return None
    heading = begin.pick if moving == "end" and begin.skips and isinstance(begin.pick, tuple) else None
    if moving == "start":
        vertices = vertices[::-1]
    return Wire("EDGES", vertices, points[list(vertices)], *ends, heading=heading, follow=follow)


def ways_of(
    found: Candidates, way: Way, begin: Begin, avoid: int | None, points: NDArray[np.float64]
) -> tuple[list[Wire | None], int]:
    candidates, leading = by_number(found)
    if way.along == "SURFACE":
        return [across(each, row, way.start, way.end, way.moving) for row, each in enumerate(candidates)], leading
    ends = way.start, way.end
    return [
        along_edges(each, row, begin, ends, avoid, points, way.moving) for row, each in enumerate(candidates)
    ], leading


def goal(target: Pick, first: Wire | None) -> tuple[Pick, int | None]:
    """Return where wires along edges to a target lead, and a vertex where they may end before.

    `first` is the wire that leaves the target, an edge, over one end: a wire that arrives there does so at the other.
    """
    if isinstance(target, tuple) and first is not None and first.heading is None and not first.closed:
        return first.vertices[0], first.vertices[1]
    return target, None


def in_order(ways: Sequence[Wire | None], first: int) -> tuple[Wire, ...]:
    """Return the ways that differ, in the order in which they come forward, from that of one metric on."""
    return distinct(ways[(first + step) % len(ways)] for step in range(len(ways)))


def choices(way: Way, ways: Sequence[Wire | None], leading: int) -> tuple[Wire, ...]:
    """Return the ways that a request can take, that without `turns` first."""
    known = way.follow if way.follow is not None and way.follow < len(ways) else leading
    if way.was is None or not way.turns:
        return in_order(ways, known)
    return (way.was, *(other for other in in_order(ways, way.was.follow + 1) if not other.like(way.was)))


@dataclass(frozen=True)
class Ground:
    """What searches know of the mesh and of the wires that are drawn on it.

    `wire` returns the wire of a request by its number, as it runs now.
    """

    points: NDArray[np.float64]
    stops: Stops
    network: Callable[[], Network]
    drawn: Callable[[], Drawn]
    wire: Callable[[int], Wire | None]

    def heading(self, link: Link | None, start: Pick) -> Edge | None:
        """Return the directed edge that a request goes on from which begins at a pick."""
        if link is None:
            return None
        wire = self.wire(link[0])
        return None if wire is None else heading_of(wire, link[1], start)

    def after(self, own: Request) -> Wire | None:
        after = self.network().after(own)
        return None if after is None else self.wire(after.id)

    def run_on(self, live: LiveWire, wire: Wire | None, start: Pick, heading: Edge | None) -> Wire:
        """Return a wire along edges with its straight way on until that meets something. Without a wire it goes on from an edge.

        Raise ValueError if there is no way.
        """
        edge = heading if wire is None else wire.last_edge
        if edge is None:
            raise Refused("Point at where the wire should run")
        stops = self.stops.of(self.drawn(), wire, edge[1:])
        way = live.extend_straight(edge, stops[stops != edge[1]])
        vertices = tuple(int(vertex) for vertex in way.vertices)
        if len(vertices) < 2:
            raise Refused("The wire cannot be extended from here")
        if wire is not None:
            vertices, heading = wire.vertices + vertices[1:], wire.heading
        return Wire("EDGES", vertices, self.points[list(vertices)], start, vertices[-1], heading=heading)

    def check(self, way: Way, wire: Wire) -> None:
        if not wire.leaves_trace:
            raise Refused("Too short to become a seam: click farther away")
        # The snapped edges of a wire that is cut tell nothing about where it runs.
        if way.closes is not None and not isinstance(wire.end, FacePoint):
            known = {edge for own in self.drawn().wires if own.id != way.id for edge in own.edges()}
            if known.issuperset(wire.edges()):
                raise Refused("The way back runs along the chain itself: place another seed first")


def search_way(way: Way, ground: Ground, live: LiveWire, begun: Begin | None = None) -> Search:
    """Find the course of a way. If `begun` is given, the live wires have begun to compute from there already."""
    return Search.of(live, _courses(way, ground, live, begun))


def _courses(way: Way, ground: Ground, live: LiveWire, begun: Begin | None) -> Iterator[Course]:
    while True:
        begin, target, avoid = _plan(way, ground)
        if way.runs_on and way.end == way.start:
            wire = ground.run_on(live, None, way.start, ground.heading(way.goes_on, way.start))
            yield Course((_kept(way, wire),), final=True)
        if begin != begun:
            begin.sow(live, way.along)
            begun = begin
        found = live.wires(for_live(target, way.along))
        ways, leading = ways_of(found, way, begin, avoid, ground.points)
        if found.final:
            yield turned(way, ground, live, choices(way, ways, leading))
        shown = in_order(ways, leading if way.follow is None else way.follow)
        if way.was is not None:
            yield Course((way.was,))
        else:
            yield Course((_kept(way, shown[0]),) if shown else ())


def _plan(way: Way, ground: Ground) -> tuple[Begin, Pick, int | None]:
    """Return where the library's wires begin, where they lead, and a vertex where they may end before."""
    if way.moving == "end":
        begin = Begin.of(way.start, way.along, ground.heading(way.goes_on, way.start))
        if way.along == "SURFACE" or way.closes is None:
            return begin, way.end, None
        return begin, *goal(way.end, ground.wire(way.closes))
    after = ground.after(way) if way.along == "EDGES" else None
    begin = backwards(way.end, way.was, after, way.along)
    direction = ground.heading(way.meets, way.start)
    return (begin, way.start, None) if direction is None else (begin, direction[1], direction[0])


def turned(way: Way, ground: Ground, live: LiveWire, ordered: tuple[Wire, ...]) -> Course:
    """Return the course with the one of some known ways that a request takes. Raise Refused if it is of no use."""
    if not ordered:
        raise Refused(f"No wire from {pick_name(way.start)} reaches {pick_name(way.end)}")
    wire, was = ordered[way.turns % len(ordered)], way.was
    if way.turns and len(ordered) == 1:
        raise Refused("All wires run along the same edges here")
    leaves = isinstance(wire.end, tuple) and wire.along == "EDGES" and ground.after(way) is not None
    if way.turns and was is not None and leaves and wire.last_edge == was.last_edge[::-1]:
        # What goes on from the edge leaves it over this vertex: arriving there is enough.
        wire = replace(wire, vertices=wire.vertices[:-1], points=wire.points[:-1])
        if len(wire.vertices) < 2:
            raise Refused("No other path to this seed")
    if way.runs_on:
        wire = ground.run_on(live, wire, way.start, None)
    wire = _kept(way, wire)
    ground.check(way, wire)
    return Course((wire,), final=True, choices=() if way.runs_on else ordered)


def _kept(way: Way, wire: Wire) -> Wire:
    return way.how.of(replace(wire, id=way.id))


def backwards(stays: Pick, was: Wire | None, after: Wire | None, along: Along) -> Begin:
    """Return where wires begin that are looked for from the end that stays; `after` goes on from there."""
    if along == "SURFACE":
        return Begin(surface_vertex(stays))
    if after is None:
        return Begin(stays)
    if isinstance(stays, tuple):
        # The wire after this one leaves the edge over its second vertex: this one arrives over the first.
        assert was is not None
        return Begin(was.last_edge[::-1], forward=True)
    return Begin((after.vertices[1], after.vertices[0]), forward=True, skips=True)
