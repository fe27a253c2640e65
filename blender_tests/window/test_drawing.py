# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains in the real window: what is marked, what is seen, and that nothing is left behind."""

from types import SimpleNamespace

import bpy
import pytest
import ui as driver
from desk import ORANGE, RED, WHITE, Desk, choose, shows, undo_steps
from mathutils import Euler
from scene import add_grid, chain, seams, snapshot
from seamwire.tool import events


@pytest.mark.smoke
@pytest.mark.every_blender
def test_wires_are_drawn_kept_and_marked(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    assert session.seed == 36
    ui.move(desk.at(40))
    ui.wait_until(lambda: session.picture.active is not None)
    assert session.picture.active.vertices == (36, 37, 38, 39, 40)
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), ORANGE)
    assert shows(pixels, desk.at(36), WHITE)
    assert not shows(pixels, desk.at(41, 42), ORANGE)
    ui.click(desk.at(40))
    ui.move(desk.at(44))
    ui.wait_until(lambda: session.picture.active is not None)
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), RED), "kept"
    assert shows(pixels, desk.at(41, 42), ORANGE), "live"
    ui.click(desk.at(44))
    ui.click(desk.at(0), ctrl=True)
    ui.click(desk.at(2))
    ui.wait_until(lambda: len(session.wires) == 3)
    ui.click(desk.at(20), button="RIGHTMOUSE")
    assert desk.left_clean()
    assert seams(desk.obj) == sorted(chain(*range(36, 45)) + chain(0, 1, 2))
    after = snapshot(desk.obj, with_seams=False)
    assert after == {key: value for key, value in desk.before.items() if key != "seams"}
    ui.move(desk.at(20))
    assert not shows(ui.pixels(), desk.at(36), WHITE), "with another tool only Blender's own seams are seen"
    choose(ui)
    ui.move(desk.at(21))
    assert shows(ui.pixels(), desk.at(36), WHITE), "with the tool the seeds are"


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_double_click_on_an_edge_takes_its_loop(cone: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = cone.start(), cone.ui
    # A redraw between the clicks may take longer than Blender's longest time for a double click.
    monkeypatch.setattr(events, "time", SimpleNamespace(monotonic=lambda: 0.0))
    edge = cone.at(40, 49)
    ui.wait_until(lambda: not session.computing)
    ui.move(edge)
    for _ in range(2):
        ui.event("LEFTMOUSE", "PRESS", ticks=1)
        ui.event("LEFTMOUSE", "RELEASE", ticks=1)
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.wires[0].closed
    assert (40, 49) in seams(cone.obj)
    assert not cone.running, "the first of the two clicks left nothing"


@pytest.mark.smoke
def test_e_switches_to_the_surface_and_back(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20), ctrl=True)
    ui.click(cone.at(24))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(cone.at(60))
    ui.key("E")
    assert session.options.along == "SURFACE"
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.picture.active is not None)
    assert session.picture.active.along == "SURFACE"
    assert session.picture.active.vertices[0] == 24
    assert session.picture.active.vertices[-1] == 61
    ui.move(cone.at(60))
    ui.wait_until(lambda: session.picture.active is not None)
    ui.click(cone.at(60))
    ui.key("E")
    ui.move(cone.at(76))
    ui.wait_until(lambda: session.picture.active is not None)
    assert session.picture.active.along == "EDGES"
    assert session.picture.active.vertices[0] == 60
    marked = session.edges_to_mark()
    assert {v for edge in marked for v in edge} >= {20, 24, 60}
    ui.key("RET")
    assert seams(cone.obj) == marked


@pytest.mark.oldest_and_newest
def test_on_a_turned_and_unevenly_scaled_object_wires_lie_on_the_mesh(ui: driver.Ui) -> None:
    obj = add_grid(9)
    obj.scale = (0.5, 1.4, 2.0)
    obj.rotation_euler = Euler((0.3, -0.4, 0.6))
    obj.location = (0.2, 0.1, -3.0)
    bpy.context.view_layer.update()
    desk = Desk(ui, obj)
    session = desk.start()
    ui.view.view_location = obj.location
    ui.wait(redraw=True)
    ui.click(desk.at(36), ctrl=True)
    ui.move(desk.at(44))
    ui.wait_until(lambda: session.picture.active is not None)
    assert session.picture.active.vertices == tuple(range(36, 45))
    pixels = ui.pixels()
    for first in range(37, 43):
        assert shows(pixels, desk.at(first, first + 1), ORANGE)
    ui.key("ESC")
    assert desk.unchanged()


@pytest.mark.smoke
@pytest.mark.every_blender
def test_escape_drops_the_live_wire_only(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    assert not desk.left_clean()
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(desk.at(60))
    ui.key("ESC")
    assert desk.left_clean()
    assert seams(desk.obj) == chain(*range(36, 45))


def test_a_chain_without_a_wire_leaves_the_mesh_and_undo_as_they_were(
    desk: Desk, capfd: pytest.CaptureFixture[str]
) -> None:
    before = undo_steps(capfd)
    for key in ("RET", "ESC"):
        desk.start()
        desk.ui.click(desk.at(36), ctrl=True)
        desk.ui.key(key)
        assert desk.left_clean()
    assert desk.unchanged()
    assert undo_steps(capfd) == before


@pytest.mark.smoke
@pytest.mark.every_blender
def test_undo_and_redo_within_a_chain_go_wire_by_wire(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    session, ui = desk.start(), desk.ui
    before = undo_steps(capfd)
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(40))
    ui.click(desk.at(76))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("Z", ctrl=True)
    assert [wire.end for wire in session.wires] == [40]
    ui.key("Z", ctrl=True, shift=True)
    assert [wire.end for wire in session.wires] == [40, 76]
    ui.key("BACK_SPACE")
    ui.key("BACK_SPACE")
    assert session.wires == ()
    assert desk.running
    ui.key("Z", ctrl=True)
    assert desk.left_clean(), "without its first seed there is no chain"
    assert desk.unchanged()
    assert undo_steps(capfd) == before
