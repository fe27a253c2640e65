# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender itself offers for picking chains of edges.

- *Pick Shortest Path* in edge mode is Dijkstra's algorithm over edges. A step from an edge to the next costs
  (|a| + |b|) (1 + (2 - sqrt|cos|) / 2), with the angle between the two, or 1 with *Topology Distance*.
- *Edge Loop Select* goes straight on at vertices of four edges, and along boundaries.
- *Select Linked Flat Faces* takes the faces around one that are reached over edges where faces meet in less than an angle.
- *Select Boundary Loop* takes the border of these faces.
- *Select Sharp Edges* takes all edges where faces meet in more than an angle.
"""

from itertools import pairwise

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, dijkstra
from seams_engine import polygon_edges

Pair = tuple[int, int]


class BlenderEngine:
    """Blender's selecting on one mesh, with the interface of seams_engine.SeamwireEngine.

    `topology`: offer the path by topology distance as well, after the other one.
    """

    def __init__(self, topology: bool = False) -> None:
        self._topology = topology

    def prepare(self, points: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> None:
        """Take a polygon mesh; points (n, 3), and face f has the corners corners[offsets[f]:offsets[f + 1]]."""
        edges = polygon_edges(offsets, corners)
        self.edges = edges[edges[:, 0] != edges[:, 1]]
        self.number = {(int(a), int(b)): k for k, (a, b) in enumerate(self.edges)}
        self._link_faces(offsets, corners)
        self._step_costs(points)
        self._measure_angles(points, offsets, corners)
        self._trees: dict[tuple[int, bool], np.ndarray] = {}
        self._borders: dict[float, dict[Pair, list[frozenset[Pair]]]] = {}

    def _link_faces(self, offsets: np.ndarray, corners: np.ndarray) -> None:
        self.faces_of: list[set[int]] = [set() for _ in self.edges]
        self.edges_at: dict[int, list[int]] = {}
        for k, pair in enumerate(self.edges.tolist()):
            for vertex in pair:
                self.edges_at.setdefault(vertex, []).append(k)
        for face, (begin, end) in enumerate(pairwise(offsets)):
            ring = corners[begin:end].tolist()
            for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
                if a != b:
                    self.faces_of[self.number[min(a, b), max(a, b)]].add(face)

    def _step_costs(self, points: np.ndarray) -> None:
        steps = [
            (one, two, vertex)
            for vertex, around in self.edges_at.items()
            for one in around
            for two in around
            if one != two
        ]
        one, two, vertex = np.array(steps).T
        towards = points[vertex] - points[self.edges[one].sum(axis=1) - vertex]
        away = points[self.edges[two].sum(axis=1) - vertex] - points[vertex]
        long_one, long_two = np.linalg.norm(towards, axis=1), np.linalg.norm(away, axis=1)
        cosine = np.abs(np.einsum("ij,ij->i", towards, away)) / np.maximum(long_one * long_two, 1e-30)
        cost = (long_one + long_two) * (1.0 + 0.5 * (2.0 - np.sqrt(np.minimum(cosine, 1.0))))
        # Two edges may share both ends: the cheaper step counts, and zeros would not be steps.
        order = np.lexsort((-cost, two, one))
        self.graph = csr_matrix((len(self.edges), len(self.edges)))
        data = dict(zip(zip(one[order].tolist(), two[order].tolist(), strict=True), cost[order], strict=True))
        rows, columns = np.array(list(data)).T
        self.graph = csr_matrix((np.maximum(list(data.values()), 1e-12), (rows, columns)), shape=self.graph.shape)

    def _measure_angles(self, points: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> None:
        """Find the angle, in degrees, in which the two faces of an edge meet; infinite where it has not two."""
        normals = np.zeros((len(offsets) - 1, 3))
        for face, (begin, end) in enumerate(pairwise(offsets)):
            ring = points[corners[begin:end]]
            normals[face] = np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        self._angles = np.full(len(self.edges), np.inf)
        for k, faces in enumerate(self.faces_of):
            if len(faces) == 2:
                one, two = faces
                self._angles[k] = np.degrees(np.arccos(np.clip(normals[one] @ normals[two], -1.0, 1.0)))

    def sharp_edges(self, degrees: float) -> frozenset[Pair]:
        """Return the edges that Select Sharp Edges takes."""
        return frozenset(self._pair(k) for k in np.flatnonzero((self._angles > degrees) & np.isfinite(self._angles)))

    def flat_borders(self, edge: Pair, degrees: float) -> list[frozenset[Pair]]:
        """Return the borders of the flat faces on both sides of an edge, where it is on them."""
        if degrees not in self._borders:
            self._borders[degrees] = self._find_borders(degrees)
        return self._borders[degrees].get(edge, [])

    def _find_borders(self, degrees: float) -> dict[Pair, list[frozenset[Pair]]]:
        """Return for each edge the borders that it is on: edges of which one face is inside, and one is not, or none is there."""
        links = [sorted(self.faces_of[k]) for k in np.flatnonzero(self._angles < degrees)]
        rows, columns = np.array(links, dtype=np.int64).reshape(-1, 2).T
        count = 1 + max((face for faces in self.faces_of for face in faces), default=0)
        joined = csr_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count))
        region = connected_components(joined, directed=False)[1]
        around: dict[int, set[Pair]] = {}
        for k, faces in enumerate(self.faces_of):
            beside = {int(region[face]) for face in faces}
            if len(beside) > 1 or len(faces) == 1:
                for inside in beside:
                    around.setdefault(inside, set()).add(self._pair(k))
        borders: dict[Pair, list[frozenset[Pair]]] = {}
        for border in map(frozenset, around.values()):
            for edge in border:
                borders.setdefault(edge, []).append(border)
        return borders

    def _pair(self, number: int) -> Pair:
        a, b = self.edges[number].tolist()
        return a, b

    def wires(self, seed: Pair, targets: list[Pair], _forward: bool) -> list[list[list[int]]]:
        """Offer the paths from a seed edge to each target edge, as their vertices."""
        start = self.number[min(seed), max(seed)]
        kinds = (False, True) if self._topology else (False,)
        for kind in kinds:
            if (start, kind) not in self._trees:
                _, tree = dijkstra(self.graph, indices=start, return_predecessors=True, unweighted=kind)
                self._trees[start, kind] = tree
        numbers = [self.number[min(target), max(target)] for target in targets]
        found = [[self._chain(self._trees[start, kind], start, number) for kind in kinds] for number in numbers]
        return [[chain for chain in chains if chain] for chains in found]

    def _chain(self, tree: np.ndarray, start: int, target: int) -> list[int]:
        path = [target]
        while path[-1] != start:
            path.append(int(tree[path[-1]]))
            if path[-1] < 0:
                return []
        return vertices_of([self._pair(k) for k in reversed(path)])

    def loop(self, edge: Pair) -> list[int] | None:
        """Offer the closed edge loop through an edge, its first vertex not repeated; None where it is open."""
        strip, closed = self.strip(edge)
        return strip if closed else None

    def strip(self, edge: Pair) -> tuple[list[int], bool]:
        """Return the vertices of the edge loop through an edge, and whether it is closed."""
        begin = self.number[min(edge), max(edge)]
        forth, closed = self._walk(begin, edge[1])
        if closed:
            return forth[:-1], True
        back, _ = self._walk(begin, edge[0])
        return back[::-1] + forth[2:], False

    def _walk(self, begin: int, towards: int) -> tuple[list[int], bool]:
        at, edge = towards, begin
        path = [int(self.edges[begin].sum()) - towards, towards]
        while True:
            following = self._straight_on(edge, at)
            if following is None or (following != begin and at in path[:-1]):
                return path, False
            if following == begin:
                return path, True
            edge, at = following, int(self.edges[following].sum()) - at
            path.append(at)

    def _straight_on(self, edge: int, vertex: int) -> int | None:
        around = self.edges_at[vertex]
        if len(self.faces_of[edge]) == 1:
            ways = [k for k in around if k != edge and len(self.faces_of[k]) == 1]
        elif len(around) == 4 and all(len(self.faces_of[k]) == 2 for k in around):
            ways = [k for k in around if k != edge and not self.faces_of[k] & self.faces_of[edge]]
        else:
            return None
        return ways[0] if len(ways) == 1 else None


def vertices_of(pairs: list[Pair]) -> list[int]:
    """Return the vertices along a chain of edges that follow each other."""
    if len(pairs) == 1:
        return [int(v) for v in pairs[0]]
    first, second = set(pairs[0]), set(pairs[1])
    chain = [int(v) for v in (*(first - second or {pairs[0][0]}), *(first & second))][:2]
    for pair in pairs[1:]:
        chain.append(int(sum(pair)) - chain[-1])
    return chain
