# SPDX-License-Identifier: GPL-3.0-or-later
"""Time from the tool's start to its first wire, in Blender: ``scripts/bench-blender MESH...`` runs this.

A mesh is a file, or ``suzanne+N``: Blender's monkey subdivided N times.

Each mesh and each way of running gives one line. It has the milliseconds (medians) of each step of the tool before its first wire, and
their sum. It also has the part that is processor time of Blender's own thread, which blocks the interface, and the total memory. The
steps are those of
the tool in the viewport, including the wait between two looks at running work, but without the overlay and Blender's redraw.
"""

import os
import statistics
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import addon_utils
import bpy
import numpy as np
from bench_meshes import load

REPEATS = 5
LARGE = 300_000
"""Faces from which on one round has to do."""


class Watch:
    """Milliseconds between one call and the next: as time passes, and of this thread's work."""

    def __init__(self) -> None:
        self._last = time.perf_counter(), time.thread_time()

    def lap(self) -> tuple[float, float]:
        """Return the time since the last call."""
        now = time.perf_counter(), time.thread_time()
        took, self._last = (now[0] - self._last[0], now[1] - self._last[1]), now
        return 1e3 * took[0], 1e3 * took[1]


def memory() -> float:
    """Return what of this process is in memory, in megabytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def first_wire(obj: bpy.types.Object, along: str) -> dict[str, tuple[float, float]]:
    """Do what the tool does from its start to the first wire; return the milliseconds of each step.

    The first three are for reading the mesh, for starting the computation in other threads, and until a seed can be given. The others are
    from the click to the first wire, from the click to both final wires, and from a move of the cursor to the next wire.
    """
    from seamwire.core.picking.picker import Camera, Picker
    from seamwire.core.sketch.sketch import Sketch
    from seamwire.core.solver.solver import LiveMaker
    from seamwire.mesh import edit_mesh
    from seamwire.terms.options import Options
    from seamwire.tool.chain import TICK

    steps = {}
    watch = Watch()
    edit_mesh.Cage(obj)  # as the tool does
    arrays = edit_mesh.read(obj)
    steps["read"] = watch.lap()
    wires = Sketch(
        LiveMaker(arrays), arrays.points, Options(along=along), edges=arrays.edges, triangles=arrays.triangles
    )
    Picker(arrays).surface_at(Camera(1.0, 1.0, np.eye(4)), obj.matrix_world, (0.5, 0.5))
    steps["begun"] = watch.lap()
    wires.wait()
    steps["ready"] = watch.lap()
    top, bottom = (int(at(arrays.points[:, 2])) for at in (np.argmax, np.argmin))
    beside = next(int(v) for v in arrays.triangles[(arrays.triangles == bottom).any(axis=1)][0] if v != bottom)
    watch.lap()
    wires.start(top)
    wires.hover(bottom)
    while wires.wiring.active is None and wires.computing:
        time.sleep(TICK)  # as the tool waits
        wires.poll()
    steps["shown"] = watch.lap()
    wires.wait()
    steps["final"] = watch.lap()
    wires.hover(beside)
    steps["next"] = watch.lap()
    if wires.wiring.active is None:
        sys.exit(f"No wire leads from the top of {obj.name} to its bottom")
    return steps


def main() -> None:
    """Measure every mesh named on the command line."""
    addon_utils.enable("seamwire", default_set=True)
    for name in sys.argv[sys.argv.index("--") + 1 :]:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("seamwire", default_set=True)
        obj = load(name)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.mode_set(mode="EDIT")
        before = memory()
        for along in ("EDGES", "SURFACE"):
            repeats = REPEATS if len(obj.data.polygons) < LARGE else 1
            runs = [first_wire(obj, along) for _ in range(repeats)]
            steps = {step: [statistics.median(run[step][i] for run in runs) for i in (0, 1)] for step in runs[0]}
            total = statistics.median(sum(took for took, _ in run.values()) for run in runs)
            parts = "  ".join(f"{step} {took:.1f}" for step, (took, _) in steps.items())
            held = "  ".join(f"{step} {own:.1f}" for step, (_, own) in steps.items())
            print(
                f"{Path(name).stem:16} {len(obj.data.polygons):8} faces  {along:8} {total:9.1f} ms:  {parts}\n"
                f"{'':38}Blender's thread:  {held}  memory {memory() - before:.0f} MB",
                flush=True,
            )


main()
