# SPDX-License-Identifier: GPL-3.0-or-later
"""The chain that is being drawn, and who shows its status."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .modal import Chain

running: list[Chain] = []
"""The chain that is being drawn."""
status_makers: list[Callable[[Chain], object]] = []
"""Functions that return what draws the status bar for a chain. The interface adds one."""
