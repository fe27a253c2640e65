# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of flat regions: of a box whose sides are grids, a bent plate, and what has no border."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.offers import flat_regions
from seamwire.core.offers.flat_regions import FlatRegions
from seamwire.core.offers.half_edges import after

SIZE = 6
"""Vertices along a side of the plate; vertex SIZE * row + column."""


def plate(bend: float = 0.0, edges: NDArray[np.int32] | None = None) -> FlatRegions:
    """Return a plate of quads, bent by an angle in degrees along its third column."""
    points = grid_points(SIZE)
    right = np.maximum(points[:, 0] - points[2, 0], 0.0)
    points[:, 0] += right * (np.cos(np.radians(bend)) - 1.0)
    points[:, 2] += right * np.sin(np.radians(bend))
    return FlatRegions(points, grid_triangles(SIZE), grid_edges(SIZE) if edges is None else edges)


def around(columns: range) -> set[int]:
    """Return the vertices around all rows of some columns."""
    return {
        SIZE * row + column
        for row, column in itertools.product(range(SIZE), columns)
        if row in (0, SIZE - 1) or column in (columns[0], columns[-1])
    }


def test_the_border_of_a_plate_leads_around_it() -> None:
    borders = list(plate().borders((0, 1)))
    assert [set(border) for border in borders] == [around(range(SIZE))] * 3, "at each angle"
    assert all(len(border) == len(set(border)) == 4 * (SIZE - 1) for border in borders)


def test_an_edge_inside_has_none() -> None:
    assert list(plate().borders((7, 8))) == []
    assert list(plate().borders((0, 7))) == [], "a diagonal of a quad is no edge, and within the region"


@pytest.mark.parametrize(("bend", "angles"), [(10.0, 0), (20.0, 1), (40.0, 2), (80.0, 3)])
def test_a_bend_parts_regions_below_its_angle(bend: float, angles: int) -> None:
    borders = list(plate(bend).borders((2, 2 + SIZE)))
    assert [set(border) for border in borders] == [around(range(3)), around(range(2, SIZE))] * angles, (
        "small ones first"
    )
    outer = [set(border) for border in plate(bend).borders((4, 5))]
    assert sorted(map(len, outer)) == sorted([16] * angles + [20] * (3 - angles))


def test_a_single_polygon_is_no_region() -> None:
    rows = np.arange(SIZE)
    saw = grid_points(SIZE)
    saw[:, 2] = 5.0 * (np.add.outer(rows, rows) % 2).ravel()
    assert list(FlatRegions(saw, grid_triangles(SIZE), grid_edges(SIZE)).borders((7, 8))) == []
    every_side = np.concatenate([grid_triangles(SIZE)[:, [0, 1]], grid_triangles(SIZE)[:, [1, 2]]])
    assert list(plate(edges=every_side.astype(np.int32)).borders((0, 1))), "all triangles of a plate are one region"


def test_of_a_region_with_a_hole_the_chain_with_the_edge() -> None:
    triangles = grid_triangles(SIZE)
    hole = {14, 15, 20, 21}
    kept = triangles[[not set(triangle) <= hole for triangle in triangles.tolist()]]
    ring = FlatRegions(grid_points(SIZE), kept, grid_edges(SIZE))
    assert {frozenset(border) for border in ring.borders((14, 15))} == {frozenset(hole)}
    assert {frozenset(border) for border in ring.borders((0, 1))} == {frozenset(around(range(SIZE)))}


def test_what_is_not_manifold_or_turned_inside_out_ends_a_region() -> None:
    triangles = grid_triangles(SIZE)
    left = (grid_points(SIZE)[triangles, 0] <= grid_points(SIZE)[2, 0]).all(axis=1)
    turned = np.where(left[:, None], triangles[:, ::-1], triangles)
    borders = list(FlatRegions(grid_points(SIZE), turned, grid_edges(SIZE)).borders((2, 2 + SIZE)))
    assert {frozenset(border) for border in borders} == {frozenset(around(range(3))), frozenset(around(range(2, SIZE)))}
    assert (
        list(FlatRegions(np.zeros((0, 3)), np.zeros((0, 3), np.int32), np.zeros((0, 2), np.int32)).borders((0, 1)))
        == []
    )


def test_around_a_polygon_lies_the_border_of_all_in_its_plane() -> None:
    bent = plate(20.0)
    for triangle, columns in ((0, range(3)), (2 * (SIZE - 2), range(2, SIZE))):
        assert set(bent.border_around(triangle)) == around(columns)
    assert set(plate().border_around(7)) == around(range(SIZE))


def test_around_a_face_with_a_hole_its_outer_border_counts() -> None:
    triangles = grid_triangles(SIZE)
    kept = triangles[[not set(triangle) <= {14, 15, 20, 21} for triangle in triangles.tolist()]]
    ring = FlatRegions(grid_points(SIZE), kept, grid_edges(SIZE))
    assert set(ring.border_around(0)) == around(range(SIZE))


def test_a_border_that_is_too_long_is_given_up_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    count = 20_100
    turns = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    ring = np.stack([np.cos(turns), np.sin(turns), np.zeros(count)], axis=1)
    here = np.arange(count, dtype=np.int32) + 1
    following = np.roll(here, -1)
    disc = FlatRegions(
        np.concatenate([np.zeros((1, 3)), ring]),
        np.stack([np.zeros_like(here), here, following], axis=1),
        np.stack([here, following], axis=1),
    )
    steps = itertools.count()

    def counted(half_edge: int) -> int:
        assert next(steps) < 3 * count
        return after(half_edge)

    monkeypatch.setattr(flat_regions, "after", counted)
    assert disc.border_around(0) == ()
