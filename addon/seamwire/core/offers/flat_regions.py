# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of flat regions: of faces that meet their neighbors at small angles. Blender selects such regions by Linked Flat Faces."""

from __future__ import annotations

import threading
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from ..network.picks import Edge

FLAT_ANGLES = (30.0, 15.0, 50.0)
"""Degrees below which two faces are of one region; what most borders in artists' seams belong to comes first."""
AT_ONCE = 5_000
"""Triangles up to which looking at all takes some ten milliseconds, so that a thread would only make it late."""
_LONGEST = 20_000
"""Edges of a border: longer ones go around so much that nobody wants them in one click."""


class FlatRegions:
    """Finds the borders of flat regions, on half-edges: half-edge 3 t + i leads from corner i of triangle t to the next one.

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
        self._thread: threading.Thread | None = None

    def ready(self) -> bool:
        """Whether `borders` need not wait; the first call begins to look at all triangles, on a thread where they are many."""
        if self._thread is None:
            self._thread = threading.Thread(target=lambda: (self._by_edge, self._sides), daemon=True)
            self._thread.start()
            if len(self._triangles) <= AT_ONCE:
                self._thread.join()
        return not self._thread.is_alive()

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
            found = (self._border(side, angle) for side in self._half_edges_of(edge))
            yield from sorted(filter(None, found), key=len)

    def _border(self, start: int, angle: float) -> tuple[int, ...]:
        """Return the border of the region beside a half-edge, from its tail, or nothing. See `borders`."""
        twins, angles, visible = self._sides
        if angles[start] < angle:
            return ()
        chain: list[int] = []
        is_several = False
        at = start
        while len(chain) < _LONGEST:
            chain.append(int(self._triangles[at // 3, at % 3]))
            # Around the tip, within the region, to the side that it ends at.
            at = _next(at)
            while angles[at] < angle:
                is_several = is_several or bool(visible[at])
                at = _next(int(twins[at]))
            if at == start:
                simple = is_several and len(chain) > 2 and len(set(chain)) == len(chain)
                return tuple(chain) if simple else ()
        return ()

    def _half_edges_of(self, edge: Edge) -> list[int]:
        """Return the half-edges along an edge, in both directions."""
        keys, order = self._by_edge
        key = min(edge) * len(self._points) + max(edge)
        begin, end = np.searchsorted(keys, [key, key + 1])
        return [int(half_edge) for half_edge in order[begin:end]]

    @cached_property
    def _by_edge(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Keys of the edges of all half-edges in order, smaller vertex * n + larger one, and the half-edges."""
        keys = self._keys(np.stack([self._triangles, np.roll(self._triangles, -1, axis=1)], axis=2).reshape(-1, 2))
        order = np.argsort(keys, kind="stable")
        return keys[order], order

    def _keys(self, pairs: NDArray[np.int32]) -> NDArray[np.int64]:
        pairs = np.sort(pairs, axis=1).astype(np.int64)
        return pairs[:, 0] * len(self._points) + pairs[:, 1]

    @cached_property
    def _sides(self) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.bool_]]:
        """(3m,) of each half-edge its twin, the angle between the faces in degrees, and whether its edge is the mesh's.

        Where not exactly two triangles meet that agree which side is out, the twin is -1 and the angle infinite.
        """
        keys, order = self._by_edge
        tails = self._triangles.reshape(-1)
        starts = np.flatnonzero(np.concatenate([[True], keys[1:] != keys[:-1]])) if len(keys) else np.empty(0, int)
        pairs = starts[np.diff(np.append(starts, len(keys))) == 2]
        one, two = order[pairs], order[pairs + 1]
        agree = tails[one] != tails[two]
        one, two = one[agree], two[agree]
        twins = np.full(len(keys), -1, dtype=np.int64)
        twins[one], twins[two] = two, one

        a, b, c = (self._points[self._triangles[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)
        cosines = np.einsum("ij,ij->i", normals[one // 3], normals[two // 3])
        angles = np.full(len(keys), np.inf)
        angles[one] = angles[two] = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))

        visible = np.zeros(len(keys), dtype=np.bool_)
        visible[order] = np.isin(keys, self._keys(self._edges))
        angles[~visible & (twins >= 0)] = 0.0
        return twins, angles, visible


def _next(half_edge: int) -> int:
    return half_edge - 2 if half_edge % 3 == 2 else half_edge + 1
