# SPDX-License-Identifier: GPL-3.0-or-later
"""Events of every kind in random order, with Blender's own keys between ours, playback, a second window, and the add-on disabled.

No error is raised. Only seams change, and what Blender's keys change. The network agrees with the seams.

SEAMWIRE_MONKEYS=4 lets four of them play with each keymap, 9,600 events in all; one does otherwise.
"""

from __future__ import annotations

import os
import random
from collections.abc import Iterator

import bmesh
import bpy
import pytest
import traces
from desk import Desk, choose, undo_steps
from keymaps import as_event, gestures, using
from scene import animate, seams, snapshot
from seamwire.mesh.settings import preferences
from seamwire.tool.running import chains as running
from seamwire.tool.running import steps as searches
from seamwire.view.edited_objects import edited

EVENTS = 800
SEEDS = range(1, 1 + int(os.environ.get("SEAMWIRE_MONKEYS", "1")))
BATCH = 16
"""Events between two turns of Blender's loop: many come at once where a machine is slow."""
OURS = ["W", "C", "F", "S", "E", "V", "M", "X", "BACK_SPACE", "RET", "ESC", "F1", "LEFT_ALT", "LEFT_SHIFT"]
WHILE_HELD = ["BACK_SPACE", "RET", "X", "ESC", "C", "F", "S", "E", "W", "Z", "RIGHTMOUSE", "G", "TAB"]
OURS_ALONE = {"F", "S", "E", "V", "M", "C", "F1", "W"}
BLENDERS = [
    "A",
    "H",
    "TAB",
    "ONE",
    "TWO",
    "THREE",
    "NUMPAD_1",
    "NUMPAD_3",
    "NUMPAD_7",
    "NUMPAD_5",
    "PERIOD",
    "NUMPAD_PERIOD",
    "HOME",
    "L",
    "F9",
]
SOMETIMES = {"A": ({}, {"alt": True}), "H": ({}, {"alt": True}, {"shift": True})}
"""Modifiers that are held with keys of Blender's."""
HARMLESS = (
    *(f"view3d.{name}" for name in ("view_", "rotate", "move", "zoom", "dolly", "smoothview", "toggle_", "select")),
    *(f"mesh.{name}" for name in ("select_", "loop_select", "edgering_select", "hide", "reveal", "seamwire_")),
    *(f"object.{name}" for name in ("mode_set", "editmode_toggle", "select_")),
    *(f"screen.{name}" for name in ("redo_last", "frame_", "region_")),
    "ed.undo",
    "ed.redo",
    "wm.context_",
)
"""What Blender's operators that change nothing but the view, the mode and what is selected and hidden begin with."""
BUTTONS = ["LEFTMOUSE"] * 8 + ["RIGHTMOUSE"] * 2 + ["MIDDLEMOUSE"]
WHEELS = ["WHEELUPMOUSE", "WHEELDOWNMOUSE"]
GESTURES = ["TRACKPADPAN", "MOUSEROTATE"]


class Monkey:
    """Sends events without waiting for what they do."""

    def __init__(self, desk: Desk, seed: int) -> None:
        self.desk = desk
        self.ui = desk.ui
        self.name = desk.obj.name
        self.dice = random.Random(seed)
        self.at = (0, 0)
        self.sent = 0
        self.held: list[str] = []
        self.log: list[tuple[object, ...]] = []

    @property
    def obj(self) -> bpy.types.Object:
        return bpy.data.objects[self.name]

    def send(self, kind: str, value: str, **modifiers: bool) -> None:
        x, y = self.ui.region.x + self.at[0], self.ui.region.y + self.at[1]
        self.ui.window.event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
        self.sent += 1
        self.log.append((kind, value, self.at, *(name for name, held in modifiers.items() if held)))

    def modifiers(self, often: float = 0.12) -> dict[str, bool]:
        return {name: self.dice.random() < often for name in ("shift", "ctrl", "alt")}

    def bars(self) -> tuple[int, int]:
        """Return how wide the bars at the sides are."""
        widths = {region.type: region.width for region in self.ui.area.regions}
        return widths["TOOLS"], widths["UI"]

    def move(self) -> None:
        width, height = self.ui.region.width, self.ui.region.height
        if self.dice.random() < 0.3:  # a little, as in a slow drag
            x, y = self.at[0] + self.dice.randint(-9, 9), self.at[1] + self.dice.randint(-9, 9)
        elif self.dice.random() < 0.85 and (at := self.seen(self.dice.randrange(81))) is not None:
            x, y = (round(value) for value in at)
        else:
            x, y = self.dice.randrange(width), self.dice.randrange(height)
        # Not over bars and the navigation gizmo, whose buttons are Blender's.
        left, right = self.bars()
        self.at = (min(max(x, left + 8), width - right - 110), min(max(y, 8), height - 80))
        self.send("MOUSEMOVE", "NOTHING", **self.modifiers(0.05))

    def seen(self, vertex: int) -> tuple[float, float] | None:
        if self.obj.mode != "EDIT":
            return None
        return self.desk.seen(vertex)

    def act(self) -> None:
        kind = self.dice.random()
        if kind < 0.42:
            self.move()
        elif kind < 0.72:
            button = self.dice.choice(BUTTONS)
            if button in self.held:
                self.held.remove(button)
                self.send(button, "RELEASE", **self.modifiers())
            else:
                self.held.append(button)
                # Ctrl and the right button extrude, in Blender; Alt and others with the left one select and move.
                held = {} if button == "RIGHTMOUSE" else self.modifiers()
                if held.get("alt") and (held["ctrl"] or held["shift"]):
                    held = {}
                self.send(button, "PRESS", **held)
        elif kind < 0.8:
            self.send(self.dice.choice(WHEELS), "PRESS", **self.modifiers())
        elif kind < 0.82:
            self.send(self.dice.choice(GESTURES), "NOTHING")
        elif kind < 0.88:
            self.send("Z", "PRESS", ctrl=True, shift=self.dice.random() < 0.4)
            self.send("Z", "RELEASE")
        elif kind < 0.95:
            key = self.dice.choice(OURS)
            # With others held they begin operators of Blender's that change the mesh, or wait for the mouse.
            held = {"alt": key == "W" and self.dice.random() < 0.3}
            if key in OURS_ALONE:
                # Without a chain these are Blender's, and change the mesh: whether there is one must be known.
                self.ui.wait(4)
                live = running and running[0].session
                if not live or live.seed is None or live.waiting or self.held:
                    return
            self.send(key, "PRESS", **held)
            self.send(key, "RELEASE")
            if key in OURS_ALONE:
                self.ui.wait(1)
        elif kind < 0.96:
            self.move_view()
        elif kind < 0.98:
            self.hold_and_press()
        elif kind < 0.99:
            self.dice.choice((self.play, self.disable, self.work_in_second_window, self.suggest))()
        else:
            key = self.dice.choice(BLENDERS)
            self.release()
            self.send(key, "PRESS", **self.dice.choice(SOMETIMES.get(key, ({},))))
            self.send(key, "RELEASE")
            self.ui.wait(2)

    def move_view(self) -> None:
        """Do one of the keymap's gestures, its modifiers pressed first."""
        self.release()
        kind, _, _, held = self.dice.choice(gestures(buttons=self.dice.random() < 0.7))
        for name in held:
            self.send(f"LEFT_{name.upper()}", "PRESS", **held)
        self.send(as_event(kind), "NOTHING" if kind == "TRACKPADPAN" else "PRESS", **held)
        if not kind.startswith(("WHEEL", "TRACKPAD")):
            for _ in range(3 if kind.endswith("MOUSE") else 0):
                self.at = (self.at[0] + self.dice.randint(-9, 9), self.at[1] + self.dice.randint(-9, 9))
                self.send("MOUSEMOVE", "NOTHING", **held)
            self.send(kind, "RELEASE", **held)
        for name in held:
            self.send(f"LEFT_{name.upper()}", "RELEASE")
        self.ui.wait(1)

    def hold_and_press(self) -> None:
        """Drag over the mesh, and press a key before the button is released."""
        self.release()
        self.move()
        self.send("LEFTMOUSE", "PRESS", **self.dice.choice(({}, {}, {"shift": True}, {"shift": True, "ctrl": True})))
        self.held.append("LEFTMOUSE")
        for _ in range(self.dice.randint(1, 4)):
            self.move()
        self.ui.wait(4)
        if running and running[0].hold is not None:
            key = self.dice.choice(WHILE_HELD)
            self.send(key, "PRESS", ctrl=key == "Z")
            self.send(key, "RELEASE")
            for _ in range(self.dice.randint(0, 3)):
                self.move()
        if self.dice.random() < 0.8:
            self.release()

    def play(self) -> None:
        """Play the animation, or stop it."""
        self.log.append(("play",))
        with self.ui.override():
            bpy.ops.screen.animation_play()
        self.ui.wait(2)

    def disable(self) -> None:
        """Disable the add-on whatever runs, work without it, and enable it again."""
        self.log.append(("disable",))
        traces.disable()
        assert not running
        assert not searches
        for _ in range(self.dice.randint(0, 4)):
            self.move()
        self.release()
        self.ui.wait(2)
        traces.enable()
        preferences().text = "INFORMATION"
        choose(self.ui)

    def suggest(self) -> None:
        """Search for seams beside the interface."""
        self.release()
        self.log.append(("suggest",))
        with self.ui.override():
            if bpy.ops.mesh.seamwire_suggest.poll():
                bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", along="EDGES", unwrap=False)
        self.ui.wait(self.dice.randint(0, 8))

    def work_in_second_window(self) -> None:
        """Open another window, draw and undo in both, and close it."""
        self.release()
        self.log.append(("second window",))
        with self.ui.override():
            bpy.ops.wm.window_new()
        other = next(window for window in bpy.context.window_manager.windows if window != self.ui.window)
        self.ui.wait(4)
        area = next((area for area in other.screen.areas if area.type == "VIEW_3D"), None)
        for _ in range(self.dice.randint(2, 12) if area is not None else 0):
            if self.dice.random() < 0.4:
                self.act_a_little()
                continue
            x = area.x + area.width // 2 + self.dice.randint(-60, 60)
            y = area.y + area.height // 2 + self.dice.randint(-60, 60)
            key, held = self.dice.choice((("LEFTMOUSE", {}), ("LEFTMOUSE", {}), ("Z", {"ctrl": True}), ("RET", {})))
            other.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
            for value in ("PRESS", "RELEASE"):
                other.event_simulate(type=key, value=value, x=x, y=y, **held)
            self.log.append(("second window", key))
            self.ui.wait(self.dice.randint(0, 2))
        with bpy.context.temp_override(window=other):
            bpy.ops.wm.window_close()
        self.ui.wait(4)

    def act_a_little(self) -> None:
        """Click in the first window, or begin a search there."""
        if self.dice.random() < 0.1:
            self.suggest()
        self.move()
        self.send("LEFTMOUSE", "PRESS")
        self.send("LEFTMOUSE", "RELEASE")

    def release(self) -> None:
        for button in self.held:
            self.send(button, "RELEASE")
        self.held.clear()
        self.ui.wait(1)

    def rest(self) -> None:
        """Let go of everything, end what is drawn, and come back to edit mode with the tool and all shown."""
        self.release()
        for _ in range(3):
            self.send("ESC", "PRESS")
            self.send("ESC", "RELEASE")
            self.ui.wait(2)
        self.ui.wait_until(lambda: not running and not searches)
        if self.ui.window.screen.is_animation_playing:
            self.play()
        if self.obj.mode != "EDIT":
            with self.ui.override():
                bpy.context.view_layer.objects.active = self.obj
                bpy.ops.object.mode_set(mode="EDIT")
        with self.ui.override():
            bpy.ops.mesh.reveal(select=False)
        choose(self.ui)
        self.ui.wait(2)
        self.check()
        self.ui.look_from_top(distance=4.0)

    def check(self) -> None:
        """The mesh's seams are what the wires mark; the wires run along its edges; no layer but ours was touched."""
        view = edited.of(self.obj)
        session = view.session
        here = f"after {self.sent} events: {self.log[-40:]}"
        marked = {edge for wire in session.wires for edge in wire.claims()}
        plain = {tuple(sorted(pair)) for pair in view.mesh.plain_seams.tolist()}
        assert set(seams(self.obj)) == marked | plain, here
        assert session.seed is None, here
        bm = bmesh.from_edit_mesh(self.obj.data)
        bm.verts.ensure_lookup_table()
        for wire in session.wires:
            assert all(bm.edges.get((bm.verts[a], bm.verts[b])) is not None for a, b in wire.edges()), here


@pytest.fixture
def keymap(request: pytest.FixtureRequest, cone: Desk) -> Iterator[str]:
    """One of Blender's preset keymaps without what changes the mesh: where there is no wire, X and the right button are Blender's."""
    with using(request.param):
        cone.ui.wait(4)
        keymaps = bpy.context.window_manager.keyconfigs.user.keymaps
        names = ("Mesh", "3D View Generic", "3D View", "Object Mode", "Object Non-modal", "Frames", "Screen", "Window")
        for name in names:
            for item in keymaps[name].keymap_items:
                item.active = item.active and item.idname.startswith(HARMLESS)
        cone.ui.wait(4)
        yield request.param
        for name in names:
            keymaps[name].restore_to_default()


@pytest.mark.parametrize("keymap", ["Blender", "Industry Compatible", "Blender 2.7x"], indirect=True)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.oldest_and_newest
def test_whatever_is_pressed_seams_and_network_agree_and_nothing_else_changes(
    cone: Desk, seed: int, keymap: str, capfd: pytest.CaptureFixture[str]
) -> None:
    monkey = Monkey(cone, seed)
    with cone.ui.override():
        animate(cone.obj)
    for _ in range(bpy.context.preferences.edit.undo_steps + 1):  # undo never leads to where there was no mesh
        bpy.ops.ed.undo_push(message="Before")
    start = undo_steps(capfd)[-1]
    assert start == "Before"
    before = unselected(cone.obj)
    choose(cone.ui)
    most = 0
    while monkey.sent < EVENTS:
        for _ in range(monkey.dice.randint(1, BATCH)):
            monkey.act()
        cone.ui.wait(1)
        if edited.views():
            most = max(most, len(edited.views()[0].session.wires))
        if monkey.dice.random() < 0.12:
            monkey.rest()
    monkey.rest()
    assert most > 0, "it drew; with Clear Seams on, it may have drawn little"
    after = unselected(monkey.obj)
    different = [(key, one, two) for key in before for one, two in parts(before[key], after.get(key)) if one != two]
    assert not different, f"{different[:4]} {monkey.log[-60:]}"
    assert after.keys() == before.keys()


def unselected(obj: bpy.types.Object) -> dict[str, object]:
    """Return all that a mesh holds but what is selected, which Blender's own keys change, and seams."""
    with bpy.context.temp_override():
        bpy.ops.mesh.select_all(action="DESELECT")
    found = snapshot(obj, with_seams=False)
    # M within a chain sets the mesh's mirror.
    return {key: value for key, value in found.items() if key not in {"history", "mode", "mirror", "active face"}}


def parts(one: object, two: object) -> list[tuple[object, object]]:
    """Return two things in pairs of their items, where they have as many."""
    if isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        return list(zip(one, two, strict=True))
    return [(one, two)]
