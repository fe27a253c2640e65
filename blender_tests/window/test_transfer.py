# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks are placed, and wires repeated, beside the interface: the view can be moved meanwhile, and Esc changes nothing."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import addon_utils
import bpy
import pytest
import stored
import ui as driver
from desk import leave, undo_steps
from scene import ADDON, add_suzanne, changing, edit, head, mark_wires, seams, snapshot
from seamwire.tool.running import steps as running
from seamwire_networks.repeats import Repeats
from seamwire_networks.transfer import Tracing


class Gate:
    """Keeps transfers from drawing their first wire, and repeats from their first place."""

    def __init__(self) -> None:
        self.has_begun = threading.Event()
        self._may_go_on = threading.Event()

    def guard(self, owner: type, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
        """Let a method wait until the gate is open."""
        method = getattr(owner, name)

        def waiting(*arguments: object) -> object:
            self.wait()
            return method(*arguments)

        monkeypatch.setattr(owner, name, waiting)

    def open(self) -> None:
        """Let wires be drawn."""
        self._may_go_on.set()

    def wait(self) -> None:
        """Wait as a slow search for a wire does."""
        self.has_begun.set()
        self._may_go_on.wait(20.0)


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[Gate]:
    """A gate that is closed."""
    made = Gate()
    made.guard(Tracing, "_best", monkeypatch)
    made.guard(Repeats, "_matched", monkeypatch)
    yield made
    made.open()


@pytest.fixture
def target(ui: driver.Ui, tmp_path: Path) -> Iterator[bpy.types.Object]:
    """A finer Suzanne in edit mode beside a selected one that has wires, and the file net.json of these."""
    with ui.override():
        source = add_suzanne()
        edit()
        a, b, c = head(source, 3)
        mark_wires(chains=f"{a} {b} {c}")
        bpy.ops.mesh.seamwire_save_network(filepath=str(tmp_path / "net.json"))
        bpy.ops.object.mode_set(mode="OBJECT")
        obj = add_suzanne(levels=1)
        source.select_set(True)
        edit()
        bpy.ops.ed.undo_push(message="Made")
    yield obj
    leave(ui)


def begin(ui: driver.Ui, gate: Gate, operator: str = "seamwire_transfer") -> None:
    with ui.override():
        assert getattr(bpy.ops.mesh, operator)("INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
    ui.wait_until(gate.has_begun.is_set)


def mark_on(ui: driver.Ui, target: bpy.types.Object) -> None:
    """Draw a wire on one half of the target."""
    with ui.override():
        mark_wires(chains=" ".join(map(str, head(target, 2))))
        bpy.ops.ed.undo_push(message="Marked")


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("operator", ["seamwire_transfer", "seamwire_repeat"])
def test_escape_ends_the_work_and_leaves_the_mesh_as_it_was(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, capfd: pytest.CaptureFixture[str], operator: str
) -> None:
    if operator == "seamwire_repeat":
        mark_on(ui, target)
    before, steps = snapshot(target), undo_steps(capfd)
    ui.look_from_top(distance=4.0)
    begin(ui, gate, operator)
    rotation = ui.view.view_rotation.copy()
    ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
    ui.key("NUMPAD_1")
    ui.wait(5)
    assert ui.view.view_rotation != rotation, "the window draws and takes keys"
    assert not bpy.ops.mesh.seamwire_suggest.poll()
    ui.key("ESC")
    gate.open()
    ui.wait_until(lambda: not running)
    ui.wait(5)
    assert snapshot(target) == before
    assert undo_steps(capfd) == steps


@pytest.mark.parametrize("addon", [ADDON, f"{ADDON}_networks"])
def test_disabled_meanwhile_it_ends_and_leaves_the_mesh_as_it_was(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, addon: str
) -> None:
    before = snapshot(target)
    begin(ui, gate)
    addon_utils.disable(addon)
    try:
        assert not running
        assert not hasattr(bpy.types, "MESH_OT_seamwire_transfer")
        gate.open()
        ui.wait(5)
        assert snapshot(target) == before
    finally:
        addon_utils.enable(addon)


@pytest.mark.smoke
def test_a_transfer_that_ends_marks_seams_and_one_undo_takes_it_back(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, capfd: pytest.CaptureFixture[str]
) -> None:
    before = snapshot(target)
    begin(ui, gate)
    gate.open()
    ui.wait_until(lambda: not running)
    ui.wait(5)
    assert len(seams(target)) > 20
    assert stored.agree(target)
    assert undo_steps(capfd)[-1] == "Transfer Seamwires"
    with ui.override():
        bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


@pytest.mark.smoke
def test_a_repeat_that_ends_marks_seams_and_one_undo_takes_it_back(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, capfd: pytest.CaptureFixture[str]
) -> None:
    mark_on(ui, target)
    before = seams(target)
    begin(ui, gate, "seamwire_repeat")
    gate.open()
    ui.wait_until(lambda: not running)
    ui.wait(5)
    assert len(seams(target)) > len(before), "on the other half"
    assert stored.agree(target)
    assert undo_steps(capfd)[-1] == "Repeat Seamwires"
    with ui.override():
        bpy.ops.ed.undo()
    assert seams(bpy.context.active_object) == before


@pytest.mark.parametrize("change", ["subdivide", "move"])
def test_a_mesh_that_is_changed_meanwhile_keeps_what_it_has(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, change: str
) -> None:
    begin(ui, gate)
    with ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        if change == "subdivide":
            bpy.ops.mesh.subdivide()
        else:
            with changing(target) as bm:
                bm.verts[0].co.z += 1.0
    gate.open()
    ui.wait_until(lambda: not running)
    assert seams(target) == []


def test_a_wire_that_is_marked_meanwhile_stays(
    ui: driver.Ui, target: bpy.types.Object, gate: Gate, monkeypatch: pytest.MonkeyPatch
) -> None:
    start, end = head(target, 2)
    begin(ui, gate)
    with ui.override():
        mark_wires(chains=f"{start} {end}")
    (marked,) = stored.chains(target)
    gate.open()
    ui.wait_until(lambda: not running)
    stored.forget(monkeypatch)
    found = stored.chains(target)
    assert marked in found and len(found) > 1
    assert stored.agree(target)


@pytest.mark.smoke
@pytest.mark.parametrize("end", ["ESC", "wait"])
def test_a_file_that_was_chosen_is_placed_beside_the_interface_too(
    ui: driver.Ui,
    target: bpy.types.Object,
    gate: Gate,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    end: str,
) -> None:
    monkeypatch.setattr(bpy.context.preferences.view, "filebrowser_display_type", "SCREEN")
    before = snapshot(target)
    with ui.override():
        assert bpy.ops.mesh.seamwire_load_network("INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
    ui.wait(5)
    (browser,) = (area for area in ui.window.screen.areas if area.type == "FILE_BROWSER")
    parameters = browser.spaces.active.params
    parameters.directory, parameters.filename = bytes(tmp_path) + b"/", "net.json"
    with bpy.context.temp_override(window=ui.window, area=browser, region=browser.regions[-1]):
        bpy.ops.file.execute()
    ui.wait_until(gate.has_begun.is_set)
    assert seams(target) == []
    driver.Ui.__init__(ui)
    ui.wait(3)
    if end == "ESC":
        ui.key("ESC")
    gate.open()
    ui.wait_until(lambda: not running)
    ui.wait(5)
    if end == "ESC":
        assert snapshot(target) == before
        return
    assert len(seams(target)) > 20
    assert undo_steps(capfd)[-1] == "Load Seamwire Network"
