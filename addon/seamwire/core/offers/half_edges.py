# SPDX-License-Identifier: GPL-3.0-or-later
"""The half-edges of triangles: which two belong together, and how a chain of edges turns within the surface."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ..base.geometry import triangle_areas, triangle_normals

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..network.picks import Edge

_MOST_AROUND = 512
"""Faces around a vertex that are looked at: how a chain turns at the middle of a larger fan is not known."""


class HalfEdges:
    """The half-edges of triangles: half-edge 3 t + i leads from corner i of triangle t to the next one.

    Parameters
    ----------
    points
        (n, 3) vertices of the mesh.
    triangles
        (m, 3) what its polygons are divided into.
    edges
        (e, 2) its edges; other sides of triangles lie within polygons, which are flat by definition.
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> None:
        self._points, self._triangles, self._edges = points, triangles, edges
        self.tails = triangles.reshape(-1)

    def prepare(self) -> None:
        """Compute everything that the other methods need, on the thread that calls this."""
        _ = self.area, self.normals, self.twins, self.boundary, self.visible

    def of(self, edge: Edge) -> list[int]:
        """Return the half-edges along an edge, in both directions."""
        keys, order = self._by_edge
        key = min(edge) * len(self._points) + max(edge)
        begin, end = np.searchsorted(keys, [key, key + 1])
        return [int(half_edge) for half_edge in order[begin:end]]

    def chain(self, half_edges: Sequence[int]) -> tuple[int, ...]:
        """Return the vertices that half-edges start at, in order."""
        return tuple(self.tails[half_edges].tolist())

    def turns(self, chain: Sequence[int]) -> NDArray[np.float64]:
        """Return how far a closed chain turns to its left at each vertex, (k,), in radians.

        This is the discrete geodesic curvature of Polthier and Schmies (1998), from the face angles on both sides. On a boundary it is
        zero along the boundary, and otherwise pi minus the angle between the edges. It is zero where the faces are no single fan.

        Parameters
        ----------
        chain
            The vertices of the chain, the first one not repeated.
        """
        here = np.asarray(chain, dtype=np.int64)
        after, before = np.roll(here, -1), np.roll(here, 1)
        left, right = self._angles(here, after, before), self._angles(here, before, after)
        has_left, has_right = np.isfinite(left), np.isfinite(right)
        on_boundary = self._is_open(here, after) & self._is_open(before, here)
        turns = np.zeros(len(here))
        both = has_left & has_right & (left + right > 0.0)
        turns[both] = np.pi * (right[both] - left[both]) / (right[both] + left[both])
        one = has_left & ~has_right & ~on_boundary
        turns[one] = np.pi - left[one]
        other = has_right & ~has_left & ~on_boundary
        turns[other] = right[other] - np.pi
        return turns

    def _angles(
        self, here: NDArray[np.int64], first: NDArray[np.int64], last: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Return the face angles at vertices, (k,), from one edge to the left up to another, infinite where the fan ends before."""
        found = np.full(len(here), np.inf)
        angles = np.zeros(len(here))
        at = self._half_edges(here, first)
        rows = np.flatnonzero(at >= 0)
        for _ in range(_MOST_AROUND):
            if not len(rows):
                break
            to = at[rows]
            back = _before(to)
            angles[rows] += self._corner_angles(to)
            ends = self.tails[back] == last[rows]
            found[rows[ends]] = angles[rows[ends]]
            at[rows] = self.twins[back]
            rows = rows[~ends & (at[rows] >= 0)]
        return found

    def _corner_angles(self, half_edges: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the angles of triangles at the tails of half-edges, (k,)."""
        middle = self._points[self.tails[half_edges]]
        one = self._points[self.tails[after(half_edges)]] - middle
        two = self._points[self.tails[_before(half_edges)]] - middle
        return np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), np.einsum("ij,ij->i", one, two))

    def _half_edges(self, tails: NDArray[np.int64], tips: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the half-edges from vertices to others, (k,), or -1 if there is no such half-edge."""
        keys, order = self._by_edge
        wanted = self._keys(np.stack([tails, tips], axis=1))
        begin = np.searchsorted(keys, wanted)
        found = np.full(len(tails), -1, dtype=np.int64)
        for place in (begin, begin + 1):
            row = np.minimum(place, len(keys) - 1)
            fits = (place < len(keys)) & (keys[row] == wanted) & (self.tails[order[row]] == tails)
            found = np.where(fits, order[row], found)
        return found

    def _is_open(self, one: NDArray[np.int64], two: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return whether only one triangle has the edges between vertices, (k,)."""
        keys, _ = self._by_edge
        wanted = self._keys(np.stack([one, two], axis=1))
        return np.searchsorted(keys, wanted, "right") - np.searchsorted(keys, wanted) == 1

    @cached_property
    def area(self) -> float:
        """The area of all triangles."""
        return float(triangle_areas(self._points, self._triangles).sum())

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """(m, 3) of the triangles, of length one; of triangles without area zero."""
        return triangle_normals(self._points, self._triangles)

    @cached_property
    def twins(self) -> NDArray[np.int64]:
        """(3m,) of each half-edge the other one of its edge; -1 unless two triangles meet that agree which side is out."""
        keys, order = self._by_edge
        starts = np.flatnonzero(np.concatenate([[True], keys[1:] != keys[:-1]])) if len(keys) else np.empty(0, int)
        pairs = starts[np.diff(np.append(starts, len(keys))) == 2]
        one, two = order[pairs], order[pairs + 1]
        agree = self.tails[one] != self.tails[two]
        one, two = one[agree], two[agree]
        twins = np.full(len(keys), -1, dtype=np.int64)
        twins[one], twins[two] = two, one
        return twins

    @cached_property
    def boundary(self) -> NDArray[np.bool_]:
        """(3m,) whether each half-edge lies on an edge that only one triangle has."""
        return self._is_open(self.tails, self.tails[after(np.arange(len(self.tails)))])

    @cached_property
    def visible(self) -> NDArray[np.bool_]:
        """(3m,) whether each half-edge lies on an edge of the mesh."""
        keys, order = self._by_edge
        visible = np.zeros(len(keys), dtype=np.bool_)
        visible[order] = np.isin(keys, self._keys(self._edges))
        return visible

    @cached_property
    def _by_edge(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Keys of the edges of all half-edges in order, smaller vertex * n + larger one, and the half-edges."""
        keys = self._keys(np.stack([self._triangles, np.roll(self._triangles, -1, axis=1)], axis=2).reshape(-1, 2))
        order = np.argsort(keys, kind="stable")
        return keys[order], order

    def _keys(self, pairs: NDArray[np.integer]) -> NDArray[np.int64]:
        pairs = np.sort(pairs, axis=1).astype(np.int64)
        return pairs[:, 0] * len(self._points) + pairs[:, 1]


_Numbers = TypeVar("_Numbers", int, "NDArray[np.int64]")


def after(half_edge: _Numbers) -> _Numbers:
    """Return the next half-edge of the triangle, of one or of many."""
    return half_edge - half_edge % 3 + (half_edge + 1) % 3


def _before(half_edge: NDArray[np.int64]) -> NDArray[np.int64]:
    return half_edge - half_edge % 3 + (half_edge + 2) % 3
