# SPDX-License-Identifier: GPL-3.0-or-later
"""Divides the long work of an operator into steps, so that the interface keeps drawing.

Esc cancels the operator, and nothing changes. Enter ends a step early if it already has a result.
"""

from __future__ import annotations

import time
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy

from .navigation import moves_view

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from concurrent.futures import Future

    Progress = Callable[[float], bool]
    """Takes the finished fraction, and returns whether to continue."""

running: list[Stepwise] = []
"""The operators that take steps beside the interface at the moment."""
_PERIOD = 0.05
"""Seconds between two looks at whether a step has ended."""
_CONSOLE_PERIOD = 5.0
"""Seconds between two lines about the progress."""


@dataclass(frozen=True)
class Step:
    """One step of an operator.

    Parameters
    ----------
    text
        A text for the status bar.
    work
        Work for another thread, or None if Blender itself must do what comes next.
    look
        Shows the best result so far, and returns a text for the status bar. The text is empty if there is no result yet. The interface
        calls it from time to time. None if the step cannot end early.
    """

    text: str
    work: Callable[[Progress], None] | None = None
    look: Callable[[], str] | None = None


class Stepwise:
    """Gives an operator `execute`, and `invoke` with a thread for its steps. The operator has `steps`.

    Attributes
    ----------
    enough
        Whether the artist pressed Enter: steps with a `look` should end with the best result so far.
    """

    enough = False

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        """Yield the steps, and return the operator's result.

        A ValueError is reported. If the generator is closed between two steps, nothing changes.
        """
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take all steps at once, for scripts and for Adjust Last Operation.

        The mouse pointer shows the progress of each step. Without a window the console does, while a step takes longer than a few seconds.
        """
        self._steps = self.steps(context)
        pointer = context.window_manager
        shown = time.monotonic()

        def show(fraction: float) -> bool:
            nonlocal shown
            pointer.progress_update(100.0 * fraction)
            if bpy.app.background and time.monotonic() - shown > _CONSOLE_PERIOD:
                print(f"progress {100.0 * fraction:.0f} {step.text}", flush=True)
                shown = time.monotonic()
            return True

        pointer.progress_begin(0.0, 100.0)
        try:
            while True:
                step = next(self._steps)
                if step.work is not None:
                    step.work(show)
        except StopIteration as end:
            return end.value
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            self._steps.close()
            pointer.progress_end()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Take the steps while the interface keeps drawing."""
        from concurrent.futures import ThreadPoolExecutor

        if bpy.app.background or context.window is None:
            return self.execute(context)
        manager = context.window_manager
        self._steps = self.steps(context)
        self._cancelled, self._fraction, self._seen = False, 0.0, ""
        self._workspace = context.workspace
        self._work: Future[None] | None = None
        self._thread = ThreadPoolExecutor(1, "seamwire steps")
        self._cleanup = ExitStack()
        self._cleanup.callback(self._tell, None)
        self._cleanup.callback(manager.event_timer_remove, manager.event_timer_add(_PERIOD, window=context.window))
        self._cleanup.callback(self._steps.close)
        self._cleanup.callback(self._thread.shutdown)
        running.append(self)
        self._cleanup.callback(running.remove, self)
        result = self._advance()
        if result == {"RUNNING_MODAL"}:
            context.window_manager.modal_handler_add(self)
        return result

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Wait for a step, and take the next one. Only the view can be moved in the meantime."""
        if self not in running:
            return {"CANCELLED", "PASS_THROUGH"}
        if moves_view(event, context.window_manager):
            return {"PASS_THROUGH"}
        if event.type == "ESC":
            self._cancelled = True
        if event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS" and self._seen:
            self.enough = True
        is_at_work = self._work is not None and not self._work.done()
        if is_at_work:
            try:
                self._show()
            except BaseException:
                self.end()
                raise
        if is_at_work or event.type not in {"TIMER", "ESC"}:
            return {"RUNNING_MODAL"}
        return self._advance()

    def cancel(self, _context: bpy.types.Context) -> None:
        """End because Blender quits or loads a file."""
        self.end()

    def end(self) -> None:
        """Cancel the step that runs, wait for its thread, and put everything back. More than once does no harm."""
        self._cancelled = True
        self._cleanup.close()

    def _advance(self) -> set[str]:
        """Take the next step, or end."""
        result = {"CANCELLED"}
        try:
            if not self._cancelled:
                if self._work is not None:
                    self._work.result()
                self._step, self._fraction, self._seen = next(self._steps), 0.0, ""
                self.enough = False
                self._work = self._thread.submit(self._step.work, self._progress) if self._step.work else None
                self._show()
                return {"RUNNING_MODAL"}
        except StopIteration as end:
            result = end.value
        except ValueError as error:
            self.report({"ERROR"}, str(error))
        except BaseException:
            self.end()
            raise
        self.end()
        return result

    def _progress(self, fraction: float) -> bool:
        self._fraction = fraction
        return not self._cancelled

    def _show(self) -> None:
        parts = [self._step.text if self._work is None else f"{self._step.text}: {100.0 * self._fraction:.0f} %"]
        if self._step.look is not None and not self.enough:
            self._seen = self._step.look()
            parts += [self._seen, "Enter: Keep This"] if self._seen else []
        self._tell("    ".join([*parts, "Esc: Cancel"]))

    def _tell(self, text: str | None) -> None:
        with suppress(ReferenceError):  # the workspace may be gone with its file
            self._workspace.status_text_set(text)


def end_all() -> None:
    """End every operator that takes steps, as if the artist had cancelled it."""
    for operator in tuple(running):
        operator.end()
