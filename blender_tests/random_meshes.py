# SPDX-License-Identifier: GPL-3.0-or-later
"""Random polygon meshes of the kinds that artists make, and of the kinds that break programs."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import bmesh
import bpy
from mathutils import Matrix, Vector, noise

KINDS: dict[str, Callable[[bmesh.types.BMesh, random.Random], None]] = {}
"""By name: each adds a mesh to an empty bmesh."""


def _kind(
    make: Callable[[bmesh.types.BMesh, random.Random], None],
) -> Callable[[bmesh.types.BMesh, random.Random], None]:
    KINDS[make.__name__.strip("_")] = make
    return make


def add_random(kind: str, seed: int) -> bpy.types.Object:
    """Add an object with the mesh of this kind and number, active and selected, in object mode.

    Some of the meshes have seams, hidden faces, turned faces or holes.
    """
    dice = random.Random(f"{kind} {seed}")
    bm = bmesh.new()
    KINDS[kind](bm, dice)
    _spoil(bm, dice)
    bm.normal_update()
    mesh = bpy.data.meshes.new(kind)
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new(f"{kind} {seed}", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def _spoil(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    """Mark seams, turn faces and remove faces, each in some of the meshes."""
    share = dice.choice((0.0, 0.0, 0.02, 0.3))
    for edge in bm.edges:
        edge.seam = dice.random() < share
    if dice.random() < 0.15:
        bmesh.ops.reverse_faces(bm, faces=[face for face in bm.faces if dice.random() < 0.3])
    if dice.random() < 0.2 and len(bm.faces) > 6:
        gone = [face for face in bm.faces if dice.random() < 0.05]
        bmesh.ops.delete(bm, geom=gone, context="FACES")
    scale = 10.0 ** dice.choice((-3, 0, 0, 0, 3))
    turn = Matrix.Rotation(dice.uniform(0.0, 6.3), 4, Vector((dice.random(), dice.random(), 1.0)).normalized())
    bmesh.ops.transform(bm, matrix=turn @ Matrix.Scale(scale, 4), verts=bm.verts)


def _crumple(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    """Move the vertices by smooth noise."""
    if dice.random() < 0.4:
        return
    strength, size = dice.uniform(0.02, 0.4), dice.uniform(0.5, 3.0)
    offset = Vector((dice.uniform(-9.0, 9.0), dice.uniform(-9.0, 9.0), dice.uniform(-9.0, 9.0)))
    for vertex in bm.verts:
        vertex.co += strength * noise.noise_vector(size * vertex.co + offset)


def _grid(
    bm: bmesh.types.BMesh, columns: int, rows: int, place: Callable[[float, float], Vector], close: str = ""
) -> None:
    """Add quads between places for u and v from 0 to 1. `close` names the directions that go around."""
    around_u, around_v = "u" in close, "v" in close
    us, vs = columns + (not around_u), rows + (not around_v)
    vertices = [[bm.verts.new(place(i / columns, j / rows)) for i in range(us)] for j in range(vs)]
    for j in range(rows):
        for i in range(columns):
            right, above = (i + 1) % us, (j + 1) % vs
            bm.faces.new((vertices[j][i], vertices[j][right], vertices[above][right], vertices[above][i]))


@_kind
def _quads(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    shape = dice.choice(("cube", "sheet", "torus", "ball", "moebius"))
    if shape == "cube":
        bmesh.ops.create_cube(bm, size=1.0)
        if cuts := dice.choice((0, 0, 1, 2, 3)):
            bmesh.ops.subdivide_edges(bm, edges=bm.edges[:], cuts=cuts, use_grid_fill=True)
        for face in dice.sample(bm.faces[:], k=min(2, len(bm.faces))):
            if dice.random() < 0.5:
                made = bmesh.ops.extrude_discrete_faces(bm, faces=[face])["faces"][0]
                bmesh.ops.translate(bm, verts=made.verts[:], vec=dice.uniform(0.1, 1.0) * made.normal)
    elif shape == "sheet":
        _grid(bm, dice.randint(1, 14), dice.randint(1, 14), lambda u, v: Vector((u, v, 0.0)))
    elif shape == "torus":
        inner = dice.uniform(0.1, 0.8)

        def on_torus(u: float, v: float) -> Vector:
            u, v = math.tau * u, math.tau * v
            away = 1.0 + inner * math.cos(v)
            return Vector((away * math.cos(u), away * math.sin(u), inner * math.sin(v)))

        _grid(bm, dice.randint(3, 16), dice.randint(3, 10), on_torus, "uv")
    elif shape == "ball":
        bmesh.ops.create_uvsphere(bm, u_segments=dice.randint(3, 16), v_segments=dice.randint(2, 10), radius=1.0)
    else:
        count = dice.randint(5, 20)
        pairs = []
        for i in range(count):
            angle = math.tau * i / count
            arm = Matrix.Rotation(angle, 3, "Z") @ Matrix.Rotation(angle / 2.0, 3, "Y") @ Vector((0.0, 0.0, 0.4))
            middle = Vector((math.cos(angle), math.sin(angle), 0.0))
            pairs.append((bm.verts.new(middle - arm), bm.verts.new(middle + arm)))
        for i, (a, b) in enumerate(pairs):
            c, d = pairs[(i + 1) % count] if i + 1 < count else reversed(pairs[0])
            bm.faces.new((a, b, d, c))
    _crumple(bm, dice)


@_kind
def _ngons(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    """Add cylinders with caps, prisms, and faces that were joined at random, concave and bent."""
    if dice.random() < 0.5:
        bmesh.ops.create_cone(
            bm, cap_ends=True, cap_tris=False, segments=dice.choice((3, 5, 8, 12, 32, 100)), radius1=1.0,
            radius2=dice.choice((1.0, 1.0, 0.5)), depth=dice.choice((0.05, 1.0, 2.0, 10.0)),
        )  # fmt: skip
        if dice.random() < 0.5:
            bmesh.ops.bevel(bm, geom=bm.edges[:], offset=0.01, segments=dice.randint(1, 2), affect="EDGES")
        return
    bmesh.ops.create_icosphere(bm, subdivisions=dice.randint(1, 3), radius=1.0)
    _crumple(bm, dice)
    edges = [edge for edge in bm.edges if dice.random() < 0.35]
    bmesh.ops.dissolve_edges(bm, edges=edges, use_verts=False)


@_kind
def _fans(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    count = dice.choice((3, 7, 20, 60, 300))
    height, depth = dice.choice((0.0, 0.1, 1.0, 5.0)), dice.choice((0.0, 0.0, 0.5))
    tip = bm.verts.new((0.0, 0.0, height))
    rim = [
        bm.verts.new((math.cos(math.tau * i / count), math.sin(math.tau * i / count), depth * dice.random()))
        for i in range(count)
    ]
    for i in range(count):
        bm.faces.new((tip, rim[i], rim[(i + 1) % count]))
    if dice.random() < 0.4:
        bm.faces.new(rim[::-1])


@_kind
def _pieces(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    for _ in range(dice.randint(2, 25)):
        where = Matrix.Translation([dice.uniform(-8.0, 8.0) for _ in range(3)]) @ Matrix.Rotation(dice.random(), 4, "Z")
        size = Matrix.Diagonal([10.0 ** dice.uniform(-1.0, 0.3) for _ in range(3)]).to_4x4()
        shape = dice.choice(("cube", "cube", "cube", "ball", "cone", "card"))
        if shape == "cube":
            bmesh.ops.create_cube(bm, size=1.0, matrix=where @ size)
        elif shape == "ball":
            bmesh.ops.create_icosphere(bm, subdivisions=1, radius=0.5, matrix=where @ size)
        elif shape == "cone":
            bmesh.ops.create_cone(
                bm, cap_ends=dice.random() < 0.7, segments=dice.randint(3, 12), radius1=0.5, radius2=dice.choice((0.0, 0.5)),
                depth=1.0, matrix=where @ size,
            )  # fmt: skip
        else:
            bmesh.ops.create_grid(bm, x_segments=1, y_segments=dice.randint(1, 3), size=0.5, matrix=where @ size)


@_kind
def _fins(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    """Add a sheet or a box with faces that stand on inner edges, so that three faces and more meet there."""
    if dice.random() < 0.6:
        side = dice.randint(2, 8)
        _grid(bm, side, side, lambda u, v: Vector((u, v, 0.0)))
    else:
        bmesh.ops.create_cube(bm, size=1.0)
    inner = [edge for edge in bm.edges if len(edge.link_faces) == 2]
    for edge in dice.sample(inner, k=min(len(inner), dice.randint(1, 20))):
        one, two = edge.verts
        up = dice.uniform(0.1, 0.5) * (edge.link_faces[0].normal + edge.link_faces[1].normal)
        up = up if up.length > 1e-3 else Vector((0.0, 0.0, 0.3))
        bm.faces.new((one, two, bm.verts.new(two.co + up), bm.verts.new(one.co + up)))
    _crumple(bm, dice)


@_kind
def _tubes(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    around, along = dice.randint(3, 10), dice.choice((2, 10, 40, 150))
    bend, radius = dice.choice((0.0, 0.5, 3.0)), dice.uniform(0.02, 0.3)
    length = radius * dice.uniform(0.3, 3.0) * along

    def on_tube(u: float, v: float) -> Vector:
        across = Vector((radius * math.cos(math.tau * u), radius * math.sin(math.tau * u), 0.0))
        turn = Matrix.Rotation(bend * v, 3, "X")
        middle = Vector((0.0, 0.0, length * v))
        if bend:
            middle = length / bend * Vector((0.0, math.cos(bend * v) - 1.0, math.sin(bend * v)))
        return middle + turn @ across

    _grid(bm, around, along, on_tube, "u")
    for row, is_closed in ((0, dice.random() < 0.5), (along, dice.random() < 0.5)):
        bm.verts.ensure_lookup_table()
        rim = bm.verts[row * around : (row + 1) * around]
        if is_closed:
            bm.faces.new(rim if row else rim[::-1])
    if dice.random() < 0.3:
        bmesh.ops.triangulate(bm, faces=bm.faces[:])


@_kind
def _slivers(bm: bmesh.types.BMesh, dice: random.Random) -> None:
    """Add a shape with corners in the middle of straight sides, needles, caps, and faces without an area."""
    if dice.random() < 0.5:
        bmesh.ops.create_cube(bm, size=1.0)
    else:
        bmesh.ops.create_uvsphere(bm, u_segments=dice.randint(3, 9), v_segments=dice.randint(2, 6), radius=1.0)
    for _ in range(dice.randint(1, 12)):
        bm.edges.ensure_lookup_table()
        edge = dice.choice(bm.edges)
        part = dice.choice((0.5, 0.3, 0.01, 1e-4, 1e-6))
        _, vertex = bmesh.utils.edge_split(edge, edge.verts[0], part)
        if dice.random() < 0.4:
            face = dice.choice(vertex.link_faces[:])
            others = [v for v in face.verts if v is not vertex and not any(vertex in e.verts for e in v.link_edges)]
            if others:
                bmesh.utils.face_split(face, vertex, dice.choice(others))
    if dice.random() < 0.3:
        bmesh.ops.triangulate(bm, faces=bm.faces[:])
    if dice.random() < 0.2:
        a, b = dice.sample(bm.verts[:], k=2)
        c = bm.verts.new(0.5 * (a.co + b.co))
        bm.faces.new((a, b, c))
