# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices slid onto curves, on meshes where it is known how far they may go."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from polygons import polygon_faces
from seamwire.core.seams.slide_plan import Move, SlidFaces, places, plan

SIZE = 9


def grid(height: NDArray[np.float64] | None = None, quads: bool = False) -> SlidFaces:
    """Return a grid with vertex y * SIZE + x at (x, y), of quads or of triangles from lower left to upper right."""
    x, y = np.meshgrid(np.arange(SIZE, dtype=float), np.arange(SIZE, dtype=float))
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(SIZE * SIZE) if height is None else height])
    squares = [
        [corner, corner + 1, corner + SIZE + 1, corner + SIZE]
        for corner in range(SIZE * (SIZE - 1))
        if corner % SIZE < SIZE - 1
    ]
    if quads:
        return polygon_faces(points, squares)
    return polygon_faces(points, [half for a, b, c, d in squares for half in ([a, b, c], [a, c, d])])


def straight(start: tuple[float, float], end: tuple[float, float]) -> NDArray[np.float64]:
    """Return a straight line over the flat grid, with points close enough for each two to share a triangle nearly."""
    parts = np.linspace(0.0, 1.0, 400)[:, None]
    line = np.array(start) * (1.0 - parts) + np.array(end) * parts
    return np.column_stack([line, np.zeros(len(line))])


LINE = straight((1, 2), (7, 6))
STAIRS = [19, 29, 30, 40, 50, 51, 61]  # along that line


def slid(mesh: SlidFaces, moves: dict[int, Move]) -> NDArray[np.float64]:
    """Return the vertices as they are then."""
    moved = mesh.points.copy()
    moved[list(moves)] = places(mesh.points, moves.values())
    return moved


@pytest.mark.parametrize("quads", [False, True])
def test_a_zigzag_becomes_the_line_and_the_ends_stay(quads: bool) -> None:
    mesh = grid(quads=quads)
    moves = plan(mesh, [(STAIRS, LINE)])
    moved = slid(mesh, moves)
    off = np.abs((moved[STAIRS, 1] - 2) * 6 - (moved[STAIRS, 0] - 1) * 4) / np.hypot(6, 4)
    assert off.max() < 1e-9
    assert np.array_equal(moved[STAIRS[0]], mesh.points[STAIRS[0]])
    assert np.array_equal(moved[STAIRS[-1]], mesh.points[STAIRS[-1]])
    others = np.setdiff1d(np.arange(len(moved)), STAIRS)
    assert np.array_equal(moved[others], mesh.points[others])
    along = moved[STAIRS, :2] @ np.array([6.0, 4.0])
    assert (np.diff(along) > 0).all(), "in order along the line"


def test_weights_are_those_of_the_place_in_a_polygon_around_the_vertex() -> None:
    mesh = grid()
    for vertex, move in plan(mesh, [(STAIRS, LINE)]).items():
        assert vertex in mesh.corners[move.polygon]
        assert set(move.corners) <= set(mesh.corners[move.polygon])
        assert sum(move.weights) == pytest.approx(1.0)
        assert min(move.weights) >= 0.0


def test_a_vertex_goes_anywhere_in_a_quad_beside_it_and_no_further() -> None:
    # To the right and below vertex 40, at (4, 4): in a quad beside it that its triangle covers half of, and past that.
    near, far = straight((4.2, 3.2), (4.9, 3.2)), straight((4.2, 2.8), (4.9, 2.8))
    chain = [32, 40, 48]
    assert 40 in plan(grid(quads=True), [(chain, near)])
    assert plan(grid(quads=True), [(chain, far)]) == {}


def test_the_border_and_what_is_fixed_stay() -> None:
    mesh = grid()
    border = [0, 1, 2, 3, 4]
    assert plan(mesh, [(border, straight((0, 0.3), (4, 0.3)))]) == {}
    moves = plan(mesh, [(STAIRS, LINE)], fixed=[29])
    assert 29 not in moves
    assert moves


@pytest.mark.parametrize("quads", [False, True])
def test_vertices_of_a_sharp_edge_stay(quads: bool) -> None:
    x = np.tile(np.arange(SIZE, dtype=float), SIZE)
    ridge = [4 + SIZE * y for y in range(1, SIZE - 1)]
    line = straight((4.3, 1), (4.3, 7))
    for slope, sharp in ((0.8, True), (0.1, False)):
        line[:, 2] = -slope * np.abs(line[:, 0] - 4)
        assert bool(plan(grid(-slope * np.abs(x - 4), quads), [(ridge, line)])) != sharp


@pytest.mark.parametrize("quads", [False, True])
def test_no_face_turns_over_or_gets_thin(quads: bool) -> None:
    # A curve so short that all of the chain would end up in one place.
    mesh = grid(quads=quads)
    curve = np.array([[3.9, 3.4, 0.0], [3.92, 3.41, 0.0], [3.95, 3.42, 0.0]])
    chain = [30, 31, 40, 41, 50]
    moves = plan(mesh, [(chain, curve)])
    assert moves
    moved = slid(mesh, moves)[:, :2]
    for polygon in {polygon for vertex in chain for polygon in mesh.at[vertex]}:
        rim = moved[list(mesh.corners[polygon])]
        u, v = rim - np.roll(rim, 1, axis=0), np.roll(rim, -1, axis=0) - rim
        assert (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).min() > 0.05


def test_where_two_curves_cross_is_where_their_vertex_goes() -> None:
    mesh = grid()
    across, up = [38, 39, 40, 41, 42], [22, 31, 40, 49, 58]
    courses = [(across, straight((2, 4.2), (6, 4.2))), (up, straight((4.3, 2), (4.3, 6)))]
    assert slid(mesh, plan(mesh, courses))[40] == pytest.approx([4.3, 4.2, 0.0], abs=1e-6)


def test_a_curve_elsewhere_moves_nothing() -> None:
    mesh = grid()
    assert plan(mesh, [(STAIRS, LINE + np.array([0.0, 0.0, 5.0]))]) == {}
    assert plan(mesh, []) == {}
