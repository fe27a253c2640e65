# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires that follow a seed of the network while it is dragged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.refused import Refused
from ..network.network import Network, Snap
from ..network.picks import FacePoint, pick_name, undirected, vertices_of
from ..network.wires import Wire, distinct
from ..solver.solver import by_number, for_live
from .gesture import Gesture
from .wire import only_vertices

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge, End, Pick
    from ..solver.solver import Candidate, LiveWire
    from .drawing import Drawing
    from .gesture import Committed


@dataclass(frozen=True)
class Courses:
    """The ways that a wire may take, one for each metric, as far as they are computed; `leading` is offered first."""

    ways: tuple[Wire | None, ...] = ()
    leading: int = 0
    solved: bool = False
    final: bool = False

    def following(self, follow: int) -> Wire | None:
        """Return the way of one metric with the others as its alternatives. If it has no way, return the next one."""
        way, *others = self.in_order(follow if follow < len(self.ways) else self.leading) or (None,)
        return way and replace(way, alternatives=tuple(others))

    def others(self, own: Wire) -> tuple[Wire, ...]:
        """Return the ways that a wire does not take, in the order in which they come forward after its own."""
        return tuple(way for way in self.in_order(own.follow + 1) if not way.like(own))

    def in_order(self, first: int) -> tuple[Wire, ...]:
        """Return the ways that differ, in the order in which they come forward, from that of one metric on."""
        count = len(self.ways)
        return distinct(self.ways[(first + step) % count] for step in range(count))


class Leg:
    """Finds new courses for one wire, no loop, from the end that stays.

    Where the wire joins others of the network, it leaves and arrives as they do.

    Raises ValueError where the end that stays is not part of the surface.
    """

    def __init__(self, live: LiveWire, network: Network, wire: Wire, moving: End, points: NDArray[np.float64]) -> None:
        self.wire = wire
        self.moving = moving
        self.live = live
        self.stays = wire.end if moving == "start" else wire.start
        self._points = points
        seed, forward, self._skip = _fixed_seed(network, wire, moving)
        live.seed(for_live(seed, wire.along), forward=forward)

    def trace(self, target: Pick, place: Pick, avoid: int | None = None) -> Courses:
        """Return the courses to a target, where they have a seed at `place`. They end as soon as they pass the vertex `avoid`.

        Raises ValueError where the target is not part of the surface.
        """
        found = self.live.wires(for_live(target, self.wire.along))
        wires, leading = by_number(found)
        ways = tuple(self._wire(wire, follow, place, avoid) for follow, wire in enumerate(wires))
        return Courses(ways, leading, found.solved, found.final)

    def _wire(self, candidate: Candidate, follow: int, place: Pick, avoid: int | None) -> Wire | None:
        vertices = tuple(int(vertex) for vertex in candidate.vertices)[self._skip :]
        if avoid in vertices:
            vertices = vertices[: vertices.index(avoid) + 1]
        free = isinstance(place, FacePoint) or isinstance(self.stays, FacePoint)
        if len(vertices) < (1 if free and self.wire.along == "SURFACE" else 2):
            return None
        points, faces = np.array(candidate.points, dtype=np.float64), np.array(candidate.faces)
        if self.moving == "start":
            vertices, points, faces = vertices[::-1], points[::-1], faces[::-1]
        if self.wire.along == "EDGES":
            points, faces = self._points[list(vertices)], None
        ends = {"start": self.wire.start, "end": self.wire.end, self.moving: place}
        return self.wire.drawn(vertices=vertices, points=points, faces=faces, follow=follow, **ends)


def _fixed_seed(network: Network, wire: Wire, moving: End) -> tuple[Pick, bool, int]:
    """Return where a leg's live wires begin, whether that is a directed edge, and how many vertices are not the leg's."""
    stays = wire.end if moving == "start" else wire.start
    if wire.along == "SURFACE":
        return stays if isinstance(stays, FacePoint) else vertices_of(stays)[-1], False, 0
    if moving == "end":
        before = network.before(wire)
        return (stays, False, 0) if before is None else (before.last_edge, True, 1)
    after = network.after(wire)
    if after is None:
        return stays, False, 0
    if isinstance(stays, tuple):
        # The wire after this one leaves the edge over its second vertex: this one arrives over the first.
        return wire.last_edge[::-1], True, 0
    return (after.vertices[1], after.vertices[0]), True, 1


class SeedDrag(Gesture):
    """A seed of the network that is dragged, and the wires that follow it. On a wire, a seed is put there first, in the same step for undo.

    Raises ValueError if there is no seed, or if a wire's other end is not part of the surface.
    """

    def __init__(self, drawing: Drawing, grip: Snap) -> None:
        self._drawing = drawing
        seed = grip.pick
        network = drawing.network.joined(grip, drawing.points)
        # Wires that were cut go across the surface anew.
        own = {wire.id for wire, _ in network.at(seed)}
        network = replace(network, wires=tuple(wire.uncut() if wire.id in own else wire for wire in network.wires))
        ends = network.at(seed)
        live = network.seed
        if not ends and (live is None or undirected(live.place) != undirected(seed)):
            raise Refused(f"No seed to move at {pick_name(seed)}")
        self.before = network
        self.network = network
        self.seed = seed
        self.target: Snap | None = None
        self.final = True
        self.solved = True
        """Whether each wire that follows is the shortest one."""
        self.ending = False
        """Whether the seed was released, and stays where it is as soon as its wires are computed."""
        self.message = ""
        engines, points = drawing.engines, drawing.points
        self.legs = [Leg(engines.get(wire.along).fork(), network, wire, end, points) for wire, end in ends]

    @property
    def place(self) -> Pick:
        """Where the seed is now."""
        return self.seed if self.target is None else self.target.pick

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow, as they run now."""
        own = {leg.wire.id for leg in self.legs}
        return tuple(wire for wire in self.network.wires if wire.id in own)

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it."""
        return [leg.live for leg in self.legs]

    def poll(self) -> bool:
        """Take in what was computed. Return whether the wires run elsewhere now."""
        if self.final or self.target is None:
            return False
        before = self.network
        self.aim(self.target)
        return self.network is not before

    def aim(self, target: Snap | None) -> str:
        """Lead the wires to another place. If that fails, the old wires stay. Return why."""
        if target is None:
            return self.message
        self.target = target
        self.final = self.solved = True
        self.message = self._refusal(target.pick)
        if self.message:
            return self.message
        try:
            courses = self._courses(target.pick)
        except ValueError as error:
            self.message = str(error)
            return self.message
        missing = [leg for leg in self.legs if leg.wire.id not in courses]
        if self.solved and missing:
            self.message = f"No wire from {pick_name(missing[0].stays)} reaches {pick_name(target.pick)}"
        elif self.solved:
            self.network = self._with_seed(self.before.with_courses(courses), target.pick)
        return self.message

    def commit(self) -> Committed:
        """Return the network with the seed where it is now."""
        if not self.final:
            return self
        if self.message:
            raise Refused(self.message)
        if self.target is None:
            return None
        # The mirror may have changed while the seed was dragged.
        network = replace(self.network, mirror=self._drawing.options.mirror)
        return network.joined(self.target, self._drawing.points)

    def _refusal(self, pick: Pick) -> str:
        if isinstance(pick, tuple) and any(leg.wire.along == "SURFACE" for leg in self.legs):
            return only_vertices(pick)
        if self.legs and all(undirected(leg.stays) == undirected(pick) for leg in self.legs):
            return "The wire would end where it begins: remove it instead"
        return ""

    def _courses(self, pick: Pick) -> dict[int, Wire | None]:
        """Return the wires' new courses; one whose ends meet goes, one that is not reached or computed is left out."""
        courses: dict[int, Wire | None] = {}
        # A wire that arrives comes first: those that leave an edge have to go on in its direction.
        direction: Edge | None = None
        for leg in sorted(self.legs, key=lambda leg: leg.moving == "start"):
            if undirected(leg.stays) == undirected(pick):
                courses[leg.wire.id] = None
                continue
            if direction is not None and leg.moving == "start":
                found = leg.trace(direction[1], pick, avoid=direction[0])
            else:
                found = leg.trace(pick, pick)
            self.final &= found.final
            self.solved &= found.solved
            wire = found.following(leg.wire.follow)
            if wire is None:
                continue
            courses[leg.wire.id] = wire
            if isinstance(pick, tuple) and direction is None:
                # Another wire leaves in the direction of one that arrives, and goes the other way from one that leaves.
                direction = wire.last_edge if leg.moving == "end" else (wire.vertices[1], wire.vertices[0])
        return courses

    def _with_seed(self, network: Network, pick: Pick) -> Network:
        """Return a network whose live wire begins, and whose chain began, at the dragged seed's new place."""
        seed = network.seed
        if seed is None or self.before.seed is None:
            return network
        at_seed = undirected(self.before.seed.place) == undirected(self.seed)
        if at_seed and undirected(seed.place) != undirected(pick):
            seed = replace(seed, pick=pick, forward=False, clicked=None)
        if seed.first is not None and undirected(seed.first) == undirected(self.seed):
            seed = replace(seed, first=pick)
        return replace(network, seed=seed)
