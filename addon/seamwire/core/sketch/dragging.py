# SPDX-License-Identifier: GPL-3.0-or-later
"""The drag of a seed: the wires that end there follow it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..network.network import Given, How, Way
from ..network.picks import is_same, pick_name, undirected
from ..solver.solver import for_live
from .courses import Course
from .interaction import Begun, Edit, Interaction
from .ways import Begin, backwards, choices, directed, search_way, ways_of
from .wiring import only_vertices

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..network.network import Link, Network, Request, Snap
    from ..network.picks import Edge, End, Pick
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .board import Board


class Leg:
    """One wire at the seed. Its live wires begin at the end that stays.

    Raises ValueError if that is not part of the surface.
    """

    def __init__(self, board: Board, network: Network, own: Request, wire: Wire, moving: End) -> None:
        ground = board.ground
        self.own, self.wire, self.moving = own, wire, moving
        self.stays = wire.end if moving == "start" else wire.start
        self.live = board.engines.get(wire.along).fork()
        if moving == "end":
            heading = ground.heading(own.goes_on, wire.start) if wire.along == "EDGES" else None
            self.begin = Begin.of(self.stays, wire.along, heading)
        else:
            after = network.after(own) if wire.along == "EDGES" else None
            self.begin = backwards(self.stays, wire, None if after is None else board.wire(after.id), wire.along)
        self.begin.sow(self.live, wire.along)

    def request(self, pick: Pick, meets: Link | None) -> Way:
        ends = {"start": self.wire.start, "end": self.wire.end, self.moving: pick}
        return Way(
            along=self.wire.along,
            goes_on=self.own.goes_on,
            how=How.like(self.wire),
            follow=self.wire.follow,
            was=self.wire,
            meets=meets if self.moving == "start" else None,
            moving=self.moving,
            id=self.own.id,
            **ends,
        )


class Dragging(Interaction):
    """A seed that is dragged, and the wires that follow it. On a wire, a seed is put there first, in the same step for undo.

    Raises ValueError if there is no seed, or if a wire's other end is not part of the surface.

    Attributes
    ----------
    moved, shown
        The wires that follow, as they run now, and all wires with them.
    """

    def __init__(self, board: Board, grip: Snap) -> None:
        super().__init__(board)
        self._seed = grip.pick
        self._before = board.base.joined(grip, board.points, board.is_final)
        ends = self._before.at(grip.pick)
        live = self._before.seed
        if not ends and (live is None or not is_same(live.pick, grip.pick)):
            raise Refused(f"No seed to move at {pick_name(grip.pick)}")
        self._legs: list[Leg] = []
        for own, end in ends:
            wire = board.wire_of(own)
            if wire is None or not isinstance(own, (Given, Way)):
                raise Refused("This wire is still being computed: try again in a moment")
            # Wires that were cut go across the surface anew.
            wire = wire.uncut()
            if wire.along != own.along:
                own = Given.of(wire)
            self._legs.append(Leg(board, self._before, own, wire, end))
        self._courses: list[tuple[Leg, Way, Course]] = []
        self._show(tuple(leg.wire for leg in self._legs))
        self._is_final = self._is_solved = True

    @property
    def place(self) -> Pick:
        return self._seed if self.target is None else self.target.pick

    @property
    def is_final(self) -> bool:
        return self._is_final

    @property
    def is_solved(self) -> bool:
        return self._is_solved and not self.reason

    def lives(self) -> Sequence[LiveWire]:
        return [leg.live for leg in self._legs]

    def aim(self, target: Snap) -> None:
        self.target = target
        self._is_final = self._is_solved = True
        try:
            self.reason = self._refusal(target.pick) or self._lead(target.pick)
        except ValueError as error:
            self.reason = str(error)

    def poll(self) -> bool:
        if self._is_final or self.target is None:
            return False
        before = self.moved
        self.aim(self.target)
        return before is not self.moved

    def _refusal(self, pick: Pick) -> str:
        if isinstance(pick, tuple) and any(leg.wire.along == "SURFACE" for leg in self._legs):
            return only_vertices(pick)
        if self._legs and all(is_same(leg.stays, pick) for leg in self._legs):
            return "The wire would end where it begins: remove it instead"
        return ""

    def _lead(self, pick: Pick) -> str:
        """Find the wires to a pick, and show them if all of them are solved. If a wire is missing, return the reason."""
        self._courses = []
        moved: list[Wire] = []
        missing: list[Leg] = []
        # A wire that arrives comes first: those that leave an edge have to go on in its direction.
        meets: Link | None = None
        direction: Edge | None = None
        for leg in self._arriving_first():
            if is_same(leg.stays, pick):
                continue
            way = leg.request(pick, meets)
            if isinstance(pick, tuple) and meets is None:
                # Another wire leaves in the direction of one that arrives, and goes the other way from one that leaves.
                meets = way.id, leg.moving
            target, avoid = pick, None
            if direction is not None and leg.moving == "start":
                target, avoid = direction[1], direction[0]
            found = leg.live.wires(for_live(target, way.along))
            self._is_final &= found.final
            self._is_solved &= found.solved
            ways, leading = ways_of(found, way, leg.begin, avoid, self._board.points)
            ordered = choices(way, ways, leading)
            if not ordered:
                missing.append(leg)
                self._courses.append((leg, way, Course((leg.wire,))))
                continue
            wire = way.how.of(replace(ordered[0], id=way.id))
            moved.append(wire)
            shown = wire if found.solved else leg.wire
            course = Course((shown,), final=found.final, choices=ordered if found.final else ())
            self._courses.append((leg, way, course))
            if meets is not None and meets[0] == way.id:
                direction = directed(wire, leg.moving)
        if self._is_solved and missing:
            return f"No wire from {pick_name(missing[0].stays)} reaches {pick_name(pick)}"
        if self._is_solved:
            self._show(tuple(moved))
        return ""

    def _arriving_first(self) -> list[Leg]:
        return sorted(self._legs, key=lambda leg: leg.moving == "start")

    @property
    def ids(self) -> set[int]:
        return {leg.own.id for leg in self._legs}

    @property
    def ends(self) -> frozenset[Pick]:
        ends = {end for wire in (*self.moved, *(leg.wire for leg in self._legs)) for end in (wire.start, wire.end)}
        return frozenset(ends | {end[::-1] for end in ends if isinstance(end, tuple)})

    def seeds(self) -> list[Pick]:
        before, now = undirected(self._seed), undirected(self.place)
        moved = (
            now if undirected(pick) == before else undirected(pick) for pick in (*self._before.seeds(), *self._live)
        )
        return list(dict.fromkeys(moved))

    @property
    def _live(self) -> tuple[Pick, ...]:
        place = self._board.seed_place
        return () if place is None else (place,)

    def _show(self, moved: tuple[Wire, ...]) -> None:
        """Show the wires that follow. `shown` has them among all drawn wires."""
        board, self.moved = self._board, moved
        own = {wire.id: wire for wire in moved}
        requests = (each for each in self._before.requests if each.id in own or each.id not in self.ids)
        wires = (own.get(each.id) or board.wire_of(each) for each in requests)
        complete = (board.images.completed(wire) for wire in wires if wire is not None)
        self.shown = replace(board.drawn, wires=tuple(complete))

    def keep(self) -> Edit | None:
        """Return the edit that leaves the seed where it is now. Return None if it has not moved."""
        if self.reason:
            raise Refused(self.reason)
        if self.target is None:
            return None
        board, pick = self._board, self.target.pick
        begun = tuple(
            Begun(way, course, search_way(way, board.ground, leg.live, leg.begin))
            for leg, way, course in self._courses
            if not course.final or course.wires[0].leaves_trace
        )
        report = "A wire was removed: no edge is left for its seam" if len(begun) < len(self._courses) else ""
        requests = {each.request.id: each.request for each in begun}
        gone = [leg.own.id for leg in self._legs if leg.own.id not in requests]
        network = self._before.without(*gone).replacing({id: (own,) for id, own in requests.items()})
        network = self._with_seed(network, pick)
        return Edit(network.joined(self.target, board.points, board.is_final), begun, report=report)

    def _with_seed(self, network: Network, pick: Pick) -> Network:
        seed = network.seed
        if seed is None:
            return network
        if is_same(seed.pick, self._seed):
            own = None if seed.after is None else network.find(seed.after[0])
            stays = own is not None and is_same(getattr(own, seed.after[1]), pick)
            seed = replace(seed, pick=pick, after=seed.after if stays else None)
        if seed.first is not None and is_same(seed.first, self._seed):
            seed = replace(seed, first=pick)
        return replace(network, seed=seed)
