# SPDX-License-Identifier: GPL-3.0-or-later
"""While a button is held, keys work on what it drags: the chain stays as it is, whatever is pressed."""

from __future__ import annotations

import bpy
import pytest
from desk import Desk, draw
from scene import chain, seams
from seamwire.core.sketch.lining import Lining
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited

KEPT = chain(0, 1, 2, 3, 4)
HELD = ("guide stroke", "avoid stroke", "line", "line that goes on", "seed", "wire")


@pytest.fixture(autouse=True)
def no_double_clicks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let two presses at a place be two clicks."""
    monkeypatch.setattr(bpy.context.preferences.inputs, "mouse_double_click_time", 1)


class Hand:
    """Draws a chain of one kept wire, and holds a button.

    Parameters
    ----------
    desk
        The mesh.
    what
        Of `HELD`.
    """

    def __init__(self, desk: Desk, what: str) -> None:
        self.desk, self.ui, self.what = desk, desk.ui, what
        if what in {"seed", "wire"}:
            desk.choose()
            draw(desk, 0, 4)
            self.session = desk.session
        else:
            self.session = desk.start()
            self.ui.click(desk.at(0))
            self.ui.click(desk.at(4))
        self.ui.wait_until(lambda: len(self.session.wires) == 1 and not self.session.computing)

    def press(self, then_released: bool = True) -> None:
        """Press the button and move. The modifiers of a stroke may be released then."""
        start = {"line that goes on": 4, "seed": 0, "wire": 2}.get(self.what, 36)
        desk, ui = self.desk, self.ui
        shift, ctrl = self.what.endswith("stroke"), self.what == "avoid stroke"
        ui.wait_until(lambda: not self.session.computing)
        ui.event("LEFTMOUSE", "PRESS", desk.at(start), shift=shift, ctrl=ctrl)
        for step in (1, 2, 3):
            ui.move((desk.at(start)[0] + 12.0 * step, desk.at(start)[1] + 12.0 * step), shift=shift, ctrl=ctrl)
        if then_released:
            ui.event("LEFT_SHIFT", "RELEASE")
        assert self.holds

    @property
    def holds(self) -> bool:
        """Whether something is dragged."""
        shown = edited.front.stroke is not None or self.session.holds(Lining) is not None or self.session.is_held
        assert shown == (self.desk.running and self.desk.chain.hold is not None)
        return shown

    def chain(self) -> tuple[object, ...]:
        """Return what no key may change."""
        names = ("along", "clear", "snap", "strength_edges", "finish")
        kept = self.session.drawn
        return (
            [wire.vertices for wire in kept.wires],
            kept.strokes,
            self.session.seed,
            self.session.waiting,
            self.session.options.mirror,
            *(getattr(settings(), name) for name in names),
            seams(self.desk.obj),
        )


@pytest.mark.smoke
@pytest.mark.every_blender
def test_backspace_drops_the_stroke_that_is_drawn_and_keeps_the_wire(desk: Desk) -> None:
    hand = Hand(desk, "guide stroke")
    hand.press()
    desk.ui.key("BACK_SPACE")
    assert edited.front.stroke is None
    desk.ui.event("LEFTMOUSE", "RELEASE")
    assert len(hand.session.wires) == 1
    assert hand.session.network.strokes == ()
    desk.ui.key("RET")
    assert seams(desk.obj) == KEPT


@pytest.mark.parametrize("what", HELD)
@pytest.mark.parametrize("is_away", [False, True])
def test_keys_while_a_button_is_held(desk: Desk, what: str, is_away: bool) -> None:
    hand, ui = Hand(desk, what), desk.ui
    for key, held in (
        ("BACK_SPACE", {}),
        ("Z", {"ctrl": True}),
        ("Z", {"ctrl": True, "shift": True}),
        ("RET", {}),
        ("X", {}),
        ("C", {}),
        ("F", {}),
        ("G", {}),
        ("W", {}),
        ("S", {}),
        ("E", {}),
        ("M", {}),
        ("V", {}),
        ("TAB", {"shift": True}),
        ("TAB", {}),
        ("RIGHTMOUSE", {}),
        ("ESC", {}),
    ):
        hand.press()
        before = hand.chain()
        if is_away:
            ui.move((-30.0, 100.0))
        ui.key(key, **held)
        assert hand.chain() == before, key
        assert hand.holds == (key not in {"BACK_SPACE", "RIGHTMOUSE", "ESC"} and (key != "Z" or "shift" in held)), key
        if hand.holds:
            ui.key("ESC")
        ui.event("LEFTMOUSE", "RELEASE", desk.at(50))
        assert hand.chain() == before, key
    if desk.running:
        ui.key("RET")
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == KEPT


@pytest.mark.every_blender
@pytest.mark.parametrize("what", HELD)
def test_what_cancels_a_drag_does_so_with_any_modifier_still_down(desk: Desk, what: str) -> None:
    hand, ui = Hand(desk, what), desk.ui
    own = {"shift": what.endswith("stroke"), "ctrl": what == "avoid stroke"}
    cancels = [("Z", {**own, "ctrl": True})]
    for names in ((), ("shift",), ("ctrl",), ("alt",), ("shift", "ctrl"), ("shift", "ctrl", "alt")):
        cancels += [(key, {**own, **dict.fromkeys(names, True)}) for key in ("BACK_SPACE", "RIGHTMOUSE", "ESC")]
    for key, held in cancels:
        hand.press(then_released=False)
        before = hand.chain()
        ui.key(key, **held)
        assert not hand.holds, (key, held)
        ui.event("LEFTMOUSE", "RELEASE", desk.at(50), **held)
        assert hand.chain() == before, (key, held)
    if desk.running:
        ui.key("RET")
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == KEPT


def test_x_ray_switches_while_the_modifiers_of_a_stroke_are_down(desk: Desk) -> None:
    hand = Hand(desk, "guide stroke")
    hand.press(then_released=False)
    desk.ui.key("V", shift=True)
    assert settings().xray
    assert hand.holds


def test_after_a_lost_release_the_next_press_begins_anew(desk: Desk) -> None:
    hand, ui = Hand(desk, "guide stroke"), desk.ui
    hand.press()
    ui.click(desk.at(40))  # another window has received the release
    ui.wait_until(lambda: len(hand.session.wires) == 2)
    assert not hand.holds
    assert hand.session.network.strokes == ()
