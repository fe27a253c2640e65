# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's timers: the add-on has one at a time for each purpose, and none once it is disabled."""

from collections.abc import Callable

import bpy
import pytest
import traces
from desk import Desk, choose, draw
from scene import ADDON, chain, seams
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited
from seamwire.view.viewport import place_in

Taker = Callable[[], int]


@pytest.fixture
def take_timers(monkeypatch: pytest.MonkeyPatch) -> Taker:
    """Return what counts the timers that the add-on has registered during the test, and removes them."""
    register, known = bpy.app.timers.register, []

    def noting(function: Callable[[], float | None], **options: object) -> None:
        known.append(function)
        register(function, **options)

    def take() -> int:
        found = 0
        for function in known:
            if not function.__module__.startswith(ADDON):
                continue
            while bpy.app.timers.is_registered(function):
                bpy.app.timers.unregister(function)
                found += 1
        return found

    monkeypatch.setattr(bpy.app.timers, "register", noting)
    return take


def hover(desk: Desk, times: int) -> None:
    """Tell of the mouse many times, without waiting for Blender."""
    x, y = (round(value) for value in desk.at(40))
    for i in range(times):
        edited.hover(place_in(desk.ui.area, desk.ui.region, (x + i % 9, y)))


@pytest.mark.every_blender
def test_a_thousand_motions_of_the_mouse_leave_one_timer(desk: Desk, take_timers: Taker) -> None:
    desk.choose()
    hover(desk, 1000)
    assert take_timers() == 1
    hover(desk, 1)
    assert take_timers() == 1, "the next motion starts it again"


def test_a_chain_needs_no_timer_and_its_end_leaves_at_most_one(desk: Desk, take_timers: Taker) -> None:
    session, ui = desk.choose(), desk.ui
    ui.click(desk.at(36))
    for vertex in (37, 38, 39, 40) * 3:
        ui.move(desk.at(vertex))
    settings().xray = True  # a setting is followed at once
    settings().xray = False
    ui.wait_until(lambda: not session.computing)
    ui.wait_until(lambda: not edited.timer.is_running, seconds=5.0)
    assert take_timers() == 0
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert not desk.running
    assert take_timers() <= 1
    assert seams(desk.obj) == chain(*range(36, 45))


def test_what_is_computed_after_a_chain_is_still_taken_in(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    desk.ui.wait_until(lambda: not any(view.busy for view in edited.views()))
    assert edited.front.islands.newest.count == 2


@pytest.mark.parametrize("in_chain", [pytest.param(False, marks=pytest.mark.every_blender), True])
def test_disabled_the_add_on_has_no_timer(desk: Desk, take_timers: Taker, in_chain: bool) -> None:
    desk.choose()
    if in_chain:
        desk.ui.click(desk.at(36))
        assert desk.running
    hover(desk, 100)
    choose(desk.ui, "builtin.select_box")
    traces.disable()
    try:
        assert take_timers() == 0
    finally:
        traces.enable()
