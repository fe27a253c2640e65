# SPDX-License-Identifier: GPL-3.0-or-later
"""What cuts run through: vertices, edges and polygons of a mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..base.messages import Refused
from ..network.picks import FacePoint

if TYPE_CHECKING:
    from numpy.typing import NDArray


NEAR = 0.05
"""A cut that passes a vertex or an edge nearer than that, as part of an edge or of a triangle's height, goes through it: no slivers."""

WIDE = 0.25
"""Two cuts that part and meet again are merged if they are nowhere farther apart than this fraction of the heights of the triangles that
they cross. Otherwise curves that run side by side would enclose tiny islands."""

OFF = 0.25
"""How far from the mesh a curve's points may be, as part of the longest side of the triangle beside. Mirror images of curves are off
if the halves of a mesh are cut into other triangles, and so are the curves of slid wires. The cuts lie on the mesh all the same."""

BEND = 0.1
"""By how much of its length a cut may leave the straight line within a polygon and be straight."""

ON = 1e-4
"""Which vertex or edge a curve's point is on: stored curves are rounded."""

FLAT = 1e-3
"""A polygon's side has no length below this part of its longest one. Two sides lie on each other below this sine of the angle
between them. A triangle has no area below this part of the square of its longest side."""

SIDE = 0.05
"""The least cosine between the normal of a triangle and the direction along which its polygon is seen."""


class CutError(Refused):
    """A curve cannot be cut into the mesh."""


class Faces(Protocol):
    """The polygons of a mesh, and the triangles that they are seen as."""

    points: NDArray[np.float64]
    """(n, 3) vertices."""
    triangles: NDArray[np.int32]
    """(m, 3)"""

    def polygons_at(self, vertex: int) -> Sequence[int]:
        """Return the polygons around a vertex."""

    def rows_of(self, polygon: int) -> Sequence[int]:
        """Return the triangles of a polygon."""

    def corners(self, polygon: int) -> Sequence[int]:
        """Return the vertices around a polygon."""


@dataclass(frozen=True)
class Node:
    """A place on the mesh: a vertex, a point between two, or one inside a triangle.

    Parameters
    ----------
    vertices
        One, two or three, ascending.
    weights
        Of each vertex, all positive; their sum is 1.
    polygon
        The polygon that it lies inside; -1 if it is a vertex or lies on an edge.
    """

    vertices: tuple[int, ...]
    weights: tuple[float, ...] = (1.0,)
    polygon: int = -1

    @classmethod
    def between(cls, vertices: Sequence[int], weights: Sequence[float], near: float = 0.0) -> Node:
        """Return the node of barycentric coordinates, moved to an edge or a vertex that it is near to."""
        kept = [(int(v), float(w)) for v, w in zip(vertices, weights, strict=True) if w > near]
        if len(kept) < 3:
            # Points near an edge may still be near one of its ends.
            total = sum(w for _, w in kept)
            kept = [(v, w / total) for v, w in kept if w > near * total]
        kept.sort()
        total = sum(w for _, w in kept)
        return cls(tuple(v for v, _ in kept), tuple(w / total for _, w in kept))

    def place(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where it is, (3,)."""
        return np.asarray(self.weights) @ points[list(self.vertices)]

    def near(self, other: Node) -> bool:
        """Whether both are between the same vertices, and near each other."""
        weights = zip(self.weights, other.weights, strict=True)
        return self.vertices == other.vertices and max(abs(one - two) for one, two in weights) < NEAR

    def weight(self, vertex: int) -> float:
        """Return the weight of any vertex."""
        return dict(zip(self.vertices, self.weights, strict=True)).get(vertex, 0.0)


Segment = tuple[Node, Node]
"""A straight cut between two nodes."""


Piece = tuple[Node, Node, int]
"""One in a polygon, by that polygon's number."""


Spot = int | FacePoint
"""A vertex, or a point in a triangle."""


Trail = tuple[Piece, "Trail"] | None
"""The pieces up to one, the last first."""
