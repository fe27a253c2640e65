# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact geodesics of Seamwire beside those of other libraries, in one run on one machine.

    python native/bench/peers.py MESH... [--loop LEVELS] [--repeats N] [--seeds N] [--skip NAME]

Needs numpy, pygeodesic and potpourri3d, and seamwire_core on the path. All get the same triangles and the same seeds, one thread.
Prints the median time of a solve, how many times as long the others take, and how far their distances are from ours. Peers run in a
process of their own: some of them abort on meshes that are not manifold.
"""

import argparse
import multiprocessing
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Solve = Callable[[int], Array]


def seamwire(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return our exact solver, lengths in the mesh's own units."""
    import seamwire_core as sw

    surface = sw.Surface(points, triangles)
    metric = sw.euclidean_metric(surface, sw.principal_curvatures(surface))
    embedding = sw.embed(surface, metric)
    sw.distance_field(embedding, 0)  # the solver's own form of the mesh is made once
    return lambda seed: sw.distance_field(embedding, seed).distances[: len(points)] / surface.scale


def pygeodesic(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return the exact solver of Surazhsky et al. (2005)."""
    from pygeodesic import geodesic

    solver = geodesic.PyGeodesicAlgorithmExact(points, triangles)
    return lambda seed: solver.geodesicDistances(np.array([seed]))[0]


def potpourri3d_heat(points: Array, triangles: NDArray[np.int32]) -> Solve:
    """Return the heat method of Crane et al. (2013), approximate."""
    import potpourri3d

    solver = potpourri3d.MeshHeatMethodDistanceSolver(points, triangles)
    return solver.compute_distance


SOLVERS = {"seamwire": seamwire, "pygeodesic": pygeodesic, "potpourri3d heat": potpourri3d_heat}


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
    """Solve from each seed; send the median time and the fields through the pipe."""
    solve = SOLVERS[name](points, triangles)
    times, fields = [], []
    for seed in seeds:
        for _ in range(repeats):
            start = time.perf_counter()
            field = solve(seed)
            times.append(time.perf_counter() - start)
        fields.append(np.array(field))
    pipe.send((statistics.median(times), fields))


def run_apart(name: str, *arguments: object) -> tuple[float, list[Array]] | None:
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


def compare(file: Path, options: argparse.Namespace) -> None:
    """Print what each solver takes on a mesh, and how far it is from ours."""
    import potpourri3d

    points, triangles = potpourri3d.read_mesh(str(file))
    points, triangles = np.ascontiguousarray(points, dtype=np.float64), np.ascontiguousarray(triangles, dtype=np.int32)
    for _ in range(options.loop):
        points, triangles = loop_subdivided(points, triangles)
    random = np.random.default_rng(0)
    seeds = [0, *(int(v) for v in random.choice(np.unique(triangles), options.seeds - 1))]
    ours = run_apart("seamwire", points, triangles, seeds, options.repeats)
    print(
        f"{file.name}{' loop' + str(options.loop) if options.loop else ''}: {len(triangles)} triangles, {len(seeds)} seeds"
    )
    if ours is None:
        print("  seamwire         failed")
        return
    print(f"  seamwire         {ours[0]:9.4f} s")
    for name in SOLVERS:
        if name == "seamwire" or name in options.skip:
            continue
        theirs = run_apart(name, points, triangles, seeds, options.repeats)
        if theirs is None:
            print(f"  {name:16} failed")
            continue
        errors = []
        for mine, other in zip(ours[1], theirs[1], strict=True):
            both = np.isfinite(mine) & (mine > 0) & (other < 1e50)
            errors.append(np.abs(other[both] - mine[both]) / mine[both])
        error = np.concatenate(errors)
        print(
            f"  {name:16} {theirs[0]:9.4f} s  {theirs[0] / ours[0]:6.1f} times as long  differs by {error.max():.1e} at most, "
            f"{error.mean():.1e} on average"
        )


def main() -> None:
    """Compare the solvers on the meshes named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--loop", type=int, default=0, help="levels of Loop subdivision")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--skip", action="append", default=[], choices=[n for n in SOLVERS if n != "seamwire"])
    options = parser.parse_args()
    for mesh in options.meshes:
        compare(mesh, options)


if __name__ == "__main__":
    main()
