# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as the add-on reads them from Blender, made from vertices and polygons."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from seamwire.core.base.mesh_arrays import Arrays


def arrays_of(
    places: ArrayLike,
    polygons: Sequence[Sequence[int]],
    loose: Sequence[tuple[int, int]] = (),
    hidden: Sequence[int] = (),
    stretch: ArrayLike | None = None,
) -> Arrays:
    """Return a mesh as arrays.

    Parameters
    ----------
    places
        (n, 3) vertices in object coordinates.
    polygons
        Convex ones, each by its vertices in order.
    loose
        Edges without a polygon.
    hidden
        Which polygons are hidden. Edges that only these have are hidden too.
    stretch
        (3, 3) what the object's matrix does to lengths; nothing by default.
    """
    shown = [i for i in range(len(polygons)) if i not in hidden]
    triangles, owners = [], []
    edges: dict[tuple[int, int], None] = {}
    for i in shown:
        first, *others = polygons[i]
        for pair in pairwise(others):
            triangles.append((first, *pair))
            owners.append(i)
        edges |= {(min(pair), max(pair)): None for pair in zip(polygons[i], (*others, first), strict=True)}
    matrix = np.eye(3) if stretch is None else np.asarray(stretch, dtype=np.float64)
    return Arrays(
        points=np.asarray(places, dtype=np.float64) @ matrix,
        triangles=np.array(triangles, dtype=np.int32).reshape(-1, 3),
        polygons=np.array(owners, dtype=np.int32),
        edges=np.array([*edges, *loose], dtype=np.int32).reshape(-1, 2),
        to_object=np.linalg.inv(matrix),
        seams=np.empty((0, 2), dtype=np.int32),
        partly_hidden=np.empty((0, 2), dtype=np.int32),
    )


def grid_places(side: int, size: float = 2.0) -> np.ndarray:
    """Return the side x side vertices of a square around the origin; vertex y * side + x is column x of row y."""
    steps = size * (np.arange(side) / (side - 1) - 0.5)
    x, y = np.meshgrid(steps, steps)
    return np.stack([x.ravel(), y.ravel(), np.zeros(side * side)], axis=1)


def grid_polygons(side: int, first: int = 0) -> list[tuple[int, int, int, int]]:
    """Return the quads of that square, whose first vertex has this number."""
    corners = [first + y * side + x for y in range(side - 1) for x in range(side - 1)]
    return [(a, a + 1, a + side + 1, a + side) for a in corners]
