# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of flat regions: of faces that meet their neighbors at small angles. Blender selects such regions by Linked Flat Faces."""

from __future__ import annotations

import threading
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .half_edges import HalfEdges, after

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from ..network.picks import Edge

FLAT_ANGLES = (30.0, 15.0, 50.0)
"""Degrees below which two faces are of one region; what most borders in artists' seams belong to comes first."""
AT_ONCE = 5_000
"""Triangles up to which looking at all takes some ten milliseconds, so that a thread would only make it late."""
_LONGEST = 20_000
"""Edges of a border: longer ones go around so much that nobody wants them in one click."""
_IN_PLANE = float(np.cos(np.radians(1.0)))
"""Two faces lie in a plane if the cosine between their normals is at least this."""
_LARGEST = 50_000
"""Triangles of a flat face: around larger ones nobody needs help."""


class FlatRegions:
    """Finds the borders of flat regions.

    Parameters
    ----------
    points
        (n, 3) vertices of the mesh.
    triangles
        (m, 3) what its polygons are divided into.
    edges
        (e, 2) its edges; other sides of triangles lie within polygons, which are flat by definition.

    Attributes
    ----------
    half_edges
        The half-edges of the triangles.
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> None:
        self.half_edges = HalfEdges(points, triangles, edges)
        self._points, self._triangles = points, triangles
        self._thread: threading.Thread | None = None

    def ready(self) -> bool:
        """Whether `borders` need not wait; the first call begins to look at all triangles, on a thread where they are many."""
        if self._thread is None:
            self._thread = threading.Thread(target=lambda: self._angles, daemon=True)
            self._thread.start()
            if len(self._triangles) <= AT_ONCE:
                self._thread.join()
        return not self._thread.is_alive()

    def wait(self) -> None:
        """Wait until `borders` need not wait, if `ready` was called."""
        if self._thread is not None:
            self._thread.join()

    def borders(self, edge: Edge) -> Iterator[tuple[int, ...]]:
        """Yield the closed chains through an edge that are borders of flat regions beside it.

        A region is of two polygons at least. Its border may be several chains: what is yielded is the one with the edge,
        unless it meets itself. One may be yielded more than once, for several angles or from both sides.

        Parameters
        ----------
        edge
            Two vertices of an edge, in any order.
        """
        for angle in FLAT_ANGLES:
            found = (self._border(side, angle) for side in self.half_edges.of(edge))
            yield from sorted(filter(None, found), key=len)

    def border_around(self, triangle: int) -> tuple[int, ...]:
        """Return the outer border of the flat face that a triangle is part of, or nothing if that meets itself.

        The face is the polygon of the triangle, with all polygons around it that lie in the same plane.
        """
        is_in_face = self._plane_around(triangle)
        twins = self.half_edges.twins

        def is_inner(half_edge: int) -> bool:
            twin = int(twins[half_edge])
            return twin >= 0 and bool(is_in_face[twin // 3])

        sides = {side for t in np.flatnonzero(is_in_face).tolist() for side in range(3 * t, 3 * t + 3)}
        left = {side for side in sides if not is_inner(side)}
        chains: list[tuple[int, ...]] = []
        while left:
            border = self._walk(left.pop(), is_inner)
            if not border:
                return ()
            left.difference_update(border)
            chains.append(tuple(self.half_edges.tails[border].tolist()))
        outer = max(chains, key=self._length, default=())
        return outer if len(outer) > 2 and len(set(outer)) == len(outer) else ()

    def _plane_around(self, triangle: int) -> NDArray[np.bool_]:
        """Return which triangles, (m,), are part of a triangle's flat face; none if these are too many."""
        sides = self.half_edges
        is_in_face = np.zeros(len(self._triangles), dtype=np.bool_)
        new = np.array([triangle])
        count = 0
        while len(new):
            is_in_face[new] = True
            count += len(new)
            if count > _LARGEST:
                return np.zeros_like(is_in_face)
            own = (3 * new[:, None] + np.arange(3)).reshape(-1)
            own = own[sides.twins[own] >= 0]
            beside = sides.twins[own] // 3
            is_flat = sides.normals[beside] @ sides.normals[triangle] >= _IN_PLANE
            new = np.unique(beside[(is_flat | ~sides.visible[own]) & ~is_in_face[beside]])
        return is_in_face

    def _length(self, chain: tuple[int, ...]) -> float:
        around = self._points[[*chain, chain[0]]]
        return float(np.linalg.norm(np.diff(around, axis=0), axis=1).sum())

    def _border(self, start: int, angle: float) -> tuple[int, ...]:
        """Return the border of the region beside a half-edge, from its tail, or nothing. See `borders`."""
        angles, visible = self._angles, self.half_edges.visible
        if angles[start] < angle:
            return ()
        is_several = False

        def is_inner(half_edge: int) -> bool:
            nonlocal is_several
            inner = bool(angles[half_edge] < angle)
            is_several = is_several or (inner and bool(visible[half_edge]))
            return inner

        chain = tuple(self.half_edges.tails[self._walk(start, is_inner)].tolist())
        return chain if is_several and len(chain) > 2 and len(set(chain)) == len(chain) else ()

    def _walk(self, start: int, is_inner: Callable[[int], bool]) -> list[int]:
        """Return the half-edges around a region from one of its border, in order; nothing if they are too many."""
        twins = self.half_edges.twins
        found: list[int] = []
        at = start
        while len(found) < _LONGEST:
            found.append(at)
            # Around the tip, within the region, to the side that it ends at.
            at = after(at)
            while is_inner(at):
                at = after(int(twins[at]))
            if at == start:
                return found
        return []

    @cached_property
    def _angles(self) -> NDArray[np.float64]:
        """(3m,) of each half-edge the angle between the faces in degrees; infinite where it has no twin."""
        sides = self.half_edges
        one = np.flatnonzero(sides.twins >= 0)
        cosines = np.einsum("ij,ij->i", sides.normals[one // 3], sides.normals[sides.twins[one] // 3])
        angles = np.full(3 * len(self._triangles), np.inf)
        angles[one] = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
        angles[one[~sides.visible[one]]] = 0.0
        return angles
