# SPDX-License-Identifier: GPL-3.0-or-later
"""The colors of heat views: maps of a few published colors each, at equal distances."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .tool import ColorMap


def _of_hex(text: str) -> ColorMap:
    codes = [[int(code[i : i + 2], 16) / 255.0 for i in (0, 2, 4)] for code in text.split()]
    return tuple((red, green, blue) for red, green, blue in codes)


VIRIDIS: ColorMap = _of_hex("440154 472D7B 3B528B 2C728E 21908C 27AD81 5DC863 AADC32 FDE725")
"""For numbers from zero. By Smith and van der Walt (matplotlib, CC0). Steps in brightness are equal, also for the color-blind."""
PLASMA: ColorMap = _of_hex("0D0887 4C02A1 7E03A8 A92395 CC4678 E56B5D F89441 FDC328 F0F921")
"""For lengths, which may be seen beside VIRIDIS. By the same authors."""
PURPLE_ORANGE: ColorMap = _of_hex("2D004B 542788 8073AC B2ABD2 D8DAEB F7F7F7 FEE0B6 FDB863 E08214 B35806 7F3B08")
"""For numbers with a sign: both ends are dark, and zero is nearly white. PuOr of ColorBrewer 2.0 (Harrower and Brewer 2003), reversed."""
