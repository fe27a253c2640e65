# SPDX-License-Identifier: GPL-3.0-or-later
"""How good UV maps are, measured without the add-on."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

ROUNDING = 2e-7
"""Single precision moves each corner of a triangle by up to 4e-8 in the UV square. So its height may change by twice that, at least."""


def triangles(obj: bpy.types.Object) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the visible triangles of an edit mesh: their UVs, (m, 3, 2), and their corners, (m, 3, 3)."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    loops = [each for each in bm.calc_loop_triangles() if not each[0].face.hide]
    uvs = np.array([[loop[layer].uv[:] for loop in each] for each in loops], dtype=np.float64)
    return uvs.reshape(-1, 3, 2), np.array([[loop.vert.co[:] for loop in each] for each in loops]).reshape(-1, 3, 3)


def signed_areas(uvs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the areas of triangles, (m, 3, 2), negative for clockwise ones."""
    one, two = uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]
    return 0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the areas of triangles in space, (m, 3, 3)."""
    return 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)


def on_line(uvs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which triangles of a map, (m, 3, 2), are lower than the rounding of UVs in single precision."""
    longest = np.linalg.norm(uvs - np.roll(uvs, 1, axis=1), axis=2).max(axis=1)
    return 2.0 * np.abs(signed_areas(uvs)) <= ROUNDING * longest


def flipped(obj: bpy.types.Object) -> int:
    """Return how many triangles with area are turned over in the map, or have no area there."""
    uvs, corners = triangles(obj)
    return int(((signed_areas(uvs) <= 0.0) & (areas(corners) > 1e-9)).sum())


def overlapping_pairs(*objects: bpy.types.Object, deep: float = 2e-7) -> int:
    """Return `overlaps` of the maps of objects, taken together."""
    return overlaps(np.concatenate([triangles(obj)[0] for obj in objects]), deep)


def overlaps(uvs: NDArray[np.float64], deep: float = 2e-7) -> int:
    """Return how many pairs of triangles, (m, 3, 2), reach into each other.

    Two triangles are apart if the line along a side of either parts them. Triangles that lie on a line in the map cover nothing twice
    and are left out. Triangles that reach into each other by less than `deep`, in the UV square, touch up to the rounding of single
    precision.
    """
    area = signed_areas(uvs)
    uvs = uvs.copy()
    uvs[area < 0.0] = uvs[area < 0.0][:, ::-1]
    uvs = uvs[~on_line(uvs)]
    low, high = uvs.min(axis=1), uvs.max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    uvs, low, high = uvs[order], low[order], high[order]
    sides = np.roll(uvs, -1, axis=1) - uvs
    outwards = np.stack([sides[..., 1], -sides[..., 0]], axis=2) / np.linalg.norm(sides, axis=2)[..., None]
    reach = np.einsum("tij,tij->ti", outwards, uvs)
    ends = np.searchsorted(low[:, 0], high[:, 0] - deep)
    found = 0
    for row, end in enumerate(ends.tolist()):
        near = np.arange(row + 1, end)
        near = near[(low[near, 1] < high[row, 1] - deep) & (high[near, 1] > low[row, 1] + deep)]
        from_own = np.einsum("ij,tkj->tik", outwards[row], uvs[near]).min(axis=2) - reach[row]
        from_others = np.einsum("tij,kj->tik", outwards[near], uvs[row]).min(axis=2) - reach[near]
        gap = np.maximum(from_own.max(axis=1), from_others.max(axis=1))
        found += int((gap < -deep).sum())
    return found


def in_square(obj: bpy.types.Object) -> bool:
    """Whether the map lies in the UV square, up to rounding."""
    uvs, _ = triangles(obj)
    return bool(np.isfinite(uvs).all() and uvs.min() >= -1e-6 and uvs.max() <= 1.0 + 1e-6)


def energy(obj: bpy.types.Object, aspect: float = 1.0) -> float:
    """Return the symmetric Dirichlet energy of the map at its best scale, the mean over the area of the visible triangles.

    The worst 0.1 % of the area is left out. `aspect` is the width over the height of the image that the map lies on.
    """
    uvs, corners = triangles(obj)
    weights = areas(corners)
    uvs, corners, weights = uvs[weights > 1e-9] * (aspect, 1.0), corners[weights > 1e-9], weights[weights > 1e-9]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    length = np.linalg.norm(one, axis=1)
    along = np.einsum("ij,ij->i", one, two) / length
    height = 2.0 * weights / length
    flat = np.zeros((len(uvs), 2, 2))
    flat[:, 0, 0], flat[:, 0, 1], flat[:, 1, 1] = length, along, height
    mapped = np.stack([uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]], axis=2)
    values = np.linalg.svd(mapped @ np.linalg.inv(flat), compute_uv=False)
    with np.errstate(divide="ignore"):
        larger, smaller = (values**power for power in (2.0, -2.0))
    larger, smaller = larger.sum(axis=1), smaller.sum(axis=1)
    for left_out in (0.0, 0.001):
        square = np.sqrt(smaller @ weights / (larger @ weights))  # of the best scale
        order = np.argsort(square * larger + smaller / square)
        larger, smaller, weights = larger[order], smaller[order], weights[order]
        before = np.cumsum(weights) - weights
        weights = np.clip((1.0 - left_out) * weights.sum() - before, 0.0, weights)
        larger, smaller, weights = (values[weights > 0.0] for values in (larger, smaller, weights))
    return float(2.0 * np.sqrt((larger @ weights) * (smaller @ weights)) / weights.sum())


def folded(obj: bpy.types.Object, least_height: float = 1e-6) -> int:
    """Return `folds` of the map of an edit mesh."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    loops = [each for each in bm.calc_loop_triangles() if not each[0].face.hide]
    vertices = np.array([[loop.vert.index for loop in each] for each in loops], dtype=np.int64).reshape(-1, 3)
    return folds(vertices, *triangles(obj), least_height)


def folds(
    vertices: NDArray[np.integer], uvs: NDArray[np.float64], corners: NDArray[np.float64], least_height: float = 1e-6
) -> int:
    """Return how many edges a map is folded at, plus the number of triangles without an area in it.

    The map is folded where two triangles are joined in it and lie on the same side of their common edge, whichever way their faces are
    turned. Triangles whose height is less than `least_height` of their longest side do not count. Nor do triangles that lie on a line in
    the map and would be lower than `least_height` there at the map's mean scale, or triangles smaller than the rounding of UVs.

    Parameters
    ----------
    vertices, uvs, corners
        (m, 3), (m, 3, 2), (m, 3, 3) of each triangle.
    least_height
        See above.
    """
    if not len(vertices):
        return 0
    on_model = areas(corners)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    size = np.ptp(corners.reshape(-1, 3), axis=0).max()
    scale = np.sqrt(np.abs(signed_areas(uvs)).sum() / on_model.sum()) if on_model.any() else 0.0
    counts = (2.0 * on_model > least_height * longest**2) & (longest >= 1e-5 * size)
    counts &= ~on_line(uvs) | (2.0 * scale * on_model > least_height * longest)
    vertices, uvs = vertices[counts], uvs[counts]
    area = signed_areas(uvs)
    ends = np.stack([vertices, np.roll(vertices, -1, axis=1)], axis=2).reshape(-1, 2)
    places = np.stack([uvs, np.roll(uvs, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    is_down = ends[:, 0] > ends[:, 1]
    ends[is_down], places[is_down] = ends[is_down][:, ::-1], places[is_down][:, ::-1]
    sides = np.repeat(area, 3) * np.where(is_down, -1.0, 1.0)
    # Sides of triangles are joined in the map where both ends agree. Where more than two are, which lie where cannot be told.
    keys = np.column_stack([ends, places.reshape(-1, 4)])
    _, numbers, joined = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    numbers = numbers.ravel()
    above, below = (np.bincount(numbers, is_there, len(joined)) for is_there in (sides > 0.0, sides < 0.0))
    return int((area == 0.0).sum() + ((joined == 2) & ((above == 2) | (below == 2))).sum())
