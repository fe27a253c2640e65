# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds out what an event means to a chain: the action of a key, or a sign such as a motion of the mouse."""

from __future__ import annotations

import time
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from ..mesh import settings as chosen
from ..view.viewport import place_of
from ..words.keys import MODIFIER_KEYS, WHEEL, Action, Key
from . import keymaps
from .holds import LineHold, StrokeHold
from .running import Cue, Stage

if TYPE_CHECKING:
    import bpy

    from ..view.viewport import Place
    from .chain import Chain
    from .holds import Hold

_HARMLESS = MODIFIER_KEYS.union(WHEEL)
"""Presses that change no mesh, wherever the mouse is."""


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
class Meant:
    """Blender's event, its meaning, and the place in a 3D view under the mouse, if there is one."""

    what: Action | Sign
    event: bpy.types.Event
    place: Place | None = None


def read(chain: Chain, context: bpy.types.Context, event: bpy.types.Event) -> Meant:
    """Return what an event means in the chain's state.

    An event may tell that a key or button is no longer held, although its release went elsewhere. Then the chain lets go first.
    """
    is_released = event.type == chain.peek and event.value == "RELEASE"
    if chain.stage is Stage.PEEKING and (is_released or event.type == "WINDOW_DEACTIVATE"):
        chain.go(Cue.UNPEEK)
    is_press = event.value != "RELEASE" and not event.is_repeat
    if chain.hold is not None and event.type == chain.hold.button and is_press:
        chain.let_go()  # another window has received the release, and this press is not a drag's
    if event.type == "TIMER":
        return Meant(Sign.TICK, event)
    if chain.hold is not None and event.value in {"PRESS", "RELEASE"}:  # motions may come without the modifiers
        chain.hold.follow_modifiers(event)
    # Another window may show another scene, where other objects are edited.
    is_same = context.view_layer == chain.window.view_layer and context.mode == "EDIT_MESH"
    can_draw = chain.follow_mouse(context.window) and is_same
    place = place_of(context.window, event) if can_draw else None
    double = chain.clicks.is_second(event, time.monotonic(), context.preferences)
    hold = chain.hold
    if hold is not None and event.type == hold.button and event.value == "RELEASE":
        return Meant(Sign.RELEASE, event, place)
    motion = _motion(event, hold)
    if place is not None:
        if event.type.endswith("MOUSE") and hold is None and keymaps.on_gizmo(place, context.preferences):
            return Meant(Sign.NOTHING, event)
        return Meant(motion or _key(chain, context, event, double), event, place)
    if event.type == "MOUSEMOVE":
        return Meant(Sign.AWAY, event)
    if hold is not None and motion is None:
        what = _key(chain, context, event, double)
        return Meant(Sign.NOTHING if what is Sign.ZOOM else what, event)
    if event.value != "PRESS" or hold is not None or event.type in _HARMLESS:
        return Meant(Sign.NOTHING, event)
    # Undo in Blender would take wires out of the mesh that the chain writes again. Backspace alone resets a setting.
    action = chain.keys.decode(event, double)
    is_undo = action in {Action.UNDO, Action.REDO} and (event.ctrl or event.oskey)
    # Windows without a view, such as Blender's preferences, belong to Blender.
    has_view = any(area.type == "VIEW_3D" for area in context.window.screen.areas)
    is_elsewhere = context.window != chain.window and (is_undo or not has_view)
    if _is_over_settings(context.window, event) or is_elsewhere:
        return Meant(action if is_undo else Sign.NOTHING, event)
    return Meant(Sign.OTHER_TOOL, event)


def _key(chain: Chain, context: bpy.types.Context, event: bpy.types.Event, double: bool) -> Action | Sign:
    """Return what a key, a button or the wheel means."""
    if _turns_wheel(chain, context, event):
        return Sign.ZOOM if event.ctrl else Action.NEXT
    if keymaps.takes(Key.of(event), context):
        return Sign.NOTHING
    bindings = chain.keys if chain.hold is None else chain.keys.while_held(chain.hold.modifiers)
    action = bindings.decode(event, double)
    if action is None:
        return Sign.OTHER_TOOL if keymaps.is_other(event, chain.manager) else Sign.NOTHING
    is_repeat = event.is_repeat and action not in {Action.UNDO, Action.REDO}
    return Sign.REPEAT if is_repeat else action


def _motion(event: bpy.types.Event, hold: Hold | None) -> Sign | None:
    """Return what a motion means, or None for a key or a button."""
    if event.type == "INBETWEEN_MOUSEMOVE":
        if isinstance(hold, LineHold):
            return Sign.TRACE
        return Sign.DRAG if isinstance(hold, StrokeHold) else Sign.NOTHING
    if event.type == "MOUSEMOVE":
        return Sign.HOVER if hold is None else Sign.DRAG
    if event.type == "WINDOW_DEACTIVATE" or event.type.startswith("TIMER"):
        return Sign.NOTHING
    return Sign.HOVER if event.type in MODIFIER_KEYS else None


def _turns_wheel(chain: Chain, context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Return whether the wheel turns, alone or with Ctrl, and the preferences give it to the candidates."""
    if event.type not in WHEEL or event.shift or event.alt or event.oskey:
        return False
    return chosen.preferences(context).wheel_switches and chain.session.seed is not None


def _is_over_settings(window: bpy.types.Window, event: bpy.types.Event) -> bool:
    """Return whether the mouse is over the settings of a 3D view's tool, which a chain follows."""
    x, y = event.mouse_x, event.mouse_y
    regions = (region for area in window.screen.areas if area.type == "VIEW_3D" for region in area.regions)
    return any(
        region.x <= x < region.x + region.width and region.y <= y < region.y + region.height
        for region in regions
        if region.type in {"TOOL_HEADER", "UI"}
    )
