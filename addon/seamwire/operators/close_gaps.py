# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that closes gaps in seams."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..core.seams.gaps import Gap
    from ..mesh.object_session import ObjectSession


class MESH_OT_seamwire_close_gaps(EditMeshOperator, bpy.types.Operator):
    """Draw wires where the end of a seam just misses another seam or the boundary, so that the islands separate"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_close_gaps"
    bl_label = "Close Gaps in Seams"

    longest: bpy.props.FloatProperty(
        name="Longest Gap",
        description="Longest gap to close, as a fraction of the seam ending there",
        default=0.5,
        min=0.0,
        soft_max=2.0,
    )

    def run(self, context: bpy.types.Context) -> set[str]:
        """Draw wires over the gaps of all objects before writing to any, so that an error leaves all of them unchanged."""
        from ..mesh import edit_mesh

        meshes = self.open_meshes(context)
        if not meshes:
            return {"CANCELLED"}
        found = self._find(meshes)
        if not found:
            self.report({"INFO"}, "No gaps: no seam ends just before another seam or the boundary")
            return {"CANCELLED"}
        closed = sum(self._close(mesh, gaps) for mesh, gaps in found.items())
        if not closed:
            self.report({"ERROR"}, "No gap could be closed")
            return {"CANCELLED"}
        plans = {mesh: mesh.plan() for mesh in found}
        with changing():
            marked = sum(mesh.write(plan)[0] for mesh, plan in plans.items())
            edit_mesh.live_unwrap(context)
        self.report({"INFO"}, f"{count(closed, 'gap')} closed, {count(marked, 'edge')} marked")
        return {"FINISHED"}

    def _find(self, meshes: Iterable[ObjectSession]) -> dict[ObjectSession, list[Gap]]:
        """Return the gaps of each object that has some."""
        from ..core.seams.gaps import GapFinder

        found = {}
        for mesh in meshes:
            arrays = mesh.arrays
            finder = GapFinder(arrays.points, arrays.triangles, arrays.edges, arrays.partly_hidden)
            gaps = finder.find(arrays.seams, self.longest)
            if gaps:
                found[mesh] = gaps
        return found

    def _close(self, mesh: ObjectSession, gaps: list[Gap]) -> int:
        """Draw a wire and its mirror images over each gap that is still open, and return the number of wires."""
        from ..words.scripted import draw_chain

        mesh.make_live.wait()
        session, closed = mesh.session, 0
        before = set(session.wires)
        for gap in gaps:
            new = [wire for wire in session.wires if wire not in before]
            if any(gap.end in edge for wire in new for edge in wire.claims()):
                continue
            for problem in draw_chain(session, (gap.end, gap.target)):
                self.report({"WARNING"}, problem)
            closed += len(session.wires) > len(before) + len(new)
        return closed


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_close_gaps,))
