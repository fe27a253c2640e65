# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys: one table of what each does, registered with Blender so that its user can change them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

OPERATOR = "mesh.seamwire_draw"
ACTION_OPERATOR = "mesh.seamwire_key"
"""Stands for what a key does while the tool runs; it does nothing by itself."""
NAME = "Seamwire"
"""The name of the keymap that holds those keys."""
START = {"type": "W", "value": "PRESS", "ctrl": True, "alt": True}


class Action(Enum):
    """What the artist asks for; the value is what the preferences and the help call it."""

    CLICK = "Seed, keep, join or drag"
    NEW_CHAIN = "New chain"
    LOOP = "Take the loop"
    DROP = "Drop the wire under the cursor"
    ATTRACT = "Drag: stroke to follow. On a wire: drop it"
    REPEL = "Drag: stroke to keep off"
    ERASE = "Remove the stroke under the cursor"
    END_CHAIN = "End the chain"
    TOGGLE = "Other wire, or the next of what a loop click offers"
    STRONGER = "Follow the shape more"
    WEAKER = "Follow the shape less"
    ZOOM_IN = "Zoom in"
    ZOOM_OUT = "Zoom out"
    CLOSE = "Close the loop"
    RUN = "Run to the end"
    MARKING = "Mark or clear"
    XRAY = "X-ray"
    MIRROR = "Mirror"
    SWITCH = "Along edges or across the surface"
    SNAP = "Snap to features"
    RESUME = "Go on with the wires kept before"
    HELP = "Show the keys"
    UNDO = "Undo"
    REDO = "Redo"
    FINISH = "Finish"
    LEAVE = "Drop the live wire, then leave"


@dataclass(frozen=True)
class Key:
    """A key or a button with its modifiers: 1 held, 0 not held, -1 either."""

    type: str
    value: str = "PRESS"
    ctrl: int = 0
    shift: int = 0
    alt: int = 0
    oskey: int = 0

    def matches(self, event: bpy.types.Event, value: str) -> bool:
        """Whether an event is this key, taken for one of another value."""
        pressed = "PRESS" if self.value in {"ANY", "CLICK"} else self.value
        return event.type == self.type and value == pressed and self.held(event)

    def held(self, event: bpy.types.Event) -> bool:
        """Whether its modifiers are as it wants them. The command key of other systems counts as Ctrl."""
        ctrl = event.ctrl if self.oskey == 1 else event.ctrl or event.oskey
        wanted = ((self.ctrl, ctrl), (self.shift, event.shift), (self.alt, event.alt))
        if self.oskey == 1 and not event.oskey:
            return False
        return all(want == -1 or bool(want) == bool(is_held) for want, is_held in wanted)

    @property
    def modifiers(self) -> str:
        """The modifiers that must be held, as Blender writes them."""
        names = (("Shift", self.shift), ("Ctrl", self.ctrl), ("Alt", self.alt), ("Cmd", self.oskey))
        return " ".join(name for name, want in names if want == 1)

    @property
    def text(self) -> str:
        """The key in words."""
        double = "Double-" if self.value == "DOUBLE_CLICK" else ""
        name = double + _NAMES.get(self.type, self.type.replace("_", " ").title())
        return f"{self.modifiers} {name}".strip()

    @property
    def icon(self) -> str:
        """Blender's icon of the key without its modifiers; an empty string where there is none."""
        if self.type in _ICONS:
            return _ICONS[self.type]
        letter = len(self.type) == 1 and self.type.isalpha()
        function = self.type[:1] == "F" and self.type[1:].isdigit() and int(self.type[1:]) <= 12
        return f"EVENT_{self.type}" if letter or function else ""


_ANY = {"ctrl": -1, "shift": -1, "alt": -1, "oskey": -1}

KEYS: tuple[tuple[Action, Key], ...] = (
    (Action.LOOP, Key("LEFTMOUSE", "DOUBLE_CLICK")),
    (Action.LOOP, Key("LEFTMOUSE", alt=1)),
    (Action.NEW_CHAIN, Key("LEFTMOUSE", ctrl=1)),
    (Action.ATTRACT, Key("LEFTMOUSE", shift=1)),
    (Action.REPEL, Key("LEFTMOUSE", ctrl=1, shift=1)),
    (Action.ERASE, Key("D")),
    (Action.DROP, Key("DEL")),
    (Action.CLICK, Key("LEFTMOUSE")),
    (Action.END_CHAIN, Key("RIGHTMOUSE")),
    (Action.TOGGLE, Key("WHEELUPMOUSE")),
    (Action.TOGGLE, Key("WHEELDOWNMOUSE")),
    (Action.TOGGLE, Key("WHEELUPMOUSE", alt=1)),
    (Action.TOGGLE, Key("WHEELDOWNMOUSE", alt=1)),
    (Action.TOGGLE, Key("W")),
    (Action.TOGGLE, Key("W", alt=1)),
    (Action.STRONGER, Key("WHEELUPMOUSE", shift=1)),
    (Action.WEAKER, Key("WHEELDOWNMOUSE", shift=1)),
    (Action.ZOOM_IN, Key("WHEELUPMOUSE", ctrl=1)),
    (Action.ZOOM_OUT, Key("WHEELDOWNMOUSE", ctrl=1)),
    (Action.CLOSE, Key("C")),
    (Action.RUN, Key("F")),
    (Action.MARKING, Key("X")),
    (Action.XRAY, Key("V")),
    (Action.MIRROR, Key("M")),
    (Action.SWITCH, Key("E")),
    (Action.SNAP, Key("G")),
    (Action.RESUME, Key("R")),
    (Action.HELP, Key("H")),
    (Action.UNDO, Key("Z", ctrl=1)),
    (Action.UNDO, Key("BACK_SPACE")),
    (Action.REDO, Key("Z", ctrl=1, shift=1)),
    (Action.FINISH, Key("RET", **_ANY)),
    (Action.FINISH, Key("NUMPAD_ENTER", **_ANY)),
    (Action.FINISH, Key("SPACE")),
    (Action.LEAVE, Key("ESC", **_ANY)),
)
"""The first that matches counts."""

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
    "ONE": "1",
    "TWO": "2",
    "THREE": "3",
    "FOUR": "4",
    "FIVE": "5",
    "SIX": "6",
    "SEVEN": "7",
    "EIGHT": "8",
    "NINE": "9",
    "ZERO": "0",
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
_WHEEL = ("WHEELUPMOUSE", "WHEELDOWNMOUSE")

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
_OTHERWISE_WITH_CTRL = frozenset({"NUMPAD_PLUS", "NUMPAD_MINUS", "NUMPAD_0"})
"""With Ctrl they change the selection or the camera."""
_SIDEBARS = frozenset({"N", "T"})
"""With Shift, Ctrl or Alt they change the mesh or open menus that do."""


class Bindings:
    """What each key does now.

    Parameters
    ----------
    keys
        Actions and their keys; the first that matches counts.
    undo
        Blender's own keys for undo and redo.
    """

    def __init__(self, keys: Sequence[tuple[Action, Key]] = KEYS, undo: Sequence[Key] = ()) -> None:
        # A double click is a press as well: those who want two come first.
        self._keys = sorted(keys, key=lambda pair: pair[1].value != "DOUBLE_CLICK")
        self._undo = (*undo, Key("Z", ctrl=1, shift=-1, alt=-1))

    @classmethod
    def of_user(cls, manager: bpy.types.WindowManager) -> Bindings:
        """Return what the user has set in Blender's preferences; the defaults where there are no keymaps."""
        keymap = user_keymap(manager)
        if keymap is None:
            return cls()
        keys = [
            (Action[item.properties.action], _key(item))
            for item in items_of(keymap, ACTION_OPERATOR)
            if item.active and item.key_modifier == "NONE"
        ]
        screen = manager.keyconfigs.user.keymaps.get("Screen")
        undo = [
            _key(item)
            for item in (screen.keymap_items if screen else ())
            if item.active and item.idname in {"ed.undo", "ed.redo", "ed.undo_history"}
        ]
        return cls(keys, undo)

    def action_of(self, event: bpy.types.Event, double: bool = False) -> Action | None:
        """Return what an event asks for; `double`: it is the second press of a double click."""
        values = ("DOUBLE_CLICK", event.value) if double else (event.value,)
        return next((action for value in values for action, key in self._keys if key.matches(event, value)), None)

    def keys_of(self, action: Action) -> list[Key]:
        """Return the keys of an action."""
        return [key for of, key in self._keys if of is action]

    def previews_loop(self, event: bpy.types.Event) -> bool:
        """Whether the modifiers are held with which a click would take a loop."""
        keys = self.keys_of(Action.LOOP)
        return any(key.modifiers and key.value != "DOUBLE_CLICK" and key.held(event) for key in keys)

    def is_blender_undo(self, event: bpy.types.Event) -> bool:
        """Whether an event would make Blender undo or redo: that must never happen under the running tool."""
        return any(event.type == key.type and key.held(event) for key in self._undo)

    def text(self, action: Action) -> str:
        """Return the keys of an action in words; an empty string where it has none."""
        keys = self.keys_of(action)
        merged = list(keys)
        # Both ways of the wheel are one thing to say.
        for key in keys:
            if key.type == _WHEEL[0] and replace(key, type=_WHEEL[1]) in keys:
                merged[merged.index(key)] = replace(key, type="WHEEL")
                merged.remove(replace(key, type=_WHEEL[1]))
        return ", ".join(key.text for key in merged)

    def icon(self, action: Action, single: bool = True) -> tuple[str, str]:
        """Return the icon of the first key of an action, and what must be written before what it does.

        Parameters
        ----------
        action
            What the key does.
        single
            Prefer a key to a double click.
        """
        keys = self.keys_of(action)
        if not keys:
            return "", ""
        key = next((key for key in keys if not single or key.value != "DOUBLE_CLICK"), keys[0])
        if not key.icon:
            return "", key.text
        wheel = "Wheel" if key.type in _WHEEL else ""
        return key.icon, f"{key.modifiers} {wheel}".strip()

    def rows(self) -> list[tuple[str, str]]:
        """Return each action with its keys, in words, for a table."""
        return [(self.text(action), action.value) for action in Action if self.keys_of(action)]


def _key(item: bpy.types.KeyMapItem) -> Key:
    if item.any:
        return Key(item.type, item.value, -1, -1, -1, -1)
    return Key(item.type, item.value, item.ctrl, item.shift, item.alt, item.oskey)


class DoubleClicks:
    """Finds double clicks: Blender hands modal operators the second press as any other.

    The time that counts is that from the first release to the second press, as they are handled: where a redraw comes
    between the two presses, however long it takes, the release has waited as well.
    """

    def __init__(self) -> None:
        self._released: tuple[str, float, int, int] | None = None

    def is_second(self, event: bpy.types.Event, now: float, preferences: bpy.types.Preferences) -> bool:
        """Whether an event is the second press of a double click. To be asked of every event of the mouse's buttons.

        Parameters
        ----------
        event
            Any; only the buttons of the mouse count.
        now
            Seconds, from any beginning.
        preferences
            For what counts as a double click and as the same place.
        """
        if not event.type.endswith("MOUSE") or event.type.startswith("WHEEL"):
            return False
        if event.value == "RELEASE":
            self._released = (event.type, now, event.mouse_x, event.mouse_y)
            return False
        released, self._released = self._released, None
        if released is None or event.value != "PRESS" or released[0] != event.type:
            return False
        soon = (now - released[1]) * 1000.0 < preferences.inputs.mouse_double_click_time
        away = max(abs(event.mouse_x - released[2]), abs(event.mouse_y - released[3]))
        return soon and away <= drag_threshold(event, preferences)


def drag_threshold(event: bpy.types.Event, preferences: bpy.types.Preferences) -> float:
    """Return how many pixels a button must be moved to drag: as Blender counts, more on a display of larger scale."""
    inputs = preferences.inputs
    threshold = inputs.drag_threshold_tablet if event.is_tablet else inputs.drag_threshold_mouse
    return threshold * preferences.system.ui_scale


def is_navigation(event: bpy.types.Event) -> bool:
    """Whether an event moves the view or changes how it is shown, and nothing else."""
    if event.type in _OTHERWISE_WITH_CTRL and event.ctrl:
        return False
    if event.type.startswith("NDOF_") or (event.type.startswith("NUMPAD_") and event.type != "NUMPAD_ENTER"):
        return True
    if event.type in _SIDEBARS:
        return not (event.ctrl or event.oskey or event.shift or event.alt)
    if event.type == "Z":
        return not event.ctrl and not event.oskey
    # Alt and the wheel change the frame.
    return event.type in _NAVIGATION and not (event.alt and event.type.startswith("WHEEL"))


def emulates_middle_button(event: bpy.types.Event, inputs: bpy.types.PreferencesInput) -> bool:
    """Whether an event is one of the middle button that the left one plays."""
    if not inputs.use_mouse_emulate_3_button or event.type != "LEFTMOUSE":
        return False
    return event.oskey if getattr(inputs, "mouse_emulate_3_button_modifier", "ALT") == "OSKEY" else event.alt


def user_keymap(manager: bpy.types.WindowManager) -> bpy.types.KeyMap | None:
    """Return the keymap of the tool's keys with the user's changes; None where there are no keymaps."""
    configuration = manager.keyconfigs.user
    return configuration.keymaps.get(NAME) if configuration is not None else None


def items_of(keymap: bpy.types.KeyMap, idname: str) -> list[bpy.types.KeyMapItem]:
    """Return a keymap's items of one operator, as the add-on has them: the running tool's in the order of `KEYS`.

    Blender hands the items that add-ons added to the user's keymap on newest first. An action's keys that the user has
    changed come before its others.
    """
    items = [item for item in reversed(keymap.keymap_items) if item.idname == idname]
    if idname != ACTION_OPERATOR:
        return items
    actions = [action.name for action, _ in KEYS]
    own = {(action.name, key): i for i, (action, key) in enumerate(KEYS)}

    def place(item: bpy.types.KeyMapItem) -> tuple[int, int]:
        action = item.properties.action
        return actions.index(action), own.get((action, _key(item)), -1)

    return sorted(items, key=place)


class MESH_OT_seamwire_key(bpy.types.Operator):
    """Holds the place of a key while seams are drawn"""  # noqa: D400 - a tooltip

    bl_idname = ACTION_OPERATOR
    bl_label = "Seamwire Key"
    bl_options = {"INTERNAL"}

    action: bpy.props.EnumProperty(
        name="Action",
        description="What the key does",
        items=tuple((action.name, action.value, "") for action in Action),
    )

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        """Never: the drawing looks its keys up itself."""
        return False


_registered: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []
_SPACE = {"space_type": "VIEW_3D", "region_type": "WINDOW"}


def register() -> None:
    """Add the key that starts the tool in edit mode, and those of the running tool."""
    bpy.utils.register_class(MESH_OT_seamwire_key)
    _registered.extend(_add())


def _add() -> Iterator[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]]:
    configurations = bpy.context.window_manager.keyconfigs
    if configurations.addon is None:  # there may be none in background mode
        return
    keymap = configurations.addon.keymaps.new(name="Mesh", space_type="EMPTY")
    yield keymap, keymap.keymap_items.new(OPERATOR, **START)
    # Blender hands a keymap of an add-on on to the user's only where its own has one of that name.
    configurations.default.keymaps.new(name=NAME, **_SPACE)
    keymap = configurations.addon.keymaps.new(name=NAME, **_SPACE)
    for action, key in KEYS:
        if key.ctrl == key.shift == key.alt == -1:
            item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, any=True)
        else:
            held = {"ctrl": key.ctrl == 1, "shift": key.shift == 1, "alt": key.alt == 1}
            item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, **held)
        item.properties.action = action.name


def unregister() -> None:
    """Remove them."""
    while _registered:
        keymap, item = _registered.pop()
        keymap.keymap_items.remove(item)
    remove(NAME)
    bpy.utils.unregister_class(MESH_OT_seamwire_key)


def empty(name: str) -> None:
    """Take the add-on's items out of a keymap, and so out of the user's, where they would stay without their keymap."""
    configurations = bpy.context.window_manager.keyconfigs
    keymap = configurations.addon.keymaps.get(name) if configurations.addon is not None else None
    if keymap is not None:
        while keymap.keymap_items:
            keymap.keymap_items.remove(keymap.keymap_items[0])
        configurations.update()


def remove(name: str) -> None:
    """Remove a keymap that is the add-on's alone."""
    empty(name)
    configurations = bpy.context.window_manager.keyconfigs
    for configuration in (configurations.addon, configurations.default):
        keymap = configuration.keymaps.get(name) if configuration is not None else None
        if keymap is not None:
            configuration.keymaps.remove(keymap)
