# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps in seams: a cut that ends just before it meets another one, or a border, keeps two islands from separating."""

from __future__ import annotations

import functools
import heapq
import math
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of
from .seam_wires import seam_chains

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from numpy.typing import NDArray

_DETOUR = 4.0
"""A gap has no way along cuts and borders that is shorter than it by this factor: else its ends are joined as it is."""
MOST_LOOKED_AT = 50_000
"""Vertices around an end: one from which nothing is met among so many lies in the middle of nowhere."""


_NO_EDGES = np.empty((0, 2), dtype=np.int32)


@dataclass(frozen=True)
class Gap:
    """Where a cut ends, and the vertex that it nearly meets: the nearest along edges that the cut does not lead to soon.

    It is a vertex of a cut or of the border, within the limits of `find`. The path and its length are those of the shortest way there along
    edges.
    """

    end: int
    target: int
    length: float
    path: tuple[int, ...] = field(default=(), compare=False)


class GapFinder:
    """Finds the gaps of a mesh's seams. Beside edges that are `partly_hidden`, cuts may lead on, and have not met the border."""

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        edges: NDArray[np.int32],
        partly_hidden: NDArray[np.int32] = _NO_EDGES,
    ) -> None:
        self._points, self._triangles, self._edges, self._partly_hidden = points, triangles, edges, partly_hidden

    @functools.cached_property
    def _border(self) -> NDArray[np.int32]:
        around = border_edges(self._triangles, self._edges)
        hidden = set(map(frozenset, self._partly_hidden.tolist()))
        return around[[frozenset(edge) not in hidden for edge in around.tolist()]]

    @functools.cached_property
    def _mesh(self) -> _Ways:
        return _Ways(self._points, self._edges)

    def find(
        self,
        seams: NDArray[np.int32],
        longest: float = 0.5,
        most_looked_at: int = MOST_LOOKED_AT,
        longest_of_several: float = math.inf,
        meant: Collection[int] = (),
    ) -> list[Gap]:
        """Find the gaps of seams, (k, 2), shortest first; where two ends face each other there is one for both.

        Parameters
        ----------
        longest
            Of a gap, in lengths of the cut that ends there, as far as it leads without meeting others. So a dart, which ends in
            the middle of a face on purpose, has none.
        most_looked_at
            Vertices around an end.
        longest_of_several
            As `longest`, of gaps that are more than one edge.
        meant
            Vertices where cuts end on purpose.
        """
        points, cuts = self._points, _Ways(self._points, np.concatenate([seams, self._border]))
        on_border = {*self._border.ravel().tolist(), *self._partly_hidden.ravel().tolist()}
        found: dict[frozenset[int], Gap] = {}
        for chain in seam_chains(seams):
            length = length_of(points[chain])
            for end in {chain[0], chain[-1]} - on_border.union(meant):
                if len(cuts.beside(end)) == 1:
                    several = min(longest, longest_of_several)
                    gap = _gap_at(self._mesh, cuts, end, longest * length, several * length, most_looked_at)
                    if gap is not None:
                        found.setdefault(frozenset((gap.end, gap.target)), gap)
        return sorted(found.values(), key=lambda gap: (gap.length, gap.end))


def border_edges(triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return those edges, (b, 2), that one triangle alone has."""
    return edges[triangles_at(triangles, edges) == 1]


def triangles_at(triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> NDArray[np.int64]:
    """Return how many triangles each edge has, (e,)."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    count = 1 + int(max(triangles.max(initial=0), edges.max(initial=0)))
    keys, counts = np.unique(sides[:, 0].astype(np.int64) * count + sides[:, 1], return_counts=True)
    ends = np.sort(edges, axis=1).astype(np.int64)
    own = ends[:, 0] * count + ends[:, 1]
    if not len(keys):
        return np.zeros(len(edges), dtype=np.int64)
    at = np.minimum(np.searchsorted(keys, own), len(keys) - 1)
    return np.where(keys[at] == own, counts[at], 0)


class _Ways:
    """Shortest ways along some edges of a mesh."""

    def __init__(self, points: NDArray[np.float64], edges: NDArray[np.int32]) -> None:
        self._points = points
        tails, heads = np.concatenate([edges, edges[:, ::-1]]).T
        order = np.argsort(tails, kind="stable")
        self._heads = heads[order]
        self._begin = np.searchsorted(tails[order], np.arange(len(points) + 1))

    def beside(self, vertex: int) -> NDArray[np.int32]:
        return self._heads[self._begin[vertex] : self._begin[vertex + 1]]

    def nearest(
        self, start: int, longest: float, longest_of_several: float, before: dict[int, int] | None = None
    ) -> Iterator[tuple[int, float]]:
        """Yield vertices and their distances from one, nearest first (Dijkstra's algorithm), up to a distance.

        Ways of several edges have a separate limit. Where `before` is given, it is filled with the vertex before each on the
        shortest way to it.
        """
        reached, done = {start: 0.0}, set()
        queue = [(0.0, start)]
        while queue:
            distance, vertex = heapq.heappop(queue)
            if vertex in done:
                continue
            done.add(vertex)
            yield vertex, distance
            beside = self.beside(vertex)
            most = longest if vertex == start else longest_of_several
            # A vertex has few neighbors: calls of NumPy would take longer than the sums.
            x, y, z = self._points[vertex].tolist()
            for other, (a, b, c) in zip(beside.tolist(), self._points[beside].tolist(), strict=True):
                a, b, c = a - x, b - y, c - z
                so_far = distance + math.sqrt(a * a + b * b + c * c)
                if so_far <= most and so_far < reached.get(other, np.inf):
                    reached[other] = so_far
                    if before is not None:
                        before[other] = vertex
                    heapq.heappush(queue, (so_far, other))


def _gap_at(
    mesh: _Ways, cuts: _Ways, end: int, longest: float, longest_of_several: float, most_looked_at: int
) -> Gap | None:
    """Return the gap at the end of a cut, or None if there is no gap of one edge or several edges up to these lengths."""
    along = dict(cuts.nearest(end, _DETOUR * longest, _DETOUR * longest))
    before: dict[int, int] = {}
    for vertex, distance in islice(mesh.nearest(end, longest, longest_of_several, before), most_looked_at):
        if len(cuts.beside(vertex)) and along.get(vertex, np.inf) > _DETOUR * distance:
            path = [vertex]
            while path[-1] != end:
                path.append(before[path[-1]])
            return Gap(end, vertex, distance, tuple(reversed(path)))
    return None
