# SPDX-License-Identifier: GPL-3.0-or-later
"""Variational shape approximation [CAD04], which Figure 11 shows beside the wires: regions of faces that a plane each stands for."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROUNDS = 12


def shape_proxies(
    points: NDArray[np.float64], triangles: NDArray[np.int32], count: int, rounds: int = ROUNDS
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
    """
    a, b, c = points[triangles].transpose(1, 0, 2)
    cross = np.cross(b - a, c - a)
    areas = 0.5 * np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(2.0 * areas, 1e-300)[:, None]
    beside = _neighbors(triangles)
    seeds = np.random.default_rng(1).choice(len(triangles), count, replace=False)
    proxies = normals[seeds]
    regions = np.full(len(triangles), -1, dtype=np.int32)
    for _ in range(rounds):
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
    return regions


def _neighbors(triangles: NDArray[np.int32]) -> list[list[int]]:
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owners = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    same = (sides[order][1:] == sides[order][:-1]).all(axis=1)
    beside: list[list[int]] = [[] for _ in range(len(triangles))]
    for one, other in zip(owners[order][:-1][same].tolist(), owners[order][1:][same].tolist(), strict=True):
        beside[one].append(other)
        beside[other].append(one)
    return beside


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
    queue = [(0.0, int(face), region) for region, face in enumerate(seeds)]
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
