# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that suggests a network of wires."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING

import bpy

from ..mesh.settings import ALONG_ITEMS, AUTO_FINISH_ITEMS
from .cut import cut_wires
from .report import count, in_edit_mode
from .slide import slide_wires

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..mesh.suggestion import Suggestion

_ROUNDS = 12
"""How often islands that are stretched too much are made smaller."""
_PERIOD = 0.05
"""Seconds between two looks at whether the planning has ended."""


class MESH_OT_seamwire_suggest(bpy.types.Operator):
    """Mark seams that cut the mesh into islands which unwrap well: wires like those drawn, to be moved, dropped and added to. Seams that are there stay"""  # noqa: D400, E501 - a tooltip

    bl_idname = "mesh.seamwire_suggest"
    bl_label = "Suggest Seamwires"
    bl_options = {"REGISTER", "UNDO"}

    limit: bpy.props.EnumProperty(
        name="Limit",
        description="What ends the joining of islands",
        items=(
            ("BEND", "Bend", "How far the faces of an island may turn away from their mean direction"),
            ("ISLANDS", "Islands", "Their number"),
            ("STRETCH", "Stretch", "How much Blender's unwrap stretches an island: unwraps as well, several times"),
            (
                "DISCS",
                "Open Islands",
                "Only what it takes for each island to be a disc: cuts along features and out of sight",
            ),
            (
                "WORST",
                "Worst Island",
                "Only the island that the UV map stretches most is parted again, where that lowers it most, and what is no disc",
            ),
        ),
        default="BEND",
    )
    angle: bpy.props.FloatProperty(
        name="Angle",
        description="An island bends as a sphere's cap of this angle about its middle at most: 90 degrees is half a sphere",
        subtype="ANGLE",
        default=math.radians(80.0),
        min=math.radians(10.0),
        max=math.pi,
    )
    islands: bpy.props.IntProperty(
        name="Islands", description="How many islands there are to be, each a disc", default=8, min=1, soft_max=64
    )
    stretch: bpy.props.FloatProperty(
        name="Stretch",
        description="How many times longer than wide, and how many times larger or smaller than the mean of the mesh, faces become"
        " in the UV map, in the mean of an island",
        default=1.2,
        min=1.02,
        soft_max=2.0,
    )
    along: bpy.props.EnumProperty(
        name="Along",
        description="Where wires run",
        items=(("AUTO", "As the Mesh Is", "Along edges where most faces are quads", 2), *ALONG_ITEMS),
        default="AUTO",
    )
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="What becomes the seam of a wire across the surface",
        items=AUTO_FINISH_ITEMS,
        default="AUTO",
    )
    symmetric: bpy.props.BoolProperty(
        name="Symmetric", description="Wires come in pairs where the mesh is symmetric", default=True
    )
    unwrap: bpy.props.BoolProperty(
        name="Unwrap", description="Unwrap the islands whose seams have changed", default=False
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def draw(self, _context: bpy.types.Context) -> None:
        """Show the settings that count."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "limit")
        amount = {"BEND": "angle", "ISLANDS": "islands", "STRETCH": "stretch"}.get(self.limit)
        if amount:
            layout.prop(self, amount)
        layout.prop(self, "along")
        if self.along != "EDGES":
            layout.prop(self, "finish")
        layout.prop(self, "symmetric")
        if self.limit != "STRETCH":
            layout.prop(self, "unwrap")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Plan and mark at once."""
        suggestions = self._begin(context)
        if not suggestions:
            return {"CANCELLED"}
        try:
            for suggestion in suggestions:
                suggestion.prepare(lambda _: True)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return self._carry_out(context, suggestions)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Plan beside the interface, so that it can be cancelled."""
        if bpy.app.background or context.window is None:
            return self.execute(context)
        self._suggestions = self._begin(context)
        if not self._suggestions:
            return {"CANCELLED"}
        self._cancelled, self._fraction, self._error = False, 0.0, ""
        self._thread = threading.Thread(target=self._prepare, name="seamwire suggestion")
        self._thread.start()
        self._timer = context.window_manager.event_timer_add(_PERIOD, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Wait for the planning, and carry it out."""
        if event.type == "ESC":
            self._cancelled = True
        if self._thread.is_alive():
            context.workspace.status_text_set(f"Planning seams: {100.0 * self._fraction:.0f} %    Esc: Cancel")
            return {"RUNNING_MODAL"}
        self._end(context)
        if self._cancelled:
            return {"CANCELLED"}
        if not self._error and not all(suggestion.mesh.alive() for suggestion in self._suggestions):
            self._error = "The mesh was changed meanwhile"
        if self._error:
            self.report({"ERROR"}, self._error)
            return {"CANCELLED"}
        return self._carry_out(context, self._suggestions)

    def cancel(self, context: bpy.types.Context) -> None:
        """End with Blender, or with the file."""
        self._cancelled = True
        self._thread.join()
        self._end(context)

    def _end(self, context: bpy.types.Context) -> None:
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace is not None:
            context.workspace.status_text_set(None)

    @property
    def _spread(self) -> float:
        """How far the normals of an island may spread: as far as they like where something else has the last word."""
        from ..core.suggestion import spread_of

        return spread_of(self.angle if self.limit in {"BEND", "ISLANDS"} else math.pi)

    @property
    def _islands(self) -> int:
        return self.islands if self.limit == "ISLANDS" else 0

    def _begin(self, context: bpy.types.Context) -> list[Suggestion]:
        """Read the meshes in edit mode; report where that cannot be."""
        from ..core.native import NativeError
        from ..core.suggestion import SEEDS_TO_OPEN, seeds_for
        from ..mesh.suggestion import Suggestion

        seeds = SEEDS_TO_OPEN if self.limit == "DISCS" else (seeds_for(self._spread, self._islands),)
        along, finish = (None if chosen == "AUTO" else chosen for chosen in (self.along, self.finish))
        found, problem = [], "No face is visible"
        for obj in context.objects_in_mode_unique_data:
            try:
                suggestion = Suggestion(obj, along, self.symmetric, seeds, finish)
            except NativeError as error:
                self.report({"ERROR"}, str(error))
                return []
            except ValueError as error:
                problem = str(error)
                continue
            if suggestion.mesh.problem:
                self.report({"WARNING"}, suggestion.mesh.problem)
            if len(suggestion.mesh.arrays.triangles):
                found.append(suggestion)
        if not found:
            self.report({"ERROR"}, problem)
        return found

    def _prepare(self) -> None:
        """Find the wires to choose from, on a thread of its own."""
        from ..core import native

        def progress(fraction: float, done: int) -> bool:
            self._fraction = (done + fraction) / len(self._suggestions)
            return not self._cancelled

        try:
            for i, suggestion in enumerate(self._suggestions):
                suggestion.prepare(lambda fraction, done=i: progress(fraction, done))
        except native.load().Cancelled:
            self._cancelled = True
        except ValueError as error:
            self._error = str(error)

    def _carry_out(self, context: bpy.types.Context, suggestions: Sequence[Suggestion]) -> set[str]:
        """Choose the wires, write or cut them, and unwrap."""
        try:
            parted = _part_worst(context, suggestions) if self.limit == "WORST" else None
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for suggestion in suggestions:
            if suggestion is not parted:
                # Against stretch, detours are of use.
                suggestion.suggest(self._spread, self._islands, straightened=self.limit != "STRETCH")
            suggestion.write()
        left = 0
        if self.limit == "STRETCH":
            try:
                left = self._limit_stretch(context, suggestions)
            except ValueError as error:
                for suggestion in suggestions:
                    suggestion.take_back()
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        if not any(suggestion.wires for suggestion in suggestions):
            limit = "no cut lowers the worst stretch" if self.limit == "WORST" else "within the limit"
            self.report({"INFO"}, f"The islands are discs already, and {limit}: nothing to add")
            return {"CANCELLED"}
        islands = sum(suggestion.plan.island_count for suggestion in suggestions)
        across = [suggestion for suggestion in suggestions if suggestion.along == "SURFACE" and suggestion.wires]
        to_cut = {suggestion.mesh: suggestion.wires for suggestion in across if suggestion.finish == "CUT"}
        if to_cut:
            for suggestion in across:
                if suggestion.mesh in to_cut:
                    suggestion.take_back()
            if cut_wires(self, context, to_cut) == {"CANCELLED"}:
                for suggestion in suggestions:
                    suggestion.take_back()
                return {"CANCELLED"}
        slide_wires({suggestion.mesh: suggestion.wires for suggestion in across if suggestion.finish == "SLIDE"})
        problem = self._unwrap(context)
        if problem:
            self.report({"WARNING"}, problem)
        wires = sum(len(suggestion.wires) for suggestion in suggestions)
        marked = sum(suggestion.marked for suggestion in suggestions)
        parts = [count(wires, "wire"), f"{count(marked, 'edge')} marked", count(islands, "island")]
        open_ones = sum(suggestion.plan.not_discs for suggestion in suggestions)
        if open_ones:
            parts.append(f"{open_ones} of them no {'disc' if open_ones == 1 else 'discs'}")
        if left:
            parts.append(f"{left} stretched more than {self.stretch:.2f} times still")
        self.report({"WARNING"} if open_ones or left else {"INFO"}, ", ".join(parts))
        return {"FINISHED"}

    def _limit_stretch(self, context: bpy.types.Context, suggestions: Sequence[Suggestion]) -> int:
        """Unwrap, and make islands that are stretched too much smaller; return how many still are.

        Raises
        ------
        ValueError
            Where Blender cannot unwrap.
        """
        from ..core.native import NativeError
        from ..mesh.unwrap import unwrap_changed

        most = math.log2(self.stretch)
        for turn in range(_ROUNDS + 1):
            try:
                unwrap_changed(context)
            except NativeError as error:
                raise ValueError(str(error)) from error
            stretched = {suggestion: suggestion.stretched(most) for suggestion in suggestions}
            if turn == _ROUNDS or not any(stretched.values()):
                break
            for suggestion, islands in stretched.items():
                if islands:
                    suggestion.take_back()
                    suggestion.narrow(islands)
                    suggestion.write()
        return sum(map(len, stretched.values()))

    def _unwrap(self, context: bpy.types.Context) -> str:
        """Unwrap as asked, or as Blender is set; return what could not be done."""
        from ..core.native import NativeError
        from ..mesh import edit_mesh
        from ..mesh.unwrap import unwrap_changed

        if not self.unwrap and self.limit != "STRETCH":
            edit_mesh.live_unwrap(context)
            return ""
        try:
            unwrap_changed(context)
        except (ValueError, NativeError) as error:
            return str(error)
        return ""


def _part_worst(context: bpy.types.Context, suggestions: Sequence[Suggestion]) -> Suggestion | None:
    """Let a suggestion be the one that lowers the stretch of the island most that is stretched most; None: none lowers it.

    Of those that lower it at all, only the ones with the fewest islands count, and those with one more, for wires come in pairs
    where the mesh is symmetric. Blender unwraps each of them; afterwards the UVs are as they were.

    Raises
    ------
    ValueError
        Where there are no UVs, or Blender cannot unwrap.
    """
    from ..core.native import NativeError
    from ..mesh.unwrap import taken_back, unwrap_changed

    stretched = {suggestion: worst for suggestion in suggestions if (worst := suggestion.worst()) is not None}
    if not stretched:
        raise ValueError("No visible face has UVs: unwrap first")
    suggestion = max(stretched, key=lambda one: stretched[one].value)
    worst = stretched[suggestion]
    best, least, most_islands = None, worst.value, math.inf
    plans, obj, progress = suggestion.parting(worst), suggestion.mesh.obj, context.window_manager
    progress.progress_begin(0, len(plans))
    try:
        for number, plan in enumerate(plans):
            progress.progress_update(number)
            if plan.island_count > most_islands:
                break
            suggestion.use(plan)
            suggestion.write()
            try:
                with taken_back(obj):
                    unwrap_changed(context, [obj])
                    stretch = suggestion.stretch_within(worst.faces)
            finally:
                suggestion.take_back()
            if stretch < least:
                best, least = plan, stretch
                most_islands = min(most_islands, plan.island_count + 1)
    except NativeError as error:
        raise ValueError(str(error)) from error
    finally:
        progress.progress_end()
    if best is None:
        return None
    suggestion.use(best)
    return suggestion


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_suggest)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_suggest)
