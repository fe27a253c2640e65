# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole loops through the edge under the cursor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .network import Wire

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .live import LiveWire
    from .network import Edge


@dataclass
class LoopPreview:
    """The loop through the edge under the cursor, while it is asked for."""

    wanted: bool = False
    wire: Wire | None = None
    final: bool = True

    def reset(self) -> None:
        """Show none."""
        self.wanted, self.wire, self.final = False, None, True


def find_loop(live: LiveWire, edge: Edge, points: NDArray[np.float64]) -> tuple[Wire | None, bool]:
    """Return the closed loop through an edge, and whether it, or that there is none, is computed.

    Raises
    ------
    ValueError
        Where the edge is not part of the surface.
    """
    found = live.loop(edge)
    vertices = tuple(int(v) for v in found.vertices)
    if not found.final or len(vertices) < 3:
        return None, found.final
    return Wire("EDGES", vertices, points[[*vertices, vertices[0]]], edge, edge, closed=True), True
