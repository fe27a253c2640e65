# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for seams on all objects in Edit Mode, from reading the meshes to unwrapped islands.

The library finds the parts of each object, and plans the wires between and within them. Functions that take `progress` may run in any
thread, and raise `seamwire_core.Cancelled` where it returns False.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from mathutils import Vector

from ..core.base import native
from ..core.base.geometry import length_of, triangle_areas
from ..core.islands.uv_maps import NO_FAULTS, MappedSurface, square_use
from ..core.network.picks import undirected
from ..core.seams import seam_plan
from ..core.seams.seam_plan import PartChoice, PartEdits
from ..terms.choices import FINISHES
from ..terms.options import CLAMP_PERCENTILE, STRENGTHS
from ..words.reports import ALL_HIDDEN, Notices, Outcome
from . import edit_mesh, finishes
from .object_session import ObjectSession, mirror_axes
from .unwrap import MARGIN, STRAIGHT_COST, UP, Layout, Unwrapped, unwrap_changed
from .uv_islands import aspect, count_islands, labels_of, maps_of, to_scene

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    import bpy
    import seamwire_core
    from numpy.typing import NDArray

    from ..core.islands.uv_maps import SquareUse
    from ..core.network.wires import Wire
    from ..terms.choices import Along, Finish, PartsBy

Progress = Callable[[float], bool]
"""Takes the finished fraction, and returns whether to continue."""
_Asked = tuple["PartsBy", float, PartEdits]
_LEAST_ISLAND = 0.003
"""The fraction of the area of a figure below which no island is wanted."""
_CUT_CRUMB = 0.25
"""Cuts that run side by side cross here and there. A piece smaller than this fraction of the smallest planned island is merged."""
_KEPT = 32
"""How many results of searches for parts are kept, so that an artist can go back to them at once."""
_FIRST = 0.8
"""The fraction of finding parts until the mesh is measured for them."""
_MEASURING = 0.1
"""The fraction of planning until the costs of wires are known."""


@dataclass(frozen=True)
class SearchOptions:
    along: Along | None  # None: as is best for the mesh
    finish: Finish | None  # None: as is best for the mesh
    symmetric: bool  # whether wires come in pairs where the mesh is symmetric
    front: Sequence[float] | None  # (3,) to the viewer in the scene: seams are hidden from there; None: from all sides
    stretch: float  # the mean, in percent
    islands: int  # the least number of each object
    unwraps: bool  # whether to unwrap the islands whose seams have changed; otherwise Blender's Live Unwrap decides


class Suggestion:
    """Wires for one object: parts are found, wires planned in them, and all wires written to the mesh.

    The mesh is planned in object coordinates, without the object's scale, as UV maps are measured. If faces are given, only the islands
    that have some of them are cut. Raises ValueError or NativeError if no edge is visible, none of the faces is, or the compiled part is
    missing.
    """

    def __init__(self, obj: bpy.types.Object, options: SearchOptions, faces: NDArray[np.integer] | None) -> None:
        self._core = native.load()
        self.name = obj.name_full  # also after a rename, because edits use it; threads must not ask Blender
        self.mesh = ObjectSession(obj)
        self.to_scene = to_scene(obj)
        arrays = self.mesh.arrays
        self.along: Along = options.along or self.mesh.find_auto().along
        self.finish: Finish = options.finish or self.mesh.find_auto().finish
        self._symmetric = options.symmetric
        # The direction to the viewer in object coordinates. None also if the object is flattened.
        self._front: tuple[float, float, float] | None = None
        if options.front is not None:
            with suppress(ValueError):
                front = obj.matrix_world.to_3x3().inverted() @ Vector(options.front)
                self._front = tuple(front.normalized()) if front.length > 0.0 else None
        self._within: NDArray[np.bool_] | None = None  # (m,) the triangles of the islands to cut; None: all
        self.others = 0  # the number of other islands
        if faces is not None:
            labels = labels_of(arrays)
            planned = np.unique(labels[np.isin(arrays.polygons, faces)])
            if not len(planned):
                raise ValueError("No face is selected")
            self._within, self.others = np.isin(labels, planned), int(labels.max()) + 1 - len(planned)
        self._finders: dict[PartsBy, seamwire_core.PartFinder] = {}
        self._found: dict[_Asked, seamwire_core.Parts] = {}  # the last ones at the end
        self._by: PartsBy = "AUTO"  # of the chosen parts
        self._planner: seamwire_core.SeamPlanner | None = None
        self._blenders_mirrors = mirror_axes(obj.data)
        self.had_seams = len(arrays.seams) > 0  # before `write`
        # The chosen borders between parts, as chains of vertices. A closed chain ends with its first vertex.
        self.borders: list[NDArray[np.int32]] = []
        self.part_count = 0  # with the islands that are not to be cut
        self.best: seamwire_core.SeamPlan | None = None  # the plan to carry out
        self.straight_cost = STRAIGHT_COST  # for `Layout`: less, if the plan would exceed its limit otherwise
        self.slits: list[Wire] = []  # the wires of this plan
        self._bound = 0.0  # on the energy of plans
        # The plan that was laid out last, its map, the island of each triangle there, and its energy.
        self.laid_out: tuple[seamwire_core.SeamPlan | None, NDArray[np.float64] | None, NDArray[np.int32] | None, float]
        self.laid_out = None, None, None, 0.0
        self.marked = 0  # how many edges `write` made seams

    def measure(self, by: PartsBy, progress: Progress) -> seamwire_core.PartFinder:
        if by not in self._finders:
            arrays = self.mesh.arrays
            self._finders[by] = self._core.PartFinder(
                arrays.surface,
                by="shape" if by == "AUTO" else by.lower(),
                scan=self.along == "SURFACE",
                front=self._front,
                mirror=self._axis,
                marked=arrays.marked,
                seams=arrays.seams,
                progress=progress,
            )
        return self._finders[by]

    @property
    def automatic(self) -> PartsBy | None:
        return self._finders["AUTO"].by.upper() if "AUTO" in self._finders else None

    def count(self, choice: PartChoice, progress: Progress) -> int:
        return self._counted(self._parts_of(choice, progress))

    def _counted(self, parts: seamwire_core.Parts) -> int:
        """Return the number of parts. An island that is not to be cut is one part."""
        return parts.count if self._within is None else len(np.unique(parts.of_face[self._within])) + self.others

    def choose(self, choice: PartChoice, progress: Progress) -> None:
        found = self._parts_of(choice, progress)
        self._by, self.part_count = choice.by, self._counted(found)
        self.borders = [np.asarray(chain) for chain in found.borders]
        if self._within is not None:  # islands that are not to be cut keep no borders
            corners = self.mesh.arrays.triangles[self._within].tolist()
            inside = {undirected(side) for a, b, c in corners for side in ((a, b), (b, c), (c, a))}
            self.borders = [chain for chain in self.borders if seam_plan.edges_of(chain) <= inside]
        self._planner = self.best = None
        self.laid_out = None, None, None, 0.0
        self.slits = []

    def _parts_of(self, choice: PartChoice, progress: Progress) -> seamwire_core.Parts:
        edits = choice.edits.get(self.name, PartEdits())
        asked = choice.by, choice.amount, edits
        found = self._found.pop(asked, None)
        if found is None:
            begin = 0.0 if choice.by in self._finders else _FIRST
            finder, arrays = self.measure(choice.by, lambda done: progress(begin * done)), self.mesh.arrays
            changes = edits.on(arrays.edges, arrays.polygons)
            found = finder.find(choice.amount, **changes, progress=lambda done: progress(begin + (1.0 - begin) * done))
        self._found[asked] = found
        if len(self._found) > _KEPT:
            del self._found[next(iter(self._found))]
        return found

    @property
    def seams(self) -> NDArray[np.int32]:
        chains = [np.stack([chain[:-1], chain[1:]], axis=1) for chain in self.borders]
        return np.concatenate([self.mesh.arrays.seams, *chains]).astype(np.int32)

    @cached_property
    def _axis(self) -> int | None:
        """Return the axis over which wires come in pairs: one of those that Blender mirrors over, if there are any."""
        if not self._symmetric:
            return None
        symmetric = self.mesh.session.symmetry.symmetric_axes
        axis = min(symmetric, key=lambda axis: axis not in self._blenders_mirrors, default=None)
        if axis is None or self._within is None:
            return axis
        # Planned islands that are not symmetric themselves have no pairs.
        images = self.mesh.session.symmetry.partners((axis,))
        planned = np.zeros(len(images), dtype=bool)
        planned[self.mesh.arrays.triangles[self._within]] = True
        has_image = images[planned] >= 0
        return axis if has_image.all() and planned[images[planned]].all() else None

    def _weights(self) -> NDArray[np.float64] | None:
        arrays, strokes = self.mesh.arrays, self.mesh.session.network.strokes
        if self._within is None and not strokes:
            return None
        weights = seam_plan.stroke_weights(arrays.points, arrays.edges, strokes)
        if self._within is not None:
            weights *= seam_plan.keep_out(arrays.triangles, self._within, len(weights))
        return weights

    def plan(self, energy: float, islands: int, progress: Progress, is_enough: Callable[[], bool]) -> None:
        """Find wires in the chosen parts, better and better ones.

        The symmetric Dirichlet energy of the map is at most `energy`, and what is to be cut becomes at least so many `islands`. As soon as
        `is_enough` returns True, the best plan so far counts. The first one is waited for.
        """
        self._bound = energy
        # Other parts may be chosen meanwhile, which drops the planner.
        self._planner = planner = self._core.SeamPlanner(
            self.mesh.arrays.surface,
            along=self.along.lower(),
            max_anisotropy=STRENGTHS[self.along],
            clamp_percentile=CLAMP_PERCENTILE,
            front=self._front,
            mirror=self._axis,
            weights=self._weights(),
            seams=self.seams,
            progress=lambda done: progress(_MEASURING * done),
        )

        def go_on(done: float) -> bool:
            is_found = self._useful(planner.best_so_far) is not None
            return progress(_MEASURING + (1.0 - _MEASURING) * done) and not (is_enough() and is_found)

        try:
            found = planner.plan(distortion=energy, islands=islands + self.others, progress=go_on)
        except self._core.Cancelled:
            found = self._useful(planner.best_so_far)
            if found is None or not is_enough():
                raise
        if self._planner is not planner:
            return  # the plan is for other parts
        from_object = np.linalg.inv(self.mesh.arrays.to_object)
        self.straight_cost = self._straight_cost_of(found)
        self.best = found
        self.slits = seam_plan.planned_wires(found, self.along, STRENGTHS[self.along], from_object)

    def layout_of(self, plan: seamwire_core.SeamPlan, progress: Progress) -> NDArray[np.float64] | None:
        """Return how the islands of a plan will lie in the UV map, (m, 3, 2) in the object's units.

        If unwrapping opens them further, it is the planned map, or None if the search has not ended. Any thread may call it.
        """
        arrays = self.mesh.arrays
        try:
            found = self._core.flatten(
                arrays.in_object,
                arrays.triangles,
                self.edges_of(plan),
                start=plan.uvs,
                straighten=self._straight_cost_of(plan),
                up=UP,
                edges=arrays.edges,
                progress=progress,
            )
            self.laid_out = plan, np.asarray(found.uvs), np.asarray(found.islands), float(found.energy)
        except ValueError:
            self.laid_out = plan, plan.uvs, plan.islands, float(plan.energy)
        return self.laid_out[1]

    def energy_of(self, plan: seamwire_core.SeamPlan) -> float:
        laid_out, _, _, energy = self.laid_out
        return energy if laid_out is plan else float(plan.energy)

    def _straight_cost_of(self, plan: seamwire_core.SeamPlan) -> float:
        return min(STRAIGHT_COST, max(0.0, self._bound - float(plan.energy)))

    @property
    def best_so_far(self) -> seamwire_core.SeamPlan | None:
        """The best plan so far with a map of every part and, unless the search has ended, with seams. Any thread may read it."""
        planner = self._planner
        return None if planner is None else self._useful(planner.best_so_far)

    def _useful(self, plan: seamwire_core.SeamPlan | None) -> seamwire_core.SeamPlan | None:
        if plan is None or not np.isfinite(plan.energy):
            return None
        return plan if plan.wires or self.borders or plan is self.best else None

    @property
    def _border_wires(self) -> list[Wire]:
        return seam_plan.border_wires(self.borders, self.mesh.arrays.points)

    @property
    def wires(self) -> list[Wire]:
        return [*self._border_wires, *self.slits]

    def map(self) -> NDArray[np.float64] | None:
        """Return the map of the plan, (m, 3, 2), in the object's units; None if it has none, or the mesh is another one with the wires."""
        is_same = not self.slits or self.along == "EDGES" or not FINISHES[self.finish].edits
        if self.best is None or not is_same:
            return None
        plan, layout, *_ = self.laid_out
        return layout if plan is self.best and layout is not None else self.best.uvs

    def length_of(self, plan: seamwire_core.SeamPlan) -> float:
        """Return the length of the borders and the wires of a plan, in the scene's units."""
        points, scene = self.mesh.arrays.in_object, to_scene(self.mesh.obj)
        curves = [*(points[chain] for chain in self.borders), *(wire.points for wire in plan.wires)]
        return sum(length_of(curve @ scene.T) for curve in curves)

    def edges_of(self, plan: seamwire_core.SeamPlan) -> NDArray[np.int32]:
        return seam_plan.cut_edges(plan, self.seams)

    @cached_property
    def area(self) -> float:
        return float(self._areas.sum())

    @cached_property
    def _areas(self) -> NDArray[np.float64]:
        return triangle_areas(self.mesh.arrays.in_object, self.mesh.arrays.triangles)

    def crumb(self) -> float:
        """Return the fraction of the mesh's area below which islands beside cuts are merged."""
        assert self.best is not None
        if self._finders[self._by].by == "limbs":
            return _LEAST_ISLAND
        areas = np.bincount(self.best.islands, self._areas)
        smallest = (areas[areas > 0.0] / areas.sum()).min(initial=seam_plan.CRUMB)
        return _CUT_CRUMB * float(smallest)

    @property
    def cuts(self) -> bool:
        return self.along == "SURFACE" and bool(self.slits) and FINISHES[self.finish].cuts

    def write(self) -> None:
        """Keep the wires with the mesh, and finish them. Only borders are kept if the others are to be cut."""
        self.mesh.add(self._border_wires if self.cuts else self.wires)
        marked, _ = self.mesh.write(self.mesh.plan())
        self.marked += marked
        if self.along == "SURFACE":
            finishes.move(self.mesh, self.slits, self.finish)


class SeamSearch:
    """Suggested wires for all objects that have visible faces. If `selected`, only islands with selected faces are cut."""

    def __init__(self, objects: Iterable[bpy.types.Object], options: SearchOptions, selected: bool) -> None:
        self.notices = Notices()  # problems with the wires that are stored with the meshes
        self.problem = ALL_HIDDEN  # why no object can be cut
        self._options = options
        self._unwrapped: Unwrapped | None = None
        self._found: list[Suggestion] = []
        hidden: list[str] = []
        for obj in objects:
            faces = None
            if selected:
                bm = edit_mesh.edit_bmesh(obj.data)
                faces = np.array([face.index for face in bm.faces if face.select], dtype=np.int64)
            try:
                suggestion = Suggestion(obj, options, faces)
                if not len(suggestion.mesh.arrays.triangles):
                    raise edit_mesh.NothingVisibleError(obj)
            except ValueError as error:
                self.problem = str(error)
                hidden += [self.problem] if isinstance(error, edit_mesh.NothingVisibleError) else []
                continue
            for notice in suggestion.mesh.notices.take():
                self.notices.add(*notice)
            self._found.append(suggestion)
        for problem in hidden if self._found else ():
            self.notices.add("WARNING", problem)

    def __iter__(self) -> Iterator[Suggestion]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    @property
    def are_alive(self) -> bool:
        return all(suggestion.mesh.alive() for suggestion in self)

    def count(self, choice: PartChoice, progress: Progress) -> int:
        return sum(suggestion.count(choice, share) for suggestion, share in self._shares(progress))

    def choose(self, choice: PartChoice, progress: Progress = lambda _: True) -> None:
        for suggestion, share in self._shares(progress):
            suggestion.choose(choice, share)

    def limit(self, stretch: float, islands: int) -> None:
        """Let the next plans have another mean stretch, in percent, and number of islands. `choose` drops the plans before."""
        self._options = replace(self._options, stretch=stretch, islands=islands)

    def used(self) -> SquareUse | None:
        """Return how the maps that `layout_of` found last use the UV square, packed as unwrapping packs them. Any thread may call it.

        It is None if a map is missing, or if unwrapping leaves islands in place.
        """
        laid_out = [suggestion.laid_out[1:3] for suggestion in self]
        if not self._is_first or any(uvs is None for uvs, _ in laid_out):
            return None
        starts = np.cumsum([0, *(int(islands.max(initial=-1)) + 1 for _, islands in laid_out)])
        labels = [islands + start for (_, islands), start in zip(laid_out, starts, strict=False)]
        all_uvs, all_labels = np.concatenate([uvs for uvs, _ in laid_out]), np.concatenate(labels)
        placements = np.asarray(native.load().pack_islands(all_uvs, all_labels, margin=MARGIN).placements)[all_labels]
        packed = np.einsum("tij,tcj->tci", placements[..., :2], all_uvs) + placements[:, None, :, 2]
        ends = np.cumsum([len(own) for own in labels])[:-1]
        maps = []
        for suggestion, (_, islands), own in zip(self, laid_out, np.split(packed, ends), strict=True):
            arrays, scene = suggestion.mesh.arrays, (suggestion.name, suggestion.to_scene)
            maps.append(MappedSurface(arrays.in_object, arrays.triangles, islands, own, arrays.edges, *scene))
        return square_use(maps)

    @property
    def _is_first(self) -> bool:
        return not any(suggestion.had_seams or suggestion.others for suggestion in self)

    @property
    def part_count(self) -> int:
        return sum(suggestion.part_count for suggestion in self)

    @property
    def automatic(self) -> set[PartsBy]:
        return set(filter(None, (suggestion.automatic for suggestion in self)))

    def plan(self, progress: Progress, is_enough: Callable[[], bool] = lambda: False) -> None:
        """Plan wires in the chosen parts of all meshes, until it `is_enough`, but wait for the first plan of each mesh."""
        energy = seam_plan.energy_of(0.01 * self._options.stretch)
        for suggestion, share in self._shares(progress):
            suggestion.plan(energy, self._options.islands, share, is_enough)

    def _shares(self, progress: Progress) -> Iterator[tuple[Suggestion, Progress]]:
        for number, suggestion in enumerate(self):
            yield suggestion, lambda done, number=number: progress((number + done) / len(self))

    def refresh(self) -> None:
        """Read the meshes again. Wires and seams that were added stay. Raises ValueError if a mesh has another shape now."""
        if not all(suggestion.mesh.refresh(suggestion.mesh.obj) for suggestion in self):
            raise ValueError("The mesh changed during the search")

    @property
    def has_wires(self) -> bool:
        return any(suggestion.wires for suggestion in self)

    @property
    def crumb(self) -> float:
        crumbs = (suggestion.crumb() for suggestion in self if suggestion.along == "SURFACE" and suggestion.slits)
        return min(crumbs, default=0.0)

    @property
    def to_cut(self) -> dict[ObjectSession, list[Wire]]:
        return {suggestion.mesh: suggestion.slits for suggestion in self if suggestion.cuts}

    def write(self, before_cuts: bool) -> None:
        """Keep wires with the meshes: the borders of meshes that are to be cut, or everything with the other meshes."""
        for suggestion in self:
            if suggestion.cuts == before_cuts:
                suggestion.write()

    def unwrap(self, context: bpy.types.Context) -> int:
        """Unwrap if wanted, otherwise follow Blender's Live Unwrap. Return the number of unwrapped islands.

        If the meshes had no seams, all UVs are replaced, so that the new islands fill the UV square. Raises as `unwrap_changed`.
        """
        if not self._options.unwraps:
            edit_mesh.live_unwrap(context)
            return 0
        starts = {suggestion.mesh.obj: uvs for suggestion in self if (uvs := suggestion.map()) is not None}
        is_whole = {suggestion.mesh.obj for suggestion in self} >= set(context.objects_in_mode_unique_data)
        every = self._is_first and is_whole and self.has_wires
        layout = Layout(straight_cost=min(suggestion.straight_cost for suggestion in self))
        self._unwrapped = unwrap_changed(context, every=every, starts=starts, layout=layout)
        return self._unwrapped.islands

    def outcome(self) -> Outcome:
        """Measure the islands, and the UV maps that the meshes have. If nothing was to be unwrapped, the planned maps count."""
        options, done = self._options, self._unwrapped
        counts = [count_islands(suggestion.mesh.obj) for suggestion in self]
        is_few = any(own - suggestion.others < options.islands for own, suggestion in zip(counts, self, strict=True))
        # The energy of each map, with the area of its surface, and how the maps in the meshes use the UV square. Without a new unwrapping,
        # the maps on the meshes are those from before.
        maps, used = [], None
        if not options.unwraps:
            maps = [(float(suggestion.best.energy), suggestion.area) for suggestion in self]
        elif done is not None:
            surfaces = maps_of(each.mesh.obj for each in self)
            maps = [(found.energy(aspect(obj)), found.area) for obj, found in surfaces.items()]
            used = square_use([*surfaces.values()]) if surfaces else None
        return Outcome(
            wires=sum(len(suggestion.wires) for suggestion in self),
            marked=sum(suggestion.marked for suggestion in self),
            islands=sum(counts),
            exposed=sum(suggestion.best.exposed_wires for suggestion in self if suggestion.best is not None),
            islands_wanted=options.islands if is_few else 0,
            stretch=100.0 * seam_plan.mean_stretch(*zip(*maps, strict=True)) if maps else None,
            stretches=[100.0 * seam_plan.stretch_of(energy) for energy, _ in maps],
            stretch_wanted=options.stretch,
            used=used,
            unwrapped=None if done is None else done.islands,
            faults=NO_FAULTS if done is None else done.faults,
        )
