# SPDX-License-Identifier: GPL-3.0-or-later
"""The active UV map of an edit mesh as arrays."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.islands.uv_islands import Corners
from . import edit_mesh
from .versions import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray


def corners_of(data: bpy.types.Mesh) -> Corners:
    """Read the corners of a mesh that edit mode does not hold."""
    vertices, edges = (edit_mesh.column(data.loops, name, np.int32) for name in ("vertex_index", "edge_index"))
    starts = edit_mesh.column(data.polygons, "loop_start", np.int32)
    return Corners(vertices, edges, np.diff(starts, append=len(vertices)))


def read(obj: bpy.types.Object) -> tuple[Corners, NDArray[np.float32] | None]:
    """Read the corners of an edit mesh, and their UVs as `read_uvs` does."""
    with copied(obj) as data:
        return corners_of(data), uvs_of(data)


def read_uvs(obj: bpy.types.Object) -> NDArray[np.float32] | None:
    """Read the places of an edit mesh's corners in the active UV map, (c, 2); None: there is no UV map."""
    with copied(obj) as data:
        return uvs_of(data)


@contextmanager
def copied(obj: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """Copy the mesh, which itself shows no UVs in edit mode; in newer versions a copy shares the data and costs nothing."""
    obj.update_from_editmode()
    data = obj.data.copy()
    try:
        yield data
    finally:
        bpy.data.meshes.remove(data)


def aspect(obj: bpy.types.Object) -> float:
    """Return width / height of the image that Blender unwraps for, in the material of the active or first face. 1 without an image."""
    bm = edit_mesh.edit_bmesh(obj.data)
    if not len(bm.faces):
        return 1.0
    number = (bm.faces.active or bm.faces[0]).material_index
    material = obj.material_slots[number].material if number < len(obj.material_slots) else None
    if material is None or material.node_tree is None:
        return 1.0
    shown = (node for node in material.node_tree.nodes if node.type == "TEX_IMAGE" and node.show_texture and node.image)
    image = next(shown, None)
    if image is None:
        return 1.0
    (width, height), (wide, tall) = image.image.size, image.image.display_aspect
    return (width * wide) / (height * tall) if width and height else 1.0


def uvs_of(data: bpy.types.Mesh) -> NDArray[np.float32] | None:
    """Return the places of the corners in the active UV map, (c, 2); None: there is no UV map."""
    layer = data.uv_layers.active
    if layer is None:
        return None
    return edit_mesh.column(*((layer.data, "uv") if IS_OLD else (layer.uv, "vector")), np.float32, 2)


def pinned_of(data: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Return which corners are pinned, (c,)."""
    layer, count = data.uv_layers.active, len(data.loops)
    # The attribute of newer versions is empty while nothing is pinned.
    items, name = ((), "") if layer is None else (layer.data, "pin_uv") if IS_OLD else (layer.pin, "value")
    return edit_mesh.column(items, name, np.bool_) if count and len(items) == count else np.zeros(count, dtype=bool)
