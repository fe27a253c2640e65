# SPDX-License-Identifier: GPL-3.0-or-later
"""Slides vertices onto kept wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..words.names import count

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession


def slide_wires(wires: Mapping[ObjectSession, Collection[Wire]]) -> str:
    """Slide the vertices of kept wires onto the wires, and return a report. The sessions of the meshes end."""
    from ..mesh import finish

    return f"{count(sum(finish.slide(mesh, own)[1] for mesh, own in wires.items() if own), 'vertex', 'vertices')} moved"
