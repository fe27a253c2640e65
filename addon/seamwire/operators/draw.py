# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that draws a chain, or does what else begins with a button or a key of the tool."""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING

import bpy

from ..core.base.native import NativeError
from ..mesh.settings import ALONG_ITEMS, notices, settings
from ..words.keys import Action, Key
from .edit_mesh_operator import NeedsEditMode
from .navigation import takes
from .report import running

if TYPE_CHECKING:
    from .modal import Chain

_FIRST = (
    ("NONE", "Nothing", "The chain begins with the next click", 0),
    ("CLICK", "Click", "Place the first seed, or take hold of a seed or a wire", 1),
    ("LOOP", "Loop", "Take the loop through the edge", 2),
    ("GUIDE", "Guide Stroke", "Draw a stroke that wires follow", 3),
    ("AVOID", "Avoid Stroke", "Draw a stroke that wires avoid", 4),
    ("REMOVE", "Remove", "Remove the wire or the stroke; where there is none, Blender has the key", 5),
    ("NEXT", "Next Candidate", "Let the wire take its other path; where there is none, Blender has the key", 6),
    ("PEEK", "Show Loop", "Show the loop that a click would take, while the key is held", 7),
    ("BEND", "Bend Closed Cut", "Bend the closed cut that was taken last; along edges, Blender has the key", 8),
)
_FOR_BLENDER = {"REMOVE", "NEXT", "PEEK", "BEND"}
"""Where these find nothing to do, the key has Blender's meaning."""


class MESH_OT_seamwire_draw(NeedsEditMode, bpy.types.Operator):
    """Draw seams with live wires that follow the shape of the mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_draw"
    bl_label = "Draw Seamwires"
    # A chain makes its own step of undo, named for what it did.
    bl_options = set()

    along: bpy.props.EnumProperty(
        name="Along",
        description="Where wires run at first; where not given, as the tool is set",
        items=ALONG_ITEMS,
        options={"SKIP_SAVE"},
    )
    first: bpy.props.EnumProperty(
        name="First", description="What is done at once, under the cursor", items=_FIRST, options={"SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode, and no chain being drawn."""
        if not super().poll(context):
            return False
        if running:
            cls.poll_message_set("A chain is being drawn already")
            return False
        return True

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin."""
        from ..mesh.edit_mesh import NothingVisibleError
        from .modal import Chain

        if self.first != "NONE" and takes(Key.of(event), context):
            return {"PASS_THROUGH"}
        if not any(area.type == "VIEW_3D" for area in context.window.screen.areas):
            self.report({"ERROR"}, "Seams are drawn in a 3D view, and this window shows none")
            return {"CANCELLED"}
        try:
            if self.properties.is_property_set("along"):
                settings(context).along = self.along
            self._chain = Chain(context)
        except (ValueError, NativeError) as error:
            if self.first in _FOR_BLENDER:
                return {"PASS_THROUGH"}
            # Blender opens a popup for an error, and the popup takes the next key.
            nothing = isinstance(error, NothingVisibleError) and self.first != "NONE"
            self.report({"WARNING"} if nothing else {"ERROR"}, str(error))
            return {"CANCELLED"}
        # Blender frees an operator whose invoke raised, and would call its modal method all the same.
        try:
            if self.first != "PEEK":
                self._tell_problem(self._chain)
            done = self._begin(event)
            if not done and self.first in _FOR_BLENDER:
                self._chain.drop()
                return {"PASS_THROUGH"}
            if self._chain.idle and self.first != "NONE":
                return self._finish(context)
        except Exception as error:
            return self._failed(error)
        self._chain.show()
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"} if self.first != "PEEK" else {"RUNNING_MODAL", "PASS_THROUGH"}

    def _begin(self, event: bpy.types.Event) -> bool:
        """Do what comes first; return whether there was something to do it to."""
        if self.first == "NONE":
            return True
        return self._chain.peek(event) if self.first == "PEEK" else self._chain.begin(Action[self.first], event)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Pass an event on to the chain, and end it where that is due."""
        chain = self._chain
        if not chain.open:
            return {"CANCELLED", "PASS_THROUGH"}
        try:
            trouble = chain.trouble(context)
            if trouble:
                self.report({"WARNING"}, f"{trouble}: the chain has ended")
                return self._finish(context) | {"PASS_THROUGH"}
            passes = chain.handle(context, event)
            if chain.idle:
                result = self._finish(context)
                return result | {"PASS_THROUGH"} if passes else result
            return {"PASS_THROUGH"} if passes else {"RUNNING_MODAL"}
        except Exception as error:
            return self._failed(error)

    def _tell_problem(self, chain: Chain) -> None:
        """Say once what there is to say of the wires that came with the mesh."""
        while notices:
            self.report({"WARNING"}, notices.pop(0))
        mesh = chain.view.mesh
        if mesh.problem:
            self.report({"WARNING"}, mesh.problem)
            mesh.problem = ""
        if mesh.obj.modifiers:
            chain.message = "Modifiers are ignored"

    def _finish(self, context: bpy.types.Context) -> set[str]:
        try:
            self._chain.finish(context)
        except ValueError as error:
            self._chain.drop()
            self.report({"WARNING"}, f"{error}: the wires of this chain are lost")
            return {"CANCELLED"}
        for told in self._chain.told:
            self.report({"INFO"}, told)
        for error in self._chain.errors:
            self.report({"ERROR"}, error)
        return {"FINISHED"} if self._chain.told else {"CANCELLED"}

    def _failed(self, error: Exception) -> set[str]:
        traceback.print_exc()
        previews = self._chain.previews
        try:
            self._chain.drop()
        except Exception:
            traceback.print_exc()
            self._chain.close()
        if previews:
            return {"CANCELLED", "PASS_THROUGH"}
        self.report({"ERROR"}, f"Drawing seams ended on an error, the mesh is as it was before this chain: {error}")
        return {"CANCELLED"}

    def cancel(self, context: bpy.types.Context) -> None:
        """End the chain when Blender takes the operator away; its wires are kept where the mesh is still there."""
        chain = self._chain
        if not chain.open:
            return
        try:
            chain.finish(context, undo_step=False)
        except Exception:
            traceback.print_exc()
            chain.close()


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_draw)


def unregister() -> None:
    """End what is being drawn, leaving the meshes as they were before it, and remove the operator."""
    for chain in tuple(running):
        chain.drop()
    bpy.utils.unregister_class(MESH_OT_seamwire_draw)
