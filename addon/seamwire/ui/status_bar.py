# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows hints in Blender's status bar while a chain is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..operators.report import status_makers
from ..words.hints import Status, hints

if TYPE_CHECKING:
    from collections.abc import Callable

    import bpy

    from ..operators.modal import Chain


def status_of(chain: Chain) -> Status:
    """Return what there is to tell of a chain."""
    symmetric = chain.view.mesh.symmetric
    offers = symmetric if symmetric and not chain.session.mirror_axes else ()
    return Status(chain.session, chain.keys, chain.message, "".join("XYZ"[axis] for axis in offers))


def status_drawer(status: Status) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    """Return what draws the hints in the status bar.

    A plain function: Blender makes it a method of its header class, and crashes on a bound method.
    """

    def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
        row = header.layout.row(align=False)
        for icon, text in hints(status):
            row.label(text=text, icon=icon)

    return draw


def register() -> None:
    """Let chains tell the status bar what each key does."""
    status_makers.append(_drawer_of)


def unregister() -> None:
    """Let them tell it nothing any more."""
    status_makers.remove(_drawer_of)


def _drawer_of(chain: Chain) -> Callable[[bpy.types.Header, bpy.types.Context], None]:
    return status_drawer(status_of(chain))
