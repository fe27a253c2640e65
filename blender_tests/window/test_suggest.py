# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams are suggested beside the interface, and can be cancelled."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import pytest
import ui as driver
from desk import leave, undo_steps
from scene import add_suzanne, edit, seams


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


def test_escape_leaves_all_as_it_was(
    ui: driver.Ui, suzanne: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    before = undo_steps(capfd)
    invoke(ui)
    ui.key("ESC")
    ui.wait(20)
    assert seams(suzanne) == []
    assert undo_steps(capfd) == before


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
