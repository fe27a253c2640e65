# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the network that the labels of a mesh's edges tell of."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.components import groups
from ..network.network import Network
from ..network.picks import undirected
from ..network.wires import LOOP_KINDS, Wire
from . import serialization
from .serialization import Archive, Record
from .wire_labels import Claim, EdgeLabels, Found, Places, edge_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge, End, Pick


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
    edges = [edge_of(pair) for pair in marks.pairs.tolist()]
    seams = {edge for edge, seam in zip(edges, marks.seams.tolist(), strict=True) if seam}
    hidden = {edge for edge, hides in zip(edges, marks.hidden.tolist(), strict=True) if hides}
    in_object = places.in_object
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
    before = {edge_of(pair) for pair in itertools.pairwise(around)}
    if before == set(part):
        return tuple(stored)
    if len(part) < len(before):
        return None
    trail = _trail(part, around[0] == around[-1])
    if trail is None:
        return None
    return _directed(trail[:-1] if record["closed"] else trail, record, places)


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
            None if curve is None else serialization.stored_faces(record),
            closed=closed,
            mirror=tuple(record["mirror"]),
            images=piece.images,
            follow=int(record["follow"]),
            strength=float(record["strength"]),
            finish=record.get("finish", "SNAP"),
            kind=None if through is None else record["kind"],
            through=through,
            planned=record.get("planned", False),
            # A copy of a wire, or one whose vertices have other numbers now, is still that of its record.
            stored=piece.number if piece.unchanged else 0,
        )

    def _through(self, row: int) -> Edge | None:
        piece = self._pieces[row]
        if piece.record.get("kind") not in LOOP_KINDS or not piece.unchanged:
            return None
        found = self._edge_now(row, serialization.pick_of(piece.record["through"]))
        return None if found is None else edge_of(found)

    def _edge_now(self, row: int, stored: Edge) -> Edge | None:
        """Return a stored edge by the numbers of one piece, or None if it has no label."""
        one, two = (self._numbers[row].get(vertex) for vertex in stored)
        if one is None or two is None or edge_of((one, two)) not in self._edges:
            return None
        return one, two

    def _pick(self, row: int, name: End, end: int) -> Pick:
        """Return the seed at one end of a piece; the vertex where it ends, if the seed cannot be found."""
        piece = self._pieces[row]
        stored = serialization.pick_of(piece.record[name])
        if not isinstance(stored, tuple):
            return self._numbers[row].get(stored, end)
        if tuple(piece.record["vertices"]) == piece.vertices and end in stored and edge_of(stored) in self._edges:
            return stored
        found = self._edge_now(row, stored)
        if found is not None and end in found:
            return found
        if not piece.unchanged and not piece.record["closed"]:
            chain, now = piece.record["vertices"], piece.vertices
            if undirected(stored) == edge_of(chain[:2] if name == "start" else chain[-2:]):
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
