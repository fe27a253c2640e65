# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: events, and lists of seeds, turned into calls of one session."""

from __future__ import annotations

import time
import traceback
from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

from . import keymap, lazy, native, ui
from .keymap import Action

if TYPE_CHECKING:
    from collections.abc import Callable

    from . import edit_mesh, overlay, picking, session
    from .session import Along, LiveWire, Pick, Session
else:
    edit_mesh, overlay, picking, session = map(lazy.Part, ("edit_mesh", "overlay", "picking", "session"))

_TICK = 0.05
"""Seconds between two looks at running work: redraws stay below what the eye takes for a stop."""

_ALONG_ITEMS = (
    ("EDGES", "Along Edges", "Wires are chains of the mesh's edges"),
    ("SURFACE", "Across Surface", "Wires cross faces, and the chain of edges nearest to them is marked"),
)


_STRENGTH = {
    "EDGES": {"max_anisotropy": 10.0, "clamp_percentile": 99.0},
    "SURFACE": {"max_anisotropy": 20.0, "clamp_percentile": 99.0},
}
"""How strongly wires are drawn to features; docs/method.md says why."""


def live_maker(arrays: edit_mesh.Arrays) -> Callable[[Along], LiveWire]:
    """Return what makes the live wires on a mesh for one way of running."""
    core = native.load()
    surface = core.Surface(arrays.points, arrays.triangles, arrays.edges)
    return lambda along: core.LiveWire(surface, along=along.lower(), **_STRENGTH[along])


def _in_edit_mode(context: bpy.types.Context) -> bool:
    obj = context.active_object
    return context.mode == "EDIT_MESH" and obj is not None and obj.type == "MESH"


def _bystanders(context: bpy.types.Context) -> int:
    return sum(obj.data != context.active_object.data for obj in context.objects_in_mode_unique_data)


def _summary(drawing: Session, new: int) -> str:
    wires, edges = len(drawing.wires), len(drawing.edges())
    already = f", {edges - new} were seams already" if edges > new else ""
    return f"{_count(wires, 'wire')}, {_count(new, 'edge')} marked{already}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _only_active(context: bpy.types.Context) -> str:
    others = _bystanders(context)
    if not others:
        return ""
    return f"Only '{context.active_object.name}' is drawn on, not the {_count(others, 'other object')} in edit mode"


class MESH_OT_seamwire_mark(bpy.types.Operator):
    """Mark the seams of wires between given vertices or edges"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_mark"
    bl_label = "Mark Seamwires"
    bl_options = {"REGISTER", "UNDO"}

    chains: bpy.props.StringProperty(
        name="Chains",
        description="Chains of seeds: vertex numbers, or edges as two numbers with a hyphen; semicolons between chains",
    )
    along: bpy.props.EnumProperty(name="Along", description="Where wires run", items=_ALONG_ITEMS, default="EDGES")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return _in_edit_mode(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Draw the chains, and mark what they run along."""
        try:
            chains = session.parse_chains(self.chains)
            cage = edit_mesh.Cage(context.active_object)
            problem = cage.problem_with(pick for chain in chains for pick in chain)
            if problem:
                raise ValueError(problem)
            if self.along == "SURFACE" and any(isinstance(pick, tuple) for chain in chains for pick in chain):
                raise ValueError("Across the surface seeds are vertices: give vertex numbers, not edges")
            arrays = edit_mesh.read(context.active_object)
            drawing = session.Session(live_maker(arrays), arrays.points, self.along)
            problems = session.draw_chains(drawing, chains)
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for problem in problems:
            self.report({"WARNING"}, problem)
        if not drawing.wires:
            self.report({"ERROR"}, f"No seam was marked. {problems[0]}" if problems else "No seam was marked")
            return {"CANCELLED"}
        only = _only_active(context)
        if only:
            self.report({"INFO"}, only)
        self.report({"INFO"}, _summary(drawing, cage.mark_seams(drawing.edges())))
        return {"FINISHED"}


class Drawing:
    """A session in a window: its handles, and what has to be put back when it ends.

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
        self._obj = context.active_object
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""
        self._clicks = keymap.DoubleClicks()
        self._shown: tuple[int, int, bool] | None = None
        self.notes = tuple(
            note
            for note in (
                _only_active(context),
                "Works on the mesh without its modifiers" if self._obj.modifiers else "",
            )
            if note
        )
        self.cage = edit_mesh.Cage(self._obj)
        arrays = edit_mesh.read(self._obj)
        self.session = session.Session(live_maker(arrays), arrays.points, along)
        size = (arrays.points.max(axis=0) - arrays.points.min(axis=0)).max()
        self._picker = picking.Picker(self.cage.bm, float(size))
        self._ending = ExitStack()
        try:
            self._overlay = overlay.Overlay(self.session, self._obj, arrays.points, arrays.to_object)
            self._ending.callback(self._redraw)
            self._ending.callback(self._overlay.remove)
            self._ending.callback(self._set_timer, False)
            self._ending.callback(self._set_cursor, "")
            self._ending.callback(self._workspace.status_text_set, None)
            bpy.app.handlers.load_pre.append(self._on_load)
            self._ending.callback(self._forget_load)
            _running.append(self)
            self._ending.callback(_running.remove, self)
            self.refresh()
        except BaseException:
            self.close()
            raise

    @property
    def open(self) -> bool:
        """Whether it has not been closed."""
        return self in _running

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
        if obj is None or obj.data != self.cage.mesh:
            return "Another object became the active one"
        if not self.cage.intact():
            return "The mesh was changed"
        if self._overlay.error is not None:
            raise self._overlay.error
        return ""

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
        inside = self._view_at(event.mouse_x, event.mouse_y)
        self._set_cursor("CROSSHAIR" if inside else "")
        double = event.type == "LEFTMOUSE" and self._clicks.is_second(
            event, time.monotonic(), context.preferences.inputs
        )
        action = keymap.action_of(event, double)
        if inside is None:
            if keymap.is_blender_undo(event):
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
        """Whether the wheel toggles: over the mesh while a wire is live. Elsewhere it zooms."""
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
        else:
            self._click(action, self._pick(inside, event))

    def _click(self, action: Action, pick: Pick | None) -> None:
        drawing = self.session
        if pick is None:
            return
        if action is Action.START_CHAIN:
            drawing.start(pick)
            drawing.hover(pick)
        elif action is Action.LOOP and drawing.along == "EDGES" and isinstance(pick, tuple):
            drawing.loop(pick)
        else:
            drawing.click(pick)

    def _hover(self, inside: _Inside, event: bpy.types.Event) -> None:
        self.session.hover(self._pick(inside, event), loop=event.alt)
        self.refresh()

    def _pick(self, inside: _Inside, event: bpy.types.Event) -> Pick | None:
        region, view = inside
        cursor = (event.mouse_x - region.x + 0.5, event.mouse_y - region.y + 0.5)
        return self._picker.pick(view, self._obj.matrix_world, cursor, self.session.along == "SURFACE")

    def _view_at(self, x: int, y: int) -> _Inside | None:
        """Return the 3D view under the mouse, where no toolbar, sidebar or header lies over it."""
        for area in self._window.screen.areas:
            if area.type != "VIEW_3D" or not _contains(area, x, y):
                continue
            under = [region for region in area.regions if region.width > 1 and _contains(region, x, y)]
            if any(region.type != "WINDOW" for region in under):
                return None
            for region in under:
                return region, picking.View.of(region, _region_3d(area, region))
        return None

    # What is seen

    def refresh(self) -> None:
        """Show the session as it is now."""
        drawing = self.session
        self._set_timer(drawing.computing or drawing.waiting_clicks > 0)
        before, self._shown = self._shown, (drawing.revision, round(100.0 * drawing.progress), drawing.computing)
        if self._shown != before:
            self._workspace.status_text_set(ui.status_drawer(drawing, self.notes))
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


_Inside = "tuple[bpy.types.Region, picking.View]"

_running: list[Drawing] = []
"""The drawings going on, so that unregistering the add-on can end them."""


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


class MESH_OT_seamwire_draw(bpy.types.Operator):
    """Draw seams with live wires that follow the shape of the mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_draw"
    bl_label = "Draw Seamwires"
    bl_options = {"UNDO"}

    along: bpy.props.EnumProperty(
        name="Along", description="Where wires run at first", items=_ALONG_ITEMS, default="EDGES"
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode, and no drawing going on."""
        return _in_edit_mode(context) and not _running

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Start drawing."""
        if context.area is None or context.area.type != "VIEW_3D":
            self.report({"ERROR"}, "Seams are drawn in a 3D view: start the tool there")
            return {"CANCELLED"}
        try:
            self._drawing = Drawing(context, self.along)
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for note in self._drawing.notes:
            self.report({"INFO"}, note)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Pass an event on to the drawing, and end it where that is due."""
        drawing = self._drawing
        if not drawing.open:
            return {"CANCELLED"}
        try:
            trouble = drawing.trouble(context)
            if trouble:
                drawing.close()
                self.report({"WARNING"}, f"{trouble} while seams were drawn: nothing was marked")
                return {"CANCELLED", "PASS_THROUGH"}
            result = drawing.handle(context, event)
            if result & {"FINISHED", "CANCELLED"}:
                drawing.close()
            return self._finish(drawing) if "FINISHED" in result else result
        except Exception as error:
            drawing.close()
            traceback.print_exc()
            self.report({"ERROR"}, f"Drawing seams ended on an error, and nothing was marked: {error}")
            return {"CANCELLED"}

    def _finish(self, drawing: Drawing) -> set[str]:
        if not drawing.session.wires:
            self.report({"INFO"}, "No wire was kept, and nothing marked")
            return {"CANCELLED"}
        new = drawing.cage.mark_seams(drawing.session.edges())
        self.report({"INFO"}, _summary(drawing.session, new))
        # Without a change there is to be no step of undo either.
        return {"FINISHED"} if new else {"CANCELLED"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """End drawing when Blender takes the operator away."""
        self._drawing.close()


_CLASSES = (MESH_OT_seamwire_mark, MESH_OT_seamwire_draw)


def register() -> None:
    """Add the operators."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """End what is being drawn, and remove the operators."""
    for drawing in tuple(_running):
        drawing.close()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
