# SPDX-License-Identifier: GPL-3.0-or-later
"""The time that `flatten` takes, beside libigl's SLIM.

    python native/bench/flatten.py [--repeats N] [MESH...]      (pip install libigl for the peer)

Without meshes (OBJ, OFF), jittered grids with bumps of 7,938, 20,000 and 99,458 triangles. A mesh has to be a disc. Ours runs until a step
promises less than 1e-6. SLIM (Rabinovich et al., Scalable locally injective mappings, 2017) minimizes the same energy from libigl's Tutte
embedding, until it is within .001 of ours or for 100 iterations. Times are the best of the repeats, in seconds of the clock, with the
embedding; per step: all of that over the steps. E_d: `measure_map`, mean over the area, 4 for an isometry.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import seamwire_core as sw

try:
    import igl
except ImportError:
    igl = None

sys.path.insert(0, str(Path(__file__).parents[2] / "docs/figures"))
from figure_models import read

_CLOSE, _MOST_ITERATIONS = 1e-3, 100
Mesh = tuple[np.ndarray, np.ndarray]


def main() -> None:
    """Print a line for each mesh."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    meshes = {path.stem: read(path) for path in options.meshes} or {
        f"bumps {n} x {n}": bumps(n) for n in (63, 100, 223)
    }
    print(
        "mesh                triangles |  ours s  steps  ms/step     E_d |  SLIM s  iterations  ms/step     E_d | SLIM / ours"
    )
    for name, (points, triangles) in meshes.items():
        ours, flat = best_of(options.repeats, lambda points=points, triangles=triangles: sw.flatten(points, triangles))
        steps = int(flat.steps[0])
        line = f"{name:20}{len(triangles):9} |{ours:8.3f}{steps:7}{1e3 * ours / steps:9.2f}{flat.energy:8.4f} |"
        if igl is None:
            print(line + "  libigl is not installed")
            continue
        seconds, (iterations, energy) = best_of(
            options.repeats,
            lambda points=points, triangles=triangles, goal=flat.energy: slim(points, triangles, goal + _CLOSE),
        )
        seconds -= measured_in(points, triangles, flat) * iterations
        per_step = 1e3 * seconds / iterations
        print(f"{line}{seconds:8.3f}{iterations:12}{per_step:9.2f}{energy:8.4f} |{seconds / ours:12.1f}")


def bumps(n: int) -> Mesh:
    """Return a square of n x n cells with hills of .15 and inner vertices moved by a fifth of a cell."""
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    move = np.random.default_rng(1).uniform(-0.2, 0.2, (2, n + 1, n + 1))
    move[:, [0, -1], :] = move[:, :, [0, -1]] = 0
    x, y = (x + move[0]).ravel() / n, (y + move[1]).ravel() / n
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    a, b, c, d = first, first + 1, first + n + 1, first + n + 2
    triangles = np.stack([a, b, d, a, d, c], 1).reshape(-1, 3)
    return np.stack([x, y, 0.15 * np.sin(9 * x) * np.cos(7 * y)], 1), triangles.astype(np.int32)


def best_of(repeats: int, work: Callable[[], object]) -> tuple[float, object]:
    """Return the shortest time and the last result."""
    best = np.inf
    for _ in range(repeats):
        before = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - before)
    return best, result


def measured_in(points: np.ndarray, triangles: np.ndarray, flat: sw.Flattening) -> float:
    """Return the time that the comparison takes after each iteration of SLIM, which is not SLIM's."""
    return best_of(3, lambda: sw.measure_map(points, triangles, flat.uvs))[0]


def slim(points: np.ndarray, triangles: np.ndarray, goal: float) -> tuple[int, float]:
    """Return how many iterations SLIM takes to get below an energy, and the energy."""
    loop = igl.boundary_loop(triangles)
    circle = igl.map_vertices_to_circle(points, loop)
    start = igl.harmonic(points, triangles, loop, circle, 1)
    area = np.linalg.norm(np.cross(*np.diff(points[triangles], axis=1).transpose(1, 0, 2)), axis=1).sum() / 2
    start = np.asfortranarray(start * np.sqrt(area / np.pi))
    data = igl.slim_precompute(
        np.asfortranarray(points), np.asfortranarray(triangles), start, igl.MappingEnergyType.SYMMETRIC_DIRICHLET,
        np.zeros(0, np.int32), np.zeros((0, 2), order="F"), 0.0,
    )  # fmt: skip
    iterations, energy = 0, np.inf
    while energy > goal and iterations < _MOST_ITERATIONS:
        uvs = igl.slim_solve(data, 1)[:, :2]
        energy = sw.measure_map(points, triangles, uvs[triangles]).energy
        iterations += 1
    return iterations, energy


if __name__ == "__main__":
    main()
