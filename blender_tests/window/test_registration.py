# SPDX-License-Identifier: GPL-3.0-or-later
"""Disabling the add-on while it draws, and its keys among the user's keymaps. Blender has no keymaps without a window."""

import threading
from pathlib import Path

import bpy
import pytest
import seamwire
import traces
import ui as driver
from desk import Desk, draw, undo_steps
from scene import chain, seams
from seamwire.mesh.seam_search import Suggestion
from seamwire.operators import steps
from seamwire.tool import keymaps
from seamwire.view.edited_objects import edited
from seamwire.words.keys import Action, Bindings


@pytest.mark.smoke
@pytest.mark.every_blender
def test_disabled_while_drawing_it_keeps_the_wires_and_leaves_nothing_else_behind(
    desk: Desk, capfd: pytest.CaptureFixture[str]
) -> None:
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
        assert seams(desk.obj) == chain(*range(36, 45))
        assert undo_steps(capfd)[-1] == "Draw Seamwires"
    finally:
        traces.enable()
    ui.wait()  # the user's keymaps follow at the next turn of the event loop
    assert traces.difference(before, traces.traces()) == {}


@pytest.fixture
def endless(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """Let searches show their first plan, and go on until they are cancelled. Return the plans."""
    plan, found = Suggestion.plan, []

    def plan_on(suggestion: Suggestion, energy: float, islands: int, progress: object, is_enough: object) -> None:
        plan(suggestion, energy, islands, progress, is_enough)
        found.append(suggestion.best_so_far)
        while progress(0.5):
            threading.Event().wait(0.01)
        raise ValueError("cancelled")

    monkeypatch.setattr(Suggestion, "plan", plan_on)
    return found


def search(desk: Desk, endless: list[object]) -> None:
    """Begin a search that shows a plan and does not end. A wire across the grid leaves seams to find."""
    with desk.ui.override():
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", islands=3) == {"RUNNING_MODAL"}
    desk.ui.wait_until(lambda: bool(endless) and edited.covered)


def is_shown() -> bool:
    """Whether a search takes input or draws."""
    return bool(steps.running or edited.covered)


def is_searching() -> bool:
    """Whether anything of a search is left. Its thread ends soon after all else."""
    return is_shown() or any("seamwire steps" in thread.name for thread in threading.enumerate())


@pytest.mark.smoke
@pytest.mark.every_blender
def test_disabled_while_it_searches_it_ends_and_draws_again_when_enabled(desk: Desk, endless: list[object]) -> None:
    ui = desk.ui
    desk.choose()
    before = traces.traces()
    search(desk, endless)
    traces.disable()
    try:
        assert not is_shown()
        ui.wait_until(lambda: not is_searching())
        ui.key("RET")
        ui.pixels()
        assert traces.ours(traces.traces()) == []
        assert desk.left_clean()
    finally:
        traces.enable()
    ui.wait()
    ui.key("RET")
    assert desk.unchanged(), "Enter marks nothing that nobody has seen"
    desk.choose()
    assert traces.difference(before, traces.traces()) == {}
    draw(desk, 36, 44)
    assert len(seams(desk.obj)) == 8
    search(desk, endless)
    ui.key("ESC")
    ui.wait_until(lambda: not is_searching())


@pytest.mark.parametrize("load_ui", [False, True])
def test_opening_a_file_ends_the_search(desk: Desk, endless: list[object], tmp_path: Path, load_ui: bool) -> None:
    path = str(tmp_path / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    search(desk, endless)
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=load_ui)
    driver.Ui.__init__(desk.ui)  # the file may have brought another window
    desk.ui.wait(5)
    assert not is_searching()


def test_a_search_that_was_ended_otherwise_ends_at_its_next_event(desk: Desk, endless: list[object]) -> None:
    search(desk, endless)
    steps.end_all()
    assert not is_shown()
    desk.ui.wait_until(lambda: not is_searching())
    desk.ui.key("RET")
    desk.ui.move(desk.at(40))
    assert desk.unchanged()


def test_if_a_part_cannot_be_registered_nothing_is(ui: driver.Ui, monkeypatch: pytest.MonkeyPatch) -> None:
    ui.wait()
    before = traces.traces()
    register_class, calls, failing = bpy.utils.register_class, 0, -1

    def refuse(cls: type) -> None:
        nonlocal calls
        calls += 1
        if calls == failing:
            raise RuntimeError("refused")
        register_class(cls)

    monkeypatch.setattr(bpy.utils, "register_class", refuse)
    seamwire.unregister()
    bare = traces.traces()
    try:
        assert traces.ours(bare) == []
        seamwire.register()
        seamwire.unregister()
        assert calls > 30
        for failing in range(1, calls):
            calls = 0
            with pytest.raises(RuntimeError, match="refused"):
                seamwire.register()
            assert traces.difference(bare, traces.traces()) == {}, f"class {failing}"
        failing = -1
        with monkeypatch.context() as patched:
            patched.setattr(bpy.types.TOPBAR_MT_file_export, "append", None, raising=False)
            with pytest.raises(TypeError):
                seamwire.register()
        assert traces.difference(bare, traces.traces()) == {}
    finally:
        seamwire.register()
    ui.wait()
    assert traces.difference(before, traces.traces()) == {}


@pytest.mark.smoke
def test_the_users_keys_are_the_add_ons_in_the_same_order(ui: driver.Ui) -> None:
    ui.wait()
    of_user, defaults = keymaps.of_user(bpy.context.window_manager), Bindings()
    assert of_user.groups() == defaults.groups()
    for action in Action:
        assert of_user.keys_of(action) == defaults.keys_of(action), action
        assert of_user.icon(action) == defaults.icon(action), action


def test_an_actions_number_in_a_users_keys_is_its_own(ui: driver.Ui) -> None:
    ui.wait()
    items = keymaps.items_of(keymaps.user_keymap(bpy.context.window_manager), keymaps.ACTION_OPERATOR)
    for item in items:
        action = Action[item.properties.action]
        assert item.properties["action"] == action.number, "stored as that, wherever it stands in the table"
