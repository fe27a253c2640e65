# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing of two hundred wires, saved, and Blender killed at a random moment: what was saved is there, seams and network."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import pytest
import ui as driver
from scene import ADDON, add_grid, chain, edit, mark_wires, seams
from seamwire.view.edited_objects import edited

pytestmark = pytest.mark.oldest_and_newest

SIDE = 41
DRAW = """
import os, sys, time
sys.path.insert(0, os.environ["SEAMWIRE_TESTS"])
import addon_utils, bpy
from pathlib import Path
from scene import add_grid
seamwire = addon_utils.enable(os.environ["SEAMWIRE_NAME"], default_set=True)
path = Path(os.environ["SEAMWIRE_FILE"])
add_grid({side})
bpy.ops.object.mode_set(mode="EDIT")
for number in range(200):
    row, half = number % {side}, number // {side}
    first = row * {side} + 8 * half
    seamwire.mark(bpy.context.object, [[first, first + 8]])
    if number % 20 == 19:
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        path.with_suffix(".count").write_text(str(number + 1))
time.sleep(60)
"""


@pytest.mark.parametrize("seed", [1, 2])
def test_what_was_saved_of_two_hundred_wires_is_there_after_a_kill(ui: driver.Ui, tmp_path: Path, seed: int) -> None:
    path = tmp_path / "wires.blend"
    script = tmp_path / "draw.py"
    script.write_text(DRAW.format(side=SIDE))
    environment = {
        **os.environ,
        "SEAMWIRE_TESTS": str(Path(__file__).parent.parent),
        "SEAMWIRE_NAME": ADDON,
        "SEAMWIRE_FILE": str(path),
    }
    blender = subprocess.Popen(
        [bpy.app.binary_path, "--background", "--factory-startup", "--python-exit-code", "3", "--python", str(script)],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=sys.stderr,
        start_new_session=True,
    )
    try:
        dice = random.Random(seed)
        enough = dice.choice([60, 120, 200])
        counted = path.with_suffix(".count")
        end = time.monotonic() + 240.0
        while not (counted.exists() and counted.read_text() and int(counted.read_text()) >= enough):
            assert blender.poll() is None, "it ended by itself"
            assert time.monotonic() < end
            time.sleep(0.05)
        time.sleep(dice.random() * 0.5)
    finally:
        os.killpg(blender.pid, signal.SIGKILL)
        blender.wait()
    saved = int(counted.read_text())
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    ui.wait(4)
    obj = bpy.context.view_layer.objects.active
    assert obj.mode == "EDIT"
    session = edited.of(obj).session
    assert saved <= len(session.wires) <= saved + 20
    rows = [number % SIDE * SIDE + 8 * (number // SIDE) for number in range(len(session.wires))]
    expected = sorted({edge for first in rows for edge in chain(*range(first, first + 9))})
    assert seams(obj) == expected
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    ui.wait(4)


def test_blender_saves_what_was_drawn_by_itself_once_edit_mode_is_left(ui: driver.Ui, tmp_path: Path) -> None:
    """Blender's own autosave has the mesh from before edit mode, and nothing of ours keeps it from running."""
    files = bpy.context.preferences.filepaths
    before = files.temporary_directory, files.use_auto_save_temporary_files, files.auto_save_time
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "drawn.blend"))
    obj = add_grid(9)
    ui.wait()
    with ui.override():
        edit()
        mark_wires(chains="36 44")
    edited.of(obj)
    with ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.ed.undo_push(message="Left edit mode")  # as Blender does where a person leaves it
        edit()
    try:
        files.temporary_directory = str(tmp_path)
        files.auto_save_time = 1
        files.use_auto_save_temporary_files = True
        ui.wait_until(lambda: any(tmp_path.glob("drawn_*_autosave.blend")), seconds=100.0)
        saved = next(tmp_path.glob("drawn_*_autosave.blend"))
        with bpy.data.libraries.load(str(saved), link=False) as (inside, wanted):
            wanted.meshes = inside.meshes
        marked = [sum(edge.use_seam for edge in mesh.edges) for mesh in wanted.meshes]
        assert 8 in marked
        assert any(mesh.seamwire_wires for mesh in wanted.meshes)
    finally:
        files.temporary_directory, files.use_auto_save_temporary_files, files.auto_save_time = before
