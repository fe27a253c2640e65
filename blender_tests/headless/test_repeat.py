# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires drawn again wherever they fit: ``mesh.seamwire_repeat``."""

import random

import bpy
import pytest
from scene import add_grid, add_suzanne, changing, edit, mark_wires, seams, snapshot
from stored import agree, chains


@pytest.fixture
def bolts() -> bpy.types.Object:
    """Three cylinders in one mesh, turned, one mirrored, and one of another size; the first vertices are those of the last."""
    for number, scale in enumerate([(1, 1, 3), (1, 1, 2), (-1, 1, 2), (1, 1, 2)]):
        bpy.ops.mesh.primitive_cylinder_add(
            vertices=8, location=(4.0 * number, 0.0, 0.0), rotation=(0.0, 0.3 * number, number)
        )
        bpy.context.active_object.scale = scale
        bpy.context.active_object.select_set(True)
    for obj in bpy.data.objects:
        obj.select_set(obj.type == "MESH" and obj.name.startswith("Cylinder"))
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    bpy.ops.object.join()
    edit()
    return bpy.context.active_object


def parts(bolts: bpy.types.Object) -> list[int]:
    """Return for each seam the number of the cylinder that it is on."""
    return [edge[0] // (len(bolts.data.vertices) // 4) for edge in seams(bolts)]


def test_a_loop_is_drawn_on_all_that_is_alike(bolts: bpy.types.Object) -> None:
    assert mark_wires(loops="0-2", take="CLOSED")
    ring = len(seams(bolts))
    assert bpy.ops.mesh.seamwire_repeat() == {"FINISHED"}
    assert agree(bolts)
    assert [parts(bolts).count(part) for part in range(4)] == [2 * ring] * 4, (
        "both ends of each: their edges are as long"
    )
    before = snapshot(bolts)
    assert bpy.ops.mesh.seamwire_repeat() == {"CANCELLED"}, "it is everywhere"
    assert snapshot(bolts) == before


@pytest.mark.every_blender
def test_all_that_hangs_together_is_repeated_and_one_undo_takes_it_back(bolts: bpy.types.Object) -> None:
    assert mark_wires(chains="0 1 3 2")
    assert len(chains(bolts)) == 3
    drawn = seams(bolts)
    bpy.ops.ed.undo_push(message="Drawn")
    assert bpy.ops.mesh.seamwire_repeat() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="Repeated")
    assert len(set(parts(bolts))) == 3
    assert len(chains(bolts)) == len(seams(bolts)), "each wire is one edge here"
    bpy.ops.ed.undo()
    assert seams(bpy.context.active_object) == drawn


def test_selected_wires_are_repeated_instead(bolts: bpy.types.Object) -> None:
    mark_wires(chains="0 1")
    mark_wires(chains="16 18")
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No selected wire along edges"):
        bpy.ops.mesh.seamwire_repeat(selected=True)


def test_all_wires_are_repeated_or_those_with_selected_edges(bolts: bpy.types.Object) -> None:
    mark_wires(chains="0 1")
    mark_wires(chains="2 3; 16 18")
    bpy.ops.ed.undo_push(message="Drawn")
    select(bolts, 2, 3)
    assert bpy.ops.mesh.seamwire_repeat(selected=True) == {"FINISHED"}
    some = set(seams(bolts))
    assert bpy.ops.mesh.seamwire_repeat() == {"FINISHED"}
    assert some < set(seams(bolts)), "the other wires too, in whatever order they were drawn"


def select(obj: bpy.types.Object, *vertices: int) -> None:
    """Select the edge between two vertices alone."""
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        bm.edges.get([bm.verts[vertex] for vertex in vertices]).select_set(True)


def test_without_a_wire_it_says_so() -> None:
    add_suzanne()
    edit()
    with pytest.raises(RuntimeError, match="No wire along edges"):
        bpy.ops.mesh.seamwire_repeat()


def test_what_is_nowhere_else_changes_nothing() -> None:
    obj = add_grid(9)
    draw = random.Random(2)
    for vertex in obj.data.vertices:
        vertex.co.x += draw.uniform(-0.05, 0.05)
        vertex.co.y += draw.uniform(-0.05, 0.05)
    edit()
    assert mark_wires(chains="20 60")
    before = snapshot(obj)
    assert bpy.ops.mesh.seamwire_repeat() == {"CANCELLED"}
    assert snapshot(obj) == before
