# SPDX-License-Identifier: GPL-3.0-or-later
"""How well seams agree with an artist's, and how much work is left, in numbers.

Seams are sets of edges of a polygon mesh. `SeamMesh` finds its edges once, and `SeamMeasures` says what each number is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from uv_maps import triangle_areas
from uv_measures import seam_samples, surface_samples

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray
    from uv_maps import Model

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]
    Bools = NDArray[np.bool_]

SHARP = 30.0
"""Edges with a larger angle between their faces are sharp, in degrees."""
_STEP = 0.004
"""Distance between samples of a seam, of the diagonal."""
_NEAR = 0.015
"""A seam this near to another one is there too, of the diagonal."""
_NEAR_MIRRORED = 0.01
"""A seam this near to the mirror image of another one is mirrored, of the diagonal."""
_PROBES = 8_000
_MOST_CHANCE = 0.95
_ACCEPTED = 0.6
"""An artist who is tolerant accepts a chain if this share of it is near the other seams."""
_KINK = np.radians(60.0)
_PRESS = 0.4
"""A press takes a chain this far, of the diagonal."""
CRUMB = 0.003
"""A smaller island is a crumb, of the area."""
_RIM = 0.9
"""Share of a crumb's border that has to be sharp if a rim is the reason for it."""
_STRAIGHT = np.radians(30.0)


class SeamMesh:
    """A polygon mesh with its edges.

    Attributes
    ----------
    edges
        (e, 2) vertex pairs, the lower vertex first.
    faces_at
        (e,) how many faces each edge has.
    joins
        (k, 2) pairs of sides that an edge joins, and `joined_edge` (k,) that edge. A side is the number of its first corner.
    """

    def __init__(self, model: Model) -> None:
        self.model, self.points = model, model.points
        self._corners = model.corners
        self._sizes = np.diff(model.start)
        self._face = np.repeat(np.arange(len(self._sizes)), self._sizes)
        self._following = np.arange(1, len(self._corners) + 1)
        self._following[model.start[1:] - 1] = model.start[:-1]
        sides = np.sort(np.stack([self._corners, self._corners[self._following]], axis=1), axis=1)
        self.edges, self._edge = np.unique(sides, axis=0, return_inverse=True)
        self._edge = self._edge.reshape(-1)
        self.faces_at = np.bincount(self._edge, minlength=len(self.edges))
        self.lengths = np.linalg.norm(np.diff(self.points[self.edges], axis=1)[:, 0], axis=1)
        order = np.argsort(self._edge, kind="stable")
        first = (np.cumsum(self.faces_at) - self.faces_at)[self._edge[order]]
        others = np.flatnonzero(first != np.arange(len(order)))
        self.joins = np.stack([order[first[others]], order[others]], axis=1)
        self.joined_edge = self._edge[order[others]]

    @cached_property
    def face_areas(self) -> Floats:
        """The area of each polygon."""
        return np.bincount(
            np.repeat(np.arange(len(self._sizes)), self._sizes - 2), triangle_areas(self.points, self.model.triangles)
        )

    @cached_property
    def angles(self) -> Floats:
        """The angle between the two faces of each edge in degrees, (e,); 0 if it has not exactly two."""
        first = self.points[np.repeat(self._corners[self.model.start[:-1]], self._sizes)]
        cross = np.cross(self.points[self._corners] - first, self.points[self._corners[self._following]] - first)
        normals = np.add.reduceat(cross, self.model.start[:-1])
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
        pairs = self._face[self.joins]
        between = np.degrees(np.arccos(np.clip((normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1), -1, 1)))
        angles = np.zeros(len(self.edges))
        angles[self.joined_edge] = between
        return np.where(self.faces_at == 2, angles, 0.0)

    @cached_property
    def outer_vertices(self) -> Bools:
        """Whether each vertex lies on an edge that has not exactly two faces, (n,)."""
        found = np.zeros(len(self.points), dtype=bool)
        found[self.edges[self.faces_at != 2].reshape(-1)] = True
        return found

    def mask(self, pairs: Integers | Iterable[tuple[int, int]]) -> Bools:
        """Return which edges are among vertex pairs (k, 2). Other pairs do not count."""
        pairs = np.sort(np.asarray(list(pairs), dtype=np.int64).reshape(-1, 2), axis=1)
        count = len(self.points)
        return np.isin(self.edges @ [count, 1], pairs @ [count, 1])

    def islands(self, seams: Bools) -> Integers:
        """Return the island of each polygon."""
        pairs = self._face[self.joins[~seams[self.joined_edge]]]
        return _components(pairs, len(self._sizes))

    def not_discs(self, seams: Bools) -> int:
        """Return how many islands have an Euler characteristic other than 1."""
        islands = self.islands(seams)
        count = int(islands.max()) + 1
        one, other = self.joins[~seams[self.joined_edge]].T
        begin_one, end_one = self._low_and_high(one)
        begin_other, end_other = self._low_and_high(other)
        pairs = np.concatenate([np.stack([begin_one, begin_other], 1), np.stack([end_one, end_other], 1)])
        vertices = _components(pairs, len(self._corners))
        _, representative = np.unique(vertices, return_index=True)
        euler = np.bincount(islands[self._face[representative]], minlength=count)
        euler += np.bincount(islands[self._face[one]], minlength=count)
        euler -= np.bincount(islands[self._face], minlength=count)
        return int((euler + np.bincount(islands, minlength=count) != 1).sum())

    def _low_and_high(self, sides: Integers) -> tuple[Integers, Integers]:
        """Return the corners of sides at the lower and at the higher vertex."""
        ends = self._following[sides]
        is_up = self._corners[sides] < self._corners[ends]
        return np.where(is_up, sides, ends), np.where(is_up, ends, sides)

    def crumbs(self, seams: Bools) -> int:
        """Return how many islands are small without a reason.

        The reasons are that the island is a separate piece, or that a sharp rim encloses it.
        """
        islands = self.islands(seams)
        areas = np.bincount(islands, self.face_areas)
        pairs = islands[self._face[self.joins]]
        border = pairs[:, 0] != pairs[:, 1]
        lengths, sharp = self.lengths[self.joined_edge], self.angles[self.joined_edge] > SHARP
        around, of_rim = np.zeros(len(areas)), np.zeros(len(areas))
        for side in pairs[border].T:
            around += np.bincount(side, lengths[border], len(areas))
            of_rim += np.bincount(side, (lengths * sharp)[border], len(areas))
        return int(((areas < CRUMB * areas.sum()) & (of_rim < _RIM * around)).sum())

    def loose_ends(self, seams: Bools) -> int:
        """Return the number of vertices inside the surface where exactly one seam edge ends."""
        degree = np.bincount(self.edges[seams].reshape(-1), minlength=len(self.points))
        return int(((degree == 1) & ~self.outer_vertices).sum())

    def straightness(self, seams: Bools) -> float | None:
        """Return the share of the seams, by length, that goes on straight at its vertices; None without such vertices.

        A seam is straight if both sides have the same angle on the surface, give or take 30 degrees. Junctions and the
        boundary of the surface do not count.
        """
        at: dict[int, list[int]] = {}
        for edge in np.flatnonzero(seams).tolist():
            for vertex in self.edges[edge].tolist():
                at.setdefault(vertex, []).append(edge)
        passed = {v: pair for v, pair in at.items() if len(pair) == 2 and not self.outer_vertices[v]}
        corners: dict[int, list[int]] = {v: [] for v in passed}
        for corner in np.flatnonzero(np.isin(self._corners, list(passed))).tolist():
            corners[int(self._corners[corner])].append(corner)
        straight = total = 0.0
        for vertex, (one, other) in passed.items():
            turn = self._turn(corners[vertex], one, other)
            if turn is not None:
                length = self.lengths[one] + self.lengths[other]
                total += length
                straight += length * (turn < _STRAIGHT)
        return float(straight / total) if total else None

    def _turn(self, corners: list[int], one: int, other: int) -> float | None:
        """Return how far the edges one and other around a vertex are from a straight line; None if it has no single fan."""
        wedges: dict[int, list[tuple[int, int, float]]] = {}
        for corner in corners:
            before = self._before[corner]
            a = self.points[self._corners[before]] - self.points[self._corners[corner]]
            b = self.points[self._corners[self._following[corner]]] - self.points[self._corners[corner]]
            angle = float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))
            for edge, next_edge in ((self._edge[before], self._edge[corner]), (self._edge[corner], self._edge[before])):
                wedges.setdefault(int(edge), []).append((corner, int(next_edge), angle))
        used, edge, left = set[int](), one, 0.0
        total = sum(angle for around in wedges.values() for _, _, angle in around) / 2
        while edge != other:
            step = next((wedge for wedge in wedges[edge] if wedge[0] not in used), None)
            if step is None:
                return None
            used.add(step[0])
            edge, left = step[1], left + step[2]
        return abs(np.pi - 2 * np.pi * left / total) if total else None

    @cached_property
    def _before(self) -> Integers:
        before = np.empty_like(self._following)
        before[self._following] = np.arange(len(before))
        return before

    def chains(self, seams: Bools, part: Bools | None = None) -> list[list[int]]:
        """Return the chains of edges between junctions of the seams, as vertices; a loop ends with its first vertex.

        With `part`, a subset of the seams, only its edges count. Chains still end at the junctions of all seams.
        """
        part = seams if part is None else part
        degree = np.bincount(self.edges[seams].reshape(-1), minlength=len(self.points))
        at: dict[int, list[int]] = {}
        for a, b in self.edges[part].tolist():
            at.setdefault(a, []).append(b)
            at.setdefault(b, []).append(a)
        ends = [v for v, near in at.items() if len(near) != 2 or degree[v] != 2]
        is_end, used, found = set(ends), set[tuple[int, int]](), []
        for begin in [*ends, *at]:
            for following in at[begin]:
                chain = [begin, following]
                if (begin, following) in used:
                    continue
                while chain[-1] not in is_end and chain[-1] != begin:
                    a, b = at[chain[-1]]
                    chain.append(b if a == chain[-2] else a)
                used.update(pairwise(chain))
                used.update(pairwise(chain[::-1]))
                found.append(chain)
        return found


def _components(pairs: Integers, count: int) -> Integers:
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


@dataclass
class SeamMeasures:
    """The numbers of the seams of one method on one model. None: the number does not exist."""

    agree: float | None
    """Harmonic mean of `lift` and `rlift`; 0 where one of them is below 0."""
    lift: float | None
    """(p - c) / (1 - c): p is the share of the seams near the artist's, c that share of the whole surface.

    It does not exist if nearly the whole surface is near the artist's seams.
    """
    rlift: float
    """The same for the share of the artist's seams near these."""
    exact: float
    """Share of the seams that lie on the artist's own edges."""
    exact_mean: float
    """Harmonic mean of `exact` and the share of the artist's edges that are seams."""
    presses: float
    """Presses from these seams to the artist's, over those from nothing."""
    tolerant: float | None
    """The same for an artist who accepts chains near the wanted ones. It exists if `lift` does."""
    islands: int
    islands_ratio: float
    """Islands over the artist's."""
    crumbs: int
    """Islands of less than .3 % of the area that are neither enclosed by a sharp rim nor separate pieces."""
    loose_ends: int
    """Loose ends minus those of the artist's seams."""
    discs: float
    """Share of islands that are discs."""
    straightness: float | None
    """Share of the seams that goes on straight."""
    mirrored: float | None
    """Share of the seams whose mirror image is seam too; None if the model is not symmetric."""
    length: float
    """Length over the root of the area."""


class Artist:
    """An artist's seams of a model, and what measuring other seams against them shares.

    Parameters
    ----------
    mesh
        The mesh. Other seams may lie on another mesh with the same points, such as its triangles.
    pairs
        The artist's seams, (k, 2).
    mirror
        The axis to whose normal plane through the origin the model is symmetric, or None.
    """

    def __init__(self, mesh: SeamMesh, pairs: Integers, mirror: int | None) -> None:
        self.mesh, self.pairs, self.mirror = mesh, pairs, mirror
        self.seams = mesh.mask(pairs)
        self.islands = int(mesh.islands(self.seams).max()) + 1
        self.ends = mesh.loose_ends(self.seams)
        self.diagonal = mesh.model.diagonal
        self._probes = surface_samples(mesh.points, mesh.model.triangles, _PROBES)
        self._samples = self._of(mesh, self.seams)
        self._tree = cKDTree(self._samples[0])
        self._chance = float(self._is_near(self._tree, self._probes).mean())

    @property
    def sharp(self) -> float:
        """The share of the artist's seams on sharp edges, by length."""
        lengths = self.mesh.lengths[self.seams]
        return float(lengths[self.mesh.angles[self.seams] > SHARP].sum() / lengths.sum())

    def _of(self, mesh: SeamMesh, seams: Bools) -> tuple[Floats, Floats]:
        return seam_samples(mesh.points, mesh.edges[seams], _STEP * self.diagonal)

    def _is_near(self, tree: cKDTree, points: Floats, most: float = _NEAR) -> Bools:
        return tree.query(points)[0] < most * self.diagonal

    def measure(self, pairs: Integers, mesh: SeamMesh | None = None) -> SeamMeasures:
        """Measure seams, (k, 2), that lie on edges of the mesh or of another mesh with the same points."""
        mesh = mesh or self.mesh
        seams, artist = mesh.mask(pairs), mesh.mask(self.pairs)
        islands = int(mesh.islands(seams).max()) + 1
        lift, rlift, mirrored = 0.0, 0.0, None
        if seams.any():
            samples, weights = self._of(mesh, seams)
            tree = cKDTree(samples)
            near = np.average(self._is_near(self._tree, samples), weights=weights)
            back = np.average(self._is_near(tree, self._samples[0]), weights=self._samples[1])
            lift = (near - self._chance) / (1 - self._chance) if self._chance < _MOST_CHANCE else None
            chance = self._is_near(tree, self._probes).mean()
            rlift = (back - chance) / max(1 - chance, 1e-9)
            if self.mirror is not None:
                images = samples * np.where(np.arange(3) == self.mirror, -1.0, 1.0)
                mirrored = float(np.average(self._is_near(tree, images, _NEAR_MIRRORED), weights=weights))
        common = mesh.lengths[seams & artist].sum()
        total, wanted = mesh.lengths[seams].sum(), mesh.lengths[artist].sum()
        strict, tolerant = self._presses(mesh, seams, artist)
        return SeamMeasures(
            agree=None if lift is None else _harmonic_mean(lift, rlift),
            lift=None if lift is None else float(lift),
            rlift=float(rlift),
            exact=float(common / total) if total else 0.0,
            exact_mean=_harmonic_mean(common / total, common / wanted) if total else 0.0,
            presses=strict,
            tolerant=None if lift is None else tolerant,
            islands=islands,
            islands_ratio=islands / self.islands,
            crumbs=mesh.crumbs(seams),
            loose_ends=mesh.loose_ends(seams) - self.ends,
            discs=1 - mesh.not_discs(seams) / islands,
            straightness=mesh.straightness(seams),
            mirrored=mirrored,
            length=float(total / np.sqrt(mesh.face_areas.sum())),
        )

    def _presses(self, mesh: SeamMesh, seams: Bools, artist: Bools) -> tuple[float, float]:
        """Return the presses from seams to the artist's over those from nothing: exactly, and by a tolerant artist."""
        wanted = mesh.chains(artist)
        nothing = sum(self._drawing(chain) for chain in wanted)
        wrong = len(mesh.chains(seams, seams & ~artist))
        missing = sum(self._drawing(chain) for chain in mesh.chains(artist, artist & ~seams))
        if not seams.any():
            return 1.0, 1.0
        tree = cKDTree(self._of(mesh, seams)[0])
        far = sum(not self._is_accepted(chain, self._tree) for chain in mesh.chains(seams))
        left = sum(self._drawing(chain) for chain in wanted if not self._is_accepted(chain, tree))
        return float((wrong + missing) / nothing), float((far + left) / nothing)

    def _drawing(self, chain: list[int]) -> float:
        """Return the presses that draw a chain: one for a smooth loop, and otherwise by kinks and length."""
        points = self.mesh.points[chain]
        is_closed = chain[0] == chain[-1]
        if is_closed:
            points = np.concatenate([points, points[1:2]])
        steps = np.diff(points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        cosines = (steps[1:] * steps[:-1]).sum(axis=1) / np.maximum(lengths[1:] * lengths[:-1], 1e-30)
        kinks = int((cosines < np.cos(_KINK)).sum())
        if is_closed and not kinks:
            return 1.0
        length = lengths[: len(chain) - 1].sum()
        return 1 + max(kinks + 1, length / (_PRESS * self.diagonal))

    def _is_accepted(self, chain: list[int], tree: cKDTree) -> bool:
        """Return whether most of a chain is near the seams of a tree of samples."""
        pairs = np.stack([chain[:-1], chain[1:]], axis=1)
        samples, weights = seam_samples(self.mesh.points, pairs, _STEP * self.diagonal)
        total = weights.sum()
        return not total or (weights * self._is_near(tree, samples)).sum() >= _ACCEPTED * total


def _harmonic_mean(one: float, other: float) -> float:
    return float(2 * one * other / (one + other)) if min(one, other) > 0 else 0.0
