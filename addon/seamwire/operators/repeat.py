# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that repeats wires wherever the mesh has matching edges."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing

if TYPE_CHECKING:
    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_repeat(EditMeshOperator, bpy.types.Operator):
    """Repeat the last wires, and those connected to them, wherever edges match"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_repeat"
    bl_label = "Repeat Seamwires"

    selected: bpy.props.BoolProperty(
        name="Selected", description="Repeat the wires with selected edges instead of the last ones", default=False
    )

    def run(self, context: bpy.types.Context) -> set[str]:
        """Find matching places on the active object, and add the missing wires."""
        from ..core.matching.repeats import Repeats
        from ..mesh import edit_mesh

        mesh = self.open_mesh(context.active_object)
        groups = self._groups(mesh)
        if not groups:
            self.report({"ERROR"}, f"No {'selected wire' if self.selected else 'wire'} along edges to repeat")
            return {"CANCELLED"}
        arrays = mesh.arrays
        repeats = Repeats(arrays.points, arrays.triangles, arrays.edges)
        taken = {(min(pair), max(pair)) for pair in arrays.seams.tolist()}
        places, new = 0, []
        for group in groups:
            for place in repeats.of(group, arrays.points):
                wires = [wire for wire in place if not taken.issuperset(wire.edges())]
                places += bool(wires)
                new += wires
                taken.update(edge for wire in wires for edge in wire.edges())
        if not new:
            self.report({"INFO"}, "No other unmarked place matches these wires")
            return {"CANCELLED"}
        mesh.add(new)
        plan = mesh.plan()
        with changing():
            marked, _ = mesh.write(plan)
            edit_mesh.live_unwrap(context)
        self.report(
            {"INFO"}, f"Repeated at {count(places, 'place')}: {count(len(new), 'wire')}, {count(marked, 'edge')} marked"
        )
        return {"FINISHED"}

    def _groups(self, mesh: ObjectSession) -> list[list[Wire]]:
        """Return the wires to repeat, with connected wires in one list."""
        from ..core.matching.repeats import connected_groups

        wires = [wire for wire in mesh.session.wires if wire.along == "EDGES"]
        wanted = wires[-1:]
        if self.selected:
            chosen = {
                tuple(sorted(vertex.index for vertex in edge.verts)) for edge in mesh.cage.bm.edges if edge.select
            }
            wanted = [wire for wire in wires if not chosen.isdisjoint(wire.edges())]
        return connected_groups(wanted, wires)


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_repeat,))
