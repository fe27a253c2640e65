# SPDX-License-Identifier: GPL-3.0-or-later
"""Events of every kind in no order: nothing may be raised, and after Esc the mesh is bit for bit what it was."""

import random

import pytest
from desk import Desk

EVENTS = 2000
BATCH = 24
"""Events between two turns of Blender's loop: many come at once where a machine is slow."""
# Left out: what finishes, what opens a menu of Blender's own over the view (its buttons would be pressed next), and Esc, which gets a turn
# of its own.
KEYS = [chr(letter) for letter in range(ord("A"), ord("Z") + 1) if chr(letter) not in "NTZ"]
KEYS += ["ONE", "TWO", "THREE", "F2", "F3", "F9", "TAB", "DEL", "BACK_SPACE", "PERIOD", "COMMA", "SLASH", "HOME"]
KEYS += ["LEFT_ALT", "LEFT_CTRL", "LEFT_SHIFT", "NUMPAD_1", "NUMPAD_3", "NUMPAD_7", "NUMPAD_5", "NUMPAD_9"]
BUTTONS = ["LEFTMOUSE"] * 8 + ["RIGHTMOUSE"] * 2 + ["MIDDLEMOUSE"]
WHEELS = ["WHEELUPMOUSE", "WHEELDOWNMOUSE"]


class Monkey:
    """Sends events without waiting for what they do."""

    def __init__(self, desk: Desk, seed: int) -> None:
        self.desk = desk
        self.ui = desk.ui
        self.dice = random.Random(seed)
        self.at = (0, 0)
        self.sent = 0
        self.held: list[str] = []
        tools = next(region for region in self.ui.area.regions if region.type == "TOOLS")
        self.left = tools.width + 8

    def send(self, kind: str, value: str, **modifiers: bool) -> None:
        x, y = self.ui.region.x + self.at[0], self.ui.region.y + self.at[1]
        self.ui.window.event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
        self.sent += 1

    def modifiers(self) -> dict[str, bool]:
        return {name: self.dice.random() < 0.12 for name in ("shift", "ctrl", "alt")}

    def move(self) -> None:
        width, height = self.ui.region.width, self.ui.region.height
        if self.dice.random() < 0.3:  # a little, as in a slow drag
            x, y = self.at[0] + self.dice.randint(-9, 9), self.at[1] + self.dice.randint(-9, 9)
        elif self.dice.random() < 0.85 and (at := self.desk.seen(self.dice.randrange(81))) is not None:
            x, y = (round(value) for value in at)
        else:
            x, y = self.dice.randrange(width), self.dice.randrange(height)
        # Not over bars and the navigation gizmo, whose buttons are Blender's.
        self.at = (min(max(x, self.left), width - 110), min(max(y, 8), height - 80))
        self.send("MOUSEMOVE", "NOTHING", **self.modifiers())

    def act(self) -> None:
        kind = self.dice.random()
        if kind < 0.45:
            self.move()
        elif kind < 0.75:
            button = self.dice.choice(BUTTONS)
            if button in self.held:
                self.held.remove(button)
                self.send(button, "RELEASE", **self.modifiers())
            else:
                self.held.append(button)
                self.send(button, "PRESS", **self.modifiers())
        elif kind < 0.85:
            self.send(self.dice.choice(WHEELS), "PRESS", **self.modifiers())
        elif kind < 0.9:
            self.send("Z", "PRESS", ctrl=True, shift=self.dice.random() < 0.4)
            self.send("Z", "RELEASE")
        else:
            key = self.dice.choice(KEYS)
            self.send(key, "PRESS", **self.modifiers())
            self.send(key, "RELEASE")

    def release(self) -> None:
        for button in self.held:
            self.send(button, "RELEASE")
        self.held.clear()
        self.ui.wait(1)

    def escape(self) -> None:
        self.release()
        self.send("ESC", "PRESS")
        self.send("ESC", "RELEASE")
        self.ui.wait(1)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_whatever_is_pressed_nothing_is_raised_and_nothing_changed(cone: Desk, seed: int) -> None:
    monkey = Monkey(cone, seed)
    cone.start()
    most = 0
    while monkey.sent < EVENTS:
        for _ in range(monkey.dice.randint(1, BATCH)):
            monkey.act()
        cone.ui.wait(1)
        assert cone.running, "nothing but Esc and Enter ends it"
        most = max(most, len(cone.session.wires))
        if monkey.dice.random() < 0.04:
            monkey.escape()
            if not cone.running:
                assert cone.unchanged()
                cone.start()
        if monkey.dice.random() < 0.03:
            cone.ui.look_from_top(distance=4.0)
    assert most > 3, "it drew"
    for _ in range(5):
        if cone.running:
            monkey.escape()
    assert cone.left_clean()
    assert cone.unchanged()
    assert list(cone.obj.data.keys()) == []
