# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for seams on all objects in Edit Mode, from reading the meshes to unwrapped islands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Literal

from ..core.islands.map_faults import NO_FAULTS
from ..core.seams.parts import PartEdits
from ..core.seams.suggestion import Request, energy_of, mean_stretch, stretch_of
from ..words.notices import Notices
from ..words.suggestion import Outcome
from . import edit_mesh, uv_map
from .seam_islands import mapped, missing_cuts
from .suggestion import Suggestion
from .unwrap import Layout, Unwrapped, unwrap_changed

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    import bpy
    import numpy as np
    from numpy.typing import NDArray

    from .suggestion import Options

Progress = Callable[[float], bool]
"""Takes the finished fraction, and returns whether to continue."""
_CUT_CRUMB = 0.25
"""Cuts that run side by side cross here and there. A piece smaller than this fraction of the smallest planned island is merged."""


@dataclass(frozen=True)
class Wanted:
    """Requirements for the seams.

    Parameters
    ----------
    stretch
        The mean stretch in percent.
    islands
        The least number of islands of each object.
    unwraps
        Whether to unwrap the islands whose seams have changed. Otherwise Blender's Live Unwrap decides.
    """

    stretch: float = 17.0
    islands: int = 1
    unwraps: bool = True

    @property
    def request(self) -> Request:
        """The requirements for a plan."""
        return Request(energy_of(0.01 * self.stretch), self.islands)


def objects_to_cut(
    objects: Collection[bpy.types.Object], selected: bool
) -> dict[bpy.types.Object, NDArray[np.integer] | None]:
    """Return the objects to cut, each with the faces whose islands are cut, or None for all islands.

    Parameters
    ----------
    objects
        In Edit Mode.
    selected
        Whether only islands with selected faces are cut.
    """
    if selected:
        return {obj: edit_mesh.selected_faces(obj) for obj in objects}
    return dict.fromkeys(objects)


class Suggestions:
    """Suggested wires for several objects.

    Parameters
    ----------
    objects
        In Edit Mode, each with the faces whose islands are cut, or None for all islands. Objects without visible faces are left out.
    options
        How wires are planned.
    wanted
        Requirements for the seams.

    Attributes
    ----------
    notices
        Problems with the wires that are stored with the meshes.
    problem
        Why no object can be cut.

    Raises
    ------
    native.NativeError
        If the compiled part is missing.
    """

    def __init__(
        self, objects: Mapping[bpy.types.Object, NDArray[np.integer] | None], options: Options, wanted: Wanted
    ) -> None:
        self.notices = Notices()
        self.problem = "No face is visible"
        self._wanted = wanted
        self._unwrapped: Unwrapped | None = None
        self._found: list[Suggestion] = []
        for obj, faces in objects.items():
            try:
                suggestion = Suggestion(obj, options, faces)
            except ValueError as error:
                self.problem = str(error)
                continue
            for notice in suggestion.mesh.notices.take():
                self.notices.add(notice.level, notice.text)
            if len(suggestion.mesh.arrays.triangles):
                self._found.append(suggestion)

    def __iter__(self) -> Iterator[Suggestion]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    @property
    def are_alive(self) -> bool:
        """Whether no mesh has changed since it was read."""
        return all(suggestion.mesh.alive() for suggestion in self)

    def measure(self, progress: Progress) -> None:
        """Measure all meshes for parts; any thread may.

        Parameters
        ----------
        progress
            Is told the fraction done; where it returns False, `seamwire_core.Cancelled` is raised.
        """
        for suggestion, share in self._shares(progress):
            suggestion.measure(share)

    def count(self, amount: float, edits: Mapping[str, PartEdits], progress: Progress) -> int:
        """Return the number of parts of all meshes for an amount from 0 to 1; any thread may.

        The edits have the names of objects. `progress` is that of `measure`.
        """
        shares = self._shares(progress)
        return sum(suggestion.count(amount, _own(edits, suggestion), share) for suggestion, share in shares)

    def choose(self, amount: float, edits: Mapping[str, PartEdits], progress: Progress = lambda _: True) -> None:
        """Choose the parts for an amount from 0 to 1, as `count` finds them."""
        for suggestion, share in self._shares(progress):
            suggestion.choose(amount, _own(edits, suggestion), share)

    def limit_stretch(self, percent: float) -> None:
        """Let the next plans have another mean stretch. `choose` drops those for the stretch before."""
        self._wanted = replace(self._wanted, stretch=percent)

    @property
    def part_count(self) -> int:
        """The number of chosen parts."""
        return sum(suggestion.part_count for suggestion in self)

    def plan(self, progress: Progress, is_enough: Callable[[], bool] = lambda: False) -> None:
        """Plan wires in the chosen parts of all meshes; any thread may.

        Parameters
        ----------
        progress
            As that of `measure`.
        is_enough
            Whether to go on with the best plans so far; the first plan of each mesh is waited for.
        """
        for suggestion, share in self._shares(progress):
            suggestion.plan(self._wanted.request, share, is_enough=is_enough)

    def lay_out(self, progress: Progress) -> None:
        """Find how the islands of the plans will lie in the UV map; any thread may. `progress` is that of `measure`."""
        for suggestion, share in self._shares(progress):
            suggestion.lay_out(share)

    def _shares(self, progress: Progress) -> Iterator[tuple[Suggestion, Progress]]:
        """Yield each suggestion with its share of the progress."""
        count = len(self)
        for number, suggestion in enumerate(self):
            yield suggestion, partial(_part, progress, number, count)

    def refresh(self) -> None:
        """Read the meshes again. Wires and seams that were added during the search stay.

        Raises
        ------
        ValueError
            If a mesh has another shape than the planned one.
        """
        if not all(suggestion.mesh.refresh(suggestion.mesh.obj) for suggestion in self):
            raise ValueError("The mesh changed during the search")

    @property
    def has_wires(self) -> bool:
        """Whether any wire was found."""
        return any(suggestion.wires for suggestion in self)

    @property
    def crumb(self) -> float:
        """The fraction of a mesh's area below which islands beside cuts are merged."""
        smallest = (suggestion.smallest() for suggestion in self if suggestion.along == "SURFACE" and suggestion.slits)
        return _CUT_CRUMB * min(smallest, default=0.0)

    def finished_by(self, finish: Literal["CUT", "SLIDE"]) -> list[Suggestion]:
        """Return the suggestions with wires across the surface that become seams in this way."""
        across = (suggestion for suggestion in self if suggestion.along == "SURFACE" and suggestion.slits)
        return [suggestion for suggestion in across if suggestion.finish == finish]

    def write_borders(self) -> None:
        """Keep the borders of meshes whose other wires are cut."""
        for suggestion in self.finished_by("CUT"):
            suggestion.write(suggestion.border_wires)

    def write(self) -> None:
        """Keep all wires with the meshes, except meshes whose wires are cut."""
        cut = self.finished_by("CUT")
        for suggestion in self:
            if suggestion not in cut:
                suggestion.write(suggestion.wires)

    def unwrap(self, context: bpy.types.Context) -> int:
        """Unwrap if wanted, otherwise follow Blender's Live Unwrap. Return the number of unwrapped islands.

        If the meshes had no seams, all UVs are replaced, so that the new islands fill the UV square.

        Raises
        ------
        ValueError, native.NativeError
            If a map cannot be made.
        """
        if not self._wanted.unwraps:
            edit_mesh.live_unwrap(context)
            return 0
        starts = {suggestion.mesh.obj: uvs for suggestion in self if (uvs := suggestion.map()) is not None}
        is_first = not any(suggestion.had_seams or suggestion.others for suggestion in self)
        is_whole = {suggestion.mesh.obj for suggestion in self} >= set(context.objects_in_mode_unique_data)
        every = is_first and is_whole and self.has_wires
        layout = Layout(straight_cost=min(suggestion.straight_cost for suggestion in self))
        self._unwrapped = unwrap_changed(context, every=every, starts=starts, layout=layout)
        return self._unwrapped.islands

    def outcome(self) -> Outcome:
        """Measure the islands, and the UV maps that the meshes have. If nothing was to be unwrapped, the planned maps count."""
        wanted, done = self._wanted, self._unwrapped
        missing = [missing_cuts(suggestion.mesh.obj) for suggestion in self]
        is_few = any(
            len(own) - suggestion.others < wanted.islands for own, suggestion in zip(missing, self, strict=True)
        )
        energies, areas = self._energies()
        return Outcome(
            wires=sum(len(suggestion.wires) for suggestion in self),
            marked=sum(suggestion.marked for suggestion in self),
            missing=[int(cuts) for own in missing for cuts in own],
            islands_wanted=wanted.islands if is_few else 0,
            stretch=100.0 * mean_stretch(energies, areas) if energies else None,
            stretches=[100.0 * stretch_of(energy) for energy in energies],
            stretch_wanted=wanted.stretch,
            unwrapped=None if done is None else done.islands,
            faults=NO_FAULTS if done is None else done.faults,
        )

    def _energies(self) -> tuple[list[float], list[float]]:
        """Return the energy of each map, and the area of its surface."""
        if not self._wanted.unwraps:
            return [float(suggestion.best.energy) for suggestion in self], [suggestion.area for suggestion in self]
        if self._unwrapped is None:  # the maps on the meshes are those from before
            return [], []
        maps = {obj: found for obj in (each.mesh.obj for each in self) if (found := mapped(obj)) is not None}
        return [found.energy(uv_map.aspect(obj)) for obj, found in maps.items()], [
            found.area for found in maps.values()
        ]


def _own(edits: Mapping[str, PartEdits], suggestion: Suggestion) -> PartEdits:
    return edits.get(suggestion.mesh.obj.name_full, PartEdits())


def _part(progress: Progress, number: int, count: int, fraction: float) -> bool:
    """Report a fraction of one of several pieces of work."""
    return progress((number + fraction) / count)
