# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes on around the tool: several views, regions that lie over them, files that are loaded."""

import bpy
import ui as driver
from bpy_extras.view3d_utils import location_3d_to_region_2d
from scene import add_grid, edit
from seamwire import operator
from seamwire.session import Session


def start(ui: driver.Ui) -> tuple[bpy.types.Object, Session]:
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    ui.wait()
    return obj, operator._running[0].session


def test_every_view_of_a_quad_view_can_be_drawn_in(ui: driver.Ui) -> None:
    with ui.override():
        bpy.ops.screen.region_quadview()
    ui.wait(4, redraw=True)
    obj, session = start(ui)
    for view in ui.space.region_quadviews:
        view.view_location = (0.0, 0.0, 0.0)
        view.view_distance = 3.0
    ui.wait(4, redraw=True)
    point = obj.data.vertices[40].co
    views = [region for region in ui.area.regions if region.type == "WINDOW"]
    assert len(views) == 4
    found = 0
    for region, view in zip(views, ui.space.region_quadviews, strict=True):
        at = location_3d_to_region_2d(region, view, point)
        from_the_side = abs(view.view_rotation.to_matrix()[2][2]) < 0.1
        if from_the_side:
            continue
        session.hover(None)
        ui.move((region.x + at.x - ui.region.x, region.y + at.y - ui.region.y))
        assert session.target == 40
        found += 1
    assert found == 3, "from above twice, for the view that the drawing began in was turned there, and the user's"
    ui.key("ESC")
    assert not operator._running
    with ui.override():
        bpy.ops.screen.region_quadview()
    ui.wait(4, redraw=True)


def test_over_toolbars_the_tool_lets_go_of_the_mouse(ui: driver.Ui) -> None:
    _, session = start(ui)
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    assert session.target is not None
    tools = next(region for region in ui.area.regions if region.type == "TOOLS")
    over = (tools.x + tools.width * 0.5 - ui.region.x, tools.y + tools.height * 0.5 - ui.region.y)
    ui.move(over)
    assert session.target is None
    ui.event("LEFTMOUSE", "PRESS", over)
    ui.event("LEFTMOUSE", "RELEASE", over)
    assert session.seed is None
    assert operator._running
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    ui.key("ESC")
    assert not operator._running


def test_loading_a_file_ends_the_tool(ui: driver.Ui) -> None:
    start(ui)
    handlers = len(bpy.app.handlers.load_pre)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert not operator._running
    assert len(bpy.app.handlers.load_pre) == handlers - 1
    ui.wait(4)
    fresh = driver.Ui()
    fresh.move((200.0, 200.0))
    fresh.pixels()
