# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts are suggested beside the interface: the wheel and clicks change them, Enter keeps them, Esc changes nothing."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import bmesh
import bpy
import numpy as np
import pytest
import stored
import ui as driver
from desk import choose, leave, undo_steps
from scene import add_suzanne, edit, head, mark_wires, seams, snapshot
from seamwire.core.base import native
from seamwire.mesh.seam_islands import island_count
from seamwire.mesh.suggestion import Suggestion
from seamwire.operators import suggest_live
from seamwire.operators.report import running as chains
from seamwire.operators.steps import running as searches
from seamwire.view.edited_objects import edited


@pytest.fixture
def suzanne(ui: driver.Ui) -> Iterator[bpy.types.Object]:
    """Suzanne seen from her left, from above and the front."""
    with ui.override():
        obj = add_suzanne(1)
        edit()
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.ed.undo_push(message="Made")
    ui.look((0.82, 0.42, 0.18, 0.34), (0.0, 0.0, 0.0), 4.0)
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
    ui.key("RET")
    assert live().is_kept


def count() -> int:
    """Return the number of parts that are shown."""
    return live()._suggestions.part_count


class Waiting:
    """Keeps planners from going on after their first plan."""

    def __init__(self) -> None:
        self.found: list[object] = []
        self._go_on = threading.Event()

    def plan(
        self, suggestion: Suggestion, request: object, progress: Callable[[float], bool], **options: object
    ) -> None:
        """Plan as a suggestion does, and wait in between."""

        def wait(fraction: float) -> bool:
            best = suggestion.best_so_far
            if best is not None and not self.found:
                self.found.append(best)
                while not self._go_on.wait(0.02) and progress(fraction) and not options["is_enough"]():
                    pass
            return progress(fraction)

        PLAN(suggestion, request, wait, **options)

    def end(self) -> None:
        """Let it go on."""
        self._go_on.set()


PLAN = Suggestion.plan


@pytest.fixture
def waiting(monkeypatch: pytest.MonkeyPatch) -> Iterator[Waiting]:
    """Planners that find one plan, and wait."""
    made = Waiting()

    def plan(suggestion: Suggestion, request: object, progress: Callable[[float], bool], **options: object) -> None:
        made.plan(suggestion, request, progress, **options)

    monkeypatch.setattr(Suggestion, "plan", plan)
    yield made
    made.end()


@pytest.fixture
def status(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts on plans in the status bar."""
    said: list[str] = []
    look = suggest_live.LiveParts._look

    def noted(self: object) -> str:
        said.append(look(self))
        return said[-1]

    monkeypatch.setattr(suggest_live.LiveParts, "_look", noted)
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

    def slow(self: Suggestion, progress: Callable[[float], bool]) -> None:
        may_end.wait(20.0)
        measure(self, progress)

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


def test_a_mesh_that_is_changed_meanwhile_keeps_what_it_has(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting
) -> None:
    begin(ui)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
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


def test_a_mesh_that_is_moved_meanwhile_keeps_what_it_has(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting
) -> None:
    begin(ui)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        bm = bmesh.from_edit_mesh(suzanne.data)
        bm.verts.ensure_lookup_table()
        bm.verts[0].co.z += 1.0
        bmesh.update_edit_mesh(suzanne.data)
    waiting.end()
    ui.wait_until(lambda: not searches, 60.0)
    assert seams(suzanne) == []


@pytest.mark.every_blender
def test_beside_a_search_a_chain_in_another_window_is_refused_with_a_sentence(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting, capfd: pytest.CaptureFixture[str]
) -> None:
    choose(ui)
    with ui.override():
        bpy.ops.wm.window_new()
    other = bpy.context.window_manager.windows[-1]
    ui.wait(5)
    try:
        invoke(ui)
        ui.wait_until(lambda: bool(waiting.found))
        area = next(area for area in other.screen.areas if area.type == "VIEW_3D")
        region = next(region for region in area.regions if region.type == "WINDOW")
        with bpy.context.temp_override(window=other, area=area, region=region):
            capfd.readouterr()
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first="CLICK") == {"CANCELLED"}
            assert "A search for seams is running" in "".join(capfd.readouterr())
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", first="REMOVE") & {"PASS_THROUGH", "CANCELLED"}
            assert not bpy.ops.mesh.seamwire_suggest.poll(), "one search at a time"
        assert not chains
        ui.key("ESC")
        ui.wait_until(lambda: not searches)
        with bpy.context.temp_override(window=other, area=area, region=region):
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        assert not bpy.ops.mesh.seamwire_suggest.poll(), "a chain is drawn in the other window"
        chains[0].drop()
    finally:
        with bpy.context.temp_override(window=other):
            bpy.ops.wm.window_close()
        ui.wait(3)


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
    ui.event(more, "PRESS")
    assert count() == 9, "each side is a part"
    amount = live().amount
    ui.event(more, "PRESS")
    assert (count(), live().amount) == (9, amount), "there are no more"
    ui.event(fewer, "PRESS")
    assert count() == 3
    ui.event(fewer, "PRESS")
    assert count() == 1
    assert ui.view.view_distance == distance
    ui.event(more, "PRESS")
    chosen = live().amount
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
    ui.key("RET")
    ui.wait_until(lambda: not searches, 60.0)
    assert island_count(prism) == 1


def test_a_click_into_an_island_cuts_it_once_more(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    ui.click(ui.on_screen(FRONT_SIDE))
    assert count() == 4
    ui.click(ui.on_screen(FRONT_SIDE))
    assert count() == 5
    ui.key("RET")
    ui.wait_until(lambda: not searches, 60.0)
    assert island_count(prism) == 5


def test_adjust_last_operation_has_what_was_clicked(ui: driver.Ui, prism: bpy.types.Object) -> None:
    invoke(ui)
    ui.click(ui.on_screen(FRONT_RIM))
    ui.key("RET")
    ui.wait_until(lambda: not searches, 60.0)
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
    behind = dict(live().edits)
    assert all(not edits.dropped for edits in behind.values())
    ui.click((5.0, 5.0))  # beside the mesh
    assert live().edits == behind


@pytest.mark.smoke
def test_slits_are_shown_when_the_hand_rests_and_planned_anew_after_a_change(
    ui: driver.Ui, prism: bpy.types.Object, status: list[str]
) -> None:
    invoke(ui)
    ui.wait_until(lambda: live().is_planned)
    ui.wait_until(lambda: bool(status[-1]))
    assert status[-1].startswith("stretch ") and ", seams " in status[-1]
    assert seams(prism) == []
    version = live()._version
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.wheel(True)
    assert live()._version > version, "another plan is needed"
    ui.wait_until(lambda: live().is_planned)


def test_the_wheel_ends_a_plan_that_is_being_made(ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting) -> None:
    invoke(ui)
    ui.wait_until(lambda: bool(waiting.found))  # and it waits
    before = live()._version
    ui.wheel(False, (0.5 * ui.region.width, 0.5 * ui.region.height))
    assert live()._version > before
    ui.wait_until(lambda: live().is_planned)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_escape_after_changes_leaves_all_as_it_was(
    ui: driver.Ui, prism: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    before, steps = snapshot(prism), undo_steps(capfd)
    invoke(ui)
    ui.wheel(True, ui.on_screen(TOP))
    ui.click(ui.on_screen(FRONT_RIM))
    ui.wait(10)
    ui.key("ESC")
    ui.wait_until(lambda: not searches)
    assert snapshot(prism) == before
    assert undo_steps(capfd) == steps
    assert not edited.covered


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
