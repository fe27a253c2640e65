# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool in the toolbar, and several objects at once."""

from collections.abc import Iterator

import bmesh
import bpy
import pytest
import ui as driver
from desk import Desk, choose, leave
from scene import add_grid, chain, changing, edit, seams
from seamwire.mesh.settings import TOOL
from seamwire.tool import draw
from seamwire.tool.running import chains as running
from seamwire.view.edited_objects import edited
from seamwire.view.viewport import place_in
from seamwire.words.hints import lines as corner_lines


def test_the_island_under_the_mouse_is_named(desk: Desk) -> None:
    ui = desk.ui
    desk.choose()
    assert edited.front.islands.pointed_island is None, "the mesh as a whole is no news"
    ui.click(desk.at(27))
    ui.click(desk.at(35))
    ui.wait_until(lambda: len(desk.session.wires) == 1)

    def named(place: tuple[float, float, float]) -> list[str]:
        ui.move(ui.on_screen(place))
        ui.wait_until(lambda: not edited.front.islands.busy)
        lines = corner_lines(edited.front.picture)
        return [line for line in lines if line.startswith("Island ")]

    larger, smaller = (0.03, 0.55, 0.0), (0.03, -0.7, 0.0)
    assert named(larger) == ["Island 1: 80 triangles"], "while a chain is drawn"
    ui.key("RET")
    assert named(smaller) == ["Island 2: 48 triangles"]
    assert named(larger) == ["Island 1: 80 triangles"]
    ui.move((ui.region.width - 140.0, 60.0))
    assert edited.front.islands.pointed_island is None


def test_a_click_beside_the_mesh_begins_nothing(desk: Desk) -> None:
    desk.choose()
    desk.ui.click((desk.ui.region.width - 140.0, 60.0))
    assert not desk.running


def test_over_the_half_that_a_modifier_mirrors_a_click_says_where_to_click(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    ui = desk.ui
    center = bpy.data.objects.new("Center", None)
    bpy.context.scene.collection.objects.link(center)
    center.location.y = 1.2
    modifier = desk.obj.modifiers.new("Mirror", "MIRROR")
    modifier.use_axis = False, True, False
    modifier.mirror_object = center
    desk.choose()
    ui.look_from_top(distance=9.0)
    ui.wait(3, redraw=True)
    said = []
    monkeypatch.setattr(draw, "tell_mirrored", lambda operator: said.append(operator.first))
    ui.click(ui.on_screen((0.03, -1.5, 0.0)))
    assert said == []
    ui.click(ui.on_screen((0.03, 2.3, 0.0)))
    assert said == ["CLICK"]
    assert not desk.running
    ui.click(desk.at(36))
    assert desk.running
    assert said == ["CLICK"]


@pytest.mark.smoke
def test_the_shortcut_and_the_menu_choose_the_tool(desk: Desk) -> None:
    ui = desk.ui
    ui.move(desk.at(40))
    ui.key("W", ctrl=True, alt=True)
    assert bpy.context.workspace.tools.from_space_view3d_mode("EDIT_MESH").idname == TOOL


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
        choose(ui)

    def at(self, obj: bpy.types.Object, vertex: int) -> tuple[float, float]:
        x, y = vertex % 5, vertex // 5
        return self.ui.on_screen((obj.location.x + 0.25 * x - 0.5, 0.25 * y - 0.5, 0.0))

    def names(self) -> list[str]:
        return [view.name for view in edited.views()]


@pytest.fixture
def two(ui: driver.Ui) -> Iterator[Two]:
    yield Two(ui)
    leave(ui)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_object_under_the_cursor_is_drawn_on_each_in_a_chain_of_its_own(two: Two) -> None:
    ui, names = two.ui, (two.left.name, two.right.name)
    bpy.ops.ed.undo_push(message="Before")
    ui.move(two.at(two.left, 12))
    assert edited.front.name == "Left"
    ui.click(two.at(two.left, 10))
    ui.click(two.at(two.left, 14))
    session = edited.front.session
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(two.at(two.right, 12))
    assert edited.front.name == "Left", "the live wire stays with its object"
    ui.click(two.at(two.right, 10))
    assert edited.front.name == "Right"
    assert session.seed is None, "the chain on the other object has ended"
    assert seams(two.left) == chain(*range(10, 15))
    ui.click(two.at(two.right, 12))
    ui.wait_until(lambda: len(edited.front.session.wires) == 1)
    ui.key("RET")
    assert not running
    assert seams(two.right) == chain(10, 11, 12)
    assert bpy.context.view_layer.objects.active == two.left
    ui.key("Z", ctrl=True)
    assert [seams(bpy.data.objects[name]) for name in names] == [chain(*range(10, 15)), []]
    ui.key("Z", ctrl=True)
    assert [seams(bpy.data.objects[name]) for name in names] == [[], []]


def test_undo_that_changes_another_objects_mesh_leaves_the_object_in_front_there(two: Two) -> None:
    ui = two.ui
    bpy.ops.ed.undo_push(message="Before")
    with changing(two.right) as bm:
        bmesh.ops.poke(bm, faces=list(bm.faces))
    bpy.ops.ed.undo_push(message="Poke")
    for side in (two.right, two.left):
        ui.move(two.at(side, 12))
    assert edited.front.name == "Left"
    poked = next(view for view in edited.views() if view.name == "Right")
    ui.key("Z", ctrl=True)
    ui.wait_until(lambda: any(view.name == "Right" and view is not poked for view in edited.views()))
    assert edited.front.name == "Left"


def test_other_objects_may_have_nothing_to_draw_on(two: Two) -> None:
    ui = two.ui
    with changing(two.right) as bm:
        for face in bm.faces:
            face.hide_set(True)
    ui.click(two.at(two.left, 10))
    ui.move(two.at(two.right, 12))
    ui.click(two.at(two.left, 14))
    ui.wait_until(lambda: len(edited.front.session.wires) == 1)
    assert two.names() == ["Left"]


@pytest.mark.smoke
def test_an_object_outside_the_local_view_is_not_pointed_at(two: Two) -> None:
    ui = two.ui
    ui.wait_until(lambda: len(two.names()) == 2)
    with ui.override():
        bpy.ops.view3d.localview(frame_selected=False)
    two.right.local_view_set(ui.space, False)
    try:
        ui.wait(4, redraw=True)
        at = two.at(two.right, 12)
        assert edited.find(place_in(ui.area, ui.region, (round(at[0]), round(at[1]))))[1] is None
    finally:
        with ui.override():
            bpy.ops.view3d.localview(frame_selected=False)
    ui.move(two.at(two.right, 13))
    ui.wait_until(lambda: edited.front.name == "Right" and edited.front.session.target is not None)


def test_one_of_several_objects_may_leave_edit_mode(two: Two) -> None:
    ui = two.ui
    ui.move(two.at(two.right, 12))
    ui.click(two.at(two.left, 10))
    assert running
    bpy.data.objects.remove(two.right)
    ui.move(two.at(two.left, 11))
    assert running, "the chain is on the other one"
    ui.click(two.at(two.left, 14))
    ui.wait_until(lambda: len(edited.front.session.wires) == 1)
    ui.key("RET")
    assert seams(two.left) == chain(*range(10, 15))


def test_over_toolbars_the_tool_lets_go_of_the_mouse(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.move(desk.at(40))
    assert session.target is not None
    bar = next(region for region in ui.area.regions if region.type == "TOOLS")
    ui.move((bar.x + bar.width * 0.5 - ui.region.x, bar.y + bar.height * 0.5 - ui.region.y))
    assert session.target is None
    assert desk.running
    ui.move(desk.at(40))
    ui.key("ESC")
    assert not desk.running
