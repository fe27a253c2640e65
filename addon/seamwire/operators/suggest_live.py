# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggest Seamwires in a window: the mouse wheel turns the parts, clicks change borders, slits and the map follow when the hand rests."""

from __future__ import annotations

import math
import time
from collections import deque
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import bpy

from ..core.base import native
from ..core.seams.seam_plan import PartEdits, edges_of, mean_stretch, turned, turned_limit
from ..view.plan_preview import Curves, PlanPreview, Pointed
from ..view.viewport import place_of
from ..words.search_report import LIVE_HINTS, parts_text
from .keymaps import on_gizmo
from .steps import Step

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ..mesh.seam_search import SeamSearch, Suggestion
    from ..view.viewport import Place
    from .steps import Progress

    Search = Callable[[Progress], tuple[float, dict[str, PartEdits]]]
    """Finds other parts, and returns their amount and the edits. Any thread may call it."""

_REST = 0.4
"""Seconds without a change until slits are planned."""
_INSTANT = 0.1
"""Seconds that the interface waits for new parts. Parts that take longer are found in a separate step."""
_LOOKING = 0.2
"""Seconds that a notch of the wheel may look for another number of parts."""
_TICK = 0.02
"""Seconds between two looks at whether the hand rests."""
_SQUARES = 28
"""Squares of the checker pattern along the side of a square that is as large as the surface."""
_CONFIRM = frozenset({"RET", "NUMPAD_ENTER", "SPACE"})
_NOTCHES = {"WHEELUPMOUSE": 1, "WHEELDOWNMOUSE": -1, "PAGE_UP": 1, "PAGE_DOWN": -1, "PLUS": 1, "EQUAL": 1, "MINUS": -1}
"""How many notches each event turns."""
_PRESSES = frozenset({"PRESS", "DOUBLE_CLICK"})
_TAKEN = frozenset({"RUNNING_MODAL"})


class LiveParts:
    """The parts of meshes while an artist changes them. Once it `is_enough`, planning stops, and the best plan so far is taken."""

    def __init__(
        self,
        window: bpy.types.Window,
        search: SeamSearch,
        preview: PlanPreview,
        amount: float,
        stretch: float,
        is_enough: Callable[[], bool],
    ) -> None:
        self._window = window
        self._search = search
        self._preview = preview
        self._is_enough = is_enough
        self.amount = amount  # of parts, from 0 to 1
        self.stretch = stretch  # the limit, in percent
        self.edits: dict[str, PartEdits] = {}  # the changes by clicks, by the name of the object
        self.is_kept = False  # whether the artist has confirmed the parts
        self._dropped: dict[str, list[NDArray[np.int32]]] = {}
        self._counts: dict[float, int] = {}
        self._searches: deque[Search] = deque()
        self._found: tuple[float, dict[str, PartEdits]] | None = None
        self._version = self._worked_on = 0
        self._planned = -1
        self._rests_at = 0.0
        self._seen: dict[Suggestion, tuple[object, object]] = {}
        self._square = _square_size(search)
        self._cancelled = native.load().Cancelled
        self._change()

    # The step

    def step(self) -> Step:
        """Return the step that finds the parts that the artist has asked for, or waits and plans when the hand rests."""
        if self._found is not None:
            self._searches.popleft()
            found, self._found = self._found, None
            self._change_to(*found)
        self._worked_on = self._version
        if self._searches:
            return Step("Finding parts", self._find, hand=self)
        return Step("Planning seams", self._plan, self._look, self)

    @property
    def is_done(self) -> bool:
        """Whether the parts are confirmed, and seams planned in them."""
        return self.is_kept and self.is_planned and not self._searches

    @property
    def is_planned(self) -> bool:
        """Whether seams are planned in the parts that are shown."""
        return self._planned == self._version

    @property
    def is_over(self) -> bool:
        """Whether the step has nothing to wait for."""
        is_outdated = self._worked_on != self._version or bool(self._searches)
        return self.is_kept or is_outdated or not self._search.are_alive

    @property
    def title(self) -> str:
        """The amount and the number of parts, and the limit of the stretch."""
        return parts_text(self.amount, self._search.part_count, self.stretch)

    @property
    def hints(self) -> Sequence[str]:
        """The artist's choices."""
        return () if self.is_kept else LIVE_HINTS

    def _plan(self, progress: Progress) -> None:
        """Wait until the hand rests, then plan. Give up as soon as the parts have changed."""
        version = self._version

        def goes_on(fraction: float) -> bool:
            return progress(fraction) and self._version == version and not self._searches

        while time.monotonic() < self._rests_at and not self.is_kept:
            if not goes_on(0.0):
                return
            time.sleep(_TICK)
        with suppress(self._cancelled):
            self._search.plan(goes_on, is_enough=self._is_enough)
            self._planned = version
            self._search.lay_out(lambda _: goes_on(1.0) and not self.is_kept)

    def _look(self) -> str:
        """Show plans that are new, and return the stretch and the length of their seams."""
        if not self._search.are_alive:
            return ""
        self._preview.poll()
        plans = {each: plan for each in self._search if (plan := each.best_so_far) is not None}
        for suggestion, plan in plans.items():
            seen = self._seen.get(suggestion, (None, None))
            if seen[0] is not plan or seen[1] is not suggestion.layout:
                self._seen[suggestion] = plan, suggestion.layout
                self._show(suggestion)
        if not plans:
            return ""
        energy = mean_stretch([float(plan.energy) for plan in plans.values()], [each.area for each in plans])
        length = sum(each.length_of(plan) for each, plan in plans.items())
        return f"stretch {100.0 * energy:.0f} %, seams {_in_units(length)}"

    # The artist's hand

    def take(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take an event of the wheel, the mouse or the keys, as `Hand.take`."""
        if self.is_kept or not self._search.are_alive:
            return set()
        place = place_of(self._window, event)
        if event.type == "MOUSEMOVE":
            self._preview.point(None if place is None else self._preview.at(place))
            return {"PASS_THROUGH"}
        if event.alt or event.oskey or event.value not in _PRESSES:
            return set()
        if event.shift and event.type not in {"PLUS", "EQUAL"}:
            return set()
        is_wheel = event.type.startswith("WHEEL")
        if event.type in _NOTCHES and (place is not None or not is_wheel):
            (self._turn_stretch if event.ctrl else self._turn)(_NOTCHES[event.type])
            return set(_TAKEN)
        if event.ctrl:
            return set()
        if event.type in _CONFIRM:
            self._keep()
            return set(_TAKEN)
        if event.type == "LEFTMOUSE" and place is not None and not on_gizmo(place, context.preferences):
            self._click(place)
            return set(_TAKEN)
        return set()

    def _keep(self) -> None:
        """Keep the parts. The map is no longer shown."""
        self.is_kept = True
        self._preview.point(None)
        for suggestion in self._search:
            self._show(suggestion)

    def _turn_stretch(self, notches: int) -> None:
        found = turned_limit(self.stretch, notches)
        if found != self.stretch:
            self.stretch = found
            self._search.limit_stretch(found)
            self._change()

    def _turn(self, notches: int) -> None:
        def search(progress: Progress) -> tuple[float, dict[str, PartEdits]]:
            until = time.monotonic() + _LOOKING
            found = turned(
                self.amount, notches, lambda amount: self._count(amount, progress), lambda: time.monotonic() < until
            )
            self._search.count(found, self.edits, progress)  # so that its parts are kept
            return found, self.edits

        self._begin(search)

    def _count(self, amount: float, progress: Progress) -> int:
        if amount not in self._counts:
            self._counts[amount] = self._search.count(amount, self.edits, progress)
        return self._counts[amount]

    def _click(self, place: Place) -> None:
        at = None if self._searches else self._preview.at(place)
        if at is None:
            return
        name = next(each.name for each in self._search if each.mesh.obj == at.obj)
        edits = {**self.edits, name: self._edited(self.edits.get(name, PartEdits()), at)}

        def search(progress: Progress) -> tuple[float, dict[str, PartEdits]]:
            count = self._search.count(self.amount, edits, progress)
            is_uncut = at.border is None and count == self._search.part_count
            return self.amount, self.edits if is_uncut else edits

        self._begin(search)
        self._preview.point(self._preview.at(place))

    def _begin(self, search: Search) -> None:
        """Change the parts as a search says: at once if it is short, otherwise in a step."""
        until = time.monotonic() + _INSTANT
        try:
            found = None if self._searches else search(lambda _: time.monotonic() < until)
        except self._cancelled:
            found = None
        if found is None:
            self._searches.append(search)
        else:
            self._change_to(*found)

    def _find(self, progress: Progress) -> None:
        with suppress(self._cancelled):
            self._found = self._searches[0](progress)

    def _change_to(self, amount: float, edits: dict[str, PartEdits]) -> None:
        if edits != self.edits:
            self._counts.clear()
        elif amount == self.amount:
            return
        self.amount, self.edits = amount, edits
        self._change()

    def _edited(self, edits: PartEdits, at: Pointed) -> PartEdits:
        suggestion = next(each for each in self._search if each.mesh.obj == at.obj)
        if at.border is None:
            return edits.part(int(suggestion.mesh.arrays.polygons[at.triangle]))
        if at.border < len(suggestion.borders):
            chain = suggestion.borders[at.border]
            dropped = self._dropped.setdefault(suggestion.name, [])
            if all(edges_of(known) != edges_of(chain) for known in dropped):
                dropped.append(chain)
            return edits.drop(edges_of(chain))
        return edits.keep(edges_of(self._dim(suggestion)[at.border - len(suggestion.borders)]))

    def _change(self) -> None:
        """Choose the parts anew, and show them."""
        self._version += 1
        self._rests_at = time.monotonic() + _REST
        self._search.choose(self.amount, self.edits)
        for suggestion in self._search:
            self._show(suggestion)

    # The picture

    def _dim(self, suggestion: Suggestion) -> list[NDArray[np.int32]]:
        """Return the borders that the artist has dropped."""
        dropped = self.edits.get(suggestion.name, PartEdits()).dropped
        return [chain for chain in self._dropped.get(suggestion.name, ()) if edges_of(chain) <= dropped]

    def _show(self, suggestion: Suggestion) -> None:
        plan, points = suggestion.best_so_far, suggestion.mesh.arrays.in_object
        curves = Curves(
            [points[chain] for chain in suggestion.borders], [points[chain] for chain in self._dim(suggestion)]
        )
        cuts = suggestion.seams
        if plan is not None:
            curves = replace(curves, slits=[wire.points for wire in plan.wires])
            cuts = suggestion.edges_of(plan)
        squares = None
        if suggestion.layout is not None and not self.is_kept:
            squares = suggestion.layout * (_scale_of(suggestion.mesh.obj) / self._square)
        self._preview.show(suggestion.mesh.obj, suggestion.mesh.arrays, curves, cuts, squares)


def _scale_of(obj: bpy.types.Object) -> float:
    """Return the mean scale of an object in the scene."""
    return abs(obj.matrix_world.to_3x3().determinant()) ** (1.0 / 3.0)


def _square_size(search: SeamSearch) -> float:
    """Return the size of the squares on all objects, in the scene's units."""
    area = sum(each.area * _scale_of(each.mesh.obj) ** 2 for each in search)
    return math.sqrt(area) / _SQUARES if area > 0.0 else 1.0


def _in_units(length: float) -> str:
    units = bpy.context.scene.unit_settings
    if units.system == "NONE":
        return f"{length:.3g}"
    return bpy.utils.units.to_string(units.system, "LENGTH", length * units.scale_length, precision=3)
