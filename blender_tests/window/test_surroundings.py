# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes on around the tool: regions that lie over the view, files that are loaded."""

import bpy
import ui as driver
from scene import add_grid, edit
from seamwire.core.session import Session
from seamwire.operators import modal as drawing


def start(ui: driver.Ui) -> tuple[bpy.types.Object, Session]:
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    ui.wait()
    return obj, drawing.running[0].session


def test_over_toolbars_the_tool_lets_go_of_the_mouse(ui: driver.Ui) -> None:
    _, session = start(ui)
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    assert session.target is not None
    tools = next(region for region in ui.area.regions if region.type == "TOOLS")
    over = (tools.x + tools.width * 0.5 - ui.region.x, tools.y + tools.height * 0.5 - ui.region.y)
    ui.move(over)
    assert session.target is None
    assert drawing.running
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    ui.key("ESC")
    assert not drawing.running


def test_loading_a_file_ends_the_tool(ui: driver.Ui) -> None:
    start(ui)
    handlers = len(bpy.app.handlers.depsgraph_update_post)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert not drawing.running
    assert len(bpy.app.handlers.depsgraph_update_post) == handlers - 1
    ui.wait(4)
    fresh = driver.Ui()
    fresh.move((200.0, 200.0))
    fresh.pixels()
