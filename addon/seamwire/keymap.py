# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys: one to start the tool, and what each does while it runs."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Iterator

OPERATOR = "mesh.seamwire_draw"
START = {"type": "W", "value": "PRESS", "ctrl": True, "alt": True}


class Action(Enum):
    """What the artist asks for."""

    CLICK = auto()
    START_CHAIN = auto()
    LOOP = auto()
    END_CHAIN = auto()
    TOGGLE = auto()
    SWITCH = auto()
    UNDO = auto()
    REDO = auto()
    FINISH = auto()
    LEAVE = auto()


@dataclass(frozen=True)
class Key:
    """A key or a button and what it does. None for a modifier: held or not."""

    action: Action
    type: str
    value: str = "PRESS"
    ctrl: bool | None = None
    shift: bool | None = None
    alt: bool | None = None

    def matches(self, event: bpy.types.Event, value: str) -> bool:
        """Whether an event of this value is this key."""
        ctrl = event.ctrl or event.oskey
        held = ((self.ctrl, ctrl), (self.shift, event.shift), (self.alt, event.alt))
        return (
            event.type == self.type
            and value == self.value
            and all(wanted is None or wanted == is_held for wanted, is_held in held)
        )


KEYS = (
    Key(Action.LOOP, "LEFTMOUSE", value="DOUBLE_CLICK"),
    Key(Action.LOOP, "LEFTMOUSE", alt=True),
    Key(Action.START_CHAIN, "LEFTMOUSE", ctrl=True),
    Key(Action.CLICK, "LEFTMOUSE"),
    Key(Action.END_CHAIN, "RIGHTMOUSE"),
    Key(Action.TOGGLE, "WHEELUPMOUSE", ctrl=False, shift=False, alt=False),
    Key(Action.TOGGLE, "WHEELDOWNMOUSE", ctrl=False, shift=False, alt=False),
    Key(Action.SWITCH, "E", ctrl=False, shift=False, alt=False),
    Key(Action.UNDO, "Z", ctrl=True, shift=False, alt=False),
    Key(Action.REDO, "Z", ctrl=True, shift=True, alt=False),
    Key(Action.FINISH, "RET"),
    Key(Action.FINISH, "NUMPAD_ENTER"),
    Key(Action.LEAVE, "ESC"),
)
"""The first that matches counts."""

_NAVIGATION = frozenset(
    {
        "MIDDLEMOUSE",
        "WHEELUPMOUSE",
        "WHEELDOWNMOUSE",
        "WHEELINMOUSE",
        "WHEELOUTMOUSE",
        "TRACKPADPAN",
        "TRACKPADZOOM",
        "MOUSEROTATE",
        "MOUSESMARTZOOM",
        "HOME",
        "ACCENT_GRAVE",
    }
)
_SHADING_AND_SIDEBARS = frozenset({"Z", "N", "T"})


def action_of(event: bpy.types.Event, double: bool = False) -> Action | None:
    """Return what an event asks for; `double`: it is the second press of a double click."""
    value = "DOUBLE_CLICK" if double else event.value
    return next((key.action for key in KEYS if key.matches(event, value)), None)


class DoubleClicks:
    """Finds double clicks: Blender hands modal operators the second press as any other.

    The time that counts is that from the first release to the second press, as they are handled: where a redraw comes
    between the two presses, however long it takes, the release has waited as well.
    """

    def __init__(self) -> None:
        self._released: tuple[float, int, int] | None = None

    def is_second(self, event: bpy.types.Event, now: float, inputs: bpy.types.PreferencesInput) -> bool:
        """Whether an event is the second press of a double click. To be asked of every event of the left button.

        Parameters
        ----------
        event
            Of the left mouse button.
        now
            Seconds, from any beginning.
        inputs
            The preferences, for what counts as a double click and as the same place.
        """
        if event.value == "RELEASE":
            self._released = (now, event.mouse_x, event.mouse_y)
            return False
        released, self._released = self._released, None
        if released is None or event.value != "PRESS":
            return False
        soon = (now - released[0]) * 1000.0 < inputs.mouse_double_click_time
        away = max(abs(event.mouse_x - released[1]), abs(event.mouse_y - released[2]))
        return soon and away <= inputs.drag_threshold_mouse


def is_navigation(event: bpy.types.Event) -> bool:
    """Whether an event moves the view or changes how it is shown, and nothing else."""
    if event.type.startswith("NDOF_") or (event.type.startswith("NUMPAD_") and event.type != "NUMPAD_ENTER"):
        return True
    if event.type in _SHADING_AND_SIDEBARS:
        return not event.ctrl and not event.oskey
    # Alt and the wheel change the frame.
    return event.type in _NAVIGATION and not (event.alt and event.type.startswith("WHEEL"))


def is_blender_undo(event: bpy.types.Event) -> bool:
    """Whether an event would make Blender undo or redo: that must never happen under the running tool."""
    return event.type == "Z" and (event.ctrl or event.oskey)


_registered: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []


def register() -> None:
    """Add the key that starts the tool in edit mode."""
    _registered.extend(_add())


def _add() -> Iterator[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]]:
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is not None:  # there is none in background mode
        keymap = configuration.keymaps.new(name="Mesh", space_type="EMPTY")
        yield keymap, keymap.keymap_items.new(OPERATOR, **START)


def unregister() -> None:
    """Remove it."""
    while _registered:
        keymap, item = _registered.pop()
        keymap.keymap_items.remove(item)
