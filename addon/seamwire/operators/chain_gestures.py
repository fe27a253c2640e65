# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mouse does in a chain: clicks, drags, strokes, and the wires and strokes under it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..view.edited_objects import edited
from ..words.keys import Action, drag_threshold
from . import navigation, undo_steps
from .chain_events import Given, Sign
from .drag_handlers import LineHold, SeedHold, StrokeHold

if TYPE_CHECKING:
    from ..core.drawing.session import Session
    from ..core.network.network import Snap
    from ..core.network.strokes import Stroke
    from ..core.network.wires import Wire
    from ..view.object_view import ObjectView
    from ..view.viewport import Place
    from .chain_state import ChainState

_OFFERED = (Action.LOOP, Action.BEND)
"""The preview while the modifiers of its click are held."""


def can_bend(state: ChainState) -> bool:
    """Return whether there may be a closed cut to bend. Along edges there is no such cut."""
    return state.session.options.along == "SURFACE"


def can_preview(state: ChainState, given: Given) -> bool:
    """Return whether the held modifiers show what their click would take."""
    offered = _OFFERED if can_bend(state) else (Action.LOOP,)
    return given.place is not None and any(state.keys.previews(action, given.event) for action in offered)


# Motions


def hover(state: ChainState, given: Given) -> None:
    """Show what a click would take."""
    assert given.place is not None
    loop, bend = (state.keys.previews(action, given.event) for action in _OFFERED)
    view, snap = edited.find(given.place, plain=loop or bend)
    edited.point_at(view, given.place)
    if view is not None and view is not edited.front:
        state.session.hover(None)
        # A live wire stays with its object until there is a click on another.
        if state.session.seed is None and not state.session.waiting_clicks:
            edited.front = view
        else:
            snap = None
    state.session.hover(snap, loop=loop, bend=bend)


def rehover(state: ChainState, place: Place) -> None:
    """Show what a click would take now, after a change."""
    view, snap = edited.find(place)
    state.find_front()
    state.session.hover(snap if view is edited.front else None)


def leave(state: ChainState, _given: Given) -> None:
    """Show nothing under a mouse that has left the view."""
    if state.session.target is not None and state.hold is None:
        state.session.hover(None)


def zoom(_state: ChainState, given: Given) -> None:
    """Zoom, because the wheel alone swaps candidates."""
    assert given.place is not None
    navigation.zoom(bpy.context, given.place, given.event)


def drag(state: ChainState, given: Given) -> None:
    """Let the held thing follow the mouse."""
    hold = state.hold
    assert hold is not None and given.place is not None
    is_held = hold.move(given.place, drag_threshold(given.event, bpy.context.preferences))
    if not is_held and state.hold is hold:
        state.hold = None


def trace(state: ChainState, given: Given) -> None:
    """Let a line go through where the mouse was between two motions."""
    assert isinstance(state.hold, LineHold) and given.place is not None
    state.hold.follow(given.place)


def release(state: ChainState, given: Given) -> None:
    """Do what was meant by a press and a release."""
    hold, state.hold = state.hold, None
    assert hold is not None
    # The wires that were live before a line become a separate chain, with a separate step in Blender's undo.
    if not (isinstance(hold, LineHold) and hold.starts_chain()) or _keep_chain(state):
        title = hold.release()
        if title:
            state.record.note(title)
        elif isinstance(hold, StrokeHold):
            state.say("Drag over the mesh to draw a stroke")
    if given.place is not None:
        rehover(state, given.place)


def _keep_chain(state: ChainState) -> bool:
    """Keep the live wires as a separate chain, and return whether the object is still the same."""
    view = state.view
    state.keep()
    if view not in edited.views():
        state.say("The mesh was cut: draw the line once more")
        return False
    state.draw_on(view)
    return True


# Presses


def click(state: ChainState, given: Given) -> None:
    """Take what is under the mouse, or begin to drag it."""
    action, place, event = given.what, given.place, given.event
    assert place is not None
    view, snap = edited.find(place, plain=action in _OFFERED)
    if view is None or snap is None:
        return
    state.has_begun = True
    if view is not edited.front:
        state.session.hover(None)
    if action is Action.NEW_CHAIN and not view.session.waiting_clicks:
        state.keep()
        if view not in edited.views():  # it was cut
            view, snap = edited.find(place)
            if view is None or snap is None:
                return
    state.draw_on(view)
    session = view.session
    if action is Action.NEW_CHAIN:
        session.start(snap)
        session.hover(snap)
        state.record.note(undo_steps.DRAW)
    elif action is Action.BEND:
        session.bend(snap)
        state.record.note(undo_steps.EDIT)
    elif action is Action.LOOP and _is_loop(state, session, snap, event):
        session.loop(snap)
        state.record.note(undo_steps.DRAW)
    elif session.seed is None and not session.waiting_clicks and snap.to in {"SEED", "WIRE"}:
        # Whether it is a click or the beginning of a drag is known when the button or the mouse has moved.
        session.hover(snap)
        state.hold = SeedHold(event.type, view, snap, place)
    elif snap.to in {"MESH", "FEATURE", "SEAM"} or session.goes_on_from(snap):
        state.hold = LineHold(event.type, view, snap, place)
    else:
        session.click(snap)
        state.record.note(undo_steps.DRAW)


def _is_loop(state: ChainState, session: Session, snap: Snap, event: bpy.types.Event) -> bool:
    """Return whether a click takes what runs around. Across the surface, a double click ends a wire instead."""
    if session.options.along == "SURFACE":
        return state.keys.previews(Action.LOOP, event)
    return isinstance(snap.pick, tuple)


def begin_stroke(state: ChainState, given: Given) -> None:
    """Begin a stroke under the mouse."""
    assert given.place is not None
    state.has_begun = True
    found, _ = edited.find(given.place)
    is_live = state.session.seed is not None or state.session.waiting_clicks
    view = state.view if is_live or found is None else found
    state.draw_on(view)
    state.cancel_drags()
    scale = bpy.context.preferences.system.ui_scale
    state.hold = StrokeHold(given.event.type, view, given.place, given.what is Action.GUIDE, scale)


def has_target(state: ChainState, given: Given) -> bool:
    """Return whether a press that may begin a chain finds something to act on, without changing anything."""
    if given.place is None:
        return False
    if given.what is Sign.HOVER:
        return can_preview(state, given)
    if given.what is Action.BEND:
        return can_bend(state)
    _, wire, stroke = _drawn_at(given)
    return wire is not None or (stroke is not None and given.what is Action.REMOVE)


def _drawn_at(given: Given) -> tuple[ObjectView | None, Wire | None, Stroke | None]:
    """Return the object under the mouse, and the kept wire there, or else the stroke."""
    assert given.place is not None
    view, snap = edited.find(given.place)
    if view is None or (snap is not None and snap.to == "WIRE"):
        return view, None if snap is None else snap.wire, None
    return view, None, view.stroke_at(given.place.view, given.place.cursor)


def remove(state: ChainState, given: Given) -> bool:
    """Remove the wire or the stroke under the mouse, and return whether there was one."""
    view, wire, stroke = _drawn_at(given)
    if view is None or (wire is None and stroke is None):
        return False
    assert given.place is not None
    state.draw_on(view)
    if wire is not None:
        view.session.drop(wire)
        state.record.note(undo_steps.EDIT)
    elif stroke is not None:
        view.session.erase(stroke)
        state.record.note(undo_steps.EDIT)
    rehover(state, given.place)
    return True


def retrace(state: ChainState, given: Given) -> bool:
    """Let the wire under the mouse take its other path, and return whether there was one."""
    assert given.place is not None
    view, snap = edited.find(given.place)
    if view is None or snap is None or snap.to != "WIRE" or snap.wire is None:
        return False
    state.draw_on(view)
    view.session.hover(snap)
    view.session.retrace(snap.wire)
    state.record.note(undo_steps.EDIT)
    return True
