# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires that follow a line while it is drawn over the surface, and what is kept of them when it is done."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from ..network.picks import FacePoint
from ..network.wires import Wire
from ..seams.seam_wires import wires_along
from ..solver.solver import by_number, for_live
from .ways import across

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from ..network.picks import Edge, Pick
    from ..solver.solver import Candidates, Engines, LiveWire

_MOST_EDGES = 200
"""A chain that is longer stays as it is but for this many edges at its end: so the next move takes no longer than the one before."""
_LEAVES_EDGES = 100
"""How many edges of a chain that has become longer than that go on being fitted."""
_TOLERANCE = 8.0 / 3.0
"""How far wires may be from the line, as part of the median step from one of its points to the next, which are three pixels apart..."""
_TOLERANCE_SIDES = 0.5, 0.8
"""...or, if that is more, as part of the median side of its triangles: for wires that end inside triangles, at vertices."""
_NEAR_VERTEX = 0.35
"""How far from the line a vertex may be where a wire ends on the way, as part of the same."""
_SAMPLES = 96
"""Places of a line that its distance from a wire is measured at."""
_STEP = 4
"""Points of the line between which no other place for a seed is looked for."""
_SLICE = 0.004
"""Seconds between two times that others get a turn."""


class EdgeLine:
    """A line whose wires run along edges: while it is drawn, the one chain that fits it; then as few wires as reproduce that.

    Parameters
    ----------
    mesh
        (n, 3) vertices.
    begin
        The vertex where it begins; None: the one nearest to it.
    before
        The directed edge of a wire that it goes on from.

    Attributes
    ----------
    points
        (k, 3) the line so far.
    wires
        The wires that follow it, as far as they are known.
    message
        Why they do not follow all of it, or an empty message.
    """

    def __init__(self, engines: Engines, mesh: NDArray[np.float64], begin: int | None, before: Edge | None) -> None:
        self._live = engines.get("EDGES")
        self._fork: LiveWire | None = None
        self._engines = engines
        self._mesh = mesh
        self._begin = begin
        self._before = before
        self._fixed: list[int] = []
        self._from = 0
        # A part of the line may have been drawn before the mesh's edges were known.
        self._early: tuple[NDArray[np.float64], NDArray[np.int32], Pick | None, NDArray[np.int64]] | None = None
        self._finished = False
        self._ready: list[Wire] = []
        self._making: Iterator[Wire | None] | None = None
        self.points = np.empty((0, 3))
        self.wires: tuple[Wire, ...] = ()
        self.message = ""

    def to(
        self, points: NDArray[np.float64], triangles: NDArray[np.int32], end: Pick | None, stops: NDArray[np.int64]
    ) -> None:
        """Fit the chain to what is drawn by now.

        Parameters
        ----------
        points
            (k, 3) all of the line. The points before are the same.
        triangles
            (k,) the triangle that each point lies in.
        end
            Where it ends on the network or on a seam. None: it ends elsewhere.
        stops
            The vertices of seams and kept wires, in rising order.
        """
        self.points = points
        self._early = (points, triangles, end, stops) if self._live.progress() < 1.0 else None
        begin = self._fixed[-1] if self._fixed else self._begin
        at = slice(self._from, None)
        try:
            fitted = self._live.fit_chain(points[at], triangles[at], begin, self._nearest_of(end, points[-1]))
        except ValueError as error:
            self.message = str(error)
            return
        chain, places = fitted.vertices.tolist(), fitted.places
        if end is None:
            chain = _without_overshoot(chain, stops)
        if len(chain) > _MOST_EDGES:
            cut = len(chain) - 1 - _LEAVES_EDGES
            self._fixed += chain[1 if self._fixed else 0 : cut + 1]
            self._from += int(places[cut])
            chain = chain[cut:]
        head = list(self._fixed)
        while len(head) > 1 and len(chain) > 1 and chain[1] == head[-2]:  # the hand goes back
            head.pop()
            chain = chain[1:]
        chain = [*head[:-1], *chain] if chain else head
        self.wires = (self._wire(chain),) if len(chain) > 1 else ()

    def _nearest_of(self, end: Pick | None, place: NDArray[np.float64]) -> int | None:
        if isinstance(end, FacePoint):
            return end.vertex
        if isinstance(end, tuple):
            return min(end, key=lambda vertex: float(np.linalg.norm(self._mesh[vertex] - place)))
        return end

    def _wire(self, chain: list[int]) -> Wire:
        return Wire("EDGES", tuple(chain), self._mesh[chain], chain[0], chain[-1], heading=self._before)

    @property
    def ends(self) -> tuple[Pick, Pick]:
        """Where it begins and ends, as far as it is known."""
        if self.wires:
            return self.wires[0].start, self.wires[-1].end
        begin = -1 if self._begin is None else self._begin
        return begin, begin

    def finish(self) -> None:
        """Let `poll` look for the fewest wires that reproduce the chain."""
        self._finished = True

    def poll(self) -> bool:
        """Go on with that for a moment; return whether it is done."""
        if not self.wires and self._early is not None:
            self.to(*self._early)
            if not self.wires and self._early is not None:
                return False
        if not self._finished or not self.wires:
            return True
        if self._making is None:
            self._fork = self._live.fork()
            chain, strength = list(self.wires[0].vertices), self._engines.strengths["EDGES"]
            self._making = wires_along(self._fork, chain, self._mesh, strength, self._before)
        end = time.monotonic() + _SLICE
        for wire in self._making:
            if wire is not None:
                self._ready.append(wire)
            if wire is None or time.monotonic() > end:
                return False
        self.wires = tuple(self._ready)
        return True

    def lives(self) -> list[LiveWire]:
        return [] if self._fork is None else [self._fork]


def _without_overshoot(chain: list[int], stops: NDArray[np.int64]) -> list[int]:
    """Return a chain without its last edge where that alone leads on from a seam, or a wire, that the chain has come to."""
    if len(chain) < 3:
        return chain
    before, at, last = np.isin(chain[-3:], stops).tolist()
    return chain[:-1] if at and not before and not last else chain


class SurfaceLine:
    """A line whose wires run across the surface, each as far as one keeps near to the line, and going on where that ended.

    Its attributes and methods are those of `EdgeLine`. Unless `anywhere`, wires begin and end at vertices.
    """

    def __init__(
        self,
        engines: Engines,
        mesh: NDArray[np.float64],
        triangles: NDArray[np.int32],
        begin: Pick,
        anywhere: bool,
    ) -> None:
        self._mesh = mesh
        self._triangles = triangles
        self._anywhere = anywhere
        self._live = engines.get("SURFACE").fork()
        self._picks: list[tuple[Pick, int]] = [(begin, 0)]  # where a wire may end, and which point of the line that is
        self._taken = 0
        self._near = True  # whether the last of them is one where a wire may end that goes on
        self._ended: Pick | None = None
        self._anchor = 0
        self._good: tuple[int, Wire] | None = None
        self._bad: tuple[int, Wire | None] | None = None
        self._legs: list[Wire] = []
        self._tolerance = 0.0
        self._finished = False
        self.points = np.empty((0, 3))
        self.wires: tuple[Wire, ...] = ()
        self.message = ""
        self._live.seed(for_live(begin, "SURFACE"))

    def to(
        self, points: NDArray[np.float64], triangles: NDArray[np.int32], end: Pick | None, stops: NDArray[np.int64]
    ) -> None:
        del stops  # what wires across the surface snap to is told by `end` alone
        self.points = points
        if len(points) > 1:
            steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
            corners = self._mesh[self._triangles[triangles]]
            sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
            side = float(np.median(sides))
            self._tolerance = max(_TOLERANCE * float(np.median(steps)), _TOLERANCE_SIDES[not self._anywhere] * side)
            for number in range(self._taken, len(points)):
                self._add(number, points[number], int(triangles[number]), _NEAR_VERTEX * side)
            self._taken = len(points)
        self._ended = end
        self.poll()

    def _add(self, number: int, place: NDArray[np.float64], triangle: int, reach: float) -> None:
        """Let wires end at a point of the line, or, at vertices alone, at the one beside it: on the way where that is near."""
        point = FacePoint.at(place, triangle, self._triangles, self._mesh)
        pick: Pick = point if self._anywhere else point.vertex
        near = self._anywhere or float(np.linalg.norm(self._mesh[point.vertex] - place)) <= reach
        if pick == self._picks[-1][0]:
            self._near |= near
            return
        if not self._near and len(self._picks) - 1 > self._anchor:
            self._replace_last(pick, number)
        else:
            self._picks.append((pick, number))
        self._near = near

    def _replace_last(self, pick: Pick, number: int) -> None:
        last = len(self._picks) - 1
        self._picks[last] = pick, number
        if self._good is not None and self._good[0] == last:
            self._good = None
        if self._bad is not None and self._bad[0] == last:
            self._bad = None

    @property
    def ends(self) -> tuple[Pick, Pick]:
        """Where it begins and ends. Until it is done, the end is where the line leads."""
        is_done = self._anchor == len(self._picks) - 1
        return self._picks[0][0], self.wires[-1].end if is_done and self.wires else self._picks[-1][0]

    def finish(self) -> None:
        """Lead the wires to the line's end."""
        if self._ended is not None and self._ended != self._picks[-1][0]:
            if len(self._picks) - 1 == self._anchor:
                self._picks.append((self._ended, len(self.points) - 1))
            self._replace_last(self._ended, len(self.points) - 1)
        self._finished = True

    def poll(self) -> bool:
        """Lead the wires on; return whether they have come to the end of the line."""
        while self._anchor < len(self._picks) - 1 and not self.message:
            goal = self._goal()
            if goal is None and self._bad is None and not self._finished:
                break  # the hand may lead it on
            try:
                if goal is None:
                    if not self._refine():
                        return False
                    if not self._take():
                        break
                    continue
                found = self._live.wires(for_live(self._picks[goal][0], "SURFACE"))
            except ValueError as error:
                self.message = str(error)
                break
            wire, fits = self._nearest(found, goal)
            if not found.solved:
                self._show(wire)
                return False
            if fits and wire is not None:
                self._good = goal, wire
            else:
                self._bad = goal, wire
        self._show(None)
        return True

    def _goal(self) -> int | None:
        """Return where to look for a wire to next; None: it is known how far this one can go."""
        last = len(self._picks) - 1
        good = self._anchor if self._good is None else self._good[0]
        if self._bad is None:
            return last if good < last else None
        between = (good + self._bad[0]) // 2
        step = _STEP if self._anywhere else 1
        return between if self._bad[0] - good > step and between > good else None

    def _farthest(self) -> tuple[int, Wire | None]:
        """Return the wire that goes farthest, and where. If even the next place is too far off, a wire there is better than none."""
        return self._good or self._bad or (self._anchor, None)

    def _refine(self) -> bool:
        """Make the wire that goes farthest final; return whether it is."""
        number, wire = self._farthest()
        if wire is None:
            return True
        found = self._live.wires(for_live(self._picks[number][0], "SURFACE"))
        if not found.final:
            return False
        wires, _ = by_number(found)
        final = across(wires[wire.follow], wire.follow, self._picks[self._anchor][0], self._picks[number][0])
        self._good = number, final or wire
        return True

    def _take(self) -> bool:
        """Keep the wire that goes farthest, and go on from its end; return whether there is more to do."""
        number, wire = self._farthest()
        if wire is None:
            self.message = "No wire fits the rest of the line"
            return False
        self._legs.append(wire)
        self._anchor, self._good, self._bad = number, None, None
        if number < len(self._picks) - 1:
            self._live.seed(for_live(self._picks[number][0], "SURFACE"))
        return True

    def _nearest(self, found: Candidates, goal: int) -> tuple[Wire | None, bool]:
        """Return the first wire offered that keeps near to the line, else the nearest one; and whether it does."""
        best: tuple[float, Wire] | None = None
        wires, leading = by_number(found)
        for follow in sorted(range(len(wires)), key=lambda follow: follow != leading):
            wire = across(wires[follow], follow, self._picks[self._anchor][0], self._picks[goal][0])
            if wire is None:
                continue
            off = _apart(wire.points, self.points[self._picks[self._anchor][1] : self._picks[goal][1] + 1])
            if off <= self._tolerance:
                return wire, True
            if best is None or off < best[0]:
                best = off, wire
        return (None, False) if best is None else (best[1], False)

    def _show(self, live: Wire | None) -> None:
        """Let all be seen that there is: what is kept of the line, and the wire from there on."""
        if live is None and self._good is not None:
            live = self._good[1]
        self.wires = (*self._legs, live) if live is not None else tuple(self._legs)

    def lives(self) -> list[LiveWire]:
        return [self._live]


def _apart(curve: NDArray[np.float64], line: NDArray[np.float64]) -> float:
    """Return how far a curve is from a line at most, and the line from the curve; (k, 3) each."""
    curve, line = _thinned(curve), _thinned(line)
    return max(_farthest(curve, line), _farthest(line, curve))


def _farthest(points: NDArray[np.float64], curve: NDArray[np.float64]) -> float:
    """Return how far the one of (k, 3) points is from a curve, (l, 3), that is farthest."""
    starts = curve[:-1] if len(curve) > 1 else curve
    along = curve[1:] - curve[:-1] if len(curve) > 1 else np.zeros_like(curve)
    square = np.einsum("ij,ij->i", along, along)
    to = points[:, None] - starts
    part = np.clip(np.einsum("kij,ij->ki", to, along) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return float(np.linalg.norm(to - part[..., None] * along, axis=2).min(axis=1).max())


def _thinned(curve: NDArray[np.float64]) -> NDArray[np.float64]:
    if len(curve) <= _SAMPLES:
        return curve
    return curve[np.linspace(0, len(curve) - 1, _SAMPLES).round().astype(int)]
