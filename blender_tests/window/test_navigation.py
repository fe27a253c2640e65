# SPDX-License-Identifier: GPL-3.0-or-later
"""While a chain is drawn the view is moved in every way that the user's keymap knows."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
import ui as driver
from desk import Desk
from scene import chain, seams


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


@pytest.mark.smoke
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
    """Blender simulates no spaceball, and crashes on one that says nothing: the event is handed to the chain itself."""
    begin(desk)
    handed = event(desk, kind)
    before = desk.session.revision
    with desk.ui.override():
        assert desk.chain.handle(bpy.context, handed)
    assert desk.session.revision == before
    assert not desk.chain.idle
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


def test_the_navigation_gizmo_works(desk: Desk) -> None:
    begin(desk)
    ui = desk.ui
    turned = ui.view.view_rotation.copy()
    scale = bpy.context.preferences.system.ui_scale
    sidebar = next(region for region in ui.area.regions if region.type == "UI")
    header = max(region.y + region.height for region in ui.area.regions if region.type == "HEADER")
    right = ui.region.width - (sidebar.width if sidebar.width > 1 else 0)
    tops = [region.y - ui.region.y for region in ui.area.regions if region.type in {"HEADER", "TOOL_HEADER"}]
    top = min([top for top in tops if top > ui.region.height / 2], default=header - ui.region.y)
    ball = (right - 52.0 * scale, top - 52.0 * scale)
    ui.move(ball)
    ui.event("LEFTMOUSE", "PRESS", ball)
    for step in range(1, 4):
        ui.move((ball[0] + 8.0 * step, ball[1] - 6.0 * step))
    ui.event("LEFTMOUSE", "RELEASE", (ball[0] + 24.0, ball[1] - 18.0))
    ui.wait(2)
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.02
    assert desk.running
    assert desk.session.wires == ()
    finish(desk)


@pytest.fixture
def industry() -> Iterator[None]:
    """Blender's preset keymap Industry Compatible."""
    manager = bpy.context.window_manager
    before = manager.keyconfigs.active.name
    path = next(
        Path(folder) / "Industry_Compatible.py"
        for folder in bpy.utils.preset_paths("keyconfig")
        if (Path(folder) / "Industry_Compatible.py").exists()
    )
    bpy.utils.keyconfig_set(str(path))
    yield
    manager.keyconfigs.active = manager.keyconfigs[before]


def test_with_the_industry_compatible_keymap_alt_and_the_mouse_move_the_view(industry: None, desk: Desk) -> None:
    desk.ui.wait(4)
    begin(desk)
    ui = desk.ui
    turned, distance = ui.view.view_rotation.copy(), ui.view.view_distance
    start = desk.at(40)
    for button in ("LEFTMOUSE", "RIGHTMOUSE"):
        ui.move(start, alt=True)
        ui.event(button, "PRESS", start, alt=True)
        for step in range(1, 4):
            ui.move((start[0] + 10.0 * step, start[1] + 6.0 * step), alt=True)
        ui.event(button, "RELEASE", (start[0] + 30.0, start[1] + 18.0), alt=True)
        ui.wait(2)
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.02
    assert ui.view.view_distance != distance
    assert desk.running
    assert desk.session.wires == ()
    finish(desk)


def test_what_a_key_means_is_read_from_the_users_keymap(desk: Desk) -> None:
    keys = bpy.context.window_manager.keyconfigs.user.keymaps["3D View"].keymap_items
    own = [keys.new("view3d.view_axis", "F19", "PRESS"), keys.new("mesh.select_all", "F20", "PRESS")]
    own[0].properties.type = "FRONT"
    try:
        begin(desk)
        ui = desk.ui
        turned = ui.view.view_rotation.copy()
        ui.key("F19")
        assert ui.view.view_rotation.rotation_difference(turned).angle > 0.1
        assert desk.running
        ui.look_from_top(distance=4.0)
        ui.click(desk.at(44))
        ui.wait_until(lambda: len(desk.session.wires) == 1)
        ui.key("F20")
        assert not desk.running
        assert seams(desk.obj) == chain(*range(36, 45))
    finally:
        # Blender may have made the items anew.
        keys = bpy.context.window_manager.keyconfigs.user.keymaps["3D View"].keymap_items
        for item in [item for item in keys if item.type in {"F19", "F20"}]:
            keys.remove(item)
