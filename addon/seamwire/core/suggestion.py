# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that the library plans, as wires of a network, and what islands may be like."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .network import FOLLOWS, Wire

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    import seamwire_core
    from numpy.typing import NDArray

    from .network import Along, Finish

_DENSE = 5_000
"""Triangles of a mesh from which on they are taken for those of a scan or a sculpt."""
NARROWER = 0.6
"""What is left of an island's spread where it was stretched too much."""
CRUMB = 0.004
"""The part of a mesh's area below which there is to be no island."""
CRUMB_OF_ISLAND = 0.1
"""The same of each island, where islands are parted that may be that small themselves."""
_SAME = 0.95
"""The part of an island's area that is in one island still where it was not parted, but its border has moved."""
_SEEDS = 24, 400
"""Seeds to choose wires between: at least, and at most."""
SEEDS_TO_OPEN = 24, 300
"""Where islands are to be discs and no more: the fewer are enough on smooth shapes, the more lie on all that is worth following."""


def best_along(polygons: NDArray[np.int32]) -> Along:
    """Return how wires had best run: along edges where most faces are quads or larger.

    Parameters
    ----------
    polygons
        (m,) the face that each triangle is part of.
    """
    return "EDGES" if _most_are_quads(polygons) else "SURFACE"


def best_finish(polygons: NDArray[np.int32]) -> Finish:
    """Return what had best become the seam of a wire across the surface: where triangles are many and small, nobody placed them.

    Parameters
    ----------
    polygons
        As those of `best_along`.
    """
    return "CUT" if len(polygons) >= _DENSE and not _most_are_quads(polygons) else "SNAP"


def _most_are_quads(polygons: NDArray[np.int32]) -> bool:
    _, triangles = np.unique(polygons, return_counts=True)
    return bool((triangles > 1).sum() > 0.5 * len(triangles))


def mutual(images: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the images of vertices, (n,), with -1 where the image of a vertex' image is another vertex.

    On a mesh that is not quite symmetric the way back may lead elsewhere.
    """
    back = np.where(images >= 0, images[images], -1)
    return np.where(back == np.arange(len(images)), images, -1)


def spread_of(angle: float) -> float:
    """Return the spread, see ``seamwire_core.SeamPlanner``, of normals within an angle of their mean, as on a sphere's cap."""
    return 0.5 * (1.0 - np.cos(min(angle, np.pi)))


def seeds_for(max_spread: float, islands: int = 0) -> int:
    """Return how many seeds there have to be, for wires enough: they part a surface into about twice as many pieces at most."""
    least, most = _SEEDS
    return int(min(max(least, islands, 2.0 / max(max_spread, 1e-6)), most))


def planned_wires(plan: seamwire_core.SeamPlan, along: Along, strength: float) -> list[Wire]:
    """Return the wires of a plan, that were found with such a strength."""
    return [
        Wire(
            along, tuple(wire.vertices.tolist()), np.array(wire.points), *wire.seeds,
            follow=FOLLOWS.index(wire.follow), strength=strength,
        )
        for wire in plan.wires
    ]  # fmt: skip


def spreads(
    points: NDArray[np.float64], triangles: NDArray[np.int32], islands: NDArray[np.int32]
) -> NDArray[np.float64]:
    """Return how far the normals of each island spread: 0 in a plane, 0.5 for a half sphere."""
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    count = int(islands.max(initial=-1)) + 1
    areas = np.bincount(islands, np.linalg.norm(normals, axis=1), count)
    sums = np.stack([np.bincount(islands, column, count) for column in normals.T])
    flat = np.divide(np.linalg.norm(sums, axis=0), areas, out=np.ones(count), where=areas > 0.0)
    return np.maximum(1.0 - flat, 0.0)


def narrowed(
    limits: NDArray[np.float64],
    stretched: Collection[int] | Sequence[int],
    islands: NDArray[np.int32],
    island_spreads: NDArray[np.float64],
    left: float = NARROWER,
) -> NDArray[np.float64]:
    """Return limits with which islands that were stretched too much are planned smaller, and others may stay as they are.

    Parameters
    ----------
    limits
        (m,) how far the normals around each triangle could spread.
    stretched
        The islands that were.
    islands
        (m,) the island of each triangle.
    island_spreads
        How far they did spread, see `spreads`.
    left
        What is left of that.
    """
    is_stretched = np.zeros(len(island_spreads), dtype=bool)
    is_stretched[list(stretched)] = True
    own = island_spreads[islands]
    return np.where(is_stretched[islands], left * own, np.maximum(limits, own))


def bordering_seeds(
    wires: Sequence[seamwire_core.PlannedWire], triangles: NDArray[np.int32], is_within: NDArray[np.bool_]
) -> set[int]:
    """Return the seeds of wires that run along some of the triangles.

    Parameters
    ----------
    wires
        Of a plan.
    triangles
        (m, 3) vertices.
    is_within
        (m,) whether a triangle is one of them.
    """
    vertices = np.unique(triangles[is_within])
    seeds: set[int] = set()
    for wire in wires:
        is_beside = np.isin(wire.vertices, vertices)
        if (is_beside[:-1] & is_beside[1:]).any():
            seeds.update(wire.seeds)
    return seeds


def is_parted(before: NDArray[np.int32], after: NDArray[np.int32], areas: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return for each island whether others have come in its place, rather than one that is nearly the same.

    Parameters
    ----------
    before, after
        (m,) the island of each triangle then, and now.
    areas
        (m,) of the triangles.
    """
    count = int(after.max(initial=-1)) + 1
    pairs, of_pair = np.unique(before.astype(np.int64) * count + after, return_inverse=True)
    shared = np.bincount(of_pair, areas)
    largest = np.zeros(int(before.max(initial=-1)) + 1)
    np.maximum.at(largest, pairs // count, shared)
    return largest < _SAME * np.bincount(before, areas)
