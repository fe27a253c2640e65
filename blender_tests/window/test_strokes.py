# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes in the real window: drawn, undone, erased, kept, and which edges are marked for them."""

from collections.abc import Iterator
from itertools import pairwise

import bpy
import pytest
import ui as driver
from desk import Desk, choose, leave, undo_steps
from scene import add_grid, chain, changing, seams
from seamwire.core.sketch.picture import Role
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited

SIDE = 31
LEFT, RIGHT = 15 * SIDE + 5, 15 * SIDE + 25
GATE = [(5, 15), (5, 23), (25, 23), (25, 15)]
"""Columns and rows of a stroke up from the left seed, across, and down to the right one."""
STRAIGHT = chain(*range(LEFT, RIGHT + 1))
ROUND = chain(
    *range(LEFT, 23 * SIDE + 5, SIDE), *range(23 * SIDE + 5, 23 * SIDE + 25), *range(23 * SIDE + 25, RIGHT - 1, -SIDE)
)


@pytest.fixture
def fine(ui: driver.Ui) -> Iterator[Desk]:
    """A flat grid of 31 x 31 vertices; vertex y * 31 + x is column x of row y."""
    desk = Desk(ui, add_grid(SIDE))
    ui.look_from_top(distance=2.6)
    yield desk
    leave(ui)


def at(desk: Desk, corner: tuple[float, float]) -> tuple[float, float]:
    x, y = (2.0 * part / (SIDE - 1) - 1.0 for part in corner)
    return desk.ui.on_screen((x, y, 0.0))


def draw(desk: Desk, corners: list[tuple[float, float]], **more: bool) -> None:
    """Draw a stroke along straight lines with Shift held."""
    ui = desk.ui
    held = {"shift": True, **more}
    ui.move(at(desk, corners[0]), **held)
    ui.event("LEFTMOUSE", "PRESS", **held)
    for (x, y), (to_x, to_y) in pairwise(corners):
        for step in range(1, 6):
            ui.move(at(desk, (x + step / 5 * (to_x - x), y + step / 5 * (to_y - y))), **held)
    ui.event("LEFTMOUSE", "RELEASE", **held)


def computed(desk: Desk) -> None:
    desk.ui.wait_until(lambda: not desk.session.computing)
    desk.ui.wait(2)


def wire(desk: Desk) -> list[tuple[int, int]]:
    """Return the edges of the live wire from the left seed to the right one."""
    desk.ui.click(desk.at(LEFT), ctrl=True)
    desk.ui.move(desk.at(RIGHT))
    session = desk.session
    desk.ui.wait_until(lambda: session.picture.active is not None and session.picture.one(Role.COMPUTING) is None)
    return sorted(session.picture.active.edges())


@pytest.mark.smoke
@pytest.mark.every_blender
def test_between_chains_a_stroke_is_a_step_of_blenders_undo_and_kept_with_the_mesh(
    fine: Desk, capfd: pytest.CaptureFixture[str]
) -> None:
    bpy.ops.ed.undo_push(message="Before")
    choose(fine.ui)
    draw(fine, GATE)
    fine.ui.wait_until(lambda: not fine.running)
    assert undo_steps(capfd)[-1] == "Draw Seamwires"
    assert seams(fine.obj) == []
    edited.clear()
    fine.ui.move(fine.at(LEFT))
    assert len(fine.session.network.strokes) == 1, "as the mesh has it"
    fine.ui.key("Z", ctrl=True)
    fine.ui.move(fine.at(LEFT))
    assert fine.session.network.strokes == ()
    fine.ui.key("Z", ctrl=True, shift=True)
    fine.ui.move(fine.at(LEFT))
    assert len(fine.session.network.strokes) == 1
    computed(fine)
    assert wire(fine) == sorted(ROUND)


@pytest.mark.smoke
def test_x_removes_the_stroke_under_the_cursor(fine: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    ui = fine.ui
    bpy.ops.ed.undo_push(message="Before")
    choose(ui)
    draw(fine, GATE)
    ui.wait_until(lambda: not fine.running)
    ui.move(at(fine, (15.0, 23.2)))
    ui.key("X")
    assert fine.session.network.strokes == ()
    assert undo_steps(capfd)[-1] == "Edit Seamwires"
    computed(fine)
    assert wire(fine) == STRAIGHT


@pytest.mark.smoke
@pytest.mark.every_blender
def test_wires_keep_off_a_stroke_that_repels(fine: Desk) -> None:
    choose(fine.ui)
    ui = fine.ui
    draw(fine, [(6.0, 15.0), (24.0, 15.0)], ctrl=True)
    session = fine.session
    assert not session.network.strokes[0].attracts
    computed(fine)
    off = wire(fine)
    assert len(set(off) & set(STRAIGHT)) < 8
    ui.click(fine.at(RIGHT))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(fine.obj) == off


def test_a_stroke_ends_where_it_leaves_the_model(fine: Desk) -> None:
    choose(fine.ui)
    draw(fine, [(20.0, 15.0), (40.0, 15.0), (40.0, 25.0), (20.0, 25.0)])
    points = fine.session.network.strokes[0].points
    assert points[:, 0].max() <= 1.0 + 1e-6
    assert abs(points[:, 1]).max() < 0.1, "what came after it left is not part of it"
    assert fine.unchanged()


def test_hidden_parts_of_the_mesh_are_not_drawn_on(fine: Desk) -> None:
    with changing(fine.obj) as bm:
        for face in bm.faces:
            face.hide_set(face.calc_center_median().x > 0.0)
    choose(fine.ui)
    draw(fine, [(5.0, 15.0), (25.0, 15.0), (25.0, 20.0), (5.0, 20.0)])
    points = fine.session.network.strokes[0].points
    assert points[:, 0].max() <= 1e-6
    assert abs(points[:, 1]).max() < 0.1, "there it ended"
    draw(fine, [(20.0, 15.0), (25.0, 20.0)])
    assert len(fine.session.network.strokes) == 1


def test_the_tools_reach_of_strokes_is_taken(fine: Desk) -> None:
    choose(fine.ui)
    settings().stroke_radius = 0.2
    draw(fine, GATE)
    assert fine.session.network.strokes[0].radius == pytest.approx(0.2)


@pytest.fixture(params=[1.0, 2.0])
def display_scale(request: pytest.FixtureRequest, fine: Desk) -> Iterator[float]:
    """Blender's display scale, set."""
    view = bpy.context.preferences.view
    view.ui_scale = request.param
    fine.ui.wait(4, redraw=True)
    yield request.param
    view.ui_scale = 1.0
    fine.ui.wait(4, redraw=True)


def stroke_by(desk: Desk, *ways: tuple[float, float]) -> None:
    """Draw a stroke from the left seed over places so many pixels from it."""
    x, y = desk.at(LEFT)
    desk.ui.move((x, y), shift=True)
    desk.ui.event("LEFTMOUSE", "PRESS", shift=True)
    for right, up in ways:
        desk.ui.move((x + right, y + up), shift=True)
    desk.ui.event("LEFTMOUSE", "RELEASE", shift=True)


def test_a_hand_may_be_as_unsteady_on_a_display_of_twice_the_scale(fine: Desk, display_scale: float) -> None:
    choose(fine.ui)
    stroke_by(fine, (5.0, 0.0))
    assert len(fine.session.network.strokes) == (1 if display_scale == 1.0 else 0), "five pixels are a drag, or a click"
    stroke_by(fine, (200.0, 0.0), (200.0, 100.0), (0.0, 100.0), (0.0, 15.0))
    points = fine.session.network.strokes[-1].points
    closed = bool((points[0] == points[-1]).all())
    assert closed is (display_scale == 2.0), "fifteen pixels from its beginning"
