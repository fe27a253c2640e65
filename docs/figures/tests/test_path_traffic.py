# SPDX-License-Identifier: GPL-3.0-or-later
"""Where shortest paths gather: the computation behind the picture of feature detection."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))

from path_traffic import (
    face_areas,
    feature_lines,
    feature_score,
    highest,
    joined,
    part_count,
    shortest_paths,
    traffic,
    vertex_areas,
)

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]


def grid(cells: int) -> Mesh:
    """Return the unit square, two triangles a cell."""
    y, x = np.meshgrid(*[np.linspace(0.0, 1.0, cells + 1)] * 2, indexing="ij")
    row, column = (part.ravel() for part in np.meshgrid(*[np.arange(cells)] * 2, indexing="ij"))
    a = row * (cells + 1) + column
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return np.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1), triangles.astype(np.int32)


def box(cells: int) -> Mesh:
    """Return the unit cube: six grids that share the vertices of their borders."""
    points, triangles = grid(cells)
    sides, faces = [], []
    for axis in range(3):
        for height in (0.0, 1.0):
            turned = np.roll(points + np.array([0.0, 0.0, height]), axis, axis=1)
            faces.append((triangles if height else triangles[:, ::-1]) + len(points) * len(sides))
            sides.append(turned)
    corners, number = np.unique(np.round(np.concatenate(sides) * cells).astype(int), axis=0, return_inverse=True)
    return corners / cells, number.ravel()[np.concatenate(faces)].astype(np.int32)


def test_traffic_is_the_length_of_paths_per_area() -> None:
    points, triangles = grid(2)
    one = np.array([(0.1, 0.05, 0.0), (0.4, 0.05, 0.0)])
    field = traffic(points, triangles, joined([(one, np.array([0]))]))
    assert set(np.flatnonzero(field)) == set(triangles[0])
    # A path in one of eight equal triangles: eight times the mean there, shared by all triangles around a corner.
    around = np.bincount(triangles.ravel())
    assert field[triangles[0]] == pytest.approx(8.0 / around[triangles[0]])


def test_highest_values_have_the_share_of_the_area() -> None:
    areas = np.array([1.0, 2.0, 3.0, 4.0])
    assert highest(np.array([5.0, 9.0, 1.0, 7.0]), areas, 0.6).tolist() == [False, True, False, True]
    points, triangles = grid(3)
    assert vertex_areas(points, triangles).sum() == pytest.approx(1.0)
    assert face_areas(points, triangles) == pytest.approx(1.0 / 18.0)


def test_parts_are_counted_from_the_largest() -> None:
    edges = np.array([[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6]], dtype=np.int32)
    marked = np.array([True, True, False, True, False, True, True])
    areas = np.array([4.0, 4.0, 9.0, 1.0, 9.0, 0.5, 0.5])
    assert part_count(edges, marked, areas, 1.0) == 3
    assert part_count(edges, marked, areas, 0.8) == 1
    assert part_count(edges, marked, areas, 0.9) == 2


def test_lines_keep_to_strong_triangles_and_cover_each_place_once() -> None:
    points, triangles = grid(10)
    surface = sw.Surface(points, triangles)
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    left, right = 55 + np.array([0, 11]), 65 + np.array([0, 11])
    paths = shortest_paths(sw, embedding, left, right)
    strong = points[triangles][:, :, 0].max(axis=1) <= 0.75
    lines = feature_lines(triangles, paths, strong, 0.3)
    assert len(lines) == 1
    line = paths.points[lines[0]]
    assert line[:, 0].max() <= 0.75
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() > 0.65
    assert feature_lines(triangles, paths, strong, 0.8) == []


def test_paths_in_our_metric_gather_at_the_edges_of_a_box() -> None:
    points, triangles = box(12)
    surface = sw.Surface(points, triangles)
    curvature = sw.principal_curvatures(surface)
    some = np.arange(0, len(points), 17)
    fields = [
        traffic(points, triangles, shortest_paths(sw, sw.embed(surface, metric, max_error=0), some, some))
        for metric in (sw.feature_metric(surface, curvature, gamma=0.1), sw.euclidean_metric(surface, curvature))
    ]
    score, areas = feature_score(*fields), vertex_areas(points, triangles)
    at_edge = (np.minimum(points, 1.0 - points) < 1e-9).sum(axis=1) >= 2
    assert score[at_edge].mean() > 1.8 * score[~at_edge].mean()
    assert fields[1][at_edge].mean() < fields[1][~at_edge].mean()
    # Vertices at edges have a sixth of the area.
    top = highest(score, areas, 0.5 * areas[at_edge].sum() / areas.sum())
    assert areas[top & at_edge].sum() > 0.9 * areas[top].sum()
