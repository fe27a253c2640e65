# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints for the status bar: what each button and key does at the moment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..terms.choices import LOOPS, ignores_shape
from .keys import Action, Bindings, Key
from .reports import count

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..core.sketch.picture import Picture
    from ..terms.choices import LoopKind

Hint = tuple[str, str]
"""The name of one of Blender's icons, and a text."""
Deed = tuple[Action, str]
"""An action, and what it would do at the moment."""
MOST = 8
"""The largest number of hints at once, so that a status bar shows all of them."""

_CLICKS = {
    "SEED": "Add Seed, Drag: Draw Line",
    "CONTINUE": "Begin at This Seed, Drag: Move It",
    "BRANCH": "Begin on This Wire, Drag: New Seed",
    "KEEP": "Keep Wire",
    "JOIN": "Join Here",
    "CLOSE": "Close Chain",
    "RUN": "Keep Wire to the End",
    "WAIT": "Confirm When Ready",
    "MOVE": "Release to Confirm",
    "DRAW": "Release to Keep Line",
}
"""The text for a click, by the session's intent."""
_IDLE = (
    ("CLICK", "Draw Line", True),
    ("LOOP", "Add Loop", False),
    ("GUIDE", "Draw Stroke", True),
)
"""The gestures between chains: the name of the key, the text, and whether the mouse is dragged. Blender itself names a click."""


def idle_hints(keys: Mapping[str, Key]) -> list[Hint]:
    """Return what a newcomer can do before the first click, with the keys of the tool by the names of what they begin with."""
    found: list[Hint] = []
    for name, text, is_drag in _IDLE:
        key = keys.get(name)
        if key is not None:
            icon = f"{key.icon}_DRAG" if is_drag and key.icon == "MOUSE_LMB" else key.icon
            found.append(_hint(icon, key.modifiers if icon else key.text, text))
    return found


def _hint(icon: str, before: str, text: str) -> Hint:
    return icon or "NONE", f"{before}: {text}" if before else text


def hints(picture: Picture, keys: Bindings, message: str = "", mirror_offer: str = "") -> list[Hint]:
    """Return at most `MOST` hints: first messages, then what a click does and how to end, then other keys by their usefulness.

    `message` is the result of the last key. `mirror_offer` has the letters of the axes that the mesh is symmetric over and not mirrored.
    """
    found: list[Hint] = []
    work = picture.work
    if work.computing:
        waiting = f", {count(work.waiting, 'wire')} left" if work.waiting else ""
        found.append(("SORTTIME", f"Computing {min(99.0, 100.0 * work.progress):.0f} %{waiting}"))
    if message:
        found.append(("INFO", message))
    if picture.message:
        found.append(("ERROR", picture.message))
    ways = ((Action.END, "End Chain"), (Action.KEYS, "Keys"))
    deeds = [*_click(picture), *ways, *_wires(picture), *_guides(picture, mirror_offer)]
    found += [_hint(*keys.icon(action), text) for action, text in deeds if keys.keys_of(action)]
    return found[:MOST]


def _click(picture: Picture) -> Iterator[Deed]:
    """Yield what a click does, and what it does after W."""
    offered, choice = picture.offered, picture.choice
    kinds, kind, number = offered.kinds, offered.kind, offered.number
    if kind is not None and offered.bends:
        yield Action.BEND, "Bend Closed Cut"
    elif kind is not None:
        which = f", {number + 1} of {len(kinds)}" if len(kinds) > 1 else ""
        yield Action.LOOP, f"Add {_offer(kind)}{which}"
        if which:
            yield Action.NEXT, f"{_offer(kinds[(number + 1) % len(kinds)])} Instead"
    else:
        if picture.intent.name in _CLICKS:
            yield Action.CLICK, _CLICKS[picture.intent.name]
        if picture.seed is not None and choice.count > 1:
            yield Action.NEXT, f"Next Candidate ({(choice.number + 1) % choice.count + 1} of {choice.count})"


def _offer(kind: LoopKind) -> str:
    # Title case as Blender has it: small words stay small.
    return " ".join(word if word in {"a", "of"} else word.capitalize() for word in LOOPS[kind].split())


def _wires(picture: Picture) -> Iterator[Deed]:
    # Imported late, because it needs NumPy, and Blender's start should not wait for that.
    from ..core.sketch.picture import Role

    is_along_edges = picture.options.along == "EDGES"
    if picture.seed is not None and picture.can_close:
        yield Action.CLOSE, "Close"
    if picture.seed is not None and is_along_edges:
        yield Action.EXTEND, "Extend to End" if picture.one(Role.EXTENSION) is None else "Keep It"
    wire = picture.one(Role.HOVERED)
    if wire is not None:
        yield Action.REMOVE, "Remove Wire"
        if picture.seed is None and (wire.kind is not None or not wire.closed):
            yield Action.NEXT, "Swap Path"
    target = picture.target
    on_edge = target is not None and isinstance(target.pick, tuple)
    if picture.offered.kind is None and target is not None and on_edge == is_along_edges:
        yield Action.LOOP, "Loop" if on_edge else "Closed Cut"
        if picture.can_bend:
            yield Action.BEND, "Bend Closed Cut"
    if picture.can_undo:
        yield Action.UNDO, "Undo"


def _guides(picture: Picture, mirror_offer: str) -> Iterator[Deed]:
    options = picture.options
    if mirror_offer and not options.mirror:
        yield Action.MIRROR, f"Mirror? Symmetric on {mirror_offer}"
    if not ignores_shape(options.metric):
        yield Action.STRONGER, f"Strength {picture.strength:.3g}"
    yield Action.CLEAR, "Switch to Clear" if options.marking else "Switch to Mark"
    yield Action.SWITCH, "Across Surface" if options.along == "EDGES" else "Along Edges"
    if picture.target is not None:
        yield Action.GUIDE, "Guide Stroke"
        yield Action.AVOID, "Avoid Stroke"
    if options.mirror:
        yield Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in options.mirror)}"
