# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes seams run exactly where wires run: cuts wires into the mesh, or slides vertices onto them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..terms.choices import FINISHES, items
from ..words.reports import count, not_cut
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession

_ITEMS = tuple(item for item in items(FINISHES) if FINISHES[item[0]].edits)


class MESH_OT_seamwire_finish(EditMeshOperator, bpy.types.Operator):
    """Make the seams of wires across the surface run exactly where the wires run"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_finish"
    bl_label = "Finish Seamwires"

    finish: bpy.props.EnumProperty(
        name="Finish", description="How a seam comes to lie on its wire", items=_ITEMS, default="CUT"
    )

    description = description_of_item("finish")

    def run(self, context: bpy.types.Context) -> set[str]:
        """Finish the wires of all objects in Edit Mode."""
        from ..mesh import finishes

        meshes = self.open_meshes(context)
        wires = {
            mesh: own
            for mesh in meshes
            if (own := [wire for wire in mesh.session.wires if wire.along == "SURFACE" and wire.marks])
        }
        if not wires:
            if meshes:
                self.report({"ERROR"}, "No kept wire runs across the surface")
            return {"CANCELLED"}
        if FINISHES[self.finish].cuts:
            return cut_wires(self, context, wires, kept=True)
        with changing(context):
            moved = sum(finishes.move(mesh, own, self.finish)[1] for mesh, own in wires.items())
        done = count(sum(map(len, wires.values())), "wire"), count(moved, "vertex", "vertices")
        self.report({"INFO"}, "{}: {} moved".format(*done))
        return {"FINISHED"}


def cut_wires(
    operator: bpy.types.Operator,
    context: bpy.types.Context,
    wires: Mapping[ObjectSession, Sequence[Wire]],
    kept: bool = False,
    crumb: float = 0.0,
    live_unwrap: bool = True,
    first: Callable[[], None] = lambda: None,
) -> set[str]:
    """Cut wires across the surface into meshes, and report the result.

    Wires that do not run over their mesh are left out. If no wire of a mesh can be cut, a warning names the mesh, and the others are
    cut. Every cut is tried on a copy before the first mesh changes. Raises `Halfway` if an error comes after that.
    With `live_unwrap`, Blender's Live Unwrap follows, if it is on.

    `kept` and `crumb` are those of `finishes.cut`. `first` changes meshes before they are cut, and must not renumber them. The
    sessions that are given end.
    """
    from ..mesh import finishes

    plans, problems = {}, []
    for mesh, own in wires.items():
        try:
            if own:
                plans[mesh] = finishes.plan_cut(mesh, own)
        except finishes.CutError as error:
            problems.append(f"{mesh.obj.name}: {error}" if len(wires) > 1 else str(error))
    if not plans:
        operator.report({"ERROR"}, problems[0])
        return {"CANCELLED"}
    for problem in problems:
        operator.report({"WARNING"}, problem if kept else f"{problem}: no wire was added")
    with changing(context if live_unwrap else None):
        first()
        cuts = [finishes.cut(mesh, plan, wires[mesh], kept, crumb=crumb)[1] for mesh, plan in plans.items()]
    for problem in not_cut(sum(cut.uncut for cut in cuts), sum(cut.left_out for cut in cuts)):
        operator.report({"WARNING"}, problem)
    done = (
        f"{count(sum(cut.wires for cut in cuts), 'wire')} cut",
        f"{count(sum(len(cut.edges) for cut in cuts), 'edge')} marked",
        count(sum(cut.vertices for cut in cuts), "new vertex", "new vertices"),
    )
    operator.report({"INFO"}, ", ".join(done))
    return {"FINISHED"}


register, unregister = together(*classes(MESH_OT_seamwire_finish))
