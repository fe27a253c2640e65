# SPDX-License-Identifier: GPL-3.0-or-later
"""Time from the tool's start to its first wire, in Blender: ``scripts/bench-blender MESH...`` runs this.

A mesh is a file, or ``suzanne+N``: Blender's monkey subdivided N times.

One line a mesh and a way of running: what the tool does before its first wire, step by step, in milliseconds (medians), and their sum.
The steps are those of the tool in the viewport, but for the overlay and Blender's own redraw.
"""

import statistics
import sys
import time
from pathlib import Path

import addon_utils
import bpy
import numpy as np

REPEATS = 5
LARGE = 300_000
"""Faces from which on two rounds have to do."""
IMPORTERS = {
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".ply": lambda path: bpy.ops.import_mesh.ply(filepath=path),
    ".stl": lambda path: bpy.ops.import_mesh.stl(filepath=path),
}


class Watch:
    """Milliseconds between one call and the next."""

    def __init__(self) -> None:
        self._last = time.perf_counter()

    def lap(self) -> float:
        """Return the time since the last call."""
        now = time.perf_counter()
        took, self._last = now - self._last, now
        return 1e3 * took


def first_wire(obj: bpy.types.Object, along: str) -> dict[str, float]:
    """Do what the tool does from its start to the first wire; return the milliseconds of each step."""
    from seamwire import board, edit_mesh, picking, session

    steps = {}
    watch = Watch()
    cage = edit_mesh.Cage(obj)
    arrays = edit_mesh.read(obj)
    steps["read"] = watch.lap()
    wires = session.Session(board.live_maker(arrays), arrays.points, along)
    steps["surface"] = watch.lap()
    picking.Picker(cage.bm, arrays).depth(picking.View(1.0, 1.0, np.eye(4)), obj.matrix_world, (0.5, 0.5))
    steps["picker"] = watch.lap()
    wires.wait()
    steps["metrics"] = watch.lap()
    wires.start(0)
    wires.wait()
    steps["seed"] = watch.lap()
    wires.hover(len(arrays.points) // 2)
    steps["wire"] = watch.lap()
    if wires.active is None:
        sys.exit(f"No wire leads from vertex 0 to vertex {len(arrays.points) // 2} of {obj.name}")
    return steps


def load(name: str) -> bpy.types.Object:
    """Add what is named to the scene."""
    if not name.startswith("suzanne+"):
        IMPORTERS[Path(name).suffix.lower()](name)
        return bpy.context.selected_objects[0]
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = int(name.split("+")[1])
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj


def main() -> None:
    """Measure every mesh named on the command line."""
    addon_utils.enable("seamwire", default_set=True)
    for name in sys.argv[sys.argv.index("--") + 1 :]:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("seamwire", default_set=True)
        obj = load(name)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.mode_set(mode="EDIT")
        for along in ("EDGES", "SURFACE"):
            repeats = REPEATS if len(obj.data.polygons) < LARGE else 2
            runs = [first_wire(obj, along) for _ in range(repeats)]
            steps = {step: statistics.median(run[step] for run in runs) for step in runs[0]}
            total = statistics.median(sum(run.values()) for run in runs)
            parts = "  ".join(f"{step} {took:.1f}" for step, took in steps.items())
            print(
                f"{Path(name).stem:24} {len(obj.data.polygons):8} faces  {along:8} {total:9.1f} ms:  {parts}",
                flush=True,
            )


main()
