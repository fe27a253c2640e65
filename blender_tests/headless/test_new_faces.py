# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are made after unwrapping: *Unwrap Changed* unwraps their islands if the map has no good place for them."""

from collections.abc import Callable

import bmesh
import bpy
import numpy as np
import pytest
import seamwire
from maps import flipped, overlapping_pairs
from scene import add_grid, changing, edit, snapshot

pytestmark = pytest.mark.every_blender
BLENDER, SEAMWIRE = "by Blender", "by Seamwire"


def add_ball() -> bpy.types.Object:
    """Add a ball of 12 x 12 faces with two islands."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=12)
    obj = bpy.context.active_object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    for edge in obj.data.edges:
        edge.use_seam = all(abs(obj.data.vertices[vertex].co.z) < 1e-5 for vertex in edge.vertices)
    return obj


def add_tube() -> bpy.types.Object:
    """Add an open tube with a seam along it."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=16, end_fill_type="NOTHING")
    obj = bpy.context.active_object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    next(edge for edge in obj.data.edges if edge.key == (0, 1)).use_seam = True
    edit()
    with changing(obj) as bm:
        bmesh.ops.bisect_plane(bm, geom=[*bm.verts, *bm.edges, *bm.faces], plane_co=(0, 0, 0), plane_no=(0, 0, 1))
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def unwrap_first(obj: bpy.types.Object, how: str) -> None:
    if how == SEAMWIRE:
        assert seamwire.unwrap(obj)
        return
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.02)
    bpy.ops.object.mode_set(mode="OBJECT")


def check_whole(obj: bpy.types.Object) -> None:
    """Check that the map has each face once with an area, and that nothing more is to be done."""
    edit()
    assert not flipped(obj)
    assert not overlapping_pairs(obj)
    before = snapshot(obj)
    assert not seamwire.unwrap(obj), "a second time there is nothing to do"
    assert snapshot(obj) == before
    bpy.ops.object.mode_set(mode="OBJECT")


def delete_faces(obj: bpy.types.Object, chosen: Callable[[bmesh.types.BMFace], bool]) -> None:
    edit()
    with changing(obj) as bm:
        bmesh.ops.delete(bm, geom=[face for face in bm.faces if chosen(face)], context="FACES")
    bpy.ops.object.mode_set(mode="OBJECT")


def open_border(obj: bpy.types.Object) -> None:
    """Select the edges that have one face."""
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.select_set(edge.is_boundary)


def fill_by_f(obj: bpy.types.Object) -> None:
    """Fill each border with one face."""
    for side in (-1.0, 1.0):
        bpy.ops.mesh.select_mode(type="EDGE")
        bpy.ops.mesh.select_all(action="DESELECT")
        with changing(obj) as bm:
            for edge in bm.edges:
                edge.select_set(edge.is_boundary and all(side * vertex.co.z > -1e-4 for vertex in edge.verts))
            is_open = any(edge.select for edge in bm.edges)
        if is_open:
            bpy.ops.mesh.edge_face_add()


def fill_holes(obj: bpy.types.Object) -> None:
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.fill_holes(sides=0)


def fill_with_triangles(obj: bpy.types.Object) -> None:
    open_border(obj)
    bpy.ops.mesh.fill()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.normals_make_consistent()


def fill_with_grids(obj: bpy.types.Object) -> None:
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.select_set(edge.is_boundary and all(vertex.co.z > 0.0 for vertex in edge.verts))
        count = len(bm.faces)
    bpy.ops.mesh.fill_grid(span=4)
    assert len(bmesh.from_edit_mesh(obj.data).faces) == count + 16


def bridge(obj: bpy.types.Object) -> None:
    open_border(obj)
    bpy.ops.mesh.bridge_edge_loops()


FILLS = {
    "F": fill_by_f,
    "holes": fill_holes,
    "triangles": fill_with_triangles,
    "grid": fill_with_grids,
    "bridge": bridge,
}


@pytest.mark.parametrize("first", [SEAMWIRE, BLENDER])
@pytest.mark.parametrize("fill", FILLS.values(), ids=FILLS)
def test_the_ends_of_a_tube_that_are_filled_later_get_a_place(
    fill: Callable[[bpy.types.Object], None], first: str
) -> None:
    obj = add_tube()
    unwrap_first(obj, first)
    edit()
    fill(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert seamwire.unwrap(obj), "islands with new faces have changed"
    check_whole(obj)


def test_a_hole_that_fits_the_map_keeps_all_uvs() -> None:
    obj = add_grid(7)
    delete_faces(obj, lambda face: face.index in {14, 15, 20, 21})
    unwrap_first(obj, SEAMWIRE)
    edit()
    fill_by_inner_hole(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not seamwire.unwrap(obj)
    check_whole(obj)


def fill_by_inner_hole(obj: bpy.types.Object) -> None:
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.select_set(edge.is_boundary and all(max(map(abs, v.co)) < 0.9 for v in edge.verts))
    bpy.ops.mesh.edge_face_add()


def extrude(_obj: bpy.types.Object) -> None:
    bpy.ops.mesh.extrude_region_move(TRANSFORM_OT_translate={"value": (0.0, 0.0, 0.7)})


def solidify(obj: bpy.types.Object) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.modifiers.new("Thick", "SOLIDIFY").thickness = 0.2
    bpy.ops.object.modifier_apply(modifier="Thick")


def mirror(obj: bpy.types.Object) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.modifiers.new("Both", "MIRROR").mirror_offset_u = 0.0
    for vertex in obj.data.vertices:
        vertex.co.x += 1.0
    bpy.ops.object.modifier_apply(modifier="Both")


MAKERS = {"extrude": extrude, "solidify": solidify, "mirror": mirror}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_faces_without_a_place_and_faces_that_lie_on_others_are_unwrapped(
    make: Callable[[bpy.types.Object], None],
) -> None:
    obj = add_grid(5)
    unwrap_first(obj, SEAMWIRE)
    edit()
    with changing(obj) as bm:
        for face in bm.faces:
            face.select_set(face.index in {5, 6, 9, 10})
    make(obj)
    if obj.mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    assert seamwire.unwrap(obj)
    edit()
    assert not flipped(obj) and not overlapping_pairs(obj)


def test_joined_meshes_without_a_map_are_unwrapped_and_the_others_stay() -> None:
    obj = add_grid(5, name="Mapped")
    unwrap_first(obj, SEAMWIRE)
    uvs = np.empty(2 * 64, dtype=np.float32)
    obj.data.uv_layers.active.data.foreach_get("uv", uvs)
    other = add_grid(4, name="Bare")
    for vertex in other.data.vertices:
        vertex.co.z += 3.0
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    other.select_set(True)
    bpy.ops.object.join()
    assert seamwire.unwrap(obj)
    now = np.empty(2 * len(obj.data.loops), dtype=np.float32)
    obj.data.uv_layers.active.data.foreach_get("uv", now)
    assert np.array_equal(now[:128], uvs)
    check_whole(obj)


def test_cuts_that_interpolate_the_map_keep_all_uvs() -> None:
    obj = add_grid(5)
    unwrap_first(obj, SEAMWIRE)
    edit()
    with changing(obj) as bm:
        bmesh.ops.bisect_plane(bm, geom=[*bm.verts, *bm.edges, *bm.faces], plane_co=(0.13, 0, 0), plane_no=(1, 0.3, 0))
        bmesh.ops.subdivide_edges(bm, edges=bm.edges[:6], cuts=1, use_grid_fill=True)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.inset(thickness=0.002, use_individual=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not seamwire.unwrap(obj)
    check_whole(obj)


def test_hidden_faces_are_counted_and_unwrapped_when_they_are_shown(capfd: pytest.CaptureFixture) -> None:
    obj = add_ball()
    obj.data.polygons.foreach_set("hide", np.arange(144) % 12 < 5)
    unwrap_first(obj, SEAMWIRE)
    assert "60 hidden faces have no place in the map" in capfd.readouterr().out
    obj.data.polygons.foreach_set("hide", np.zeros(144, dtype=bool))
    assert seamwire.unwrap(obj)
    check_whole(obj)


def test_a_map_folded_by_somebody_else_stays() -> None:
    obj = add_grid(5)
    layer = obj.data.uv_layers.new()
    for corner in obj.data.loops:
        x, y, _ = obj.data.vertices[corner.vertex_index].co
        layer.data[corner.index].uv = abs(x), 0.5 + 0.5 * y
    assert not seamwire.unwrap(obj)
