# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of polygons, as what cuts and slides sees of them."""

from __future__ import annotations

import itertools
from collections import defaultdict

import numpy as np
from numpy.typing import NDArray


class Polygons:
    """Polygons in the plane or in space, as triangles that fan out from their first corners."""

    def __init__(self, points: NDArray[np.float64], polygons: list[list[int]]) -> None:
        self.points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
        self._polygons = polygons
        cut = [(a, b, c, p) for p, (a, *rest) in enumerate(polygons) for b, c in itertools.pairwise(rest)]
        self.triangles = np.array([row[:3] for row in cut], dtype=np.int32)
        self._rows = defaultdict(list)
        for row, (*_, polygon) in enumerate(cut):
            self._rows[polygon].append(row)
        self._around = defaultdict(list)
        for polygon, corners in enumerate(polygons):
            for corner in corners:
                self._around[corner].append(polygon)

    def polygons_at(self, vertex: int) -> list[int]:
        return self._around[vertex]

    def rows_of(self, polygon: int) -> list[int]:
        return self._rows[polygon]

    def corners(self, polygon: int) -> list[int]:
        return self._polygons[polygon]

    def straight(self, start: int, end: int) -> tuple[int, NDArray[np.float64]]:
        """Return the straight curve between two vertices, with a point wherever it passes a side of a triangle."""
        a, b = self.points[start, :2], self.points[end, :2]
        parts = {0.0, 1.0}
        for triangle in self.triangles:
            for c, d in itertools.pairwise([*triangle, triangle[0]]):
                u, v, w = b - a, self.points[d, :2] - self.points[c, :2], self.points[c, :2] - a
                area = u[0] * v[1] - u[1] * v[0]
                if abs(area) < 1e-12:
                    continue
                s, t = (w[0] * v[1] - w[1] * v[0]) / area, (w[0] * u[1] - w[1] * u[0]) / area
                if 0.0 <= s <= 1.0 and -1e-12 <= t <= 1.0 + 1e-12:
                    parts.add(round(float(s), 12))
        places = np.array(sorted(parts))[:, None]
        return start, self.points[start] * (1.0 - places) + self.points[end] * places
