# SPDX-License-Identifier: GPL-3.0-or-later
"""The half-edges of triangles, and which two belong together."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


class HalfEdges:
    """The half-edges of triangles: half-edge 3 t + i leads from corner i of triangle t to the next one.

    Sides of triangles, (m, 3), that are not among the edges of the mesh, (e, 2), lie within polygons. `count` is the number of vertices.
    `tails` and `tips` are (3m,).
    """

    def __init__(self, triangles: NDArray[np.int32], edges: NDArray[np.int32], count: int) -> None:
        corners = triangles.astype(np.int64)
        self.tails = corners.ravel()
        self.tips = np.roll(corners, -1, axis=1).ravel()
        self._edges, self._count = edges, count

    @cached_property
    def twins(self) -> NDArray[np.int64]:
        """(3m,) of each half-edge the other one of its edge; -1 unless two triangles meet that agree which side is out."""
        keys, order = self._by_edge
        starts = np.flatnonzero(np.diff(keys, prepend=-1))
        pairs = starts[np.diff(starts, append=len(keys)) == 2]
        one, two = order[pairs], order[pairs + 1]
        agree = self.tails[one] != self.tails[two]
        one, two = one[agree], two[agree]
        twins = np.full(len(keys), -1, dtype=np.int64)
        twins[one], twins[two] = two, one
        return twins

    @cached_property
    def visible(self) -> NDArray[np.bool_]:
        """(3m,) whether each half-edge lies on an edge of the mesh."""
        keys, order = self._by_edge
        visible = np.empty(len(keys), dtype=np.bool_)
        visible[order] = among(keys, np.sort(self._keys(*self._edges.T)))
        return visible

    def between(self, tails: NDArray[np.int64], tips: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the half-edges from vertices to others, (k,), or -1 if there is no such half-edge."""
        keys, by_edge = self._by_edge
        found = np.full(len(tails), -1, dtype=np.int64)
        if not len(keys):
            return found
        wanted = self._keys(tails, tips)
        order = np.argsort(wanted)
        for side, aside in (("left", 0), ("right", -1)):
            # A half-edge and its twin are neighbors in this order.
            at = np.searchsorted(keys, wanted[order], side) + aside
            half_edges = by_edge[np.clip(at, 0, len(keys) - 1)]
            fits = (self.tails[half_edges] == tails[order]) & (self.tips[half_edges] == tips[order])
            found[order[fits]] = half_edges[fits]
        return found

    @cached_property
    def _by_edge(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Keys of the edges of all half-edges in order, smaller vertex * count + larger one, and the half-edges."""
        keys = self._keys(self.tails, self.tips)
        order = np.argsort(keys, kind="stable")
        return keys[order], order

    def _keys(self, one: NDArray[np.integer], two: NDArray[np.integer]) -> NDArray[np.int64]:
        return np.minimum(one, two).astype(np.int64) * self._count + np.maximum(one, two)


_Numbers = TypeVar("_Numbers", int, "NDArray[np.int64]")


def after(half_edge: _Numbers) -> _Numbers:
    return half_edge - half_edge % 3 + (half_edge + 1) % 3


def before(half_edge: _Numbers) -> _Numbers:
    return half_edge - half_edge % 3 + (half_edge + 2) % 3


def among(values: NDArray[np.int64], ranked: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which values, best in rising order, are among others in rising order."""
    if not len(ranked):
        return np.zeros(len(values), dtype=bool)
    return ranked[np.minimum(np.searchsorted(ranked, values), len(ranked) - 1)] == values
