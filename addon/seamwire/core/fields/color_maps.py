# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for numbers: maps of a few published colors each, at equal distances, with straight ways in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

ColorMap = tuple[tuple[float, float, float], ...]


def _of_hex(text: str) -> ColorMap:
    codes = [[int(code[i : i + 2], 16) / 255.0 for i in (0, 2, 4)] for code in text.split()]
    return tuple((red, green, blue) for red, green, blue in codes)


VIRIDIS = _of_hex("440154 472D7B 3B528B 2C728E 21908C 27AD81 5DC863 AADC32 FDE725")
"""For what is zero and more. Smith and van der Walt (matplotlib, CC0); equally spaced in brightness, for the color-blind too."""
PLASMA = _of_hex("0D0887 4C02A1 7E03A8 A92395 CC4678 E56B5D F89441 FDC328 F0F921")
"""Its sibling, by the same: for lengths, where VIRIDIS may be seen beside."""
PURPLE_ORANGE = _of_hex("2D004B 542788 8073AC B2ABD2 D8DAEB F7F7F7 FEE0B6 FDB863 E08214 B35806 7F3B08")
"""For what has a sign: both ends dark, zero nearly white. PuOr of ColorBrewer 2.0 (Harrower and Brewer 2003), turned around."""
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
    """Return the colors, (..., 3), at parts of a map; what is below 0 or above 1 has the color of the end.

    Parameters
    ----------
    parts
        0 to 1, of any shape.
    of
        The map.
    """
    parts = np.asarray(parts, dtype=np.float64)
    at = np.linspace(0.0, 1.0, len(of))
    return np.stack([np.interp(parts, at, column) for column in zip(*of, strict=True)], axis=-1)


def steps(of: ColorMap, count: int, opacity: float = 1.0) -> list[tuple[float, float, float, float]]:
    """Return a map as so many colors, both ends among them."""
    return [(r, g, b, opacity) for r, g, b in colors(np.linspace(0.0, 1.0, count), of).tolist()]
