# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects with known numbers, and what their meshes hold, for tests in Blender."""

from __future__ import annotations

import math
import os
import random
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from typing import TYPE_CHECKING, NoReturn

import bmesh
import bpy
import numpy as np

if TYPE_CHECKING:
    from seamwire.scripting import Marked

ADDON = os.environ.get("SEAMWIRE_ADDON", "seamwire")
"""The add-on's name in this Blender; to import from it, say ``seamwire``."""

Edge = tuple[int, int]
Seed = int | Edge | tuple[float, float, float]


def seeds(text: str) -> list[list[Seed]]:
    """Return chains of seeds that are written in short, such as ``"0 512; 7-9 (0.1 0 1)"``."""
    return [
        [_seed(token) for token in re.findall(r"\([^()]*\)|[^\s()]+", part)] for part in text.split(";") if part.strip()
    ]


def _seed(token: str) -> Seed:
    if token.startswith("("):
        return tuple(float(part) for part in token[1:-1].split())
    numbers = tuple(int(part) for part in token.split("-"))
    return numbers if len(numbers) > 1 else numbers[0]


def mark_wires(
    chains: str = "", loops: str = "", strokes: str = "", obj: bpy.types.Object | None = None, **options: object
) -> Marked:
    """Draw with `seamwire.mark` between seeds that are written in short, on the active object by default.

    A tilde before a stroke makes it an avoid stroke.
    """
    import seamwire

    guides = [part.strip() for part in strokes.split(";") if part.strip()]
    return seamwire.mark(
        obj or bpy.context.active_object,
        seeds(chains),
        loops=[seed for part in seeds(loops) for seed in part],
        strokes=[seeds(part)[0] for part in guides if part[0] != "~"],
        avoid=[seeds(part[1:])[0] for part in guides if part[0] == "~"],
        **options,
    )


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


def add_scan() -> bpy.types.Object:
    """Add a rough ball of 5,120 triangles."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    obj = bpy.context.active_object
    dice = random.Random(3)
    for v in obj.data.vertices:
        v.co *= 1.0 + 0.03 * dice.random()
    return obj


def add_pillow(rows: Sequence[str], fine: int = 8) -> bpy.types.Object:
    """Add two layers, in front (y < 0) and behind, over cells that are "#".

    They meet in round sides, and are open beside cells that are "o". Each cell has fine x fine faces on each side.
    """
    cells = np.pad(np.array([list(row) for row in rows]).repeat(fine, 0).repeat(fine, 1), 1, constant_values=" ")

    def is_beside(i: int, j: int, what: str) -> bool:
        return bool((cells[j : j + 2, i : i + 2] == what).any())

    height, width = cells.shape[0] - 1, cells.shape[1] - 1
    corners = [(i, j) for j in range(height) for i in range(width) if is_beside(i, j, "#")]
    sides = np.array([at for at in corners if is_beside(*at, " ")])
    points, numbers = [], {}
    for i, j in corners:
        away = min(1.0, float(np.hypot(*(sides - (i, j)).T).min()) / fine)
        for layer in (-1.0, 1.0):
            if layer > 0.0 and away == 0.0:
                numbers[i, j, layer] = numbers[i, j, -layer]
                continue
            numbers[i, j, layer] = len(points)
            depth = 0.8 * layer * math.sqrt(1.0 - (1.0 - away) ** 2)
            points.append((i / fine - 0.5 * (width - 1) / fine, depth, -j / fine))
    faces = []
    for j in range(height - 1):
        for i in range(width - 1):
            if cells[j + 1, i + 1] == "#":
                ring = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
                faces.append([numbers[(*at, -1.0)] for at in ring])
                faces.append([numbers[(*at, 1.0)] for at in reversed(ring)])
    return add_object(points, faces, name="Pillow")


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

    From foot to foot of the ridge wires follow it, on a path twice as long as straight. They run straight with a low
    strength, in the metric of shortest paths, and if the clamp lets the weakest features count as much as the ridge.
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
    """Return vertices of Suzanne's head, spread over it: her eyes are separate parts."""
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


def animate(obj: bpy.types.Object) -> None:
    """Give an object in edit mode an armature that turns it a little, with an animation of 30 frames. It stays active."""
    bpy.ops.object.mode_set(mode="OBJECT")
    armature = bpy.data.objects.new("Armature", bpy.data.armatures.new("Armature"))
    bpy.context.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    edit()
    armature.data.edit_bones.new("Bone").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    pose = armature.pose.bones["Bone"]
    pose.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.0), (30, 0.02)):
        pose.rotation_euler = (0.0, 0.0, angle)
        pose.keyframe_insert("rotation_euler", frame=frame)
    obj.modifiers.new("Armature", "ARMATURE").object = armature
    obj.vertex_groups.new(name="Bone").add(range(len(obj.data.vertices)), 1.0, "REPLACE")
    armature.select_set(False)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    edit()


def edit() -> None:
    """Enter edit mode on the selected objects."""
    bpy.ops.object.mode_set(mode="EDIT")


def fail(*_: object, **__: object) -> NoReturn:
    """End on an error, in place of what a test wants to fail."""
    raise RuntimeError("as the test wants it")


@contextmanager
def changing(obj: bpy.types.Object) -> Iterator[bmesh.types.BMesh]:
    """Change a mesh in edit mode, whose items may be named by their numbers."""
    bm = bmesh.from_edit_mesh(obj.data)
    for items in (bm.verts, bm.edges, bm.faces):
        items.ensure_lookup_table()
    yield bm
    bmesh.update_edit_mesh(obj.data)


def set_seams(obj: bpy.types.Object, *chains: Sequence[int], seam: bool = True) -> None:
    """Make the edges along chains of vertices seams of a mesh in edit mode, or no seams."""
    with changing(obj) as bm:
        for a, b in (pair for one in chains for pair in pairwise(one)):
            bm.edges.get((bm.verts[a], bm.verts[b])).seam = seam


def seams(obj: bpy.types.Object) -> list[Edge]:
    """Return the seams of an object in either mode, smaller vertex first, sorted."""
    if obj.mode == "EDIT":
        bm = bmesh.from_edit_mesh(obj.data)
        bm.verts.index_update()
        pairs = [tuple(v.index for v in edge.verts) for edge in bm.edges if edge.seam]
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
    """Return all that a mesh in edit mode holds but the add-on's own: every layer of every kind that this Blender has.

    Parameters
    ----------
    obj
        In edit mode.
    with_seams
        Whether seams count as well.
    """
    bm = bmesh.from_edit_mesh(obj.data)
    for sequence in (bm.verts, bm.edges, bm.faces):
        sequence.index_update()  # Blender's own operators leave others behind
    history = range(len(bm.select_history))
    found: dict[str, object] = {
        "vertices": [(*v.co, *v.normal, v.select, v.hide) for v in bm.verts],
        "edges": [(v.index, w.index, e.select, e.hide, e.smooth) for e in bm.edges for v, w in [e.verts]],
        "faces": [
            (tuple(v.index for v in f.verts), f.select, f.hide, f.smooth, f.material_index, tuple(f.normal))
            for f in bm.faces
        ],
        "active face": None if bm.faces.active is None else bm.faces.active.index,
        # Not iterated: Blender 4.3 cannot, on the Python 3.13 of Debian 13.
        "history": [(type(item).__name__, item.index) for item in map(bm.select_history.__getitem__, history)],
        "mode": tuple(bpy.context.tool_settings.mesh_select_mode),
    }
    if with_seams:
        found["seams"] = [e.seam for e in bm.edges]
    items = items_of(bm)
    for domain, kind, layers in layer_kinds(bm):
        for name, layer in layers.items():
            if (domain, kind, name) == ("edges", "int", ".seamwire"):
                continue
            if kind == "uv":
                found[f"uv {name}"] = [tuple(loop[layer].uv) for loop in items[domain]]
            found[f"{domain} {kind} {name}"] = [plain(item[layer]) for item in items[domain]]
    return found | of_mesh(obj)


def layer_kinds(bm: bmesh.types.BMesh) -> list[tuple[str, str, object]]:
    """Return the kinds of layers that a bmesh can have, each with its domain and the layers of it that there are."""
    found = []
    for domain in ("verts", "edges", "faces", "loops"):
        layers = getattr(bm, domain).layers
        names = [name for name in dir(layers) if not name.startswith("_")]
        found += [(domain, name, getattr(layers, name)) for name in names if hasattr(getattr(layers, name), "items")]
    return found


def items_of(bm: bmesh.types.BMesh) -> dict[str, list[object]]:
    """Return a bmesh's items by their domains; a new layer makes them invalid."""
    loops = [loop for face in bm.faces for loop in face.loops]
    return {"verts": list(bm.verts), "edges": list(bm.edges), "faces": list(bm.faces), "loops": loops}


def plain(value: object) -> object:
    """Return what a layer holds of an item as values that can be compared."""
    if value is NotImplemented:  # Blender has no Python for these
        return None
    if isinstance(value, (bool, int, float, bytes, str)):
        return value
    # Of UVs the places are told apart from the rest.
    fields = ("pin_uv", "select", "select_edge", "radius", "use_root", "use_loose")
    known = tuple((name, plain(getattr(value, name))) for name in fields if hasattr(value, name))
    if known:
        return known
    return tuple(sorted(value.items())) if hasattr(value, "items") else tuple(value)


def of_mesh(obj: bpy.types.Object) -> dict[str, object]:
    """Return what a mesh and its object hold beside the layers of the edit mesh."""
    mesh = obj.data
    keys = mesh.shape_keys
    found: dict[str, object] = {
        "groups": [group.name for group in obj.vertex_groups],
        "materials": [material and material.name for material in mesh.materials],
        "keys": keys and [(key.name, key.value, key.mute) for key in keys.key_blocks],
        "active key": obj.active_shape_key_index,
        "properties": {name: mesh[name] for name in mesh.keys() if "seamwire" not in name},  # noqa: SIM118
        "mirror": [getattr(mesh, f"use_mirror_{axis}") for axis in "xyz"],
        "uv layers": [(layer.name, layer.active, layer.active_render) for layer in mesh.uv_layers],
        "has custom normals": mesh.has_custom_normals,
    }
    if mesh.has_custom_normals:
        obj.update_from_editmode()
        if hasattr(mesh, "corner_normals"):
            found["corner normals"] = [tuple(normal.vector) for normal in mesh.corner_normals]
        else:
            mesh.calc_normals_split()
            found["corner normals"] = [tuple(loop.normal) for loop in mesh.loops]
            mesh.free_normals_split()
    return found


def add_layers(obj: bpy.types.Object) -> None:
    """Give a mesh in object mode things that must not change: each kind of layer that this Blender has, and all else."""
    mesh = obj.data
    layer = mesh.uv_layers.new(name="Kept")
    for i, corner in enumerate(layer.data):
        corner.uv = (i % 7 / 7.0, i % 11 / 11.0)
    attribute = mesh.attributes.new("kept", "FLOAT", "POINT")
    for i, value in enumerate(attribute.data):
        value.value = i % 5
    for i, polygon in enumerate(mesh.polygons):
        polygon.use_smooth = i % 2 == 0
        polygon.select = i % 3 == 0
        polygon.material_index = i % 2
    for name in ("Stone", "Moss"):
        mesh.materials.append(bpy.data.materials.get(name) or bpy.data.materials.new(name))
    _fill_layers(mesh)
    for name in ("Left", "Right"):
        group = obj.vertex_groups.new(name=name)
        for i in range(0, len(mesh.vertices), 3):
            group.add([i], i % 4 / 4.0, "REPLACE")
    mesh["kept"] = "a custom property"
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set([(0.0, 0.6 * (i % 2), 0.8) for i in range(len(mesh.loops))])
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Raised", from_mix=False)
    for i, point in enumerate(key.data):
        point.co.z += 0.1 * (i % 3)
    key.value = 0.5
    obj.active_shape_key_index = 0


_FILLS = {
    "bool": lambda i: i % 3 == 0,
    "int": lambda i: i % 13 - 4,
    "float": lambda i: i % 7 / 7.0,
    "string": lambda i: f"{i % 5}".encode(),
    "float_vector": lambda i: (i % 2, i % 3, i % 5),
    "float_color": lambda i: (i % 2, i % 3 / 3.0, i % 5 / 5.0, 1.0),
    "color": lambda i: (i % 2, i % 3 / 2.0, i % 5 / 4.0, 1.0),
    "crease": lambda i: i % 3 / 3.0,
    "bevel_weight": lambda i: i % 4 / 4.0,
    "paint_mask": lambda i: i % 5 / 5.0,
    "face_map": lambda i: i % 2,
}
_ALONE = {"crease", "bevel_weight", "paint_mask", "face_map", "skin"}
"""Kinds of layers of which a mesh has one at most."""


def _fill_layers(mesh: bpy.types.Mesh) -> None:
    bm = bmesh.new()
    bm.from_mesh(mesh)
    for domain, kind, layers in layer_kinds(bm):
        if kind in _ALONE:
            layers.verify()
        elif kind in _FILLS:
            layers.new(f"kept {kind} of {domain}")
    if not hasattr(bm.edges.layers, "crease"):  # then these are attributes like any other
        bm.edges.layers.float.new("crease_edge")
        bm.edges.layers.float.new("bevel_weight_edge")
    items = items_of(bm)
    for domain, kind, layers in layer_kinds(bm):
        for name, layer in layers.items() if kind in _FILLS else ():
            if name.startswith("kept") or kind in _ALONE or "_edge" in name:
                for i, item in enumerate(items[domain]):
                    item[layer] = _FILLS[kind](i)
    pinned = bm.loops.layers.uv["Kept"]
    for i, loop in enumerate(items["loops"]):
        loop[pinned].pin_uv = i % 4 == 0
    for i, edge in enumerate(bm.edges):
        edge.smooth = i % 3 != 0
    bm.to_mesh(mesh)
    bm.free()
