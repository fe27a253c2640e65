# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pick of the mesh may be: a vertex, an edge, or a point inside a triangle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..base.geometry import barycentric, nearest_on_segments

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class FacePoint:
    """A point inside a triangle of the surface: where wires across the surface begin and end that are to be cut into it.

    The weights of the triangle's corners are 0 or more, and their sum is 1.
    """

    triangle: int
    corners: tuple[int, int, int]
    weights: tuple[float, float, float]

    @classmethod
    def at(
        cls, place: NDArray[np.float64], triangle: int, triangles: NDArray[np.int32], points: NDArray[np.float64]
    ) -> FacePoint:
        """Return the point of a triangle that a place is, (3,), or is near to; `points` are the vertices, (n, 3)."""
        corners = triangles[triangle]
        places = points[corners]
        (weights,), (off,) = barycentric(places[None], place)
        if not np.isfinite(off):  # the triangle has no area: the point is on one of its sides
            part, gap = nearest_on_segments(place, places, np.roll(places, -1, axis=0))
            side = int(np.argmin(gap))
            weights = np.zeros(3)
            weights[[side, (side + 1) % 3]] = 1.0 - part[side, 0], part[side, 0]
        return cls(int(triangle), tuple(corners.tolist()), tuple(weights.tolist()))

    @property
    def vertex(self) -> int:
        """The corner that it has most of: there the edges end that a wire snaps to."""
        return self.corners[self.weights.index(max(self.weights))]


Pick = int | tuple[int, int] | FacePoint
"""A vertex, an edge by its two vertices, or a point inside a triangle."""

Edge = tuple[int, int]
"""An edge by its vertices; in results the smaller one first."""

End = Literal["start", "end"]


def undirected(pick: Pick | None) -> Pick | None:
    """Return a pick with an edge's smaller vertex first."""
    return (min(pick), max(pick)) if isinstance(pick, tuple) else pick


def is_same(one: Pick | None, other: Pick | None) -> bool:
    """Whether two picks are the same, edges in either direction."""
    return one == other or (isinstance(one, tuple) and one[::-1] == other)


def pick_name(pick: Pick) -> str:
    if isinstance(pick, tuple):
        return f"edge {pick[0]}-{pick[1]}"
    return "this point" if isinstance(pick, FacePoint) else f"vertex {pick}"


def vertices_of(pick: Pick) -> tuple[int, ...]:
    """Return the vertex, both vertices of an edge, or the vertex that stands for a point."""
    if isinstance(pick, FacePoint):
        return (pick.vertex,)
    return pick if isinstance(pick, tuple) else (pick,)


def place_of(pick: Pick, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where a pick is, of an edge its middle, (3,); `points` are the vertices, (n, 3)."""
    if isinstance(pick, FacePoint):
        return np.asarray(pick.weights) @ points[list(pick.corners)]
    return points[list(vertices_of(pick))].mean(axis=0)
