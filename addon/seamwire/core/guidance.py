# SPDX-License-Identifier: GPL-3.0-or-later
"""What the wires of a drawing session are led by: the way they run, metric and strength, mirror, strokes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from .defaults import CLAMP_RANGE, STRENGTH_RANGE, STRENGTH_STEP
from .strokes import FOR_WIRES, OffMeshError, Scribble, drawn, through_vertices
from .workings import Workings

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .network import Along
    from .solver import MetricName
    from .strokes import ActsOn


class Guidance(Workings):
    """What can be done to a session beside drawing wires: everything here is for those drawn from then on."""

    def switch(self, along: Along) -> bool:
        """Run wires along edges or across the surface from here on; kept wires stay as they are."""
        if along == self.along:
            return True
        self._calm()
        before = self.along
        self.along = along
        self._candidates.chosen = None
        self._candidates.clear()
        self._loops.wanted = False
        self._loops.clear()
        if self._network.seed is not None and not self._sow(self._network.seed):
            self.along = before
            return False
        self.message = ""
        self._aim(self._candidates.target, again=True)
        self.revision += 1
        return True

    def toggle_marking(self) -> bool:
        """Let the wires that are kept from here on clear seams instead of marking them, or mark again."""
        self.marking = not self.marking
        self.message = ""
        self.revision += 1
        return True

    def change_strength(self, steps: int) -> bool:
        """Draw wires more or less strongly to features, a quarter a step; kept wires stay as they are."""
        low, high = STRENGTH_RANGE
        strength = min(max(self.strength * STRENGTH_STEP**steps, low), high)
        if strength == self.strength:
            return self._refuse(
                f"The strength is {strength:g} already, the {'most' if steps > 0 else 'least'} there is"
            )
        return self._use_metric(self.metric, {**self._engines.strengths, self.along: strength})

    def set_strength(self, along: Along, strength: float) -> bool:
        """Draw wires that run one way so strongly to features; kept wires stay as they are."""
        low, high = STRENGTH_RANGE
        strength = min(max(strength, low), high)
        # What comes from Blender's properties is of single precision.
        if abs(strength - self._engines.strengths[along]) <= 1e-4 * strength:
            return True
        return self._use_metric(self.metric, {**self._engines.strengths, along: strength})

    def set_metric(self, metric: MetricName) -> bool:
        """Draw wires by another metric; kept wires stay as they are."""
        return metric == self.metric or self._use_metric(metric, self._engines.strengths)

    def set_clamp(self, percentile: float) -> bool:
        """Let another percentile of feature strengths count as the strongest; kept wires stay as they are."""
        low, high = CLAMP_RANGE
        percentile = min(max(percentile, low), high)
        if abs(percentile - self.clamp) <= 1e-4:
            return True
        return self._use_metric(self.metric, self._engines.strengths, percentile)

    def set_mirror(self, axes: Iterable[int]) -> bool:
        """Mirror the wires that are kept from here on over axes, 0 to 2; none: not at all."""
        mirror = tuple(sorted(set(axes)))
        if mirror != self._network.mirror:
            self._set(replace(self._network, mirror=mirror))
        return True

    def scribble(
        self,
        points: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        *,
        vertices: ArrayLike | None = None,
        attracts: bool = True,
        acts_on: ActsOn | None = None,
        radius: float | None = None,
    ) -> bool:
        """Draw a stroke that live wires follow, or keep from; kept wires stay as they are.

        Parameters
        ----------
        points
            (n, 3) as a hand drew them on the surface, to be smoothed a little.
        faces
            (n,) the triangle of the surface that each lies in.
        vertices
            (n,) instead of both: the vertices that the stroke runs through.
        attracts
            Whether wires follow it; else crossing it is short, and following it long.
        acts_on
            Which of the two wires it is meant for; None: the active one while a wire is live, else both.
        radius
            How far it reaches, in the points' units; None: ten rings of vertices.
        """
        try:
            if vertices is not None:
                stroke = through_vertices(vertices, self._points)
            elif points is None or faces is None or self._triangles is None:
                raise ValueError("a stroke needs points and the triangles that they lie in, or vertices")
            else:
                stroke = drawn(points, faces, self._points, self._triangles)
        except OffMeshError as error:
            return self._refuse(str(error))
        self._last_click = None
        self.drag_cancel()
        chosen = self._candidates.chosen
        if acts_on is None and self._network.seed is not None:
            # The wire that the stroke is for stays the active one, even where the other is shorter now.
            chosen = self._candidates.active_index
            acts_on = FOR_WIRES[chosen]
        scribble = Scribble(*stroke, attracts=attracts, acts_on=acts_on or "both", radius=radius)
        return self._scribbled((*self._network.scribbles, scribble), chosen)

    def erase(self, scribble: Scribble) -> bool:
        """Remove a stroke."""
        rest = tuple(own for own in self._network.scribbles if own.id != scribble.id)
        if len(rest) == len(self._network.scribbles):
            return self._refuse("This stroke is not there any more")
        self._last_click = None
        self.drag_cancel()
        return self._scribbled(rest, self._candidates.chosen)

    def _scribbled(self, scribbles: tuple[Scribble, ...], chosen: int | None) -> bool:
        self._change(replace(self._network, scribbles=scribbles))
        self._candidates.chosen = chosen
        return True
