# SPDX-License-Identifier: GPL-3.0-or-later
"""How many connected components of artists' seams are repeats of others, and how many places are found that have no seams.

    python native/bench/seam_repeats.py SEAMS

SEAMS is as for seam_clicks.py. The components are visited by size, the largest first. A component that does not repeat a former one is
drawn, and all its repeats are taken.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from seams_engine import fan_triangles, polygon_edges

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from seamwire_networks.repeats import Repeats  # this knows no Blender


def main() -> None:
    """Print a line a model, then the sums."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seams", type=Path)
    chosen = parser.parse_args()
    sys.path.insert(0, str(chosen.seams))
    measure = importlib.import_module("measure")
    line = "{:4d} components, {:4d} to draw, {:3d} repeats of those; {:3d} more places, without seams"
    sums = np.zeros(4, dtype=int)
    for path in sorted((chosen.seams / "data").glob("*.npz")):
        points, offsets, corners, _, listed = measure.load(str(path))
        edges, triangles = polygon_edges(offsets, corners), fan_triangles(offsets, corners)
        edges = edges[edges[:, 0] != edges[:, 1]]
        known = {tuple(sorted(pair)) for pair in edges.tolist()}
        begun = time.perf_counter()
        repeats = Repeats(points, triangles, edges)
        counts = np.zeros(4, dtype=int)
        drawn = set()
        components = _components(np.array([pair for pair in sorted(listed) if tuple(sorted(pair)) in known]))
        counts[0] = len(components)
        for component in components:
            if drawn >= component:
                counts[2] += 1
                continue
            counts[1] += 1
            drawn |= component
            for place in repeats.maps(component):
                there = {tuple(sorted((place[first], place[second]))) for first, second in component}
                if any(there <= other for other in components):
                    drawn |= there
                elif not any(there & other for other in components):
                    counts[3] += 1
        sums += counts
        print(f"{path.stem:40s} {line.format(*counts)}; {1e3 * (time.perf_counter() - begun):.0f} ms", flush=True)
    print(line.format(*sums))


def _components(seams: np.ndarray) -> list[set[tuple[int, int]]]:
    """Return the connected components of seams, the largest first."""
    if not len(seams):
        return []
    size = int(seams.max()) + 1
    _, label = connected_components(coo_array((np.ones(len(seams)), seams.T), shape=(size, size)), directed=False)
    sets: dict[int, set[tuple[int, int]]] = {}
    for first, second in seams.tolist():
        sets.setdefault(int(label[first]), set()).add((min(first, second), max(first, second)))
    return sorted(sets.values(), key=len, reverse=True)


if __name__ == "__main__":
    main()
