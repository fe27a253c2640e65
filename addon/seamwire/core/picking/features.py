# SPDX-License-Identifier: GPL-3.0-or-later
"""Corners, ridges, valleys and strong features near the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import triangle_normals
from ..network.picks import FacePoint
from .camera import Segments

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray

    from ..fields.crests import Crests
    from ..network.picks import Pick
    from .camera import Sight
    from .surface import VisibleSurface

FEATURE_REACH = 10.0
"""Pixels in which the strongest feature is looked for."""
FEATURE_QUANTILE = 0.75
"""A vertex counts as a feature from this share of all vertices' strengths on: on a plain nothing is stronger than noise."""
_SHARP_COSINE = float(np.cos(np.radians(30.0)))
"""An edge counts as a feature if its faces meet at 30 degrees or more, as Blender's Select Sharp Edges takes it."""
_CORNER = 3
"""So many such edges meet at a corner."""
_MOST_TRIED = 4
"""So many of the vertices near the cursor are tried for one that is not hidden."""


class FeaturePicker:
    """Finds features of a mesh near the cursor."""

    def __init__(self, surface: VisibleSurface) -> None:
        self._surface = surface
        self._strength: tuple[object, float] = (None, 0.0)
        self._crests: tuple[Crests | None, Segments] = (None, Segments([]))

    def preferred_at(self, sight: Sight, pick: Pick, preferred: Collection[int]) -> int | None:
        """Return the nearest of the preferred vertices within reach, going over the mesh from what is under the cursor."""
        near = self._surface.vertices_near(sight, pick, FEATURE_REACH * sight.scale)
        return self._nearest(sight, {vertex: gap for vertex, gap in near.items() if vertex in preferred})

    def corner_at(self, sight: Sight, pick: Pick) -> int | None:
        """Return the nearest vertex within reach where three or more sharp edges meet, going over the mesh from a pick."""
        near = self._surface.vertices_near(sight, pick, FEATURE_REACH * sight.scale)
        count = dict.fromkeys(near, 0)
        for edge in self._sharp_edges(near):
            for vertex in edge:
                if vertex in count:
                    count[vertex] += 1
        return self._nearest(sight, {vertex: gap for vertex, gap in near.items() if count[vertex] >= _CORNER})

    def _sharp_edges(self, vertices: Collection[int]) -> list[tuple[int, int]]:
        """Return the edges at vertices where the mesh ends, where faces meet at a sharp angle, or where more than two meet."""
        surface = self._surface
        triangles = surface.triangles[surface.triangles_at.rows(vertices)]
        normals = triangle_normals(surface.points, triangles)
        sides: dict[tuple[int, int], list[NDArray[np.float64]]] = {}
        for (one, two, three), normal in zip(triangles.tolist(), normals, strict=True):
            for tail, tip in ((one, two), (two, three), (three, one)):
                # Faces that agree which side is out have the edge in opposite directions.
                sides.setdefault((min(tail, tip), max(tail, tip)), []).append(normal if tail < tip else -normal)
        found = []
        for one, two in surface.edges[surface.edges_at.rows(vertices)].tolist():
            beside = sides.get((min(one, two), max(one, two)), [])
            if len(beside) != 2 or -float(beside[0] @ beside[1]) <= _SHARP_COSINE:
                found.append((one, two))
        return found

    def _nearest(self, sight: Sight, gaps: dict[int, float]) -> int | None:
        """Return the nearest vertex that can be picked. `gaps` tells how far each one is from the cursor."""
        nearest = sorted(gaps, key=gaps.__getitem__)[:_MOST_TRIED]
        return next((vertex for vertex in nearest if self._can_pick(sight, vertex)), None)

    def strongest_at(self, sight: Sight, pick: Pick, strength: NDArray[np.float64]) -> int | None:
        """Return the vertex of the strongest feature within reach, going over the mesh from what is under the cursor."""
        if self._strength[0] is not strength:
            self._strength = (strength, float(np.quantile(strength, FEATURE_QUANTILE)) if len(strength) else 0.0)
        near = self._surface.vertices_near(sight, pick, FEATURE_REACH * sight.scale)
        for vertex in sorted(near, key=lambda v: -strength[v])[:_MOST_TRIED]:
            if strength[vertex] <= self._strength[1]:
                return None
            if self._can_pick(sight, vertex):
                return vertex
        return None

    def crest_at(self, sight: Sight, crests: Crests, anywhere: bool) -> Pick | None:
        """Return the nearest point of a ridge or valley within reach of the cursor.

        The point may lie within a triangle if it may lie `anywhere`. Otherwise it is a vertex beside it that is as near.
        """
        surface = self._surface
        if self._crests[0] is not crests:
            ends = surface.in_object(crests.segments.reshape(-1, 3)).reshape(-1, 2, 3)
            self._crests = crests, Segments(list(ends))
        for piece, seen in self._crests[1].near(sight, FEATURE_REACH * sight.scale):
            if not surface.can_pick(sight, seen):
                continue
            place, triangle, vertex = crests.place_at(piece, surface.to_points @ seen)
            if anywhere:
                return FacePoint.at(place, triangle, surface.triangles, surface.points)
            pixel = surface.pixels(sight, [vertex])[0]
            if np.linalg.norm(pixel - np.asarray(sight.cursor)) <= FEATURE_REACH * sight.scale:
                return vertex
        return None

    def _can_pick(self, sight: Sight, vertex: int) -> bool:
        return self._surface.can_pick(sight, self._surface.to_object @ self._surface.points[vertex])
