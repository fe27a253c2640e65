# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams are suggested beside the interface, and can be cancelled."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import ui as driver
from desk import leave, undo_steps
from scene import add_suzanne, edit, seams, snapshot
from seamwire.mesh import seam_islands, unwrap, uv_map


@pytest.fixture
def suzanne(ui: driver.Ui) -> Iterator[bpy.types.Object]:
    """Large enough for the planning to take a while."""
    with ui.override():
        obj = add_suzanne(3)
        edit()
        bpy.ops.ed.undo_push(message="Made")
    yield obj
    leave(ui)


def invoke(ui: driver.Ui) -> None:
    with ui.override():
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT") == {"RUNNING_MODAL"}


@pytest.mark.smoke
@pytest.mark.every_blender
def test_seams_come_when_the_planning_has_ended(
    ui: driver.Ui, suzanne: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    invoke(ui)
    assert seams(suzanne) == []
    ui.wait_until(lambda: bool(seams(suzanne)))
    ui.wait()
    assert undo_steps(capfd)[-1] == "Suggest Seamwires"
    with ui.override():
        bpy.ops.ed.undo()
    assert seams(bpy.context.active_object) == []


@pytest.mark.smoke
@pytest.mark.every_blender
def test_escape_leaves_all_as_it_was(
    ui: driver.Ui, suzanne: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    before = undo_steps(capfd)
    invoke(ui)
    ui.key("ESC")
    ui.wait(20)
    assert seams(suzanne) == []
    assert undo_steps(capfd) == before


def test_meanwhile_the_view_can_be_moved_and_nothing_else_done(ui: driver.Ui, suzanne: bpy.types.Object) -> None:
    distance, vertices, selected = ui.view.view_distance, len(suzanne.data.vertices), suzanne.data.total_vert_sel
    invoke(ui)
    ui.wheel(True, (0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.key("A")
    ui.key("X")
    ui.wait_until(lambda: bool(seams(suzanne)))
    assert ui.view.view_distance != distance
    suzanne.update_from_editmode()
    assert len(suzanne.data.vertices) == vertices
    assert suzanne.data.total_vert_sel == selected


def test_a_mesh_that_is_changed_meanwhile_keeps_what_it_has(ui: driver.Ui, suzanne: bpy.types.Object) -> None:
    invoke(ui)
    with ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
    ui.wait(60)
    assert seams(suzanne) == []


def test_a_file_may_be_loaded_meanwhile(ui: driver.Ui, suzanne: bpy.types.Object) -> None:
    invoke(ui)
    with ui.override():
        bpy.ops.wm.read_homefile(app_template="", load_ui=False)
    ui.wait(10)
    assert bpy.context.active_object.name == "Cube"


@pytest.fixture
def unwrappings(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many islands were unwrapped each time."""
    done: list[int] = []

    def counted(*args: object, **options: bool) -> unwrap.Unwrapped:
        result = unwrap_changed(*args, **options)
        done.append(result.islands)
        return result

    unwrap_changed = unwrap.unwrap_changed
    monkeypatch.setattr(unwrap, "unwrap_changed", counted)
    return done


@pytest.mark.parametrize(("limit", "is_unwrapped"), [("STRETCH", False), ("STRETCH", True), ("WORST", True)])
def test_escape_while_islands_are_unwrapped_on_trial_leaves_all_as_it_was(
    ui: driver.Ui, suzanne: bpy.types.Object, unwrappings: list[int], limit: str, is_unwrapped: bool
) -> None:
    if is_unwrapped:
        with ui.override():
            bpy.ops.mesh.seamwire_suggest(limit="ISLANDS", islands=8, unwrap=True)
    before, uvs = snapshot(suzanne), uv_map.read_uvs(suzanne)
    done = len(unwrappings)
    with ui.override():
        options = {"limit": limit, "stretch": 1.03}
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
    ui.wait_until(lambda: len(unwrappings) > done)
    ui.key("ESC")
    ui.wait(20)
    done = len(unwrappings)
    ui.wait(20)
    assert len(unwrappings) == done, "it has ended"
    assert snapshot(suzanne) == before
    after = uv_map.read_uvs(suzanne)
    assert (after is None) if uvs is None else np.array_equal(after, uvs)


def test_islands_are_unwrapped_until_none_is_stretched_more(
    ui: driver.Ui, suzanne: bpy.types.Object, unwrappings: list[int]
) -> None:
    with ui.override():
        options = {"limit": "STRETCH", "stretch": 1.3}
        assert bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
    ui.wait_until(lambda: bool(unwrappings) and unwrappings[-1] == 0, 120.0)
    ui.wait()
    assert len(unwrappings) > 2, "more than one round, and none left at last"
    worst = max(seam_islands.worst_island(suzanne, kind).value for kind in ("ANGLE", "AREA"))
    assert 2.0**worst <= 1.3
