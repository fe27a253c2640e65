# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender stays Blender around the tool: its keys, menus, undo, saving and modes, between chains and within one."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path
from weakref import ref

import bmesh
import bpy
import pytest
import stored
import ui as driver
from bpy_extras.view3d_utils import location_3d_to_region_2d
from desk import Desk, choose, dismiss, draw, second_window, send, undo_steps
from scene import chain, changing, edit, fail, mark_wires, seams
from seamwire.core.sketch.picture import Role, SeedRole, ShownSeed
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.sketch.wiring import Wiring
from seamwire.core.storage.serialization import Archive
from seamwire.mesh import edit_mesh, finishes
from seamwire.mesh.settings import TOOL, settings
from seamwire.tool import chain as chain_module
from seamwire.tool import events, keymaps
from seamwire.tool.holds import Hold
from seamwire.tool.running import chains as running
from seamwire.tool.running import listening
from seamwire.view import edited_objects
from seamwire.view.edited_objects import EditedObjects, edited
from seamwire.view.object_view import ObjectView
from seamwire.view.overlay import Overlay
from seamwire.words.reports import Notice

ROW = chain(*range(36, 45))


def live(desk: Desk) -> Sketch:
    """Choose the tool, keep a wire along the middle row, and leave the next one live."""
    desk.choose()
    ui = desk.ui
    ui.click(desk.at(36))
    ui.click(desk.at(44))
    session = desk.session
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(desk.at(53))
    assert desk.running
    return session


def modal_operators(ui: driver.Ui) -> list[str]:
    """Return the modal operators that run in the window, as far as Blender tells of them."""
    found = getattr(ui.window, "modal_operators", None)
    return [operator.bl_idname for operator in found] if found is not None else ["?"] * len(running)


# Between chains


def test_between_chains_no_operator_of_ours_runs_and_what_a_click_takes_is_lit(desk: Desk) -> None:
    session = desk.choose()
    assert modal_operators(desk.ui) == []
    desk.ui.move(desk.at(40))
    assert session.target.pick == 40
    draw(desk, 36, 44)
    desk.ui.move(desk.at(40))
    assert session.picture.one(Role.HOVERED) is not None
    desk.ui.move(desk.at(36))
    assert ShownSeed(36, SeedRole.HOVERED) in session.picture.seeds
    assert modal_operators(desk.ui) == []


def test_between_chains_blender_has_its_keys(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    ui, obj = desk.ui, desk.obj
    ui.move(desk.at(60))
    ui.key("A", alt=True)
    assert not any(v.select for v in bmesh.from_edit_mesh(obj.data).verts)
    ui.key("A")
    assert all(v.select for v in bmesh.from_edit_mesh(obj.data).verts)
    ui.key("A", alt=True)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[80].select = True
    ui.key("H")
    assert bmesh.from_edit_mesh(obj.data).verts[80].hide if ensured(obj) else False
    ui.key("H", alt=True)
    assert not bmesh.from_edit_mesh(obj.data).verts[80].hide if ensured(obj) else False
    ui.key("TAB")
    assert obj.mode == "OBJECT"
    ui.key("TAB")
    assert obj.mode == "EDIT"
    assert seams(obj) == ROW
    ui.move(desk.at(40))
    ui.wait_until(lambda: bool(desk.session.wires))
    assert desk.session.picture.one(Role.HOVERED) is not None, "a mode switch leaves the network"


def ensured(obj: bpy.types.Object) -> bool:
    bmesh.from_edit_mesh(obj.data).verts.ensure_lookup_table()
    return True


def hidden(obj: bpy.types.Object) -> list[bool]:
    """Return which faces are hidden."""
    return [face.hide for face in bmesh.from_edit_mesh(obj.data).faces]


def hide_all(desk: Desk) -> None:
    with desk.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.hide()
    desk.ui.wait()
    assert all(hidden(desk.obj))


@pytest.mark.every_blender
def test_alt_h_shows_again_what_is_hidden_altogether(desk: Desk) -> None:
    desk.choose()
    hide_all(desk)
    ui, place = desk.ui, desk.at(40)
    ui.move(place)
    ui.event("LEFT_ALT", "PRESS", place, alt=True)
    assert not desk.running
    ui.key("H", alt=True)
    ui.event("LEFT_ALT", "RELEASE", place)
    assert not any(hidden(desk.obj))
    ui.move(desk.at(41))
    assert desk.session.target.pick == 41


def test_where_nothing_is_visible_keys_of_the_tool_are_blenders_and_a_click_opens_no_popup(desk: Desk) -> None:
    desk.choose()
    hide_all(desk)
    ui, place = desk.ui, desk.at(40)
    ui.click(place)
    ui.key("W")  # Blender goes to its next selection tool
    assert bpy.context.workspace.tools.from_space_view3d_mode("EDIT_MESH").idname != TOOL
    choose(ui)
    ui.click(place, alt=True)
    ui.key("H", alt=True)
    assert not any(hidden(desk.obj))


def test_on_an_empty_mesh_neither_alt_nor_a_click_takes_the_next_key(desk: Desk) -> None:
    desk.choose()
    with desk.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.delete(type="VERT")
    ui, place = desk.ui, (300.0, 300.0)
    ui.move(place)
    ui.event("LEFT_ALT", "PRESS", place, alt=True)
    ui.event("LEFT_ALT", "RELEASE", place)
    ui.key("TAB")
    assert desk.obj.mode == "OBJECT"
    ui.key("TAB")
    assert desk.obj.mode == "EDIT"
    ui.click(place)
    ui.key("TAB")
    assert desk.obj.mode == "OBJECT"


def test_a_preview_that_raises_tells_nobody_and_the_next_key_is_blenders(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = desk.choose()

    ui, place = desk.ui, desk.at(40)
    ui.move(place)
    monkeypatch.setattr(session, "hover", fail)
    ui.event("LEFT_ALT", "PRESS", place, alt=True)
    monkeypatch.undo()
    assert not desk.running
    ui.event("LEFT_ALT", "RELEASE", place)
    ui.key("TAB")
    assert desk.obj.mode == "OBJECT"


@pytest.mark.every_blender
def test_what_was_hidden_just_now_is_not_picked_and_alt_h_shows_it(desk: Desk) -> None:
    """The keys come so fast that Blender tells of the hidden faces only after the last one."""
    desk.choose()
    with changing(desk.obj) as bm:
        with desk.ui.override():
            bpy.ops.mesh.select_all(action="DESELECT")
        for vertex in (0, 1, 9, 10):
            bm.verts[vertex].select = True
        bm.select_flush_mode()
    ui, place = desk.ui, desk.at(40)
    ui.move(place)
    ui.wait(20)
    assert desk.session.target.pick == 40
    ui.event("H", "PRESS", shift=True, ticks=0)
    ui.event("H", "RELEASE", shift=True, ticks=0)
    ui.event("LEFT_ALT", "PRESS", alt=True)
    assert sum(hidden(desk.obj)) == 63
    assert desk.session.target is None, "nothing is seen there"
    assert len(edited.front.mesh.arrays.edges) == 4
    ui.key("H", alt=True)
    ui.event("LEFT_ALT", "RELEASE")
    assert not any(hidden(desk.obj))


def test_what_redo_brings_back_in_a_chain_that_drew_nothing_becomes_seams(desk: Desk) -> None:
    session, ui = live(desk), desk.ui
    while desk.running:
        ui.key("Z", ctrl=True)
    assert session.wires == ()
    ui.move(desk.at(58, 59))
    ui.event("LEFT_ALT", "PRESS", alt=True)  # shows a loop
    assert desk.running
    for _ in range(4):
        ui.key("Z", ctrl=True, shift=True)
    wires = len(session.wires)
    ui.event("LEFT_ALT", "RELEASE")
    if desk.running:
        ui.key("RET")
    ui.wait_until(lambda: not desk.running)
    assert wires == 1
    assert seams(desk.obj) == ROW


def test_a_line_is_kept_though_edit_mode_is_left_before_its_wires_are_computed(desk: Desk) -> None:
    desk.choose()
    ui = desk.ui
    ui.move(desk.at(37))
    ui.event("LEFTMOUSE", "PRESS", desk.at(37))
    for vertex in (38, 40, 42, 43):
        ui.event("MOUSEMOVE", "NOTHING", desk.at(vertex), ticks=0)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(43), ticks=0)
    ui.event("TAB", "PRESS", ticks=0)
    ui.event("TAB", "RELEASE")
    ui.wait_until(lambda: not desk.running)
    assert desk.obj.mode == "OBJECT"
    assert seams(desk.obj) == chain(*range(37, 44))
    ui.key("TAB")
    ui.move(desk.at(20))
    ui.wait(10)
    assert [wire.vertices for wire in desk.session.wires] == [tuple(range(37, 44))]


def test_along_edges_a_click_with_shift_and_alt_is_blenders(desk: Desk) -> None:
    ui = desk.ui
    desk.choose()
    with ui.override():
        bpy.ops.mesh.select_mode(type="EDGE")
        bpy.ops.mesh.select_all(action="DESELECT")
    place = desk.at(40, 41)
    ui.move(place)
    ui.event("LEFT_SHIFT", "PRESS", place, shift=True)
    ui.event("LEFT_ALT", "PRESS", place, shift=True, alt=True)
    assert not desk.running, "nothing is offered that there could be"
    ui.click(place, shift=True, alt=True)
    ui.event("LEFT_ALT", "RELEASE", place, shift=True)
    ui.event("LEFT_SHIFT", "RELEASE", place)
    assert desk.left_clean()
    selected = [edge for edge in bmesh.from_edit_mesh(desk.obj.data).edges if edge.select]
    assert len(selected) == 8, "a loop"
    assert seams(desk.obj) == []


def test_what_is_prepared_is_kept_from_one_chain_to_the_next(desk: Desk) -> None:
    session = desk.choose()
    draw(desk, 36, 44)
    engine = session.engines.get(session.options.along)
    choose(desk.ui, "builtin.select_box")
    choose(desk.ui)
    bpy.ops.object.mode_set(mode="OBJECT")
    with desk.ui.override():
        edit()
    draw(desk, 0, 8)
    assert desk.session is session
    assert session.engines.get(session.options.along) is engine


def test_a_mesh_is_read_once_until_it_changes(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    """Though Blender tells of a change where a mesh with shape keys, as this one, is read."""
    read, reads = edit_mesh.read, []
    monkeypatch.setattr(edit_mesh, "read", lambda obj: (reads.append(obj.name), read(obj))[1])
    desk.choose()
    assert desk.obj.data.shape_keys is not None
    for vertex in (21, 22, 30, 31):
        desk.ui.move(desk.at(vertex))
    desk.ui.wait(20)
    assert len(reads) == 1
    with changing(desk.obj) as bm:
        bm.verts[80].co.x += 0.1
    desk.ui.wait_until(lambda: len(reads) > 1)
    desk.ui.wait(20)
    assert len(reads) <= 3, "read anew when it rests"


@pytest.mark.parametrize("keys", [True, False], ids=["with shape keys", "without"])
def test_a_chain_reads_its_mesh_when_it_begins_and_no_more(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, keys: bool
) -> None:
    """Though Blender tells of a change whenever a mesh is read."""
    if not keys:
        with desk.ui.override():
            bpy.ops.object.mode_set(mode="OBJECT")
            desk.obj.shape_key_clear()
            bpy.ops.object.mode_set(mode="EDIT")
    assert (desk.obj.data.shape_keys is not None) == keys
    read, reads = edit_mesh.read, []
    monkeypatch.setattr(edit_mesh, "read", lambda obj: (reads.append(obj.name), read(obj))[1])
    desk.choose()
    draw(desk, 36, 40)
    assert len(reads) <= 2
    reads.clear()
    desk.ui.click(desk.at(0))
    for vertex in (21, 22, 30, 31, 8):
        desk.ui.move(desk.at(vertex))
    desk.ui.click(desk.at(8))
    desk.ui.wait(20)
    desk.ui.key("ESC")
    assert len(reads) <= 1


def test_a_click_right_after_a_mode_switch_and_back_begins_a_chain(desk: Desk) -> None:
    desk.choose()
    ui, place = desk.ui, desk.at(36)
    for key in ("TAB", "TAB", "LEFTMOUSE"):
        ui.event(key, "PRESS", place, ticks=0)
        ui.event(key, "RELEASE", place, ticks=0)
    ui.wait_until(lambda: desk.running)
    assert desk.session.seed == 36


# Within a chain


@pytest.mark.smoke
@pytest.mark.every_blender
def test_ctrl_s_saves_what_is_drawn_so_far_and_the_chain_goes_on(desk: Desk, tmp_path: Path) -> None:
    path = tmp_path / "drawn.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    session, ui = live(desk), desk.ui
    before = path.stat().st_mtime_ns
    ui.key("S", ctrl=True)
    ui.wait_until(lambda: path.stat().st_mtime_ns > before)
    assert desk.running
    assert session.seed is not None
    ui.key("ESC")
    assert seams(desk.obj) == ROW
    bpy.ops.object.mode_set(mode="OBJECT")
    copy = tmp_path / "copy.blend"  # Blender does not load from the file that is open
    shutil.copy(path, copy)
    with bpy.data.libraries.load(str(copy), link=False) as (inside, wanted):
        wanted.objects = inside.objects
    saved = wanted.objects[0].data
    assert sorted(tuple(sorted(edge.vertices)) for edge in saved.edges if edge.use_seam) == ROW
    assert saved.seamwire_wires


def test_a_wire_that_a_script_marks_within_a_chain_is_saved_with_the_chain(
    desk: Desk, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    live(desk)
    with desk.ui.override():
        assert mark_wires(chains="0 8")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"), copy=True)
    stored.forget(monkeypatch)
    assert stored.chains(desk.obj) == [tuple(range(9)), tuple(range(36, 45))]
    desk.ui.key("ESC")


def test_what_was_saved_within_a_chain_and_then_taken_back_is_no_seam(desk: Desk, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "drawn.blend"))
    live(desk)
    bpy.ops.wm.save_mainfile()
    assert seams(desk.obj) == ROW
    desk.ui.key("BACK_SPACE")
    desk.ui.key("ESC")
    assert not desk.running
    assert seams(desk.obj) == []


@pytest.mark.parametrize(
    ("key", "held"),
    [
        pytest.param("TAB", {}, marks=pytest.mark.smoke),
        ("H", {}),
        ("A", {}),
        ("F3", {}),
        ("I", {"ctrl": True}),
        ("THREE", {}),
    ],
)
def test_keys_that_change_mode_or_mesh_end_the_chain_first(desk: Desk, key: str, held: dict[str, bool]) -> None:
    live(desk)
    desk.ui.key(key, **held)
    assert not desk.running
    assert seams(desk.obj) == ROW, "its wires are kept"
    if key == "TAB":
        assert desk.obj.mode == "OBJECT", "and then the key does what it does"
    elif key == "THREE":
        assert tuple(bpy.context.tool_settings.mesh_select_mode) == (False, False, True)
        bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    elif key == "I":
        assert all(v.select for v in bmesh.from_edit_mesh(desk.obj.data).verts) or held
    desk.ui.key("ESC")


def test_a_press_in_another_editor_ends_the_chain_and_does_what_it_does(desk: Desk) -> None:
    live(desk)
    ui = desk.ui
    area = next(area for area in ui.window.screen.areas if area.type == "DOPESHEET_EDITOR")
    region = next(region for region in area.regions if region.type == "WINDOW")
    inside = (region.x + region.width // 2 - ui.region.x, region.y + region.height // 2 - ui.region.y)
    ui.move(inside)
    assert desk.running, "pointing there alone does nothing"
    frame = bpy.context.scene.frame_current
    ui.key("RIGHT_ARROW")
    assert bpy.context.scene.frame_current == frame + 1
    assert not desk.running
    assert seams(desk.obj) == ROW


def test_a_script_that_removes_the_object_ends_the_chain(desk: Desk) -> None:
    live(desk)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(desk.obj)
    desk.ui.move((300.0, 300.0))
    assert desk.left_clean()


def test_renamed_within_a_chain_an_object_keeps_its_wires(desk: Desk) -> None:
    session = live(desk)
    desk.obj.name = desk.name = "Renamed"
    desk.ui.move(desk.at(53))
    assert session.target.pick == 53, "the live wire follows"
    desk.ui.click(desk.at(53))
    desk.ui.wait_until(lambda: len(session.wires) == 2)
    bpy.data.objects.new("Grid", None)  # its former name is another object's
    settings().xray = True
    desk.ui.wait()
    desk.ui.move(desk.at(50))
    assert edited.views() == [edited.front]
    assert desk.running
    desk.ui.key("RET")
    assert seams(desk.obj) == sorted([*ROW, (44, 53)])


def test_what_is_prepared_is_freed_a_while_after_edit_mode_was_left(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    live(desk)
    desk.ui.key("RET")
    view = ref(edited.front)
    for mode in ("OBJECT", "EDIT", "OBJECT"):
        with desk.ui.override():
            bpy.ops.object.mode_set(mode=mode)
        desk.ui.wait(4, redraw=True)
        assert view() is not None, "Edit Mode may be entered again at once"
    monkeypatch.setattr(edited_objects, "_IDLE", 0.5)
    edited.sweeper.stop()
    edited.watch()
    desk.ui.wait_until(lambda: view() is None, 3.0)
    assert not edited.sweeper.is_running
    with desk.ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
    desk.ui.move(desk.at(50))
    desk.ui.wait_until(lambda: len(desk.session.wires) == 1)


def break_overlay(desk: Desk, broken: pytest.MonkeyPatch) -> None:
    broken.setattr(Overlay, "draw_in_scene", fail)
    desk.ui.move(desk.at(54))
    desk.ui.wait(redraw=True)


def break_engine(desk: Desk, broken: pytest.MonkeyPatch) -> None:
    """Let everything fail that the library computes, also while the chain ends."""
    for name in ("keep", "aim", "poll"):
        broken.setattr(Wiring, name, fail, raising=False)
    desk.ui.click(desk.at(50))


def break_timer(desk: Desk, broken: pytest.MonkeyPatch) -> None:
    broken.setattr(EditedObjects, "poll", fail)
    edited.chain()
    desk.ui.wait_until(lambda: not desk.running)


def break_while_held(desk: Desk, broken: pytest.MonkeyPatch) -> None:
    desk.ui.event("LEFTMOUSE", "PRESS", desk.at(10))
    for name in ("move", "cancel"):
        broken.setattr(Hold, name, fail)


BREAKS: dict[str, Callable[[Desk, pytest.MonkeyPatch], None]] = {
    "hover": lambda desk, broken: broken.setattr(Sketch, "hover", fail),
    "hints": lambda desk, broken: broken.setattr(chain_module.Chain, "hints", fail),
    "poll": lambda desk, broken: broken.setattr(keymaps, "takes", fail),
    "event": lambda desk, broken: broken.setattr(events, "read", fail),
    "ending": lambda desk, broken: broken.setattr(Sketch, "end_chain", fail),
    "overlay": break_overlay,
    "engine": break_engine,
    "timer": break_timer,
    "hold": break_while_held,
}
"""Errors within a chain."""


@pytest.mark.parametrize("where", [pytest.param("overlay", marks=pytest.mark.smoke), *(BREAKS.keys() - {"overlay"})])
def test_an_error_ends_the_chain_and_keeps_its_wires(
    desk: Desk, where: str, reports: list[Notice], capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    session, ui = live(desk), desk.ui
    ui.click(desk.at(53))
    ui.wait_until(lambda: len(session.wires) == 2)
    with monkeypatch.context() as broken:
        BREAKS[where](desk, broken)
        ui.move(desk.at(50))
        ui.move(desk.at(51))
        ui.key("RET")
        ui.wait_until(lambda: not desk.running)
    dismiss(ui)
    driver.take_errors()
    assert desk.left_clean()
    assert seams(desk.obj) == sorted([*ROW, (44, 53)])
    assert undo_steps(capfd)[-1] == "Draw Seamwires"
    assert Notice("ERROR", "Drawing ended on an error, and its wires are kept: as the test wants it") in reports
    ui.key("Z", ctrl=True)
    ui.wait(3)
    assert desk.unchanged()
    draw(desk, 36, 44)
    assert seams(desk.obj) == ROW, "the tool goes on"


def test_an_error_after_a_script_has_changed_the_mesh_keeps_the_wires(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    live(desk)
    with monkeypatch.context() as broken:
        broken.setattr(Overlay, "draw_in_scene", fail)
        with changing(desk.obj) as bm:
            bm.verts.new((3.0, 0.0, 0.0))
        desk.ui.wait(redraw=True)
        desk.ui.move(desk.at(50))
        desk.ui.wait_until(lambda: not desk.running)
    dismiss(desk.ui)
    driver.take_errors()
    assert seams(desk.obj) == ROW


@pytest.mark.parametrize(
    ("failing", "what"),
    [
        ([(chain_module, "unwrap_after_chain")], "unwrapping"),
        ([(ObjectView, "renew"), (finishes, "apply")], "finishing them"),
    ],
)
def test_wires_are_kept_with_a_step_of_undo_if_what_comes_after_them_fails(
    desk: Desk, failing: list[tuple[object, str]], what: str, reports: list[Notice], monkeypatch: pytest.MonkeyPatch
) -> None:
    desk.choose()
    with monkeypatch.context() as broken:
        for owner, name in failing:
            broken.setattr(owner, name, fail)
        draw(desk, 36, 44)
    dismiss(desk.ui)
    driver.take_errors()
    assert seams(desk.obj) == ROW
    told = f"Wires are kept, but {what} ended on an error, undo leads back: as the test wants it"
    assert Notice("ERROR", told) in reports
    desk.ui.key("Z", ctrl=True)
    desk.ui.wait(3)
    assert desk.unchanged()


def test_a_chain_whose_wires_are_written_in_part_leaves_the_mesh_as_it_was(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk.choose()
    text, failed = Archive.text, []

    def fail_once(archive: Archive, labels: Iterable[int]) -> str:
        if not failed:
            failed.append(seams(desk.obj))
            raise TypeError("as the test wants it")
        return text(archive, labels)

    monkeypatch.setattr(Archive, "text", fail_once)
    draw(desk, 36, 44)
    dismiss(desk.ui)
    driver.take_errors()
    assert failed == [ROW]
    assert desk.unchanged()


def test_an_exception_in_the_first_click_leaves_blender_alive(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session = desk.choose()

    monkeypatch.setattr(session, "click", fail)
    desk.ui.click(desk.at(36))
    monkeypatch.undo()
    dismiss(desk.ui)
    assert desk.left_clean()
    desk.ui.move(desk.at(50))
    assert desk.unchanged()
    draw(desk, 36, 44)
    assert seams(desk.obj) == ROW


def test_one_chain_at_a_time_and_only_in_edit_mode(desk: Desk) -> None:
    desk.start()
    with desk.ui.override():
        assert not bpy.ops.mesh.seamwire_draw.poll()
    desk.ui.move(desk.at(40))
    desk.ui.key("ESC")
    with desk.ui.override():
        assert bpy.ops.mesh.seamwire_draw.poll()


def test_beside_a_chain_another_window_says_that_it_must_end_first(
    desk: Desk, capfd: pytest.CaptureFixture[str]
) -> None:
    with second_window(desk.ui) as other:
        desk.start()
        with bpy.context.temp_override(**other):
            capfd.readouterr()
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first="CLICK") == {"CANCELLED"}
        assert "A chain is being drawn in another window" in "".join(capfd.readouterr())
        assert len(running) == 1
        running[0].finish()


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("is_late", [False, True])
def test_undo_in_another_window_is_that_of_the_chain(desk: Desk, is_late: bool) -> None:
    with contextlib.ExitStack() as stack:
        if not is_late:
            other = stack.enter_context(second_window(desk.ui))
        session = live(desk)
        if is_late:
            other = stack.enter_context(second_window(desk.ui))
            desk.ui.move(desk.at(52))
        send(desk.ui, other, "Z", ctrl=True)
        assert session.wires == ()
        assert session.seed is not None
        send(desk.ui, other, "Z", ctrl=True, shift=True)
        assert len(session.wires) == 1
        send(desk.ui, other, "Z", ctrl=True)
        send(desk.ui, other, "BACK_SPACE")
        desk.ui.wait_until(lambda: not desk.running)
        assert desk.obj.mode == "EDIT"
        assert seams(desk.obj) == []
        desk.ui.wait_until(lambda: not listening)


@pytest.mark.every_blender
def test_in_a_window_with_another_scene_undo_is_that_of_the_chain_and_a_click_keeps_it(desk: Desk) -> None:
    ui = desk.ui
    with second_window(ui, "Other") as other:
        session = live(desk)
        send(ui, other, "Z", ctrl=True)
        assert session.wires == (), "undo in Blender would change this scene too"
        send(ui, other, "Z", ctrl=True, shift=True)
        assert len(session.wires) == 1
        send(ui, other, "LEFTMOUSE")
        ui.wait_until(lambda: not desk.running)
        assert len(session.wires) == 1, "nothing was drawn there"
        assert bpy.context.mode == "EDIT_MESH"
    assert seams(desk.obj) == ROW


@pytest.mark.every_blender
def test_a_chain_goes_on_in_another_window(desk: Desk) -> None:
    ui = desk.ui
    with second_window(ui) as other:
        session = live(desk)
        area = other["area"]
        view = area.spaces.active.region_3d

        def at(vertex: int) -> tuple[float, float]:
            point = (vertex % 9 / 4.0 - 1.0, vertex // 9 / 4.0 - 1.0, 0.0)
            found = location_3d_to_region_2d(other["region"], view, point)
            return found.x, found.y

        send(ui, other, "LEFTMOUSE", at(53))
        ui.wait_until(lambda: len(session.wires) == 2)
        ui.click(desk.at(80))
        ui.wait_until(lambda: len(session.wires) == 3)
        send(ui, other, "RET", at(53))
        ui.wait_until(lambda: not desk.running)
        assert seams(desk.obj) == sorted([*ROW, *chain(44, 53), *chain(53, 62, 71, 80)])
        ui.wait_until(lambda: not listening)
    with ui.override():
        bpy.ops.ed.undo()
    assert seams(desk.obj) == []


def test_another_key_in_another_window_ends_the_chain_first(desk: Desk) -> None:
    with second_window(desk.ui) as other:
        session = live(desk)
        assert len(session.wires) == 1
        send(desk.ui, other, "TAB")
        desk.ui.wait_until(lambda: not desk.running)
        assert desk.obj.mode == "OBJECT"
        assert seams(desk.obj) == ROW
        with desk.ui.override():
            edit()
