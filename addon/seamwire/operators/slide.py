# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that slides vertices onto kept wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from .report import count, in_edit_mode, open_meshes

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from ..core.network.network import Wire
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_slide(bpy.types.Operator):
    """Slide the vertices of kept wires across the surface over the faces onto the wires, so that the seams run where the wires do"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_slide"
    bl_label = "Slide Seamwires"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Move the vertices."""
        from ..mesh import edit_mesh

        wires = wires_across(self, context)
        if not wires:
            return {"CANCELLED"}
        done = slide_wires(wires)
        edit_mesh.live_unwrap(context)
        self.report({"INFO"}, f"{count(sum(map(len, wires.values())), 'wire')}: {done}")
        return {"FINISHED"}


def wires_across(operator: bpy.types.Operator, context: bpy.types.Context) -> dict[ObjectSession, list[Wire]]:
    """Return the kept wires across the surface of all objects in edit mode; where there is none, say so and return nothing."""
    wires: dict[ObjectSession, list[Wire]] = {}
    meshes = open_meshes(operator, context)
    for mesh in meshes:
        own = [wire for wire in mesh.session.wires if wire.along == "SURFACE" and wire.marks]
        if own:
            wires[mesh] = own
    if meshes and not wires:
        operator.report({"ERROR"}, "No kept wire runs across the surface")
    return wires


def slide_wires(wires: Mapping[ObjectSession, Collection[Wire]]) -> str:
    """Slide the vertices of kept wires onto them; return what was done, in words. The sessions of the meshes are over then."""
    return f"{count(sum(mesh.slide(own) for mesh, own in wires.items() if own), 'vertex', 'vertices')} moved"


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_slide)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_slide)
