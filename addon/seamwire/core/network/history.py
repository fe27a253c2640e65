# SPDX-License-Identifier: GPL-3.0-or-later
"""The networks that undo and redo bring back."""

from __future__ import annotations

from dataclasses import replace

from .network import Network


class History:
    """The states of a network before each of its steps, and after each step that was undone.

    The mirror belongs to the mesh and is no step of the drawing: what is brought back has the mirror that there is now.
    """

    def __init__(self) -> None:
        self._undo: list[Network] = []
        self._redo: list[Network] = []

    @property
    def steps(self) -> int:
        """How many steps were done."""
        return len(self._undo)

    @property
    def can_redo(self) -> bool:
        """Whether there are steps that were taken back."""
        return bool(self._redo)

    def can_undo(self, now: Network) -> bool:
        """Whether a step led to something else than there is now."""
        now = _without_mirror(now)
        return any(network != now for network in self._undo)

    def step(self, before: Network) -> None:
        """Remember what was there before a new step."""
        self._undo.append(_without_mirror(before))
        self._redo.clear()

    def forget_step(self, now: Network) -> Network:
        """Return what was there before the last step, as if that had never been done. There must be one."""
        return replace(self._undo.pop(), mirror=now.mirror)

    def back(self, now: Network) -> Network | None:
        """Return what was there before the last step that changed something; None: there is no such step."""
        while self._undo:
            network = self._undo.pop()
            if network != _without_mirror(now):
                self._redo.append(_without_mirror(now))
                return replace(network, mirror=now.mirror)
        return None

    def forth(self, now: Network) -> Network | None:
        """Return what the step did that was taken back last; None: there is no such step."""
        if not self._redo:
            return None
        self._undo.append(_without_mirror(now))
        return replace(self._redo.pop(), mirror=now.mirror)

    def forget(self) -> None:
        """Forget all steps: what was done is Blender's to undo now."""
        self._undo.clear()
        self._redo.clear()


def _without_mirror(network: Network) -> Network:
    return replace(network, mirror=())
