# SPDX-License-Identifier: GPL-3.0-or-later
"""Menu entries, and what the status bar says while the tool runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from . import keymap

if TYPE_CHECKING:
    from collections.abc import Callable

    from .session import Session

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_context_menu", "IMAGE_MT_uvs")

Hint = tuple[str, str]
"""An icon of Blender's, and what it stands for now."""


def hints(session: Session, keys: keymap.Bindings, notes: tuple[str, ...] = ()) -> list[Hint]:
    """Return what each button and key would do now, after what there is to say.

    Parameters
    ----------
    session
        The drawing.
    keys
        What each key does.
    notes
        What holds for the whole drawing.
    """
    edges = session.along == "EDGES"
    found: list[Hint] = []
    if session.computing:
        waiting = f", {session.waiting_clicks} waiting" if session.waiting_clicks else ""
        found.append(("SORTTIME", f"Computing {100.0 * session.progress:.0f} %{waiting}"))
    if session.message:
        found.append(("ERROR", session.message))
    if session.seed is None:
        found.append(("MOUSE_LMB", "Ctrl: Seed" if not edges else "Ctrl: Seed on Edge or Vertex"))
    else:
        if session.active is not None:
            found.append(("MOUSE_LMB", "Keep Wire"))
        if session.other is not None:
            found.append(("MOUSE_MMB", "Wheel: Other Wire"))
        found.append(("MOUSE_RMB", "End Chain"))
    if edges:
        found.append(("MOUSE_LMB_DRAG", "Double Click: Loop (Alt Shows It)"))
    found.append(("EVENT_E", "Go Across Surface" if edges else "Go Along Edges"))
    if session.can_undo:
        found.append(("LOOP_BACK", "Ctrl Z: Take Back"))
    count = len(session.edges_to_mark())
    found.append(("EVENT_RETURN", f"Mark {count} Edges" if count else "Finish"))
    found.append(("EVENT_ESC", "Leave Without Marking"))
    return found + [("INFO", note) for note in notes]


def status_drawer(
    session: Session, keys: keymap.Bindings, notes: tuple[str, ...]
) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    """Return what draws the hints in the status bar.

    A plain function: Blender makes it a method of its header class, and crashes on a bound method.
    """

    def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
        row = header.layout.row(align=False)
        for icon, text in hints(session, keys, notes):
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
