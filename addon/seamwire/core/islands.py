# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that wires and seams cut a mesh into, computed beside the drawing. Knows neither Blender nor the GPU."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Label = Callable[["NDArray[np.int32]"], "NDArray[np.int32]"]
"""Takes cut edges, (c, 2), and returns a label for every triangle: 0, 1, ..., largest island first."""

AT_ONCE = 20_000
"""Triangles up to which the answer takes a few milliseconds, so that a thread would only make it late."""
_TOLD_APART = 4096
"""Islands beyond this many are so small that neighbours may share a hue."""


@dataclass(frozen=True)
class Islands:
    """What a network cuts a mesh into.

    Parameters
    ----------
    key
        What it was asked for by.
    count
        How many islands there are.
    labels
        (m,) of each triangle.
    hues
        (count,) a number below the number of hues for each; neighbours across a cut have different ones.
    cut
        Whether anything was cut: else the islands are the parts that the mesh has anyway.
    pieces
        For each hue that is used: it, and its triangles, (k, 3).
    """

    key: object
    count: int
    labels: NDArray[np.int32]
    hues: NDArray[np.uint8]
    cut: bool
    pieces: tuple[tuple[int, NDArray[np.int32]], ...]


class IslandMaker:
    """Computes islands on a thread of its own; of several requests the newest wins.

    Parameters
    ----------
    triangles
        (m, 3).
    label
        What tells the islands apart; called on the thread.
    hues
        How many colours there are.
    """

    def __init__(self, triangles: NDArray[np.int32], label: Label, hues: int = 12) -> None:
        self._triangles = triangles
        self._label = label
        self._hues = hues
        self._lock = threading.Lock()
        self._wanted: tuple[object, NDArray[np.int32]] | None = None
        self._working = False
        self._closed = False
        self._error: Exception | None = None
        self._newest: Islands | None = None

    @property
    def busy(self) -> bool:
        """Whether something is being computed."""
        return self._working

    @property
    def newest(self) -> Islands | None:
        """What was computed last. Raises what went wrong on the thread."""
        if self._error is not None:
            raise self._error
        return self._newest

    def want(self, key: object, cuts: Iterable[tuple[int, int]] | NDArray[np.int32]) -> None:
        """Ask for the islands that cut edges make; `key` is how the answer is known."""
        edges = np.array(cuts if isinstance(cuts, np.ndarray) else list(cuts), dtype=np.int32).reshape(-1, 2)
        if len(self._triangles) <= AT_ONCE:
            self._newest = self._make(key, edges)
            return
        with self._lock:
            self._wanted = (key, edges)
            if self._working:
                return
            self._working = True
        threading.Thread(target=self._work, name="seamwire-islands", daemon=True).start()

    def close(self) -> None:
        """Drop what is asked for; a running computation ends unseen."""
        with self._lock:
            self._closed = True
            self._wanted = None

    def _work(self) -> None:
        while True:
            with self._lock:
                if self._wanted is None:
                    self._working = False
                    return
                (key, edges), self._wanted = self._wanted, None
            try:
                made = self._make(key, edges)
            except Exception as error:
                # The main thread raises it: here nobody would see it.
                self._error = error
                self._working = False
                return
            if not self._closed:
                self._newest = made

    def _make(self, key: object, cuts: NDArray[np.int32]) -> Islands:
        labels = np.asarray(self._label(cuts), dtype=np.int32)
        if labels.shape != (len(self._triangles),):
            raise ValueError(f"{labels.shape} labels for {len(self._triangles)} triangles")
        count = int(labels.max(initial=-1)) + 1
        hues = coloured(count, neighbours(self._triangles, labels, cuts), self._wishes(labels, count), self._hues)
        of_triangle = hues[labels]
        order = np.argsort(of_triangle, kind="stable")
        bounds = np.searchsorted(of_triangle[order], np.arange(self._hues + 1))
        pieces = tuple(
            (hue, np.ascontiguousarray(self._triangles[order[bounds[hue] : bounds[hue + 1]]]))
            for hue in range(self._hues)
            if bounds[hue] < bounds[hue + 1]
        )
        return Islands(key, count, labels, hues, len(cuts) > 0, pieces)

    def _wishes(self, labels: NDArray[np.int32], count: int) -> NDArray[np.int64]:
        """Return the hue that most of each island had before, so that a new wire recolours only what it cuts off."""
        if self._newest is None or count > _TOLD_APART:
            return np.arange(count) % self._hues
        before = self._newest.hues[self._newest.labels].astype(np.int64)
        shares = np.bincount(labels.astype(np.int64) * self._hues + before, minlength=count * self._hues)
        return shares.reshape(count, self._hues).argmax(axis=1)


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


def coloured(count: int, pairs: NDArray[np.int32], wishes: NDArray[np.int64], hues: int) -> NDArray[np.uint8]:
    """Choose a hue for each island, unlike those of its neighbours; where there are hues enough, unlike all others.

    Parameters
    ----------
    count
        How many islands, the largest first: it chooses first.
    pairs
        (k, 2) neighbours.
    wishes
        (count,) the hue that each would have without neighbours.
    hues
        How many there are.
    """
    chosen = wishes.astype(np.uint8) % hues
    if count > _TOLD_APART:
        return chosen
    around: list[list[int]] = [[] for _ in range(count)]
    for one, two in pairs.tolist():
        around[one].append(two)
        around[two].append(one)
    used = np.zeros(hues, dtype=np.int64)
    for island in range(count):
        others = range(island) if count <= hues else (other for other in around[island] if other < island)
        taken = {int(chosen[other]) for other in others}
        hue = int(chosen[island])
        if hue in taken:
            free = [one for one in range(hues) if one not in taken] or list(range(hues))
            hue = min(free, key=lambda one: (used[one], one))
        chosen[island] = hue
        used[hue] += 1
    return chosen
