# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of wires that the library suggests for one object in edit mode."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..core import native
from ..core.defaults import CLAMP_PERCENTILE, STRENGTHS
from ..core.suggestion import (
    CRUMB,
    CRUMB_OF_ISLAND,
    best_along,
    best_finish,
    bordering_seeds,
    is_parted,
    mutual,
    narrowed,
    planned_wires,
    spread_of,
    spreads,
)
from .object_session import ObjectSession, mirror_axes
from .seam_islands import Worst, labels_of, stretch_of, worst_island

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import bpy
    import seamwire_core
    from numpy.typing import NDArray

    from ..core.network import Along, Finish, Wire


_MORE_SEEDS = 120
"""How many more seeds than at first there may be for pieces that are no discs."""
SEEDS_IN_ISLAND = (12, 24, 48)
"""How many seeds are laid in each island that is not parted otherwise, one number after the other."""
_KEPT = 0.5
"""The part of the mesh's area, in islands that are to be smaller, from which on all is planned anew, not within these alone."""
_TRIED = (0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
"""What may be left of the spread of an island that is parted for its stretch."""


def _progress_of(progress: Callable[[float], bool], done: int, number: int, fraction: float) -> bool:
    """Tell the fraction of one of several parts as that of all."""
    return progress((done + fraction) / number)


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
    selected
        Whether only islands with selected faces are parted.

    Attributes
    ----------
    wires
        Those suggested last.
    plan
        What they were made of; None: nothing was planned yet.
    partings
        Plans that part one island, those with the fewest islands first; see `part`.
    marked
        How many edges they have made seams.

    Raises
    ------
    ValueError, native.NativeError
        Where no edge is visible, no face is selected that has to be, or the compiled part is missing.
    """

    def __init__(
        self,
        obj: bpy.types.Object,
        along: Along | None,
        symmetric: bool,
        seeds: Sequence[int],
        finish: Finish | None,
        selected: bool = False,
    ) -> None:
        self._core = native.load()
        self.mesh = ObjectSession(obj)
        self.along: Along = along or best_along(self.mesh.arrays.polygons)
        self._symmetric = symmetric
        self._crumb_of_island = 1.0
        self._seeds = tuple(seeds)
        self.finish: Finish = finish or best_finish(self.mesh.arrays.polygons)
        self._mirror = mirror_axes(obj.data)
        corners = self.mesh.arrays.points[self.mesh.arrays.triangles]
        self._areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        self._images: NDArray[np.int32] | None = None
        self._within: NDArray[np.bool_] | None = None
        self._others = 0
        if selected:
            labels = labels_of(self.mesh.arrays)
            parted = np.unique(labels[self._is_selected()])
            if not len(parted):
                raise ValueError("No face is selected")
            self._within = np.isin(labels, parted)
            self._others = int(labels.max()) + 1 - len(parted)
        self._planners: list[seamwire_core.SeamPlanner] = []
        self._limits: NDArray[np.float64] | None = None
        self.plan: seamwire_core.SeamPlan | None = None
        self.wires: list[Wire] = []
        self.partings: list[seamwire_core.SeamPlan] = []
        self.marked = 0

    def _is_selected(self) -> NDArray[np.bool_]:
        """Return which triangles are of selected faces, (m,)."""
        return np.array([face.select for face in self.mesh.cage.bm.faces], dtype=bool)[self.mesh.arrays.polygons]

    def prepare(self, progress: Callable[[float], bool]) -> None:
        """Find the wires to choose from; any thread may.

        Parameters
        ----------
        progress
            Is told the fraction done; where it returns False, `seamwire_core.Cancelled` is raised.
        """
        axes = (self._mirror or self.mesh.session.symmetric_axes)[:1] if self._symmetric else ()
        self._images = mutual(self.mesh.session.partners(axes)) if axes else None
        seeding = {"seams": self.mesh.arrays.seams}
        if self._within is not None:
            seeding["density"] = density = self._density(self._within)
            if self._images is not None and not np.array_equal(density, density[self._images] * (self._images >= 0)):
                self._images = None  # the selected islands are not symmetric
        self._planners = self._find_wires(self._seeds, progress, **seeding)

    def _density(self, is_part: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return the density of seeds that are to be in a part of the triangles alone."""
        density = np.zeros(len(self.mesh.arrays.points))
        density[self.mesh.arrays.triangles[is_part]] = 1.0
        return density

    def _find_wires(
        self, seeds: Sequence[int], progress: Callable[[float], bool], **seeding: NDArray[np.generic]
    ) -> list[seamwire_core.SeamPlanner]:
        """Return a planner for each number of seeds; `density`, `seeds_at` and `seams` as ``seamwire_core.SeamPlanner`` has them."""
        make = self._planners[0].with_seeds if self._planners else self._make_planner
        planners = []
        for done, number in enumerate(seeds):
            planner = make(
                seeds=number,
                most_seeds=number + _MORE_SEEDS,
                **seeding,
                images=self._images,
                progress=partial(_progress_of, progress, done, len(seeds)),
            )
            planners.append(planner)
            make = planner.with_seeds
        return planners

    def _make_planner(self, **options: object) -> seamwire_core.SeamPlanner:
        arrays = self.mesh.arrays
        return self._core.SeamPlanner(
            self._core.Surface(arrays.points, arrays.triangles, arrays.edges),
            along=self.along.lower(),
            max_anisotropy=STRENGTHS[self.along],
            clamp_percentile=CLAMP_PERCENTILE,
            **options,
        )

    def suggest(
        self,
        progress: Callable[[float], bool],
        max_spread: float,
        islands: int = 0,
        straightened: bool = True,
        kept: Sequence[seamwire_core.PlannedWire] = (),
        planners: Sequence[seamwire_core.SeamPlanner] = (),
    ) -> None:
        """Choose wires of some planners, else of those prepared; any thread may.

        `islands`, of those that are to be parted, `straightened` and `kept` are those of ``seamwire_core.SeamPlanner.plan``.
        """
        planners = planners or self._planners
        if self._limits is None:
            self._limits = np.full(len(self.mesh.arrays.triangles), max_spread)
        plans = [
            planner.plan(
                max_spread=self._limits,
                islands=islands and islands + self._others,
                crumb=CRUMB,
                crumb_of_island=self._crumb_of_island,
                kept=list(kept),
                may_start_on_others=not self.is_cut,
                straightened=straightened,
                progress=partial(_progress_of, progress, done, len(planners)),
            )
            for done, planner in enumerate(planners)
        ]
        self.use(min(plans, key=lambda plan: (plan.not_discs, plan.cost)))

    @property
    def is_cut(self) -> bool:
        """Whether the wires are to be cut into the faces."""
        return self.along == "SURFACE" and self.finish == "CUT"

    def use(self, plan: seamwire_core.SeamPlan) -> None:
        """Suggest the wires of a plan."""
        self.plan = plan
        self.wires = planned_wires(plan, self.along, STRENGTHS[self.along])

    def smallest(self) -> float:
        """Return the least part of the mesh's area that an island has: of those planned, or of those that may be."""
        assert self.plan is not None
        if self._crumb_of_island == 1.0:
            return CRUMB
        areas = np.bincount(self.plan.islands, self._areas)
        return min(CRUMB, float(areas.min() / areas.sum()))

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
        if stretch is None:
            return []
        is_stretched = np.maximum(stretch.angle, stretch.area) > most
        if self._within is not None:
            is_stretched[self.plan.islands[~self._within]] = False
        return np.flatnonzero(is_stretched).tolist()

    def narrow(self, stretched: Sequence[int], progress: Callable[[float], bool]) -> None:
        """Suggest again, with smaller islands in place of some; any thread may.

        What bounds other islands is kept, unless these are most of the mesh. Where the wires there are do not part an island,
        more are found within it.
        """
        assert self.plan is not None and self._limits is not None
        arrays, before = self.mesh.arrays, self.plan.islands
        own = spreads(arrays.points, arrays.triangles, before)
        self._limits = narrowed(self._limits, stretched, before, own)
        self._crumb_of_island = CRUMB_OF_ISLAND
        whole = np.isin(before, stretched)
        is_kept = self._areas[whole].sum() < _KEPT * self._areas.sum()
        self.suggest(progress, 0.0, straightened=False, kept=self.plan.wires if is_kept else [])
        for seeds in SEEDS_IN_ISLAND:
            whole &= ~is_parted(before, self.plan.islands, self._areas)[before]
            if not whole.any():
                break
            kept = self.plan.wires
            planners = self._find_wires_within(whole, seeds * len(np.unique(before[whole])), kept, progress)
            self.suggest(progress, 0.0, straightened=False, kept=kept, planners=planners)

    def _find_wires_within(
        self,
        is_part: NDArray[np.bool_],
        seeds: int,
        wires: Sequence[seamwire_core.PlannedWire],
        progress: Callable[[float], bool],
    ) -> list[seamwire_core.SeamPlanner]:
        """Return a planner with the seeds of wires and some more, in a part of the triangles alone."""
        seeds_at = np.unique(np.array([wire.seeds for wire in wires], dtype=np.int32))
        edges = [np.stack([wire.vertices[:-1], wire.vertices[1:]], axis=1) for wire in wires]
        seams = np.concatenate([self.mesh.arrays.seams, *edges])
        return self._find_wires(
            (len(seeds_at) + seeds,), progress, density=self._density(is_part), seeds_at=seeds_at, seams=seams
        )

    def straighten(self, plan: seamwire_core.SeamPlan, fixed: set[int], progress: Callable[[float], bool]) -> None:
        """Suggest the wires of a plan with direct ones in place of detours, but not at fixed seeds; any thread may."""
        assert self._limits is not None
        straight = self._planners[0].straightened(
            plan.wires,
            max_spread=self._limits,
            crumb=CRUMB,
            crumb_of_island=self._crumb_of_island,
            may_start_on_others=not self.is_cut,
            fixed=sorted(fixed),
            progress=progress,
        )
        self.use(straight)

    def seeds_around(self, stretched: Sequence[int], before: seamwire_core.SeamPlan) -> set[int]:
        """Return the seeds of what bounds those islands of a former plan that some of the present ones have come from."""
        assert self.plan is not None
        area = np.zeros((self.plan.island_count, before.island_count))
        np.add.at(area, (self.plan.islands, before.islands), self._areas)
        came_from = np.flatnonzero(np.isin(area.argmax(axis=0), stretched))
        came_from = np.union1d(came_from, area[stretched].argmax(axis=1))
        return bordering_seeds(before.wires, self.mesh.arrays.triangles, np.isin(before.islands, came_from))

    def worst(self) -> Worst | None:
        """Return the island that the UV map stretches most, by angle or by area; None: there are no UVs."""
        found = [worst_island(self.mesh.obj, kind) for kind in ("ANGLE", "AREA")]
        return max((one for one in found if one is not None), key=lambda one: one.value, default=None)

    def part(self, island: Worst, seeds: int, progress: Callable[[float], bool]) -> None:
        """Find `partings`, with smaller islands in place of one that there is; any thread may.

        Parameters
        ----------
        island
            The one.
        seeds
            How many there are in it alone; 0: those prepared, all over the mesh.
        progress
            As above.
        """
        arrays = self.mesh.arrays
        labels = np.where(np.isin(arrays.polygons, island.faces), 0, 1).astype(np.int32)
        whole = np.full(len(labels), spread_of(np.pi))
        own = spreads(arrays.points, arrays.triangles, labels)
        # Wires may also be slits within an island: it is they that tell plans apart.
        plans: dict[frozenset[bytes], seamwire_core.SeamPlan] = {}
        self._crumb_of_island = CRUMB_OF_ISLAND
        planners = self._find_wires_within(labels == 0, seeds, (), progress) if seeds else self._planners
        for done, left in enumerate(_TRIED):
            self._limits = narrowed(whole, [0], labels, own, left)
            told = partial(_progress_of, progress, done, len(_TRIED))
            self.suggest(told, 0.0, straightened=False, planners=planners)
            assert self.plan is not None
            if self.wires:
                plans.setdefault(frozenset(wire.vertices.tobytes() for wire in self.plan.wires), self.plan)
        self._limits = whole
        self.partings = sorted(plans.values(), key=lambda plan: plan.island_count)

    def stretch_within(self, faces: NDArray[np.int32]) -> float:
        """Return how much the UV map stretches the planned islands that have some of these faces, at most, in octaves."""
        assert self.plan is not None
        arrays, islands = self.mesh.arrays, self.plan.islands
        stretch = stretch_of(self.mesh.obj, arrays, islands)
        if stretch is None:
            return np.inf
        parts = np.unique(islands[np.isin(arrays.polygons, faces)])
        return float(np.maximum(stretch.angle, stretch.area)[parts].max())
