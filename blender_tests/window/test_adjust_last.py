# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's *Adjust Last Operation* after drawing: nothing that was drawn may go with it, and nothing may come twice."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

import bpy
import pytest
from desk import Desk, choose, drag, draw, undo_steps
from scene import seams
from seamwire.tool.running import DRAW, EDIT


def call(desk: Desk, name: str, **options: object) -> None:
    """Run an operator as from a menu, so that Blender can adjust it afterwards."""
    group, operator = name.split(".")
    with desk.ui.override():
        getattr(getattr(bpy.ops, group), operator)("EXEC_DEFAULT", True, **options)
    desk.ui.wait(redraw=True)


def adjust(desk: Desk) -> None:
    """Do what Blender does when a number in the panel *Adjust Last Operation* was changed."""
    with desk.ui.override():
        if bpy.ops.ed.undo_redo.poll():
            bpy.ops.ed.undo_redo()
    desk.ui.wait(redraw=True)


def stroke(desk: Desk, start: int, end: int, **modifiers: bool) -> None:
    """Draw a stroke between two vertices."""
    ui = desk.ui
    ui.move(desk.at(start), **modifiers)
    ui.event("LEFTMOUSE", "PRESS", desk.at(start), **modifiers)
    for vertex in range(start + 1, end + 1):
        ui.move(desk.at(vertex), **modifiers)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(end), **modifiers)


def draw_middle(desk: Desk) -> None:
    """Draw a wire along the middle row."""
    draw(desk, 36, 44)


def add_loop(desk: Desk) -> None:
    """Take the strip through an edge of the middle row."""
    at = desk.at(40, 41)
    desk.ui.move(at, alt=True)
    desk.ui.click(at, alt=True)
    desk.ui.event("LEFT_ALT", "RELEASE", at)


def draw_line(desk: Desk) -> None:
    """Draw a line along the middle row."""
    drag(desk, desk.at(37), desk.at(43))


def move_seed(desk: Desk) -> None:
    """Drag the end of the first row's wire."""
    drag(desk, desk.at(8), desk.at(17))


def remove(desk: Desk) -> None:
    """Remove the first row's wire."""
    desk.ui.move(desk.at(4))
    desk.ui.key("X")


def guide(desk: Desk) -> None:
    """Draw a stroke that wires follow."""
    stroke(desk, 55, 61, shift=True)


GESTURES: dict[str, tuple[Callable[[Desk], None], str]] = {
    "wires": (draw_middle, DRAW),
    "line": (draw_line, DRAW),
    "loop": (add_loop, DRAW),
    "seed": (move_seed, EDIT),
    "removal": (remove, EDIT),
    "stroke": (guide, DRAW),
}
"""Gestures, and the titles of their steps of undo."""

OPERATORS: tuple[tuple[str, dict[str, object]], ...] = (
    ("uv.unwrap", {}),
    ("mesh.select_all", {"action": "SELECT"}),
    ("transform.translate", {"value": (0.0, 0.0, 0.1)}),
    ("mesh.seamwire_close_gaps", {}),
    ("mesh.seamwire_finish", {"finish": "CUT"}),
    ("mesh.seamwire_repeat", {}),
    ("mesh.seamwire_select_islands", {"which": "TO_CUT"}),
    ("mesh.seamwire_finish", {"finish": "SLIDE"}),
    ("mesh.seamwire_store", {"what": "MATERIALS"}),
    ("mesh.seamwire_suggest", {"islands": 2}),
    ("mesh.seamwire_take_over", {}),
    ("mesh.seamwire_unwrap", {}),
)


@pytest.fixture
def unwrapped(desk: Desk) -> Desk:
    """The grid with a wire along its first row, and Blender's unwrap as the operator that can be adjusted."""
    desk.choose()
    draw(desk, 0, 8)
    with desk.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
    call(desk, "uv.unwrap")
    return desk


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.smoke, pytest.mark.every_blender] if name == "loop" else [])
        for name in GESTURES
    ],
)
def test_after_a_gesture_no_operator_from_before_it_is_adjusted(
    unwrapped: Desk, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    desk = unwrapped
    before = seams(desk.obj)
    gesture, title = GESTURES[name]
    gesture(desk)
    desk.ui.wait_until(lambda: not desk.running)
    after, steps = seams(desk.obj), undo_steps(capfd)
    strokes = desk.session.network.strokes
    assert steps[-1] == title
    assert after != before or strokes
    adjust(desk)
    assert seams(desk.obj) == after
    assert undo_steps(capfd) == steps
    desk.ui.key("Z", ctrl=True)
    assert seams(desk.obj) == before, "it is one step"
    desk.ui.key("Z", ctrl=True, shift=True)
    assert seams(desk.obj) == after
    desk.ui.move(desk.at(70))
    assert len(desk.session.network.strokes) == len(strokes)


@pytest.mark.parametrize(("name", "options"), OPERATORS, ids=[name for name, _ in OPERATORS])
def test_a_loop_stays_whatever_operator_came_before_it(desk: Desk, name: str, options: dict[str, object]) -> None:
    desk.choose()
    draw(desk, 0, 8)
    with suppress(RuntimeError):  # there may be nothing for it to do
        call(desk, name, **options)
    choose(desk.ui)
    before = seams(desk.obj)
    add_loop(desk)
    desk.ui.wait_until(lambda: not desk.running)
    after = seams(desk.obj)
    assert after != before
    adjust(desk)
    assert seams(desk.obj) == after
