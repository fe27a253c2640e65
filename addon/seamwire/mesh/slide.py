# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices of an edit mesh slid over its faces: what corners hold and shape keys stay where they are on the surface."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np
from mathutils import Vector

from ..core.seams.slide_plan import SlidFaces
from .registration import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.network.picks import Edge
    from ..core.seams.slide_plan import Move
    from .edit_mesh import Cage

    Value = Vector | float

_SAME = 6
"""Digits that corners around a vertex have in common where they hang together, as in one island of a UV map."""


def faces_at(cage: Cage, arrays: Arrays, vertices: Iterable[int]) -> SlidFaces:
    verts = cage.number_bmesh().verts
    faces = (face for vertex in vertices for face in verts[vertex].link_faces if not face.hide)
    corners = {face.index: [vert.index for vert in face.verts] for face in faces}
    return SlidFaces(arrays.points, arrays.triangles, arrays.polygons, corners)


def stiff_vertices(cage: Cage, vertices: Iterable[int], seams: Collection[Edge]) -> set[int]:
    """Return those of some vertices that must stay: on sharp and creased edges, between materials, on seams other than those given."""
    bm = cage.number_bmesh()
    layers = bm.edges.layers
    crease = layers.crease.active if IS_OLD else layers.float.get("crease_edge")

    def holds(edge: bmesh.types.BMEdge) -> bool:
        one, two = sorted(vert.index for vert in edge.verts)
        return (
            not edge.smooth
            or (crease is not None and edge[crease] > 0.0)
            or len({face.material_index for face in edge.link_faces}) > 1
            or (edge.seam and (one, two) not in seams)
        )

    return {vertex for vertex in vertices if any(map(holds, bm.verts[vertex].link_edges))}


def carry_out(obj: bpy.types.Object, cage: Cage, moves: Mapping[int, Move]) -> None:
    """Move vertices. What corners of faces hold follows as with Blender's own sliding: UVs, colors and other numbers."""
    bm = cage.number_bmesh()
    spans = {vertex: ([bm.verts[corner] for corner in move.corners], move.weights) for vertex, move in moves.items()}
    # All is read before anything is written: neighbors move as well.
    places = {vertex: _mean([corner.co for corner in corners], weights) for vertex, (corners, weights) in spans.items()}
    keys = [
        (layer, {vertex: _mean([corner[layer] for corner in own], weights) for vertex, (own, weights) in spans.items()})
        for layer in bm.verts.layers.shape.values()
    ]
    kinds = ("uv", "color", "float_color", "float", "float_vector")
    layers = [layer for kind in kinds for layer in getattr(bm.loops.layers, kind).values()]
    corners = [(layer, list(_of_corners(bm, moves, places, layer))) for layer in layers]
    follows = _keys_that_follow(obj)
    for vertex, place in places.items():
        vert = bm.verts[vertex]
        offset = place - vert.co
        for number, (layer, wanted) in enumerate(keys):
            if number != obj.active_shape_key_index:  # that is `vert.co`
                vert[layer] = wanted[vertex] - offset if number in follows else wanted[vertex]
        vert.co = place
    for layer, values in corners:
        for corner, value in values:
            if hasattr(corner[layer], "uv"):
                corner[layer].uv = value
            else:
                corner[layer] = value
    bm.normal_update()
    bmesh.update_edit_mesh(cage.data, loop_triangles=True, destructive=False)


def _mean(values: Sequence[Value], weights: Sequence[float]) -> Value:
    first, *rest = (value * weight for value, weight in zip(values, weights, strict=True))
    for value in rest:
        first = first + value
    return first


def _keys_that_follow(obj: bpy.types.Object) -> set[int]:
    """Return the numbers of the shape keys that Blender moves with the edited one: relative to it, in newer versions also indirectly."""
    keys = obj.data.shape_keys
    if keys is None or not keys.use_relative:
        return set()
    blocks = list(keys.key_blocks)
    edited = blocks[obj.active_shape_key_index]

    def leads_there(block: bpy.types.ShapeKey) -> bool:
        passed = []
        while block not in passed:
            passed.append(block)
            block = block.relative_key
            if block == edited:
                return True
            if IS_OLD:
                break
        return False

    return {number for number, block in enumerate(blocks) if block != edited and leads_there(block)}


def _read(corner: bmesh.types.BMLoop, layer: bmesh.types.BMLayerItem) -> Value:
    value = getattr(corner[layer], "uv", corner[layer])
    return value if isinstance(value, float) else Vector(value)


def _of_corners(
    bm: bmesh.types.BMesh, moves: Mapping[int, Move], places: Mapping[int, Vector], layer: bmesh.types.BMLayerItem
) -> Iterator[tuple[bmesh.types.BMLoop, Value]]:
    """Yield the corners around vertices that move, and what a layer has there.

    If the layer is continuous with the face that a vertex moves into, the value is interpolated there. Beyond a seam of the layer, each
    face's values are extrapolated to that place, and connected values are averaged.
    """
    for vertex, move in moves.items():
        inside = {corner.vert.index: _read(corner, layer) for corner in bm.faces[move.polygon].loops}
        there = _mean([inside[corner] for corner in move.corners], move.weights)
        groups: dict[tuple[float, ...], list[bmesh.types.BMLoop]] = defaultdict(list)
        for corner in bm.verts[vertex].link_loops:
            groups[_rounded(_read(corner, layer))].append(corner)
        for key, group in groups.items():
            value = there
            if key != _rounded(inside[vertex]):
                beyond = [_continued(corner, places[vertex], layer) for corner in group]
                value = _mean(beyond, [1.0 / len(beyond)] * len(beyond))
            for corner in group:
                yield corner, value


def _rounded(value: Value) -> tuple[float, ...]:
    return tuple(round(part, _SAME) for part in ((value,) if isinstance(value, float) else value))


def _continued(corner: bmesh.types.BMLoop, place: Vector, layer: bmesh.types.BMLayerItem) -> Value:
    """Return what a face's layer has at a place, continued from the triangle of a corner and those beside it."""
    three = (corner.link_loop_prev, corner, corner.link_loop_next)
    return _mean([_read(one, layer) for one in three], _affine([one.vert.co for one in three], place))


def _affine(corners: Sequence[Vector], place: Vector) -> NDArray[np.float64]:
    """Return the weights of three corners whose mean is nearest to a place; any of them may be negative."""
    a, b, c = map(np.array, corners)
    sides = np.stack([b - a, c - a], axis=1)
    (s, t), *_ = np.linalg.lstsq(sides, np.array(place) - a, rcond=None)
    return np.array([1.0 - s - t, s, t])
