# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that suggests a network of wires."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import bpy

from ..mesh.settings import ALONG_ITEMS, AUTO_FINISH_ITEMS
from .cut import cut_wires
from .report import count, in_edit_mode
from .slide import slide_wires
from .steps import Step, Stepwise

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Sequence

    from seamwire_core import SeamPlan

    from ..mesh.seam_islands import Worst
    from ..mesh.suggestion import Suggestion

_CUT_CRUMB = 0.25
"""What cuts enclose is no island either below this part of the area below which none is planned: where they run side by side, they
cross here and there."""
_ON_TRIAL = 0.9
"""The part of the bound on stretch that is for trials along edges, where the wires are cut into the faces afterwards."""
_ON_TRIAL_STRAIGHT = 0.8
"""The same of straightened wires: they run farther from edges."""
_ROUNDS = 12
"""How often islands that are stretched too much are made smaller."""
_FEW = 2
"""How many islands more are few, in place of the worst one."""
_STRAIGHTENINGS = 3
"""How often seams are straightened, each time but for those around islands that got stretched too much by it."""


class MESH_OT_seamwire_suggest(Stepwise, bpy.types.Operator):
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
        name="Islands",
        description="How many islands of each object there are to be, each a disc",
        default=8,
        min=1,
        soft_max=64,
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
    selected: bpy.props.BoolProperty(
        name="Selected Only", description="Only islands that have selected faces are parted", default=False
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
        if self.limit != "WORST":
            layout.prop(self, "selected")
        if self.limit != "STRETCH":
            layout.prop(self, "unwrap")

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        """Plan, unwrap on trial where that decides, and mark or cut."""
        from ..mesh.unwrap import SavedUvs

        suggestions = self._begin(context)
        if not suggestions:
            return {"CANCELLED"}
        for suggestion in suggestions:
            yield from _planning(suggestions, suggestion.prepare)
        parted = (yield from _part_worst(context, suggestions)) if self.limit == "WORST" else None
        for suggestion in suggestions:
            if suggestion is not parted:
                # Against stretch, detours are of use.
                choose = partial(
                    suggestion.suggest,
                    max_spread=self._spread,
                    islands=self._islands,
                    straightened=self.limit != "STRETCH",
                )
                yield from _planning(suggestions, choose)
        if self.limit != "STRETCH":
            return self._carry_out(context, suggestions)
        saved = [SavedUvs(suggestion.mesh.obj) for suggestion in suggestions]
        result = {"CANCELLED"}
        try:
            most = math.log2(self.stretch)
            if (yield from _limit_stretch(context, suggestions, most)):
                yield from _straighten(context, suggestions, most)
            result = self._carry_out(context, suggestions)
        finally:
            if result == {"CANCELLED"}:
                for uvs in saved:
                    uvs.restore()
        return result

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
        selected = self.selected and self.limit != "WORST"
        found, problem = [], "No face is visible"
        for obj in context.objects_in_mode_unique_data:
            try:
                suggestion = Suggestion(obj, along, self.symmetric, seeds, finish, selected)
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

    def _carry_out(self, context: bpy.types.Context, suggestions: Sequence[Suggestion]) -> set[str]:
        """Write or cut the wires, unwrap, and say what was done."""
        from ..mesh.seam_islands import missing_cuts, stretched_count

        if not any(suggestion.wires for suggestion in suggestions):
            if self.unwrap and self._unwrap_uncut(context):
                return {"FINISHED"}
            limit = "no cut lowers the worst stretch" if self.limit == "WORST" else "within the limit"
            self.report({"INFO"}, f"The islands are discs already, and {limit}: nothing to add")
            return {"CANCELLED"}
        across = [suggestion for suggestion in suggestions if suggestion.along == "SURFACE" and suggestion.wires]
        to_cut = {suggestion.mesh: suggestion.wires for suggestion in across if suggestion.finish == "CUT"}
        crumb = _CUT_CRUMB * min((suggestion.smallest() for suggestion in across), default=0.0)
        if to_cut and cut_wires(self, context, to_cut, crumb=crumb) == {"CANCELLED"}:
            return {"CANCELLED"}
        for suggestion in suggestions:
            if suggestion.mesh not in to_cut:
                suggestion.write()
        slide_wires({suggestion.mesh: suggestion.wires for suggestion in across if suggestion.finish == "SLIDE"})
        missing = [int(cuts) for suggestion in suggestions for cuts in missing_cuts(suggestion.mesh.obj)]
        problem = self._unwrap(context)
        if problem:
            self.report({"WARNING"}, problem)
        wires = sum(len(suggestion.wires) for suggestion in suggestions)
        marked = sum(suggestion.marked for suggestion in suggestions if suggestion.mesh not in to_cut)
        parts = [
            count(wires, "wire"),
            *([f"{count(marked, 'edge')} marked"] if marked else ()),
            count(len(missing), "island"),
        ]
        open_ones = sum(cuts > 0 for cuts in missing)
        if open_ones:
            parts.append(f"{open_ones} of them no {'disc' if open_ones == 1 else 'discs'}")
            parts.append(f"{count(sum(missing), 'more cut')} needed")
        stretched = 0
        if self.limit == "STRETCH":
            most = math.log2(self.stretch)
            stretched = sum(stretched_count(suggestion.mesh.obj, most) for suggestion in suggestions)
        if stretched:
            parts.append(f"{stretched} stretched more than {self.stretch:.2f} times still")
        self.report({"WARNING"} if open_ones or stretched else {"INFO"}, ", ".join(parts))
        return {"FINISHED"}

    def _unwrap_uncut(self, context: bpy.types.Context) -> bool:
        """Unwrap where no seam is needed, and report it; return whether any island got other UVs."""
        from ..core.native import NativeError
        from ..mesh.unwrap import unwrap_changed

        try:
            done = unwrap_changed(context)
        except (ValueError, NativeError) as error:
            self.report({"WARNING"}, str(error))
            return False
        if done.islands:
            self.report({"INFO"}, f"No seam is needed: {count(done.islands, 'island')} unwrapped")
        return done.islands > 0

    def _unwrap(self, context: bpy.types.Context) -> str:
        """Unwrap as asked, or as Blender is set; return what could not be done."""
        from ..core.native import NativeError
        from ..mesh import edit_mesh
        from ..mesh.unwrap import unwrap_changed

        if not self.unwrap and self.limit != "STRETCH":
            edit_mesh.live_unwrap(context)
            return ""
        try:
            unwrap_changed(context, even=self.limit == "STRETCH")
        except (ValueError, NativeError) as error:
            return str(error)
        return ""


def _step(suggestions: Sequence[Suggestion], step: Step) -> Generator[Step, None, None]:
    """Yield one step.

    Raises
    ------
    ValueError
        Where a mesh is another one afterwards.
    """
    yield step
    if not all(suggestion.mesh.alive() for suggestion in suggestions):
        raise ValueError("The mesh was changed meanwhile")


def _planning(
    suggestions: Sequence[Suggestion], work: Callable[..., None], text: str = "Planning seams"
) -> Generator[Step, None, None]:
    """Yield the step of planning: `work` is told `progress`."""
    yield from _step(suggestions, Step(text, lambda progress: work(progress=progress)))


def _stretched(
    context: bpy.types.Context, suggestions: Sequence[Suggestion], most: float, on_trial: float = _ON_TRIAL
) -> dict[Suggestion, list[int]]:
    """Unwrap on trial, and return the islands that are stretched more than so many octaves; leave the UVs.

    `on_trial` is the part of that where the wires are cut into the faces afterwards.

    Raises
    ------
    ValueError
        Where Blender cannot unwrap.
    """
    from ..mesh.unwrap import unwrap_changed

    for suggestion in suggestions:
        suggestion.write()
    try:
        unwrap_changed(context, [suggestion.mesh.obj for suggestion in suggestions], even=True)
        return {
            suggestion: suggestion.stretched(on_trial * most if suggestion.is_cut else most)
            for suggestion in suggestions
        }
    finally:
        for suggestion in suggestions:
            suggestion.take_back()


def _limit_stretch(
    context: bpy.types.Context, suggestions: Sequence[Suggestion], most: float
) -> Generator[Step, None, bool]:
    """Plan islands smaller that are stretched more than so many octaves in a trial, until none is; return whether that was reached.

    Raises
    ------
    ValueError
        Where Blender cannot unwrap, or a mesh is changed meanwhile.
    """
    turn = 0
    while True:
        stretched = _stretched(context, suggestions, most)
        left = sum(map(len, stretched.values()))
        if turn == _ROUNDS or not left:
            return not left
        turn += 1
        for suggestion, islands in stretched.items():
            if islands:
                text = f"{count(left, 'island')} stretched too much, planning again"
                yield from _planning(suggestions, partial(suggestion.narrow, islands), text)


def _straighten(
    context: bpy.types.Context, suggestions: Sequence[Suggestion], most: float
) -> Generator[Step, None, None]:
    """Put direct wires in the place of detours, where no island is stretched more than so many octaves in a trial.

    Raises
    ------
    ValueError
        Where Blender cannot unwrap, or a mesh is changed meanwhile.
    """
    before = {suggestion: suggestion.plan for suggestion in suggestions if suggestion.wires}
    fixed: dict[Suggestion, set[int]] = {suggestion: set() for suggestion in before}
    for _ in range(_STRAIGHTENINGS if before else 0):
        for suggestion, seeds in fixed.items():
            straighten = partial(suggestion.straighten, before[suggestion], seeds)
            yield from _planning(suggestions, straighten, "Straightening seams")
        stretched = _stretched(context, list(fixed), most, _ON_TRIAL_STRAIGHT)
        around = {
            suggestion: suggestion.seeds_around(islands, before[suggestion])
            for suggestion, islands in stretched.items()
            if islands
        }
        # Where all seeds around were fixed, nothing has changed.
        fixed = {
            suggestion: fixed[suggestion] | seeds for suggestion, seeds in around.items() if seeds - fixed[suggestion]
        }
        if not fixed:
            return
    for suggestion in fixed:
        suggestion.use(before[suggestion])


def _part_worst(
    context: bpy.types.Context, suggestions: Sequence[Suggestion]
) -> Generator[Step, None, Suggestion | None]:
    """Let a suggestion be the one that lowers the stretch of the island most that is stretched most; None: none lowers it.

    Of those that lower it at all, only the ones with the fewest islands count, and those with one more, for wires come in pairs
    where the mesh is symmetric. Where none does, or it takes many islands, there is more to choose from in the island. Blender unwraps
    each of them; afterwards the UVs are as they were.

    Raises
    ------
    ValueError
        Where there are no UVs, Blender cannot unwrap, or a mesh is changed meanwhile.
    """
    from ..mesh.seam_islands import island_count
    from ..mesh.suggestion import SEEDS_IN_ISLAND

    stretched = {suggestion: worst for suggestion in suggestions if (worst := suggestion.worst()) is not None}
    if not stretched:
        raise ValueError("No visible face has UVs: unwrap first")
    suggestion = max(stretched, key=lambda one: stretched[one].value)
    worst = stretched[suggestion]
    few = island_count(suggestion.mesh.obj) + _FEW
    lower: list[tuple[float, SeamPlan]] = []
    most_islands = math.inf
    for seeds in (0, *SEEDS_IN_ISLAND):
        yield from _planning(suggestions, partial(suggestion.part, worst, seeds))
        for number, plan in enumerate(suggestion.partings, start=1):
            if plan.island_count > most_islands:
                break
            yield from _step(suggestions, Step(f"Unwrapping on trial, {number} of {len(suggestion.partings)}"))
            stretch = _stretch_within(context, suggestion, plan, worst)
            if stretch < worst.value:
                lower.append((stretch, plan))
                most_islands = min(most_islands, plan.island_count + 1)
        if most_islands <= few + 1:
            break
    if not lower:
        return None
    least, best = min((one for one in lower if one[1].island_count <= most_islands), key=lambda one: one[0])
    # Detours are of use, but not all of them.
    yield from _planning(suggestions, partial(suggestion.straighten, best, set()), "Straightening seams")
    straight = suggestion.plan
    if straight.cost < best.cost:
        yield from _step(suggestions, Step("Unwrapping on trial"))
        if _stretch_within(context, suggestion, straight, worst) <= least:
            best = straight
    suggestion.use(best)
    return suggestion


def _stretch_within(context: bpy.types.Context, suggestion: Suggestion, plan: SeamPlan, worst: Worst) -> float:
    """Unwrap a plan on trial, and return how much the islands are stretched that come of one, at most; the UVs are as before then.

    Raises
    ------
    ValueError
        Where Blender cannot unwrap.
    """
    from ..mesh.unwrap import SavedUvs, unwrap_changed

    suggestion.use(plan)
    suggestion.write()
    saved = SavedUvs(suggestion.mesh.obj)
    try:
        unwrap_changed(context, [suggestion.mesh.obj])
        return suggestion.stretch_within(worst.faces)
    finally:
        saved.restore()
        suggestion.take_back()


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_suggest)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_suggest)
