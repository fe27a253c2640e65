# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects with known numbers, and what their meshes hold, for tests in Blender."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from itertools import pairwise

import bmesh
import bpy
import numpy as np

ADDON = os.environ.get("SEAMWIRE_ADDON", "seamwire")
"""The add-on's name in this Blender; to import from it, say ``seamwire``."""

Edge = tuple[int, int]


def add_object(
    points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]], edges: Sequence[Edge] = (), name: str = "Test"
) -> bpy.types.Object:
    """Add an object with a mesh of these vertices and faces, active and selected, in object mode."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, edges, faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def add_grid(columns: int, rows: int | None = None, size: float = 2.0, name: str = "Grid") -> bpy.types.Object:
    """Add a square of `columns` x `rows` vertices around the origin; vertex y * columns + x is column x of row y."""
    rows = columns if rows is None else rows
    points = [
        (size * (x / (columns - 1) - 0.5), size * (y / (rows - 1) - 0.5), 0.0)
        for y in range(rows)
        for x in range(columns)
    ]
    faces = [
        (y * columns + x, y * columns + x + 1, (y + 1) * columns + x + 1, (y + 1) * columns + x)
        for y in range(rows - 1)
        for x in range(columns - 1)
    ]
    return add_object(points, faces, name=name)


def add_suzanne(levels: int = 0) -> bpy.types.Object:
    """Add Suzanne, subdivided some times."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    if levels:
        modifier = obj.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = levels
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj


GATE_SIDE = 17
GATE_SEEDS = (8 * GATE_SIDE + 4, 8 * GATE_SIDE + 12)
"""The feet of the gate's ridge."""
GATE_STRAIGHT = list(range(GATE_SEEDS[0], GATE_SEEDS[1] + 1))
GATE_RIDGE = [
    *range(GATE_SEEDS[0], 12 * GATE_SIDE + 4, GATE_SIDE),
    *range(12 * GATE_SIDE + 4, 12 * GATE_SIDE + 12),
    *range(12 * GATE_SIDE + 12, GATE_SEEDS[1] - 1, -GATE_SIDE),
]


def add_gate() -> bpy.types.Object:
    """Make a grid of 17 x 17 vertices with a ridge up, across and down again, and one spike far from it.

    From foot to foot of the ridge wires follow it, a way twice as long as straight; with a low strength, in the shortest
    ways' metric, and where the clamp lets the weakest features count as the ridge does, they run straight.
    """
    obj = add_grid(GATE_SIDE)
    for v in obj.data.vertices:
        x, y = v.co.x, v.co.y
        feet = math.hypot(abs(x) - 0.5, y - min(max(y, 0.0), 0.5))
        top = math.hypot(x - min(max(x, -0.5), 0.5), y - 0.5)
        v.co.z = 0.4 * math.exp(-((min(feet, top) / 0.15) ** 2))
    obj.data.vertices[2 * GATE_SIDE + 2].co.z += 3.0
    return obj


def head(obj: bpy.types.Object, count: int) -> list[int]:
    """Return vertices of Suzanne's head, spread over it: her eyes are parts of their own."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    parts, seen = [], set()
    for start in bm.verts:
        part, waiting = [], [start]
        while waiting:
            v = waiting.pop()
            if v.index not in seen:
                seen.add(v.index)
                part.append(v.index)
                waiting += [edge.other_vert(v) for edge in v.link_edges]
        parts.append(sorted(part))
    bm.free()
    largest = max(parts, key=len)
    return largest[:: len(largest) // count][:count]


def edit() -> None:
    """Enter edit mode on the selected objects."""
    bpy.ops.object.mode_set(mode="EDIT")


def seams(obj: bpy.types.Object) -> list[Edge]:
    """Return the seams of an object in either mode, smaller vertex first, sorted."""
    if obj.mode == "EDIT":
        pairs = [tuple(v.index for v in edge.verts) for edge in bmesh.from_edit_mesh(obj.data).edges if edge.seam]
    else:
        pairs = [tuple(edge.vertices) for edge in obj.data.edges if edge.use_seam]
    return sorted((min(pair), max(pair)) for pair in pairs)


def chain(*vertices: int) -> list[Edge]:
    """Return the edges of a chain of vertices, smaller vertex first, sorted."""
    return sorted((min(pair), max(pair)) for pair in pairwise(vertices))


def ends(edges: Iterable[Edge]) -> list[int]:
    """Return the vertices that an odd number of edges meet at: those where chains end."""
    numbers, counts = np.unique(np.array(list(edges)).reshape(-1), return_counts=True)
    return numbers[counts % 2 == 1].tolist()


def snapshot(obj: bpy.types.Object, with_seams: bool = True) -> dict[str, object]:
    """Return all that a mesh in edit mode holds and a tool might change."""
    bm = bmesh.from_edit_mesh(obj.data)
    history = range(len(bm.select_history))
    found: dict[str, object] = {
        "vertices": [(*v.co, *v.normal, v.select, v.hide) for v in bm.verts],
        "edges": [(v.index, w.index, e.select, e.hide, e.smooth) for e in bm.edges for v, w in [e.verts]],
        "faces": [
            (tuple(v.index for v in f.verts), f.select, f.hide, f.smooth, f.material_index, tuple(f.normal))
            for f in bm.faces
        ],
        # Not iterated: Blender 4.3 cannot, on the Python 3.13 of Debian 13.
        "history": [(type(item).__name__, item.index) for item in map(bm.select_history.__getitem__, history)],
        "mode": tuple(bpy.context.tool_settings.mesh_select_mode),
    }
    if with_seams:
        found["seams"] = [e.seam for e in bm.edges]
    for domain, items in (("verts", bm.verts), ("edges", bm.edges), ("faces", bm.faces)):
        for layer in items.layers.float.values():
            found[f"{domain} {layer.name}"] = [item[layer] for item in items]
    for layer in bm.loops.layers.uv.values():
        found[f"uv {layer.name}"] = [tuple(loop[layer].uv) for f in bm.faces for loop in f.loops]
    return found


def add_layers(obj: bpy.types.Object) -> None:
    """Give a mesh in object mode things that must not change: UVs, an attribute, materials, smooth faces."""
    layer = obj.data.uv_layers.new(name="Kept")
    for i, corner in enumerate(layer.data):
        corner.uv = (i % 7 / 7.0, i % 11 / 11.0)
    attribute = obj.data.attributes.new("kept", "FLOAT", "POINT")
    for i, value in enumerate(attribute.data):
        value.value = i % 5
    for i, polygon in enumerate(obj.data.polygons):
        polygon.use_smooth = i % 2 == 0
        polygon.select = i % 3 == 0
