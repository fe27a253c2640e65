# SPDX-License-Identifier: GPL-3.0-or-later
"""How far limbs are from the parts that people see, for five amounts.

    python native/bench/limbs.py PSB_FOLDER

PSB_FOLDER holds off/N.off and seg/N_k.seg (a segment number per face) of Chen, Golovinskiy, Funkhouser, "A Benchmark for 3D Mesh
Segmentation" (2009). The distance of two segmentations is one minus their Rand index: the share of the pairs of faces that are in one
segment of one, and in two segments of the other. People are averaged for each model, then models are. Times are processor time. Needs
numpy, and seamwire_core on the path.
"""

import sys
import time
from itertools import combinations
from pathlib import Path

import numpy as np
import seamwire_core as sw
from human_cuts import read_off
from numpy.typing import NDArray

AMOUNTS = (0.1, 0.3, 0.5, 0.7, 0.9)


def rand_distance(one: NDArray[np.int64], other: NDArray[np.int64]) -> float:
    """Return the share of the pairs of faces on which two segmentations, (m,) each, disagree."""

    def pairs(counts: NDArray[np.int64]) -> int:
        return int((counts * (counts - 1)).sum()) // 2

    both = np.unique(np.stack([one, other]), axis=1, return_counts=True)[1]
    of_one, of_other = (np.unique(each, return_counts=True)[1] for each in (one, other))
    return (pairs(of_one) + pairs(of_other) - 2 * pairs(both)) / (len(one) * (len(one) - 1) // 2)


def main() -> None:
    """Measure all models and print a table."""
    folder = Path(sys.argv[1])
    rows, people, single, seconds = [], [], [], []
    for file in sorted((folder / "off").glob("*.off")):
        points, triangles = read_off(file)
        found = [np.loadtxt(each, dtype=np.int64) for each in sorted((folder / "seg").glob(f"{file.stem}_*.seg"))]
        persons = [each for each in found if len(each) == len(triangles)]
        if len(persons) < 2:
            continue
        start = time.process_time()
        finder = sw.PartFinder(sw.Surface(points, triangles), by="limbs")
        limbs = [np.asarray(finder.find(amount).of_face, dtype=np.int64) for amount in AMOUNTS]
        seconds.append(time.process_time() - start)
        rows.append([np.mean([rand_distance(own, person) for person in persons]) for own in limbs])
        people.append(np.mean([rand_distance(one, other) for one, other in combinations(persons, 2)]))
        single.append(np.mean([rand_distance(np.zeros_like(person), person) for person in persons]))
    if not rows:
        sys.exit(f"No models with two segmentations in {folder}")
    table = np.array(rows)
    print(f"| {len(rows)} models | Rand index distance to people |\n| --- | --- |")
    for amount, column in zip(AMOUNTS, table.T, strict=True):
        print(f"| amount {amount} | {column.mean():.3f} |")
    print(f"| best of the five | {table.min(axis=1).mean():.3f} |")
    print(f"| people among themselves | {np.mean(people):.3f} |")
    print(f"| one part | {np.mean(single):.3f} |")
    print(f"\n{np.mean(seconds):.2f} s a model")


if __name__ == "__main__":
    main()
