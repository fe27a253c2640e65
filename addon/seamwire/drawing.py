# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing that goes on in a window: events turned into calls of sessions, and all that has to be put back at the end."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

from . import keymap, lazy, native, preferences, ui
from .keymap import Action

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from . import edit_mesh, overlay, picking, session
    from .live import LiveWire
    from .network import Along, Pick
    from .session import Session
    from .tool import SeamwireSettings
else:
    edit_mesh, overlay, picking, session = map(lazy.Part, ("edit_mesh", "overlay", "picking", "session"))

_TICK = 0.05
"""Seconds between two looks at running work: redraws stay below what the eye takes for a stop."""

_Inside = "tuple[bpy.types.Area, bpy.types.Region, picking.View]"

running: list[Drawing] = []
"""The drawings going on, so that unregistering the add-on can end them."""


def live_maker(arrays: edit_mesh.Arrays) -> Callable[[Along], LiveWire]:
    """Return what makes the live wires on a mesh for one way of running."""
    core = native.load()
    surface = core.Surface(arrays.points, arrays.triangles, arrays.edges)
    return lambda along: core.LiveWire(
        surface,
        along=along.lower(),
        max_anisotropy=session.STRENGTHS[along],
        clamp_percentile=session.CLAMP_PERCENTILE,
    )


def count(number: int, what: str) -> str:
    """Return a number with what it counts."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def settings_changed(settings: SeamwireSettings) -> None:
    """Let the running drawing follow its settings."""
    for drawing in running:
        drawing.follow(settings)


class Board:
    """One object that is drawn on.

    Parameters
    ----------
    obj
        A mesh object in edit mode.
    along
        Where wires run at first.
    """

    def __init__(self, obj: bpy.types.Object, along: Along) -> None:
        self.obj = obj
        self.cage = edit_mesh.Cage(obj)
        arrays = edit_mesh.read(obj)
        self.session = session.Session(live_maker(arrays), arrays.points, along)
        size = (arrays.points.max(axis=0) - arrays.points.min(axis=0)).max()
        self._picker = picking.Picker(self.cage.bm, float(size))
        self.overlay = overlay.Overlay(self.session, obj, arrays.points, arrays.to_object)

    def pick(self, view: picking.View, cursor: tuple[float, float]) -> Pick | None:
        """Return what of the mesh is under the cursor."""
        return self._picker.pick(view, self.obj.matrix_world, cursor, self.session.along == "SURFACE")


class Drawing:
    """A drawing in a window: its sessions and handles, and what has to be put back when it ends.

    Parameters
    ----------
    context
        With the 3D view to draw in, and the active object in edit mode.
    along
        Where wires run at first.
    """

    def __init__(self, context: bpy.types.Context, along: Along) -> None:
        self._window = context.window
        self._workspace = context.workspace
        self._manager = context.window_manager
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""
        self._clicks = keymap.DoubleClicks()
        self._shown: tuple[object, ...] | None = None
        self.keys = keymap.Bindings.of_user(self._manager)
        obj = context.active_object
        self.notes = tuple(
            note
            for note in (
                only_active(context),
                "Works on the mesh without its modifiers" if obj.modifiers else "",
            )
            if note
        )
        self.board = Board(obj, along)
        self._ending = ExitStack()
        try:
            self._ending.callback(self._redraw)
            self._ending.callback(self.board.overlay.remove)
            self._ending.callback(self._set_timer, False)
            self._ending.callback(self._set_cursor, "")
            self._ending.callback(self._workspace.status_text_set, None)
            bpy.app.handlers.load_pre.append(self._on_load)
            self._ending.callback(self._forget_load)
            running.append(self)
            self._ending.callback(running.remove, self)
            self.refresh()
        except BaseException:
            self.close()
            raise

    @property
    def session(self) -> Session:
        """The session of the object that is drawn on."""
        return self.board.session

    @property
    def open(self) -> bool:
        """Whether it has not been closed."""
        return self in running

    def close(self) -> None:
        """Put everything back; more than once does no harm."""
        self._ending.close()

    def _on_load(self, *_: object) -> None:
        self.close()

    def _forget_load(self) -> None:
        bpy.app.handlers.load_pre.remove(self._on_load)

    # What can happen from outside

    def trouble(self, context: bpy.types.Context) -> str:
        """Say why drawing cannot go on; an empty string where it can. Raises what the overlay could not draw."""
        if context.mode != "EDIT_MESH":
            return "Edit mode was left"
        obj = context.active_object
        if obj is None or obj.data != self.board.cage.mesh:
            return "Another object became the active one"
        if not self.board.cage.intact():
            return "The mesh was changed"
        if self.board.overlay.error is not None:
            raise self.board.overlay.error
        return ""

    def follow(self, settings: SeamwireSettings) -> None:
        """Take over settings that were changed in the tool's header."""
        self.session.switch(settings.along)
        self.refresh()

    # Events

    def handle(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Do what an event asks for.

        Returns
        -------
        set of str
            What modal() returns; FINISHED and CANCELLED ask the operator to end the drawing in that way.
        """
        if event.type == "TIMER":
            self.session.poll()
            self.refresh()
            return {"PASS_THROUGH"}
        inputs = context.preferences.inputs
        inside = self._view_at(event.mouse_x, event.mouse_y)
        self._set_cursor("CROSSHAIR" if inside else "")
        double = self._clicks.is_second(event, time.monotonic(), inputs)
        if inside is None:
            if self.keys.is_blender_undo(event):
                return {"RUNNING_MODAL"}
            if event.type == "MOUSEMOVE" and self.session.target is not None:
                self.session.hover(None)
                self.refresh()
            return {"PASS_THROUGH"}
        if event.type in {"INBETWEEN_MOUSEMOVE", "WINDOW_DEACTIVATE"} or event.type.startswith("TIMER"):
            return {"PASS_THROUGH"}
        if event.type == "MOUSEMOVE" or event.type.endswith(("_ALT", "_CTRL", "_SHIFT")):
            self._hover(inside, event)
            return {"PASS_THROUGH" if event.type == "MOUSEMOVE" else "RUNNING_MODAL"}
        if keymap.emulates_middle_button(event, inputs):
            return {"PASS_THROUGH"}
        action = self.keys.action_of(event, double)
        if action is Action.FINISH:
            return {"FINISHED"}
        if action is Action.LEAVE:
            return {"CANCELLED"}
        if action is not None and not (action is Action.TOGGLE and not self._toggles(inside, event)):
            self._do(action, inside, event)
            self.refresh()
            return {"RUNNING_MODAL"}
        return {"PASS_THROUGH"} if keymap.is_navigation(event) else {"RUNNING_MODAL"}

    def _toggles(self, inside: _Inside, event: bpy.types.Event) -> bool:
        """Whether toggling is meant: the wheel zooms but over the mesh while a wire is live."""
        if not event.type.startswith("WHEEL"):
            return True
        own = preferences.get()
        if own is not None and own.always_zoom:
            return False
        return self.session.active is not None and self._pick(inside, event) is not None

    def _do(self, action: Action, inside: _Inside, event: bpy.types.Event) -> None:
        drawing = self.session
        if action is Action.END_CHAIN:
            drawing.end_chain()
        elif action is Action.TOGGLE:
            drawing.toggle()
        elif action is Action.UNDO:
            drawing.undo()
        elif action is Action.REDO:
            drawing.redo()
        elif action is Action.SWITCH:
            if drawing.switch("SURFACE" if drawing.along == "EDGES" else "EDGES"):
                self._hover(inside, event)
        elif action in {Action.ZOOM_IN, Action.ZOOM_OUT}:
            self._zoom(inside, 1 if action is Action.ZOOM_IN else -1)
        elif action in {Action.CLICK, Action.NEW_CHAIN, Action.LOOP}:
            self._click(action, self._pick(inside, event))

    def click_at(self, event: bpy.types.Event, first: str) -> None:
        """Do the click that started the tool."""
        inside = self._view_at(event.mouse_x, event.mouse_y)
        if inside is not None:
            self._click(Action.LOOP if first == "LOOP" else Action.CLICK, self._pick(inside, event))
            self.refresh()

    def _click(self, action: Action, pick: Pick | None) -> None:
        drawing = self.session
        if pick is None:
            return
        if action is Action.NEW_CHAIN:
            drawing.start(pick)
            drawing.hover(pick)
        elif action is Action.LOOP and drawing.along == "EDGES" and isinstance(pick, tuple):
            drawing.loop(pick)
        else:
            drawing.click(pick)

    def _zoom(self, inside: _Inside, delta: int) -> None:
        area, region, _ = inside
        with bpy.context.temp_override(window=self._window, area=area, region=region):
            bpy.ops.view3d.zoom("INVOKE_DEFAULT", delta=delta, use_cursor_init=True)

    def _hover(self, inside: _Inside, event: bpy.types.Event) -> None:
        self.session.hover(self._pick(inside, event), loop=self.keys.previews_loop(event))
        self.refresh()

    def _pick(self, inside: _Inside, event: bpy.types.Event) -> Pick | None:
        _, region, view = inside
        cursor = (event.mouse_x - region.x + 0.5, event.mouse_y - region.y + 0.5)
        return self.board.pick(view, cursor)

    def _view_at(self, x: int, y: int) -> _Inside | None:
        """Return the 3D view under the mouse, where no toolbar, sidebar or header lies over it."""
        for area in self._window.screen.areas:
            if area.type != "VIEW_3D" or not _contains(area, x, y):
                continue
            under = [region for region in area.regions if region.width > 1 and _contains(region, x, y)]
            if any(region.type != "WINDOW" for region in under):
                return None
            for region in under:
                return area, region, picking.View.of(region, _region_3d(area, region))
        return None

    # What is seen

    def refresh(self) -> None:
        """Show the session as it is now."""
        drawing = self.session
        self._set_timer(drawing.computing or drawing.waiting_clicks > 0)
        before, self._shown = self._shown, (drawing.revision, round(100.0 * drawing.progress), drawing.computing)
        if self._shown != before:
            self._workspace.status_text_set(ui.status_drawer(drawing, self.keys, self.notes))
        if before is None or self._shown[0] != before[0]:
            self._redraw()

    def _redraw(self) -> None:
        for window in self._manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()

    def _set_timer(self, wanted: bool) -> None:
        if wanted and self._timer is None:
            self._timer = self._manager.event_timer_add(_TICK, window=self._window)
        elif not wanted and self._timer is not None:
            timer, self._timer = self._timer, None
            self._manager.event_timer_remove(timer)

    def _set_cursor(self, shape: str) -> None:
        if shape == self._cursor:
            return
        self._cursor = shape
        if shape:
            self._window.cursor_modal_set(shape)
        else:
            self._window.cursor_modal_restore()


def only_active(context: bpy.types.Context) -> str:
    """Say which objects in edit mode are not drawn on; an empty string where there is none."""
    others = sum(obj.data != context.active_object.data for obj in context.objects_in_mode_unique_data)
    if not others:
        return ""
    return f"Only '{context.active_object.name}' is drawn on, not the {count(others, 'other object')} in edit mode"


def close_all(drawings: Iterable[Drawing] = ()) -> None:
    """End all drawings."""
    for drawing in tuple(drawings or running):
        drawing.close()


def _contains(box: bpy.types.Area | bpy.types.Region, x: int, y: int) -> bool:
    return box.x <= x < box.x + box.width and box.y <= y < box.y + box.height


def _region_3d(area: bpy.types.Area, region: bpy.types.Region) -> bpy.types.RegionView3D:
    """Return what a window region of a 3D view shows; a quad view has four."""
    space = area.spaces.active
    quads = space.region_quadviews
    if not quads:
        return space.region_3d
    windows = [one for one in area.regions if one.type == "WINDOW"]
    return quads[windows.index(region)]
