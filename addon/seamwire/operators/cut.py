# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts wires into the mesh and reports the result."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..words.names import count
from ..words.reports import gaps, left_out
from .edit_mesh_operator import changing

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import bpy

    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession


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
    cut. Every cut is tried on a copy before the first mesh changes.

    Parameters
    ----------
    operator
        Reports the result.
    wires
        The wires of each mesh. Its session ends.
    kept
        Whether meshes already have these wires. Their snapped edges stop being seams.
    crumb
        Islands smaller than this fraction of the area of a mesh are merged into a larger one.
    live_unwrap
        Whether to follow Blender's Live Unwrap.
    first
        Changes meshes before they are cut, after every cut was tried. It must not renumber them.

    Raises
    ------
    Halfway
        If an error comes after a mesh has changed.
    """
    from ..mesh import edit_mesh, finish
    from ..mesh.cut import CutError

    plans, problems = {}, []
    for mesh, own in wires.items():
        try:
            if own:
                plans[mesh] = finish.plan_cut(mesh, own)
        except CutError as error:
            problems.append(f"{mesh.obj.name}: {error}" if len(wires) > 1 else str(error))
    if not plans:
        operator.report({"ERROR"}, problems[0])
        return {"CANCELLED"}
    for problem in problems:
        operator.report({"WARNING"}, problem if kept else f"{problem}: no wire was added")
    with changing():
        first()
        cuts = [finish.cut(mesh, plan, wires[mesh], kept, crumb=crumb)[1] for mesh, plan in plans.items()]
        if live_unwrap:
            edit_mesh.live_unwrap(context)
    uncut = sum(cut.uncut for cut in cuts)
    if uncut:
        operator.report({"WARNING"}, gaps(uncut))
    missing = sum(cut.left_out for cut in cuts)
    if missing:
        operator.report({"WARNING"}, left_out(missing))
    done = (
        f"{count(sum(cut.wires for cut in cuts), 'wire')} cut",
        f"{count(sum(len(cut.edges) for cut in cuts), 'edge')} marked",
        count(sum(cut.vertices for cut in cuts), "new vertex", "new vertices"),
    )
    operator.report({"INFO"}, ", ".join(done))
    return {"FINISHED"}
