# SPDX-License-Identifier: GPL-3.0-or-later
"""Variational shape approximation [CSAD04], which Figure 11 shows beside the wires: regions of faces that a plane each stands for."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROUNDS = 12
_SETTLING = 3
"""The last rounds, in which no region moves."""


def shape_proxies(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    count: int,
    rounds: int = ROUNDS,
    parts: NDArray[np.int32] | None = None,
    teleport: bool = False,
) -> NDArray[np.int32]:
    """Return the region of each triangle, (m,): Cohen-Steiner, Alliez, Desbrun, "Variational shape approximation" (2004).

    Lloyd's iteration in the metric L2,1 (Section 3). Regions grow over the mesh from one face each, always to the triangle whose normal
    differs least from that of the region's proxy, weighted by area. Proxies become the mean normals of their regions.

    Parameters
    ----------
    points, triangles
        (n, 3) and (m, 3).
    count
        How many regions: at most m.
    rounds
        Of Lloyd's iteration.
    parts
        (m,), 0 and up: a connected part of the mesh for each triangle. No region crosses from one part to another.
        Each part has at least one region, so there are more than `count` regions if there are more parts than that.
    teleport
        Whether regions that are hardly needed move to where the error is largest, as in [CSAD04].
    """
    a, b, c = points[triangles].transpose(1, 0, 2)
    cross = np.cross(b - a, c - a)
    areas = 0.5 * np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(2.0 * areas, 1e-300)[:, None]
    _, pairs = shared_sides(triangles)
    if parts is None:
        seeds = np.random.default_rng(1).choice(len(triangles), count, replace=False)
    else:
        pairs = pairs[parts[pairs[:, 0]] == parts[pairs[:, 1]]]
        seeds = _seeds_in_parts(parts, count)
        count = len(seeds)
    beside = _neighbors(len(triangles), pairs)
    proxies = normals[seeds]
    regions = np.full(len(triangles), -1, dtype=np.int32)
    for step in range(rounds):
        regions = _grown(seeds, proxies, normals, areas, beside)
        used = regions >= 0
        sums = np.zeros((count, 3))
        np.add.at(sums, regions[used], cross[used])
        proxies = sums / np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]
        # A region grows next from the face that is most like its proxy.
        errors = ((normals - proxies[regions]) ** 2).sum(axis=1)
        order = np.lexsort((errors, regions))
        order = order[used[order]]
        found, first = np.unique(regions[order], return_index=True)
        seeds[found] = order[first]
        if teleport and step < rounds - _SETTLING:
            moved = _least_needed(regions, pairs, 0.5 * sums, areas)
            if moved is not None:
                least, worst = moved
                candidates = np.where(regions == worst, areas * errors, -1.0)
                candidates[seeds[worst]] = -1.0
                seeds[least] = candidates.argmax()
                proxies[least] = normals[seeds[least]]
    return regions


def shared_sides(triangles: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Find the sides between two triangles: the two vertices of each, (e, 2), and the two triangles, (e, 2)."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owners = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, owners = sides[order], owners[order]
    same = (sides[1:] == sides[:-1]).all(axis=1)
    return sides[1:][same], np.stack([owners[:-1][same], owners[1:][same]], axis=1)


def _neighbors(count: int, pairs: NDArray[np.int64]) -> list[list[int]]:
    beside: list[list[int]] = [[] for _ in range(count)]
    for one, other in pairs.tolist():
        beside[one].append(other)
        beside[other].append(one)
    return beside


def _seeds_in_parts(parts: NDArray[np.int32], count: int) -> NDArray[np.int64]:
    """Return random faces for regions to grow from: one in each part first, then others anywhere."""
    drawn = np.random.default_rng(1).permutation(len(parts))
    _, first = np.unique(parts[drawn], return_index=True)
    others = np.delete(drawn, first)[: max(0, count - len(first))]
    return np.concatenate([drawn[first], others])


def _least_needed(
    regions: NDArray[np.int32], pairs: NDArray[np.int64], sums: NDArray[np.float64], areas: NDArray[np.float64]
) -> tuple[int, int] | None:
    """Return the region that its neighbor can replace best, and the region with the largest error.

    Return None if moving a region from the first place to the second is unlikely to help.
    """
    used = regions >= 0
    bulk = np.linalg.norm(sums, axis=1)
    # The integral of the squared distance between normals and their mean direction.
    errors = 2.0 * (np.bincount(regions[used], areas[used], len(sums)) - bulk)
    touching = np.unique(regions[pairs], axis=0)
    one, other = touching[(touching[:, 0] != touching[:, 1]) & (touching >= 0).all(axis=1)].T
    if not len(one):
        return None
    grown = 2.0 * (bulk[one] + bulk[other] - np.linalg.norm(sums[one] + sums[other], axis=1))
    best, worst = int(grown.argmin()), int(errors.argmax())
    least = int(one[best] if bulk[one[best]] < bulk[other[best]] else other[best])
    return (least, worst) if grown[best] < 0.5 * errors[worst] and least != worst else None


def _grown(
    seeds: NDArray[np.int64],
    proxies: NDArray[np.float64],
    normals: NDArray[np.float64],
    areas: NDArray[np.float64],
    beside: list[list[int]],
) -> NDArray[np.int32]:
    """Return regions grown from a face each; -1 where none of them is connected to."""

    def cost(face: int, region: int) -> float:
        off = normals[face] - proxies[region]
        return float(areas[face] * (off @ off))

    regions = np.full(len(normals), -1, dtype=np.int32)
    # Each region takes its own face before any region grows.
    queue = [(-1.0, int(face), region) for region, face in enumerate(seeds)]
    heapify(queue)
    while queue:
        _, face, region = heappop(queue)
        if regions[face] >= 0:
            continue
        regions[face] = region
        for other in beside[face]:
            if regions[other] < 0:
                heappush(queue, (cost(other, region), other, region))
    return regions
