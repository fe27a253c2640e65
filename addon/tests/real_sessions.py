# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions with the library's own live wires, on a tube and a ball."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from seamwire.terms.options import CLAMP_PERCENTILE, STRENGTHS

core = pytest.importorskip("seamwire_core")

AROUND = 16
RINGS = 9
"""Rings of the tube and of the ball; vertex ring * AROUND + i."""


def session_on(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32] | None = None,
    ready: bool = True,
    **options: object,
) -> Sketch:
    surface = core.Surface(points, triangles, edges)

    def make(way: Along) -> object:
        on = (surface,) if ready else (points, triangles, edges)
        return core.LiveWire(*on, along=way.lower(), max_anisotropy=STRENGTHS[way], clamp_percentile=CLAMP_PERCENTILE)

    def parts(mirror: int | None, seams: NDArray[np.int32], progress: object) -> object:
        return core.PartFinder(surface, mirror=mirror, seams=seams, progress=progress)

    own = surface.edges if edges is None else edges
    return Sketch(make, points, edges=own, triangles=triangles, make_parts=parts, **options)


def quads_between_rings(rings: int = RINGS, around: int = AROUND) -> NDArray[np.int32]:
    """Return the quads between rings of vertices; vertex ring * around + i."""
    start = np.arange(around)
    after = np.roll(start, -1)
    square = np.stack([start, after, after + around, start + around], axis=1)
    return np.concatenate([square + ring * around for ring in range(rings - 1)]).astype(np.int32)


def caps(rings: int = RINGS, around: int = AROUND) -> NDArray[np.int32]:
    """Return the triangles from the first and the last ring to two more vertices, the poles."""
    first, low = np.arange(around), np.full(around, around * rings)
    top = first + around * (rings - 1)
    ends = np.stack([np.roll(first, -1), first, low], axis=1), np.stack([top, np.roll(top, -1), low + 1], axis=1)
    return np.concatenate(ends).astype(np.int32)


def halves(quads: NDArray[np.int32]) -> NDArray[np.int32]:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def sides(faces: NDArray[np.int32]) -> NDArray[np.int32]:
    pairs = np.concatenate(
        [np.stack([faces[:, i], np.roll(faces, -1, axis=1)[:, i]], axis=1) for i in range(faces.shape[1])]
    )
    return np.unique(np.sort(pairs, axis=1), axis=0)


def circles(heights: NDArray[np.float64], radii: NDArray[np.float64], around: int = AROUND) -> NDArray[np.float64]:
    """Return the vertices of circles around z."""
    angles = np.arange(around) * 2.0 * np.pi / around
    x, y, z = np.outer(radii, np.cos(angles)), np.outer(radii, np.sin(angles)), np.repeat(heights, around)
    return np.stack([x.ravel(), y.ravel(), z], axis=1)


def tube(**options: object) -> Sketch:
    points = circles(np.linspace(-2.0, 2.0, RINGS), np.ones(RINGS))
    quads = quads_between_rings()
    return session_on(points, halves(quads), sides(quads), **options)


def ball(**options: object) -> Sketch:
    """Return a session on a sphere of RINGS rings and two poles."""
    angles = np.linspace(0.0, np.pi, RINGS + 2)[1:-1]
    points = np.vstack([circles(-np.cos(angles), np.sin(angles)), [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]])
    quads = quads_between_rings()
    edges = np.unique(np.concatenate([sides(quads), sides(caps())]), axis=0)
    return session_on(points, np.concatenate([halves(quads), caps()]), edges, **options)


def meridian(at: int) -> list[int]:
    return [ring * AROUND + at for ring in range(RINGS)]
