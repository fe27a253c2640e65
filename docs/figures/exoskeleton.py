# SPDX-License-Identifier: GPL-3.0-or-later
"""A segmentation after Exoskeleton [dGGDV11], which Figure 11 shows beside the wires.

De Goes, Goldenstein, Desbrun, Velho, "Exoskeleton: Curve network abstraction for 3D shapes" (2011), divide a shape into
perceptual parts. An extension of variational shape approximation [CSAD04] then makes the curve network. We had only the
paper's abstract. It does not say how parts are found, or how the approximation is extended. Our choices are:

- Parts are clusters in diffusion distance, around medoids. The first author's earlier method does this too: de Goes,
  Goldenstein, Velho, "A hierarchical segmentation of articulated bodies" (2008). Ours has no hierarchy.
- Diffusion slows down at concave edges, so that parts meet there.
- The approximation runs inside each part. Regions move to the parts that have the largest errors.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from shape_proxies import shape_proxies, shared_sides

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEAST_PART = 0.01
"""The smallest part, as a fraction of the surface."""
_CLUSTERS = range(4, 13)
_PATCHES = 500
"""How many patches of triangles the diffusion is computed on."""
_FOLD = 0.2
"""The angle of a concave edge at which diffusion is e times slower, radians."""
_STEPS = 30
"""Of smoothing and of moving the medoids."""


class Exoskeleton(NamedTuple):
    """The regions that the curves of a network surround, and the parts that the regions lie in."""

    regions: NDArray[np.int32]  # (m,), of each triangle
    parts: NDArray[np.int32]  # (m,), of each triangle


def exoskeleton(points: NDArray[np.float64], triangles: NDArray[np.int32], count: int) -> Exoskeleton:
    """Divide a mesh into parts, and each part into regions that a plane each stands for.

    Parameters
    ----------
    points, triangles
        (n, 3) and (m, 3).
    count
        How many regions: at most m. Each part has at least one region, even if there are more parts than `count`.
    """
    parts = shape_parts(points, triangles)
    regions = shape_proxies(points, triangles, count, parts=parts, teleport=True)
    return Exoskeleton(regions, parts)


def shape_parts(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the perceptual part of each triangle, (m,). Each part is connected.

    The number of clusters is where the eigenvalues of the diffusion grow most from one to the next. There are at least
    four clusters, even if the shape has no parts.
    """
    count = len(triangles)
    a, b, c = points[triangles].transpose(1, 0, 2)
    cross, middles = np.cross(b - a, c - a), (a + b + c) / 3.0
    areas = np.maximum(0.5 * np.linalg.norm(cross, axis=1), 1e-12 * np.ptp(points, axis=0).max() ** 2)
    sides, pairs = shared_sides(triangles)
    one, other = pairs.T
    lengths = np.linalg.norm(points[sides[:, 0]] - points[sides[:, 1]], axis=1)
    slower = _slower(cross, middles, pairs)
    steps = np.linalg.norm(middles[one] - middles[other], axis=1)
    patches = _patches(areas, pairs, steps * slower)
    values, centres = _diffused(patches, areas, middles, pairs, lengths / slower)
    # A value for each patch becomes a smooth value for each triangle.
    pull = lengths / slower / np.maximum(steps, 1e-9 * steps.max())
    total = np.maximum(np.bincount(one, pull, count) + np.bincount(other, pull, count), 1e-300)
    values = values[patches]
    for _ in range(_STEPS):
        for column in values.T:
            near = np.bincount(one, pull * column[other], count) + np.bincount(other, pull * column[one], count)
            column[:] = 0.5 * column + 0.5 * near / total
    labels = np.stack([((values - centre) ** 2).sum(axis=1) for centre in centres]).argmin(axis=0)
    parts = _components(count, pairs[labels[one] == labels[other]])
    return _without_small(parts, areas, pairs, lengths)


def _slower(cross: NDArray[np.float64], middles: NDArray[np.float64], pairs: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return how many times slower diffusion is across each side: 1 if it is convex."""
    normals = cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300)
    one, other = pairs.T
    concave = ((normals[other] - normals[one]) * (middles[other] - middles[one])).sum(axis=1) < 0.0
    bend = np.arccos(np.clip((normals[one] * normals[other]).sum(axis=1), -1.0, 1.0))
    return np.where(concave, np.exp(bend / _FOLD), 1.0)


def _patches(areas: NDArray[np.float64], pairs: NDArray[np.int64], steps: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the patch of each triangle: the nearest of some random triangles, where `steps` are distances."""
    beside: list[list[tuple[int, float]]] = [[] for _ in areas]
    for (one, other), step in zip(pairs.tolist(), steps.tolist(), strict=True):
        beside[one].append((other, step))
        beside[other].append((one, step))
    number = min(_PATCHES, len(areas))
    seeds = np.random.default_rng(1).choice(len(areas), number, replace=False, p=areas / areas.sum())
    patches = np.full(len(areas), -1)
    # Each seed takes its own triangle first, even if triangles have no size.
    queue = [(-1.0, face, patch) for patch, face in enumerate(seeds.tolist())]
    heapify(queue)
    while queue:
        away, face, patch = heappop(queue)
        if patches[face] < 0:
            patches[face] = patch
            for near, step in beside[face]:
                if patches[near] < 0:
                    heappush(queue, (max(away, 0.0) + step, near, patch))
    # Components without a seed become one patch.
    return np.where(patches < 0, number, patches)


def _diffused(
    patches: NDArray[np.int64],
    areas: NDArray[np.float64],
    middles: NDArray[np.float64],
    pairs: NDArray[np.int64],
    widths: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return diffusion coordinates of each patch, and those of the medoids; distances between them are diffusion distances."""
    mass = np.bincount(patches, areas)
    places = np.stack([np.bincount(patches, areas * one) for one in middles.T], axis=1) / mass[:, None]
    one, other = patches[pairs].T
    flow = np.zeros((len(mass), len(mass)))
    across = np.linalg.norm(places[one] - places[other], axis=1)
    np.add.at(flow, (one, other), np.where(one != other, widths / np.maximum(across, 1e-9 * across.max()), 0.0))
    flow += flow.T
    root = np.sqrt(mass)
    rates, waves = np.linalg.eigh((np.diag(flow.sum(axis=1)) - flow) / root[:, None] / root)
    rates = np.maximum(rates, 1e-9 * rates[-1])
    clusters = max((k for k in _CLUSTERS if k < len(rates)), key=lambda k: rates[k] / rates[k - 1], default=1)
    used = slice(1, 4 * clusters)
    coordinates = waves[:, used] / root[:, None] * np.exp(-rates[used] / rates[clusters - 1])
    away = ((coordinates[:, None] - coordinates) ** 2).sum(axis=2)
    medoids = [int((mass @ away).argmax())]
    while len(medoids) < clusters:
        medoids.append(int(away[medoids].min(axis=0).argmax()))
    for _ in range(_STEPS):
        nearest = away[medoids].argmin(axis=0)
        medoids = [
            int(np.where(nearest == i, (mass * (nearest == i)) @ away, np.inf).argmin()) for i in range(clusters)
        ]
    return coordinates, coordinates[medoids]


def _components(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the component of each triangle, (m,), in the graph of these pairs."""
    parts = np.arange(count)
    while True:
        lowest = parts.copy()
        for end in pairs.T:
            np.minimum.at(lowest, parts[end], parts[pairs].min(axis=1))
        lowest = lowest[lowest]
        if (lowest == parts).all():
            return np.unique(parts, return_inverse=True)[1]
        parts = lowest


def _without_small(
    parts: NDArray[np.int64], areas: NDArray[np.float64], pairs: NDArray[np.int64], lengths: NDArray[np.float64]
) -> NDArray[np.int32]:
    """Join each small part, the smallest first, to the part that it has the longest boundary with."""
    while True:
        sizes, across = np.bincount(parts, areas), parts[pairs]
        between = across[:, 0] != across[:, 1]
        across, borders = across[between], lengths[between]
        least = min(np.unique(across).tolist(), key=sizes.__getitem__, default=None)
        if least is None or sizes[least] >= LEAST_PART * areas.sum():
            return np.unique(parts, return_inverse=True)[1].astype(np.int32)
        mine = (across == least).any(axis=1)
        partners = across[mine].sum(axis=1) - least
        parts = np.where(parts == least, np.bincount(partners, borders[mine]).argmax(), parts)
