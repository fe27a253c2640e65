# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and things by the names that artists read."""

from __future__ import annotations


def count(number: int, what: str, several: str = "") -> str:
    """Return a number with what it counts."""
    return f"{number} {what if number == 1 else several or what + 's'}"
