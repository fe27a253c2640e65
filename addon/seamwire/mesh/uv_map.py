# SPDX-License-Identifier: GPL-3.0-or-later
"""The active UV map of an edit mesh as arrays, and islands of the same shape that lie on each other in it."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.islands.copies import ShapedIsland, find_copies
from . import edit_mesh
from .versions import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays


@dataclass(frozen=True)
class Corners:
    """The corners of a mesh's faces, face by face, hidden ones included.

    Parameters
    ----------
    vertices, edges
        (c,) the vertex of each, and the edge to the next corner of its face.
    faces
        (c,) the face that each belongs to, ascending.
    following
        (c,) the next corner of its face.
    """

    vertices: NDArray[np.int32]
    edges: NDArray[np.int32]
    faces: NDArray[np.int64]
    following: NDArray[np.int64]

    @classmethod
    def of(cls, mesh: bpy.types.Mesh) -> Corners:
        """Read them from a mesh that edit mode does not hold."""
        vertices, edges = (edit_mesh.column(mesh.loops, name, np.int32) for name in ("vertex_index", "edge_index"))
        starts = edit_mesh.column(mesh.polygons, "loop_start", np.int32)
        sizes = np.diff(starts, append=len(vertices))
        following = np.arange(1, len(vertices) + 1)
        following[starts + sizes - 1] = starts
        return cls(vertices, edges, np.repeat(np.arange(len(starts)), sizes), following)

    def of_triangles(self, arrays: Arrays) -> NDArray[np.int64]:
        """Return the corner that lies at each corner of the triangles, (m, 3)."""
        count = len(arrays.points)
        keys = self.faces * count + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = arrays.polygons[:, None].astype(np.int64) * count + arrays.triangles
        return order[np.searchsorted(keys, wanted.reshape(-1), sorter=order)].reshape(-1, 3)


@dataclass(frozen=True)
class EditedMap:
    """What unwrapping needs of an edit mesh, hidden faces included.

    Parameters
    ----------
    corners
        The corners of the faces.
    uvs
        (c, 2) their places in the active UV map; None: there is no UV map.
    pinned
        (c,) whether they are pinned.
    seams
        (e,) whether the edges are seams.
    numbers
        (e,) the values of the edges in a layer; zeros: there is no such layer.
    """

    corners: Corners
    uvs: NDArray[np.float32] | None
    pinned: NDArray[np.bool_]
    seams: NDArray[np.bool_]
    numbers: NDArray[np.int32]


def read_with_edges(obj: bpy.types.Object, layer: str) -> EditedMap:
    """Read an edit mesh, and what a layer of whole numbers holds of its edges."""
    with _copied(obj) as mesh:
        corners, uvs = Corners.of(mesh), _uvs(mesh)
        seams = edit_mesh.column(mesh.edges, "use_seam", np.bool_)
        attribute = mesh.attributes.get(layer)
        if attribute is not None and len(attribute.data) == len(seams):
            numbers = edit_mesh.column(attribute.data, "value", np.int32)
        else:
            numbers = np.zeros(len(seams), dtype=np.int32)
        return EditedMap(corners, uvs, _pinned(mesh), seams, numbers)


def read(obj: bpy.types.Object) -> tuple[Corners, NDArray[np.float32] | None]:
    """Read the corners of an edit mesh, and their UVs as `read_uvs` does."""
    with _copied(obj) as mesh:
        return Corners.of(mesh), _uvs(mesh)


def read_uvs(obj: bpy.types.Object) -> NDArray[np.float32] | None:
    """Read the places of an edit mesh's corners in the active UV map, (c, 2); None: there is no UV map."""
    with _copied(obj) as mesh:
        return _uvs(mesh)


@contextmanager
def _copied(obj: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """Copy the mesh, which itself shows no UVs in edit mode; in newer versions a copy shares the data and costs nothing."""
    obj.update_from_editmode()
    mesh = obj.data.copy()
    try:
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)


def aspect(obj: bpy.types.Object) -> float:
    """Return the width over the height of the image that an edit mesh's UVs lie on, as Blender's unwrap takes it into account.

    It is the active image of the active face's material, or of the first face's; 1 without an image.
    """
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


def _uvs(mesh: bpy.types.Mesh) -> NDArray[np.float32] | None:
    layer = mesh.uv_layers.active
    if layer is None:
        return None
    return edit_mesh.column(*((layer.data, "uv") if IS_OLD else (layer.uv, "vector")), np.float32, 2)


def _pinned(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    layer, count = mesh.uv_layers.active, len(mesh.loops)
    # The attribute of newer versions is empty while nothing is pinned.
    items, name = ((), "") if layer is None else (layer.data, "pin_uv") if IS_OLD else (layer.pin, "value")
    return edit_mesh.column(items, name, np.bool_) if count and len(items) == count else np.zeros(count, dtype=bool)


@dataclass(frozen=True)
class Stack:
    """Copies of islands, and where they lie.

    Parameters
    ----------
    copies
        The islands of each object that lie on other islands.
    places
        Of each object corners of its copies, and the objects and corners on which they lie.
    """

    copies: Mapping[bpy.types.Object, NDArray[np.int64]]
    places: Mapping[bpy.types.Object, Sequence[tuple[NDArray[np.int64], bpy.types.Object, NDArray[np.int64]]]]

    def uvs(self) -> dict[bpy.types.Object, tuple[NDArray[np.int64], NDArray[np.float64]]]:
        """Return the corners of all copies, ascending, with the UVs of the islands that they lie on."""
        below = dict.fromkeys(obj for own in self.places.values() for _, obj, _ in own)
        present = {obj: read_uvs(obj) for obj in below}
        found = {}
        for obj, own in self.places.items():
            corners = np.concatenate([mine for mine, _, _ in own])
            uvs = np.concatenate([present[other][theirs] for _, other, theirs in own]).astype(np.float64)
            order = np.argsort(corners)
            found[obj] = corners[order], uvs[order]
        return found


def stacked(islands: Sequence[tuple[bpy.types.Object, ShapedIsland]]) -> Stack:
    """Lay copies on the first island of their shape. The islands lie on images of one shape."""
    copies: dict[bpy.types.Object, list[int]] = {}
    places: dict[bpy.types.Object, list[tuple[NDArray[np.int64], bpy.types.Object, NDArray[np.int64]]]] = {}
    for number, (first, corners) in enumerate(find_copies([island.shape for _, island in islands])):
        if first == number:
            continue
        (obj, island), (other, below) = islands[number], islands[first]
        copies.setdefault(obj, []).append(island.label)
        places.setdefault(obj, []).append((island.corners, other, below.corners[corners]))
    return Stack({obj: np.array(labels) for obj, labels in copies.items()}, places)
