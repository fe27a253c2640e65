# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that just miss another one closed: ``mesh.seamwire_close_gaps``."""

import bmesh
import bpy
import pytest
from scene import add_grid, chain, changing, edit, seams, set_seams, snapshot
from stored import agree, chains

ROW, COLUMN = chain(*range(36, 45)), chain(4, 13, 22, 31)


@pytest.fixture
def nearly() -> bpy.types.Object:
    """A grid in edit mode with seams along a row, and down a column to one edge before it; vertex y * 9 + x is column x of row y."""
    obj = add_grid(9)
    edit()
    set_seams(obj, *ROW, *COLUMN)
    return obj


@pytest.mark.every_blender
def test_a_wire_closes_it_and_what_is_marked_stays(nearly: bpy.types.Object) -> None:
    assert bpy.ops.mesh.seamwire_close_gaps() == {"FINISHED"}
    assert seams(nearly) == sorted([*ROW, *COLUMN, (31, 40)])
    assert chains(nearly) == [(31, 40)]
    assert agree(nearly, [*ROW, *COLUMN])
    before = snapshot(nearly)
    assert bpy.ops.mesh.seamwire_close_gaps() == {"CANCELLED"}, "there is none any more"
    assert snapshot(nearly) == before


def test_two_islands_are_three_then(nearly: bpy.types.Object) -> None:
    def islands() -> int:
        assert bpy.ops.mesh.seamwire_store(what="ATTRIBUTE") == {"FINISHED"}
        layer = bmesh.from_edit_mesh(nearly.data).faces.layers.int["island"]
        return len({face[layer] for face in bmesh.from_edit_mesh(nearly.data).faces})

    assert islands() == 2
    bpy.ops.mesh.seamwire_close_gaps()
    assert islands() == 3


def test_longer_ones_stay_open_unless_they_are_asked_for(nearly: bpy.types.Object) -> None:
    before = snapshot(nearly)
    assert bpy.ops.mesh.seamwire_close_gaps(longest=0.3) == {"CANCELLED"}
    assert snapshot(nearly) == before


@pytest.mark.parametrize("hidden", [False, True])
def test_the_edge_of_what_is_hidden_is_no_border(hidden: bool) -> None:
    obj = add_grid(9)
    edit()
    set_seams(obj, range(36, 43))
    with changing(obj) as bm:
        for face in list(bm.faces):
            if face.calc_center_median().x > 0.75:
                face.hide_set(True) if hidden else bm.faces.remove(face)
    assert bpy.ops.mesh.seamwire_close_gaps() == ({"CANCELLED"} if hidden else {"FINISHED"})


def test_where_the_mesh_is_mirrored_both_sides_are_closed() -> None:
    obj = add_grid(9)
    edit()
    set_seams(obj, range(36, 45), (2, 11, 20, 29), (6, 15, 24, 33))
    obj.data.use_mirror_x = True
    assert bpy.ops.mesh.seamwire_close_gaps() == {"FINISHED"}
    assert {(29, 38), (33, 42)} < set(seams(obj))
    assert len(chains(obj)) == 1, "one wire and its image"


def test_all_objects_in_edit_mode_and_none_where_one_fails(nearly: bpy.types.Object) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    other = add_grid(9)
    nearly.select_set(True)
    edit()
    set_seams(other, *ROW, *COLUMN)
    assert bpy.ops.mesh.seamwire_close_gaps() == {"FINISHED"}
    assert (31, 40) in seams(nearly)
    assert (31, 40) in seams(other)
