# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the UV square maps use, and which island costs most of the rest."""

from __future__ import annotations

import numpy as np
import pytest
from seamwire.core.islands.uv_maps import CostlyIsland, MappedSurface, square_use

TILE = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]])


def tile(size: tuple[float, float], at: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Return the corners of a rectangle of two triangles."""
    return TILE * size + at


def in_map(*islands: np.ndarray, name: str = "Shirt", turn: np.ndarray | None = None) -> MappedSurface:
    """Return islands, (t, 3, 2) each, whose faces lie on the model as in the map, in the plane of x and y."""
    uvs = np.concatenate(islands)
    points = np.concatenate([uvs.reshape(-1, 2), np.zeros((3 * len(uvs), 1))], axis=1)
    triangles = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
    labels = np.repeat(np.arange(len(islands)), [len(each) for each in islands]).astype(np.int32)
    edges = np.empty((0, 2), dtype=np.int32)
    return MappedSurface(points, triangles, labels, uvs, edges, name, np.eye(3) if turn is None else turn)


FRAME = np.concatenate([tile((0.9, 0.05)), tile((0.05, 0.85), (0.0, 0.05))])
"""The lower and the left side of a square, as long as 0.9 of the UV square."""


def test_an_island_from_side_to_side_is_long_and_its_width_does_not_matter() -> None:
    for width in (0.02, 0.3):
        strip, rest = tile((0.99, width)), tile((0.2, 0.2), (0.5, 0.5))
        found = square_use([in_map(rest, strip)])
        assert found.share == pytest.approx(0.99 * width + 0.04)
        assert found.costly == CostlyIsland(1, side="-y")


def test_islands_that_are_about_as_long_are_counted() -> None:
    strips = [tile((length, 0.04), (0.0, 0.1 * row)) for row, length in enumerate((0.95, 0.99, 0.4, 0.96, 0.9))]
    found = square_use([in_map(*strips)]).costly
    assert (found.number, found.others, found.empty) == (1, 2, None)


def test_the_island_with_most_free_space_in_its_box_costs_most_if_none_is_long() -> None:
    found = square_use([in_map(tile((0.1, 0.1), (0.8, 0.8)), FRAME)])
    covered = 0.9 * 0.05 + 0.05 * 0.85
    assert found.share == pytest.approx(covered + 0.01)
    assert found.costly.number == 1
    assert found.costly.empty == pytest.approx((0.81 - covered - 0.01) / 0.81), "another island fills some of the box"


def test_a_long_island_with_an_empty_box_costs_by_whichever_is_more() -> None:
    corner = FRAME / 0.9
    assert square_use([in_map(corner)]).costly.empty == pytest.approx(1.0 - 0.0875 / 0.81)
    bent = corner * (0.3, 1.0)
    assert square_use([in_map(bent)]).costly.empty is None, "most of the square is beside its box"


def test_full_boxes_that_are_not_long_are_no_cause() -> None:
    tiles = [tile((0.3, 0.3), (0.0, 0.0)), tile((0.3, 0.3), (0.6, 0.6))]
    assert square_use([in_map(*tiles)]).costly is None
    outside = in_map(tile((0.99, 0.02), (1.5, 0.0)))
    assert square_use([outside]).costly is None, "it is not packed into the square"
    assert square_use([]).share == 0.0


def test_faces_without_a_place_count_nothing() -> None:
    unplaced = np.full((1, 3, 2), np.nan)
    found = square_use([in_map(tile((0.99, 0.1)), unplaced)])
    assert found.share == pytest.approx(0.099)
    assert found.costly.number == 0


def test_the_island_is_named_by_its_object_and_its_side_in_the_scene() -> None:
    strip, rest = tile((0.99, 0.02)), tile((0.1, 0.1), (0.0, 0.5))
    turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    upright = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    for turn, side in ((None, "-y"), (turned, "+x"), (upright, "-z")):
        own = in_map(rest, strip, name="Trousers", turn=turn)
        assert square_use([own]).costly == CostlyIsland(1, side=side)
        both = square_use([in_map(rest), own])
        assert both.costly == CostlyIsland(1, name="Trousers", side=side)
    assert square_use([in_map(strip)]).costly == CostlyIsland(0, is_only=True)
