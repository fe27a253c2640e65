# SPDX-License-Identifier: GPL-3.0-or-later
"""The interpreter ends while threads of it are in the library: quietly, in the middle of any work."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys, threading, time
import meshes
import numpy as np
import seamwire_core as sw

def grid(n):
    return sw.Surface(*meshes.grid(n))

class TornDownSlowly:
    # Python is ending for so long, and threads that want to come back do so now.
    def __del__(self, sleep=time.sleep):
        sleep({teardown})

sys.kept = TornDownSlowly()
inside = threading.Event()

def work():
    {prepare}
    inside.set()
    while True:
        {call}

threads = [threading.Thread(target=work, daemon=True) for _ in range({threads})]
for thread in threads:
    thread.start()
inside.wait()
time.sleep({delay})
"""

WORK = {
    "a field": (
        "s = grid(60); e = sw.embed(s, sw.euclidean_metric(s, sw.principal_curvatures(s)), max_error=0)",
        "sw.distance_field(e, 0)",
    ),
    "a field that tells its progress": (
        "s = grid(60); e = sw.embed(s, sw.euclidean_metric(s, sw.principal_curvatures(s)), max_error=0)",
        "sw.distance_field(e, 0, progress=lambda fraction: time.sleep(0.001))",
    ),
    "an embedding": (
        "s = grid(60); m = sw.campen_metric(s, sw.principal_curvatures(s), alpha=100)",
        "sw.embed(s, m, progress=lambda fraction: None, max_error=0)",
    ),
    "what cannot be stopped": ("s = grid(300)", "sw.face_segments(s, s.edges[::2])"),
    "waiting": ("s = grid(60); w = sw.LiveWire(s)", "w.seed(0); w.wait()"),
    "building a surface": ("p, t = meshes.grid(300)", "sw.LiveWire(p, t).wait_for_surface()"),
    "giving up live wires": ("p, t = meshes.grid(300)", "sw.LiveWire(p, t).seed(0)"),
    "flattening": ("p, t = meshes.torus(60, 40)", "sw.flatten(p, t)"),
    "rays": ("p, t = meshes.grid(60)", "sw.RayTree(p, t).wait()"),
    "picker": ("p, t = meshes.grid(60)", "sw.Picker(p, t, t[:, 0], t[:, :2], np.eye(3)).wait()"),
}


def quit_during(
    prepare: str, call: str, delay: float = 0.02, teardown: float = 0.2, threads: int = 2
) -> subprocess.CompletedProcess[str]:
    program = PROGRAM.format(prepare=prepare, call=call, delay=delay, teardown=teardown, threads=threads)
    return subprocess.run(
        [sys.executable, "-c", program],
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


@pytest.mark.parametrize("name", WORK)
def test_threads_in_long_work(name: str) -> None:
    for i in range(4):
        ended = quit_during(*WORK[name], delay=0.004 * i)
        assert (ended.returncode, ended.stderr) == (0, "")


def test_a_callback_that_python_ends_in_the_middle() -> None:
    """The callback still sleeps when nobody waits for it any more, and wakes when it may not run Python any more."""
    prepare, _ = WORK["a field"]
    call = "sw.distance_field(e, 0, progress=lambda fraction: time.sleep(1.3))"
    ended = quit_during(prepare, call, delay=0.2, teardown=1.5)
    assert (ended.returncode, ended.stderr) == (0, "")


NUMPY = {
    "the first array of all": (
        "p, t = meshes.grid(60); lib = np.lib; version = lib.NumpyVersion;"
        " lib.NumpyVersion = lambda text: (time.sleep(0.3), version(text))[1]",
        "sw.RayTree(p, t)",
    ),
    "numbers of another width": ("p, t = meshes.grid(300); p = p.astype('f4')", "sw.RayTree(p, t)"),
}


@pytest.mark.parametrize("name", NUMPY)
def test_threads_that_hand_over_arrays(name: str) -> None:
    """NumPy lets go of the GIL in between, and so does pybind11 when it looks for NumPy's functions."""
    for _ in range(3):
        ended = quit_during(*NUMPY[name], delay=0.05, teardown=0.5, threads=4)
        assert (ended.returncode, ended.stderr) == (0, "")


def test_work_that_returns_when_the_wait_for_it_is_over() -> None:
    """Threads that come back when Python is being torn down sleep until the process ends."""
    call = "sw.RayTree(p, t).wait()"  # which nothing stops
    ended = quit_during("p, t = meshes.grid(1000)", call, delay=0.05, teardown=3.0, threads=4)
    assert (ended.returncode, ended.stderr) == (0, "")


def test_the_thread_that_ends_python_may_go_on_in_the_library() -> None:
    """Handlers that were registered before the module's run after it."""
    program = """
import atexit
@atexit.register
def last():
    surface = sw.Surface(*meshes.grid(4))
    print(sw.LiveWire(surface).wait(), len(sw.principal_curvatures(surface).k1))
    print(sw.edge_wires(surface, metric, 0, progress=print).trace(1).vertices)
import meshes
import seamwire_core as sw
grid = sw.Surface(*meshes.grid(4))
metric = sw.euclidean_metric(grid, sw.principal_curvatures(grid))
"""
    ended = subprocess.run(
        [sys.executable, "-c", program],
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert ended.stdout.startswith("True 25\n")
    assert ended.stdout.endswith("[0 1]\n")


def test_a_thread_that_is_joined_at_the_end_is_told_to_leave() -> None:
    """It is neither kept in the library nor let into it again, so that the join returns."""
    program = """
import atexit, threading
@atexit.register
def join():
    thread.join()
    print(*seen, type(left).__name__)
import meshes
import seamwire_core as sw
seen, left, begun = [], None, threading.Event()
def work():
    global left
    surface = sw.Surface(*meshes.grid(60))
    metric = sw.campen_metric(surface, sw.principal_curvatures(surface), alpha=100)
    try:
        while True:
            begun.set()
            sw.embed(surface, metric, max_error=0)
    except SystemExit as error:
        left = error
    try:
        sw.principal_curvatures(surface)
    except SystemExit:
        seen.append("refused")
thread = threading.Thread(target=work, daemon=True)
thread.start()
begun.wait()
"""
    ended = subprocess.run(
        [sys.executable, "-c", program],
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert ended.stdout == "refused SystemExit\n"
