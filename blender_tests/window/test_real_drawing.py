# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawing with the display's own pointer: what simulated events cannot do."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import ui as driver
from desk import choose
from scene import add_grid, chain, edit, seams, snapshot
from seamwire.tool import events
from seamwire.tool.running import chains as running


def test_a_double_click_takes_a_loop_and_single_clicks_draw(
    real_ui: driver.RealUi, monkeypatch: pytest.MonkeyPatch
) -> None:
    ui = real_ui
    # A band around the z axis: its middle ring is the loop through each of the ring's edges.
    # A redraw between the clicks may take longer than Blender's longest time for a double click.
    monkeypatch.setattr(events, "time", SimpleNamespace(monotonic=lambda: 0.0))
    bpy.ops.mesh.primitive_cylinder_add(vertices=12, depth=2.0, end_fill_type="NOTHING")
    obj = bpy.context.active_object
    ui.wait()
    with ui.override():
        edit()
    with ui.override():
        bpy.ops.mesh.subdivide(number_cuts=1)
    ui.wait()
    ui.look((0.70710678, 0.70710678, 0.0, 0.0), (0.0, 0.0, 0.0), 5.0)  # from the front: x to the right, z up
    before = snapshot(obj, with_seams=False)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    session = running[0].session
    ui.wait_until(lambda: not session.computing)
    middle = ui.on_screen((0.13, -0.96, 0.0))
    ui.move(middle)
    assert isinstance(session.target.pick, tuple)
    ui.double_click(middle)
    ui.wait_until(lambda: len(session.wires) == 1)
    loop = session.wires[0]
    assert loop.closed
    assert len(loop.vertices) == 24
    assert np.allclose(loop.points[:, 2], 0.0)
    ui.wait_until(lambda: not running)
    assert seams(obj) == sorted(loop.edges())
    after = snapshot(obj, with_seams=False)
    assert after == before


def test_a_left_button_that_plays_the_middle_one_turns_the_view_between_chains_and_within_one(
    real_ui: driver.RealUi, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Blender makes another button of it before an operator hears of it: simulated events stay what they are."""
    ui = real_ui
    monkeypatch.setattr(bpy.context.preferences.inputs, "use_mouse_emulate_3_button", True)
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    choose(ui)

    def turn() -> float:
        """Drag with Alt and the left button; return the angle that the view was turned by."""
        before, start = ui.view.view_rotation.copy(), ui.on_screen((0.03, 0.4, 0.0))
        ui.move(start)
        ui.event("LEFT_ALT", "PRESS")
        assert not (running and running[0].peek), "a click would not take a loop"
        ui.event("LEFTMOUSE", "PRESS", alt=True)
        for step in range(1, 4):
            ui.move((start[0] + 15.0 * step, start[1]))
        ui.event("LEFTMOUSE", "RELEASE")
        ui.event("LEFT_ALT", "RELEASE")
        angle = ui.view.view_rotation.rotation_difference(before).angle
        ui.look_from_top(distance=4.0)
        return angle

    assert turn() > 0.02
    assert not running
    ui.click(ui.on_screen(tuple(obj.data.vertices[36].co)))
    assert running[0].session.seed == 36
    assert turn() > 0.02
    assert running[0].session.wires == ()
    running[0].finish()
    assert seams(obj) == []
    choose(ui, "builtin.select_box")


@pytest.mark.smoke
def test_a_wire_is_drawn_by_hand(real_ui: driver.RealUi) -> None:
    ui = real_ui
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    session = running[0].session

    def at(vertex: int) -> tuple[float, float]:
        return ui.on_screen(tuple(obj.data.vertices[vertex].co))

    ui.click(at(36), ctrl=True)
    assert session.seed == 36
    ui.move(at(40))
    ui.wait_until(lambda: session.picture.active is not None)
    ui.click(at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.click(at(60), button="RIGHTMOUSE")
    ui.wait_until(lambda: not running)
    assert seams(obj) == chain(*range(36, 45))
