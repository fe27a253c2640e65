# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: a drawing started and ended, and lists of seeds drawn without a hand."""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING

import bpy

from . import lazy, native
from .drawing import Drawing, close_all, count, live_maker, only_active, running
from .tool import ALONG_ITEMS, settings

if TYPE_CHECKING:
    from . import chains, edit_mesh, session
    from .session import Session
else:
    chains, edit_mesh, session = map(lazy.Part, ("chains", "edit_mesh", "session"))


def _in_edit_mode(context: bpy.types.Context) -> bool:
    obj = context.active_object
    return context.mode == "EDIT_MESH" and obj is not None and obj.type == "MESH"


def _summary(drawing: Session, new: int) -> str:
    wires, edges = len(drawing.wires), len(drawing.edges_to_mark())
    already = f", {edges - new} were seams already" if edges > new else ""
    return f"{count(wires, 'wire')}, {count(new, 'edge')} marked{already}"


class MESH_OT_seamwire_mark(bpy.types.Operator):
    """Mark the seams of wires between given vertices or edges"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_mark"
    bl_label = "Mark Seamwires"
    bl_options = {"REGISTER", "UNDO"}

    chains: bpy.props.StringProperty(
        name="Chains",
        description="Chains of seeds: vertex numbers, or edges as two numbers with a hyphen; semicolons between chains",
    )
    along: bpy.props.EnumProperty(name="Along", description="Where wires run", items=ALONG_ITEMS, default="EDGES")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return _in_edit_mode(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Draw the chains, and mark what they run along."""
        try:
            seeds = chains.parse_chains(self.chains)
            cage = edit_mesh.Cage(context.active_object)
            problem = cage.problem_with(pick for chain in seeds for pick in chain)
            if problem:
                raise ValueError(problem)
            if self.along == "SURFACE" and any(isinstance(pick, tuple) for chain in seeds for pick in chain):
                raise ValueError("Across the surface seeds are vertices: give vertex numbers, not edges")
            arrays = edit_mesh.read(context.active_object)
            drawing = session.Session(live_maker(arrays), arrays.points, self.along)
            problems = chains.draw_chains(drawing, seeds)
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for problem in problems:
            self.report({"WARNING"}, problem)
        if not drawing.wires:
            self.report({"ERROR"}, f"No seam was marked. {problems[0]}" if problems else "No seam was marked")
            return {"CANCELLED"}
        only = only_active(context)
        if only:
            self.report({"INFO"}, only)
        self.report({"INFO"}, _summary(drawing, cage.mark_seams(drawing.edges_to_mark())))
        return {"FINISHED"}


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
            self._drawing = Drawing(context, settings(context).along)
        except (ValueError, native.NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for note in self._drawing.notes:
            self.report({"INFO"}, note)
        if self.first != "NONE":
            self._drawing.click_at(event, self.first)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Pass an event on to the drawing, and end it where that is due."""
        drawing = self._drawing
        if not drawing.open:
            return {"CANCELLED"}
        try:
            trouble = drawing.trouble(context)
            if trouble:
                drawing.close()
                self.report({"WARNING"}, f"{trouble} while seams were drawn: nothing was marked")
                return {"CANCELLED", "PASS_THROUGH"}
            result = drawing.handle(context, event)
            if result & {"FINISHED", "CANCELLED"}:
                drawing.close()
            return self._finish(drawing) if "FINISHED" in result else result
        except Exception as error:
            drawing.close()
            traceback.print_exc()
            self.report({"ERROR"}, f"Drawing seams ended on an error, and nothing was marked: {error}")
            return {"CANCELLED"}

    def _finish(self, drawing: Drawing) -> set[str]:
        if not drawing.session.wires:
            self.report({"INFO"}, "No wire was kept, and nothing marked")
            return {"CANCELLED"}
        new = drawing.board.cage.mark_seams(drawing.session.edges_to_mark())
        self.report({"INFO"}, _summary(drawing.session, new))
        # Without a change there is to be no step of undo either.
        return {"FINISHED"} if new else {"CANCELLED"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """End drawing when Blender takes the operator away."""
        self._drawing.close()


_CLASSES = (MESH_OT_seamwire_mark, MESH_OT_seamwire_draw)


def register() -> None:
    """Add the operators."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """End what is being drawn, and remove the operators."""
    close_all()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
