# SPDX-License-Identifier: GPL-3.0-or-later
"""The heat method beside exact distances, as the tables of docs/benchmarks/exactness.md.

    python native/bench/heat.py MESH... [--anisotropy A] [--repeats N] [--seeds N]

MESH is a mesh file, or a folder of them. Needs seamwire_core on the path. Where potpourri3d can be imported, its heat method runs
too, in the Euclidean metric. It gets the same triangles and seeds, and one thread.

Prints a row of a Markdown table for each mesh and metric. Times are processor time: to prepare a method on an embedding, and the median
of a solve. Errors are relative to the exact distances on the same embedding: the mean, and the largest.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import seamwire_core as sw
from numpy.typing import NDArray

try:
    import potpourri3d
except ImportError:
    potpourri3d = None

Floats = NDArray[np.float64]
Solve = Callable[[int], Floats]


class Measured(NamedTuple):
    """Seconds of processor time, and the distances from each seed."""

    prepared: float
    solved: float
    fields: list[Floats]


def measure(prepare: Callable[[], Solve], seeds: list[int], repeats: int) -> Measured:
    """Return the medians of preparing and of a solve. ``prepare`` returns what solves."""
    prepared, solved, fields = [], [], []
    for _ in range(repeats):
        start = time.process_time()
        solve = prepare()
        prepared.append(time.process_time() - start)
    for seed in seeds:
        for _ in range(repeats):
            start = time.process_time()
            field = solve(seed)
            solved.append(time.process_time() - start)
        fields.append(np.array(field))
    return Measured(statistics.median(prepared), statistics.median(solved), fields)


def measure_own(embed: Callable[[], sw.Embedding], method: str, seeds: list[int], repeats: int) -> Measured:
    """Return the times of one of our methods. Preparing is a first field less a solve, on a new embedding each time."""
    embeddings = [embed() for _ in range(repeats)]
    first = measure(lambda: first_solver(embeddings.pop(), method), seeds, repeats)
    return first._replace(prepared=max(first.prepared - first.solved, 0.0))


def first_solver(embedding: sw.Embedding, method: str) -> Solve:
    """Return what solves on an embedding whose solver is built."""
    sw.distance_field(embedding, 0, method=method)
    return lambda seed: sw.distance_field(embedding, seed, method=method).distances


def errors(measured: Measured, exact: Measured) -> tuple[float, float]:
    """Return the mean and the largest error relative to exact distances, over all seeds."""
    every = []
    for mine, right in zip(measured.fields, exact.fields, strict=True):
        known = np.isfinite(right) & (right > 0)
        every.append(np.abs(mine[known] - right[known]) / right[known])
    error = np.concatenate(every)
    return float(error.mean()), float(error.max())


def cells(measured: Measured, exact: Measured) -> str:
    """Return the cells of an approximate method."""
    mean, most = errors(measured, exact)
    return f"{1e3 * measured.prepared:.0f} / {1e3 * measured.solved:.1f} ms | {1e2 * mean:.2f} / {1e2 * most:.0f} %"


def compare(file: Path, options: argparse.Namespace) -> None:
    """Print the rows of a mesh."""
    surface = sw.read_mesh(file).surface()
    points, triangles = np.array(surface.points), np.array(surface.triangles)
    curvature = sw.principal_curvatures(surface)
    random = np.random.default_rng(0)
    seeds = [int(v) for v in random.choice(np.unique(triangles), options.seeds, replace=False)]
    metrics = {
        "Euclidean": sw.euclidean_metric(surface, curvature),
        "M_min": sw.feature_metric(surface, curvature, follow="min", max_anisotropy=options.anisotropy),
        "M_max": sw.feature_metric(surface, curvature, follow="max", max_anisotropy=options.anisotropy),
    }
    for name, metric in metrics.items():

        def embed(metric: sw.Metric = metric) -> sw.Embedding:
            return sw.embed(surface, metric, max_error=0)

        exact = measure_own(embed, "exact", seeds, options.repeats)
        heat = measure_own(embed, "heat", seeds, options.repeats)
        peer = " | "
        if potpourri3d is not None and name == "Euclidean":
            peer = cells(
                measure(
                    lambda: potpourri3d.MeshHeatMethodDistanceSolver(points, triangles).compute_distance,
                    seeds,
                    options.repeats,
                ),
                exact,
            )
        print(
            f"| {file.stem}, {name} ({len(embed().triangles):,}) | {1e3 * exact.prepared:.0f} / {1e3 * exact.solved:.1f} ms "
            f"| {cells(heat, exact)} | {peer} |",
            flush=True,
        )


def main() -> None:
    """Measure the meshes named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--anisotropy", type=float, default=20.0, help="the largest anisotropy of M_min and M_max")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seeds", type=int, default=5)
    options = parser.parse_args()
    print(
        "| mesh, metric (triangles) | exact: prepare / solve | heat: prepare / solve | mean / largest error "
        "| potpourri3d: prepare / solve | mean / largest error |\n|---|---|---|---|---|---|"
    )
    for given in options.meshes:
        files = (
            [given] if given.is_file() else sorted(p for p in given.iterdir() if p.suffix.lower() in (".obj", ".off"))
        )
        for file in files:
            compare(file, options)


if __name__ == "__main__":
    main()
