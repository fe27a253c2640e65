# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds out what an event means to a chain: the action of a key, or a sign such as a motion of the mouse."""

from __future__ import annotations

import time
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from ..mesh import settings as chosen
from ..view.viewport import contains, place_of
from ..words.keys import MODIFIER_KEYS, WHEEL, Action, Key
from . import keymaps

if TYPE_CHECKING:
    import bpy

    from ..view.viewport import Place
    from .chain import Chain

_HARMLESS = MODIFIER_KEYS.union(WHEEL)
"""Presses that change no mesh, wherever the mouse is."""


class Sign(Enum):
    """The meaning of an event that is not the action of a key."""

    TICK = "It is time for another look at running work"
    RELEASE = "The held button is released"
    AWAY = "The mouse moves where nothing is drawn"
    DRAG = "The mouse moves while a button is held"
    TRACE = "The mouse was here between two motions"
    HOVER = "The mouse moves over a view, or a modifier has changed"
    ZOOM = "The view comes closer or goes back"
    OTHER_TOOL = "The event does something else in Blender for which the chain must end"
    NOTHING = "The event is Blender's alone"
    REPEAT = "A key repeats that acts only once"


class Meant(NamedTuple):
    """Blender's event, its meaning, and the place in a 3D view under the mouse, if there is one."""

    what: Action | Sign
    event: bpy.types.Event
    place: Place | None = None


def read(chain: Chain, context: bpy.types.Context, event: bpy.types.Event) -> Meant:
    """Return what an event means in the chain's state.

    An event may tell that a key or button is no longer held, although its release went elsewhere. Then the chain lets go first.
    """
    is_release = event.value == "RELEASE"
    if chain.peek and ((is_release and event.type == chain.peek) or event.type == "WINDOW_DEACTIVATE"):
        chain.go("DRAWING")
    if chain.hold is not None and event.type == chain.hold.button and not is_release and not event.is_repeat:
        chain.let_go()  # another window has received the release, and this press is not a drag's
    hold = chain.hold
    if event.type == "TIMER":
        return Meant(Sign.TICK, event)
    if hold is not None and event.value in {"PRESS", "RELEASE"}:  # motions may come without the modifiers
        hold.follow_modifiers(event)
    # Another window may show another scene, where other objects are edited.
    is_same = context.view_layer == chain.window.view_layer and context.mode == "EDIT_MESH"
    can_draw = chain.follow_mouse(context.window) and is_same
    place = place_of(context.window, event) if can_draw else None
    double = chain.clicks.is_second(event, time.monotonic(), context.preferences)
    if hold is not None and is_release and event.type == hold.button:
        return Meant(Sign.RELEASE, event, place)
    motion = _motion(chain, event)
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
    is_wheel = event.type in WHEEL and not (event.shift or event.alt or event.oskey)
    if is_wheel and chosen.preferences(context).wheel_switches and chain.session.seed is not None:
        return Sign.ZOOM if event.ctrl else Action.NEXT
    if keymaps.takes(Key.of(event), context):
        return Sign.NOTHING
    bindings = chain.keys if chain.hold is None else chain.keys.while_held(chain.hold.modifiers)
    action = bindings.decode(event, double)
    if action is None:
        return Sign.OTHER_TOOL if keymaps.is_other(event, chain.manager) else Sign.NOTHING
    is_repeat = event.is_repeat and action not in {Action.UNDO, Action.REDO}
    return Sign.REPEAT if is_repeat else action


def _motion(chain: Chain, event: bpy.types.Event) -> Sign | None:
    """Return what a motion means, or None for a key or a button."""
    held = None if chain.hold is None else chain.hold.what
    if event.type == "INBETWEEN_MOUSEMOVE":
        return {None: Sign.NOTHING, "SEED": Sign.NOTHING, "LINE": Sign.TRACE}.get(held, Sign.DRAG)
    if event.type == "MOUSEMOVE":
        return Sign.HOVER if held is None else Sign.DRAG
    if event.type == "WINDOW_DEACTIVATE" or event.type.startswith("TIMER"):
        return Sign.NOTHING
    return Sign.HOVER if event.type in MODIFIER_KEYS else None


def _is_over_settings(window: bpy.types.Window, event: bpy.types.Event) -> bool:
    """Return whether the mouse is over the settings of a 3D view's tool, which a chain follows."""
    regions = (region for area in window.screen.areas if area.type == "VIEW_3D" for region in area.regions)
    return any(contains(own, event.mouse_x, event.mouse_y) for own in regions if own.type in {"TOOL_HEADER", "UI"})
