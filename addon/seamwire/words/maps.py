# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators report of UV maps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .names import count

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..core.islands.map_faults import MapFaults


def in_words(faults: MapFaults) -> list[str]:
    """Return what is wrong with islands that were unwrapped. The list is empty if nothing is wrong."""
    parts = []
    if faults.overlapping:
        parts.append(count(faults.overlapping, "island overlaps", "islands overlap"))
    if faults.flipped:
        parts.append(f"{count(faults.flipped, 'face')} turned over")
    if faults.outside:
        parts.append(f"{count(faults.outside, 'island')} outside the UV square")
    return parts


def percent(stretch: float) -> str:
    """Return a stretch, in percent, with one decimal place if it is small."""
    digits = 0 if stretch >= 10.0 else 1
    return f"{stretch:.{digits}f}".removesuffix(".0") + " %"


def is_beyond(stretch: float, wanted: float) -> bool:
    """Whether a stretch is higher than another one in the numbers that reports show."""
    return not math.isfinite(stretch) or float(percent(stretch)[:-2]) > float(percent(wanted)[:-2])


def not_reached(stretches: Sequence[float], wanted: float) -> str:
    """Return the report that the maps of objects have more stretch than wanted, or an empty text.

    Parameters
    ----------
    stretches
        The stretch of each map, in percent.
    wanted
        The stretch that was asked for, in percent.
    """
    beyond = sum(is_beyond(stretch, wanted) for stretch in stretches)
    if not beyond:
        return ""
    if len(stretches) > 1:
        return f"{beyond} of {len(stretches)} objects above {percent(wanted)}"
    return f"{percent(wanted)} was not reached"
