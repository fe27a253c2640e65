# SPDX-License-Identifier: GPL-3.0-or-later
"""Where points of one mesh are on another one: by the nearest point of the aligned surface, or by distances to known pairs."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .tool import Places, area_normals, load, units

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import NearestPoints

PLACED = 0.3
"""The fraction that is finished when the first wire is drawn: before that, seeds are placed."""
Progress = Callable[[float], bool]
"""Takes the finished fraction, and returns whether to continue."""
_STEPS = 30
"""Of the alignment: it has come to rest long before on shapes that are alike."""
_ELSEWHERE = 0.1
"""As part of the mesh's size: what lies that far off lies elsewhere."""
_RIVAL = 2.0
"""An alternative is a rival if its distance is at most this many times larger. On artists' models, moved and with another topology, the
ratio is 1.06 for wrong choices and at least 2.6 for unique ones (docs/benchmarks/clicks.md)."""
_TURNED = 5.0
"""Degrees: what is turned by less than that lies elsewhere because it is moved."""
_SAMPLE = 100
"""How many points it looks at."""
_TRIMMED = 0.8
"""The fraction of points that the alignment uses, the nearest ones. Parts that only one mesh has do not pull."""
_ALIGNED = 0.01
"""As part of the mesh's size: points this near to a surface lie on it as they are."""
_CREASE = 30.0
"""Degrees: where a surface is as sharp as that, a seed lies on the edge on purpose."""
DOUBTFUL = 0.25
"""The confidence from which on a point has a place."""
_APART = 0.5
"""By how much more another place's distances have to be off for the best one to be sure."""


def tell(progress: Progress, fraction: float) -> None:
    """Tell the finished fraction. Raise `seamwire_core.Cancelled` if the work is to stop."""
    if not progress(fraction):
        raise load().Cancelled


def within(progress: Progress, begin: float, end: float) -> Progress:
    """Return the progress of a part of the work, which is finished from one fraction of the whole to another."""
    return lambda fraction: progress(begin + (end - begin) * fraction)


@dataclass(frozen=True)
class Moments:
    """Where a surface lies, whatever its triangles are: its center of area, (3,), and its principal axes, (3, 3).

    The longest axis comes first. Each is as long as the standard deviation along it.
    """

    middle: NDArray[np.float64]
    axes: NDArray[np.float64]

    @classmethod
    def of(cls, points: NDArray[np.float64], triangles: NDArray[np.int32]) -> Moments:
        """Return those of a mesh; of one without an area, zeros."""
        corners, areas = points[triangles], 0.5 * np.linalg.norm(area_normals(points, triangles), axis=1)
        total = float(areas.sum())
        if not total > 0.0:
            return cls(np.zeros(3), np.zeros((3, 3)))
        middles = corners.mean(axis=1)
        middle = areas @ middles / total
        off = np.concatenate([corners.transpose(1, 0, 2), middles[None]]) - middle
        # Over a triangle the square is that of its corners and thrice that of its middle, each a twelfth and nine twelfths.
        weights = np.array([1.0, 1.0, 1.0, 9.0]) / 12.0
        square = np.einsum("c,m,cmi,cmj->ij", weights, areas, off, off) / total
        values, vectors = np.linalg.eigh(square)
        axes = (vectors * np.sqrt(np.maximum(values, 0.0))).T[::-1]
        return cls(middle, axes)

    @property
    def size(self) -> float:
        """The standard deviation in all directions together."""
        return float(np.linalg.norm(self.axes))


def _vertex_normals(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return unit normals of (n, 3) vertices, weighted by the areas of their (m, 3) triangles. Vertices without triangles have zero."""
    rows, normals = triangles.reshape(-1), area_normals(points, triangles)
    return units(np.stack([np.bincount(rows, np.repeat(column, 3), len(points)) for column in normals.T], axis=1))


def _creases(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return the largest angle, in degrees, between two triangles that share a side at each vertex, (n,)."""
    normals = units(area_normals(points, triangles))
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64), axis=1)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    shared = np.flatnonzero((sides[order[1:]] == sides[order[:-1]]).all(axis=1))
    one, other = order[shared], order[shared + 1]
    cosines = np.einsum("ij,ij->i", normals[one // 3], normals[other // 3])
    angles = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    largest = np.zeros(len(points))
    for column in sides[one].T:
        np.maximum.at(largest, column, angles)
    return largest


@dataclass(frozen=True)
class Shape:
    """A mesh as arrays."""

    points: NDArray[np.float64]  # (n, 3) vertices as sessions have them
    triangles: NDArray[np.int32]  # (m, 3)
    edges: NDArray[np.int32]  # (e, 2) the edges that wires may run along
    to_object: NDArray[np.float64] | None = None  # (3, 3) takes `points` to object coordinates

    @cached_property
    def where(self) -> Places:
        return Places(self.points, np.eye(3) if self.to_object is None else self.to_object)

    @property
    def places(self) -> NDArray[np.float64]:
        """(n, 3) the vertices in object coordinates."""
        return self.where.in_object

    def in_object(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (k, 3) points in object coordinates."""
        return points @ self.where.to_object.T

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """(n, 3) of the vertices, in object coordinates."""
        return _vertex_normals(self.places, self.triangles)

    @cached_property
    def creases(self) -> NDArray[np.float64]:
        """(n,) the largest angle between triangles at each vertex, in degrees."""
        return _creases(self.places, self.triangles)

    @cached_property
    def spacing(self) -> NDArray[np.float64]:
        """(n,) the mean length of the edges at each vertex, in object coordinates. 0 for vertices without edges."""
        lengths = np.linalg.norm(self.places[self.edges[:, 0]] - self.places[self.edges[:, 1]], axis=1)
        ends = self.edges.reshape(-1)
        sums = np.bincount(ends, np.repeat(lengths, 2), len(self.places))
        counts = np.bincount(ends, minlength=len(self.places))
        return np.divide(sums, counts, out=np.zeros(len(sums)), where=counts > 0)

    @cached_property
    def around(self) -> dict[int, list[int]]:
        """The vertices that share an edge with each."""
        found: dict[int, list[int]] = {}
        for one, two in self.edges.tolist():
            found.setdefault(one, []).append(two)
            found.setdefault(two, []).append(one)
        return found

    @cached_property
    def moments(self) -> Moments:
        return Moments.of(self.places, self.triangles)

    @cached_property
    def size(self) -> float:
        """The diagonal of the bounds of what is seen, in object coordinates."""
        used = self.places[np.unique(self.triangles)]
        return float(np.linalg.norm(np.ptp(used, axis=0))) if len(used) else 0.0


def _onto(source: Moments, target: Moments, scale: float, signs: tuple[int, int]) -> Similarity:
    """Return what lays one mesh's principal axes onto another's, the first two of them in directions by signs."""

    def frame(moments: Moments) -> NDArray[np.float64]:
        _, _, directions = np.linalg.svd(moments.axes)
        directions[2] = np.cross(directions[0], directions[1])
        return directions

    one, other = frame(source), frame(target)
    rotation = other.T @ np.diag([*signs, signs[0] * signs[1]]) @ one
    return Similarity(scale, rotation, target.middle - scale * rotation @ source.middle)


def doubt_between(way: Similarity, rival: Similarity) -> str:
    """Return the sentence that a rival lays a network elsewhere."""
    cosine = 0.5 * (np.trace(rival.rotation @ way.rotation.T) - 1.0)
    turn = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    where = f"if rotated by {turn:.0f} degrees" if turn >= _TURNED else "in another place"
    return f"the network also fits {where}: check its position, or give pairs"


@dataclass(frozen=True)
class Placed:
    """Points on a mesh."""

    triangles: NDArray[np.int64]  # (k,) the triangle of each point, or -1
    places: NDArray[np.float64]  # (k, 3) in object coordinates
    confidence: NDArray[np.float64]  # (k,) from 0, nothing is known, to 1, it is certain


@dataclass(frozen=True)
class Similarity:
    """Turns, scales and moves: ``scale * points @ rotation.T + shift``. A mirroring is one too."""

    scale: float
    rotation: NDArray[np.float64]
    shift: NDArray[np.float64]

    @classmethod
    def between(cls, points: NDArray[np.float64], targets: NDArray[np.float64]) -> Similarity:
        """Return the one that brings points nearest to others, by least squares.

        Umeyama, Least-squares estimation of transformation parameters between two point patterns (1991), without mirroring.
        """
        middle, other = points.mean(axis=0), targets.mean(axis=0)
        p, q = points - middle, targets - other
        u, values, vt = np.linalg.svd(q.T @ p / len(p))
        signs = np.ones(3)
        signs[2] = np.sign(np.linalg.det(u) * np.linalg.det(vt)) or 1.0
        rotation = u @ np.diag(signs) @ vt
        spread = float((p**2).sum()) / len(p)
        scale = float((values * signs).sum()) / spread if spread > 0.0 else 1.0
        if not scale > 0.0:
            scale = 1.0
        return cls(scale, rotation, other - scale * rotation @ middle)

    @classmethod
    def mirroring(cls, *axes: int) -> Similarity:
        """Return the one that mirrors over axes, 0 to 2. Without axes everything stays where it is."""
        signs = np.ones(3)
        signs[list(axes)] = -1.0
        return cls(1.0, np.diag(signs), np.zeros(3))

    def of(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.scale * points @ self.rotation.T + self.shift

    def of_normals(self, normals: NDArray[np.float64]) -> NDArray[np.float64]:
        return normals @ self.rotation.T

    def after(self, other: Similarity) -> Similarity:
        """Return the one that does first another one, then this one."""
        return Similarity(
            self.scale * other.scale,
            self.rotation @ other.rotation,
            self.scale * self.rotation @ other.shift + self.shift,
        )


class NearestSurface:
    """Finds the points of a mesh that are nearest to places.

    Raises ValueError if it has no triangle, and Cancelled where `go_on` returns False.
    """

    def __init__(self, shape: Shape, go_on: Progress = lambda _: True) -> None:  # `go_on` gets any fraction
        if not len(shape.triangles):
            raise ValueError("The mesh has no visible faces to place wires on")
        self._shape, self._go_on = shape, go_on
        self._trees: dict[int | None, tuple[NDArray[np.int64], NearestPoints]] = {}
        self._normals = units(area_normals(shape.places, shape.triangles))

    @cached_property
    def parts(self) -> NDArray[np.int32]:
        """(m,) which of the parts that hang together each triangle belongs to."""
        shape, core = self._shape, load()
        whole = core.Surface(shape.places, shape.triangles, shape.edges, progress=self._go_on)
        return np.asarray(core.face_segments(whole, np.empty((0, 2), dtype=np.int32)))

    def nearest(
        self, places: NDArray[np.float64], normals: NDArray[np.float64] | None = None, part: int | None = None
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
        """Return the triangle that is nearest to each place, (k, 3), its point there, and how far away that is; (k,), (k, 3), (k,).

        Triangles that face away from normals, (k, 3), do not count, unless all do: thin cloth has two sides. If a part is given, only that
        counts.
        """
        if part not in self._trees:
            rows = np.arange(len(self._shape.triangles)) if part is None else np.flatnonzero(self.parts == part)
            tree = load().NearestPoints(self._shape.places, self._shape.triangles[rows], progress=self._go_on)
            self._trees[part] = rows, tree
        rows, tree = self._trees[part]
        triangles, points, gaps = tree.find(places, normals, progress=self._go_on)
        return rows[triangles], points, gaps

    def align(
        self, points: NDArray[np.float64], moments: Moments, progress: Progress = lambda _: True
    ) -> tuple[Similarity, str]:
        """Find what brings points of a mesh onto this one, and what to tell if something else lays them elsewhere about as well.

        They stay where they are if they lie on it. Otherwise ICP starts there and from the four alignments of the principal axes without
        a reflection (Besl, McKay, A method for registration of 3-D shapes, 1992). The best result is taken. The points, (k, 3) in object
        coordinates, are of a mesh with these moments.
        """
        size = self._shape.size
        some = points[np.linspace(0, len(points) - 1, min(len(points), _SAMPLE)).astype(np.int64)]
        best, least = Similarity.mirroring(), self._gap(some)
        if least <= _ALIGNED * size or len(points) < 3:
            return best, ""
        own = self._shape.moments
        scale = own.size / moments.size if moments.size > 0.0 else 1.0
        starts = [best, *(_onto(moments, own, scale, signs) for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1)))]
        starts.append(Similarity(scale, np.eye(3), own.middle - scale * moments.middle))
        found_ways = [(least, best)]
        for number, current in enumerate(starts):
            tell(progress, PLACED * number / len(starts))
            for _ in range(_STEPS):
                moved = current.of(some)
                _, found, gaps = self.nearest(moved)
                near = gaps <= np.quantile(gaps, _TRIMMED)
                current = Similarity.between(moved[near], found[near]).after(current)
                if np.linalg.norm(current.of(some) - moved, axis=1).max() <= 1e-4 * size:
                    break
            # What has shrunk lies on any surface.
            if 0.8 <= current.scale / scale <= 1.25:
                found_ways.append((self._gap(current.of(some)), current))
        least, best = min(found_ways, key=lambda way: way[0])
        rivals = [
            (gap, way)
            for gap, way in found_ways
            if gap <= max(_RIVAL * least, 1e-6 * size)
            and np.linalg.norm(way.of(some) - best.of(some), axis=1).max() > _ELSEWHERE * size
        ]
        return best, doubt_between(best, min(rivals, key=lambda way: way[0])[1]) if rivals else ""

    def _gap(self, points: NDArray[np.float64]) -> float:
        gaps = self.nearest(points)[2]
        return float(gaps[gaps <= np.quantile(gaps, _TRIMMED)].mean())

    def place(
        self,
        points: NDArray[np.float64],
        normals: NDArray[np.float64],
        spacing: NDArray[np.float64] | float = 0.0,
        part: int | None = None,
    ) -> Placed:
        """Place points, (k, 3) in object coordinates, that lie near. `spacing`, (k,), tells how long the edges were that they came from.

        How far the surface is, in edges, and whether it faces the same way, say how sure each is. `part` is that of `nearest`.
        """
        triangles, found, gaps = self.nearest(points, normals, part)
        edges = np.maximum(self._shape.spacing[self._shape.triangles[triangles]].mean(axis=1), spacing)
        near = 1.0 / (1.0 + (gaps / np.maximum(edges, 1e-300)) ** 2)
        agree = np.einsum("ij,ij->i", normals, self._normals[triangles])
        known = np.linalg.norm(normals, axis=1) > 0.5
        return Placed(triangles, found, near * np.where(known, np.clip(0.3 + 1.4 * agree, 0.0, 1.0), 1.0))

    def vertex(self, triangle: int, place: NDArray[np.float64], crease: float) -> int:
        """Return the vertex that stands for a place, (3,), in a triangle: the nearest one, or a crease beside it for what was on one.

        `crease` tells how sharp the surface was there that it came from, in degrees.
        """
        shape = self._shape
        corners = shape.triangles[triangle].tolist()
        # Wires do not run along hidden edges and edges without a triangle.
        near = dict.fromkeys(corner for corner in corners if corner in shape.around)
        if crease >= _CREASE:
            near |= dict.fromkeys(other for corner in near for other in shape.around[corner])
        if not near:
            return corners[0]
        candidates = np.array(list(near))
        edge = max(float(shape.spacing[candidates].mean()), 1e-300)
        cost = np.linalg.norm(shape.places[candidates] - place, axis=1) / edge
        if crease >= _CREASE:
            # A whole edge away a crease is as good as the nearest vertex that is flat.
            cost += np.clip(1.0 - shape.creases[candidates] / crease, 0.0, 1.0)
        return int(candidates[np.argmin(cost)])


class Landmarks:
    """Places vertices of one mesh on another by their distances, along the surface, to points that both have.

    Poses change these little. Two places can have the same distances, such as both sides of a symmetric shape with all pairs in its
    plane. Then the nearer one counts after the pairs were aligned.

    Pairs are (k, 2): each has a vertex of each mesh, at the same point of the shape. Raises ValueError for fewer than three pairs, or if a
    vertex is not there. `progress` is told the fraction done of measuring distances. Later it is asked whether to continue.
    """

    _RESOLUTION = 0.02
    """As part of the mesh's size: distances in other poses agree no better."""
    _CHANGE = 0.1
    """By which part of themselves poses change distances."""
    _TIE = 1.0
    """How much where the aligned place is counts beside distances."""

    def __init__(self, source: Shape, target: Shape, pairs: ArrayLike, progress: Progress = lambda _: True) -> None:
        numbers = np.array(pairs, dtype=np.int64).reshape(-1, 2)
        if len(numbers) < 3:
            raise ValueError(f"Transfer by pairs needs at least three pairs of vertices, but got {len(numbers)}")
        for shape, column, what in ((source, 0, "source"), (target, 1, "target")):
            outside = numbers[~np.isin(numbers[:, column], shape.triangles), column]
            if len(outside):
                raise ValueError(f"Pairs: vertex {outside[0]} is not on a visible face of the {what}")
        self._source, self._target = source, target
        self._go_on = within(progress, 1.0, 1.0)
        self._here = _distances(source, numbers[:, 0], within(progress, 0.0, 0.5))
        self._there = _distances(target, numbers[:, 1], within(progress, 0.5, 1.0))
        one, other = self._here[numbers[:, 0]], self._there[numbers[:, 1]]
        both = np.isfinite(one) & np.isfinite(other) & (one > 0.0)
        square = float((one[both] ** 2).sum())
        self._scale = float((one[both] * other[both]).sum()) / square if square > 0.0 else 1.0
        aligned = Similarity.between(source.places[numbers[:, 0]], target.places[numbers[:, 1]])
        self._aligned = aligned.of(source.places)
        self._used = np.unique(target.triangles)
        self._triangle_of = np.full(len(target.places), -1, dtype=np.int64)
        self._triangle_of[target.triangles.reshape(-1)] = np.repeat(np.arange(len(target.triangles)), 3)

    def place(self, vertices: NDArray[np.int64]) -> Placed:
        """Place vertices of the source on the target, (k,).

        Each place is the surer, the smaller its error is, and the larger that of the best rival.
        """
        target, used = self._target, self._used
        size = max(target.size, 1e-300)
        there = self._there[used]
        best = np.empty(len(vertices), dtype=np.int64)
        confidence = np.zeros(len(vertices))
        for row, vertex in enumerate(vertices.tolist()):
            tell(self._go_on, 0.0)
            wanted = self._scale * self._here[vertex]
            known = np.isfinite(wanted)
            if not known.any():
                best[row] = used[0]
                continue
            # Near pairs say more: poses change long ways most.
            usual = self._RESOLUTION * size + self._CHANGE * wanted[known]
            square = (((there[:, known] - wanted[known]) / usual) ** 2).mean(axis=1)
            aside = ((target.places[used] - self._aligned[vertex]) ** 2).sum(axis=1) / size**2
            chosen = int(np.argmin(square + self._TIE * aside))
            best[row] = used[chosen]
            edge = max(float(target.spacing[used[chosen]]), self._RESOLUTION * size)
            far = np.linalg.norm(target.places[used] - target.places[used[chosen]], axis=1) > 4.0 * edge
            rival = np.sqrt(square[far].min()) if far.any() else np.inf
            # Where the distances are off by more than edges are long, so is the place.
            weights = usual**-2.0
            gaps = ((there[chosen, known] - wanted[known]) ** 2 * weights).sum() / weights.sum()
            exact = 1.0 / (1.0 + gaps / (2.0 * max(float(target.spacing[used[chosen]]), 1e-300)) ** 2)
            likely = _landmark_confidence(np.sqrt(square[chosen]), rival)
            confidence[row] = max(exact * likely, min(likely, DOUBTFUL))
        return Placed(self._triangle_of[best], target.places[best], confidence)


def _landmark_confidence(off: float, rival: float) -> float:
    """Return the confidence in a place from its error and that of the best rival. An error of 1 is typical of a changed pose."""
    if not np.isfinite(off):
        return 0.0
    apart = np.clip((rival - off) / _APART, 0.0, 1.0) if np.isfinite(rival) else 1.0
    return float((0.2 + 0.8 * apart) / (1.0 + off**2))


def _distances(shape: Shape, vertices: NDArray[np.int64], progress: Progress) -> NDArray[np.float64]:
    """Return the distances along the surface from all vertices to some, (n, k), in object coordinates; inf: there is no way."""
    core = load()
    steps = np.linspace(0.0, 1.0, 4 + len(vertices)).tolist()
    parts = iter([within(progress, *step) for step in itertools.pairwise(steps)])
    surface = core.Surface(shape.places, shape.triangles, shape.edges, progress=next(parts))
    metric = core.make_metric(surface, core.MetricSpec("euclidean"), progress=next(parts))
    flat = core.embed(surface, metric, progress=next(parts), max_error=0)
    # Several pairs at one vertex, and pairs on separate parts, each count.
    fields = [core.distance_field(flat, int(vertex), progress=next(parts)) for vertex in vertices]
    return np.stack([field.distances for field in fields], axis=1)
