# SPDX-License-Identifier: GPL-3.0-or-later
"""Where cuts end just before they meet another one: on a plate of 9 x 9 vertices, vertex 9 * row + column."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.islands.islands import IslandMaker
from seamwire.core.seams.gaps import Gap, GapFinder, border_edges

SIZE = 9
ROW = tuple(range(36, 45))


def seams(*chains: tuple[int, ...] | range) -> NDArray[np.int32]:
    return np.array([pair for chain in chains for pair in pairwise(chain)], dtype=np.int32).reshape(-1, 2)


def gaps(*chains: tuple[int, ...] | range, longest: float = 0.5) -> list[Gap]:
    return GapFinder(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE)).find(seams(*chains), longest)


def test_the_border_is_of_edges_with_one_triangle() -> None:
    border = border_edges(grid_triangles(SIZE), grid_edges(SIZE))
    assert len(border) == 4 * (SIZE - 1)
    rows, columns = np.divmod(border, SIZE)
    on_side = [(ends == side).all(axis=1) for ends in (rows, columns) for side in (0, SIZE - 1)]
    assert np.logical_or.reduce(on_side).all()


def test_a_cut_that_ends_before_another_one_or_the_border_has_a_gap() -> None:
    assert gaps(ROW, (4, 13, 22, 31)) == [Gap(31, 40, 1.0)]
    assert gaps((19, 20, 21, 22, 23, 24, 25)) == [Gap(19, 18, 1.0), Gap(25, 26, 1.0)]


def test_what_is_closed_has_none() -> None:
    assert gaps() == []
    assert gaps(ROW) == [], "from border to border"
    assert gaps(ROW, (4, 13, 22, 31, 40)) == []
    assert gaps((20, 21, 22, 31, 40, 39, 38, 29, 20)) == [], "a circle"


def test_two_ends_that_face_each_other_have_one_gap() -> None:
    assert [{gap.end, gap.target} for gap in gaps(range(36, 40), range(40, 45))] == [{39, 40}]
    assert [{gap.end, gap.target} for gap in gaps(range(36, 40), range(41, 45), longest=0.7)] == [{39, 41}]


def test_a_gap_is_no_longer_than_a_part_of_its_cut() -> None:
    assert gaps(ROW, (4, 13, 22)) == [], "as long as the cut"
    assert gaps(ROW, (4, 13, 22), longest=1.0) == [Gap(22, 40, 2.0)]


def test_what_the_cut_itself_leads_to_soon_is_not_across_a_gap() -> None:
    around = (36, 37, 38, 39, 40, 41, 32, 23, 22, 21, 30)
    assert gaps(around) == [Gap(30, 39, 1.0)]
    assert gaps((4, 13, 22), longest=9.0) == [], "a dart: along it and the border it is not much farther than across"


def test_the_way_across_a_gap_leads_from_the_end_to_the_target_along_edges() -> None:
    (gap,) = gaps(ROW, (4, 13, 22), longest=1.0)
    assert gap.path == (22, 31, 40)


def test_where_the_mesh_goes_on_hidden_there_is_no_border_to_meet() -> None:
    points, triangles, edges = grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE)
    right = points[:, 0] == points[:, 0].max()
    beside = edges[right[edges].all(axis=1)]
    assert len(beside) == SIZE - 1
    row = seams(range(4 * SIZE, 5 * SIZE - 1))
    (gap,) = GapFinder(points, triangles, edges).find(row)
    assert gap.target == 5 * SIZE - 1
    assert GapFinder(points, triangles, edges, beside).find(row) == []
    # A cut that leads up to where it is hidden may go on there.
    assert GapFinder(points, triangles, edges, beside).find(seams(range(4 * SIZE, 5 * SIZE))) == []


def test_islands_tell_of_gaps_where_they_are_asked_for() -> None:
    finder = GapFinder(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))
    maker = IslandMaker(grid_triangles(SIZE), lambda _: np.zeros(2 * (SIZE - 1) ** 2, dtype=np.int32), gaps=finder)
    maker.ask("open", seams(ROW, (4, 13, 22, 31)))
    assert maker.answer is not None
    assert maker.answer.gaps == (Gap(31, 40, 1.0),)
    maker.ask("closed", seams(ROW, (4, 13, 22, 31, 40)))
    assert maker.answer.gaps == ()


def test_while_seams_are_drawn_an_end_some_edges_from_another_cut_is_no_gap_yet() -> None:
    finder = GapFinder(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))
    drawn = seams(ROW, (4, 13, 22))
    assert finder.find(drawn, longest=2.0) == [Gap(22, 40, 2.0)]
    assert finder.find(drawn, longest=2.0, longest_of_several=0.2) == []


def test_a_gap_of_one_edge_counts_although_several_edges_lead_to_a_nearer_cut() -> None:
    points = grid_points(SIZE)
    points[45:, 1] += 1.5
    finder = GapFinder(points, grid_triangles(SIZE), grid_edges(SIZE))
    drawn = seams((4, 13, 22, 31, 40), range(2, 81, 9), range(45, 54))
    assert finder.find(drawn, longest=0.7) == [Gap(40, 38, 2.0)]
    assert finder.find(drawn, longest=0.7, longest_of_several=0.2) == [Gap(40, 49, 2.5)]


def test_a_cut_that_ends_on_purpose_has_no_gap_there() -> None:
    finder = GapFinder(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))
    maker = IslandMaker(grid_triangles(SIZE), lambda _: np.zeros(2 * (SIZE - 1) ** 2, dtype=np.int32), gaps=finder)
    drawn = seams(ROW, (4, 13, 22, 31), (50, 59, 68, 77))
    maker.ask("planned", drawn, frozenset({4, 13, 22, 31}))
    assert maker.answer is not None
    assert maker.answer.gaps == (Gap(50, 41, 1.0),)
