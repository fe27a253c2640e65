# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of polygons, as what slides sees of them."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray
from seamwire.core.seams.slide_plan import SlidFaces


def polygon_faces(points: NDArray[np.float64], polygons: list[list[int]]) -> SlidFaces:
    """Return polygons in the plane or in space, as triangles that fan out from their first corners."""
    points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
    cut = [(a, b, c, p) for p, (a, *rest) in enumerate(polygons) for b, c in itertools.pairwise(rest)]
    *corners, owners = np.array(cut, dtype=np.int32).T
    return SlidFaces(points, np.stack(corners, axis=1), owners, dict(enumerate(polygons)))
