# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made on the spot, as (points, triangles)."""

from __future__ import annotations

import numpy as np

Mesh = tuple[np.ndarray, np.ndarray]


def _cells(columns: int, rows: int, nu: int, nv: int) -> np.ndarray:
    """Two triangles for each of the nu x nv cells of a grid of vertices, closed where it has as many as cells."""
    i, j = np.meshgrid(np.arange(nu), np.arange(nv))
    i, j = i.ravel(), j.ravel()

    def at(di: int, dj: int) -> np.ndarray:
        return (j + dj) % rows * columns + (i + di) % columns

    a, b, c, d = at(0, 0), at(1, 0), at(0, 1), at(1, 1)
    return np.stack([a, b, d, a, d, c], 1).reshape(-1, 3)


def grid(n: int) -> Mesh:
    """Return the unit square in z = 0 of n x n cells."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], 1), _cells(n + 1, n + 1, n, n)


def torus(nu: int, nv: int) -> Mesh:
    """Return nu cells about the z axis, nv about the tube."""
    u, v = np.meshgrid(2 * np.pi * np.arange(nu) / nu, 2 * np.pi * np.arange(nv) / nv)
    ring = 0.35 + 0.15 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.15 * np.sin(v)], -1).reshape(-1, 3)
    return points, _cells(nu, nv, nu, nv)


def moebius(n: int) -> Mesh:
    """Return a band of n cells that is closed after half a turn, at the edge (0, 1); edges across it are (2 i, 2 i + 1)."""
    angle = np.repeat(2 * np.pi * np.arange(n) / n, 2)
    across = np.tile([-0.1, 0.1], n)
    ring = 0.5 + across * np.cos(angle / 2)
    points = np.stack([ring * np.cos(angle), ring * np.sin(angle), across * np.sin(angle / 2)], 1)
    a = 2 * np.arange(n)
    b, c, d = a + 1, a + 2, a + 3
    c[-1], d[-1] = 1, 0
    return points, np.stack([a, c, b, c, d, b], 1).reshape(-1, 3)


def spike(width: float) -> Mesh:
    """Return six triangles from a hexagon of this radius to an apex, vertex 6, at (0.3, 0.2, 1)."""
    angle = np.pi / 3 * np.arange(6)
    base = width * np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    return np.vstack([base, [(0.3, 0.2, 1.0)]]), np.array([(k, (k + 1) % 6, 6) for k in range(6)])


def joined(*meshes: Mesh) -> Mesh:
    """Return several meshes as one, without sharing a vertex."""
    starts = np.cumsum([0] + [len(points) for points, _ in meshes])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([triangles + start for (_, triangles), start in zip(meshes, starts[:-1], strict=True)]),
    )
