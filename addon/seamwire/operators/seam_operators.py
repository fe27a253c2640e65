# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that work on existing seams: one turns them into wires, one closes their gaps, one makes them run where wires run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..mesh.registration import classes, together
from ..terms.choices import FINISHES, items
from ..words.reports import count, not_cut
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

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
                found[mesh] = list(_wires_along(context, mesh, seams))
        if not found:
            self.report({"ERROR"}, f"No {'selected seams' if self.selected else 'seams'} to convert")
            return {"CANCELLED"}
        for mesh, wires in found.items():
            mesh.take_over(wires)
        self.write(context, found, follow=False)
        wires = [wire for own in found.values() for wire in own]
        seeds = {(mesh, end) for mesh, own in found.items() for wire in own for end in (wire.start, wire.end)}
        edges = sum(len(wire.edges()) for wire in wires)
        made = f"{count(len(wires), 'wire')}, {count(len(seeds), 'seed')}"
        self.report({"INFO"}, f"{count(edges, 'seam edge')} converted: {made}")
        return {"FINISHED"}


def _wires_along(context: bpy.types.Context, mesh: ObjectSession, seams: NDArray[np.int32]) -> Iterator[Wire]:
    """Yield the wires of seams. The mouse pointer shows the progress."""
    progress, done = context.window_manager, 0
    progress.progress_begin(0, len(seams))
    try:
        for wire in mesh.session.wires_along(seams):
            done += len(wire.edges())
            progress.progress_update(done)
            yield wire
    finally:
        progress.progress_end()


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
        from ..core.seams.seam_wires import GapFinder

        meshes = self.open_meshes(context)
        if not meshes:
            return {"CANCELLED"}
        gaps_of = {
            mesh: GapFinder(mesh.make_live.wait, mesh.arrays.partly_hidden).find(mesh.arrays.seams, self.longest)
            for mesh in meshes
        }
        found = {mesh: gaps for mesh, gaps in gaps_of.items() if gaps}
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


register, unregister = together(
    *classes(MESH_OT_seamwire_finish, MESH_OT_seamwire_take_over, MESH_OT_seamwire_close_gaps)
)
