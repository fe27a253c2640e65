# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawn line: wires follow a line that is drawn by dragging, or a ridge or valley."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.refused import Refused
from ..network.network import Sought, linked, surface_vertex
from ..network.picks import vertices_of
from .courses import Course, Search
from .interaction import Begun, Edit, Interaction
from .line_wires import EdgeLine, SurfaceLine
from .wiring import only_vertices

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from ..network.network import How, Network, Seed, Snap
    from ..network.picks import Edge, Pick
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .board import Board


_TOO_SHORT = "Drag farther along the surface to draw a line"


class Lining(Interaction):
    """A line on the surface, and the wires that follow it. Raises Refused if no line across the surface can begin there.

    Parameters
    ----------
    begin
        The pick under the cursor at its beginning.
    goes_on
        Whether it continues the chain from the live wire's seed.
    apart
        Whether its wires belong to no chain, and leave the chain that is drawn unchanged.
    """

    def __init__(self, board: Board, begin: Snap, goes_on: bool = False, apart: bool = False) -> None:
        super().__init__(board)
        self._begin, self._goes_on, self._apart = begin, goes_on, apart
        self.line = self._begun(begin.pick, board.network.seed if goes_on else None)

    def _begun(self, pick: Pick, seed: Seed | None) -> EdgeLine | SurfaceLine:
        board = self._board
        if board.options.along == "SURFACE":
            if isinstance(pick, tuple):
                raise Refused(only_vertices(pick))
            place = pick if seed is None else surface_vertex(seed.pick)
            return SurfaceLine(board.engines, board.points, board.triangles, place, board.options.into_faces)
        vertex = pick if isinstance(pick, int) and not self._apart else None
        before: Edge | None = None
        if seed is not None:
            before = board.ground.heading(seed.after, seed.pick)
            vertex = vertices_of(before or seed.pick)[-1]
        return EdgeLine(board.engines, board.points, vertex, before)

    def draw(self, points: NDArray[np.float64], triangles: NDArray[np.int32], target: Snap | None) -> None:
        """Draw the line on: all its points, (k, 3), the triangle of each, (k,), and the pick under the cursor."""
        self.target = target
        if len(points):
            end = None if self.joined is None else self.joined.pick
            self.line.to(points, triangles, end, self._board.stops.kept(self._board.drawn))
        self.reason = self.line.message

    def poll(self) -> bool:
        before = self.line.wires
        self.line.poll()
        self.reason = self.line.message
        return before is not self.line.wires

    def lives(self) -> Sequence[LiveWire]:
        return self.line.lives()

    @property
    def joined(self) -> Snap | None:
        """The pick under the cursor if a chain would end there, otherwise None."""
        return self.target if self.target is not None and self.target.ends_chains else None

    def keep(self) -> Edit:
        board, line = self._board, self.line
        line.finish()
        how = board.how(board.options.along)
        is_done = line.poll()
        if is_done and not line.wires:
            none = "No wire fits this line: draw closer to the surface" if self._apart else _TOO_SHORT
            raise Refused(line.message or none)
        if is_done:
            self.warn()
        wires = tuple(map(how.of, line.wires))
        ends = line.ends
        if self._apart:
            return self._added(board.base, ends, wires, is_done, None, False)
        network = board.base
        for pick in ends:
            network = self._with_seed_at(network, pick)
        seed = network.seed if self._goes_on else None
        start, end = ends
        if seed is not None:
            start = seed.pick if board.options.along == "EDGES" else surface_vertex(seed.pick)
            wires = (replace(wires[0], start=start), *wires[1:]) if wires else ()
        stays = seed is not None and not self._ends_chain(end, seed)
        return self._added(network, (start, end), wires, is_done, seed, stays)

    def warn(self) -> None:
        if self.line.message:
            self._board.tell(self.line.message)

    def _added(
        self,
        network: Network,
        ends: tuple[Pick, Pick],
        wires: tuple[Wire, ...],
        is_done: bool,
        seed: Seed | None,
        stays: bool,
    ) -> Edit:
        """Return the edit with the line's wires, or with a request that finds them. The chain goes on from its end if it `stays`."""
        along = self._board.options.along
        link = None if seed is None or along == "SURFACE" else seed.after
        begun: tuple[Begun, ...] = ()
        if is_done:
            first, *rest = linked(wires)
            new = (first if link is None else replace(first, goes_on=link), *rest)
            last = wires[-1].id
        else:
            request = Sought(along=along, start=ends[0], end=ends[1], goes_on=link, what="line")
            search = _search_line(self, self._board.how(along), request)
            new, last = (request,), request.id
            shown = tuple(replace(wire, id=request.id) for wire in wires[:1]) + wires[1:]
            begun = (Begun(request, Course(shown), search),)
        after = network.adding(*new)
        if self._apart:
            return Edit(after, begun)
        if not stays or seed is None:
            return Edit(replace(after, seed=None), begun)
        going = (last, "end") if along == "EDGES" else None
        return Edit(replace(after, seed=replace(seed, pick=ends[1], after=going, first=seed.began)), begun)

    def _with_seed_at(self, network: Network, pick: Pick) -> Network:
        """Return a network with a seed where the line meets one of its wires."""
        board = self._board
        for snap in (self._begin, self.target):
            if snap is not None and snap.to == "WIRE" and pick in (snap.pick, *vertices_of(snap.pick)):
                network = network.joined(replace(snap, pick=pick), board.points, board.is_final)
        for own in network.requests if isinstance(pick, int) else ():
            wire = board.wire_of(own)
            if wire is not None and wire.along == "EDGES" and not wire.closed and pick in wire.vertices[1:-1]:
                network = network.with_seed_in(wire, pick, board.points, board.is_final(own)) or network
        return network

    def _ends_chain(self, end: Pick, seed: Seed) -> bool:
        """Whether a line that went on from a chain ends that: on a seed, a wire or a seam, the chain's first seed too."""
        if self.joined is not None or end == seed.began:
            return True
        return isinstance(end, int) and bool(np.isin(end, self._board.stops.kept(self._board.drawn)))


def _search_line(own: Lining, how: How, request: Sought) -> Search:
    """Find the wires that follow a released line."""

    def courses() -> Iterator[Course]:
        while True:
            is_done = own.line.poll()
            wires = tuple(map(how.of, own.line.wires))
            if is_done and not wires:
                raise Refused(own.line.message or _TOO_SHORT)
            if wires:
                wires = (replace(wires[0], id=request.id, start=request.start), *wires[1:])
            if is_done:
                own.warn()
            yield Course(wires, final=is_done)

    return Search(courses(), own.lives)
