# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain in a window, from the click that begins it until its wires are in the mesh, or dropped."""

from __future__ import annotations

import traceback
from contextlib import ExitStack, nullcontext, suppress
from functools import partial
from typing import TYPE_CHECKING, TypeVar

import bpy
import numpy as np

from ..core.base.native import NativeError
from ..core.network.drawn import Drawn, edges_after
from ..core.network.network import Snap
from ..core.network.picks import FacePoint
from ..core.sketch.change import Change
from ..mesh import edit_mesh, finishes
from ..mesh import settings as chosen
from ..mesh.unwrap import unwrap_changed
from ..view.edited_objects import edited
from ..view.object_view import let_blender_tell
from ..words.hints import hints
from ..words.keys import DoubleClicks
from ..words.reports import Notices, count, in_words, summary
from . import keymaps, running
from .running import DRAW, EDIT, chains, show_status

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from contextlib import AbstractContextManager

    from ..core.sketch.sketch import Sketch
    from ..core.storage.wire_labels import Plan
    from ..view.object_view import ObjectView
    from ..words.hints import Hint
    from .holds import Hold

_Result = TypeVar("_Result")

STAGES: Mapping[str, Sequence[str]] = {
    "READY": ("PEEKING", "DRAWING", "CLOSED"),
    "PEEKING": ("DRAWING", "CLOSED"),
    "DRAWING": ("HOLDING", "ENDING", "OVER", "CLOSED"),
    "HOLDING": ("DRAWING",),
    "ENDING": ("DRAWING", "OVER", "CLOSED"),
    "OVER": ("CLOSED",),
    "CLOSED": (),
}
"""The states of a chain, and those that can follow each. `docs/development/structure.md` says what they are, and what leads to them."""
TICK = 0.008
"""Seconds between two looks at running work, half of what a screen shows a picture for: a wire is drawn with the next one."""


class Chain:
    """A chain that is being drawn in a window.

    Attributes
    ----------
    stage
        The state, a key of `STAGES`. Only `go` changes it.
    hold
        The thing that a pressed button drags, or None. In *HOLDING* there is one.
    peek
        The key that shows the loop under the mouse while it is held, or an empty text. In *PEEKING* there is one.
    drawn_on
        The object that is drawn on. None if nothing has been drawn since the last step of undo.
    has_kept
        Whether the chain has changed a mesh.
    failure
        The error on which the chain ends, if there is one.
    titles
        The titles of the steps of undo for what was done, `DRAW` or `EDIT`.
    notices
        What there is to report when the chain ends.
    hint
        The result of the last key, for the status bar.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        self.window, self.workspace, self.manager = context.window, context.workspace, context.window_manager
        self._mouse_window = context.window
        self.keys, self.clicks = keymaps.keys(context), DoubleClicks()
        self.notices, self.hint = Notices(), ""
        self.drawn_on: ObjectView | None = None
        self.has_kept = False
        self.failure: Exception | None = None
        self._before = Drawn()  # what the object that is drawn on had at the last step
        self._seams = np.empty((0, 2), dtype=np.int32)  # its seams then
        self.titles: set[str] = set()
        self._is_saved = False
        self.stage, self.hold, self.peek = "READY", None, ""
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""
        self._shown: tuple[tuple[object, ...], tuple[object, ...]] | None = None
        self._cleanup = ExitStack()
        self._switched: dict[str, tuple[object, object]] = {}  # settings before a key changed them, and since then
        edited.chain = partial(self._set_timer, True)  # nobody may move the mouse when a mesh changes
        for leave in (self._switch_back, _leave_objects, self._leave_window):
            self._cleanup.callback(leave)
        for listed, own in ((chosen.listeners, self._on_settings), (chains, self)):
            listed.append(own)
            self._cleanup.callback(listed.remove, own)

    @property
    def session(self) -> Sketch:
        assert edited.front is not None
        return edited.front.session

    # Its state

    def go(self, stage: str, hold: Hold | None = None, peek: str = "") -> None:
        """Go on to another state, with what is held there. Raises AssertionError if `STAGES` does not allow it."""
        if stage not in STAGES[self.stage]:
            raise AssertionError(f"A chain cannot go on: {self.stage}, {stage}")
        self.stage, self.hold, self.peek = stage, hold, peek

    def begin(self) -> None:
        """End as soon as nothing is live, because something is done from now on."""
        if self.stage in {"READY", "PEEKING"}:
            self.go("DRAWING")

    def begin_anew(self) -> None:
        """Keep the drawn wires as a separate chain, if they are computed, and begin another one."""
        if self.stage == "ENDING":
            self.go("DRAWING")
        if self._is_final:
            self.keep()
            self._switch_back()

    def switch(self, name: str, value: object) -> None:
        before, _ = self._switched.get(name, (getattr(chosen.settings(), name), None))
        self._switched[name] = before, value
        setattr(chosen.settings(), name, value)

    def _switch_back(self) -> None:
        """Restore the settings that keys have changed, except those that the artist has chosen otherwise meanwhile."""
        settings = chosen.settings()
        while self._switched:
            name, (before, value) = self._switched.popitem()
            if getattr(settings, name) == value:
                setattr(settings, name, before)

    def let_go(self) -> None:
        hold = self.hold
        if hold is not None:
            self.go("DRAWING")
            hold.cancel()

    @property
    def _is_final(self) -> bool:
        return not any(view.session.waiting for view in edited.views())

    def cancel(self) -> None:
        """Cancel what is dragged. If nothing is, end. While the end waits for wires, keep them as they are drawn."""
        self.begin()
        views = edited.views()
        if self.stage == "ENDING":
            for view in views:
                view.session.finish(wait=False)
        if not any([view.session.cancel() for view in views]):
            self.end()

    def end_now(self) -> None:
        """End before Blender has the event, because it may change the mesh. Blender stands still until the last wire is computed."""
        self.begin()
        self.go("OVER")

    def end(self) -> None:
        """End as soon as all wires are computed."""
        self.begin()
        for view in edited.views():
            view.session.end_chain()
        if self._is_final:
            self.go("OVER")
        elif self.stage != "ENDING":
            self.go("ENDING")
            self.hint = "Ending when all wires are computed: Esc keeps them as they are drawn"

    def settle(self) -> None:
        """End if nothing is live, and all wires are computed."""
        if self.stage == "ENDING":
            self.end()
        elif self.stage == "DRAWING":
            sketches = [view.session for view in edited.views()]
            if not any(one.network.seed is not None or one.is_held for one in sketches):
                self.go("OVER" if self._is_final else "ENDING")

    # The objects

    def find_front(self) -> None:
        """Let the active object be in front if no object is, because a cut mesh is read anew. This may read the whole mesh."""
        if edited.front is None or not edited.front.exists:
            with self._at_home():
                edited.front = edited.of(bpy.context.active_object)

    def draw_on(self, view: ObjectView) -> None:
        """Draw on this object. Wires drawn on another object become a separate chain."""
        edited.front = view
        if self.drawn_on is not view:
            if self.drawn_on is not None:
                self.keep()
            self.drawn_on, self._before = view, view.session.drawn
            self._seams = view.mesh.arrays.seams

    def keep(self) -> None:
        """Keep what was drawn as a separate step of undo, and go on with the next."""
        with self._at_home():
            self._keep_wires()
        if self.failure is not None:
            raise self.failure
        self.find_front()

    def trouble(self, context: bpy.types.Context) -> str:
        """Return why the chain cannot go on, or an empty text. Raises what an overlay could not draw."""
        reason = ""
        is_own = context.window == self.window  # another window may show another scene or workspace
        if is_own and context.mode != "EDIT_MESH":
            reason = "Edit mode was left"
        elif is_own and context.workspace != self.workspace:
            reason = "Another workspace was opened"
        # After an error, wires can be kept only if the mesh is known as it is.
        reason = self._follow_mesh(reason)
        edited.take_error()
        if self.failure is not None:
            raise self.failure
        return reason

    def _follow_mesh(self, reason: str = "") -> str:
        """Return why the chain cannot go on: because others have changed the mesh, or for the given `reason`."""
        view = self.drawn_on
        if view is None or not (view.stale or not view.mesh.alive()):
            return reason
        obj = view.obj if view.exists else bpy.data.objects.get(view.name)
        if obj is None:
            self.drawn_on, self._is_saved = None, False
            return "The object was removed"
        seams = view.mesh.arrays.seams
        is_same = view.mesh.rebind(obj)
        after = view.mesh.arrays.seams
        # The report counts no seams that others have marked.
        self._seams = edges_after(self._seams, edges_after(after, (), seams), edges_after(seams, (), after))
        if not is_same:
            return reason or "The mesh was changed"
        view.renew()
        return reason

    # How it ends

    def finish(self, at_once: bool = False) -> bool:
        """Mark and clear what was drawn, as a step of Blender's undo, and return whether the chain has changed a mesh.

        An error loses no wire, except if the wires cannot be written. Then the mesh is restored. The notices tell of it.

        Parameters
        ----------
        at_once
            Whether Blender stops the operator. Then there is no time to wait for wires, and no step of undo.
        """
        with self._at_home():
            self.attempt(self.let_go)
            self.attempt(self._follow_mesh)
            try:
                self._keep_wires(at_once)
            except Exception as error:
                self._give_up(error, at_once)
            self.attempt(self.close)
        if self.failure is not None:
            fate = ", and its wires are kept" if self.has_kept else ""
            self.notices.add("ERROR", f"Drawing ended on an error{fate}: {self.failure}")
        return self.has_kept

    def _at_home(self) -> AbstractContextManager[None]:
        """Return a context in which Blender works on the scene of the chain. Another window may show another scene."""
        is_open = self.window in self.manager.windows.values()
        return bpy.context.temp_override(window=self.window) if is_open else nullcontext()

    def attempt(self, work: Callable[..., object], *arguments: object) -> bool:
        """Do work that does not decide about the wires. Note an error instead of raising it, and return whether there was none."""
        try:
            work(*arguments)
        except Exception as error:
            traceback.print_exc()
            self.failure = self.failure or error
            return False
        return True

    def _give_up(self, error: Exception, at_once: bool) -> None:
        """Restore the mesh because the wires cannot be written, and tell what became of them."""
        is_known = isinstance(error, ValueError)
        if not is_known:
            traceback.print_exc()
        fate = "were not kept"
        self.attempt(self.drop)
        if self._is_saved:
            fate = "are in the mesh as they were last saved" if is_known else "are in the mesh in part, undo leads back"
            self.has_kept = True
            if not at_once:
                self.attempt(running.push, DRAW)
        self.notices.add("WARNING" if is_known else "ERROR", f"{error}: the wires of this chain {fate}")
        self.failure = None

    def _keep_wires(self, at_once: bool = False) -> None:
        """End the chains of all objects after their last wires are computed, and write what was drawn as a step of Blender's undo.

        It reports clicks that waited and could not be done. `at_once` is that of `finish`. Raises ValueError if an edge is gone. Then
        the mesh is unchanged.
        """
        # The object that is drawn on comes first, because outside Edit Mode it is not among the views.
        drawn_on = [] if self.drawn_on is None else [self.drawn_on]
        for view in dict.fromkeys((*drawn_on, *edited.views())):
            finish, reports = view.session.finish, view.session.reports
            if not self.attempt(finish, not at_once):
                self.attempt(finish, False)
            for told in reports:
                self.notices.add("WARNING", told)
            reports.clear()
        view = self.drawn_on
        change = None if view is None else Change(self._before, view.session.drawn)
        title = EDIT if self.titles == {EDIT} else DRAW
        self.titles.clear()
        if view is None or change is None or not (self._is_saved or change):
            self.drawn_on = None
            return
        plan = view.mesh.plan(change)
        self._write(view, plan)
        self.drawn_on, self._is_saved = None, False
        # Not what `write` has changed: saving within the chain may have marked edges already.
        before, after = self._seams, view.mesh.arrays.seams
        marked, cleared = len(edges_after(after, (), before)), len(edges_after(before, (), after))
        # The wires are in the mesh by now. Whatever fails, a step of undo must lead back.
        self.has_kept = True
        self._try("drawing them", view, lambda: (view.mesh.adopt(plan), view.renew()))
        done = self._try("finishing them", view, lambda: _apply(view, change)) or ""
        problem = ""
        if not at_once:
            if (marked or cleared or done) and bpy.context.mode == "EDIT_MESH":
                problem = self._try("unwrapping", view, lambda: unwrap_after_chain(bpy.context)) or ""
            self.attempt(running.push, title)
        told = f"{title}: {done or summary(change, marked, cleared)}"
        self.notices.add("WARNING" if problem else "INFO", f"{told}. {problem}" if problem else told)

    def _write(self, view: ObjectView, plan: Plan) -> None:
        """Write what was drawn. Raises ValueError if the mesh has other vertices. Then it is unchanged."""
        # After any other error, dropping the chain writes the former wires.
        was_saved, self._is_saved = self._is_saved, True
        try:
            view.mesh.write(plan, adopt=False)
        except ValueError:
            self._is_saved = was_saved
            raise

    def _try(self, what: str, view: ObjectView, work: Callable[[], _Result]) -> _Result | None:
        """Do some of the work on a mesh that has its wires already. Report an error instead of raising it, and return None."""
        try:
            return work()
        except Exception as error:
            traceback.print_exc()
            edited.forget(view)
            self.notices.add("ERROR", f"Wires are kept, but {what} ended on an error, undo leads back: {error}")
            return None

    def save(self) -> None:
        """Write the wires so far to the mesh, so that Blender saves them. The chain goes on, unless a wire must be cut for that."""
        if self.drawn_on is None:
            return
        let_blender_tell()
        self._follow_mesh()
        if self.drawn_on is None:
            return
        if self._must_cut(self.drawn_on):
            self.attempt(self.let_go)
            self.attempt(self.keep)
        else:
            view = self.drawn_on
            # If the mesh has other vertices, nothing is written, and the chain ends at its next event.
            with suppress(ValueError):
                self._write(view, view.mesh.plan(Change(self._before, view.session.drawn)))
                view.renew()

    def _must_cut(self, view: ObjectView) -> bool:
        """Return whether a wire lies within a face and can be cut. Until it is cut, no edge can store it."""
        sketch = view.session
        cuts = [wire for wire in sketch.drawn.wires if wire.cuts and Change(self._before, sketch.drawn).finishes(wire)]
        # A wire that ends within a face is cut once the chain has led out of the face.
        is_inside = isinstance(sketch.seed, FacePoint)
        if is_inside or all(len(wire.vertices) > 1 for wire in cuts):
            return False
        with suppress(ValueError):
            finishes.plan_cut(view.mesh, cuts)
            return True
        return False

    def drop(self) -> None:
        """Undo everything since the last step.

        Wires that were saved stay in the mesh if the former wires cannot be written after a change by others.
        """
        view, self.drawn_on = self.drawn_on, None
        if view is not None and view.mesh.alive():
            view.session.adopt(self._before, view.mesh.plain_seams)
            if self._is_saved:
                view.mesh.write(view.mesh.plan(), adopt=True)
                view.renew()
                self._is_saved = False
        self.close()

    def close(self) -> None:
        if self.stage != "CLOSED":
            self.go("CLOSED")
            self._cleanup.close()

    def _leave_window(self) -> None:
        show_status(None)
        self.set_cursor("")
        if self.window in self.manager.windows.values():
            self._set_timer(False)

    # Its window

    def follow_mouse(self, window: bpy.types.Window) -> bool:
        """Take note of the window that has an event. Return whether the chain can be drawn there: a drag stays in its window."""
        if window != self._mouse_window and self.hold is None:
            self.set_cursor("")
            self._mouse_window = window
        return window == self._mouse_window

    def set_cursor(self, shape: str) -> None:
        """Show another cursor, or Blender's own if the name is empty."""
        if shape == self._cursor:
            return
        self._cursor = shape
        if self._mouse_window not in self.manager.windows.values():
            return
        if shape:
            self._mouse_window.cursor_modal_set(shape)
        else:
            self._mouse_window.cursor_modal_restore()

    def _set_timer(self, wanted: bool) -> None:
        if wanted and self._timer is None:
            self._timer = self.manager.event_timer_add(TICK, window=self.window)
        elif not wanted and self._timer is not None:
            timer, self._timer = self._timer, None
            self.manager.event_timer_remove(timer)

    def hints(self) -> list[Hint]:
        symmetric = edited.front.mesh.symmetric
        offers = symmetric if symmetric and not edited.front.options.mirror else ()
        axes = "".join("XYZ"[axis] for axis in offers)
        return hints(self.session.picture, self.keys, self.hint, axes)

    def show(self) -> None:
        session = self.session
        picture = (
            id(edited.front),
            tuple((view.session.revision, view.islands.pointed_island) for view in edited.views()),
        )
        words = (
            round(100.0 * session.progress),
            session.computing,
            session.waiting,
            edited.front.mesh.symmetric,
            self.hint,
        )
        before, self._shown = self._shown, (picture, words)
        if before is None or picture != before[0]:
            edited.show()
            edited.redraw()
        if self._shown != before:
            show_status(self.hints())
        # Last: what is shown may ask for more to be computed.
        self._set_timer(any(view.busy for view in edited.views()))

    def _on_settings(self) -> None:
        self._shown = None
        if edited.front is not None:
            self.show()


def _leave_objects() -> None:
    edited.chain = None
    edited.watch()
    edited.redraw()
    for view in edited.views():
        view.stroke = None
        turned = None if view.turned is None else view.turned_at(view.turned[1])
        view.session.hover(None if turned is None else Snap(turned.start, "WIRE", turned))  # the next key acts on it
    edited.show()


def _apply(view: ObjectView, change: Change) -> str:
    if not view.mesh.alive():
        left = sum(map(change.finishes, change.after.wires))
        return f"{count(left, 'wire')} kept along edges, because the mesh was changed meanwhile" if left else ""
    _, done = finishes.apply(view.mesh, change)
    if done:
        edited.forget(view)
    return done


def unwrap_after_chain(context: bpy.types.Context) -> str:
    """Unwrap after a change of seams, as the tool or Blender is set. Return what went wrong, or an empty text."""
    if not chosen.settings(context).unwrap:
        edit_mesh.live_unwrap(context)
        return ""
    try:
        return ", ".join(in_words(unwrap_changed(context).faults))
    except (ValueError, NativeError) as error:
        return str(error)
