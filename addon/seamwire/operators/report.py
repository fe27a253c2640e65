# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators run in, and what they say they did."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from ..words.names import count

if TYPE_CHECKING:
    from collections.abc import Callable

    import bpy

    from ..core.network.network import Along
    from ..mesh.object_session import ObjectSession
    from .modal import Chain

_Found = TypeVar("_Found")

running: list[Chain] = []
"""The chain that is being drawn."""
status_makers: list[Callable[[Chain], object]] = []
"""Make what draws the status bar while a chain is drawn; the interface adds one."""


def in_edit_mode(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Whether a mesh is in edit mode; where none is, whoever points at the operator's button reads so."""
    obj = context.active_object
    if context.mode == "EDIT_MESH" and obj is not None and obj.type == "MESH":
        return True
    operator.poll_message_set("Needs a mesh in Edit Mode")
    return False


def for_each_object(
    operator: bpy.types.Operator, context: bpy.types.Context, work: Callable[[bpy.types.Object], _Found]
) -> dict[bpy.types.Object, _Found]:
    """Return what work gives for each object in edit mode of which something is visible; nothing, and say why, for none."""
    from ..core.base.native import NativeError
    from ..mesh.edit_mesh import NothingVisibleError

    found, problems = {}, []
    for obj in context.objects_in_mode_unique_data:
        try:
            found[obj] = work(obj)
        except NativeError as error:
            operator.report({"ERROR"}, str(error))
            return {}
        except NothingVisibleError:
            continue
        except ValueError as error:
            problems.append(str(error))
    for problem in problems if found else problems[:1] or ["No face is visible"]:
        operator.report({"WARNING"} if found else {"ERROR"}, problem)
    return found


def open_mesh(operator: bpy.types.Operator, obj: bpy.types.Object, along: Along = "EDGES") -> ObjectSession:
    """Read an object to draw on, and report what is wrong with the wires that came with it.

    Raises
    ------
    ValueError, native.NativeError
        If there is nothing to draw on, or nothing to draw with.
    """
    from ..mesh.object_session import ObjectSession

    mesh = ObjectSession(obj, along)
    if mesh.problem:
        operator.report({"WARNING"}, mesh.problem)
    return mesh


def open_meshes(operator: bpy.types.Operator, context: bpy.types.Context) -> list[ObjectSession]:
    """Read the objects in edit mode as `open_mesh` does, see `for_each_object`."""
    return list(for_each_object(operator, context, lambda obj: open_mesh(operator, obj)).values())


def summary(wires: int, marked: int, cleared: int, touched: int = 0) -> str:
    """Say what was done: `touched` edges are those that new wires run along, seams before or not."""
    parts = [count(wires, "wire")]
    if marked or not cleared:
        parts.append(f"{count(marked, 'edge')} marked")
    if cleared:
        parts.append(f"{count(cleared, 'edge')} cleared")
    already = touched - marked - cleared
    if already > 0:
        parts.append(f"{already} already seams" if not cleared else f"{already} unchanged")
    return ", ".join(parts)
