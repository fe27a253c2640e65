# SPDX-License-Identifier: GPL-3.0-or-later
"""The one way in which text reaches the artist outside the 3D view: reports, and a hint in the status bar."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

LEVELS = ("INFO", "WARNING", "ERROR")


class Notice(NamedTuple):
    """Something to report, and how Blender shows it."""

    level: Literal["INFO", "WARNING", "ERROR"]
    text: str


class Notices:
    """What waits to be reported, and what the status bar shows."""

    def __init__(self) -> None:
        self.hint = ""  # the result of the last key, for the status bar
        self._waiting: list[Notice] = []

    def add(self, level: Literal["INFO", "WARNING", "ERROR"], text: str) -> None:
        """Add something to report, unless the same text waits already."""
        notice = Notice(level, text)
        if notice not in self._waiting:
            self._waiting.append(notice)

    def take(self) -> list[Notice]:
        """Return what waits to be reported, errors last, and forget it."""
        waiting, self._waiting = self._waiting, []
        return sorted(waiting, key=lambda notice: LEVELS.index(notice.level))

    def tell(self, report: Callable[[set[str], str], None]) -> None:
        """Report what waits, once. `report` takes the level and the text, as operators of Blender do."""
        for level, text in self.take():
            report({level}, text)
