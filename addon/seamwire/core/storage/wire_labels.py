# SPDX-License-Identifier: GPL-3.0-or-later
"""The network that the labels of a mesh's edges tell of, and the labels that a network asks for.

Labels travel with the edges wherever Blender takes them: undo, subdivision, duplicates, joining, appending. A wire is there
where its number stands on a whole chain of edges that are all seams.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..network.network import LOOP_KINDS, Network, Wire, undirected
from . import serialization
from .serialization import WAS_SEAM, Archive, Record

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.network import Edge, End, Pick
    from ..network.strokes import Stroke


Claim = tuple["Edge", int]
"""An edge and a member of its label."""


@dataclass(frozen=True)
class EdgeLabels:
    """The labelled edges of a mesh.

    Parameters
    ----------
    pairs
        (k, 2) their vertices.
    labels
        (k,) no zeros.
    seams, hidden
        (k,) whether they are.
    """

    pairs: NDArray[np.int64]
    labels: NDArray[np.int64]
    seams: NDArray[np.bool_]
    hidden: NDArray[np.bool_]

    @classmethod
    def none(cls) -> EdgeLabels:
        """Return those of a mesh that has none."""
        return cls(np.empty((0, 2), np.int64), np.empty(0, np.int64), np.empty(0, bool), np.empty(0, bool))

    def same_as(self, other: EdgeLabels) -> bool:
        """Whether another mesh has the same labels on the same edges, with the same seams and hidden edges."""
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in vars(self))


@dataclass(frozen=True)
class Places:
    """Where a mesh's vertices are.

    Parameters
    ----------
    points
        (n, 3) as sessions have them.
    to_object
        (3, 3) takes them to object coordinates: ``points @ to_object.T``.
    """

    points: NDArray[np.float64]
    to_object: NDArray[np.float64]

    @property
    def in_object(self) -> NDArray[np.float64]:
        """(n, 3) in object coordinates."""
        return self.points @ self.to_object.T


@dataclass(frozen=True)
class Found:
    """What labels tell of.

    Parameters
    ----------
    network
        The wires and strokes that are there and not hidden.
    known
        The claims to edges that stand for those.
    broken
        The claims of former wires, whose edges have changed.
    unknown
        How many labels stand for what no record tells.

    Notes
    -----
    Claims and not numbers alone: of two copies of a wire one may be hidden, or broken, while the other is sound.
    """

    network: Network = field(default_factory=Network)
    known: frozenset[Claim] = frozenset()
    broken: frozenset[Claim] = frozenset()
    unknown: int = 0


@dataclass(frozen=True)
class Plan:
    """The wanted labels of a mesh's edges.

    Parameters
    ----------
    network
        As it is when that is done: wires that clear seams have done so, and are no wires, nor are those that they cleared.
    labels
        The edges' new labels; 0: none.
    mark, clear
        The edges that become seams, and those that cease to be.
    known
        As in `Found`.
    """

    network: Network
    labels: dict[Edge, int]
    mark: list[Edge]
    clear: list[Edge]
    known: frozenset[Claim]


def read(marks: EdgeLabels, archive: Archive, places: Places) -> Found:
    """Return what labels tell of."""
    if not len(marks.labels):
        return Found()
    rows_of: dict[int, list[int]] = {}
    expanded = {label: archive.members(label) for label in np.unique(marks.labels).tolist()}
    unknown = sum(not archive.knows(label) for label in expanded)
    for row, label in enumerate(marks.labels.tolist()):
        for member in expanded[label]:
            rows_of.setdefault(member, []).append(row)
    edges = [_edge(pair) for pair in marks.pairs.tolist()]
    seams = {edge for edge, seam in zip(edges, marks.seams.tolist(), strict=True) if seam}
    hidden = {edge for edge, hides in zip(edges, marks.hidden.tolist(), strict=True) if hides}
    in_object = places.in_object
    pieces: list[_Piece] = []
    known: set[Claim] = set()
    broken: set[Claim] = set()
    for number in sorted({abs(number) for number in rows_of} & archive.wires.keys()):
        parts = _components([edges[row] for row in rows_of.get(number, [])])
        images = sorted(edges[row] for row in rows_of.get(-number, []))
        for part, share in zip(parts or [[]], _shares(images, len(parts)), strict=True):
            if not hidden.isdisjoint(part):
                continue  # nothing is known of it until it is shown again
            chain = _chain(part, archive.wires[number], in_object) if seams.issuperset(part) else None
            claims = [*((edge, number) for edge in part), *((edge, -number) for edge in share)]
            (broken if chain is None else known).update(claims)
            if chain is not None:
                there = tuple(edge for edge in share if edge in seams)
                pieces.append(_Piece(number, archive.wires[number], chain, there))
    strokes = []
    for number in sorted(
        archive.strokes.keys() & rows_of.keys(), key=lambda one: (serialization.order_of(archive.strokes[one]), one)
    ):
        begins = [edges[row] for row in rows_of[number]]
        stroke = serialization.stored_stroke(archive.strokes[number], in_object, places.to_object, begins)
        known.update((edge, number) for edge in begins)
        if stroke is not None:
            strokes.append(stroke)
    wires = _Wires(pieces, set(edges), places, in_object).all()
    return Found(Network(wires, strokes=tuple(strokes)), frozenset(known), frozenset(broken), unknown)


def _edge(pair: Iterable[int]) -> Edge:
    one, two = pair
    return (one, two) if one < two else (two, one)


def _shares(images: list[Edge], count: int) -> list[list[Edge]]:
    """Return which edges of images belong to each of a wire's copies.

    Copies have larger vertices than what they were made of, hence come in its order.
    """
    if count < 2 or len(images) % count:
        return [images, *([] for _ in range(count - 1))]
    size = len(images) // count
    return [images[one * size : (one + 1) * size] for one in range(count)]


@dataclass(frozen=True)
class _Piece:
    """A chain of edges that a wire's number stands on."""

    number: int
    record: Record
    vertices: tuple[int, ...]
    images: tuple[Edge, ...]

    @property
    def unchanged(self) -> bool:
        """Whether it has as many edges as the wire had: else it was subdivided."""
        return len(self.vertices) == len(self.record["vertices"])


def _chain(part: list[Edge], record: Record, places: NDArray[np.float64]) -> tuple[int, ...] | None:
    """Return the chain that a wire runs along now, by connected edges that its number stands on; None: it is broken."""
    stored = [int(vertex) for vertex in record["vertices"]]
    around = stored + stored[:1] if record["closed"] else stored
    before = {_edge(pair) for pair in itertools.pairwise(around)}
    if before == set(part):
        return tuple(stored)
    if len(part) < len(before):
        return None
    trail = _trail(part, around[0] == around[-1])
    if trail is None:
        return None
    return _directed(trail[:-1] if record["closed"] else trail, record, places)


def _components(edges: list[Edge]) -> list[list[Edge]]:
    """Return edges in their connected parts, in the order of their first vertices."""
    around: dict[int, list[Edge]] = {}
    for edge in edges:
        for vertex in edge:
            around.setdefault(vertex, []).append(edge)
    done: set[Edge] = set()
    parts = []
    for first in sorted(edges):
        if first in done:
            continue
        done.add(first)
        part = [first]
        for edge in part:  # it grows
            following = dict.fromkeys(other for vertex in edge for other in around[vertex] if other not in done)
            done.update(following)
            part += following
        parts.append(part)
    return parts


def _trail(edges: list[Edge], closed: bool) -> list[int] | None:
    """Return the vertices along all of some edges, each run along once; None: they are no such trail.

    Where it touches itself there are several: any of them marks the same edges.
    """
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


def _directed(trail: list[int], record: Record, places: NDArray[np.float64]) -> tuple[int, ...]:
    """Return a trail in the direction of the stored wire, and a loop from where that begins.

    If its ends have not moved, they decide. Otherwise the order of the vertex numbers decides, because deleting, copying and joining keep
    it. Otherwise positions decide.
    """
    first, second = np.array(record["ends"], dtype=np.float64)
    by_place = _as_placed(trail, bool(record["closed"]), first, second, places)
    ends = places[[by_place[0], by_place[1] if record["closed"] else by_place[-1]]]
    if np.abs(ends - (first, second)).max() <= serialization.tolerance(places):
        return tuple(by_place)
    ranks = _ranks(record["vertices"])
    for way in (trail, trail[::-1]) if len(ranks) == len(trail) else ():
        begin = way.index(min(way)) - int(np.argmin(ranks)) if record["closed"] else 0
        around = way[begin:] + way[:begin]
        if np.array_equal(_ranks(around), ranks):
            return tuple(around)
    return tuple(by_place)


def _ranks(vertices: Iterable[int]) -> NDArray[np.int64]:
    """Return which of the vertices each is when they are sorted."""
    return np.unique(np.array(list(vertices)), return_inverse=True)[1]


def _as_placed(
    trail: list[int], closed: bool, first: NDArray[np.float64], second: NDArray[np.float64], places: NDArray[np.float64]
) -> list[int]:
    """Return a trail in the direction that the places of its ends, or of the first two vertices of a loop, speak for."""
    if closed:
        begin = int(np.argmin(np.linalg.norm(places[trail] - first, axis=1)))
        trail = trail[begin:] + trail[:begin]
        back = np.linalg.norm(places[[trail[1], trail[-1]]] - second, axis=1)
        return trail if back[0] <= back[1] else [trail[0], *trail[:0:-1]]
    # A part that moved as a whole is rotated back, and its center does not count.
    ends = places[[trail[0], trail[-1]]]
    shift = ends.mean(axis=0) - 0.5 * (first + second)
    forth = np.linalg.norm(ends[0] - shift - first) + np.linalg.norm(ends[1] - shift - second)
    back = np.linalg.norm(ends[1] - shift - first) + np.linalg.norm(ends[0] - shift - second)
    return trail if forth <= back else trail[::-1]


class _Wires:
    """Wires made of pieces; their seeds are found among all of them, for a wire may begin on the last edge of another."""

    def __init__(self, pieces: list[_Piece], edges: set[Edge], places: Places, in_object: NDArray[np.float64]) -> None:
        self._pieces = pieces
        self._edges = edges
        self._places = places
        self._in_object = in_object
        self._numbers = [self._numbers_of(piece) for piece in pieces]
        self._beside: dict[int, list[int]] = {}
        """The pieces with each vertex, by their places in the list."""
        for row, piece in enumerate(pieces):
            for vertex in set(piece.vertices):
                self._beside.setdefault(vertex, []).append(row)

    def all(self) -> tuple[Wire, ...]:
        wires = [self._wire(row) for row in range(len(self._pieces))]
        wires = [self._with_shared_seeds(row, wires) for row in range(len(wires))]
        return tuple(
            replace(wire, heading=self._heading(row, wires)) if self._pieces[row].record["heading"] else wire
            for row, wire in enumerate(wires)
        )

    @staticmethod
    def _numbers_of(piece: _Piece) -> dict[int, int]:
        """Return the numbers that the stored vertices of a piece have now."""
        stored = piece.record["vertices"]
        if piece.unchanged:
            return dict(zip(stored, piece.vertices, strict=True))
        return {} if piece.record["closed"] else {stored[0]: piece.vertices[0], stored[-1]: piece.vertices[-1]}

    def _wire(self, row: int) -> Wire:
        piece = self._pieces[row]
        record, vertices = piece.record, piece.vertices
        closed = bool(record["closed"])
        around = list(vertices + vertices[:1] if closed else vertices)
        curve = serialization.stored_curve(record, vertices, self._in_object, self._places.to_object)
        through = self._through(row)
        return Wire(
            record["along"],
            vertices,
            self._places.points[around] if curve is None else curve,
            through if closed and through else self._pick(row, "start", vertices[0]),
            through if closed and through else self._pick(row, "end", vertices[0] if closed else vertices[-1]),
            closed=closed,
            mirror=tuple(record["mirror"]),
            images=piece.images,
            follow=int(record["follow"]),
            strength=float(record["strength"]),
            finish=record.get("finish", "SNAP"),
            kind=None if through is None else record["kind"],
            through=through,
            # A copy of a wire, or one whose vertices have other numbers now, is still that of its record.
            stored=piece.number if piece.unchanged else 0,
        )

    def _through(self, row: int) -> Edge | None:
        piece = self._pieces[row]
        if piece.record.get("kind") not in LOOP_KINDS or not piece.unchanged:
            return None
        found = self._edge_now(row, serialization.pick_of(piece.record["through"]))
        return None if found is None else _edge(found)

    def _edge_now(self, row: int, stored: Edge) -> Edge | None:
        """Return a stored edge by the numbers of one piece, or None if it has no label."""
        one, two = (self._numbers[row].get(vertex) for vertex in stored)
        if one is None or two is None or _edge((one, two)) not in self._edges:
            return None
        return one, two

    def _pick(self, row: int, name: End, end: int) -> Pick:
        """Return the seed at one end of a piece; the vertex where it ends, if the seed cannot be found."""
        piece = self._pieces[row]
        stored = serialization.pick_of(piece.record[name])
        if not isinstance(stored, tuple):
            return self._numbers[row].get(stored, end)
        if tuple(piece.record["vertices"]) == piece.vertices and end in stored and _edge(stored) in self._edges:
            return stored
        found = self._edge_now(row, stored)
        if found is not None and end in found:
            return found
        if not piece.unchanged and not piece.record["closed"]:
            chain, now = piece.record["vertices"], piece.vertices
            if undirected(stored) == _edge(chain[:2] if name == "start" else chain[-2:]):
                return now[:2] if name == "start" else now[-2:]
        return end

    def _with_shared_seeds(self, row: int, wires: list[Wire]) -> Wire:
        """Return a wire with the seeds that others have at its ends, where it had the same and did not find them.

        An edge where two wires meet lies on one of them, and the records of both may be of different times.
        """
        wire, record = wires[row], self._pieces[row].record
        names: tuple[End, End] = ("start", "end")
        for name in names:
            vertex, stored = getattr(wire, name), serialization.pick_of(record[name])
            if isinstance(vertex, tuple) or not isinstance(stored, tuple):
                continue
            for other in self._beside.get(vertex, []):
                for end in names:
                    seed = getattr(wires[other], end)
                    before = serialization.pick_of(self._pieces[other].record[end])
                    goes_on = (name, end) == ("start", "end") and record["heading"]
                    if (
                        isinstance(seed, tuple)
                        and vertex in seed
                        and (undirected(before) == undirected(stored) or goes_on)
                    ):
                        wire = replace(wire, **{name: seed})
        return wire

    def _heading(self, row: int, wires: list[Wire]) -> Edge | None:
        """Return the last edge of the wire that one goes on from: of several, that which its record tells of."""
        wire, stored = wires[row], serialization.pick_of(self._pieces[row].record["heading"])
        found = [
            (tuple(self._pieces[other].record["vertices"][-2:]) != stored, wires[other].last_edge)
            for other in self._beside.get(wire.vertices[0], [])
            if other != row
            and not wires[other].closed
            and undirected(wires[other].end) == undirected(wire.start)
            and wires[other].vertices[-1] == wire.vertices[0]
        ]
        return min(found)[1] if found else None


def plan(
    network: Network,
    marks: EdgeLabels,
    found: Found,
    archive: Archive,
    places: Places,
    is_seam: Callable[[Edge], bool],
    edges: NDArray[np.int32],
) -> Plan:
    """Return what a mesh's edges must be for a network; all that it does not know of stays.

    Parameters
    ----------
    network
        Of a session that began with `found`, or went on from it.
    marks
        The labels that the mesh has.
    found
        What of them the session knew.
    archive
        Where new records go.
    places
        The mesh's vertices.
    is_seam
        Whether an edge is a seam now.
    edges
        (e, 2) the visible edges.
    """
    effect = {edge: wire.marks for wire in network.wires for edge in wire.claims()}
    cleared = {edge for edge, marks_it in effect.items() if not marks_it}
    in_object = places.in_object
    before = {
        _edge(pair): set(archive.members(label))
        for pair, label in zip(marks.pairs.tolist(), marks.labels.tolist(), strict=True)
    }
    after: dict[Edge, set[int]] = {}
    rest: set[Edge] = set()
    wires = []
    for wire in network.wires:
        if not wire.marks:
            continue
        if not cleared.isdisjoint(wire.edges()):
            rest.update(wire.claims())
            continue
        number = wire.stored
        if not number:
            number = archive.add_wire(serialization.wire_record(wire, in_object, places.to_object))
        images = tuple(edge for edge in wire.images or () if edge not in cleared)
        for edge in wire.edges():
            after.setdefault(edge, set()).add(number)
        for edge in images:
            after.setdefault(edge, set()).add(-number)
        wires.append(replace(wire, stored=number, images=images))
    for order, stroke in enumerate(network.strokes):
        number = archive.add_stroke(serialization.stroke_record(stroke, in_object, places.to_object, order))
        for edge in _beginning(stroke, edges):
            after.setdefault(edge, set()).add(number)
    known = frozenset((edge, member) for edge, members in after.items() for member in members)
    result = Plan(replace(network, wires=tuple(wires)), {}, [], [], known)
    own = {edge for wire in found.network.wires for edge in wire.claims()}
    for edge in sorted({*before, *after, *cleared, *rest}):
        change = _Change(
            edge,
            is_seam(edge),
            before.get(edge, set()),
            after.get(edge, set()),
            own=edge in own,
            cleared=edge in cleared,
            rest=edge in rest,
        )
        change.decide(result, found, archive)
    return result


@dataclass(frozen=True)
class _Change:
    """What becomes of one edge.

    Parameters
    ----------
    edge, seam
        The edge, and whether it is a seam now.
    before, after
        The members of its label, and those that the network asks for.
    own
        Whether it was a wire's of the network that the session began with.
    cleared
        Whether it ceases to be a seam.
    rest
        Whether it is left of a wire that others clear in part: a plain seam from here on.
    """

    edge: Edge
    seam: bool
    before: set[int]
    after: set[int]
    own: bool
    cleared: bool
    rest: bool

    def decide(self, result: Plan, found: Found, archive: Archive) -> None:
        """Add it to a plan."""

        def wires(members: Iterable[int]) -> set[int]:
            return {member for member in members if abs(member) in archive.wires}

        broken = {member for member in self.before if (self.edge, member) in found.broken}
        known = {member for member in self.before if (self.edge, member) in found.known}
        others = self.before - broken - known - {WAS_SEAM}
        ours = self.own or bool(wires(known))
        plain = not ours and not wires(others)
        was_seam = self.rest or (self.seam and (plain or WAS_SEAM in self.before or bool(wires(broken))))
        if self.cleared:
            wanted, others = False, others - wires(others)
        elif wires(self.after):
            wanted = True
        elif ours or self.rest:
            wanted = was_seam or (self.seam and bool(wires(others)))
        else:
            wanted = self.seam  # it belongs to no wire of the session
        members = self.after | others
        unknown = others and WAS_SEAM in self.before and not ours  # a member of a label that is not ours to change
        if unknown or (was_seam and wires(members)):
            members = members | {WAS_SEAM}
        label = archive.label_of(members)
        if label != archive.label_of(self.before):
            result.labels[self.edge] = label
        if wanted != self.seam:
            (result.mark if wanted else result.clear).append(self.edge)


def _beginning(stroke: Stroke, edges: NDArray[np.int32]) -> Iterator[Edge]:
    """Yield an edge or several where a stroke begins."""
    corners = set(stroke.corners[0].tolist())
    near = edges[np.isin(edges, list(corners)).any(axis=1)]
    inside = [pair for pair in near.tolist() if corners.issuperset(pair)] if len(corners) > 1 else []
    for pair in inside or near[:1].tolist():
        yield _edge(pair)


def seams_beside(
    seams: NDArray[np.int32],
    labels: Mapping[Edge, int] | EdgeLabels,
    archive: Archive,
    known: frozenset[Claim] | None = None,
) -> NDArray[np.int32]:
    """Return those seams, (k, 2), that no wire runs along.

    Parameters
    ----------
    seams
        (k, 2) of the mesh.
    labels
        Its labels.
    archive
        The meaning of the labels.
    known
        The claims of the wires that are there, see `Found`; None: of all that have a record, broken ones too.
    """
    if isinstance(labels, EdgeLabels):
        rows = zip(labels.pairs.tolist(), labels.labels.tolist(), strict=True)
        labels = {_edge(pair): label for pair, label in rows}
    wired = [
        edge
        for edge, label in labels.items()
        if any(
            abs(member) in archive.wires and (known is None or (edge, member) in known)
            for member in archive.members(label)
        )
    ]
    if not wired or not len(seams):
        return seams
    count = int(max(np.max(seams), np.max(wired))) + 1
    keys = np.sort(seams.astype(np.int64), axis=1) @ (count, 1)
    return seams[~np.isin(keys, np.array(wired, dtype=np.int64) @ (count, 1))]
