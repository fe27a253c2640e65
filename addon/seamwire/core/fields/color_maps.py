# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for numbers: maps of a few published colors each, at equal distances, with straight ways in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

ColorMap = tuple[tuple[float, float, float], ...]
STRETCH: ColorMap = (
    (0.13, 0.22, 0.78),
    (0.10, 0.66, 0.86),
    (0.30, 0.76, 0.32),
    (0.98, 0.86, 0.16),
    (0.74, 0.04, 0.12),
)
"""From blue to red, as the stretch of UV maps is shown elsewhere. Yellow is the lightest: where it turns to red is seen without
color too. The red is darker than that of seams, which are seen on it."""


def colors(parts: ArrayLike, of: ColorMap) -> NDArray[np.float64]:
    """Return the colors, (..., 3), at parts of a map, from 0 to 1; what is below 0 or above 1 has the color of the end."""
    parts = np.asarray(parts, dtype=np.float64)
    at = np.linspace(0.0, 1.0, len(of))
    return np.stack([np.interp(parts, at, column) for column in zip(*of, strict=True)], axis=-1)


def steps(of: ColorMap, count: int, opacity: float = 1.0) -> list[tuple[float, float, float, float]]:
    """Return a map as so many colors, both ends among them."""
    return [(r, g, b, opacity) for r, g, b in colors(np.linspace(0.0, 1.0, count), of).tolist()]
