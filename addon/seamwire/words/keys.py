# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of a chain: one table of what each does, and what an event means by it.

`KeyMapItems.match_event` cannot match these keys: Blender turns a double click into a press before it calls a modal operator.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    Event = Any
    """One of Blender's events."""


@dataclass(frozen=True)
class Key:
    """A key or a button with its modifiers: 1 held, 0 not held, -1 either."""

    type: str
    value: str = "PRESS"
    ctrl: int = 0
    shift: int = 0
    alt: int = 0
    oskey: int = 0

    @classmethod
    def of(cls, event: Event) -> Key:
        return cls(event.type, event.value, *(int(getattr(event, name)) for name in MODIFIERS))

    def matches(self, event: Event, value: str) -> bool:
        pressed = "PRESS" if self.value in {"ANY", "CLICK"} else self.value
        return event.type == self.type and value == pressed and self.held(event)

    def held(self, event: Event) -> bool:
        """Whether its modifiers are as it wants them. The command key of other systems counts as Ctrl."""
        ctrl = event.ctrl if self.oskey == 1 else event.ctrl or event.oskey
        wanted = ((self.ctrl, ctrl), (self.shift, event.shift), (self.alt, event.alt))
        if self.oskey == 1 and not event.oskey:
            return False
        return all(want == -1 or bool(want) == bool(is_held) for want, is_held in wanted)

    @property
    def modifiers(self) -> str:
        names = (("Shift", self.shift), ("Ctrl", self.ctrl), ("Alt", self.alt), ("Cmd", self.oskey))
        return " ".join(name for name, want in names if want == 1)

    @property
    def text(self) -> str:
        double = "Double-" if self.value == "DOUBLE_CLICK" else ""
        name = _NAMES.get(self.type, self.type.replace("_", " ").title())
        return f"{self.modifiers} {double}{name}".strip()

    @property
    def icon(self) -> str:
        """Blender's icon of the key without its modifiers, or an empty string."""
        if self.type in _ICONS:
            return _ICONS[self.type]
        letter = len(self.type) == 1 and self.type.isalpha()
        function = self.type[:1] == "F" and self.type[1:].isdigit() and int(self.type[1:]) <= 12
        return f"EVENT_{self.type}" if letter or function else ""


MODIFIERS = ("ctrl", "shift", "alt", "oskey")
MODIFIER_KEYS = frozenset(
    {*(f"{side}_{key}" for side in ("LEFT", "RIGHT") for key in ("SHIFT", "CTRL", "ALT")), "OSKEY"}
)
"""Blender's names of the keys that are held with others."""
_ANY = dict.fromkeys(MODIFIERS, -1)


class Action(Enum):
    """Everything that keys can do: its text in the preferences and in tables of keys, its number, the group of the table, its keys.

    Blender stores the number with the keys that a user has changed. A number is never given to another action.
    """

    CLICK = ("Add Seed, Keep Wire, Join (drag: Draw Line, Move Seed)", 1, "Draw", Key("LEFTMOUSE"))
    LOOP = ("Add Loop", 3, "Draw", Key("LEFTMOUSE", "DOUBLE_CLICK"), Key("LEFTMOUSE", alt=1))
    BEND = ("Bend Closed Cut", 22, "Draw", Key("LEFTMOUSE", shift=1, alt=1))
    NEW_CHAIN = ("New Chain", 2, "Draw", Key("LEFTMOUSE", ctrl=1))
    GUIDE = ("Draw Guide Stroke (drag)", 5, "Draw", Key("LEFTMOUSE", shift=1))
    AVOID = ("Draw Avoid Stroke (drag)", 6, "Draw", Key("LEFTMOUSE", ctrl=1, shift=1))
    NEXT = (
        "Next Candidate",
        8,
        "Change the Wire",
        Key("W"),
        Key("W", alt=1),
        Key("WHEELUPMOUSE", alt=1),
        Key("WHEELDOWNMOUSE", alt=1),
    )
    STRONGER = ("Follow Shape More", 9, "Change the Wire", Key("WHEELUPMOUSE", shift=1))
    WEAKER = ("Follow Shape Less", 10, "Change the Wire", Key("WHEELDOWNMOUSE", shift=1))
    EXTEND = ("Extend to End", 12, "Change the Wire", Key("F"))
    CLOSE = ("Close Chain", 11, "Change the Wire", Key("C"))
    REMOVE = ("Remove Wire or Stroke", 4, "Change the Wire", Key("X"), Key("DEL"))
    SWITCH = ("Along Edges or Across Surface", 16, "Set", Key("E"))
    CLEAR = ("Mark or Clear Seams", 13, "Set", Key("S"))
    MIRROR = ("Mirror", 15, "Set", Key("M"))
    SNAP = ("Snap to Features", 17, "Set", Key("TAB", shift=1))
    XRAY = ("X-Ray", 14, "Set", Key("V"))
    END = ("End Chain", 7, "End and Undo", Key("RIGHTMOUSE"), Key("RET"), Key("NUMPAD_ENTER"))
    CANCEL = ("Cancel Wire", 21, "End and Undo", Key("ESC", **_ANY))
    UNDO = ("Undo in Chain", 19, "End and Undo", Key("Z", ctrl=1), Key("BACK_SPACE"))
    REDO = ("Redo in Chain", 20, "End and Undo", Key("Z", ctrl=1, shift=1))
    KEYS = ("Show Keys", 18, "End and Undo", Key("F1"))

    def __init__(self, text: str, number: int, group: str, *keys: Key) -> None:
        self.text, self.number, self.group, self.keys = text, number, group, keys


_ENDING = frozenset({Action.END, Action.CANCEL, Action.UNDO})
"""What cancels a drag."""
KEYS = tuple((action, key) for action in Action for key in action.keys)
"""All actions with each of their keys."""

_NAMES = {
    "LEFTMOUSE": "Click",
    "RIGHTMOUSE": "Right Click",
    "MIDDLEMOUSE": "Middle Click",
    "WHEELUPMOUSE": "Wheel Up",
    "WHEELDOWNMOUSE": "Wheel Down",
    "RET": "Enter",
    "NUMPAD_ENTER": "Numpad Enter",
    "ESC": "Esc",
    "DEL": "Delete",
    "BACK_SPACE": "Backspace",
    "ACCENT_GRAVE": "`",
    "COMMA": ",",
    "PERIOD": ".",
    **{
        name: str(i)
        for i, name in enumerate(["ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE"])
    },
}
_ICONS = {
    "LEFTMOUSE": "MOUSE_LMB",
    "RIGHTMOUSE": "MOUSE_RMB",
    "MIDDLEMOUSE": "MOUSE_MMB",
    "WHEELUPMOUSE": "MOUSE_MMB",
    "WHEELDOWNMOUSE": "MOUSE_MMB",
    "RET": "EVENT_RETURN",
    "ESC": "EVENT_ESC",
    "SPACE": "EVENT_SPACEKEY",
    "TAB": "EVENT_TAB",
}
WHEEL = ("WHEELUPMOUSE", "WHEELDOWNMOUSE")


class Bindings:
    """What each key does now: actions and their keys, of which the first that matches counts."""

    def __init__(self, keys: Sequence[tuple[Action, Key]] = KEYS) -> None:
        # A double click is a press as well: those who want two come first.
        self._keys = sorted(keys, key=lambda pair: pair[1].value != "DOUBLE_CLICK")

    def without(self, taken: Callable[[Key], bool]) -> Bindings:
        """Return them without the keys that somebody else takes first."""
        return Bindings([(action, key) for action, key in self._keys if not taken(key)])

    def while_held(self, own: Iterable[str]) -> Bindings:
        """Return them while a button is held: its own modifiers need not be released, and what cancels or ends ignores all modifiers."""

        def ignoring(key: Key, names: Iterable[str]) -> Key:
            return replace(key, **{name: -1 for name in names if getattr(key, name) == 0})

        ending = [(action, ignoring(key, MODIFIERS)) for action, key in self._keys if action in _ENDING]
        return Bindings([*((action, ignoring(key, own)) for action, key in self._keys), *ending])

    def decode(self, event: Event, double: bool = False) -> Action | None:
        values = ("DOUBLE_CLICK", event.value) if double else (event.value,)
        return next((action for value in values for action, key in self._keys if key.matches(event, value)), None)

    def keys_of(self, action: Action) -> list[Key]:
        return [key for of, key in self._keys if of is action]

    def previews(self, action: Action, event: Event) -> bool:
        """Whether the modifiers are held with which a click would take a loop, or bend a cut, as the action says."""
        keys = self.keys_of(action)
        return any(key.modifiers and key.value != "DOUBLE_CLICK" and key.held(event) for key in keys)

    def text(self, action: Action) -> str:
        keys = self.keys_of(action)

        def name(key: Key) -> str:
            # Both ways of the wheel are one thing to say.
            is_both = key.type in WHEEL and all(replace(key, type=way) in keys for way in WHEEL)
            return replace(key, type="WHEEL").text if is_both else key.text

        return ", ".join(dict.fromkeys(map(name, keys)))

    def icon(self, action: Action) -> tuple[str, str]:
        """Return the icon of an action's first key, no double click if possible, and the text before its name."""
        keys = self.keys_of(action)
        if not keys:
            return "", ""
        key = next((key for key in keys if key.value != "DOUBLE_CLICK"), keys[0])
        if not key.icon:
            return "", key.text
        wheel = "Wheel" if key.type in WHEEL else ""
        return key.icon, f"{key.modifiers} {wheel}".strip()

    def groups(self) -> dict[str, list[tuple[str, str]]]:
        groups = dict.fromkeys(action.group for action in Action)
        bound = [action for action in Action if self.keys_of(action)]
        return {name: [(self.text(each), each.text) for each in bound if each.group == name] for name in groups}


class DoubleClicks:
    """Finds double clicks: Blender hands modal operators the second press as any other.

    The time between the first release and the second press counts, as the events are handled. A slow redraw between the presses delays
    both events alike.
    """

    def __init__(self) -> None:
        self._pressed: tuple[int, int] | None = None
        self._released: tuple[str, float, tuple[int, int]] | None = None

    def is_second(self, event: Event, now: float, preferences: Any) -> bool:  # noqa: ANN401 - Blender's
        """Whether an event is the second press of a double click, `now` in seconds. To be asked of every event of the mouse's buttons."""
        if not event.type.endswith("MOUSE") or event.type.startswith("WHEEL"):
            return False
        here = event.mouse_x, event.mouse_y
        pressed, self._pressed = self._pressed, here if event.value == "PRESS" else None
        released, self._released = self._released, None

        def is_near(other: tuple[int, int]) -> bool:
            away = max(abs(here[0] - other[0]), abs(here[1] - other[1]))
            return away <= drag_threshold(event, preferences)

        if event.value == "RELEASE" and (pressed is None or is_near(pressed)):  # a drag does not count as a first click
            self._released = event.type, now, here
        if event.value != "PRESS" or released is None or released[0] != event.type:
            return False
        return (now - released[1]) * 1000.0 < preferences.inputs.mouse_double_click_time and is_near(released[2])


def drag_threshold(event: Event, preferences: Any) -> float:  # noqa: ANN401 - Blender's
    """Return how many pixels a button must be moved to drag: as Blender counts, more on a display of larger scale."""
    inputs = preferences.inputs
    threshold = inputs.drag_threshold_tablet if event.is_tablet else inputs.drag_threshold_mouse
    return threshold * preferences.system.ui_scale
