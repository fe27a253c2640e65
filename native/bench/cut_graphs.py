# SPDX-License-Identifier: GPL-3.0-or-later
"""The cuts that make a closed surface with handles a disc, ours beside plain short ones.

    python native/bench/cut_graphs.py MESH...

A torus with two grooves, a plain one, and meshes (OBJ, OFF). Ours: `SeamPlanner` with every limit off, as *Open Islands* has it: of
24 and of 300 seeds what costs less; and the same in the Euclidean metric. Beside them the greedy system of loops along edges (Erickson and
Whittlesey, Greedy optimal homotopy and homology generators, 2005), the shortest of some base points, the union of its loops without open
ends. Lengths are along edges, over the longest side of the box. Feature and hollow: where the seam's vertices stand, in the mean by length,
among all by |k1| - |k2| and by how concave they are (0.5: anywhere). Seen: the share of rays that leave the surface there, over the same
share of all vertices.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import seamwire_core as sw
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts/lib"))
sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from figure_models import read
from seamwire.core.suggestion import SEEDS_TO_OPEN  # knows no Blender

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Integers = NDArray[np.int64]

_RAYS, _SAMPLES = 64, 500
_AROUND, _ALONG = 48, 160


def main() -> None:
    """Print a line a way of cutting."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--bases", type=int, default=60, help="base points of the greedy loops")
    options = parser.parse_args()
    made = [("torus with grooves", *torus(0.25)), ("torus", *torus(0.0))]
    for name, points, triangles in [*made, *((path.stem, *read(path)) for path in options.meshes)]:
        mesh = Mesh(points, triangles)
        print(f"{name}: {len(triangles)} triangles, genus {mesh.genus}")
        ways = {
            "ours, across": partial(mesh.planned, "surface", 20.0),
            "ours, edges": partial(mesh.planned, "edges", 10.0),
            "Euclidean, across": partial(mesh.planned, "surface", 1.0),
            "Euclidean, edges": partial(mesh.planned, "edges", 1.0),
            "greedy loops": partial(mesh.greedy, options.bases),
        }
        for way, make in ways.items():
            begun = time.process_time()
            edges = make()
            spent = time.process_time() - begun
            length, feature, hollow, seen = mesh.judge(edges)
            print(
                f"   {way:18} length {length:6.3f}  feature {feature:.2f}  hollow {hollow:.2f}  seen {seen:.2f}  {spent:6.2f} s"
            )


def torus(depth: float) -> tuple[Points, NDArray[np.int32]]:
    """Return a torus whose tube has a groove inside the ring and one across it, so deep."""
    u, v = np.meshgrid(np.arange(_ALONG) / _ALONG, np.arange(_AROUND) / _AROUND, indexing="ij")
    turn, round_ = 2.0 * np.pi * u, 2.0 * np.pi * v
    groove = depth * (np.exp(-(((v - 0.4) / 0.03) ** 2)) + np.exp(-(((u - 0.3) / 0.01) ** 2)))
    radius = 0.4 * (1.0 - groove)
    ring = 1.0 + radius * np.cos(round_)
    points = np.stack([ring * np.cos(turn), ring * np.sin(turn), radius * np.sin(round_)], axis=2).reshape(-1, 3)
    a = np.arange(_ALONG * _AROUND).reshape(_ALONG, _AROUND)
    b, c = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    d = np.roll(b, -1, axis=1)
    triangles = np.concatenate([np.stack([a, b, d], axis=2), np.stack([a, d, c], axis=2)]).reshape(-1, 3)
    return points, triangles.astype(np.int32)


@dataclass(frozen=True)
class Mesh:
    """A closed surface.

    Parameters
    ----------
    points, triangles
        (n, 3) and (m, 3).
    """

    points: Points
    triangles: NDArray[np.int32]

    @cached_property
    def _edges(self) -> tuple[Integers, Integers]:
        """The edges, (e, 2), and the two triangles of each."""
        sides = np.sort(np.stack([self.triangles, np.roll(self.triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
        edges, inverse, counts = np.unique(sides.astype(np.int64), axis=0, return_inverse=True, return_counts=True)
        if (counts != 2).any():
            raise ValueError("The mesh is not closed, or no manifold")
        return edges, (np.argsort(inverse.ravel(), kind="stable") // 3).reshape(-1, 2)

    @cached_property
    def _lengths(self) -> Points:
        edges = self._edges[0]
        return np.linalg.norm(self.points[edges[:, 0]] - self.points[edges[:, 1]], axis=1)

    @cached_property
    def _surface(self) -> sw.Surface:
        return sw.Surface(self.points, self.triangles, self._edges[0].astype(np.int32))

    @property
    def genus(self) -> int:
        """How many handles it has."""
        return (2 - (len(np.unique(self.triangles)) - len(self._edges[0]) + len(self.triangles))) // 2

    def planned(self, along: str, strength: float) -> Integers:
        """Return the seams, edges by their numbers, of a plan that makes it a disc and no more."""
        planners = [
            sw.SeamPlanner(self._surface, along=along, max_anisotropy=strength, seeds=seeds, most_seeds=seeds + 120)
            for seeds in SEEDS_TO_OPEN
        ]
        plan = min((planner.plan(max_spread=1.0) for planner in planners), key=lambda one: one.cost)
        if plan.not_discs or plan.island_count != 1:
            raise RuntimeError(f"{plan.island_count} islands, {plan.not_discs} of them no discs")
        pairs = np.concatenate([np.stack([w.vertices[:-1], w.vertices[1:]], axis=1) for w in plan.wires])
        return np.unique(self._numbers(pairs))

    def greedy(self, bases: int) -> Integers:
        """Return the shortest cut graph of the greedy loops at some base points, edges by their numbers."""
        draw = np.random.default_rng(1)
        used = np.unique(self.triangles)
        found = [self._loops_at(base) for base in draw.choice(used, min(bases, len(used)), replace=False).tolist()]
        return min(found, key=lambda edges: self._lengths[edges].sum())

    def _loops_at(self, base: int) -> Integers:
        edges, faces = self._edges
        count = len(self.points)
        graph = csr_matrix((self._lengths, (edges[:, 0], edges[:, 1])), shape=(count, count))
        far, before = dijkstra(graph, directed=False, indices=base, return_predecessors=True)
        reached = np.flatnonzero(before >= 0)
        in_tree = np.zeros(len(edges), dtype=bool)
        in_tree[self._numbers(np.stack([reached, before[reached]], axis=1))] = True
        # The dual tree of the longest loops: what is in neither closes 2 g loops, the shortest there are.
        loops = far[edges[:, 0]] + far[edges[:, 1]] + self._lengths
        rest = np.flatnonzero(~in_tree)
        weights = loops.max() * 2.0 - loops[rest]
        dual = csr_matrix((weights, (faces[rest, 0], faces[rest, 1])), shape=(len(self.triangles),) * 2)
        # Triangles with two sides in common would have the weights added: closed surfaces of triangles have none.
        tree = minimum_spanning_tree(dual).tocoo()
        kept = set(zip(tree.row.tolist(), tree.col.tolist(), strict=True))
        open_ = [e for e in rest.tolist() if not {tuple(faces[e]), tuple(faces[e][::-1])} & kept]
        cut = set(open_)
        for vertex in edges[open_].ravel().tolist():
            while vertex != base and before[vertex] >= 0:
                cut.add(int(self._numbers(np.array([[vertex, before[vertex]]]))[0]))
                vertex = int(before[vertex])
        return self._without_ends(np.array(sorted(cut)))

    def _without_ends(self, chosen: Integers) -> Integers:
        """Return edges without those that lead to nowhere."""
        edges = self._edges[0]
        while True:
            ends = np.bincount(edges[chosen].ravel(), minlength=len(self.points)) == 1
            loose = ends[edges[chosen]].any(axis=1)
            if not loose.any():
                return chosen
            chosen = chosen[~loose]

    def _numbers(self, pairs: Integers) -> Integers:
        edges, count = self._edges[0], len(self.points)
        pairs = np.sort(pairs.astype(np.int64), axis=1)
        return np.searchsorted(edges[:, 0] * count + edges[:, 1], pairs[:, 0] * count + pairs[:, 1])

    def judge(self, chosen: Integers) -> tuple[float, float, float, float]:
        """Return the length of edges, how they stand by feature and by concavity, and how well they are seen."""
        edges = self._edges[0][chosen]
        lengths = self._lengths[chosen]
        curvature, smoothed = self._curvatures
        places = np.unique(edges)
        return (
            float(lengths.sum() / np.ptp(self.points, axis=0).max()),
            float(np.average(_ranks(curvature.difference)[edges].mean(axis=1), weights=lengths)),
            float(np.average(_ranks(-smoothed.k1)[edges].mean(axis=1), weights=lengths)),
            self._openness(places) / self._mean_openness,
        )

    @cached_property
    def _curvatures(self) -> tuple[sw.Curvature, sw.Curvature]:
        curvature = sw.principal_curvatures(self._surface)
        return curvature, sw.smoothed_curvatures(self._surface, curvature)

    @cached_property
    def _tree(self) -> sw.RayTree:
        tree = sw.RayTree(self.points, self.triangles)
        tree.wait()
        return tree

    @cached_property
    def _mean_openness(self) -> float:
        used = np.unique(self.triangles)
        return self._openness(np.random.default_rng(2).choice(used, min(_SAMPLES, len(used)), replace=False))

    def _openness(self, vertices: Integers) -> float:
        """Return the share of rays from vertices, half spheres of them, that meet nothing."""
        draw = np.random.default_rng(3)
        directions = draw.normal(size=(_RAYS, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        normals = self._curvatures[0].normals
        size = np.ptp(self.points, axis=0).max()
        free = 0
        for vertex in vertices.tolist():
            outward = directions * np.sign(directions @ normals[vertex])[:, None]
            origin = self.points[vertex] + 1e-4 * size * normals[vertex]
            free += sum(self._tree.first_hit(origin, direction) is None for direction in outward)
        return free / (_RAYS * len(vertices))


def _ranks(values: Points) -> Points:
    return np.argsort(np.argsort(values)) / max(len(values) - 1, 1)


if __name__ == "__main__":
    main()
