# SPDX-License-Identifier: GPL-3.0-or-later
"""A session on a grid, with the live wires it has made."""

from __future__ import annotations

import itertools

from fake_live import FakeLive, grid_edges, grid_points, grid_triangles
from paper_mesh import PaperMesh
from seamwire.core.drawing.drawing import Drawing
from seamwire.core.drawing.session import Session
from seamwire.terms.choices import Along
from seamwire.terms.options import Options

SIZE = 6


class Table:
    """A session on a grid of SIZE x SIZE vertices; vertex y * SIZE + x lies at (x, y), from the middle if `centred`."""

    def __init__(
        self, along: Along = "EDGES", seams: list[tuple[int, int]] = (), centred: bool = False, **options: object
    ) -> None:
        self.lives: dict[str, FakeLive] = {}

        def make(way: Along) -> FakeLive:
            self.lives[way] = FakeLive(SIZE, way, **options)
            return self.lives[way]

        self.points = grid_points(SIZE)
        if centred:
            self.points[:, :2] -= (SIZE - 1) / 2
        self.session = Session(
            Drawing(
                make,
                self.points,
                Options(along=along),
                edges=grid_edges(SIZE),
                seams=seams,
                triangles=grid_triangles(SIZE),
                make_stroke=lambda one: one,
            )
        )

    def compute(self) -> None:
        """Let all live wires be ready, and take it in."""
        for live in self.lives.values():
            for one in (live, *live.forks):
                one.ready = (True,) * len(one.ready)
        self.session.poll()


def paper(centred: bool = False, **options: object) -> PaperMesh:
    """Return the mesh of a table."""
    points = grid_points(SIZE)
    if centred:
        points[:, :2] -= (SIZE - 1) / 2
    return PaperMesh(points, grid_edges(SIZE), triangles=grid_triangles(SIZE), **options)


def chain(*vertices: int) -> list[tuple[int, int]]:
    """Return the edges along vertices, sorted, smaller vertex first."""
    return sorted((min(a, b), max(a, b)) for a, b in itertools.pairwise(vertices))


def corner(**options: object) -> Table:
    """A chain 0 - 3 - 21, from the left along the bottom and up."""
    table = Table(**options)
    for pick in (0, 3, 21):
        table.session.click(pick)
    return table


def courses(session: Session) -> list[tuple[int, ...]]:
    return [wire.vertices for wire in session.wires]
