# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that wires and seams cut a mesh into, computed beside the drawing. Knows neither Blender nor the GPU."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.newest import Newest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..seams.gaps import Gap, GapFinder

Label = Callable[["NDArray[np.int32]"], "NDArray[np.int32]"]
"""Takes cut edges, (c, 2), and returns a label for every triangle: 0, 1, ..., largest island first."""
Count = Callable[["NDArray[np.int32]", "NDArray[np.int32]"], "NDArray[np.int32]"]
"""Takes cut edges, (c, 2), and the labels they make; returns how many more cuts each island needs before it can lie flat."""
_Request = tuple[object, "NDArray[np.int32]", frozenset[int]]
"""The key, the cuts, and the vertices where cuts end on purpose."""

_MOST_LOOKED_AT = 3_000
"""Vertices around the end of a cut for what it nearly meets: less than where gaps are to be closed, for this is asked at each change."""
_CLOSE = 0.2
"""The longest gap of several edges, in lengths of the cut that ends there: the artist may go on at an end farther from others."""
AT_ONCE = 20_000
"""Triangles up to which the answer takes a few milliseconds, so that a thread would only make it late."""
_TOLD_APART = 4096
"""Islands beyond this many are so small that neighbors may share a hue."""
HUES = 12
"""How many colors islands are told apart by."""
PLACES = [(4 + 5 * hue) % HUES for hue in range(HUES)]
"""Where each hue lies in the rainbow: hues with numbers next to each other lie far apart in it, and each place comes once."""
_CLEAR = 3
"""By how many places in the rainbow the hues of neighbors differ wherever that can be: 60 degrees of the circle of hues, where
12 hues share two thirds of it."""
_TOO_NEAR = [sum(1 << other for other in range(HUES) if abs(place - PLACES[other]) < _CLEAR) for place in PLACES]
"""The hues that are too near to each, as bits."""


@dataclass(frozen=True)
class Islands:
    """The islands that a network cuts a mesh into.

    Parameters
    ----------
    key
        The key of the request.
    count
        How many islands there are.
    labels
        (m,) of each triangle.
    hues
        (count,) a number below the number of hues for each; those of neighbors across a cut are far apart, see `PLACES`.
    missing
        (count,) how many more cuts each needs before it can lie flat.
    cut
        Whether anything was cut.
    parted
        Whether the cuts part the mesh. Otherwise the islands are the parts that it has anyway.
    pieces
        For each hue that is used: it, and its triangles, (k, 3).
    gaps
        Where a cut ends just before it meets another one, shortest first.
    """

    key: object
    count: int
    labels: NDArray[np.int32]
    hues: NDArray[np.uint8]
    missing: NDArray[np.int32]
    cut: bool
    parted: bool
    pieces: tuple[tuple[int, NDArray[np.int32]], ...]
    gaps: tuple[Gap, ...] = ()

    @cached_property
    def sizes(self) -> NDArray[np.int64]:
        """(count,) how many triangles each has."""
        return np.bincount(self.labels, minlength=self.count)


class IslandMaker(Newest[_Request, Islands]):
    """Computes islands in its own thread. Only the newest waiting request is answered.

    Parameters
    ----------
    label
        What tells the islands apart; called on the thread.
    gaps
        Finds what keeps islands from separating; None: that is not asked for.
    count
        Counts the cuts that islands need; called on the thread. None: no island needs any.
    """

    def __init__(
        self,
        triangles: NDArray[np.int32],
        label: Label,
        gaps: GapFinder | None = None,
        count: Count | None = None,
    ) -> None:
        super().__init__(self._islands_of, "seamwire-islands")
        self._triangles = triangles
        self._label = label
        self._gaps = gaps
        self._count = count

    def ask(
        self, key: object, cuts: Iterable[tuple[int, int]] | NDArray[np.int32], meant: frozenset[int] = frozenset()
    ) -> None:
        """Ask for the islands that cut edges make, with a key. Where cuts end at vertices that are `meant`, there are no gaps."""
        edges = np.array(cuts if isinstance(cuts, np.ndarray) else list(cuts), dtype=np.int32).reshape(-1, 2)
        if len(self._triangles) <= AT_ONCE:
            self.answer_now((key, edges, meant))
        else:
            self.want((key, edges, meant))

    def _islands_of(self, request: _Request) -> Islands:
        key, cuts, meant = request
        labels = np.asarray(self._label(cuts), dtype=np.int32)
        if labels.shape != (len(self._triangles),):
            raise ValueError(f"{labels.shape} labels for {len(self._triangles)} triangles")
        count = int(labels.max(initial=-1)) + 1
        hues = choose_hues(self._inherited(labels, count), neighbours(self._triangles, labels, cuts))
        of_triangle = hues[labels]
        order = np.argsort(of_triangle, kind="stable")
        bounds = np.searchsorted(of_triangle[order], np.arange(HUES + 1))
        pieces = tuple(
            (hue, np.ascontiguousarray(self._triangles[order[bounds[hue] : bounds[hue + 1]]]))
            for hue in range(HUES)
            if bounds[hue] < bounds[hue + 1]
        )
        missing = np.zeros(count, dtype=np.int32) if self._count is None else self._count(cuts, labels)
        gaps = (
            ()
            if self._gaps is None
            else tuple(self._gaps.find(cuts, most_looked_at=_MOST_LOOKED_AT, longest_of_several=_CLOSE, meant=meant))
        )
        return Islands(key, count, labels, hues, missing, len(cuts) > 0, count > self._parts, pieces, gaps)

    @cached_property
    def _parts(self) -> int:
        """How many parts the mesh has without cuts."""
        return int(np.max(self._label(np.empty((0, 2), dtype=np.int32)), initial=-1)) + 1

    def _inherited(self, labels: NDArray[np.int32], count: int) -> NDArray[np.int64]:
        """Return the hue that each island keeps, (count,), -1 for what was cut off or is new.

        An island has the hue of the one that most of it belonged to; of several pieces of that, the largest has it.
        """
        hues = np.full(count, -1, dtype=np.int64)
        before = self.answer
        if before is None or not before.count or max(count, before.count) > _TOLD_APART:
            return hues
        shared = np.sort(labels.astype(np.int64) * before.count + before.labels)
        begin = np.flatnonzero(np.diff(shared, prepend=-1))
        now, then = np.divmod(shared[begin], before.count)
        sizes = np.diff(begin, append=len(shared))
        main = _largest_of_each(now, sizes)
        now, then, sizes = now[main], then[main], sizes[main]
        heirs = _largest_of_each(then, sizes)
        hues[now[heirs]] = before.hues[then[heirs]]
        return hues


def _largest_of_each(groups: NDArray[np.int64], sizes: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return which one is the largest of each group."""
    order = np.lexsort((sizes, groups))
    return order[np.diff(groups[order], append=-1) != 0]


def neighbours(triangles: NDArray[np.int32], labels: NDArray[np.int32], cuts: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the pairs of different labels that meet at cut edges, (k, 2), each once, smaller first."""
    if not len(cuts):
        return np.empty((0, 2), dtype=np.int32)
    count = int(max(triangles.max(initial=0), cuts.max())) + 1
    on_cut = np.zeros(count, dtype=bool)
    on_cut[cuts] = True
    # Only triangles with two vertices on cuts can lie at one: few, on a large mesh.
    near = np.flatnonzero(on_cut[triangles].sum(axis=1) >= 2)
    corners = triangles[near].astype(np.int64)
    sides = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    keys = sides.min(axis=1) * count + sides.max(axis=1)
    wanted = cuts.astype(np.int64)
    at_cut = np.isin(keys, wanted.min(axis=1) * count + wanted.max(axis=1))
    keys, owners = keys[at_cut], np.repeat(labels[near], 3)[at_cut]
    order = np.argsort(keys, kind="stable")
    keys, owners = keys[order], owners[order]
    same = keys[1:] == keys[:-1]
    pairs = np.stack([owners[:-1][same], owners[1:][same]], axis=1)
    pairs = np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)
    return np.unique(pairs, axis=0)


def choose_hues(inherited: NDArray[np.int64], pairs: NDArray[np.int32]) -> NDArray[np.uint8]:
    """Choose a hue for each island, (count,), far from those of its neighbors, and one that few others have.

    `inherited`, (count,), has the hue that each keeps, unless a larger neighbor has one too much like it, or -1. The largest islands come
    first. Pairs of neighbors are (k, 2).
    """
    count = len(inherited)
    if count > _TOLD_APART:
        return np.where(inherited >= 0, inherited, np.arange(count) % HUES).astype(np.uint8)
    around: list[list[int]] = [[] for _ in range(count)]
    for one, two in pairs.tolist():
        around[one].append(two)
        around[two].append(one)
    chosen = [-1] * count
    used = [0] * HUES
    # For each island, the hues that are not too near to a neighbor's, as bits.
    free = [(1 << HUES) - 1] * count

    def settle(island: int, hue: int) -> None:
        chosen[island] = hue
        used[hue] += 1
        for other in around[island]:
            free[other] &= ~_TOO_NEAR[hue]

    # Old hues stay, the largest islands first. The other islands get new hues when all old ones are known.
    for island, hue in enumerate(inherited.tolist()):
        if hue >= 0 and free[island] >> hue & 1:
            settle(island, hue)
    # The one with the fewest hues left is next (Brelaz, New methods to color the vertices of a graph, 1979).
    waiting = [(free[island].bit_count(), island) for island in range(count) if chosen[island] < 0]
    heapq.heapify(waiting)
    while waiting:
        left, island = heapq.heappop(waiting)
        if chosen[island] >= 0 or left != free[island].bit_count():
            continue
        gaps = [HUES] * HUES
        open_to = [free[other] for other in around[island] if chosen[other] < 0]
        for other in around[island]:
            if chosen[other] >= 0:
                place = PLACES[chosen[other]]
                gaps = [min(gap, abs(PLACES[hue] - place)) for hue, gap in enumerate(gaps)]

        def merit(hue: int, gaps: list[int] = gaps, open_to: list[int] = open_to) -> tuple[int, int, int, int]:
            taken = sum((mask & _TOO_NEAR[hue]).bit_count() for mask in open_to)
            return min(gaps[hue], _CLEAR), -taken, -used[hue], gaps[hue]

        settle(island, max(range(HUES), key=merit))
        for other in around[island]:
            if chosen[other] < 0:
                heapq.heappush(waiting, (free[other].bit_count(), other))
    return np.array(chosen, dtype=np.uint8)
