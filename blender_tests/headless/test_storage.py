# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires that stay with their mesh, whatever is done to it: afterwards wires and seams agree, in this Blender and the next one."""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import bmesh
import bpy
import pytest
from scene import add_grid, chain, changing, edit, mark_wires, seams, snapshot
from seamwire.mesh.edit_mesh import LABELS
from stored import agree, chains, forget, session_on, wired, write

FIXTURES = Path(__file__).parents[1] / "fixtures"
ROW, COLUMN = tuple(range(36, 45)), (4, 13, 22, 31)
NEWER = "seamwire 2 what a later version wrote"


@pytest.fixture
def drawn() -> bpy.types.Object:
    """A grid in edit mode with a row of it as two wires and half a column; vertex y * 9 + x is column x of row y."""
    obj = add_grid(9)
    edit()
    mark("36 40 44; 4 31")
    assert agree(obj)
    return obj


def mark(seeds: str, **options: object) -> None:
    assert mark_wires(chains=seeds, **options)


def mode(name: str) -> None:
    bpy.ops.object.mode_set(mode=name)


def select(obj: bpy.types.Object, wanted: Callable[[bmesh.types.BMFace], bool]) -> None:
    """Select faces of an edit mesh, and nothing else."""
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        for face in bm.faces:
            face.select_set(wanted(face))
        bm.select_flush_mode()


def vertices(obj: bpy.types.Object, *places: tuple[float, float]) -> list[int]:
    """Return the vertices of an edit mesh at places of the plane."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    return [min(bm.verts, key=lambda v: (v.co.x - x) ** 2 + (v.co.y - y) ** 2).index for x, y in places]


def reopened(path: Path, name: str) -> bpy.types.Object:
    """Save to a file, open it, and return an object of it in edit mode."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), check_existing=False)
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return entered(bpy.data.objects[name])


def entered(obj: bpy.types.Object) -> bpy.types.Object:
    if obj.mode != "EDIT":
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        edit()
    return obj


# Files


@pytest.mark.every_blender
@pytest.mark.parametrize("where", ["EDIT", "OBJECT"])
def test_a_file_saved_and_opened_has_them(
    drawn: bpy.types.Object, where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, marked, text = chains(drawn), seams(drawn), drawn.data.seamwire_wires
    mode(where)
    forget(monkeypatch)
    obj = reopened(tmp_path / "drawn.blend", drawn.name)
    assert obj.data.seamwire_wires == text
    assert chains(obj) == before
    assert seams(obj) == marked
    assert sorted(session_on(obj).session.seeds()) == [4, 31, 36, 40, 44]
    assert agree(obj)


@pytest.mark.every_blender
@pytest.mark.parametrize("link", [False, True], ids=["appended", "linked and made local"])
def test_an_object_from_another_file_has_them(
    drawn: bpy.types.Object, link: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, name = chains(drawn), drawn.name
    mode("OBJECT")
    path = str(tmp_path / "drawn.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, check_existing=False, copy=True)
    bpy.data.batch_remove([drawn.data, drawn])
    forget(monkeypatch)
    with bpy.data.libraries.load(path, link=link) as (_, wanted):
        wanted.objects = [name]
    (obj,) = wanted.objects
    bpy.context.collection.objects.link(obj)
    if link:
        obj.make_local()
        obj.data.make_local()
        obj = bpy.data.objects[name]
    entered(obj)
    assert chains(obj) == before
    assert agree(obj)


def test_the_text_is_small(drawn: bpy.types.Object) -> None:
    assert len(drawn.data.seamwire_wires) < 1500
    assert "seamwire" not in drawn.data.keys(), "it is not among the custom properties"  # noqa: SIM118


# Undo


def undo_step(name: str) -> None:
    bpy.ops.ed.undo_push(message=name)


@pytest.mark.every_blender
def test_undo_and_redo_take_wires_back_and_bring_them_again() -> None:
    name = add_grid(9).name
    edit()
    undo_step("Before")
    mark("36 44")
    undo_step("One")
    mark("4 31")
    undo_step("Two")
    two = chains(bpy.data.objects[name])
    for expected in ([ROW], []):
        bpy.ops.ed.undo()
        obj = bpy.data.objects[name]
        assert chains(obj) == expected
        assert agree(obj)
    for expected in ([ROW], two):
        bpy.ops.ed.redo()
        obj = bpy.data.objects[name]
        assert chains(obj) == expected
        assert agree(obj)


@pytest.mark.every_blender
@pytest.mark.every_blender
@pytest.mark.parametrize("edited", [True, False], ids=["in Edit Mode", "in Object Mode"])
def test_wires_that_undo_brings_back_while_nobody_looks_are_in_the_file(
    drawn: bpy.types.Object, edited: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = chains(drawn)
    bpy.ops.ed.undo_push(message="Drawn")
    mesh = session_on(drawn)
    for wire in mesh.session.wires:
        mesh.session.drop(wire)
    write(mesh)
    bpy.ops.ed.undo_push(message="Removed")
    bpy.ops.mesh.select_all(action="SELECT")
    for _ in range(2):
        bpy.ops.mesh.extrude_region_move(TRANSFORM_OT_translate={"value": (0.0, 0.0, 1.0)})
        bpy.ops.ed.undo_push(message="Extruded")
    for _ in range(3):
        bpy.ops.ed.undo()
    if not edited:
        mode("OBJECT")
    name = bpy.context.active_object.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"), check_existing=False)
    forget(monkeypatch)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    obj = entered(bpy.data.objects[name])
    assert chains(obj) == before
    assert agree(obj)


def test_undo_over_a_switch_of_modes_brings_them_back() -> None:
    name = add_grid(9).name
    edit()
    undo_step("Before")
    mark("36 44")
    undo_step("Drawn")
    mode("OBJECT")
    undo_step("Object mode")
    bpy.data.objects[name].location.x = 1.0
    undo_step("Moved")
    for _ in range(2):
        bpy.ops.ed.undo()
    obj = entered(bpy.data.objects[name])
    assert chains(obj) == [ROW]
    assert agree(obj)


# Modes and objects


@pytest.mark.every_blender
def test_modes_are_switched_and_they_stay(drawn: bpy.types.Object, monkeypatch: pytest.MonkeyPatch) -> None:
    before = chains(drawn)
    forget(monkeypatch)
    for other in ("OBJECT", "SCULPT", "WEIGHT_PAINT", "OBJECT"):
        mode(other)
        mode("EDIT")
        assert chains(drawn) == before
        assert agree(drawn)


@pytest.mark.every_blender
@pytest.mark.parametrize("linked", [False, True], ids=["a copy", "the same mesh"])
def test_a_duplicate_has_them_too(drawn: bpy.types.Object, linked: bool) -> None:
    before = chains(drawn)
    mode("OBJECT")
    bpy.ops.object.duplicate(linked=linked)
    copy = bpy.context.active_object
    assert copy != drawn
    drawn.select_set(False)
    entered(copy)
    assert chains(copy) == before
    assert agree(copy)
    mark("0 72")
    mode("OBJECT")
    copy.select_set(False)
    entered(drawn)
    assert len(chains(drawn)) == len(before) + linked
    assert agree(drawn)


@pytest.mark.every_blender
def test_joined_objects_keep_the_wires_of_all() -> None:
    one, two = add_grid(9, name="One"), add_grid(9, name="Two")
    two.location = (3.0, 0.0, 0.0)
    bpy.context.view_layer.update()
    edit()
    mark("36 44", obj=one)
    mark("4 31", obj=two)
    mode("OBJECT")
    bpy.context.view_layer.objects.active = one
    bpy.ops.object.join()
    edit()
    assert chains(one) == [ROW, tuple(81 + v for v in COLUMN)]
    assert agree(one)


# The mesh


@pytest.mark.every_blender
def test_a_part_duplicated_in_edit_mode_has_its_wires_twice(drawn: bpy.types.Object) -> None:
    before = chains(drawn)
    select(drawn, lambda face: True)
    bpy.ops.mesh.duplicate_move(TRANSFORM_OT_translate={"value": (4.0, 0.0, 0.0)})
    assert len(chains(drawn)) == 2 * len(before)
    assert len(seams(drawn)) == 2 * sum(len(wire) - 1 for wire in before)
    assert agree(drawn)
    mesh = session_on(drawn)
    far = [wire for wire in mesh.session.wires if mesh.arrays.points[list(wire.vertices), 0].min() > 2.0]
    for wire in far:
        mesh.session.drop(wire)
    write(mesh)
    assert chains(drawn) == before, "the copies go, and theirs stay"
    assert agree(drawn)


@pytest.mark.every_blender
def test_a_separated_part_takes_its_wires_along(drawn: bpy.types.Object) -> None:
    select(drawn, lambda face: face.calc_center_median().y < -0.13)
    bpy.ops.mesh.separate(type="SELECTED")
    assert len(chains(drawn)) == 2, "the row"
    assert agree(drawn)
    other = next(obj for obj in bpy.context.scene.objects if obj != drawn)
    mode("OBJECT")
    drawn.select_set(False)
    entered(other)
    assert [len(wire) for wire in chains(other)] == [4], "the column"
    assert agree(other)


@pytest.mark.every_blender
def test_subdivided_they_run_along_twice_as_many_edges(drawn: bpy.types.Object) -> None:
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    assert sorted(len(wire) - 1 for wire in chains(drawn)) == [6, 8, 8]
    assert agree(drawn)
    seeds = vertices(drawn, (-1, 0), (0, 0), (1, 0), (0, -1), (0, -0.25))
    assert sorted(session_on(drawn).session.seeds()) == sorted(seeds)


@pytest.mark.every_blender
def test_where_a_part_was_deleted_the_rest_of_a_wire_is_a_plain_seam(drawn: bpy.types.Object) -> None:
    select(drawn, lambda face: face.calc_center_median().x > 0.5)
    bpy.ops.mesh.delete(type="FACE")
    found = session_on(drawn)
    assert sorted(len(wire.vertices) for wire in found.session.wires) == [4, 5]
    assert len(found.plain_seams) == 2
    assert len(seams(drawn)) == 3 + 4 + 2
    before = seams(drawn)
    write(found)
    assert seams(drawn) == before


def test_dissolved_edges_under_a_wire_leave_no_wire_and_no_error(drawn: bpy.types.Object) -> None:
    with changing(drawn) as bm:
        bmesh.ops.dissolve_verts(bm, verts=[bm.verts[38]])
    assert session_on(drawn).notices.take() == []
    assert len(chains(drawn)) == 2


@pytest.mark.every_blender
def test_hidden_wires_stay(drawn: bpy.types.Object, monkeypatch: pytest.MonkeyPatch) -> None:
    before, marked = chains(drawn), seams(drawn)
    select(drawn, lambda face: face.calc_center_median().y < -0.3)
    bpy.ops.mesh.hide()
    forget(monkeypatch)
    mesh = session_on(drawn)
    assert len(mesh.session.wires) == 2, "the column is hidden"
    mesh.session.drop(mesh.session.wires[0])
    write(mesh)
    mark("54 62")
    assert set(marked) - set(seams(drawn)) <= set(chain(*ROW))
    bpy.ops.mesh.reveal(select=False)
    assert COLUMN in chains(drawn)
    assert set(before) - set(chains(drawn)) <= {ROW[:5], ROW[4:]}
    assert agree(drawn)


@pytest.mark.every_blender
def test_sorted_anew_their_vertices_have_other_numbers(drawn: bpy.types.Object) -> None:
    places = [(x / 4.0 - 1.0, 0.0) for x in range(9)]
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.sort_elements(type="REVERSE", elements={"VERT"})
    row = vertices(drawn, *places)
    assert row != list(ROW)
    assert {edge for edge in wired(drawn) if edge[0] in row and edge[1] in row} == set(chain(*row))
    assert agree(drawn)


# Stored texts


@pytest.mark.every_blender
def test_stored_wires_are_read(monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_grid(9)
    column = (4, 13, 22, 31)
    lines = (FIXTURES / "wires.txt").read_text(encoding="utf-8").splitlines()
    labels = {tuple(map(int, line.split()[:2])): int(line.split()[2]) for line in lines[1:]}
    for edge in obj.data.edges:
        edge.use_seam = tuple(sorted(edge.vertices)) in {*chain(*ROW), *chain(*column)}
    attribute = obj.data.attributes.new(LABELS, "INT", "EDGE")
    for edge in obj.data.edges:
        attribute.data[edge.index].value = labels.get(tuple(sorted(edge.vertices)), 0)
    obj.data.seamwire_wires = lines[0]
    edit()
    forget(monkeypatch)
    assert session_on(obj).notices.take() == []
    assert chains(obj) == [column, ROW[:5], ROW[4:]]
    assert sorted(session_on(obj).session.seeds()) == [4, 31, 36, 40, 44]
    assert len(session_on(obj).session.network.strokes) == 1
    assert agree(obj)


@pytest.mark.every_blender
def test_what_a_newer_version_wrote_stays_byte_by_byte_and_is_said(
    drawn: bpy.types.Object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn.data.seamwire_wires = NEWER
    labels = session_on(drawn).cage.labels()
    marked = seams(drawn)
    before = snapshot(drawn, with_seams=False)
    forget(monkeypatch)
    mesh = session_on(drawn)
    assert mesh.session.wires == ()
    (notice,) = mesh.notices.take()
    assert "newer version of Seamwire" in notice.text
    (problem,) = mark_wires("54 62").problems
    assert "newer version of Seamwire" in problem
    assert drawn.data.seamwire_wires == NEWER
    assert session_on(drawn).cage.labels().same_as(labels)
    assert seams(drawn) == sorted([*marked, *chain(*range(54, 63))]), "what is drawn are plain seams"
    assert snapshot(drawn, with_seams=False) == before
    obj = reopened(tmp_path / "newer.blend", drawn.name)
    assert obj.data.seamwire_wires == NEWER


@pytest.mark.parametrize(
    "operator", ["close_gaps", "finish", "load_network", "repeat", "save_network", "suggest", "take_over", "transfer"]
)
def test_each_operator_tells_of_wires_that_it_cannot_read(
    drawn: bpy.types.Object,
    operator: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "net.json"
    bpy.ops.mesh.seamwire_save_network(filepath=str(path))
    bpy.ops.object.mode_set(mode="OBJECT")
    source = add_grid(9, name="Source")
    for edge in source.data.edges:
        edge.use_seam = True
    bpy.context.view_layer.objects.active = drawn
    edit()
    drawn.data.seamwire_wires = NEWER
    forget(monkeypatch)
    options = {
        "load_network": {"filepath": str(path)},
        "save_network": {"filepath": str(path)},
        "transfer": {"source": "Source"},
    }
    capfd.readouterr()
    with suppress(RuntimeError):  # without wires some have nothing to do
        getattr(bpy.ops.mesh, f"seamwire_{operator}")(**options.get(operator, {}))
    assert capfd.readouterr().out.count("newer version of Seamwire") == 1


@pytest.mark.parametrize("text", ["seamwire 1 not base64", "seamwire 1 AAAA", "nonsense", "{"])
def test_what_cannot_be_read_is_said_and_the_seams_stay(
    drawn: bpy.types.Object, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    marked = seams(drawn)
    drawn.data.seamwire_wires = text
    forget(monkeypatch)
    mesh = session_on(drawn)
    (notice,) = mesh.notices.take()
    assert "cannot be read" in notice.text
    assert mesh.session.wires == ()
    assert seams(drawn) == marked
    assert drawn.data.seamwire_wires == text, "looking at it changes nothing"
    mark("54 62")
    assert seams(drawn) == sorted([*marked, *chain(*range(54, 63))])
    assert chains(drawn) == [tuple(range(54, 63))]
