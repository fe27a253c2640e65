# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams drawn by dragging over the surface, in the real window."""

import itertools

import bpy
import pytest
from desk import ORANGE, RED, WHITE, Desk, drag, shows, undo_steps
from scene import chain, seams
from seamwire.core.sketch.picture import Role


def press_and_draw(desk: Desk, *places: tuple[float, float]) -> None:
    """Press the button at the first place and move over the others, in steps."""
    ui = desk.ui
    ui.move(places[0])
    ui.event("LEFTMOUSE", "PRESS", places[0])
    for start, end in itertools.pairwise(places):
        for part in (0.25, 0.5, 0.75, 1.0):
            ui.move((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))


def beside(place: tuple[float, float], x: float = 0.0, y: float = 0.0) -> tuple[float, float]:
    return place[0] + x, place[1] + y


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_drag_over_the_mesh_draws_along_its_edges_in_one_step(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    session, ui = desk.choose(), desk.ui
    ui.wait_until(lambda: session.progress == 1.0)
    # Along a row and up a column, some pixels beside the edges, as a hand draws.
    press_and_draw(desk, beside(desk.at(36), 3, 4), beside(desk.at(40), -4, -5), beside(desk.at(67), 5, 3))
    wanted = (*range(36, 41), 49, 58, 67)
    assert [wire.vertices for wire in session.picture.all(Role.FOLLOWING)] == [wanted]
    assert session.wires == ()
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), ORANGE), "it is seen while it is drawn"
    assert shows(pixels, desk.at(49, 58), ORANGE)
    ui.event("LEFTMOUSE", "RELEASE")
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == chain(*wanted)
    assert undo_steps(capfd)[-1] == "Draw Seamwires"
    ui.move(desk.at(20))
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), RED)
    assert shows(pixels, desk.at(36), WHITE), "its ends are seeds"
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []
    assert desk.session.wires == ()


def test_a_click_is_a_click_still(desk: Desk) -> None:
    session, ui = desk.choose(), desk.ui
    ui.move(desk.at(36))
    ui.event("LEFTMOUSE", "PRESS", desk.at(36))
    threshold = bpy.context.preferences.inputs.drag_threshold_mouse * bpy.context.preferences.system.ui_scale
    ui.move(beside(desk.at(36), threshold - 1))
    ui.event("LEFTMOUSE", "RELEASE")
    assert session.seed == 36
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.wires[0].vertices == (36, 37, 38, 39, 40)
    assert session.seed is not None
    ui.key("RET")
    assert seams(desk.obj) == chain(*range(36, 41))


def test_a_line_from_the_live_seed_goes_on_with_the_chain(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(0))
    ui.click(desk.at(4))
    ui.wait_until(lambda: len(session.wires) == 1)
    # The line begins at the place of the last click.
    monkeypatch.setattr(bpy.context.preferences.inputs, "mouse_double_click_time", 1)
    drag(desk, desk.at(4), desk.at(40))
    ui.wait_until(lambda: session.seed_place == 40)
    ui.click(desk.at(44))
    ui.wait_until(lambda: session.seed_place == 44)
    ui.key("RET")
    assert seams(desk.obj) == sorted(chain(0, 1, 2, 3, 4) + chain(4, 13, 22, 31, 40) + chain(*range(40, 45)))


def test_a_line_elsewhere_ends_the_chain_and_is_kept_with_it(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(0))
    ui.click(desk.at(4))
    ui.wait_until(lambda: len(session.wires) == 1)
    drag(desk, desk.at(36), desk.at(40))
    ui.wait_until(lambda: not desk.running)
    both = sorted(chain(0, 1, 2, 3, 4) + chain(*range(36, 41)))
    assert seams(desk.obj) == both
    assert undo_steps(capfd)[-1:] == ["Draw Seamwires"]
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == [], "both are one step"
