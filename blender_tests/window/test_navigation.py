# SPDX-License-Identifier: GPL-3.0-or-later
"""While a chain is drawn the view is moved in every way that the user's keymap knows."""

from collections.abc import Iterator
from types import SimpleNamespace

import bpy
import pytest
import ui as driver
from desk import Desk, choose
from keymaps import KEYMAPS, Gesture, as_event, gestures, using
from scene import chain, seams
from seamwire.tool.acts import act
from seamwire.tool.events import read
from seamwire.words.keys import KEYS, Key


def begin(desk: Desk) -> None:
    """Start the tool, with a live wire."""
    session = desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    desk.ui.move(desk.at(40))
    desk.ui.wait_until(lambda: session.picture.active is not None)


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
        assert act(desk.chain, read(desk.chain, bpy.context, handed))
    assert desk.session.revision == before
    assert desk.chain.stage != "OVER"
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


HANDS = [
    *(pytest.param(name, True, marks=pytest.mark.every_blender, id=f"buttons-{name}") for name in KEYMAPS),
    *(pytest.param(name, False, id=f"keys-{name}") for name, (_, button) in KEYMAPS.items() if button != "RIGHT"),
]
"""Each keymap with its buttons, and with its keys."""


@pytest.fixture
def keymap(request: pytest.FixtureRequest) -> Iterator[str]:
    """One of `KEYMAPS`."""
    with using(request.param):
        yield request.param


ALONG = {"NORTH": (0, 1), "SOUTH": (0, -1), "EAST": (1, 0), "WEST": (-1, 0)}


def seen(ui: driver.Ui) -> tuple[object, ...]:
    """Return all that tells how the view looks at the scene."""
    view = ui.view
    numbers = (*view.view_rotation, *view.view_location, view.view_distance)
    return (*(round(number, 5) for number in numbers), view.view_perspective)


def do(desk: Desk, kind: str, value: str, direction: str, held: dict[str, bool]) -> bool:
    """Do what a hand does for a gesture; return whether it moved the view, which is then put back."""
    ui, start = desk.ui, desk.at(50)
    view = ui.view
    place = view.view_rotation.copy(), view.view_location.copy(), view.view_distance, view.view_perspective
    before = seen(ui)
    ui.event("MOUSEMOVE", "NOTHING", start, ticks=0)
    for i, name in enumerate(held):
        ui.event(f"LEFT_{name.upper()}", "PRESS", ticks=0, **dict.fromkeys(list(held)[: i + 1], True))
    if kind == "TRACKPADPAN":
        ui.event(kind, "NOTHING", (start[0] + 60.0, start[1] + 20.0), ticks=0, **held)
    elif kind.startswith("WHEEL"):
        ui.event(as_event(kind), "PRESS", ticks=0, **held)
    else:
        ui.event(kind, "PRESS", ticks=0, **held)
        if kind.endswith("MOUSE") and value != "CLICK":
            x, y = ALONG.get(direction, (0.6, 0.8))
            for far in (15.0, 30.0, 45.0):
                ui.event("MOUSEMOVE", "NOTHING", (start[0] + far * x, start[1] + far * y), ticks=0, **held)
        ui.event(kind, "RELEASE", ticks=0, **held)
    for name in held:
        ui.event(f"LEFT_{name.upper()}", "RELEASE", ticks=0)
    ui.wait(2)
    moved = seen(ui) != before
    view.view_rotation, view.view_location, view.view_distance, view.view_perspective = place
    view.update()
    return moved


def moved_by_other_tools(desk: Desk, tried: list[Gesture]) -> list[object]:
    """Return the gestures that move the view without the tool: some need what is not there."""
    choose(desk.ui, "builtin.select_box")
    return [gesture for gesture in tried if do(desk, *gesture)]


@pytest.mark.parametrize(("keymap", "buttons"), HANDS, indirect=["keymap"])
def test_every_gesture_of_a_keymap_moves_the_view_before_the_first_click(
    keymap: str, desk: Desk, buttons: bool
) -> None:
    desk.ui.wait(4)
    desk.choose()
    still = []
    for gesture in gestures(buttons):
        kind, _, _, held = gesture
        if kind == "F1" and not held:
            continue  # the tool shows its keys, in a panel that would stay open and take all other keys
        if not do(desk, *gesture):
            still.append(gesture)
        assert not desk.running, gesture
    assert seams(desk.obj) == []
    assert moved_by_other_tools(desk, still) == []


@pytest.mark.parametrize(("keymap", "buttons"), HANDS, indirect=["keymap"])
def test_every_gesture_of_a_keymap_moves_the_view_within_a_chain(keymap: str, desk: Desk, buttons: bool) -> None:
    desk.ui.wait(4)
    desk.choose()
    begin(desk)
    # A chain's keys come before those of the keymap, not so its buttons.
    ours = {(key.type, key.modifiers) for _, key in KEYS if not key.type.endswith("MOUSE")}
    still = []
    for gesture in gestures(buttons):
        kind, _, _, held = gesture
        if (kind, Key(kind, **dict.fromkeys(held, 1)).modifiers) in ours:
            continue
        if not do(desk, *gesture):
            still.append(gesture)
        assert desk.running, gesture
        assert desk.session.wires == (), gesture
    finish(desk)
    assert moved_by_other_tools(desk, still) == []


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
