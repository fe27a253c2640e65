# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that makes seams run exactly where kept wires run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import bpy

from ..words.names import count
from .cut import cut_wires
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item
from .slide import slide_wires

if TYPE_CHECKING:
    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_finish(EditMeshOperator, bpy.types.Operator):
    """Make the seams of wires across the surface run exactly where the wires run"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_finish"
    bl_label = "Finish Seamwires"

    finish: bpy.props.EnumProperty(
        name="Finish",
        description="How a seam comes to lie on its wire",
        items=(
            ("CUT", "Cut", "Cut the wires into the faces"),
            ("SLIDE", "Slide", "Slide the vertices of the nearest edges onto the wires"),
        ),
    )

    description = description_of_item("finish")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Cut or slide the wires of all objects in Edit Mode."""
        return finish_wires(self, context, self.finish)


def finish_wires(operator: EditMeshOperator, context: bpy.types.Context, finish: Literal["CUT", "SLIDE"]) -> set[str]:
    """Cut or slide the kept wires across the surface, and report what was done."""
    from ..mesh import edit_mesh

    wires = _wires_across(operator, context)
    if not wires:
        return {"CANCELLED"}
    if finish == "CUT":
        return cut_wires(operator, context, wires, kept=True)
    with changing():
        done = slide_wires(wires)
        edit_mesh.live_unwrap(context)
    operator.report({"INFO"}, f"{count(sum(map(len, wires.values())), 'wire')}: {done}")
    return {"FINISHED"}


def _wires_across(operator: EditMeshOperator, context: bpy.types.Context) -> dict[ObjectSession, list[Wire]]:
    """Return the kept wires across the surface of each object in Edit Mode. Report an error if no object has such a wire."""
    wires: dict[ObjectSession, list[Wire]] = {}
    meshes = operator.open_meshes(context)
    for mesh in meshes:
        own = [wire for wire in mesh.session.wires if wire.along == "SURFACE" and wire.marks]
        if own:
            wires[mesh] = own
    if meshes and not wires:
        operator.report({"ERROR"}, "No kept wire runs across the surface")
    return wires


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_finish,))
