# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that the seams of an edit mesh make, and its active UV map.

Functions raise ValueError or NativeError where no face is visible, a coordinate is no number, or the compiled part is missing.
"""

from __future__ import annotations

import colorsys
from typing import TYPE_CHECKING, NamedTuple

import bmesh
import bpy
import numpy as np

from ..core.base import native
from ..core.base.geometry import area_normals
from ..core.islands.islands import HUES, PLACES
from ..core.islands.uv_maps import Corners, MappedSurface, Stretch
from . import edit_mesh
from .registration import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays

ATTRIBUTE = "island"
"""The face attribute that islands are stored as."""


def _read(obj: bpy.types.Object) -> tuple[Arrays, NDArray[np.int32]]:
    """Read an edit mesh and its islands. Raise `edit_mesh.NothingVisibleError` where no face is visible."""
    arrays = edit_mesh.read(obj)
    if not len(arrays.triangles):
        raise edit_mesh.NothingVisibleError(obj)
    return arrays, labels_of(arrays)


def labels_of(arrays: Arrays) -> NDArray[np.int32]:
    """Return the island of each triangle, (m,): 0, 1, ..., largest first."""
    return np.asarray(native.load().face_segments(arrays.surface, arrays.seams))


def count_islands(obj: bpy.types.Object) -> int:
    arrays = edit_mesh.read(obj)
    return int(labels_of(arrays).max(initial=-1)) + 1 if len(arrays.triangles) else 0


def faces_to_cut(obj: bpy.types.Object) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the faces of islands that need more cuts, as closed islands, handles and tubes do, and how many cuts each needs."""
    arrays, labels = _read(obj)
    missing = np.asarray(native.load().missing_cuts(arrays.surface, arrays.seams, labels))
    return np.unique(arrays.polygons[missing[labels] > 0]), missing[missing > 0]


def store(obj: bpy.types.Object, kind: str) -> int:
    """Store the island of each visible face with an edit mesh; return how many there are.

    The kind ``ATTRIBUTE`` is the face attribute `ATTRIBUTE`, from 0, largest first. ``MATERIALS`` are materials in new slots, with
    different hues for neighbors. Hidden faces keep their values. Without a value they get -1, or an empty slot. Raises ValueError if the
    attribute's name is taken.
    """
    arrays, labels = _read(obj)
    polygons, first = np.unique(arrays.polygons, return_index=True)
    numbers = labels
    if kind == "MATERIALS":
        hues = np.asarray(native.load().island_hues(arrays.triangles, labels, arrays.seams))
        if not obj.data.materials and len(polygons) < len(edit_mesh.edit_bmesh(obj.data).faces):
            obj.data.materials.append(None)
        slot_of = {hue: _material_slot(obj, hue) for hue in np.unique(hues).tolist()}
        numbers = np.array([slot_of[hue] for hue in hues.tolist()])[labels]
    bm = edit_mesh.edit_bmesh(obj.data)
    layer = _face_layer(obj, bm) if kind == "ATTRIBUTE" else None
    for face, number in zip(polygons.tolist(), numbers[first].tolist(), strict=True):
        if layer is None:
            bm.faces[face].material_index = number
        else:
            bm.faces[face][layer] = number
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
    return int(labels.max()) + 1


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


def _material_slot(obj: bpy.types.Object, hue: int) -> int:
    name, materials = f"Seamwire Island {hue + 1}", obj.data.materials
    material = bpy.data.materials.get(name)
    if material is None:
        material = bpy.data.materials.new(name)
        material.diffuse_color = (*colorsys.hsv_to_rgb(PLACES[hue] / HUES, 0.6, 0.8), 1.0)
    if materials.find(name) < 0:
        materials.append(material)
        return len(materials) - 1
    return materials.find(name)


class Worst(NamedTuple):
    value: float  # octaves, see `Stretch`
    faces: NDArray[np.int32]
    count: int  # of all islands of the mesh
    facing: NDArray[np.float64]  # (3,) mean direction in object coordinates; its length is projected area / area


def worst_island(obj: bpy.types.Object, kind: str) -> Worst | None:
    """Find the island of an edit mesh that is stretched most by ``ANGLE`` or ``AREA``; None: it has no UV map."""
    arrays, labels = _read(obj)
    stretch = stretch_of(obj, arrays)
    if stretch is None:
        return None
    values, _ = stretch.islands(labels, kind)
    number = int(values.argmax())
    rows = labels == number
    normals = area_normals(arrays.in_object, arrays.triangles[rows])
    facing = normals.sum(axis=0) / max(float(np.linalg.norm(normals, axis=1).sum()), 1e-300)
    return Worst(float(values[number]), np.unique(arrays.polygons[rows]), len(values), facing)


def stretch_of(obj: bpy.types.Object, arrays: Arrays) -> Stretch | None:
    """Return how much the active UV map of an edit mesh stretches faces, without the object's scale. None without UVs or faces."""
    corners, uvs = read_map(obj)
    if uvs is None or not len(arrays.triangles):
        return None
    stretch = Stretch(arrays.in_object, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
    stretch.update(uvs)
    return stretch


def mapped(obj: bpy.types.Object) -> MappedSurface | None:
    try:
        arrays = edit_mesh.read(obj)
    except edit_mesh.NothingVisibleError:
        return None
    corners, uvs = read_map(obj)
    if uvs is None or not len(arrays.triangles):
        return None
    surface = arrays.in_object, arrays.triangles, labels_of(arrays), uvs[corners.of_triangles(arrays)], arrays.edges
    return MappedSurface(*surface, obj.name_full, to_scene(obj))


def maps_of(objects: Iterable[bpy.types.Object]) -> dict[bpy.types.Object, MappedSurface]:
    return {obj: found for obj in objects if (found := mapped(obj)) is not None}


def to_scene(obj: bpy.types.Object) -> NDArray[np.float64]:
    """Return the matrix, (3, 3), from object coordinates to the axes of the scene."""
    return np.array(obj.matrix_world.to_3x3(), dtype=np.float64)


def corners_of(data: bpy.types.Mesh) -> Corners:
    vertices, edges = (edit_mesh.column(data.loops, name, np.int32) for name in ("vertex_index", "edge_index"))
    starts = edit_mesh.column(data.polygons, "loop_start", np.int32)
    return Corners(vertices, edges, np.diff(starts, append=len(vertices)))


def uvs_of(data: bpy.types.Mesh) -> NDArray[np.float32] | None:
    """Return the places of the corners in the active UV map, (c, 2); None: there is no UV map."""
    layer = data.uv_layers.active
    if layer is None:
        return None
    return edit_mesh.column(*((layer.data, "uv") if IS_OLD else (layer.uv, "vector")), np.float32, 2)


def pinned_of(data: bpy.types.Mesh) -> NDArray[np.bool_]:
    layer, count = data.uv_layers.active, len(data.loops)
    # The attribute of newer versions is empty while nothing is pinned.
    items, name = ((), "") if layer is None else (layer.data, "pin_uv") if IS_OLD else (layer.pin, "value")
    return edit_mesh.column(items, name, np.bool_) if count and len(items) == count else np.zeros(count, dtype=bool)


def read_map(obj: bpy.types.Object) -> tuple[Corners, NDArray[np.float32] | None]:
    obj.update_from_editmode()
    with edit_mesh.copied(obj.data) as data:
        return corners_of(data), uvs_of(data)


def read_uvs(obj: bpy.types.Object) -> NDArray[np.float32] | None:
    """Read the places of an edit mesh's corners in the active UV map, (c, 2); None: there is no UV map."""
    obj.update_from_editmode()
    with edit_mesh.copied(obj.data) as data:
        return uvs_of(data)


def aspect(obj: bpy.types.Object) -> float:
    """Return width / height of the image that Blender unwraps for, in the material of the active or first face. 1 without an image."""
    bm = edit_mesh.edit_bmesh(obj.data)
    if not len(bm.faces):
        return 1.0
    number = (bm.faces.active or bm.faces[0]).material_index
    material = obj.material_slots[number].material if number < len(obj.material_slots) else None
    nodes = () if material is None or material.node_tree is None else material.node_tree.nodes
    shown = (node for node in nodes if node.type == "TEX_IMAGE" and node.show_texture and node.image)
    image = next(shown, None)
    if image is None:
        return 1.0
    (width, height), (wide, tall) = image.image.size, image.image.display_aspect
    return (width * wide) / (height * tall) if width and height else 1.0
