# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain in a window: from the click that begins it until it is closed, joined or ended, with all that is dragged or stroked."""

from __future__ import annotations

import time
import traceback
from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

from ..core.drawing.change import Change
from ..core.drawing.options import strength_name
from ..core.drawing.picture import Role
from ..core.network.network import Network
from ..mesh import finish
from ..mesh import settings as chosen
from ..view.edited_objects import edited
from ..view.viewport import Place, place_of
from ..words.keys import WHEEL, Action, DoubleClicks, Key, drag_threshold
from . import bindings, navigation, undo_steps
from .cut import gaps, left_out
from .drag_handlers import Hold, LineHold, SeedHold, StrokeHold
from .navigation import Meaning
from .report import count, running, status_makers, summary
from .unwrap import unwrap_after_chain

if TYPE_CHECKING:
    from ..core.drawing.session import Session
    from ..core.network.network import Snap
    from ..view.object_view import ObjectView

TICK = 0.008
"""Seconds between two looks at running work, half of what a screen shows a picture for: a wire is drawn with the next one."""
_OFFERED = (Action.LOOP, Action.BEND)
"""The preview while the modifiers of its click are held."""
_CLICKS = frozenset({Action.CLICK, Action.NEW_CHAIN, *_OFFERED})
_STROKES = frozenset({Action.GUIDE, Action.AVOID})
_CHANGES = frozenset({Action.NEXT, Action.CLOSE, Action.EXTEND, Action.UNDO, Action.REDO})
"""Keys that may change the wires of the object that was pointed at last."""
_AXES = "XYZ"


class Chain:
    """A chain that is being drawn in a window: what it drew, and what has to be put back when it ends.

    Parameters
    ----------
    context
        With the 3D view to draw in, and the active object in edit mode.

    Attributes
    ----------
    message
        What there is to say about the last key.
    done
        The titles from `undo_steps` of everything that was done, each once.
    told
        What became of it, in words, for each step of undo.
    errors
        What ended on an error of ours after that, in words.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        self._window = context.window
        self._workspace = context.workspace
        self._manager = context.window_manager
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""
        self._clicks = DoubleClicks()
        self._shown: tuple[tuple[object, ...], tuple[object, ...]] | None = None
        self._hold: Hold | None = None
        self._drawn: ObjectView | None = None
        self._before = Network()
        self._saved = False
        self._ending = False
        self._begun = False
        self._peek = ""
        self._keys = False
        self.message = ""
        self.done: list[str] = []
        self.told: list[str] = []
        self.errors: list[str] = []
        self.keys = bindings.of_user(self._manager).without(lambda key: navigation.takes(key, context))
        self._cleanup = ExitStack()
        try:
            edited.take_stock()
            edited.follow_settings()
            edited.chain = True
            self._cleanup.callback(self._leave_objects)
            self._cleanup.callback(self._set_timer, False)
            self._cleanup.callback(self._set_cursor, "")
            self._cleanup.callback(self._workspace.status_text_set, None)
            for handlers, handler in ((bpy.app.handlers.save_pre, _on_save), (bpy.app.handlers.load_pre, _on_load)):
                handlers.append(handler)
                self._cleanup.callback(handlers.remove, handler)
            chosen.listeners.append(self._on_settings)
            self._cleanup.callback(chosen.listeners.remove, self._on_settings)
            running.append(self)
            self._cleanup.callback(running.remove, self)
        except BaseException:
            self.close()
            raise

    # State

    @property
    def view(self) -> ObjectView:
        """The object that was pointed at last."""
        if edited.front is None:
            edited.front = edited.of(bpy.context.active_object)
        return edited.front

    @property
    def session(self) -> Session:
        """Its session."""
        return self.view.session

    @property
    def open(self) -> bool:
        """Whether it goes on."""
        return self in running

    @property
    def previews(self) -> bool:
        """Whether it only shows what a click would take."""
        return bool(self._peek)

    @property
    def idle(self) -> bool:
        """Whether it has begun and nothing is live any more, nothing dragged and nothing waited for: then it ends."""
        return (
            self._begun
            and not self._peek
            and self._hold is None
            and not any(
                view.session.seed is not None or view.session.waiting_clicks or view.session.dragging
                for view in edited.views()
            )
        )

    def close(self) -> None:
        """Put everything back; more than once does no harm."""
        self._cleanup.close()

    def _leave_objects(self) -> None:
        edited.chain = False
        edited.watch()
        edited.redraw()
        for view in edited.views():
            view.stroke = None
            view.session.hover(None)
        edited.show()

    def trouble(self, context: bpy.types.Context) -> str:
        """Say why it cannot go on; an empty string where it can. Raises what an overlay could not draw."""
        edited.take_error()
        reason = ""
        if context.mode != "EDIT_MESH":
            reason = "Edit mode was left"
        elif context.workspace != self._workspace:
            reason = "Another workspace was opened"
        view = self._drawn
        if view is None or not (view.stale or not view.mesh.alive()):
            return reason
        # Blender says that the mesh was changed. Seams may be: others may mark them.
        obj = bpy.data.objects.get(view.name)
        if obj is None:
            self._drawn = None
            return "The object was removed"
        if not view.mesh.follow_change(obj):
            return reason or "The mesh was changed"
        view.was_read()
        view.renew()
        return reason

    # How it ends

    def finish(self, context: bpy.types.Context, undo_step: bool = True) -> None:
        """End the chain: mark and clear what was drawn, as a step of Blender's undo.

        Raises
        ------
        ValueError
            Where an edge is gone; then nothing is changed.
        """
        self._cancel_hold()
        self._keep(context, undo_step)
        self.close()

    def _keep(self, context: bpy.types.Context, undo_step: bool = True) -> None:
        # The object that is drawn on comes first, because outside Edit Mode it is not among the views.
        if self._drawn is not None:
            if self._ending:
                self._drawn.session.wait()  # a key that ended the chain also left edit mode before the last wire was there
            self._drawn.session.end_chain()
        for view in edited.views():
            view.session.end_chain()
        view, before = self._drawn, self._before
        title = self.done[0] if len(self.done) == 1 else undo_steps.DRAW_SEVERAL
        self.done.clear()
        if view is None or not (self._saved or Change(before, view.session.network)):
            self._drawn = None
            return
        change = Change(before, view.session.network)
        marked, cleared = self._write(view, adopt=True)
        self._drawn, self._saved, problem = None, False, ""
        try:
            finished = self._apply(view, change)
        except Exception as error:
            # The wires are in the mesh by now, and undo is to lead back from what was left half done.
            traceback.print_exc()
            edited.forget(view)
            finished = ""
            self.errors.append(
                f"Wires are kept, but cutting or sliding them ended on an error, undo leads back: {error}"
            )
        if undo_step:
            if (marked or cleared) and context.mode == "EDIT_MESH":
                problem = unwrap_after_chain(context)
            undo_steps.push(title)
        self.told.append(f"{title}: {finished or summary(change.drawn, marked, cleared)}{problem and f'. {problem}'}")

    @staticmethod
    def _apply(view: ObjectView, change: Change) -> str:
        """Let the mesh do what a change asks, and return what was done, in words."""
        if not view.mesh.alive():
            return ""
        _, done = finish.apply(view.mesh, change)
        if not done:
            return ""
        edited.forget(view)
        told = []
        if done.slid:
            told.append(f"{count(done.slid, 'wire')} slid, {count(done.moved, 'vertex', 'vertices')} moved")
        if done.cut:
            told.append(f"{count(done.cut, 'wire')} cut, {count(done.edges, 'edge')} marked")
        if done.uncut:
            told.append(gaps(done.uncut))
        if done.left_out:
            told.append(left_out(done.left_out))
        if done.problem:
            told.append(f"not cut: {done.problem}")
        if done.taken_back:
            told.append("cut taken back")
        return ", ".join(told)

    def save(self) -> None:
        """Write what is drawn so far to the mesh, so that Blender saves it; the chain goes on."""
        if self._drawn is not None:
            self._write(self._drawn, adopt=False)
            self._saved = True

    @staticmethod
    def _write(view: ObjectView, adopt: bool) -> tuple[int, int]:
        plan = view.mesh.plan()
        counts = view.mesh.write(plan, adopt)
        if view.mesh.alive():
            view.renew()
            view.was_read()
        return counts

    def drop(self) -> None:
        """End the chain and undo everything that it did."""
        self._hold = None
        view, self._drawn = self._drawn, None
        if view is not None and view.mesh.alive():
            view.mesh.drop_changes(self._before)
            if self._saved:
                self._write(view, adopt=True)
        self.close()

    # Events

    def begin(self, action: Action, event: bpy.types.Event) -> bool:
        """Do what started the chain, under the mouse; return whether there was something to do it to."""
        place = place_of(self._window, event)
        if place is None:
            return False
        self._begun = True
        if action is Action.REMOVE:
            done = self._remove(place)
        elif action is Action.NEXT:
            done = self._retrace(place)
        elif action is Action.BEND and not self._bends:
            done = False
        else:
            done = True
            (self._begin_stroke if action in _STROKES else self._click)(action, place, event)
        self._after()
        return done

    @property
    def _bends(self) -> bool:
        """Return whether there may be a closed cut to bend. Along edges there is no such cut."""
        return self.session.options.along == "SURFACE"

    def peek(self, event: bpy.types.Event) -> bool:
        """Show the loop under the mouse while the key of an event is held; return whether it shows loops."""
        place = place_of(self._window, event)
        offered = _OFFERED if self._bends else (Action.LOOP,)
        if place is None or not any(self.keys.previews(action, event) for action in offered):
            return False
        self._begun, self._peek = True, event.type
        self._hover(place, event)
        return True

    def handle(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Do what an event asks for; return whether Blender is to have it too. Where the chain ends, `idle` tells."""
        if event.type == "TIMER":
            self._tick()
            return True
        if self._peek and (
            event.type == "WINDOW_DEACTIVATE" or (event.type == self._peek and event.value == "RELEASE")
        ):
            self._peek = ""
        edited.follow_settings()
        place = place_of(self._window, event)
        double = self._clicks.is_second(event, time.monotonic(), context.preferences)
        if self._hold is not None and event.type == self._hold.button and event.value == "RELEASE":
            self._release(place)
            return False
        press = place is None and event.value == "PRESS"
        button = event.type.endswith("MOUSE")
        if button and place is not None and self._hold is None and navigation.on_gizmo(place, context.preferences):
            place = None
        self._set_cursor("CROSSHAIR" if place else "")
        if place is None:
            if press and not _in_tool_settings(self._window, event):
                self._end()
            if event.type == "MOUSEMOVE" and self.session.target is not None and self._hold is None:
                self.session.hover(None)
                self.show()
            return True
        if isinstance(self._hold, LineHold) and event.type == "INBETWEEN_MOUSEMOVE":
            self._hold.follow(place)
            return False
        moves = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"} if isinstance(self._hold, StrokeHold) else {"MOUSEMOVE"}
        if self._hold is not None and event.type in moves:
            hold = self._hold
            if not hold.move(place, drag_threshold(event, context.preferences)) and self._hold is hold:
                self._hold = None
            self._after()
            return False
        if event.type in {"INBETWEEN_MOUSEMOVE", "WINDOW_DEACTIVATE"} or event.type.startswith("TIMER"):
            return True
        if event.type == "MOUSEMOVE" or event.type.endswith(("_ALT", "_CTRL", "_SHIFT")):
            self._hover(place, event)
            return True
        return self._key(context, place, event, double)

    def _turns_wheel(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Whether the wheel is turned that was given to the candidates, alone or with Ctrl."""
        alone = not (event.shift or event.alt or event.oskey)
        given = chosen.preferences(context).wheel_switches and self.session.seed is not None
        return given and alone and event.type in WHEEL

    def _key(self, context: bpy.types.Context, place: Place, event: bpy.types.Event, double: bool) -> bool:
        if self._turns_wheel(context, event):
            if event.ctrl:
                navigation.zoom(context, place, event)
                return False
            return self.act(Action.NEXT, place, event)
        if navigation.takes(Key.of(event), context):
            return True
        action = self.keys.decode(event, double)
        if action is None:
            meaning = navigation.meaning(event, self._manager)
            if meaning is Meaning.OTHER:
                self._end()
            return True
        if getattr(event, "is_repeat", False) and action not in {Action.UNDO, Action.REDO}:
            return False
        return self.act(action, place, event)

    def act(self, action: Action, place: Place, event: bpy.types.Event) -> bool:
        """Do what a key or button asks for; return whether Blender is to have the event too."""
        self.message = ""
        if self._peek and action is not Action.NEXT:
            self._peek = ""
        if action is Action.END:
            self._end()
        elif action is Action.CANCEL:
            self._end(wait=False)
        elif action in _CLICKS:
            self._click(action, place, event)
        elif action in _STROKES:
            self._begin_stroke(action, place, event)
        elif action is Action.REMOVE:
            if not self._remove(place):
                # Blender's own meaning of the key, which changes the mesh.
                self._end()
                return True
        else:
            self._do(action, place)
        self._after()
        return False

    def _end(self, wait: bool = True) -> None:
        """Let go of what is live; clicks that wait for their wires are done first, or forgotten."""
        self._begun, self._peek = True, ""
        if self._cancel_hold():
            return
        if wait and any(view.session.waiting_clicks for view in edited.views()):
            self._ending = True
            self.message = "Ending as soon as the last wire is computed"
            return
        self._ending = False
        for view in edited.views():
            view.session.stop_preview()
            view.session.end_chain()

    def _after(self) -> None:
        self.show()

    def _draw_on(self, view: ObjectView) -> None:
        """Draw on this object. Wires drawn on another object become a separate chain."""
        edited.front = view
        if self._drawn is not view:
            if self._drawn is not None:
                self._keep(bpy.context)
            self._drawn, self._before = view, view.session.network

    def _note(self, done: str) -> None:
        if done not in self.done:
            self.done.append(done)

    def _on_settings(self) -> None:
        self._shown = None
        self.show()

    def _tick(self) -> None:
        edited.poll()
        if self._ending and not any(view.session.waiting_clicks for view in edited.views()):
            self._ending = False
            self._end()
        self._after()

    # What keys and buttons do

    def _release(self, place: Place | None) -> None:
        hold, self._hold = self._hold, None
        assert hold is not None
        # The wires that were live before a line become a separate chain, with a separate step in Blender's undo.
        if not (isinstance(hold, LineHold) and hold.starts_chain()) or self._keep_chain():
            hold.release()
        if isinstance(hold, StrokeHold) and hold.missed:
            self.message = "Drag over the mesh to draw a stroke"
        if place is not None:
            self._rehover(place)
        self._after()

    def _click(self, action: Action, place: Place, event: bpy.types.Event) -> None:
        view, snap = edited.find(place, plain=action in _OFFERED)
        if view is None or snap is None:
            return
        self._begun = True
        if view is not edited.front:
            self.session.hover(None)
        if action is Action.NEW_CHAIN and not view.session.waiting_clicks:
            self._keep(bpy.context)
            if view not in edited.views():  # it was cut
                view, snap = edited.find(place)
                if view is None or snap is None:
                    return
        self._draw_on(view)
        session = view.session
        if action is Action.NEW_CHAIN:
            session.start(snap)
            session.hover(snap)
            self._note(undo_steps.DRAW_WIRES)
        elif action is Action.BEND:
            session.bend(snap)
            self._note(undo_steps.BEND_CUT)
        elif action is Action.LOOP and self._is_loop(session, snap, event):
            session.loop(snap)
            self._note(undo_steps.ADD_LOOP)
        elif session.seed is None and not session.waiting_clicks and snap.to in {"SEED", "WIRE"}:
            # Whether it is a click or the beginning of a drag is known when the button or the mouse has moved.
            session.hover(snap)
            self._hold = SeedHold(event.type, view, snap, place, self._note)
        elif snap.to in {"MESH", "FEATURE", "SEAM"} or session.goes_on_from(snap):
            self._hold = LineHold(event.type, view, snap, place, lambda: self._click_at(view, snap), self._note)
        else:
            self._click_at(view, snap)

    def _click_at(self, view: ObjectView, snap: Snap) -> None:
        view.session.click(snap)
        self._note(undo_steps.DRAW_WIRES)

    def _keep_chain(self) -> bool:
        """Keep the live wires as a separate chain, and return whether the object is still the same."""
        view = self.view
        self._keep(bpy.context)
        if view not in edited.views():
            self.message = "The mesh was cut: draw the line once more"
            return False
        self._draw_on(view)
        return True

    def _is_loop(self, session: Session, snap: Snap, event: bpy.types.Event) -> bool:
        """Whether a click takes what runs around: across the surface not the second one of a double click, which ends a wire."""
        if session.options.along == "SURFACE":
            return self.keys.previews(Action.LOOP, event)
        return isinstance(snap.pick, tuple)

    def _begin_stroke(self, action: Action, place: Place, event: bpy.types.Event) -> None:
        self._begun = True
        found, _ = edited.find(place)
        live = self.session.seed is not None or self.session.waiting_clicks
        view = self.view if live or found is None else found
        self._draw_on(view)
        self._cancel_hold()
        scale = bpy.context.preferences.system.ui_scale
        self._hold = StrokeHold(event.type, view, place, action is Action.GUIDE, scale)
        self._note(undo_steps.GUIDE_STROKE if action is Action.GUIDE else undo_steps.AVOID_STROKE)

    def _cancel_hold(self) -> bool:
        hold, self._hold = self._hold, None
        dragged = hold is not None and hold.cancel()
        # A released drag may still wait.
        return any([view.session.drag_cancel() for view in edited.views()]) or dragged or hold is not None

    def _do(self, action: Action, place: Place) -> None:
        if action in _CHANGES:
            self._draw_on(self.view)
        session, settings = self.session, chosen.settings()
        if action is Action.NEXT:
            hovered = session.picture.one(Role.HOVERED)
            if session.seed is None and hovered is not None:
                session.retrace(hovered)
            else:
                session.next_candidate()
        elif action in {Action.STRONGER, Action.WEAKER}:
            self._change_strength(1 if action is Action.STRONGER else -1)
        elif action is Action.CLOSE:
            first = session.kept.closing_point
            session.close(None if first is None else self.view.seen_along(place.view, first))
        elif action is Action.EXTEND:
            session.run_to_end(preview=session.picture.one(Role.EXTENSION) is None)
        elif action is Action.CLEAR:
            settings.clear = not settings.clear
        elif action is Action.XRAY:
            settings.xray = not settings.xray
        elif action is Action.SNAP:
            settings.snap = not settings.snap
            self._rehover(place)
        elif action is Action.SWITCH:
            settings.along = "SURFACE" if settings.along == "EDGES" else "EDGES"
            self._rehover(place)
        elif action is Action.MIRROR:
            self._cycle_mirror()
        elif action is Action.KEYS:
            self._keys = not self._keys
        elif action is Action.UNDO:
            self._undo()
        elif action is Action.REDO:
            self._redo()

    def _remove(self, place: Place) -> bool:
        """Remove the wire or the stroke under the cursor; return whether there was one."""
        view, snap = edited.find(place)
        if view is None:
            return False
        wire = snap.wire if snap is not None and snap.to == "WIRE" else None
        stroke = view.stroke_at(place.view, place.cursor) if wire is None else None
        if wire is None and stroke is None:
            return False
        self._draw_on(view)
        if wire is not None:
            view.session.drop(wire)
            self._note(undo_steps.REMOVE_WIRE)
        elif stroke is not None:
            view.session.erase(stroke)
            self._note(undo_steps.REMOVE_STROKE)
        self._rehover(place)
        return True

    def _retrace(self, place: Place) -> bool:
        """Let the wire under the cursor take its other path; return whether there was one."""
        view, snap = edited.find(place)
        if view is None or snap is None or snap.to != "WIRE" or snap.wire is None:
            return False
        self._draw_on(view)
        view.session.hover(snap)
        view.session.retrace(snap.wire)
        self._note(undo_steps.RETRACE)
        return True

    def _change_strength(self, steps: int) -> None:
        session, settings = self.session, chosen.settings()
        name, strength = strength_name(settings.along), session.options.stepped(steps).strength
        if session.dragging:
            self.message = "Finish moving the seed first"
        elif strength == session.options.strength:
            self.message = f"The strength is {strength:g} already, the {'most' if steps > 0 else 'least'} there is"
        else:
            setattr(settings, name, strength)
            self.message = f"Strength {strength:.3g}"

    def _cycle_mirror(self) -> None:
        session = self.session
        symmetric = self.view.mesh.symmetric_soon()
        if symmetric is None:
            self.message = "Still checking the mesh for symmetry"
            return
        if self.view.mesh.symmetry_problem:
            self.message = self.view.mesh.symmetry_problem
            return
        ways = [(), *((axis,) for axis in symmetric), *([symmetric] if len(symmetric) > 1 else ())]
        if len(ways) == 1 and not session.options.mirror:
            self.message = "The mesh is not symmetric on X, Y or Z"
            return
        now = ways.index(session.options.mirror) if session.options.mirror in ways else len(ways) - 1
        axes = ways[(now + 1) % len(ways)]
        # The mesh's own option, which Blender's tools use as well.
        for axis, name in enumerate("xyz"):
            setattr(self.view.obj.data, f"use_mirror_{name}", axis in axes)
        edited.follow_settings()
        self.message = f"Mirrored on {', '.join(_AXES[axis] for axis in axes)}" if axes else "Not mirrored"

    def _undo(self) -> None:
        self._hold = None
        if not self.session.undo():
            self._end()

    def _redo(self) -> None:
        self.session.redo()

    # Pointing

    def _hover(self, place: Place, event: bpy.types.Event) -> None:
        loop, bend = (self.keys.previews(action, event) for action in _OFFERED)
        view, snap = edited.find(place, plain=loop or bend)
        edited.point_at(view, place)
        if view is not None and view is not edited.front:
            self.session.hover(None)
            # A live wire stays with its object until there is a click on another.
            if self.session.seed is None and not self.session.waiting_clicks:
                edited.front = view
            else:
                snap = None
        self.session.hover(snap, loop=loop, bend=bend)
        self.show()

    def _rehover(self, place: Place) -> None:
        view, snap = edited.find(place)
        self.session.hover(snap if view is edited.front else None)

    # Drawing

    def show(self) -> None:
        """Show the sessions as they are now."""
        session = self.session
        picture = (
            id(self.view),
            tuple((view.session.revision, view.islands.pointed_island) for view in edited.views()),
            self._keys,
        )
        words = (
            round(100.0 * session.work.progress),
            session.computing,
            session.waiting_clicks,
            self.view.mesh.symmetric,
            self.message,
        )
        before, self._shown = self._shown, (picture, words)
        if before is None or picture != before[0]:
            edited.show(self.keys.rows() if self._keys else None)
            edited.redraw()
        if self._shown != before:
            for make in status_makers:
                self._workspace.status_text_set(make(self))
        # Last: what is shown may ask for more to be computed.
        self._set_timer(any(view.busy for view in edited.views()))

    def _set_timer(self, wanted: bool) -> None:
        if wanted and self._timer is None:
            self._timer = self._manager.event_timer_add(TICK, window=self._window)
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


def _in_tool_settings(window: bpy.types.Window, event: bpy.types.Event) -> bool:
    """Whether the mouse is over the settings of a 3D view's tool, which a chain follows."""
    x, y = event.mouse_x, event.mouse_y
    regions = (region for area in window.screen.areas if area.type == "VIEW_3D" for region in area.regions)
    return any(
        region.x <= x < region.x + region.width and region.y <= y < region.y + region.height
        for region in regions
        if region.type in {"TOOL_HEADER", "UI"}
    )


def _on_save(*_: object) -> None:
    """Let files hold what is drawn so far."""
    for chain in tuple(running):
        chain.save()


def _on_load(*_: object) -> None:
    """End what is being drawn before another file is loaded."""
    for chain in tuple(running):
        chain.close()
