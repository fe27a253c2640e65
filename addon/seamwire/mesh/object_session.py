# SPDX-License-Identifier: GPL-3.0-or-later
"""One object in edit mode that is drawn on: its edit mesh, its session, and the network that stays with its mesh."""

from __future__ import annotations

import threading
import traceback
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.base import native
from ..core.network.drawn import edges_after
from ..core.network.picks import FacePoint
from ..core.network.strokes import on_mesh
from ..core.offers.surface_loops import CutMemory
from ..core.sketch.sketch import Sketch
from ..core.solver.solver import LiveMaker
from ..core.storage import serialization, wire_labels
from ..core.storage.serialization import Archive, Places, UnreadableError
from ..core.storage.wire_labels import EdgeLabels, Found
from ..terms.options import PLACED, SCANNED, Options
from ..words.reports import Notices
from . import edit_mesh
from .settings import mirror_axes, snapshot

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import seamwire_core
    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.network.strokes import Stroke
    from ..core.network.wires import Wire
    from ..core.sketch.change import Change
    from ..terms.options import Auto
    from .settings import SeamwireSettings


def auto_for(obj: bpy.types.Object, arrays: Arrays) -> Auto:
    if len(obj.vertex_groups) or obj.data.shape_keys is not None:
        return PLACED
    is_scan = native.load().has_scanned_edges(arrays.points, arrays.triangles, arrays.polygons)
    return SCANNED if is_scan else PLACED


_MOMENT = 0.1
"""Seconds for which the interface may wait."""

_MOST_RECORDED = 32_000_000
"""Bytes of records, as text, that are kept for undo. Meshes hold the records that they use."""

_archive = Archive()
"""Records that were seen since the file was opened: undo brings back labels whose records no mesh holds any more."""
_taken_cuts = CutMemory()
"""Closed cuts that were taken since the file was opened, to be bent after they were cut."""


def forget_records(*_: object) -> None:
    global _archive
    _archive = Archive()
    _taken_cuts.clear()


def complete_records(*_: object) -> None:
    """Store the missing records of all meshes. Blender's undo restores labels, but not records."""
    if not (_archive.wires or _archive.strokes):
        return
    for obj in bpy.data.objects:
        if obj.type == "MESH" and obj.mode == "EDIT":
            obj.update_from_editmode()  # Blender does so too when it saves
    for data in list(bpy.data.meshes):
        stored = () if data.library is not None else edit_mesh.stored_labels(data)
        labels = [label for label in np.unique(stored).astype(np.int64).tolist() if label]
        try:
            own = Archive.parse(data.seamwire_wires) if labels else Archive()
        except UnreadableError:
            continue
        unknown = [label for label in labels if not own.knows(label)]
        if any(map(_archive.knows, unknown)) and own.merge(_archive):
            data.seamwire_wires = own.text(labels)


class ObjectSession:
    """One mesh object that is drawn on. Outside edit mode it can only be read.

    It begins with `options`; None: the defaults, with the mesh's own mirror. Raises ValueError where there is nothing to draw on.
    """

    def __init__(self, obj: bpy.types.Object, options: Options | None = None) -> None:
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        self.arrays = edit_mesh.read(obj)
        self.make_live = LiveMaker(self.arrays)
        self.session = Sketch(
            self.make_live,
            self.arrays.points,
            options or Options(mirror=mirror_axes(obj.data)),
            edges=self.arrays.edges,
            to_object=self.arrays.to_object,
            triangles=self.arrays.triangles,
            topology=obj.data.use_mirror_topology,
            make_parts=self.make_live.part_finder,
        )
        self.notices = Notices()  # problems with the wires that are stored with the mesh
        self.plain_seams: NDArray[np.int32] = self.arrays.seams
        self.symmetric: tuple[int, ...] | None = None  # the axes of its symmetry; None while they are not known
        self._auto: Auto | None = None
        self._symmetry_error: Exception | None = None
        self._looking: threading.Thread | None = None
        self._archive = _archive
        self._labels = EdgeLabels.none()
        self._found = Found()
        self._newer = False
        self._damaged = False
        self._renumbered = self._outdated = self._has_other_wires = False
        self._unstored = False
        self._adopt(self.cage.labels(was_read=True), self.arrays.seams)

    # Symmetry

    def look_for_symmetry(self) -> None:
        if self._looking is None:
            # A daemon: Blender must not wait for it to quit.
            self._looking = threading.Thread(target=self._look_for_symmetry, name="seamwire symmetry", daemon=True)
            self._looking.start()

    def _look_for_symmetry(self) -> None:
        try:
            self.symmetric = self.session.symmetry.symmetric_axes
        except Exception as error:
            traceback.print_exc()
            self._symmetry_error = error
            self.symmetric = ()

    def symmetric_soon(self) -> tuple[int, ...] | None:
        """Return `symmetric`, or None if it takes longer than a moment to find out. Raises ValueError if it cannot be found out."""
        self.look_for_symmetry()
        if self._looking is not None:
            self._looking.join(_MOMENT)
        error, self._symmetry_error = self._symmetry_error, None
        if error is not None:
            self._looking = self.symmetric = None  # the next call tries again
            raise ValueError(f"The mesh could not be checked for symmetry: {error}")
        return self.symmetric

    @property
    def busy(self) -> bool:
        looking = self._looking is not None and self._looking.is_alive()
        return self.session.computing or self.session.waiting > 0 or looking or self._unstored

    # Settings

    def follow(self, settings: SeamwireSettings) -> None:
        self.session.follow(self.options(settings))

    def options(self, settings: SeamwireSettings) -> Options:
        return snapshot(settings, self.cage.data, self.find_auto())

    def find_auto(self) -> Auto:
        if self._auto is None:
            self._auto = auto_for(self.obj, self.arrays)
        return self._auto

    # The network and the mesh

    @property
    def places(self) -> Places:
        return Places(self.arrays.points, self.arrays.to_object)

    def alive(self) -> bool:
        """Whether the edit mesh that was read is still there, and can be drawn on with the numbers it was read with."""
        try:
            is_edited = self.obj.mode == "EDIT" and self.obj.data == self.cage.data
            return is_edited and not self._outdated and self.cage.intact()
        except ReferenceError:
            return False

    def refresh(self, obj: bpy.types.Object) -> bool:
        """Take over what the object's mesh holds now; return False where wires would run on it in another way.

        Raises ValueError where there is nothing to draw on.
        """
        arrays = edit_mesh.read(obj)
        if obj.mode != "EDIT" or not arrays.same_as(self.arrays):
            return False
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        self._renumbered = self._outdated = self._has_other_wires = False
        labels = self.cage.labels(was_read=True)
        same = labels.same_as(self._labels) and np.array_equal(arrays.seams, self.arrays.seams)
        if not same:
            self._adopt(labels, arrays.seams)
        elif self._found.known:
            self._store()
        session = self.session
        session.follow(replace(session.options, mirror=mirror_axes(self.cage.data)))
        return True

    def rebind(self, obj: bpy.types.Object) -> bool:
        """Read the object's mesh again while wires are drawn. Return whether it is as it was read or written last.

        If it is not, the chain must end. Its wires can still be written if their vertices have the same numbers.
        """
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        has_others = self.cage.vertex_count != len(self.arrays.points)
        self._renumbered = has_others and not self._has_same_numbers()
        known, self._labels = self._labels, self.cage.labels()
        self._outdated = True
        if not self._labels.same_as(known) and not has_others:
            self._found = Found() if self._newer else wire_labels.read(self._labels, self._archive, self.places)
            self._has_other_wires = True
        if obj.mode != "EDIT" or has_others:
            return False
        try:
            arrays = edit_mesh.read(obj)
        except ValueError:
            return False
        if not arrays.same_as(self.arrays):
            return False
        self._outdated = False
        before, now = (np.unique(np.sort(seams, axis=1), axis=0) for seams in (self.arrays.seams, arrays.seams))
        self._set_seams(arrays.seams, self._labels)
        return self._labels.same_as(known) and np.array_equal(before, now)

    def _has_same_numbers(self) -> bool:
        network = self.session.drawn
        of_wires = (vertex for wire in network.wires for edge in wire.claims() for vertex in edge)
        of_strokes = (vertex for stroke in network.strokes for vertex in stroke.corners.reshape(-1).tolist())
        used = sorted({*of_wires, *of_strokes})
        if used and used[-1] >= self.cage.vertex_count:
            return False
        verts = self.cage.number_bmesh().verts
        moved = np.array([verts[vertex].co for vertex in used]).reshape(-1, 3) - self.arrays.in_object[used]
        return bool(np.abs(moved).max(initial=0.0) <= self.places.tolerance)

    def _adopt(self, labels: EdgeLabels, seams: NDArray[np.int32]) -> None:
        self._learn(labels)
        self._labels = labels
        self._found = Found() if self._newer else wire_labels.read(labels, self._archive, self.places)
        network = self._found.network
        strokes = tuple(on_mesh(one, self.arrays.points, self.arrays.triangles) for one in network.strokes)
        self._set_seams(seams, labels)
        self.session.adopt(replace(network, strokes=strokes), self.plain_seams)
        if not self._damaged:
            self._store()
        self.session.offering.cuts.recall(_taken_cuts.recall(self.session.drawn, self.places))

    def _set_seams(self, seams: NDArray[np.int32], labels: EdgeLabels) -> None:
        self.arrays = replace(self.arrays, seams=seams)
        self.plain_seams = wire_labels.seams_beside(seams, labels, self._archive, self._found.known)

    def _learn(self, labels: EdgeLabels) -> None:
        """Take in the records of the mesh and, where labels came from another one, those of all meshes in the file."""
        global _archive
        self._newer = self._damaged = False
        try:
            own = Archive.parse(self.cage.data.seamwire_wires)
            # The oldest records of the file go if all take too much memory. Sessions keep what they have.
            if _archive.size > _MOST_RECORDED:
                _archive = _archive.newest(_MOST_RECORDED // 2)
            # If numbers of the mesh stand for something else in this Blender, the mesh gets a separate archive.
            self._archive = _archive if _archive.merge(own) else own
        except serialization.NewerError as error:
            self._newer = True
            self.notices.add("WARNING", str(error))
            return
        except UnreadableError as error:
            self._damaged = True
            self.notices.add("WARNING", str(error))
        if all(self._archive.knows(label) for label in np.unique(labels.labels).tolist()):
            return
        for data in bpy.data.meshes:
            try:
                self._archive.merge(Archive.parse(data.seamwire_wires))
            except UnreadableError:
                continue

    def _store(self) -> None:
        if self._newer:
            return
        text = self._archive.text(np.unique(self._labels.labels).tolist())
        data = self.cage.data
        self._unstored = False
        try:
            if data.seamwire_wires != text:
                data.seamwire_wires = text
        except AttributeError:
            # While Blender asks what is under the mouse nothing may be written; after undo the records may be others by then.
            self._unstored = True

    def poll(self) -> None:
        """Let the mesh hold what could not be written yet."""
        if self._unstored and self.alive():
            self._store()

    def plan(self, change: Change | None = None) -> wire_labels.Plan:
        """Return what the mesh's edges must be for what is drawn. If others have changed the mesh, only a `change` is drawn on it.

        Raises ValueError if vertices have other numbers now.
        """
        if self._renumbered:
            raise ValueError("The mesh has other vertices now")
        drawn = self.session.drawn
        return wire_labels.plan(
            change.on(self._found.network) if change and self._has_other_wires else drawn,
            self._labels,
            self._found,
            self._archive,
            self.places,
            self.cage.is_seam,
            self.arrays.edges,
        )

    def write(self, plan: wire_labels.Plan, adopt: bool = True) -> tuple[int, int]:
        """Mark and clear seams as planned, and let the mesh keep the network. Return how many edges were marked, and how many cleared.

        If the session is to `adopt` the network, the drawing ends with that: what was done before is Blender's to undo then. Raises
        ValueError where an edge is not there any more; then nothing is changed.
        """
        labels = {} if self._newer else plan.labels
        written = self.cage.write(plan.mark, plan.clear, labels)
        # Any other edge has no label, as before.
        self._labels = self.cage.labels((*map(tuple, self._labels.pairs.tolist()), *labels))
        self._found = Found(plan.network, plan.known)
        self._has_other_wires = False
        seams = edges_after(self.arrays.seams, plan.mark, plan.clear)
        self._set_seams(seams, self._labels)
        self._store()
        if adopt:
            self.adopt(plan)
        return written

    def adopt(self, plan: wire_labels.Plan) -> None:
        self.session.adopt(plan.network, self.plain_seams)
        _taken_cuts.keep(self.session.offering.cuts.taken(self.session.drawn), self.session.drawn, self.places)

    def add(self, wires: Iterable[Wire], strokes: Iterable[Stroke] = ()) -> None:
        """Go on with more wires and strokes, found elsewhere; `write` marks their edges."""
        session = self.session
        new = (on_mesh(one, self.arrays.points, self.arrays.triangles) for one in strokes)
        drawn = replace(session.drawn, wires=(*session.wires, *wires), strokes=(*session.drawn.strokes, *new))
        session.adopt(drawn, self.plain_seams)

    def take_over(self, wires: Iterable[Wire]) -> None:
        """Go on with wires along seams of the mesh: `write` makes these edges theirs, so that they go where the wires go."""
        session = self.session
        network = replace(session.drawn, wires=(*session.wires, *wires))
        taken = {edge for wire in network.wires for edge in wire.edges()}
        rest = [pair for pair in self.plain_seams.tolist() if (min(pair), max(pair)) not in taken]
        self.plain_seams = np.array(rest, dtype=np.int32).reshape(-1, 2)
        session.adopt(network, self.plain_seams)
        self._found = replace(self._found, network=session.drawn)

    @cached_property
    def _tree(self) -> seamwire_core.NearestPoints:
        return native.load().NearestPoints(self.arrays.in_object, self.arrays.triangles)

    def point_at(self, place: Sequence[float]) -> FacePoint:
        """Return the point of the visible surface that is nearest to a place in object coordinates.

        Raises ValueError if no face is visible, or the place is too far away to be compared with them.
        """
        if not len(self.arrays.triangles):
            raise ValueError("No face is visible: give vertices or edges instead of places")
        # In single precision, as Blender has places, larger ones have no distance.
        if not np.abs(np.array(place)).max() < 1e18:
            raise ValueError(f"The place ({' '.join(f'{x:g}' for x in place)}) is too far from the mesh")
        (row,), (found,), _ = self._tree.find([place])
        return FacePoint.at(found, row, self.arrays.triangles, self.arrays.in_object)
