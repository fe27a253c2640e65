# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension: the live wire runs straight on until it meets a seam, a wire, the boundary, the mirror or itself."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..network.wires import Wire
from .gesture import Gesture

if TYPE_CHECKING:
    from ..network.network import Snap
    from .drawing import Drawing
    from .gesture import Committed
    from .wire import WireGesture


class Extension(Gesture):
    """The live wire with its way to the end. Along edges only."""

    def __init__(self, drawing: Drawing, live: WireGesture) -> None:
        self._drawing = drawing
        self._live = live
        self.wanted = False
        """Whether it is asked for."""
        self.wire: Wire | None = None
        """The extended wire that is shown."""
        self.message = ""
        """Why there is no way to the end, if that is known."""

    def aim(self, target: Snap | None) -> str:
        """Return why no wire can run to an end. The way does not depend on the target."""
        if self._drawing.network.seed is None:
            return "Nothing to extend: place a seed first"
        return (
            "Extend to End works along edges, not across the surface"
            if self._drawing.options.along == "SURFACE"
            else ""
        )

    def poll(self) -> bool:
        """Show the extended wire while it is asked for. Return whether it runs elsewhere than before."""
        if not self.wanted:
            return False
        before, self.wire = self.wire, self._find()
        if before is None or self.wire is None:
            return before is not self.wire
        return not before.like(self.wire)

    def commit(self) -> Committed:
        """Return the network with the extended wire, which ends the chain."""
        if self._live.target is not None and self._live.waits:
            self.wanted = False
            return self
        wire = self._find()
        if wire is None:
            raise Refused(self.message or "The wire cannot be extended from here")
        return replace(self._drawing.with_wires(wire), seed=None)

    def leaves_live(self, live: bool, target: Snap | None) -> bool:
        """Return False, because the chain ends there."""
        return False

    def cancel(self) -> None:
        """Show nothing, and ask for nothing."""
        self.wanted, self.wire = False, None

    def _find(self) -> Wire | None:
        """Return the live wire, or the seed, with its way to the end, or None if there is no way or no direction."""
        drawing, active = self._drawing, self._live.active
        network, seed = drawing.network, drawing.network.seed
        self.message = ""
        if seed is None:
            return None
        if active is not None:
            edge = active.last_edge
        elif seed.forward and isinstance(seed.pick, tuple):
            edge = seed.pick
        else:
            self.message = "Point at where the wire should run"
            return None
        stops = drawing.stops.of(network, active, edge[1:])
        try:
            way = drawing.engines.get("EDGES").extend_straight(edge, stops[stops != edge[1]])
        except ValueError as error:  # the edge is not part of the surface
            self.message = str(error)
            return None
        vertices, heading = tuple(int(vertex) for vertex in way.vertices), edge
        if len(vertices) < 2:
            return None
        if active is not None:
            vertices, heading = active.vertices + vertices[1:], active.heading
        return Wire(
            "EDGES",
            vertices,
            drawing.points[list(vertices)],
            seed.place,
            vertices[-1],
            marks=drawing.options.marking,
            mirror=network.mirror,
            heading=heading,
            strength=drawing.engines.strengths["EDGES"],
        )
