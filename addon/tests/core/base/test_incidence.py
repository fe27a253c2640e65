# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rows of a table contain a vertex, or both vertices of a pair."""

from __future__ import annotations

import numpy as np
from seamwire.core.base.incidence import Incidence


def test_rows_and_pairs_are_those_that_a_look_at_the_whole_table_finds() -> None:
    dice = np.random.default_rng(5)
    triangles = dice.integers(0, 90, (200, 3)).astype(np.int32)
    incidence = Incidence(triangles, 90)
    for vertices in ([0], [3, 77, 12], range(20)):
        expected = np.flatnonzero(np.isin(triangles, list(vertices)).any(axis=1))
        np.testing.assert_array_equal(incidence.rows(vertices), expected)
    pairs = dice.integers(0, 90, (500, 2)).astype(np.int32)
    expected = [bool(((triangles == a).any(axis=1) & (triangles == b).any(axis=1)).any()) for a, b in pairs]
    assert 20 < sum(expected) < 480
    assert incidence.contain(pairs).tolist() == expected


def test_an_empty_table_has_no_rows() -> None:
    incidence = Incidence(np.empty((0, 3), dtype=np.int32), 2)
    assert incidence.rows([0, 1]).tolist() == []
    assert incidence.contain(np.array([(0, 1)])).tolist() == [False]
    assert incidence.contain(np.empty((0, 2), dtype=np.int32)).tolist() == []
