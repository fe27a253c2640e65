# SPDX-License-Identifier: GPL-3.0-or-later
"""What the parts of a session are made with, on a grid of SIZE x SIZE vertices; vertex y * SIZE + x lies at (x, y)."""

from __future__ import annotations

from fake_live import FakeLive, grid_edges, grid_points, grid_triangles
from seamwire.core.drawing.drawing import Drawing
from seamwire.core.network.network import Network
from seamwire.core.network.symmetry import Symmetry
from seamwire.core.network.wires import Wire
from seamwire.core.solver.solver import Engines
from seamwire.terms.choices import Along

SIZE = 6
POINTS = grid_points(SIZE)


class Grid:
    """Engines on a grid, with the live wires they have made."""

    def __init__(self, **options: object) -> None:
        self.lives: dict[str, FakeLive] = {}

        def make(way: Along) -> FakeLive:
            self.lives[way] = FakeLive(SIZE, way, **options)
            return self.lives[way]

        self.engines = Engines(make, lambda stroke: stroke)
        self.make = make

    def drawing(self, network: Network, seams: list[tuple[int, int]] = ()) -> Drawing:
        """Return a drawing with a network, on the grid with its middle at the origin."""
        points = POINTS.copy()
        points[:, :2] -= (SIZE - 1) / 2
        drawing = Drawing(
            self.make,
            points,
            edges=grid_edges(SIZE),
            triangles=grid_triangles(SIZE),
            seams=seams,
            make_stroke=lambda stroke: stroke,
        )
        drawing.network = network
        return drawing


def wire(*vertices: int, **options: object) -> Wire:
    """Return a wire along edges."""
    return Wire("EDGES", vertices, POINTS[list(vertices)], vertices[0], vertices[-1], **options)


def symmetry() -> Symmetry:
    """Return the symmetry of a grid with its middle at the origin."""
    points = POINTS.copy()
    points[:, :2] -= (SIZE - 1) / 2
    return Symmetry(points, grid_edges(SIZE))
