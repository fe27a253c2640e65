# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of finding what is under the cursor: ``python picking.py``, without Blender.

The meshes are grids of quads with 50 seeds and a wire, seen from above. Each line is about one mesh. It gives the milliseconds until the
first snap and until the threads are done. Then come the medians for a snap along edges, for one across the surface, and for both with
X-ray, while the view moves.
"""

import statistics
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.wires import Wire
from seamwire.core.picking.picker import Camera, Picker
from seamwire.terms.options import Options

SIDES = (317, 513, 1025)
"""Vertices along a side: a hundred thousand, a quarter of a million and a million quads."""
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

    def snap(self, cursor: tuple[float, float], across: bool, xray: bool = False, turn: float = 0.0) -> None:
        """Find what is under the cursor of an object that was moved a little."""
        matrix = np.eye(4)
        matrix[0, 3] = turn
        strength = self.strength if across else None
        options = {"vertices_only": across, "session": self.session, "strength": strength, "xray": xray}
        self.picker.snap(VIEW, matrix, cursor, **options)

    def time(self, across: bool, xray: bool = False) -> float:
        """Return the median of the milliseconds of a snap."""
        found = []
        for number, cursor in enumerate(CURSORS):
            begun = time.perf_counter()
            self.snap(cursor, across, xray, 1e-4 * number if xray else 0.0)
            found.append(1e3 * (time.perf_counter() - begun))
        return statistics.median(found)


def main() -> None:
    """Measure and print."""
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
        times = [snaps.time(across, xray) for xray in (False, True) for across in (False, True)]
        print(
            f"{(side - 1) ** 2:8} quads: first snap {first:.1f}, ready {ready:.0f}, along edges {times[0]:.2f}, across {times[1]:.2f}, "
            f"with X-ray {times[2]:.2f} and {times[3]:.2f} ms",
            flush=True,
        )


if __name__ == "__main__":
    main()
