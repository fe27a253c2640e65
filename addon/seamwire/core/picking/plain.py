# SPDX-License-Identifier: GPL-3.0-or-later
"""The edge, the vertex or the point of the plain mesh under the cursor."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments
from ..network.network import Snap
from ..network.picks import FacePoint
from .camera import VERTEX_RADIUS, VERTEX_SHARE, Projected, Segments, nearest_edge
from .surface import MAX_NEAR

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator

    from numpy.typing import NDArray

    from ..network.picks import Edge, Pick
    from .camera import Sight
    from .surface import VisibleSurface

REACH = 14.0
"""Pixels beside the mesh in which it is still found: rims and silhouettes are hard to hit."""
SHORT_EDGE = 12.0
"""Pixels below which an edge is too short to point at."""
INSIDE = 14.0
"""Pixels from the nearest edge beyond which the cursor is inside a face."""
_STRAIGHT_COSINE = 0.9
"""An edge that turns off by less than some 25 degrees does not cross another one..."""
_SAME_COSINE = 0.05
"""...and edges cross equally well if these cosines differ by less."""
_FEW_EDGES = 50_000
"""So many are projected all; of more, those at the vertices that are near."""


class PlainPicker:
    """Finds the edges, vertices and points of a mesh."""

    def __init__(self, surface: VisibleSurface) -> None:
        self._surface = surface

    def at(self, sight: Sight, vertices_only: bool, edges_only: bool) -> Pick | None:
        """Return the visible edge or vertex under the cursor."""
        surface = self._surface
        rows = self._edges_near(sight, loose_too=not vertices_only)
        if not rows:
            return None
        pairs = surface.edges[rows]
        if vertices_only:
            numbers = np.unique(pairs)
            gaps = np.linalg.norm(surface.pixels(sight, numbers) - np.asarray(sight.cursor), axis=1)
            return None if np.isnan(gaps).all() else int(numbers[np.nanargmin(gaps)])
        starts, ends = surface.pixels(sight, pairs.T.reshape(-1)).reshape(2, -1, 2)
        index, end = nearest_edge(sight.cursor, starts, ends, sight.scale)
        if index < 0:
            return None
        pair = (int(pairs[index, 0]), int(pairs[index, 1]))
        return pair if end is None or edges_only else pair[end]

    def through(self, sight: Sight, vertices_only: bool) -> Pick | None:
        """Return the vertex or edge that is nearest on the screen, however much lies before it."""
        edges, cursor, reach = self._surface.edges, sight.cursor, REACH * sight.scale
        numbers, projected = self._vertices
        x, y, depth = projected.seen(sight.camera, sight.matrix)
        for radius in (reach, 5.0 * reach):
            rows = projected.near(sight.camera, sight.matrix, cursor, radius)
            if len(rows):
                break
        if vertices_only:
            if not len(rows):
                return None
            gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
            same = rows[gaps <= gaps.min() + 1.0]  # of those at the same place, the one in front
            return int(numbers[same[np.argmin(depth[same])]])
        if len(edges) <= _FEW_EDGES:
            pairs = edges
        else:
            gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
            nearest = numbers[rows[np.argsort(gaps)[:MAX_NEAR]]]
            pairs = edges[self._surface.edges_at.rows(nearest)]
        at = np.searchsorted(numbers, pairs)
        screen = np.stack([x, y], axis=1)
        starts, ends = screen[at[:, 0]], screen[at[:, 1]]
        index, end = nearest_edge(cursor, starts, ends, sight.scale)
        if index < 0 or nearest_on_segments(cursor, starts[[index]], ends[[index]])[1][0] > 5.0 * reach:
            return None
        pair = (int(pairs[index, 0]), int(pairs[index, 1]))
        return pair if end is None else pair[end]

    def point_at(self, sight: Sight) -> int | FacePoint | None:
        """Return the point of the surface under the cursor, or the vertex that is meant."""
        surface = self._surface
        hit = surface.cast(sight, sight.cursor)
        if hit is None:
            return None
        corners = surface.triangles[hit[0]].tolist()
        pixels = surface.pixels(sight, corners)
        gaps = np.linalg.norm(pixels - np.asarray(sight.cursor), axis=1)
        if not np.isnan(gaps).any():
            nearest = int(np.argmin(gaps))
            shorter = np.linalg.norm(np.delete(pixels, nearest, axis=0) - pixels[nearest], axis=1).min()
            if gaps[nearest] <= min(VERTEX_RADIUS * sight.scale, VERTEX_SHARE * float(shorter)):
                return corners[nearest]
        return FacePoint.at(surface.to_points @ hit[1], hit[0], surface.triangles, surface.points)

    def with_crossing(self, sight: Sight, edge: Edge) -> Snap:
        """Return the snap of an edge with the edge that crosses it at its end nearer to the cursor, and the triangle there."""
        surface = self._surface
        hit = None if sight.xray else surface.cast(sight, sight.cursor)
        seen = surface.pixels(sight, [*edge])
        gap = float(nearest_on_segments(sight.cursor, seen[:1], seen[1:])[1][0])
        inside = hit is not None and gap > INSIDE * sight.scale
        plain = Snap(edge, triangle=None if hit is None else hit[0], inside=inside)
        end = edge[int(np.argmin(np.linalg.norm(seen - np.asarray(sight.cursor), axis=1)))]
        start = edge[0] if end == edge[1] else edge[1]
        pairs = surface.edges[surface.edges_at.rows([end])]
        ends = pairs.sum(axis=1) - end
        ends = ends[ends != start]
        ways = surface.in_object(surface.points[[start, *ends]]) - surface.in_object(surface.points[end])
        lengths = np.linalg.norm(ways, axis=1)
        if not len(ends) or lengths.min() <= 0.0:
            return plain
        cosines = np.abs(ways[1:] @ ways[0]) / (lengths[1:] * lengths[0])
        if cosines.min() > _STRAIGHT_COSINE:
            return plain
        best = ends[cosines <= cosines.min() + _SAME_COSINE]
        places = surface.pixels(sight, best)
        here = surface.pixels(sight, [end])
        _, gaps = nearest_on_segments(sight.cursor, np.broadcast_to(here, places.shape), places)
        at = int(np.argmin(np.where(np.isnan(gaps), np.inf, gaps)))
        sizes = np.linalg.norm([seen[1] - seen[0], places[at] - here[0]], axis=1)
        is_close_call = bool(sizes.min() < SHORT_EDGE * sight.scale)
        return replace(plain, crossing=(end, int(best[at])), is_close_call=is_close_call)

    # Edges near the cursor

    @cached_property
    def _vertices(self) -> tuple[NDArray[np.int32], Projected]:
        """Return the vertices that are not hidden, and their coordinates."""
        surface = self._surface
        used = np.zeros(len(surface.points), dtype=np.bool_)
        used[surface.edges] = True
        numbers = np.flatnonzero(used).astype(np.int32)
        return numbers, Projected(surface.in_object(surface.points[numbers]).astype(np.float32))

    @cached_property
    def _loose(self) -> Segments:
        """The edges without a visible face."""
        return Segments(list(self._surface.in_object(self._surface.points[self._surface.edges[self._loose_rows]])))

    @cached_property
    def _loose_rows(self) -> NDArray[np.int64]:
        return np.flatnonzero(~self._surface.triangles_at.contain(self._surface.edges))

    def _edges_near(self, sight: Sight, loose_too: bool) -> list[int]:
        """Return the edges that may be meant, by their rows: those of polygons near the cursor, and those without one."""
        hits = set(self._polygons_at(sight, REACH * sight.scale))
        found = {row for polygon in hits for row in self._surroundings(polygon, sight)}
        if loose_too:
            loose = self._loose.near(sight, REACH * sight.scale)
            found.update(int(self._loose_rows[row]) for row, place in loose if self._surface.sees(sight, place))
        return sorted(found)

    def _polygons_at(self, sight: Sight, reach: float) -> Iterator[int]:
        """Yield the polygon under the cursor, or the polygons just beside a cursor that is over no polygon."""
        surface, cursor = self._surface, sight.cursor
        hit = surface.cast(sight, cursor)
        if hit is not None:
            yield int(surface.polygons[hit[0]])
            return
        for radius in (0.5 * reach, reach):
            found = False
            for turn in np.arange(8) * (np.pi / 4.0):
                beside = (cursor[0] + radius * float(np.cos(turn)), cursor[1] + radius * float(np.sin(turn)))
                hit = surface.cast(sight, beside)
                if hit is not None:
                    found = True
                    yield int(surface.polygons[hit[0]])
            if found:
                return

    def _triangles_of(self, polygons: Collection[int]) -> list[int]:
        """Return the rows of the triangles that polygons are cut into."""
        every = self._surface.polygons
        # Of the same type, or NumPy would convert the whole array each time.
        wanted = np.fromiter(polygons, every.dtype, len(polygons))
        begins, ends = (np.searchsorted(every, wanted, side).tolist() for side in ("left", "right"))
        return [row for begin, end in zip(begins, ends, strict=True) for row in range(begin, end)]

    def _surroundings(self, polygon: int, sight: Sight) -> list[int]:
        """Return the edges of a polygon and of those around it that turn the same side to the viewer, by their rows."""
        surface = self._surface
        corners = set(surface.triangles[self._triangles_of([polygon])].reshape(-1).tolist())
        rows = self._triangles_of(set(surface.polygons[surface.triangles_at.rows(corners)].tolist()))
        triangles, owners = surface.triangles[rows], surface.polygons[rows].tolist()
        # The volume between the eye and a triangle is below 0 for those that turn one side to it, and above 0 for the others.
        to_clip = (sight.camera.perspective @ sight.matrix)[[0, 1, 3]]
        places = surface.in_object(surface.points[triangles]) @ to_clip[:, :3].T + to_clip[:, 3]
        facing = dict.fromkeys(owners, 0.0)
        for owner, volume in zip(owners, np.linalg.det(places).tolist(), strict=True):
            facing[owner] += volume
        alike = {owner for owner, volume in facing.items() if volume * facing[polygon] > 0.0 or owner == polygon}
        return self._sides(
            (owner, *corners) for owner, corners in zip(owners, triangles.tolist(), strict=True) if owner in alike
        )

    def _sides(self, triangles: Iterable[tuple[int, int, int, int]]) -> list[int]:
        """Return the edges of polygons, by their rows. Their triangles are given, each as its polygon and its corners.

        A side that two triangles of a polygon share is a diagonal and not one of its edges.
        """
        sides: set[tuple[int, int, int]] = set()
        for owner, a, b, c in triangles:
            for one, two in ((a, b), (b, c), (c, a)):
                side = (owner, one, two) if one < two else (owner, two, one)
                if side in sides:
                    sides.remove(side)
                else:
                    sides.add(side)
        own = {(one, two) for _, one, two in sides}
        rows = self._surface.edges_at.rows({vertex for side in own for vertex in side})
        pairs = zip(rows.tolist(), self._surface.edges[rows].tolist(), strict=True)
        return [row for row, (one, two) in pairs if (one, two) in own or (two, one) in own]
