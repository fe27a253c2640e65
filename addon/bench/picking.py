# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of finding what is under the cursor: ``python picking.py``, without Blender.

The meshes are grids of quads with 50 seeds and a wire, seen from above. Each line is about one mesh. It gives the milliseconds until the
first snap and until the threads are done. Then come the medians for a snap along edges and for one across the surface. The last numbers are
the most calls that a snap makes and the most bytes it takes. The program ends with an error if a snap makes more calls on a larger mesh.
"""

import statistics
import sys
import time
import tracemalloc
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType, SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.wires import Wire
from seamwire.core.picking.camera import Camera
from seamwire.core.picking.picker import Picker
from seamwire.terms.options import Options

SIDES = (317, 513, 1025)
"""Vertices along a side: a hundred thousand, a quarter of a million and a million quads."""
COMPARED = SIDES[1:]
"""On these, more vertices lie within reach than a snap looks at."""
VIEW = Camera(400.0, 400.0, np.diag([0.8, 0.8, -0.1, 1.0]))
CURSORS = [(120.0 + 4.0 * step, 131.0 + 3.0 * step) for step in range(40)]


@dataclass
class ShownSession:
    """The part of a session that a picker reads. A real one would compute wires in threads, and disturb the times."""

    placed: tuple[int, ...]
    wires: tuple[Wire, ...]
    cursor: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(moved=()))
    options: Options = field(default_factory=Options)

    @property
    def network(self) -> tuple[object, ...]:
        """The seeds and wires."""
        return self.placed, self.wires

    def seeds(self) -> list[int]:
        """Return the seeds."""
        return list(self.placed)


def grid(side: int) -> Arrays:
    """Return a square of quads."""
    steps = np.linspace(-1.0, 1.0, side)
    points = np.stack([np.tile(steps, side), np.repeat(steps, side), np.zeros(side * side)], axis=1)
    numbers = np.arange(side * side, dtype=np.int32).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]))
    across = np.stack([numbers[:, :-1].ravel(), numbers[:, 1:].ravel()], axis=1)
    up = np.stack([numbers[:-1].ravel(), numbers[1:].ravel()], axis=1)
    none = np.empty((0, 2), dtype=np.int32)
    triangles = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    polygons = np.repeat(np.arange(len(a), dtype=np.int32), 2)
    return Arrays(points, triangles, polygons, np.concatenate([across, up]), np.eye(3), none, none)


class Snaps:
    """Snaps on one mesh."""

    def __init__(self, arrays: Arrays) -> None:
        count = len(arrays.points)
        wire = Wire("EDGES", tuple(range(60)), arrays.points[:60], 0, 59)
        self.session = ShownSession(tuple(range(0, count, count // 50)), (wire,))
        self.strength = np.random.default_rng(1).random(count)
        self.picker = Picker(arrays)

    def snap(self, cursor: tuple[float, float], across: bool) -> None:
        """Find what is under the cursor."""
        strength = self.strength if across else None
        self.picker.snap(VIEW, np.eye(4), cursor, vertices_only=across, session=self.session, strength=strength)

    def times(self, across: bool) -> list[float]:
        """Return the milliseconds of each snap."""
        found = []
        for cursor in CURSORS:
            begun = time.perf_counter()
            self.snap(cursor, across)
            found.append(1e3 * (time.perf_counter() - begun))
        return found

    def work(self) -> tuple[int, int]:
        """Return the most calls and the most bytes at a time of a snap."""
        calls, sizes = [], []

        def called(_frame: FrameType, event: str, _what: object) -> None:
            calls[-1] += event in {"call", "c_call"}

        for cursor in CURSORS:
            calls.append(0)
            tracemalloc.start()
            sys.setprofile(called)
            try:
                self.snap(cursor, across=True)
            finally:
                sys.setprofile(None)
                sizes.append(tracemalloc.get_traced_memory()[1])
                tracemalloc.stop()
        return max(calls), max(sizes)


def main() -> None:
    """Measure and print."""
    most_calls = {}
    for side in SIDES:
        arrays = grid(side)
        begun = time.perf_counter()
        snaps = Snaps(arrays)
        snaps.snap(CURSORS[0], across=False)
        first = 1e3 * (time.perf_counter() - begun)
        snaps.picker.wait()
        ready = 1e3 * (time.perf_counter() - begun)
        # The first snap across the surface reads what is kept.
        snaps.snap(CURSORS[0], across=True)
        along, across = (statistics.median(snaps.times(way)) for way in (False, True))
        most_calls[side], size = snaps.work()
        print(
            f"{(side - 1) ** 2:8} quads: first snap {first:.1f}, ready {ready:.0f}, along edges {along:.2f}, "
            f"across {across:.2f} ms; {most_calls[side]} calls, {size} bytes",
            flush=True,
        )
    one, other = (most_calls[side] for side in COMPARED)
    if other > one:
        sys.exit(f"A snap makes {other} calls on the larger mesh, and {one} on the smaller one")


if __name__ == "__main__":
    main()
