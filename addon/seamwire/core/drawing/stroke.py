# SPDX-License-Identifier: GPL-3.0-or-later
"""The stroke gesture: live wires follow or avoid a stroke from here on."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..network.strokes import Stroke, drawn, through_vertices
from ..network.wires import FOLLOWS
from .gesture import Gesture

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..network.strokes import ActsOn
    from .drawing import Drawing
    from .gesture import Committed
    from .wire import WireGesture


class StrokeGesture(Gesture):
    """A stroke that live wires follow or avoid. Kept wires stay as they are.

    Raises OffMeshError if the stroke does not lie on the mesh.

    Parameters
    ----------
    points, faces
        (n, 3) the points that a hand drew on the surface, and the triangle of each. They are smoothed a little.
    vertices
        (n,) the vertices that the stroke runs through, instead of both.
    acts_on
        The wires that it is meant for. If None, the active one while a wire is live, otherwise both.
    radius
        How far it reaches, in the points' units. If None, ten rings of vertices.
    """

    def __init__(
        self,
        drawing: Drawing,
        live: WireGesture,
        points: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        *,
        vertices: ArrayLike | None = None,
        attracts: bool = True,
        acts_on: ActsOn | None = None,
        radius: float | None = None,
    ) -> None:
        self._drawing = drawing
        if vertices is not None:
            course = through_vertices(vertices, drawing.points)
        elif points is None or faces is None:
            raise TypeError("neither points nor vertices")
        else:
            course = drawn(points, faces, drawing.points, drawing.triangles)
        self._live = live
        self._meant = acts_on
        self.stroke = Stroke(*course, acts_on=acts_on or "both", attracts=attracts, radius=radius)
        """The stroke, which is shown while it waits."""

    def commit(self) -> Committed:
        """Return the network with the stroke."""
        network, acts_on = self._drawing.network, self._meant
        # The wire that the stroke is for stays the active one, even if another is shorter now.
        self.keeps_active = self._live.chosen
        index = self._live.active_index
        # One that is straight in the view follows no stroke.
        follows = index < len(FOLLOWS) and not self._live.straight_active
        if acts_on is None and network.seed is not None and follows:
            self.keeps_active, acts_on = index, FOLLOWS[index]
        stroke = replace(self.stroke, acts_on=acts_on or "both")
        return replace(network, strokes=(*network.strokes, stroke))
