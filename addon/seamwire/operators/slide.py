# SPDX-License-Identifier: GPL-3.0-or-later
"""Slides vertices onto kept wires, and says what was done."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..words.names import count

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from ..core.network.network import Wire
    from ..mesh.object_session import ObjectSession


def slide_wires(wires: Mapping[ObjectSession, Collection[Wire]]) -> str:
    """Slide the vertices of kept wires onto them, and return what was done in words. The sessions of the meshes end."""
    return f"{count(sum(mesh.slide(own) for mesh, own in wires.items() if own), 'vertex', 'vertices')} moved"
