# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects that are drawn on: which of them is under the mouse, what is drawn over them, and how they follow Blender.

Prepared data of a mesh stays until its geometry changes, also between chains, while other tools are used, and for a while after Edit
Mode was left. Whatever a view should show and does not is read by a timer. `draw` starts the timer, because Blender draws its views after
each change of mode, tool or mesh.
"""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

import bpy

from ..core.network.network import Snap
from ..mesh import settings as chosen
from ..mesh.registration import Timer
from ..mesh.settings import redraw_views
from .failures import failures
from .object_view import ObjectView, in_bounds, let_blender_tell

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..terms.choices import Along
    from .viewport import Place

_RHYTHM = 0.05
"""Seconds between two looks at running work: redraws stay below what the eye takes for a stop."""
_PAUSE = 0.2
"""Seconds after which a mesh that Blender has changed is read anew: while it is being moved, it changes all the time."""
_IDLE = 60.0
"""Seconds for which objects stay prepared while they are not edited."""


class EditedObjects:
    """The objects that are drawn on.

    `chain` lets the chain that is being drawn look at a changed mesh. It is None if no chain is drawn. While there is a chain, it updates
    the objects, and they are drawn with every tool.
    """

    def __init__(self) -> None:
        self._views: list[ObjectView] = []
        self._was_front = ""  # the object that was in front until it had to be read anew
        self._waits = False  # whether a mesh may have to be read
        self._states: dict[int, tuple[str, bool]] = {}  # the mode of each window, and whether it shows the tool
        self.front: ObjectView | None = None  # the one that was pointed at last
        self.timer = Timer(self.tick)
        self.sweeper = Timer(self.sweep)
        self.chain: Callable[[], None] | None = None
        self.covered = False  # whether something else is drawn in place of the objects
        self._changed = 0.0  # when Blender told of a change last
        self._stale_since = 0.0
        self._shown: list[tuple[object, ...]] | None = None  # what `show` has shown

    # What there is

    def views(self) -> list[ObjectView]:
        return [view for view in self._views if view.mesh.alive()]

    def _view_of(self, obj: bpy.types.Object) -> ObjectView | None:
        """Return the view of an object, which may have another name now. Undo makes another object with the same name."""
        for view in self._views:
            if view.obj == obj and view.exists:
                view.name = obj.name_full
                return view
        name = obj.name_full
        return next((view for view in self._views if view.name == name and not view.exists), None)

    def of(self, obj: bpy.types.Object) -> ObjectView:
        """Return an object in edit mode, read anew where it has changed. Raises as `ObjectView`."""
        view = self._view_of(obj)
        if view is not None and not self.chain and not self._is_current(view, obj):
            self._remove(view)
            view = None
        if view is None:
            view = ObjectView(obj)
            self._views.append(view)
            if self.front is None and view.name == self._was_front:
                self.front = view
        return view

    def best_along(self, obj: bpy.types.Object | None) -> Along:
        """Return how wires run on an object if the mesh decides: along edges as long as it is not read."""
        view = None if obj is None else self._view_of(obj)
        return "EDGES" if view is None else view.mesh.find_auto().along

    def _is_current(self, view: ObjectView, obj: bpy.types.Object) -> bool:
        """Whether what is prepared for an object's mesh holds, having read it anew where it has changed."""
        if view.is_current(obj):
            return True
        self._shown = None  # Blender drew the views without it
        try:
            return view.refresh(obj)
        except ValueError:  # nothing of it is visible any more
            return False

    def _remove(self, view: ObjectView) -> None:
        if view not in self._views:
            return
        self._views.remove(view)
        view.close()
        if self.front is view:
            self.front, self._was_front = None, view.name

    def sweep(self) -> float | None:
        """Forget objects that have not been edited for a while, because they take much memory. Return the seconds until the next call."""
        now, idle = time.monotonic(), [view for view in self._views if view.edited_until is not None]
        for view in self._views:
            view.edited_until = None if view.mesh.alive() else view.edited_until or now
        for view in idle:
            if view.edited_until is not None and now - view.edited_until >= _IDLE:
                self._remove(view)
        return min((view.edited_until + _IDLE - now for view in self._views if view.edited_until), default=None)

    def forget(self, view: ObjectView) -> None:
        """Let an object be read anew, at the latest when the mesh has stayed as it is for a moment: it has other vertices now."""
        self._changed = time.monotonic()
        self._remove(view)
        self.watch()

    def take_stock(self) -> None:
        """Read anew what has changed, and let one of the objects that are edited be in front."""
        failures.retry()
        let_blender_tell()
        self.refresh()
        if self.front is None or not self.front.mesh.alive():
            self.front = self.of(bpy.context.active_object)

    def clear(self, *_: object) -> None:
        for view in tuple(self._views):
            self._remove(view)
        self._states.clear()
        self.timer.stop()
        self.sweeper.stop()
        self._was_front, self._waits, self.chain, self.covered = "", False, None, False
        failures.clear()

    # Pointing

    def find(self, place: Place, plain: bool = False) -> tuple[ObjectView | None, Snap | None]:
        """Return which object is under the mouse, and what of it; `plain`: what loops lead through."""
        found = [view for obj in _in_edit_mode() if (view := self._at(obj, place)) is not None]
        if len(found) > 1:
            hits = [(hit.depth, view) for view in found if (hit := view.hit(place.view, place.cursor)) is not None]
            if hits:
                found = [min(hits, key=lambda pair: pair[0])[1]]
            else:
                found.sort(key=lambda view: view is not self.front)
        for view in found:
            snap = view.snap(place.view, place.cursor, plain)
            if snap is not None:
                return view, snap
        return (found[0], None) if found else (None, None)

    def find_or_turned(self, place: Place) -> tuple[ObjectView | None, Snap | None]:
        """Return what `find` does, or the wire that was just given another path there. While a wire is live, keys act on that wire."""
        for view in self.views():
            wire = view.turned_at(place)
            if wire is not None and view.session.seed is None:
                return view, Snap(wire.start, "WIRE", wire)
        return self.find(place)

    def _at(self, obj: bpy.types.Object, place: Place) -> ObjectView | None:
        """Return an object that may be under the mouse: those that were read always, others where there is room."""
        if self._view_of(obj) is None and not in_bounds(obj, place.view, place.cursor):
            return None
        return self._read(obj) if obj.visible_in_viewport_get(place.area.spaces.active) else None

    def _read(self, obj: bpy.types.Object) -> ObjectView | None:
        """Return what `of` returns, or None where there is nothing to draw on until the mesh changes."""
        if failures.has("read", obj.name_full):
            return None
        try:
            return self.of(obj)
        except ValueError:
            failures.skip("read", obj.name_full)
            return None

    def hover(self, place: Place) -> None:
        """Light up what a click, or a key after *W*, would take, while no chain is being drawn."""
        failures.attempt(("hover",), partial(self._hover, place))

    def _hover(self, place: Place) -> None:
        view, snap = self.find_or_turned(place)
        self.point_at(view, place)
        if self.front is not None and view is not self.front:
            self.front.session.hover(None)
        if view is not None:
            self.front = view
            view.session.hover(snap)
        self.watch()
        self.show()

    def point_at(self, view: ObjectView | None, place: Place) -> None:
        """Take note where the mouse is. The overlay names the island there, which is on that object if anywhere."""
        for each in self.views():
            each.turned_at(place)
            hit = each.hit(place.view, place.cursor) if each is view else None
            each.islands.pointed = None if hit is None else hit.triangle

    # How they follow

    def follow_settings(self) -> None:
        settings = chosen.settings()
        for view in self.views():
            view.mesh.follow(settings)
            view.measure()

    def on_settings(self) -> None:
        if self._views:
            self.follow_settings()
            self.watch()

    def make_layers(self) -> None:
        for view in self._views:
            view.make_layers()
        self.on_settings()
        self.redraw()

    def refresh(self, *_: object) -> None:
        """Read changed meshes again, and forget meshes with a new topology. A chain looks after its objects itself."""
        if self.chain:
            return
        for view in tuple(self._views):
            if view.exists:
                view.name = view.obj.name_full
            obj = bpy.data.objects.get(view.name)
            if obj is None or obj.type != "MESH":
                self._remove(view)
            elif obj.mode == "EDIT" and not self._is_current(view, obj):
                self.forget(view)

    def on_update(self, _scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Take note of meshes that Blender says were changed. A mesh that could not be read is tried again then."""
        if not self._views:
            if _changed_meshes(depsgraph):
                failures.retry()
            return
        for view in tuple(self._views):
            # Undo makes other objects with the same names.
            if not view.exists and bpy.data.objects.get(view.name) is None:
                self._remove(view)
        moved = {update.id.original for update in depsgraph.updates if update.is_updated_geometry}
        self._move([view for view in self._views if view.exists and view.obj in moved], depsgraph)
        meshes = _changed_meshes(depsgraph)
        # A view whose edit mesh is gone is read anew in any case.
        changed = [view for view in self.views() if view.obj.data in meshes or view.is_stretched_anew]
        if not meshes and not changed:
            return
        failures.retry()
        now, settings = time.monotonic(), chosen.settings()
        for view in changed:
            view.mesh.follow(settings)  # the mesh's own mirror may be another one
            if not view.stale:
                view.stale = True
                self._stale_since = now
        if self.chain:
            if depsgraph.mode == "VIEWPORT":  # a render works in another thread
                self.chain()
        else:
            self._changed = now
            self.watch()

    def on_frame(self, _scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Take note that another frame may show the objects in another pose. Blender tells of no update then."""
        self._move(self._views, depsgraph)

    def _move(self, views: list[ObjectView], depsgraph: bpy.types.Depsgraph) -> None:
        """Take note that objects may be in another pose, and follow it if they are shown. A render works in another thread."""
        for view in views:
            view.has_moved()
        is_shown = self.chain is not None or any(has_tool for _, has_tool in self._states.values())
        if is_shown and depsgraph.mode == "VIEWPORT":
            self._follow_poses()

    def _follow_poses(self) -> None:
        for view in self.views():
            failures.attempt(("pose", view.name), view.follow_pose)

    def on_undo(self, *_: object) -> None:
        """Follow Blender's undo or redo: all edit meshes are others now."""
        failures.retry()
        for view in self._views:
            view.stale = True
        self.refresh()
        self.redraw()
        self.watch()

    def watch(self) -> None:
        """Look after running work, and read what is to be read, until that is done."""
        self._waits = True
        self.timer.start(after=_RHYTHM)

    def poll(self) -> None:
        """Take in what was computed for a chain, and show it. Raises what went wrong."""
        if any([view.poll() for view in self.views()]):
            self.redraw()

    def tick(self) -> float | None:
        """Poll running work, and read a mesh that a view should show.

        Return the seconds until the next call, or None if nothing is left to do. While a chain is drawn, it looks after the
        objects, and it calls `watch` when it ends.
        """
        if self.chain:
            return None
        wait = self.sweep()
        if wait is not None:
            self.sweeper.start(after=wait)
        if time.monotonic() - self._changed > _PAUSE:
            self._read_next()
        self._follow_poses()
        views = self.views()
        if any([failures.attempt(("poll", view.name), view.poll) for view in views]):
            self.redraw()
        is_busy = any(view.busy and not failures.has("poll", view.name) for view in views)
        return _RHYTHM if self._waits or is_busy else None

    def _read_next(self) -> None:
        """Read one of the meshes that views should show. The others wait, so that Blender draws and listens in between."""
        self._waits = False
        for window in bpy.context.window_manager.windows:
            with bpy.context.temp_override(window=window):
                obj = self._unread() if chosen.tool_is_active(bpy.context) else None
                if obj is not None:
                    self._waits = True
                    failures.attempt(("read", obj.name_full), partial(self._show_read, obj))
                    return

    def _show_read(self, obj: bpy.types.Object) -> None:
        view = self._read(obj)
        if view is not None and (self.front is None or not self.front.mesh.alive()):
            self.front = view
        self.show()
        self.redraw()

    def _unread(self) -> bpy.types.Object | None:
        """Return an object in edit mode that is not read as it is now, the active one first."""
        for obj in _in_edit_mode():
            view = self._view_of(obj)
            if (view is None or not view.is_current(obj)) and not failures.has("read", obj.name_full):
                return obj
        return None

    # Drawing

    def show(self) -> None:
        """Show the sessions as they are now, where that is something new."""
        has_islands = any([view.show(front=view is self.front) for view in self.views()])
        state = [(id(view), view.session.revision, view.islands.pointed_island) for view in self.views()]
        state.append((id(self.front),))
        if has_islands or state != self._shown:
            self._shown = state
            self.redraw()

    redraw = staticmethod(redraw_views)

    def take_error(self) -> None:
        """Raise what could not be drawn since the last call: raised while drawing, it would be printed at every redraw."""
        if (error := failures.take("draw")) is not None:
            raise error

    def draw(self, part: str) -> None:
        """Draw in the view that Blender is drawing now, by a method of overlays. A timer reads missing meshes, and nothing is read here."""
        context = bpy.context
        if context.window is None or context.space_data is None:
            return  # another add-on draws the view into a picture
        has_tool = chosen.tool_is_active(context)
        key, state = context.window.as_pointer(), (context.mode, has_tool)
        is_new = self._states.get(key) != state
        if is_new:
            self._states[key] = state
            failures.retry()
        if not self.chain and (is_new or (has_tool and self._unread() is not None)):
            self.watch()
        if not (has_tool or self.chain) or self.covered or not context.space_data.overlay.show_overlays:
            return
        # A mesh that changes for a long time is shown after it was read again.
        shows_stale = self.chain or time.monotonic() - self._stale_since < 2.0 * _PAUSE
        for obj in _in_edit_mode():
            view = self._view_of(obj)
            is_seen = view is not None and view.mesh.alive() and obj.visible_in_viewport_get(context.space_data)
            if is_seen and (shows_stale or not view.stale):
                failures.attempt(("draw", view.name), partial(view.draw, part))


def _changed_meshes(depsgraph: bpy.types.Depsgraph) -> set[bpy.types.Mesh]:
    """Return the meshes in edit mode whose geometry Blender says was changed. A modifier that moves does not change the mesh."""
    found = {update.id.original for update in depsgraph.updates if update.is_updated_geometry}
    meshes = {one.user if isinstance(one, bpy.types.Key) else one for one in found}
    return {one for one in meshes if isinstance(one, bpy.types.Mesh) and one.is_editmode}


def _in_edit_mode() -> list[bpy.types.Object]:
    """Return the meshes that are edited, each once, the active one first."""
    objects = [obj for obj in bpy.context.objects_in_mode_unique_data if obj.type == "MESH"]
    active = bpy.context.active_object
    return sorted(objects, key=lambda obj: obj != active)


edited = EditedObjects()
"""The edited objects of this Blender."""
