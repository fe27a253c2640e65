# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory of the module's functions grow with the mesh.

    python native/bench/scaling.py [--triangles N] [NAME...]

Each function runs on meshes of N, 4 N and 16 N triangles (N is 8,000 without the option), in a process of its own. The program prints a row
of a Markdown table for each: processor time and the memory that the call adds at its peak. *growth* is the exponent between the last two
sizes: 1 is proportional, 2 quadratic. The exit code is 1 if a growth exceeds 1.2, except for functions with a stated larger limit.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from math import log
from pathlib import Path

import numpy as np
import seamwire_core as sw
from auto_seams_report import markdown

Work = Callable[[], object]
MOST_GROWTH = 1.2
# Shorter times are noise: first uses of memory, and other work on the machine.
LEAST_SECONDS = 0.02
LEAST_BYTES = 4e6


def torus(triangles: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the points and triangles of a bumpy torus."""
    rows = round((triangles / 6) ** 0.5)
    columns = 3 * rows
    u, v = np.meshgrid(np.arange(columns) / columns, np.arange(rows) / rows, indexing="ij")
    u, v = 2 * np.pi * u, 2 * np.pi * v
    radius = 0.35 + 0.04 * np.sin(9 * u) * np.sin(6 * v)
    points = np.stack(
        [(1 + radius * np.cos(v)) * np.cos(u), (1 + radius * np.cos(v)) * np.sin(u), radius * np.sin(v)], -1
    )
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    a, b = i * rows + j, (i + 1) % columns * rows + j
    c, d = (i + 1) % columns * rows + (j + 1) % rows, i * rows + (j + 1) % rows
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return points.reshape(-1, 3), faces.astype(np.int32)


def boxes(triangles: int) -> tuple[np.ndarray, np.ndarray]:
    """Return unequal boxes side by side, of twelve triangles each."""
    from many_boxes import boxes as model_of

    model = model_of(triangles // 12)
    return model.points, sw.triangulate(model.points, model.corners, np.diff(model.start))[0]


def fan(triangles: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a disc of triangles around one vertex."""
    angles = 2 * np.pi * np.arange(triangles) / triangles
    rim = np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
    number = np.arange(triangles)
    faces = np.stack([0 * number, 1 + number, 1 + (number + 1) % triangles], -1)
    return np.concatenate([[[0, 0, 0]], rim]), faces.astype(np.int32)


def ring(triangles: int) -> np.ndarray:
    """Return the edges of the torus around its tube and around its hole, which cut it to a disc."""
    rows = round((triangles / 6) ** 0.5)
    columns = 3 * rows
    around = np.arange(rows)
    tube = np.stack([around, (around + 1) % rows], -1)
    along = np.arange(columns)
    return np.concatenate([tube, np.stack([along * rows, (along + 1) % columns * rows], -1)])


def all_work() -> dict[str, tuple[Callable[[int], Work], float]]:
    """Return for each function what prepares its call, from the number of triangles, and the growth that is allowed."""
    feature = sw.MetricSpec("feature", "min", max_anisotropy=10, clamp_percentile=99)

    def surface(n: int) -> sw.Surface:
        return sw.Surface(*torus(n))

    def metric(n: int) -> tuple[sw.Surface, sw.Metric]:
        on = surface(n)
        return on, sw.make_metric(on, feature)

    def embedded(n: int) -> sw.Embedding:
        return sw.embed(*metric(n), max_error=0)

    def far(n: int) -> int:
        rows = round((n / 6) ** 0.5)
        return 3 * rows // 2 * rows  # across the hole from vertex 0, in the plane of both and the y-axis

    def after(prepare: Callable[[int], object], call: Callable[..., object]) -> Callable[[int], Work]:
        def prepared(n: int) -> Work:
            made = prepare(n)
            arguments = made if isinstance(made, tuple) else (made,)
            return lambda: call(*arguments)

        return prepared

    def flat(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        points, triangles = torus(n)
        return points, triangles, sw.flatten(points, triangles, ring(n)).uvs

    def rectangles(n: int, step: tuple[float, float], width: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        corners = [(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, 1.0, 0.0), (0.0, 1.0, 0.0)]
        points = np.tile(corners, (n // 2, 1))
        points[:, :2] += np.arange(n // 2).repeat(4)[:, None] * step
        first = 4 * np.arange(n // 2)[:, None, None]
        triangles = (first + np.array([(0, 1, 2), (0, 2, 3)])).reshape(-1, 3).astype(np.int32)
        points[:, 2] = np.arange(n // 2).repeat(4)
        turn = np.array([(0.8, 0.6), (-0.6, 0.8)])
        return points, triangles, points[triangles][:, :, :2] @ turn

    def field(n: int) -> tuple[sw.DistanceField, int]:
        return sw.distance_field(embedded(n), 0), far(n)

    def wire(n: int) -> tuple[sw.Surface, sw.Wire]:
        on, by = metric(n)
        return on, sw.distance_field(sw.embed(on, by, max_error=0), 0).trace(far(n))

    def line(on: sw.Surface) -> tuple[np.ndarray, np.ndarray]:
        faces = np.arange(0, 2 * round((len(on.triangles) / 6) ** 0.5), 2, np.int32)
        return on.points[on.triangles[faces]].mean(1), faces

    def places(n: int) -> tuple[sw.NearestPoints, np.ndarray]:
        points, triangles = torus(n)
        return sw.NearestPoints(points, triangles), points + 0.01

    def file(n: int, ending: str) -> tuple[tempfile.TemporaryDirectory, str, sw.PolygonMesh]:
        folder = tempfile.TemporaryDirectory()
        path = f"{folder.name}/mesh{ending}"
        points, triangles = torus(n)
        mesh = sw.PolygonMesh(points, triangles.ravel(), np.full(len(triangles), 3))
        sw.write_mesh(path, mesh)
        return folder, path, mesh

    def hits(n: int) -> object:
        tree = sw.RayTree(*torus(n))
        tree.wait()
        return tree

    def seam_plan(make: Callable[[int], tuple[np.ndarray, np.ndarray]]) -> Callable[[int], Work]:
        return after(lambda n: sw.Surface(*make(n)), lambda on: sw.SeamPlanner(on, along="edges").plan(steps=1))

    def shown(wires: sw.LiveWire, n: int) -> object:
        """Wait for the wire from vertex 0 to one far away."""
        wires.wait_for_surface()
        wires.seed(0)
        wires.wires(far(n))
        wires.wait()
        return wires.wires(far(n))

    def live(along: str) -> Callable[[int], Work]:
        return after(lambda n: (*torus(n), n), lambda *mesh: shown(sw.LiveWire(*mesh[:2], along=along), mesh[2]))

    def after_live(along: str, call: Callable[[sw.LiveWire, int], object]) -> Callable[[int], Work]:
        def prepare(n: int) -> tuple[sw.LiveWire, int]:
            wires = sw.LiveWire(*torus(n), along=along)
            shown(wires, n)
            return wires, n

        return after(prepare, call)

    def settled(wires: sw.LiveWire, call: Callable[[], object]) -> object:
        """Wait for the answer of a call that starts a search."""
        call()
        wires.wait()
        return call()

    def stroke(on: sw.Surface) -> sw.Scribble:
        vertices = np.arange(32)
        return sw.Scribble(on.points[vertices], vertices=vertices)

    def strokes(n: int) -> tuple[sw.Surface, sw.Metric, list[sw.Scribble]]:
        on, by = metric(n)
        return on, by, [stroke(on)]

    def curved(n: int) -> tuple[sw.Surface, sw.Curvature]:
        on = surface(n)
        return on, sw.principal_curvatures(on)

    def bent(n: int) -> tuple[sw.BentWires, int]:
        distances, to = field(n)
        return distances.bend(distances.closed_wires(1)[0]), to

    def cut(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[sw.CutCurve]]:
        points, triangles = torus(n)
        section = sw.plane_section(sw.Surface(points, triangles), 0, far(n), [0, 1, 0])
        curve = sw.CutCurve(section[0], 0, far(n), section[1])
        return points, triangles, np.arange(len(triangles), dtype=np.int32), [curve]

    work = {
        "Surface": after(torus, sw.Surface),
        "principal_curvatures": after(surface, sw.principal_curvatures),
        "smoothed_curvatures": after(curved, sw.smoothed_curvatures),
        "make_metric": after(lambda n: (surface(n), feature), sw.make_metric),
        "feature_metric": after(curved, lambda *on: sw.feature_metric(*on, max_anisotropy=10, clamp_percentile=99)),
        "campen_metric": after(curved, lambda *on: sw.campen_metric(*on, max_anisotropy=10)),
        "pottmann_kovacs_metric": after(curved, lambda *on: sw.pottmann_kovacs_metric(*on, max_anisotropy=10)),
        "concave_metric": after(curved, sw.concave_metric),
        "euclidean_metric": after(curved, sw.euclidean_metric),
        "Metric.ellipses": after(metric, lambda _, by: by.ellipses()),
        "apply_scribbles": after(strokes, sw.apply_scribbles),
        "crest_lines": after(curved, sw.crest_lines),
        "embed, without max_error": after(metric, lambda *on: sw.embed(*on, max_error=0)),
        "embed": after(metric, sw.embed),
        "Embedding.with_lengths": after(embedded, lambda on: on.with_lengths(on.lengths)),
        "invalid_faces": after(metric, sw.invalid_faces),
        "metric_lengths": after(metric, sw.metric_lengths),
        "DistanceField.trace": after(field, lambda distances, to: distances.trace(to)),
        "DistanceField.trace_many": after(field, lambda distances, to: distances.trace_many(range(to, to + 100))),
        "DistanceField.trace_to": after(field, lambda distances, to: distances.trace_to(to, [0.2, 0.3, 0.5])),
        "DistanceField.distance": after(field, lambda distances, to: distances.distance(to, [0.2, 0.3, 0.5])),
        "snap_to_edges": after(wire, sw.snap_to_edges),
        "edge_wires": after(lambda n: (*metric(n), 0), sw.edge_wires),
        "EdgeWires.trace": after(lambda n: (sw.edge_wires(*metric(n), 0), far(n)), lambda wires, to: wires.trace(to)),
        "shortest_cycle": after(lambda n: (*metric(n), (0, 1)), sw.shortest_cycle),
        "fit_chain": after(lambda n: (on := surface(n), *line(on)), sw.fit_chain),
        "isolines": after(lambda n: (on := surface(n), on.points[:, 2], [-0.1, 0.0, 0.1]), sw.isolines),
        "plane_section": after(lambda n: (surface(n), 0, far(n), [0, 1, 0]), sw.plane_section),
        "face_segments": after(lambda n: (surface(n), ring(n)), sw.face_segments),
        "missing_cuts": after(lambda n: (on := surface(n), ring(n), sw.face_segments(on, ring(n))), sw.missing_cuts),
        "read_mesh, OBJ": after(lambda n: file(n, ".obj"), lambda _, path, __: sw.read_mesh(path)),
        "read_mesh, STL": after(lambda n: file(n, ".stl"), lambda _, path, __: sw.read_mesh(path)),
        "write_mesh, PLY": after(lambda n: file(n, ".ply"), lambda _, path, mesh: sw.write_mesh(path, mesh)),
        "triangulate": after(
            lambda n: (torus(n)[0], torus(n)[1].ravel(), np.full(len(torus(n)[1]), 3, np.int32)), sw.triangulate
        ),
        "has_scanned_edges": after(torus, sw.has_scanned_edges),
        "plan_cuts": after(cut, sw.plan_cuts),
        "CutPlan.node_at": after(
            lambda n: (sw.plan_cuts(*cut(n)), torus(n)[1][0]),
            lambda plan, corners: plan.node_at(corners, [0.2, 0.3, 0.5]),
        ),
        "RayTree": after(torus, lambda points, triangles: sw.RayTree(points, triangles).wait()),
        "RayTree.first_hit": after(
            hits, lambda tree: [tree.first_hit([3, y, 0.1], [-1, 0, 0]) for y in np.linspace(-1, 1, 999)]
        ),
        "NearestPoints": after(torus, sw.NearestPoints),
        "NearestPoints.find": after(places, lambda tree, near: tree.find(near)),
        "measure_map": after(flat, sw.measure_map),
        "map_energy": after(flat, sw.map_energy),
        "measure_map, stacked islands": after(lambda n: rectangles(n, (0, 0), 1), sw.measure_map),
        "measure_map, islands on each other": after(lambda n: rectangles(n, (1 / n, 0), 1), sw.measure_map),
        "measure_map, long islands": after(lambda n: rectangles(n, (0, 2), n), sw.measure_map),
        "PartFinder": after(surface, sw.PartFinder),
        "PartFinder.find": after(lambda n: sw.PartFinder(surface(n)), lambda finder: finder.find(0.5)),
        "SeamPlanner.plan, boxes": seam_plan(boxes),
        "SeamPlanner.plan, a fan": seam_plan(fan),
        "LiveWire, edges": live("edges"),
        "LiveWire.set_metric, edges": after_live("edges", lambda on, n: (on.set_metric("campen"), shown(on, n))),
        "LiveWire.set_scribbles, edges": after_live(
            "edges", lambda on, n: (on.set_scribbles([stroke(on.surface)]), shown(on, n))
        ),
        "LiveWire.loop": after_live("edges", lambda on, _: settled(on, lambda: on.loop((0, 1)))),
        "LiveWire.edge_loop": after_live("edges", lambda on, _: on.edge_loop((0, 1))),
        "LiveWire.extend_straight": after_live("edges", lambda on, _: on.extend_straight((0, 1))),
        "LiveWire.fit_chain": after_live("edges", lambda on, _: on.fit_chain(*line(on.surface))),
    }
    return {
        **{name: (prepare, MOST_GROWTH) for name, prepare in work.items()},
        # Newton's steps factor a sparse matrix. On a planar mesh that takes n^1.5 (George, "Nested Dissection of a Regular Finite
        # Element Mesh", 1973).
        "flatten": (after(lambda n: (*torus(n), ring(n)), sw.flatten), 1.5),
        "SeamPlanner.plan": (seam_plan(torus), 1.5),
        "distance_field, heat": (after(embedded, lambda on: sw.distance_field(on, 0, method="heat")), 1.5),
        # Each window crosses as many triangles as the surface is wide, so an exact front has up to n^1.5 windows.
        "distance_field": (after(embedded, lambda on: sw.distance_field(on, 0)), 1.5),
        "closed_wires": (after(field, lambda distances, _: distances.closed_wires()), 1.5),
        "DistanceField.bend": (after(field, lambda on, _: on.bend(on.closed_wires(1)[0])), 1.5),
        "BentWires.through": (after(bent, lambda wires, to: wires.through(to)), 1.5),
        "LiveWire, surface": (live("surface"), 1.5),
        "LiveWire.set_metric": (after_live("surface", lambda on, n: (on.set_metric("campen"), shown(on, n))), 1.5),
        "LiveWire.set_scribbles": (
            after_live("surface", lambda on, n: (on.set_scribbles([stroke(on.surface)]), shown(on, n))),
            1.5,
        ),
        "LiveWire.closed_wires": (after_live("surface", lambda on, _: settled(on, lambda: on.closed_wires(0))), 1.5),
        "LiveWire.bent_wire": (after_live("surface", lambda on, n: settled(on, lambda: on.bent_wire(0, far(n)))), 1.5),
    }


def measured(name: str, triangles: int) -> tuple[float, float]:
    """Return the processor time of a call, and the memory that it adds at its peak."""
    work = all_work()[name][0](triangles)
    Path("/proc/self/clear_refs").write_text("5")  # forgets the peak so far
    before = memory("VmRSS")
    start = time.process_time()
    work()
    return time.process_time() - start, memory("VmHWM") - before


def memory(kind: str) -> float:
    """Return a figure of /proc/self/status in bytes."""
    return 1024.0 * int(Path("/proc/self/status").read_text().split(f"{kind}:")[1].split()[0])


def growth(small: float, large: float, least: float) -> float:
    """Return the exponent between two sizes that differ by a factor of four."""
    return log(max(large, least) / max(small, least)) / log(4)


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--triangles", type=int, default=8000)
    parser.add_argument("--one", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(measured(arguments.names[0], arguments.triangles)))
        return 0
    titles = ["function", "s: n / 4 n / 16 n", "MB: n / 4 n / 16 n", "growth, s", "growth, MB", "limit"]
    print(markdown(titles, []), flush=True)
    is_fine = True
    for name, (_, limit) in all_work().items():
        if arguments.names and name not in arguments.names:
            continue
        results = []
        for factor in (1, 4, 16):
            command = [sys.executable, __file__, "--one", "--triangles", str(factor * arguments.triangles), name]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"{name}: {done.stderr}")
            results.append(json.loads(done.stdout))
        (_, one, two), (_, small, large) = zip(*results, strict=True)
        in_time, in_memory = growth(one, two, LEAST_SECONDS), growth(small, large, LEAST_BYTES)
        is_fine &= in_time <= limit and in_memory <= limit
        cells = [
            name,
            " / ".join(f"{seconds:.2f}" for seconds, _ in results),
            " / ".join(f"{amount / 1e6:.0f}" for _, amount in results),
            f"{in_time:.2f}",
            f"{in_memory:.2f}",
            f"{limit:g}",
        ]
        print(f"| {' | '.join(cells)} |", flush=True)
    return 0 if is_fine else 1


if __name__ == "__main__":
    sys.exit(main())
