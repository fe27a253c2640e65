# SPDX-License-Identifier: GPL-3.0-or-later
"""A wire, and the two wires that a new seed in it makes.

Wires do not change: every edit makes a new one.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from ...terms.choices import DEFAULT_FINISH, FINISHES, LOOPS, Along, Finish, LoopKind
from ..base.geometry import nearest_on_segments
from .picks import Edge, Pick, is_same

if TYPE_CHECKING:
    from numpy.typing import NDArray

FOLLOWS: tuple[Literal["min", "max", "concave"], ...] = ("min", "max", "concave")
"""The library's names of wires, by `Wire.follow`: along the least curvature, along the most curvature, or along concave creases (only
across the surface). Files have these numbers."""

LOOP_KINDS: frozenset[LoopKind] = frozenset(LOOPS) - {"CROSSING"}
"""The kinds of kept loops. A crossing loop is kept as a closed loop or a strip."""

_ids = itertools.count()


def new_id() -> int:
    return next(_ids)


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
    faces
        (k - 1,) of a wire across the surface, the triangle that each piece of the curve lies in. None if it is not known.
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
    strength
        The metric's largest anisotropy when it was found; 0: not known, or it needs none.
    finish
        Across the surface, what becomes its seam when its chain ends; along edges, a finish that cuts says that it was cut into the faces.
    kind
        The kind of loop that one click on an edge offered, or None if the wire was drawn.
    through
        The edge of that click, smaller vertex first.
    planned
        Whether *Suggest Seamwires* found its course: it ends where it is meant to end.
    offers
        What else that click offered, the next one first; they have no offers themselves.
    beside
        Of an offer, the other loops that the click takes with it. Kept wires have none.
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
    faces: NDArray[np.int32] | None = None
    closed: bool = False
    marks: bool = True
    mirror: tuple[int, ...] = ()
    images: tuple[Edge, ...] | None = None
    heading: Edge | None = None
    follow: int = 0
    strength: float = 0.0
    finish: Finish = DEFAULT_FINISH
    kind: LoopKind | None = None
    through: Edge | None = None
    planned: bool = False
    offers: tuple[Wire, ...] = ()
    beside: tuple[Wire, ...] = ()
    stored: int = 0
    id: int = field(default_factory=new_id)

    def edges(self) -> list[Edge]:
        return list(self._edges)

    @cached_property
    def _edges(self) -> tuple[Edge, ...]:
        following = self.vertices[1:] + (self.vertices[:1] if self.closed else ())
        return tuple((min(a, b), max(a, b)) for a, b in zip(self.vertices, following, strict=False))

    def claims(self) -> Iterator[Edge]:
        """Yield the edges that it and its images mark or clear."""
        yield from self._edges
        yield from self.images or ()

    @property
    def cuts(self) -> bool:
        return FINISHES[self.finish].cuts

    @property
    def leaves_trace(self) -> bool:
        """Whether the mesh keeps it: it runs along an edge, or is to be cut into a face."""
        return len(self.vertices) > 1 or self.cuts

    @property
    def last_edge(self) -> Edge:
        return self.vertices[-2], self.vertices[-1]

    @property
    def is_cut(self) -> bool:
        """Whether it was cut into the faces, and runs along edges for that reason alone."""
        return self.along == "EDGES" and self.cuts

    def uncut(self) -> Wire:
        """Return a wire that was cut as one across the surface, whose other courses run there; any other as it is."""
        if not self.is_cut:
            return self
        return self.changed(along="SURFACE", heading=None, start=self.vertices[0], end=self.vertices[-1])

    def like(self, other: Wire) -> bool:
        if self.along == other.along == "EDGES":
            return self.vertices == other.vertices and len(self.beside) == len(other.beside)
        return self.points.shape == other.points.shape and bool(np.allclose(self.points, other.points, rtol=1e-6))

    def drawn(self, **course: object) -> Wire:
        """Return the wire with another course, which no click on an edge offered."""
        course = {"faces": None, **course}
        return self.changed(**course, images=None, kind=None, through=None, planned=False, offers=())

    def anew(self, **changes: object) -> Wire:
        return self.changed(**changes, images=None, id=new_id())

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


def distinct(ways: Iterable[Wire | None]) -> tuple[Wire, ...]:
    found: list[Wire] = []
    for way in ways:
        if way is not None and not any(way.like(earlier) for earlier in found):
            found.append(way)
    return tuple(found)


def split(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    """Cut a wire in two where a seed is put into it. A loop is cut open twice, at the pick and opposite to it.

    The pick is one of its vertices or edges; across the surface a vertex of the edges that it marks. Points are the mesh's vertices, (n,
    3). Returns both parts in order, the first with the wire's number; None where the pick is not on the wire, or at its end.
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
    second = wire.drawn(vertices=vertices[after:], points=wire.points[after:], start=seed, heading=heading, id=new_id())
    return first, second


def _position(vertices: tuple[int, ...], pick: Pick) -> tuple[int, int] | None:
    """Return where a pick lies on a chain of vertices: the indices of its ends, twice the same for a vertex."""
    if not isinstance(pick, tuple):
        return (vertices.index(pick),) * 2 if pick in vertices else None
    for index, pair in enumerate(itertools.pairwise(vertices)):
        if is_same(pair, pick):
            return index, index + 1
    return None


def _split_loop(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    ends = _position(wire.vertices + wire.vertices[:1], pick)
    if ends is None:
        return None
    begin, middle = ends[1] % len(wire.vertices), len(wire.vertices) // 2
    around = wire.vertices[begin:] + wire.vertices[: begin + 1]
    seed: Pick = around[0] if ends[0] == ends[1] else (around[-2], around[-1])

    def part(chain: tuple[int, ...], start: Pick, end: Pick, **others: object) -> Wire:
        return wire.drawn(vertices=chain, points=points[list(chain)], start=start, end=end, closed=False, **others)

    first = part(around[: middle + 1], seed, around[middle], heading=around[-2:])
    return first, part(around[middle:], around[middle], seed, heading=around[middle - 1 : middle + 1], id=new_id())


def _split_curve(wire: Wire, pick: Pick, points: NDArray[np.float64]) -> tuple[Wire, Wire] | None:
    if not isinstance(pick, int) or pick not in wire.vertices[1:-1]:
        return None
    at = wire.vertices.index(pick)
    place = points[pick]
    # The curve passes near the vertex, not through it: it is led there from the nearest of its segments.
    _, gaps = nearest_on_segments(place, wire.points[:-1], wire.points[1:])
    nearest = int(np.argmin(gaps))
    before, after = np.vstack([wire.points[: nearest + 1], place]), np.vstack([place, wire.points[nearest + 1 :]])
    first = wire.drawn(vertices=wire.vertices[: at + 1], points=before, end=pick)
    return first, wire.drawn(vertices=wire.vertices[at:], points=after, start=pick, heading=None, id=new_id())
