# SPDX-License-Identifier: GPL-3.0-or-later
"""Ridges and valleys of a mesh: lines over its faces, and what is near to them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..network.picks import FacePoint
from ..network.wires import Wire

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    import seamwire_core
    from numpy.typing import NDArray

    from ...terms.choices import LoopKind
    from ..network.picks import Pick

CREST_KINDS: tuple[LoopKind, ...] = ("RIDGE", "VALLEY")
"""What their offers are."""


@dataclass(frozen=True, eq=False)
class Crests:
    """Ridges and valleys, the strongest first: line i has the points starts[i] to starts[i + 1]."""

    points: NDArray[np.float64]  # (p, 3) each on an edge; a closed line ends with its first point
    edges: NDArray[np.int32]  # (p, 2) which edge
    t: NDArray[np.float64]  # (p,) where on it, 0 to 1
    faces: NDArray[np.int32]  # (p,) the triangle that leads to the next point; -1 at a line's end
    curvatures: NDArray[np.float64]  # (p,) above 0 along ridges, below along valleys
    starts: NDArray[np.int32]  # (k + 1,)
    strengths: NDArray[np.float64]  # (k,) the curvature along each line, in radians

    @classmethod
    def on(
        cls, core: ModuleType, surface: seamwire_core.Surface, go_on: Callable[[float], bool] | None = None
    ) -> Crests:
        """Find those of a surface. `go_on` receives the fraction that is done, and returns False to raise the library's ``Cancelled``."""
        curvature = core.principal_curvatures(surface, go_on)
        lines = core.crest_lines(surface, core.smoothed_curvatures(surface, curvature, progress=go_on), progress=go_on)
        return cls(lines.points, lines.edges, lines.t, lines.faces, lines.curvatures, lines.starts, lines.strengths)

    def __len__(self) -> int:
        return len(self.strengths)

    @cached_property
    def pieces(self) -> NDArray[np.int64]:
        """The points that a straight piece begins at, (s,)."""
        return np.flatnonzero(self.faces >= 0)

    @cached_property
    def segments(self) -> NDArray[np.float64]:
        return np.stack([self.points[self.pieces], self.points[self.pieces + 1]], axis=1)

    @cached_property
    def owners(self) -> NDArray[np.int64]:
        return np.repeat(np.arange(len(self)), np.diff(self.starts))

    @cached_property
    def vertices(self) -> NDArray[np.int32]:
        """The vertex that each point is nearest to on its edge, (p,)."""
        return self.edges[np.arange(len(self.edges)), np.round(self.t).astype(np.int64)]

    @cached_property
    def ridges(self) -> NDArray[np.bool_]:
        """Which lines are ridges, (k,); the others are valleys."""
        return self.curvatures[self.starts[:-1]] > 0.0

    def line(self, number: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        mine = slice(self.starts[number], self.starts[number + 1])
        faces = self.faces[mine].copy()
        faces[-1] = faces[-2]
        return self.points[mine], faces

    def line_at(self, pick: Pick) -> int | None:
        """Return the strongest line across an edge of a vertex, across the triangle of a point, or across or beside an edge."""
        if isinstance(pick, FacePoint):
            found = self.owners[self.faces == pick.triangle]
        elif isinstance(pick, tuple):
            beside = [set(self.owners[self.vertices == vertex].tolist()) for vertex in pick]
            crossing = self.owners[(self.edges == np.sort(pick)).all(axis=1)].tolist()
            return min({*crossing, *(beside[0] & beside[1])}, default=None)
        else:
            found = self.owners[(self.edges == pick).any(axis=1)]
        return int(found.min()) if len(found) else None

    def offer(self, pick: Pick) -> Wire | None:
        """Return the line at a pick as a wire to be shown; it marks nothing."""
        number = self.line_at(pick)
        if number is None:
            return None
        kind: LoopKind = "RIDGE" if self.ridges[number] else "VALLEY"
        return Wire("SURFACE", (), self.line(number)[0], pick, pick, kind=kind)
