# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawing in views of every kind: with perspective, on a display of larger scale, clipped, split in four, on a shape key."""

from collections.abc import Iterator

import bmesh
import bpy
import numpy as np
import pytest
import ui as driver
from bpy_extras.view3d_utils import location_3d_to_region_2d
from desk import WHITE, Desk, choose, draw, leave, shows
from scene import add_grid, chain, edit, seams
from seamwire.mesh.settings import settings
from seamwire.tool.running import chains as running
from seamwire.view.edited_objects import edited

ROW = chain(*range(36, 45))


@pytest.fixture
def scaled(ui: driver.Ui) -> Iterator[driver.Ui]:
    """A display of scale 1.75."""
    view = bpy.context.preferences.view
    view.ui_scale = 1.75
    ui.wait(4, redraw=True)
    yield ui
    view.ui_scale = 1.0
    ui.wait(4, redraw=True)


def test_at_a_scale_of_one_and_three_quarters_it_draws_and_says_first_what_matters(scaled: driver.Ui) -> None:
    desk = Desk(scaled, add_grid(9))
    try:
        session = desk.choose()
        scaled.click(desk.at(36))
        scaled.move(desk.at(44))
        scaled.wait_until(lambda: session.picture.active is not None)
        hints = [text for _, text in desk.chain.hints() if "Computing" not in text]
        assert "Keep Wire" in hints[0]
        assert "End Chain" in " ".join(hints[1:3])
        scaled.click(desk.at(44))
        scaled.wait_until(lambda: len(session.wires) == 1)
        scaled.key("RET")
        assert seams(desk.obj) == ROW
    finally:
        leave(scaled)


@pytest.mark.oldest_and_newest
def test_what_the_clipping_border_hides_is_neither_picked_nor_drawn(desk: Desk) -> None:
    ui = desk.ui
    session = desk.choose()
    draw(desk, 36, 44)
    left, right = desk.at(37), desk.at(43)
    middle = desk.at(40)
    with ui.override():
        bpy.ops.view3d.clip_border(
            xmin=round(middle[0]), xmax=ui.region.width - 5, ymin=5, ymax=ui.region.height - 5, wait_for_input=False
        )
    ui.wait(redraw=True)
    assert ui.view.use_clip_planes
    try:
        ui.move(right)
        assert session.target is not None
        ui.move(left)
        assert session.target is None
        ui.move((right[0], right[1] + 40.0))
        pixels = ui.pixels()
        assert not shows(pixels, desk.at(36), WHITE)
        assert shows(pixels, desk.at(44), WHITE)
    finally:
        ui.view.use_clip_planes = False


@pytest.mark.oldest_and_newest
@pytest.mark.parametrize("shown", ["tint", "ANGLE"])
def test_beyond_the_clipping_border_nothing_is_colored(desk: Desk, shown: str) -> None:
    ui = desk.ui
    desk.choose()
    draw(desk, 36, 44)
    if shown != "tint":
        settings().heat = shown
    (x, y), (right, top) = desk.at(4), desk.at(80)
    with ui.override():
        bpy.ops.view3d.clip_border(
            xmin=round(x), xmax=ui.region.width - 5, ymin=5, ymax=ui.region.height - 5, wait_for_input=False
        )
    try:
        ui.move((right + 30.0, top))
        ui.wait_until(lambda: not any(view.busy for view in edited.views()))
        seen = ui.pixels()
        choose(ui, "builtin.select_box")
        colored = np.abs(seen - ui.pixels())[round(y) : round(top), :, :3].max(axis=-1) > 0.02
        assert not colored[:, round(desk.at(0)[0]) : round(x) - 4].any()
        assert colored[:, round(x) + 4 : round(right)].mean() > 0.5
    finally:
        ui.view.use_clip_planes = False


def test_drawing_is_on_the_shape_that_is_seen(ui: driver.Ui) -> None:
    desk = Desk(ui, add_grid(9))
    try:
        bpy.ops.object.mode_set(mode="OBJECT")
        obj = desk.obj
        key = obj.shape_key_add(name="Narrow", from_mix=False)
        for number, point in enumerate(key.data):
            point.co.x = (number % 9 - 4) / 8.0
            point.co.z = 0.2 * (number % 9)
        key.value = 1.0
        obj.active_shape_key_index = len(obj.data.shape_keys.key_blocks) - 1
        with ui.override():
            edit()
        bm = bmesh.from_edit_mesh(obj.data)
        bm.verts.ensure_lookup_table()
        assert abs(bm.verts[8].co.x - 0.5) < 1e-6
        session = desk.choose()
        ui.move(desk.at(44))
        assert session.target.pick == 44
        draw(desk, 36, 44)
        assert seams(desk.obj) == ROW
        bpy.ops.object.mode_set(mode="OBJECT")
        assert desk.obj.data.shape_keys.key_blocks[0].data[8].co.x == 1.0
    finally:
        leave(ui)


@pytest.mark.parametrize(
    "name", [pytest.param("show_gizmo", marks=[pytest.mark.smoke, pytest.mark.every_blender]), "show_gizmo_tool"]
)
def test_what_a_click_takes_is_lit_where_gizmos_are_hidden_too(desk: Desk, name: str) -> None:
    session = desk.choose()
    setattr(desk.ui.space, name, False)
    try:
        desk.ui.wait(redraw=True)
        for vertex in (20, 40, 60):
            desk.ui.move(desk.at(vertex))
            assert session.target.pick == vertex
        assert not running
    finally:
        setattr(desk.ui.space, name, True)


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
        assert session.target.pick == 40
        found += 1
    assert found == 3, "from above twice, for the view that the drawing began in was turned there, and the user's"
    ui.key("ESC")
    assert not running
