# SPDX-License-Identifier: GPL-3.0-or-later
"""How many gaps are found in artists' seams, and whether one that is made in them is found.

    python native/bench/seam_gaps.py SEAMS

SEAMS is as for seam_clicks.py. In each chain of eight edges or more, one edge that is not near
its ends is removed, and put back before the next. The gap counts as found if its two sides are among the reported gaps.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from pathlib import Path

import numpy as np
import seamwire_core
from seams_engine import fan_triangles, polygon_edges

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from seamwire.core.seams.seam_wires import GapFinder  # these know no Blender

_SHORTEST = 8
_NEAR_END = 3


def main() -> None:
    """Print a line a model, then the sums."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seams", type=Path)
    chosen = parser.parse_args()
    sys.path.insert(0, str(chosen.seams))
    measure = importlib.import_module("measure")
    draw = np.random.default_rng(1)
    sums = np.zeros(4, dtype=int)
    for path in sorted((chosen.seams / "data").glob("*.npz")):
        points, offsets, corners, _, listed = measure.load(str(path))
        edges, triangles = polygon_edges(offsets, corners), fan_triangles(offsets, corners)
        edges = edges[edges[:, 0] != edges[:, 1]]
        seams = np.array(sorted(listed)).reshape(-1, 2)
        corners, counts = np.unique(
            np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_counts=True
        )
        ends = set(np.flatnonzero(np.bincount(seams.ravel()) == 1)) - set(corners[counts == 1].ravel())
        surface = seamwire_core.Surface(points, triangles, edges)
        finder = GapFinder(lambda surface=surface: surface)
        counts = [len(ends), len(finder.find(seams)), 0, 0]
        for chain in map(np.ndarray.tolist, seamwire_core.edge_chains(seams)):
            if len(chain) <= _SHORTEST:
                continue
            at = int(draw.integers(_NEAR_END, len(chain) - 1 - _NEAR_END))
            gap = set(chain[at : at + 2])
            found = finder.find(seams[[set(pair) != gap for pair in seams.tolist()]])
            counts[2] += 1
            counts[3] += any({one.end, one.target} == gap for one in found)
        sums += counts
        print(
            f"{path.stem:40s} {counts[0]:4d} open ends, {counts[1]:3d} gaps; of {counts[2]:3d} made {counts[3]:3d} found",
            flush=True,
        )
    print("{} open ends, {} gaps; of {} made {} found".format(*sums))


if __name__ == "__main__":
    main()
