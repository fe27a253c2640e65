# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that work on existing seams: one turns them into wires, one closes their gaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..words.reports import count
from .edit_mesh_operator import EditMeshOperator

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from ..core.network.wires import Wire
    from ..core.seams.seam_wires import Gap
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
        self.write(context, found, follow=False)
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
            for wire in mesh.session.wires_along(seams):
                wires.append(wire)
                done += len(wire.edges())
                progress.progress_update(done)
        finally:
            progress.progress_end()
        return wires


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
        marked = self.write(context, found)
        self.report({"INFO"}, f"{count(closed, 'gap')} closed, {count(marked, 'edge')} marked")
        return {"FINISHED"}

    def _find(self, meshes: Iterable[ObjectSession]) -> dict[ObjectSession, list[Gap]]:
        from ..core.seams.seam_wires import GapFinder

        found = {}
        for mesh in meshes:
            gaps = GapFinder(mesh.make_live.wait, mesh.arrays.partly_hidden).find(mesh.arrays.seams, self.longest)
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


register, unregister = together(*classes(MESH_OT_seamwire_take_over, MESH_OT_seamwire_close_gaps))
