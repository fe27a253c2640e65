# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of wires, as data that does not change: every edit makes a new one, so that undo is keeping the old.

It knows neither Blender nor the library.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from ...terms.choices import Along
from .picks import Edge, End, FacePoint, Pick, undirected, vertices_of
from .wires import Wire, split

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .strokes import Stroke


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
    triangle
        The triangle under the cursor of a picked edge; None: the cursor is beside the mesh. Only loops need it.
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


class History:
    """The states of a network before each of its steps, and after each step that was undone.

    The mirror belongs to the mesh and is no step of the drawing: what is brought back has the mirror that there is now.
    """

    def __init__(self) -> None:
        self._undo: list[Network] = []
        self._redo: list[Network] = []

    @property
    def steps(self) -> int:
        """How many steps were done."""
        return len(self._undo)

    @property
    def can_redo(self) -> bool:
        """Whether there are steps that were taken back."""
        return bool(self._redo)

    def can_undo(self, now: Network) -> bool:
        """Whether a step led to something else than there is now."""
        now = _without_mirror(now)
        return any(network != now for network in self._undo)

    def step(self, before: Network) -> None:
        """Remember what was there before a new step."""
        self._undo.append(_without_mirror(before))
        self._redo.clear()

    def forget_step(self, now: Network) -> Network:
        """Return what was there before the last step, as if that had never been done. There must be one."""
        return replace(self._undo.pop(), mirror=now.mirror)

    def back(self, now: Network) -> Network | None:
        """Return what was there before the last step that changed something; None: there is no such step."""
        while self._undo:
            network = self._undo.pop()
            if network != _without_mirror(now):
                self._redo.append(_without_mirror(now))
                return replace(network, mirror=now.mirror)
        return None

    def forth(self, now: Network) -> Network | None:
        """Return what the step did that was taken back last; None: there is no such step."""
        if not self._redo:
            return None
        self._undo.append(_without_mirror(now))
        return replace(self._redo.pop(), mirror=now.mirror)

    def forget(self) -> None:
        """Forget all steps: what was done is Blender's to undo now."""
        self._undo.clear()
        self._redo.clear()


def _without_mirror(network: Network) -> Network:
    return replace(network, mirror=())
