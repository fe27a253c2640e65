# SPDX-License-Identifier: GPL-3.0-or-later
"""How long it takes from a mesh to the first wire, where the artist clicks at once.

    python native/bench/ready.py [--side N] [--repeats N]

The mesh is a bumpy torus of 2 N^2 triangles. For wires across the surface and along edges, a LiveWire is made and seeded at once. Then the
wires to a far vertex are requested every millisecond.

Prints seconds on the clock until the surface is built, until the first of the two wires, and until both are final. Then it prints the
seconds until another LiveWire, without a seed, is ready for one, and the processor time of everything. These are medians. The first run of
the process is separate, because the system has yet to find its memory. Needs numpy, and seamwire_core on the path.
"""

import argparse
import statistics
import time

import numpy as np
import seamwire_core as sw
from closing import torus


def measure(points: np.ndarray, triangles: np.ndarray, along: str) -> list[float]:
    """Return the seconds until surface, first wire and both final ones, until ready, and of the processor."""
    worked, begun = time.process_time(), time.perf_counter()
    live = sw.LiveWire(points, triangles, along=along, max_anisotropy=20.0, clamp_percentile=99.0)
    live.seed(0)
    laps = {}
    while not laps.get("final"):
        wires = live.wires(len(points) // 2)
        now = time.perf_counter() - begun
        if live.surface is not None:
            laps.setdefault("surface", now)
        if any(len(wire.points) for wire in wires.wires):
            laps.setdefault("wire", now)
        if wires.final:
            laps["final"] = now
        time.sleep(1e-3)
    del live
    begun = time.perf_counter()
    live = sw.LiveWire(points, triangles, along=along, max_anisotropy=20.0, clamp_percentile=99.0)
    live.wait()
    ready = time.perf_counter() - begun
    return [laps["surface"], laps["wire"], laps["final"], ready, time.process_time() - worked]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=707)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    points, triangles = torus(options.side)
    points[:, 2] *= 1.0 + 0.1 * np.sin(20.0 * np.arctan2(points[:, 1], points[:, 0]))
    print(f"torus, {len(triangles)} triangles")
    for along in ("surface", "edges"):
        runs = [measure(points, triangles, along) for _ in range(options.repeats)]
        for name, values in (
            ("first", runs[0]),
            ("median", [statistics.median(column) for column in zip(*runs, strict=True)]),
        ):
            texts = ("surface", "first wire", "final", "ready", "processor, all")
            print(
                f"{along:8} {name:6} "
                + ", ".join(f"{text} {value:.2f} s" for text, value in zip(texts, values, strict=True))
            )


if __name__ == "__main__":
    main()
