# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggest Seamwires in a window: the mouse wheel turns the parts, clicks change borders, slits and the map follow when the hand rests."""

from __future__ import annotations

import math
import time
from collections import Counter, deque
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import bpy

from ..core.base import native
from ..core.seams.seam_plan import PartChoice, PartEdits, edges_of, mean_stretch, parted_by_next, turned, turned_limit
from ..tool import keymaps
from ..view.plan_preview import Curves, PlanPreview, Pointed
from ..view.viewport import place_of
from ..words.hints import FoundMap, rows_of_parts
from ..words.keys import MODIFIER_KEYS, Action
from ..words.reports import parts_text

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ..core.islands.uv_maps import SquareUse
    from ..mesh.seam_search import SeamSearch, Suggestion
    from ..view.viewport import Place

    Progress = Callable[[float], bool]
    Search = Callable[[Progress], PartChoice]
    """Finds other parts, and returns the choice that they belong to. Any thread may call it."""
    Asked = tuple[Search, int | None]
    """A search, and the place of its choice among those that were made, or None for a new choice."""

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
_SIGNS = frozenset({"PLUS", "EQUAL", "MINUS"})
_PRESSES = frozenset({"PRESS", "DOUBLE_CLICK"})
_TAKEN = frozenset({"RUNNING_MODAL"})


class LiveParts:
    """The parts of meshes while an artist changes them. Once it `is_enough`, planning stops, and the best plan so far is taken."""

    def __init__(
        self, search: SeamSearch, preview: PlanPreview, choice: PartChoice, is_enough: Callable[[], bool]
    ) -> None:
        self._search, self._preview, self._is_enough = search, preview, is_enough
        self._choices = [choice]  # each that was made, also those that were taken back
        self._at = 0  # the one that is shown
        self.is_kept = False  # whether the artist has confirmed the parts
        self._said = ""
        self._told: set[str] = set()
        self._dropped: dict[str, list[NDArray[np.int32]]] = {}
        self._counts: dict[float, int] = {}
        self._turns: dict[tuple[float, int], float] = {}  # where notches led from amounts, and back
        self._past: Counter[str] = Counter()  # the notches past an end, by what they turn
        self._searches: deque[Asked] = deque()
        self._found: tuple[Asked, PartChoice] | None = None
        self._version = self._worked_on = 0
        self._planned = -1
        self._rests_at = 0.0
        self._seen: dict[Suggestion, object] = {}
        self._found_map: FoundMap | None = None
        self._used: tuple[int, SquareUse] | None = None  # with the version of the parts
        self._square = _square_size(search)
        self._cancelled = native.load().Cancelled
        self._change()

    # The step

    def begin(self) -> bool:
        """Take the parts that were found, and return whether the artist has asked for others: `find` is next, otherwise `plan`."""
        found, self._found = self._found, None
        if found is not None and self._searches and self._searches[0] is found[0]:
            self._searches.popleft()
            self._change_to(found[1], found[0][1])
        self._worked_on = self._version
        return bool(self._searches)

    @property
    def choice(self) -> PartChoice:
        return self._choices[self._at]

    @property
    def is_done(self) -> bool:
        return self.is_kept and self.is_planned and not self._searches

    @property
    def is_planned(self) -> bool:
        return self._planned == self._version

    @property
    def is_over(self) -> bool:
        """Whether the step ends when its work has ended. Otherwise it waits for the artist."""
        is_outdated = self._worked_on != self._version or bool(self._searches)
        return self.is_kept or is_outdated or not self._search.are_alive

    @property
    def title(self) -> str:
        """For the status bar: the answer to the last key, the amount and the number of parts, and the limit of the stretch."""
        text = parts_text(self.choice.by, self.choice.amount, self._search.part_count, self.choice.stretch)
        return f"{self._said}    {text}" if self._said else text

    @property
    def hints(self) -> Sequence[str]:
        """The artist's choices, without those that the corner of the view has."""
        return () if self.is_kept else ("Click Border: Drop or Keep", "Click Part: Cut", "Ctrl Z: Undo", "Enter: Keep")

    def plan(self, progress: Progress) -> None:
        """Wait until the hand rests, then plan, unless it is done. Give up as soon as the parts have changed."""
        version = self._version
        if self.is_planned:
            return

        def goes_on(fraction: float) -> bool:
            return progress(fraction) and self._version == version and not self._searches

        while time.monotonic() < self._rests_at and not self.is_kept:
            if not goes_on(0.0):
                return
            time.sleep(_TICK)
        with suppress(self._cancelled):
            self._search.plan(goes_on, is_enough=self._is_enough)
            self._planned = version

    def look(self) -> str:
        """Show plans that are new, and return the stretch and the length of their seams."""
        if not self._search.are_alive:
            return ""
        self._preview.poll()
        plans = {each: plan for each in self._search if (plan := each.best_so_far) is not None}
        new = [suggestion for suggestion, plan in plans.items() if self._seen.get(suggestion) is not plan]
        self._seen.update((suggestion, plans[suggestion]) for suggestion in new)
        for suggestion in new:
            self._show(suggestion)
        is_whole = len(plans) == len(self._search)
        if new and is_whole:
            length = _in_units(sum(each.length_of(plan) for each, plan in plans.items()))
            islands = sum(plan.island_count for plan in plans.values())
            self._found_map = FoundMap(0.0, islands, length)
        if self._found_map is not None and is_whole:
            energies = [each.energy_of(plan) for each, plan in plans.items()]
            stretch = mean_stretch(energies, [each.area for each in plans])
            self._found_map = replace(self._found_map, stretch=100.0 * stretch)
        if self._found_map is not None and self._used is not None and self._used[0] == self._version:
            self._found_map = replace(self._found_map, used=self._used[1])
        self._tell()
        found = self._found_map
        return "" if found is None else f"stretch {found.stretch:.0f} %, seams {found.length}"

    def _tell(self) -> None:
        search = self._search
        rows = rows_of_parts(
            self.choice, search.part_count, self._past, self._found_map, self.is_planned, search.automatic
        )
        self._preview.tell([(self._said, ""), *rows] if self._said else rows)

    # The artist's hand

    def take(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take an event of the wheel, the mouse or the keys.

        Returns what a modal operator returns, or an empty set if the event is for others.
        """
        if self.is_kept or not self._search.are_alive:
            return set()
        place = place_of(context.window, event)
        if event.type == "MOUSEMOVE":
            self._preview.point(None if place is None else self._preview.at(place))
            return {"PASS_THROUGH"}
        if event.value not in _PRESSES:
            return set()
        act = self._act_for(event, place, keymaps.keys(context).decode(event))
        if act is not None and not (place is not None and keymaps.on_gizmo_with(event, place, context)):
            self._said = ""
            act()
            self._tell()
            return set(_TAKEN)
        if place is not None and not keymaps.is_for_blender(event, context) and event.type not in MODIFIER_KEYS:
            self._say("Only the wheel, clicks, W, Ctrl Z, Enter, Esc and keys that move the view work here")
            self._tell()
        return set()

    def _act_for(self, event: bpy.types.Event, place: Place | None, action: Action | None) -> Callable[[], None] | None:
        """Return what an event asks for. Over other editors only Enter does, and Undo, which would change the mesh."""
        if action in {Action.UNDO, Action.REDO} and (place is not None or event.ctrl or event.oskey):
            return partial(self._step_to, -1 if action is Action.UNDO else 1)
        if action is Action.NEXT and place is not None and not event.alt:
            return self._part_by_next
        if event.alt or event.oskey:
            return None
        if event.type in _NOTCHES and place is not None:
            is_shifted = event.shift and event.type not in _SIGNS  # a keyboard may have the plus with Shift
            if not (event.ctrl and is_shifted):
                what = "stretch" if event.ctrl else "islands" if is_shifted else "amount"
                return partial(self._turn, what, _NOTCHES[event.type])
        if event.ctrl or event.shift:
            return None
        if event.type in _CONFIRM and (place is not None or event.type != "SPACE"):
            return self._keep
        if event.type == "LEFTMOUSE" and place is not None:
            return partial(self._click, place)
        return None

    def _say(self, text: str) -> None:
        """Answer a key until the next input. The same answer is given once."""
        if text not in self._told:
            self._told.add(text)
            self._said = text

    def _step_to(self, by: int) -> None:
        """Take back the last change, by -1, or make it again, by 1. A change whose search has not ended is taken back first."""
        waiting, waits_at = self._searches[-1] if self._searches else (None, None)
        if waiting is not None and waits_at is None:
            if by < 0:
                self._drop_search()
            return
        at = (self._at if waits_at is None else waits_at) + by
        if not 0 <= at < len(self._choices):
            self._say("Nothing to undo: the parts are as they were first shown" if by < 0 else "Nothing to redo")
            return
        if waiting is not None:
            self._drop_search()  # the new search goes on from where that one leads
        self._begin(partial(self._counted, self._choices[at]), at)

    def _counted(self, choice: PartChoice, progress: Progress) -> PartChoice:
        """Return a choice after its parts were found, so that they are kept."""
        self._search.count(choice, progress)
        return choice

    def _drop_search(self) -> None:
        self._searches.pop()
        self._worked_on = -1  # another step is needed

    def _keep(self) -> None:
        """Keep the parts. The map is no longer shown."""
        self.is_kept = True
        self._preview.point(None)
        for suggestion in self._search:
            self._show(suggestion)

    def _turn(self, what: str, notches: int) -> None:
        """Turn the amount of parts, the limit of the stretch or the number of islands by one notch.

        Notches past an end are counted, so that as many notches back lead to the same choice again.
        """

        def search(progress: Progress) -> PartChoice:
            choice = self.choice
            if self._past[what] * notches >= 0:
                choice = self._turned(what, notches, progress)
            if choice == self.choice:
                self._past[what] += notches
            return choice

        self._begin(search)

    def _part_by_next(self) -> None:
        self._begin(lambda progress: self._counted(parted_by_next(self._choices[: self._at + 1]), progress))

    def _turned(self, what: str, notches: int, progress: Progress) -> PartChoice:
        choice = self.choice
        if what == "stretch":
            return replace(choice, stretch=turned_limit(choice.stretch, notches, self._choices[0].stretch))
        if what == "islands":
            return replace(choice, islands=max(1, choice.islands + notches))
        until = time.monotonic() + _LOOKING
        found = self._turns.get((choice.amount, notches))
        if found is None:
            found = turned(
                choice.amount, notches, lambda some: self._count(some, progress), lambda: time.monotonic() < until
            )
        after = self._counted(replace(choice, amount=found), progress)
        if found != choice.amount:
            self._turns[choice.amount, notches], self._turns[found, -notches] = found, choice.amount
        return after

    def _count(self, amount: float, progress: Progress) -> int:
        if amount not in self._counts:
            self._counts[amount] = self._search.count(replace(self.choice, amount=amount), progress)
        return self._counts[amount]

    def _click(self, place: Place) -> None:
        at = None if self._searches else self._preview.at(place)
        if at is None:
            return
        suggestion = next(each for each in self._search if each.mesh.obj == at.obj)
        edits = {**self.choice.edits, suggestion.name: self._edited(suggestion, at)}

        def search(progress: Progress) -> PartChoice:
            edited = replace(self.choice, edits=edits)
            is_uncut = self._search.count(edited, progress) == self._search.part_count and at.border is None
            return self.choice if is_uncut else edited

        self._begin(search)
        self._preview.point(self._preview.at(place))

    def _begin(self, search: Search, at: int | None = None) -> None:
        """Change the parts as a search says: at once if it is short, otherwise in a step. The choice is new, or has a place already."""
        until = time.monotonic() + _INSTANT
        try:
            found = None if self._searches else search(lambda _: time.monotonic() < until)
        except self._cancelled:
            found = None
        if found is None:
            self._searches.append((search, at))
        else:
            self._change_to(found, at)

    def find(self, progress: Progress) -> None:
        asked = self._searches[0]
        with suppress(self._cancelled):
            # Undo may take the search back.
            self._found = asked, asked[0](lambda done: progress(done) and asked in self._searches)

    def _change_to(self, choice: PartChoice, at: int | None) -> None:
        before = self.choice
        if choice == before:
            return
        if (choice.by, choice.edits) != (before.by, before.edits):
            self._counts.clear()
            self._turns.clear()
            del self._past["amount"]  # other parts have other ends
        if at is not None or choice.edits != before.edits:
            self._past.clear()
        if at is None:
            at = self._at + 1
            self._choices[at:] = [choice]
        self._at = at
        self._change()

    def _edited(self, suggestion: Suggestion, at: Pointed) -> PartEdits:
        edits = self.choice.edits.get(suggestion.name, PartEdits())
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
        self._version += 1
        self._rests_at = time.monotonic() + _REST
        self._found_map = None
        self._search.limit(self.choice.stretch, self.choice.islands)
        self._search.choose(self.choice)
        for suggestion in self._search:
            self._show(suggestion)
        self._tell()

    # The picture

    def _dim(self, suggestion: Suggestion) -> list[NDArray[np.int32]]:
        """Return the borders that the artist has dropped."""
        dropped = self.choice.edits.get(suggestion.name, PartEdits()).dropped
        return [chain for chain in self._dropped.get(suggestion.name, ()) if edges_of(chain) <= dropped]

    def _show(self, suggestion: Suggestion) -> None:
        plan, points = suggestion.best_so_far, suggestion.mesh.arrays.in_object
        curves = Curves(
            [points[chain] for chain in suggestion.borders], [points[chain] for chain in self._dim(suggestion)]
        )
        cuts, unfold, version = suggestion.seams, None, self._version
        if plan is not None:
            curves = replace(curves, slits=[wire.points for wire in plan.wires])
            cuts = suggestion.edges_of(plan)
        if plan is not None and not self.is_kept:
            per_unit = _scale_of(suggestion.mesh.obj) / self._square

            def unfold() -> NDArray[np.float64] | None:
                found = suggestion.layout_of(plan, lambda _: self._version == version and self._preview.is_open)
                used = self._search.used()
                self._used = None if used is None else (version, used)
                return None if found is None else found * per_unit

        self._preview.show(suggestion.mesh.obj, suggestion.mesh.arrays, curves, cuts, unfold)


def _scale_of(obj: bpy.types.Object) -> float:
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
