# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps of seams that islands tell of: on a plate of 9 x 9 vertices, vertex 9 * row + column."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.islands.islands import IslandMaker
from seamwire.core.seams.seam_wires import Gap, GapFinder

SIZE = 9
ROW = tuple(range(36, 45))


core = pytest.importorskip("seamwire_core")
plate = core.Surface(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))


def seams(*chains: tuple[int, ...] | range) -> NDArray[np.int32]:
    return np.array([pair for chain in chains for pair in pairwise(chain)], dtype=np.int32).reshape(-1, 2)


def test_islands_tell_of_gaps_where_they_are_asked_for() -> None:
    finder = GapFinder(lambda: plate)
    maker = IslandMaker(grid_triangles(SIZE), lambda _: np.zeros(2 * (SIZE - 1) ** 2, dtype=np.int32), gaps=finder)
    maker.ask("open", seams(ROW, (4, 13, 22, 31)))
    assert maker.answer is not None
    assert maker.answer.gaps == (Gap(31, 40, 1.0),)
    maker.ask("closed", seams(ROW, (4, 13, 22, 31, 40)))
    assert maker.answer.gaps == ()


def test_a_cut_that_ends_on_purpose_has_no_gap_there() -> None:
    finder = GapFinder(lambda: plate)
    maker = IslandMaker(grid_triangles(SIZE), lambda _: np.zeros(2 * (SIZE - 1) ** 2, dtype=np.int32), gaps=finder)
    drawn = seams(ROW, (4, 13, 22, 31), (50, 59, 68, 77))
    maker.ask("planned", drawn, frozenset({4, 13, 22, 31}))
    assert maker.answer is not None
    assert maker.answer.gaps == (Gap(50, 41, 1.0),)
