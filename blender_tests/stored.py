# SPDX-License-Identifier: GPL-3.0-or-later
"""What is stored with meshes, read as the tool reads it."""

from __future__ import annotations

import bpy
import pytest
from scene import Edge, seams
from seamwire.core.storage.serialization import Archive
from seamwire.mesh import object_session
from seamwire.mesh.object_session import ObjectSession
from seamwire.mesh.uv_islands import count_islands


def session_on(obj: bpy.types.Object) -> ObjectSession:
    """Return a session on an object in edit mode."""
    return ObjectSession(obj)


def write(mesh: ObjectSession) -> tuple[int, int]:
    """Let the mesh hold what its session has, as the end of a chain does."""
    mesh.session.end_chain()
    return mesh.write(mesh.plan())


def chains(obj: bpy.types.Object) -> list[tuple[int, ...]]:
    """Return the vertices of the wires that a mesh in edit mode has, the smaller end first, sorted."""
    found = [wire.vertices for wire in session_on(obj).session.wires]
    return sorted(chain if chain[0] <= chain[-1] else chain[::-1] for chain in found)


def wired(obj: bpy.types.Object) -> list[Edge]:
    """Return the edges that the wires of a mesh in edit mode run along, images too, sorted."""
    return sorted({edge for wire in session_on(obj).session.wires for edge in wire.claims()})


def agree(obj: bpy.types.Object, plain: list[Edge] | tuple[Edge, ...] = ()) -> bool:
    """Whether the seams of a mesh in edit mode are those of its wires, and the plain ones named."""
    return seams(obj) == sorted({*wired(obj), *plain})


def forget(patch: pytest.MonkeyPatch) -> None:
    """Forget the records of all meshes, as a Blender that was just started knows none."""
    patch.setattr(object_session, "_archive", Archive())


def island_count(obj: bpy.types.Object) -> int:
    """Return how many islands an object in Edit Mode has."""
    return count_islands(obj)
