# SPDX-License-Identifier: GPL-3.0-or-later
"""One object in edit mode that is drawn on: its edit mesh, its session, and the network that stays with its mesh."""

from __future__ import annotations

import functools
import threading
import traceback
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ..core.drawing.session import Session
from ..core.network.network import FacePoint, edges_after, vertices_of
from ..core.network.strokes import on_mesh
from ..core.offers.closed_cuts import CutMemory
from ..core.seams.cut import NEAR, CutError
from ..core.seams.seam_wires import wires_between
from ..core.seams.slide import plan as plan_slide
from ..core.seams.suggestion import best_finish
from ..core.solver.live_maker import LiveMaker
from ..core.storage import serialization, wire_labels
from ..core.storage.network_file import NetworkFile
from ..core.storage.serialization import Archive, UnreadableError
from ..core.storage.wire_labels import EdgeLabels, Found, Places
from . import cut, edit_mesh, slide

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from ..core.network.network import Along, Edge, Finish, Network, Pick, Wire
    from ..core.network.strokes import Stroke
    from ..core.offers.closed_cuts import TakenCut
    from ..core.seams.cut import CutPlan
    from .settings import SeamwireSettings

FIRST_VERSION = "seamwire"
"""The mesh's custom property that held the network in the first version."""
_MOMENT = 0.1
"""Seconds for which the interface may wait."""

_archive = Archive()
"""All records that this Blender has seen: undo brings back labels whose records no mesh holds any more."""
_taken_cuts = CutMemory()
"""All closed cuts that were taken in this Blender, to be bent after they were cut."""


def mirror_axes(mesh: bpy.types.Mesh) -> tuple[int, ...]:
    """Return the axes over which Blender mirrors what is done to a mesh."""
    return tuple(axis for axis, name in enumerate("xyz") if getattr(mesh, f"use_mirror_{name}"))


@dataclass(frozen=True)
class Finished:
    """What became of wires across the surface when their chain ended.

    Parameters
    ----------
    slid, moved
        How many wires were slid onto, and how many vertices were.
    cut, edges, uncut
        How many wires were cut into the faces, how many edges they run along, and how many faces could not be cut.
    left_out
        How many wires and mirror images were not cut, because they do not run over the mesh.
    problem
        Why nothing was cut.
    taken_back
        How many edges of former cuts went, where nothing was cut in their place.
    """

    slid: int = 0
    moved: int = 0
    cut: int = 0
    edges: int = 0
    uncut: int = 0
    left_out: int = 0
    problem: str = ""
    taken_back: int = 0

    def __bool__(self) -> bool:
        return self != Finished()


class ObjectSession:
    """One object that is drawn on.

    Parameters
    ----------
    obj
        A mesh object in edit mode; in another mode it can be read, and not drawn on.
    along
        How wires run at first.

    Attributes
    ----------
    problem
        What there is to say of the wires that came with the mesh, once.
    generation
        Grows whenever the edit mesh was read anew.
    symmetric
        The axes over which the mesh is symmetric; None while that is not known.
    symmetry_problem
        Why that could not be found out.

    Raises
    ------
    ValueError
        Where there is nothing to draw on.
    """

    def __init__(self, obj: bpy.types.Object, along: Along = "EDGES") -> None:
        self.obj = obj
        self.cage: edit_mesh.Cage | edit_mesh.StoredMesh
        self.cage = edit_mesh.Cage(obj) if obj.mode == "EDIT" else edit_mesh.StoredMesh(obj.data)
        self.arrays = edit_mesh.read(obj)
        self.make_live = LiveMaker(self.arrays)
        self.session = Session(
            self.make_live,
            self.arrays.points,
            along,
            edges=self.arrays.edges,
            to_object=self.arrays.to_object,
            triangles=self.arrays.triangles,
            topology=obj.data.use_mirror_topology,
        )
        self.problem = ""
        self.generation = 0
        self.plain_seams: NDArray[np.int32] = self.arrays.seams
        self.symmetric: tuple[int, ...] | None = None
        self.symmetry_problem = ""
        self._looking: threading.Thread | None = None
        self._labels = EdgeLabels.none()
        self._found = Found()
        self._newer = False
        self._damaged = False
        self._renumbered = False
        self._unstored = False
        self._adopt(self.cage.labels())
        self.follow_mirror()

    # Symmetry

    def look_for_symmetry(self) -> None:
        """Begin to find out over which axes the mesh is symmetric."""
        if self._looking is None:
            # A daemon: Blender must not wait for it to quit.
            self._looking = threading.Thread(target=self._look_for_symmetry, name="seamwire symmetry", daemon=True)
            self._looking.start()

    def _look_for_symmetry(self) -> None:
        try:
            self.symmetric = self.session.symmetric_axes
        except Exception as error:
            traceback.print_exc()
            self.symmetry_problem = f"The mesh could not be checked for symmetry: {error}"
            self.symmetric = ()

    def symmetric_soon(self) -> tuple[int, ...] | None:
        """Return the axes over which the mesh is symmetric; None where that takes longer than a moment to find out."""
        self.look_for_symmetry()
        if self._looking is not None:
            self._looking.join(_MOMENT)
        return self.symmetric

    @property
    def busy(self) -> bool:
        """Whether something is being computed."""
        looking = self._looking is not None and self._looking.is_alive()
        return self.session.computing or self.session.waiting_clicks > 0 or looking or self._unstored

    def follow_mirror(self) -> None:
        """Take over the mesh's own mirror."""
        self.session.set_mirror(mirror_axes(self.cage.mesh))

    # Settings

    def follow(self, settings: SeamwireSettings) -> None:
        """Take over the tool's settings."""
        session = self.session
        session.switch(settings.along)
        session.finish = self.finish(settings)
        session.set_straight(settings.straight)
        session.set_metric(settings.metric)
        session.set_clamp(settings.clamp)
        session.set_strength("EDGES", settings.strength_edges)
        session.set_strength("SURFACE", settings.strength_surface)
        if session.marking == settings.clear:
            session.toggle_marking()

    def finish(self, settings: SeamwireSettings) -> Finish:
        """Return what becomes the seam of wires across the surface here."""
        return self._best_finish if settings.finish == "AUTO" else settings.finish

    @functools.cached_property
    def _best_finish(self) -> Finish:
        return best_finish(self.arrays.polygons)

    def tell(self, settings: SeamwireSettings) -> None:
        """Write back what keys changed."""
        session = self.session
        for name, value in (("along", session.along), ("metric", session.metric), ("clear", not session.marking)):
            if getattr(settings, name) != value:
                setattr(settings, name, value)
        name = "strength_edges" if session.along == "EDGES" else "strength_surface"
        if abs(getattr(settings, name) - session.strength) > 1e-4 * session.strength:
            setattr(settings, name, session.strength)

    # The network and the mesh

    @property
    def places(self) -> Places:
        """Where the vertices are."""
        return Places(self.arrays.points, self.arrays.to_object)

    def alive(self) -> bool:
        """Whether the edit mesh that was read is still there, with as many vertices, edges and faces."""
        try:
            return self.obj.mode == "EDIT" and self.obj.data == self.cage.mesh and self.cage.intact()
        except ReferenceError:
            return False

    def refresh(self, obj: bpy.types.Object) -> bool:
        """Take over what the object's mesh holds now; return False where wires would run on it in another way.

        Raises
        ------
        ValueError
            Where there is nothing to draw on.
        """
        arrays = edit_mesh.read(obj)
        if obj.mode != "EDIT" or not arrays.same_as(self.arrays):
            return False
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        self._renumbered = False
        labels = self.cage.labels()
        same = labels.same_as(self._labels) and np.array_equal(arrays.seams, self.arrays.seams)
        self.arrays = replace(self.arrays, seams=arrays.seams)
        self.generation += 1
        if not same:
            self._adopt(labels)
        elif self._found.known:
            self._store()
        self.follow_mirror()
        return True

    def follow_change(self, obj: bpy.types.Object) -> bool:
        """While wires are drawn, go on with what the object's mesh holds now, and with the wires as they were.

        Returns
        -------
        bool
            False where wires would run on it in another way, or it has left edit mode: then they can be written still, as far
            as vertices have the numbers that they had.
        """
        self.obj = obj
        editing = obj.mode == "EDIT"
        self.cage = edit_mesh.Cage(obj) if editing else edit_mesh.StoredMesh(obj.data)
        self._renumbered = self.cage.vertex_count != len(self.arrays.points)
        self._labels = self.cage.labels()
        if not editing or self._renumbered:
            return False
        try:
            arrays = edit_mesh.read(obj)
        except ValueError:
            return False
        if not arrays.same_as(self.arrays):
            return False
        self.generation += 1
        self._set_seams(arrays.seams, self._labels)
        return True

    def _adopt(self, labels: EdgeLabels) -> None:
        """Go on with the network that labels tell of."""
        self._learn(labels)
        self._labels = labels
        self._found = Found() if self._newer else wire_labels.read(labels, _archive, self.places)
        network = self._found.network
        stored = self.cage.mesh.get(FIRST_VERSION)
        if isinstance(stored, str) and not len(labels.labels):
            network, self.problem = serialization.load_first_version(
                stored, self.arrays.points, self.arrays.edges, self.arrays.seams
            )
        strokes = tuple(on_mesh(one, self.arrays.points, self.arrays.triangles) for one in network.strokes)
        self._set_seams(self.arrays.seams, labels)
        self.session.adopt(replace(network, strokes=strokes), self.plain_seams)
        if network is not self._found.network:
            # It did not tell which edges were seams before: those of its wires are taken for theirs.
            self._found = Found(self.session.network)
        if not self._damaged:
            self._store()
        self.session.recall_cuts(_taken_cuts.recall(self.session.network, self.places))

    def _set_seams(self, seams: NDArray[np.int32], labels: EdgeLabels) -> None:
        self.arrays = replace(self.arrays, seams=seams)
        self.plain_seams = wire_labels.seams_beside(seams, labels, _archive, self._found.known)

    def _learn(self, labels: EdgeLabels) -> None:
        """Take in the records of the mesh and, where labels came from another one, those of all meshes in the file."""
        self._newer = self._damaged = False
        try:
            _archive.merge(Archive.parse(self.cage.mesh.seamwire_wires))
        except serialization.NewerError as error:
            self._newer, self.problem = True, str(error)
            return
        except UnreadableError as error:
            self._damaged, self.problem = True, str(error)
        if all(_archive.knows(label) for label in np.unique(labels.labels).tolist()):
            return
        for mesh in bpy.data.meshes:
            try:
                _archive.merge(Archive.parse(mesh.seamwire_wires))
            except UnreadableError:
                continue

    def _store(self) -> None:
        """Let the mesh hold the records that its labels call."""
        if self._newer:
            return
        text = _archive.text(np.unique(self._labels.labels).tolist())
        mesh = self.cage.mesh
        self._unstored = False
        try:
            if mesh.seamwire_wires != text:
                mesh.seamwire_wires = text
            if text and FIRST_VERSION in mesh:
                del mesh[FIRST_VERSION]
        except AttributeError:
            # While Blender asks what is under the mouse nothing may be written; after undo the records may be others by then.
            self._unstored = True

    def poll(self) -> None:
        """Let the mesh hold what could not be written yet."""
        if self._unstored and self.alive():
            self._store()

    def plan(self) -> wire_labels.Plan:
        """Return what the mesh's edges must be for the session's network."""
        return wire_labels.plan(
            self.session.kept,
            self._labels,
            self._found,
            _archive,
            self.places,
            self.cage.is_seam,
            self.arrays.edges,
        )

    def write(self, plan: wire_labels.Plan, adopt: bool = True) -> tuple[int, int]:
        """Mark and clear seams, and let the mesh keep the network.

        Parameters
        ----------
        plan
            From `plan`.
        adopt
            Whether the drawing ends with that: what was done before is Blender's to undo then.

        Returns
        -------
        tuple of int
            How many edges became seams, and how many ceased to be.

        Raises
        ------
        ValueError
            Where an edge is not there any more; then nothing is changed.
        """
        if self._renumbered:
            raise ValueError("The mesh has other vertices now")
        labels = {} if self._newer else plan.labels
        written = self.cage.write(plan.mark, plan.clear, labels)
        # Any other edge has no label, as before.
        self._labels = self.cage.labels((*map(tuple, self._labels.pairs.tolist()), *labels))
        self._found = Found(plan.network, plan.known)
        seams = edges_after(self.arrays.seams, plan.mark, plan.clear)
        self._set_seams(seams, self._labels)
        self._store()
        if adopt:
            self.session.adopt(replace(plan.network, seed=None), self.plain_seams)
            _taken_cuts.keep(self.session.taken_cuts, self.session.network, self.places)
        return written

    def add(self, wires: Iterable[Wire], strokes: Iterable[Stroke] = ()) -> None:
        """Go on with more wires and strokes, found elsewhere; `write` marks their edges."""
        session = self.session
        drawn = (*session.wires, *wires)
        strokes = (*session.strokes, *(on_mesh(one, self.arrays.points, self.arrays.triangles) for one in strokes))
        session.adopt(replace(session.network, wires=drawn, strokes=strokes, seed=None), self.plain_seams)

    def network_file(self, settings: SeamwireSettings, more: Iterable[Wire] = ()) -> NetworkFile:
        """Return the network, and more wires, as they are saved to a file."""
        arrays = self.arrays
        return NetworkFile.of(
            replace(self.session.kept, wires=(*self.session.wires, *more)),
            arrays.points,
            arrays.triangles,
            arrays.edges,
            name=self.cage.mesh.name,
            metric=settings.metric,
            clamp=settings.clamp,
            to_object=arrays.to_object,
        )

    def take_over(self, wires: Iterable[Wire]) -> None:
        """Go on with wires along seams of the mesh: `write` makes these edges theirs, so that they go where the wires go."""
        session = self.session
        network = replace(session.network, wires=(*session.wires, *wires), seed=None)
        taken = {edge for wire in network.wires for edge in wire.edges()}
        rest = [pair for pair in self.plain_seams.tolist() if (min(pair), max(pair)) not in taken]
        self.plain_seams = np.array(rest, dtype=np.int32).reshape(-1, 2)
        session.adopt(network, self.plain_seams)
        self._found = replace(self._found, network=session.network)

    def finder(self, faces: Collection[int] = ()) -> Callable[[Sequence[float]], FacePoint]:
        """Return what finds the point of the visible surface, or of some faces, that is nearest to a place in object coordinates.

        The function raises ValueError if no face is visible, or the place is too far away to be compared with them.
        """
        triangles, in_object = self.arrays.triangles, self.arrays.in_object
        rows = np.arange(len(triangles))
        if len(faces):
            rows = rows[np.isin(self.arrays.polygons, list(faces))]

        @functools.cache
        def tree() -> BVHTree:
            used, corners = np.unique(triangles[rows], return_inverse=True)
            polygons = corners.reshape(-1, 3).tolist()
            return BVHTree.FromPolygons(in_object[used].tolist(), polygons, all_triangles=True)

        def find(place: Sequence[float]) -> FacePoint:
            if not len(rows):
                raise ValueError("No face is visible: give vertices or edges instead of places")
            found, _, row, _ = tree().find_nearest(place)
            if found is None:
                raise ValueError(f"The place ({' '.join(f'{x:g}' for x in place)}) is too far from the mesh")
            return FacePoint.at(np.array(found), rows[row], triangles, in_object)

        return find

    def plan_cut(self, wires: Iterable[Wire]) -> CutPlan:
        """Find what wires across the surface and their mirror images cut, and try it on a copy of the edit mesh.

        The plan leaves out wires that do not run over the mesh, by their numbers here, and mirror images, by higher numbers.

        Raises
        ------
        CutError
            If no wire runs over the mesh, or nothing is cut.
        """
        wires = list(wires)
        images = [
            (number, image) for number, wire in enumerate(wires) for image in self.session.mirrored(wire, curves=True)
        ]
        curves = [
            (_spot(own.start, own.vertices[0]), own.points, _spot(own.end, own.vertices[-1]))
            for own in (*wires, *(image for _, image in images))
        ]
        originals = {len(wires) + row: number for row, (number, _) in enumerate(images)}
        plan = cut.plan(self.cage, self.arrays, curves, originals)
        if not plan.segments():
            raise CutError("No wire leaves the face that it begins in")
        cut.rehearse(self.cage, plan)
        return plan

    def cut(
        self,
        plan: CutPlan,
        wires: Collection[Wire],
        kept: bool = False,
        before: Network | None = None,
        taken: Collection[TakenCut] | None = None,
        crumb: float = 0.0,
    ) -> cut.Cut:
        """Cut the mesh; what was cut are wires along its edges then, between the seeds of those across the surface.

        Vertices, edges and faces have other numbers then: this session is over.

        Parameters
        ----------
        plan
            From `plan_cut`.
        wires
            The same as for `plan_cut`. Wires that are not cut stay wires across the surface.
        kept
            Whether the mesh has these wires already: their snapped edges cease to be seams.
        before
            A network that the mesh had: what wires of it were cut along that are there no more is taken back first.
        taken
            The closed cuts that are among these wires; None: those of the session.
        crumb
            The part of the mesh's area below which an island beside the cuts becomes part of a larger one.

        Raises
        ------
        CutError
            If no wire can be cut once former cuts were taken back. These cuts are gone then, and the wires are snapped to edges.
        """
        taken = self.session.taken_cuts if taken is None else taken
        skipped = sum(number < len(wires) for number in plan.left_out)
        wires = [wire for number, wire in enumerate(wires) if number not in plan.left_out]
        images = [replace(image, mirror=()) for wire in wires for image in self.session.mirrored(wire, curves=True)]
        if kept:
            for wire in wires:
                self.session.drop(wire)
            self.write(self.plan())
        left = [] if before is None else self._left_cuts(before)
        if left:
            # Those of images as well: there is no chain of edges to be mirrored yet.
            both = (*wires, *images)
            places = cut.PickedPlaces(self.cage, {end for wire in both for end in (wire.start, wire.end)})
            cut.take_back(self.cage, left)
            after = ObjectSession(self.obj)
            placed: list[Wire] = []
            try:
                placed = after._placed(both, places)
                again = after.plan_cut(placed)
            except ValueError as error:
                after._draw_again(placed[: len(wires)])
                raise CutError(f"{error}; what was cut before is taken back, undo brings it again") from error
            missing = [placed[number] for number in again.left_out if number < len(wires)]
            after._draw_again(missing)
            done = after.cut(again, placed, taken=taken)
            return replace(done, wires=len(wires) - len(missing), left_out=skipped + done.left_out)
        seeds = {end for wire in wires for end in (wire.start, wire.end)}
        done = cut.carry_out(self.cage, plan, seeds, crumb)
        after = ObjectSession(self.obj)
        claimed = {edge for wire in after.session.wires for edge in wire.claims()}
        after.take_over(after._cut_wires({edge for edge in done.edges if edge not in claimed}, wires, done.seeds))
        after._go_on_with(taken)
        after.write(after.plan())
        return replace(done, wires=len(wires), left_out=len(plan.left_out))

    def _go_on_with(self, taken: Iterable[TakenCut]) -> None:
        """Let closed cuts that were taken before the mesh was changed be bent on it."""
        own = (cut.of(self.session.network) for cut in taken)
        self.session.recall_cuts(cut for cut in own if cut is not None)

    def take_back_cuts(self, before: Network) -> int:
        """Take back what wires of a network before were cut along that are there no more; return how many edges went.

        Where there are any, this session is over.
        """
        left = self._left_cuts(before)
        return cut.take_back(self.cage, left) if left else 0

    def _left_cuts(self, before: Network) -> list[Edge]:
        """Return the edges that wires of a network were cut along, and that are no seams now."""
        own = {edge for wire in before.wires if wire.is_cut for edge in wire.claims()}
        return [edge for edge in sorted(own) if not self.cage.is_seam(edge)]

    def _placed(self, wires: Iterable[Wire], places: cut.PickedPlaces) -> list[Wire]:
        """Return wires across a mesh from which cuts were taken back, the same surface, as wires across this mesh."""

        def seed_at(pick: Pick, place: NDArray[np.float64]) -> int | FacePoint:
            vertex = places.vertex(pick)
            if vertex is not None:
                return vertex
            point = self.finder(places.faces(pick))((self.arrays.to_object @ place).tolist())
            return point.vertex if max(point.weights) > 1.0 - NEAR else point

        placed = []
        for wire in wires:
            start, end = seed_at(wire.start, wire.points[0]), seed_at(wire.end, wire.points[-1])
            vertices = (*vertices_of(start), *vertices_of(end))
            placed.append(wire.changed(vertices=vertices, start=start, end=end, images=()))
        return placed

    def _draw_again(self, wires: Collection[Wire]) -> None:
        """Draw wires across the surface once more between their seeds, snapped to edges, because their former edges may be gone."""
        if not wires:
            return
        session = self.session
        session.switch("SURFACE")
        for wire in wires:
            session.finish = wire.finish
            session.set_mirror(wire.mirror)
            if wire.strength:
                session.set_strength("SURFACE", wire.strength)
            for seed in (wire.start, wire.end):
                session.click(seed)
                session.wait()
            session.end_chain()
        self.write(self.plan())

    def _cut_wires(
        self, edges: set[Edge], wires: Collection[Wire], seeds: Mapping[int | FacePoint, int]
    ) -> Iterator[Wire]:
        """Yield wires along edges that others were cut along, between their seeds; what is the image of one is no other."""
        pairs = np.array(sorted(edges), dtype=np.int32).reshape(-1, 2)
        between = list(wires_between(pairs, set(seeds.values()), self.arrays.points))
        origin = {frozenset((seeds.get(wire.start), seeds.get(wire.end))): wire for wire in wires}
        mirrors = {wire.mirror for wire in wires}
        shared = mirrors.pop() if len(mirrors) == 1 else ()
        between.sort(key=lambda wire: frozenset((wire.start, wire.end)) not in origin)
        left = set(edges)
        for wire in between:
            if left.isdisjoint(wire.edges()):
                continue
            own = origin.get(frozenset((wire.start, wire.end)))
            left.difference_update(wire.edges())
            wire = replace(wire, finish="CUT", mirror=shared, images=())
            if own is not None:
                wire = replace(wire, follow=own.follow, strength=own.strength, mirror=own.mirror)
            images = {edge for image in self.session.mirrored(wire) for edge in image.edges()}
            if left.issuperset(images):
                left.difference_update(images)
                yield replace(wire, images=None)
            else:
                yield replace(wire, mirror=())

    def finish_wires(self, before: Network, changed: Collection[int]) -> Finished:
        """Let the changed wires across the surface be what they are to be, slid or cut, and take back cuts that are wires' no more.

        The mesh has these wires. Where anything was done, this session is over.

        Parameters
        ----------
        before
            The network before the changes.
        changed
            The numbers of the wires that are new since, or have another course.
        """
        wires = [wire for wire in self.session.wires if wire.id in changed and wire.along == "SURFACE" and wire.marks]
        slid = [wire for wire in wires if wire.finish == "SLIDE"]
        to_cut = [wire for wire in wires if wire.finish == "CUT"]
        mesh, moved = self, self.slide(slid) if slid else 0
        if moved:
            mesh, drawn = ObjectSession(self.obj), {wire.vertices for wire in to_cut}
            to_cut = [wire for wire in mesh.session.wires if wire.vertices in drawn]
        finished = Finished(len(slid), moved)
        if to_cut:
            try:
                done = mesh.cut(mesh.plan_cut(to_cut), to_cut, kept=True, before=before)
            except CutError as error:
                return replace(finished, problem=str(error))
            return replace(finished, cut=done.wires, edges=len(done.edges), uncut=done.uncut, left_out=done.left_out)
        return replace(finished, taken_back=mesh.take_back_cuts(before))

    def slide(self, wires: Collection[Wire]) -> int:
        """Slide the vertices of snapped wires, and of their mirror images, onto the wires; return how many were moved.

        The mesh has these wires. Where something was moved, this session is over.
        """
        own = {wire: [wire, *self.session.mirrored(wire)] for wire in wires}
        courses = [(image.vertices, image.points) for images in own.values() for image in images]
        seams = {edge for images in own.values() for image in images for edge in image.edges()}
        stiff = slide.stiff_vertices(self.cage, {vertex for chain, _ in courses for vertex in chain}, seams)
        moves = plan_slide(cut.CageFaces(self.cage, self.arrays), courses, stiff)
        if moves:
            slide.carry_out(self.obj, self.cage, moves)
            # What the mesh keeps of a wire tells where its vertices are: it is written anew, its curve as it was.
            after = ObjectSession(self.obj)
            curve_of = {wire.vertices: wire.points for wire in wires}
            network = after.session.network
            kept = [
                wire.changed(points=curve_of[wire.vertices]) if wire.vertices in curve_of else wire
                for wire in network.wires
            ]
            after.session.adopt(replace(network, wires=tuple(kept)), after.plain_seams)
            after._go_on_with(self.session.taken_cuts)
            after.write(after.plan())
        return len(moves)

    def drop_changes(self, network: Network) -> None:
        """Go back to a network that the session had, whatever was drawn since."""
        self.session.adopt(replace(network, seed=None), self.plain_seams)


def _spot(pick: Pick, vertex: int) -> int | FacePoint:
    """Return where a curve begins or ends: a point in a triangle, or else the vertex that its edges begin or end at."""
    return pick if isinstance(pick, FacePoint) else vertex
