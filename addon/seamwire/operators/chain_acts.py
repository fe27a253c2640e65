# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of what a chain does for each meaning of an event."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..view.edited_objects import edited
from ..words.keys import Action
from . import chain_gestures as gestures
from . import chain_keys as keys
from .chain_events import Given, Sign

if TYPE_CHECKING:
    from collections.abc import Callable

    from .chain_state import ChainState


def _tick(_state: ChainState, _given: Given) -> None:
    edited.poll()


def _end(state: ChainState, _given: Given) -> None:
    state.end()


def _cancel(state: ChainState, _given: Given) -> None:
    state.end(wait=False)


def _remove(state: ChainState, given: Given) -> bool:
    """Remove what is under the mouse. If there is nothing, Blender's own meaning of the key changes the mesh."""
    is_removed = gestures.remove(state, given)
    if not is_removed:
        state.end()
    return not is_removed


def _let_go(state: ChainState, _given: Given) -> None:
    """Cancel what is held, and nothing else."""
    state.let_go()


def _refuse(state: ChainState, _given: Given) -> None:
    """Do nothing, because the held button comes first."""
    state.say("Release the button first")


def _end_held(state: ChainState, given: Given) -> None:
    """Cancel what is held if another button asks for it, as in Blender's own drags. A key waits."""
    (_let_go if given.event.type.endswith("MOUSE") else _refuse)(state, given)


def _nothing(_state: ChainState, _given: Given) -> None:
    """Leave everything as it is."""


ACTS: dict[Action | Sign, Callable[[ChainState, Given], bool | None]] = {
    Action.CLICK: gestures.click,
    Action.NEW_CHAIN: gestures.click,
    Action.LOOP: gestures.click,
    Action.BEND: gestures.click,
    Action.REMOVE: _remove,
    Action.GUIDE: gestures.begin_stroke,
    Action.AVOID: gestures.begin_stroke,
    Action.END: _end,
    Action.CANCEL: _cancel,
    Action.NEXT: keys.swap,
    Action.STRONGER: keys.change_strength,
    Action.WEAKER: keys.change_strength,
    Action.CLOSE: keys.close,
    Action.EXTEND: keys.extend,
    Action.CLEAR: keys.toggle_clear,
    Action.XRAY: keys.toggle_xray,
    Action.MIRROR: keys.cycle_mirror,
    Action.SWITCH: keys.switch,
    Action.SNAP: keys.toggle_snap,
    Action.KEYS: keys.show_keys,
    Action.UNDO: keys.undo,
    Action.REDO: keys.redo,
    Sign.TICK: _tick,
    Sign.RELEASE: gestures.release,
    Sign.AWAY: gestures.leave,
    Sign.DRAG: gestures.drag,
    Sign.TRACE: gestures.trace,
    Sign.HOVER: gestures.hover,
    Sign.ZOOM: gestures.zoom,
    Sign.OTHER_TOOL: _end,
    Sign.NOTHING: _nothing,
    Sign.REPEAT: _nothing,
}
"""The function for each meaning. If it returns True, Blender has the event too."""
WHILE_HELD: dict[Action | Sign, Callable[[ChainState, Given], bool | None]] = {
    **dict.fromkeys(Action, _refuse),
    **{what: ACTS[what] for what in Sign},
    Action.XRAY: keys.toggle_xray,
    Action.UNDO: _let_go,
    Action.CANCEL: _let_go,
    Action.END: _end_held,
    Sign.OTHER_TOOL: _refuse,
}
"""The function for each meaning while a button is held. A key works only on what is held, or on what is shown."""
_FIRST = {**ACTS, Action.REMOVE: gestures.remove, Action.NEXT: gestures.retrace}
"""The function for a press that begins a chain."""
_BLENDERS = frozenset({Sign.TICK, Sign.AWAY, Sign.HOVER, Sign.OTHER_TOOL, Sign.NOTHING})
"""Signs that Blender always receives too."""


def act(state: ChainState, given: Given) -> bool:
    """Do what an event asks for, and return whether Blender is to have it too."""
    if isinstance(given.what, Action):
        state.say("")
        if given.what is not Action.NEXT:
            state.peek = ""
        if state.hold is not None and given.event.type == state.hold.button:
            state.let_go()  # another window has received the release
    is_held = state.hold is not None
    passes = bool((WHILE_HELD if is_held else ACTS)[given.what](state, given))
    state.end_if_done()
    return passes or (given.what in _BLENDERS and not (is_held and given.what is Sign.OTHER_TOOL))


def act_first(state: ChainState, given: Given) -> None:
    """Do what begins a chain."""
    state.has_begun = given.place is not None
    if state.has_begun:
        _FIRST[given.what](state, given)
