# SPDX-License-Identifier: GPL-3.0-or-later
"""The network that the labels of a mesh's edges tell of, and the labels that a network asks for.

Labels travel with the edges wherever Blender takes them: undo, subdivision, duplicates, joining, appending. A wire is there
where its number stands on a whole chain of edges that are all seams.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from . import serialization
from .network import Network, Wire, undirected
from .serialization import WAS_SEAM, Archive, Record

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import Edge, Pick
    from .strokes import Scribble


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
        The members of labels that stand for those.
    broken
        Those that stand for wires that are none any more: what they ran along has changed.
    unknown
        How many labels stand for what no record tells.
    """

    network: Network = field(default_factory=Network)
    known: frozenset[int] = frozenset()
    broken: frozenset[int] = frozenset()
    unknown: int = 0


@dataclass(frozen=True)
class Plan:
    """What a mesh's edges are to be.

    Parameters
    ----------
    network
        As it is when that is done: wires that clear seams have done so, and are no wires, nor are those that they cleared a
        part of, whose other edges are plain seams then.
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
    known: frozenset[int]


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
    pieces: list[_Piece] = []
    known, broken = set(), set()
    in_object = places.in_object
    for number in sorted(number for number in rows_of if number in archive.wires):
        rows = np.array(rows_of[number])
        if marks.hidden[rows].any():
            continue  # nothing is known of it until it is shown again
        record = archive.wires[number]
        chains = _chains(marks.pairs[rows], record, in_object) if marks.seams[rows].all() else []
        images = np.array(rows_of.get(-number, []), dtype=np.int64)
        if not chains:
            broken.update((number, -number))
            continue
        known.update((number, -number))
        own = [_edge(pair) for pair in marks.pairs[images[marks.seams[images]]].tolist()]
        pieces += [_Piece(number, record, chain, tuple(own) if one == 0 else ()) for one, chain in enumerate(chains)]
    strokes = []
    for number in sorted(number for number in rows_of if number in archive.strokes):
        stroke = serialization.stored_stroke(archive.strokes[number], in_object, places.to_object)
        known.add(number)
        if stroke is not None:
            strokes.append(stroke)
    wires = _Wires(pieces, {_edge(pair) for pair in marks.pairs.tolist()}, places, in_object).all()
    return Found(Network(wires, scribbles=tuple(strokes)), frozenset(known), frozenset(broken), unknown)


def _edge(pair: Iterable[int]) -> Edge:
    one, two = pair
    return (one, two) if one < two else (two, one)


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


def _chains(pairs: NDArray[np.int64], record: Record, places: NDArray[np.float64]) -> list[tuple[int, ...]]:
    """Return the chains that a wire runs along now: one, or several where it was duplicated; none where it is broken."""
    stored, closed = [int(vertex) for vertex in record["vertices"]], bool(record["closed"])
    around = stored + stored[:1] if closed else stored
    edges = {_edge(pair) for pair in pairs.tolist()}
    if {_edge(pair) for pair in itertools.pairwise(around)} == edges:
        return [tuple(stored)]
    chains = []
    for part in _components(pairs):
        if len(part) < len(around) - 1:
            continue
        trail = _trail(part, closed)
        if trail is not None:
            chains.append(_directed(trail, record, places))
    return chains


def _components(pairs: NDArray[np.int64]) -> list[list[Edge]]:
    """Return edges in their connected parts, in the order of their first vertices."""
    around: dict[int, list[int]] = {}
    for row, pair in enumerate(pairs.tolist()):
        for vertex in pair:
            around.setdefault(vertex, []).append(row)
    done: set[int] = set()
    parts = []
    for first in range(len(pairs)):
        if first in done:
            continue
        done.add(first)
        part, front = [first], [first]
        while front:
            rows = {row for one in front for vertex in pairs[one].tolist() for row in around[vertex]} - done
            done |= rows
            front = sorted(rows)
            part += front
        parts.append([_edge(pairs[row].tolist()) for row in part])
    return sorted(parts, key=min)


def _trail(edges: list[Edge], closed: bool) -> list[int] | None:
    """Return the vertices along all of some edges, each run along once; None: they are no such trail."""
    around: dict[int, list[Edge]] = {}
    for edge in edges:
        for vertex in edge:
            around.setdefault(vertex, []).append(edge)
    odd = [vertex for vertex, meeting in around.items() if len(meeting) % 2]
    if len(odd) != (0 if closed else 2) or (closed and any(len(meeting) != 2 for meeting in around.values())):
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
    return trail[:-1] if closed else trail


def _directed(trail: list[int], record: Record, places: NDArray[np.float64]) -> tuple[int, ...]:
    """Return a trail in the direction of the stored wire, as far as the places of its ends tell."""
    first, second = np.array(record["ends"], dtype=np.float64)
    if record["closed"]:
        begin = int(np.argmin(np.linalg.norm(places[trail] - first, axis=1)))
        trail = trail[begin:] + trail[:begin]
        ends = (trail[1], trail[-1])
        back = np.linalg.norm(places[list(ends)] - second, axis=1)
        return tuple(trail if back[0] <= back[1] else [trail[0], *trail[:0:-1]])
    # What was moved as a whole is turned to where it came from: its middle does not count.
    ends = places[[trail[0], trail[-1]]]
    shift = ends.mean(axis=0) - 0.5 * (first + second)
    forth = np.linalg.norm(ends[0] - shift - first) + np.linalg.norm(ends[1] - shift - second)
    back = np.linalg.norm(ends[1] - shift - first) + np.linalg.norm(ends[0] - shift - second)
    return tuple(trail if forth <= back else trail[::-1])


class _Wires:
    """Wires made of pieces; their seeds are found among all of them, for a wire may begin on the last edge of another."""

    def __init__(self, pieces: list[_Piece], edges: set[Edge], places: Places, in_object: NDArray[np.float64]) -> None:
        self._pieces = pieces
        self._edges = edges
        self._places = places
        self._in_object = in_object
        self._now: dict[int, set[int]] = {}
        for piece in pieces:
            for before, now in self._own(piece).items():
                self._now.setdefault(before, set()).add(now)

    def all(self) -> tuple[Wire, ...]:
        wires = [self._wire(piece) for piece in self._pieces]
        return tuple(
            replace(wire, heading=self._heading(wire, wires)) if piece.record["goes_on"] else wire
            for piece, wire in zip(self._pieces, wires, strict=True)
        )

    @staticmethod
    def _own(piece: _Piece) -> dict[int, int]:
        """Return the numbers that the stored vertices of a piece have now."""
        stored = piece.record["vertices"]
        if piece.unchanged:
            return dict(zip(stored, piece.vertices, strict=True))
        return {} if piece.record["closed"] else {stored[0]: piece.vertices[0], stored[-1]: piece.vertices[-1]}

    def _wire(self, piece: _Piece) -> Wire:
        record, vertices = piece.record, piece.vertices
        closed = bool(record["closed"])
        around = list(vertices + vertices[:1] if closed else vertices)
        curve = serialization.stored_curve(record, vertices, self._in_object, self._places.to_object)
        through = self._through(piece)
        same = tuple(record["vertices"]) == vertices
        return Wire(
            record["along"],
            vertices,
            self._places.points[around] if curve is None else curve,
            through if closed and through else self._pick(piece, "start", vertices[0]),
            through if closed and through else self._pick(piece, "end", vertices[0] if closed else vertices[-1]),
            closed=closed,
            mirror=tuple(record["mirror"]),
            images=piece.images,
            follow=1 if record["follow"] else 0,
            strength=float(record["strength"]),
            kind=None if through is None else record["kind"],
            through=through,
            # A copy of a wire, or one whose vertices have other numbers now, is still that of its record.
            stored=piece.number if same or piece.unchanged else 0,
        )

    def _through(self, piece: _Piece) -> Edge | None:
        if piece.record.get("kind") is None or not piece.unchanged:
            return None
        own = self._own(piece)
        one, two = (own.get(int(vertex)) for vertex in piece.record["through"])
        return None if one is None or two is None else _edge((one, two))

    def _pick(self, piece: _Piece, name: str, end: int) -> Pick:
        """Return the seed at one end of a piece; the vertex where it ends, if the seed cannot be found."""
        stored = serialization.pick_of(piece.record[name])
        own = self._own(piece)
        if not isinstance(stored, tuple):
            return own.get(stored, end)
        if stored[0] in own and stored[1] in own:
            found = own[stored[0]], own[stored[1]]
            if _edge(found) in self._edges:
                return found
        ones, twos = (self._now.get(vertex, set()) for vertex in stored)
        pairs = [(one, two) for one in ones for two in twos if end in (one, two) and _edge((one, two)) in self._edges]
        if pairs:
            return min(pairs)
        chain = piece.record["vertices"]
        if not piece.unchanged and undirected(stored) in {
            undirected((chain[0], chain[1])),
            undirected(tuple(chain[-2:])),
        }:
            return piece.vertices[:2] if end == piece.vertices[0] else piece.vertices[-2:]
        return end

    @staticmethod
    def _heading(wire: Wire, wires: list[Wire]) -> Edge | None:
        """Return the last edge of the wire that one goes on from."""
        start = undirected(wire.start)
        for other in wires:
            if other is wire or other.closed or undirected(other.end) != start:
                continue
            if other.last_edge[1] == wire.vertices[0]:
                return other.last_edge
        return None


def plan(
    network: Network,
    marks: EdgeLabels,
    found: Found,
    archive: Archive,
    places: Places,
    is_seam: Callable[[Edge], bool],
    edges: NDArray[np.int32],
    own: frozenset[Edge] = frozenset(),
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
    own
        Edges without labels that are seams for the network's wires alone: they cease to be with them.
    """
    effect = {edge: wire.marks for wire in network.wires for edge in wire.claims()}
    cleared = {edge for edge, marks_it in effect.items() if not marks_it}
    in_object = places.in_object
    before = {
        _edge(pair): set(archive.members(label))
        for pair, label in zip(marks.pairs.tolist(), marks.labels.tolist(), strict=True)
    }
    after: dict[Edge, set[int]] = {}
    known: set[int] = set()
    cut: set[Edge] = set()
    wires = []
    for wire in network.wires:
        if not wire.marks:
            continue
        if not cleared.isdisjoint(wire.edges()):
            cut.update(wire.claims())
            continue
        number = wire.stored
        if not number:
            number = archive.add_wire(serialization.wire_record(wire, in_object, places.to_object))
        known.update((number, -number))
        images = tuple(edge for edge in wire.images or () if edge not in cleared)
        for edge in wire.edges():
            after.setdefault(edge, set()).add(number)
        for edge in images:
            after.setdefault(edge, set()).add(-number)
        wires.append(replace(wire, stored=number, images=images))
    for stroke in network.scribbles:
        number = archive.add_stroke(serialization.stroke_record(stroke, in_object, places.to_object))
        known.add(number)
        for edge in _beginning(stroke, edges):
            after.setdefault(edge, set()).add(number)
    result = Plan(replace(network, wires=tuple(wires)), {}, [], [], frozenset(known))
    old = frozenset(found.known)
    for edge in sorted({*before, *after, *cleared, *cut, *own}):
        _decide(
            result,
            edge,
            before.get(edge, set()),
            after.get(edge, set()),
            old,
            found.broken,
            archive,
            edge in cleared,
            edge in cut,
            edge in own,
            is_seam,
        )
    return result


def _decide(
    result: Plan,
    edge: Edge,
    before: set[int],
    after: set[int],
    known: frozenset[int],
    broken: frozenset[int],
    archive: Archive,
    cleared: bool,
    cut: bool,
    own: bool,
    is_seam: Callable[[Edge], bool],
) -> None:
    """Add to a plan what one edge is to be.

    `cut`: it is left of a wire that was cleared elsewhere; `own`: it is a seam for wires alone, without a label.
    """

    def wires(members: Iterable[int]) -> set[int]:
        return {member for member in members if abs(member) in archive.wires}

    seam = is_seam(edge)
    others = before - known - broken - {WAS_SEAM}
    wired = own or bool(wires(before) - broken)
    now = wires(after) | (wires(others) if not cleared else set())
    was_seam = WAS_SEAM in before if wired else seam
    wanted = not cleared and (cut or bool(now) or was_seam)
    members = after | (others if not cleared else others - wires(others))
    if was_seam and now:
        members = members | {WAS_SEAM}
    label = archive.label_of(members)
    if label != archive.label_of(before):
        result.labels[edge] = label
    if wanted != seam:
        (result.mark if wanted else result.clear).append(edge)


def _beginning(stroke: Scribble, edges: NDArray[np.int32]) -> Iterator[Edge]:
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
    known: Collection[int] | None = None,
) -> NDArray[np.int32]:
    """Return those seams, (k, 2), that no wire runs along; `known`: the wires that count; None: all."""
    if isinstance(labels, EdgeLabels):
        rows = zip(labels.pairs.tolist(), labels.labels.tolist(), strict=True)
        labels = {_edge(pair): label for pair, label in rows}
    wired = [
        edge
        for edge, label in labels.items()
        if any(abs(member) in archive.wires and (known is None or member in known) for member in archive.members(label))
    ]
    if not wired or not len(seams):
        return seams
    count = int(max(np.max(seams), np.max(wired))) + 1
    keys = np.sort(seams.astype(np.int64), axis=1) @ (count, 1)
    return seams[~np.isin(keys, np.array(wired, dtype=np.int64) @ (count, 1))]
