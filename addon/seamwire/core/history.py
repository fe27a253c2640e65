# SPDX-License-Identifier: GPL-3.0-or-later
"""The networks that undo and redo bring back."""

from __future__ import annotations

from .network import Network


class History:
    """What a network was before each of its steps, and after those that were taken back."""

    def __init__(self) -> None:
        self._undo: list[Network] = []
        self._redo: list[Network] = []

    @property
    def steps(self) -> int:
        """How many steps were done."""
        return len(self._undo)

    @property
    def empty(self) -> bool:
        """Whether there are no steps, done or taken back."""
        return not self._undo and not self._redo

    @property
    def can_redo(self) -> bool:
        """Whether there are steps that were taken back."""
        return bool(self._redo)

    def can_undo(self, now: Network) -> bool:
        """Whether a step led to something else than there is now."""
        return any(network != now for network in self._undo)

    def step(self, before: Network) -> None:
        """Remember what was there before a new step."""
        self._undo.append(before)
        self._redo.clear()

    def forget_step(self) -> Network:
        """Return what was there before the last step, as if that had never been done. There must be one."""
        return self._undo.pop()

    def back(self, now: Network) -> Network | None:
        """Return what was there before the last step that changed something; None: there is no such step."""
        while self._undo:
            network = self._undo.pop()
            if network != now:
                self._redo.append(now)
                return network
        return None

    def forth(self, now: Network) -> Network | None:
        """Return what the step did that was taken back last; None: there is no such step."""
        if not self._redo:
            return None
        self._undo.append(now)
        return self._redo.pop()

    def forget(self) -> None:
        """Forget all steps: what was done is Blender's to undo now."""
        self._undo.clear()
        self._redo.clear()
