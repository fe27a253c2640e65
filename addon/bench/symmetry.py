# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of finding each vertex's mirror image by place, beside SciPy's k-d tree: ``python symmetry.py [REPEATS]``, without Blender.

A million vertices in no order, symmetric over x. Seconds of the processor, medians; both are given the same points and find the same.
"""

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).parents[1]))
from seamwire.core.network.symmetry import Symmetry

TOLERANCE = 2e-5
SIDE = 1000
FLIP = np.array([-1.0, 1.0, 1.0])


def vertices() -> np.ndarray:
    """Return (n, 3) vertices of a wavy sheet, in an order drawn at random."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, SIDE), np.linspace(-1.0, 1.0, SIDE))
    sheet = np.stack([x.ravel(), y.ravel(), np.sin(3.0 * y.ravel()) * np.abs(x.ravel())], axis=1)
    return sheet[np.random.default_rng(0).permutation(len(sheet))].astype(np.float32).astype(np.float64)


def ours(points: np.ndarray) -> np.ndarray:
    """Return each vertex's partner."""
    return Symmetry(points).partners((0,))


def peer(points: np.ndarray) -> np.ndarray:
    """Return the vertex nearest to each one's mirror image."""
    return cKDTree(points).query(points * FLIP, distance_upper_bound=TOLERANCE)[1]


def timed(work: Callable[[np.ndarray], np.ndarray], points: np.ndarray) -> float:
    """Return the processor's seconds of one run."""
    begun = time.process_time()
    partners = work(points)
    took = time.process_time() - begun
    if not np.allclose(points[partners], points * FLIP, atol=TOLERANCE):
        sys.exit(f"{work.__name__}: not the mirror images")
    return took


def main() -> None:
    """Measure in turns, and print."""
    points = vertices()
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    pairs = [(timed(ours, points), timed(peer, points)) for _ in range(repeats)]
    own, other = (statistics.median(column) for column in zip(*pairs, strict=True))
    ratio = statistics.median(theirs / mine for mine, theirs in pairs)
    print(f"{len(points)} vertices: {own:.2f} s; SciPy's k-d tree {other:.2f} s, {ratio:.1f} times as long")


if __name__ == "__main__":
    main()
