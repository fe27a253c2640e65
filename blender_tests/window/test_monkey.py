# SPDX-License-Identifier: GPL-3.0-or-later
"""Events of every kind in no order: nothing may be raised; after Esc the mesh is bit for bit what it was, and undo's history too."""

import ctypes
import random
import re

import bpy
import pytest
from desk import Desk

EVENTS = 2000
BATCH = 24
"""Events between two turns of Blender's loop: many come at once where a machine is slow."""
# Left out: what finishes; Esc and Z, which get a turn of their own, for Z opens a menu; and the motion of a 3D mouse, which Blender lets
# nobody simulate: it reads data that such an event lacks.
KEYS = [chr(letter) for letter in range(ord("A"), ord("Z"))]
KEYS += ["ONE", "TWO", "THREE", "F2", "F3", "F9", "TAB", "DEL", "BACK_SPACE", "PERIOD", "COMMA", "SLASH", "HOME"]
KEYS += ["LEFT_ALT", "LEFT_CTRL", "LEFT_SHIFT", "NUMPAD_1", "NUMPAD_3", "NUMPAD_7", "NUMPAD_5", "NUMPAD_9"]
KEYS += ["NDOF_BUTTON_FIT", "NDOF_BUTTON_TOP", "NDOF_BUTTON_ROLL_CW"]
BUTTONS = ["LEFTMOUSE"] * 8 + ["RIGHTMOUSE"] * 2 + ["MIDDLEMOUSE"]
WHEELS = ["WHEELUPMOUSE", "WHEELDOWNMOUSE"]
GESTURES = ["TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM"]
BLENDERS_STEPS = {"Frame Change", "Local View"}
"""Steps of undo that Blender makes of events that are left to it: Alt and the wheel beside the mesh, and a trackpad's double tap."""


def undo_steps(capfd: pytest.CaptureFixture[str]) -> set[str]:
    """Return the names of the steps in Blender's history, which it tells nobody but the terminal."""
    capfd.readouterr()
    bpy.context.window_manager.print_undo_steps()
    ctypes.CDLL(None).fflush(None)
    names = set(re.findall(r"name='([^']*)'", capfd.readouterr().out))
    assert names, "there is a history"
    return names


class Monkey:
    """Sends events without waiting for what they do."""

    def __init__(self, desk: Desk, seed: int) -> None:
        self.desk = desk
        self.ui = desk.ui
        self.dice = random.Random(seed)
        self.at = (0, 0)
        self.sent = 0
        self.held: list[str] = []

    def send(self, kind: str, value: str, **modifiers: bool) -> None:
        x, y = self.ui.region.x + self.at[0], self.ui.region.y + self.at[1]
        self.ui.window.event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
        self.sent += 1

    def modifiers(self) -> dict[str, bool]:
        return {name: self.dice.random() < 0.12 for name in ("shift", "ctrl", "alt")}

    def bars(self) -> tuple[int, int]:
        """Return how wide the bars at the sides are."""
        widths = {region.type: region.width for region in self.ui.area.regions}
        return widths["TOOLS"], widths["UI"]

    def move(self) -> None:
        width, height = self.ui.region.width, self.ui.region.height
        if self.dice.random() < 0.3:  # a little, as in a slow drag
            x, y = self.at[0] + self.dice.randint(-9, 9), self.at[1] + self.dice.randint(-9, 9)
        elif self.dice.random() < 0.85 and (at := self.desk.seen(self.dice.randrange(81))) is not None:
            x, y = (round(value) for value in at)
        else:
            x, y = self.dice.randrange(width), self.dice.randrange(height)
        # Not over bars and the navigation gizmo, whose buttons are Blender's; T and N show and hide the bars at the sides.
        left, right = self.bars()
        self.at = (min(max(x, left + 8), width - right - 110), min(max(y, 8), height - 80))
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
        elif kind < 0.87:
            self.send(self.dice.choice(GESTURES), "NOTHING", **self.modifiers())
        elif kind < 0.9:
            self.send("Z", "PRESS", ctrl=True, shift=self.dice.random() < 0.4)
            self.send("Z", "RELEASE")
        else:
            key = self.dice.choice(KEYS)
            self.send(key, "PRESS", **self.modifiers())
            self.send(key, "RELEASE")
            if key in "NT":
                self.ui.wait(2)
                self.move()

    def shade(self) -> None:
        """Open the menu of the view's shading; Esc closes it, and where it did not open, Esc is the drawing's."""
        self.release()
        self.send("Z", "PRESS")
        self.send("Z", "RELEASE")
        self.ui.wait(2)
        self.escape()

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
def test_whatever_is_pressed_nothing_is_raised_and_nothing_changed(
    cone: Desk, seed: int, capfd: pytest.CaptureFixture[str]
) -> None:
    monkey = Monkey(cone, seed)
    bpy.ops.ed.undo_push(message="Before")
    steps = undo_steps(capfd)
    cone.start()
    most = 0
    while monkey.sent < EVENTS:
        for _ in range(monkey.dice.randint(1, BATCH)):
            monkey.act()
        cone.ui.wait(1)
        assert cone.running, "nothing but Esc and Enter ends it"
        most = max(most, len(cone.session.wires))
        if monkey.dice.random() < 0.04:
            monkey.dice.choice((monkey.escape, monkey.shade))()
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
    assert undo_steps(capfd) - steps <= BLENDERS_STEPS
