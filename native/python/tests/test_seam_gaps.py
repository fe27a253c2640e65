# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of edges, and where seams end just before they meet another one: on a plate of 9 x 9 vertices, 9 * row + column."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import seamwire_core as sw
from test_mirror_partners import centred, grid_edges, grid_triangles

SIZE = 9
ROW = tuple(range(36, 45))
PLATE = sw.Surface(centred(SIZE), grid_triangles(SIZE), grid_edges(SIZE))


def seams(*chains: tuple[int, ...] | range) -> np.ndarray:
    return np.array([pair for chain in chains for pair in pairwise(chain)], dtype=np.int32).reshape(-1, 2)


def gaps(*chains: tuple[int, ...] | range, on: sw.Surface = PLATE, **options: object) -> list[tuple[int, int, float]]:
    found = sw.find_gaps(on, seams(*chains), **options)
    return [(int(path[0]), int(path[-1]), length) for path, length in found]


def test_chains_end_where_edges_end_or_meet_and_at_vertices_that_are_given() -> None:
    edges = np.array([(0, 1), (1, 2), (2, 3), (2, 4), (5, 6), (6, 7), (7, 5), (1, 0)])
    chains = [chain.tolist() for chain in sw.edge_chains(edges)]
    assert chains == [[0, 1, 2], [2, 3], [2, 4], [5, 6, 7, 5]]
    assert [chain.tolist() for chain in sw.edge_chains(edges[:2], [1, 99])] == [[0, 1], [1, 2]]
    circle = [chain.tolist() for chain in sw.edge_chains([(0, 1), (1, 2), (2, 0), (0, 3)])]
    assert circle == [[0, 1, 2, 0], [0, 3]], "a circle through a junction is one chain"


def test_a_cut_that_ends_before_another_one_or_the_border_has_a_gap() -> None:
    assert gaps(ROW, (4, 13, 22, 31)) == [(31, 40, 1.0)]
    assert gaps((19, 20, 21, 22, 23, 24, 25)) == [(19, 18, 1.0), (25, 26, 1.0)]


def test_what_is_closed_has_none() -> None:
    assert gaps() == []
    assert gaps(ROW) == [], "from border to border"
    assert gaps(ROW, (4, 13, 22, 31, 40)) == []
    assert gaps((20, 21, 22, 31, 40, 39, 38, 29, 20)) == [], "a circle"


def test_two_ends_that_face_each_other_have_one_gap() -> None:
    assert [set(gap[:2]) for gap in gaps(range(36, 40), range(40, 45))] == [{39, 40}]
    assert [set(gap[:2]) for gap in gaps(range(36, 40), range(41, 45), longest=0.7)] == [{39, 41}]


def test_a_gap_is_no_longer_than_a_part_of_its_cut() -> None:
    assert gaps(ROW, (4, 13, 22)) == [], "as long as the cut"
    assert gaps(ROW, (4, 13, 22), longest=1.0) == [(22, 40, 2.0)]


def test_what_the_cut_itself_leads_to_soon_is_not_across_a_gap() -> None:
    around = (36, 37, 38, 39, 40, 41, 32, 23, 22, 21, 30)
    assert gaps(around) == [(30, 39, 1.0)]
    assert gaps((4, 13, 22), longest=9.0) == [], "a dart: along it and the border it is not much farther than across"


def test_the_way_across_a_gap_leads_from_the_end_to_the_target_along_edges() -> None:
    ((path, _),) = sw.find_gaps(PLATE, seams(ROW, (4, 13, 22)), longest=1.0)
    assert path.tolist() == [22, 31, 40]


def test_where_the_mesh_goes_on_hidden_there_is_no_border_to_meet() -> None:
    beside = seams(range(SIZE - 1, SIZE**2, SIZE))
    assert gaps(ROW[:-1]) == [(43, 44, 1.0)]
    assert gaps(ROW[:-1], partly_hidden=beside) == []
    # A cut that leads up to where it is hidden may go on there.
    assert gaps(ROW, partly_hidden=beside) == []


def test_while_seams_are_drawn_an_end_some_edges_from_another_cut_is_no_gap_yet() -> None:
    assert gaps(ROW, (4, 13, 22), longest=2.0) == [(22, 40, 2.0)]
    assert gaps(ROW, (4, 13, 22), longest=2.0, longest_of_several=0.2) == []
    assert gaps(ROW, (4, 13, 22), longest=2.0, most_looked_at=5) == []


def test_a_gap_of_one_edge_counts_although_several_edges_lead_to_a_nearer_cut() -> None:
    points = centred(SIZE)
    points[45:, 1] += 1.5
    stretched = sw.Surface(points, grid_triangles(SIZE), grid_edges(SIZE))
    drawn = (4, 13, 22, 31, 40), range(2, 81, 9), range(45, 54)
    assert gaps(*drawn, on=stretched, longest=0.7) == [(40, 38, 2.0)]
    assert gaps(*drawn, on=stretched, longest=0.7, longest_of_several=0.2) == [(40, 49, 2.5)]


def test_a_cut_that_ends_on_purpose_has_no_gap_there() -> None:
    assert gaps(ROW, (4, 13, 22, 31), (50, 59, 68, 77), meant=[31]) == [(50, 41, 1.0)]


def test_vertices_that_are_not_there_are_refused() -> None:
    with pytest.raises(ValueError, match="seams: vertex 81 is out of range"):
        sw.find_gaps(PLATE, [(0, 81)])
    with pytest.raises(ValueError, match="meant: vertex -1 is out of range"):
        sw.find_gaps(PLATE, [(0, 1)], meant=[-1])
    with pytest.raises(ValueError, match="partly_hidden: vertex 81 is out of range"):
        sw.find_gaps(PLATE, [(0, 1)], partly_hidden=[(81, 0)])
    with pytest.raises(ValueError, match="joins vertex 3 to itself"):
        sw.edge_chains([(3, 3)])
    with pytest.raises(ValueError, match="vertex -1 is negative"):
        sw.edge_chains([(3, -1)])
