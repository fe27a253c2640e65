# SPDX-License-Identifier: GPL-3.0-or-later
"""How strongly wires follow the shape to begin with, in which limits, and what Auto stands for. Read at Blender's start: without NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ..network.picks import Along, Finish

STRENGTHS: Mapping[Along, float] = {"EDGES": 10.0, "SURFACE": 20.0}
"""The metric's largest anisotropy to begin with: how strongly wires are drawn to features; docs/method/defaults.md says why."""
CLAMP_PERCENTILE = 99.0
"""The percentile of feature strengths that counts as the strongest, to begin with."""
CLAMP_RANGE = (50.0, 100.0)
STRENGTH_STEP = 1.25
STRENGTH_RANGE = (1.0, 100.0)


class Auto(NamedTuple):
    """The values that Auto stands for: how wires run, and how wires across the surface become seams."""

    along: Along
    finish: Finish


PLACED = Auto("EDGES", "SNAP")
"""For meshes whose edges an artist placed: nothing cuts their faces."""
SCANNED = Auto("SURFACE", "CUT")
"""For scans, sculpts and remeshed surfaces."""
