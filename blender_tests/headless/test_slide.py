# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices slid onto wires: `seamwire.mark` with ``finish="SLIDE"`` and ``mesh.seamwire_finish``."""

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_grid, add_layers, changing, edit, mark_wires, seams, snapshot
from stored import agree, session_on

CHAIN = "14 45"


def mark(finish: str = "SLIDE", chains: str = CHAIN, **options: object) -> set[str]:
    return mark_wires(chains=chains, along="SURFACE", finish=finish, strength=1.0, **options)


def places(obj: bpy.types.Object, key: str = "") -> np.ndarray:
    obj.update_from_editmode()
    data = obj.data.shape_keys.key_blocks[key].data if key else obj.data.vertices
    return np.array([item.co[:] for item in data])


def off_line(places: np.ndarray) -> np.ndarray:
    """Return how far places are from the straight line between the first and the last."""
    along = places[-1] - places[0]
    return np.linalg.norm(np.cross(places - places[0], along / np.linalg.norm(along)), axis=1)


def add_quads(**uv: object) -> bpy.types.Object:
    obj = add_grid(12, **uv)
    edit()
    return obj


def add_triangles() -> bpy.types.Object:
    """Add triangles cut like the chain runs: of a quad three vertices would come to lie in a line."""
    obj = add_quads()
    bpy.ops.mesh.quads_convert_to_tris(quad_method="FIXED_ALTERNATE")
    return obj


@pytest.mark.every_blender
def test_the_seam_lies_on_the_wire_and_nothing_else_changes() -> None:
    obj = add_triangles()
    before = places(obj)
    faces = [tuple(face.vertices) for face in obj.data.polygons]
    assert mark("SNAP")
    snapped = seams(obj)
    (snapped_wire,) = session_on(obj).session.wires
    chain = list(snapped_wire.vertices)
    assert off_line(places(obj)[chain]).max() > 0.02
    assert bpy.ops.mesh.seamwire_finish(finish="SLIDE") == {"FINISHED"}
    assert seams(obj) == snapped
    after = places(obj)
    assert off_line(after[chain]).max() < 1e-6
    others = np.setdiff1d(np.arange(len(before)), chain)
    assert np.array_equal(before[others], after[others])
    assert [tuple(face.vertices) for face in obj.data.polygons] == faces
    assert agree(obj)
    (wire,) = session_on(obj).session.wires
    assert wire.along == "SURFACE"
    assert wire.points == pytest.approx(snapped_wire.points, abs=1e-6), "its curve as it was"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not obj.data.validate()


def test_at_once_is_the_same_as_afterwards() -> None:
    found = []
    for at_once in (True, False):
        obj = add_quads()
        mark("SLIDE" if at_once else "SNAP")
        if not at_once:
            bpy.ops.mesh.seamwire_finish(finish="SLIDE")
        found.append((places(obj), seams(obj)))
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)
    assert np.allclose(found[0][0], found[1][0], atol=1e-7)
    assert found[0][1] == found[1][1]


@pytest.mark.every_blender
def test_what_the_corners_hold_stays_where_it_is_on_the_surface() -> None:
    obj = add_quads()
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.verify()
        color = bm.loops.layers.float_color.new("painted")
        for face in bm.faces:
            for loop in face.loops:
                x, y, _ = loop.vert.co
                loop[layer].uv = (3.0 * x + y, 0.5 - y)
                loop[color] = (x, y, 0.25, 1.0)
    mark()
    bm = bmesh.from_edit_mesh(obj.data)
    layer, color = bm.loops.layers.uv.active, bm.loops.layers.float_color["painted"]
    for face in bm.faces:
        for loop in face.loops:
            x, y, _ = loop.vert.co
            assert loop[layer].uv[:] == pytest.approx((3.0 * x + y, 0.5 - y), abs=1e-5)
            assert loop[color][:] == pytest.approx((x, y, 0.25, 1.0), abs=1e-5)


@pytest.mark.every_blender
def test_islands_of_a_uv_map_stay_apart_and_each_as_it_was() -> None:
    obj = add_quads()
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.verify()
        for face in bm.faces:
            far = face.calc_center_median().y > face.calc_center_median().x
            for loop in face.loops:
                x, y, _ = loop.vert.co
                loop[layer].uv = (10.0 - y, 2.0 * x) if far else (x, y)
    mark(chains="12 140; 24 142")
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    values = [(loop.vert.co.copy(), loop[layer].uv.copy()) for face in bm.faces for loop in face.loops]
    near = [uv[:] == pytest.approx((co.x, co.y), abs=1e-5) for co, uv in values]
    far = [uv[:] == pytest.approx((10.0 - co.y, 2.0 * co.x), abs=1e-5) for co, uv in values]
    assert all(one or other for one, other in zip(near, far, strict=True))
    assert any(near)
    assert any(far)


@pytest.mark.every_blender
@pytest.mark.parametrize("active", [0, 1, 2])
def test_the_surface_stays_in_every_shape_key(active: int) -> None:
    obj = add_grid(12)
    for name in ("Basis", "Tilted", "Turned"):
        obj.shape_key_add(name=name, from_mix=False)
    keys = obj.data.shape_keys.key_blocks
    for item in keys["Tilted"].data:
        item.co.z = 0.7 * item.co.x - 0.2 * item.co.y
    for item in keys["Turned"].data:
        item.co = (-item.co.y, item.co.x, 3.0)
    keys["Turned"].relative_key = keys["Tilted"]
    obj.active_shape_key_index = active
    edit()
    before = {key.name: places(obj, key.name) for key in keys}
    assert mark()
    bpy.ops.object.mode_set(mode="OBJECT")
    after = {key.name: places(obj, key.name) for key in obj.data.shape_keys.key_blocks}
    moved = np.flatnonzero(np.abs(after["Basis"] - before["Basis"]).max(axis=1) > 1e-4)
    assert len(moved)
    flat = after["Basis"]
    assert after["Tilted"] == pytest.approx(
        np.column_stack([flat[:, :2], 0.7 * flat[:, 0] - 0.2 * flat[:, 1]]), abs=1e-5
    )
    assert after["Turned"] == pytest.approx(
        np.column_stack([-flat[:, 1], flat[:, 0], np.full(len(flat), 3.0)]), abs=1e-5
    )


@pytest.mark.every_blender
@pytest.mark.parametrize("what", ["sharp", "crease", "material", "seam"])
def test_vertices_on_marks_stay(what: str) -> None:
    obj = add_quads()
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        column = [edge for edge in bm.edges if all(v.index % 12 == 6 for v in edge.verts)]
        if what == "material":
            for face in bm.faces:
                face.material_index = int(face.calc_center_median().x > bm.verts[:][6].co.x)
        else:
            for edge in column:
                edge.select_set(True)
    if what == "sharp":
        bpy.ops.mesh.mark_sharp()
    elif what == "crease":
        bpy.ops.transform.edge_crease(value=1.0)
    elif what == "seam":
        bpy.ops.mesh.mark_seam()
    before = places(obj)
    mark()
    moved = set(np.flatnonzero(np.abs(places(obj) - before).max(axis=1) > 1e-6).tolist())
    assert moved
    assert not any(vertex % 12 == 6 for vertex in moved)


@pytest.mark.every_blender
def test_undo_and_layers() -> None:
    obj = add_grid(12)
    add_layers(obj)
    edit()
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(obj)
    name = obj.name
    mark()
    bpy.ops.ed.undo_push(message="slid")
    bpy.ops.ed.undo()
    assert snapshot(bpy.data.objects[name]) == before


def test_mirror_images_slide_too() -> None:
    obj = add_quads()
    obj.data.use_mirror_x = True
    before = places(obj)
    mark(chains="14 77")
    after = places(obj)
    flipped = after * (-1.0, 1.0, 1.0)
    partner = np.array([np.argmin(np.linalg.norm(before - place * (-1.0, 1.0, 1.0), axis=1)) for place in before])
    assert np.allclose(flipped[partner], after, atol=1e-6)
    assert (np.abs(after - before).max(axis=1) > 1e-6).sum() >= 4
