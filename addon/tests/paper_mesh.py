# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh on paper: edges with seams and labels, and what Blender does to them while nobody of ours looks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.picks import Edge
from seamwire.core.network.strokes import on_mesh
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.storage import wire_labels
from seamwire.core.storage.serialization import Archive, Places
from seamwire.core.storage.wire_labels import EdgeLabels, Found, Plan


def undirected(pairs: Iterable[Sequence[int]]) -> list[Edge]:
    """Return edges with their smaller vertices first."""
    return [(min(pair), max(pair)) for pair in (tuple(map(int, pair)) for pair in pairs)]


@dataclass
class PaperMesh:
    """A mesh whose edges have seams and labels.

    Parameters
    ----------
    places
        (n, 3) vertices in object coordinates.
    edges
        (e, 2) by their vertices.
    triangles
        (m, 3) for strokes.
    seams, labels, hidden, text
        As Blender keeps them.
    archive
        The stored texts of other times and meshes.
    found
        The network at the start of the session.
    """

    places: NDArray[np.float64]
    edges: NDArray[np.int32]
    triangles: NDArray[np.int32] | None = None
    seams: set[Edge] = field(default_factory=set)
    labels: dict[Edge, int] = field(default_factory=dict)
    hidden: set[Edge] = field(default_factory=set)
    text: str = ""
    archive: Archive = field(default_factory=Archive)
    found: Found = field(default_factory=Found)

    # As sessions see it

    @property
    def points(self) -> NDArray[np.float64]:
        """Return the vertices as sessions have them."""
        return self.places

    @property
    def where(self) -> Places:
        """Return where the vertices are."""
        return Places(self.places, np.eye(3))

    @property
    def pairs(self) -> list[Edge]:
        """Return the edges, smaller vertices first."""
        return undirected(self.edges.tolist())

    @property
    def visible(self) -> NDArray[np.int32]:
        """Return the edges that are not hidden."""
        return np.array([pair for pair in self.pairs if pair not in self.hidden], dtype=np.int32).reshape(-1, 2)

    def marks(self) -> EdgeLabels:
        """Return the labelled edges, in the mesh's order."""
        rows = [pair for pair in self.pairs if self.labels.get(pair)]
        return EdgeLabels(
            np.array(rows, dtype=np.int64).reshape(-1, 2),
            np.array([self.labels[row] for row in rows], dtype=np.int64),
            np.array([row in self.seams for row in rows], dtype=bool),
            np.array([row in self.hidden for row in rows], dtype=bool),
        )

    def read(self, archive: Archive | None = None) -> Found:
        """Return what the labels tell of; without an archive, what a Blender that was just started finds."""
        archive = Archive() if archive is None else archive
        archive.merge(Archive.parse(self.text))
        return wire_labels.read(self.marks(), archive, self.where)

    def unknown(self, archive: Archive | None = None) -> int:
        """Return how many labels stand for what no record tells, of the mesh or of an archive."""
        archive = Archive() if archive is None else archive
        archive.merge(Archive.parse(self.text))
        return sum(not archive.knows(label) for label in set(self.labels.values()))

    def plain_seams(self) -> set[Edge]:
        """Return the visible seams without a wire."""
        seams = np.array(sorted(self.seams - self.hidden), dtype=np.int32).reshape(-1, 2)
        return set(undirected(wire_labels.seams_beside(seams, self.marks(), self.archive, self.found.known).tolist()))

    def open(self, session: Sketch, archive: Archive | None = None) -> Found:
        """Let a session go on with what the mesh has now; without an archive, in a Blender that was just started."""
        self.archive = Archive() if archive is None else archive
        self.found = found = self.read(self.archive)
        strokes = tuple(on_mesh(one, self.points, self.triangles) for one in found.network.strokes)
        session.adopt(replace(found.network, strokes=strokes), sorted(self.plain_seams()))
        return found

    def write(self, session: Sketch | Drawn, adopt: bool = False) -> Plan:
        """Let the mesh be what a session's network asks for, and the session end its drawing with that."""
        network = session.drawn if isinstance(session, Sketch) else session
        plan = wire_labels.plan(
            network, self.marks(), self.found, self.archive, self.where, self.seams.__contains__, self.visible
        )
        there = set(self.pairs)
        assert there.issuperset([*plan.mark, *plan.clear, *plan.labels])
        assert self.seams.isdisjoint(plan.mark), "what is one already is not marked"
        assert self.seams.issuperset(plan.clear)
        assert all(self.labels.get(edge, 0) != label for edge, label in plan.labels.items())
        self.seams.update(plan.mark)
        self.seams.difference_update(plan.clear)
        self.labels.update(plan.labels)
        self.labels = {edge: label for edge, label in self.labels.items() if label}
        self.text = self.archive.text(self.labels.values())
        self.found = Found(plan.network, plan.known)
        if adopt and isinstance(session, Sketch):
            session.adopt(plan.network, sorted(self.plain_seams()))
        return plan

    # What Blender does to it

    def _renamed(self, numbers: dict[int, int]) -> dict[Edge, Edge]:
        """Return the edges whose vertices all have new numbers, by what they were."""
        return {
            pair: undirected([(numbers[pair[0]], numbers[pair[1]])])[0]
            for pair in self.pairs
            if pair[0] in numbers and pair[1] in numbers
        }

    def _take(self, edges: dict[Edge, Edge]) -> None:
        self.edges = np.array(list(edges.values()), dtype=np.int32).reshape(-1, 2)
        self.seams = {edges[edge] for edge in self.seams if edge in edges}
        self.hidden = {edges[edge] for edge in self.hidden if edge in edges}
        self.labels = {edges[edge]: label for edge, label in self.labels.items() if edge in edges}

    def renumber(self, order: Sequence[int] | NDArray[np.int64]) -> NDArray[np.int64]:
        """Let vertex i be what vertex order[i] was; return the new number of each old one."""
        order = np.asarray(order)
        where = np.argsort(order)
        self._take(self._renamed(dict(enumerate(where.tolist()))))
        self.places = self.places[order]
        if self.triangles is not None:
            self.triangles = where[self.triangles].astype(np.int32)
        return where

    def delete_vertices(self, gone: Iterable[int]) -> NDArray[np.int64]:
        """Delete vertices and their edges; return the new number of each, -1 of those gone."""
        kept = np.setdiff1d(np.arange(len(self.places)), list(gone))
        where = np.full(len(self.places), -1)
        where[kept] = np.arange(len(kept))
        self._take(self._renamed({int(one): int(where[one]) for one in kept}))
        self.places = self.places[kept]
        if self.triangles is not None:
            whole = (where[self.triangles] >= 0).all(axis=1)
            self.triangles = where[self.triangles[whole]].astype(np.int32)
        return where

    def delete_edges(self, gone: Iterable[Edge]) -> None:
        """Delete edges, and leave their vertices."""
        without = set(undirected(gone))
        self._take({pair: pair for pair in self.pairs if pair not in without})

    def subdivide(self, edges: Iterable[Edge] | None = None) -> dict[Edge, int]:
        """Put a vertex into the middle of some edges, or of all; return it for each."""
        cut = self.pairs if edges is None else undirected(edges)
        middles = {}
        for pair in cut:
            middle = len(self.places)
            middles[pair] = middle
            self.places = np.vstack([self.places, self.places[list(pair)].mean(axis=0)])
            halves = [(pair[0], middle), (pair[1], middle)]
            self.edges = np.array([one for one in self.pairs if one != pair] + halves, dtype=np.int32)
            for kept in (self.seams, self.hidden):
                if pair in kept:
                    kept.remove(pair)
                    kept.update(halves)
            label = self.labels.pop(pair, 0)
            if label:
                self.labels.update(dict.fromkeys(halves, label))
        return middles

    def duplicate(self, vertices: Iterable[int], shift: Sequence[float] = (0.0, 0.0, 0.0)) -> dict[int, int]:
        """Copy vertices and the edges between them; return the copies' numbers."""
        numbers = {one: len(self.places) + row for row, one in enumerate(sorted(vertices))}
        edges = self._renamed(numbers)
        self.places = np.vstack([self.places, self.places[list(numbers)] + np.array(shift)])
        self.edges = np.vstack([self.edges, np.array(list(edges.values()), dtype=np.int32).reshape(-1, 2)])
        for kept in (self.seams, self.hidden):
            kept.update([edges[edge] for edge in kept if edge in edges])
        self.labels.update({edges[edge]: label for edge, label in self.labels.items() if edge in edges})
        return numbers

    def hide(self, *edges: Edge) -> None:
        """Hide edges."""
        self.hidden.update(undirected(edges))

    def clear_seam(self, *edges: Edge) -> None:
        """Clear seams by hand: labels stay."""
        self.seams.difference_update(undirected(edges))

    def snapshot(self) -> tuple[set[Edge], dict[Edge, int]]:
        """Return what Blender's undo brings back: not the text."""
        return set(self.seams), dict(self.labels)

    def undo(self, snapshot: tuple[set[Edge], dict[Edge, int]]) -> None:
        """Go back to a snapshot."""
        self.seams, self.labels = set(snapshot[0]), dict(snapshot[1])
