# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wire: its candidates from the seed to the cursor. A click begins a chain, or keeps the active one and goes on from its end."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.refused import Refused
from ..network.network import Network
from ..network.picks import FacePoint, pick_name
from ..network.wires import Wire, distinct
from ..solver.solver import by_number, for_live
from .gesture import Gesture
from .picture import Intent

if TYPE_CHECKING:
    from ...terms.choices import Along
    from ..network.network import Seed, Snap
    from ..network.picks import Pick
    from ..solver.solver import Candidate, LiveWire
    from .drawing import Drawing
    from .gesture import Committed

    Direction = tuple[float, float, float]


class WireGesture(Gesture):
    """The live wire from the chain's seed to the cursor: a candidate for each metric.

    Attributes
    ----------
    target
        The pick under the cursor.
    wires, finals
        The candidates, and which of them are computed.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.target: Snap | None = None
        self.wires: tuple[Wire | None, ...] = ()
        self.finals: tuple[bool, ...] = ()
        self.leading = 0
        """The candidate that is the active one unless the artist brings another forward."""
        self.settled = True
        """Whether it is computed, and stays the leading one."""
        self.chosen: int | None = None
        """The candidate that the artist brought forward."""
        self._straight: Wire | None = None
        self._message = ""
        self.seen = False
        """Whether the active wire was shown before the click. The session tells, because waiting clicks show nothing."""
        self._kept = False
        self.seedless = False
        """Whether no live wire is shown, because the seed moves."""

    def take_warning(self) -> str:
        """Return the warning about triangles that a kept wire leads around, once."""
        return self._drawing.engines.warning(self._drawing.options.along) if self._kept else ""

    def aim(self, target: Snap | None) -> str:
        """Find the wires to a target."""
        self.seen = False
        self._message = self._find(target)
        return self._message

    def _find(self, target: Snap | None) -> str:
        """Find the wires from the seed to a target. Return the reason for a failure, otherwise an empty message."""
        network, options = self._drawing.network, self._drawing.options
        along = options.along
        self.target = target
        self.cancel()
        seed = None if self.seedless else network.seed
        if seed is None or target is None or seed.at(target.pick, along):
            return ""
        if along == "SURFACE" and isinstance(target.pick, tuple):
            return only_vertices(target.pick)
        goal, avoid = _goal(target, network, along)
        try:
            found = self._drawing.engines.get(along).wires(for_live(goal, along))
        except ValueError as error:
            return str(error)
        wires, self.leading = by_number(found)
        self.finals = tuple(wire.final for wire in wires)
        self.settled = found.settled
        if along == "SURFACE":
            begin = seed.begins("SURFACE")
            self.wires = tuple(across(wire, follow, begin, target.pick) for follow, wire in enumerate(wires))
            if options.straight:
                self._add_straight(begin, target)
        else:
            self.wires = tuple(
                self._along_edges(wire, follow, seed, target.pick, avoid) for follow, wire in enumerate(wires)
            )
        if self.chosen is not None and self.chosen >= len(self.wires):
            self.chosen = None  # the metric that is used now has no such wire
        return "" if self._is_reached else f"No wire reaches {pick_name(target.pick)}: it is not connected to the seed"

    @property
    def final(self) -> bool:
        """Whether all wires are computed."""
        return all(self.finals)

    @property
    def active_index(self) -> int:
        """Which of them a click would keep."""
        index = self.leading if self.chosen is None else self.chosen
        # While that one is not computed and another is, show the one there is.
        there = (at for at in self._order(index) if self.wires[at] is not None)
        return next(there, index)

    @property
    def active(self) -> Wire | None:
        """The wire that a click would keep."""
        return self.wires[self.active_index] if self.wires else None

    @property
    def others(self) -> tuple[Wire, ...]:
        """The different other wires, in the order in which they follow the active one."""
        return distinct(self.wires[at] for at in self._order(self.active_index))[1:]

    @property
    def number(self) -> int:
        """The place of the active wire among those that run differently, beginning with the leading one, from 0."""
        active = self.active
        ways = distinct(self.wires[at] for at in self._order(self.leading))
        return next((place for place, way in enumerate(ways) if active is not None and way.like(active)), 0)

    @property
    def active_final(self) -> bool:
        """Whether the wire that a click would keep is computed."""
        return self.active is not None and self.finals[self.active_index]

    def _order(self, first: int) -> list[int]:
        """Return the wires' numbers in the order in which they come forward, from one of them on."""
        count = len(self.wires)
        return [(first + step) % count for step in range(count)]

    @property
    def decided(self) -> bool:
        """Whether the wire that a click would keep is computed, and will not be another one when the rest is."""
        index = self.active_index
        return self.active_final and (self.final or index == self.chosen or (self.settled and index == self.leading))

    @property
    def shown(self) -> tuple[object, ...]:
        """What changes when something else is to be seen."""
        return self.target, self.leading, self.finals, self.wires

    def is_aimed_at(self, target: Snap | None, straight: bool) -> bool:
        """Whether a target is what is under the cursor already, looked at from where it is now if wires are to be straight there."""
        if target != self.target:
            return False
        return not straight or target is None or target.seen_along == self.target.seen_along

    def reset(self) -> None:
        """Forget which wires there were: those of another metric, or way of running, are others."""
        self.cancel()
        self.chosen, self.leading = None, 0

    def sow(self, seed: Seed, along: Along) -> None:
        """Let wires that run one way begin at a seed from here on. Raises ValueError where the seed is not part of the surface."""
        begin = for_live(seed.begins(along), along)
        self._drawing.engines.get(along).seed(begin, forward=seed.forward and along == "EDGES")

    def advance(self) -> str:
        """Bring the next wire forward; return why that cannot be, else nothing."""
        others = self.others
        if not others:
            if self.finals and not self._is_reached:
                return f"No wire reaches {pick_name(self.target.pick)}: it is not connected to the seed"
            same = self.final and self.active is not None
            return "All wires run along the same edges here" if same else "No other candidate found yet"
        self.chosen = next(at for at, wire in enumerate(self.wires) if wire is others[0])
        return ""

    @property
    def straight_active(self) -> bool:
        """Whether the wire that a click would keep is the one that is straight in the view."""
        return self._straight is not None and self.active is self._straight

    @property
    def _is_reached(self) -> bool:
        """Whether a wire leads to the target, or one may still be found."""
        return not self.final or any(self.wires)

    def _add_straight(self, begin: Pick, target: Snap) -> None:
        if target.seen_along is None:
            return
        live = self._drawing.engines.get("SURFACE")
        self._straight = straight_wire(live, begin, target.pick, target.seen_along, self.leading)
        if self._straight is not None:
            self.wires, self.finals = (*self.wires, self._straight), (*self.finals, True)
            self.leading, self.settled = len(self.wires) - 1, True

    def _along_edges(
        self, candidate: Candidate, follow: int, seed: Seed, target: Pick, avoid: int | None
    ) -> Wire | None:
        vertices = tuple(int(v) for v in candidate.vertices)
        if seed.forward:
            vertices = vertices[1:]  # the edge before the seed belongs to the wire before
        if avoid in vertices:
            vertices = vertices[: vertices.index(avoid) + 1]
        if len(vertices) < 2:
            return None
        heading = seed.pick if seed.forward and isinstance(seed.pick, tuple) else None
        points = self._drawing.points[list(vertices)]
        return Wire("EDGES", vertices, points, seed.place, target, heading=heading, follow=follow)

    # Clicks

    @property
    def computing(self) -> bool:
        """Whether the wires may still change."""
        return self._drawing.progress < 1.0 or not self.final

    @property
    def waits(self) -> bool:
        """Whether a click has to wait.

        It keeps the candidate that was shown. If none was shown yet, it does not keep one merely because that finished first.
        """
        return not (self.decided or (self.seen and self.active_final)) and self.computing

    def begun(self, target: Snap) -> Network:
        """Return the network with a new chain that begins at a target. Raises Refused if wires across the surface cannot begin there."""
        along = self._drawing.options.along
        if along == "SURFACE" and isinstance(target.pick, tuple):
            raise Refused(only_vertices(target.pick))
        network = replace(self._drawing.network, seed=None).joined(target, self._drawing.points)
        return replace(network, seed=network.seed_at(target, along))

    def commit(self) -> Committed:
        """Return the network with the active wire, or with a new chain if none is drawn."""
        network, options, target = self._drawing.network, self._drawing.options, self.target
        self._kept = False
        if target is None:
            return None
        if network.seed is None:
            return self.begun(target)
        if self.waits:
            return self
        wire = self.active
        if wire is None:
            if network.seed.at(target.pick, options.along):
                raise Refused("The wire ends where it begins: click somewhere else")
            raise Refused(self._message or f"No wire reaches {pick_name(target.pick)}: it is not connected to the seed")
        ending = self.ending(target)
        known = {edge for own in network.wires for edge in own.edges()}
        # The snapped edges of a wire that is cut tell nothing about where it runs.
        if ending is Intent.CLOSE and known.issuperset(wire.edges()) and not isinstance(wire.end, FacePoint):
            raise Refused("The way back runs along the chain itself: place another seed first")
        wire = replace(self._drawing.as_drawn(wire), alternatives=self.others if self.final else ())
        if not wire.leaves_trace:
            raise Refused("Too short to become a seam: click farther away")
        network = network.joined(target, self._drawing.points).with_drawn(wire, target.pick, ending is not None)
        self._kept = True
        return network

    def leaves_live(self, live: bool, target: Snap | None) -> bool:
        """Return whether the chain goes on, or a new one begins."""
        return not (live and target is not None and target.ends_chains)

    def ending(self, target: Snap) -> Intent | None:
        """Return how a wire to a target ends the chain, or None if the chain goes on."""
        if self._drawing.network.closes(target):
            return Intent.CLOSE
        return Intent.JOIN if target.ends_chains else None

    def cancel(self) -> None:
        """Show no wires. The pick under the cursor stays."""
        self.wires, self.finals, self.settled = (), (), True
        self._straight = None

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it."""
        return [self._drawing.engines.get(self._drawing.options.along)]


def across(candidate: Candidate, follow: int, begin: Pick, end: Pick) -> Wire | None:
    """Return the library's wire across the surface from one pick to another, or None."""
    vertices = tuple(int(v) for v in candidate.vertices)
    # Between points of one face there may be no edge to snap to.
    least = 1 if isinstance(begin, FacePoint) or isinstance(end, FacePoint) else 2
    if len(vertices) < least or len(candidate.points) < 2:
        return None
    points = np.array(candidate.points, dtype=np.float64)
    return Wire("SURFACE", vertices, points, begin, end, np.array(candidate.faces), follow=follow)


def _goal(target: Snap, network: Network, along: Along) -> tuple[Pick, int | None]:
    """Return where the wires to a target lead, and a vertex where they may end before."""
    if along == "EDGES" and isinstance(target.pick, tuple) and network.closes(target):
        # The chain left its first edge over one end: the wire that closes it arrives at the other.
        for wire, end in network.at(target.pick):
            if end == "start" and wire.heading is None:
                return wire.vertices[0], wire.vertices[1]
    return target.pick, None


def only_vertices(edge: Pick) -> str:
    """Say that wires across the surface do not end at edges."""
    return f"Wires across the surface need vertices or points of faces, not {pick_name(edge)}"


def straight_wire(live: LiveWire, begin: Pick, end: Pick, direction: Direction, follow: int) -> Wire | None:
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
