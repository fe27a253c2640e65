# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands that are copies of each other: the same faces with the same lengths, as they are or mirrored."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

_SAME = 1e-4
"""Lengths of copies differ by at most this part of the longest edge: coordinates are rounded."""


@dataclass(frozen=True)
class IslandShape:
    """The corners of an island's faces, and the lengths between them, (c,) each. They decide how it is flattened.

    Attributes
    ----------
    mates
        The corner of the neighboring face from which the same edge runs the other way; -1 at the island's border.
    lengths, spans
        Of the edge to the next corner, and between the corners before and after.
    corners
        The corner at which each edge begins. It is the corner itself, unless the shape is mirrored.
    """

    following: NDArray[np.int64]
    mates: NDArray[np.int64]
    lengths: NDArray[np.float64]
    spans: NDArray[np.float64]
    corners: NDArray[np.int64]

    @cached_property
    def whole(self) -> float:
        """The sum of all lengths."""
        return float(self.lengths.sum())

    @cached_property
    def tolerance(self) -> float:
        """How far lengths of copies may differ."""
        return _SAME * float(self.lengths.max(initial=0.0))

    def mirrored(self) -> IslandShape:
        """Return the mirror image: each edge has its number, and runs the other way."""
        preceding = np.empty_like(self.following)
        preceding[self.following] = np.arange(len(self.following))
        return IslandShape(preceding, self.mates, self.lengths, self.spans[self.following], self.following)

    def agrees(self, edges: NDArray[np.int64], other: IslandShape, others: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return whether edges look like those of another shape, each by itself."""
        same = np.abs(self.lengths[edges] - other.lengths[others]) <= self.tolerance
        same &= np.abs(self.spans[edges] - other.spans[others]) <= self.tolerance
        return same & ((self.mates[edges] < 0) == (other.mates[others] < 0))


@dataclass(frozen=True)
class ShapedIsland:
    """An island: its number, its corners on the mesh, (c,) ascending, and its shape."""

    label: int
    corners: NDArray[np.int64]
    shape: IslandShape


def shaped_islands(
    points: NDArray[np.float64],
    vertices: NDArray[np.int32],
    edges: NDArray[np.int32],
    following: NDArray[np.int64],
    labels: NDArray[np.integer],
) -> list[ShapedIsland]:
    """Read the shapes of islands from the corners of a mesh with vertices, (n, 3).

    Each corner, (c,), has a vertex, the edge to the next corner of its face, that corner, and its island. The edge is -1 at a border of the
    island. The island is -1 if the corner is left out.
    """
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(following))
    place = points[vertices]
    lengths = np.linalg.norm(place[following] - place, axis=1)
    spans = np.linalg.norm(place[following] - place[preceding], axis=1)
    mates = np.full(len(vertices), -1)
    inner = np.flatnonzero((edges >= 0) & (labels >= 0))
    inner = inner[np.argsort(edges[inner], kind="stable")]
    _, first, counts = np.unique(edges[inner], return_index=True, return_counts=True)
    one, two = inner[first[counts == 2]], inner[first[counts == 2] + 1]
    are_neighbors = (labels[one] == labels[two]) & (vertices[one] == vertices[following[two]])
    mates[one[are_neighbors]], mates[two[are_neighbors]] = two[are_neighbors], one[are_neighbors]
    order = np.argsort(labels, kind="stable")
    order = order[labels[order] >= 0]
    numbers, starts = np.unique(labels[order], return_index=True)
    own = np.full(len(vertices) + 1, -1)  # the last for edges without a mate
    found = []
    for label, corners in zip(numbers.tolist(), np.split(order, starts[1:]), strict=True):
        own[corners] = np.arange(len(corners))
        shape = IslandShape(
            own[following[corners]], own[mates[corners]], lengths[corners], spans[corners], np.arange(len(corners))
        )
        found.append(ShapedIsland(label, corners, shape))
    return found


def find_copies(shapes: Sequence[IslandShape]) -> list[tuple[int, NDArray[np.int64]]]:
    """Find the first island that each island is a copy of, and which of its corners corresponds to each corner, (c,).

    The first island of each shape corresponds to itself.
    """
    found: list[tuple[int, NDArray[np.int64]]] = []
    firsts: defaultdict[int, list[tuple[float, int]]] = defaultdict(list)
    for number, shape in enumerate(shapes):
        alike = firsts[len(shape.lengths)]
        reach = shape.tolerance * len(shape.lengths)
        begin, end = bisect_left(alike, (shape.whole - reach, -1)), bisect_right(alike, (shape.whole + reach, number))
        for first in sorted(first for _, first in alike[begin:end]):
            corners = corresponding(shape, shapes[first])
            if corners is not None:
                found.append((first, corners))
                break
        else:
            found.append((number, np.arange(len(shape.lengths))))
            alike.insert(bisect_left(alike, (shape.whole, number)), (shape.whole, number))
    return found


def corresponding(shape: IslandShape, first: IslandShape) -> NDArray[np.int64] | None:
    """Return which corner of another island corresponds to each corner; None if the two are no copies of each other."""
    own = np.arange(len(shape.lengths))
    if (
        np.array_equal(shape.following, first.following)
        and np.array_equal(shape.mates, first.mates)
        and shape.agrees(own, first, own).all()
    ):
        return own
    for image in (first, first.mirrored()):
        for start, place in _starts(shape, image):
            edges = _spread(shape, image, start, place)
            if edges is not None:
                return image.corners[edges]
    return None


def _starts(shape: IslandShape, image: IslandShape) -> Iterator[tuple[int, int]]:
    """Yield pairs of edges that may correspond: those of the edge with the fewest others of its length, then its own number first."""
    order = np.sort(image.lengths)
    counts = np.searchsorted(order, shape.lengths + shape.tolerance, side="right")
    counts -= np.searchsorted(order, shape.lengths - shape.tolerance)
    start = int(counts.argmin())
    places = np.flatnonzero(shape.agrees(np.full(len(order), start), image, np.arange(len(order))))
    for place in sorted(places.tolist(), key=lambda place: place != start):
        yield start, place


def _spread(shape: IslandShape, image: IslandShape, start: int, place: int) -> NDArray[np.int64] | None:
    """Walk from one pair of edges to all others, face by face; None if two edges differ or some are not reached."""
    edges = np.full(len(shape.lengths), -1)
    edges[start] = place
    front = np.array([start])
    while len(front):
        reached = []
        for steps, others in ((shape.following, image.following), (shape.mates, image.mates)):
            there = steps[front]
            inside = there >= 0
            there, target = there[inside], others[edges[front[inside]]]
            if (target < 0).any() or not shape.agrees(there, image, target).all():
                return None
            fresh = edges[there] < 0
            if (edges[there[~fresh]] != target[~fresh]).any():
                return None
            edges[there[fresh]] = target[fresh]
            reached.append(there[fresh])
        front = np.unique(np.concatenate(reached))
    return edges if (edges >= 0).all() and len(np.unique(edges)) == len(edges) else None
