# SPDX-License-Identifier: GPL-3.0-or-later
"""How strongly wires follow the shape to begin with, and in which limits. Read at Blender's start: without NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..network.picks import Along

STRENGTHS: Mapping[Along, float] = {"EDGES": 10.0, "SURFACE": 20.0}
"""The metric's largest anisotropy to begin with: how strongly wires are drawn to features; docs/method/defaults.md says why."""
CLAMP_PERCENTILE = 99.0
"""The percentile of feature strengths that counts as the strongest, to begin with."""
CLAMP_RANGE = (50.0, 100.0)
STRENGTH_STEP = 1.25
STRENGTH_RANGE = (1.0, 100.0)
