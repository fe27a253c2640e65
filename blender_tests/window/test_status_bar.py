# SPDX-License-Identifier: GPL-3.0-or-later
"""The status bar shows what the tool can do before the first click, and nothing of it with other tools and operators."""

import bpy
import pytest
from desk import Desk, choose
from seamwire.mesh.registration import IS_OLD
from seamwire.tool import running
from seamwire.ui import toolbar

pytestmark = pytest.mark.every_blender


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The hints that were drawn last."""
    texts: list[str] = []
    draw = running.draw_hints

    def draw_and_note(header: bpy.types.Header, hints: list[tuple[str, str]]) -> None:
        texts[:] = [text for _, text in hints]
        draw(header, hints)

    for module in (running, toolbar):
        monkeypatch.setattr(module, "draw_hints", draw_and_note)
    return texts


def redraw(desk: Desk, shown: list[str]) -> list[str]:
    """Have Blender draw the status bar, and return its hints."""
    shown.clear()
    desk.ui.window.workspace.status_text_set_internal(None)
    desk.ui.wait(3, redraw=True)
    return shown


@pytest.mark.smoke
def test_with_the_tool_it_shows_the_gestures_and_in_a_chain_its_keys(desk: Desk, shown: list[str]) -> None:
    assert redraw(desk, shown) == [], "another tool is active"
    desk.choose()
    assert redraw(desk, shown) == [
        "Draw Line",
        "Alt: Add Loop",
        "Shift: Draw Stroke",
    ]
    desk.ui.click(desk.at(40))
    desk.ui.wait_until(lambda: desk.running)
    desk.ui.move(desk.at(44))
    desk.ui.wait_until(lambda: "Keep Wire" in shown)
    assert "Draw Line" not in shown
    desk.ui.key("ESC")
    desk.ui.wait_until(lambda: not desk.running)
    assert "Draw Line" in redraw(desk, shown)
    choose(desk.ui, "builtin.select_box")
    assert redraw(desk, shown) == []


def test_it_follows_the_keys_of_the_user(desk: Desk, shown: list[str]) -> None:
    desk.choose()
    keymap = bpy.context.window_manager.keyconfigs.user.keymaps[toolbar.KEYMAP]
    item = next(item for item in keymap.keymap_items if getattr(item.properties, "first", "") == "LOOP")
    item.active = False
    try:
        assert not any("Loop" in text for text in redraw(desk, shown))
    finally:
        item.active = True


@pytest.mark.skipif(IS_OLD, reason="Blender does not tell which operators run")
def test_while_another_operator_runs_it_shows_nothing_of_ours(desk: Desk, shown: list[str]) -> None:
    desk.choose()
    with desk.ui.override():
        bpy.ops.mesh.knife_tool("INVOKE_DEFAULT")
    try:
        assert redraw(desk, shown) == []
    finally:
        desk.ui.key("ESC")
        desk.ui.wait(2)
