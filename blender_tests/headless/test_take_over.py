# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that a mesh has become wires: ``mesh.seamwire_take_over``."""

import bmesh
import bpy
import pytest
from scene import add_grid, add_suzanne, chain, changing, edit, ends, mark_wires, seams, set_seams, snapshot
from stored import agree, chains, session_on, wired, write

ROW, COLUMN = chain(*range(36, 45)), chain(4, 13, 22, 31, 40)


@pytest.fixture
def seamed() -> bpy.types.Object:
    """A grid in edit mode with seams along a row and half a column; vertex y * 9 + x is column x of row y."""
    obj = add_grid(9)
    edit()
    set_seams(obj, *ROW, *COLUMN)
    return obj


@pytest.mark.every_blender
def test_seams_are_wires_then_and_nothing_else_has_changed(seamed: bpy.types.Object) -> None:
    before = snapshot(seamed)
    assert bpy.ops.mesh.seamwire_take_over() == {"FINISHED"}
    assert snapshot(seamed) == before
    assert agree(seamed)
    assert chains(seamed) == [(4, 13, 22, 31, 40), (36, 37, 38, 39, 40), (40, 41, 42, 43, 44)]


def test_a_wire_that_is_dropped_or_moved_takes_its_seam_with_it(seamed: bpy.types.Object) -> None:
    bpy.ops.mesh.seamwire_take_over()
    mesh = session_on(seamed)
    mesh.make_live.wait()
    (column,) = [wire for wire in mesh.session.wires if wire.vertices[0] == 4 or wire.vertices[-1] == 4]
    assert mesh.session.drop(column)
    write(mesh)
    assert seams(seamed) == ROW
    mesh = session_on(seamed)
    assert mesh.session.drag(44)
    mesh.session.wait()
    mesh.session.drag_to(53)
    mesh.session.wait()
    mesh.session.drag_end()
    mesh.session.wait()
    write(mesh)
    assert ends(seams(seamed)) == [36, 53]
    assert agree(seamed)


def test_seams_of_wires_and_those_not_selected_stay_what_they_were(seamed: bpy.types.Object) -> None:
    mark_wires(chains="0 8")
    with changing(seamed) as bm:
        bpy.context.tool_settings.mesh_select_mode = (False, True, False)
        bpy.ops.mesh.select_all(action="DESELECT")
        for pair in COLUMN:
            bm.edges.get([bm.verts[v] for v in pair]).select_set(True)
    assert bpy.ops.mesh.seamwire_take_over(selected=True) == {"FINISHED"}
    assert chains(seamed) == [tuple(range(9)), (4, 13, 22, 31, 40)]
    assert agree(seamed, plain=ROW)


def test_what_there_is_nothing_to_take_over_of_is_said() -> None:
    obj = add_grid(9)
    edit()
    with pytest.raises(RuntimeError, match="No seams to convert"):
        bpy.ops.mesh.seamwire_take_over()
    set_seams(obj, *ROW)
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No selected seams to convert"):
        bpy.ops.mesh.seamwire_take_over(selected=True)
    assert seams(obj) == ROW
    assert wired(obj) == []


def test_seams_of_several_objects_that_run_anyhow() -> None:
    edited = [add_suzanne(), add_grid(9, name="Sheet")]
    for obj in edited:
        obj.select_set(True)
    edit()
    bm = bmesh.from_edit_mesh(edited[0].data)
    jagged = [(e.verts[0].index, e.verts[1].index) for e in bm.edges if e.index % 3 == 0]
    set_seams(edited[0], *jagged)
    set_seams(edited[1], *ROW, *COLUMN)
    before = [seams(obj) for obj in edited]
    assert bpy.ops.mesh.seamwire_take_over() == {"FINISHED"}
    assert [seams(obj) for obj in edited] == before
    for obj in edited:
        bpy.context.view_layer.objects.active = obj
        assert agree(obj)
