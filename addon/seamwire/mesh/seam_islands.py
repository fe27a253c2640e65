# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that the seams of an edit mesh make: which need more cuts, how stretched each is in its UV map, and how they are stored.

Functions raise ValueError or NativeError where no face is visible, a coordinate is no number, or the compiled part is missing.
"""

from __future__ import annotations

import colorsys
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ..core.base import native
from ..core.base.geometry import area_normals
from ..core.islands.islands import HUES, PLACES
from ..core.islands.map_faults import MappedSurface
from ..core.islands.square_use import MapInScene
from ..core.islands.stretch import Stretch
from . import edit_mesh, uv_map

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays

ATTRIBUTE = "island"
"""The face attribute that islands are stored as."""


def read(obj: bpy.types.Object) -> Arrays:
    """Read the edit mesh of an object; raises `edit_mesh.NothingVisibleError` where no face is visible."""
    arrays = edit_mesh.read(obj)
    if not len(arrays.triangles):
        raise edit_mesh.NothingVisibleError(obj)
    return arrays


def labels_of(arrays: Arrays) -> NDArray[np.int32]:
    """Return the island of each triangle, (m,): 0, 1, ..., largest first."""
    return np.asarray(native.load().face_segments(arrays.surface, arrays.seams))


def count_islands(obj: bpy.types.Object) -> int:
    arrays = edit_mesh.read(obj)
    return int(labels_of(arrays).max(initial=-1)) + 1 if len(arrays.triangles) else 0


def faces_to_cut(obj: bpy.types.Object) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the faces of the islands that need more cuts, and how many cuts each of these islands needs.

    Closed islands, handles and tubes need cuts. Holes in nearly flat places may stay.
    """
    arrays = read(obj)
    labels = labels_of(arrays)
    missing = np.asarray(native.load().missing_cuts(arrays.surface, arrays.seams, labels))
    return np.unique(arrays.polygons[missing[labels] > 0]), missing[missing > 0]


def store(obj: bpy.types.Object, kind: str) -> int:
    """Store the island of each visible face with an edit mesh; return how many there are.

    The kind ``ATTRIBUTE`` is the face attribute `ATTRIBUTE`, from 0, largest first. ``MATERIALS`` are materials in new slots, with
    different hues for neighbors. Hidden faces keep their values. Without a value they get -1, or an empty slot. Raises ValueError if the
    attribute's name is taken.
    """
    arrays = read(obj)
    labels = labels_of(arrays)
    count = int(labels.max(initial=-1)) + 1
    polygons, first = np.unique(arrays.polygons, return_index=True)
    if kind == "MATERIALS":
        hues = np.asarray(native.load().island_hues(arrays.triangles, labels, arrays.seams))
        if not obj.data.materials and len(polygons) < len(edit_mesh.edit_bmesh(obj.data).faces):
            obj.data.materials.append(None)
        numbers = np.array(_material_slots(obj, sorted(set(hues.tolist()))))[hues[labels]]
    else:
        numbers = labels
    bm = edit_mesh.edit_bmesh(obj.data)
    layer = _face_layer(obj, bm) if kind == "ATTRIBUTE" else None
    for face, number in zip(polygons.tolist(), numbers[first].tolist(), strict=True):
        if layer is None:
            bm.faces[face].material_index = number
        else:
            bm.faces[face][layer] = number
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
    return count


def _face_layer(obj: bpy.types.Object, bm: bmesh.types.BMesh) -> bmesh.types.BMLayerItem:
    """Return the layer for the numbers of islands. Raise ValueError if an attribute of another kind has its name."""
    layer = bm.faces.layers.int.get(ATTRIBUTE)
    if layer is not None:
        return layer
    other = obj.data.attributes.get(ATTRIBUTE)
    if other is not None:
        kind = f"{other.domain.lower()}, {other.data_type.lower().replace('_', ' ')}"
        raise ValueError(f"{obj.name} has an attribute {ATTRIBUTE!r} of another kind ({kind}): rename it")
    layer = bm.faces.layers.int.new(ATTRIBUTE)
    for face in bm.faces:
        face[layer] = -1
    return layer


def _material_slots(obj: bpy.types.Object, hues: list[int]) -> list[int]:
    """Return the slot of the material of each hue; -1 for hues that are not used."""
    slots = [-1] * HUES
    for hue in hues:
        name = f"Seamwire Island {hue + 1}"
        material = bpy.data.materials.get(name)
        if material is None:
            material = bpy.data.materials.new(name)
            material.diffuse_color = (*colorsys.hsv_to_rgb(PLACES[hue] / HUES, 0.6, 0.8), 1.0)
        slots[hue] = obj.data.materials.find(name)
        if slots[hue] < 0:
            obj.data.materials.append(material)
            slots[hue] = len(obj.data.materials) - 1
    return slots


@dataclass(frozen=True)
class Worst:
    """An island that is stretched."""

    value: float  # octaves, see `Stretch`
    faces: NDArray[np.int32]
    count: int  # of all islands of the mesh
    facing: NDArray[np.float64]  # (3,) mean direction in object coordinates; its length is projected area / area


def worst_island(obj: bpy.types.Object, kind: str) -> Worst | None:
    """Find the island of an edit mesh that is stretched most by ``ANGLE`` or ``AREA``; None: it has no UV map."""
    arrays = read(obj)
    labels = labels_of(arrays)
    stretch = stretch_of(obj, arrays)
    if stretch is None:
        return None
    values, _ = stretch.islands(labels, kind)
    number = int(values.argmax())
    rows = labels == number
    normals = area_normals(arrays.in_object, arrays.triangles[rows])
    facing = normals.sum(axis=0) / max(float(np.linalg.norm(normals, axis=1).sum()), 1e-300)
    return Worst(float(values[number]), np.unique(arrays.polygons[rows]), len(values), facing)


def mapped(obj: bpy.types.Object) -> MappedSurface | None:
    """Read the visible faces of an edit mesh with their places in its active UV map; None if there are no UVs or no visible faces."""
    try:
        arrays = edit_mesh.read(obj)
    except edit_mesh.NothingVisibleError:
        return None
    corners, uvs = uv_map.read(obj)
    if uvs is None or not len(arrays.triangles):
        return None
    own = uvs[corners.of_triangles(arrays)]
    return MappedSurface(arrays.in_object, arrays.triangles, labels_of(arrays), own, arrays.edges)


def maps_of(objects: Iterable[bpy.types.Object]) -> dict[bpy.types.Object, MappedSurface]:
    """Read those of the edit meshes that have a map."""
    return {obj: found for obj in objects if (found := mapped(obj)) is not None}


def to_scene(obj: bpy.types.Object) -> NDArray[np.float64]:
    """Return the matrix, (3, 3), from object coordinates to the axes of the scene."""
    return np.array(obj.matrix_world.to_3x3(), dtype=np.float64)


def in_scene(maps: Mapping[bpy.types.Object, MappedSurface]) -> list[MapInScene]:
    """Return the maps of objects with the names and directions of these."""
    return [MapInScene(obj.name_full, found, to_scene(obj)) for obj, found in maps.items()]


def stretch_of(obj: bpy.types.Object, arrays: Arrays) -> Stretch | None:
    """Return how much the active UV map of an edit mesh stretches faces, without the object's scale. None without UVs or faces."""
    corners, uvs = uv_map.read(obj)
    if uvs is None or not len(arrays.triangles):
        return None
    stretch = Stretch(arrays.in_object, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
    stretch.update(uvs)
    return stretch
