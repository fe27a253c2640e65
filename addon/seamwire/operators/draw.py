# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: a drawing started and ended, and lists of seeds drawn without a hand."""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING

import bpy

from .. import lazy
from ..ui.menus import count
from ..ui.toolbar import ALONG_ITEMS, METRIC_ITEMS, settings
from .modal import Drawing, close_all, on_load, running

if TYPE_CHECKING:
    from ..core import native, session
    from ..core.network import Edge, Pick
    from ..core.session import Session
    from ..mesh import edit_mesh
    from ..mesh import object_session as board
    from . import seed_text as chains
else:
    board, chains, edit_mesh, native, session = map(
        lazy.Part, ("mesh.object_session", "operators.seed_text", "mesh.edit_mesh", "core.native", "core.session")
    )


def _in_edit_mode(context: bpy.types.Context) -> bool:
    obj = context.active_object
    return context.mode == "EDIT_MESH" and obj is not None and obj.type == "MESH"


def _summary(wires: int, marked: int, cleared: int, touched: int) -> str:
    """Say what was done: `touched` edges are those that wires run along, seams before or not."""
    parts = [count(wires, "wire")]
    if marked or not cleared:
        parts.append(f"{count(marked, 'edge')} marked")
    if cleared:
        parts.append(f"{count(cleared, 'edge')} cleared")
    already = touched - marked - cleared
    if already > 0:
        parts.append(f"{already} {'was' if already == 1 else 'were'} so already")
    return ", ".join(parts)


class MESH_OT_seamwire_mark(bpy.types.Operator):
    """Mark the seams of wires between given vertices or edges"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_mark"
    bl_label = "Mark Seamwires"
    bl_options = {"REGISTER", "UNDO"}

    chains: bpy.props.StringProperty(
        name="Chains",
        description="Chains of seeds: vertex numbers, or edges as two numbers with a hyphen; semicolons between chains",
    )
    loops: bpy.props.StringProperty(
        name="Loops",
        description="Edges, each as two vertex numbers with a hyphen: the closed loop through each of them is taken",
    )
    take: bpy.props.EnumProperty(
        name="Take",
        description="What is taken through the edges given as loops",
        items=(
            ("FIRST", "First Offered", "What a click on the edge offers first"),
            ("CLOSED", "Closed Loop", "The closed chain of edges that is shortest for its shape"),
            ("STRIP", "Strip", "Straight on both ways, up to seams, other wires and the mirror"),
            (
                "PAST",
                "Past Poles",
                "Straight on as well where other than four edges meet, up to seams, other wires and the mirror",
            ),
            ("WHOLE", "Whole Strip", "Straight on both ways, across seams and wires"),
        ),
        default="FIRST",
    )
    strokes: bpy.props.StringProperty(
        name="Strokes",
        description="Strokes that wires are to follow: vertex numbers along each; semicolons between strokes; a tilde"
        " before one that they are to keep off",
    )
    along: bpy.props.EnumProperty(name="Along", description="Where wires run", items=ALONG_ITEMS, default="EDGES")
    clear: bpy.props.BoolProperty(
        name="Clear", description="Let the edges cease to be seams instead of marking them", default=False
    )
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="The axes over which wires are mirrored; where not given, those that the mesh is mirrored over",
        items=(("X", "X", ""), ("Y", "Y", ""), ("Z", "Z", "")),
        options={"ENUM_FLAG"},
        default=set(),
    )
    strength: bpy.props.FloatProperty(
        name="Strength",
        description="How much longer than straight a way may be for following the shape, 1 to 100; 0: as the tool does",
        default=0.0,
        min=0.0,
        max=100.0,
    )
    metric: bpy.props.EnumProperty(
        name="Metric", description="What draws wires to features", items=METRIC_ITEMS, default="feature"
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return _in_edit_mode(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Draw the chains and loops, and mark or clear what they run along."""
        try:
            cage = edit_mesh.Cage(context.active_object)
            seeds, loops, strokes = self._read(cage)
            drawing = self._session(context)
            take = None if self.take == "FIRST" else self.take
            problems = [
                *chains.draw_scribbles(drawing, strokes),
                *chains.draw_chains(drawing, seeds),
                *chains.draw_loops(drawing, loops, take),
            ]
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for problem in problems:
            self.report({"WARNING"}, problem)
        if not drawing.wires:
            self.report({"ERROR"}, f"No seam was marked. {problems[0]}" if problems else "No seam was marked")
            return {"CANCELLED"}
        mark, clear = drawing.edges_to_mark(), drawing.edges_to_clear()
        new, old = cage.write_seams(mark, clear)
        if new or old:
            edit_mesh.live_unwrap(context)
        self.report({"INFO"}, _summary(len(drawing.wires), new, old, len(mark) + len(clear)))
        return {"FINISHED"}

    def _read(self, cage: edit_mesh.Cage) -> tuple[list[list[Pick]], list[Edge], list[chains.Stroke]]:
        """Return chains, loops and strokes; raises ValueError where they cannot be drawn."""
        loops = chains.parse_edges(self.loops)
        seeds = [] if loops and not self.chains.strip() else chains.parse_chains(self.chains)
        strokes = chains.parse_scribbles(self.strokes)
        through = [stroke.vertices for stroke in strokes]
        problem = cage.problem_with(pick for chain in (*seeds, loops, *through) for pick in chain)
        if problem:
            raise ValueError(problem)
        if self.along == "SURFACE" and (loops or any(isinstance(pick, tuple) for chain in seeds for pick in chain)):
            raise ValueError("Across the surface seeds are vertices: give vertex numbers, not edges")
        return seeds, loops, strokes

    def _session(self, context: bpy.types.Context) -> Session:
        arrays = edit_mesh.read(context.active_object)
        drawing = session.Session(
            board.live_maker(arrays),
            arrays.points,
            self.along,
            edges=arrays.edges,
            seams=arrays.seams,
            to_object=arrays.to_object,
        )
        if self.strength:
            drawing.set_strength(self.along, self.strength)
        drawing.set_metric(self.metric)
        given = self.properties.is_property_set("mirror")
        drawing.set_mirror(
            tuple("XYZ".index(axis) for axis in self.mirror) if given else board.mirror_axes(context.active_object.data)
        )
        if self.clear:
            drawing.toggle_marking()
        return drawing


class MESH_OT_seamwire_draw(bpy.types.Operator):
    """Draw seams with live wires that follow the shape of the mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_draw"
    bl_label = "Draw Seamwires"
    bl_options = {"UNDO"}

    along: bpy.props.EnumProperty(
        name="Along",
        description="Where wires run at first; where not given, as the tool is set",
        items=ALONG_ITEMS,
        options={"SKIP_SAVE"},
    )
    first: bpy.props.EnumProperty(
        name="First",
        description="What is done at once, under the cursor",
        items=(
            ("NONE", "Nothing", "The drawing begins with the next click"),
            ("CLICK", "Click", "The first seed is placed"),
            ("LOOP", "Loop", "The loop through the edge is taken"),
            ("ATTRACT", "Stroke", "A stroke begins that wires are to follow"),
            ("REPEL", "Stroke to Keep Off", "A stroke begins that wires are to keep off"),
        ),
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode, and no drawing going on."""
        return _in_edit_mode(context) and not running

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Start drawing."""
        if not any(area.type == "VIEW_3D" for area in context.window.screen.areas):
            self.report({"ERROR"}, "Seams are drawn in a 3D view, and this window shows none")
            return {"CANCELLED"}
        try:
            if self.properties.is_property_set("along"):
                settings(context).along = self.along
            self._drawing = Drawing(context)
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for note in self._drawing.notes:
            self.report({"INFO"}, note)
        context.window_manager.modal_handler_add(self)
        if self.first != "NONE":
            self._drawing.click_at(event, self.first)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Pass an event on to the drawing, and end it where that is due."""
        drawing = self._drawing
        if not drawing.open:
            return {"CANCELLED"}
        try:
            trouble = drawing.trouble(context, event)
            result = set() if trouble else drawing.handle(context, event)
            if "FINISHED" in result:
                trouble = drawing.trouble_at_the_end()
            if trouble:
                kept = drawing.set_aside()
                drawing.close()
                later = f"; start the tool again to go on with {count(kept, 'wire')}" if kept else ""
                self.report({"WARNING"}, f"{trouble} while seams were drawn: nothing was marked{later}")
                return {"CANCELLED", "PASS_THROUGH"}
            if result & {"FINISHED", "CANCELLED"}:
                drawing.close()
            return self._finish(context, drawing) if "FINISHED" in result else result
        except Exception as error:
            traceback.print_exc()
            kept = self._save(drawing)
            drawing.close()
            later = f". Start the tool again to go on with {count(kept, 'wire')}" if kept else ""
            self.report({"ERROR"}, f"Drawing seams ended on an error, and nothing was marked: {error}{later}")
            return {"CANCELLED"}

    @staticmethod
    def _save(drawing: Drawing) -> int:
        """Keep the wires for the next drawing, whatever state this one is in; return how many."""
        try:
            return drawing.set_aside()
        except Exception:
            traceback.print_exc()
            return 0

    def _finish(self, context: bpy.types.Context, drawing: Drawing) -> set[str]:
        if drawing.empty:
            self.report({"INFO"}, "No wire was kept, and nothing marked")
            return {"CANCELLED"}
        wires = strokes = marked = cleared = touched = 0
        before = [one.stored for one in drawing.boards.values()]
        for one, new, old in drawing.write():
            wires += len(one.session.wires)
            strokes += len(one.session.scribbles)
            touched += len(one.session.edges_to_mark()) + len(one.session.edges_to_clear())
            marked, cleared = marked + new, cleared + old
        stored = before != [one.stored for one in drawing.boards.values()]
        if marked or cleared:
            edit_mesh.live_unwrap(context)
        kept = f", {count(strokes, 'stroke')} kept" if strokes else ""
        self.report({"INFO"}, _summary(wires, marked, cleared, touched) + kept)
        # Without a change there is to be no step of undo either.
        return {"FINISHED"} if marked or cleared or stored else {"CANCELLED"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """End drawing when Blender takes the operator away."""
        self._drawing.close()


_CLASSES = (MESH_OT_seamwire_mark, MESH_OT_seamwire_draw)


def register() -> None:
    """Add the operators."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.app.handlers.load_pre.append(on_load)


def unregister() -> None:
    """End what is being drawn, and remove the operators."""
    bpy.app.handlers.load_pre.remove(on_load)
    close_all()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
