# SPDX-License-Identifier: GPL-3.0-or-later
"""The line gesture: wires follow a line that is drawn by dragging, or a ridge or valley."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.refused import Refused
from ..network.picks import vertices_of
from .gesture import Gesture
from .line_wires import EdgeLine, SurfaceLine
from .wire import only_vertices

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.network import Network, Seed, Snap
    from ..network.picks import Edge, Pick
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Committed


class LineGesture(Gesture):
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

    def __init__(self, drawing: Drawing, begin: Snap, goes_on: bool = False, apart: bool = False) -> None:
        self._drawing = drawing
        self.begin = begin
        self._goes_on = goes_on
        self._apart = apart
        self.end: Snap | None = None
        """The pick under the cursor at its current end."""
        self.line = self._begun(begin.pick, drawing.network.seed if goes_on else None)
        """The line itself, with the wires that follow it."""

    def _begun(self, pick: Pick, seed: Seed | None) -> EdgeLine | SurfaceLine:
        """Return a line from a pick, or from the live wire's seed."""
        drawing = self._drawing
        if drawing.options.along == "SURFACE":
            if isinstance(pick, tuple):
                raise Refused(only_vertices(pick))
            place = pick if seed is None else seed.begins("SURFACE")
            return SurfaceLine(drawing.engines, drawing.points, drawing.triangles, place, drawing.options.into_faces)
        vertex = pick if isinstance(pick, int) and not self._apart else None
        before: Edge | None = None
        if seed is not None:
            vertex = seed.vertex
            before = seed.pick if seed.forward and isinstance(seed.pick, tuple) else None
        return EdgeLine(drawing.engines, drawing.points, vertex, before)

    def take_warning(self) -> str:
        """Return why wires do not follow the whole line, or a warning about triangles that they must lead around."""
        return self.line.message or self._drawing.engines.warning(self._drawing.options.along)

    def draw(self, points: NDArray[np.float64], triangles: NDArray[np.int32], target: Snap | None) -> None:
        """Draw the line on: all its points, (k, 3), the triangle of each, (k,), and the pick under the cursor."""
        self.end = target
        if len(points):
            end = None if self.joined is None else self.joined.pick
            self.line.to(points, triangles, end, self._drawing.stops.kept(self._drawing.network))

    def poll(self) -> bool:
        """Take in the wires that were computed. Return whether there are others now."""
        before = self.line.wires
        self.line.poll()
        return before is not self.line.wires

    def commit(self) -> Committed:
        """Return the network with the wires that follow the line."""
        if not self.line.poll():
            return self
        wires = tuple(self._drawing.as_drawn(wire) for wire in self.line.wires)
        if not wires:
            none = (
                "No wire fits this line: draw closer to the surface"
                if self._apart
                else "Drag farther along the surface to draw a line"
            )
            raise Refused(self.line.message or none)
        return self._kept(wires)

    def leaves_live(self, live: bool, target: Snap | None) -> bool:
        """Return whether a chain goes on from the line's end, or was left unchanged."""
        return live and (self._apart or (self._goes_on and self.joined is None))

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it."""
        return self.line.lives()

    @property
    def joined(self) -> Snap | None:
        """The pick under the cursor if a chain would end there, otherwise None."""
        return self.end if self.end is not None and self.end.ends_chains else None

    def _kept(self, wires: tuple[Wire, ...]) -> Network:
        """Return the network with the line's wires, joined to those that it meets."""
        network = self._drawing.network
        if self._apart:
            return self._drawing.with_wires(*wires)
        for pick in (wires[0].start, wires[-1].end):
            network = self._with_seed_at(network, pick)
        seed = network.seed if self._goes_on else None
        if seed is not None:
            wires = (replace(wires[0], start=seed.shown(wires[0].along)), *wires[1:])
        ends = seed is None or self._ends_chain(network, wires[-1].end, seed)
        for number, wire in enumerate(wires):
            network = network.with_drawn(wire, wire.end, ends and number == len(wires) - 1)
        return replace(network, seed=None) if ends else network

    def _with_seed_at(self, network: Network, pick: Pick) -> Network:
        """Return a network with a seed where the line meets one of its wires."""
        points = self._drawing.points
        for snap in (self.begin, self.end):
            if snap is not None and snap.to == "WIRE" and pick in (snap.pick, *vertices_of(snap.pick)):
                network = network.joined(replace(snap, pick=pick), points)
        if isinstance(pick, int):
            for wire in network.wires:
                if wire.along == "EDGES" and not wire.closed and pick in wire.vertices[1:-1]:
                    network = network.with_seed_in(wire, pick, points) or network
        return network

    def _ends_chain(self, network: Network, end: Pick, seed: Seed) -> bool:
        """Whether a line that went on from a chain ends that: on a seed, a wire or a seam, the chain's first seed too."""
        if self.joined is not None or end == seed.began:
            return True
        return isinstance(end, int) and bool(np.isin(end, self._drawing.stops.kept(network)))
