# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool in the toolbar, several objects at once, coming back to a network, and every way that a drawing ends."""

from collections.abc import Iterator

import bmesh
import bpy
import pytest
import ui as driver
from desk import Desk, leave
from scene import add_grid, chain, edit, seams
from seamwire.operators import modal as drawing
from seamwire.ui import menus as texts


def said() -> str:
    return "; ".join(text for _, text in texts.hints(drawing.running[0].status()))


@pytest.mark.parametrize("modifiers", [{}, {"ctrl": True}])
def test_the_first_click_with_the_tool_places_a_seed(desk: Desk, modifiers: dict[str, bool]) -> None:
    ui = desk.ui
    with ui.override():
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    try:
        ui.wait(redraw=True)
        ui.move(desk.at(36))
        assert not desk.running
        ui.click(desk.at(36), **modifiers)
        assert desk.running
        session = desk.session
        ui.wait_until(lambda: session.seed == 36)
        ui.click(desk.at(44))
        ui.wait_until(lambda: len(session.wires) == 1)
        ui.key("RET")
        assert seams(desk.obj) == chain(*range(36, 45))
        ui.click(desk.at(0))
        assert desk.running, "the tool stays: the next click begins again"
        ui.key("ESC")
        ui.key("ESC")
        assert desk.left_clean()
    finally:
        with ui.override():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


def test_an_alt_click_with_the_tool_takes_a_loop(cone: Desk) -> None:
    ui = cone.ui
    with ui.override():
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    try:
        ui.wait(redraw=True)
        ui.click(cone.at(40, 49), alt=True)
        session = cone.session
        ui.wait_until(lambda: len(session.wires) == 1)
        assert session.wires[0].closed
    finally:
        with ui.override():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


class Two:
    """Two grids side by side in edit mode; the left one is active."""

    def __init__(self, ui: driver.Ui) -> None:
        self.ui = ui
        self.right = add_grid(5, size=1.0, name="Right")
        self.right.location.x = 0.8
        self.left = add_grid(5, size=1.0, name="Left")
        self.left.location.x = -0.8
        ui.wait()
        with ui.override():
            edit()
        ui.look_from_top(distance=4.0)

    def at(self, obj: bpy.types.Object, vertex: int) -> tuple[float, float]:
        x, y = vertex % 5, vertex // 5
        return self.ui.on_screen((obj.location.x + 0.25 * x - 0.5, 0.25 * y - 0.5, 0.0))


@pytest.fixture
def two(ui: driver.Ui) -> Iterator[Two]:
    yield Two(ui)
    leave(ui)


def test_the_object_under_the_cursor_is_drawn_on_and_all_are_marked_in_one_step(two: Two) -> None:
    ui, names = two.ui, (two.left.name, two.right.name)
    bpy.ops.ed.undo_push(message="Before")
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    running = drawing.running[0]
    assert list(running.boards) == ["Left"]
    ui.click(two.at(two.left, 10))
    ui.click(two.at(two.left, 14))
    ui.wait_until(lambda: len(running.session.wires) == 1)
    ui.click(two.at(two.right, 10))
    assert running.board.obj == two.right
    assert running.boards["Left"].session.seed is None, "the chain on the other object has ended"
    ui.click(two.at(two.right, 12))
    ui.wait_until(lambda: len(running.session.wires) == 1)
    ui.key("Z", ctrl=True)
    ui.key("Z", ctrl=True)
    ui.key("Z", ctrl=True)
    assert running.board.obj == two.left, "undone in the order of drawing"
    for _ in range(3):
        ui.key("Z", ctrl=True, shift=True)
    assert [len(board.session.wires) for board in running.boards.values()] == [1, 1]
    ui.key("RET")
    assert not drawing.running
    assert seams(two.left) == chain(*range(10, 15))
    assert seams(two.right) == chain(10, 11, 12)
    assert bpy.context.view_layer.objects.active == two.left
    ui.key("Z", ctrl=True)
    assert [seams(bpy.data.objects[name]) for name in names] == [[], []]


def test_other_objects_may_have_nothing_to_draw_on(two: Two) -> None:
    ui = two.ui
    bm = bmesh.from_edit_mesh(two.right.data)
    for face in bm.faces:
        face.hide_set(True)
    bmesh.update_edit_mesh(two.right.data)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    running = drawing.running[0]
    ui.click(two.at(two.left, 10))
    ui.move(two.at(two.right, 12))
    ui.click(two.at(two.left, 14))
    ui.wait_until(lambda: len(running.session.wires) == 1)
    assert list(running.boards) == ["Left"]


def test_other_objects_may_leave_edit_mode_and_go(two: Two) -> None:
    ui = two.ui
    at = two.at(two.right, 12)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    running = drawing.running[0]
    ui.click(two.at(two.left, 10))
    bpy.data.objects.remove(two.right)
    ui.move(at)
    ui.click(two.at(two.left, 14))
    ui.wait_until(lambda: len(running.session.wires) == 1)
    ui.key("RET")
    assert seams(two.left) == chain(*range(10, 15))


def draw_two(desk: Desk) -> None:
    session, ui = desk.session, desk.ui
    for first, last in ((36, 44), (0, 8)):
        before = len(session.wires)
        ui.click(desk.at(first), ctrl=True)
        ui.click(desk.at(last))
        ui.wait_until(lambda before=before: len(session.wires) > before)
        ui.click(desk.at(last), button="RIGHTMOUSE")


def test_a_network_can_be_gone_on_with(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    desk.ui.key("RET")
    assert "seamwire" in desk.obj.data
    session, ui = desk.start(), desk.ui
    assert "Go On" in said()
    assert session.wires == ()
    ui.move(desk.at(40))
    ui.key("R")
    assert len(session.wires) == 2
    assert "Go On" not in said()
    ui.click(desk.at(40), shift=True)
    assert len(session.wires) == 1
    ui.key("RET")
    assert seams(desk.obj) == chain(*range(9)), "what a dropped wire had marked is cleared"
    session = desk.start()
    ui.move(desk.at(4))
    ui.key("R")
    assert len(session.wires) == 1
    ui.key("DEL")
    ui.key("RET")
    assert seams(desk.obj) == []
    assert "seamwire" not in desk.obj.data


def test_wires_that_are_not_taken_up_stay_with_the_mesh(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    desk.ui.key("RET")
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(72))
    ui.click(desk.at(80))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    session = desk.start()
    ui.move(desk.at(40))
    ui.key("R")
    assert len(session.wires) == 3


def test_wires_whose_taking_up_was_undone_stay_with_the_mesh(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    desk.ui.key("RET")
    session, ui = desk.start(), desk.ui
    ui.move(desk.at(40))
    ui.key("R")
    ui.key("Z", ctrl=True)
    assert session.wires == ()
    assert "Go On" in said()
    ui.click(desk.at(72))
    ui.click(desk.at(80))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(desk.obj) == sorted(chain(*range(9)) + chain(*range(36, 45)) + chain(*range(72, 81)))
    session = desk.start()
    ui.move(desk.at(40))
    ui.key("R")
    assert len(session.wires) == 3


def test_escape_loses_nothing_that_was_interrupted_before(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    bpy.ops.object.mode_set(mode="OBJECT")
    desk.ui.move(desk.ui.on_screen((0.1, 0.1, 0.0)))
    with desk.ui.override():
        edit()
    desk.start()
    desk.ui.move(desk.at(40))
    desk.ui.key("ESC")
    assert not desk.running
    session = desk.start()
    desk.ui.move(desk.at(40))
    desk.ui.key("R")
    assert len(session.wires) == 2


def test_escape_stores_nothing(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    desk.ui.key("ESC")
    desk.ui.key("ESC")
    assert desk.left_clean()
    assert "seamwire" not in desk.obj.data
    assert desk.unchanged()


def test_the_preferences_say_whether_wires_are_taken_up(desk: Desk) -> None:
    from seamwire.ui import preferences

    own = preferences.get()
    desk.start()
    draw_two(desk)
    desk.ui.key("RET")
    try:
        own.resume = "ALWAYS"
        assert len(desk.start().wires) == 2
        drawing.close_all()
        desk.ui.move(desk.at(40))
        own.resume = "NEVER"
        desk.start()
        assert "Go On" not in said()
    finally:
        own.resume = "ASK"


def test_what_an_interruption_ended_can_be_gone_on_with(desk: Desk) -> None:
    desk.start()
    draw_two(desk)
    bpy.ops.object.mode_set(mode="OBJECT")
    desk.ui.move(desk.ui.on_screen((0.1, 0.1, 0.0)))
    assert desk.left_clean()
    assert seams(desk.obj) == []
    with desk.ui.override():
        edit()
    session = desk.start()
    assert "Go On" in said()
    desk.ui.move(desk.at(40))
    desk.ui.key("R")
    assert len(session.wires) == 2
    desk.ui.key("RET")
    assert seams(desk.obj) == sorted(chain(*range(9)) + chain(*range(36, 45)))


@pytest.mark.parametrize("keep", [False, True])
def test_a_drawing_that_changes_nothing_adds_no_step_of_undo(desk: Desk, keep: bool) -> None:
    name, bm = desk.obj.name, bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    bpy.ops.ed.undo_push(message="One")
    bm.verts[80].co.z = 0.25
    bmesh.update_edit_mesh(desk.obj.data)
    bpy.ops.ed.undo_push(message="Two")
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    if not keep:
        ui.click(desk.at(44))
        ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("Z", ctrl=True)
    if keep:
        ui.key("RET")
    for _ in range(3):
        if desk.running:
            ui.key("ESC")
    assert desk.left_clean()
    bpy.ops.ed.undo()
    bm = bmesh.from_edit_mesh(bpy.data.objects[name].data)
    bm.verts.ensure_lookup_table()
    assert bm.verts[80].co.z == 0.0, "one step back is the one before the drawing"


def test_blenders_undo_under_the_tool_ends_it(desk: Desk) -> None:
    bpy.ops.ed.undo_push(message="One")
    bpy.ops.ed.undo_push(message="Two")
    desk.start()
    desk.ui.click(desk.at(36))
    name = desk.obj.name
    with desk.ui.override():
        bpy.ops.ed.undo()
    desk.ui.move((300.0, 300.0))
    assert desk.left_clean()
    assert seams(bpy.data.objects[name]) == []


def test_another_workspace_ends_it(desk: Desk) -> None:
    ui = desk.ui
    before = ui.window.workspace
    desk.start()
    ui.click(desk.at(36))
    ui.window.workspace = next(space for space in bpy.data.workspaces if space != before)
    ui.wait(4)
    try:
        ui.move((300.0, 300.0))
        assert not desk.running
    finally:
        ui.window.workspace = before
        ui.wait(4)
    assert desk.left_clean()


def test_the_keys_are_shown_and_hidden(desk: Desk) -> None:
    desk.start()
    desk.ui.move(desk.at(40))
    before = desk.ui.pixels()
    desk.ui.key("H")
    shown = desk.ui.pixels()
    assert abs(shown - before).mean() > 0.01
    desk.ui.key("H")
    assert abs(desk.ui.pixels() - before).mean() < 0.001
