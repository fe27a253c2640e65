# SPDX-License-Identifier: GPL-3.0-or-later
"""What each call of the library costs, as the table of docs/library/limits.md.

Times every call on the sheet of docs/library.md, or on a torus, with 30,000 and 120,000 triangles, in turns. The first number is the
processor time at 120,000 triangles, divided by that of ``Surface``. The second one is the power of the number of triangles with which
the time grows.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time
from collections.abc import Callable

import numpy as np
import seamwire_core as sw

Calls = dict[str, Callable[[], object]]


def grid(x: np.ndarray, y: np.ndarray, z: np.ndarray, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the points and the triangles of a grid."""
    m, n = x.shape
    i, j = np.meshgrid(np.arange(m if closed else m - 1), np.arange(n if closed else n - 1), indexing="ij")
    corners = [(i + di) % m * n + (j + dj) % n for di, dj in [(0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)]]
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), np.stack(corners, axis=-1).reshape(-1, 3)


def sheet(fineness: int) -> tuple[np.ndarray, np.ndarray, int, int]:
    """Return the points and triangles of the sheet, and two vertices on its ridge."""
    m, n = 150 * fineness + 1, 100 * fineness + 1
    x, y = np.meshgrid(np.linspace(-1.5, 1.5, m), np.linspace(-1, 1, n), indexing="ij")
    z = 0.5 * np.exp(-np.hypot(y - 0.4 * np.sin(2.2 * x), 0.08) / 0.4)
    return *grid(x, y, z, closed=False), fineness * (10 * n + 44), fineness * (140 * n + 56)


def closed_wire_calls(fineness: int) -> Calls:
    """Return calls that need closed wires, on a torus with as many triangles as the sheet."""
    m, n = 150 * fineness, 100 * fineness
    u, v = np.meshgrid(*(np.linspace(0, 2 * np.pi, count, endpoint=False) for count in (m, n)), indexing="ij")
    torus = sw.Surface(*grid((3 + np.cos(v)) * np.cos(u), (3 + np.cos(v)) * np.sin(u), np.sin(v), closed=True))
    metric = sw.concave_metric(torus, sw.principal_curvatures(torus))
    embedding = sw.embed(torus, metric, max_error=0)
    field = sw.distance_field(embedding, 0)
    cut = field.closed_wires()[0]
    bent = field.bend(cut)
    return {
        "distance_field, on the torus": lambda: sw.distance_field(embedding, 0),
        "DistanceField.closed_wires": lambda: field.closed_wires(),
        "DistanceField.bend": lambda: field.bend(cut),
        "BentWires.through": lambda: bent.through(n // 2),
    }


def calls_on(fineness: int) -> Calls:
    """Return the calls to time, on a sheet of that fineness."""
    points, triangles, start, end = sheet(fineness)
    surface = sw.Surface(points, triangles)
    curvature = sw.principal_curvatures(surface)
    metric = sw.feature_metric(surface, curvature, max_anisotropy=20, clamp_percentile=99)
    embedding = sw.embed(surface, metric, max_error=0)
    field = sw.distance_field(embedding, start)
    wire = field.trace(end)
    stroke = sw.Scribble(points[[start, end]], vertices=[start, end])
    middle = np.arange(points.shape[0] // 2, points.shape[0] // 2 + 100 * fineness)
    cuts = np.stack([middle[:-1], middle[1:]], axis=1)
    return {
        "Surface": lambda: sw.Surface(points, triangles),
        "principal_curvatures, with Surface": lambda: sw.principal_curvatures(sw.Surface(points, triangles)),
        "smoothed_curvatures, radius 0.01": lambda: sw.smoothed_curvatures(surface, curvature),
        "feature_metric": lambda: sw.feature_metric(surface, curvature, max_anisotropy=20),
        "apply_scribbles, one stroke": lambda: sw.apply_scribbles(surface, metric, [stroke]),
        "embed, max_error=0": lambda: sw.embed(surface, metric, max_error=0),
        "embed": lambda: sw.embed(surface, metric),
        "distance_field, the first, with embed, max_error=0": lambda: sw.distance_field(
            sw.embed(surface, metric, max_error=0), start
        ),
        "distance_field, further ones": lambda: sw.distance_field(embedding, start),
        "DistanceField.trace": lambda: field.trace(end),
        "snap_to_edges": lambda: sw.snap_to_edges(surface, wire),
        "edge_wires, further ones": lambda: sw.edge_wires(surface, metric, start),
        "crest_lines": lambda: sw.crest_lines(surface, curvature),
        "face_segments": lambda: sw.face_segments(surface, cuts),
        "measure_map": lambda: sw.measure_map(points, triangles, points[triangles][:, :, :2]),
        **closed_wire_calls(fineness),
    }


def processor_time(call: Callable[[], object]) -> float:
    """Return the processor time of a call, which is repeated until it is long enough to be measured."""
    count, begin = 0, time.process_time()
    while (spent := time.process_time() - begin) < 0.02:
        call()
        count += 1
    return spent / max(count, 1)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    sets = [calls_on(1), calls_on(2)]
    times: dict[str, list[list[float]]] = {name: [[], []] for name in sets[0]}
    for _ in range(rounds):
        for which, calls in enumerate(sets):
            for name, call in calls.items():
                times[name][which].append(processor_time(call))
    unit = statistics.median(times["Surface"][1])
    print("| call | time / `Surface` | grows as triangles to the power of |\n|---|---|---|")
    for name, (few, many) in times.items():
        growth = math.log(statistics.median(many) / statistics.median(few), 4)
        head, _, rest = name.partition(",")
        print(f"| `{head}`{',' + rest if rest else ''} | {statistics.median(many) / unit:.2g} | {growth:.1f} |")


if __name__ == "__main__":
    main()
