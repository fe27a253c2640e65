# SPDX-License-Identifier: GPL-3.0-or-later
"""Every allowed change of a chain's state happens in Blender's window, and no other change is possible."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import bpy
import pytest
import ui as driver
from desk import Desk, dismiss, draw
from scene import chain, edit, seams
from seamwire.mesh.object_session import ObjectSession
from seamwire.tool import events
from seamwire.tool.chain import STAGES, Chain
from seamwire.view.edited_objects import edited
from slow import Slow

EMPTY = 58
"""A vertex where nothing is drawn."""


class Walk:
    """A chain with all changes of its state. Wires are computed as `slow` says."""

    def __init__(self, desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
        self.desk, self.ui = desk, desk.ui
        self.monkeypatch = monkeypatch
        self.walked: list[tuple[str, str]] = []
        go, self.slow = Chain.go, Slow(monkeypatch)

        def noted(chain: Chain, stage: str, *held: object, **named: object) -> None:
            self.walked.append((chain.stage, stage))
            go(chain, stage, *held, **named)
            assert chain.stage == stage
            self.chain = chain

        monkeypatch.setattr(Chain, "go", noted)

    # Ways to a state

    def reach(self, stage: str) -> None:
        """Bring a chain to a state."""
        {
            "READY": self.desk.start,
            "PEEKING": self.peek,
            "DRAWING": self.draw,
            "HOLDING": self.hold,
            "ENDING": self.wait_to_end,
            "OVER": self.draw,
        }[stage]()
        if stage != "OVER":  # the same event keeps a chain that is over, so it is reached by the walk itself
            assert self.stage == stage

    @property
    def stage(self) -> str:
        return self.desk.chain.stage if self.desk.running else "CLOSED"

    def draw(self) -> None:
        self.desk.start()
        self.ui.click(self.desk.at(36))
        self.ui.click(self.desk.at(40))
        self.ui.wait_until(lambda: len(self.desk.session.wires) == 1 and not self.desk.session.computing)

    def peek(self) -> None:
        self.desk.choose()
        self.ui.move(self.desk.at(EMPTY, EMPTY + 1))
        self.ui.event("LEFT_ALT", "PRESS", alt=True)

    def hold(self) -> None:
        self.draw()
        self.press()

    def press(self) -> None:
        self.ui.move(self.desk.at(EMPTY))
        self.ui.event("LEFTMOUSE", "PRESS")

    def press_anew(self) -> None:
        self.ui.move(self.desk.at(EMPTY))
        self.ui.event("LEFTMOUSE", "PRESS", ctrl=True)

    def stroke(self) -> None:
        self.ui.move(self.desk.at(EMPTY), shift=True)
        self.ui.event("LEFTMOUSE", "PRESS", shift=True)

    def wait_to_end(self) -> None:
        self.draw()
        self.ui.move(self.desk.at(44))
        self.slow.is_slow = True
        self.ui.click(self.desk.at(44))
        self.ui.key("RET")

    # Events

    def click(self) -> None:
        self.ui.click(self.desk.at(EMPTY))

    def loop(self) -> None:
        """Begin another chain with a loop, after which nothing is live."""
        self.ui.key("RET")
        self.desk.start()
        self.ui.click(self.desk.at(EMPTY, EMPTY + 1), alt=True)

    def release_key(self) -> None:
        self.ui.event("LEFT_ALT", "RELEASE")

    def lose_focus(self) -> None:
        self.ui.event("WINDOW_DEACTIVATE", "NOTHING")

    def release(self) -> None:
        self.ui.event("LEFTMOUSE", "RELEASE")

    def compute(self) -> None:
        self.slow.is_slow = False

    def undo_all(self) -> None:
        for _ in range(2):  # the wire and the seed
            self.ui.key("BACK_SPACE")

    def leave_mode(self) -> None:
        with self.ui.override():
            bpy.ops.object.mode_set(mode="OBJECT")
        self.slow.is_slow = False
        self.ui.move(self.desk.ui.on_screen((0.3, 0.4, 0.0)))

    def fail(self) -> None:
        """Let the next event end on an error."""
        self.slow.is_slow = False
        with self.monkeypatch.context() as broken:
            broken.setattr(events, "read", partial(_raise, RuntimeError("broken")))
            self.ui.move(self.desk.at(20))
        dismiss(self.ui)

    def fail_to_write(self) -> None:
        """Let writing the chain fail, so that it is dropped."""
        with self.monkeypatch.context() as broken:
            broken.setattr(ObjectSession, "plan", partial(_raise, ValueError("broken")))
            self.ui.key("RET")

    def fail_to_write_otherwise(self) -> None:
        """Let writing the chain end on an error that nobody expects."""
        with self.monkeypatch.context() as broken:
            broken.setattr(ObjectSession, "plan", partial(_raise, RuntimeError("broken")))
            self.ui.key("RET")
        dismiss(self.ui)

    def drop(self) -> None:
        self.desk.chain.drop()

    def key(self, name: str) -> None:
        self.ui.key(name)

    def click_right(self) -> None:
        self.ui.event("RIGHTMOUSE", "PRESS")
        self.ui.event("RIGHTMOUSE", "RELEASE")


def _raise(error: Exception, *_: object, **__: object) -> None:
    raise error


Do = Callable[[Walk], None]


def key(name: str) -> Do:
    return partial(Walk.key, name=name)


WALKS: list[tuple[str, str, Do]] = [
    ("READY", "DRAWING", Walk.click),
    ("READY", "DRAWING", key("RET")),
    ("READY", "DRAWING", key("BACK_SPACE")),
    ("READY", "PEEKING", lambda walk: (walk.ui.key("ESC"), walk.peek())),
    ("PEEKING", "DRAWING", Walk.release_key),
    ("PEEKING", "DRAWING", Walk.lose_focus),
    ("PEEKING", "DRAWING", key("ESC")),
    ("DRAWING", "HOLDING", Walk.press),
    ("DRAWING", "ENDING", Walk.wait_to_end),
    ("DRAWING", "OVER", key("RET")),
    ("DRAWING", "OVER", key("ESC")),
    ("DRAWING", "OVER", Walk.click_right),
    ("DRAWING", "OVER", Walk.loop),
    ("DRAWING", "OVER", Walk.undo_all),
    ("HOLDING", "DRAWING", Walk.release),
    ("HOLDING", "DRAWING", key("ESC")),
    ("HOLDING", "DRAWING", key("BACK_SPACE")),
    ("HOLDING", "DRAWING", Walk.click_right),
    ("ENDING", "DRAWING", Walk.press),
    ("ENDING", "DRAWING", Walk.press_anew),
    ("ENDING", "DRAWING", Walk.stroke),
    ("ENDING", "OVER", Walk.compute),
    ("ENDING", "OVER", key("ESC")),
    *((stage, "CLOSED", Walk.leave_mode) for stage in ("READY", "PEEKING", "DRAWING", "ENDING")),
    ("OVER", "CLOSED", key("RET")),
    ("OVER", "CLOSED", Walk.fail_to_write),
    ("OVER", "CLOSED", Walk.fail_to_write_otherwise),
    *((stage, "CLOSED", Walk.fail) for stage in ("READY", "PEEKING", "DRAWING", "ENDING")),
    ("HOLDING", "DRAWING", Walk.fail),
    *((stage, "CLOSED", Walk.drop) for stage in ("READY", "PEEKING", "DRAWING", "ENDING")),
]
"""How each transition is walked: the states before and after it, and what brings it."""
DROPS = (Walk.fail_to_write, Walk.fail_to_write_otherwise, Walk.drop)
"""After these nothing is kept."""
KEPT = {
    "READY": [],
    "PEEKING": [],
    **dict.fromkeys(("DRAWING", "HOLDING", "OVER"), chain(*range(36, 41))),
    "ENDING": chain(*range(36, 45)),
}
"""The seams that a chain in each state leaves if it is kept."""


def name(walk: tuple[str, str, Do]) -> str:
    stage, after, do = walk
    return f"{stage}-{after}-{getattr(do, '__name__', 'key')}"


@pytest.fixture
def walk(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> Iterator[Walk]:
    """Return a chain that is to be walked. Errors are expected in some walks only."""
    monkeypatch.setattr(bpy.context.preferences.inputs, "mouse_double_click_time", 1)
    yield Walk(desk, monkeypatch)
    assert all("broken" in error for error in driver.take_errors())


@pytest.mark.smoke
def test_each_transition_is_walked() -> None:
    assert {(stage, after) for stage, after, _ in WALKS} == {
        (stage, each) for stage in STAGES for each in STAGES[stage]
    }


@pytest.mark.parametrize(("stage", "after", "do"), WALKS, ids=map(name, WALKS))
def test_the_transition(walk: Walk, stage: str, after: str, do: Do) -> None:
    if after != "ENDING":
        walk.reach(stage)
    do(walk)
    walk.ui.wait_until(lambda: (stage, after) in walk.walked, seconds=5.0)
    if after == "CLOSED":
        walk.ui.wait_until(lambda: not walk.desk.running)
        kept = [] if do in DROPS else KEPT[stage]
        assert seams(walk.desk.obj) == kept
        assert walk.chain.stage == "CLOSED"
    walk.slow.is_slow = False
    if walk.desk.running:
        walk.ui.event("LEFTMOUSE", "RELEASE")
        walk.ui.event("LEFT_ALT", "RELEASE")
    if walk.desk.running:
        walk.ui.key("RET")
    walk.ui.wait_until(lambda: not walk.desk.running)
    assert walk.chain.stage == "CLOSED"
    assert walk.desk.left_clean()
    assert not edited.chain


def test_no_other_transition_is_possible() -> None:
    chain = object.__new__(Chain)
    for stage in STAGES:
        for after in set(STAGES) - set(STAGES[stage]):
            chain.stage = stage
            with pytest.raises(AssertionError, match=f"{stage}, {after}"):
                chain.go(after)
            assert chain.stage == stage


def test_a_chain_closes_though_its_workspace_is_gone(desk: Desk) -> None:
    ui, home = desk.ui, desk.ui.window.workspace
    with ui.override():
        bpy.ops.workspace.duplicate()
    ui.wait(4)
    driver.Ui.__init__(ui)  # the copy has other areas
    ui.look_from_top(distance=4.0)
    try:
        session = desk.start()
        ui.click(desk.at(36))
        ui.click(desk.at(40))
        ui.wait_until(lambda: len(session.wires) == 1)
        with ui.override():
            bpy.ops.workspace.delete()
        ui.wait(4)
    finally:
        ui.window.workspace = home
        ui.wait(4)
        driver.Ui.__init__(ui)
    ui.move((300.0, 300.0))
    assert desk.left_clean()
    assert not edited.chain
    assert seams(desk.obj) == chain(*range(36, 41))


def test_opening_a_file_ends_the_chain_and_skips_no_handler(desk: Desk, tmp_path: Path) -> None:
    path, told = str(tmp_path / "a.blend"), []
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    desk.choose()
    desk.ui.click(desk.at(36))
    assert desk.running
    for number in range(4):
        bpy.app.handlers.load_pre.append(lambda *_, number=number: told.append(number))
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=False)
    desk.ui.wait(4)
    assert told == [0, 1, 2, 3]
    assert desk.left_clean()
    desk.ui = ui = driver.Ui()
    if desk.obj.mode != "EDIT":
        with ui.override():
            edit()
    ui.look_from_top(distance=4.0)
    desk.choose()
    draw(desk, 36, 40)
    assert seams(desk.obj) == chain(*range(36, 41)), "the handlers stay with the add-on"


@pytest.mark.smoke
@pytest.mark.parametrize("first", ["REMOVE", "NEXT", "PEEK", "BEND"])
def test_a_key_without_a_target_builds_no_chain(desk: Desk, monkeypatch: pytest.MonkeyPatch, first: str) -> None:
    desk.choose()
    desk.ui.move(desk.at(EMPTY))
    built: list[Chain] = []
    monkeypatch.setattr(Chain, "__init__", lambda own, _context: built.append(own))
    with desk.ui.override():
        assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first=first) == {"PASS_THROUGH"}
    assert built == []
