# SPDX-License-Identifier: GPL-3.0-or-later
"""Enabling and disabling the add-on where there are keymaps, and while it draws."""

import bpy
import traces
import ui as driver
from scene import add_grid, edit
from seamwire.operators import bindings
from seamwire.operators.report import running

TIMES = 20


def test_enabled_and_disabled_many_times_it_leaves_nothing_behind(ui: driver.Ui) -> None:
    enabled = traces.traces()
    assert any("Mesh: wm.tool_set_by_id W" in one for one in enabled["keymap items"])
    traces.disable()
    try:
        ui.wait()
        disabled = traces.traces()
        assert traces.ours(disabled) == []
        for _ in range(TIMES):
            traces.enable()
            traces.disable()
        ui.wait()
        assert traces.difference(disabled, traces.traces()) == {}
    finally:
        traces.enable()
    ui.wait()
    assert traces.difference(enabled, traces.traces()) == {}


def test_disabled_while_drawing_it_ends_and_leaves_nothing_behind(ui: driver.Ui) -> None:
    add_grid(5)
    ui.wait()
    with ui.override():
        edit()
    ui.look_from_top(distance=4.0)
    before = traces.traces()
    with ui.override():
        bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT")
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    assert running
    traces.disable()
    try:
        assert not running
        ui.move((ui.region.width * 0.4, ui.region.height * 0.5))
        ui.pixels()
    finally:
        traces.enable()
    ui.wait()  # the user's keymaps follow at the next turn of the event loop
    assert traces.difference(before, traces.traces()) == {}


def test_the_users_keys_are_the_add_ons_in_the_same_order(ui: driver.Ui) -> None:
    ui.wait()
    of_user, defaults = bindings.of_user(bpy.context.window_manager), bindings.Bindings()
    assert of_user.rows() == defaults.rows()
    for action in bindings.Action:
        assert of_user.keys_of(action) == defaults.keys_of(action), action
        assert of_user.icon(action) == defaults.icon(action), action


def test_a_changed_key_is_the_actions_first(ui: driver.Ui) -> None:
    ui.wait()
    manager = bpy.context.window_manager

    def bind(old: str, new: str) -> None:
        # Blender may make the items anew whenever one has changed: none is kept.
        items = bindings.items_of(bindings.user_keymap(manager), bindings.ACTION_OPERATOR)
        next(item for item in items if item.type == old).type = new

    try:
        bind("NUMPAD_ENTER", "P")
        assert bindings.of_user(manager).keys_of(bindings.Action.END)[0].type == "P"
    finally:
        bind("P", "NUMPAD_ENTER")
    assert bindings.of_user(manager).rows() == bindings.Bindings().rows()


def test_an_actions_number_in_a_users_keys_is_its_own(ui: driver.Ui) -> None:
    ui.wait()
    items = bindings.items_of(bindings.user_keymap(bpy.context.window_manager), bindings.ACTION_OPERATOR)
    for item in items:
        action = bindings.Action[item.properties.action]
        assert item.properties["action"] == bindings.NUMBERS[action], "stored as that, wherever it stands in the table"
    assert len(set(bindings.NUMBERS.values())) == len(bindings.Action)
