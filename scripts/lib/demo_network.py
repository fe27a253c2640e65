# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of wires for any mesh, as an example of what ``seamwire_core`` is used for.

The rule, in the order of the functions below:

1. Seeds lie far apart in the metric that follows features, and on features: farthest-point sampling, weighted by the difference of the
   principal curvatures.
2. Seeds whose cells touch are joined by a wire: the shorter of the two that the tool would show.
3. Where a segment is not a disk, it gets another seed, until every one is.
4. Wires are dropped again, those that follow features least and part the flattest pairs of segments first, as long as every segment stays
   a disk that is flatter than a half sphere.
5. Where two wires run side by side for a while and leave crumbs between them, the weaker one starts on the other instead.

On a mesh that is its own mirror image in x, seeds come and wires go in pairs.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from numpy.typing import NDArray

SEEDS = 24
"""Seeds to begin with."""
MOST_SEEDS = 120
"""Seeds at most, where segments are not disks yet."""
BEND = 0.42
"""The most that a segment's normals may spread: 0 in a plane, 0.5 for a half sphere."""
CRUMB = 0.004
"""Segments of less than this part of the surface are merged wherever they stay disks."""

Edge = tuple[int, int]


@dataclass(frozen=True)
class Wire:
    """A wire between two seeds: the vertices whose edges it marks, its curve, and how well it follows features (1: not at all)."""

    seeds: tuple[int, int]
    vertices: tuple[int, ...]
    points: NDArray[np.float64]
    strength: float

    def edges(self) -> list[Edge]:
        """Return the edges it marks, smaller vertex first."""
        return [(min(a, b), max(a, b)) for a, b in pairwise(self.vertices)]


@dataclass(frozen=True)
class Network:
    """Wires, and the number of the segment that each triangle lies in."""

    wires: list[Wire]
    segments: NDArray[np.int64]

    def chains(self) -> str:
        """Write the wires as the operator ``mesh.seamwire_mark`` takes them."""
        return "; ".join(f"{a} {b}" for a, b in (wire.seeds for wire in self.wires))

    def edges(self) -> set[Edge]:
        """Return all edges that the wires mark."""
        return {edge for wire in self.wires for edge in wire.edges()}


class Drawing:
    """The surface, its metric, and the wires of the seeds placed so far."""

    def __init__(
        self,
        sw: ModuleType,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        edges: NDArray[np.int32],
        along: Literal["edges", "surface"],
        strength: float,
    ) -> None:
        self.points, self.triangles = points, triangles
        self._sw = sw
        surface = sw.Surface(points, triangles, edges)
        curvature = sw.principal_curvatures(surface)
        metric = sw.feature_metric(surface, curvature, follow="min", max_anisotropy=10.0, clamp_percentile=99.0)
        self._embedding = sw.embed(surface, metric)
        self._live = sw.LiveWire(surface, along=along, max_anisotropy=strength, clamp_percentile=99.0)
        self._scale = surface.scale
        # Ranks, not values: one sharp corner must not outweigh all soft ridges.
        self._feature = np.argsort(np.argsort(curvature.difference)) / max(len(points) - 1, 1)
        self._wires: dict[Edge, Wire | None] = {}
        self._distances: list[NDArray[np.float64]] = []
        self.seeds: list[int] = []
        self._used = np.zeros(len(points), dtype=bool)
        self._used[triangles] = True
        self._image = _mirror_images(points)

    def add_seed(self, among: NDArray[np.bool_] | None = None) -> bool:
        """Place the seed that is farthest from all others and on the strongest feature; False where no vertex is left."""
        free = self._used.copy() if among is None else self._used & among
        free[self.seeds] = False
        if not free.any():
            return False
        nearest = self._nearest()
        reach = np.where(np.isfinite(nearest), nearest, 0.0).max(initial=0.0)
        # Components that have no seed yet come first: they are infinitely far away.
        far = np.where(np.isfinite(nearest), nearest, 2.0 * max(reach, 1.0))
        score = np.where(free, far * (0.3 + self._feature), -1.0)
        seed = int(score.argmax())
        for one in {seed: None, self.mirrored(seed): None}:
            self.seeds.append(one)
            self._distances.append(np.array(self._sw.distance_field(self._embedding, one).distances))
        return True

    def mirrored(self, vertex: int) -> int:
        """Return the mirror image of a vertex; the vertex itself where the mesh is not symmetric."""
        return vertex if self._image is None else int(self._image[vertex])

    def _nearest(self) -> NDArray[np.float64]:
        if not self._distances:
            return np.full(len(self.points), np.inf)
        return np.min(self._distances, axis=0)

    def wires(self) -> list[Wire]:
        """Return the wires between all seeds whose cells touch."""
        distances = np.array(self._distances)
        cell = np.where(np.isfinite(distances).any(axis=0), distances.argmin(axis=0), -1)
        sides = cell[np.concatenate([self.triangles[:, [0, 1]], self.triangles[:, [1, 2]], self.triangles[:, [2, 0]]])]
        touching = np.unique(np.sort(sides[(sides[:, 0] != sides[:, 1]) & (sides >= 0).all(axis=1)], axis=1), axis=0)
        wanted = [(int(a), int(b)) for a, b in touching]
        for first in sorted({a for a, b in wanted if (a, b) not in self._wires}):
            self._live.seed(self.seeds[first])
            self._live.wait()
            for pair in wanted:
                if pair[0] == first and pair not in self._wires:
                    self._wires[pair] = self._wire(self.seeds[first], self.seeds[pair[1]])
        found = [(pair, wire) for pair in wanted if (wire := self._wires[pair]) is not None]
        # A wire that strays into other seeds' cells runs beside their wires: it goes before them.
        strays = [float(np.isin(cell[list(wire.vertices)], pair, invert=True).mean()) for pair, wire in found]
        return [
            replace(wire, strength=wire.strength / (1 + 5 * stray))
            for (_, wire), stray in zip(found, strays, strict=True)
        ]

    def wire_between(self, start: int, end: int) -> Wire | None:
        """Return the wire between two vertices; None where there is none."""
        self._live.seed(start)
        self._live.wait()
        return self._wire(start, end)

    def _wire(self, start: int, end: int) -> Wire | None:
        found = self._live.wires(end)
        shorter = found.wires[found.shorter]
        if len(shorter.vertices) < 2:
            return None
        points = np.array(shorter.points)
        euclidean = self._scale * np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        strength = euclidean / shorter.length if shorter.length > 0 else 1.0
        return Wire((start, end), tuple(int(v) for v in shorter.vertices), points, float(strength))


class Segments:
    """The pieces that a set of wires cuts the triangles into, and what becomes of them when a wire goes.

    A piece is a disk when it is connected and its Euler characteristic is 1. Cut open, a mesh has a vertex for every fan of corners that
    hang together; glueing two sides takes away one edge, and the vertices that it unites.
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], wires: list[Wire]) -> None:
        self.triangles = triangles
        self.wires = list(wires)
        self._covered = Counter(edge for wire in wires for edge in wire.edges())
        self._sides = _sides_of_edges(triangles)
        keys = np.array(list(self._sides), dtype=np.int64).reshape(-1, 2)
        sides = np.array(list(self._sides.values()), dtype=np.int64).reshape(-1, 4)
        glued = np.array([tuple(key) not in self._covered for key in keys.tolist()], dtype=bool)
        # A side is (triangle, its corner there) for both ends of the edge; corners are numbered 3 t + k.
        one, two = sides[glued, :2], sides[glued, 2:]
        corners = _components(3 * len(triangles), np.concatenate([np.stack([one[:, k], two[:, k]], 1) for k in (0, 1)]))
        faces = _components(len(triangles), np.stack([one[:, 0] // 3, two[:, 0] // 3], axis=1))
        self.label, self._face_of = np.unique(faces, return_inverse=True)
        count = len(self.label)
        _, self._corner_of = np.unique(corners, return_inverse=True)
        normals = np.cross(
            points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
        )
        areas = np.linalg.norm(normals, axis=1)
        face_count = np.bincount(self._face_of, minlength=count)
        inner = np.bincount(self._face_of[one[:, 0] // 3], minlength=count)
        fans = np.zeros(count, dtype=np.int64)
        first_corner = np.unique(self._corner_of, return_index=True)[1]
        np.add.at(fans, self._face_of[first_corner // 3], 1)
        # F - E + V, where E = 3 F - (glued pairs of sides).
        self._euler = (face_count - (3 * face_count - inner) + fans).tolist()
        self._area = np.bincount(self._face_of, areas, minlength=count).tolist()
        self._normal = np.stack([np.bincount(self._face_of, normals[:, k], minlength=count) for k in range(3)], axis=1)
        self._whole = float(areas.sum())
        self._face_parent = list(range(count))
        self._corner_parent = list(range(len(first_corner)))

    def vertices_of_worst(self) -> NDArray[np.bool_] | None:
        """Return which vertices lie in the biggest segment that is not a disk; None where all are."""
        bad = [piece for piece, euler in enumerate(self._euler) if euler != 1 and self._area[piece] > 0]
        if not bad:
            return None
        worst = max(bad, key=self._area.__getitem__)
        inside = np.zeros(int(self.triangles.max()) + 1, dtype=bool)
        inside[self.triangles[self._face_of == worst]] = True
        return inside

    def all_disks(self) -> bool:
        """Whether every segment is a disk."""
        roots = {_root(self._face_parent, piece) for piece in range(len(self._face_parent))}
        return all(self._euler[piece] == 1 for piece in roots)

    def cost_of_dropping(self, wire: Wire) -> float:
        """Return how much is lost without a wire; infinite where a segment would no longer be a flat enough disk."""
        trial = self._glue(wire, list(self._corner_parent))
        if trial is None:
            return 0.0  # it marks nothing of its own
        pieces, euler = trial
        if euler != 1:
            return np.inf
        area = sum(self._area[piece] for piece in pieces)
        bend = 1.0 - float(np.linalg.norm(sum(self._normal[piece] for piece in pieces))) / max(area, 1e-300)
        smallest = min(self._area[piece] for piece in pieces) / self._whole
        if bend > BEND and not (len(pieces) > 1 and smallest < CRUMB):
            return np.inf
        if len(pieces) == 1:
            return 1e-3 * bend * wire.strength  # a cut that ends inside a segment
        return (bend + 0.02) * wire.strength * smallest**0.25

    def drop(self, wire: Wire) -> None:
        """Take a wire away and glue what only it had cut."""
        trial = self._glue(wire, self._corner_parent)
        self.wires.remove(wire)
        self._covered.subtract(wire.edges())
        if trial is None:
            return
        pieces, euler = trial
        keep, *others = pieces
        for piece in others:
            self._face_parent[piece] = keep
            self._area[keep] += self._area[piece]
            self._normal[keep] += self._normal[piece]
        self._euler[keep] = euler

    def _glue(self, wire: Wire, corner_parent: list[int]) -> tuple[list[int], int] | None:
        """Glue the edges that only this wire covers; return the pieces it joins and the Euler characteristic of their union."""
        pieces: dict[int, None] = {}
        change = 0
        for edge in dict.fromkeys(wire.edges()):
            if self._covered[edge] > wire.edges().count(edge) or edge not in self._sides:
                continue
            a, b, c, d = self._sides[edge]
            for corner in (a, c):
                pieces[_root(self._face_parent, int(self._face_of[corner // 3]))] = None
            change += 1
            for one, two in ((a, c), (b, d)):
                first = _root(corner_parent, int(self._corner_of[one]))
                second = _root(corner_parent, int(self._corner_of[two]))
                if first != second:
                    corner_parent[second] = first
                    change -= 1
        if not pieces:
            return None
        if len(pieces) > 1 and not self._connected(wire, pieces):
            return list(pieces), 0
        return list(pieces), sum(self._euler[piece] for piece in pieces) + change

    def _connected(self, wire: Wire, pieces: dict[int, None]) -> bool:
        """Whether the pieces beside a wire all hang together once it is gone."""
        group = {piece: piece for piece in pieces}

        def find(piece: int) -> int:
            while group[piece] != piece:
                piece = group[piece]
            return piece

        for edge in wire.edges():
            if self._covered[edge] > wire.edges().count(edge) or edge not in self._sides:
                continue
            a, _, c, _ = self._sides[edge]
            one, two = (find(_root(self._face_parent, int(self._face_of[corner // 3]))) for corner in (a, c))
            group[two] = one
        return len({find(piece) for piece in pieces}) == 1

    def most_bent(self) -> float:
        """Return the spread of the normals of the piece that is least flat; 1 at once where a piece is no disk."""
        if not self.all_disks():
            return 1.0
        bends = 1.0 - np.linalg.norm(self._normal, axis=1) / np.maximum(self._area, 1e-300)
        return float(bends.max(initial=BEND, where=np.array(self._area) > CRUMB * self._whole))

    def crumbs(self) -> int:
        """Return how many pieces are very small."""
        return sum(area < CRUMB * self._whole for area in self._area)

    def state(self) -> tuple:
        """Return all that dropping wires changes."""
        changing = (self.wires, self._covered, self._euler, self._area, self._face_parent, self._corner_parent)
        return (*(item.copy() for item in changing), self._normal.copy())

    def restore(self, state: tuple) -> None:
        """Go back to a state."""
        (
            self.wires,
            self._covered,
            self._euler,
            self._area,
            self._face_parent,
            self._corner_parent,
            self._normal,
        ) = state

    def labels(self) -> NDArray[np.int64]:
        """Return the segment of each triangle, numbered from 0."""
        roots = np.array([_root(self._face_parent, piece) for piece in range(len(self._face_parent))])
        return np.unique(roots[self._face_of], return_inverse=True)[1]


def _root(parent: list[int], item: int) -> int:
    while parent[item] != item:
        item = parent[item]
    return item


def _mirror_images(points: NDArray[np.float64]) -> NDArray[np.int64] | None:
    """Return for each vertex its mirror image in x; None unless nearly every vertex has one."""
    size = np.ptp(points, axis=0).max(initial=0.0)
    if size == 0.0:
        return None
    grid = np.round(points / (1e-4 * size)).astype(np.int64)
    place = {tuple(key): vertex for vertex, key in enumerate(grid.tolist())}
    images = np.array([place.get((-x, y, z), -1) for x, y, z in grid.tolist()])
    if (images < 0).mean() > 0.02:
        return None
    return np.where(images < 0, np.arange(len(points)), images)


def _sides_of_edges(triangles: NDArray[np.int32]) -> dict[Edge, tuple[int, int, int, int]]:
    """For each edge of exactly two triangles: the corners at its smaller and larger vertex, in the one and in the other triangle."""
    corners = np.arange(triangles.size).reshape(-1, 3)
    start = np.concatenate([triangles[:, k] for k in range(3)]).astype(np.int64)
    end = np.concatenate([triangles[:, (k + 1) % 3] for k in range(3)]).astype(np.int64)
    at_start = np.concatenate([corners[:, k] for k in range(3)])
    at_end = np.concatenate([corners[:, (k + 1) % 3] for k in range(3)])
    swap = start > end
    low, high = np.where(swap, end, start), np.where(swap, start, end)
    at_low, at_high = np.where(swap, at_end, at_start), np.where(swap, at_start, at_end)
    order = np.lexsort((high, low))
    low, high, at_low, at_high = low[order], high[order], at_low[order], at_high[order]
    new = np.concatenate([[True], (low[1:] != low[:-1]) | (high[1:] != high[:-1])])
    first = np.flatnonzero(new)
    pairs = first[np.diff(np.append(first, len(low))) == 2]
    table = np.stack([low, high, at_low, at_high, np.roll(at_low, -1), np.roll(at_high, -1)], axis=1)[pairs]
    return {(a, b): (c, d, e, f) for a, b, c, d, e, f in table.tolist()}


def _components(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return for each of so many items the smallest item that it hangs together with."""
    label = np.arange(count)
    while True:
        one, two = label[pairs[:, 0]], label[pairs[:, 1]]
        apart = one != two
        if not apart.any():
            return label
        np.minimum.at(label, np.maximum(one, two)[apart], np.minimum(one, two)[apart])
        while not np.array_equal(label, label[label]):
            label = label[label]


def _thin_out(segments: Segments, mirrored: Callable[[int], int]) -> None:
    """Drop wires, and their mirror images with them, until each that is left is needed."""
    needed: set[tuple[int, ...]] = set()
    while True:
        costs = [
            (segments.cost_of_dropping(wire), index)
            for index, wire in enumerate(segments.wires)
            if tuple(sorted(wire.seeds)) not in needed
        ]
        cost, index = min(costs, default=(np.inf, 0))
        if cost == np.inf:
            return
        wire = segments.wires[index]
        image = tuple(sorted(mirrored(seed) for seed in wire.seeds))
        before = segments.state()
        segments.drop(wire)
        for other in [other for other in segments.wires if tuple(sorted(other.seeds)) == image]:
            if segments.cost_of_dropping(other) < np.inf:
                segments.drop(other)
            else:
                segments.restore(before)
                needed |= {image, tuple(sorted(wire.seeds))}


def _edge(wire: Wire, place: int) -> Edge:
    one, two = wire.vertices[place : place + 2]
    return min(one, two), max(one, two)


def _sweep(drawing: Drawing, wires: list[Wire]) -> Segments:
    """Let wires start on others where they ran beside them, as long as that leaves fewer crumbs and every segment as good."""
    best = Segments(drawing.points, drawing.triangles, wires)
    for wire in sorted(wires, key=lambda one: one.strength):
        if best.crumbs() == 0:
            break
        others = [other for other in best.wires if other is not wire]
        drawn = {vertex for other in others for vertex in other.vertices}
        last = len(wire.vertices) - 1
        contacts = [place for place, vertex in enumerate(wire.vertices) if vertex in drawn or place in (0, last)]
        shared = {edge for other in others for edge in other.edges()}
        stretches = [(a, b) for a, b in pairwise(contacts) if b - a > 1 or _edge(wire, a) not in shared]
        for left_out in stretches if len(contacts) > 2 else ():
            parts = [
                drawing.wire_between(wire.vertices[a], wire.vertices[b]) for a, b in stretches if (a, b) != left_out
            ]
            trial = Segments(drawing.points, drawing.triangles, others + [part for part in parts if part is not None])
            if trial.crumbs() < best.crumbs() and trial.most_bent() <= min(best.most_bent() + 0.02, 0.99):
                best = trial
                break
    return best


def plan(
    sw: ModuleType,
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    along: Literal["edges", "surface"],
    strength: float,
    tell: Callable[[str], None],
) -> Network:
    """Plan a network of wires that cuts the mesh into disks.

    Parameters
    ----------
    sw
        The module ``seamwire_core``.
    points, triangles, edges
        (n, 3), (m, 3) and (e, 2): the mesh; the edges are those of its polygons.
    along
        Where the wires run.
    strength
        The metric's largest anisotropy: that of whatever is to draw these wires again.
    tell
        Is told in a line what was done.
    """
    drawing = Drawing(sw, points, triangles, edges, along, strength)
    while len(drawing.seeds) < SEEDS and drawing.add_seed():
        pass
    while True:
        segments = Segments(points, triangles, drawing.wires())
        worst = segments.vertices_of_worst()
        if worst is None or len(drawing.seeds) >= MOST_SEEDS or not drawing.add_seed(among=worst):
            break
    tell(f"{len(drawing.seeds)} seeds, {len(segments.wires)} wires between neighbours, {len(segments.label)} segments")
    _thin_out(segments, drawing.mirrored)
    segments = _sweep(drawing, segments.wires)
    labels = segments.labels()
    state = "all of them disks" if segments.all_disks() else "some of them not disks"
    tell(f"{len(segments.wires)} wires kept, {labels.max() + 1} segments, {state}")
    return Network(segments.wires, labels)
