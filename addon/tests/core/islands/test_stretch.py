# SPDX-License-Identifier: GPL-3.0-or-later
"""Stretch of UV maps against known answers and singular values."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_points
from seamwire.core.islands.uv_maps import Stretch

LIMIT = 5.0


def grid(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices of a grid and the triangles of its squares, two each."""
    first = (np.arange(size - 1)[:, None] * size + np.arange(size - 1)).reshape(-1, 1)
    return grid_points(size), (first + np.array([0, 1, size + 1, 0, size + 1, size])).reshape(-1, 3)


POINTS, TRIANGLES = grid(4)
PLACES = POINTS[:, :2][TRIANGLES].astype(np.float32)
ALONE = np.arange(len(TRIANGLES))
CORNERS = np.arange(3 * len(TRIANGLES)).reshape(-1, 3)


def stretch_of(uvs: np.ndarray, points: np.ndarray = POINTS, polygons: np.ndarray = ALONE) -> Stretch:
    stretch = Stretch(points, TRIANGLES, polygons, CORNERS)
    assert stretch.update(uvs.astype(np.float32).reshape(-1, 2))
    return stretch


def test_area_is_compared_with_the_mean_of_all() -> None:
    uvs = PLACES.copy()
    half = len(uvs) // 2
    uvs[:half] *= 2.0
    stretch = stretch_of(uvs)
    # Of equal areas one half has 4, the other 1: the mean is 2.5.
    assert stretch.area[:half] == pytest.approx(np.full(half, np.log2(4.0 / 2.5)), abs=1e-5)
    assert stretch.area[half:] == pytest.approx(np.full(len(uvs) - half, np.log2(1.0 / 2.5)), abs=1e-5)
    labels = np.repeat([0, 1], [half, len(uvs) - half])
    values, areas = stretch.islands(labels, "AREA")
    assert values == pytest.approx([np.log2(4.0 / 2.5), np.log2(2.5)], abs=1e-5)
    assert stretch.islands(labels, "ANGLE")[0] == pytest.approx([0.0, 0.0], abs=1e-2)
    assert areas.sum() == pytest.approx(9.0)


def test_it_agrees_with_singular_values() -> None:
    dice = np.random.default_rng(5)
    points = POINTS + dice.normal(0.0, 0.2, POINTS.shape)
    uvs = dice.random((len(TRIANGLES), 3, 2)).astype(np.float32)
    found = stretch_of(uvs, points)
    for row, (corners, places) in enumerate(zip(points[TRIANGLES], uvs.astype(np.float64), strict=True)):
        sides = (corners[1:] - corners[0]).T
        basis, flat = np.linalg.qr(sides)
        assert basis.shape == (3, 2)
        one, two = np.linalg.svd((places[1:] - places[0]).T @ np.linalg.inv(flat), compute_uv=False)
        assert found.angle[row] == pytest.approx(min(np.log2(one / two), LIMIT), abs=1e-6)


def test_a_polygon_has_the_mean_of_its_triangles() -> None:
    uvs = PLACES.copy()
    uvs[0] *= (2.0, 1.0)
    stretch = stretch_of(uvs, polygons=ALONE // 2)
    # Energies of 1.25 and 1 on equal areas: 1.125 is a ratio of e^arccosh(1.125).
    assert stretch.angle[:2] == pytest.approx(np.full(2, np.arccosh(1.125) / np.log(2.0)), abs=1e-5)
    assert stretch.angle[2:] == pytest.approx(np.zeros(len(uvs) - 2), abs=1e-2)


def test_faces_without_area_count_for_nothing_and_those_without_uv_area_for_the_limit() -> None:
    points = POINTS.copy()
    points[TRIANGLES[0]] = points[TRIANGLES[0][0]]
    uvs = PLACES.copy()
    uvs[-1] = 0.25
    stretch = stretch_of(uvs, points)
    assert stretch.angle[0] == stretch.area[0] == 0.0
    assert stretch.angle[-1] == pytest.approx(LIMIT)
    assert stretch.area[-1] == -LIMIT
    nothing = stretch_of(np.zeros_like(PLACES))
    assert nothing.angle == pytest.approx(np.full(len(PLACES), LIMIT))
    assert np.isfinite(nothing.area).all()
    empty = Stretch(POINTS, TRIANGLES[:0], ALONE[:0], CORNERS[:0])
    assert not empty.update(np.empty((0, 2), dtype=np.float32))
    assert len(empty.islands(ALONE[:0], "ANGLE")[0]) == 0


def test_only_another_map_is_measured() -> None:
    uvs = PLACES.copy()
    stretch = stretch_of(uvs)
    assert not stretch.update(uvs.reshape(-1, 2))
    uvs[7, 0] += 0.4
    assert stretch.update(uvs.reshape(-1, 2))
    assert np.array_equal(stretch.angle, stretch_of(uvs).angle)
