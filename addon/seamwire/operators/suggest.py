# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that suggests a network of wires."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import bpy
from mathutils import Vector

from ..mesh.settings import AUTO_ALONG_ITEMS, AUTO_FINISH_ITEMS
from .cut import cut_wires
from .edit_mesh_operator import EditMeshOperator, Halfway, changing
from .report import running as chains
from .slide import slide_wires
from .steps import Step, Stepwise, end_all
from .steps import running as searches

if TYPE_CHECKING:
    from collections.abc import Generator

    from ..mesh.suggestion import Suggestion
    from ..mesh.suggestions import Suggestions, Wanted
    from ..view.plan_preview import PlanPreview

_LIMITS = ("DISTORTION", "ISLANDS", "DISCS")
"""The limits that the interface offers. The others are deprecated."""
_BLENDERS_FRONT = (0.0, -1.0, 0.0)
"""The direction to the viewer in Blender's front view."""


class MESH_OT_seamwire_suggest(Stepwise, EditMeshOperator, bpy.types.Operator):
    """Mark a few hidden seams so that the mesh unwraps with little stretch. They are wires that you can move or drop. Existing seams stay"""  # noqa: D400, E501 - a tooltip

    bl_idname = "mesh.seamwire_suggest"
    bl_label = "Suggest Seamwires"

    limit: bpy.props.EnumProperty(
        name="Limit",
        description="When to stop adding seams",
        items=(
            ("DISTORTION", "Stretch", "As few seams as possible for the stretch below", 0),
            ("ISLANDS", "Islands", "At least this many islands, within the stretch below", 1),
            ("DISCS", "Open Islands", "Only seams that make each island a disc, with any stretch", 2),
            ("BEND", "Bend", "Deprecated: the same as Stretch", 3),
            ("STRETCH", "Stretch Ratio", "Deprecated: the setting 'stretch' as a stretch in percent", 4),
            ("WORST", "Worst Island", "Deprecated: only the island that the UV map stretches most", 5),
        ),
        default="DISTORTION",
    )
    distortion: bpy.props.FloatProperty(
        name="Stretch",
        description="Average stretch of faces. At 17 %, a face is 1.17 times longer one way and 1.17 times shorter the other way."
        " Low values need more seams",
        subtype="PERCENTAGE",
        default=17.0,
        min=0.5,
        max=1000.0,
        soft_min=5.0,
        soft_max=60.0,
        precision=0,
    )
    islands: bpy.props.IntProperty(
        name="Islands",
        description="Minimum number of islands per object",
        default=8,
        min=1,
        soft_max=64,
    )
    parts: bpy.props.BoolProperty(
        name="Parts",
        description="Make limbs such as hands, feet and heads separate islands, with closed cuts where they are narrow",
        default=False,
    )
    front: bpy.props.EnumProperty(
        name="Hide From",
        description="Side from which seams should be hard to see",
        items=(
            ("VIEW", "View", "From the side that the 3D view shows; without one, from Blender's front", 0),
            ("FRONT", "Front", "From Blender's front, which is -Y", 1),
            ("NONE", "All Sides", "Equally from all sides: in creases and hollows", 2),
        ),
        default="VIEW",
    )
    along: bpy.props.EnumProperty(
        name="Along",
        description="How wires run on the mesh",
        items=AUTO_ALONG_ITEMS,
        default="AUTO",
    )
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="How a wire across the surface becomes a seam",
        items=AUTO_FINISH_ITEMS,
        default="AUTO",
    )
    symmetric: bpy.props.BoolProperty(
        name="Symmetric", description="Add wires in pairs if the mesh is symmetric", default=True
    )
    selected: bpy.props.BoolProperty(
        name="Selected Only", description="Cut only islands with selected faces", default=False
    )
    unwrap: bpy.props.BoolProperty(
        name="Unwrap", description="Unwrap the islands whose seams have changed", default=True
    )
    view_direction: bpy.props.FloatVectorProperty(
        name="View Direction",
        description="Direction to the viewer in world space, for Hide From View. Zero takes the direction of the 3D view",
        subtype="XYZ",
        options={"HIDDEN", "SKIP_SAVE"},
    )
    angle: bpy.props.FloatProperty(
        name="Angle",
        description="Deprecated: has no effect",
        subtype="ANGLE",
        options={"HIDDEN", "SKIP_SAVE"},
    )
    stretch: bpy.props.FloatProperty(
        name="Stretch Ratio",
        description="Deprecated: how many times longer than wide faces may become",
        default=1.2,
        min=1.02,
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether a mesh is in Edit Mode, and neither a chain is being drawn nor another search runs."""
        if not super().poll(context):
            return False
        if chains:
            cls.poll_message_set("A chain is being drawn")
            return False
        if searches:
            cls.poll_message_set("A search for seams is running")
            return False
        return True

    def draw(self, _context: bpy.types.Context) -> None:
        """Show the settings that have an effect."""
        layout = self.layout
        layout.use_property_split = True
        row = layout.row(align=True)
        row.use_property_split = False
        for limit in _LIMITS:
            row.prop_enum(self, "limit", limit)
        if self.limit == "ISLANDS":
            layout.prop(self, "islands")
        if self.limit != "DISCS":
            layout.prop(self, "distortion", slider=True)
            ends = layout.split(factor=0.4)  # under the slider, where the properties' values begin
            ends.label()
            ends = ends.row()
            ends.label(text="Low Stretch")
            ends = ends.row()
            ends.alignment = "RIGHT"
            ends.label(text="Few Seams")
        layout.prop(self, "parts")
        layout.prop(self, "front")
        layout.prop(self, "along")
        if self.along != "EDGES":
            layout.prop(self, "finish")
        layout.prop(self, "symmetric")
        layout.prop(self, "selected")
        layout.prop(self, "unwrap")

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Note the direction of the 3D view, and search while the interface stays responsive."""
        if not any(self.view_direction):
            self.view_direction = _towards_viewer(context)
        return super().invoke(context, event)

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        """Yield the steps of the search, then mark or cut."""
        from ..core.base.native import NativeError
        from ..view.plan_preview import PlanPreview

        self._follow_older_scripts()
        wanted = self._wanted()
        try:
            suggestions = self._read(context, wanted)
        except NativeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        suggestions.notices.tell(self.report)
        if not suggestions:
            raise ValueError(suggestions.problem)
        preview = PlanPreview()
        try:
            for suggestion in suggestions:
                yield from _step(suggestions, Step("Measuring the shape", suggestion.prepare))
                work = partial(suggestion.plan, wanted.request, is_enough=lambda: self.enough)
                yield from _step(suggestions, Step("Planning seams", work, _Look(preview, suggestion)))
            yield from _step(suggestions, Step("Marking seams"))
            suggestions.refresh()
        finally:
            preview.close()
        return self._carry_out(context, suggestions)

    def _follow_older_scripts(self) -> None:
        """Replace deprecated settings by the nearest current ones, and report it."""
        from ..core.seams.suggestion import stretch_of_ratio

        is_set = self.properties.is_property_set
        if self.limit == "BEND":
            self.limit = "DISTORTION"
            self._warn(f"The limit BEND is deprecated: the stretch is limited to {self.distortion:.0f} % instead")
        elif self.limit == "STRETCH":
            self.limit, self.distortion = "DISTORTION", 100.0 * stretch_of_ratio(self.stretch)
            self._warn(
                f"The limit STRETCH is deprecated: use distortion={self.distortion:.1f} instead of stretch={self.stretch:.2f}"
            )
        elif self.limit == "WORST":
            self._warn(
                f"The limit WORST is deprecated: only the worst island is cut, until its stretch is {self.distortion:.0f} %"
            )
        elif is_set("angle") or is_set("stretch"):
            name = "angle" if is_set("angle") else "stretch"
            self._warn(f"The setting {name} is deprecated: the stretch is limited to {self.distortion:.0f} % instead")
            self.properties.property_unset("angle")
            self.properties.property_unset("stretch")

    def _warn(self, text: str) -> None:
        self.report({"WARNING"}, text)

    def _wanted(self) -> Wanted:
        """Return the requirements for the seams. The worst island has the limit of all."""
        from ..mesh.suggestions import Wanted

        limit = "DISTORTION" if self.limit == "WORST" else self.limit
        return Wanted(limit, self.distortion, self.islands, self.parts, self.unwrap)

    def _front(self, context: bpy.types.Context) -> tuple[float, float, float] | None:
        """Return the direction to the viewer whom seams hide from, in world space, or None to hide from all sides."""
        if self.front == "NONE":
            return None
        if self.front == "FRONT":
            return _BLENDERS_FRONT
        return tuple(self.view_direction) if any(self.view_direction) else _towards_viewer(context)

    def _read(self, context: bpy.types.Context, wanted: Wanted) -> Suggestions:
        """Read the meshes in Edit Mode."""
        from ..mesh.suggestion import Options
        from ..mesh.suggestions import Suggestions, objects_to_cut

        along, finish = (None if chosen == "AUTO" else chosen for chosen in (self.along, self.finish))
        options = Options(along, finish, self.symmetric, self._front(context))
        objects = objects_to_cut(context.objects_in_mode_unique_data, self.limit == "WORST", self.selected)
        return Suggestions(objects, options, wanted)

    def _carry_out(self, context: bpy.types.Context, suggestions: Suggestions) -> set[str]:
        """Write or cut the wires, unwrap, and report."""
        if not suggestions.has_wires:
            return self._unwrap_uncut(context, suggestions)
        try:
            return self._change(context, suggestions)
        except Halfway as error:
            return self.stopped_halfway(error)

    def _change(self, context: bpy.types.Context, suggestions: Suggestions) -> set[str]:
        to_cut = {suggestion.mesh: suggestion.wires for suggestion in suggestions.finished_by("CUT")}
        crumb = suggestions.crumb
        if to_cut and cut_wires(self, context, to_cut, crumb=crumb, live_unwrap=False) == {"CANCELLED"}:
            return {"CANCELLED"}
        with changing():
            suggestions.write()
            slide_wires({suggestion.mesh: suggestion.wires for suggestion in suggestions.finished_by("SLIDE")})
            self._unwrap(context, suggestions)
            self._report_outcome(suggestions)
        return {"FINISHED"}

    def _report_outcome(self, suggestions: Suggestions) -> None:
        outcome = suggestions.outcome()
        self.report({"INFO"} if outcome.is_good else {"WARNING"}, outcome.text)

    def _unwrap_uncut(self, context: bpy.types.Context, suggestions: Suggestions) -> set[str]:
        """Unwrap although no seam is needed, report it, and return the operator's result."""
        unwrapped = self._unwrap(context, suggestions) if self.unwrap else 0
        self._report_outcome(suggestions)
        return {"FINISHED"} if unwrapped else {"CANCELLED"}

    def _unwrap(self, context: bpy.types.Context, suggestions: Suggestions) -> int:
        """Unwrap, and report what cannot be unwrapped. Return the number of unwrapped islands."""
        from ..core.base.native import NativeError

        try:
            return suggestions.unwrap(context)
        except (ValueError, NativeError) as error:
            self.report({"WARNING"}, str(error))
            return 0


class _Look:
    """Shows the best plan so far in the 3D views and in the status bar.

    Parameters
    ----------
    preview
        Draws the plan.
    suggestion
        Plans in another thread.
    """

    def __init__(self, preview: PlanPreview, suggestion: Suggestion) -> None:
        self._preview = preview
        self._suggestion = suggestion
        self._seen: object = None

    def __call__(self) -> str:
        """Show the plan if it is new, and return its stretch and length."""
        from ..core.seams.suggestion import stretch_of

        suggestion = self._suggestion
        plan = suggestion.best_so_far
        if plan is None or not suggestion.mesh.alive():
            return ""
        if plan is not self._seen:
            self._seen = plan
            curves = [wire.points for wire in plan.wires]
            self._preview.show(suggestion.mesh.obj, suggestion.mesh.arrays, curves, suggestion.edges_of(plan))
        self._preview.poll()
        stretch = f"stretch {100.0 * stretch_of(float(plan.energy)):.0f} %"
        return f"{stretch}, seams {_in_units(suggestion.length_of(plan))}"


def _in_units(length: float) -> str:
    """Return a length in the scene's units."""
    units = bpy.context.scene.unit_settings
    if units.system == "NONE":
        return f"{length:.3g}"
    return bpy.utils.units.to_string(units.system, "LENGTH", length * units.scale_length, precision=3)


def _step(suggestions: Suggestions, step: Step) -> Generator[Step, None, None]:
    """Yield one step.

    Raises
    ------
    ValueError
        If a mesh changed during the step.
    """
    yield step
    if not suggestions.are_alive:
        raise ValueError("The mesh changed during the search")


def _towards_viewer(context: bpy.types.Context) -> tuple[float, float, float]:
    """Return the direction to the viewer in world space: from the 3D view if there is one, otherwise Blender's front."""
    view = context.region_data
    if not isinstance(view, bpy.types.RegionView3D) and context.screen is not None:
        spaces = (area.spaces.active for area in context.screen.areas if area.type == "VIEW_3D")
        view = next((space.region_3d for space in spaces), None)
    if bpy.app.background or not isinstance(view, bpy.types.RegionView3D):
        return _BLENDERS_FRONT
    return tuple(view.view_rotation @ Vector((0.0, 0.0, 1.0)))


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_suggest)


def unregister() -> None:
    """End the search that runs, and remove the operator."""
    end_all()
    bpy.utils.unregister_class(MESH_OT_seamwire_suggest)
