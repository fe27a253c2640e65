# SPDX-License-Identifier: GPL-3.0-or-later
"""Embedding by global optimization beside ours: the paper's own comparison (Section 4.2, Figure 7, column "Opt" of Figure 8).

    python native/bench/global_optimization.py [--anisotropy A]... MESH...

Campen, Heistermann and Kobbelt (Practical anisotropic geodesy, 2013) make triangles valid without adding triangles. They change edge
lengths as little as possible, by least squares under the triangle inequalities. Here OSQP solves that (Stellato et al., OSQP: an operator
splitting solver for quadratic programs, 2020).

Prints a line for each mesh and A. It has the seconds of that and of `embed` (medians of three) and the changes of the lengths. From five
seeds, it has the differences of distances at the vertices from ours, and the distances of wires to 40 vertices from ours, in mean edge
lengths. With ``--arrays IN.npz OUT.npz`` a mesh and its metric's lengths are read, and the changed ones written, with the seconds.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
import osqp
import seamwire_core as sw
from scipy import sparse

sys.path.insert(0, str(Path(__file__).parents[2] / "docs/figures"))
sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from figure_models import Model, read
from seamwire.core.base.geometry import nearest_on_segments  # knows no Blender

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Values = NDArray[np.float64]
    Integers = NDArray[np.int32]

_MARGIN = 1e-3
"""By how much two sides are longer than the third at least, as part of that: with nothing to spare, rounding would break triangles."""
_PRECISION = 1e-6
_SEEDS, _WIRES = 5, 40


def main() -> None:
    """Print a line a mesh and anisotropy, or optimize the lengths of a file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--anisotropy", type=float, action="append", help="10, 20 and 30 unless told")
    parser.add_argument("--arrays", nargs=2, type=Path, metavar=("IN", "OUT"))
    options = parser.parse_args()
    if options.arrays:
        with np.load(options.arrays[0]) as data:
            seconds, lengths = _timed(lambda: optimized(data["triangles"], data["edges"], data["lengths"]), 1)
        np.savez(options.arrays[1], lengths=lengths, seconds=seconds)
    for path in options.meshes:
        model = Model(sw, path.stem, *read(path))
        for anisotropy in options.anisotropy or (10.0, 20.0, 30.0):
            print(
                f"{path.stem:12} {len(model.triangles):7} A {anisotropy:g}: {compared(model, anisotropy)}", flush=True
            )


def optimized(triangles: Integers, edges: Integers, lengths: Values) -> Values:
    """Return lengths that are as near as can be to others by least squares, and make every triangle valid.

    Parameters
    ----------
    triangles, edges
        (m, 3) and (e, 2), all sides of triangles among these.
    lengths
        (e,) of the edges, positive.

    Raises
    ------
    osqp.OSQPException
        Where the solver finds none.
    """
    count = int(triangles.max()) + 1
    keys = edges.min(axis=1).astype(np.int64) * count + edges.max(axis=1)
    order = np.argsort(keys)
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2).astype(np.int64)
    sides = order[np.searchsorted(keys[order], ends[..., 0] * count + ends[..., 1])]
    unit = float(lengths.mean())
    # A row for each side of each triangle: the two others less this one.
    signs = np.tile((1.0 - 2.0 * np.eye(3)).reshape(-1), len(triangles))
    columns = np.tile(sides, (1, 3)).reshape(-1)
    rows = np.repeat(np.arange(sides.size), 3)
    inequalities = sparse.csc_matrix((signs, (rows, columns)), shape=(sides.size, len(edges)))
    least = _MARGIN * np.minimum(lengths[sides].reshape(-1) / unit, 1.0)
    solver = osqp.OSQP()
    solver.setup(
        sparse.identity(len(edges), format="csc"), -lengths / unit, inequalities, least, np.full(sides.size, np.inf),
        eps_abs=_PRECISION, eps_rel=_PRECISION, max_iter=100_000, polishing=False, verbose=False,
    )  # fmt: skip
    result = solver.solve(raise_error=True)
    return result.x * unit


def compared(model: Model, anisotropy: float) -> str:
    """Return what both ways make of a metric, in a line."""
    surface, metric = model.surface, model.metric("feature", max_anisotropy=anisotropy)
    lengths = sw.metric_lengths(surface, metric)
    taken, changed = _timed(lambda: optimized(model.triangles, surface.edges, lengths))
    ours_taken, ours = _timed(lambda: sw.embed(surface, metric, max_error=0))
    plain = model.embed(model.metric("euclidean"))
    of_edge = {pair: length for pair, length in zip(map(tuple, surface.edges.tolist()), changed.tolist(), strict=True)}
    theirs = plain.with_lengths([of_edge[min(a, b), max(a, b)] for a, b in plain.edges.tolist()])
    ends = model.points[surface.edges]
    edge = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())
    draw = np.random.default_rng(1)
    off, apart = [], []
    for seed in draw.choice(np.unique(model.triangles), _SEEDS, replace=False).tolist():
        fields = [sw.distance_field(one, seed) for one in (ours, theirs)]
        near, far = (field.distances[: len(model.points)] for field in fields)
        both = np.isfinite(near) & np.isfinite(far) & (near > 0.0)
        off.append(np.abs(far[both] / near[both] - 1.0))
        for target in draw.choice(np.flatnonzero(both), _WIRES).tolist():
            wires = [field.trace(target).points for field in fields]
            apart.append(np.mean([nearest_on_segments(p, wires[0][:-1], wires[0][1:])[1].min() for p in wires[1]]))
    differences = np.concatenate(off)
    return (
        f"Opt {taken:.3f} s, ours {ours_taken:.4f} s ({taken / ours_taken:.0f} x); {ours.invalid_before} invalid; "
        f"{np.mean(np.abs(changed / lengths - 1.0) > 0.01):.1%} of lengths changed by more than 1 %; "
        f"distances {differences.mean():.2%} off ours, 95 % of them at most {np.quantile(differences, 0.95):.2%}; "
        f"wires {np.mean(apart) / edge:.2f} edges, median {np.median(apart) / edge:.2f}"
    )


def _timed(make: Callable[[], object], times: int = 3) -> tuple[float, object]:
    seconds = []
    for _ in range(times):
        begin = time.perf_counter()
        made = make()
        seconds.append(time.perf_counter() - begin)
    return median(seconds), made


if __name__ == "__main__":
    main()
