# SPDX-License-Identifier: GPL-3.0-or-later
"""All settings of the tool, as they are at one moment."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..solver.defaults import CLAMP_PERCENTILE, CLAMP_RANGE, STRENGTH_RANGE, STRENGTH_STEP, STRENGTHS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..network.picks import Along, Finish
    from ..solver.solver import MetricName


@dataclass(frozen=True)
class Options:
    """A snapshot of the settings. Values beyond their limits are moved to the limits.

    Parameters
    ----------
    along
        Where wires run.
    strength_edges, strength_surface
        How strongly wires follow the shape, for each way of running: the metric's largest anisotropy.
    finish
        How a wire across the surface becomes a seam.
    straight
        Whether the wire that is straight in the view is offered first, across the surface.
    metric
        What draws wires to features.
    clamp
        The percentile of feature strengths that counts as the strongest.
    clear
        Whether wires clear seams instead of marking them.
    mirror
        The axes, 0 to 2, over which wires are mirrored.
    stroke_radius
        How far strokes reach, in the object's units; 0: ten rings of vertices.
    snap
        Whether seeds snap to features.
    xray
        Whether wires are shown, and things picked, through the mesh.
    heat
        The kind of stretch that colors faces, or ``NONE``.
    show_crests
        Whether ridges and valleys are shown.
    """

    along: Along = "EDGES"
    strength_edges: float = STRENGTHS["EDGES"]
    strength_surface: float = STRENGTHS["SURFACE"]
    finish: Finish = "SNAP"
    straight: bool = False
    metric: MetricName = "feature"
    clamp: float = CLAMP_PERCENTILE
    clear: bool = False
    mirror: tuple[int, ...] = ()
    stroke_radius: float = 0.0
    snap: bool = False
    xray: bool = False
    heat: str = "NONE"
    show_crests: bool = False

    def __post_init__(self) -> None:
        limits = {"strength_edges": STRENGTH_RANGE, "strength_surface": STRENGTH_RANGE, "clamp": CLAMP_RANGE}
        for name, (low, high) in limits.items():
            object.__setattr__(self, name, min(max(getattr(self, name), low), high))
        object.__setattr__(self, "mirror", tuple(sorted(set(self.mirror))))

    @property
    def marking(self) -> bool:
        """Whether wires mark seams."""
        return not self.clear

    @property
    def strengths(self) -> Mapping[Along, float]:
        """How strongly wires follow the shape, for each way of running."""
        return {"EDGES": self.strength_edges, "SURFACE": self.strength_surface}

    @property
    def strength(self) -> float:
        """How strongly wires follow the shape, for the way that they run."""
        return self.strengths[self.along]

    @property
    def computes(self) -> tuple[object, ...]:
        """What decides how wires are computed, besides the way that they run."""
        return self.metric, self.strength_edges, self.strength_surface, self.clamp

    def stepped(self, steps: int) -> Options:
        """Return options with a strength that is some steps greater, or less; the same at the limit."""
        return replace(self, **{strength_name(self.along): self.strength * STRENGTH_STEP**steps})


def strength_name(along: Along) -> str:
    """Return the name of the option that holds the strength for one way of running."""
    return f"strength_{along.lower()}"
