# SPDX-License-Identifier: GPL-3.0-or-later
"""The library's live wires for each way of running, and the metric that they share."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .live import LiveWire, MetricName
    from .network import Along
    from .strokes import Scribble

STRENGTHS: Mapping[Along, float] = {"EDGES": 10.0, "SURFACE": 20.0}
"""The metric's largest anisotropy to begin with: how strongly wires are drawn to features; docs/method.md says why."""
CLAMP_PERCENTILE = 99.0
"""The percentile of feature strengths that counts as the strongest, to begin with."""
CLAMP_RANGE = (50.0, 100.0)
STRENGTH_STEP = 1.25
STRENGTH_RANGE = (1.0, 100.0)


class Engines:
    """Live wires, each made when it is first asked for.

    Parameters
    ----------
    make
        Makes those of one way, with that way's strength of `STRENGTHS` and `CLAMP_PERCENTILE`.
    strengths
        Largest anisotropy of the metric, where it is to be another one.
    make_scribble
        Makes of a stroke what the live wires take.
    """

    def __init__(
        self,
        make: Callable[[Along], LiveWire],
        strengths: Mapping[Along, float],
        make_scribble: Callable[[Scribble], object],
    ) -> None:
        self._make = make
        self._lives: dict[Along, LiveWire] = {}
        self.strengths: dict[Along, float] = {**STRENGTHS, **strengths}
        self.metric: MetricName = "feature"
        self.clamp = CLAMP_PERCENTILE
        self._make_scribble = make_scribble
        self._scribbles: list[object] = []

    def get(self, along: Along) -> LiveWire:
        """Return the live wires of one way."""
        if along not in self._lives:
            self._lives[along] = self._make(along)
            if (self.metric, self.strengths[along], self.clamp) != ("feature", STRENGTHS[along], CLAMP_PERCENTILE):
                self._tell_metric(along)
            if self._scribbles:
                self._lives[along].set_scribbles(self._scribbles)
        return self._lives[along]

    def use(self, metric: MetricName, strengths: Mapping[Along, float], clamp: float) -> None:
        """Compute with another metric from here on; forks that were made before keep theirs."""
        before = self.metric, self.strengths, self.clamp
        self.metric, self.strengths, self.clamp = metric, dict(strengths), clamp
        for along in self._lives:
            if (metric, strengths[along], clamp) != (before[0], before[1][along], before[2]):
                self._tell_metric(along)

    def follow(self, scribbles: Sequence[Scribble]) -> None:
        """Compute with other strokes from here on; forks that were made before keep theirs."""
        self._scribbles = [self._make_scribble(scribble) for scribble in scribbles]
        for live in self._lives.values():
            live.set_scribbles(self._scribbles)

    def _tell_metric(self, along: Along) -> None:
        self._lives[along].set_metric(self.metric, max_anisotropy=self.strengths[along], clamp_percentile=self.clamp)
