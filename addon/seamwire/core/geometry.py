# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances from points to the straight pieces of curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def nearest_on_segments(
    point: ArrayLike, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find the nearest place to a point on each of some segments, in the plane or in space.

    Parameters
    ----------
    point
        (d,)
    starts, ends
        (k, d); a segment may be a point.

    Returns
    -------
    part
        (k, 1) how far along each segment that place lies, from 0 to 1.
    gap
        (k,) how far from the point it is; NaN where an end is.
    """
    along = ends - starts
    square = np.einsum("ij,ij->i", along, along)
    part = np.einsum("ij,ij->i", point - starts, along) / np.where(square > 0.0, square, 1.0)
    part = np.clip(part, 0.0, 1.0)[:, None]
    return part, np.linalg.norm(starts + part * along - point, axis=1)
