# SPDX-License-Identifier: GPL-3.0-or-later
"""How a chain of edges turns within the surface, and hairpins: closed chains that come back beside themselves."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import triangle_areas, triangle_normals
from ..base.half_edges import HalfEdges, after, before

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..network.picks import Edge

_MOST_AROUND = 512
"""Faces around a vertex that are looked at: how a chain turns at the middle of a larger fan is not known."""
_BEND = np.radians(135.0)
"""A chain that turns so far within the surface comes back: up, over a rim, and down again."""
_SHORT_WAY = 0.165
"""The part of its length within which it does so. Around two square faces in a row it takes a sixth."""
_CIRCLE = np.radians(270.0)
"""A chain that turns so far in all goes around a patch, and not around a limb."""
_FEW_EDGES = 6
_TINY = 0.2
"""Such a circle of few edges is tiny if the square of its length is below this part of the surface's area."""


class SurfaceEdges(HalfEdges):
    """The half-edges of a mesh with places. Sides of triangles that are not among its edges lie within flat polygons."""

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> None:
        super().__init__(triangles, edges, len(points))
        self._points, self._triangles = points, triangles

    def prepare(self) -> None:
        """Compute everything that the other methods need, on the thread that calls this."""
        _ = self.area, self.normals, self.twins, self.boundary, self.visible

    def of(self, edge: Edge) -> list[int]:
        """Return the half-edges along an edge, in both directions."""
        keys, order = self._by_edge
        key = min(edge) * self._count + max(edge)
        begin, end = np.searchsorted(keys, [key, key + 1])
        return [int(half_edge) for half_edge in order[begin:end]]

    def chain(self, half_edges: Sequence[int]) -> tuple[int, ...]:
        """Return the vertices that half-edges start at, in order."""
        return tuple(self.tails[half_edges].tolist())

    def turns(self, chain: Sequence[int]) -> NDArray[np.float64]:
        """Return how far a closed chain turns to its left at each vertex, (k,), in radians. The first vertex is not repeated.

        This is the discrete geodesic curvature of Polthier and Schmies (1998), from the face angles on both sides. On a boundary it is
        zero along the boundary, and otherwise pi minus the angle between the edges. It is zero where the faces are no single fan.
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

    def is_hairpin(self, chain: Sequence[int]) -> bool:
        """Return whether a closed chain doubles back within a short way, or is a tiny circle of a few edges. See `turns`.

        How far it turns is measured within the surface: a ring that leads over the rims of a thin plate goes straight on.
        """
        turns = self.turns(chain)
        lengths = np.linalg.norm(np.diff(self._points[[*chain, chain[0]]], axis=0), axis=1)
        length = float(lengths.sum())
        is_tiny = len(chain) <= _FEW_EDGES and length**2 < _TINY * self.area
        return (is_tiny and abs(float(turns.sum())) >= _CIRCLE) or _doubles_back(turns, lengths, _SHORT_WAY * length)

    def _angles(
        self, here: NDArray[np.int64], first: NDArray[np.int64], last: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Return the face angles at vertices, (k,), from one edge to the left up to another, infinite where the fan ends before."""
        found = np.full(len(here), np.inf)
        angles = np.zeros(len(here))
        at = self.between(here, first)
        rows = np.flatnonzero(at >= 0)
        for _ in range(_MOST_AROUND):
            if not len(rows):
                break
            to = at[rows]
            back = before(to)
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
        two = self._points[self.tails[before(half_edges)]] - middle
        return np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), np.einsum("ij,ij->i", one, two))

    def _is_open(self, one: NDArray[np.int64], two: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return whether only one triangle has the edges between vertices, (k,)."""
        keys, _ = self._by_edge
        wanted = self._keys(one, two)
        return np.searchsorted(keys, wanted, "right") - np.searchsorted(keys, wanted) == 1

    @cached_property
    def area(self) -> float:
        """The area of all triangles."""
        return float(self.areas.sum())

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """(m,) of the triangles."""
        return triangle_areas(self._points, self._triangles)

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """(m, 3) of the triangles, of length one; of triangles without area zero."""
        return triangle_normals(self._points, self._triangles)

    @cached_property
    def boundary(self) -> NDArray[np.bool_]:
        """(3m,) whether each half-edge lies on an edge that only one triangle has."""
        return self._is_open(self.tails, self.tips)


def _doubles_back(turns: NDArray[np.float64], lengths: NDArray[np.float64], way: float) -> bool:
    """Return whether a closed chain turns back on a part of it that is at most `way` long."""
    begins = np.concatenate([[0.0], np.cumsum(lengths)])
    if np.abs(turns).sum() < _BEND:
        return False
    total = begins[-1]
    at = np.concatenate([begins[:-1], begins[:-1] + total])
    sums = np.concatenate([[0.0], np.cumsum(np.concatenate([turns, turns]))])
    for first in range(len(turns)):
        last = np.searchsorted(at, at[first] + way * (1.0 + 1e-9), side="right")
        if np.abs(sums[first + 1 : last + 1] - sums[first]).max(initial=0.0) >= _BEND:
            return True
    return False
