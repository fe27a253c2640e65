# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of wires, as data that does not change: every edit makes a new one, so that undo is keeping the old.

Knows neither Blender nor the library.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .strokes import Stroke

Along = Literal["EDGES", "SURFACE"]
"""Where wires run: along the mesh's edges, or across its surface."""

Finish = Literal["SNAP", "SLIDE", "CUT"]
"""What becomes the seam of a wire across the surface: the edges nearest to it, these with their vertices slid onto it, or itself, cut
into the faces."""


@dataclass(frozen=True)
class FacePoint:
    """A point inside a triangle of the mesh: where wires across the surface begin and end that are to be cut into it.

    Parameters
    ----------
    triangle
        Its number among those that the surface was made of.
    corners
        Its vertices.
    weights
        Of each corner, 0 or more; their sum is 1.
    """

    triangle: int
    corners: tuple[int, int, int]
    weights: tuple[float, float, float]

    @classmethod
    def at(
        cls, place: NDArray[np.float64], triangle: int, triangles: NDArray[np.int32], points: NDArray[np.float64]
    ) -> FacePoint:
        """Return the point of a triangle that a place is, (3,), or is near to; `points` are the vertices, (n, 3)."""
        corners = triangles[triangle]
        places = points[corners]
        (weights,), (off,) = barycentric(places[None], place)
        if not np.isfinite(off):  # the triangle has no area: the point is on one of its sides
            part, gap = nearest_on_segments(place, places, np.roll(places, -1, axis=0))
            side = int(np.argmin(gap))
            weights = np.zeros(3)
            weights[[side, (side + 1) % 3]] = 1.0 - part[side, 0], part[side, 0]
        return cls(int(triangle), tuple(corners.tolist()), tuple(weights.tolist()))

    @property
    def vertex(self) -> int:
        """The corner that it has most of: there the edges end that a wire snaps to."""
        return self.corners[self.weights.index(max(self.weights))]


Pick = int | tuple[int, int] | FacePoint
"""A vertex, an edge by its two vertices, or a point inside a triangle."""

Edge = tuple[int, int]
"""An edge by its vertices; in results the smaller one first."""

End = Literal["start", "end"]

FOLLOWS: tuple[Literal["min", "max", "concave"], ...] = ("min", "max", "concave")
"""The library's names of wires, by `Wire.follow`: along the least curvature, along the most curvature, or along concave creases (only
across the surface). Files have these numbers."""

LoopKind = Literal["CLOSED", "CROSSING", "STRIP", "PAST", "WHOLE", "FLAT", "ACROSS", "HANDLE", "RIDGE", "VALLEY"]
"""What a click takes as a whole. On an edge: the closed loop of the metric, the loop or strip that crosses the edge, the straight strip
up to what is there already, the same past poles, the whole strip, the border of a flat region. On a point of the surface: a closed cut
that separates, or one around or through a handle, which does not. On both: a ridge or a valley as far as it is one."""

LOOP_KINDS: frozenset[LoopKind] = frozenset(get_args(LoopKind)) - {"CROSSING"}
"""The kinds of kept loops. A crossing loop is kept as a closed loop or a strip."""

_ids = itertools.count()


@dataclass(frozen=True)
class Snap:
    """The edge, vertex or place under the cursor.

    Parameters
    ----------
    pick
        The vertex or the edge that a click would take.
    to
        The target of the pick: the plain mesh, a seed or a wire of the network, an existing seam, or a strong feature nearby.
    wire
        The wire, where it belongs to one.
    seen_along
        The direction from the viewer to it, in the coordinates of the session's points; None: it is not looked at.
    crossing
        The edge that crosses a picked edge at its end nearer to the cursor. Only loops need it.
    is_close_call
        Whether these two edges are too short on the screen to point at one of them.
    """

    pick: Pick
    to: Literal["MESH", "SEED", "WIRE", "SEAM", "FEATURE"] = "MESH"
    wire: Wire | None = None
    seen_along: tuple[float, float, float] | None = field(default=None, compare=False)
    crossing: Edge | None = field(default=None, compare=False)
    is_close_call: bool = field(default=False, compare=False)

    @classmethod
    def of(cls, what: Snap | Pick) -> Snap:
        """Return a snap as it is, and a pick as one on the plain mesh."""
        return what if isinstance(what, Snap) else cls(what)

    @property
    def ends_chains(self) -> bool:
        """Whether a chain that comes here ends here: at a seed, a wire or a seam."""
        return self.to in {"SEED", "WIRE", "SEAM"}


@dataclass(frozen=True)
class Seed:
    """Where the next wire begins.

    Parameters
    ----------
    pick
        A vertex, or an edge; a directed one where `forward` is set.
    forward
        The wire before this one ended on the edge `pick`, running from its first vertex to its second: the next wire
        goes on from there.
    clicked
        The clicked place, if it differs from `pick`.
    first
        Where the chain began; None: here.
    """

    pick: Pick
    forward: bool = False
    clicked: Pick | None = None
    first: Pick | None = None

    @property
    def place(self) -> Pick:
        """Where the seed is shown."""
        return self.pick if self.clicked is None else self.clicked

    @property
    def began(self) -> Pick:
        """Where the chain began."""
        return self.place if self.first is None else self.first

    @property
    def vertex(self) -> int:
        """The vertex that stands for the seed where wires cannot begin on edges, nor inside triangles."""
        return vertices_of(self.pick)[-1]

    def begins(self, along: Along) -> Pick:
        """Return where the wires begin that run one way."""
        return self.pick if along == "EDGES" or isinstance(self.pick, FacePoint) else self.vertex

    def shown(self, along: Along) -> Pick:
        """Return where the seed is shown while wires run one way."""
        return self.place if along == "EDGES" else self.begins(along)

    def at(self, pick: Pick, along: Along) -> bool:
        """Whether a wire to a pick would end where it begins."""
        own = undirected(self.begins(along)), undirected(self.place)
        return undirected(pick) in own or (self.forward and pick == self.vertex)


@dataclass(frozen=True, eq=False)
class Wire:
    """A wire from one pick to another, or a closed loop.

    Parameters
    ----------
    along
        How it was found.
    vertices
        The edges that it marks: one between each two neighbours in this list, and between last and first of a loop.
    points
        (k, 3), the curve as it is drawn; for a loop the first point comes again at the end. Along edges one point for
        each vertex.
    start, end
        The picks at its ends; the same one for a loop.
    closed
        Whether it is a loop.
    marks
        Whether its edges become seams; else they cease to be seams.
    mirror
        The axes, 0 to 2, that it is mirrored over.
    images
        The edges that its mirror images mark or clear as well, smaller vertex first; None: not found yet.
    heading
        The directed edge that it goes on from, where it begins at the end of another wire.
    follow
        Which of the library's wires it is, see `FOLLOWS`.
    alternatives
        The others of them that run elsewhere, each once, in the order in which they come forward; they have no
        alternatives themselves.
    strength
        The metric's largest anisotropy when it was found; 0: not known, or it needs none.
    finish
        Across the surface, what becomes its seam when its chain ends; along edges "CUT" says that it was cut into the faces.
    kind
        The kind of loop that one click on an edge offered, or None if the wire was drawn.
    through
        The edge of that click, smaller vertex first.
    offers
        What else that click offered, the next one first; they have no offers themselves.
    stored
        The number under which the mesh knows it as it runs now; 0: under none yet.
    id
        Its own number, kept when its course changes.
    """

    along: Along
    vertices: tuple[int, ...]
    points: NDArray[np.float64]
    start: Pick
    end: Pick
    closed: bool = False
    marks: bool = True
    mirror: tuple[int, ...] = ()
    images: tuple[Edge, ...] | None = None
    heading: Edge | None = None
    follow: int = 0
    alternatives: tuple[Wire, ...] = ()
    strength: float = 0.0
    finish: Finish = "SNAP"
    kind: LoopKind | None = None
    through: Edge | None = None
    offers: tuple[Wire, ...] = ()
    stored: int = 0
    id: int = field(default_factory=_ids.__next__)

    def edges(self) -> list[Edge]:
        """Return the edges it marks or clears, in order along the wire."""
        following = self.vertices[1:] + (self.vertices[:1] if self.closed else ())
        return [(min(a, b), max(a, b)) for a, b in zip(self.vertices, following, strict=False)]

    def claims(self) -> Iterator[Edge]:
        """Yield the edges that it and its images mark or clear."""
        yield from self.edges()
        yield from self.images or ()

    @property
    def leaves_trace(self) -> bool:
        """Whether the mesh keeps it: it runs along an edge, or is to be cut into a face."""
        return len(self.vertices) > 1 or self.finish == "CUT"

    @property
    def last_edge(self) -> Edge:
        """Its last edge in the direction that it runs."""
        return self.vertices[-2], self.vertices[-1]

    @property
    def is_cut(self) -> bool:
        """Whether it was cut into the faces, and runs along edges for that reason alone."""
        return self.along == "EDGES" and self.finish == "CUT"

    def uncut(self) -> Wire:
        """Return a wire that was cut as one across the surface, whose other courses run there; any other as it is."""
        if not self.is_cut:
            return self
        return self.changed(along="SURFACE", heading=None, start=self.vertices[0], end=self.vertices[-1])

    def like(self, other: Wire) -> bool:
        """Whether another wire runs the same way."""
        if self.along == other.along == "EDGES":
            return self.vertices == other.vertices
        return self.points.shape == other.points.shape and bool(np.allclose(self.points, other.points, rtol=1e-6))

    def retraced(self) -> Wire:
        """Return its next alternative in its place, itself as the last one after that. There must be one."""
        following, *rest = self.alternatives
        back = replace(self, alternatives=())
        return replace(
            following,
            id=self.id,
            marks=self.marks,
            mirror=self.mirror,
            finish=self.finish,
            alternatives=(*rest, back),
        )

    def drawn(self, **course: object) -> Wire:
        """Return the wire with another course, which no click on an edge offered."""
        return self.changed(**course, images=None, alternatives=(), kind=None, through=None, offers=())

    def anew(self, **changes: object) -> Wire:
        """Return it as another wire, with changes."""
        return self.changed(**changes, images=None, id=next(_ids))

    def changed(self, **changes: object) -> Wire:
        """Return it with changes that the mesh does not know yet."""
        return replace(self, **changes, stored=0)

    def all_offers(self) -> tuple[Wire, ...]:
        """Return the wire and the other offers of the click on its edge, all without further offers."""
        return replace(self, offers=()), *self.offers

    def next_offer(self, steps: int = 1) -> Wire:
        """Return what the click on its edge offered next, or some steps on, in its place."""
        offers = self.all_offers()
        offers = offers[steps:] + offers[:steps]
        return replace(offers[0], id=self.id, marks=self.marks, mirror=self.mirror, offers=offers[1:])


@dataclass(frozen=True)
class Network:
    """Wires and the seed of the live one: what undo brings back and what is stored with the mesh.

    Parameters
    ----------
    wires
        Oldest first.
    seed
        Where the live wire begins; None between chains.
    mirror
        The axes, 0 to 2, that wires are mirrored over which are kept from here on.
    strokes
        The strokes that live wires follow or keep from; where they cross, the later one counts. Kept wires stay as they
        are.
    """

    wires: tuple[Wire, ...] = ()
    seed: Seed | None = None
    mirror: tuple[int, ...] = ()
    strokes: tuple[Stroke, ...] = ()

    def find(self, wire: Wire | None) -> Wire | None:
        """Return the wire with another's number, as it runs in this network."""
        return None if wire is None else next((own for own in self.wires if own.id == wire.id), None)

    def taken_through(self, edge: Pick) -> Wire | None:
        """Return the newest wire that a click on an edge took."""
        pair = undirected(edge)
        return next((wire for wire in reversed(self.wires) if wire.through == pair), None)

    def at(self, pick: Pick) -> list[tuple[Wire, End]]:
        """Return the wires that begin or end at a pick, and which of their ends is there. Loops have no ends."""
        place = undirected(pick)
        return [
            (wire, end)
            for wire in self.wires
            if not wire.closed
            for end in ("start", "end")
            if undirected(getattr(wire, end)) == place
        ]

    @property
    def closing_point(self) -> Pick | None:
        """Where the chain of the seed began, while a wire may lead back there."""
        seed = self.seed
        if seed is None or seed.first is None or undirected(seed.first) == undirected(seed.place):
            return None
        return seed.first if self.at(seed.first) else None

    def closes(self, target: Snap) -> bool:
        """Whether a wire from the seed to a target closes the chain."""
        first = self.closing_point
        return target.to == "SEED" and first is not None and undirected(first) == undirected(target.pick)

    def joined(self, target: Snap, points: NDArray[np.float64]) -> Network:
        """Return the network with a seed where a target meets a wire; at a wire's ends there is one."""
        own = self.find(target.wire) if target.to == "WIRE" else None
        if own is None or own.closed:
            return self
        return self.with_seed_in(own, target.pick, points) or self

    def seed_at(self, target: Snap, along: Along) -> Seed:
        """Return the seed of a chain that begins at a target; where one wire ends there, the chain goes on from it."""
        pick = target.pick
        wires = self.at(pick) if target.to == "SEED" else []
        if len(wires) != 1 or along == "SURFACE" or wires[0][0].along == "SURFACE":
            return Seed(pick)
        wire, end = wires[0]
        edge = wire.last_edge if end == "end" else (wire.vertices[1], wire.vertices[0])
        return Seed(edge, forward=True, clicked=pick)

    def seeds(self) -> list[Pick]:
        """Return the seeds of the wires, each once, in the order they were placed."""
        ends = [pick for wire in self.wires if not wire.closed for pick in (wire.start, wire.end)]
        return list({undirected(pick): None for pick in ends})

    def without(self, wire: Wire) -> Network:
        """Return the network without a wire. A chain that went on from the wire's end goes on from the place itself."""
        return replace(self, wires=tuple(own for own in self.wires if own.id != wire.id), seed=self._seed_without(wire))

    def lasting(self) -> Network:
        """Return the network without the wires that leave no trace in the mesh."""
        wires = tuple(wire for wire in self.wires if wire.leaves_trace)
        return self if len(wires) == len(self.wires) else replace(self, wires=wires)

    def _seed_without(self, wire: Wire) -> Seed | None:
        seed = self.seed
        if seed is None or not seed.forward or not _goes_on(wire, seed.place, seed.pick):
            return seed
        return replace(seed, pick=seed.place, forward=False, clicked=None)

    def with_wire(self, wire: Wire) -> Network:
        """Return the network with a wire in place of the one with its number."""
        return replace(self, wires=tuple(wire if own.id == wire.id else own for own in self.wires))

    def with_drawn(self, wire: Wire, target: Pick, ends: bool) -> Network:
        """Return the network with a wire from its seed to a target as its newest; unless that `ends` it, the chain goes on."""
        after = None
        if not ends:
            first = None if self.seed is None else self.seed.began
            after = Seed(target, first=first)
            if wire.along == "EDGES":
                after = Seed(wire.last_edge, forward=True, clicked=target, first=first)
        return replace(self, wires=(*self.wires, wire), seed=after)

    def with_next_offer(self, wire: Wire, steps: int = 1) -> Network:
        """Return the network with what a click on a wire's edge offered next. What went on from the wire stays."""

        def follows(own: Wire) -> Wire:
            if own.id == wire.id:
                return own.next_offer(steps)
            return own.changed(heading=None) if _goes_on(wire, own.start, own.heading) else own

        return replace(self, wires=tuple(follows(own) for own in self.wires), seed=self._seed_without(wire))

    def before(self, wire: Wire) -> Wire | None:
        """Return the wire that a wire goes on from."""
        return next((own for own in self.wires if own is not wire and _goes_on(own, wire.start, wire.heading)), None)

    def after(self, wire: Wire) -> Wire | None:
        """Return the wire that goes on from a wire."""
        return next((own for own in self.wires if own is not wire and _goes_on(wire, own.start, own.heading)), None)

    def with_courses(self, courses: Mapping[int, Wire | None]) -> Network:
        """Return the network with other courses for some wires, by number; None: the wire goes.

        Wires and the seed that go on from a wire with a new course go on from its new last edge.
        """
        changed = [wire for wire in self.wires if wire.id in courses]

        def last_edge(before: Wire) -> Edge | None:
            course = courses[before.id]
            return None if course is None else course.last_edge

        wires = []
        for wire in self.wires:
            new = courses.get(wire.id, wire)
            if new is None:
                continue
            before = next((own for own in changed if own is not wire and _goes_on(own, wire.start, wire.heading)), None)
            wires.append(new if before is None else new.changed(heading=last_edge(before)))
        seed = self.seed
        if seed is not None and seed.forward:
            before = next((own for own in changed if _goes_on(own, seed.place, seed.pick)), None)
            course = None if before is None else courses[before.id]
            if course is not None:
                seed = replace(seed, pick=course.last_edge, clicked=course.end)
        return replace(self, wires=tuple(wires), seed=seed)

    def with_seed_in(self, wire: Wire, pick: Pick, points: NDArray[np.float64]) -> Network | None:
        """Return the network with a wire cut in two at a pick; None where that cannot be, see `split`."""
        own = self.find(wire)
        parts = None if own is None else split(own, pick, points)
        if own is None or parts is None:
            return None
        wires = itertools.chain.from_iterable(parts if one is own else (one,) for one in self.wires)
        return replace(self, wires=tuple(wires))


def _goes_on(wire: Wire, start: Pick, heading: Pick | None) -> bool:
    """Whether what begins at a place, heading on from an edge, goes on from the end of a wire."""
    return heading is not None and wire.vertices[-2:] == heading and undirected(wire.end) == undirected(start)


def distinct(ways: Iterable[Wire | None]) -> tuple[Wire, ...]:
    """Return the wires among these without those that run like an earlier one."""
    found: list[Wire] = []
    for way in ways:
        if way is not None and not any(way.like(earlier) for earlier in found):
            found.append(way)
    return tuple(found)


def undirected(pick: Pick | None) -> Pick | None:
    """Return a pick with an edge's smaller vertex first."""
    return (min(pick), max(pick)) if isinstance(pick, tuple) else pick


def vertices_of(pick: Pick) -> tuple[int, ...]:
    """Return the vertex, both vertices of an edge, or the vertex that stands for a point."""
    if isinstance(pick, FacePoint):
        return (pick.vertex,)
    return pick if isinstance(pick, tuple) else (pick,)


def place_of(pick: Pick, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where a pick is, of an edge its middle, (3,); `points` are the vertices, (n, 3)."""
    if isinstance(pick, FacePoint):
        return np.asarray(pick.weights) @ points[list(pick.corners)]
    return points[list(vertices_of(pick))].mean(axis=0)


def split(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    """Cut a wire in two where a seed is put into it.

    Parameters
    ----------
    wire
        Any wire. A loop is cut open twice, at the pick and opposite to it.
    pick
        One of its vertices or edges; across the surface a vertex of the edges that it marks.
    points
        (n, 3) vertices of the mesh.

    Returns
    -------
    tuple of Wire or None
        Both parts in order, the first with the wire's number; None where the pick is not on the wire, or at its end.
    """
    if wire.closed:
        return _split_loop(wire, pick, points)
    if wire.along == "SURFACE":
        return _split_curve(wire, pick, points)
    vertices = wire.vertices
    ends = _position(vertices, pick)
    if ends is None:
        return None
    before, after = ends
    # The edge of an edge seed belongs to the part before it, as in a chain that is drawn.
    if (before == 0 and before == after) or after == len(vertices) - 1:
        return None
    seed: Pick = vertices[after] if before == after else (vertices[before], vertices[after])
    heading = (vertices[after - 1], vertices[after])
    first = wire.drawn(vertices=vertices[: after + 1], points=wire.points[: after + 1], end=seed)
    second = wire.drawn(
        vertices=vertices[after:], points=wire.points[after:], start=seed, heading=heading, id=next(_ids)
    )
    return first, second


def _position(vertices: tuple[int, ...], pick: Pick) -> tuple[int, int] | None:
    """Return where a pick lies on a chain of vertices: the indices of its ends, twice the same for a vertex."""
    if not isinstance(pick, tuple):
        return (vertices.index(pick),) * 2 if pick in vertices else None
    for index, pair in enumerate(itertools.pairwise(vertices)):
        if undirected(pair) == undirected(pick):
            return index, index + 1
    return None


def _split_loop(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    ends = _position(wire.vertices + wire.vertices[:1], pick)
    if ends is None:
        return None
    count = len(wire.vertices)
    begin = ends[1] % count
    around = wire.vertices[begin:] + wire.vertices[: begin + 1]
    middle = count // 2
    seed: Pick = around[0] if ends[0] == ends[1] else (around[-2], around[-1])
    first = wire.drawn(
        vertices=around[: middle + 1],
        points=points[list(around[: middle + 1])],
        start=seed,
        end=around[middle],
        closed=False,
        heading=(around[-2], around[-1]),
    )
    second = wire.drawn(
        vertices=around[middle:],
        points=points[list(around[middle:])],
        start=around[middle],
        end=seed,
        closed=False,
        heading=(around[middle - 1], around[middle]),
        id=next(_ids),
    )
    return first, second


def _split_curve(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    if not isinstance(pick, int) or pick not in wire.vertices[1:-1]:
        return None
    at = wire.vertices.index(pick)
    place = points[pick]
    # The curve passes near the vertex, not through it: it is led there from the nearest of its segments.
    _, gaps = nearest_on_segments(place, wire.points[:-1], wire.points[1:])
    nearest = int(np.argmin(gaps))
    first = wire.drawn(
        vertices=wire.vertices[: at + 1],
        points=np.vstack([wire.points[: nearest + 1], place]),
        end=pick,
    )
    second = wire.drawn(
        vertices=wire.vertices[at:],
        points=np.vstack([place, wire.points[nearest + 1 :]]),
        start=pick,
        heading=None,
        id=next(_ids),
    )
    return first, second


def net_effect(claims: Iterable[tuple[Edge, bool]]) -> tuple[list[Edge], list[Edge]]:
    """Return the edges to mark and those to clear, each sorted; of several claims to an edge the last one counts."""
    effect = dict(claims)
    return sorted(e for e, marks in effect.items() if marks), sorted(e for e, marks in effect.items() if not marks)


def edges_after(edges: NDArray[np.int32], added: Iterable[Edge], removed: Iterable[Edge]) -> NDArray[np.int32]:
    """Return (k, 2) edges with some more and without others, each once, smaller vertex first."""
    more = np.array(list(added), dtype=np.int32).reshape(-1, 2)
    less = np.array(list(removed), dtype=np.int64).reshape(-1, 2)
    both = np.sort(np.concatenate([np.asarray(edges, dtype=np.int32).reshape(-1, 2), more]), axis=1).astype(np.int64)
    count = int(max(both.max(initial=0), less.max(initial=0))) + 1
    keys = np.setdiff1d(both @ (count, 1), np.sort(less, axis=1) @ (count, 1))
    return np.stack([keys // count, keys % count], axis=1).astype(np.int32)
