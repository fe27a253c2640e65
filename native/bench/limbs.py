# SPDX-License-Identifier: GPL-3.0-or-later
"""How far limbs are from the parts that people see, for five amounts, beside CGAL's segmentation by shape diameters.

    python native/bench/limbs.py PSB_FOLDER [PROGRAM]

PSB_FOLDER holds off/N.off and seg/N_k.seg (a segment number per face) of Chen, Golovinskiy, Funkhouser, "A Benchmark for 3D Mesh
Segmentation" (2009). The distance of two segmentations is one minus their Rand index: the share of the pairs of faces that are in one
segment of one, and in two segments of the other. People are averaged for each model, then models are. Times are processor time.

PROGRAM is cgal_segments of this folder. CGAL also gets five amounts: numbers of clusters, of which 5 is its default. Without PROGRAM
its column is missing. Needs numpy, and seamwire_core on the path.
"""

import subprocess
import sys
import time
from itertools import combinations
from pathlib import Path

import numpy as np
import seamwire_core as sw
from human_cuts import read_off
from numpy.typing import NDArray

AMOUNTS = (0.1, 0.3, 0.5, 0.7, 0.9)
CLUSTERS = (2, 3, 5, 8, 12)
"""The amounts of CGAL. The default is in the middle, as it is for limbs."""


def rand_distance(one: NDArray[np.int64], other: NDArray[np.int64]) -> float:
    """Return the share of the pairs of faces on which two segmentations, (m,) each, disagree."""

    def pairs(counts: NDArray[np.int64]) -> int:
        return int((counts * (counts - 1)).sum()) // 2

    both = np.unique(np.stack([one, other]), axis=1, return_counts=True)[1]
    of_one, of_other = (np.unique(each, return_counts=True)[1] for each in (one, other))
    return (pairs(of_one) + pairs(of_other) - 2 * pairs(both)) / (len(one) * (len(one) - 1) // 2)


def limbs_of(file: Path) -> list[NDArray[np.int64]]:
    """Return the limb of each triangle, (m,), for each of the five amounts."""
    finder = sw.PartFinder(sw.Surface(*read_off(file)), by="limbs")
    return [np.asarray(finder.find(amount).of_face, dtype=np.int64) for amount in AMOUNTS]


def cgal_segments(program: Path, file: Path) -> tuple[list[NDArray[np.int64]], float]:
    """Return CGAL's segment of each triangle, (m,), for each number of clusters, and the seconds that all of them take."""
    command = [program, file, *map(str, CLUSTERS)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    rows = [np.array(line.split(), dtype=np.float64) for line in lines]
    return [row[2:].astype(np.int64) for row in rows], float(rows[0][0] + sum(row[1] for row in rows))


def main() -> None:
    """Measure all models and print a table."""
    folder, program = Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else None
    ours, peers, people, single, seconds = [], [], [], [], []
    for file in sorted((folder / "off").glob("*.off")):
        count = len(read_off(file)[1])
        found = [np.loadtxt(each, dtype=np.int64) for each in sorted((folder / "seg").glob(f"{file.stem}_*.seg"))]
        persons = [each for each in found if len(each) == count]
        if len(persons) < 2:
            continue

        def to_people(labels: NDArray[np.int64], persons: list[NDArray[np.int64]] = persons) -> float:
            return float(np.mean([rand_distance(labels, person) for person in persons]))

        start = time.process_time()
        limbs = limbs_of(file)
        spent = [time.process_time() - start]
        ours.append([to_people(labels) for labels in limbs])
        if program is not None:
            segments, of_peer = cgal_segments(program, file)
            spent.append(of_peer)
            peers.append([to_people(labels) for labels in segments])
        seconds.append(spent)
        people.append(np.mean([rand_distance(one, other) for one, other in combinations(persons, 2)]))
        single.append(to_people(np.zeros(count, dtype=np.int64)))
    if not ours:
        sys.exit(f"No models with two segmentations in {folder}")
    print_table([np.array(each) for each in (ours, peers) if each], np.mean(seconds, axis=0))
    print(f"\n{len(ours)} models. People among themselves: {np.mean(people):.3f}. One part: {np.mean(single):.3f}.")


def print_table(distances: list[NDArray[np.float64]], seconds: NDArray[np.float64]) -> None:
    """Print the distances to people, (models, amounts) for each method, and the seconds a model."""

    def row(label: str, cells: list[str]) -> str:
        return f"| {' | '.join([label, *cells])} |"

    methods = ["limbs", "CGAL"][: len(distances)]
    print(row("Rand index distance to people", methods), row("---", ["---"] * len(methods)), sep="\n")
    for i, (amount, clusters) in enumerate(zip(AMOUNTS, CLUSTERS, strict=True)):
        print(row(f"amount {amount}, {clusters} clusters", [f"{each[:, i].mean():.3f}" for each in distances]))
    print(row("best of the five", [f"{each.min(axis=1).mean():.3f}" for each in distances]))
    print(row("seconds for all five", [f"{each:.2f}" for each in seconds]))


if __name__ == "__main__":
    main()
