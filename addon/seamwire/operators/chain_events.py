# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds out what an event means to a chain: the action of a key, or a sign such as a motion of the mouse."""

from __future__ import annotations

import time
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from ..mesh import settings as chosen
from ..view.viewport import place_of
from ..words.keys import WHEEL, Action, DoubleClicks, Key
from . import navigation
from .drag_handlers import LineHold, StrokeHold
from .navigation import Meaning

if TYPE_CHECKING:
    import bpy

    from ..view.viewport import Place
    from .chain_state import ChainState
    from .chain_window import ChainWindow


class Sign(Enum):
    """The meaning of an event that is not the action of a key."""

    TICK = auto()
    """Time for another look at running work."""
    RELEASE = auto()
    """The held button is released."""
    AWAY = auto()
    """The mouse moves where nothing is drawn."""
    DRAG = auto()
    """The mouse moves while a button is held."""
    TRACE = auto()
    """The mouse was here between two motions."""
    HOVER = auto()
    """The mouse moves over a view, or a modifier has changed."""
    ZOOM = auto()
    """The view comes closer or goes back."""
    OTHER_TOOL = auto()
    """The event does something else in Blender for which the chain must end."""
    NOTHING = auto()
    """The event is Blender's alone."""
    REPEAT = auto()
    """A key repeats that acts only once."""


@dataclass(frozen=True)
class Given:
    """An event and its meaning.

    Parameters
    ----------
    what
        The meaning.
    event
        Blender's event.
    place
        The place in a 3D view under the mouse, or None.
    """

    what: Action | Sign
    event: bpy.types.Event
    place: Place | None = None


class EventReader:
    """Reads the events of a chain.

    Parameters
    ----------
    window
        The window that the events come from.
    """

    def __init__(self, window: ChainWindow) -> None:
        self._window = window
        self._clicks = DoubleClicks()

    def read(self, context: bpy.types.Context, event: bpy.types.Event, state: ChainState) -> Given:
        """Return what an event means in this state of the chain."""
        if event.type == "TIMER":
            return Given(Sign.TICK, event)
        place = place_of(self._window.window, event)
        double = self._clicks.is_second(event, time.monotonic(), context.preferences)
        hold = state.hold
        if hold is not None and event.type == hold.button and event.value == "RELEASE":
            return Given(Sign.RELEASE, event, place)
        if place is None:
            return Given(self._away(context, event, state, double), event)
        if event.type.endswith("MOUSE") and hold is None and navigation.on_gizmo(place, context.preferences):
            return Given(Sign.NOTHING, event)
        return Given(_motion(event, state) or self._key(context, event, state, double), event, place)

    def _away(
        self, context: bpy.types.Context, event: bpy.types.Event, state: ChainState, double: bool
    ) -> Action | Sign:
        if event.type == "MOUSEMOVE":
            return Sign.AWAY
        if state.hold is not None and _motion(event, state) is None:
            what = self._key(context, event, state, double)
            return Sign.NOTHING if what is Sign.ZOOM else what
        is_pressed = event.value == "PRESS" and not self._window.is_over_settings(event)
        return Sign.OTHER_TOOL if is_pressed and state.hold is None else Sign.NOTHING

    def _key(
        self, context: bpy.types.Context, event: bpy.types.Event, state: ChainState, double: bool
    ) -> Action | Sign:
        if _turns_wheel(context, event, state):
            return Sign.ZOOM if event.ctrl else Action.NEXT
        if navigation.takes(Key.of(event), context):
            return Sign.NOTHING
        action = state.keys.decode(event, double)
        if action is None:
            is_other = navigation.meaning(event, self._window.manager) is Meaning.OTHER
            return Sign.OTHER_TOOL if is_other else Sign.NOTHING
        is_repeat = getattr(event, "is_repeat", False) and action not in {Action.UNDO, Action.REDO}
        return Sign.REPEAT if is_repeat else action


def _motion(event: bpy.types.Event, state: ChainState) -> Sign | None:
    """Return what a motion means, or None for a key or a button."""
    hold = state.hold
    if event.type == "INBETWEEN_MOUSEMOVE":
        if isinstance(hold, LineHold):
            return Sign.TRACE
        return Sign.DRAG if isinstance(hold, StrokeHold) else Sign.NOTHING
    if event.type == "MOUSEMOVE":
        return Sign.HOVER if hold is None else Sign.DRAG
    if event.type == "WINDOW_DEACTIVATE" or event.type.startswith("TIMER"):
        return Sign.NOTHING
    return Sign.HOVER if event.type.endswith(("_ALT", "_CTRL", "_SHIFT")) else None


def _turns_wheel(context: bpy.types.Context, event: bpy.types.Event, state: ChainState) -> bool:
    """Return whether the wheel turns, alone or with Ctrl, and the preferences give it to the candidates."""
    if event.type not in WHEEL or event.shift or event.alt or event.oskey:
        return False
    return chosen.preferences(context).wheel_switches and state.session.seed is not None
