# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams marked as something else too."""

import bmesh
import bpy
import pytest
from scene import add_grid, add_layers, chain, edit, seams, snapshot

pytestmark = pytest.mark.every_blender


def marked_as(obj: bpy.types.Object, kind: str) -> list[tuple[int, int]]:
    """Return the edges that Blender knows as such, in object mode."""
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    pairs = [tuple(sorted(edge.vertices)) for edge in mesh.edges]
    if kind == "SHARP":
        found = [edge.use_edge_sharp for edge in mesh.edges]
    elif kind == "FREESTYLE":
        if hasattr(mesh.edges[0], "use_freestyle_mark"):
            found = [edge.use_freestyle_mark for edge in mesh.edges]
        else:
            found = [item.value for item in mesh.attributes["freestyle_edge"].data]
    elif hasattr(mesh.edges[0], "crease"):
        found = [(edge.crease if kind == "CREASE" else edge.bevel_weight) == 1.0 for edge in mesh.edges]
    else:
        name = "crease_edge" if kind == "CREASE" else "bevel_weight_edge"
        found = [item.value == 1.0 for item in mesh.attributes[name].data]
    edit()
    return sorted(pair for pair, is_marked in zip(pairs, found, strict=True) if is_marked)


def select(obj: bpy.types.Object) -> None:
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for vert in bm.verts:
        vert.select = vert.index in (3, 4, 12)
    bm.select_flush_mode()
    bm.select_history.clear()
    bm.select_history.add(bm.verts[12])
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("kind", ["SHARP", "CREASE", "BEVEL", "FREESTYLE"])
def test_seams_are_marked_and_nothing_else_changes(kind: str) -> None:
    obj = add_grid(9)
    edit()
    bpy.ops.mesh.seamwire_mark(chains="36 44")
    wanted = sorted(tuple(sorted(pair)) for pair in chain(*range(36, 45)))
    select(obj)
    before = snapshot(obj)
    assert bpy.ops.mesh.seamwire_mark_seams_as(kind=kind) == {"FINISHED"}
    assert marked_as(obj, kind) == wanted
    assert sorted(seams(obj)) == wanted
    bm = bmesh.from_edit_mesh(obj.data)
    assert [vert.index for vert in bm.verts if vert.select] == [3, 4, 12]
    assert [bm.select_history[i].index for i in range(len(bm.select_history))] == [12]
    after = snapshot(obj)
    changed = {name for name in before if after.get(name) != before[name]}
    assert len(changed) <= 1, changed


def test_weights_beside_those_that_are_there() -> None:
    obj = add_grid(9)
    add_layers(obj)
    edit()
    bpy.ops.mesh.seamwire_mark(chains="36 44")
    bpy.ops.mesh.seamwire_mark_seams_as(kind="CREASE")
    assert set(chain(*range(36, 45))) <= set(marked_as(obj, "CREASE"))


def test_hidden_seams_stay_as_they_are() -> None:
    obj = add_grid(9)
    edit()
    bpy.ops.mesh.seamwire_mark(chains="36 44")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    assert bpy.ops.mesh.seamwire_mark_seams_as(kind="SHARP") == {"CANCELLED"}
    assert marked_as(obj, "SHARP") == []
