# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and things by the names that artists read."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..core.network.picks import Pick
    from ..core.network.wires import LoopKind

LOOP_NAMES: Mapping[LoopKind, str] = {
    "CLOSED": "closed loop",
    "CROSSING": "crossing loop",
    "STRIP": "strip",
    "PAST": "strip past poles",
    "WHOLE": "whole strip",
    "FLAT": "border of part",
    "ACROSS": "closed cut",
    "HANDLE": "cut of a handle",
    "RIDGE": "ridge",
    "VALLEY": "valley",
}
"""The names of loops."""
DEGREE_NAMES = {"SURE": "sure", "LIKELY": "likely", "DOUBTFUL": "doubtful", "LOST": "not placed"}
"""How sure a transferred seed is."""


def count(number: int, what: str, several: str = "") -> str:
    """Return a number with what it counts."""
    return f"{number} {what if number == 1 else several or what + 's'}"


def pick_name(pick: Pick) -> str:
    """Return a vertex, an edge or a point of a face as messages call it."""
    if isinstance(pick, tuple):
        return f"edge {pick[0]}-{pick[1]}"
    return "this point" if hasattr(pick, "weights") else f"vertex {pick}"
