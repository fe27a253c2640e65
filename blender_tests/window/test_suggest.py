# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams are suggested beside the interface: the best plan is shown, Enter keeps it, Esc changes nothing."""

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
from scene import add_suzanne, edit, head, seams, snapshot
from seamwire.core.base import native
from seamwire.mesh.suggestion import Suggestion
from seamwire.operators import suggest
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


def invoke(ui: driver.Ui, **options: object) -> None:
    with ui.override():
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}


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
    look = suggest._Look.__call__

    def noted(self: object) -> str:
        said.append(look(self))
        return said[-1]

    monkeypatch.setattr(suggest._Look, "__call__", noted)
    return said


@pytest.mark.smoke
@pytest.mark.every_blender
def test_seams_and_uvs_come_when_the_planning_has_ended(
    ui: driver.Ui, suzanne: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    while suzanne.data.uv_layers:
        suzanne.data.uv_layers.remove(suzanne.data.uv_layers[0])
    bpy.ops.ed.undo_push(message="No UVs")
    invoke(ui)
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
    invoke(ui)
    ui.wait_until(lambda: bool(status) and bool(status[-1]))
    ui.key(key)
    ui.wait_until(lambda: bool(seams(suzanne)))
    ui.wait()
    assert len(waiting.found) == 1
    edges = {frozenset(pair) for wire in waiting.found[0].wires for pair in zip(wire.vertices, wire.vertices[1:])}  # noqa: B905
    assert {frozenset(edge) for edge in seams(suzanne)} == edges
    assert suzanne.data.uv_layers


def test_enter_before_anything_is_found_does_nothing(
    ui: driver.Ui, suzanne: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepare, may_end = Suggestion.prepare, threading.Event()

    def slow(self: Suggestion, progress: Callable[[float], bool]) -> None:
        may_end.wait(20.0)
        prepare(self, progress)

    monkeypatch.setattr(Suggestion, "prepare", slow)
    invoke(ui, distortion=40.0)
    ui.key("RET")
    ui.wait(5)
    assert seams(suzanne) == []
    may_end.set()
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)


def test_meanwhile_the_view_can_be_moved_and_nothing_else_done(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting
) -> None:
    distance, vertices, selected = ui.view.view_distance, len(suzanne.data.vertices), suzanne.data.total_vert_sel
    invoke(ui, unwrap=False)
    ui.wheel(True, (0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.key("A")
    ui.key("X")
    ui.wait_until(lambda: bool(waiting.found))
    waiting.end()
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)
    assert ui.view.view_distance != distance
    suzanne.update_from_editmode()
    assert len(suzanne.data.vertices) == vertices
    assert suzanne.data.total_vert_sel == selected


def test_a_mesh_that_is_changed_meanwhile_keeps_what_it_has(
    ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting
) -> None:
    invoke(ui)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
    waiting.end()
    ui.wait_until(lambda: not searches, 60.0)
    assert not edited.covered
    assert seams(suzanne) == []


def test_a_file_may_be_loaded_meanwhile(ui: driver.Ui, suzanne: bpy.types.Object, waiting: Waiting) -> None:
    invoke(ui)
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
    invoke(ui, along="EDGES", unwrap=False)
    ui.wait_until(lambda: bool(waiting.found))
    with ui.override():
        assert bpy.ops.mesh.seamwire_mark(chains=f"{start} {end}") == {"FINISHED"}
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
    invoke(ui)
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
    invoke(ui, distortion=40.0)
    ui.wait_until(lambda: bool(seams(suzanne)), 60.0)
    assert asked[0] == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)
