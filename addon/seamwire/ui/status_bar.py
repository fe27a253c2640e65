# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows hints in Blender's status bar: what the tool can do, and while a chain is drawn, what each key does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bl_ui.space_statusbar import STATUSBAR_HT_header

from ..mesh.settings import tool_is_active
from ..operators import keymaps, steps
from ..operators.chain_state import running, status_makers
from ..words.hints import Hint, Status, hints, idle_hints
from . import toolbar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import bpy

    from ..operators.chain import Chain


def status_of(chain: Chain) -> Status:
    """Return the state of a chain."""
    from ..view.edited_objects import edited

    symmetric = edited.front.mesh.symmetric
    offers = symmetric if symmetric and not edited.front.options.mirror else ()
    axes = "".join("XYZ"[axis] for axis in offers)
    return Status(chain.session.picture, chain.keys, chain.notices.hint, axes)


def status_drawer(chain: Chain) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    """Return a function that draws the hints for a chain in the status bar.

    It is a plain function, because Blender makes it a method of its header class and crashes on a bound method.
    """
    status = status_of(chain)

    def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
        _draw_hints(header, hints(status))

    return draw


def draw_idle(header: bpy.types.Header, context: bpy.types.Context) -> None:
    """Draw what the tool can do, before Blender's own hints. Draw nothing while another tool or operator has the mouse."""
    if tool_is_active(context) and not is_busy(context):
        _draw_hints(header, idle_hints(tool_keys(context.window_manager)))


def tool_keys(manager: bpy.types.WindowManager) -> dict[str, keymaps.Key]:
    """Return the keys of the tool as the user has set them, by the names of what they begin with."""
    found: dict[str, keymaps.Key] = {}
    for item in keymaps.items_of(keymaps.user_keymap(manager, toolbar.KEYMAP), toolbar.OPERATOR):
        if item.active:
            found.setdefault(item.properties.first, keymaps.key_of(item))
    return found


def is_busy(context: bpy.types.Context) -> bool:
    """Return whether an operator is running. Blender 3.4 tells only of those of this add-on."""
    return bool(running or steps.running or getattr(context.window, "modal_operators", ()))


def _draw_hints(header: bpy.types.Header, shown: Iterable[Hint]) -> None:
    row = header.layout.row(align=False)
    for icon, text in shown:
        row.label(text=text, icon=icon)


def register() -> None:
    """Add the hints."""
    status_makers.append(status_drawer)
    STATUSBAR_HT_header.prepend(draw_idle)
    if hasattr(STATUSBAR_HT_header, "_draw_orig"):
        # An add-on has shown its own status before. Blender goes back to this function after each such status.
        STATUSBAR_HT_header._draw_orig = STATUSBAR_HT_header.draw


def unregister() -> None:
    """Remove the hints."""
    # While a chain is drawn, Blender keeps its own function aside.
    draw = getattr(STATUSBAR_HT_header, "_draw_orig", STATUSBAR_HT_header.draw)
    if draw_idle in draw._draw_funcs:
        draw._draw_funcs.remove(draw_idle)
    status_makers.remove(status_drawer)
