# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of wires that the library suggests for one object in edit mode."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core import native
from ..core.defaults import CLAMP_PERCENTILE, STRENGTHS
from ..core.suggestion import best_along, best_finish, narrowed, planned_wires, spread_of, spreads
from .object_session import ObjectSession, mirror_axes
from .seam_islands import Worst, stretch_of, worst_island

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import bpy
    import seamwire_core
    from numpy.typing import NDArray

    from ..core.network import Along, Finish, Wire


_MORE_SEEDS = 120
"""How many more seeds than at first there may be for pieces that are no discs."""
_MOST_DOUBLINGS = 3
"""How often there are twice as many seeds for smaller islands."""
_TRIED = (0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
"""What may be left of the spread of an island that is parted for its stretch."""


class Suggestion:
    """Wires for one object: those that are suggested, in the mesh or not.

    Parameters
    ----------
    obj
        In edit mode.
    along
        How the wires run; None: as is best for the mesh.
    symmetric
        Whether they come in pairs where the mesh is symmetric.
    seeds
        How many seeds there are to begin with; of several such numbers the one that makes the better seams.
    finish
        What becomes the seam of wires across the surface; None: as is best for the mesh.

    Attributes
    ----------
    wires
        Those suggested last.
    plan
        What they were made of; None: nothing was planned yet.
    marked
        How many edges they have made seams.

    Raises
    ------
    ValueError, native.NativeError
        Where no edge is visible, or the compiled part is missing.
    """

    def __init__(
        self, obj: bpy.types.Object, along: Along | None, symmetric: bool, seeds: Sequence[int], finish: Finish | None
    ) -> None:
        self._core = native.load()
        self.mesh = ObjectSession(obj)
        self.along: Along = along or best_along(self.mesh.arrays.polygons)
        self._symmetric = symmetric
        self._seeds, self._most_seeds = tuple(seeds), max(seeds) << _MOST_DOUBLINGS
        self.finish: Finish = finish or best_finish(self.mesh.arrays.polygons)
        self._mirror = mirror_axes(obj.data)
        self._planners: list[seamwire_core.SeamPlanner] = []
        self._limits: NDArray[np.float64] | None = None
        self.plan: seamwire_core.SeamPlan | None = None
        self.wires: list[Wire] = []
        self.marked = 0

    def prepare(self, progress: Callable[[float], bool]) -> None:
        """Find the wires to choose from; any thread may.

        Parameters
        ----------
        progress
            Is told the fraction done; where it returns False, `seamwire_core.Cancelled` is raised.
        """
        arrays = self.mesh.arrays
        images = None
        axes = (self._mirror or self.mesh.session.symmetric_axes)[:1] if self._symmetric else ()
        if axes:
            images = self.mesh.session.partners(axes)
        surface = self._core.Surface(arrays.points, arrays.triangles, arrays.edges)
        self._planners = [
            self._core.SeamPlanner(
                surface,
                along=self.along.lower(),
                max_anisotropy=STRENGTHS[self.along],
                clamp_percentile=CLAMP_PERCENTILE,
                seeds=seeds,
                most_seeds=seeds + _MORE_SEEDS,
                images=images,
                seams=arrays.seams,
                progress=lambda fraction, done=done: progress((done + fraction) / len(self._seeds)),
            )
            for done, seeds in enumerate(self._seeds)
        ]

    def suggest(self, max_spread: float, islands: int = 0, straightened: bool = True) -> None:
        """Choose wires; `islands` and `straightened` as ``seamwire_core.SeamPlanner.plan`` has them."""
        if self._limits is None:
            self._limits = np.full(len(self.mesh.arrays.triangles), max_spread)
        cuts = self.along == "SURFACE" and self.finish == "CUT"
        plans = [
            planner.plan(
                max_spread=self._limits, islands=islands, may_start_on_others=not cuts, straightened=straightened
            )
            for planner in self._planners
        ]
        self.use(min(plans, key=lambda plan: (plan.not_discs, plan.cost)))

    def use(self, plan: seamwire_core.SeamPlan) -> None:
        """Suggest the wires of a plan."""
        self.plan = plan
        self.wires = planned_wires(plan, self.along, STRENGTHS[self.along])

    def write(self) -> None:
        """Keep the wires with the mesh."""
        self.mesh.add(self.wires)
        self.marked, _ = self.mesh.write(self.mesh.plan())

    def take_back(self) -> None:
        """Undo `write`."""
        for wire in self.wires:
            self.mesh.session.drop(wire)
        self.mesh.write(self.mesh.plan())

    def stretched(self, most: float) -> list[int]:
        """Return the islands that the UV map stretches more than so many octaves, by angle or area, see `core.stretch`."""
        assert self.plan is not None
        stretch = stretch_of(self.mesh.obj, self.mesh.arrays, self.plan.islands)
        return [] if stretch is None else np.flatnonzero(np.maximum(stretch.angle, stretch.area) > most).tolist()

    def narrow(self, stretched: list[int]) -> None:
        """Suggest again, with smaller islands in place of some; between more seeds where there are no wires for that."""
        assert self.plan is not None and self._limits is not None
        before = self.plan.island_count
        arrays, islands = self.mesh.arrays, self.plan.islands
        self._limits = narrowed(self._limits, stretched, islands, spreads(arrays.points, arrays.triangles, islands))
        self.suggest(0.0, straightened=False)
        if self.plan.island_count <= before and max(self._seeds) < self._most_seeds:
            self._seeds = (min(2 * max(self._seeds), self._most_seeds),)
            self.prepare(lambda _: True)
            self.suggest(0.0, straightened=False)

    def worst(self) -> Worst | None:
        """Return the island that the UV map stretches most, by angle or by area; None: there are no UVs."""
        found = [worst_island(self.mesh.obj, kind) for kind in ("ANGLE", "AREA")]
        return max((one for one in found if one is not None), key=lambda one: one.value, default=None)

    def parting(self, island: Worst) -> list[seamwire_core.SeamPlan]:
        """Return plans with smaller islands in place of one that there is, those with the fewest islands first."""
        arrays = self.mesh.arrays
        labels = np.where(np.isin(arrays.polygons, island.faces), 0, 1).astype(np.int32)
        whole = np.full(len(labels), spread_of(np.pi))
        own = spreads(arrays.points, arrays.triangles, labels)
        # Wires may also be slits within an island: it is they that tell plans apart.
        plans: dict[frozenset[bytes], seamwire_core.SeamPlan] = {}
        for left in _TRIED:
            self._limits = narrowed(whole, [0], labels, own, left)
            self.suggest(0.0)
            assert self.plan is not None
            if self.wires:
                plans.setdefault(frozenset(wire.vertices.tobytes() for wire in self.plan.wires), self.plan)
        self._limits = whole
        return sorted(plans.values(), key=lambda plan: plan.island_count)

    def stretch_within(self, faces: NDArray[np.int32]) -> float:
        """Return how much the UV map stretches the planned islands that have some of these faces, at most, in octaves."""
        assert self.plan is not None
        arrays, islands = self.mesh.arrays, self.plan.islands
        stretch = stretch_of(self.mesh.obj, arrays, islands)
        if stretch is None:
            return np.inf
        parts = np.unique(islands[np.isin(arrays.polygons, faces)])
        return float(np.maximum(stretch.angle, stretch.area)[parts].max())
