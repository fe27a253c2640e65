# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that suggests a network of wires."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import bpy
from bpy.app.handlers import persistent
from mathutils import Vector

from ..mesh.registration import classes, handler, together
from ..operators.edit_mesh_operator import changing
from ..operators.seam_operators import cut_wires
from ..operators.steps import Step, Stepwise, end_all
from ..terms.choices import ALONG, AUTO_ALONG, AUTO_FINISH, FINISHES, PARTS_BY, items

if TYPE_CHECKING:
    from collections.abc import Generator

    from ..core.seams.seam_plan import PartChoice
    from ..mesh.seam_search import SeamSearch

kept_choices: dict[tuple[tuple[str, int, int], ...], tuple[list[bytes], PartChoice]] = {}
"""The last choice that was kept for meshes of the open file, and the seams that these meshes had before it."""
_BLENDERS_FRONT = (0.0, -1.0, 0.0)
"""The direction to the viewer in Blender's front view."""
_BY_MESH = {"SKIP_SAVE"}
"""Blender does not carry these options over to the next mesh."""


class MESH_OT_seamwire_suggest(Stepwise, bpy.types.Operator):
    """Mark a few hidden seams so that the mesh unwraps with little stretch. They are wires that you can move or drop. Existing seams stay"""  # noqa: D400, E501 - a tooltip

    bl_idname = "mesh.seamwire_suggest"
    bl_label = "Suggest Seamwires"

    parts: bpy.props.FloatProperty(
        name="Parts",
        description="How many parts become separate islands. At 0 % all faces that are connected stay together,"
        " at 100 % there are borders on all sharp edges",
        subtype="PERCENTAGE",
        default=50.0,
        min=0.0,
        max=100.0,
        precision=0,
        options=_BY_MESH,
    )
    parts_by: bpy.props.EnumProperty(
        name="Parts by",
        description="What separates parts",
        items=items(PARTS_BY),
        default="AUTO",
        options=_BY_MESH,
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
        options=_BY_MESH,
    )
    islands: bpy.props.IntProperty(
        name="Islands",
        description="Minimum number of islands per object. Large islands are cut into halves for it",
        default=1,
        min=1,
        soft_max=64,
        options=_BY_MESH,
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
        name="Along", description="How wires run on the mesh", items=items(ALONG, AUTO_ALONG), default="AUTO"
    )
    finish: bpy.props.EnumProperty(
        name="Finish",
        description="How a wire across the surface becomes a seam",
        items=items(FINISHES, AUTO_FINISH),
        default="AUTO",
    )
    symmetric: bpy.props.BoolProperty(
        name="Symmetric",
        description="Let wires follow the mirror plane or come in pairs if the mesh is symmetric",
        default=True,
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
    edits: bpy.props.StringProperty(
        name="Edits",
        description="The borders that were kept or dropped by clicks, and the parts that were cut",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        shown = (
            "parts",
            "parts_by",
            "distortion",
            "islands",
            "front",
            "along",
            "finish",
            "symmetric",
            "selected",
            "unwrap",
        )
        for name in shown:
            if name != "finish" or self.along != "EDGES":
                self.layout.prop(self, name, slider=name in {"parts", "distortion"})

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Note the direction of the 3D view, and let the artist choose the parts while the interface stays responsive."""
        if not any(self.view_direction):
            self.view_direction = _towards_viewer(context)
        return super().invoke(context, event)

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        search = self._read(context)
        search.notices.tell(self.report)
        if not search:
            raise ValueError(search.problem)
        choice = self._first_choice(search) if self.is_beside else self._choice()
        yield from _step(search, Step("Finding parts", partial(search.choose, choice)))
        if self.is_beside:
            yield from self._show_parts(search, choice)
        else:
            yield from _step(search, Step("Planning seams", search.plan))
        search.refresh()
        return self._change(context, search)

    def _show_parts(self, search: SeamSearch, choice: PartChoice) -> Generator[Step, None, None]:
        """Yield steps until the artist has confirmed the parts that the views show, and seams are planned in them."""
        from ..core.seams.seam_plan import edits_text
        from ..view.plan_preview import PlanPreview
        from .live_parts import LiveParts

        with closing(PlanPreview()) as preview:
            live = LiveParts(search, preview, choice, lambda: self.enough)
            while not live.is_done:
                find, plan = ("Finding parts", live.find), ("Planning seams", live.plan, live.look)
                yield from _step(search, Step(*(find if live.begin() else plan), hand=live))
            choice = live.choice
            self.parts, self.parts_by, self.distortion = 100.0 * choice.amount, choice.by, choice.stretch
            self.islands, self.edits = choice.islands, edits_text(choice.edits)
            kept_choices[_identity(search)] = _seams_of(search), choice
            yield from _step(search, Step("Marking seams"))

    def _first_choice(self, search: SeamSearch) -> PartChoice:
        """Return the choice that is shown first: the one that was kept for these meshes, or the options."""
        is_given = any(map(self.properties.is_property_set, ("parts", "parts_by", "distortion", "islands", "edits")))
        if not is_given and _identity(search) in kept_choices:
            seams, choice = kept_choices[_identity(search)]
            # Clicks belong to the borders that were shown. Other seams make other borders.
            return choice if seams == _seams_of(search) else replace(choice, edits={})
        return self._choice()

    def _choice(self) -> PartChoice:
        from ..core.seams.seam_plan import PartChoice, edits_of_text

        return PartChoice(0.01 * self.parts, self.distortion, self.islands, edits_of_text(self.edits), self.parts_by)

    def _read(self, context: bpy.types.Context) -> SeamSearch:
        from ..mesh.seam_search import SeamSearch, SearchOptions

        # The direction to the viewer whom seams hide from, in world space, or None to hide from all sides.
        front = None if self.front == "NONE" else _BLENDERS_FRONT
        if self.front == "VIEW":
            front = tuple(self.view_direction) if any(self.view_direction) else _towards_viewer(context)
        along, finish = (None if chosen == "AUTO" else chosen for chosen in (self.along, self.finish))
        options = SearchOptions(along, finish, self.symmetric, front, self.distortion, self.islands, self.unwrap)
        return SeamSearch(context.objects_in_mode_unique_data, options, self.selected)

    def _change(self, context: bpy.types.Context, search: SeamSearch) -> set[str]:
        """Write or cut the wires, unwrap, and report. It unwraps even if no seam is needed."""
        if not search.has_wires:
            return {"FINISHED"} if self._end(context, search, self.unwrap) else {"CANCELLED"}
        if search.to_cut:
            first = partial(search.write, before_cuts=True)
            done = cut_wires(self, context, search.to_cut, crumb=search.crumb, live_unwrap=False, first=first)
            if done == {"CANCELLED"}:
                return done
        with changing():
            search.write(before_cuts=False)
            self._end(context, search)
        return {"FINISHED"}

    def _end(self, context: bpy.types.Context, search: SeamSearch, unwraps: bool = True) -> int:
        """Unwrap, and report the outcome. Return the number of unwrapped islands."""
        from ..core.base.native import NativeError

        unwrapped = 0
        try:
            unwrapped = search.unwrap(context) if unwraps else 0
        except (ValueError, NativeError) as error:
            self.report({"WARNING"}, str(error))
        outcome = search.outcome()
        self.report({"INFO"} if outcome.is_good else {"WARNING"}, outcome.text)
        return unwrapped


def _identity(search: SeamSearch) -> tuple[tuple[str, int, int], ...]:
    """Return what tells meshes from others in the file: names and sizes. Undo replaces the meshes themselves."""
    meshes = (each.mesh for each in search)
    return tuple((mesh.obj.data.name_full, len(mesh.arrays.points), len(mesh.arrays.triangles)) for mesh in meshes)


def _seams_of(search: SeamSearch) -> list[bytes]:
    return [each.mesh.arrays.seams.tobytes() for each in search]


def _step(search: SeamSearch, step: Step) -> Generator[Step, None, None]:
    """Yield one step. Raise ValueError if a mesh changed during the step."""
    yield step
    if not search.are_alive:
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


@persistent
def _forget_choices(*_: object) -> None:
    kept_choices.clear()


register, unregister = together(
    *classes(MESH_OT_seamwire_suggest), handler("load_pre", _forget_choices), (lambda: None, end_all)
)
