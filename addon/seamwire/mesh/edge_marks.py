# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's other marks of edges, given to seams."""

from __future__ import annotations

import bmesh
import bpy

from .edit_mesh import Selection, edit_bmesh

_ATTRIBUTES = {"CREASE": ("crease", "float"), "BEVEL": ("bevel_weight", "float"), "FREESTYLE": ("freestyle", "bool")}
"""The layer of each mark, and of which type the attribute of that name with _edge is, in Blenders that have one."""


def copy_seams(objects: list[bpy.types.Object], kind: str) -> int:
    """Mark the visible seams of meshes in edit mode as something else too; what is marked so already stays.

    Parameters
    ----------
    objects
        All mesh objects in edit mode, one of each mesh.
    kind
        'SHARP', 'CREASE', 'BEVEL' (both with weight 1) or 'FREESTYLE'.

    Returns
    -------
    int
        How many edges are marked.
    """
    marked = 0
    by_operator = []
    for obj in objects:
        bm = edit_bmesh(obj.data)
        # A new layer makes other items of the edges, so it comes first.
        layer = None if kind == "SHARP" else _layer(bm, kind)
        seams = _seams(bm)
        marked += len(seams)
        if kind == "FREESTYLE" and hasattr(bm.edges.layers, "freestyle"):
            by_operator.append(obj)  # Python cannot write this layer
            continue
        for edge in seams:
            if layer is None:
                edge.smooth = False
            else:
                edge[layer] = True if kind == "FREESTYLE" else 1.0
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
    if by_operator and marked:
        _mark_freestyle(by_operator)
    return marked


def _seams(bm: bmesh.types.BMesh) -> list[bmesh.types.BMEdge]:
    return [edge for edge in bm.edges if edge.seam and not edge.hide]


def _layer(bm: bmesh.types.BMesh, kind: str) -> bmesh.types.BMLayerItem:
    """Return the layer of a mark. In newer versions of Blender, it is a generic attribute."""
    layers, (name, of_type) = bm.edges.layers, _ATTRIBUTES[kind]
    if hasattr(layers, name):
        return getattr(layers, name).verify()
    attributes = getattr(layers, of_type)
    return attributes.get(f"{name}_edge") or attributes.new(f"{name}_edge")


def _mark_freestyle(objects: list[bpy.types.Object]) -> None:
    """Select the seams, let Blender's operator mark them, and select what was selected."""
    selections = [Selection(obj) for obj in objects]
    try:
        bpy.ops.mesh.select_all(action="DESELECT")
        for obj in objects:
            for edge in _seams(edit_bmesh(obj.data)):
                edge.select_set(True)
        bpy.ops.mesh.mark_freestyle_edge()
    finally:
        bpy.ops.mesh.select_all(action="DESELECT")
        for selection in selections:
            selection.restore()
