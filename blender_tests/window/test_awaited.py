# SPDX-License-Identifier: GPL-3.0-or-later
"""Clicks and drags whose wires are not computed yet are done at once. Only the end of a chain waits for the wires."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace

import bmesh
import bpy
import pytest
import ui as driver
from desk import Desk, choose, draw, leave, reset_settings
from scene import add_grid, chain, edit, seams
from seamwire.core.sketch.courses import Courses
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.sketch import Sketch
from seamwire.tool.draw import MESH_OT_seamwire_draw
from seamwire.view.edited_objects import edited
from seamwire.words.reports import Notice
from slow import Slow

ROW, LONG_ROW = chain(*range(36, 41)), chain(*range(36, 45))


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> Slow:
    return Slow(monkeypatch)


def click_ahead(desk: Desk, slow: Slow) -> Sketch:
    """Keep a wire, and click once more before the next wire is computed."""
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 1 and not session.computing)
    ui.move(desk.at(44))
    slow.is_slow = True
    ui.click(desk.at(44))
    assert session.waiting == 1
    return session


def pull(desk: Desk, begin: int, goal: int) -> None:
    """Move the mouse from one vertex to another, while a button is held."""
    start, end = desk.at(begin), desk.at(goal)
    for part in (0.4, 0.7, 1.0):
        desk.ui.move((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))


def release_ahead(desk: Desk, slow: Slow) -> Sketch:
    """Move a seed from 44 to 53, and release it before its wire is computed."""
    desk.choose()
    session, ui = draw(desk, 36, 44), desk.ui
    slow.is_slow = True
    ui.move(desk.at(44))
    ui.event("LEFTMOUSE", "PRESS", desk.at(44))
    pull(desk, 44, 53)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(53))
    assert session.waiting == 1
    return session


def end(desk: Desk) -> None:
    if desk.running:
        desk.ui.key("RET")
    desk.ui.wait_until(lambda: not desk.running)


def outside(ui: driver.Ui) -> tuple[float, float]:
    """Return a place in another editor."""
    return -30.0, 100.0


@pytest.mark.smoke
def test_a_press_outside_after_a_lost_release_ends_the_chain_and_keeps_its_wires(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 1 and not session.computing)
    ui.event("LEFTMOUSE", "PRESS", desk.at(58))
    ui.move(outside(ui))
    ui.event("LEFTMOUSE", "PRESS", outside(ui))  # another window has received the release
    ui.event("LEFTMOUSE", "RELEASE", outside(ui))
    end(desk)
    assert seams(desk.obj) == ROW


@pytest.mark.parametrize("press", ["LEFT_SHIFT", "RIGHT_CTRL", "WHEELDOWNMOUSE"])
def test_presses_that_change_no_mesh_leave_the_chain_as_it_is(desk: Desk, slow: Slow, press: str) -> None:
    session, ui = click_ahead(desk, slow), desk.ui
    ui.move(outside(ui))
    ui.event(press, "PRESS", outside(ui))
    assert desk.chain.stage == "DRAWING"
    assert session.waiting == 1
    slow.is_slow = False
    end(desk)
    assert seams(desk.obj) == LONG_ROW


@pytest.mark.smoke
@pytest.mark.parametrize(("key", "is_ending"), [("I", False), ("I", True), ("X", False)])
def test_a_key_that_changes_the_mesh_finds_all_wires_in_it(desk: Desk, slow: Slow, key: str, is_ending: bool) -> None:
    click_ahead(desk, slow)
    if is_ending:
        desk.ui.key("RET")
        assert desk.chain.stage == "ENDING"
    desk.ui.move(desk.at(60))
    desk.ui.key(key)
    desk.ui.key("ESC")  # Blender puts its inset faces back, or closes the menu
    assert desk.left_clean()
    assert seams(desk.obj) == LONG_ROW


def test_a_press_on_a_menu_ends_the_chain_so_that_undo_there_is_blenders(desk: Desk, slow: Slow) -> None:
    ui = desk.ui
    click_ahead(desk, slow)
    ui.key("RET")
    assert desk.chain.stage == "ENDING"
    ui.move(outside(ui))
    ui.event("LEFTMOUSE", "PRESS", outside(ui))
    ui.event("LEFTMOUSE", "RELEASE", outside(ui))
    assert not desk.running
    assert seams(desk.obj) == LONG_ROW
    with ui.override():
        bpy.ops.ed.undo()
    ui.wait(4)
    ui.move(desk.at(20))
    assert seams(desk.obj) == [], "and the wires do not come back"


def test_undo_over_the_settings_is_the_chains(desk: Desk) -> None:
    ui = desk.ui
    desk.choose()
    draw(desk, 0, 4)
    session = desk.start()
    ui.click(desk.at(36))
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 2)
    header = next(region for region in ui.area.regions if region.type == "TOOL_HEADER")
    ui.move((header.x + header.width - 40.0 - ui.region.x, header.y + header.height * 0.5 - ui.region.y))
    ui.key("Z", ctrl=True)
    assert desk.running
    assert len(session.wires) == 1
    assert seams(desk.obj) == chain(*range(5)), "the chain before is in the mesh still"
    ui.move(desk.at(60))
    end(desk)


@pytest.mark.smoke
@pytest.mark.parametrize("held", [{}, {"ctrl": True}], ids=["click", "Ctrl-click"])
def test_a_press_while_a_chain_ends_begins_another_chain(desk: Desk, slow: Slow, held: dict[str, bool]) -> None:
    ui = desk.ui
    session = click_ahead(desk, slow)
    ui.event("RIGHTMOUSE", "PRESS")
    ui.event("RIGHTMOUSE", "RELEASE")
    assert desk.chain.stage == "ENDING"
    ui.click(desk.at(0), **held)
    assert desk.chain.stage == "DRAWING"
    assert session.seed == 0
    slow.is_slow = False
    ui.click(desk.at(4))
    ui.wait_until(lambda: len(session.wires) == 3)
    end(desk)
    assert seams(desk.obj) == sorted([*chain(*range(5)), *LONG_ROW])
    with ui.override():
        bpy.ops.ed.undo()
    assert seams(desk.obj) == [], "both are one step of undo"


def test_a_seed_that_a_chain_ends_with_is_grabbed_there(desk: Desk, slow: Slow) -> None:
    ui = desk.ui
    session = click_ahead(desk, slow)
    ui.key("RET")
    ui.move(desk.at(44))
    ui.event("LEFTMOUSE", "PRESS", desk.at(44))
    pull(desk, 44, 53)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(53))
    slow.is_slow = False
    ui.wait_until(lambda: not session.computing)
    end(desk)
    assert 53 in session.seeds()
    assert 44 not in session.seeds()


def test_blender_stops_a_chain_at_once(desk: Desk, slow: Slow, monkeypatch: pytest.MonkeyPatch) -> None:
    session = click_ahead(desk, slow)
    waits = []
    monkeypatch.setattr(Sketch, "wait", lambda _own, **_how: waits.append(1))
    MESH_OT_seamwire_draw.cancel(SimpleNamespace(_chain=desk.chain), bpy.context)
    desk.ui.wait(4)
    assert desk.left_clean()
    assert waits == []
    assert session.waiting == 0
    assert seams(desk.obj) == LONG_ROW, "as it was drawn"


def test_a_click_without_a_result_is_reported_when_the_chain_ends(
    desk: Desk, slow: Slow, reports: list[Notice], monkeypatch: pytest.MonkeyPatch
) -> None:
    click_ahead(desk, slow)
    desk.ui.key("RET")
    monkeypatch.setattr(Courses, "step", lambda courses: (courses.unfinished[0], False))
    desk.ui.move(outside(desk.ui))
    desk.ui.event("LEFTMOUSE", "PRESS", outside(desk.ui))
    desk.ui.event("LEFTMOUSE", "RELEASE", outside(desk.ui))
    assert not desk.running
    assert seams(desk.obj) == LONG_ROW, "as it was drawn"
    assert [notice.level for notice in reports if "without a result" in notice.text] == ["WARNING"]


def test_undo_by_a_script_takes_back_the_chain_before_and_keeps_what_was_drawn_since(
    desk: Desk, reports: list[Notice]
) -> None:
    ui = desk.ui
    desk.choose()
    draw(desk, 0, 4)
    session = desk.start()
    ui.click(desk.at(36))
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 2)
    with ui.override():
        bpy.ops.ed.undo()
    ui.move(desk.at(60))
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == ROW, "and the wires before do not come back"
    assert len(desk.session.wires) == 1
    assert [notice.text for notice in reports if "1 wire" in notice.text] != []


@pytest.fixture
def halves(ui: driver.Ui) -> Iterator[driver.Ui]:
    """Two grids beside each other, both edited, with the tool."""
    reset_settings()
    for name, x in (("Right", 0.8), ("Left", -0.8)):
        add_grid(5, size=1.0, name=name).location.x = x
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    choose(ui)
    ui.wait_until(lambda: len(edited.views()) == 2)
    yield ui
    leave(ui)


def place(ui: driver.Ui, name: str, vertex: int) -> tuple[float, float]:
    obj = bpy.data.objects[name]
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    return ui.on_screen(tuple(obj.matrix_world @ bm.verts[vertex].co))


def test_a_click_on_another_object_awaits_the_wire_on_the_first(halves: driver.Ui, slow: Slow) -> None:
    ui = halves
    ui.click(place(ui, "Left", 10))
    session = edited.front.session
    ui.wait_until(lambda: not session.computing)
    ui.move(place(ui, "Left", 14))
    slow.is_slow = True
    ui.click(place(ui, "Left", 14))
    assert session.waiting == 1
    ui.click(place(ui, "Right", 10))
    assert edited.front.name == "Right"
    assert seams(bpy.data.objects["Left"]) == chain(*range(10, 15))
    ui.key("RET")


def test_a_key_beside_a_held_button_leaves_the_object_in_front(halves: driver.Ui) -> None:
    ui = halves
    ui.click(place(ui, "Left", 10))
    session = edited.front.session
    ui.click(place(ui, "Left", 14))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    ui.move(place(ui, "Left", 14))
    ui.event("LEFTMOUSE", "PRESS", place(ui, "Left", 14))
    for part in (0.3, 0.6, 1.0):
        start, goal = place(ui, "Left", 14), place(ui, "Right", 12)
        ui.move((start[0] + part * (goal[0] - start[0]), start[1] + part * (goal[1] - start[1])))
    for key in ("LEFT_CTRL", "LEFT_SHIFT", "LEFT_ALT"):
        ui.event(key, "PRESS")
        ui.event(key, "RELEASE")
        assert edited.front.name == "Left", key
    ui.key("ESC")
    ui.event("LEFTMOUSE", "RELEASE")


# Seeds that are released


def press_and_escape(desk: Desk) -> None:
    ui = desk.ui
    ui.move(desk.at(10))
    ui.event("LEFTMOUSE", "PRESS", desk.at(10))
    ui.key("ESC")
    ui.event("LEFTMOUSE", "RELEASE", desk.at(10))


def drag_and_escape(desk: Desk) -> None:
    ui = desk.ui
    ui.event("LEFTMOUSE", "PRESS", desk.at(10))
    for vertex in (11, 12, 13):
        ui.move(desk.at(vertex))
    ui.key("ESC")
    ui.event("LEFTMOUSE", "RELEASE", desk.at(13))


def leave_mode(desk: Desk) -> None:
    with desk.ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
    desk.ui.move(desk.ui.on_screen((0.3, 0.4, 0.0)))


@pytest.mark.parametrize(
    "go_on",
    [press_and_escape, drag_and_escape, leave_mode],
    ids=["press, Esc", "drag, Esc", "mode"],
)
def test_a_released_seed_stays_where_it_is(desk: Desk, slow: Slow, go_on: Callable[[Desk], None]) -> None:
    session = release_ahead(desk, slow)
    go_on(desk)
    slow.is_slow = False
    end(desk)
    assert 53 in session.seeds()
    assert 44 not in session.seeds()
    assert any(53 in edge for edge in seams(desk.obj))


@pytest.mark.smoke
@pytest.mark.parametrize(("begin", "goal"), [(36, 27), (53, 62)], ids=["another", "the same"])
def test_a_second_seed_is_grabbed_while_the_first_one_waits(desk: Desk, slow: Slow, begin: int, goal: int) -> None:
    session, ui = release_ahead(desk, slow), desk.ui
    ui.move(desk.at(begin))
    ui.event("LEFTMOUSE", "PRESS", desk.at(begin))
    pull(desk, begin, goal)
    assert session.holds(Dragging)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(goal))
    slow.is_slow = False
    ui.wait_until(lambda: not session.waiting)
    end(desk)
    assert len(session.wires) == 1
    assert set(session.seeds()) == {36, 44, 53} - {44, begin} | {goal}


def test_undo_lets_a_released_seed_go_back(desk: Desk, slow: Slow) -> None:
    session = release_ahead(desk, slow)
    desk.ui.key("BACK_SPACE")
    slow.is_slow = False
    end(desk)
    assert 44 in session.seeds()
    assert 53 not in session.seeds()


def test_twenty_clicks_in_a_second_are_twenty_wires(desk: Desk, slow: Slow) -> None:
    session, ui = desk.start(), desk.ui
    slow.is_slow = True
    picks = [36, 40, 22, 24, 6, 8, 26, 44, 42, 60, 58, 76, 74, 56, 54, 72, 70, 52, 50, 32, 30]
    for pick in picks:
        ui.click(desk.at(pick))
    assert len(session.network.requests) == 20
    assert session.waiting == 20
    ui.key("RET")
    assert desk.chain.stage == "ENDING"
    slow.is_slow = False
    ui.wait_until(lambda: not desk.running)
    assert len(desk.session.wires) == 20
    assert [wire.start for wire in desk.session.wires] != []


def test_esc_ends_the_wait_and_keeps_wires_as_they_are_drawn(desk: Desk, slow: Slow) -> None:
    click_ahead(desk, slow)
    desk.ui.key("RET")
    assert desk.chain.stage == "ENDING"
    desk.ui.key("ESC")
    desk.ui.wait_until(lambda: not desk.running)
    assert slow.is_slow, "nothing was waited for"
    assert seams(desk.obj) == LONG_ROW
