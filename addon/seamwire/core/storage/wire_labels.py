# SPDX-License-Identifier: GPL-3.0-or-later
"""The labels of a mesh's edges, and those that a network asks for.

Labels travel with the edges wherever Blender takes them: undo, subdivision, duplicates, joining, appending. A wire is there
where its number stands on a whole chain of edges that are all seams.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..network.network import Network
from . import serialization
from .serialization import WAS_SEAM, Archive

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge
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


def edge_of(pair: Iterable[int]) -> Edge:
    """Return an edge by its two vertices, the smaller one first."""
    one, two = pair
    return (one, two) if one < two else (two, one)


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
        edge_of(pair): set(archive.members(label))
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
        yield edge_of(pair)


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
        labels = {edge_of(pair): label for pair, label in rows}
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
