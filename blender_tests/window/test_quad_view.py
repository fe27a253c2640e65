# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawing in a view split in four."""

import bpy
import ui as driver
from bpy_extras.view3d_utils import location_3d_to_region_2d
from scene import add_grid, edit
from seamwire.operators.chain_state import running


def test_every_view_of_a_quad_view_can_be_drawn_in(ui: driver.Ui) -> None:
    with ui.override():
        bpy.ops.screen.region_quadview()
    ui.wait(4, redraw=True)
    try:
        draw_in_each(ui)
    finally:
        # This frees the regions of the four views. The next test finds the one that is left.
        with ui.override():
            bpy.ops.screen.region_quadview()
        ui.wait(4)


def draw_in_each(ui: driver.Ui) -> None:
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    ui.wait()
    session = running[0].session
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
        assert session.cursor.target.pick == 40
        found += 1
    assert found == 3, "from above twice, for the view that the drawing began in was turned there, and the user's"
    ui.key("ESC")
    assert not running
