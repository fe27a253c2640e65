# SPDX-License-Identifier: GPL-3.0-or-later
"""Divides the long work of an operator into steps, so that the interface keeps drawing.

Esc or a right click cancels the operator, and nothing changes. Enter ends a step early if it already has a result.
"""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy

from ..tool.keymaps import is_for_blender, right_click_cancels, undoes
from ..tool.running import listen, show_status
from ..tool.running import steps as running
from .edit_mesh_operator import EditMeshOperator

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from concurrent.futures import Future

    Progress = Callable[[float], bool]
    """Takes the finished fraction, and returns whether to continue."""

_ALWAYS = frozenset({"TIMER", "RET", "NUMPAD_ENTER"})
"""Events that count wherever the mouse is."""
_PERIOD = 0.02
"""Seconds between two looks at whether a step has ended."""
_CONSOLE_PERIOD = 5.0
"""Seconds between two lines about the progress."""


class Step(NamedTuple):
    text: str  # for the status bar
    work: Callable[[Progress], None] | None = None  # for another thread; None: Blender itself must do what comes next
    # Shows the best result so far, and returns a text for the status bar, empty if there is no result yet. The interface calls it from
    # time to time. None if the step cannot end early.
    look: Callable[[], str] | None = None
    hand: Any = None  # the parts that the artist changes meanwhile; None: the artist can only move the view


class Stepwise(EditMeshOperator):
    """Gives an operator `execute`, and `invoke` with a thread for its steps. The operator has `steps`.

    Attributes
    ----------
    enough
        Whether the artist pressed Enter: steps with a `look` should end with the best result so far.
    is_beside
        Whether the interface keeps drawing beside the steps.
    """

    ends_chain = True
    enough = False
    is_beside = False

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        """Yield the steps, and return the operator's result.

        Errors are reported as by `outcome`. If the generator is closed between two steps, nothing changes.
        """
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take all steps at once, for scripts and for Adjust Last Operation.

        The mouse pointer shows the progress of each step. Without a window the console does, while a step takes longer than a few seconds.
        """
        self.end_chain()
        self.is_beside = False  # Adjust Last Operation executes the operator that was invoked
        self._steps = self.steps(context)
        pointer = context.window_manager
        shown = time.monotonic()
        step = Step("")

        def show(fraction: float) -> bool:
            nonlocal shown
            pointer.progress_update(100.0 * fraction)
            if bpy.app.background and time.monotonic() - shown > _CONSOLE_PERIOD:
                print(f"progress {100.0 * fraction:.0f} {step.text}", flush=True)
                shown = time.monotonic()
            return True

        pointer.progress_begin(0.0, 100.0)

        def run() -> set[str]:
            nonlocal step
            try:
                while True:
                    step = next(self._steps)
                    if step.work is not None:
                        step.work(show)
            except StopIteration as end:
                return end.value

        try:
            return self.outcome(run)
        finally:
            self._steps.close()
            pointer.progress_end()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        from concurrent.futures import ThreadPoolExecutor

        if bpy.app.background or context.window is None:
            return self.execute(context)
        self.end_chain()
        manager = context.window_manager
        self.is_beside = True
        self._steps = self.steps(context)
        self._cancelled, self._fraction, self._seen = False, 0.0, ""
        self._said: str | None = None
        self._work: Future[None] | None = None
        self._thread = ThreadPoolExecutor(1, "seamwire steps")
        self._cleanup = ExitStack()
        self._cleanup.callback(self._tell, None)
        self._cleanup.callback(manager.event_timer_remove, manager.event_timer_add(_PERIOD, window=context.window))
        self._cleanup.callback(self._steps.close)
        self._cleanup.callback(self._thread.shutdown, wait=False)
        running.append(self)
        self._cleanup.callback(running.remove, self)
        self.window = context.window
        result = self._advance()
        if result == {"RUNNING_MODAL"}:
            listen(self.window)
            context.window_manager.modal_handler_add(self)
        return result

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self not in running:
            return {"CANCELLED", "PASS_THROUGH"}
        listen(self.window)
        try:
            return self._follow(context, event)
        except BaseException:
            self.end()
            raise

    def overhear(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Handle an event of another window. Undo is taken, because it would change the mesh. Everything else passes through."""
        if not undoes(event, context.window_manager):
            return {"PASS_THROUGH"}
        hand = None if self._cancelled else self._step.hand
        if hand is not None and hand.take(context, event):
            self._show()
        return {"RUNNING_MODAL"}

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        hand = None if self._cancelled else self._step.hand
        if context.mode != "EDIT_MESH" and not self._cancelled:
            self.report({"WARNING"}, f"Edit Mode was left: {self.bl_label} has ended, and nothing has changed")
            self._cancelled, hand = True, None
        taken = set() if hand is None else hand.take(context, event)
        if taken:
            if "PASS_THROUGH" not in taken:
                self._show()
            return taken
        if self._cancels(context, event):
            self._cancelled = True
        elif event.type not in _ALWAYS and is_for_blender(event, context):
            return {"PASS_THROUGH"}
        if event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS" and self._seen:
            self.enough = True
        has_failed = not self._is_at_work and self._work is not None and self._work.exception() is not None
        is_open = hand is not None and not hand.is_over and not has_failed
        is_waiting = not self._cancelled and (self._is_at_work or is_open)
        if is_waiting:
            self._show()
        if is_waiting or not (event.type == "TIMER" or self._cancelled):
            return {"RUNNING_MODAL"}
        return self._advance()

    def _cancels(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Return whether an event cancels the operator, as it does for Blender's own tools."""
        from ..view.viewport import place_of

        if event.type == "RIGHTMOUSE":
            if place_of(context.window, event) is None:
                return False
            is_plain = not (event.ctrl or event.shift or event.alt or event.oskey)
            return is_plain and event.value in {"PRESS", "DOUBLE_CLICK"} and right_click_cancels(context.window_manager)
        return event.type == "ESC"

    @property
    def _is_at_work(self) -> bool:
        return self._work is not None and not self._work.done()

    def cancel(self, _context: bpy.types.Context) -> None:
        self.end()

    def end(self) -> None:
        """Cancel the step that runs, and put everything back. More than once does no harm.

        The thread ends in the background, because long work may look seldom at whether it goes on. Its result is dropped.
        """
        self._cancelled = True
        self._cleanup.close()

    def _advance(self) -> set[str]:
        result = {"CANCELLED"}
        try:
            if not self._cancelled:
                result = self.outcome(self._next)
        finally:
            if result != {"RUNNING_MODAL"}:
                self.end()
        return result

    def _next(self) -> set[str]:
        if self._work is not None:
            self._work.result()
        try:
            self._step, self._fraction, self._seen = next(self._steps), 0.0, ""
        except StopIteration as end:
            return end.value
        self.enough = False
        self._work = self._thread.submit(self._step.work, self._progress) if self._step.work else None
        self._show()
        return {"RUNNING_MODAL"}

    def _progress(self, fraction: float) -> bool:
        self._fraction = fraction
        return not self._cancelled

    def _show(self) -> None:
        step, hand = self._step, self._step.hand
        texts = [] if hand is None else [hand.title]
        if self._is_at_work:
            texts.append(f"{step.text}: {100.0 * self._fraction:.0f} %")
        elif hand is None:
            texts.append(step.text)
        if step.look is not None and not self.enough:
            self._seen = step.look()
            texts += [self._seen] if self._seen else []
        if hand is not None and hand.hints:
            texts += hand.hints
        elif self._seen and not self.enough:
            texts.append("Enter: Keep This")
        is_right = right_click_cancels(bpy.context.window_manager)
        self._tell("    ".join([*texts, "Esc or Right Click: Cancel" if is_right else "Esc: Cancel"]))

    def _tell(self, text: str | None) -> None:
        if text == self._said:
            return
        self._said = text
        show_status(None if text is None else [("NONE", text)])


def end_all() -> None:
    """End every operator that takes steps, as if the artist had cancelled it."""
    for operator in tuple(running):
        operator.end()
