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


def joined(*meshes: Mesh) -> Mesh:
    """Return several meshes as one, without sharing a vertex."""
    starts = np.cumsum([0] + [len(points) for points, _ in meshes])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([triangles + start for (_, triangles), start in zip(meshes, starts[:-1], strict=True)]),
    )
