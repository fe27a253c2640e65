# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of polygons with corners in a row."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.base.geometry import without_flat_triangles


def areas(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    p = points[triangles]
    return 0.5 * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])[:, 2]


def sides(triangles: NDArray[np.int32]) -> list[tuple[int, int]]:
    return [tuple(sorted(t[[i, (i + 1) % 3]].tolist())) for t in triangles for i in range(3)]


def test_two_polygons_with_three_corners_in_a_row_in_common_share_no_diagonal() -> None:
    # Both triangles beside the edge 0-2 have the vertex 1 in its middle, and the diagonal 0-2 past it.
    points = np.array([(0, 0, 0), (1, 1e-7, 0), (2, 0, 0), (1, 2, 0), (1, -2, 0)])
    triangles = np.array([(0, 1, 2), (0, 2, 3), (2, 1, 0), (2, 0, 4)], dtype=np.int32)
    turned = without_flat_triangles(points, triangles, np.array([0, 0, 1, 1]))
    assert sides(turned).count((0, 2)) == 0
    assert areas(points, turned) == pytest.approx([1.0] * 4)


def test_corners_in_a_row_one_after_the_other() -> None:
    points = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (0, 3, 0)], dtype=float)
    fan = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4)], dtype=np.int32)
    turned = without_flat_triangles(points, fan, np.zeros(3, dtype=int))
    assert areas(points, turned) == pytest.approx([1.5] * 3)
    assert {*turned.reshape(-1).tolist()} == {0, 1, 2, 3, 4}


def test_what_has_areas_or_cannot_have_any_stays() -> None:
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    triangles = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
    assert without_flat_triangles(square, triangles, np.array([0, 0])) is triangles
    line = square * (1.0, 0.0, 0.0)
    assert np.array_equal(without_flat_triangles(line, triangles, np.array([0, 0])), triangles)
    apart = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 2, 0)], dtype=float)
    rows = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
    assert np.array_equal(without_flat_triangles(apart, rows, np.array([0, 1])), rows), "of two polygons"
