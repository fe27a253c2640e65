# SPDX-License-Identifier: GPL-3.0-or-later
"""How chains turn within the surface, and which are hairpins."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from polygon_meshes import arrays_of
from seamwire.core.offers.turns import SurfaceEdges

SIZE = 9
"""Vertices along a side of the sheet; vertex SIZE * row + column."""


def sheet() -> SurfaceEdges:
    return SurfaceEdges(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))


def box(left: int, low: int, width: int, height: int) -> list[int]:
    """Return the vertices around a box of faces, counterclockwise."""
    right, top = left + width, low + height
    around = [(x, low) for x in range(left, right)] + [(right, y) for y in range(low, top)]
    around += [(x, top) for x in range(right, left, -1)] + [(left, y) for y in range(top, low, -1)]
    return [SIZE * y + x for x, y in around]


def test_a_box_on_a_sheet_turns_by_a_right_angle_at_each_corner() -> None:
    turns = np.degrees(sheet().turns(box(2, 2, 3, 2)))
    assert turns.tolist() == pytest.approx([90, 0, 0, 90, 0, 90, 0, 0, 90, 0])
    back = np.degrees(sheet().turns(box(2, 2, 3, 2)[::-1]))
    assert back.sum() == pytest.approx(-360.0)


def test_along_a_boundary_a_chain_goes_straight_and_from_it_it_turns() -> None:
    assert sheet().turns(box(0, 0, SIZE - 1, SIZE - 1)).tolist() == [0.0] * (4 * (SIZE - 1))
    turns = np.degrees(sheet().turns(box(2, 0, 3, 2)))
    assert turns.tolist() == pytest.approx([90, 0, 0, 90, 0, 90, 0, 0, 90, 0])


def test_a_ring_over_the_rims_of_a_thin_plate_goes_straight_on() -> None:
    corners = [(x, y, z) for x in (0.0, 8.0) for y in (0.0, 4.0, 8.0) for z in (0.0, 0.1)]
    number = {corner: i for i, corner in enumerate(corners)}
    quads = []
    for low, high in ((0.0, 4.0), (4.0, 8.0)):
        ring = [(0.0, 0.0), (0.0, 0.1), (8.0, 0.1), (8.0, 0.0)]
        for (x, z), (to_x, to_z) in zip(ring, ring[1:] + ring[:1], strict=True):
            quads.append([number[x, low, z], number[x, high, z], number[to_x, high, to_z], number[to_x, low, to_z]])
    arrays = arrays_of(corners, quads)
    plate = SurfaceEdges(arrays.points, arrays.triangles, arrays.edges)
    ring = [number[corner] for corner in ((0.0, 4.0, 0.0), (0.0, 4.0, 0.1), (8.0, 4.0, 0.1), (8.0, 4.0, 0.0))]
    assert np.degrees(plate.turns(ring)).tolist() == pytest.approx([0.0] * 4)
    assert not plate.is_hairpin(ring)


@pytest.mark.parametrize(
    ("width", "height", "hairpin"),
    [(1, 6, True), (6, 1, True), (3, 1, True), (2, 1, False), (6, 3, False), (1, 1, False)],
)
def test_a_narrow_box_is_a_hairpin(width: int, height: int, hairpin: bool) -> None:
    for way in (1, -1):
        assert sheet().is_hairpin(box(1, 1, width, height)[::way]) == hairpin


def test_a_circle_of_a_few_edges_is_a_hairpin_where_it_is_tiny() -> None:
    large = 41
    points = grid_points(large)
    half_edges = SurfaceEdges(points, grid_triangles(large), grid_edges(large))
    face = [large + 1, large + 2, 2 * large + 2, 2 * large + 1]
    assert half_edges.is_hairpin(face)
    assert not sheet().is_hairpin(box(3, 3, 1, 1))


def test_around_the_middle_of_a_large_fan_a_chain_is_taken_for_straight() -> None:
    count = 2000
    angles = np.arange(count) * 2.0 * np.pi / count
    points = np.vstack([np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1), np.zeros(3)])
    arrays = arrays_of(points, [(i, (i + 1) % count, count) for i in range(count)])
    turns = SurfaceEdges(arrays.points, arrays.triangles, arrays.edges).turns([count, 0, 1])
    assert turns[0] == pytest.approx(np.pi - 2.0 * np.pi / count), "on the side where the faces are few"
    assert SurfaceEdges(arrays.points, arrays.triangles, arrays.edges).turns([0, count, count // 2])[1] == 0.0
