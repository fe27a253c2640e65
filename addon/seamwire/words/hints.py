# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints for the status bar: what each button and key does at the moment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .keys import Action, Bindings, Key
from .names import count

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..core.drawing.session import Session
    from ..core.network.network import LoopKind

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
    ("CLICK", "Begin Wire", False),
    ("CLICK", "Draw Line", True),
    ("LOOP", "Add Loop", False),
    ("GUIDE", "Draw Stroke", True),
)
"""What the tool does between chains: the name of its key, the text, and whether the mouse is dragged."""


@dataclass(frozen=True)
class Status:
    """The state of a chain, as far as the status bar describes it.

    Parameters
    ----------
    session
        The session of the object under the mouse.
    keys
        The action of each key.
    message
        The result of the last key.
    mirror_offer
        The letters of the axes that the mesh is symmetric over and that are not mirrored.
    """

    session: Session
    keys: Bindings
    message: str = ""
    mirror_offer: str = ""


def idle_hints(keys: Mapping[str, Key]) -> list[Hint]:
    """Return what a newcomer can do before the first click.

    Parameters
    ----------
    keys
        The keys of the tool by the names of what they begin with. Keys that are missing give no hint.
    """
    found: list[Hint] = []
    for name, text, is_drag in _IDLE:
        key = keys.get(name)
        if key is None:
            continue
        icon = f"{key.icon}_DRAG" if is_drag and key.icon == "MOUSE_LMB" else key.icon
        before = key.modifiers if icon else key.text
        found.append((icon or "NONE", f"{before}: {text}" if before else text))
    found.append(("SHADERFX", "Find All Seams: Edge > Seamwire > Suggest Seamwires"))
    return found


def hints(status: Status) -> list[Hint]:
    """Return at most `MOST` hints: first messages, then what a click does and how to end, then other keys by their usefulness."""
    session, keys = status.session, status.keys
    found: list[Hint] = []
    if session.computing:
        waiting = f", {count(session.waiting_clicks, 'click')} waiting" if session.waiting_clicks else ""
        found.append(("SORTTIME", f"Computing {min(99.0, 100.0 * session.progress):.0f} %{waiting}"))
    if status.message:
        found.append(("INFO", status.message))
    if session.message:
        found.append(("ERROR", session.message))
    deeds = [
        *_click(session),
        (Action.END, "End Chain"),
        (Action.KEYS, "Keys"),
        *_wires(session),
        *_guides(status),
    ]
    for action, text in deeds:
        icon, before = keys.icon(action)
        if icon or before:
            found.append((icon or "NONE", f"{before}: {text}" if before else text))
    return found[:MOST]


def _click(session: Session) -> Iterator[Deed]:
    """Yield what a click does, and what it does after W."""
    offers, offer = session.loop_offers, session.loop_choice
    if offer is not None and session.bending:
        yield Action.BEND, "Bend Closed Cut"
        return
    if offer is not None:
        number = session.loop_number
        which = f", {number + 1} of {len(offers)}" if len(offers) > 1 else ""
        yield Action.LOOP, f"Add {_offer(offer)}{which}"
        if which:
            yield Action.NEXT, f"{_offer(offers[(number + 1) % len(offers)])} Instead"
        return
    click = _CLICKS.get(session.intent.name)
    if click:
        yield Action.CLICK, click
    if session.seed is not None and session.others:
        count = 1 + len(session.others)
        yield Action.NEXT, f"Next Candidate ({(session.candidate_number + 1) % count + 1} of {count})"


def _offer(kind: LoopKind) -> str:
    from ..core.network.network import LOOP_NAMES

    return LOOP_NAMES[kind].title()


def _wires(session: Session) -> Iterator[Deed]:
    """Yield what other keys do to wires."""
    if session.seed is not None:
        if session.closing_point is not None:
            yield Action.CLOSE, "Close"
        if session.along == "EDGES":
            yield Action.EXTEND, "Extend to End" if session.end_preview is None else "Keep It"
    wire = session.hovered_wire
    if wire is not None:
        yield Action.REMOVE, "Remove Wire"
        if session.seed is None and (wire.kind is not None or not wire.closed):
            yield Action.NEXT, "Swap Path"
    on_edge = session.target is not None and isinstance(session.target.pick, tuple)
    if session.loop_choice is None and session.target is not None and on_edge == (session.along == "EDGES"):
        yield Action.LOOP, "Loop" if on_edge else "Closed Cut"
        if session.can_bend:
            yield Action.BEND, "Bend Closed Cut"
    if session.can_undo:
        yield Action.UNDO, "Undo"


def _guides(status: Status) -> Iterator[Deed]:
    """Yield the keys for settings and strokes."""
    session = status.session
    if status.mirror_offer and not session.mirror_axes:
        yield Action.MIRROR, f"Mirror? Symmetric on {status.mirror_offer}"
    if session.metric != "euclidean":
        yield Action.STRONGER, f"Strength {session.strength:.3g}"
    yield Action.CLEAR, "Switch to Clear" if session.marking else "Switch to Mark"
    yield Action.SWITCH, "Across Surface" if session.along == "EDGES" else "Along Edges"
    if session.target is not None:
        yield Action.GUIDE, "Guide Stroke"
        yield Action.AVOID, "Avoid Stroke"
    if session.mirror_axes:
        yield Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in session.mirror_axes)}"
