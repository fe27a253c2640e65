# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a UV map is torn, and where new islands are put."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seamwire.core.islands.uv_islands import (
    NewIsland,
    boxes_of,
    in_rows,
    place,
    split_edges,
)

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
TILES = np.array([[(x, y) for x, y in SQUARE[rows]] for rows in TRIANGLES])


def island(before: np.ndarray, after: np.ndarray, density: float = 0.25) -> NewIsland:
    """Return a square, one unit large on the model."""
    return NewIsland(before, after, TRIANGLES, np.array([0.5, 0.5]), density)


def taken(low: tuple[float, float], size: tuple[float, float]) -> np.ndarray:
    return boxes_of(TILES * size + low)


def bounds(corners: np.ndarray) -> np.ndarray:
    return np.concatenate([corners.min(axis=0), corners.max(axis=0)])


@pytest.mark.parametrize("flipped", [False, True])
def test_an_edge_is_torn_where_either_end_is(flipped: bool) -> None:
    # Two squares side by side, 0 1 4 3 and 1 2 5 4; the edge 1-4 is number 1.
    second = [4, 5, 2, 1] if flipped else [1, 2, 5, 4]
    vertices = np.array([0, 1, 4, 3, *second])
    edges = np.array([0, 1, 2, 3, 4, 5, 6, 1])
    following = np.array([1, 2, 3, 0, 5, 6, 7, 4])
    places = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]], dtype=np.float32)
    uvs = places[vertices]
    pairs, torn = split_edges(vertices, edges, following, uvs)
    assert pairs.tolist() == [[1, 7]]
    assert torn.tolist() == [False]
    for end in (1, 4):
        moved = uvs.copy()
        moved[4 + second.index(end)] += (0.0, 0.01)
        assert split_edges(vertices, edges, following, moved)[1].tolist() == [True]
    left_out = np.where(np.arange(8) < 4, edges, -1)
    assert len(split_edges(vertices, left_out, following, uvs)[0]) == 0


def test_an_island_lies_where_it_was_as_large_and_turned_as_it_was() -> None:
    before = 0.25 * SQUARE + (0.5, 0.25)
    turned = SQUARE @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    found = place([island(before, 3.0 * turned + 7.0)], taken((0.0, 0.0), (0.3, 1.0)))[0]
    assert found == pytest.approx(before, abs=1.0 / 512)


def test_what_is_in_the_way_is_kept_clear_of() -> None:
    before = 0.25 * SQUARE + (0.5, 0.25)
    there = taken((0.55, 0.3), (0.1, 0.1))
    found = bounds(place([island(before, SQUARE)], there)[0])
    low, high = there[:, :2].min(axis=0), there[:, 2:].max(axis=0)
    assert (found[2:] < low).any() or (found[:2] > high).any()
    assert np.abs(found - bounds(before)).max() < 0.3
    assert (found >= 0.0).all()
    assert (found <= 1.0).all()


def test_new_islands_keep_clear_of_each_other() -> None:
    before = 0.25 * SQUARE + (0.5, 0.25)
    found = [bounds(corners) for corners in place([island(before, SQUARE)] * 5, taken((0.0, 0.0), (0.1, 0.1)))]
    for i, one in enumerate(found):
        for two in found[:i]:
            assert (one[2:] < two[:2]).any() or (two[2:] < one[:2]).any()


def test_without_room_they_lie_to_the_right_of_all() -> None:
    before = 0.5 * SQUARE + 0.1
    found = [bounds(c) for c in place([island(before, SQUARE, 0.6)] * 3, taken((0.0, 0.0), (1.2, 1.0)))]
    assert all(box[0] > 1.2 for box in found)
    for i, one in enumerate(found):
        for two in found[:i]:
            assert (one[2:] < two[:2]).any() or (two[2:] < one[:2]).any()
    assert max(box[3] for box in found) <= 1.01


def test_an_island_in_another_tile_stays_in_it() -> None:
    before = 0.25 * SQUARE + (2.5, -0.75)
    found = place([island(before, SQUARE)], taken((0.0, 0.0), (1.0, 1.0)))[0]
    assert found == pytest.approx(before, abs=1.0 / 512)


def test_an_island_is_turned_as_it_is_seen_on_a_wide_image() -> None:
    on_image = np.array([4.0, 1.0])
    before = 0.25 * SQUARE / on_image
    angle = 0.6
    turned = SQUARE @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]) / on_image
    new = NewIsland(before, turned, TRIANGLES, np.array([0.5, 0.5]), 0.25 / 2.0, 4.0)
    (found,) = place([new], taken((0.9, 0.9), (0.1, 0.1)))
    assert found - found[0] == pytest.approx(before - before[0])


@pytest.mark.parametrize("angle", [0.2, 1.4, 2.9, -1.0])
def test_a_straight_island_keeps_its_sides_along_the_axes(angle: float) -> None:
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    before = (0.25 * SQUARE - 0.125) @ turn + 0.5
    new = replace(island(before, SQUARE), is_straight=True)
    (found,) = place([new], taken((0.9, 0.9), (0.1, 0.1)))
    sides = np.roll(found, -1, axis=0) - found
    assert (np.abs(sides).min(axis=1) < 1e-12).all()
    assert np.abs(sides).max(axis=1) == pytest.approx(0.25)
    wanted = np.roll(before, -1, axis=0) - before
    assert (np.einsum("ij,ij->i", sides, wanted) >= 0.0625 * np.cos(0.25 * np.pi)).all(), "the nearest of four"


def test_islands_lie_in_rows_without_touching_at_one_scale() -> None:
    dice = np.random.default_rng(3)
    sizes = dice.uniform(0.05, 3.0, (40, 2))
    sizes[7] = 0.0
    uvs = np.concatenate([SQUARE * size - dice.uniform(-9.0, 9.0, 2) for size in sizes])
    labels = np.repeat(np.arange(40), 4)
    found = in_rows(uvs, labels).reshape(40, 4, 2)
    assert found.min() >= 0.0
    assert found.max() == pytest.approx(1.0)
    low, high = found.min(axis=1), found.max(axis=1)
    scale = (high - low)[0, 0] / sizes[0, 0]
    assert high - low == pytest.approx(scale * sizes)
    apart = ((low[:, None] > high[None]) | (high[:, None] < low[None])).any(axis=2)
    assert (apart | np.eye(40, dtype=bool)).all()
    assert in_rows(np.empty((0, 2)), np.empty(0, dtype=np.int64)).shape == (0, 2)


@pytest.mark.parametrize("is_new", [False, True])
def test_a_thousand_islands_find_room_side_by_side_at_once(is_new: bool) -> None:
    dice = np.random.default_rng(5)
    sizes = dice.uniform(0.01, 0.024, (1000, 2))
    middles = dice.uniform(0.1, 0.9, (1000, 2))
    islands = [
        NewIsland(0.0 * SQUARE if is_new else SQUARE * size + middle, SQUARE * size, TRIANGLES, np.full(2, 0.5), 0.0)
        for size, middle in zip(sizes, middles, strict=True)
    ]
    low, high = np.array(
        [np.split(bounds(corners), 2) for corners in place(islands, taken((0, 0), (0.3, 1)))]
    ).swapaxes(0, 1)
    assert high - low == pytest.approx(sizes)
    assert low[:, 0].min() > 0.3
    assert high.max() <= 1.0
    apart = ((low[:, None] > high[None]) | (high[:, None] < low[None])).any(axis=2)
    assert (apart | np.eye(1000, dtype=bool)).all()
    if not is_new:
        assert np.abs(low - middles).mean() < 0.1
