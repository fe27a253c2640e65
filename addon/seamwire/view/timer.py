# SPDX-License-Identifier: GPL-3.0-or-later
"""A function that Blender calls from time to time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Callable


class Timer:
    """Lets Blender call a function, at most one call at a time. It returns the seconds until the next call, or None to stop.

    Blender finds a timer by the address of its function. A bound method is another object at each access, so this object keeps one. While
    it is kept, no other object can have its address.
    """

    def __init__(self, call: Callable[[], float | None]) -> None:
        self._call = call

    @property
    def is_running(self) -> bool:
        """Whether Blender will call the function."""
        return bpy.app.timers.is_registered(self._call)

    def start(self, after: float = 0.0) -> None:
        """Let Blender call the function after some seconds, unless it will do so anyway."""
        if not self.is_running:
            bpy.app.timers.register(self._call, first_interval=after)

    def stop(self) -> None:
        """Let Blender call the function no longer."""
        if self.is_running:
            bpy.app.timers.unregister(self._call)
