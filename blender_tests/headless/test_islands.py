# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands that seams make can be stored, and islands that need another cut can be selected."""

import math
from functools import partial

import bmesh
import bpy
import pytest
from scene import add_grid, add_object, changing, edit, seams, snapshot
from seamwire.mesh.uv_islands import count_islands, faces_to_cut

pytestmark = pytest.mark.every_blender


def add_tube() -> bpy.types.Object:
    """Add an open tube of 8 quads."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=8, end_fill_type="NOTHING")
    return bpy.context.active_object


def mark(obj: bpy.types.Object, wanted: object) -> None:
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.seam = wanted(*(v.co for v in edge.verts))


def halves(a: object, b: object) -> bool:
    """Whether an edge of the grid lies on its middle column."""
    return abs(a.x) < 1e-6 and abs(b.x) < 1e-6


def selected(obj: bpy.types.Object) -> int:
    return sum(face.select for face in bmesh.from_edit_mesh(obj.data).faces)


def numbers(obj: bpy.types.Object, name: str) -> list[tuple[int, bool]]:
    """Return the number of each face and whether it lies on the left."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.faces.layers.int[name]
    return [(face[layer], face.calc_center_median().x < 0) for face in bm.faces]


def test_islands_that_are_no_discs_are_selected_until_they_are_cut() -> None:
    sheet, tube = add_grid(5), add_tube()
    sheet.select_set(True)
    edit()
    assert bpy.ops.mesh.seamwire_select_islands(which="TO_CUT") == {"FINISHED"}
    assert (selected(sheet), selected(tube)) == (0, 8)
    mark(tube, lambda a, b: a.y > 0.99 and b.y > 0.99 and abs(a.z - b.z) > 1.0)
    assert len(seams(tube)) == 1
    assert bpy.ops.mesh.seamwire_select_islands(which="TO_CUT") == {"FINISHED"}
    assert selected(tube) == 0


def test_shells_that_meet_in_a_vertex_need_a_cut_each_and_faces_on_one_edge_none() -> None:
    shell = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (0, 2, 3)]
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 2), (0, 1, 2), (0, 0, 2)]
    obj = add_object(points, [*shell, *(tuple(v + 3 for v in face) for face in shell)])
    edit()
    assert faces_to_cut(obj)[1].tolist() == [1, 1]
    bpy.ops.object.mode_set(mode="OBJECT")
    obj = add_object(
        [(x, 0, z) for x in (0, 1) for z in (0, 1)] + [(0, 1, 0), (1, 1, 0)], [(0, 1, 2), (0, 2, 3), (0, 2, 4)]
    )
    edit()
    faces, missing = faces_to_cut(obj)
    assert (faces.tolist(), missing.tolist()) == ([], [])
    assert count_islands(obj) == 3, "each face is an island"


def test_islands_are_stored_as_an_attribute_and_nothing_else_changes() -> None:
    obj = add_grid(9)
    edit()
    mark(obj, halves)
    before = snapshot(obj)
    assert bpy.ops.mesh.seamwire_store(what="ATTRIBUTE") == {"FINISHED"}
    stored = numbers(obj, "island")
    assert {number for number, _ in stored} == {0, 1}
    assert len(set(stored)) == 2, "one number on either side"
    after = snapshot(obj)
    assert {name: after[name] for name in before} == before
    assert bpy.ops.mesh.seamwire_store(what="ATTRIBUTE") == {"FINISHED"}, "again, into the same"
    assert numbers(obj, "island") == stored


def test_islands_are_stored_as_materials_beside_those_that_are_there() -> None:
    obj = add_grid(9)
    obj.data.materials.append(bpy.data.materials.new("Own"))
    edit()
    mark(obj, halves)
    for _ in range(2):
        assert bpy.ops.mesh.seamwire_store(what="MATERIALS") == {"FINISHED"}
        assert [slot.name == "Own" for slot in obj.data.materials] == [True, False, False]
        sides = {
            (face.material_index, face.calc_center_median().x < 0) for face in bmesh.from_edit_mesh(obj.data).faces
        }
        assert len(sides) == 2
        assert {index for index, _ in sides} == {1, 2}


def test_hidden_faces_keep_what_they_have_and_nothing_visible_is_said() -> None:
    obj = add_grid(9)
    edit()
    with changing(obj) as bm:
        layer = bm.faces.layers.int.new("island")
        bm.faces.ensure_lookup_table()
        bm.faces[0][layer] = 7
        bm.faces[0].hide_set(True)
    bpy.ops.mesh.seamwire_store(what="ATTRIBUTE")
    assert sorted({number for number, _ in numbers(obj, "island")}) == [0, 7]
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    with pytest.raises(RuntimeError, match="No face is visible"):
        bpy.ops.mesh.seamwire_store(what="ATTRIBUTE")


def test_hidden_faces_that_have_nothing_yet_become_no_island() -> None:
    obj = add_grid(9)
    edit()
    mark(obj, halves)
    with changing(obj) as bm:
        bm.faces[0].hide_set(True)
    assert bpy.ops.mesh.seamwire_store(what="ATTRIBUTE") == {"FINISHED"}
    assert {number for number, _ in numbers(obj, "island")} == {-1, 0, 1}
    assert bpy.ops.mesh.seamwire_store(what="MATERIALS") == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    assert {slot is None for slot in obj.data.materials} == {True, False}
    assert [obj.data.materials[face.material_index] is None for face in bm.faces] == [True] + [False] * 63


@pytest.mark.parametrize(("domain", "kind"), [("POINT", "INT"), ("FACE", "FLOAT")])
def test_an_attribute_of_the_users_is_not_taken_for_that_of_the_islands(domain: str, kind: str) -> None:
    obj = add_grid(5)
    obj.data.attributes.new("island", kind, domain)
    edit()
    before = snapshot(obj)
    with pytest.raises(RuntimeError, match="has an attribute 'island' of another kind"):
        bpy.ops.mesh.seamwire_store(what="ATTRIBUTE")
    assert snapshot(obj) == before


def test_what_cannot_be_read_is_said() -> None:
    operators = (
        bpy.ops.mesh.seamwire_store,
        bpy.ops.mesh.seamwire_select_islands,
        partial(bpy.ops.mesh.seamwire_select_islands, which="WORST"),
        bpy.ops.mesh.seamwire_suggest,
    )
    for x, faces, words in ((1.0, [], "No face is visible"), (math.nan, [(0, 1, 2)], "not finite")):
        obj = add_object([(0, 0, 0), (1, 0, 0), (x, 1, 0)], faces, [(0, 1), (1, 2)])
        obj.data.uv_layers.new()
        edit()
        for operator in operators:
            with pytest.raises(RuntimeError, match=words):
                operator()
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)
