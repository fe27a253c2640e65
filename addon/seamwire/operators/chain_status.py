# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints drawn in Blender's status bar. It needs no NumPy, so that Blender's start does not wait for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import bpy

    from ..words.hints import Hint


def draw_hints(header: bpy.types.Header, shown: Iterable[Hint]) -> None:
    """Draw hints in a row."""
    row = header.layout.row(align=False)
    for icon, text in shown:
        row.label(text=text, icon=icon)


def status_drawer(shown: Iterable[Hint]) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    """Return a function that draws hints in the status bar.

    It is a plain function, because Blender makes it a method of its header class and crashes on a bound method.
    """

    def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
        draw_hints(header, shown)

    return draw
