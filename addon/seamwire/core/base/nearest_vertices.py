# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds vertices by their position, for a million places at once, each within its own reach."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_LARGEST = 1e100
"""Larger coordinates are taken for no places: their squares would not be finite."""
_WEIGHTS = (0.41421356237309503, 0.7320508075688772, 0.23606797749978969)
"""Places with the same sum of coordinates, with these weights, are most often the same."""


class NearestVertices:
    """Finds the nearest of some vertices, (n, 3). Vertices that are not finite are never found."""

    def __init__(self, points: NDArray[np.float64]) -> None:
        rows = np.flatnonzero(_is_place(points))
        places = points[rows]
        # Of many vertices in one place, a search would look at all. So only the first is kept.
        keys = places @ _WEIGHTS
        order = np.argsort(keys, kind="stable")
        starts = np.diff(keys[order], prepend=np.nan) != 0.0
        later, first = order[~starts], order[starts][np.cumsum(starts) - 1][~starts]
        kept = np.ones(len(places), dtype=bool)
        kept[later] = (places[later] != places[first]).any(axis=1)
        self._rows = rows[kept]
        corners = np.repeat(np.arange(len(self._rows), dtype=np.int32)[:, None], 3, axis=1)
        self._tree = native.load().NearestPoints(points[self._rows], corners) if len(rows) else None

    def find(self, places: NDArray[np.float64], reach: ArrayLike) -> NDArray[np.int64]:
        """Return for each place, (m, 3), the number of the nearest vertex within reach, the first of equally near ones, or -1.

        A place that is not finite has no nearest vertex. The reach is one number, or that of each place, (m,).
        """
        best = np.full(len(places), -1, dtype=np.int64)
        rows = np.flatnonzero(_is_place(places))
        if self._tree is not None and len(rows):
            vertices, _, gaps = self._tree.find(places[rows])
            near = gaps <= np.broadcast_to(np.asarray(reach, dtype=np.float64), len(places))[rows]
            best[rows[near]] = self._rows[vertices[near]]
        return best


def _is_place(points: NDArray[np.float64]) -> NDArray[np.bool_]:
    with np.errstate(invalid="ignore"):
        return (np.abs(points) < _LARGEST).all(axis=1)
