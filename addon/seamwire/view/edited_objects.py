# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects that are drawn on: which of them is under the mouse, what is drawn over them, and how they follow Blender.

Prepared data of a mesh stays until its geometry changes, also between chains and while other tools are used.
"""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from typing import TYPE_CHECKING

import bpy

from ..mesh import settings as chosen
from .object_view import ObjectView, in_bounds, let_blender_tell
from .timer import Timer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..core.network.network import Snap
    from .viewport import Place

_RHYTHM = 0.05
"""Seconds between two looks at running work: redraws stay below what the eye takes for a stop."""
_PAUSE = 0.2
"""Seconds after which a mesh that Blender has changed is read anew: while it is being moved, it changes all the time."""
_KEPT = 8
"""So many objects stay prepared while they are not edited."""


class EditedObjects:
    """The objects that are drawn on, by their names.

    Attributes
    ----------
    front
        The one that was pointed at last; None: none yet.
    is_paused
        Whether nothing lights up under the mouse.
    chain
        Whether a chain is being drawn. The chain then updates the objects, and they are drawn with every tool.
    covered
        Whether something else is drawn in place of the objects.
    timer
        Looks after running work.
    """

    def __init__(self) -> None:
        self._views: dict[str, ObjectView] = {}
        self._handles: list[object] = []
        self._error: Exception | None = None
        self._forgotten: dict[str, bool] = {}  # names, and whether that object was in front
        self.front: ObjectView | None = None
        self.timer = Timer(self.tick)
        self.chain = False
        self.covered = False
        self.is_paused = False

    # What there is

    def views(self) -> list[ObjectView]:
        """Return the objects in Edit Mode that were pointed at."""
        return [view for view in self._views.values() if view.mesh.alive()]

    def of(self, obj: bpy.types.Object) -> ObjectView:
        """Return an object in edit mode, read anew where it has changed.

        Raises
        ------
        ValueError, native.NativeError
            Where there is nothing to draw on, or nothing to draw with.
        """
        name = obj.name_full
        view = self._views.get(name)
        if view is not None and not self.chain and not self._is_current(view, obj):
            self._remove(name)
            view = None
        if view is None:
            view = ObjectView(obj)
            self._views[name] = view
            self._make_room()
        self._begin()
        return view

    @staticmethod
    def _is_current(view: ObjectView, obj: bpy.types.Object) -> bool:
        """Whether what is prepared for an object's mesh holds, having read it anew where it has changed."""
        if not view.stale and view.mesh.alive() and view.obj == obj:
            return True
        try:
            return view.refresh(obj)
        except ValueError:  # nothing of it is visible any more
            return False

    def _remove(self, name: str) -> None:
        view = self._views.pop(name)
        view.close()
        if self.front is view:
            self.front = None

    def _make_room(self) -> None:
        idle = [name for name, view in self._views.items() if not view.mesh.alive()]
        for name in idle[: max(0, len(self._views) - _KEPT)]:
            self._remove(name)

    def forget(self, view: ObjectView) -> None:
        """Let an object be read anew, at the latest when the mesh has stayed as it is for a moment: it has other vertices now."""
        self._forgotten[view.name] = view is self.front
        self._changed = time.monotonic()
        self._remove(view.name)

    def take_stock(self) -> None:
        """Read anew what has changed, and let one of the objects that are edited be in front."""
        self._error = None  # what could not be drawn before says nothing of now
        let_blender_tell()
        self.refresh()
        if self.front is None or not self.front.mesh.alive():
            self.front = self.of(bpy.context.active_object)
        chosen.start_along(chosen.settings(), self.front.mesh.best_along)

    def clear(self) -> None:
        """Forget all objects, draw nothing any more and follow Blender no more."""
        for name, handler in _HANDLERS:
            if handler in getattr(bpy.app.handlers, name):
                getattr(bpy.app.handlers, name).remove(handler)
        if self._on_settings in chosen.listeners:
            chosen.listeners.remove(self._on_settings)
        for name in tuple(self._views):
            self._remove(name)
        self._forgotten.clear()
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        self.timer.stop()
        self.chain = self.covered = False
        self.is_paused = False
        self._error = None

    # Pointing

    def find(self, place: Place, plain: bool = False) -> tuple[ObjectView | None, Snap | None]:
        """Return which object is under the mouse, and what of it; `plain`: what loops lead through."""
        found = [view for obj in _in_edit_mode() if (view := self._at(obj, place)) is not None]
        if len(found) > 1:
            depths = [(view.depth(place.view, place.cursor), view) for view in found]
            hit = [pair for pair in depths if pair[0] is not None]
            if hit:
                found = [min(hit, key=lambda pair: pair[0])[1]]
            else:
                found.sort(key=lambda view: view is not self.front)
        for view in found:
            snap = view.snap(place.view, place.cursor, plain)
            if snap is not None:
                return view, snap
        return (found[0], None) if found else (None, None)

    def _at(self, obj: bpy.types.Object, place: Place) -> ObjectView | None:
        """Return an object that may be under the mouse: those that were pointed at always, others where there is room."""
        if obj.name_full not in self._views and not in_bounds(obj, place.view, place.cursor):
            return None
        if not obj.visible_in_viewport_get(place.area.spaces.active):
            return None
        try:
            return self.of(obj)
        except ValueError:  # it has nothing to draw on
            return None

    def hover(self, place: Place | None) -> None:
        """Light up what a click would take, while no chain is being drawn."""
        if self.is_paused:
            return
        view, snap = (None, None) if place is None else self.find(place)
        if view is not None and chosen.start_along(chosen.settings(), view.mesh.best_along):
            view, snap = self.find(place)
        self.point_at(view, place)
        if self.front is not None and view is not self.front:
            self.front.session.hover(None)
        if view is not None:
            self.front = view
            self.follow_settings()
            view.session.hover(snap)
        self.watch()
        self.show()

    def point_at(self, view: ObjectView | None, place: Place | None) -> None:
        """Let the overlay name the island under the mouse, which is on that object if anywhere."""
        for each in self.views():
            hit = each.surface_at(place.view, place.cursor) if each is view and place is not None else None
            each.islands.pointed = None if hit is None else hit[1]

    def pause(self) -> None:
        """Light up nothing until the objects are forgotten: doing so raised."""
        self.is_paused = True

    # How they follow

    def follow_settings(self) -> None:
        """Let the sessions follow the settings."""
        settings = chosen.settings()
        for view in self.views():
            view.mesh.follow(settings)
            view.measure()

    def _on_settings(self) -> None:
        self.follow_settings()
        self.watch()

    def refresh(self) -> None:
        """Read changed meshes again, and forget meshes with a new topology.

        A chain looks after its objects itself.
        """
        if self.chain:
            return
        for name, view in tuple(self._views.items()):
            obj = bpy.data.objects.get(name)
            if obj is None or obj.type != "MESH":
                self._remove(name)
            elif obj.mode == "EDIT" and not self._is_current(view, obj):
                self.forget(view)

    def _read_forgotten(self) -> None:
        """Read the objects that were forgotten, so that their wires are seen again before the mouse moves."""
        names, self._forgotten = self._forgotten, {}
        for name, was_front in names.items():
            obj = bpy.data.objects.get(name)
            if obj is None or obj.type != "MESH" or obj.mode != "EDIT":
                continue
            with suppress(ValueError):  # nothing of it is visible any more
                view = self.of(obj)
                if was_front and self.front is None:
                    self.front = view

    def on_update(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Take note of meshes that Blender says were changed."""
        for view in self._views.values():
            if not any(view.shows(update) for update in depsgraph.updates):
                continue
            now = time.monotonic()
            if not view.stale:
                view.stale = True
                self._stale_since = now
            if not self.chain:
                self._changed = now
                self.watch()

    def on_undo(self) -> None:
        """Follow Blender's undo or redo: all edit meshes are others now."""
        for view in self._views.values():
            view.stale = True
        self.refresh()
        self.redraw()
        self.watch()

    def watch(self) -> None:
        """Look after running work until it is done."""
        self.timer.start(after=_RHYTHM)

    def poll(self) -> None:
        """Take in what was computed, and show it."""
        if any([view.poll() for view in self.views()]):
            self.redraw()

    def tick(self) -> float | None:
        """Poll running work and read changed meshes again.

        Return the seconds until the next call, or None if nothing is left to do. While a chain is drawn, it looks after the
        objects, and it calls `watch` when it ends.
        """
        if self.chain:
            return None
        if self._waits_to_be_read and time.monotonic() - self._changed > _PAUSE:
            self.refresh()
            self._read_forgotten()
            self.redraw()
        self.poll()
        return _RHYTHM if self._waits_to_be_read or any(view.busy for view in self.views()) else None

    @property
    def _waits_to_be_read(self) -> bool:
        changed = bool(self._forgotten) or any(view.stale for view in self.views())
        return changed and _tool_is_shown()

    _changed = _stale_since = 0.0

    # Drawing

    def show(self, help_rows: list[tuple[str, str]] | None = None) -> None:
        """Show the sessions as they are now, where that is something new."""
        for view in self.views():
            view.show(front=view is self.front, help_rows=help_rows)
        state = [(id(view), view.session.revision, view.islands.pointed_island) for view in self.views()]
        state.append((id(self.front), bool(help_rows)))
        if state != self._shown:
            self._shown = state
            self.redraw()

    _shown: list[tuple[object, ...]] | None = None

    @staticmethod
    def redraw() -> None:
        """Let all 3D views be drawn anew."""
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()

    def take_error(self) -> None:
        """Raise what could not be drawn since the last call: raised while drawing, it would be printed at every redraw."""
        error, self._error = self._error, None
        if error is not None:
            raise error

    def _begin(self) -> None:
        """Draw, and follow what Blender does, from now on."""
        for name, handler in _HANDLERS:
            handlers = getattr(bpy.app.handlers, name)
            if handler not in handlers:
                handlers.append(handler)
        if self._on_settings not in chosen.listeners:
            chosen.listeners.append(self._on_settings)
        if not self._handles and not bpy.app.background:
            add = bpy.types.SpaceView3D.draw_handler_add
            self._handles = [
                add(self._draw, ("draw_in_scene",), "WINDOW", "POST_VIEW"),
                add(self._draw, ("draw_on_screen",), "WINDOW", "POST_PIXEL"),
            ]

    def _draw(self, part: str) -> None:
        if self._error is not None:
            return
        try:
            for view in self._drawn():
                getattr(view.overlay, part)()
        except Exception as error:
            self._error = error
            sys.excepthook(*sys.exc_info())

    def _drawn(self) -> Iterator[ObjectView]:
        """Yield the objects that are drawn in the view that Blender is drawing now."""
        context = bpy.context
        is_wanted = (self.chain or chosen.tool_is_active(context)) and not self.covered
        if not is_wanted or not context.space_data.overlay.show_overlays:
            return
        shown = set(context.view_layer.objects.keys())
        for name, view in self._views.items():
            # A mesh that changes for a long time is shown after it was read again.
            recent = time.monotonic() - self._stale_since < 2.0 * _PAUSE
            current = view.mesh.alive() and (self.chain or not view.stale or recent)
            if current and name in shown and view.obj.visible_in_viewport_get(context.space_data):
                yield view


def _tool_is_shown() -> bool:
    """Whether the tool is the active one of edit mode in a window's workspace."""
    spaces = (window.workspace for window in bpy.context.window_manager.windows)
    tools = (space.tools.from_space_view3d_mode("EDIT_MESH", create=False) for space in spaces)
    return any(tool is not None and tool.idname == chosen.TOOL for tool in tools)


def _in_edit_mode() -> list[bpy.types.Object]:
    """Return the meshes that are edited, each once, the active one first."""
    objects = [obj for obj in bpy.context.objects_in_mode_unique_data if obj.type == "MESH"]
    active = bpy.context.active_object
    return sorted(objects, key=lambda obj: obj != active)


edited = EditedObjects()
"""The edited objects of this Blender."""


def _on_update(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    edited.on_update(depsgraph)


def _on_undo(*_: object) -> None:
    edited.on_undo()


def _on_save(*_: object) -> None:
    edited.refresh()


def _on_load(*_: object) -> None:
    edited.clear()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    ("undo_post", _on_undo),
    ("redo_post", _on_undo),
    ("save_pre", _on_save),
    ("load_pre", _on_load),
)
