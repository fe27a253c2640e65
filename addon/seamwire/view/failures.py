# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the drawing that failed. Each is told of once, and tried again after the mode, the tool or the mesh has changed."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, TypeVar

from ..mesh import settings as chosen

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

Found = TypeVar("Found")


class Failures:
    """The parts that failed since the last change. A part is known by its kind and whatever else tells it from others."""

    def __init__(self) -> None:
        self._failed: dict[tuple[Hashable, ...], Exception | None] = {}
        self._told: dict[tuple[Hashable, ...], str] = {}

    def has(self, *part: Hashable) -> bool:
        """Return whether a part is left alone until the next change."""
        return part in self._failed

    def attempt(self, part: tuple[Hashable, ...], do: Callable[[], Found]) -> Found | None:
        """Call a function and return its result, or None if the part failed, in this call or since the last change."""
        if part in self._failed:
            return None
        try:
            found = do()
        except Exception as error:
            self._failed[part] = error
            text = f"{type(error).__name__}: {error}"
            if self._told.get(part) != text:
                self._told[part] = text
                again = "It is tried again when the mode, the tool or the mesh changes"
                chosen.notices.add("WARNING", f"Part of the drawing failed. {again}: {text}")
                sys.excepthook(type(error), error, error.__traceback__)
            return None
        self._told.pop(part, None)
        return found

    def skip(self, *part: Hashable) -> None:
        """Leave a part alone until the next change, without a message."""
        self._failed[part] = None

    def take(self, kind: str) -> Exception | None:
        """Forget the failures of a kind, and return the error of the first one."""
        parts = [part for part in self._failed if part[0] == kind]
        errors = [self._failed.pop(part) for part in parts]
        return next((error for error in errors if error is not None), None)

    def retry(self) -> None:
        """Let all parts be tried again. A part that fails again with the same error is not told of again."""
        self._failed.clear()

    def clear(self) -> None:
        self._failed.clear()
        self._told.clear()


failures = Failures()
"""The failed parts in this Blender."""
