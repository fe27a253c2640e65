# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and things by the names that artists read."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..core.network.picks import Pick

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
