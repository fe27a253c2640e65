# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that draws wires again wherever the mesh has the same parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator

if TYPE_CHECKING:
    from ..core.network.network import Wire
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_repeat(EditMeshOperator, bpy.types.Operator):
    """Draw the wires drawn last, and those that hang together with them, wherever the mesh has the same edges again"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_repeat"
    bl_label = "Repeat Seamwires"

    selected: bpy.props.BoolProperty(
        name="Selected", description="Repeat the wires that have selected edges, not those drawn last", default=False
    )

    def run(self, context: bpy.types.Context) -> set[str]:
        """Find the repeats on the active object, and write what is new."""
        from ..core.matching.repeats import Repeats
        from ..mesh import edit_mesh

        mesh = self.open_mesh(context.active_object)
        groups = self._groups(mesh)
        if not groups:
            self.report({"ERROR"}, f"There is no {'selected wire' if self.selected else 'wire'} along edges")
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
            self.report({"INFO"}, "The mesh has these edges nowhere else where they are no seams yet")
            return {"CANCELLED"}
        mesh.add(new)
        marked, _ = mesh.write(mesh.plan())
        edit_mesh.live_unwrap(context)
        self.report(
            {"INFO"}, f"Repeated at {count(places, 'place')}: {count(len(new), 'wire')}, {count(marked, 'edge')} marked"
        )
        return {"FINISHED"}

    def _groups(self, mesh: ObjectSession) -> list[list[Wire]]:
        """Return the wires to repeat, those that hang together in one list."""
        wires = [wire for wire in mesh.session.wires if wire.along == "EDGES"]
        wanted = wires[-1:]
        if self.selected:
            chosen = {
                tuple(sorted(vertex.index for vertex in edge.verts)) for edge in mesh.cage.bm.edges if edge.select
            }
            wanted = [wire for wire in wires if not chosen.isdisjoint(wire.edges())]
        groups: list[list[Wire]] = []
        for wire in wanted:
            if any(wire in group for group in groups):
                continue
            group, reached = [], {*wire.vertices}
            left = wires
            while joined := [other for other in left if not reached.isdisjoint(other.vertices)]:
                group += joined
                reached.update(vertex for other in joined for vertex in other.vertices)
                left = [other for other in left if other not in joined]
            groups.append(group)
        return groups


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_repeat,))
