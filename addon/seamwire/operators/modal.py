# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain in a window, from the click that begins it until it is closed, joined or ended.

An event passes through four modules: `chain_events` finds its meaning, `chain_acts` has the table of what is done, `chain_gestures` and
`chain_keys` do it. `ChainState` is what stays between two events.
"""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

from ..mesh import settings as chosen
from ..view.edited_objects import edited
from ..view.viewport import place_of
from . import navigation
from .chain_acts import act, act_first
from .chain_events import EventReader, Given, Sign
from .chain_gestures import hover
from .chain_state import ChainState
from .chain_window import ChainWindow
from .report import running, status_makers

if TYPE_CHECKING:
    from ..core.drawing.session import Session
    from ..view.object_view import ObjectView

_UNSEEN = frozenset({Sign.NOTHING, Sign.TRACE, Sign.REPEAT})
"""Signs after which there is nothing new to show."""


def prepared(context: bpy.types.Context) -> ChainState:
    """Return the state of a chain that may begin, with the active object in Edit Mode read anew where it has changed."""
    state = ChainState(navigation.keys(context))
    edited.take_stock()
    edited.follow_settings()
    return state


class Chain:
    """A chain that is being drawn in a window.

    Parameters
    ----------
    context
        With the 3D view to draw in.
    state
        Everything that stays between two events, see `prepared`.
    """

    def __init__(self, context: bpy.types.Context, state: ChainState) -> None:
        self._window = ChainWindow(context)
        self._events = EventReader(self._window)
        self._shown: tuple[tuple[object, ...], tuple[object, ...]] | None = None
        self.state = state
        self._cleanup = ExitStack()
        try:
            edited.chain = True
            self._cleanup.callback(_leave_objects)
            self._cleanup.callback(self._window.set_timer, False)
            self._cleanup.callback(self._window.set_cursor, "")
            self._cleanup.callback(self._window.workspace.status_text_set, None)
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

    @property
    def view(self) -> ObjectView:
        """The object that was pointed at last."""
        return self.state.view

    @property
    def session(self) -> Session:
        """The session of this object."""
        return self.state.session

    @property
    def window(self) -> bpy.types.Window:
        """The window that it is drawn in."""
        return self._window.window

    @property
    def open(self) -> bool:
        """Whether it goes on."""
        return self in running

    def trouble(self, context: bpy.types.Context) -> str:
        """Return why the chain cannot go on, or an empty text. Raises what an overlay could not draw."""
        edited.take_error()
        reason = ""
        if context.mode != "EDIT_MESH":
            reason = "Edit mode was left"
        elif context.workspace != self._window.workspace:
            reason = "Another workspace was opened"
        return self.state.record.trouble(reason)

    # How it ends

    def finish(self, context: bpy.types.Context, undo_step: bool = True) -> bool:
        """End the chain, and mark and clear what was drawn, as a step of Blender's undo.

        Returns
        -------
        bool
            Whether the chain has changed a mesh.

        Raises
        ------
        ValueError
            If an edge is gone. Then the mesh is unchanged.
        """
        self.state.cancel_drags()
        self.state.record.keep(context, undo_step, waits=self.state.is_ending)
        self.close()
        return self.state.record.has_kept

    def drop(self) -> None:
        """End the chain and undo everything since the last step."""
        self.state.hold = None
        self.state.record.drop()
        self.close()

    def close(self) -> None:
        """Put everything back. More than once does no harm."""
        self._cleanup.close()

    # Events

    def begin(self, given: Given) -> None:
        """Do what started the chain, under the mouse."""
        if given.what is Sign.HOVER:
            self.state.has_begun, self.state.peek = True, given.event.type
            hover(self.state, given)
        else:
            act_first(self.state, given)
        self.show()

    def is_on_mirrored_half(self, event: bpy.types.Event) -> bool:
        """Return whether the mouse is over faces that only a Mirror modifier shows."""
        place = place_of(self._window.window, event)
        return place is not None and any(view.is_on_mirrored_half(place.view, place.cursor) for view in edited.views())

    def handle(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Do what an event asks for, and return whether Blender is to have it too. `state.is_idle` tells that the chain ends."""
        state = self.state
        state.find_front()
        is_released = event.type == state.peek and event.value == "RELEASE"
        if is_released or event.type == "WINDOW_DEACTIVATE":
            state.peek = ""
        if event.type != "TIMER":
            edited.follow_settings()
        given = self._events.read(context, event, state)
        if given.what not in {Sign.TICK, Sign.RELEASE}:
            self._window.set_cursor("CROSSHAIR" if given.place else "")
        passes = act(state, given)
        if given.what not in _UNSEEN:
            self.show()
        return passes

    def show(self) -> None:
        """Show the sessions as they are now."""
        self.state.find_front()
        state, session = self.state, self.session
        picture = (
            id(state.view),
            tuple((view.session.revision, view.islands.pointed_island) for view in edited.views()),
        )
        words = (
            round(100.0 * session.work.progress),
            session.computing,
            session.waiting_clicks,
            state.view.mesh.symmetric,
            state.notices.hint,
        )
        before, self._shown = self._shown, (picture, words)
        if before is None or picture != before[0]:
            edited.show()
            edited.redraw()
        if self._shown != before:
            for make in status_makers:
                self._window.workspace.status_text_set(make(self))
        # Last: what is shown may ask for more to be computed.
        self._window.set_timer(any(view.busy for view in edited.views()))

    def _on_settings(self) -> None:
        self._shown = None
        self.show()


def _leave_objects() -> None:
    edited.chain = False
    edited.watch()
    edited.redraw()
    for view in edited.views():
        view.stroke = None
        view.session.hover(None)
    edited.show()


def _on_save(*_: object) -> None:
    """Let files hold what is drawn so far."""
    for chain in tuple(running):
        chain.state.record.save()


def _on_load(*_: object) -> None:
    """End what is being drawn before another file is loaded."""
    for chain in tuple(running):
        chain.close()
