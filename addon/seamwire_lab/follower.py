# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the views: in Edit Mode as a layer of the tool, in Object Mode over the active object.

Until the first view is switched on, NumPy is not imported.
"""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

import bpy
from mathutils import Matrix

from . import tool
from .lab_settings import is_any_shown, listeners

if TYPE_CHECKING:
    from collections.abc import Callable

    import seamwire_core

    from .tool import Arrays, Pose
    from .views import Views

_RHYTHM = 0.05
"""Seconds between two looks at running work."""
_IDLE = 0.25
"""Seconds between two looks at what is active."""
_PAUSE = 0.3
"""Seconds after which a changed mesh is read again. A mesh that is being changed changes all the time."""


class _ActiveViews:
    """The views of the active object of Object Mode, or the reason why it has none."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self.problem = ""
        self.views: Views | None = None
        self.along = "EDGES"
        try:
            core = tool.load()
            arrays, selected = tool.read_evaluated(obj)
        except (ValueError, ImportError) as error:
            self.problem = str(error)
            return
        # If all vertices are selected, as in new meshes, nobody has chosen one.
        self.source = int(selected.argmax()) if selected.any() and not selected.all() else None
        self.to_object = Matrix(arrays.to_object.tolist()).to_4x4()
        self.auto = tool.auto_for(obj, arrays)
        self.views = _views(
            arrays, lambda: core.Surface(arrays.points, arrays.triangles, arrays.edges), tool.Pose(arrays)
        )

    def follow(self) -> None:
        """Follow the settings."""
        options = tool.snapshot(tool.settings(), auto=self.auto)
        self.along = options.along
        self.views.follow(options, self.source)

    def attempt(self, do: Callable[[], None]) -> None:
        """Call a function. If it fails, show why in place of the views, until another mesh is shown."""
        if self.problem:
            return
        try:
            do()
        except Exception as error:
            self.problem = f"{type(error).__name__}: {error}"
            sys.excepthook(type(error), error, error.__traceback__)

    def close(self) -> None:
        """End all computations."""
        if self.views is not None:
            self.views.close()


class Follower:
    """Lets the tool draw the views in Edit Mode, and draws them itself in Object Mode."""

    def __init__(self) -> None:
        self._has_layer = False
        self._shown: _ActiveViews | None = None
        self._active: tuple[str, str] | None = None
        self._handles: list[object] = []
        self._changed = 0.0
        self._is_stale = False
        self._told = ""

    def start(self) -> None:
        """Show the views, if they are not shown yet."""
        if self._handles:
            return
        add = bpy.types.SpaceView3D.draw_handler_add
        self._handles = [
            add(self._draw, (self._draw_in_scene,), "WINDOW", "POST_VIEW"),
            add(self._draw, (self._draw_on_screen,), "WINDOW", "POST_PIXEL"),
        ]
        for name in _EVENTS:
            getattr(bpy.app.handlers, name).append(_on_change)
        bpy.app.timers.register(_tick, persistent=True)

    def stop(self) -> None:
        """Show nothing in Object Mode, and forget what was read."""
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        for name in _EVENTS:
            if _on_change in getattr(bpy.app.handlers, name):
                getattr(bpy.app.handlers, name).remove(_on_change)
        if bpy.app.timers.is_registered(_tick):
            bpy.app.timers.unregister(_tick)
        self._forget()
        _redraw()

    def leave(self) -> None:
        """Show nothing anywhere."""
        self.stop()
        if self._has_layer:
            tool.remove_layer(_views)
        self._has_layer = False

    @property
    def views(self) -> Views | None:
        """The views of the active object of Object Mode, or None."""
        return None if self._shown is None else self._shown.views

    @property
    def problem(self) -> str:
        """Why the active object of Object Mode has no views, or nothing."""
        return "" if self._shown is None else self._shown.problem

    @property
    def along(self) -> str:
        """How wires run on the active object of Object Mode."""
        return "EDGES" if self._shown is None else self._shown.along

    def on_change(self, depsgraph: bpy.types.Depsgraph | None) -> None:
        """Note that meshes have changed: those that a depsgraph names, or all."""
        if depsgraph is None or any(
            update.is_updated_geometry and update.id.name_full in (self._active or ()) for update in depsgraph.updates
        ):
            self._is_stale, self._changed = True, time.monotonic()

    def on_settings(self) -> None:
        """Follow changed settings."""
        if is_any_shown() and not bpy.app.background:
            self.start()
        if self._has_layer:
            tool.tell_listeners()

    def tick(self) -> float | None:
        """Follow what is active. Return the seconds until the next call, or None if no view is switched on.

        Blender ends a timer that raises. An error is told of once, and the next call tries again.
        """
        try:
            return self._advance()
        except Exception as error:
            text = f"{type(error).__name__}: {error}"
            if text != self._told:
                sys.excepthook(type(error), error, error.__traceback__)
            self._told = text
            return _IDLE

    def _advance(self) -> float | None:
        if not is_any_shown():
            self.stop()
            return None
        if not self._has_layer:
            # It stays, and keeps what it has computed.
            tool.add_layer(_views)
            self._has_layer = True
        obj = _active()
        names = None if obj is None else _names(obj)
        if names != self._active or (self._is_stale and time.monotonic() - self._changed > _PAUSE):
            self._forget()
            self._active = names
        if obj is None:
            return _IDLE
        if self._shown is None:
            self._shown = _ActiveViews(obj)
            _redraw()
        self._shown.attempt(self._follow)
        return _RHYTHM if self.views is not None and self.views.busy else _IDLE

    def _follow(self) -> None:
        self._shown.follow()
        if self._shown.views.poll():
            _redraw()

    def _forget(self) -> None:
        if self._shown is not None:
            self._shown.close()
        self._shown, self._active, self._is_stale = None, None, False

    def _draw(self, part: Callable[[bpy.types.Object], None]) -> None:
        context, obj = bpy.context, _active()
        if obj is None or self._shown is None or _names(obj) != self._active or self._is_stale:
            return
        if context.space_data is None:
            return  # another add-on draws the view into a picture
        if context.space_data.overlay.show_overlays and obj.visible_in_viewport_get(context.space_data):
            part(obj)

    def _draw_in_scene(self, obj: bpy.types.Object) -> None:
        def draw() -> None:
            eye = tool.Eye(bpy.context.region_data, obj.matrix_world @ self._shown.to_object)
            self.views.draw_heat(eye)
            self.views.draw_lines(eye)

        self._shown.attempt(draw)

    def _draw_on_screen(self, _obj: bpy.types.Object) -> None:
        legends = [tool.Legend((self.problem,))] if self.problem else self.views.legends()
        with tool.blended("NONE"):
            room = tool.free_room(bpy.context.area, bpy.context.region)
            tool.draw_legends(legends, room, bpy.context.preferences.system.ui_scale)


def _views(arrays: Arrays, surface: Callable[[], seamwire_core.Surface], pose: Pose) -> Views:
    """Make the views of a mesh. Imported only now, so that Blender's start does not wait for NumPy."""
    from .views import Views

    return Views(arrays, surface, pose)


def _names(obj: bpy.types.Object) -> tuple[str, str]:
    return obj.name_full, obj.data.name_full


def _active() -> bpy.types.Object | None:
    """Return the active mesh object of Object Mode."""
    layer = bpy.context.view_layer
    obj = None if layer is None else layer.objects.active
    return obj if obj is not None and obj.type == "MESH" and obj.mode == "OBJECT" else None


def _redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


follower = Follower()
"""The views in this Blender."""
_EVENTS = ("depsgraph_update_post", "undo_post", "redo_post", "load_post")


@bpy.app.handlers.persistent
def _on_change(_scene: bpy.types.Scene | None = None, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    follower.on_change(depsgraph)


def _tick() -> float | None:
    return follower.tick()


def register() -> None:
    """Follow the settings."""
    listeners.append(follower.on_settings)


def unregister() -> None:
    """Follow them no longer."""
    listeners.remove(follower.on_settings)
    follower.leave()
