# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that draws wires for scripts."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import bpy

from ..mesh.settings import ALONG_ITEMS, FINISH_ITEMS, METRIC_ITEMS
from ..words.reports import summary
from .cut import cut_wires
from .edit_mesh_operator import EditMeshOperator, changing
from .slide import slide_wires

if TYPE_CHECKING:
    from ..core.drawing.options import Options
    from ..core.network.picks import Pick
    from ..core.network.wires import Wire
    from ..mesh.object_session import ObjectSession
    from ..words.seed_text import VertexStroke


class MESH_OT_seamwire_mark(EditMeshOperator, bpy.types.Operator):
    """Mark the seams of wires between given vertices or edges"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_mark"
    bl_label = "Mark Seamwires"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "INTERNAL"}  # for scripts: the search does not find it

    chains: bpy.props.StringProperty(
        name="Chains",
        description="Chains of seeds, separated by semicolons. A seed is a vertex number, an edge such as 3-7, or across the"
        " surface a place such as (0 0.5 1)",
    )
    loops: bpy.props.StringProperty(
        name="Loops",
        description="Edges such as 3-7: the loop through each edge is added. Across the surface, vertex numbers or places: the"
        " closed cut through each is added",
    )
    take: bpy.props.EnumProperty(
        name="Take",
        description="Kind of loop through the edges",
        items=(
            ("FIRST", "First Offered", "The loop that a click on the edge offers first"),
            ("CLOSED", "Closed Loop", "The best closed chain of edges"),
            ("STRIP", "Strip", "Straight in both directions, up to seams, wires and the mirror plane"),
            (
                "PAST",
                "Past Poles",
                "Straight in both directions and through poles, up to seams, wires and the mirror plane",
            ),
            ("WHOLE", "Whole Strip", "Straight in both directions, across seams and wires"),
            ("FLAT", "Border of Part", "Around the part beside the edge"),
        ),
        default="FIRST",
    )
    strokes: bpy.props.StringProperty(
        name="Strokes",
        description="Strokes that attract wires, as vertex numbers, separated by semicolons. A tilde before a stroke makes it"
        " repel wires",
    )
    along: bpy.props.EnumProperty(
        name="Along", description="How wires run on the mesh", items=ALONG_ITEMS, default="EDGES"
    )
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="How a wire across the surface becomes a seam",
        items=FINISH_ITEMS,
    )
    clear: bpy.props.BoolProperty(name="Clear", description="Clear seams instead of marking them", default=False)
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Axes to mirror wires over. If not given, as set for the mesh",
        items=(("X", "X", ""), ("Y", "Y", ""), ("Z", "Z", "")),
        options={"ENUM_FLAG"},
        default=set(),
    )
    strength: bpy.props.FloatProperty(
        name="Strength",
        description="How strongly wires follow the shape, from 1 for the shortest path to 100. 0 takes the tool's default",
        default=0.0,
        min=0.0,
        max=100.0,
    )
    metric: bpy.props.EnumProperty(
        name="Metric", description="What wires follow", items=METRIC_ITEMS, default="feature"
    )

    objects: bpy.props.StringProperty(
        name="Objects",
        description="Names of objects in Edit Mode, separated by semicolons, or an asterisk for all. If empty, the active object",
    )

    def run(self, context: bpy.types.Context) -> set[str]:
        """Draw the chains and loops, and mark or clear their edges."""
        from ..mesh import edit_mesh

        self._before: dict[str, tuple[Wire, ...]] = {}
        chosen = self._chosen(context)
        # Draw on all objects before writing to any, so that an error leaves all of them unchanged.
        drawn = list(filter(None, (self._draw(obj, "" if len(chosen) == 1 else f"{obj.name}: ") for obj in chosen)))
        if not drawn:
            raise ValueError("No object has anything visible")
        problems = [problem for _, found in drawn for problem in found]
        for problem in problems:
            self.report({"WARNING"}, problem)
        new_wires = {mesh: _new_wires(mesh.session.wires, self._before[mesh.obj.name]) for mesh, _ in drawn}
        if not any(new_wires.values()):
            self.report({"ERROR"}, f"No seam was marked. {problems[0]}" if problems else "No seam was marked")
            return {"CANCELLED"}
        if self.finish == "CUT" and self.along == "SURFACE":
            return cut_wires(self, context, new_wires)
        plans = [(mesh, mesh.plan()) for mesh, _ in drawn]
        wires = sum(map(len, new_wires.values()))
        touched = sum(len({edge for wire in own for edge in wire.claims()}) for own in new_wires.values())
        with changing():
            written = [mesh.write(plan) for mesh, plan in plans]
            new, old = (sum(numbers) for numbers in zip(*written, strict=True))
            told = summary(wires, new, old, touched)
            if self.finish == "SLIDE" and self.along == "SURFACE" and not self.clear:
                told = f"{told}, {slide_wires(new_wires)}"
            if new or old:
                edit_mesh.live_unwrap(context)
        self.report({"INFO"}, told)
        return {"FINISHED"}

    def _chosen(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to draw on, each mesh once. Raise ValueError if a name is unknown."""
        edited = [obj for obj in context.objects_in_mode if obj.type == "MESH"]
        self._names = names = [name.strip() for name in self.objects.split(";") if name.strip()]
        if not names:
            return [context.active_object]
        missing = sorted(set(names) - {"*"} - {obj.name for obj in edited})
        if missing:
            raise ValueError(f"Not a mesh in Edit Mode: {', '.join(missing)}")
        return list({obj.data: obj for obj in edited if obj.name in names or "*" in names}.values())

    def _draw(self, obj: bpy.types.Object, prefix: str) -> tuple[ObjectSession, list[str]] | None:
        """Draw on one object.

        Returns
        -------
        ObjectSession
            Its session.
        list of str
            Problems, in sentences that begin with the prefix.

        The result is None if all objects are wanted and nothing of this one is visible.
        """
        from ..mesh.edit_mesh import NothingVisibleError
        from ..mesh.object_session import ObjectSession
        from ..words import seed_text

        try:
            mesh = ObjectSession(obj, self._options(obj))
            mesh.make_live.wait()
            seeds, loops, strokes = self._read(mesh)
        except NothingVisibleError as error:
            if prefix and obj.name not in self._names:
                return None
            raise ValueError(f"{prefix}{error}") from error
        except ValueError as error:
            raise ValueError(f"{prefix}{error}") from error
        session = mesh.session
        self._before[obj.name] = session.wires
        take = None if self.take == "FIRST" else self.take
        problems = [
            *(notice.text for notice in mesh.notices.take()),
            *seed_text.draw_strokes(session, strokes),
            *seed_text.draw_chains(session, seeds),
            *seed_text.draw_loops(session, loops, take),
        ]
        return mesh, [f"{prefix}{problem}" for problem in problems]

    def _options(self, obj: bpy.types.Object) -> Options:
        """Return the settings that are asked for; the mirror, if it is not, is the mesh's own."""
        from ..core.drawing.options import Options, strength_name
        from ..mesh.settings import mirror_axes

        asked = self.properties.is_property_set("mirror")
        strength = {strength_name(self.along): self.strength} if self.strength else {}
        return Options(
            along=self.along,
            finish=self.finish,
            metric=self.metric,
            clear=self.clear,
            mirror=tuple("XYZ".index(axis) for axis in self.mirror) if asked else mirror_axes(obj.data),
            **strength,
        )

    def _read(self, mesh: ObjectSession) -> tuple[list[list[Pick]], list[Pick], list[VertexStroke]]:
        """Return chains, loops and strokes. Raise ValueError if they cannot be drawn."""
        from ..core.network.picks import FacePoint
        from ..words import seed_text

        if self.finish == "CUT" and self.clear and self.along == "SURFACE":
            raise ValueError("Finish Cut cannot clear seams")
        across = self.along == "SURFACE" and self.loops.strip()
        loops: list[Pick] = []
        loops += seed_text.parse_points(self.loops, mesh.finder()) if across else seed_text.parse_edges(self.loops)
        seeds = [] if loops and not self.chains.strip() else seed_text.parse_chains(self.chains, mesh.finder())
        strokes = seed_text.parse_strokes(self.strokes)
        through = [stroke.vertices for stroke in strokes]
        problem = mesh.cage.problem_with(pick for chain in (*seeds, loops, *through) for pick in chain)
        if problem:
            raise ValueError(problem)
        if across and self.take != "FIRST":
            raise ValueError("Take applies only along edges")
        if self.along == "SURFACE" and any(isinstance(pick, tuple) for chain in seeds for pick in chain):
            raise ValueError("Seeds across the surface must be vertices or places, not edges")
        if self.along == "EDGES" and any(isinstance(pick, FacePoint) for chain in seeds for pick in chain):
            raise ValueError("Seeds along edges must be vertices or edges, not places")
        return seeds, loops, strokes


def _new_wires(wires: tuple[Wire, ...], before: tuple[Wire, ...]) -> list[Wire]:
    """Return the wires that are new or that changed their edges."""
    known = set(before)
    return [wire for wire in wires if wire not in known]


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_mark,))
