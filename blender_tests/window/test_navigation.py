# SPDX-License-Identifier: GPL-3.0-or-later
"""While seams are drawn, Blender goes on: the view is moved in every way, and other editors take their events."""

from types import SimpleNamespace

import bpy
import pytest
import ui as driver
from desk import Desk
from scene import chain, seams
from seamwire.operators import modal as drawing
from seamwire.ui import keymap


def begin(desk: Desk) -> None:
    """Start the tool, with a live wire."""
    session = desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    desk.ui.move(desk.at(40))
    desk.ui.wait_until(lambda: session.active is not None)


def drag(ui: driver.Ui, start: tuple[float, float], by: tuple[float, float], **modifiers: bool) -> None:
    ui.move(start, **modifiers)
    ui.event("MIDDLEMOUSE", "PRESS", start, **modifiers)
    for part in (0.25, 0.5, 1.0):
        ui.move((start[0] + part * by[0], start[1] + part * by[1]), **modifiers)
    ui.event("MIDDLEMOUSE", "RELEASE", **modifiers)


def finish(desk: Desk) -> None:
    """The wire that is still live is kept where it is seen now."""
    session = desk.session
    desk.ui.click(desk.at(44))
    desk.ui.wait_until(lambda: len(session.wires) == 1)
    desk.ui.key("RET")
    assert seams(desk.obj) == chain(*range(36, 45))


def test_the_middle_button_turns_moves_and_zooms(desk: Desk) -> None:
    begin(desk)
    ui = desk.ui
    turned, moved, distance = ui.view.view_rotation.copy(), ui.view.view_location.copy(), ui.view.view_distance
    drag(ui, desk.at(40), (0.0, 30.0), shift=True)
    assert (ui.view.view_location - moved).length > 0.05
    drag(ui, desk.at(40), (0.0, 30.0), ctrl=True)
    assert ui.view.view_distance != distance
    drag(ui, desk.at(40), (20.0, 10.0))
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.02
    finish(desk)


def test_a_trackpad_turns_the_view(desk: Desk) -> None:
    begin(desk)
    ui = desk.ui
    turned = ui.view.view_rotation.copy()
    ui.event("TRACKPADPAN", "NOTHING", (desk.at(40)[0] + 60.0, desk.at(40)[1] + 20.0))
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.01
    finish(desk)


@pytest.mark.parametrize("key", ["NUMPAD_1", "NUMPAD_3", "NUMPAD_8", "NUMPAD_6"])
def test_the_number_pad_turns_the_view(desk: Desk, key: str) -> None:
    begin(desk)
    ui = desk.ui
    turned = ui.view.view_rotation.copy()
    ui.move(desk.at(40))
    ui.key(key)
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.1
    assert desk.running
    ui.key("NUMPAD_7")
    assert ui.view.view_rotation.rotation_difference(turned).angle < 0.01
    finish(desk)


def test_the_number_pad_changes_the_projection(desk: Desk) -> None:
    begin(desk)
    before = desk.ui.view.view_perspective
    desk.ui.key("NUMPAD_5")
    assert desk.ui.view.view_perspective != before
    finish(desk)


def event(desk: Desk, kind: str, **held: bool) -> SimpleNamespace:
    """Return an event over the mesh as the drawing sees it."""
    x, y = desk.at(40)
    at = {"mouse_x": desk.ui.region.x + round(x), "mouse_y": desk.ui.region.y + round(y)}
    modifiers = dict.fromkeys(("ctrl", "shift", "alt", "oskey"), False)
    return SimpleNamespace(type=kind, value="NOTHING", is_repeat=False, **at, **{**modifiers, **held})


@pytest.mark.parametrize(
    "kind", ["NDOF_MOTION", "NDOF_BUTTON_FIT", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "HOME"]
)
def test_what_cannot_be_simulated_is_let_through(desk: Desk, kind: str) -> None:
    """Blender simulates no spaceball, and crashes on one that says nothing: the event is handed to the drawing itself."""
    begin(desk)
    handed = event(desk, kind)
    before = desk.session.revision
    with desk.ui.override():
        assert drawing.running[0].handle(bpy.context, handed) == {"PASS_THROUGH"}
    assert desk.session.revision == before
    assert keymap.is_navigation(handed)
    finish(desk)


@pytest.mark.parametrize(
    ("kind", "held"),
    [
        ("N", "shift"),
        ("N", "alt"),
        ("T", "alt"),
        ("NUMPAD_PLUS", "ctrl"),
        ("NUMPAD_MINUS", "ctrl"),
        ("NUMPAD_0", "ctrl"),
    ],
)
def test_keys_that_change_the_mesh_with_others_held_are_kept_away(desk: Desk, kind: str, held: str) -> None:
    begin(desk)
    handed = event(desk, kind, **{held: True})
    handed.value = "PRESS"
    with desk.ui.override():
        assert drawing.running[0].handle(bpy.context, handed) == {"RUNNING_MODAL"}
    finish(desk)


def test_shading_and_sidebars_can_be_switched(desk: Desk) -> None:
    begin(desk)
    ui = desk.ui
    shown = ui.space.show_region_ui
    ui.key("N")
    assert ui.space.show_region_ui != shown
    ui.key("N")
    # Newer Blenders let it fade, and count it as shown until then.
    ui.wait_until(lambda: ui.space.show_region_ui == shown)
    finish(desk)


def beside(ui: driver.Ui, kind: str) -> tuple[bpy.types.Area, bpy.types.Region, tuple[float, float]]:
    """Return an editor and where the middle of its main region is."""
    area = next(area for area in ui.window.screen.areas if area.type == kind)
    region = next(region for region in area.regions if region.type == "WINDOW")
    return area, region, (region.x + region.width // 2 - ui.region.x, region.y + region.height // 2 - ui.region.y)


def test_other_editors_take_keys_and_the_wheel(desk: Desk) -> None:
    begin(desk)
    ui, scene = desk.ui, bpy.context.scene
    revision = desk.session.network_revision
    _, region, at = beside(ui, "DOPESHEET_EDITOR")
    frame = scene.frame_current
    ui.move(at)
    ui.key("RIGHT_ARROW")
    assert scene.frame_current == frame + 1
    ui.key("LEFT_ARROW")
    assert scene.frame_current == frame
    left = region.view2d.region_to_view(0.0, 0.0)
    ui.wheel(up=True, at=at)
    ui.wait(4)
    assert region.view2d.region_to_view(0.0, 0.0) != left, "zoomed"
    ui.key("BACK_SPACE")
    assert desk.running
    assert desk.session.network_revision == revision
    assert desk.session.seed == 36, "keys over other editors are not the tool's"
    finish(desk)


def test_arrows_over_the_view_are_not_the_timelines(desk: Desk) -> None:
    begin(desk)
    frame = bpy.context.scene.frame_current
    desk.ui.key("RIGHT_ARROW")
    assert bpy.context.scene.frame_current == frame
    finish(desk)
