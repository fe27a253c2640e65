# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist wants, as data that does not change: every edit makes another network, so that undo is keeping the former one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from .picks import FacePoint, is_same, undirected, vertices_of
from .wires import Wire, new_id, split

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    from ...terms.choices import Along, Finish
    from .picks import Edge, End, Pick
    from .strokes import Stroke

    Link = tuple[int, End]
    """An end of a request, by the number of the request."""


@dataclass(frozen=True)
class Snap:
    """The edge, vertex or place under the cursor.

    Parameters
    ----------
    pick
        The vertex or the edge that a click would take.
    to
        The target of the pick: the plain mesh, a seed or a wire, an existing seam, or a strong feature nearby.
    wire
        The wire, where it belongs to one.
    seen_along
        The direction from the viewer to it, in the coordinates of the sketch's points. None if it is not looked at.
    crossing
        The edge that crosses a picked edge at its end nearer to the cursor. Only loops need it.
    is_close_call
        Whether these two edges are too short on the screen to point at one of them.
    triangle
        The triangle under the cursor of a picked edge, or None if the cursor is beside the mesh. Only loops need it.
    inside
        Whether the cursor is inside a face, away from the picked edge. Only loops need it.
    """

    pick: Pick
    to: Literal["MESH", "SEED", "WIRE", "SEAM", "FEATURE"] = "MESH"
    wire: Wire | None = None
    seen_along: tuple[float, float, float] | None = field(default=None, compare=False)
    crossing: Edge | None = field(default=None, compare=False)
    is_close_call: bool = field(default=False, compare=False)
    triangle: int | None = field(default=None, compare=False)
    inside: bool = field(default=False, compare=False)

    @classmethod
    def of(cls, what: Snap | Pick) -> Snap:
        return what if isinstance(what, Snap) else cls(what)

    @property
    def ends_chains(self) -> bool:
        return self.to in {"SEED", "WIRE", "SEAM"}


@dataclass(frozen=True)
class Seed:
    """Where the next wire begins.

    Parameters
    ----------
    pick
        The clicked place.
    after
        The end of a request along edges from whose last edge the next wire goes on.
    first
        Where the chain began. None if it began here.
    """

    pick: Pick
    after: Link | None = None
    first: Pick | None = None

    @property
    def began(self) -> Pick:
        return self.pick if self.first is None else self.first


ENDS: tuple[End, End] = "start", "end"


class CourseKey:
    """Stands for the course of a request. Edits that let the course be keep the key."""

    __slots__ = ("__weakref__",)


@dataclass(frozen=True, eq=False, kw_only=True)
class Request:
    """One thing that the artist wants. Its course is derived from it, see `Courses`.

    Parameters
    ----------
    start, end
        Its ends.
    goes_on
        The end of a request along edges from whose last edge it goes on.
    id
        Its own number, which also its wire has. An edit keeps the number.
    """

    along: Along
    start: Pick
    end: Pick
    closed: bool = False
    goes_on: Link | None = None
    id: int = field(default_factory=new_id)
    key: CourseKey = field(default_factory=CourseKey, repr=False)

    @cached_property
    def places(self) -> tuple[Pick, Pick]:
        return undirected(self.start), undirected(self.end)


@dataclass(frozen=True, eq=False, kw_only=True)
class Given(Request):
    """A wire that is known: the mesh has it, or it was taken as it was shown."""

    wire: Wire

    @classmethod
    def of(cls, wire: Wire, goes_on: Link | None = None) -> Given:
        return cls(
            wire=wire,
            along=wire.along,
            start=wire.start,
            end=wire.end,
            closed=wire.closed,
            goes_on=goes_on,
            id=wire.id,
        )


@dataclass(frozen=True)
class How:
    """The settings of a wire: whether it marks or clears, its mirror axes, the metric's strength, and its finish."""

    marks: bool
    mirror: tuple[int, ...]
    strength: float
    finish: Finish

    @classmethod
    def like(cls, wire: Wire) -> How:
        return cls(wire.marks, wire.mirror, wire.strength, wire.finish)

    def of(self, wire: Wire) -> Wire:
        return replace(wire, marks=self.marks, mirror=self.mirror, strength=self.strength, finish=self.finish)


@dataclass(frozen=True, eq=False, kw_only=True)
class Way(Request):
    """A wire from one place to another, no loop, that the library finds.

    Parameters
    ----------
    follow
        Which of the library's wires it is, see `FOLLOWS`. None: the one that leads.
    turns
        How many ways after that one it takes: each *W* is one more.
    was
        The wire that it replaces. `turns` count from that wire, and it stays if no way is found.
    closes
        The request that begins on the edge where it ends: it arrives over the other end of that edge.
    meets
        If the beginning moves: the end of a request at the same edge, which goes on in the direction of this one.
    moving
        The end that is looked for from the other one.
    runs_on
        Whether it then runs straight on until it meets something.
    """

    how: How
    follow: int | None = None
    turns: int = 0
    was: Wire | None = None
    closes: int | None = None
    meets: Link | None = None
    moving: End = "end"
    runs_on: bool = False


@dataclass(frozen=True, eq=False, kw_only=True)
class Sought(Request):
    """Something that was kept before it was known: the wires of a line, or a loop. A search finds its wires.

    `what` names it for the artist.
    """

    what: Literal["line", "loop"]


@dataclass(frozen=True)
class Network:
    """Everything that the artist wants of an object.

    Parameters
    ----------
    requests
        Oldest first.
    seed
        Where the live wire begins; None between chains.
    strokes
        The strokes that live wires follow or keep from. Where they cross, the later one counts. Kept wires stay as they are.
    """

    requests: tuple[Request, ...] = ()
    seed: Seed | None = None
    strokes: tuple[Stroke, ...] = ()

    def find(self, id: int) -> Request | None:
        return next((own for own in self.requests if own.id == id), None)

    def at(self, pick: Pick) -> list[tuple[Request, End]]:
        """Return the requests that begin or end at a pick, and which of their ends is there. Loops have no ends."""
        place = undirected(pick)
        return [
            (own, end)
            for own in self.requests
            if not own.closed and place in own.places
            for end, where in zip(ENDS, own.places, strict=True)
            if where == place
        ]

    @cached_property
    def closing_point(self) -> Pick | None:
        """Where the chain of the seed began, while a wire may lead back there."""
        seed = self.seed
        if seed is None or seed.first is None or is_same(seed.first, seed.pick):
            return None
        return seed.first if self.at(seed.first) else None

    def closes(self, target: Snap) -> bool:
        first = self.closing_point
        return target.to == "SEED" and first is not None and is_same(first, target.pick)

    def seed_at(self, target: Snap, along: Along) -> Seed:
        """Return the seed of a chain that begins at a target. If a single request ends there, the chain goes on from it."""
        own = self.at(target.pick) if target.to == "SEED" else []
        if len(own) != 1 or along == "SURFACE" or own[0][0].along == "SURFACE":
            return Seed(target.pick)
        return Seed(target.pick, after=(own[0][0].id, own[0][1]))

    def seeds(self) -> list[Pick]:
        return list({pick: None for own in self.requests if not own.closed for pick in own.places})

    def after(self, own: Request) -> Request | None:
        return next((each for each in self.requests if each.goes_on == (own.id, "end")), None)

    # Edits

    def adding(self, *requests: Request) -> Network:
        return replace(self, requests=(*self.requests, *requests))

    def without(self, *ids: int) -> Network:
        """Return the network without some requests. What went on from them begins at the place itself."""
        kept = tuple(own for own in self.requests if own.id not in ids)
        return replace(self, requests=kept).loosened(*ids)

    def loosened(self, *ids: int) -> Network:
        """Return the network where nothing goes on from some requests: each begins at the place itself."""
        return self._relinked(lambda link: None if link[0] in ids else link)

    def replacing(self, new: Mapping[int, tuple[Request, ...]]) -> Network:
        return replace(self, requests=tuple(each for own in self.requests for each in new.get(own.id, (own,))))

    def _relinked(self, change: Callable[[Link], Link | None]) -> Network:
        """Return the network where all that goes on from an end of a request goes on from another one."""

        def linked(link: Link | None) -> Link | None:
            return None if link is None else change(link)

        requests = tuple(
            own if linked(own.goes_on) == own.goes_on else replace(own, goes_on=linked(own.goes_on))
            for own in self.requests
        )
        seed = self.seed if self.seed is None else replace(self.seed, after=linked(self.seed.after))
        return replace(self, requests=requests, seed=seed)

    def with_drawn(self, request: Request, target: Pick, ends: bool) -> Network:
        """Return the network with a request from its seed to a target. Unless that `ends` the chain, it goes on from there."""
        after = None
        if not ends:
            first = None if self.seed is None else self.seed.began
            after = Seed(target, (request.id, "end") if request.along == "EDGES" else None, first)
        return replace(self.adding(request), seed=after)

    def with_seed_in(self, wire: Wire, pick: Pick, points: NDArray[np.float64], is_final: bool) -> Network | None:
        """Return the network with a request cut in two at a pick of its wire, or None if that is not possible, see `split`.

        The halves of a final wire stay where they are. Otherwise each half is looked for.
        """
        own, parts = self.find(wire.id), split(wire, pick, points)
        if own is None or parts is None:
            return None
        one, two = parts
        link: Link | None = (one.id, "end") if two.heading is not None else None
        first: Request = Given.of(one, (two.id, "end") if own.closed else own.goes_on)
        second: Request = Given.of(two, link)
        if isinstance(own, Way) and not is_final:
            first = replace(own, end=one.end, closes=None, runs_on=False, was=one, key=CourseKey())
            second = replace(own, start=two.start, goes_on=link, was=two, id=two.id, key=CourseKey())
        moved = self._relinked(lambda each: (two.id, "end") if each == (own.id, "end") else each)
        return moved.replacing({own.id: (first, second)})

    def joined(self, target: Snap, points: NDArray[np.float64], is_final: Callable[[Request], bool]) -> Network:
        """Return the network with a seed where a target meets a wire. At a wire's ends there is a seed already."""
        own = self.find(target.wire.id) if target.to == "WIRE" and target.wire is not None else None
        if own is None or own.closed:
            return self
        return self.with_seed_in(target.wire, target.pick, points, is_final(own)) or self


def linked(wires: tuple[Wire, ...]) -> tuple[Given, ...]:
    """Return wires as requests. A wire that is heading on from the last edge of another one goes on from that one."""
    found = []
    for wire in wires:
        before = next((own for own in wires if own is not wire and goes_on(own, wire.start, wire.heading)), None)
        found.append(Given.of(wire, None if before is None else (before.id, "end")))
    return tuple(found)


def goes_on(wire: Wire, start: Pick, heading: Pick | None) -> bool:
    """Whether what begins at a place, heading on from an edge, goes on from the end of a wire."""
    return heading is not None and wire.vertices[-2:] == heading and is_same(wire.end, start)


def surface_vertex(pick: Pick) -> Pick:
    return pick if isinstance(pick, FacePoint) else vertices_of(pick)[-1]


class History:
    """The networks before each step, and after each step that was undone."""

    def __init__(self) -> None:
        self._undo: list[Network] = []
        self._redo: list[Network] = []

    @property
    def steps(self) -> int:
        return len(self._undo)

    @property
    def can_redo(self) -> bool:
        return bool(self._redo)

    def can_undo(self, now: Network) -> bool:
        return any(network != now for network in self._undo)

    def step(self, before: Network) -> None:
        self._undo.append(before)
        self._redo.clear()

    def forget_step(self) -> Network:
        """Return what was there before the last step, as if that had never been done. There must be a step."""
        return self._undo.pop()

    def back(self, now: Network) -> Network | None:
        while self._undo:
            network = self._undo.pop()
            if network != now:
                self._redo.append(now)
                return network
        return None

    def forth(self, now: Network) -> Network | None:
        if not self._redo:
            return None
        self._undo.append(now)
        return self._redo.pop()

    def forget(self) -> None:
        self._undo.clear()
        self._redo.clear()
