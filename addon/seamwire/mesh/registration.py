# SPDX-License-Identifier: GPL-3.0-or-later
"""The versions of Blender that are supported, 3.4, as Debian 12 has it, and 4.2 to 5.x, and what registers things with Blender."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Callable

    Change = tuple[Callable[[], object], Callable[[], object]]
    """A function, and the function that takes back what the first has done."""

OLD = (3, 4)
"""The only supported version before `NEW`."""
NEW = (4, 2)
"""The oldest supported version that has extensions."""
IS_OLD = bpy.app.version[:2] < NEW
"""Whether this Blender is `OLD`. Where the two differ only in the name or the presence of a property, code asks for the property."""


def check_version(version: tuple[int, ...] = bpy.app.version) -> None:
    if version[:2] != OLD and version[:2] < NEW:
        found, old, new = ("{}.{}".format(*number[:2]) for number in (version, OLD, NEW))
        raise RuntimeError(f"Seamwire does not run in Blender {found}: use Blender {old}, or {new} or newer")


def together(*changes: Change) -> tuple[Callable[[], None], Callable[[], None]]:
    """Return a function that makes all changes, and a function that takes them back in reverse order.

    If a change fails, the changes before it are taken back, and the error is raised. An error while changes are taken back is raised
    after the others were taken back too.
    """

    def register() -> None:
        with ExitStack() as undo:
            for do, take_back in changes:
                do()
                undo.callback(take_back)
            undo.pop_all()

    def unregister() -> None:
        with ExitStack() as undo:
            for _, take_back in changes:
                undo.callback(take_back)

    return register, unregister


def classes(*types: type) -> tuple[Change, ...]:
    def change(each: type) -> Change:
        return lambda: bpy.utils.register_class(each), lambda: bpy.utils.unregister_class(each)

    return tuple(map(change, types))


def menu_entry(menu: str, draw: Callable[[bpy.types.Menu, bpy.types.Context], None]) -> Change:
    return lambda: getattr(bpy.types, menu).append(draw), lambda: getattr(bpy.types, menu).remove(draw)


def handler(name: str, function: Callable[..., None]) -> Change:
    """Return the change that lets Blender call a function, by the name of a list in `bpy.app.handlers`."""
    handlers = getattr(bpy.app.handlers, name)
    return lambda: handlers.append(function), lambda: handlers.remove(function)


class Timer:
    """Lets Blender call a function, at most one call at a time. It returns the seconds until the next call, or None to stop.

    Blender finds a timer by the address of its function. A bound method is another object at each access, so this object keeps one. While
    it is kept, no other object can have its address.
    """

    def __init__(self, call: Callable[[], float | None]) -> None:
        self._call = call

    @property
    def is_running(self) -> bool:
        return bpy.app.timers.is_registered(self._call)

    def start(self, after: float = 0.0) -> None:
        """Let Blender call the function after some seconds, unless it will do so anyway."""
        if not self.is_running:
            bpy.app.timers.register(self._call, first_interval=after)

    def stop(self) -> None:
        if self.is_running:
            bpy.app.timers.unregister(self._call)
