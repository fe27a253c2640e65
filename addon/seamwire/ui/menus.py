# SPDX-License-Identifier: GPL-3.0-or-later
"""Menu entries, and what the status bar says while the tool runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy

from .. import lazy
from . import keymap
from .keymap import Action

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ..core import network
    from ..core.network import LoopKind
    from ..core.session import Session
else:
    network = lazy.Part("core.network")

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_context_menu", "IMAGE_MT_uvs")

Hint = tuple[str, str]
"""An icon of Blender's, and what it stands for now."""
Deed = tuple[Action, str]
"""What can be asked for, and what it would do now."""

_CLICKS = {
    "SEED": "Seed",
    "CONTINUE": "Begin at This Seed, Drag: Move It",
    "BRANCH": "Begin on This Wire, Drag: New Seed",
    "KEEP": "Keep Wire",
    "JOIN": "Join Here",
    "CLOSE": "Close the Loop",
    "RUN": "Keep the Wire to the End",
    "WAIT": "Keep as Soon as Computed",
    "MOVE": "Leave the Seed Here",
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
    notes
        What holds for the whole drawing.
    mirror_offer
        The axes that the mesh is symmetric over and not mirrored, as letters.
    resume_offer
        Whether an earlier drawing can be gone on with.
    marks, clears
        How many edges finishing would mark and clear, on all objects.
    """

    session: Session
    keys: keymap.Bindings
    message: str = ""
    notes: tuple[str, ...] = ()
    mirror_offer: str = ""
    resume_offer: bool = False
    marks: int = 0
    clears: int = 0


def count(number: int, what: str) -> str:
    """Return a number with what it counts."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def hints(status: Status) -> list[Hint]:
    """Return what each button and key would do now, after what there is to say.

    Where the status bar is narrow its end is cut off: what a click does comes first, then how to get out and where all
    keys are told, then the rest, what is needed oftenest first.
    """
    session, keys = status.session, status.keys
    found: list[Hint] = []
    if session.computing:
        waiting = f", {count(session.waiting_clicks, 'click')} waiting" if session.waiting_clicks else ""
        found.append(("SORTTIME", f"Computing {100.0 * session.progress:.0f} %{waiting}"))
    if status.message:
        found.append(("INFO", status.message))
    if session.message:
        found.append(("ERROR", session.message))
    deeds = [
        *_click(session),
        (Action.FINISH, _finish(status)),
        (Action.LEAVE, "Leave" if session.seed is None else "Drop Wire"),
        (Action.HELP, "Keys"),
        *([(Action.RESUME, "Go On with the Wires Kept Before")] if status.resume_offer else []),
        *_wires(session),
        *_guides(status),
    ]
    for action, text in deeds:
        icon, before = keys.icon(action)
        if icon or before:
            found.append((icon or "NONE", f"{before}: {text}" if before else text))
    return found + [("INFO", note) for note in status.notes]


def _click(session: Session) -> Iterator[Deed]:
    """Yield what a click does, and what it would do after toggling."""
    offers, offer = session.loop_offers, session.loop_choice
    if offer is not None:
        number = offers.index(offer)
        which = f", {number + 1} of {len(offers)}" if len(offers) > 1 else ""
        yield Action.LOOP, f"Take {_offer(offer)}{which}"
        if which:
            yield Action.TOGGLE, f"{_offer(offers[(number + 1) % len(offers)])} Instead"
        return
    click = _CLICKS.get(session.intent.name)
    if click:
        yield Action.CLICK, click
    if session.seed is not None and session.other is not None:
        yield Action.TOGGLE, "Other Wire"


def _offer(kind: LoopKind) -> str:
    return network.LOOP_NAMES[kind].title()


def _wires(session: Session) -> Iterator[Deed]:
    """Yield what else can be done about wires."""
    if session.seed is not None:
        yield Action.END_CHAIN, "End Chain"
        if session.closing_point is not None:
            yield Action.CLOSE, "Close"
        if session.along == "EDGES":
            yield Action.RUN, "Run to the End" if session.end_preview is None else "Keep It"
    else:
        wire = session.hovered_wire
        if wire is not None:
            yield Action.DROP, "Drop Wire"
            if wire.kind is not None or not wire.closed:
                yield Action.TOGGLE, "Its Other Way"
        on_edge = session.target is not None and isinstance(session.target.pick, tuple)
        if session.along == "EDGES" and session.loop_choice is None and on_edge:
            yield Action.LOOP, "Loop"
    if session.can_undo:
        yield Action.UNDO, "Undo"


def _guides(status: Status) -> Iterator[Deed]:
    """Yield what wires can be led by."""
    session = status.session
    if session.metric != "euclidean":
        yield Action.STRONGER, f"Strength {session.strength:.3g}"
    yield Action.MARKING, "Clear Instead" if session.marking else "Mark Instead"
    if session.target is not None:
        yield Action.ATTRACT, "Stroke"
        yield Action.REPEL, "Keep Off"
    if session.scribbles:
        yield Action.ERASE, "Remove Stroke"
    yield Action.SWITCH, "Across Surface" if session.along == "EDGES" else "Along Edges"
    if session.mirror_axes:
        yield Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in session.mirror_axes)}"
    elif status.mirror_offer:
        yield Action.MIRROR, f"Mirror? Symmetric over {status.mirror_offer}"


def _finish(status: Status) -> str:
    parts = []
    if status.marks:
        parts.append(f"Mark {count(status.marks, 'Edge')}")
    if status.clears:
        parts.append(f"Clear {count(status.clears, 'Edge')}")
    return ", ".join(parts) or "Finish"


def status_drawer(status: Status) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    """Return what draws the hints in the status bar.

    A plain function: Blender makes it a method of its header class, and crashes on a bound method.
    """

    def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
        row = header.layout.row(align=False)
        for icon, text in hints(status):
            row.label(text=text, icon=icon)

    return draw


def _draw_menu(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    # From a menu, too, the tool is to start where the cursor is.
    menu.layout.operator_context = "INVOKE_DEFAULT"
    menu.layout.operator(keymap.OPERATOR)


def register() -> None:
    """Add the menu entries."""
    for name in MENUS:
        getattr(bpy.types, name).append(_draw_menu)


def unregister() -> None:
    """Remove them."""
    for name in MENUS:
        getattr(bpy.types, name).remove(_draw_menu)
