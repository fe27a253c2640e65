# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that turns existing seams into wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_take_over(EditMeshOperator, bpy.types.Operator):
    """Turn existing seams into wires with as few seeds as possible, so that you can drag them"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_take_over"
    bl_label = "Seams to Seamwires"

    selected: bpy.props.BoolProperty(name="Selected Only", description="Convert only selected seams", default=False)

    def run(self, context: bpy.types.Context) -> set[str]:
        """Find the wires of all objects in Edit Mode, then write them. The seams do not change."""
        found: dict[ObjectSession, list[Wire]] = {}
        meshes = self.open_meshes(context)
        if not meshes:
            return {"CANCELLED"}
        for mesh in meshes:
            seams = mesh.plain_seams
            if self.selected:
                bm = mesh.cage.number_bmesh()
                seams = seams[[bm.edges.get([bm.verts[v] for v in pair]).select for pair in seams.tolist()]]
            if len(seams):
                found[mesh] = self._wires(context, mesh, seams)
        if not found:
            self.report({"ERROR"}, f"No {'selected seams' if self.selected else 'seams'} to convert")
            return {"CANCELLED"}
        for mesh, wires in found.items():
            mesh.take_over(wires)
        plans = {mesh: mesh.plan() for mesh in found}
        with changing():
            for mesh, plan in plans.items():
                mesh.write(plan)
        wires = [wire for own in found.values() for wire in own]
        seeds = {(mesh, end) for mesh, own in found.items() for wire in own for end in (wire.start, wire.end)}
        edges = sum(len(wire.edges()) for wire in wires)
        self.report(
            {"INFO"},
            f"{count(edges, 'seam edge')} converted: {count(len(wires), 'wire')}, {count(len(seeds), 'seed')}",
        )
        return {"FINISHED"}

    @staticmethod
    def _wires(context: bpy.types.Context, mesh: ObjectSession, seams: NDArray[np.int32]) -> list[Wire]:
        progress = context.window_manager
        progress.progress_begin(0, len(seams))
        wires, done = [], 0
        try:
            for wire in mesh.session.drawing.wires_along(seams):
                wires.append(wire)
                done += len(wire.edges())
                progress.progress_update(done)
        finally:
            progress.progress_end()
        return wires


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_take_over,))
