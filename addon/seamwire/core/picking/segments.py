# SPDX-License-Identifier: GPL-3.0-or-later
"""Straight pieces of curves near the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments
from .camera import Projected

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from .sight import Sight

VERTEX_RADIUS = 12.0
"""Pixels around a vertex in which it is picked rather than its edge..."""
VERTEX_SHARE = 0.25
"""...but never over more than this part of the edge, so that every edge can be picked."""
_MAX_PIECES = 24
"""Pieces of curves under one cursor that are tried for one that is not hidden."""


class Segments:
    """Straight pieces of curves, each with the number of its owner.

    Parameters
    ----------
    curves
        Each (k, 3), in object coordinates.
    """

    def __init__(self, curves: list[NDArray[np.float64]]) -> None:
        none = np.empty((0, 3))
        self.starts = Projected(np.concatenate([none, *(curve[:-1] for curve in curves)]))
        self.ends = Projected(np.concatenate([none, *(curve[1:] for curve in curves)]))
        self.owners = np.repeat(np.arange(len(curves)), [max(len(curve) - 1, 0) for curve in curves])

    def near(self, sight: Sight, radius: float) -> Iterator[tuple[int, NDArray[np.float64]]]:
        """Yield owners and their points under the cursor, nearest first. An owner that lies there several times comes several times."""
        if not len(self.owners):
            return
        starts = np.stack(self.starts.seen(sight.camera, sight.matrix)[:2], axis=1)
        ends = np.stack(self.ends.seen(sight.camera, sight.matrix)[:2], axis=1)
        part, gaps = nearest_on_segments(sight.cursor, starts, ends)
        rows = np.flatnonzero(gaps <= radius)
        for row in rows[np.argsort(gaps[rows], kind="stable")][:_MAX_PIECES].tolist():
            start, end = self.starts.points[row], self.ends.points[row]
            # Halves on the screen are not halves in space where there is perspective; near enough for a few pixels.
            yield int(self.owners[row]), start + part[row] * (end - start)


def nearest_edge(
    cursor: tuple[float, float], starts: NDArray[np.float64], ends: NDArray[np.float64], scale: float = 1.0
) -> tuple[int, int | None]:
    """Find the segment nearest to a point, and whether one of its ends is meant.

    Parameters
    ----------
    cursor
        Pixels.
    starts, ends
        (k, 2) pixels. NaN for an end that is not in front of the viewer.
    scale
        Of the display.

    Returns
    -------
    index
        The row of the segment, or -1 if there is no segment.
    end
        0 or 1 if the cursor is so near to that end that it is meant, otherwise None.
    """
    _, gaps = nearest_on_segments(cursor, starts, ends)
    if not len(gaps) or np.isnan(gaps).all():
        return -1, None
    index = int(np.nanargmin(gaps))
    to_ends = np.linalg.norm(np.stack([starts[index], ends[index]]) - np.asarray(cursor), axis=1)
    end = int(np.argmin(to_ends))
    length = float(np.linalg.norm(ends[index] - starts[index]))
    radius = min(VERTEX_RADIUS * scale, VERTEX_SHARE * length)
    return index, end if to_ends[end] <= radius else None
