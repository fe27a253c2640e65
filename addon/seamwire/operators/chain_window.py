# SPDX-License-Identifier: GPL-3.0-or-later
"""The window in which a chain is drawn: its timer, its cursor and its status bar."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import bpy

TICK = 0.008
"""Seconds between two looks at running work, half of what a screen shows a picture for: a wire is drawn with the next one."""


class ChainWindow:
    """A window with everything that a chain changes in it.

    Parameters
    ----------
    context
        With the window.

    Attributes
    ----------
    window, workspace, manager
        Blender's.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        self.window = context.window
        self.workspace = context.workspace
        self.manager = context.window_manager
        self._timer: bpy.types.Timer | None = None
        self._cursor = ""

    def set_timer(self, wanted: bool) -> None:
        """Let Blender send an event at each tick, or no longer."""
        if wanted and self._timer is None:
            self._timer = self.manager.event_timer_add(TICK, window=self.window)
        elif not wanted and self._timer is not None:
            timer, self._timer = self._timer, None
            self.manager.event_timer_remove(timer)

    def set_cursor(self, shape: str) -> None:
        """Show another cursor, or Blender's own if the name is empty."""
        if shape == self._cursor:
            return
        self._cursor = shape
        if shape:
            self.window.cursor_modal_set(shape)
        else:
            self.window.cursor_modal_restore()

    def is_over_settings(self, event: bpy.types.Event) -> bool:
        """Return whether the mouse is over the settings of a 3D view's tool, which a chain follows."""
        x, y = event.mouse_x, event.mouse_y
        regions = (region for area in self.window.screen.areas if area.type == "VIEW_3D" for region in area.regions)
        return any(
            region.x <= x < region.x + region.width and region.y <= y < region.y + region.height
            for region in regions
            if region.type in {"TOOL_HEADER", "UI"}
        )
