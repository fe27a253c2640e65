# SPDX-License-Identifier: GPL-3.0-or-later
"""Menu entries, and what the status bar says while the tool runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy

from . import keymap
from .keymap import Action

if TYPE_CHECKING:
    from collections.abc import Callable

    from .session import Session

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_context_menu", "IMAGE_MT_uvs")

Hint = tuple[str, str]
"""An icon of Blender's, and what it stands for now."""

_OFFERS = {"CLOSED": "Closed Loop", "STRIP": "Strip", "PAST": "Past Poles", "WHOLE": "Whole Strip", "EDGE": "Edge"}
"""What a click may take with the key for loops held, by the session's names."""
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
    """Return what each button and key would do now, after what there is to say."""
    session, keys = status.session, status.keys
    found: list[Hint] = []

    def add(action: Action, text: str) -> None:
        icon, before = keys.icon(action)
        if icon or before:
            found.append((icon or "NONE", f"{before}: {text}" if before else text))

    if session.computing:
        waiting = f", {count(session.waiting_clicks, 'click')} waiting" if session.waiting_clicks else ""
        found.append(("SORTTIME", f"Computing {100.0 * session.progress:.0f} %{waiting}"))
    if status.message:
        found.append(("INFO", status.message))
    if session.message:
        found.append(("ERROR", session.message))
    if status.resume_offer:
        add(Action.RESUME, "Go On with the Wires Kept Before")
    live = session.seed is not None
    click = _CLICKS.get(session.intent.name)
    offers, offer = session.loop_offers, session.loop_choice
    if offer is not None:
        add(Action.LOOP, f"Take {_OFFERS[offer]}, {offers.index(offer) + 1} of {len(offers)}")
        if len(offers) > 1:
            following = offers[(offers.index(offer) + 1) % len(offers)]
            add(Action.TOGGLE, f"{_OFFERS[following]} Instead")
    elif click:
        add(Action.CLICK, click)
    if live:
        if session.other is not None and offer is None:
            add(Action.TOGGLE, "Other Wire")
        add(Action.END_CHAIN, "End Chain")
        if session.closing_point is not None:
            add(Action.CLOSE, "Close")
        if session.along == "EDGES":
            add(Action.RUN, "Run to the End" if session.end_preview is None else "Keep It")
    else:
        if session.hovered_wire is not None:
            add(Action.DROP, "Drop Wire")
            add(Action.TOGGLE, "Its Other Way")
        if session.along == "EDGES" and offer is None:
            add(Action.LOOP, "Loop")
    add(Action.ATTRACT, "Stroke")
    add(Action.REPEL, "Keep Off")
    if session.scribbles:
        add(Action.ERASE, "Remove Stroke")
    add(Action.MARKING, "Clear Instead" if session.marking else "Mark Instead")
    if session.mirror_axes:
        add(Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in session.mirror_axes)}")
    elif status.mirror_offer:
        add(Action.MIRROR, f"Mirror? Symmetric over {status.mirror_offer}")
    add(Action.SWITCH, "Across Surface" if session.along == "EDGES" else "Along Edges")
    add(Action.STRONGER, f"Strength {session.strength:.3g}")
    if session.can_undo:
        add(Action.UNDO, "Undo")
    add(Action.FINISH, _finish(status))
    add(Action.LEAVE, "Drop Wire" if live else "Leave")
    add(Action.HELP, "Keys")
    return found + [("INFO", note) for note in status.notes]


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
