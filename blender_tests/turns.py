# SPDX-License-Identifier: GPL-3.0-or-later
"""Python that waits for Blender's window: it runs in turns with Blender's event loop."""

import os
import sys
import traceback
from collections.abc import Callable
from typing import NoReturn

import bpy

_TICKS_BEFORE_START = 8
"""Blender makes its window and redraws it before a timer fires, but the regions get their sizes a little later."""


def leave(code: int) -> NoReturn:
    """End the process at once: Blender's own way out asks questions, and does not always hand on the exit code."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def play(what: Callable[[], int]) -> None:
    """Begin something as soon as Blender's window stands, and end the process with the exit code that it returns.

    It must not hold Blender's event loop, or no event would ever reach the tool. So it runs in a separate greenlet that a timer
    resumes. Each of its waits (``Ui.wait``) switches back to Blender.
    """
    import greenlet
    import ui

    main = greenlet.getcurrent()
    player = greenlet.greenlet(what, parent=main)
    waiting = _TICKS_BEFORE_START

    def tick() -> float:
        nonlocal waiting
        if waiting > 0:
            waiting -= 1
            return 0.0
        try:
            code = player.switch()
        except BaseException:  # the process must end with a failure and not wait for its time limit
            traceback.print_exc()
            leave(3)
        if player.dead:
            leave(code)
        return 0.0

    ui.prepare_blender(switch_to_blender=main.switch)
    bpy.app.timers.register(tick, persistent=True)


def play_strictly(what: Callable[[], None]) -> None:
    """As `play`, for what returns no code: it failed where the tool raised anything."""
    import ui

    def whole() -> int:
        what()
        errors = ui.take_errors()
        sys.stderr.write("".join(errors))
        return 3 if errors else 0

    play(whole)
