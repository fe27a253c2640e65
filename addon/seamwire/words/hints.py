# SPDX-License-Identifier: GPL-3.0-or-later
"""What each button and key would do now, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .keys import Action, Bindings
from .names import count

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..core.drawing.session import Session
    from ..core.network.network import LoopKind

Hint = tuple[str, str]
"""An icon of Blender's, and what it stands for now."""
Deed = tuple[Action, str]
"""What can be asked for, and what it would do now."""

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
"""What a click does, by the session's intent."""


@dataclass(frozen=True)
class Status:
    """What the status bar tells of.

    Parameters
    ----------
    session
        Of the object pointed at.
    keys
        What each key does.
    message
        What there is to say about the last key.
    mirror_offer
        The axes that the mesh is symmetric over and not mirrored, as letters.
    """

    session: Session
    keys: Bindings
    message: str = ""
    mirror_offer: str = ""


def hints(status: Status) -> list[Hint]:
    """Return what each button and key would do now, after what there is to say.

    Where the status bar is narrow its end is cut off: what a click does comes first, then how to get out and where all
    keys are told, then the rest, what is needed oftenest first.
    """
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
    return found


def _click(session: Session) -> Iterator[Deed]:
    """Yield what a click does, and what it would do after toggling."""
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
    """Yield what else can be done about wires."""
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
    """Yield what wires can be led by."""
    session = status.session
    if session.metric != "euclidean":
        yield Action.STRONGER, f"Strength {session.strength:.3g}"
    yield Action.CLEAR, "Switch to Clear" if session.marking else "Switch to Mark"
    if session.target is not None:
        yield Action.GUIDE, "Guide Stroke"
        yield Action.AVOID, "Avoid Stroke"
    yield Action.SWITCH, "Across Surface" if session.along == "EDGES" else "Along Edges"
    if session.mirror_axes:
        yield Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in session.mirror_axes)}"
    elif status.mirror_offer:
        yield Action.MIRROR, f"Mirror? Symmetric on {status.mirror_offer}"
