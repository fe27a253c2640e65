# SPDX-License-Identifier: GPL-3.0-or-later
"""What a UV map of a model is worth, in numbers.

Lengths are divided by the square root of the surface's area. Seams and the surface are sampled evenly, and distances between seams are
those of the samples. `Measures` says what each number is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import seamwire_core as sw
from scipy.spatial import cKDTree
from uv_maps import Model, UvMap, triangle_areas
from uv_rasters import coverage

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]
    Bools = NDArray[np.bool_]

VIEWS = 20
"""Views of the front hemisphere by which visibility is measured."""

_SEAM_STEP = 0.004
"""Distance between samples of a seam, of the diagonal."""
_NEAR_ARTIST = 0.015
"""A seam this near to the artist's is there too, of the diagonal."""
_NEAR_MIRRORED = 0.01
"""A seam this near to the mirror image of another one is mirrored, of the diagonal."""
_SYMMETRIC = 0.012
"""A model is symmetric if 95 % of its surface is this near to its mirror image, of the diagonal."""
_SEEN_THROUGH = 0.012
"""Surface less than this far in front of a point does not hide it, of the model's radius: seams lie in grooves of the mesh itself."""
_SURFACE_SAMPLES = 60_000
_PROBES = 8_000
_SYMMETRY_PROBES = 4_000
_SHARP = np.radians(30.0)
_TINY = 0.001
_WORST = 0.001
_MOST_OCTAVES = 5.0
"""A triangle counts as stretched 32 times at most, so that a triangle without any UV area does not outweigh all others."""
_PACKING_PIXELS = 1024
_STACKED = 0.005
"""A layout in which more than this share of the covered pixels is covered twice is not packed."""


@dataclass
class Measures:
    """The numbers for one map of one model. None: the number does not exist, for instance without an artist."""

    islands: int
    seam: float
    """Length of the seams over the square root of the area."""
    energy: float
    """Symmetric Dirichlet energy (Smith and Schaefer 2015): see `symmetric_dirichlet_energy`."""
    density: float
    """Texel density that 95 % of the area reach, relative to the mean over the area."""
    angles: float
    """Mean stretch of angles: see `stretch`."""
    areas: float
    """Mean stretch of areas: see `stretch`."""
    angles_most: float
    """Stretch of angles that 95 % of the area keep within."""
    areas_most: float
    """Stretch of areas that 95 % of the area keep within."""
    visibility: float | None
    """Share of the views that see the seam, over the same share of the whole surface."""
    mirrored: float | None
    """Share of the seam whose mirror image is seam as well."""
    precision: float | None
    """Share of the seam near the artist's."""
    recall: float | None
    """Share of the artist's seam near the seam."""
    chance: float | None
    """Share of the surface near the artist's seam: what precision is by chance."""
    sharp: float | None
    """Share of the seam on edges sharper than 30 degrees."""
    sharp_edges: float
    """Share of such edges among all edges, by length."""
    tiny: int
    """Islands of less than .1 % of the area."""
    loose_ends: int
    """Vertices inside the surface where exactly one seam edge ends."""
    overlap: float
    """Share of the area in islands' parts that the same island covers twice."""
    overlapping: int
    """Islands that cover a part of the plane twice."""
    flips: int
    """Triangles turned over against the larger part of their island."""
    packing: float | None
    """Covered share of the map's bounding box. None if islands lie on top of each other."""

    @property
    def lift(self) -> float | None:
        """(precision - chance) / (1 - chance)."""
        if self.precision is None or self.chance is None or self.chance >= 1:
            return None
        return (self.precision - self.chance) / (1 - self.chance)


class Reference:
    """The data that measuring any map of a model shares.

    Parameters
    ----------
    model
        The model. Its own triangles hide seams, also in views of a map that has other ones.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        self.samples = surface_samples(model.points, model.triangles, _SURFACE_SAMPLES)
        self.views = front_views(model.frame.axes)
        self.rays = sw.RayTree(model.points, model.triangles.astype(np.int32))
        self.rays.wait()

    @cached_property
    def mean_visibility(self) -> float:
        """The share of views that see a point of the surface, in the mean."""
        return float(self.visibility(self.samples[:_PROBES]).mean())

    def visibility(self, points: Floats) -> Floats:
        """Return the share of the front views that see each of the points (k, 3)."""
        low, high = self.model.points.min(axis=0), self.model.points.max(axis=0)
        radius = np.linalg.norm(self.model.points - (low + high) / 2, axis=1).max()
        seen = np.zeros(len(points))
        for view in self.views:
            direction = view.tolist()
            origins = (points + _SEEN_THROUGH * radius * view).tolist()
            seen += [self.rays.first_hit(origin, direction) is None for origin in origins]
        return seen / len(self.views)

    @cached_property
    def mirror_axis(self) -> int | None:
        """The axis to whose normal plane through the origin the surface is symmetric, if there is one."""
        tree, distances = cKDTree(self.samples), []
        for axis in range(3):
            mirrored = self.samples[:_SYMMETRY_PROBES] * np.where(np.arange(3) == axis, -1.0, 1.0)
            distances.append(np.quantile(tree.query(mirrored)[0], 0.95) / self.model.diagonal)
        best = int(np.argmin(distances))
        return best if distances[best] < _SYMMETRIC else None

    @cached_property
    def artist(self) -> tuple[Floats, Floats] | None:
        """Samples of the artist's seams (k, 3), and the length that each stands for (k,)."""
        if self.model.artist_seams is None or not len(self.model.artist_seams):
            return None
        return seam_samples(self.model.points, self.model.artist_seams, _SEAM_STEP * self.model.diagonal)

    @cached_property
    def chance(self) -> float | None:
        """The share of the surface near the artist's seams."""
        if self.artist is None:
            return None
        near = cKDTree(self.artist[0]).query(self.samples[:_PROBES])[0] < _NEAR_ARTIST * self.model.diagonal
        return float(near.mean())


def surface_samples(points: Floats, triangles: Integers, count: int, seed: int = 0) -> Floats:
    """Return points (count, 3) evenly spread over a surface at random."""
    random = np.random.default_rng(seed)
    areas = triangle_areas(points, triangles)
    chosen = random.choice(len(triangles), count, p=areas / areas.sum())
    along = random.random((count, 2))
    over = along.sum(axis=1) > 1
    along[over] = 1 - along[over]
    a, b, c = (points[triangles[chosen, k]] for k in range(3))
    return a + along[:, :1] * (b - a) + along[:, 1:] * (c - a)


def seam_samples(points: Floats, seams: Integers, step: float) -> tuple[Floats, Floats]:
    """Return points (k, 3) along edges, at most `step` apart, and the length that each stands for (k,)."""
    begin, end = points[seams[:, 0]], points[seams[:, 1]]
    lengths = np.linalg.norm(end - begin, axis=1)
    counts = np.maximum(1, np.ceil(lengths / step).astype(np.int64))
    edge = np.repeat(np.arange(len(seams)), counts)
    place = (np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts) + 0.5) / counts[edge]
    return begin[edge] + place[:, None] * (end - begin)[edge], (lengths / counts)[edge]


def front_views(axes: Floats, count: int = VIEWS) -> Floats:
    """Return directions (count, 3) towards viewers, evenly over the front hemisphere; axes (3, 3): right, up, front."""
    turn = np.pi * (3 - np.sqrt(5))
    index = np.arange(count) + 0.5
    height = 1 - index / count
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.cos(index * turn), across * np.sin(index * turn), height], axis=1) @ axes


def weighted_quantile(values: Floats, weights: Floats, share: float) -> float:
    """Return the value that the given share of the weight does not exceed."""
    order = np.argsort(values)
    summed = np.cumsum(weights[order])
    return float(np.interp(share * summed[-1], summed, values[order]))


def singular_values(uv_map: UvMap) -> tuple[Floats, Floats, Floats]:
    """Return the larger and smaller singular values of the map's Jacobian on each triangle, and its determinant, (m,) each."""
    a, b, c = (uv_map.points[uv_map.triangles[:, k]] for k in range(3))
    base = np.maximum(np.linalg.norm(b - a, axis=1), 1e-30)
    along = (b - a) / base[:, None]
    shift = ((c - a) * along).sum(axis=1)
    height = np.maximum(2 * triangle_areas(uv_map.points, uv_map.triangles) / base, 1e-30)
    first = (uv_map.uvs[:, 1] - uv_map.uvs[:, 0]) / base[:, None]
    second = (uv_map.uvs[:, 2] - uv_map.uvs[:, 0] - first * shift[:, None]) / height[:, None]
    determinant = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    squares = (first**2).sum(axis=1), (second**2).sum(axis=1)
    root = np.hypot((squares[0] - squares[1]) / 2, (first * second).sum(axis=1))
    larger = np.sqrt((squares[0] + squares[1]) / 2 + root)
    return larger, np.abs(determinant) / np.maximum(larger, 1e-30), determinant


def symmetric_dirichlet_energy(areas: Floats, larger: Floats, smaller: Floats) -> float:
    """Return the mean over the area of s1^2 + s2^2 + s1^-2 + s2^-2, at the uniform scale at which it is lowest.

    The worst .1 % of the area is left out. An isometry has 4 (Smith and Schaefer, Bijective parameterization with free boundaries, 2015,
    eq. 1). areas, larger and smaller are (m,): areas of triangles and singular values.
    """
    kept = (areas > 1e-9 * areas.mean()) & (larger > 0)
    areas, larger = areas[kept], larger[kept]
    smaller = np.maximum(smaller[kept], 1e-9 * larger)
    growth, shrinkage = larger**2 + smaller**2, larger**-2 + smaller**-2
    squared = np.sqrt((areas * shrinkage).sum() / (areas * growth).sum())
    each = squared * growth + shrinkage / squared
    kept = each <= weighted_quantile(each, areas, 1 - _WORST)
    areas, growth, shrinkage = areas[kept], growth[kept], shrinkage[kept]
    return float(2 * np.sqrt((areas * growth).sum() * (areas * shrinkage).sum()) / areas.sum())


def stretch(areas: Floats, larger: Floats, smaller: Floats) -> tuple[Floats, Floats]:
    """Return how much a map stretches the angles and the area of each triangle, (m,) each.

    The stretch of angles is how many times longer the map makes a triangle one way than the other. The stretch of areas is how many
    times larger or smaller it makes the triangle than the mean, which is the area of the whole map over that of the surface. Both are
    1 or more, and at most 32 (Sander, Snyder, Gortler, Hoppe, Texture mapping progressive meshes, 2001; Hormann and Greiner, MIPS,
    2000). areas, larger and smaller are (m,): areas of triangles and singular values.
    """
    growth = larger * smaller
    mean = (areas * growth).sum() / areas.sum()
    with np.errstate(divide="ignore", invalid="ignore"):
        octaves = np.log2(larger / smaller), np.abs(np.log2(growth / mean))
    angles, sizes = (2.0 ** np.minimum(np.nan_to_num(each, nan=np.inf), _MOST_OCTAVES) for each in octaves)
    return angles, sizes


def weighted_geometric_mean(values: Floats, weights: Floats) -> float:
    """Return the geometric mean of positive values."""
    return float(np.exp(np.average(np.log(values), weights=weights)))


def overlap(uv_map: UvMap, areas: Floats) -> tuple[float, int]:
    """Return the share of the area that islands cover twice themselves, and the number of these islands."""
    islands = uv_map.islands
    order = np.argsort(islands, kind="stable")
    twice, overlapping = 0.0, 0
    for faces in np.split(order, np.cumsum(np.bincount(islands))[:-1]):
        corners = uv_map.uvs[faces]
        extent = np.ptp(corners.reshape(-1, 2), axis=0)
        one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        size = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 2
        if len(faces) < 2 or size <= 0:
            continue
        pixels = min(400_000, max(20_000, 200 * len(faces)))
        scale = min(np.sqrt(pixels / size), 4000 / extent.max())
        width, height = np.ceil(extent * scale).astype(int) + 2
        counts = coverage((corners - corners.min(axis=(0, 1))) * scale + 1, width, height)
        covered, doubled = (counts > 0).sum(), (counts > 1).sum()
        if doubled > max(4, 2e-4 * covered):
            twice += areas[faces].sum() * doubled / covered
            overlapping += 1
    return float(twice / areas.sum()), overlapping


def packing(uv_map: UvMap) -> float | None:
    """Return the covered share of the map's bounding box, or None if islands lie on top of each other."""
    low = uv_map.uvs.min(axis=(0, 1))
    extent = np.ptp(uv_map.uvs.reshape(-1, 2), axis=0)
    if extent.min() <= 0:
        return None
    scale = (_PACKING_PIXELS - 2) / extent.max()
    counts = coverage((uv_map.uvs - low) * scale + 1, _PACKING_PIXELS, _PACKING_PIXELS)
    covered = (counts > 0).sum()
    if not covered or (counts > 1).sum() > _STACKED * covered:
        return None
    return float(covered / (extent * scale).astype(int).prod())


def sharp_shares(uv_map: UvMap) -> tuple[float | None, float]:
    """Return the share of sharp edges in the seams and among all inner edges, by length."""
    points, triangles, edges = uv_map.points, uv_map.triangles, uv_map.inner_edges
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    one, other = normals[edges.faces[:, 0]], normals[edges.faces[:, 1]]
    sharp = (one * other).sum(axis=1) < np.cos(_SHARP)
    lengths = np.linalg.norm(np.diff(points[edges.vertices], axis=1)[:, 0], axis=1)
    seam = lengths[edges.torn].sum()
    return (float(lengths[edges.torn & sharp].sum() / seam) if seam else None), float(
        lengths[sharp].sum() / lengths.sum()
    )


def flipped(islands: Integers, areas: Floats, determinant: Floats) -> int:
    """Return how many triangles are turned over against the larger part of their island."""
    facing = np.sign(np.bincount(islands, np.sign(determinant) * areas))
    return int(((np.sign(determinant) != facing[islands]) & (areas > 1e-9 * areas.sum())).sum())


def loose_ends(uv_map: UvMap) -> int:
    """Return the number of vertices inside the surface where exactly one seam edge ends."""
    edges = np.bincount(uv_map.seams.reshape(-1), minlength=len(uv_map.points))
    return int(((edges == 1) & ~uv_map.boundary_vertices).sum())


def measure(uv_map: UvMap, reference: Reference) -> Measures:
    """Measure a map of a model."""
    areas = triangle_areas(uv_map.points, uv_map.triangles)
    total, diagonal = areas.sum(), reference.model.diagonal
    larger, smaller, determinant = singular_values(uv_map)
    proper = areas > 1e-10 * total / len(areas)
    density = np.sqrt(np.abs(determinant)) / np.sqrt((areas * np.abs(determinant)).sum() / total)
    angles, sizes = stretch(areas[proper], larger[proper], smaller[proper])
    samples, lengths = seam_samples(uv_map.points, uv_map.seams, _SEAM_STEP * diagonal)
    seam, visibility, mirrored, precision, recall = lengths.sum(), None, None, None, None
    if seam:
        visibility = float((reference.visibility(samples) * lengths).sum() / seam / reference.mean_visibility)
        tree = cKDTree(samples)
        if reference.mirror_axis is not None:
            images = samples * np.where(np.arange(3) == reference.mirror_axis, -1.0, 1.0)
            mirrored = float(lengths[tree.query(images)[0] < _NEAR_MIRRORED * diagonal].sum() / seam)
        if reference.artist is not None:
            artist, artist_lengths = reference.artist
            near = _NEAR_ARTIST * diagonal
            precision = float(lengths[cKDTree(artist).query(samples)[0] < near].sum() / seam)
            recall = float(artist_lengths[tree.query(artist)[0] < near].sum() / artist_lengths.sum())
    sharp, sharp_edges = sharp_shares(uv_map)
    twice, overlapping = overlap(uv_map, areas)
    return Measures(
        islands=int(uv_map.islands.max()) + 1,
        seam=float(seam / np.sqrt(total)),
        energy=symmetric_dirichlet_energy(areas, larger, smaller),
        density=weighted_quantile(density[proper], areas[proper], 0.05),
        angles=weighted_geometric_mean(angles, areas[proper]),
        areas=weighted_geometric_mean(sizes, areas[proper]),
        angles_most=weighted_quantile(angles, areas[proper], 0.95),
        areas_most=weighted_quantile(sizes, areas[proper], 0.95),
        visibility=visibility,
        mirrored=mirrored,
        precision=precision,
        recall=recall,
        chance=reference.chance,
        sharp=sharp,
        sharp_edges=sharp_edges,
        tiny=int((np.bincount(uv_map.islands, areas) < _TINY * total).sum()),
        loose_ends=loose_ends(uv_map),
        overlap=twice,
        overlapping=overlapping,
        flips=flipped(uv_map.islands, areas, determinant),
        packing=packing(uv_map),
    )
