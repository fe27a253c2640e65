# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of polygons, as what slides sees of them."""

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
