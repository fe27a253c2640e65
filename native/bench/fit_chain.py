# SPDX-License-Identifier: GPL-3.0-or-later
"""How long it takes to fit a chain of edges to a line, beside the nearest that SciPy has to it.

    python native/bench/fit_chain.py [--sizes 100 300 700] [--edges 10 50 200 400] [--repeats N]

Needs SciPy. The mesh is a wavy square of SIZE x SIZE quads. The line is a spiral of so many edges with six points for each edge, and a
wobble of a fifth of an edge, as a hand draws it.

The comparison uses SciPy. A k-d tree of the mesh, made before the clock starts, finds the vertices within 1.5 edges of the line. A sparse
matrix has their edges, with lengths l (1 + 32 d^2 / h^2) from a k-d tree of the line. Dijkstra's algorithm then finds the chain. It ignores
turns and progress along the line, so it goes astray where the line comes by again.

Prints medians of both in milliseconds, their ratio within the same run, and how many edges the chain has.
"""

from __future__ import annotations

import argparse
import functools
import statistics
import time
from collections.abc import Callable

import numpy as np
import seamwire_core as sw
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

_WOBBLE = 0.2
_POINTS_PER_EDGE = 6


def wavy_square(size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the points (n, 3), triangles (m, 3) and edges (e, 2) of `size` x `size` quads."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(size + 1.0), np.arange(size + 1.0)))
    points = np.stack([x, y, 0.05 * size * np.sin(6.0 * x / size) * np.sin(6.0 * y / size)], 1)
    numbers = np.arange((size + 1) ** 2).reshape(size + 1, size + 1)
    a, b, c, d = numbers[:-1, :-1].ravel(), numbers[:-1, 1:].ravel(), numbers[1:, 1:].ravel(), numbers[1:, :-1].ravel()
    triangles = np.stack([a, b, c, a, c, d], 1).reshape(-1, 3)
    across = np.stack([numbers[:, :-1].ravel(), numbers[:, 1:].ravel()], 1)
    up = np.stack([numbers[:-1].ravel(), numbers[1:].ravel()], 1)
    return points, triangles, np.concatenate([across, up])


def spiral(size: int, edges: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the points (k, 3) of a line of that length on the square and the triangles that they lie in."""
    rng = np.random.default_rng(seed)
    along = np.arange(0.0, edges, 1.0 / _POINTS_PER_EDGE)
    apart = 8.0  # edges between two turns
    angle = np.sqrt(4.0 * np.pi * along / apart + 4.0)
    place = size / 2 + np.stack([np.cos(angle), np.sin(angle)], 1) * angle[:, None] * apart / (2.0 * np.pi)
    place += rng.uniform(-_WOBBLE, _WOBBLE, place.shape)
    place = np.clip(place, 0.0, size - 1e-9)
    column, row = place.astype(int).T
    inside = place - np.floor(place)
    above = inside[:, 1] > inside[:, 0]
    faces = 2 * (row * size + column) + above
    height = 0.05 * size * np.sin(6.0 * place[:, 0] / size) * np.sin(6.0 * place[:, 1] / size)
    return np.column_stack([place, height]), faces.astype(np.int32)


class WithSciPy:
    """The same job with SciPy, as far as it goes, on one mesh; its edges are about 1 long."""

    def __init__(self, points: np.ndarray, edges: np.ndarray) -> None:
        lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
        both = np.concatenate([edges, edges[:, ::-1]]).T
        self._points = points
        self._lengths = csr_matrix((np.tile(lengths, 2), both), shape=(len(points),) * 2)
        self._tree = cKDTree(points)

    def fit(self, line: np.ndarray, begin: int, end: int) -> list[int]:
        """Return the vertices of a cheapest path."""
        reached = self._tree.query_ball_point(line[::_POINTS_PER_EDGE], 1.5)
        near = np.unique(np.concatenate(reached).astype(int))
        part = self._lengths[near][:, near].tocoo()
        tree = cKDTree(line)
        off = tree.query(self._points[near])[0] ** 2
        middle = tree.query((self._points[near[part.row]] + self._points[near[part.col]]) / 2.0)[0] ** 2
        squared = (off[part.row] + off[part.col] + middle) / 3.0
        graph = csr_matrix((part.data * (1.0 + 32.0 * squared), (part.row, part.col)), shape=part.shape)
        first, at = np.searchsorted(near, [begin, end])
        before = dijkstra(graph, indices=first, return_predecessors=True)[1]
        path = [int(at)]
        while path[-1] != first:
            path.append(int(before[path[-1]]))
        return near[path[::-1]].tolist()


def median_time(work: Callable[[], object], repeats: int) -> float:
    """Return the median time of a call, in milliseconds."""
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return 1e3 * statistics.median(times)


def main() -> None:
    """Print a line for each mesh and each length."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="*", default=[100, 300, 700])
    parser.add_argument("--edges", type=int, nargs="*", default=[10, 50, 200, 400])
    parser.add_argument("--repeats", type=int, default=21)
    chosen = parser.parse_args()
    print("triangles  line  fit_chain ms  scipy ms  ratio  edges of the chain")
    for size in chosen.sizes:
        points, triangles, edges = wavy_square(size)
        surface = sw.Surface(points, triangles, edges)
        peer = WithSciPy(points, edges)
        for count in chosen.edges:
            line, faces = spiral(size, count, count)
            chain = sw.fit_chain(surface, line, faces).vertices.tolist()  # the first call prepares the surface
            ours = median_time(functools.partial(sw.fit_chain, surface, line, faces), chosen.repeats)
            theirs = median_time(functools.partial(peer.fit, line, chain[0], chain[-1]), chosen.repeats)
            print(
                f"{len(triangles):9d}  {count:4d}  {ours:12.2f}  {theirs:8.2f}  {ours / theirs:5.2f}  {len(chain) - 1:6d}"
            )


if __name__ == "__main__":
    main()
