# SPDX-License-Identifier: GPL-3.0-or-later
"""What benchmarks in Blender's window count: laps of a function, pictures of the viewport, memory."""

from __future__ import annotations

import ctypes
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import bpy


class Laps:
    """How much of Blender's thread a function takes while this is entered, in seconds.

    Parameters
    ----------
    owner, name
        Where the function is found.
    """

    def __init__(self, owner: ModuleType, name: str) -> None:
        self._owner, self._name, self._function = owner, name, getattr(owner, name)
        self.seconds = 0.0

    def __enter__(self) -> Laps:
        setattr(self._owner, self._name, self._timed)
        return self

    def __exit__(self, *_: object) -> None:
        setattr(self._owner, self._name, self._function)

    def _timed(self, *arguments: object) -> object:
        start = time.thread_time()
        try:
            return self._function(*arguments)
        finally:
            self.seconds += time.thread_time() - start


class Pictures:
    """Counts the pictures of the viewport while this is entered, up to the first one that shows something.

    Attributes
    ----------
    count
        How many there were, that one included.
    moment
        When that one was there.
    """

    def __init__(self) -> None:
        self.count = 0
        self.moment: float | None = None
        self._shows: Callable[[], bool] | None = None

    def __enter__(self) -> Pictures:
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._drawn, (), "WINDOW", "POST_PIXEL")
        return self

    def __exit__(self, *_: object) -> None:
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")

    def _drawn(self) -> None:
        if self.moment is None:
            self.count += 1
            if self._shows is not None and self._shows():
                self.moment = time.perf_counter()

    def first(self, shows: Callable[[], bool]) -> float | None:
        """Return when the first picture was there from now on for which a condition held; None: there was none yet."""
        self._shows = shows
        return self.moment


@dataclass(frozen=True)
class Memory:
    """The memory of this process, in bytes.

    Parameters
    ----------
    resident
        What of it is in memory.
    allocated
        Memory that was allocated and not freed. 0 if the allocator does not tell, because it is not jemalloc.
    """

    resident: int
    allocated: int

    @classmethod
    def now(cls) -> Memory:
        """Return what it holds now."""
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return cls(pages * os.sysconf("SC_PAGE_SIZE"), _allocated())

    def __sub__(self, other: Memory) -> Memory:
        return Memory(self.resident - other.resident, self.allocated - other.allocated)


def _allocated() -> int:
    control = getattr(ctypes.CDLL(None), "mallctl", None)
    if control is None:
        return 0
    # The numbers are those of the moment at which the epoch was set last.
    value, size, none = ctypes.c_uint64(1), ctypes.c_size_t(8), ctypes.c_size_t(0)
    control(b"epoch", None, None, ctypes.byref(value), size)
    control(b"stats.allocated", ctypes.byref(value), ctypes.byref(size), None, none)
    return value.value
