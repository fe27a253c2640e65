# SPDX-License-Identifier: GPL-3.0-or-later
"""A session on a grid, with the live wires it has made, and wires and symmetry there."""

from __future__ import annotations

import itertools

import numpy as np
from fake_live import FakeLive, grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from paper_mesh import PaperMesh
from seamwire.core.network.symmetry import Symmetry
from seamwire.core.network.wires import Wire
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from seamwire.terms.options import Options

SIZE = 6
POINTS = grid_points(SIZE)


def centred_points(size: int = SIZE) -> NDArray[np.float64]:
    """Return the vertices of a grid with its middle at the origin."""
    return grid_points(size) - [(size - 1) / 2, (size - 1) / 2, 0.0]


class Table:
    """A session on a grid of SIZE x SIZE vertices; vertex y * SIZE + x lies at (x, y), from the middle if `centred`."""

    def __init__(
        self, along: Along = "EDGES", seams: list[tuple[int, int]] = (), centred: bool = False, **options: object
    ) -> None:
        self.lives: dict[str, FakeLive] = {}

        def make(way: Along) -> FakeLive:
            self.lives[way] = FakeLive(SIZE, way, **options)
            return self.lives[way]

        self.points = centred_points() if centred else grid_points(SIZE)
        self.session = Sketch(
            make,
            self.points,
            Options(along=along),
            edges=grid_edges(SIZE),
            seams=seams,
            triangles=grid_triangles(SIZE),
            make_stroke=lambda one: one,
        )

    def compute(self) -> None:
        """Let all live wires be ready, and take it in."""
        left = list(self.lives.values())
        while left:
            live = left.pop()
            live.ready = (True,) * len(live.ready)
            left += live.forks
        for _ in range(2):  # what was found may be where something else begins
            self.session.poll()


def paper(centred: bool = False, **options: object) -> PaperMesh:
    """Return the mesh of a table."""
    return PaperMesh(
        centred_points() if centred else grid_points(SIZE), grid_edges(SIZE), triangles=grid_triangles(SIZE), **options
    )


def chain(*vertices: int) -> list[tuple[int, int]]:
    """Return the edges along vertices, sorted, smaller vertex first."""
    return sorted((min(a, b), max(a, b)) for a, b in itertools.pairwise(vertices))


def corner(**options: object) -> Table:
    """A chain 0 - 3 - 21, from the left along the bottom and up."""
    table = Table(**options)
    for pick in (0, 3, 21):
        table.session.click(pick)
    return table


def courses(session: Sketch) -> list[tuple[int, ...]]:
    return [wire.vertices for wire in session.wires]


def wire(*vertices: int, closed: bool = False, points: NDArray[np.float64] = POINTS, **options: object) -> Wire:
    """Return a wire along edges of a table, or of other points."""
    around = vertices + vertices[:1] if closed else vertices
    ends = {"start": around[0], "end": around[-1], **options}
    return Wire("EDGES", vertices, points[list(around)], closed=closed, **ends)


def symmetry() -> Symmetry:
    """Return the symmetry of a table from the middle."""
    return Symmetry(centred_points(), grid_edges(SIZE))
