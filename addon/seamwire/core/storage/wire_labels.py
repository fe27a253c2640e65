# SPDX-License-Identifier: GPL-3.0-or-later
"""The labels of a mesh's edges, and those that a network asks for.

Labels travel with the edges wherever Blender takes them: undo, subdivision, duplicates, joining, appending. A wire is there
where its number stands on a whole chain of edges that are all seams.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import groups
from ..network.drawn import Drawn
from ..network.picks import undirected
from ..network.wires import LOOP_KINDS
from . import serialization
from .serialization import WAS_SEAM, Archive, Places, Record

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from ..network.picks import Edge, End, Pick
    from ..network.wires import Wire

Claim = tuple["Edge", int]
"""An edge and a member of its label."""


@dataclass(frozen=True)
class EdgeLabels:
    """The labelled edges of a mesh, (k, 2), with their labels, which are not 0, and whether they are seams, and hidden; (k,) each."""

    pairs: NDArray[np.int64]
    labels: NDArray[np.int64]
    seams: NDArray[np.bool_]
    hidden: NDArray[np.bool_]

    @cached_property
    def edges(self) -> list[Edge]:
        return list(map(tuple, np.sort(self.pairs, axis=1).tolist()))

    @classmethod
    def none(cls) -> EdgeLabels:
        return cls(np.empty((0, 2), np.int64), np.empty(0, np.int64), np.empty(0, bool), np.empty(0, bool))

    def same_as(self, other: EdgeLabels) -> bool:
        return all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in ("pairs", "labels", "seams", "hidden")
        )


@dataclass(frozen=True)
class Found:
    """What labels tell of: the wires that are not hidden, the claims to edges that stand for them, and `broken` claims of former wires.

    Claims and not numbers alone: of two copies of a wire one may be hidden, or broken, while the other is sound.
    """

    network: Drawn = field(default_factory=Drawn)
    known: frozenset[Claim] = frozenset()
    broken: frozenset[Claim] = frozenset()


@dataclass(frozen=True)
class Plan:
    """The wanted labels of a mesh's edges, 0 for none, the edges that become seams, and those that cease to be.

    In its network, wires that clear seams have done so, and are no wires, nor are those that they cleared. `known` is as in `Found`.
    """

    network: Drawn
    labels: dict[Edge, int]
    mark: list[Edge]
    clear: list[Edge]
    known: frozenset[Claim]


def plan(
    network: Drawn,
    marks: EdgeLabels,
    found: Found,
    archive: Archive,
    places: Places,
    is_seam: Callable[[Edge], bool],
    edges: NDArray[np.int32],
) -> Plan:
    """Return what a mesh's edges must be for a network; all that it does not know of stays.

    The network is that of a session that began with `found`, or went on from it. `marks` are the labels that the mesh has, `is_seam` tells
    what is a seam now, and `edges`, (e, 2), are the visible edges. New records go to the archive.
    """
    wires, after, cleared, rest = _asked_for(network, archive, places, edges)
    known = frozenset((edge, member) for edge, members in after.items() for member in members)
    result = Plan(replace(network, wires=wires), {}, [], [], known)
    before = {edge: set(archive.members(label)) for edge, label in zip(marks.edges, marks.labels.tolist(), strict=True)}
    own = {edge for wire in found.network.wires for edge in wire.claims()}

    def of_wires(members: Iterable[int]) -> set[int]:
        return {member for member in members if abs(member) in archive.wires}

    for edge in sorted({*before, *after, *cleared, *rest}):
        seam, old, new = is_seam(edge), before.get(edge, set()), after.get(edge, set())
        broken = {member for member in old if (edge, member) in found.broken}
        understood = {member for member in old if (edge, member) in found.known}
        others = old - broken - understood - {WAS_SEAM}
        ours = edge in own or bool(of_wires(understood))
        plain = not ours and not of_wires(others)
        was_seam = edge in rest or (seam and (plain or WAS_SEAM in old or bool(of_wires(broken))))
        if edge in cleared:
            wanted, others = False, others - of_wires(others)
        elif of_wires(new):
            wanted = True
        elif ours or edge in rest:
            wanted = was_seam or (seam and bool(of_wires(others)))
        else:
            wanted = seam  # it belongs to no wire of the session
        members = new | others
        unknown = others and WAS_SEAM in old and not ours  # a member of a label that is not ours to change
        if unknown or (was_seam and of_wires(members)):
            members = members | {WAS_SEAM}
        label = archive.label_of(members)
        if label != archive.label_of(old):
            result.labels[edge] = label
        if wanted != seam:
            (result.mark if wanted else result.clear).append(edge)
    return result


def _asked_for(
    network: Drawn, archive: Archive, places: Places, edges: NDArray[np.int32]
) -> tuple[tuple[Wire, ...], dict[Edge, set[int]], set[Edge], set[Edge]]:
    """Return the wires that stay, the members of labels that edges get, the edges to clear, and those left of wires cleared in part."""
    effect = {edge: wire.marks for wire in network.wires for edge in wire.claims()}
    cleared = {edge for edge, marks_it in effect.items() if not marks_it}
    after: defaultdict[Edge, set[int]] = defaultdict(set)
    rest: set[Edge] = set()
    wires = []
    for wire in network.wires:
        if not wire.marks:
            continue
        if not cleared.isdisjoint(wire.edges()):
            rest.update(wire.claims())
            continue
        number = wire.stored or archive.add(archive.wires, serialization.wire_record(wire, places))
        images = tuple(edge for edge in wire.images or () if edge not in cleared)
        for edge in wire.edges():
            after[edge].add(number)
        for edge in images:
            after[edge].add(-number)
        wires.append(replace(wire, stored=number, images=images))
    for order, stroke in enumerate(network.strokes):
        number = archive.add(archive.strokes, serialization.stroke_record(stroke, places, order))
        corners = set(stroke.corners[0].tolist())
        near = edges[np.isin(edges, list(corners)).any(axis=1)].tolist()
        inside = [pair for pair in near if corners.issuperset(pair)] if len(corners) > 1 else []
        for pair in inside or near[:1]:
            after[undirected(tuple(pair))].add(number)
    return tuple(wires), after, cleared, rest


def seams_beside(
    seams: NDArray[np.int32], labels: EdgeLabels, archive: Archive, known: frozenset[Claim]
) -> NDArray[np.int32]:
    """Return those seams of a mesh, (k, 2), that no wire runs along. `known` has the claims of the wires that are there, see `Found`."""
    wired = [
        edge
        for edge, label in zip(labels.edges, labels.labels.tolist(), strict=True)
        if any(abs(member) in archive.wires and (edge, member) in known for member in archive.members(label))
    ]
    if not wired or not len(seams):
        return seams
    count = int(max(np.max(seams), np.max(wired))) + 1
    keys = np.sort(seams.astype(np.int64), axis=1) @ (count, 1)
    return seams[~np.isin(keys, np.array(wired, dtype=np.int64) @ (count, 1))]


def read(marks: EdgeLabels, archive: Archive, places: Places) -> Found:
    if not len(marks.labels):
        return Found()
    rows_of: dict[int, list[int]] = {}
    expanded = {label: archive.members(label) for label in np.unique(marks.labels).tolist()}
    for row, label in enumerate(marks.labels.tolist()):
        for member in expanded[label]:
            rows_of.setdefault(member, []).append(row)
    edges = marks.edges
    seams = {edge for edge, seam in zip(edges, marks.seams.tolist(), strict=True) if seam}
    hidden = {edge for edge, hides in zip(edges, marks.hidden.tolist(), strict=True) if hides}
    pieces: list[_Piece] = []
    known: set[Claim] = set()
    broken: set[Claim] = set()
    for number in sorted({abs(number) for number in rows_of} & archive.wires.keys()):
        own = sorted(edges[row] for row in rows_of.get(number, []))
        parts = [[own[row] for row in group] for group in groups(own)]
        images = sorted(edges[row] for row in rows_of.get(-number, []))
        for part, share in zip(parts or [[]], _shares(images, len(parts)), strict=True):
            if not hidden.isdisjoint(part):
                continue  # nothing is known of it until it is shown again
            chain = _chain(part, archive.wires[number], places) if seams.issuperset(part) else None
            claims = [*((edge, number) for edge in part), *((edge, -number) for edge in share)]
            (broken if chain is None else known).update(claims)
            if chain is not None:
                there = tuple(edge for edge in share if edge in seams)
                pieces.append(_Piece(number, archive.wires[number], chain, there))
    strokes = []
    orders = {number: archive.strokes[number].get("order") for number in archive.strokes.keys() & rows_of.keys()}
    # Where strokes cross, the later one counts.
    for number in sorted(orders, key=lambda one: (orders[one] if type(orders[one]) is int else 0, one)):
        begins = [edges[row] for row in rows_of[number]]
        stroke = serialization.stored_stroke(archive.strokes[number], places, begins)
        known.update((edge, number) for edge in begins)
        if stroke is not None:
            strokes.append(stroke)
    wires = _wires_of(pieces, set(edges), places)
    return Found(Drawn(wires, strokes=tuple(strokes)), frozenset(known), frozenset(broken))


def _shares(images: list[Edge], count: int) -> list[list[Edge]]:
    """Return which edges of images belong to each of a wire's copies, which have larger vertices than what they were made of."""
    if count < 2 or len(images) % count:
        return [images, *([] for _ in range(count - 1))]
    size = len(images) // count
    return [images[one * size : (one + 1) * size] for one in range(count)]


@dataclass(frozen=True)
class _Piece:
    number: int
    record: Record
    vertices: tuple[int, ...]
    images: tuple[Edge, ...]

    @property
    def unchanged(self) -> bool:
        """Whether it has as many edges as the wire had: else it was subdivided."""
        return len(self.vertices) == len(self.record["vertices"])

    @cached_property
    def numbers(self) -> dict[int, int]:
        stored = self.record["vertices"]
        if self.unchanged:
            return dict(zip(stored, self.vertices, strict=True))
        return {} if self.record["closed"] else {stored[0]: self.vertices[0], stored[-1]: self.vertices[-1]}

    def stored(self, name: str) -> Pick:
        return serialization.pick_of(self.record[name])

    def edge_now(self, stored: Edge, edges: set[Edge]) -> Edge | None:
        one, two = map(self.numbers.get, stored)
        return None if one is None or two is None or undirected((one, two)) not in edges else (one, two)

    def pick(self, name: End, end: int, edges: set[Edge]) -> Pick:
        stored, before = self.stored(name), self.record["vertices"]
        if not isinstance(stored, tuple):
            return self.numbers.get(stored, end)
        if tuple(before) == self.vertices and end in stored and undirected(stored) in edges:
            return stored
        found = self.edge_now(stored, edges)
        if found is not None and end in found:
            return found
        at = slice(2) if name == "start" else slice(-2, None)
        is_cut = not self.unchanged and not self.record["closed"]
        return self.vertices[at] if is_cut and undirected(stored) == undirected(tuple(before[at])) else end

    def wire(self, edges: set[Edge], places: Places) -> Wire:
        """Return the wire with its own seeds, and without a heading. `edges` are all that have labels."""
        wire = serialization.wire_of(self.record, places, self.vertices)
        through = None
        if self.record.get("kind") in LOOP_KINDS and self.unchanged:
            through = undirected(self.edge_now(self.stored("through"), edges))
        if wire.closed and through is not None:
            start = end = through
        else:
            last = wire.vertices[0] if wire.closed else wire.vertices[-1]
            start, end = self.pick("start", wire.vertices[0], edges), self.pick("end", last, edges)
        return replace(
            wire,
            start=start,
            end=end,
            heading=None,
            images=self.images,
            kind=None if through is None else wire.kind,
            through=through,
            # A copy of a wire, or one whose vertices have other numbers now, is still that of its record.
            stored=self.number if self.unchanged else 0,
        )


def _chain(part: list[Edge], record: Record, places: Places) -> tuple[int, ...] | None:
    """Return the chain that a wire runs along now, by connected edges that its number stands on; None: it is broken."""
    stored = [int(vertex) for vertex in record["vertices"]]
    around = stored + stored[:1] if record["closed"] else stored
    before = {undirected(pair) for pair in itertools.pairwise(around)}
    if before == set(part):
        return tuple(stored)
    if len(part) < len(before):
        return None
    trail = _trail(part, around[0] == around[-1])
    if trail is None:
        return None
    return _directed(trail[:-1] if record["closed"] else trail, record, places)


def _trail(edges: list[Edge], closed: bool) -> list[int] | None:
    """Return the vertices along all of some edges, each run along once; None: they are no such trail."""
    around: dict[int, list[Edge]] = {}
    for edge in edges:
        for vertex in edge:
            around.setdefault(vertex, []).append(edge)
    odd = [vertex for vertex, meeting in around.items() if len(meeting) % 2]
    if len(odd) != (0 if closed else 2):
        return None
    # Hierholzer's way, with the side trips put in where they leave.
    stack, trail = [min(odd) if odd else min(around)], []
    left = {vertex: sorted(meeting, reverse=True) for vertex, meeting in around.items()}
    used: set[Edge] = set()
    while stack:
        vertex = stack[-1]
        while left[vertex] and left[vertex][-1] in used:
            left[vertex].pop()
        if left[vertex]:
            edge = left[vertex].pop()
            used.add(edge)
            stack.append(edge[0] if edge[1] == vertex else edge[1])
        else:
            trail.append(stack.pop())
    return trail


def _directed(trail: list[int], record: Record, where: Places) -> tuple[int, ...]:
    """Return a trail in the direction of the stored wire, and a loop from where that begins.

    If its ends have not moved, they decide. Otherwise the order of the vertex numbers decides, because deleting, copying and joining keep
    it. Otherwise positions decide.
    """
    places, closed = where.in_object, record["closed"]
    first, second = np.array(record["ends"], dtype=np.float64)
    if closed:
        # The first two vertices of a loop are stored.
        begin = int(np.argmin(np.linalg.norm(places[trail] - first, axis=1)))
        by_place = trail[begin:] + trail[:begin]
        forth, back = np.linalg.norm(places[[by_place[1], by_place[-1]]] - second, axis=1)
        by_place = by_place if forth <= back else [by_place[0], *by_place[:0:-1]]
    else:
        # A part that moved as a whole is rotated back, and its center does not count.
        ends = places[[trail[0], trail[-1]]]
        ends = ends - (ends.mean(axis=0) - 0.5 * (first + second))
        forth, back = (np.linalg.norm(way - (first, second), axis=1).sum() for way in (ends, ends[::-1]))
        by_place = trail if forth <= back else trail[::-1]
    ends = places[[by_place[0], by_place[1] if closed else by_place[-1]]]
    if np.abs(ends - (first, second)).max() <= where.tolerance:
        return tuple(by_place)
    ranks = np.unique(record["vertices"], return_inverse=True)[1]
    for way in (trail, trail[::-1]) if len(ranks) == len(trail) else ():
        begin = way.index(min(way)) - int(np.argmin(ranks)) if closed else 0
        around = way[begin:] + way[:begin]
        if np.array_equal(np.unique(around, return_inverse=True)[1], ranks):
            return tuple(around)
    return tuple(by_place)


def _wires_of(pieces: list[_Piece], edges: set[Edge], places: Places) -> tuple[Wire, ...]:
    """Return wires made of pieces. A wire may begin on the last edge of another, so seeds are found among all pieces."""
    beside: dict[int, list[int]] = {}  # the rows of the pieces with each vertex
    for row, piece in enumerate(pieces):
        for vertex in set(piece.vertices):
            beside.setdefault(vertex, []).append(row)
    wires = [piece.wire(edges, places) for piece in pieces]
    wires = [_with_shared_seeds(piece, wire, pieces, wires, beside) for piece, wire in zip(pieces, wires, strict=True)]

    def heading(row: int) -> Edge | None:
        """Return the last edge of the wire that one goes on from: of several, that which its record tells of."""
        wire, stored = wires[row], pieces[row].stored("heading")
        found = [
            (tuple(pieces[other].record["vertices"][-2:]) != stored, wires[other].last_edge)
            for other in beside.get(wire.vertices[0], [])
            if other != row
            and not wires[other].closed
            and undirected(wires[other].end) == undirected(wire.start)
            and wires[other].vertices[-1] == wire.vertices[0]
        ]
        return min(found)[1] if found else None

    rows = enumerate(zip(pieces, wires, strict=True))
    return tuple(
        replace(wire, heading=heading(row)) if piece.record["heading"] else wire for row, (piece, wire) in rows
    )


def _with_shared_seeds(
    piece: _Piece, wire: Wire, pieces: list[_Piece], wires: list[Wire], beside: dict[int, list[int]]
) -> Wire:
    """Return a wire with the seeds that others have at its ends, where it had the same and did not find them.

    An edge where two wires meet lies on one of them, and the records of both may be of different times.
    """
    names: tuple[End, End] = ("start", "end")
    for name in names:
        vertex, stored = getattr(wire, name), piece.stored(name)
        if isinstance(vertex, tuple) or not isinstance(stored, tuple):
            continue
        for other, end in itertools.product(beside.get(vertex, []), names):
            seed = getattr(wires[other], end)
            was_same = undirected(pieces[other].stored(end)) == undirected(stored)
            goes_on = (name, end) == ("start", "end") and piece.record["heading"]
            if isinstance(seed, tuple) and vertex in seed and (was_same or goes_on):
                wire = replace(wire, **{name: seed})
    return wire
