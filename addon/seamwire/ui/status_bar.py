# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows in Blender's status bar what the tool can do. While a chain is drawn, the chain shows what each key does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bl_ui.space_statusbar import STATUSBAR_HT_header

from ..mesh.settings import tool_is_active
from ..tool import keymaps
from ..tool.running import chains, draw_hints, steps
from ..words.hints import idle_hints
from . import toolbar

if TYPE_CHECKING:
    import bpy


def draw_idle(header: bpy.types.Header, context: bpy.types.Context) -> None:
    """Draw what the tool can do, before Blender's own hints. Draw nothing while another tool or operator has the mouse."""
    if tool_is_active(context) and not is_busy(context):
        draw_hints(header, idle_hints(tool_keys(context.window_manager)))


def tool_keys(manager: bpy.types.WindowManager) -> dict[str, keymaps.Key]:
    """Return the keys of the tool as the user has set them, by the names of what they begin with."""
    found: dict[str, keymaps.Key] = {}
    for item in keymaps.items_of(keymaps.user_keymap(manager, toolbar.KEYMAP), toolbar.OPERATOR):
        if item.active:
            found.setdefault(item.properties.first, keymaps.key_of(item))
    return found


def is_busy(context: bpy.types.Context) -> bool:
    """Return whether an operator is running. Blender 3.4 tells only of those of this add-on."""
    return bool(chains or steps or getattr(context.window, "modal_operators", ()))


def register() -> None:
    STATUSBAR_HT_header.prepend(draw_idle)
    if hasattr(STATUSBAR_HT_header, "_draw_orig"):
        # An add-on has shown its own status before. Blender goes back to this function after each such status.
        STATUSBAR_HT_header._draw_orig = STATUSBAR_HT_header.draw


def unregister() -> None:
    # While a chain is drawn, Blender keeps its own function aside.
    draw = getattr(STATUSBAR_HT_header, "_draw_orig", STATUSBAR_HT_header.draw)
    if draw_idle in draw._draw_funcs:
        draw._draw_funcs.remove(draw_idle)
