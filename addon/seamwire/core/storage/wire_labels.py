# SPDX-License-Identifier: GPL-3.0-or-later
"""The labels of a mesh's edges, and those that a network asks for.

Labels travel with the edges wherever Blender takes them: undo, subdivision, duplicates, joining, appending. A wire is there
where its number stands on a whole chain of edges that are all seams.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..network.network import Network
from ..network.picks import undirected
from . import serialization
from .serialization import WAS_SEAM, Archive, Places

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from ..network.picks import Edge
    from ..network.strokes import Stroke
    from ..network.wires import Wire

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

    @cached_property
    def edges(self) -> list[Edge]:
        """The edges, smaller vertex first."""
        return list(map(tuple, np.sort(self.pairs, axis=1).tolist()))

    @classmethod
    def none(cls) -> EdgeLabels:
        """Return those of a mesh that has none."""
        return cls(np.empty((0, 2), np.int64), np.empty(0, np.int64), np.empty(0, bool), np.empty(0, bool))

    def same_as(self, other: EdgeLabels) -> bool:
        """Whether another mesh has the same labels on the same edges, with the same seams and hidden edges."""
        return all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in ("pairs", "labels", "seams", "hidden")
        )


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
    network: Network, archive: Archive, places: Places, edges: NDArray[np.int32]
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
        for edge in _beginning(stroke, edges):
            after[edge].add(number)
    return tuple(wires), after, cleared, rest


def _beginning(stroke: Stroke, edges: NDArray[np.int32]) -> list[Edge]:
    """Return an edge or several where a stroke begins."""
    corners = set(stroke.corners[0].tolist())
    near = edges[np.isin(edges, list(corners)).any(axis=1)]
    inside = [pair for pair in near.tolist() if corners.issuperset(pair)] if len(corners) > 1 else []
    return [undirected(tuple(pair)) for pair in inside or near[:1].tolist()]


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
