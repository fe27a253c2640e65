# SPDX-License-Identifier: GPL-3.0-or-later
"""One object that is drawn on, as it is seen: what of it is under the cursor, and what is drawn over it."""

from __future__ import annotations

import itertools
import threading
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ..core.islands.islands import IslandMaker
from ..core.network.drawn import edges_after
from ..core.picking.picker import REACH, Picker
from ..core.seams.seam_wires import GapFinder
from ..core.solver.solver import for_live
from ..mesh import settings as chosen
from ..mesh.edit_mesh import Pose, visible_stretch
from ..mesh.object_session import ObjectSession
from .failures import failures
from .layers import CrestView, StretchHeat, makers
from .overlay import Overlay

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator

    import seamwire_core
    from numpy.typing import ArrayLike, NDArray

    from ..core.islands.islands import Islands
    from ..core.network.network import Snap
    from ..core.network.picks import Pick
    from ..core.network.strokes import Stroke
    from ..core.network.wires import Wire
    from ..core.picking.picker import Camera
    from ..core.sketch.picture import Picture
    from ..core.sketch.sketch import Sketch
    from ..terms.options import Options
    from .layers import Layer
    from .viewport import Place

STROKE_REACH = 12.0
"""Pixels beside a stroke in which it is found."""


class ShownIslands:
    """The islands that the wires of a session and seams, (s, 2), cut the mesh into."""

    def __init__(self, maker: IslandMaker, session: Sketch, seams: ArrayLike) -> None:
        self._maker = maker
        self._session = session
        self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
        self._seams_read = 0
        self._asked: object = None
        self._cuts: NDArray[np.int32] | None = None
        self._meant: frozenset[int] = frozenset()
        self._told: object = None
        self._part = ("islands", object())
        self.pointed: int | None = None  # the triangle under the mouse; None: it is elsewhere

    @property
    def newest(self) -> Islands | None:
        """The islands that were computed last. None if computing them failed."""
        return None if failures.has(*self._part) else self._maker.answer

    @property
    def busy(self) -> bool:
        """Whether islands are being computed: `poll` is to be called now and then."""
        return not failures.has(*self._part) and (self._maker.busy or self._asked != self._key)

    @property
    def _key(self) -> tuple[int, int]:
        return self._session.network_revision, self._seams_read

    @property
    def pointed_island(self) -> int | None:
        found = self.newest
        if found is None or not found.cut or found.count < 2 or self.pointed is None:
            return None
        return int(found.labels[self.pointed])

    def set_seams(self, seams: NDArray[np.int32]) -> None:
        if not np.array_equal(self._seams, seams):
            self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
            self._seams_read += 1

    def poll(self) -> bool:
        """Ask for the islands of a network whose cuts have changed. Return whether there are islands that no call before told of."""
        failures.attempt(self._part, self._ask)
        newest = self.newest
        before, self._told = self._told, None if newest is None else newest.key
        return self._told != before

    def _ask(self) -> None:
        session = self._session
        try:
            self._maker.check()
            if self._asked == self._key:
                return
            self._asked = self._key
            wanted = edges_after(self._seams, session.edges_to_mark(), session.edges_to_clear())
            planned = (wire for wire in session.wires if wire.planned)
            meant = frozenset(vertex for wire in planned for edge in wire.claims() for vertex in edge)
            # A chain that ends turns cuts of wires into seams: the islands stay the same.
            if self._cuts is None or meant != self._meant or not np.array_equal(wanted, self._cuts):
                self._cuts, self._meant = wanted, meant
                self._maker.ask(self._asked, wanted, meant)
        except Exception:
            self._asked = self._cuts = None  # the next attempt asks anew
            raise


def in_bounds(obj: bpy.types.Object, view: Camera, cursor: tuple[float, float]) -> bool:
    """Whether a pixel lies within the bounds of an object, or within reach of them."""
    corners = np.array([(*corner, 1.0) for corner in obj.bound_box]) @ np.array(obj.matrix_world).T
    pixels = view.to_pixels(corners[:, :3])
    if np.isnan(pixels).any():
        return True
    low, high = pixels.min(axis=0) - REACH, pixels.max(axis=0) + REACH
    return bool((low <= cursor).all() and (cursor <= high).all())


def let_blender_tell() -> None:
    """Make Blender report pending changes of meshes now, instead of after all waiting events."""
    for layer in {window.view_layer for window in bpy.context.window_manager.windows} or {bpy.context.view_layer}:
        layer.update()


class ObjectView:
    """One object in edit mode that is drawn on, with its picker and its overlay. It is `stale` once Blender told of a change of the mesh.

    Raises ValueError or NativeError where there is nothing to draw on, or nothing to draw with.
    """

    def __init__(self, obj: bpy.types.Object) -> None:
        settings = chosen.settings()
        self.mesh = ObjectSession(obj, chosen.snapshot(settings, obj.data))
        self.mesh.follow(settings)
        arrays = self.mesh.arrays
        make = self.mesh.make_live
        closed = self._closed = threading.Event()

        def goes_on(_fraction: float) -> bool:  # a method would keep the view
            return not closed.is_set()

        segments = partial(make.face_segments, progress=goes_on)
        self._surface = partial(make.wait, goes_on)
        gaps = GapFinder(self._surface, arrays.partly_hidden)
        self._islands = IslandMaker(arrays.triangles, segments, gaps, make.missing_cuts)
        self.pose = Pose(arrays)
        self.crest_view = CrestView(self._surface, self.pose)
        self.heat = StretchHeat(arrays, self._islands, self.pose)
        self._layers: list[Layer] = []
        # The wire that was given another path last, and where the mouse was. Until it moves, keys act on this wire, wherever it runs now.
        self.turned: tuple[Wire, Place] | None = None
        self._has_moved = True
        self._posed_picker: Picker | None = None
        self.islands = ShownIslands(self._islands, self.session, arrays.seams)
        # The stroke that is being drawn: its points, (k, 3), as the session has them, and whether wires will follow it.
        self.stroke: tuple[NDArray[np.float64], bool] | None = None
        self._front = True
        self.overlay = Overlay(self.pose, arrays.to_object, preferences=chosen.preferences(), layers=self._layers)
        self._strength: NDArray[np.float64] | None = None
        self.name = obj.name_full  # the last one that is known
        self.edited_until: float | None = None  # when it was found out that it is not edited
        self.was_read()
        self.follow_pose()
        self.make_layers()
        self.measure()
        self.mesh.look_for_symmetry()

    @property
    def obj(self) -> bpy.types.Object:
        """The object; its data may be gone."""
        return self.mesh.obj

    @property
    def session(self) -> Sketch:
        return self.mesh.session

    @property
    def options(self) -> Options:
        return self.session.options

    @property
    def picture(self) -> Picture:
        return replace(
            self.session.picture,
            islands=self.islands.newest,
            pointed_island=self.islands.pointed_island,
            stroke=self.stroke,
            front=self._front,
        )

    def draw(self, part: str) -> None:
        """Draw by a method of overlays in the view that Blender is drawing now."""
        getattr(self.overlay, part)(self.picture, self.obj)

    def close(self) -> None:
        self.session.offering.parts.stop()
        self._islands.close()
        for layer in self._layers:
            layer.close()
        self._closed.set()

    def refresh(self, obj: bpy.types.Object) -> bool:
        """Take over what the mesh holds now; return False where it is another one, see `ObjectSession.refresh`."""
        if not self.mesh.refresh(obj):
            return False
        self.mesh.follow(chosen.settings())  # it does not follow them outside Edit Mode
        self.renew()
        return True

    def was_read(self) -> None:
        """Take note that the mesh is known as it is now, after it was read or written."""
        # Blender tells of both as of any change. From now on it tells only of other changes.
        let_blender_tell()
        self.stale = False

    def renew(self) -> None:
        """Let picker and overlay follow the mesh that was read, or written. Outside Edit Mode they have nothing to follow."""
        if not self.mesh.alive():
            return
        self.was_read()
        self.has_moved()
        self._follow_picker().set_seams(self.mesh.plain_seams)
        self.islands.set_seams(self.mesh.arrays.seams)
        self.measure(anew=True)

    def has_moved(self) -> None:
        """Take note that modifiers may show the mesh in another pose."""
        self._has_moved = True

    def follow_pose(self) -> None:
        """Let picker and overlay follow the pose in which the mesh is seen."""
        has_moved, self._has_moved = self._has_moved, False
        if has_moved and self.pose.follow(self.obj):
            self._posed_picker = None
            self.overlay.repose()

    def _follow_picker(self) -> Picker:
        self.follow_pose()
        if self._posed_picker is None:
            posed = replace(self.mesh.arrays, points=self.pose.points)
            self._posed_picker = Picker(posed, self.mesh.plain_seams, self.pose.places if self.pose.is_bent else None)
        return self._posed_picker

    def measure(self, anew: bool = False) -> None:
        """Compute what the settings show, and measure the stretch of UVs where it is not known or `anew`."""
        self._follow_layers()
        if self.stale and not anew:
            return  # of a mesh that is read anew soon
        stale = self.stale
        if self.heat.read(self.obj, self.options.heat, anew):
            self.was_read()
            self.stale = stale

    def make_layers(self) -> None:
        made = [
            failures.attempt(("layer made", self.name, make), partial(make, self.mesh.arrays, self._surface, self.pose))
            for make in makers
        ]
        for layer in self._layers[2:]:
            layer.close()
        self._layers[:] = (self.heat, self.crest_view, *(layer for layer in made if layer is not None))

    def _follow_layers(self) -> None:
        session, options = self.session, self.options
        self.crest_view.is_wanted = options.snap or session.offering.wanted
        pick = session.seed_place
        if pick is None and self.mesh.alive():
            pick = self.mesh.cage.active_vertex()
        if pick is None:
            pick = next(reversed(session.seeds()), None)
        source, strokes = None if pick is None else for_live(pick, "SURFACE"), session.engines.strokes
        for key, layer in self._working_layers():
            failures.attempt(key, partial(layer.follow, options, source, strokes))
        session.use_crests(self.crest_view.crests, options.show_crests)

    @property
    def busy(self) -> bool:
        return self.mesh.busy or self.islands.busy or any(layer.busy for _, layer in self._working_layers())

    def poll(self) -> bool:
        """Take in what was computed; return whether there is something new to be seen."""
        self.mesh.poll()
        told = any([failures.attempt(key, layer.poll) for key, layer in self._working_layers()])
        self.session.use_crests(self.crest_view.crests, self.options.show_crests)
        # Progress is told by the status bar: the picture stays.
        seen = self.session.revision
        self.session.poll()
        return any((self.session.revision != seen, self.islands.poll(), told))

    def _working_layers(self) -> Iterator[tuple[tuple[Hashable, ...], Layer]]:
        for number, layer in enumerate(self._layers):
            key = ("layers", self.name, number)
            if not failures.has(*key):
                yield key, layer

    @property
    def is_stretched_anew(self) -> bool:
        """Whether the object scales its mesh otherwise than when it was read."""
        stretch = visible_stretch(self.obj.matrix_world)
        return not np.allclose(stretch @ self.mesh.arrays.to_object, np.eye(3), atol=1e-5)

    @property
    def exists(self) -> bool:
        """Whether Blender still has the object that was read. Undo makes another one."""
        try:
            return bool(self.obj.name)
        except ReferenceError:
            return False

    def is_current(self, obj: bpy.types.Object) -> bool:
        return not self.stale and self.mesh.alive() and self.obj == obj

    def snap(self, view: Camera, cursor: tuple[float, float], plain: bool = False) -> Snap | None:
        """Return what is under the cursor; `plain`: what loops lead through, whatever was drawn on it.

        That is the mesh's nearest edge, or across the surface its nearest vertex or the point itself.
        """
        options = self.options
        across = options.along == "SURFACE"
        mirrored = not plain and options.mirror and self.mesh.symmetric is not None
        if options.snap and self._strength is None:
            self._strength = self.session.feature_strength()
        has_crests = options.show_crests and across if plain else options.snap
        snap = self._follow_picker().snap(
            view,
            self.obj.matrix_world,
            cursor,
            vertices_only=across,
            edges_only=plain and not across,
            anywhere=across and options.into_faces,
            session=None if plain else self.session,
            xray=options.xray,
            preferred=self.session.symmetry.on_plane(options.mirror) if mirrored else frozenset(),
            strength=self._strength if options.snap and not plain else None,
            # A loop leads through what is seen: a ridge that is shown is as good as under the cursor.
            crests=None if self.pose.is_bent or not has_crests else self.crest_view.crests,
            scale=bpy.context.preferences.system.ui_scale,
        )
        return None if snap is None else replace(snap, seen_along=self.seen_along(view, snap.pick))

    def seen_along(self, view: Camera, pick: Pick) -> tuple[float, float, float] | None:
        """Return the direction from the viewer to a pick where wires that are straight in the view are offered, else None."""
        if not self.options.straight or self.options.along == "EDGES" or isinstance(pick, tuple):
            return None
        return self._follow_picker().seen_along(view, self.obj.matrix_world, pick)

    def hit(self, view: Camera, cursor: tuple[float, float]) -> seamwire_core.Picked | None:
        """Return what `Picker.surface_at` finds of the mesh as it is seen."""
        return self._follow_picker().surface_at(view, self.obj.matrix_world, cursor)

    def surface_at(self, view: Camera, cursor: tuple[float, float]) -> tuple[NDArray[np.float64], int] | None:
        """Return the place on the mesh that is seen at a pixel, in the session's coordinates, and its triangle."""
        found = self.hit(view, cursor)
        return None if found is None else (self.pose.at_rest(found.place, found.triangle), found.triangle)

    def is_on_mirrored_half(self, view: Camera, cursor: tuple[float, float]) -> bool:
        """Return whether the cursor is over faces that only a Mirror modifier shows."""
        flipped = (self.obj.matrix_world @ flip for flip in _flips(self.obj))
        return any(self._follow_picker().surface_at(view, matrix, cursor) is not None for matrix in flipped)

    def stroke_at(self, view: Camera, cursor: tuple[float, float]) -> Stroke | None:
        """Return the stroke under the cursor, which may still wait."""
        scale, xray = bpy.context.preferences.system.ui_scale, self.options.xray
        strokes = self.session.picture.strokes[::-1]  # of equally near ones, the last
        curves = [stroke.points for stroke in strokes]
        found = self._follow_picker().curve_at(curves, STROKE_REACH, view, self.obj.matrix_world, cursor, xray, scale)
        return None if found is None else strokes[found[0]]

    def turned_at(self, place: Place | None) -> Wire | None:
        """Return the wire that was given another path here, as it runs now, or None. Forget it if the mouse is elsewhere."""
        if self.turned is not None and (place is None or not place.is_as(self.turned[1])):
            self.turned = None
        return None if self.turned is None else self.session.drawn.find(self.turned[0])

    def show(self, front: bool) -> bool:
        """Let the overlay follow, and ask for the islands. Return whether islands are new."""
        self._follow_layers()
        self._front = front
        return self.islands.poll()


def _flips(obj: bpy.types.Object) -> Iterator[Matrix]:
    """Yield what takes the mesh to each mirrored part that its Mirror modifiers show in Edit Mode, in object coordinates."""
    for modifier in obj.modifiers:
        if modifier.type != "MIRROR" or not (modifier.show_viewport and modifier.show_in_editmode):
            continue
        axes = [axis for axis in range(3) if modifier.use_axis[axis]]
        center = modifier.mirror_object
        frame = Matrix() if center is None else obj.matrix_world.inverted_safe() @ center.matrix_world
        for signs in itertools.product((1.0, -1.0), repeat=len(axes)):
            if min(signs, default=1.0) < 0.0:
                flip = Matrix.Identity(4)
                for axis, sign in zip(axes, signs, strict=True):
                    flip[axis][axis] = sign
                yield frame @ flip @ frame.inverted_safe()
