# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds points by their place, for a million of them at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SIZE = 16.0
"""Edge of a cell in tolerances: nearly every point is far from its cell's border, and most cells hold one point."""
_PRIMES = np.array([73856093, 19349663, 83492791], dtype=np.int64)
_MOST_IN_A_CELL = 64
"""Where points are denser than this, the tolerance says nothing, and not all of them are looked at."""


class SpatialHash:
    """Points in the cells of a grid.

    Parameters
    ----------
    points
        (n, 3) places.
    tolerance
        How far a point that is looked for may be; positive.
    """

    def __init__(self, points: NDArray[np.float64], tolerance: float) -> None:
        self._tolerance = tolerance
        self._size = _SIZE * tolerance
        keys = self._keys(np.floor(points / self._size).astype(np.int64))
        self._order = np.argsort(keys, kind="stable")
        self._sorted = keys[self._order]
        self._points = points[self._order]

    @staticmethod
    def _keys(cells: NDArray[np.int64]) -> NDArray[np.int64]:
        # SpatialHash far from each other may share a key: distances decide in the end.
        return cells[:, 0] * _PRIMES[0] + cells[:, 1] * _PRIMES[1] + cells[:, 2] * _PRIMES[2]

    def nearest(self, places: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return for each of (m, 3) places the number of the nearest point within the tolerance; -1: there is none."""
        best = np.full(len(places), -1, dtype=np.int64)
        gaps = np.full(len(places), self._tolerance**2)
        scaled = places / self._size
        cells = np.floor(scaled)
        scaled -= cells
        cells = cells.astype(np.int64)
        self._look(places, np.arange(len(places)), self._keys(cells), best, gaps)
        # Beyond the borders that are nearer than what was found, there may be something nearer.
        near = np.sqrt(gaps)[:, None] / self._size
        aside = (scaled > 1.0 - near).astype(np.int64) - (scaled < near)
        border = np.flatnonzero(aside.any(axis=1))
        for steps in np.ndindex(2, 2, 2):
            over = np.array(steps, dtype=bool)
            rows = border[(aside[border][:, over] != 0).all(axis=1)]
            if over.any() and len(rows):
                self._look(places, rows, self._keys(cells[rows] + over * aside[rows]), best, gaps)
        return best

    def _look(
        self,
        places: NDArray[np.float64],
        rows: NDArray[np.int64],
        keys: NDArray[np.int64],
        best: NDArray[np.int64],
        gaps: NDArray[np.float64],
    ) -> None:
        """Take what one cell for each row holds into `best` and the squared `gaps`."""
        # In the order of the keys a search goes through memory from one end to the other.
        order = np.argsort(keys)
        rows, keys = rows[order], keys[order]
        wanted = places[rows]
        at = np.searchsorted(self._sorted, keys)
        for _ in range(_MOST_IN_A_CELL):
            there = at < len(self._sorted)
            there[there] = self._sorted[at[there]] == keys[there]
            if not there.all():
                rows, keys, wanted, at = rows[there], keys[there], wanted[there], at[there]
            if not len(rows):
                return
            off = self._points[at] - wanted
            gap = np.einsum("ij,ij->i", off, off)
            # The first of equally near points is taken.
            nearer = (gap < gaps[rows]) | ((gap <= gaps[rows]) & (best[rows] < 0))
            best[rows[nearer]] = self._order[at[nearer]]
            gaps[rows[nearer]] = gap[nearer]
            at = at + 1
