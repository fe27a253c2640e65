# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of one object in edit mode, and the wires between and within them, as the library finds and plans them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from mathutils import Vector

from ..core.base import native
from ..core.base.geometry import triangle_areas
from ..core.network.picks import undirected
from ..core.seams.parts import PartEdits, border_wires, edges_of
from ..core.seams.suggestion import (
    CRUMB,
    curves_length,
    cut_edges,
    keep_out,
    planned_wires,
    stroke_weights,
)
from ..core.solver.defaults import CLAMP_PERCENTILE, STRENGTHS
from .object_session import ObjectSession, mirror_axes
from .seam_islands import labels_of
from .unwrap import STRAIGHT_COST, UP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    import bpy
    import seamwire_core
    from numpy.typing import NDArray

    from ..core.network.picks import Along, Finish
    from ..core.network.wires import Wire
    from ..core.seams.suggestion import Request


_MEASURING = 0.1
"""The fraction of planning until the costs of wires are known."""


@dataclass(frozen=True)
class Options:
    """How wires are planned.

    Parameters
    ----------
    along
        How the wires run; None: as is best for the mesh.
    finish
        What becomes the seam of wires across the surface; None: as is best for the mesh.
    symmetric
        Whether wires come in pairs where the mesh is symmetric.
    front
        (3,) the direction towards the viewer in the scene's coordinates: seams are hidden from there. None: from everywhere alike.
    """

    along: Along | None = None
    finish: Finish | None = None
    symmetric: bool = True
    front: Sequence[float] | None = None


class Suggestion:
    """Wires for one object: parts are found, wires planned in them, and all wires written to the mesh.

    The mesh is planned in object coordinates, without the object's scale, as UV maps are measured.

    Parameters
    ----------
    obj
        In edit mode.
    options
        How wires are planned.
    faces
        Only the islands that have some of these faces are cut; None: all islands.

    Attributes
    ----------
    borders
        The chosen borders between parts: chains of vertices. A closed chain ends with its first vertex.
    part_count
        The number of parts, those that are not to be cut included.
    best
        The plan to carry out; None: nothing was planned yet.
    slits
        The wires of this plan.
    straight_cost
        How much a straight layout may add to an island's symmetric Dirichlet energy, so that the plan stays within its limit.
    layout
        (m, 3, 2) the map of this plan as unwrapping lays it out, in the object's units; None: not known yet.
    marked
        The number of edges that `write` made seams.
    others
        The number of islands that are not to be cut.
    had_seams
        Whether the mesh had seams before.

    Raises
    ------
    ValueError, native.NativeError
        If no edge is visible, none of the faces is, or the compiled part is missing.
    """

    def __init__(self, obj: bpy.types.Object, options: Options, faces: NDArray[np.integer] | None = None) -> None:
        self._core = native.load()
        self.mesh = ObjectSession(obj)
        arrays = self.mesh.arrays
        self.along: Along = options.along or self.mesh.auto.along
        self.finish: Finish = options.finish or self.mesh.auto.finish
        self._symmetric = options.symmetric
        self._front = None if options.front is None else in_object(obj, options.front)
        self._within, self.others = self._islands_with(faces)
        self._finder: seamwire_core.PartFinder | None = None
        self._last: tuple[float, PartEdits, seamwire_core.Parts] | None = None
        self._chosen: tuple[float, PartEdits, seamwire_core.Parts] | None = None
        self._planner: seamwire_core.SeamPlanner | None = None
        self._blenders_mirrors = mirror_axes(obj.data)
        self.had_seams = len(arrays.seams) > 0
        self.borders: list[NDArray[np.int32]] = []
        self.part_count = 0
        self.best: seamwire_core.SeamPlan | None = None
        self.straight_cost = STRAIGHT_COST
        self.layout: NDArray[np.float64] | None = None
        self.slits: list[Wire] = []
        self.marked = 0

    def _islands_with(self, faces: NDArray[np.integer] | None) -> tuple[NDArray[np.bool_] | None, int]:
        """Return which triangles are of the islands that have some of these faces, (m,), and the number of other islands."""
        if faces is None:
            return None, 0
        arrays = self.mesh.arrays
        labels = labels_of(arrays)
        planned = np.unique(labels[np.isin(arrays.polygons, faces)])
        if not len(planned):
            raise ValueError("No face is selected")
        return np.isin(labels, planned), int(labels.max()) + 1 - len(planned)

    def measure(self, progress: Callable[[float], bool]) -> None:
        """Measure the mesh for parts; any thread may.

        Parameters
        ----------
        progress
            Is told the fraction done; where it returns False, `seamwire_core.Cancelled` is raised.
        """
        arrays = self.mesh.arrays
        self._surface = self._core.Surface(arrays.in_object, arrays.triangles, arrays.edges)
        self._axis = self._mirror()
        self._finder = self._core.PartFinder(
            self._surface, mirror=self._axis, marked=arrays.marked, seams=arrays.seams, progress=progress
        )

    def count(self, amount: float, edits: PartEdits, progress: Callable[[float], bool]) -> int:
        """Return the number of parts for an amount from 0 to 1; any thread may. `progress` is that of `measure`."""
        return self._counted(self._found(amount, edits, progress))

    def choose(self, amount: float, edits: PartEdits, progress: Callable[[float], bool]) -> None:
        """Find the parts for an amount from 0 to 1, and choose them. A plan for other parts is dropped.

        Parts that were counted last, or that are chosen already, are not searched again. `progress` is that of `measure`.
        """
        found = self._found(amount, edits, progress)
        self._chosen = amount, edits, found
        self.part_count = self._counted(found)
        self.borders = [np.asarray(chain) for chain in found.borders]
        if self._within is not None:
            self._keep_within()
        self._planner = self.best = self.layout = None
        self.slits = []

    def _found(self, amount: float, edits: PartEdits, progress: Callable[[float], bool]) -> seamwire_core.Parts:
        """Find parts. The last ones are kept, because parts are counted before they are chosen."""
        assert self._finder is not None
        for known in (self._chosen, self._last):
            if known is not None and known[:2] == (amount, edits):
                return known[2]
        arrays = self.mesh.arrays
        found = self._finder.find(amount, **edits.on(arrays.edges, arrays.polygons), progress=progress)
        self._last = amount, edits, found
        return found

    def _counted(self, parts: seamwire_core.Parts) -> int:
        """Return the number of parts. An island that is not to be cut is one part."""
        if self._within is None:
            return parts.count
        return len(np.unique(parts.of_face[self._within])) + self.others

    def _keep_within(self) -> None:
        """Drop the borders in islands that are not to be cut."""
        corners = self.mesh.arrays.triangles[self._within].tolist()
        inside = {undirected(side) for a, b, c in corners for side in ((a, b), (b, c), (c, a))}
        self.borders = [chain for chain in self.borders if edges_of(chain) <= inside]

    def _new_planner(self, progress: Callable[[float], bool]) -> seamwire_core.SeamPlanner:
        """Measure what wires in the chosen parts cost. `progress` is that of `measure`."""
        return self._core.SeamPlanner(
            self._surface,
            along=self.along.lower(),
            max_anisotropy=STRENGTHS[self.along],
            clamp_percentile=CLAMP_PERCENTILE,
            front=self._front,
            mirror=self._axis,
            weights=self._weights(),
            seams=self.seams,
            progress=progress,
        )

    @property
    def seams(self) -> NDArray[np.int32]:
        """The edges, (k, 2), that are seams, or borders between the chosen parts."""
        chains = [np.stack([chain[:-1], chain[1:]], axis=1) for chain in self.borders]
        return np.concatenate([self.mesh.arrays.seams, *chains]).astype(np.int32)

    def _mirror(self) -> int | None:
        """Return the axis over which wires come in pairs: one of those that Blender mirrors over, if there are any."""
        if not self._symmetric:
            return None
        symmetric = self.mesh.session.drawing.symmetry.symmetric_axes
        preferred = [axis for axis in self._blenders_mirrors if axis in symmetric]
        axis = next(iter((*preferred, *symmetric)), None)
        if axis is None or self._within is None:
            return axis
        # Planned islands that are not symmetric themselves have no pairs.
        images = self.mesh.session.drawing.symmetry.partners((axis,))
        planned = np.zeros(len(images), dtype=bool)
        planned[self.mesh.arrays.triangles[self._within]] = True
        has_image = images[planned] >= 0
        return axis if has_image.all() and planned[images[planned]].all() else None

    def _weights(self) -> NDArray[np.float64] | None:
        """Return what the cost of wires is multiplied with at each vertex; None: by nothing."""
        arrays, strokes = self.mesh.arrays, self.mesh.session.strokes
        weights = None
        if self._within is not None:
            weights = keep_out(arrays.triangles, self._within, len(arrays.points))
        if strokes:
            by_strokes = stroke_weights(arrays.points, arrays.edges, strokes)
            weights = by_strokes if weights is None else weights * by_strokes
        return weights

    def plan(
        self, request: Request, progress: Callable[[float], bool], is_enough: Callable[[], bool] = lambda: False
    ) -> None:
        """Find wires in the chosen parts, better and better ones; any thread may.

        Parameters
        ----------
        request
            Requirements for the plan.
        progress
            As that of `measure`.
        is_enough
            Whether to stop, and go on with the best plan so far; the first one is waited for.
        """
        # Other parts may be chosen meanwhile, which drops the planner.
        planner = self._new_planner(lambda done: progress(_MEASURING * done))
        self._planner = planner

        def go_on(done: float) -> bool:
            is_found = self._useful(planner.best_so_far) is not None
            return progress(_MEASURING + (1.0 - _MEASURING) * done) and not (is_enough() and is_found)

        try:
            found = planner.plan(distortion=request.distortion, islands=request.islands + self.others, progress=go_on)
        except self._core.Cancelled:
            found = self._useful(planner.best_so_far)
            if found is None or not is_enough():
                raise
        if self._planner is not planner:
            return  # the plan is for other parts
        from_object = np.linalg.inv(self.mesh.arrays.to_object)
        self.straight_cost = min(STRAIGHT_COST, max(0.0, request.distortion - found.energy))
        self.best, self.slits = found, planned_wires(found, self.along, STRENGTHS[self.along], from_object)

    def lay_out(self, progress: Callable[[float], bool]) -> None:
        """Find how the islands of the plan will lie in the UV map; any thread may. `progress` is that of `measure`."""
        planner, plan, arrays = self._planner, self.best, self.mesh.arrays
        if plan is None or plan.uvs is None:
            return
        try:
            found = self._core.flatten(
                arrays.in_object,
                arrays.triangles,
                self.edges_of(plan),
                start=plan.uvs,
                keep_apart=False,
                straighten=self.straight_cost,
                up=UP,
                edges=arrays.edges,
                progress=progress,
            ).uvs
        except ValueError:
            found = plan.uvs  # unwrapping may open islands further
        if self._planner is planner:
            self.layout = np.asarray(found)

    @property
    def best_so_far(self) -> seamwire_core.SeamPlan | None:
        """The best plan so far with a map of every part of the mesh, also while `plan` runs. Any thread may read it."""
        planner = self._planner
        return None if planner is None else self._useful(planner.best_so_far)

    def _useful(self, plan: seamwire_core.SeamPlan | None) -> seamwire_core.SeamPlan | None:
        """Return a plan if it has seams and a map of every part of the mesh, otherwise None."""
        if plan is None or not np.isfinite(plan.energy):
            return None
        return plan if plan.wires or self.borders else None

    @property
    def wires(self) -> list[Wire]:
        """The borders between the chosen parts, and the wires in them, as wires."""
        return [*self.border_wires, *self.slits]

    @property
    def border_wires(self) -> list[Wire]:
        """The borders between the chosen parts as wires."""
        return border_wires(self.borders, self.mesh.arrays.points)

    def map(self) -> NDArray[np.float64] | None:
        """Return the map of the plan, (m, 3, 2), in the object's units; None if it has none, or the mesh is another one with the wires."""
        is_same = not self.slits or self.along == "EDGES" or self.finish == "SNAP"
        return self.best.uvs if is_same and self.best is not None else None

    def length_of(self, plan: seamwire_core.SeamPlan) -> float:
        """Return the length of the borders and the wires of a plan, in the scene's units."""
        points = self.mesh.arrays.in_object
        curves = [*(points[chain] for chain in self.borders), *(wire.points for wire in plan.wires)]
        return curves_length(curves, np.array(self.mesh.obj.matrix_world.to_3x3(), dtype=np.float64))

    def edges_of(self, plan: seamwire_core.SeamPlan) -> NDArray[np.int32]:
        """Return the edges, (k, 2), that cut the mesh into the islands of a plan."""
        return cut_edges(plan, self.seams)

    @cached_property
    def area(self) -> float:
        """The area of the visible surface, in the object's units squared."""
        return float(self._areas().sum())

    def _areas(self) -> NDArray[np.float64]:
        return triangle_areas(self.mesh.arrays.in_object, self.mesh.arrays.triangles)

    def smallest(self) -> float:
        """Return the least part of the mesh's area that an island has: of those planned, or of those that may be."""
        assert self.best is not None
        areas = np.bincount(self.best.islands, self._areas())
        areas = areas[areas > 0.0]
        return min(CRUMB, float(areas.min() / areas.sum())) if len(areas) else CRUMB

    def write(self, wires: Iterable[Wire]) -> None:
        """Keep wires with the mesh."""
        self.mesh.add(wires)
        marked, _ = self.mesh.write(self.mesh.plan())
        self.marked += marked


def in_object(obj: bpy.types.Object, direction: Sequence[float]) -> tuple[float, float, float] | None:
    """Return a direction in the scene's coordinates as one of length 1 in object coordinates; None if the object is flattened."""
    try:
        found = obj.matrix_world.to_3x3().inverted() @ Vector(direction)
    except ValueError:
        return None
    return tuple(found.normalized()) if found.length > 0.0 else None
