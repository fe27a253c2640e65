# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds points by their position, for a million points at once, each within its own reach.

Points are sorted along a Morton curve (Morton, A computer oriented geodetic data base, 1966). The cells of its grids double in size, and
the points in each cell are neighbors in this order. So one order serves every reach.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_BITS = 21
"""Of a cell's number along an axis: three of them fill 63 bits."""
_CELL = 3.0
"""Least edge of a cell in reaches; the largest is twice that. Most places are far from their cell's borders then, and a cell
as large as the edges that meet at a point holds few points."""
_MOST_IN_A_CELL = 64
"""Where points are denser than this, the reach says nothing, and not all of them are looked at."""
_BLOCK = 1 << 15
"""Places that are looked for together: what is computed of so many stays in the processor's cache."""
_SAMPLE = 10_000
_FAR = 1e3
"""Points this many times as far from the middle as most are share the grid's outermost cells."""
_LARGEST = 1e100
"""Larger coordinates are taken for no places: their squares would not be finite."""


class SpatialHash:
    """Points in the cells of nested grids.

    Parameters
    ----------
    points
        (n, 3) places; points that are not finite are never found.
    tolerance
        The default search radius, positive.
    """

    def __init__(self, points: NDArray[np.float64], tolerance: float) -> None:
        self._tolerance = tolerance
        sound = np.flatnonzero(_is_place(points))
        # Most often all of them are: no copy of a million points then.
        points = points if len(sound) == len(points) else points[sound]
        self._low, self._finest = _box(points)
        codes = self._codes_of(points, np.arange(len(points)))
        order = np.argsort(codes, kind="stable")
        self._codes = codes[order]
        self._points = points[order]
        self._order = sound[order]

    def _cells(self, places: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return the finest cells that places lie in, (m, 3), and where in units of those cells they are."""
        scaled = (places - self._low) / self._finest
        np.clip(scaled, 0.0, 2.0**_BITS - 1.0, out=scaled)
        return scaled.astype(np.int64), scaled

    def _codes_of(self, places: NDArray[np.float64], rows: NDArray[np.int64]) -> NDArray[np.int64]:
        codes = np.empty(len(rows), dtype=np.int64)
        for start in range(0, len(rows), _BLOCK):
            codes[start : start + _BLOCK] = _interleaved(self._cells(places[rows[start : start + _BLOCK]])[0])
        return codes

    def nearest(self, places: NDArray[np.float64], reach: ArrayLike | None = None) -> NDArray[np.int64]:
        """Return for each place the number of the nearest point within reach; the first of equally near ones.

        Parameters
        ----------
        places
            (m, 3); one that is not finite has no nearest point.
        reach
            How far the point may be from each place, (m,) or one number; None: the tolerance.

        Returns
        -------
        (m,) array
            Numbers of points, or -1 if no point is within reach.
        """
        best = np.full(len(places), -1, dtype=np.int64)
        reaches = np.broadcast_to(np.asarray(self._tolerance if reach is None else reach, np.float64), len(places))
        rows = np.flatnonzero(_is_place(places) & (reaches >= 0.0))
        if not len(self._codes) or not len(rows):
            return best
        reaches = np.minimum(reaches, _LARGEST)
        cells = _CELL * np.maximum(reaches[rows], 1e-9 * self._finest) / self._finest
        levels = np.clip(np.ceil(np.log2(cells)), 0, _BITS).astype(np.int64)
        for level in np.flatnonzero(np.bincount(levels)).tolist():
            here = rows[levels == level]
            # In the order of the cells a search goes through memory from one end to the other.
            order = here[np.argsort(self._codes_of(places, here), kind="stable")]
            for start in range(0, len(order), _BLOCK):
                some = order[start : start + _BLOCK]
                best[some] = self._nearest_on(level, places[some], reaches[some])
        return best

    def _nearest_on(self, level: int, places: NDArray[np.float64], reaches: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the nearest points, looking at cells of 2^level of the finest."""
        finest, scaled = self._cells(places)
        best, gaps = np.full(len(places), -1, dtype=np.int64), reaches**2
        self._look(level, places, np.arange(len(places)), _interleaved(finest) >> 3 * level, best, gaps)
        # Beyond the borders that are nearer than what was found, there may be something nearer.
        size = 2.0**level
        near = np.sqrt(gaps) / self._finest
        scaled -= np.floor(scaled / size) * size
        closest = np.minimum(scaled, size - scaled)
        border = np.flatnonzero(np.minimum(np.minimum(closest[:, 0], closest[:, 1]), closest[:, 2]) <= near)
        scaled, near = scaled[border], near[border, None]
        cells = finest[border] >> level
        # A cell is wider than twice the reach: only one border of an axis can be near.
        aside = (size - scaled <= near).astype(np.int64) - (scaled <= near)
        last = (1 << _BITS - level) - 1
        for steps in np.ndindex(2, 2, 2):
            over = np.array(steps, dtype=bool)
            beyond = cells + over * aside
            # Outside the grid there are no points: those far out are in its outermost cells.
            rows = (aside[:, over] != 0).all(axis=1) & ((beyond >= 0) & (beyond <= last)).all(axis=1)
            if over.any() and rows.any():
                self._look(level, places, border[rows], _interleaved(beyond[rows]), best, gaps)
        return best

    def _look(
        self,
        level: int,
        places: NDArray[np.float64],
        rows: NDArray[np.int64],
        cells: NDArray[np.int64],
        best: NDArray[np.int64],
        gaps: NDArray[np.float64],
    ) -> None:
        """Take what one cell for each row holds into `best` and the squared `gaps`."""
        at = np.searchsorted(self._codes, cells << 3 * level)
        for _ in range(_MOST_IN_A_CELL):
            there = at < len(self._codes)
            there &= self._codes[np.minimum(at, len(self._codes) - 1)] >> 3 * level == cells
            if not there.all():
                rows, cells, at = rows[there], cells[there], at[there]
            if not len(rows):
                return
            off = self._points[at] - places[rows]
            gap = np.einsum("ij,ij->i", off, off)
            close = np.flatnonzero(gap <= gaps[rows])
            row, found = rows[close], self._order[at[close]]
            # Of equally near ones the first.
            nearer = (gap[close] < gaps[row]) | (best[row] < 0) | (found < best[row])
            row, close = row[nearer], close[nearer]
            best[row] = found[nearer]
            gaps[row] = gap[close]
            at = at + 1


def _is_place(points: NDArray[np.float64]) -> NDArray[np.bool_]:
    with np.errstate(invalid="ignore"):
        return (np.abs(points) < _LARGEST).all(axis=1)


def _box(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return the lower corner of a cube around all points but a few far ones, and the edge of its finest cells."""
    if not len(points):
        return np.zeros(3), 1.0
    sample = points[:: max(1, len(points) // _SAMPLE)]
    middle = np.median(sample, axis=0)
    off = np.abs(sample - middle).max(axis=1)
    most = float(np.percentile(off, 99.0)) or float(off.max())
    low, high = points.min(axis=0), points.max(axis=0)
    half = max(float((high - middle).max()), float((middle - low).max()))
    if most > 0.0:
        half = min(half, _FAR * most)
    # Where all points are in one place any cell will do; it must not be lost beside their coordinates.
    half = max(half * 1.01, 1e-6 * float(np.abs(middle).max()), 1e-30)
    return middle - half, 2.0 * half / 2.0**_BITS


def _interleaved(cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return Morton codes: the bits of the numbers of cells, (m, 3), x's, y's and z's in turn."""
    code = np.zeros(len(cells), dtype=np.int64)
    for axis in range(3):
        bits = cells[:, axis].copy()
        for shift, mask in (
            (32, 0x1F00000000FFFF),
            (16, 0x1F0000FF0000FF),
            (8, 0x100F00F00F00F00F),
            (4, 0x10C30C30C30C30C3),
            (2, 0x1249249249249249),
        ):
            bits = (bits | bits << shift) & mask
        code |= bits << axis
    return code
