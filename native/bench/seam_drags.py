# SPDX-License-Identifier: GPL-3.0-or-later
"""A hand that drags along seams, seen from one side, and whether the tool makes the same seams of the line it draws."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
import seamwire_core as sw

if TYPE_CHECKING:
    from numpy.typing import NDArray

_POINTS_PER_EDGE = 6
_LEAST_FACING = 0.2
"""Of the cosine between the view and the surface's normal: what is seen more askew nobody draws along."""
_VIEWS_TRIED = 2


class Hand:
    """Drags along chains of edges on one mesh.

    Parameters
    ----------
    surface
        The mesh.
    wobble
        How far the hand is off the chain at each of its vertices, at most, as part of the length of the edges there. The
        line runs straight between.
    """

    def __init__(self, surface: sw.Surface, wobble: float) -> None:
        self._surface = surface
        self._wobble = wobble
        self._points: NDArray[np.float64] = np.asarray(surface.points)
        triangles = np.asarray(surface.triangles)
        self._size = float(np.ptp(self._points, axis=0).max())
        self._rays = sw.RayTree(self._points, triangles)
        self._rays.wait()
        self._views = _directions()
        corners = self._points[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self._normals = np.zeros_like(self._points)
        for corner in range(3):
            np.add.at(self._normals, triangles[:, corner], normals)
        self._normals /= np.maximum(np.linalg.norm(self._normals, axis=1), 1e-30)[:, None]
        self._seen: dict[tuple[int, int], NDArray[np.float64]] = {}
        self._known: dict[tuple[int, ...], bool] = {}

    def drags(self, chain: list[int], closed: bool) -> int:
        """Return how many drags draw a chain, each as far as it goes; an edge that none draws takes a click."""
        vertices = [*chain, chain[0]] if closed else chain
        begin = count = 0
        while begin < len(vertices) - 1:
            begin, count = self._reach(vertices, begin), count + 1
        return count

    def through_junctions(self, chains: list[list[int]]) -> int:
        """Return how many drags are spared by drawing on from one of some chains, of a drag each, to another."""
        lines = [list(chain) for chain in chains]
        spared = 0
        for vertex in sorted({end for chain in chains for end in (chain[0], chain[-1])}):
            pairs = [
                (self._turn(one, other), i, j)
                for (i, one), (j, other) in itertools.combinations(enumerate(lines), 2)
                if vertex in (one[0], one[-1]) and vertex in (other[0], other[-1])
            ]
            taken: set[int] = set()
            joined = []
            for _, i, j in sorted(pairs):
                line = _joined(lines[i], lines[j], vertex)
                if taken.isdisjoint((i, j)) and line[0] != line[-1] and self.draws(line):
                    taken |= {i, j}
                    joined.append(line)
            spared += len(joined)
            lines = [line for i, line in enumerate(lines) if i not in taken] + joined
        return spared

    def _turn(self, one: list[int], other: list[int]) -> float:
        """Return how much a line turns that goes on from one chain to another, -1 to 1; the smaller the straighter."""
        shared = ({one[0], one[-1]} & {other[0], other[-1]}).pop()
        ways = []
        for chain in (one, other):
            beside = chain[1] if chain[0] == shared else chain[-2]
            way = self._points[beside] - self._points[shared]
            ways.append(way / max(float(np.linalg.norm(way)), 1e-30))
        return float(ways[0] @ ways[1])

    def _reach(self, vertices: list[int], begin: int) -> int:
        """Return how far a drag goes: by halves, for what is drawn in one is mostly so in parts."""
        low, high = begin + 1, len(vertices) - 1
        while low < high:
            middle = high if low == begin + 1 and high == len(vertices) - 1 else (low + high + 1) // 2
            if self.draws(vertices[begin : middle + 1]):
                low = middle
            else:
                high = middle - 1
        return low

    def draws(self, vertices: list[int]) -> bool:
        """Whether one drag draws a chain, seen from somewhere."""
        key = tuple(vertices)
        if key not in self._known:
            facing = np.min([self._facing(pair) for pair in itertools.pairwise(vertices)], axis=0)
            views = np.argsort(-facing, kind="stable")[:_VIEWS_TRIED]
            self._known[key] = any(
                facing[view] >= _LEAST_FACING and self._fits(vertices, self._views[view]) for view in views
            )
        return self._known[key]

    def _facing(self, edge: tuple[int, int]) -> NDArray[np.float64]:
        """Return how much an edge faces each view, as a cosine; -1 where something lies before it."""
        key = min(edge), max(edge)
        if key not in self._seen:
            found = np.full(len(self._views), 1.0)
            for part in (0.25, 0.5, 0.75):
                one, other = key
                place = (1.0 - part) * self._points[one] + part * self._points[other]
                normal = (1.0 - part) * self._normals[one] + part * self._normals[other]
                normal /= max(float(np.linalg.norm(normal)), 1e-30)
                cosines = self._views @ normal
                for view in np.flatnonzero(cosines >= _LEAST_FACING):
                    if self._rays.first_hit(place + 1e-4 * self._size * normal, self._views[view]) is not None:
                        cosines[view] = -1.0
                found = np.minimum(found, cosines)
            self._seen[key] = found
        return self._seen[key]

    def _fits(self, vertices: list[int], view: NDArray[np.float64]) -> bool:
        """Whether the tool makes a chain of the line that is drawn along it in a view."""
        random = np.random.default_rng(vertices)  # the same hand each time
        places = self._points[vertices].copy()
        lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
        beside = np.minimum(np.r_[lengths[:1], lengths], np.r_[lengths, lengths[-1:]])
        across = np.linalg.svd(view[None])[2][1:]  # the directions of the screen
        angle, radius = random.uniform(0.0, 2.0 * np.pi, len(places)), np.sqrt(random.uniform(0.0, 1.0, len(places)))
        off = self._wobble * (beside * radius)[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
        hand = places + off @ across
        parts = np.linspace(0.0, 1.0, _POINTS_PER_EDGE, endpoint=False)[:, None]
        line = [start + parts * (end - start) for start, end in itertools.pairwise(hand)]
        drawn, faces = [], []
        for place in (*np.concatenate(line), hand[-1]):
            hit = self._rays.first_hit(place + 4.0 * self._size * view, -view)
            if hit is not None:
                faces.append(hit[0])
                drawn.append(place + (4.0 * self._size - hit[1]) * view)
        if len(drawn) < 2:
            return False
        return (
            sw.fit_chain(self._surface, np.array(drawn), np.array(faces, dtype=np.int32)).vertices.tolist() == vertices
        )


def _joined(one: list[int], other: list[int], vertex: int) -> list[int]:
    """Return two chains as one that runs through a vertex at which both end."""
    first = one if one[-1] == vertex else one[::-1]
    return first + (other if other[0] == vertex else other[::-1])[1:]


def _directions() -> NDArray[np.float64]:
    """Return (k, 3) directions all around, evenly: a Fibonacci sphere."""
    count = 96
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    radius = np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], 1)
