# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rows of a table contain a vertex, before and after the table is sorted."""

from __future__ import annotations

import numpy as np
import pytest
from seamwire.core.incidence import Incidence

EDGES = np.array([(4, 1), (0, 1), (2, 4), (1, 0), (3, 2)], dtype=np.int32)


def unsorted(table: np.ndarray, count: int, monkeypatch: pytest.MonkeyPatch) -> Incidence:
    with monkeypatch.context() as patch:
        patch.setattr(Incidence, "_sort", lambda self: None)
        return Incidence(table, count)


def test_rows_of_several_vertices_are_found_once_and_in_order() -> None:
    incidence = Incidence(EDGES, 6)
    incidence.wait()
    assert incidence.ready
    assert incidence.rows([1]).tolist() == [0, 1, 3]
    assert incidence.rows([4, 1]).tolist() == [0, 1, 2, 3]
    assert incidence.rows([5]).tolist() == []
    assert incidence.rows([]).tolist() == []


def test_an_unsorted_table_gives_the_same_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    triangles = np.random.default_rng(5).integers(0, 90, (200, 3)).astype(np.int32)
    early = unsorted(triangles, 90, monkeypatch)
    late = Incidence(triangles, 90)
    late.wait()
    assert not early.ready
    for vertices in ([], [0], [3, 77, 12], np.arange(20)):
        np.testing.assert_array_equal(early.rows(vertices), late.rows(vertices))


def test_an_empty_table_has_no_rows() -> None:
    incidence = Incidence(np.empty((0, 3), dtype=np.int32), 2)
    incidence.wait()
    assert incidence.rows([0, 1]).tolist() == []
