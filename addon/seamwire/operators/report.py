# SPDX-License-Identifier: GPL-3.0-or-later
"""The chain that is being drawn, and the words for what operators did."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..words.names import count

if TYPE_CHECKING:
    from collections.abc import Callable

    from .modal import Chain

running: list[Chain] = []
"""The chain that is being drawn."""
status_makers: list[Callable[[Chain], object]] = []
"""Functions that return what draws the status bar for a chain. The interface adds one."""


def summary(wires: int, marked: int, cleared: int, touched: int = 0) -> str:
    """Return a report. `touched` is the number of edges below new wires, including edges that were already seams."""
    parts = [count(wires, "wire")]
    if marked or not cleared:
        parts.append(f"{count(marked, 'edge')} marked")
    if cleared:
        parts.append(f"{count(cleared, 'edge')} cleared")
    already = touched - marked - cleared
    if already > 0:
        parts.append(f"{already} already seams" if not cleared else f"{already} unchanged")
    return ", ".join(parts)
