# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing that goes on in a window: events turned into calls of sessions, and all that has to be put back at the end."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

from .. import lazy
from ..ui import keymap, preferences
from ..ui import menus as ui
from ..ui.keymap import Action
from ..view.places import Place, place_of
from .drag_handlers import Hold, SeedHold

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..core import network
    from ..core.session import Session
    from ..mesh import object_session as boards
    from ..mesh.object_session import Board
    from ..ui import toolbar as tool
    from . import stroke_handler as strokes
else:
    boards, network, strokes, tool = map(
        lazy.Part, ("mesh.object_session", "core.network", "operators.stroke_handler", "ui.toolbar")
    )

_TICK = 0.05
"""Seconds between two looks at running work: redraws stay below what the eye takes for a stop."""
_CLICKS = frozenset({Action.CLICK, Action.NEW_CHAIN, Action.LOOP})
_STROKES = frozenset({Action.ATTRACT, Action.REPEL})
_AXES = "XYZ"
_CHANGED = "The mesh was changed"

running: list[Drawing] = []
"""The drawings going on, so that unregistering the add-on can end them."""
_interrupted: dict[str, str] = {}
"""The networks, by the mesh's name, of drawings in this file that did not come to their end."""


class Drawing:
    """A drawing in a window: its boards and handles, and what has to be put back when it ends.

    Parameters
    ----------
    context
        With the 3D view to draw in, and the active object in edit mode.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        self._window = context.window
        self._workspace = context.workspace
        self._manager = context.window_manager
        self._settings = tool.settings(context)
        active = context.active_object
        others = [obj for obj in context.objects_in_mode_unique_data if obj.type == "MESH" and obj.data != active.data]
        # By the names they have now: an object that is renamed meanwhile stays the same one.
        self._objects = {obj.name: obj for obj in (active, *others)}
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""
        self._clicks = keymap.DoubleClicks()
        self._shown: tuple[object, ...] | None = None
        self._hold: Hold | None = None
        self._history: list[Board] = []
        self._undone: list[Board] = []
        self._finishing = False
        self._leaving = False
        self._help = False
        self._touched = False
        self.message = ""
        self.keys = keymap.Bindings.of_user(self._manager)
        self.boards: dict[str, Board] = {}
        self._ending = ExitStack()
        try:
            self._ending.callback(self._redraw)
            self._ending.callback(self._remove_overlays)
            self.board = self._board_of(active.name)
            self.notes = ("Works on the mesh without its modifiers",) if active.modifiers else ()
            self._ending.callback(self._set_timer, False)
            self._ending.callback(self._set_cursor, "")
            self._ending.callback(self._workspace.status_text_set, None)
            bpy.app.handlers.depsgraph_update_post.append(self._on_update)
            self._ending.callback(bpy.app.handlers.depsgraph_update_post.remove, self._on_update)
            running.append(self)
            self._ending.callback(running.remove, self)
            self.refresh()
        except BaseException:
            self.close()
            raise

    @property
    def session(self) -> Session:
        """The session of the object that was pointed at last."""
        return self.board.session

    @property
    def open(self) -> bool:
        """Whether it has not been closed."""
        return self in running

    @property
    def empty(self) -> bool:
        """Whether nothing was kept, and nothing that was kept before was dropped."""
        return not any(board.changes for board in self.boards.values())

    def close(self) -> None:
        """Put everything back; more than once does no harm."""
        self._ending.close()

    def _remove_overlays(self) -> None:
        for board in self.boards.values():
            board.remove()

    def _on_update(self, _scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        if not self._touched:
            self._touched = any(board.shows(update) for update in depsgraph.updates for board in self.boards.values())

    def _board_of(self, name: str) -> Board:
        if name not in self.boards:
            obj = self._objects[name]
            board = boards.Board(obj, self._settings, _interrupted.get(obj.data.name))
            self.boards[name] = board
            own = preferences.get()
            if board.offered is not None and own is not None and own.resume == "ALWAYS":
                self._resume(board)
        return self.boards[name]

    # What can happen from outside

    def trouble(self, context: bpy.types.Context, event: bpy.types.Event) -> str:
        """Say why drawing cannot go on; an empty string where it can. Raises what an overlay could not draw."""
        if context.mode != "EDIT_MESH":
            return "Edit mode was left"
        if context.workspace != self._workspace:
            return "Another workspace was opened"
        # Looking through the mesh takes its time: while another editor is at work on it, that can wait.
        if self._touched and place_of(self._window, event) is not None:
            self._look_through()
        for board in self.boards.values():
            if not board.intact():
                return _CHANGED
            if board.overlay.error is not None:
                raise board.overlay.error
        return ""

    def trouble_at_the_end(self) -> str:
        """Say why nothing can be marked; an empty string where it can."""
        if self._touched:
            self._look_through()
        return "" if all(board.intact(to_the_end=True) for board in self.boards.values()) else _CHANGED

    def _look_through(self) -> None:
        self._touched = False
        for board in self.boards.values():
            board.look_through()

    def set_aside(self) -> int:
        """Keep what was drawn for when the tool is started again; return how many wires that are."""
        wires = 0
        for board in self.boards.values():
            kept = board.to_set_aside()
            if kept is not None:
                _interrupted.update([kept])
                wires += len(board.session.wires)
        return wires

    def write(self) -> Iterator[tuple[Board, int, int]]:
        """Mark and clear what was drawn: on all objects or, where an edge is not there any more, on none.

        Yields
        ------
        tuple
            Each board, how many edges became seams, and how many ceased to be.
        """
        for board in self.boards.values():
            board.check()
        for board in self.boards.values():
            yield board, *board.write()
            if board.offered is None:
                _interrupted.pop(board.cage.mesh.name, None)

    def follow(self, settings: tool.SeamwireSettings) -> None:
        """Take over settings that were changed in the tool's header."""
        for board in self.boards.values():
            board.follow(settings)
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
            return self._tick()
        place = place_of(self._window, event)
        self._set_cursor("CROSSHAIR" if place else "")
        double = self._clicks.is_second(event, time.monotonic(), context.preferences)
        for board in self.boards.values():
            board.follow_mirror()
        if self._hold is not None and event.type == self._hold.button and event.value == "RELEASE":
            hold, self._hold = self._hold, None
            hold.release()
            if isinstance(hold, strokes.StrokeHold) and hold.missed:
                self.message = "Drag over the mesh to draw a stroke"
            if place is not None:
                self._rehover(place)
            return self._done()
        if place is None:
            if self.keys.is_blender_undo(event):
                return {"RUNNING_MODAL"}
            if event.type == "MOUSEMOVE" and self.session.target is not None and self._hold is None:
                self.session.hover(None)
                self.refresh()
            return {"PASS_THROUGH"}
        moves = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"} if isinstance(self._hold, strokes.StrokeHold) else {"MOUSEMOVE"}
        if self._hold is not None and event.type in moves:
            if not self._hold.move(place, keymap.drag_threshold(event, context.preferences)):
                self._hold = None
            return self._done()
        if event.type in {"INBETWEEN_MOUSEMOVE", "WINDOW_DEACTIVATE"} or event.type.startswith("TIMER"):
            return {"PASS_THROUGH"}
        if event.type == "MOUSEMOVE" or event.type.endswith(("_ALT", "_CTRL", "_SHIFT")):
            self._hover(place, event)
            return {"PASS_THROUGH" if event.type == "MOUSEMOVE" else "RUNNING_MODAL"}
        if keymap.emulates_middle_button(event, context.preferences.inputs):
            return {"PASS_THROUGH"}
        action = self.keys.action_of(event, double)
        if action is Action.TOGGLE and event.type.startswith("WHEEL") and not self._wheel_toggles(place, event):
            action = None
        if action is None:
            return {"PASS_THROUGH"} if self._is_blenders(event) else {"RUNNING_MODAL"}
        if getattr(event, "is_repeat", False) and action not in {Action.UNDO, Action.REDO}:
            return {"RUNNING_MODAL"}
        return self._act(action, place, event)

    def _act(self, action: Action, place: Place, event: bpy.types.Event) -> set[str]:
        leaving, self._leaving = self._leaving, False
        self._finishing = False
        self.message = ""
        if action is Action.FINISH:
            self._cancel_hold()
            self._finishing = any(board.session.waiting_clicks for board in self.boards.values())
            if not self._finishing:
                return {"FINISHED"}
            self.message = "Finishing as soon as the last wire is computed"
        elif action is Action.LEAVE:
            if self._leave(leaving):
                return {"CANCELLED"}
        elif action in _CLICKS:
            self._click(action, place, event)
        elif action in _STROKES:
            self._begin_stroke(action, place, event)
        else:
            self._do(action, place)
        return self._done()

    def _done(self) -> set[str]:
        for board in self.boards.values():
            if board.stepped():
                self._history.append(board)
                self._undone.clear()
        self.session_to_settings()
        self.refresh()
        return {"RUNNING_MODAL"}

    def _tick(self) -> set[str]:
        new = [board.poll() for board in self.boards.values()]
        if any(new):
            self._redraw()
        self._done()
        if self._finishing and not any(board.session.waiting_clicks for board in self.boards.values()):
            return {"FINISHED"}
        return {"PASS_THROUGH"}

    def _is_blenders(self, event: bpy.types.Event) -> bool:
        """Whether an event that means nothing here is to have the meaning that Blender gives it."""
        # Alt and the wheel change the frame, but not because the cursor slipped off an edge between two offers.
        wheel = event.alt and event.type.startswith("WHEEL")
        return self.session.target is None if wheel else keymap.is_navigation(event)

    def _wheel_toggles(self, place: Place, event: bpy.types.Event) -> bool:
        """Whether the wheel toggles: over the mesh while a wire is live, unless it is always to zoom, and between loops."""
        if self.keys.previews_loop(event):
            return self.session.loop_preview is not None
        own = preferences.get()
        if own is not None and own.always_zoom:
            return False
        return self.session.active is not None and self._find(place)[1] is not None

    # What keys and buttons do

    def _leave(self, again: bool) -> bool:
        """Let go of what is live, one after the other; return whether to leave."""
        if self._cancel_hold():
            return False
        drawing = self.session
        if drawing.stop_preview():
            return False
        if drawing.waiting_clicks or drawing.seed is not None:
            drawing.end_chain()
            return False
        if again or self.empty:
            return True
        self._leaving = True
        kept = ui.count(sum(len(board.session.wires) for board in self.boards.values()), "wire")
        self.message = (
            f"{self.keys.text(Action.LEAVE) or 'Again'} again: leave without the {kept} drawn. All else goes on"
        )
        return False

    def click_at(self, event: bpy.types.Event, first: str) -> None:
        """Do the click that started the tool."""
        place = place_of(self._window, event)
        if place is not None:
            action = Action[first]
            (self._begin_stroke if action in _STROKES else self._click)(action, place, event)
            self._done()

    def _click(self, action: Action, place: Place, event: bpy.types.Event) -> None:
        board, snap = self._find(place, plain=action is Action.LOOP)
        if board is None or snap is None:
            return
        if board is not self.board:
            self.session.end_chain()
            self.session.hover(None)
            self.board = board
        drawing = board.session
        if action is Action.NEW_CHAIN:
            drawing.start(snap)
            drawing.hover(snap)
        elif action is Action.LOOP and drawing.along == "EDGES" and isinstance(snap.pick, tuple):
            drawing.loop(snap)
        elif drawing.seed is None and not drawing.waiting_clicks and snap.to in {"SEED", "WIRE"}:
            # Whether it is a click or the beginning of a drag is known when the button or the mouse has moved.
            drawing.hover(snap)
            self._hold = SeedHold(event.type, board, snap, place)
        else:
            drawing.click(snap)

    def _begin_stroke(self, action: Action, place: Place, event: bpy.types.Event) -> None:
        board, snap = self._find(place)
        board = board or self.board
        if self.session.seed is None and not self.session.waiting_clicks:
            self.board = board
        self._cancel_hold()
        wire = snap.wire if snap is not None and snap.to == "WIRE" and action is Action.ATTRACT else None
        scale = bpy.context.preferences.system.ui_scale
        self._hold = strokes.StrokeHold(event.type, board, place, action is Action.ATTRACT, wire, scale)

    def _cancel_hold(self) -> bool:
        hold, self._hold = self._hold, None
        dragged = hold is not None and hold.cancel()
        # What was released may wait still.
        return any([board.session.drag_cancel() for board in self.boards.values()]) or dragged or hold is not None

    def _do(self, action: Action, place: Place) -> None:
        drawing = self.session
        if action is Action.END_CHAIN:
            if not self._cancel_hold():
                drawing.end_chain()
        elif action is Action.TOGGLE:
            if drawing.seed is None and drawing.hovered_wire is not None:
                drawing.toggle_kept(drawing.hovered_wire)
            else:
                drawing.toggle()
        elif action is Action.DROP:
            self._drop(place)
        elif action is Action.ERASE:
            self._erase(place)
        elif action in {Action.STRONGER, Action.WEAKER}:
            self._change_strength(1 if action is Action.STRONGER else -1)
        elif action in {Action.ZOOM_IN, Action.ZOOM_OUT}:
            self._zoom(place, 1 if action is Action.ZOOM_IN else -1)
        elif action is Action.CLOSE:
            drawing.close()
        elif action is Action.RUN:
            drawing.run_to_end(preview=drawing.end_preview is None)
        elif action is Action.MARKING:
            for board in self.boards.values():
                board.session.toggle_marking()
        elif action is Action.XRAY:
            self._settings.xray = not self._settings.xray
        elif action is Action.SNAP:
            self._settings.snap = not self._settings.snap
            self._rehover(place)
        elif action is Action.SWITCH:
            if drawing.switch("SURFACE" if drawing.along == "EDGES" else "EDGES"):
                self._settings.along = drawing.along
                self._rehover(place)
        elif action is Action.MIRROR:
            self._cycle_mirror()
        elif action is Action.RESUME:
            self._resume(self.board)
        elif action is Action.HELP:
            self._help = not self._help
        elif action is Action.UNDO:
            self._undo()
        elif action is Action.REDO:
            self._redo()

    def _drop(self, place: Place) -> None:
        board, snap = self._find(place)
        wire = snap.wire if snap is not None and snap.to == "WIRE" else None
        if board is None or wire is None:
            self.message = "Point at a wire to drop it"
        else:
            self.board = board
            board.session.drop(wire)
            self._rehover(place)

    def _erase(self, place: Place) -> None:
        board = self._find(place)[0] or self.board
        stroke = board.stroke_at(place.view, place.cursor)
        if stroke is None:
            self.message = "Point at a stroke to remove it"
        else:
            board.session.erase(stroke)
            self._rehover(place)

    def _change_strength(self, steps: int) -> None:
        if self.session.change_strength(steps):
            self.message = f"Strength {self.session.strength:.3g}"

    def _cycle_mirror(self) -> None:
        drawing = self.session
        symmetric = self.board.symmetric_soon()
        if symmetric is None:
            self.message = "Whether the mesh is symmetric is still being found out"
            return
        ways = [(), *((axis,) for axis in symmetric), *([symmetric] if len(symmetric) > 1 else ())]
        if len(ways) == 1 and not drawing.mirror_axes:
            self.message = "The mesh is symmetric over none of its axes"
            return
        now = ways.index(drawing.mirror_axes) if drawing.mirror_axes in ways else len(ways) - 1
        axes = ways[(now + 1) % len(ways)]
        if drawing.set_mirror(axes):
            self.message = f"Mirrored over {', '.join(_AXES[axis] for axis in axes)}" if axes else "Not mirrored"

    def _resume(self, board: Board) -> None:
        self.message = board.resume()

    def _undo(self) -> None:
        self._hold = None
        waiting = next((board for board in self.boards.values() if board.session.waiting_clicks), None)
        if waiting is not None:
            waiting.session.undo()
            return
        while self._history:
            board = self._history.pop()
            if board.session.undo():
                board.stepped()
                self._undone.append(board)
                self.board = board
                return
        self.session.undo()
        self.board.stepped()

    def _redo(self) -> None:
        while self._undone:
            board = self._undone.pop()
            if board.session.redo():
                board.stepped()
                self._history.append(board)
                self.board = board
                return
        self.session.redo()
        self.board.stepped()

    def _zoom(self, place: Place, delta: int) -> None:
        with bpy.context.temp_override(window=self._window, area=place.area, region=place.region):
            bpy.ops.view3d.zoom("INVOKE_DEFAULT", delta=delta, use_cursor_init=True)

    # What is under the mouse

    def _hover(self, place: Place, event: bpy.types.Event) -> None:
        loop = self.keys.previews_loop(event)
        board, snap = self._find(place, plain=loop)
        if board is not None and board is not self.board:
            self.session.hover(None)
            # A live wire stays with its object until there is a click on another.
            if self.session.seed is None and not self.session.waiting_clicks:
                self.board = board
            else:
                snap = None
        self.session.hover(snap, loop=loop and snap is not None)
        self.refresh()

    def _rehover(self, place: Place) -> None:
        board, snap = self._find(place)
        self.session.hover(snap if board is self.board else None)

    def _find(self, place: Place, plain: bool = False) -> tuple[Board | None, network.Snap | None]:
        """Return which object is under the mouse, and what of it; `plain`: of the mesh alone, as loops need it."""
        found = [self._board_of(name) for name in tuple(self._objects) if self._may_be_at(name, place)]
        if len(found) > 1:
            depths = [(board.depth(place.view, place.cursor), board) for board in found]
            hit = [pair for pair in depths if pair[0] is not None]
            if hit:
                found = [min(hit, key=lambda pair: pair[0])[1]]
            elif self.board in found:
                found.sort(key=lambda board: board is not self.board)
        for board in found:
            snap = board.snap(place.view, place.cursor, plain)
            if snap is not None:
                return board, snap
        return (found[0], None) if found else (None, None)

    def _may_be_at(self, name: str, place: Place) -> bool:
        """Whether an object may be under the mouse: those that were touched always, others where there is room."""
        if name in self.boards:
            return True
        try:
            if self._objects[name].mode != "EDIT" or not boards.in_bounds(
                self._objects[name], place.view, place.cursor
            ):
                return False
            self._board_of(name)
        except (ReferenceError, ValueError):  # it was deleted, or has nothing to draw on
            del self._objects[name]
            return False
        return True

    # What is seen

    def session_to_settings(self) -> None:
        """Show in the tool's header what the keys changed."""
        self.board.tell(self._settings)

    def refresh(self) -> None:
        """Show the sessions as they are now."""
        drawing = self.session
        self._set_timer(any(board.busy for board in self.boards.values()))
        state = (
            self.board,
            tuple(board.session.revision for board in self.boards.values()),
            round(100.0 * drawing.progress),
            drawing.computing,
            drawing.waiting_clicks,
            self.board.symmetric,
            self.message,
            self._help,
            self._settings.xray,
            self._settings.snap,
        )
        before, self._shown = self._shown, state
        if state == before:
            return
        rows = self.keys.rows() if self._help else None
        for board in self.boards.values():
            board.show(self._settings, front=board is self.board, help_rows=rows)
        self._workspace.status_text_set(ui.status_drawer(self.status()))
        self._redraw()

    def status(self) -> ui.Status:
        """Return what the status bar is to say."""
        mirrored = self.board.symmetric
        offers = mirrored if mirrored and not self.session.mirror_axes else ()
        return ui.Status(
            self.session,
            self.keys,
            message=self.message,
            notes=self.notes,
            mirror_offer="".join(_AXES[axis] for axis in offers),
            resume_offer=self.board.offer,
            marks=sum(len(board.session.edges_to_mark()) for board in self.boards.values()),
            clears=sum(len(board.session.edges_to_clear()) for board in self.boards.values()),
        )

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


def settings_changed(settings: tool.SeamwireSettings) -> None:
    """Let the running drawing follow its settings."""
    for drawing in running:
        drawing.follow(settings)


def close_all() -> None:
    """End all drawings, and forget those that did not come to their end."""
    for drawing in tuple(running):
        drawing.close()
    _interrupted.clear()


@bpy.app.handlers.persistent
def on_load(*_: object) -> None:
    """End all drawings before another file is loaded."""
    close_all()
