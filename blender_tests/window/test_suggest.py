# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts are suggested beside the interface: the wheel and clicks change them, Enter keeps them, Esc changes nothing."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import bpy
import keymaps
import numpy as np
import pytest
import stored
import ui as driver
from desk import choose, leave, second_window, send, undo_steps
from scene import add_suzanne, animate, changing, edit, head, mark_wires, seams, snapshot
from seamwire.core.base import native
from seamwire.core.seams.seam_plan import PartChoice
from seamwire.mesh.seam_search import Suggestion
from seamwire.mesh.settings import preferences
from seamwire.operators.steps import Stepwise
from seamwire.suggesting import live_parts as suggest_live
from seamwire.suggesting import suggest_seams as suggest
from seamwire.tool import keymaps as operators_keymaps
from seamwire.tool.running import chains, listening
from seamwire.tool.running import steps as searches
from seamwire.view import overlay
from seamwire.view.edited_objects import edited
from stored import island_count

NOTHING_TO_UNDO = "Nothing to undo: the parts are as they were first shown"
OTHER_KEY = "Only the wheel, clicks, W, Ctrl Z, Enter, Esc and keys that move the view work here"


@pytest.fixture
def suzanne(ui: driver.Ui) -> Iterator[bpy.types.Object]:
    """Suzanne seen from her left, from above and the front."""
    with ui.override():
        obj = add_suzanne(1)
        edit()
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.ed.undo_push(message="Made")
    ui.look((0.82, 0.42, 0.18, 0.34), (0.0, 0.0, 0.0), 4.0)
    suggest.kept_choices.clear()
    yield obj
    leave(ui)


@pytest.fixture
def prism(ui: driver.Ui) -> Iterator[bpy.types.Object]:
    """A prism of seven sides with two lids, seen from above and the front."""
    with ui.override():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_cylinder_add(vertices=7, depth=1.6)
        obj = bpy.context.active_object
        edit()
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.ed.undo_push(message="Made")
    ui.look((0.92, 0.38, 0.0, 0.0), (0.0, 0.0, 0.0), 5.0)
    suggest.kept_choices.clear()
    yield obj
    leave(ui)


FRONT_SIDE, FRONT_RIM, TOP = (0.0, -0.901, 0.0), (0.0, -0.901, 0.8), (0.0, 0.0, 0.8)
"""Places of the prism: in the middle of the side to the viewer, of the rim over it, and of the upper lid."""


def live() -> suggest_live.LiveParts:
    """Return the parts that are shown."""
    return searches[0]._step.hand


def invoke(ui: driver.Ui, **options: object) -> None:
    """Begin, and wait until the parts are shown."""
    with ui.override():
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
    ui.wait_until(lambda: live() is not None)


def begin(ui: driver.Ui, **options: object) -> None:
    """Begin, and keep the parts that are shown at first."""
    invoke(ui, **options)
    shown = live()
    ui.key("RET")
    assert shown.is_kept


def keep(ui: driver.Ui) -> None:
    """Keep what is shown, and wait until it is in the mesh."""
    ui.key("RET")
    ui.wait_until(lambda: not searches, 60.0)


def escape(ui: driver.Ui) -> None:
    ui.key("ESC")
    ui.wait_until(lambda: not searches)


def count() -> int:
    """Return the number of parts that are shown."""
    return live()._search.part_count


def turn_to_the_end(ui: driver.Ui, turn: Callable[[], object]) -> list[int]:
    """Turn notches until one changes nothing. Return the different numbers of parts, from the first one to the last."""
    counts, before = [count()], None
    while live().choice != before:
        before = live().choice
        turn()
        ui.wait_until(lambda: not live()._searches)
        counts.append(count())
    return counts[:-1]


class Waiting:
    """Keeps planners from going on after their first plan."""

    def __init__(self) -> None:
        self.found: list[object] = []
        self._go_on = threading.Event()

    def plan(
        self,
        suggestion: Suggestion,
        energy: float,
        islands: int,
        progress: Callable[[float], bool],
        is_enough: Callable[[], bool],
    ) -> None:
        """Plan as a suggestion does, and wait in between."""

        def wait(fraction: float) -> bool:
            best = suggestion.best_so_far
            if best is not None and not self.found:
                self.found.append(best)
                while not self._go_on.wait(0.02) and progress(fraction) and not is_enough():
                    pass
            return progress(fraction)

        PLAN(suggestion, energy, islands, wait, is_enough)

    def end(self) -> None:
        """Let it go on."""
        self._go_on.set()


PLAN = Suggestion.plan


@pytest.fixture
def waiting(monkeypatch: pytest.MonkeyPatch) -> Iterator[Waiting]:
    """Planners that find one plan, and wait."""
    made = Waiting()

    monkeypatch.setattr(Suggestion, "plan", lambda suggestion, *given: made.plan(suggestion, *given))
    yield made
    made.end()


@pytest.fixture
def status(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts on plans in the status bar."""
    said: list[str] = []
    look = suggest_live.LiveParts.look

    def noted(self: object) -> str:
        said.append(look(self))
        return said[-1]

    monkeypatch.setattr(suggest_live.LiveParts, "look", noted)
    return said


@pytest.mark.smoke
@pytest.mark.every_blender
def test_seams_and_uvs_come_when_the_planning_has_ended(
    ui: driver.Ui, suzanne: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    while suzanne.data.uv_layers:
        suzanne.data.uv_layers.remove(suzanne.data.uv_layers[0])
    bpy.ops.ed.undo_push(message="No UVs")
    begin(ui)
    assert seams(suzanne) == []
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)
    ui.wait()
    assert suzanne.data.uv_layers
    assert undo_steps(capfd)[-1] == "Suggest Seamwires"
    with ui.override():
        bpy.ops.ed.undo()
    assert seams(bpy.context.active_object) == []
    assert not bpy.context.active_object.data.uv_layers


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
@pytest.mark.parametrize("tool", [False, True])
def test_what_is_found_is_shown_until_escape_leaves_all_as_it_was(
    ui: driver.Ui,
    suzanne: bpy.types.Object,
    waiting: Waiting,
    status: list[str],
    tool: bool,
    capfd: pytest.CaptureFixture[str],
) -> None:
    if tool:
        choose(ui, "seamwire.draw")
        ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
        ui.wait_until(lambda: edited.front is not None)
        ui.move((5.0, 5.0))
        ui.wait(3, redraw=True)
    before, steps, plain = snapshot(suzanne), undo_steps(capfd), ui.screen()
    invoke(ui)
    ui.wait_until(lambda: bool(waiting.found) and bool(status) and bool(status[-1]))
    shown = ui.screen()
    tinted = (np.ptp(shown, axis=2) > 0.05) & (np.ptp(plain, axis=2) < 0.03)
    assert tinted.mean() > 0.03, "the islands are"
    assert status[-1].startswith("stretch ") and ", seams " in status[-1]
    assert edited.covered
    ui.key("ESC")
    ui.wait_until(lambda: not edited.covered)
    ui.wait(20)
    assert snapshot(suzanne) == before
    assert undo_steps(capfd) == steps
    assert np.abs(ui.screen() - plain).max(axis=2).mean() < 0.002


@pytest.mark.smoke
@pytest.mark.parametrize("key", ["RET", "NUMPAD_ENTER"])
def test_enter_keeps_the_best_plan_so_far(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting, status: list[str], key: str
) -> None:
    begin(ui, parts=0.0)
    ui.wait_until(lambda: bool(status) and bool(status[-1]))
    ui.key(key)
    ui.wait_until(lambda: bool(seams(suzanne)))
    ui.wait()
    assert len(waiting.found) == 1
    edges = {frozenset(pair) for wire in waiting.found[0].wires for pair in zip(wire.vertices, wire.vertices[1:])}  # noqa: B905
    assert {frozenset(edge) for edge in seams(suzanne)} == edges
    assert suzanne.data.uv_layers


def test_enter_before_parts_are_shown_does_nothing(
    ui: driver.Ui, suzanne: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    measure, may_end = Suggestion.measure, threading.Event()

    def slow(self: Suggestion, *given: object) -> object:
        may_end.wait(20.0)
        return measure(self, *given)

    monkeypatch.setattr(Suggestion, "measure", slow)
    with ui.override():
        bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", distortion=40.0)
    ui.key("RET")
    ui.wait(5)
    may_end.set()
    ui.wait_until(lambda: live() is not None)
    assert not live().is_kept
    assert seams(suzanne) == []


def test_meanwhile_the_view_can_be_moved_and_nothing_else_done(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting
) -> None:
    distance, vertices, selected = ui.view.view_distance, len(suzanne.data.vertices), suzanne.data.total_vert_sel
    rotation = ui.view.view_rotation.copy()
    invoke(ui, unwrap=False)
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.key("NUMPAD_PLUS")
    ui.key("NUMPAD_1")
    ui.wait(5)
    assert ui.view.view_distance != distance
    assert ui.view.view_rotation != rotation
    ui.key("A")
    ui.key("X")
    ui.key("Z", ctrl=True)
    ui.key("RET")
    distance = ui.view.view_distance
    ui.wheel(True, (0.5 * ui.region.width, 0.5 * ui.region.height))
    assert ui.view.view_distance != distance, "the wheel zooms once the parts are kept"
    ui.wait_until(lambda: bool(waiting.found))
    waiting.end()
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)
    suzanne.update_from_editmode()
    assert len(suzanne.data.vertices) == vertices
    assert suzanne.data.total_vert_sel == selected


def subdivide(obj: bpy.types.Object) -> None:
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()


def move(obj: bpy.types.Object) -> None:
    with changing(obj) as bm:
        bm.verts[0].co.z += 1.0


@pytest.mark.parametrize("change", [subdivide, move])
def test_a_mesh_that_is_changed_meanwhile_keeps_what_it_has(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting, change: Callable[[bpy.types.Object], None]
) -> None:
    begin(ui)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        change(suzanne)
    waiting.end()
    ui.wait_until(lambda: not searches, 60.0)
    assert not edited.covered
    assert seams(suzanne) == []


def test_a_file_may_be_loaded_meanwhile(ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting) -> None:
    begin(ui)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        bpy.ops.wm.read_homefile(app_template="", load_ui=False)
    ui.wait(10)
    assert bpy.context.active_object.name == "Cube"
    assert not edited.covered


def test_a_wire_that_is_marked_meanwhile_stays_after_saving(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting, monkeypatch: pytest.MonkeyPatch
) -> None:
    start, end = head(suzanne, 2)
    begin(ui, along="EDGES", unwrap=False)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        assert mark_wires(chains=f"{start} {end}")
    marked = stored.chains(suzanne)
    assert len(marked) == 1
    waiting.end()
    ui.wait_until(lambda: not searches, 60.0)
    stored.forget(monkeypatch)
    found = stored.chains(suzanne)
    assert marked[0] in found, "the mesh holds the record of its label"
    assert len(found) > 1
    assert stored.agree(suzanne)


@pytest.mark.every_blender
def test_beside_a_search_a_chain_in_another_window_is_refused_with_a_sentence(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting, capfd: pytest.CaptureFixture[str]
) -> None:
    choose(ui)
    with second_window(ui) as other:
        invoke(ui)
        ui.wait_until(lambda: bool(waiting.found))
        with bpy.context.temp_override(**other):
            capfd.readouterr()
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first="CLICK") == {"CANCELLED"}
            assert "Suggest Seamwires is running" in "".join(capfd.readouterr())
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first="REMOVE") & {"PASS_THROUGH", "CANCELLED"}
            assert not bpy.ops.mesh.seamwire_suggest.poll(), "one search at a time"
        assert not chains
        escape(ui)
        with bpy.context.temp_override(**other):
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        assert not bpy.ops.mesh.seamwire_suggest.poll(), "a chain is drawn in the other window"
        chains[0].finish()


def test_seams_are_hidden_from_the_side_that_the_view_shows(
    ui: driver.Ui, suzanne: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    core, asked = native.load(), []
    plain = core.SeamPlanner

    def noted(*arguments: object, **options: object) -> object:
        asked.append(options["front"])
        return plain(*arguments, **options)

    monkeypatch.setattr(core, "SeamPlanner", noted)
    ui.look_from_top()
    begin(ui, distortion=40.0)
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)
    assert asked[0] == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)


# The wheel and clicks


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
@pytest.mark.parametrize(
    ("more", "fewer"), [("WHEELUPMOUSE", "WHEELDOWNMOUSE"), ("PAGE_UP", "PAGE_DOWN"), ("EQUAL", "MINUS")]
)
def test_the_wheel_and_keys_give_more_or_fewer_parts(
    ui: driver.Ui, prism: bpy.types.Object, more: str, fewer: str
) -> None:
    distance = ui.view.view_distance
    invoke(ui)
    assert count() == 3, "two lids and the sides"
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    counts = turn_to_the_end(ui, partial(ui.event, more, "PRESS"))
    assert counts == sorted(set(counts)), "each notch gives more"
    assert counts[-1] == 9, "each side is a part, and there are no more"
    ui.event(fewer, "PRESS")
    assert count() == 9, "the notch past the end is taken back"
    for expected in [*counts[-2::-1], 1]:
        ui.event(fewer, "PRESS")
        ui.wait_until(lambda: not live()._searches)
        assert count() == expected
    assert ui.view.view_distance == distance
    ui.event(more, "PRESS")
    chosen = live().choice.amount
    ui.key("SPACE")
    ui.wait_until(lambda: not searches, 60.0)
    assert island_count(prism) == 3
    last = bpy.context.window_manager.operators[-1]
    assert last.parts == pytest.approx(100.0 * chosen)


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_a_click_drops_a_border_and_a_second_click_keeps_it(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    plain = ui.screen()
    rim = ui.on_screen(FRONT_RIM)
    ui.move(rim)
    ui.wait_until(lambda: any(shown.hovered is not None for shown in live()._preview._shown.values()))
    assert np.abs(ui.screen() - plain).max(axis=2).mean() > 0.001, "the border is highlighted"
    ui.click(rim)
    assert count() == 2, "the sides and the upper lid have joined"
    ui.click(rim)
    assert count() == 3
    ui.wheel(False, rim)
    assert count() == 2, "the border that was kept stays"
    ui.click(rim)
    keep(ui)
    assert island_count(prism) == 1


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_w_goes_through_what_separates_parts_and_each_keeps_its_amount_and_clicks(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    invoke(ui)
    shown = live()
    ui.move(ui.on_screen(FRONT_SIDE))

    def state() -> object:
        return shown.choice.by, shown.choice.amount, count(), borders(), dict(shown.choice.edits)

    def press(key: str, **held: bool) -> object:
        ui.key(key, **held)
        ui.wait_until(lambda: not shown._searches)
        return state()

    assert state()[:3] == ("AUTO", 0.5, 3)
    assert turn_to_the_end(ui, partial(ui.wheel, True))[-1] == 9
    assert shown._past["amount"] == 1
    press("W")
    assert shown._past["amount"] == 0, "these notches are not past the end of other parts"
    press("Z", ctrl=True)
    ui.click(ui.on_screen(FRONT_RIM))
    first = state()
    assert first[2] == 8 and first[4]
    states = [first, *(press("W") for _ in range(3))]
    assert [each[0] for each in states] == ["AUTO", "RIMS", "LIMBS", "PANELS"]
    assert states[1][1:3] == (0.5, 3), "rims have their own amount"
    panels = states[3]
    assert panels[2] > 3 and "Parts by Front and Back" in shown.title
    finders = []
    monkeypatch.setattr(Suggestion, "measure", lambda *given: finders.append(given))
    assert press("W") == first
    for before in reversed(states):
        assert press("Z", ctrl=True) == before
    assert not finders, "what was found is kept"
    for after in states[1:]:
        assert press("Z", ctrl=True, shift=True) == after
    monkeypatch.undo()
    keep(ui)
    assert island_count(prism) >= panels[2]
    assert bpy.context.window_manager.operators[-1].parts_by == "PANELS"


@pytest.fixture
def slow_cuts(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Cuts of parts that take until the event is set."""
    find, may_end = Suggestion.count, threading.Event()

    def count(self: Suggestion, choice: PartChoice, progress: Callable[[float], bool]) -> int:
        while any(edits.parted for edits in choice.edits.values()) and not may_end.wait(0.02):
            if not progress(0.4):
                raise native.load().Cancelled
        return find(self, choice, progress)

    monkeypatch.setattr(Suggestion, "count", count)
    yield may_end
    may_end.set()


def test_a_long_cut_is_a_step_and_the_wheel_turns_after_it(
    ui: driver.Ui, prism: bpy.types.Object, slow_cuts: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    monkeypatch.setattr(Stepwise, "_tell", lambda _, text: said.append(text or ""))
    invoke(ui)
    side = ui.on_screen(FRONT_SIDE)
    ui.click(side)
    ui.wait_until(lambda: "Finding parts: 40 %" in said[-1])
    ui.click(ui.on_screen(FRONT_RIM))
    ui.wheel(False, side)
    ui.wait(5)
    assert count() == 3, "clicks wait for the cut"
    slow_cuts.set()
    ui.wait_until(lambda: not live()._searches)
    assert count() == 2, "all is one part, which is cut"
    assert not live().choice.edits[prism.name].dropped
    keep(ui)
    assert island_count(prism) == 2


def test_escape_ends_a_long_cut(ui: driver.Ui, prism: bpy.types.Object, slow_cuts: threading.Event) -> None:
    before = snapshot(prism)
    invoke(ui)
    ui.click(ui.on_screen(FRONT_SIDE))
    ui.wait(5)
    assert live()._searches
    escape(ui)
    assert not slow_cuts.is_set()
    assert snapshot(prism) == before
    assert not edited.covered


@pytest.mark.parametrize("step", ["measure", "plan"])
def test_escape_does_not_wait_for_a_call_that_cannot_be_stopped(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch, step: str
) -> None:
    began, may_end, ended, do = threading.Event(), threading.Event(), threading.Event(), getattr(Suggestion, step)

    def deaf(self: Suggestion, *given: object) -> object:
        began.set()
        may_end.wait(20.0)
        try:
            return do(self, *given)
        finally:
            ended.set()

    monkeypatch.setattr(Suggestion, step, deaf)
    before = snapshot(prism)
    with ui.override():
        bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT")
    ui.wait_until(began.is_set)
    ui.key("ESC")
    assert not searches
    assert not ended.is_set(), "Esc does not wait for the library"
    assert not edited.covered
    may_end.set()
    ui.wait_until(ended.is_set)
    ui.wait(5)
    assert snapshot(prism) == before
    monkeypatch.undo()
    invoke(ui)
    escape(ui)


def test_adjust_last_operation_has_what_was_clicked(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    ui.click(ui.on_screen(FRONT_RIM))
    keep(ui)
    ui.wait(5)
    last = bpy.context.window_manager.operators[-1]
    options = {name: getattr(last, name) for name in ("parts", "distortion", "edits")}
    assert options["edits"]
    with ui.override():
        bpy.ops.ed.undo()
        assert seams(bpy.context.active_object) == []
        assert bpy.ops.mesh.seamwire_suggest(**{**options, "parts": 100.0}) == {"FINISHED"}
        assert island_count(bpy.context.active_object) == 2, "the sides have joined over the upper lid"
        bpy.ops.ed.undo()
        assert bpy.ops.mesh.seamwire_suggest(**{**options, "parts": 100.0, "edits": ""}) == {"FINISHED"}
        assert island_count(bpy.context.active_object) == 9
        bpy.ops.ed.undo_push(message="Suggested")


def test_hidden_borders_and_other_regions_take_no_clicks(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    ui.click(ui.on_screen((0.0, 0.97, -0.8)))  # the rim behind the prism
    behind = dict(live().choice.edits)
    assert all(not edits.dropped for edits in behind.values())
    ui.click((5.0, 5.0))  # beside the mesh
    assert live().choice.edits == behind


def test_the_wheel_ends_a_plan_that_is_being_made(ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting) -> None:
    invoke(ui)
    ui.wait_until(lambda: bool(waiting.found))  # and it waits
    before = live()._version
    ui.wheel(False, (0.5 * ui.region.width, 0.5 * ui.region.height))
    assert live()._version > before
    ui.wait_until(lambda: live().is_planned)


def test_an_error_while_slits_are_planned_ends_it(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ValueError("as the test wants it")

    monkeypatch.setattr(Suggestion, "plan", fail)
    invoke(ui)
    ui.wait_until(lambda: not searches)
    assert seams(prism) == []
    assert not edited.covered


# Undo, and other keys


def borders() -> list[list[int]]:
    """Return the chains of vertices between the parts that are shown."""
    return sorted(chain.tolist() for each in live()._search for chain in each.borders)


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("key", ["Z", "BACK_SPACE"])
def test_undo_takes_back_each_click_notch_and_key_and_redo_makes_it_again(
    ui: driver.Ui, prism: bpy.types.Object, key: str
) -> None:
    invoke(ui)
    shown = live()
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))

    def state() -> object:
        return (
            count(),
            borders(),
            shown.choice.amount,
            shown.choice.stretch,
            dict(shown.choice.edits),
            len(shown._dim(next(iter(shown._search)))),
        )

    states = [state()]
    for change in (
        partial(ui.click, ui.on_screen(FRONT_SIDE)),
        partial(ui.wheel, True),
        partial(ui.event, "WHEELUPMOUSE", "PRESS", ctrl=True),
        partial(ui.click, ui.on_screen(FRONT_RIM)),
        partial(ui.click, ui.on_screen(FRONT_RIM)),
        partial(ui.event, "PAGE_DOWN", "PRESS"),
        partial(ui.event, "MINUS", "PRESS", ctrl=True),
    ):
        change()
        ui.wait_until(lambda: not shown._searches)
        states.append(state())
        assert states[-1] != states[-2]
    for before in states[-2::-1]:
        ui.key(key, ctrl=key == "Z")
        assert state() == before
    for after in states[1:]:
        ui.key("Z", ctrl=True, shift=True)
        assert state() == after
    ui.key(key, ctrl=key == "Z")
    ui.wheel(True, ctrl=True)
    last = state()
    assert last not in states[-2:]
    ui.key("Z", ctrl=True, shift=True)
    assert state() == last, "another change takes the place of those that were undone"
    ui.wait_until(lambda: shown.is_planned)
    keep(ui)
    assert seams(prism)


@pytest.mark.every_blender
def test_undo_with_nothing_to_take_back_says_so_once(ui: driver.Ui, prism: bpy.types.Object) -> None:
    before = snapshot(prism)
    invoke(ui)
    ui.move(ui.on_screen(TOP))
    ui.key("Z", ctrl=True)
    assert live().title.startswith(NOTHING_TO_UNDO)
    ui.key("BACK_SPACE")
    assert NOTHING_TO_UNDO not in live().title
    ui.wheel(True)
    ui.key("Z", ctrl=True)
    ui.wait_until(lambda: live().is_planned)
    escape(ui)
    assert snapshot(prism) == before


def test_undo_takes_back_a_cut_that_is_still_searched(
    ui: driver.Ui, prism: bpy.types.Object, slow_cuts: threading.Event
) -> None:
    invoke(ui)
    first = borders()
    ui.click(ui.on_screen(FRONT_SIDE))
    ui.wait(5)
    assert live()._searches
    ui.wheel(False, ui.on_screen(FRONT_SIDE))
    assert len(live()._searches) == 2
    ui.key("Z", ctrl=True)
    assert len(live()._searches) == 1
    ui.key("Z", ctrl=True)
    ui.wait_until(lambda: live().is_planned)
    assert not slow_cuts.is_set()
    assert borders() == first
    assert not live().choice.edits


def test_a_search_that_is_taken_back_leaves_the_plan(
    ui: driver.Ui, prism: bpy.types.Object, slow_cuts: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    invoke(ui)
    shown, plans = live(), []
    ui.wait_until(lambda: shown.is_planned)
    monkeypatch.setattr(Suggestion, "plan", lambda *given: plans.append(given))
    ui.click(ui.on_screen(FRONT_SIDE))
    ui.wait_until(lambda: searches[0]._step.text == "Finding parts")
    ui.key("Z", ctrl=True)
    ui.wait_until(lambda: searches[0]._step.text == "Planning seams")
    ui.wait(5)
    assert shown.is_planned
    assert not plans
    assert not slow_cuts.is_set()


@pytest.mark.every_blender
@pytest.mark.parametrize("start", [50.0, 52.0])
def test_the_wheel_leads_back_to_the_same_parts(ui: driver.Ui, suzanne: bpy.types.Object, start: float) -> None:
    invoke(ui, parts=start, distortion=20.0)
    shown, seen = live(), {}
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))

    def turn(up: bool, **held: bool) -> None:
        ui.wheel(up, **held)
        ui.wait_until(lambda: not shown._searches)
        assert seen.setdefault(shown.choice.amount, borders()) == borders(), "an amount has the same borders each time"

    first = shown.choice.amount, shown.choice.stretch, borders()
    for up, notches in ((True, 2), (False, 3), (True, 1)):
        for _ in range(notches):
            turn(up)
            turn(up, ctrl=True)
    assert (shown.choice.amount, shown.choice.stretch, borders()) == first


@pytest.mark.every_blender
@pytest.mark.parametrize("held", [{}, {"ctrl": True}, {"shift": True}])
def test_the_wheel_leads_back_from_past_an_end(ui: driver.Ui, prism: bpy.types.Object, held: dict[str, bool]) -> None:
    invoke(ui, islands=2)
    shown, first = live(), live().choice
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    for up, notches in ((False, 12), (True, 24), (False, 12)):
        for _ in range(notches):
            ui.wheel(up, **held)
            ui.wait_until(lambda: not shown._searches)
    assert shown.choice == first
    ui.wheel(True, **held)
    assert shown.choice != first, "it turns at once"


def test_shift_and_the_wheel_change_the_least_number_of_islands(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui, parts=0.0)
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    for _ in range(3):
        ui.wheel(True, shift=True)
    ui.wheel(False, shift=True)
    assert live().choice.islands == 3
    ui.key("Z", ctrl=True)
    assert live().choice.islands == 4
    ui.key("Z", ctrl=True, shift=True)
    ui.wait_until(lambda: live().is_planned)
    keep(ui)
    assert island_count(prism) == 3
    assert bpy.context.window_manager.operators[-1].islands == 3


@pytest.mark.smoke
@pytest.mark.every_blender
def test_what_was_kept_belongs_to_the_mesh(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    ui.click(ui.on_screen(FRONT_RIM))
    ui.wheel(True)
    ui.wheel(True, ctrl=True)
    kept = live().choice
    assert kept.edits
    ui.wait_until(lambda: live().is_planned)
    keep(ui)
    ui.wait(5)
    invoke(ui)
    assert live().choice == replace(kept, edits={}), "with other seams clicks mean something else"
    escape(ui)
    with ui.override():
        bpy.ops.ed.undo()
    ui.wait(5)
    invoke(ui)
    assert live().choice == kept
    escape(ui)
    with ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.mesh.primitive_cylinder_add(vertices=9)
        edit()
    invoke(ui)
    assert live().choice == PartChoice(0.5, 17.0), "another mesh begins with the defaults"
    escape(ui)


def test_the_corner_of_the_view_says_what_is_shown(
    ui: driver.Ui, prism: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    bare = ui.screen()
    invoke(ui)
    preview = live()._preview
    assert preview._rows[:2] == [("Parts by: Auto (Rims)", "W"), ("Parts: 3, amount 50 %", "Wheel")]
    ui.wheel(True, ui.on_screen(TOP))
    assert count() > 3
    assert preview._rows[1][0].startswith(f"Parts: {count()}, amount")
    ui.wait_until(lambda: live().is_planned and preview._rows[-1][0] == "Search ended")
    assert any(text.startswith("Stretch: ") and ", at most 17 %" in text for text, _ in preview._rows)
    ui.wait_until(lambda: any("of the UV square used" in text for text, _ in preview._rows))
    told = next(text for text, _ in preview._rows if "of the UV square used" in text)
    ui.key("G")
    assert preview._rows[0] == (OTHER_KEY, "")
    size = 130
    drawn = np.abs(ui.screen() - bare).max(axis=2)[8:size, 8:250] > 0.3
    assert 0.02 < drawn.mean() < 0.5, "there is text"
    preferences().text = "NONE"
    blank = np.abs(ui.screen() - bare).max(axis=2)[8:size, 8:250] > 0.3
    assert blank.mean() < 0.002
    capfd.readouterr()
    keep(ui)
    assert told in "".join(capfd.readouterr()), "the report has the same share"


@pytest.mark.oldest_and_newest
def test_the_corner_of_the_view_is_legible_on_a_white_background(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ui.space.shading, "background_type", "VIEWPORT")
    monkeypatch.setattr(ui.space.shading, "background_color", (1.0, 1.0, 1.0))
    invoke(ui)
    left = overlay.free_room(ui.area, ui.region)[0]
    text = ui.screen()[10:60, left + 12 : left + 90].mean(axis=2)
    assert np.median(text) < 0.65, "the text lies on a dark plate"
    assert (text > 0.9).mean() > 0.01


class Corner:
    """The lines of the preview that a region of a window draws."""

    def __init__(self, other: dict[str, object]) -> None:
        self.counts: list[int] = []
        self._window = other["window"]
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._note, (), "WINDOW", "POST_PIXEL")

    def _note(self) -> None:
        if bpy.context.window == self._window and searches:
            self.counts.append(len(live()._preview._seen_here()))

    def end(self) -> None:
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")


@pytest.mark.every_blender
@pytest.mark.parametrize("is_same", [True, False])
def test_other_windows_show_the_preview_if_they_show_the_scene(
    ui: driver.Ui, prism: bpy.types.Object, is_same: bool
) -> None:
    with second_window(ui, "" if is_same else "Other") as other:
        assert (other["window"].scene == ui.window.scene) is is_same
        invoke(ui)
        corner = Corner(other)
        try:
            ui.wait_until(lambda: live().is_planned)
            other["area"].tag_redraw()
            ui.wait_until(lambda: bool(corner.counts))
        finally:
            corner.end()
        assert set(corner.counts) == {1 if is_same else 0}
        send(ui, other, "WHEELUPMOUSE")
        assert count() == 3
        escape(ui)


# Every key of Blender's


def pressed_keys() -> list[tuple[str, tuple[bool, bool, bool]]]:
    """Return all keys in the keymaps of a 3D view in Edit Mode, with their modifiers, except those that end the preview."""
    manager, found = bpy.context.window_manager, {}
    for name in operators_keymaps.KEYMAPS:
        keymap = operators_keymaps.user_keymap(manager, name)
        for item in [] if keymap is None else keymap.keymap_items:
            if item.active and item.map_type == "KEYBOARD" and item.value != "NOTHING":
                held = tuple(int(getattr(item, modifier)) == 1 for modifier in ("shift", "ctrl", "alt"))
                found.setdefault((item.type, held))
    ending = {"RET", "NUMPAD_ENTER", "ESC", "SPACE"}
    return [(kind, held) for kind, held in found if kind not in ending or (kind == "SPACE" and any(held))]


def put_back(ui: driver.Ui, kind: str, held: dict[str, bool]) -> None:
    """Close what a harmless key has opened: a popup, a window, a full screen, an animation."""
    manager = bpy.context.window_manager
    while len(manager.windows) > 1:
        with bpy.context.temp_override(window=manager.windows[-1]):
            bpy.ops.wm.window_close()
        ui.wait(5)
    if ui.window.screen.is_animation_playing:
        with ui.override():
            bpy.ops.screen.animation_cancel(restore_frame=True)
    if ui.window.screen.show_fullscreen:
        ui.key(kind, **held)
        ui.wait(5)


@pytest.mark.oldest_and_newest
def test_no_key_of_blenders_loses_anything(
    ui: driver.Ui, alone: bpy.types.Object, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))  # so that saving asks for no name
    try:
        name = alone.name
        with ui.override():
            for _ in range(40):  # the history is full, so that no step of other tests is dropped
                bpy.ops.ed.undo_push(message="Full")
        before, steps = snapshot(alone), undo_steps(capfd)
        invoke(ui)
        middle = (0.5 * ui.region.width, 0.5 * ui.region.height)
        pressed = pressed_keys()
        assert len(pressed) > 150
        for kind, held in pressed:
            modifiers = dict(zip(("shift", "ctrl", "alt"), held, strict=True))
            ui.move(middle)
            ui.key(kind, **modifiers)
            ui.wait(2)
            put_back(ui, kind, modifiers)
            assert searches, f"{kind} {modifiers} has ended it"
            assert bpy.context.mode == "EDIT_MESH", f"{kind} {modifiers}"
            assert snapshot(bpy.data.objects[name]) == before, f"{kind} {modifiers}"
        ui.wait_until(lambda: live().is_planned and not live()._searches, 60.0)
        assert edited.covered, "it is still shown"
        escape(ui)
        assert snapshot(bpy.data.objects[name]) == before
        # Blender's own settings, such as snapping, add steps at the end.
        kept = [step for step in undo_steps(capfd) if step != "Context Toggle"]
        assert len(kept) > 20
        assert kept == steps[len(steps) - len(kept) :]
    finally:
        with ui.override():
            bpy.ops.wm.read_homefile(app_template="", load_ui=False)
        ui.wait(5)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_key_that_does_nothing_says_once_which_keys_work(ui: driver.Ui, prism: bpy.types.Object) -> None:
    before, sidebar = snapshot(prism), ui.space.show_region_ui
    invoke(ui)
    ui.move(ui.on_screen(TOP))
    rotation = ui.view.view_rotation.copy()
    ui.event("LEFT_SHIFT", "PRESS")
    ui.key("NUMPAD_1")
    ui.key("N")
    ui.wait(5)
    assert ui.space.show_region_ui != sidebar
    ui.key("N")
    assert ui.view.view_rotation != rotation
    assert OTHER_KEY not in live().title
    for key in ("F3", "F1", "TAB", "G", "X", "ONE", "THREE", "S", "H"):
        ui.key(key)
        assert live().title.startswith(OTHER_KEY)
    ui.wheel(True)
    assert OTHER_KEY not in live().title
    ui.key("G")
    assert OTHER_KEY not in live().title, "it was said"
    escape(ui)
    assert snapshot(prism) == before


# Other editors and windows


def place_in_area(ui: driver.Ui, kind: str) -> tuple[float, float]:
    """Return the middle of an editor, from the corner of the viewport's region."""
    area = next(area for area in ui.window.screen.areas if area.type == kind)
    return area.x + 0.5 * area.width - ui.region.x, area.y + 0.5 * area.height - ui.region.y


def tab(ui: driver.Ui, number: int) -> tuple[float, float]:
    """Return where the name of a workspace stands in the bar at the top."""
    return (
        300.0 + 80.0 * number
    ) * bpy.context.preferences.system.ui_scale - ui.region.x, ui.window.height - 12.0 - ui.region.y


@pytest.fixture
def workspace(ui: driver.Ui) -> Iterator[bpy.types.WorkSpace]:
    """The workspace, which comes back after the test."""
    before = ui.window.workspace
    yield before
    ui.window.workspace = before
    ui.wait(10)


@pytest.mark.every_blender
@pytest.mark.parametrize("by", ["tab", "key"])
def test_another_workspace_can_be_opened_meanwhile(
    ui: driver.Ui, prism: bpy.types.Object, workspace: bpy.types.WorkSpace, by: str
) -> None:
    before = snapshot(prism)
    invoke(ui)
    ui.wheel(True, ui.on_screen(TOP))
    parts = count()
    if by == "tab":
        ui.click(tab(ui, 1))
    else:
        ui.move(place_in_area(ui, "OUTLINER"))
        ui.key("PAGE_DOWN", ctrl=True)
    ui.wait_until(lambda: ui.window.workspace != workspace)
    ui.wait(10)
    assert bpy.context.mode == "EDIT_MESH"
    assert count() == parts
    ui.key("Z", ctrl=True)
    assert count() == 3
    escape(ui)
    assert snapshot(prism) == before
    assert not edited.covered


@pytest.mark.every_blender
def test_a_workspace_in_another_mode_ends_it(
    ui: driver.Ui, prism: bpy.types.Object, workspace: bpy.types.WorkSpace
) -> None:
    invoke(ui)
    ui.window.workspace = bpy.data.workspaces["Sculpting"]
    ui.wait_until(lambda: not searches)
    assert not edited.covered
    ui.window.workspace = workspace
    ui.wait(10)
    with ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
    assert seams(prism) == []


@pytest.mark.every_blender
def test_clicks_in_the_sidebar_the_header_and_other_editors_are_blenders(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    invoke(ui)
    parts, heard = count(), []
    follow = Stepwise._follow

    def noted(self: Stepwise, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = follow(self, context, event)
        if event.type in {"LEFTMOUSE", "RIGHTMOUSE", "A"} and event.value == "PRESS":
            heard.append(result)
        return result

    monkeypatch.setattr(Stepwise, "_follow", noted)
    ui.space.show_region_ui = True
    ui.wait(10, redraw=True)
    sidebar = next(region for region in ui.area.regions if region.type == "UI")
    header = next(region for region in ui.area.regions if region.type == "HEADER")
    try:
        for at in (
            (sidebar.x + 0.5 * sidebar.width - ui.region.x, 8.0),
            (header.x + header.width - 4.0 - ui.region.x, header.y + 0.5 * header.height - ui.region.y),
            place_in_area(ui, "OUTLINER"),
            place_in_area(ui, "PROPERTIES"),
        ):
            ui.click(at)
            ui.wait(3)
    finally:
        ui.space.show_region_ui = False
    assert heard == 4 * [{"PASS_THROUGH"}]
    ui.move(place_in_area(ui, "OUTLINER"))
    ui.key("Z", ctrl=True)
    assert live().title.startswith(NOTHING_TO_UNDO), "Undo in Blender would end it"
    assert count() == parts
    escape(ui)


@pytest.mark.every_blender
def test_undo_in_another_window_is_that_of_the_preview(ui: driver.Ui, prism: bpy.types.Object) -> None:
    before = snapshot(prism)
    with second_window(ui) as other:
        invoke(ui)
        ui.wheel(True, ui.on_screen(TOP))
        assert count() > 3
        send(ui, other, "LEFTMOUSE")
        send(ui, other, "Z", ctrl=True)
        assert count() == 3
        send(ui, other, "Z", ctrl=True)
        assert live().title.startswith(NOTHING_TO_UNDO)
        assert bpy.context.mode == "EDIT_MESH"
        escape(ui)
        ui.wait_until(lambda: not listening)
    assert snapshot(prism)["vertices"] == before["vertices"]


# The limit of the stretch, and the map


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
@pytest.mark.parametrize(
    ("more", "fewer"), [("WHEELUPMOUSE", "WHEELDOWNMOUSE"), ("PAGE_UP", "PAGE_DOWN"), ("EQUAL", "MINUS")]
)
def test_ctrl_and_the_wheel_or_keys_change_the_limit_of_the_stretch(
    ui: driver.Ui, prism: bpy.types.Object, more: str, fewer: str
) -> None:
    invoke(ui)
    shown = live()
    parts, amount = count(), shown.choice.amount
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.wait_until(lambda: shown.is_planned)
    version = shown._version
    ui.event(more, "PRESS", ctrl=True)
    assert shown.choice.stretch == 22.0
    assert shown._version > version, "another plan is needed"
    for _ in range(2):
        ui.event(fewer, "PRESS", ctrl=True)
    assert shown.choice.stretch == 13.0
    assert "Stretch: up to 13 %" in shown.title
    assert (count(), shown.choice.amount) == (parts, amount)
    ui.wait_until(lambda: shown.is_planned)
    keep(ui)
    assert bpy.context.window_manager.operators[-1].distortion == pytest.approx(13.0)


def squares() -> list[np.ndarray]:
    """Return the maps that are shown as a checker pattern."""
    shown = live()._preview._shown.values()
    return [each._squares for each in shown if each._squares is not None]


def contrast(ui: driver.Ui, at: tuple[float, float]) -> float:
    """Return how much the brightness varies around a place in the viewport."""
    x, y = (round(value) for value in at)
    return float(ui.screen()[y - 15 : y + 15, x - 15 : x + 15].mean(axis=2).std())


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_the_map_is_shown_as_squares_of_one_size_while_the_hand_rests(ui: driver.Ui, prism: bpy.types.Object) -> None:
    side = ui.on_screen(FRONT_SIDE)
    ui.move((5.0, 5.0))
    plain = contrast(ui, side)
    invoke(ui)
    ui.wait_until(lambda: bool(squares()))
    assert contrast(ui, side) > plain + 0.03
    color = ui.screen()[round(side[1]) - 15 : round(side[1]) + 15, round(side[0]) - 15 : round(side[0]) + 15]
    assert np.ptp(color.mean(axis=(0, 1))) > 0.04, "the color of the part is seen as well"
    arrays = next(iter(live()._search)).mesh.arrays
    corners, (shown,) = arrays.in_object[arrays.triangles], squares()
    surface = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    (a, b), (c, d) = (shown[:, 1] - shown[:, 0]).T, (shown[:, 2] - shown[:, 0]).T
    assert 0.5 * np.abs(a * d - b * c) / surface == pytest.approx(28.0**2 / surface.sum(), rel=0.01)
    ui.wheel(True, side)
    assert not squares(), "the parts have changed"
    ui.move((5.0, 5.0))
    ui.wait_until(lambda: bool(squares()))
    keep(ui)
    assert not edited.covered
    assert contrast(ui, side) < plain + 0.03


# Blender meanwhile


def saved(path: Path) -> dict[str, object]:
    """Return what the one mesh in a file holds."""
    copy = path.with_suffix(".copy.blend")  # Blender cannot append from the file that is open
    shutil.copy(path, copy)
    with bpy.data.libraries.load(str(copy)) as (there, here):
        here.meshes = list(there.meshes)
    (mesh,) = here.meshes
    coordinates = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    found = {
        "coordinates": coordinates.tolist(),
        "edges": sorted(tuple(sorted(edge.vertices)) for edge in mesh.edges),
        "seams": [edge.index for edge in mesh.edges if edge.use_seam],
        "maps": [[tuple(corner.uv) for corner in layer.data] for layer in mesh.uv_layers],
        "wires": mesh.seamwire_wires,
    }
    bpy.data.meshes.remove(mesh)
    return found


@pytest.fixture
def alone(prism: bpy.types.Object) -> bpy.types.Object:
    """The prism in a file without another mesh."""
    for mesh in [mesh for mesh in bpy.data.meshes if mesh != prism.data]:
        bpy.data.meshes.remove(mesh)
    return prism


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_a_file_that_is_saved_meanwhile_has_the_mesh_as_it_was(
    ui: driver.Ui, alone: bpy.types.Object, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    # Blender itself saves automatically only after its modal operators have ended.
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "before.blend"), copy=True)
    before, steps = snapshot(alone), undo_steps(capfd)
    invoke(ui)
    ui.click(ui.on_screen(FRONT_RIM))
    ui.wait_until(lambda: live().is_planned)
    path, parts = tmp_path / "meanwhile.blend", count()
    bpy.app.timers.register(lambda: bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True) and None)
    ui.wait_until(path.exists)
    ui.wait(5)
    assert searches
    assert count() == parts
    assert live().is_planned
    escape(ui)
    assert snapshot(alone) == before
    assert undo_steps(capfd) == steps
    assert saved(path) == saved(tmp_path / "before.blend")


@pytest.mark.oldest_and_newest
def test_ctrl_s_saves_meanwhile_and_nothing_is_lost(ui: driver.Ui, alone: bpy.types.Object, tmp_path: Path) -> None:
    path = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    try:
        before = saved(path)
        ui.wait(5)
        invoke(ui)
        ui.wheel(True, ui.on_screen(TOP))
        ui.wait_until(lambda: live().is_planned)
        parts = count()
        path.unlink()
        ui.key("S", ctrl=True)
        ui.wait_until(path.exists)
        ui.wait(5)
        assert count() == parts, "the parts are still shown"
        assert saved(path) == before
        ui.key("RET")
        ui.wait_until(lambda: not searches, 60.0)
        assert seams(alone)
    finally:
        with ui.override():
            bpy.ops.wm.read_homefile(app_template="", load_ui=False)
        ui.wait(5)


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_an_animation_plays_meanwhile(ui: driver.Ui, prism: bpy.types.Object) -> None:
    with ui.override():
        animate(prism)
        prism.modifiers["Armature"].show_in_editmode = prism.modifiers["Armature"].show_on_cage = True
        bpy.context.scene.frame_set(1)
    ui.wait(5)
    before = snapshot(prism)
    invoke(ui)
    (shown,) = live()._preview._shown.values()
    rest = shown._seen[0].copy()
    try:
        with ui.override():
            bpy.ops.screen.animation_play()
        ui.wait_until(lambda: bpy.context.scene.frame_current > 10)
        ui.wait_until(lambda: np.abs(shown._seen[0] - rest).max() > 1e-3)
        ui.wheel(True, ui.on_screen(TOP))
        assert count() > 3
        ui.wait_until(lambda: live().is_planned)
        assert searches
    finally:
        with ui.override():
            bpy.ops.screen.animation_cancel(restore_frame=True)
    ui.wait(5)
    escape(ui)
    assert snapshot(prism) == before


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_undo_from_elsewhere_ends_it_and_the_mesh_is_as_undo_has_it(ui: driver.Ui, prism: bpy.types.Object) -> None:
    with ui.override():
        first = len(prism.data.vertices)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
        bpy.ops.ed.undo_push(message="Subdivided")
    invoke(ui)
    ui.wheel(True, ui.on_screen(TOP))
    ui.key("Z", ctrl=True)
    assert searches, "the shortcut does nothing meanwhile"
    with ui.override():
        bpy.ops.ed.undo()
    ui.wait_until(lambda: not searches)
    assert not edited.covered
    obj = bpy.context.active_object
    obj.update_from_editmode()
    assert len(obj.data.vertices) == first
    assert seams(obj) == []
    with ui.override():
        bpy.ops.ed.redo()
    obj = bpy.context.active_object
    obj.update_from_editmode()
    assert len(obj.data.vertices) > first


@pytest.mark.parametrize("act", ["move", "click", "wheel"])
def test_a_hand_over_an_object_that_was_just_removed_takes_nothing(
    ui: driver.Ui, prism: bpy.types.Object, act: str
) -> None:
    invoke(ui)
    at = ui.on_screen(FRONT_SIDE)
    ui.move(at)
    bpy.data.objects.remove(prism)
    {"move": partial(ui.move, at), "click": partial(ui.click, at), "wheel": partial(ui.wheel, True, at)}[act]()
    ui.wait_until(lambda: not searches)
    assert not edited.covered


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_its_window_may_be_closed(ui: driver.Ui, prism: bpy.types.Object) -> None:
    before = snapshot(prism)
    with second_window(ui) as other:
        with bpy.context.temp_override(**other):
            assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        ui.wait_until(lambda: live() is not None)
        ui.wait_until(lambda: live().is_planned)
        ui.wheel(True, ui.on_screen(TOP))
        assert count() == 3, "the wheel over the first window is for that window"
    ui.wait_until(lambda: not searches)
    assert not edited.covered
    assert snapshot(prism) == before
    invoke(ui)


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_escape_or_a_right_click_after_changes_leaves_all_as_it_was(
    ui: driver.Ui, prism: bpy.types.Object, key: str, capfd: pytest.CaptureFixture[str]
) -> None:
    before, steps = snapshot(prism), undo_steps(capfd)
    invoke(ui)
    ui.wheel(True, ui.on_screen(TOP))
    ui.click(ui.on_screen(FRONT_RIM))
    ui.click(ui.on_screen(TOP), "RIGHTMOUSE", shift=True)
    assert searches, "Shift and a right click do something else"
    ui.key(key)
    ui.wait_until(lambda: not searches)
    assert snapshot(prism) == before
    assert undo_steps(capfd) == steps
    assert not edited.covered


@pytest.mark.oldest_and_newest
def test_a_right_click_does_nothing_where_it_selects(
    ui: driver.Ui, prism: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    monkeypatch.setattr(Stepwise, "_tell", lambda _, text: said.append(text or ""))
    with keymaps.using("right-click select"):
        ui.wait(5)
        before = snapshot(prism)
        invoke(ui)
        ui.click(ui.on_screen(TOP), "RIGHTMOUSE")
        ui.wait(5)
        assert searches
        assert said[-1].endswith("    Esc: Cancel")
        escape(ui)
        assert snapshot(prism) == before
    ui.wait(5)
    invoke(ui)
    assert said[-1].endswith("    Esc or Right Click: Cancel")
