# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires everywhere they fit: on copies of a patch that are moved, turned and mirrored, and within a grid."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.base import native
from seamwire.core.network.picks import Edge
from seamwire.core.network.wires import Wire
from seamwire_networks.repeats import Repeats, connected_groups

SIZE = 6
COUNT = SIZE * SIZE
CHAIN = (7, 8, 14, 15, 21)
"""Over a patch: no other chain of it has these lengths."""


def patch() -> NDArray[np.float64]:
    """Return a grid whose edges are all of different lengths."""
    points = grid_points(SIZE)
    return points + np.random.default_rng(3).uniform(-0.2, 0.2, points.shape)


def copies(*maps: NDArray[np.float64]) -> tuple[NDArray[np.float64], Repeats]:
    """Return the points of patches under linear maps, and what finds repeats on them; mirrored ones have their faces turned."""
    points = np.concatenate([patch() @ one.T + 10.0 * number for number, one in enumerate(maps)])
    triangles = [
        COUNT * number + (grid_triangles(SIZE) if np.linalg.det(one) > 0.0 else grid_triangles(SIZE)[:, ::-1])
        for number, one in enumerate(maps)
    ]
    edges = [COUNT * number + grid_edges(SIZE) for number in range(len(maps))]
    return points, Repeats(points, np.concatenate(triangles), np.concatenate(edges))


def edges_of(chain: tuple[int, ...]) -> list[Edge]:
    return [(min(pair), max(pair)) for pair in pairwise(chain)]


def turned(angle: float) -> NDArray[np.float64]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


MIRROR = np.diag([-1.0, 1.0, 1.0])


def test_a_tree_of_edges_and_a_loop_are_found_too() -> None:
    _, repeats = copies(np.eye(3), MIRROR)
    tree = [*edges_of(CHAIN), (14, 20), (20, 26), (13, 14)]
    assert [len(to) for to in repeats.maps(tree)] == [8]
    loop = [*edges_of((7, 8, 9, 15, 14, 13)), (7, 13)]
    assert [set(to.values()) for to in repeats.maps(loop)] == [{COUNT + v for v in (7, 8, 9, 15, 14, 13)}]


@pytest.mark.parametrize(("scale", "found"), [(1.005, 1), (1.03, 1), (1.2, 0)])
def test_lengths_have_to_agree(scale: float, found: int) -> None:
    _, repeats = copies(np.eye(3), scale * np.eye(3))
    assert len(list(repeats.maps(edges_of(CHAIN)))) == found


def test_near_ones_are_told_only_where_there_is_no_nearer_one() -> None:
    _, repeats = copies(np.eye(3), 1.03 * np.eye(3), turned(1.0))
    assert [to[7] for to in repeats.maps(edges_of(CHAIN))] == [2 * COUNT + 7]


def test_within_a_grid_the_border_tells_places_apart() -> None:
    repeats = Repeats(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))
    inside = {frozenset(to.values()) for to in repeats.maps([(14, 15)])}
    middle = [
        pair
        for pair in grid_edges(SIZE).tolist()
        if all(0 < v % SIZE < SIZE - 1 and 0 < v // SIZE < SIZE - 1 for v in pair)
    ]
    assert inside == {frozenset(pair) for pair in middle} - {frozenset((14, 15))}
    corner = {frozenset(to.values()) for to in repeats.maps([(0, 1)])}
    assert corner == {frozenset(pair) for pair in ((4, 5), (0, 6), (5, 11), (24, 30), (29, 35), (30, 31), (34, 35))}


def test_where_the_mesh_is_no_surface_nothing_is_found() -> None:
    triangles = np.concatenate([grid_triangles(SIZE), [[14, 15, 0]]])
    repeats = Repeats(grid_points(SIZE), triangles, grid_edges(SIZE))
    assert list(repeats.maps([(14, 15)])) == []
    assert all(not {0, 14, 15} & set(to.values()) for to in repeats.maps([(21, 22)]))


def test_wires_are_moved_with_what_they_know() -> None:
    points, repeats = copies(np.eye(3), MIRROR)
    drawn = Wire("EDGES", CHAIN, points[list(CHAIN)], (7, 8), 21, strength=7.0, heading=(6, 7), stored=4)
    ((moved,),) = repeats.of([drawn], points)
    assert moved.vertices == tuple(COUNT + v for v in CHAIN)
    assert np.array_equal(moved.points, points[list(moved.vertices)])
    assert (moved.start, moved.end) == ((COUNT + 7, COUNT + 8), COUNT + 21)
    assert (moved.strength, moved.heading, moved.stored) == (7.0, None, 0)
    assert moved.id != drawn.id
    loop = Wire(
        "EDGES", (7, 8, 14, 13), points[[7, 8, 14, 13, 7]], (8, 7), (8, 7), closed=True, kind="CLOSED", through=(7, 8)
    )
    ((moved,),) = repeats.of([loop], points)
    assert moved.through == (COUNT + 7, COUNT + 8)
    assert len(moved.points) == 5


def test_groups_are_wires_that_share_vertices_and_each_comes_once() -> None:
    points = patch()
    chains = ((0, 1), (1, 2), (2, 8), (20, 21))
    one, two, three, apart = (Wire("EDGES", chain, points[list(chain)], *chain) for chain in chains)
    wires = [one, apart, two, three]
    assert connected_groups([three], wires) == [[one, two, three]]
    assert connected_groups([one, three, apart], wires) == [[one, two, three], [apart]]
    assert connected_groups([], wires) == []


def test_the_search_tells_how_much_is_done_and_can_be_stopped() -> None:
    points, repeats = copies(np.eye(3), turned(1.0), MIRROR)
    drawn = Wire("EDGES", CHAIN, points[list(CHAIN)], 7, 21)
    told: list[float] = []
    assert len(list(repeats.of([drawn], points, lambda fraction: not told.append(fraction)))) == 2
    assert told == sorted(told)
    assert 0.0 <= told[0] < told[-1] <= 1.0
    with pytest.raises(native.load().Cancelled):
        list(repeats.of([drawn], points, lambda _: False))
