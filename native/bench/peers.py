# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact geodesics of Seamwire beside those of other libraries, in one run on one machine.

    python native/bench/peers.py MESH... [--loop LEVELS]... [--repeats N] [--seeds N] [--skip NAME] [--most-faces N]
        [--programs build/bench/native/bench] [--plot GROWTH.svg]

Needs numpy, pygeodesic and potpourri3d, and seamwire_core on the path. CGAL's solver is a separate program. Our own benchmark adds its
counts. All solvers get the same triangles and seeds, and one thread.

Prints processor time: the time to build from points and triangles until a seed can be given, and the median of a solve. Then follows how
many times as long the others take, for a solve alone and for both, and how far their distances are from ours. Last comes the exponent with
which the time of a solve grows with the faces. --plot draws that.

Exact peers are left out above --most-faces. Peers run in a separate process, because some of them abort on meshes that are not manifold.
"""

import argparse
import contextlib
import multiprocessing
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import potpourri3d
import seamwire_core as sw
from numpy.typing import NDArray
from pygeodesic import geodesic

Array = NDArray[np.float64]
Solve = Callable[[int], Array]


class Result(NamedTuple):
    """The time of one solver in seconds of processor time, and its distances from each seed, if it returns them."""

    built: float
    solved: float
    fields: list[Array]


def seamwire(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return our exact solver, lengths in the mesh's own units."""
    surface = sw.Surface(points, triangles)
    metric = sw.euclidean_metric(surface, sw.principal_curvatures(surface))
    embedding = sw.embed(surface, metric, max_error=0)
    sw.distance_field(embedding, 0, max_distance=0.0)  # the solver's own form of the mesh is made once
    return lambda seed: sw.distance_field(embedding, seed).distances


def pygeodesic(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return the exact solver of Surazhsky et al. (2005)."""
    solver = geodesic.PyGeodesicAlgorithmExact(points, triangles)
    return lambda seed: solver.geodesicDistances(np.array([seed]))[0]


def potpourri3d_heat(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return the heat method of Crane et al. (2013), approximate."""
    solver = potpourri3d.MeshHeatMethodDistanceSolver(points, triangles)
    return solver.compute_distance


MOST_FACES_OF_CGAL = 200_000
"""Above, it takes more than 10 GB and minutes a seed."""

SOLVERS = {"Seamwire": seamwire, "pygeodesic": pygeodesic, "heat method": potpourri3d_heat}


def loop_subdivided(points: Array, triangles: NDArray[np.int32]) -> tuple[Array, NDArray[np.int32]]:
    """One step of Loop's scheme on a closed or bounded manifold: (n, 3) points and (m, 3) triangles to four times as many."""
    corners = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    opposite = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    edges, edge_of, faces_at = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True, return_counts=True)
    edge_of = edge_of.reshape(-1)
    beyond = np.zeros((len(edges), 3))
    np.add.at(beyond, edge_of, points[opposite])
    ends = points[edges[:, 0]] + points[edges[:, 1]]
    inner = faces_at == 2
    middle = np.where(inner[:, None], 3 / 8 * ends + 1 / 8 * beyond, ends / 2)

    valence = np.zeros(len(points))
    around = np.zeros_like(points)
    on_border = np.zeros(len(points), dtype=bool)
    on_border[edges[~inner].reshape(-1)] = True
    for a, b in ((0, 1), (1, 0)):
        mine = np.where(on_border[edges[:, a]], ~inner, inner)
        np.add.at(valence, edges[mine, a], 1)
        np.add.at(around, edges[mine, a], points[edges[mine, b]])
    n = np.maximum(valence, 1)
    weight = np.where(on_border, 1 / 8, (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n)
    moved = (1 - n * weight)[:, None] * points + weight[:, None] * around

    ab, bc, ca = (len(points) + edge_of.reshape(3, -1)).astype(np.int32)
    a, b, c = triangles.T
    finer = np.stack([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))], 1)
    return np.concatenate([moved, middle]), finer.reshape(-1, 3).astype(np.int32)


def run(name: str, points: Array, triangles: NDArray[np.int32], seeds: list[int], repeats: int, pipe: object) -> None:
    """Build what is built once, then solve from each seed; send the result, medians, through the pipe."""
    built, times, fields = [], [], []
    for _ in range(repeats):
        start = time.process_time()
        solve = SOLVERS[name](points, triangles)
        built.append(time.process_time() - start)
    for seed in seeds:
        for _ in range(repeats):
            start = time.process_time()
            field = solve(seed)
            times.append(time.process_time() - start)
        fields.append(np.array(field))
    pipe.send(Result(statistics.median(built), statistics.median(times), fields))


def run_apart(name: str, *arguments: object) -> Result | None:
    """Return the result of run(), or None where the library ended the process."""
    receiver, sender = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=run, args=(name, *arguments, sender))
    process.start()
    sender.close()
    try:
        result = receiver.recv()
    except EOFError:
        result = None
    process.join()
    return result


@contextlib.contextmanager
def off_file(points: Array, triangles: NDArray[np.int32]) -> Iterator[str]:
    """Write a mesh to a file that is there for a while."""
    with tempfile.NamedTemporaryFile("w", suffix=".off") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        np.savetxt(file, points, fmt="%.17g")
        np.savetxt(file, np.insert(triangles, 0, 3, axis=1), fmt="%d")
        file.flush()
        yield file.name


def run_program(program: Path, arguments: list[str], seeds: list[int]) -> Result | None:
    """Return the times of a program that prints what building takes, then what each seed does; None where it fails."""
    command = [str(program), *arguments, *map(str, seeds)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    times = [float(line.split()[0]) for line in result.stdout.splitlines()]
    return Result(times[0], statistics.median(times[1:]), []) if len(times) == len(seeds) + 1 else None


def run_own(program: Path, file: str) -> str:
    """Return what our own benchmark says of a mesh: lists, windows, nanoseconds a window, memory, sum of the distances."""
    line = subprocess.run([program, file], capture_output=True, text=True, check=True).stdout
    return " ".join(line.partition(" faces ")[2].split())


def report(name: str, result: Result | None, ours: Result | None = None) -> None:
    """Print what a solver took; beside ours, how many times as long, and how far its distances are from ours."""
    if result is None:
        print(f"  {name:16} failed", flush=True)
        return
    line = f"  {name:16} built {result.built:8.4f} s, a solve {result.solved:9.4f} s"
    if ours:
        both = (result.built + result.solved) / (ours.built + ours.solved)
        line += f"  {result.solved / ours.solved:6.1f} times as long, {both:6.1f} with what is built"
    errors = []
    for mine, other in zip(ours.fields, result.fields, strict=True) if ours and result.fields else ():
        known = np.isfinite(mine) & (mine > 0) & (other < 1e50)
        errors.append(np.abs(other[known] - mine[known]) / mine[known])
    if errors:
        error = np.concatenate(errors)
        line += f"  differs by {error.max():.1e} at most, {error.mean():.1e} on average, {np.median(error):.1e} in the median"
    print(line, flush=True)


def compare(file: Path, loop: int, options: argparse.Namespace) -> tuple[int, dict[str, float]]:
    """Compare the solvers on a file; return its faces and the times of a solve."""
    points, triangles = potpourri3d.read_mesh(str(file))
    points, triangles = np.ascontiguousarray(points, dtype=np.float64), np.ascontiguousarray(triangles, dtype=np.int32)
    for _ in range(loop):
        points, triangles = loop_subdivided(points, triangles)
    random = np.random.default_rng(0)
    seeds = [0, *(int(v) for v in random.choice(np.unique(triangles), options.seeds - 1))]
    print(f"{file.name}{' loop' + str(loop) if loop else ''}: {len(triangles)} triangles, {len(seeds)} seeds")
    results = measure(points, triangles, seeds, options)
    return len(triangles), {name: result.solved for name, result in results.items() if result}


def measure(
    points: Array, triangles: NDArray[np.int32], seeds: list[int], options: argparse.Namespace
) -> dict[str, Result | None]:
    """Measure and print what each solver takes on a mesh, and how far it is from ours."""
    ours = run_apart("Seamwire", points, triangles, seeds, options.repeats)
    report("Seamwire", ours)
    results = {"Seamwire": ours}
    if ours is None:
        return results
    exact = len(triangles) <= options.most_faces
    for name in SOLVERS:
        if name == "Seamwire" or name in options.skip or (name == "pygeodesic" and not exact):
            continue
        repeats = 1 if name == "pygeodesic" else options.repeats
        results[name] = run_apart(name, points, triangles, seeds, repeats)
        report(name, results[name], ours)
    if options.programs is None:
        return results
    with off_file(points, triangles) as path:
        print(f"  its own program: {run_own(options.programs / 'geodesics_bench', path)}", flush=True)
        cgal = options.programs / "cgal_bench"
        few = len(triangles) <= min(options.most_faces, MOST_FACES_OF_CGAL)
        if cgal.exists() and few and "CGAL" not in options.skip:
            results["CGAL"] = run_program(cgal, [path], seeds)
            report("CGAL", results["CGAL"], ours)
    return results


def exponent(faces: list[int], times: list[float]) -> float:
    """Return the slope of log time over log faces, by least squares."""
    return float(np.polyfit(np.log(faces), np.log(times), 1)[0])


def plot(curves: dict[str, list[tuple[int, float]]], file: Path) -> None:
    """Draw times over faces, both on logarithmic scales, as an SVG."""
    width, height, left, top, right, bottom = 640, 400, 60, 20, 160, 45
    every = [point for curve in curves.values() for point in curve]
    low = [np.floor(np.log10(min(p[i] for p in every))) for i in (0, 1)]
    high = [np.ceil(np.log10(max(p[i] for p in every))) for i in (0, 1)]

    def place(faces: float, seconds: float) -> tuple[float, float]:
        x = (np.log10(faces) - low[0]) / (high[0] - low[0])
        y = (np.log10(seconds) - low[1]) / (high[1] - low[1])
        return left + x * (width - left - right), height - bottom - y * (height - top - bottom)

    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
        f'<rect width="{width}" height="{height}" fill="white"/>',
    ]
    for power in range(int(low[0]), int(high[0]) + 1):
        x = place(10.0**power, 1)[0]
        lines.append(f'<path d="M{x:.1f} {top}V{height - bottom}" stroke="#ddd"/>')
        lines.append(f'<text x="{x:.1f}" y="{height - bottom + 16}" text-anchor="middle">{10**power:,}</text>')
    for power in range(int(low[1]), int(high[1]) + 1):
        y = place(1, 10.0**power)[1]
        lines.append(f'<path d="M{left} {y:.1f}H{width - right}" stroke="#ddd"/>')
        lines.append(f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g} s</text>')
    lines.append(f'<text x="{(left + width - right) / 2}" y="{height - 8}" text-anchor="middle">faces</text>')
    for color, (name, curve) in zip(("#d62728", "#1f77b4", "#2ca02c", "#9467bd"), curves.items(), strict=False):
        places = [place(*point) for point in curve]
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
        lines.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        lines += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in places]
        x, y = places[-1]
        # Names are to the right of the longest curves, and to the left above the others, where no curve runs.
        if curve[-1][0] == max(point[0] for point in every):
            lines.append(f'<text x="{x + 8:.1f}" y="{y + 4:.1f}" fill="{color}">{name}</text>')
        else:
            lines.append(f'<text x="{x - 8:.1f}" y="{y - 4:.1f}" text-anchor="end" fill="{color}">{name}</text>')
    file.write_text("\n".join([*lines, "</svg>"]) + "\n")


def main() -> None:
    """Compare the solvers on the meshes named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument(
        "--loop", type=int, action="append", help="levels of Loop subdivision; may be given several times"
    )
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--skip", action="append", default=[], choices=["pygeodesic", "heat method", "CGAL"])
    parser.add_argument("--most-faces", type=int, default=200_000, help="leave the exact peers out above")
    parser.add_argument(
        "--programs", type=Path, help="the folder with geodesics_bench and, where it was built, cgal_bench"
    )
    parser.add_argument("--plot", type=Path, help="an SVG of the times over the faces")
    options = parser.parse_args()
    curves: dict[str, list[tuple[int, float]]] = {}
    for mesh in options.meshes:
        for loop in options.loop or [0]:
            faces, times = compare(mesh, loop, options)
            for name, seconds in times.items():
                curves.setdefault(name, []).append((faces, seconds))
    for name, curve in curves.items():
        curve.sort()
        if len(options.loop or []) > 1:
            print(f"{name}: time grows with faces to the {exponent(*map(list, zip(*curve, strict=True))):.2f}")
    if options.plot:
        plot(curves, options.plot)


if __name__ == "__main__":
    main()
