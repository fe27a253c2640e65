# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators on several meshes that end on an error after they have changed one: undo leads back."""

from collections.abc import Callable, Iterator

import bmesh
import bpy
import pytest
from scene import add_grid, changing, edit, mark_wires, snapshot
from seamwire.mesh import edit_mesh, finishes, uv_islands
from seamwire.mesh.object_session import ObjectSession


def fail_at(number: int, work: Callable[..., object]) -> Callable[..., object]:
    """Return what does the same, but ends on an error from that call on."""
    calls: list[object] = []

    def failing(*arguments: object, **options: object) -> object:
        calls.append(arguments)
        if len(calls) >= number:
            raise TypeError("as the test wants it")
        return work(*arguments, **options)

    return failing


def states(names: list[str]) -> list[object]:
    """Return what the meshes of objects hold, with the labels of wires."""
    objects = [bpy.data.objects[name] for name in names]
    return [(snapshot(obj), edit_mesh.Cage(obj).labels().labels.tolist()) for obj in objects]


@pytest.fixture
def grids() -> Iterator[list[str]]:
    """The names of two grids in edit mode, each with a hole and with a gap between two seams, and an undo step of them."""
    objects = [add_grid(9, name=name) for name in ("One", "Two")]
    for obj in objects:
        obj.select_set(True)
        for vertex in obj.data.vertices:
            vertex.co.z = 0.3 * vertex.co.x * vertex.co.y
    names = [obj.name for obj in objects]
    edit()
    for obj in objects:
        with changing(obj) as bm:
            bmesh.ops.delete(bm, geom=[bm.faces[9]], context="FACES_ONLY")
            for start in (*range(36, 39), *range(40, 44)):
                bm.edges.get((bm.verts[start], bm.verts[start + 1])).seam = True
    bpy.ops.ed.undo_push(message="Before")
    yield names


WRITES = (ObjectSession, "write")
CASES = {
    "take_over": ({}, WRITES),
    "close_gaps": ({}, WRITES),
    "suggest": ({"islands": 3, "along": "EDGES"}, WRITES),
    "store": ({"what": "ATTRIBUTE"}, (uv_islands, "_face_layer")),
}


@pytest.mark.parametrize("name", CASES)
def test_undo_leads_back_from_an_error_at_the_second_mesh(
    name: str, grids: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = states(grids)
    options, (owner, function) = CASES[name]
    with monkeypatch.context() as failing:
        failing.setattr(owner, function, fail_at(2, getattr(owner, function)))
        with pytest.raises(RuntimeError, match="Stopped halfway, undo leads back: as the test wants it"):
            getattr(bpy.ops.mesh, f"seamwire_{name}")("EXEC_DEFAULT", True, **options)
    assert sorted(own != was for own, was in zip(states(grids), before, strict=True)) == [False, True]
    bpy.ops.ed.undo()
    assert states(grids) == before


def test_undo_leads_back_from_an_error_at_the_second_mesh_that_is_cut(
    grids: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in grids:
        mark_wires("0 44", obj=bpy.data.objects[name], along="SURFACE", metric="euclidean")
    bpy.ops.ed.undo_push(message="Marked")
    before = states(grids)
    with monkeypatch.context() as failing:
        failing.setattr(finishes, "cut", fail_at(2, finishes.cut))
        with pytest.raises(RuntimeError, match="Stopped halfway"):
            bpy.ops.mesh.seamwire_finish("EXEC_DEFAULT", True, finish="CUT")
    counts = [len(bmesh.from_edit_mesh(bpy.data.objects[each].data).verts) for each in grids]
    assert min(counts) == 81 < max(counts)
    bpy.ops.ed.undo()
    assert states(grids) == before


def test_an_error_before_the_first_change_leaves_no_step_of_undo(
    grids: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    bpy.ops.ed.undo_push(message="Nothing")
    with monkeypatch.context() as failing:
        failing.setattr(edit_mesh, "read", fail_at(2, edit_mesh.read))
        with pytest.raises(RuntimeError, match="as the test wants it"):
            bpy.ops.mesh.seamwire_take_over("EXEC_DEFAULT", True)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not bpy.data.objects[grids[0]].data.attributes.get(".seamwire")


def test_all_meshes_are_planned_before_the_first_one_changes(grids: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    before = states(grids)
    monkeypatch.setattr(ObjectSession, "plan", fail_at(2, ObjectSession.plan))
    with pytest.raises(RuntimeError, match="as the test wants it"):
        bpy.ops.mesh.seamwire_take_over()
    assert states(grids) == before
