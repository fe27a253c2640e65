# SPDX-License-Identifier: GPL-3.0-or-later
"""One object that is drawn on: its edit mesh, session, picker and overlay, and the network that stays with its mesh."""

from __future__ import annotations

import threading
from dataclasses import replace
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core import islands, native, session
from ..core import serialization as storage
from ..core.eventual import EventualLive, Eventually
from ..operators import stroke_handler as strokes
from ..ui import preferences
from ..ui.menus import count
from ..view import overlay, picking
from ..view.theme import HUES
from . import edit_mesh

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from types import ModuleType

    from numpy.typing import NDArray

    from ..core.live import LiveWire
    from ..core.network import Along, Edge, Snap, Wire
    from ..core.strokes import Scribble
    from ..ui.toolbar import SeamwireSettings
    from ..view.viewport import View

KEY = "seamwire"
"""The mesh's custom property that holds the network."""

_MOMENT = 0.1
"""Seconds for which the interface may wait."""


def live_maker(arrays: edit_mesh.Arrays) -> Callable[[Along], LiveWire]:
    """Return what makes the live wires on a mesh for one way of running."""
    core = native.load()
    surface = core.Surface(arrays.points, arrays.triangles, arrays.edges)
    return lambda along: _live(core, surface, along)


def eventual_surface(arrays: edit_mesh.Arrays) -> Eventually[object]:
    """Return the library's surface, made on a thread: at a million faces it takes most of a second."""
    core = native.load()
    return Eventually(lambda: core.Surface(arrays.points, arrays.triangles, arrays.edges))


def maker_on(surface: Eventually[object]) -> Callable[[Along], LiveWire]:
    """Return what makes live wires on a surface, on threads."""
    core = native.load()

    def make(along: Along) -> LiveWire:
        return EventualLive(Eventually(lambda: _live(core, surface.get(), along)))

    return make


def _live(core: ModuleType, surface: object, along: Along) -> LiveWire:
    return core.LiveWire(
        surface,
        along=along.lower(),
        max_anisotropy=session.STRENGTHS[along],
        clamp_percentile=session.CLAMP_PERCENTILE,
    )


def mirror_axes(mesh: bpy.types.Mesh) -> tuple[int, ...]:
    """Return the axes over which Blender mirrors what is done to a mesh."""
    return tuple(axis for axis, name in enumerate("xyz") if getattr(mesh, f"use_mirror_{name}"))


def in_bounds(obj: bpy.types.Object, view: View, cursor: tuple[float, float]) -> bool:
    """Whether a pixel lies within the bounds of an object, or within reach of them."""
    corners = np.array([(*corner, 1.0) for corner in obj.bound_box]) @ np.array(obj.matrix_world).T
    pixels = view.to_pixels(corners[:, :3])
    if np.isnan(pixels).any():
        return True
    reach = picking.REACH
    low, high = pixels.min(axis=0) - reach, pixels.max(axis=0) + reach
    return bool((low <= cursor).all() and (cursor <= high).all())


class Board:
    """One object that is drawn on.

    Parameters
    ----------
    obj
        A mesh object in edit mode.
    settings
        How wires are drawn at first.
    interrupted
        The network of a drawing on this mesh that did not come to its end; None: there was none.
    """

    def __init__(self, obj: bpy.types.Object, settings: SeamwireSettings, interrupted: str | None = None) -> None:
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        arrays = edit_mesh.read(obj)
        self._arrays = arrays
        self._differences: Iterator[bool] = iter(())
        self._points = arrays.points
        self._edges = arrays.edges
        self._settings = settings
        self._strength: NDArray[np.float64] | None = None
        surface = eventual_surface(arrays)
        self.session = session.Session(
            maker_on(surface),
            arrays.points,
            settings.along,
            edges=arrays.edges,
            seams=arrays.seams,
            strength={"EDGES": settings.strength_edges, "SURFACE": settings.strength_surface},
            to_object=arrays.to_object,
            triangles=arrays.triangles,
        )
        self.session.set_metric(settings.metric)
        self.session.set_clamp(settings.clamp)
        self._mesh_mirror: tuple[int, ...] = ()
        self.follow_mirror()
        self._picker = picking.Picker(self.cage.bm, arrays, arrays.seams)
        self._network = self.session.network
        self.symmetric: tuple[int, ...] | None = None
        self._looking = threading.Thread(target=self._look_for_symmetry, daemon=True)
        self._looking.start()
        self._interrupted = interrupted
        self._earlier = interrupted or self.stored
        core = native.load()
        self._segments = islands.IslandMaker(
            arrays.triangles, lambda cuts: core.face_segments(surface.get(), cuts), HUES
        )
        self.overlay = overlay.Overlay(
            self.session,
            obj,
            arrays.points,
            arrays.to_object,
            triangles=arrays.triangles,
            segments=self._segments,
            seams=arrays.seams,
            preferences=preferences.get(),
        )

    def remove(self) -> None:
        """Stop drawing the overlay."""
        self.overlay.remove()
        self._segments.close()

    def _look_for_symmetry(self) -> None:
        self.symmetric = self.session.symmetric_axes

    def symmetric_soon(self) -> tuple[int, ...] | None:
        """Return the axes over which the mesh is symmetric; None where that takes longer than a moment to find out."""
        self._looking.join(_MOMENT)
        return self.symmetric

    @property
    def offered(self) -> str | None:
        """The network of an earlier drawing, while it is not taken up."""
        return self._earlier if self.session.network.earlier is None else None

    @property
    def offer(self) -> bool:
        """Whether wires of an earlier drawing are to be offered."""
        own = preferences.get()
        return self.offered is not None and (own is None or own.resume != "NEVER")

    @property
    def busy(self) -> bool:
        """Whether something is being computed: `poll` is to be called now and then."""
        drawing = self.session
        return drawing.computing or drawing.waiting_clicks > 0 or self._looking.is_alive() or self.overlay.busy

    @property
    def changes(self) -> bool:
        """Whether finishing would change anything."""
        network = self.session.network
        return bool(network.wires or network.scribbles) or network.earlier is not None

    def look_through(self) -> None:
        """Have `intact` look at every vertex, edge and face from now on, from the first one on, not at their numbers alone."""
        self._differences = self.cage.differences(self._arrays)

    def intact(self, to_the_end: bool = False) -> bool:
        """Whether object and mesh are still there and being edited, with the same vertices, edges and faces.

        Parameters
        ----------
        to_the_end
            Look at all that there is to look at, instead of the next part.
        """
        try:
            if self.obj.mode != "EDIT" or self.obj.data != self.cage.mesh or not self.cage.intact():
                return False
        except ReferenceError:
            return False
        return not (any(self._differences) if to_the_end else next(self._differences, False))

    def shows(self, update: bpy.types.DepsgraphUpdate) -> bool:
        """Whether an update of Blender's tells of a change of the mesh, whichever it is."""
        return update.is_updated_geometry and update.id.original in (self.obj, self.cage.mesh)

    def poll(self) -> bool:
        """Take in what was computed; return whether there are new segments to be seen."""
        self.session.poll()
        return self.overlay.poll()

    def stepped(self) -> bool:
        """Whether there was a step since the last call that undo can take back."""
        if self.session.dragging:
            return False
        before, self._network = self._network, self.session.network
        return self._network is not before

    # Settings

    def follow(self, settings: SeamwireSettings) -> None:
        """Take over settings that were changed in the tool's header."""
        drawing = self.session
        drawing.switch(settings.along)
        drawing.set_metric(settings.metric)
        drawing.set_clamp(settings.clamp)
        drawing.set_strength("EDGES", settings.strength_edges)
        drawing.set_strength("SURFACE", settings.strength_surface)

    def follow_mirror(self) -> None:
        """Take over the mesh's own mirror where it was changed."""
        axes = mirror_axes(self.cage.mesh)
        if axes != self._mesh_mirror:
            self._mesh_mirror = axes
            self.session.set_mirror(axes)

    def tell(self, settings: SeamwireSettings) -> None:
        """Write back what keys changed."""
        drawing = self.session
        for setting in ("along", "metric"):
            if getattr(settings, setting) != getattr(drawing, setting):
                setattr(settings, setting, getattr(drawing, setting))
        name = "strength_edges" if drawing.along == "EDGES" else "strength_surface"
        if abs(getattr(settings, name) - drawing.strength) > 1e-4 * drawing.strength:
            setattr(settings, name, drawing.strength)

    # What is under the cursor, and what is seen

    def snap(self, view: View, cursor: tuple[float, float], plain: bool = False) -> Snap | None:
        """Return what is under the cursor; `plain`: of the mesh alone, whatever was drawn on it."""
        if self._settings.snap and self._strength is None:
            self._strength = self.session.feature_strength()
        return self._picker.snap(
            view,
            self.obj.matrix_world,
            cursor,
            vertices_only=self.session.along == "SURFACE",
            session=None if plain else self.session,
            xray=self._settings.xray,
            strength=self._strength if self._settings.snap and not plain else None,
            scale=bpy.context.preferences.system.ui_scale,
        )

    def depth(self, view: View, cursor: tuple[float, float]) -> float | None:
        """Return how far from the viewer the object is under the cursor; None where it is not."""
        return self._picker.depth(view, self.obj.matrix_world, cursor)

    def surface_at(self, view: View, cursor: tuple[float, float]) -> tuple[NDArray[np.float64], int] | None:
        """Return the place on the mesh that is seen at a pixel, in the session's coordinates, and its triangle."""
        return self._picker.surface_at(view, self.obj.matrix_world, cursor)

    @property
    def stroke_radius(self) -> float | None:
        """How far strokes reach; None: as many rings as the library takes."""
        return self._settings.stroke_radius or None

    def stroke_at(self, view: View, cursor: tuple[float, float]) -> Scribble | None:
        """Return the stroke under the cursor."""
        matrix = self.obj.matrix_world
        return strokes.stroke_at(
            self.session.scribbles,
            view,
            matrix,
            self._arrays.to_object,
            cursor,
            strokes.ERASE_REACH * bpy.context.preferences.system.ui_scale,
            lambda place: self._settings.xray or self._picker.sees(view, matrix, place),
        )

    def show(self, settings: SeamwireSettings, front: bool, help_rows: Sequence[tuple[str, str]] | None) -> None:
        """Let the overlay follow."""
        self.overlay.xray = settings.xray
        self.overlay.features = settings.snap
        self.overlay.front = front
        self.overlay.help_rows = help_rows

    # The network, beyond this drawing

    def resume(self) -> str:
        """Go on with the wires of an earlier drawing; return what there is to say."""
        text = self.offered
        if text is None:
            return "There are no wires of an earlier drawing on this mesh"
        network, problems = storage.load(text, self._points, self._edges)
        now = self.session.network
        self.session.resume(
            replace(
                network,
                wires=(*network.wires, *now.wires),
                scribbles=(*network.scribbles, *now.scribbles),
                mirror=tuple(sorted({*network.mirror, *now.mirror})),
                # What these wires marked, they are to clear where they are dropped now.
                earlier=frozenset(edge for wire in network.wires for edge in self._marked_by(wire, network.mirror)),
            )
        )
        return "; ".join([f"Going on with {count(len(network.wires), 'wire')}", *problems])

    def _marked_by(self, wire: Wire, mirror: tuple[int, ...]) -> Iterator[Edge]:
        if wire.marks:
            for image in (wire, *self.session.mirrored(wire, mirror)):
                yield from image.edges()

    def to_set_aside(self) -> tuple[str, str] | None:
        """Return the mesh's name and the network, for the next drawing on it; None where there is nothing to keep."""
        network = replace(self.session.network, seed=None)
        if not network.wires and not network.scribbles:
            return None
        try:
            return self.cage.mesh.name, storage.dump(network, self._points)
        except ReferenceError:  # the mesh is gone, and the wires with it
            return None

    @property
    def stored(self) -> str | None:
        """What is stored with the mesh."""
        return self.cage.mesh.get(KEY)

    def _effect(self) -> tuple[list[Edge], list[Edge]]:
        mark, clear = self.session.edges_to_mark(), self.session.edges_to_clear()
        dropped = (self.session.network.earlier or frozenset()) - set(mark) - set(clear)
        return mark, [*clear, *dropped]

    def check(self) -> None:
        """Raise ValueError where `write` would, so that of several objects either all are written or none."""
        self.cage.check_edges(*self._effect())

    def write(self) -> tuple[int, int]:
        """Mark and clear what was drawn, and store the network with the mesh.

        Returns
        -------
        tuple of int
            How many edges became seams, and how many ceased to be.
        """
        written = self.cage.write_seams(*self._effect())
        network = replace(self.session.network, seed=None)
        if self.stored is not None and (self.offered is not None or self._interrupted is not None):
            # Wires that were not taken up stay with the mesh, as far as they still are what they were.
            earlier, _ = storage.load(self.stored, self._points, self._edges)
            seams = set(self.cage.seams())
            drawn = {edge for wire in network.wires for edge in wire.edges()}
            kept = [
                wire for wire in earlier.wires if seams.issuperset(wire.edges()) and not drawn.issuperset(wire.edges())
            ]
            strokes = earlier.scribbles if network.earlier is None else ()
            network = replace(network, wires=(*kept, *network.wires), scribbles=(*strokes, *network.scribbles))
        if network.wires or network.scribbles:
            self.cage.mesh[KEY] = storage.dump(network, self._points)
        elif KEY in self.cage.mesh:
            del self.cage.mesh[KEY]
        return written
