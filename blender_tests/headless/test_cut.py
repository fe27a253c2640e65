# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires cut into the faces: `seamwire.mark` with ``finish="CUT"`` and ``mesh.seamwire_finish``."""

import math
import random
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector
from scene import (
    add_grid,
    add_layers,
    add_object,
    add_scan,
    add_suzanne,
    changing,
    edit,
    head,
    items_of,
    layer_kinds,
    mark_wires,
    plain,
    seams,
    snapshot,
)
from seamwire.core.base import native
from seamwire.core.network.drawn import Drawn
from seamwire.core.sketch.change import Change
from seamwire.mesh import finishes
from seamwire.mesh.edit_mesh import LABELS
from seamwire.mesh.object_session import ObjectSession
from stored import agree, island_count, session_on, write


def cut(chains: str, **options: object) -> object:
    return mark_wires(chains=chains, along="SURFACE", finish="CUT", **options)


def is_sound(obj: bpy.types.Object) -> bool:
    """Whether a mesh in edit mode has nothing to mend, and no edge or vertex is loose."""
    bpy.ops.object.mode_set(mode="OBJECT")
    sound = not obj.data.validate(verbose=True)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    return sound and all(edge.link_faces for edge in bm.edges) and all(vert.link_edges for vert in bm.verts)


def triangles(obj: bpy.types.Object, key: str = "") -> list[tuple[Vector, Vector, Vector]]:
    """Return the triangles that a mesh in object mode is seen as, in a shape key where one is named."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    places = mesh.shape_keys.key_blocks[key].data if key else mesh.vertices
    return [tuple(places[v].co.copy() for v in triangle.vertices) for triangle in mesh.loop_triangles]


def joined(obj: bpy.types.Object, start: int) -> set[int]:
    beside = defaultdict(set)
    for a, b in seams(obj):
        beside[a].add(b)
        beside[b].add(a)
    found, waiting = {start}, [start]
    while waiting:
        new = beside[waiting.pop()] - found
        found |= new
        waiting += new
    return found


def add_hills() -> bpy.types.Object:
    """Add a grid with some polygons of up to ten corners, concave ones too, and heights that make them uneven."""
    obj = add_grid(13)
    edit()
    with changing(obj) as bm:
        bmesh.ops.dissolve_verts(bm, verts=[bm.verts[v] for v in (30, 31, 57, 84, 97, 98, 111)])
        for v in bm.verts:
            v.co.z = 0.2 * math.sin(3.0 * v.co.x) * v.co.y
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


SHAPES = {
    "quads": (lambda: add_suzanne(1), lambda obj: head(obj, 6)),
    "polygons": (add_hills, lambda obj: [0, len(obj.data.vertices) - 1, 12, len(obj.data.vertices) - 13, 40, 140]),
    "triangles": (add_scan, lambda _obj: [0, 3, 70, 400, 900, 1500]),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_seams_run_from_seed_to_seed_and_the_surface_stays(shape: str) -> None:
    make, seeds_of = SHAPES[shape]
    obj = make()
    seeds = seeds_of(obj)
    old = triangles(obj)
    count, area = len(obj.data.vertices), sum(face.area for face in obj.data.polygons)
    edit()
    assert cut("{} {} {}; {} {}; {} {}".format(*seeds, seeds[0]))
    for start, end in ((0, 1), (1, 2), (3, 4), (5, 0)):
        assert seeds[end] in joined(obj, seeds[start])
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    assert not mesh.validate(verbose=True), "validate() had something to mend"
    new = mesh.vertices[count:]
    assert len(new) > 5
    faces = triangles(obj)
    size = max(obj.dimensions)
    assert all(_on_any(v.co, old, 1e-6 * size) for v in new)
    assert len(faces) > len(old)
    assert sum(face.area for face in mesh.polygons) == pytest.approx(area, rel=2e-3), "uneven polygons change a little"
    bm = bmesh.new()
    bm.from_mesh(mesh)
    assert all(edge.is_manifold or edge.is_boundary for edge in bm.edges)
    assert all(edge.link_faces for edge in bm.edges)
    assert min(face.calc_area() for face in bm.faces) > 1e-9
    bm.free()


def _on_any(place: Vector, corners: list[tuple[Vector, Vector, Vector]], tolerance: float) -> bool:
    for a, b, c in corners:
        if any(
            min(p) - tolerance > q or max(p) + tolerance < q
            for p, q in zip(zip(a, b, c, strict=True), place, strict=True)
        ):
            continue
        normal = (b - a).cross(c - a)
        if normal.length > 0.0 and abs((place - a).dot(normal.normalized())) <= tolerance:
            return True
    return False


def by_place(obj: bpy.types.Object) -> dict[str, object]:
    """Return the layers of an edit mesh by where their items are, whatever their numbers."""

    def at(item: object) -> tuple[float, ...]:
        if isinstance(item, bmesh.types.BMVert):
            place = item.co
        elif isinstance(item, bmesh.types.BMLoop):
            return (*at(item.vert), *at(item.face))
        else:
            verts = item.verts
            place = sum((v.co for v in verts), Vector()) / len(verts)
        return tuple(round(x, 4) + 0.0 for x in place)

    def rounded(value: object) -> object:
        if isinstance(value, float):
            return round(value, 4) + 0.0
        return tuple(map(rounded, value)) if isinstance(value, tuple) else value

    bm = bmesh.from_edit_mesh(obj.data)
    items = items_of(bm)
    found: dict[str, object] = {
        "places": sorted(at(v) for v in bm.verts),
        "edges": {at(e): (e.smooth, e.hide) for e in bm.edges},
        "faces": {at(f): (f.smooth, f.material_index, f.hide) for f in bm.faces},
    }
    for domain, kind, layers in layer_kinds(bm):
        for name, layer in layers.items():
            found[f"{domain} {kind} {name}"] = {at(item): rounded(plain(item[layer])) for item in items[domain]}
            if kind == "uv":
                found[f"uv {name}"] = {at(item): rounded(tuple(item[layer].uv)) for item in items[domain]}
    return found


def test_a_seed_between_two_corners_of_a_face_has_what_lies_between_theirs() -> None:
    obj = add_grid(3)
    add_layers(obj)
    edit()
    # On a diagonal of the first face, whose corners are the vertices 0, 1, 4 and 3. A bend keeps it a vertex.
    place = Vector((-0.5, -0.5, 0.0))
    assert cut("3 (-0.5 -0.5 0) 2")
    bm = bmesh.from_edit_mesh(obj.data)
    seed = min(bm.verts, key=lambda v: (v.co - place).length)
    assert (seed.co - place).length < 1e-4
    assert seed[bm.verts.layers.float["kept"]] == pytest.approx(2.0 / 7.0), "vertex i has i / 7"
    raised = bm.verts.layers.shape["Raised"]
    corners = [v for v in bm.verts if max(abs(v.co.x + 0.5), abs(v.co.y + 0.5)) == pytest.approx(0.5) and v.index < 9]
    heights = {v.index: v[raised].z for v in corners}
    assert seed[raised].z == pytest.approx(0.5 * (heights[0] + heights[4])) or seed[raised].z == pytest.approx(
        0.5 * (heights[1] + heights[3])
    )


@pytest.mark.every_blender
def test_layers_come_out_as_blenders_own_bisect_leaves_them() -> None:
    found = []
    for name in ("ours", "blenders"):
        obj = add_grid(9, name=name)
        add_layers(obj)
        edit()
        if name == "ours":
            assert cut("0 44")
        else:
            # The wire leads from one side of the grid to another, as the plane does.
            with changing(obj) as bm:
                a, b = (bm.verts[:][v].co.copy() for v in (0, 44))
                everything = [*bm.verts, *bm.edges, *bm.faces]
                across = (b - a).cross((0.0, 0.0, 1.0))
                bmesh.ops.bisect_plane(bm, geom=everything, plane_co=a, plane_no=across, dist=1e-6)
        found.append(by_place(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)
    ours, blenders = found
    assert ours.pop(f"edges int {LABELS}"), "the wires"
    assert ours.keys() == blenders.keys()
    for name in ours:
        assert ours[name] == blenders[name], name


@pytest.mark.every_blender
def test_in_every_shape_key_new_vertices_lie_on_the_faces_as_they_were() -> None:
    obj = add_grid(9)
    obj.shape_key_add(name="Basis")
    wavy = obj.shape_key_add(name="Wavy", from_mix=False)
    for point in wavy.data:
        point.co.z += 0.3 * math.sin(4.0 * point.co.x + point.co.y)
    old = triangles(obj, "Wavy")
    obj.active_shape_key_index = 1
    edit()
    assert cut("0 44; 8 36; 3 70")
    bpy.ops.object.mode_set(mode="OBJECT")
    places = [point.co.copy() for point in obj.data.shape_keys.key_blocks["Wavy"].data][81:]
    assert places and all(_on_any(place, old, 2e-6) for place in places)
    flat = [point.co.z for point in obj.data.shape_keys.key_blocks["Basis"].data]
    assert flat == pytest.approx([0.0] * len(flat), abs=1e-6)


def _counts(edges: list[tuple[int, int]]) -> dict[int, int]:
    numbers, counts = np.unique(np.array(edges), return_counts=True)
    return dict(zip(numbers.tolist(), counts.tolist(), strict=True))


def test_an_object_that_cannot_be_cut_is_named_and_the_others_are_cut(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    first, second = add_grid(5, name="First"), add_grid(5, name="Second")
    first.select_set(True)
    edit()
    for obj in (first, second):
        mark_wires("0 14", obj=obj, along="SURFACE", metric="euclidean")
    before = seams(first)
    plan = finishes.plan_cut

    def plan_second(mesh: ObjectSession, wires: object) -> object:
        if mesh.obj.name == "First":
            raise finishes.CutError("Nothing to cut: every wire stays inside one face")
        return plan(mesh, wires)

    monkeypatch.setattr(finishes, "plan_cut", plan_second)
    assert bpy.ops.mesh.seamwire_finish(finish="CUT") == {"FINISHED"}
    said = capfd.readouterr().out
    assert "First: Nothing to cut: every wire stays inside one face" in said
    assert "Second: " not in said
    assert seams(first) == before
    assert seams(second) != before and agree(second)


@pytest.mark.every_blender
def test_a_cut_is_one_step_of_undo_and_brings_every_layer_back() -> None:
    obj = add_grid(9)
    add_layers(obj)
    edit()
    name = obj.name
    bpy.ops.ed.undo_push(message="Before")
    before = snapshot(bpy.data.objects[name])
    cut("0 44; 8 36")
    bpy.ops.ed.undo_push(message="Cut")
    assert snapshot(bpy.data.objects[name])["vertices"] != before["vertices"]
    bpy.ops.ed.undo()
    assert snapshot(bpy.data.objects[name]) == before


def test_a_face_that_cannot_be_cut_stays_whole_and_is_told_of(monkeypatch: pytest.MonkeyPatch) -> None:
    split = bmesh.utils.face_split_edgenet

    def refuse_one(face: bmesh.types.BMFace, edges: list[bmesh.types.BMEdge]) -> object:
        if face.index == 10:
            raise ValueError("refused on purpose")
        return split(face, edges)

    class Utils:
        edge_split = staticmethod(bmesh.utils.edge_split)
        face_split_edgenet = staticmethod(refuse_one)

    monkeypatch.setattr(finishes.bmesh, "utils", Utils)
    obj = add_grid(9)
    edit()
    assert cut("0 44").problems == ("1 face could not be cut: the seams have gaps there",)
    bm = bmesh.from_edit_mesh(obj.data)
    assert all(edge.link_faces for edge in bm.edges) and all(vert.link_edges for vert in bm.verts)
    assert len(seams(obj)) == 7


def test_an_edge_that_is_missing_where_a_cut_runs_along_it_is_found_before_anything_is_cut(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    obj = add_grid(9)
    add_layers(obj)
    edit()
    before = snapshot(obj)
    plan = native.load().plan_cuts

    def astray(*what: object) -> object:
        found = plan(*what)
        count = len(found.vertices)
        return SimpleNamespace(
            vertices=np.concatenate([found.vertices, [(3, -1, -1), (77, -1, -1)]]),
            weights=np.concatenate([found.weights, [(1.0, 0.0, 0.0)] * 2]),
            polygons=np.concatenate([found.polygons, [-1, -1]]),
            splits=found.splits,
            along=np.concatenate([found.along, [(count, count + 1)]]),  # no neighbors
            across=found.across,
        )

    monkeypatch.setattr(native.load(), "plan_cuts", astray)
    with pytest.raises(ValueError, match="A wire does not run over the mesh near vertex 3"):
        cut("0 44")
    assert snapshot(obj) == before
    assert session_on(obj).session.wires == ()


def refuse(monkeypatch: pytest.MonkeyPatch, call: int) -> None:
    """Let a cut end on an error, at one of its faces."""
    split, calls = bmesh.utils.face_split_edgenet, []

    def split_some(face: bmesh.types.BMFace, edges: list[bmesh.types.BMEdge]) -> object:
        calls.append(1)
        if len(calls) == call:
            raise KeyError("refused on purpose")
        return split(face, edges)

    class Utils:
        edge_split = staticmethod(bmesh.utils.edge_split)
        face_split_edgenet = staticmethod(split_some)

    monkeypatch.setattr(finishes.bmesh, "utils", Utils)


@pytest.mark.every_blender
@pytest.mark.parametrize("keys", [False, True], ids=["", "shape keys"])
def test_a_cut_that_ends_on_an_error_leaves_every_mesh_as_it_was(monkeypatch: pytest.MonkeyPatch, keys: bool) -> None:
    objects = [add_grid(9, name=name) for name in ("First", "Second")]
    for obj in objects:
        add_layers(obj)
        obj.select_set(True)
        if keys:
            obj.shape_key_add(name="Basis")
            for point in obj.shape_key_add(name="Wavy", from_mix=False).data:
                point.co.z += 0.1 * point.co.x
            obj.active_shape_key_index = 1
    edit()
    for obj in objects:
        select_some(obj, "VERT")
    for obj in objects:
        mark_wires("0 44; 8 36", obj=obj, along="SURFACE")
    bpy.ops.ed.undo_push(message="Before")
    before = [(snapshot(obj), seams(obj), obj.data.seamwire_wires) for obj in objects]
    refuse(monkeypatch, 12)  # the first mesh is planned by then
    with pytest.raises(RuntimeError, match="refused on purpose"):
        bpy.ops.mesh.seamwire_finish(finish="CUT")
    assert [(snapshot(obj), seams(obj), obj.data.seamwire_wires) for obj in objects] == before
    monkeypatch.undo()
    assert bpy.ops.mesh.seamwire_finish(finish="CUT") == {"FINISHED"}


def select_some(obj: bpy.types.Object, mode: str) -> None:
    """Select some faces of a mesh in a select mode, and make one active."""
    bpy.context.tool_settings.mesh_select_mode = [mode == name for name in ("VERT", "EDGE", "FACE")]
    with changing(obj) as bm:
        bm.select_mode = {mode}
        for item in (*bm.verts, *bm.edges, *bm.faces):
            item.select = False
        for number in (1, 2, 9, 18, 27):
            bm.faces[number].select = True
        bm.select_history.clear()
        if mode == "FACE":
            bm.select_history.add(bm.faces[9])
        bm.faces.active = bm.faces[9]
        bm.select_flush_mode()


@pytest.mark.every_blender
@pytest.mark.parametrize("mode", ["VERT", "EDGE", "FACE"])
def test_what_lies_on_selected_faces_is_selected_after_a_cut(mode: str) -> None:
    obj = add_grid(9)
    edit()
    select_some(obj, mode)
    area = sum(face.calc_area() for face in bmesh.from_edit_mesh(obj.data).faces if face.select)
    # Of the face that the last wire begins in, only an edge is split.
    assert cut("0 44; 1 30; (-0.4 -0.9 0) 80")
    bm = bmesh.from_edit_mesh(obj.data)
    selected = [face for face in bm.faces if face.select]
    assert sum(face.calc_area() for face in selected) == pytest.approx(area)
    assert len(selected) > 5
    for face in selected:
        assert all(item.select for item in (*face.verts, *face.edges))
    for edge in bm.edges:
        assert not edge.select or all(vert.select for vert in edge.verts)
        if mode == "VERT":
            assert edge.select == all(vert.select for vert in edge.verts)


def test_faces_around_a_corner_of_the_mesh_are_cut() -> None:
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.active_object
    bm = bmesh.new()
    bmesh.ops.create_cube(bm, size=2)
    bmesh.ops.subdivide_edges(bm, edges=bm.edges, cuts=1, use_grid_fill=True)
    bm.verts.ensure_lookup_table()
    bmesh.ops.dissolve_verts(bm, verts=[bm.verts[9], bm.verts[15]])
    bm.to_mesh(obj.data)
    bm.free()
    edit()
    assert cut("19 1")
    assert 1 in joined(obj, 19)
    assert is_sound(obj)


@pytest.mark.every_blender
def test_a_mesh_of_edges_alone_has_no_places() -> None:
    obj = add_object([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [], [(0, 1), (1, 2)])
    edit()
    for run in (lambda: cut("(0 0 0) 2"), lambda: mark_wires(loops="(0 0 0)", along="SURFACE")):
        with pytest.raises(ValueError, match="No face is visible"):
            run()
    assert seams(obj) == []


def add_unlike_halves(count: int = 1) -> bpy.types.Object:
    """Add a cube whose quads are cut into triangles the same way on both sides, not mirrored."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.active_object
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=count)
    bpy.ops.mesh.quads_convert_to_tris(quad_method="FIXED")
    return obj


@pytest.mark.every_blender
@pytest.mark.parametrize("chains", ["1 23", "3 15", "7 25", "0 13", "25 7", "6 9"])
def test_an_image_is_cut_across_other_triangles(chains: str, capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_unlike_halves()
    assert cut(chains, mirror={"X"})
    assert "Warning" not in capfd.readouterr().out
    lengths = defaultdict(float)
    for edge in bmesh.from_edit_mesh(obj.data).edges:
        if edge.seam:
            middle = 0.5 * (edge.verts[0].co.x + edge.verts[1].co.x)
            lengths[math.copysign(1.0, middle) if abs(middle) > 1e-6 else 0.0] += edge.calc_length()
    assert lengths[1.0] == pytest.approx(lengths[-1.0], rel=1e-5)
    assert lengths[1.0] > 0.5
    assert is_sound(obj)


def test_an_image_that_leaves_the_mesh_is_left_out() -> None:
    obj = add_grid(9)
    for v in obj.data.vertices:
        if 0.2 < v.co.x < 0.9 and abs(v.co.y) < 0.6:
            v.co.z = 0.6
    edit()
    problems = cut("0 74", mirror="X").problems
    assert problems == ("1 wire or mirror image not cut: it does not run over the mesh",)
    assert 74 in joined(obj, 0)
    assert 8 not in {v for pair in seams(obj) for v in pair}


@pytest.mark.every_blender
@pytest.mark.parametrize("chains", ["68 291", "32 130", "48 249", "228 136", "55 83"])
def test_slid_wires_can_be_cut(chains: str) -> None:
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.active_object
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=6)
    mark_wires(chains=chains, along="SURFACE", finish="SLIDE")
    (wire,) = session_on(obj).session.wires
    length = float(np.linalg.norm(np.diff(wire.points, axis=0), axis=1).sum())
    assert bpy.ops.mesh.seamwire_finish(finish="CUT") == {"FINISHED"}
    assert wire.end in joined(obj, wire.start)
    cuts = sum(edge.calc_length() for edge in bmesh.from_edit_mesh(obj.data).edges if edge.seam)
    assert cuts == pytest.approx(length, rel=0.01)
    assert is_sound(obj)


@pytest.mark.every_blender
def test_kept_wires_are_cut_and_their_snapped_seams_are_gone() -> None:
    obj = add_scan()
    edit()
    mark_wires(chains="0 3 70", along="SURFACE")
    mark_wires(chains="400 900", along="EDGES")
    snapped = set(seams(obj))
    assert bpy.ops.mesh.seamwire_finish(finish="CUT") == {"FINISHED"}
    assert {3, 70} <= joined(obj, 0)
    assert 900 in joined(obj, 400), "wires along edges stay"
    assert len(snapped - set(seams(obj))) > 5, "the staircase is gone"
    with pytest.raises(RuntimeError, match="No kept wire runs across the surface"):
        bpy.ops.mesh.seamwire_finish(finish="CUT")


def test_an_object_that_shows_nothing_is_in_nobodys_way() -> None:
    hidden, obj = add_grid(5, name="Hidden"), add_grid(9)
    hidden.select_set(True)
    edit()
    for face in bmesh.from_edit_mesh(hidden.data).faces:
        face.hide_set(True)
    bmesh.update_edit_mesh(hidden.data)
    mark_wires(chains="0 44", along="SURFACE")
    assert bpy.ops.mesh.seamwire_finish(finish="CUT") == {"FINISHED"}
    assert len(seams(obj)) == 8


def test_a_kept_wire_that_is_crossed_stays_a_wire() -> None:
    obj = add_grid(9)
    edit()
    mark_wires(chains="36 44", along="EDGES")
    cut("1 76")
    wire, across = sorted(session_on(obj).session.wires, key=lambda own: -own.start)
    assert (wire.start, wire.end) == (36, 44)
    assert len(wire.vertices) == 10, "with the vertex where it is crossed"
    assert {across.start, across.end} == {1, 76}
    assert len(set(wire.vertices) & set(across.vertices)) == 1


def test_a_closed_chain_that_is_cut_keeps_its_seeds() -> None:
    obj = add_grid(9)
    edit()
    mark_wires(chains="10 16 70 64 10", along="SURFACE", finish="CUT")
    assert agree(obj)
    assert len(session_on(obj).session.wires) == 4


def seam_places(obj: bpy.types.Object) -> dict[tuple[float, float], int]:
    """Return where the seams of a flat mesh in edit mode have vertices, and how many seams meet there."""
    vertices = bpy.context.active_object.data.vertices
    obj.update_from_editmode()
    return {tuple(round(c, 5) for c in vertices[v].co[:2]): count for v, count in _counts(seams(obj)).items()}


def test_a_closed_chain_of_places_cuts_an_island_out() -> None:
    obj = add_grid(5)
    edit()
    corners = ((-0.7, -0.6), (0.7, -0.55), (0.1, 0.8))
    text = " ".join(f"({x} {y} 0)" for x, y in (*corners, corners[0]))
    assert cut(text)
    assert island_count(obj) == 2
    counts = seam_places(obj)
    assert set(counts.values()) == {2}
    assert set(corners) <= set(counts)
    assert agree(obj)


def test_a_wire_that_stays_inside_a_face_cuts_nothing_and_says_so() -> None:
    obj = add_grid(2)
    edit()
    with pytest.raises(ValueError, match="Nothing to cut: every wire stays inside one face"):
        cut("(-0.5 0 0) (0.2 0.3 0)")
    assert len(obj.data.polygons) == 1 and seams(obj) == []


def test_places_snap_to_the_vertices_nearest_to_them() -> None:
    obj = add_grid(5)
    edit()
    mark_wires(chains="(-0.9 -0.95 0) (0.05 -0.9 0)", along="SURFACE")
    assert seams(obj) == [(0, 1), (1, 2)]
    with pytest.raises(ValueError, match="not a place"):
        mark_wires(chains="(-0.9 -0.9 0) 12", along="EDGES")


def test_seams_cannot_be_cleared_by_a_cut() -> None:
    add_grid(5)
    edit()
    with pytest.raises(ValueError, match="cannot clear seams"):
        cut("0 14", clear=True)
    mark_wires(chains="0 4", along="EDGES", finish="CUT")
    assert mark_wires(chains="0 4", along="EDGES", finish="CUT", clear=True)
    assert seams(bpy.context.active_object) == [], "along edges there is nothing to cut"


@pytest.mark.every_blender
def test_hidden_faces_are_not_cut() -> None:
    obj = add_grid(9)
    edit()
    with changing(obj) as bm:
        for face in bm.faces:
            face.hide_set(face.calc_center_median().x > 0.5)
    hidden = sum(face.hide for face in bm.faces)
    assert cut("0 76")
    bm = bmesh.from_edit_mesh(obj.data)
    assert sum(face.hide for face in bm.faces) == hidden


def drag(obj: bpy.types.Object, seed: int, to: int) -> None:
    """Drag a seed of a kept wire to another vertex, as the tool does."""
    mesh = session_on(obj)
    session, before = mesh.session, mesh.session.drawn
    assert session.drag(seed)
    session.drag_to(to)
    session.wait()
    session.drag_to(to)
    assert session.drag_end()
    _finish(mesh, before)


def remove(obj: bpy.types.Object, *seeds: int) -> None:
    """Remove the wires that begin or end at some seeds, as the tool does."""
    mesh = session_on(obj)
    network = mesh.session.drawn
    for wire in network.wires:
        if {wire.start, wire.end} & {*seeds}:
            mesh.session.drop(wire)
    _finish(mesh, network)


def _finish(mesh: ObjectSession, before: Drawn) -> None:
    change = Change(before, mesh.session.drawn)
    write(mesh)
    finishes.apply(mesh, change)


def vertex_near(obj: bpy.types.Object, place: tuple[float, float, float]) -> int:
    bm = bmesh.from_edit_mesh(obj.data)
    return min(bm.verts, key=lambda v: (v.co - Vector(place)).length).index


INSIDE = (0.1, 0.06, 0.0)
"""A place inside a face of a 9 x 9 grid, where a chain from vertex 75 to vertex 10 bends."""


def chain_inside(triangulated: bool, *seeds: tuple[float, float, float] | int) -> bpy.types.Object:
    """Add a grid, and cut a chain from vertex 75 over places inside faces to a vertex."""
    obj = add_grid(9)
    edit()
    if triangulated:
        with changing(obj) as bm:
            bmesh.ops.triangulate(bm, faces=bm.faces[:])
    assert cut(" ".join(f"({x[0]} {x[1]} {x[2]})" if isinstance(x, tuple) else str(x) for x in (75, *seeds)))
    return obj


def at(obj: bpy.types.Object, place: tuple[float, float, float]) -> int:
    """Return the vertex at a place."""
    vertex = vertex_near(obj, place)
    assert (bmesh.from_edit_mesh(obj.data).verts[vertex].co - Vector(place)).length < 1e-4
    return vertex


def joins(obj: bpy.types.Object) -> set[frozenset[int]]:
    """Return the seeds that cut wires join, if all seams are theirs and the seams form one open chain."""
    wires = session_on(obj).session.wires
    ends = {v for v, count in _counts(seams(obj)).items() if count == 1}
    assert agree(obj)
    assert all(wire.is_cut for wire in wires)
    assert len(ends) == 2 and joined(obj, min(ends)) >= ends
    return {frozenset((wire.start, wire.end)) for wire in wires}


@pytest.mark.every_blender
@pytest.mark.parametrize("triangulated", [False, True], ids=["quads", "triangles"])
@pytest.mark.parametrize("to", [1, 9, 11, 19, 45, 54, 79])
def test_a_wire_stays_whole_where_another_is_dragged_from_their_seed_inside_a_face(to: int, triangulated: bool) -> None:
    obj = chain_inside(triangulated, INSIDE, 10)
    drag(obj, 10, to)
    seed = at(obj, INSIDE)
    assert joins(obj) == {frozenset((75, seed)), frozenset((seed, to))}
    assert is_sound(obj)


def undone(_path: Path) -> None:
    bpy.ops.ed.undo_push(message="Cut")
    bpy.ops.ed.undo_push(message="Another step")
    bpy.ops.ed.undo()


def redone(_path: Path) -> None:
    bpy.ops.ed.undo_push(message="Cut")
    bpy.ops.ed.undo()
    bpy.ops.ed.redo()


def saved(path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(path / "cut.blend"), check_existing=False)
    bpy.ops.wm.open_mainfile(filepath=str(path / "cut.blend"))


def tabbed(_path: Path) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    edit()


@pytest.mark.every_blender
@pytest.mark.parametrize("between", [undone, redone, saved, tabbed], ids=lambda between: between.__name__)
def test_removing_a_cut_wire_leaves_the_faces_cut_whatever_blender_did_with_the_mesh_meanwhile(
    between: Callable[[Path], None], tmp_path: Path
) -> None:
    obj = add_grid(9)
    name = obj.name
    edit()
    bpy.ops.ed.undo_push(message="Before")
    assert cut("0 (0.1 0.06 0) 44; 8 36")
    between(tmp_path)
    obj = bpy.data.objects[name]
    before = by_place(obj)
    network = session_on(obj).session.drawn
    assert len(network.wires) == 5, "two of them cross"
    remove(obj, *(wire.start for wire in network.wires))
    assert seams(obj) == []
    assert not session_on(obj).session.wires
    assert obj.data.seamwire_wires == ""
    assert by_place(obj)["places"] == before["places"]
    assert is_sound(obj)


def add_triangles() -> bpy.types.Object:
    obj = add_grid(7)
    edit()
    with changing(obj) as bm:
        bmesh.ops.triangulate(bm, faces=bm.faces[:])
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def some_places(obj: bpy.types.Object, dice: random.Random, count: int) -> str:
    """Return places inside triangles of a mesh in edit mode, as text."""
    bm, found = bmesh.from_edit_mesh(obj.data), []
    for corners in dice.sample(bm.calc_loop_triangles(), count):
        shares = [dice.uniform(0.1, 1.0) for _ in corners]
        places = [share / sum(shares) * corner.vert.co for share, corner in zip(shares, corners, strict=True)]
        found.append("({} {} {})".format(*sum(places, Vector())))
    return " ".join(found)


@pytest.mark.every_blender
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    "make", [lambda: add_grid(5), add_triangles, add_hills], ids=["quads", "triangles", "polygons"]
)
def test_after_any_cuts_drags_and_removals_the_mesh_is_sound(make: Callable[[], bpy.types.Object], seed: int) -> None:
    dice, obj = random.Random(seed), make()
    count = len(obj.data.vertices)
    edit()
    for _ in range(8):
        wires = session_on(obj).session.wires
        act = dice.choice(["cut", "drag", "remove"]) if wires else "cut"
        ends = [end for wire in wires for end in (wire.start, wire.end)] or [0]
        if act == "cut":
            begin = f"{dice.choice(ends)} " if dice.random() < 0.5 else ""
            cut(begin + some_places(obj, dice, 3))
        elif act == "drag":
            drag(obj, dice.choice(ends), dice.randrange(count))
        else:
            remove(obj, dice.choice(ends))
        assert agree(obj), act
        assert is_sound(obj), act
    while wires := session_on(obj).session.wires:
        remove(obj, wires[0].start)
    assert seams(obj) == []


@pytest.mark.every_blender
@pytest.mark.parametrize("change", ["join", "duplicate", "subdivide", "symmetrize", "hide"])
def test_cut_wires_are_removed_from_a_mesh_that_blender_changed(change: str) -> None:
    obj, other = add_grid(7), add_grid(5)
    edit()
    assert cut("0 (0.1 0.06 0) 27; 6 28; (0.3 -0.9 0) (0.35 0.25 0)", obj=obj)
    bpy.ops.mesh.select_all(action="SELECT")
    if change == "join":
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        other.select_set(True)
        bpy.ops.object.join()
        edit()
    elif change == "hide":
        with changing(obj) as bm:
            for face in bm.faces[:20]:
                face.hide_set(True)
    else:
        getattr(bpy.ops.mesh, change)()
    while wires := session_on(obj).session.wires:
        remove(obj, wires[0].start)
        assert is_sound(obj)
    # Symmetrize and Hide leave parts of wires, which are plain seams then.
    assert seams(obj) == [] or change in {"symmetrize", "hide"}


def test_no_two_layers_have_the_same_name() -> None:
    """Blender 5 loses one of two layers with the same name on undo, also if they belong to vertices and edges."""
    obj = add_grid(9)
    obj.data.uv_layers.new()
    edit()
    cut("0 44; 8 36")
    bpy.ops.mesh.seamwire_unwrap()
    names = [name for _, _, layers in layer_kinds(bmesh.from_edit_mesh(obj.data)) for name, _ in layers.items()]
    assert len([name for name in names if name.startswith(LABELS)]) == 2
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("moved", [0.0, 2.0], ids=["", "beside it"])
@pytest.mark.parametrize("sheet", [0, 1])
@pytest.mark.parametrize("row", [0, 2, 6])
def test_a_dragged_cut_stays_on_its_part_of_the_mesh_where_another_lies(moved: float, sheet: int, row: int) -> None:
    points, faces = [], []
    for x in (0.0, moved):
        grid = add_grid(9)
        faces += [[v + len(points) for v in face.vertices] for face in grid.data.polygons]
        points += [(vertex.co.x + x, vertex.co.y, 0.0) for vertex in grid.data.vertices]
        bpy.data.objects.remove(grid)
    obj = add_object(points, faces)
    edit()
    # The border of the one is where that of the other is, side by side.
    border = 9 * row + (8 if sheet == 0 else 0)
    first, seed, to = (81 * sheet + v for v in (border, 40, 50 if row == 2 else 48))
    cut(f"{first} {seed}")
    own = joined(obj, first)
    assert seams(obj) and {v for pair in seams(obj) for v in pair} <= own
    drag(obj, seed, to)
    own = joined(obj, first)
    assert {first, to} <= {v for pair in seams(obj) for v in pair} <= own
    assert agree(obj)
    (wire,) = session_on(obj).session.wires
    assert wire.is_cut


def test_mirror_images_of_a_cut_follow_its_seed() -> None:
    obj = add_grid(9)
    obj.data.use_mirror_x = True
    edit()
    cut("1 38", mirror={"X"})
    (wire,) = session_on(obj).session.wires
    assert wire.mirror == (0,)
    assert wire.images
    drag(obj, vertex_near(obj, (-0.5, 0.0, 0.0)), vertex_near(obj, (-0.25, 0.5, 0.0)))
    assert agree(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    middles = [tuple(round(x, 4) for x in sum((v.co for v in e.verts), Vector()) / 2) for e in bm.edges if e.seam]
    assert middles
    assert {(-x + 0.0, y, z) for x, y, z in middles} == set(middles)
    straight = Vector((-0.75, -1.0, 0.0)) - Vector((-0.25, 0.5, 0.0))
    assert sum(e.calc_length() for e in bm.edges if e.seam) == pytest.approx(2.0 * straight.length, rel=1e-5)


def lines(obj: bpy.types.Object, *ends: tuple[tuple[float, float], tuple[float, float]]) -> ObjectSession:
    """Keep wires across the surface between the vertices nearest to places, and return the session that has them."""
    bm = bmesh.from_edit_mesh(obj.data)
    near = [[min(bm.verts, key=lambda v: (v.co.xy - Vector(place)).length).index for place in pair] for pair in ends]
    chains = "; ".join(f"{a} {b}" for a, b in near)
    assert mark_wires(chains=chains, along="SURFACE", finish="SNAP")
    return session_on(obj)


def cut_with(mesh: ObjectSession, crumb: float) -> None:
    wires = mesh.session.wires
    finishes.cut(mesh, finishes.plan_cut(mesh, wires), wires, kept=True, crumb=crumb)


@pytest.mark.parametrize(("crumb", "islands"), [(0.0, 7), (5e-4, 7), (1e-3, 6)])
def test_what_is_smaller_than_a_crumb_is_no_island(crumb: float, islands: int) -> None:
    obj = add_grid(21)
    edit()
    # Three lines, which enclose 0.07 % of the square in its middle.
    mesh = lines(obj, ((-1.0, 0.0), (1.0, 0.0)), ((-0.2, -1.0), (0.3, 1.0)), ((0.3, -1.0), (-0.1, 1.0)))
    cut_with(mesh, crumb)
    assert island_count(obj) == islands
    assert agree(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not obj.data.validate(verbose=True)


def test_small_parts_of_a_mesh_are_cut_all_the_same() -> None:
    obj = add_grid(21)
    edit()
    with changing(obj) as bm:
        bmesh.ops.create_grid(bm, x_segments=4, y_segments=4, size=0.02, matrix=Matrix.Translation((3.0, 0.0, 0.0)))
    mesh = lines(obj, ((2.98, -0.02), (3.02, 0.01)))
    cut_with(mesh, 1e-3)
    assert island_count(obj) == 3


def test_a_seam_that_was_there_stays_though_it_borders_a_crumb() -> None:
    obj = add_grid(21)
    edit()
    with changing(obj) as bm:
        row = [bm.edges.get((bm.verts[10 * 21 + x], bm.verts[10 * 21 + x + 1])) for x in range(20)]
        for edge in row:
            edge.seam = True
    # The part of it between the two others is the longest border of what they enclose with it, 0.25 % of the square.
    mesh = lines(obj, ((-1.0, 0.0), (1.0, 0.0)), ((-1.0, -0.2), (1.0, 0.3)), ((-1.0, 0.3), (1.0, -0.2)))
    cut_with(mesh, 5e-3)
    assert island_count(obj) == 6
    across = [edge for edge in bmesh.from_edit_mesh(obj.data).edges if all(abs(v.co.y) < 1e-6 for v in edge.verts)]
    assert sum(edge.calc_length() for edge in across) == pytest.approx(2.0)
    assert all(edge.seam for edge in across)
