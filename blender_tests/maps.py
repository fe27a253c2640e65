# SPDX-License-Identifier: GPL-3.0-or-later
"""How good UV maps are, measured without the add-on."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray


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


def flipped(obj: bpy.types.Object) -> int:
    """Return how many triangles with area are turned over in the map, or have no area there."""
    uvs, corners = triangles(obj)
    return int(((signed_areas(uvs) <= 0.0) & (areas(corners) > 1e-9)).sum())


def covered_twice(*objects: bpy.types.Object, samples: int = 3000) -> int:
    """Return how many of some places in the maps of objects, taken together, lie well within two triangles or more."""
    uvs = np.concatenate([triangles(obj)[0] for obj in objects])
    area = signed_areas(uvs)
    uvs = uvs[area != 0.0]
    area = area[area != 0.0]
    dice = np.random.default_rng(4)
    chosen = dice.choice(len(uvs), samples, p=np.abs(area) / np.abs(area).sum())
    weights = dice.dirichlet((1.0, 1.0, 1.0), samples)
    places = (weights[:, :, None] * uvs[chosen]).sum(axis=1)
    count = np.zeros(samples, dtype=int)
    for corners, doubled in zip(uvs, 2.0 * area, strict=True):
        to_corners = corners - places[:, None]
        following = np.roll(to_corners, -1, axis=1)
        parts = (to_corners[..., 0] * following[..., 1] - to_corners[..., 1] * following[..., 0]) / doubled
        count += (parts > 1e-3).all(axis=1)
    return int((count > 1).sum())


_DEEP = 2e-7
"""Triangles that reach into each other by less, in the UV square, touch up to the rounding of single precision."""


def overlapping_pairs(*objects: bpy.types.Object) -> int:
    """Return how many pairs of triangles reach into each other in the maps of objects, taken together.

    Two triangles are apart if the line along a side of either parts them. Triangles without area in the map are left out.
    """
    uvs = np.concatenate([triangles(obj)[0] for obj in objects])
    area = signed_areas(uvs)
    uvs[area < 0.0] = uvs[area < 0.0][:, ::-1]
    uvs = uvs[area != 0.0]
    low, high = uvs.min(axis=1), uvs.max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    uvs, low, high = uvs[order], low[order], high[order]
    sides = np.roll(uvs, -1, axis=1) - uvs
    outwards = np.stack([sides[..., 1], -sides[..., 0]], axis=2) / np.linalg.norm(sides, axis=2)[..., None]
    reach = np.einsum("tij,tij->ti", outwards, uvs)
    ends = np.searchsorted(low[:, 0], high[:, 0] - _DEEP)
    found = 0
    for row, end in enumerate(ends.tolist()):
        near = np.arange(row + 1, end)
        near = near[(low[near, 1] < high[row, 1] - _DEEP) & (high[near, 1] > low[row, 1] + _DEEP)]
        from_own = np.einsum("ij,tkj->tik", outwards[row], uvs[near]).min(axis=2) - reach[row]
        from_others = np.einsum("tij,kj->tik", outwards[near], uvs[row]).min(axis=2) - reach[near]
        gap = np.maximum(from_own.max(axis=1), from_others.max(axis=1))
        found += int((gap < -_DEEP).sum())
    return found


def in_square(obj: bpy.types.Object) -> bool:
    """Whether the map lies in the UV square, up to rounding."""
    uvs, _ = triangles(obj)
    return bool(np.isfinite(uvs).all() and uvs.min() >= -1e-6 and uvs.max() <= 1.0 + 1e-6)


def energy(obj: bpy.types.Object, aspect: float = 1.0) -> float:
    """Return the symmetric Dirichlet energy of the map at its best scale, the mean over the area of the visible triangles.

    The worst triangles are left out, as far as they have 0.1 % of the area. `aspect` is the width over the height of the image that the
    map lies on.
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
        kept = order[np.cumsum(weights[order]) <= (1.0 - left_out + 1e-9) * weights.sum()]
        larger, smaller, weights = larger[kept], smaller[kept], weights[kept]
    return float(2.0 * np.sqrt((larger @ weights) * (smaller @ weights)) / weights.sum())
