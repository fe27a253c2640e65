# SPDX-License-Identifier: GPL-3.0-or-later
"""How long Python waits where a live wire is given up in the middle of its work.

    python native/bench/closing.py [--side N] [--repeats N] [--seconds S]

The mesh is a torus of 2 N^2 triangles. For wires across the surface and along edges, a LiveWire is made and seeded. Its last reference is
dropped at a random moment up to S seconds later. The program prints the median and the largest time on the clock until that line is left,
and how long the process then still works. live_stop_bench measures the destructor itself. Needs numpy, and seamwire_core on the path.
"""

import argparse
import random
import statistics
import time

import numpy as np
import seamwire_core as sw
from numpy.typing import NDArray


def torus(side: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return points and triangles."""
    u, v = (angle.ravel() for angle in np.meshgrid(*[2 * np.pi * np.arange(side) / side] * 2, indexing="ij"))
    ring = 1.0 + 0.3 * np.cos(v)
    points = np.column_stack([ring * np.cos(u), ring * np.sin(u), 0.3 * np.sin(v)])
    one, two = (index.ravel() for index in np.meshgrid(np.arange(side), np.arange(side), indexing="ij"))
    after, beside = (one + 1) % side, (two + 1) % side
    a, b, c, d = one * side + two, after * side + two, after * side + beside, one * side + beside
    return points, np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])]).astype(np.int32)


def settle() -> float:
    """Wait until the process does nothing any more; return the processor time that this took."""
    first = before = time.process_time()
    while True:
        time.sleep(0.05)
        now = time.process_time()
        if now - before < 0.001:
            return now - first
        before = now


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=707)
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=4.0)
    options = parser.parse_args()
    points, triangles = torus(options.side)
    print(f"torus, {len(triangles)} triangles")
    chance = random.Random(1)
    for along in ("surface", "edges"):
        waits, works = [], []
        for _ in range(options.repeats):
            live = sw.LiveWire(points, triangles, along=along, max_anisotropy=20.0)
            live.seed(0)
            time.sleep(chance.uniform(0.0, options.seconds))
            asked = time.perf_counter()
            del live
            waits.append(1e3 * (time.perf_counter() - asked))
            works.append(1e3 * settle())
        print(
            f"{along:8} waits: median {statistics.median(waits):6.2f} ms, most {max(waits):6.2f}; "
            f"works on: median {statistics.median(works):6.1f} ms of the processor's time, most {max(works):6.1f}"
        )


if __name__ == "__main__":
    main()
