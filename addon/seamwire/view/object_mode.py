# SPDX-License-Identifier: GPL-3.0-or-later
"""What the metric sees of the active object in Object Mode."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

import bpy
from mathutils import Matrix

from ..core.base import native
from ..core.solver.defaults import PLACED
from ..mesh import edit_mesh
from ..mesh import settings as chosen
from ..mesh.auto import auto_for
from ..mesh.redraw import redraw_views
from . import legend
from .failures import failures
from .gpu_draw import Eye, blended
from .legend import Legend
from .metric_views import MetricViews
from .overlay import free_room
from .timer import Timer

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.base.mesh_arrays import Arrays
    from ..core.network.picks import Along

_RHYTHM = 0.05
"""Seconds between two looks at running work."""
_IDLE = 0.25
"""Seconds between two looks at what is active."""
_FOLLOWING, _DRAWING = ("object mode", "follow"), ("object mode", "draw")
"""The parts that can fail."""
_PAUSE = 0.3
"""Seconds after which a mesh that has changed is read anew: while it is being changed, it changes all the time."""


class _Shown:
    """The arrays of the active object."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self.problem = ""
        self.arrays: Arrays | None = None
        self.auto = PLACED
        self.views: MetricViews | None = None
        try:
            core = native.load()
            self.arrays, selected = edit_mesh.read_evaluated(obj)
        except (ValueError, native.NativeError) as error:
            self.problem = str(error)
            return
        # Where all are selected, as new meshes are, none was chosen.
        self.source = int(selected.argmax()) if selected.any() and not selected.all() else None
        arrays = self.arrays
        self.auto = auto_for(obj, arrays)
        self.views = MetricViews(arrays, core, lambda: core.Surface(arrays.points, arrays.triangles, arrays.edges))

    def close(self) -> None:
        if self.views is not None:
            self.views.close()


class ObjectModeViews:
    """Draws while the setting asks for it; reads the active object when that or its mesh has changed."""

    def __init__(self) -> None:
        self._shown: _Shown | None = None
        self._active: tuple[str, str] | None = None
        self._handles: list[object] = []
        self._changed = 0.0
        self._stale = False
        self._timer = Timer(self.tick, persistent=True)

    def start(self) -> None:
        """Begin; to be called again does no harm."""
        if self._handles or bpy.app.background:
            return
        add = bpy.types.SpaceView3D.draw_handler_add
        self._handles = [
            add(self._draw, (self._draw_in_scene,), "WINDOW", "POST_VIEW"),
            add(self._draw, (self._draw_on_screen,), "WINDOW", "POST_PIXEL"),
        ]
        for name in _EVENTS:
            getattr(bpy.app.handlers, name).append(_on_change)
        self._timer.start()

    def stop(self) -> None:
        """End, and forget what was read."""
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        for name in _EVENTS:
            if _on_change in getattr(bpy.app.handlers, name):
                getattr(bpy.app.handlers, name).remove(_on_change)
        self._timer.stop()
        self._forget()

    @property
    def views(self) -> MetricViews | None:
        """The views of the active object, or None."""
        return None if self._shown is None else self._shown.views

    def on_change(self, depsgraph: bpy.types.Depsgraph | None = None) -> None:
        """Take note of a change of meshes; without a depsgraph: of all of them."""
        if self._active is None:
            return
        if depsgraph is None or any(
            update.is_updated_geometry and update.id.name_full in self._active for update in depsgraph.updates
        ):
            self._stale, self._changed = True, time.monotonic()

    def _forget(self) -> None:
        if self._shown is not None:
            self._shown.close()
        self._shown, self._active, self._stale = None, None, False
        failures.take("object mode")  # another object or mesh is another try

    def tick(self) -> float | None:
        """Follow what is active; return the seconds until the next time, None if nothing is to be shown any more."""
        if not chosen.settings().views_in_object_mode:
            self.stop()
            redraw_views()
            return None
        obj = _active()
        names = None if obj is None else _names(obj)
        if names != self._active or (self._stale and time.monotonic() - self._changed > _PAUSE):
            self._forget()
            self._active = names
        if obj is None:
            return _IDLE
        return failures.attempt(_FOLLOWING, partial(self._follow, obj)) or _IDLE

    def _follow(self, obj: bpy.types.Object) -> float:
        """Show the views of an object, and return the seconds until the next time."""
        if self._shown is None:
            self._shown = _Shown(obj)
            redraw_views()
        views = self._shown.views
        if views is None:
            return _IDLE
        views.follow(chosen.snapshot(chosen.settings(), auto=self._shown.auto), self._shown.source)
        if views.poll():
            redraw_views()
        return _RHYTHM if views.busy else _IDLE

    @property
    def best_along(self) -> Along:
        """How wires run on the active object if its mesh decides: along edges as long as it is not read."""
        return PLACED.along if self._shown is None else self._shown.auto.along

    def _draw(self, part: Callable[[bpy.types.Object], None]) -> None:
        context = bpy.context
        obj = _active()
        if obj is None or self._shown is None or _names(obj) != self._active or self._stale:
            return
        if context.space_data.overlay.show_overlays and obj.visible_in_viewport_get(context.space_data):
            failures.attempt(_DRAWING, partial(part, obj))

    def _draw_in_scene(self, obj: bpy.types.Object) -> None:
        if self._shown.views is None:
            return
        to_object = Matrix(self._shown.arrays.to_object.tolist()).to_4x4()
        eye = Eye(bpy.context.region_data, obj.matrix_world @ to_object)
        if self._shown.views.has_heat:
            self._shown.views.draw_heat(eye)
        self._shown.views.draw_lines(eye)

    def _draw_on_screen(self, _obj: bpy.types.Object) -> None:
        views = self._shown.views
        legends = [Legend((self._shown.problem,))] if views is None else views.legends()
        with blended("NONE"):
            room = free_room(bpy.context.area, bpy.context.region)
            legend.draw(legends, room, bpy.context.preferences.system.ui_scale)


def _names(obj: bpy.types.Object) -> tuple[str, str]:
    return obj.name_full, obj.data.name_full


def _active() -> bpy.types.Object | None:
    """Return the active mesh object of Object Mode."""
    context = bpy.context
    layer = context.view_layer
    obj = None if layer is None else layer.objects.active
    return obj if obj is not None and obj.type == "MESH" and obj.mode == "OBJECT" else None


object_mode = ObjectModeViews()
"""The views in this Blender."""


@bpy.app.handlers.persistent
def _on_change(_scene: bpy.types.Scene | None = None, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    object_mode.on_change(depsgraph)


_EVENTS = ("depsgraph_update_post", "undo_post", "redo_post", "load_post")
