# SPDX-License-Identifier: GPL-3.0-or-later
"""One object that is drawn on: how its session, its seams and what its mesh keeps go together."""

import gc
import math
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import add_grid, add_layers, chain, changing, edit, fail, mark_wires, seams, set_seams, snapshot
from seamwire.core.sketch.change import Change
from seamwire.core.solver.solver import LiveMaker
from seamwire.mesh import edit_mesh
from seamwire.mesh.object_session import ObjectSession
from seamwire.mesh.settings import settings
from seamwire.view import edited_objects
from seamwire.view.edited_objects import edited
from seamwire.view.failures import failures
from stored import agree, chains, forget, session_on, write

ROW = tuple(range(36, 45))
LAYER = edit_mesh.LABELS


@pytest.fixture
def grid() -> bpy.types.Object:
    """A grid in edit mode with all kinds of layers; vertex y * 9 + x is column x of row y."""
    obj = add_grid(9)
    add_layers(obj)
    edit()
    return obj


def pick(mesh: ObjectSession, *picks: int) -> None:
    for vertex in picks:
        assert mesh.session.click(vertex), mesh.session.reason
        mesh.session.wait()


def draw(mesh: ObjectSession, *picks: int) -> None:
    pick(mesh, *picks)
    write(mesh)


def has_labels(obj: bpy.types.Object) -> bool:
    return LAYER in bmesh.from_edit_mesh(obj.data).edges.layers.int


# What computes its wires


def test_both_ways_run_on_one_surface_which_islands_are_told_apart_on(grid: bpy.types.Object) -> None:
    arrays = edit_mesh.read(grid)
    make = LiveMaker(arrays)
    lives = [make("EDGES"), make("SURFACE")]
    assert [str(live).split(" of ")[0] for live in lives] == ["<LiveWire: along edges", "<LiveWire: across the surface"]
    surface = make.wait()
    assert all(live.wait() for live in lives)
    assert all(np.array_equal(live.surface.edges, surface.edges) for live in lives)
    assert np.array_equal(surface.edges, np.unique(np.sort(arrays.edges, axis=1), axis=0))
    labels = make.face_segments(np.array([(v, v + 1) for v in ROW[:-1]]))
    assert np.bincount(labels).tolist() == [64, 64]


def test_what_wires_cannot_run_on_is_said(grid: bpy.types.Object) -> None:
    bm = bmesh.from_edit_mesh(grid.data)
    bm.verts.ensure_lookup_table()
    bm.verts[7].co.x = math.nan
    make = LiveMaker(edit_mesh.read(grid))
    live = make("EDGES")
    with pytest.raises(ValueError, match="vertex 7 has a coordinate that is not finite"):
        make.wait()
    with pytest.raises(ValueError, match="vertex 7"):
        live.progress()
    with pytest.raises(ValueError, match="vertex 7"):
        mark_wires(chains="0 8")


def test_what_was_prepared_for_a_mesh_that_changed_is_freed_at_once(grid: bpy.types.Object) -> None:
    view = edited.of(grid)
    while view.busy:
        view.poll()
    held = view, view.mesh.session, view.mesh.make_live, view.crest_view, view.overlay
    gone = [weakref.ref(one) for one in held]
    del held
    gc.collect()
    gc.disable()
    try:
        edited.forget(view)
        del view
        assert [one() for one in gone] == [None] * len(gone)
    finally:
        gc.enable()
        edited.clear()


@pytest.fixture
def unprepared() -> Iterator[None]:
    """Forget afterwards what was prepared."""
    yield
    edited.clear()


@pytest.mark.usefixtures("unprepared")
def test_a_deleted_object_does_not_stay_prepared(grid: bpy.types.Object) -> None:
    gone = weakref.ref(edited.of(grid))
    bpy.ops.object.mode_set(mode="OBJECT")
    assert gone() is not None, "it stays prepared in Object Mode"
    bpy.ops.object.delete()
    bpy.context.view_layer.update()
    gc.collect()
    assert gone() is None


@pytest.mark.usefixtures("unprepared")
def test_objects_that_are_not_edited_stay_prepared_for_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    prepared, now = [], 100.0
    monkeypatch.setattr(edited_objects.time, "monotonic", lambda: now)
    for name in ("First", "Second", "Third"):
        add_grid(5, name=name)
        edit()
        prepared.append(weakref.ref(edited.of(bpy.context.active_object)))
        bpy.ops.object.mode_set(mode="OBJECT")
        assert edited.sweep() is not None
        now += 25.0
    assert [one() is None for one in prepared] == [False, False, False]
    edit()
    assert edited.of(bpy.context.active_object) is prepared[2]()
    assert edited.sweep() == 10.0
    now += 100.0
    assert edited.sweep() is None, "the object that is edited stays"
    gc.collect()
    assert [one() is None for one in prepared] == [True, True, False]


@pytest.mark.usefixtures("unprepared")
def test_a_prepared_object_follows_settings_that_changed_outside_edit_mode(grid: bpy.types.Object) -> None:
    view = edited.of(grid)
    assert view.options.along == "EDGES"
    bpy.ops.object.mode_set(mode="OBJECT")
    settings().along = "SURFACE"
    try:
        bpy.ops.object.mode_set(mode="EDIT")
        assert edited.of(grid) is view, "the mesh is the same"
        assert view.options.along == "SURFACE"
    finally:
        settings().property_unset("along")


@pytest.mark.usefixtures("unprepared")
def test_an_object_that_is_scaled_while_it_is_not_edited_lets_no_failed_part_be_tried_again(
    grid: bpy.types.Object,
) -> None:
    edited.of(grid)
    bpy.ops.object.mode_set(mode="OBJECT")
    grid.scale.x = 2.0
    add_grid(3, name="Other")
    edit()
    bpy.context.view_layer.update()
    failures.skip("hover")
    bpy.context.active_object.location.x = 1.0
    bpy.context.view_layer.update()
    assert failures.has("hover")


def test_records_of_wires_that_undo_brings_back_end_with_the_file(grid: bpy.types.Object, tmp_path: Path) -> None:
    draw(session_on(grid), 36, 44)
    grid.data.seamwire_wires = ""  # as undo leaves the mesh
    assert len(session_on(grid).session.wires) == 1
    name, path = grid.name, str(tmp_path / "other.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    bpy.data.objects[name].data.seamwire_wires = ""
    assert session_on(bpy.data.objects[name]).session.wires == ()


def test_symmetry_is_looked_for_again_after_an_error(grid: bpy.types.Object, monkeypatch: pytest.MonkeyPatch) -> None:
    def found(mesh: ObjectSession) -> tuple[int, ...]:
        return next(axes for axes in iter(mesh.symmetric_soon, ()) if axes is not None)

    mesh = session_on(grid)
    with monkeypatch.context() as patch:
        patch.setattr(type(mesh.session.symmetry), "symmetric_axes", property(fail))
        with pytest.raises(ValueError, match="as the test wants it"):
            found(mesh)
    assert 0 in found(mesh)


# What is written


def test_a_write_knows_the_labels_of_the_mesh_without_looking_at_all_edges(
    grid: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = session_on(grid)
    looked_at: list[object] = []
    labels = edit_mesh.Cage.labels

    def noting(cage: edit_mesh.Cage, among: object = None) -> object:
        looked_at.append(among)
        return labels(cage, among)

    monkeypatch.setattr(edit_mesh.Cage, "labels", noting)
    draw(mesh, 44, 36)  # against the order of the edges
    draw(mesh, 4, 76)
    mesh.session.drop(mesh.session.wires[0])
    write(mesh)
    assert len(looked_at) == 3
    assert all(among is not None and len(among) <= 32 for among in looked_at)
    assert mesh._labels.same_as(labels(mesh.cage))
    assert len(mesh._labels.labels) == 8
    mesh.session.drop(mesh.session.wires[0])
    write(mesh)
    assert mesh._labels.same_as(labels(mesh.cage))
    assert not has_labels(grid), "the last wire takes the layer away"


@pytest.mark.every_blender
def test_a_mesh_without_wires_stays_untouched(grid: bpy.types.Object) -> None:
    before = snapshot(grid)
    mesh = session_on(grid)
    assert mesh.notices.take() == []
    assert mesh.write(mesh.plan()) == (0, 0)
    assert not has_labels(grid)
    assert grid.data.seamwire_wires == ""
    assert snapshot(grid) == before


# What is found again


def test_refreshed_it_keeps_what_was_prepared_where_only_seams_changed(grid: bpy.types.Object) -> None:
    mesh = session_on(grid)
    session = mesh.session
    set_seams(grid, (4, 13))
    assert mesh.refresh(grid)
    assert mesh.session is session
    assert mesh.plain_seams.tolist() == [[4, 13]]


def test_it_does_not_go_on_with_another_shape(grid: bpy.types.Object) -> None:
    mesh = session_on(grid)
    with changing(grid) as bm:
        bm.verts[40].co.z += 0.5
    assert not mesh.refresh(grid)
    assert not mesh.rebind(grid)
    assert session_on(grid).refresh(grid)


def test_what_is_drawn_is_kept_after_a_script_has_written_other_wires(grid: bpy.types.Object) -> None:
    mesh = session_on(grid)
    before = mesh.session.drawn
    pick(mesh, 36, 44)
    draw(session_on(grid), 0, 4)
    assert not mesh.rebind(grid)
    assert mesh.alive(), "its wires can be finished"
    mesh.session.end_chain()
    mesh.write(mesh.plan(Change(before, mesh.session.drawn)))
    assert chains(grid) == [(0, 1, 2, 3, 4), ROW]
    assert seams(grid) == sorted(chain(*range(5)) + chain(*ROW))
    assert agree(grid)


def test_a_mesh_that_nobody_else_changed_is_the_same(grid: bpy.types.Object) -> None:
    mesh = session_on(grid)
    draw(mesh, 36, 44)
    assert mesh.rebind(grid)
    set_seams(grid, (0, 1), *chain(*ROW))
    assert not mesh.rebind(grid)
    assert mesh.plain_seams.tolist() == [[0, 1]]


def test_it_tells_when_its_mesh_is_gone(grid: bpy.types.Object) -> None:
    mesh = session_on(grid)
    assert mesh.alive()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not mesh.alive()
    bpy.data.objects.remove(grid)
    assert not mesh.alive()


@pytest.mark.every_blender
def test_what_is_drawn_is_written_after_edit_mode_was_left_too(grid: bpy.types.Object) -> None:
    draw(session_on(grid), 4, 22)
    mesh = session_on(grid)
    pick(mesh, 36, 44)
    mesh.session.end_chain()
    rest = snapshot(grid, with_seams=False)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not mesh.rebind(grid)
    mesh.write(mesh.plan())
    assert seams(grid) == sorted(chain(*ROW) + chain(4, 13, 22))
    edit()
    assert snapshot(grid, with_seams=False) == rest, "nothing else has changed"
    assert chains(grid) == [(4, 13, 22), ROW]
    assert agree(grid)


@pytest.mark.every_blender
def test_after_edit_mode_was_left_removed_wires_leave_no_labels(grid: bpy.types.Object) -> None:
    draw(session_on(grid), 36, 44)
    mesh = session_on(grid)
    mesh.session.drop(mesh.session.wires[0])
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not mesh.rebind(grid)
    mesh.write(mesh.plan())
    assert seams(grid) == []
    assert LAYER not in grid.data.attributes
    edit()
    assert chains(grid) == []


# Shapes


@pytest.mark.every_blender
def test_with_a_shape_key_active_the_shape_is_the_one_seen(grid: bpy.types.Object) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    grid.active_shape_key_index = 1
    edit()
    bm = bmesh.from_edit_mesh(grid.data)
    seen = np.array([v.co for v in bm.verts])
    assert np.ptp(seen[:, 2]) > 0.1
    arrays = edit_mesh.read(grid)
    np.testing.assert_allclose(arrays.points @ arrays.to_object.T, seen, atol=1e-6)
    before = snapshot(grid, with_seams=False)
    mesh = session_on(grid)
    draw(mesh, 36, 44)
    assert mesh.refresh(grid), "nothing else has changed"
    assert snapshot(grid, with_seams=False) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    grid.active_shape_key_index = 0
    edit()
    assert not mesh.refresh(grid), "another shape is seen"
    assert len(chains(grid)) == 1
    assert agree(grid)


@pytest.mark.every_blender
def test_after_reading_the_mesh_tells_which_edges_have_a_label() -> None:
    obj = add_grid(9)
    edit()
    mark_wires("36 44; 4 76")
    mesh = ObjectSession(obj)
    found = mesh.cage.labels(was_read=True)
    assert len(found.labels) == 16
    assert found.same_as(mesh.cage.labels())


@pytest.mark.every_blender
@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_wires_drawn_moved_and_removed_change_seams_and_nothing_else(grid: bpy.types.Object, along: str) -> None:
    before = snapshot(grid)
    rest = snapshot(grid, with_seams=False)
    mesh = session_on(grid)
    mesh.session.follow(replace(mesh.session.options, along=along))
    draw(mesh, 36, 40, 44)
    assert seams(grid) == chain(*ROW)
    assert snapshot(grid, with_seams=False) == rest, "drawn"
    assert mesh.session.drag(40)
    mesh.session.drag_to(49)
    mesh.session.wait()
    mesh.session.drag_end()
    mesh.session.wait()
    write(mesh)
    assert agree(grid)
    assert 49 in {vertex for edge in seams(grid) for vertex in edge}
    assert snapshot(grid, with_seams=False) == rest, "moved"
    for wire in mesh.session.wires:
        mesh.session.drop(wire)
    write(mesh)
    assert snapshot(grid) == before, "removed"
    assert not has_labels(grid)
    assert grid.data.seamwire_wires == ""


# What is found again


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_wires_do_not_mind_the_objects_scale(
    grid: bpy.types.Object, along: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = session_on(grid)
    mesh.session.follow(replace(mesh.session.options, along=along))
    assert mesh.session.draw_stroke(vertices=[38, 42])
    draw(mesh, 36, 40, 44)
    stroke = mesh.session.network.strokes[0].points @ mesh.arrays.to_object.T
    curves = {wire.vertices: wire.points @ mesh.arrays.to_object.T for wire in mesh.session.wires}
    grid.matrix_world = Matrix.Diagonal((1.0, 4.0, 0.5, 1.0))
    bpy.context.view_layer.update()
    assert not mesh.refresh(grid), "lengths are others"
    forget(monkeypatch)
    again = session_on(grid)
    assert chains(grid) == [(36, 37, 38, 39, 40), (40, 41, 42, 43, 44)]
    for wire in again.session.wires:
        np.testing.assert_allclose(wire.points @ again.arrays.to_object.T, curves[wire.vertices], atol=1e-5)
    found = again.session.network.strokes[0].points
    np.testing.assert_allclose(found @ again.arrays.to_object.T, stroke, atol=1e-5)
    assert agree(grid)
