# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wire: its candidates from the seed to the cursor. A click begins a chain, or keeps the active one and goes on from its end."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.refused import Refused
from ..network.network import Given, Way
from ..network.picks import FacePoint, pick_name
from ..network.wires import Wire, distinct
from ..solver.solver import by_number, for_live
from .courses import Course
from .interaction import Begun, Edit, Interaction
from .picture import Intent
from .ways import Begin, across, along_edges, goal, in_order, search_way

if TYPE_CHECKING:
    from ..network.network import Network, Request, Snap
    from ..network.picks import Pick
    from ..solver.solver import LiveWire
    from .board import Board


class Wiring(Interaction):
    """The live wire from the chain's seed to the cursor: a candidate for each metric.

    Attributes
    ----------
    wires, finals
        The candidates, and which of them are computed.
    leading, settled
        The candidate that is the active one unless the artist brings another forward, and whether it stays so.
    chosen
        The candidate that the artist brought forward.
    active_index, active, active_final
        The candidate that a click would keep, its number, and whether it is computed.
    runs
        Whether the way on to the end is asked for, along edges.
    extended
        The live wire with that way, once it is found.
    """

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.chosen: int | None = None
        self.runs = False
        self.extended: Wire | None = None
        self._sown: tuple[LiveWire, Begin] | None = None
        self._seen = False
        self.clear()

    def clear(self) -> None:
        """Show no wires. The pick under the cursor stays."""
        self.wires: tuple[Wire | None, ...] = ()
        self.finals: tuple[bool, ...] = ()
        self.leading, self.settled = 0, True
        self.straight: Wire | None = None
        self.extended = None
        self._choose()

    def forget(self) -> None:
        self.clear()
        self.chosen = None

    # Where it begins

    def sow(self) -> LiveWire:
        """Return the live wires, which begin where they are to begin now. Raise ValueError if that is not part of the surface."""
        begin, live = self._board.begin, self._live
        if begin is not None and self._sown != (live, begin):
            self._sown = None
            begin.sow(live, self._board.options.along)
            self._sown = live, begin
        return live

    @property
    def _live(self) -> LiveWire:
        return self._board.engines.get(self._board.options.along)

    # Candidates

    def aim(self, target: Snap | None) -> None:
        self.target = target
        self.clear()
        try:
            self.reason = self._find()
        except ValueError as error:
            self.reason = str(error)
        self._choose()
        if self.runs:
            self._extend()

    def _find(self) -> str:
        board, target = self._board, self.target
        along, network = board.options.along, board.network
        if network.seed is None or target is None:
            return ""
        live, begin = self.sow(), board.begin
        assert begin is not None
        if begin.is_at(target.pick, network.seed.pick):
            return ""
        if along == "SURFACE" and isinstance(target.pick, tuple):
            return only_vertices(target.pick)
        closes = self._closes(network, target)
        lead, avoid = target.pick, None
        if along == "EDGES" and closes is not None:
            lead, avoid = goal(target.pick, board.wire(closes.id))
        found = live.wires(for_live(lead, along))
        candidates, self.leading = by_number(found)
        self.finals = tuple(each.final for each in candidates)
        self.settled = found.settled
        if along == "SURFACE":
            self.wires = tuple(across(each, row, begin.pick, target.pick) for row, each in enumerate(candidates))
            if board.options.straight:
                self._add_straight(begin.pick, target)
        else:
            ends = network.seed.pick, target.pick
            self.wires = tuple(
                along_edges(each, row, begin, ends, avoid, board.points) for row, each in enumerate(candidates)
            )
        if self.chosen is not None and self.chosen >= len(self.wires):
            self.chosen = None  # the metric that is used now has no such wire
        return "" if self._is_reached else f"No wire reaches {pick_name(target.pick)}: it is not connected to the seed"

    @staticmethod
    def _closes(network: Network, target: Snap) -> Request | None:
        if not network.closes(target):
            return None
        return next((own for own, end in network.at(target.pick) if end == "start" and own.goes_on is None), None)

    def _add_straight(self, begin: Pick, target: Snap) -> None:
        if target.seen_along is None:
            return
        live = self._board.engines.get("SURFACE")
        self.straight = straight_wire(live, begin, target.pick, target.seen_along, self.leading)
        if self.straight is not None:
            self.wires, self.finals = (*self.wires, self.straight), (*self.finals, True)
            self.leading, self.settled = len(self.wires) - 1, True

    def _extend(self) -> None:
        board = self._board
        seed = board.network.seed
        try:
            if seed is None:
                raise Refused("Nothing to extend: place a seed first")
            heading = board.ground.heading(seed.after, seed.pick)
            wire = board.ground.run_on(board.engines.get("EDGES"), self.active, seed.pick, heading)
        except ValueError as error:
            self.extended, self.reason = None, str(error)
        else:
            self.extended = board.how("EDGES").of(wire)

    def poll(self) -> bool:
        """Find the wires to the same target once more, if they were not final or begin elsewhere now."""
        is_sown = self._sown is None or self._sown == (self._live, self._board.begin)
        if self.is_final and is_sown and not (self.runs and self.extended is None):
            return False
        before = self.shown
        self.aim(self.target)
        return before != self.shown and not _alike(before, self.shown)

    @property
    def shown(self) -> tuple[object, ...]:
        return self.target, self.reason, self.leading, self.finals, self.wires, self.extended

    @property
    def is_final(self) -> bool:
        return all(self.finals)

    def is_aimed_at(self, target: Snap | None) -> bool:
        """Whether a target is under the cursor already, looked at from where it is now if wires are to be straight there."""
        if target != self.target:
            return False
        return not self._board.options.straight or target is None or target.seen_along == self.target.seen_along

    def _choose(self) -> None:
        """Find the candidate that a click would keep: while the one that comes first is not computed and another is, the one there is."""
        first, places = self.leading if self.chosen is None else self.chosen, [*range(len(self.wires))]
        order = places[first:] + places[:first]
        self.active_index = next((at for at in order if self.wires[at] is not None), first)
        self.active = self.wires[self.active_index] if self.wires else None
        self.active_final = self.active is not None and self.finals[self.active_index]

    @property
    def others(self) -> tuple[Wire, ...]:
        return distinct(self.wires[at] for at in self._order(self.active_index))[1:]

    @property
    def number(self) -> int:
        """The place of the active wire among those that run differently, beginning with the leading one, from 0."""
        active, ways = self.active, distinct(self.wires[at] for at in self._order(self.leading))
        return next((place for place, way in enumerate(ways) if active is not None and way.like(active)), 0)

    def _order(self, first: int) -> list[int]:
        count = len(self.wires)
        return [(first + step) % count for step in range(count)]

    @property
    def is_done(self) -> bool:
        """Whether a click keeps the active wire as it is: because it stays the one, or because the artist has seen it."""
        index = self.active_index
        stays = all(self.finals) or index == self.chosen or (self.settled and index == self.leading)
        return self.active_final and (stays or self._seen)

    @property
    def _is_reached(self) -> bool:
        return not self.is_final or any(self.wires)

    def advance(self) -> None:
        others = self.others
        if not others:
            if self.finals and not self._is_reached:
                raise Refused(f"No wire reaches {pick_name(self.target.pick)}: it is not connected to the seed")
            if self.is_final and self.active is not None:
                raise Refused("All wires run along the same edges here")
            raise Refused("No other candidate found yet")
        self.chosen = next(at for at, wire in enumerate(self.wires) if wire is others[0])
        self._choose()
        if self.runs:
            self._extend()

    @property
    def is_straight(self) -> bool:
        return self.straight is not None and self.active is self.straight

    # Clicks

    def click(self, target: Snap) -> Edit:
        if self._board.network.seed is None:
            return self.start(target)
        self._seen = self.active_final and target == self.target
        if not (self.is_aimed_at(target) and self.is_final and self.wires):
            self.aim(target)
        return self.keep()

    def start(self, target: Snap) -> Edit:
        board = self._board
        along = board.options.along
        if along == "SURFACE" and isinstance(target.pick, tuple):
            raise Refused(only_vertices(target.pick))
        network = replace(board.base, seed=None).joined(target, board.points, board.is_final)
        return Edit(replace(network, seed=network.seed_at(target, along)))

    def keep(self) -> Edit:
        board, target, wire = self._board, self.target, self.active
        assert target is not None
        begin = self._board.begin
        assert begin is not None
        network = board.base
        seed = network.seed
        assert seed is not None
        if begin.is_at(target.pick, seed.pick):
            raise Refused("The wire ends where it begins: click somewhere else")
        if self.reason and not self.runs:
            raise Refused(self.reason)
        is_done = self.is_done
        closes = self._closes(network, target)
        way = Way(
            along=board.options.along,
            start=seed.pick if board.options.along == "EDGES" else begin.pick,
            end=target.pick,
            goes_on=seed.after if board.options.along == "EDGES" else None,
            how=board.how(board.options.along),
            follow=self.chosen,
            closes=None if closes is None else closes.id,
        )
        ends = self.ending(target) is not None
        joined = network.joined(target, board.points, board.is_final)
        if self.is_straight and wire is not None:
            given = Given.of(replace(way.how.of(wire), id=way.id))
            board.ground.check(way, given.wire)
            return Edit(joined.with_drawn(given, target.pick, ends))
        course = Course()
        if wire is not None:
            kept = replace(way.how.of(wire), id=way.id)
            if is_done:
                board.ground.check(way, kept)
            ordered = in_order(self.wires, self.active_index) if self.is_final else ()
            course = Course((kept,), final=is_done, choices=ordered)
        search = None if course.final else search_way(way, board.ground, board.engines.hand_over(way.along), begin)
        return Edit(joined.with_drawn(way, target.pick, ends), (Begun(way, course, search),))

    def run_to_end(self) -> Edit:
        board = self._board
        network, begin = board.base, board.begin
        seed = network.seed
        if seed is None or begin is None:
            raise Refused("Nothing to extend: place a seed first")
        self._extend()
        wire, target = self.active, self.target
        is_done = wire is None or self.is_done
        end = seed.pick if wire is None or target is None else target.pick
        if self.extended is None and is_done and self.is_final:
            raise Refused(self.reason)
        way = Way(
            along="EDGES",
            start=seed.pick,
            end=end,
            goes_on=seed.after,
            how=board.how("EDGES"),
            follow=self.active_index if wire is not None and is_done else self.chosen,
            runs_on=True,
        )
        shown = () if self.extended is None else (replace(self.extended, id=way.id),)
        course = Course(shown, final=is_done and self.extended is not None)
        if course.final:
            given = Given.of(shown[0], way.goes_on)
            return Edit(replace(network.adding(given), seed=None))
        search = search_way(way, board.ground, board.engines.hand_over("EDGES"), begin)
        return Edit(replace(network.adding(way), seed=None), (Begun(way, course, search),))

    def ending(self, target: Snap) -> Intent | None:
        if self._board.network.closes(target):
            return Intent.CLOSE
        return Intent.JOIN if target.ends_chains else None


def _alike(one: tuple[object, ...], other: tuple[object, ...]) -> bool:
    """Whether two states differ only by wires that run the same way."""
    *before, wires, extended = one
    *after, others, longer = other
    pairs = [*zip(wires, others, strict=False), (extended, longer)]
    return (
        before == after
        and len(wires) == len(others)
        and all(a is b or (a is not None and b is not None and a.like(b)) for a, b in pairs)
    )


def only_vertices(edge: Pick) -> str:
    return f"Wires across the surface need vertices or points of faces, not {pick_name(edge)}"


def straight_wire(
    live: LiveWire, begin: Pick, end: Pick, direction: tuple[float, float, float], follow: int
) -> Wire | None:
    """Return the wire in the plane through two picks and along a direction, such as that from the viewer, or None.

    Parameters
    ----------
    begin, end
        Vertices, or points of triangles.
    follow
        Which of the library's wires it is when its seeds are moved.
    """
    core, surface = native.load(), live.surface
    if surface is None:
        return None
    try:
        points, faces, _ = core.plane_section(surface, for_live(begin, "SURFACE"), for_live(end, "SURFACE"), direction)
    except ValueError:
        return None  # one lies behind the other
    if len(points) < 2:
        return None
    # Each point of the line with a triangle that it lies in.
    triangles = np.append(faces, faces[-1])
    ends = [None if isinstance(pick, FacePoint) else pick for pick in (begin, end)]
    chain = core.fit_chain(surface, points, triangles, *ends)
    vertices = tuple(int(v) for v in chain.vertices)
    inside = next((pick for pick in (begin, end) if isinstance(pick, FacePoint)), None)
    if len(vertices) < 2 and inside is not None:
        # Between points of one face there may be no edge to snap to.
        vertices = (next((pick for pick in ends if isinstance(pick, int)), inside.vertex),)
    elif len(vertices) < 2 or any(
        pick is not None and pick != vertices[at] for at, pick in zip((0, -1), ends, strict=True)
    ):
        return None
    return Wire("SURFACE", vertices, points, begin, end, faces, follow=follow)
