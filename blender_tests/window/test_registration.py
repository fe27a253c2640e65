# SPDX-License-Identifier: GPL-3.0-or-later
"""Disabling the add-on while it draws, and its keys among the user's keymaps. Blender has no keymaps without a window."""

import bpy
import pytest
import traces
import ui as driver
from desk import Desk
from seamwire.operators import bindings
from seamwire.words.keys import NUMBERS, Action, Bindings


@pytest.mark.smoke
@pytest.mark.every_blender
def test_disabled_while_drawing_it_ends_and_leaves_nothing_behind(desk: Desk) -> None:
    ui = desk.ui
    before = traces.traces()
    assert any("Mesh: wm.tool_set_by_id W" in one for one in before["keymap items"])
    session = desk.start()
    ui.click(desk.at(36))
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(desk.at(60))
    assert desk.running
    traces.disable()
    try:
        assert not desk.running
        ui.move(desk.at(40))
        ui.pixels()
        assert traces.ours(traces.traces()) == []
        assert desk.unchanged()
    finally:
        traces.enable()
    ui.wait()  # the user's keymaps follow at the next turn of the event loop
    assert traces.difference(before, traces.traces()) == {}


@pytest.mark.smoke
def test_the_users_keys_are_the_add_ons_in_the_same_order(ui: driver.Ui) -> None:
    ui.wait()
    of_user, defaults = bindings.of_user(bpy.context.window_manager), Bindings()
    assert of_user.rows() == defaults.rows()
    for action in Action:
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
        assert bindings.of_user(manager).keys_of(Action.END)[0].type == "P"
    finally:
        bind("P", "NUMPAD_ENTER")
    assert bindings.of_user(manager).rows() == Bindings().rows()


def test_an_actions_number_in_a_users_keys_is_its_own(ui: driver.Ui) -> None:
    ui.wait()
    items = bindings.items_of(bindings.user_keymap(bpy.context.window_manager), bindings.ACTION_OPERATOR)
    for item in items:
        action = Action[item.properties.action]
        assert item.properties["action"] == NUMBERS[action], "stored as that, wherever it stands in the table"
    assert len(set(NUMBERS.values())) == len(Action)
