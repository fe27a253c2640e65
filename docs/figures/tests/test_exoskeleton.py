# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of Figure 11: parts of a shape, and proxies inside each part."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from exoskeleton import LEAST_PART, _patches, exoskeleton, shape_parts
from shape_proxies import shape_proxies, shared_sides

BALLS = (-1.0, 0.0, 1.0)
RADIUS, NECK = 0.4, 0.1


def string_of_balls(rings: int = 100, around: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """Three balls along x, with thin rods between them."""
    x = np.linspace(BALLS[0] - RADIUS, BALLS[-1] + RADIUS, rings)
    inside = [RADIUS**2 - (x - ball) ** 2 for ball in BALLS]
    widths = np.sqrt(np.maximum(np.max(inside, axis=0), 0.0))
    between = (x > BALLS[0]) & (x < BALLS[-1])
    widths = np.where(between, np.maximum(widths, NECK), np.maximum(widths, 1e-3))
    turn = 2.0 * np.pi * np.arange(around) / around
    points = np.stack(
        [np.repeat(x, around), np.outer(widths, np.cos(turn)).ravel(), np.outer(widths, np.sin(turn)).ravel()], axis=1
    )
    i, j = (part.ravel() for part in np.meshgrid(np.arange(rings - 1), np.arange(around), indexing="ij"))
    a, b = i * around + j, i * around + (j + 1) % around
    return points, np.concatenate([np.stack([a, b, a + around], 1), np.stack([b, b + around, a + around], 1)])


def box(n: int = 6) -> tuple[np.ndarray, np.ndarray]:
    """A cube of six grids that share their rims."""
    points: dict[tuple[int, ...], int] = {}
    triangles = []
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    corners = [tuple(np.roll((side, *place), axis).tolist()) for place in quad[:: 1 if side else -1]]
                    a, b, c, d = (points.setdefault(corner, len(points)) for corner in corners)
                    triangles += [(a, b, c), (a, c, d)]
    return np.array(list(points), dtype=float) / n, np.array(triangles)


def test_each_ball_is_another_part() -> None:
    points, triangles = string_of_balls()
    parts = shape_parts(points, triangles)
    places = points[triangles].mean(axis=1)[:, 0]
    found = []
    for ball in BALLS:
        # The ball's last tenth, next to a rod, may belong to another part.
        owners = np.unique(parts[np.abs(places - ball) < 0.9 * RADIUS])
        assert len(owners) == 1
        found.append(int(owners[0]))
    assert len(set(found)) == len(BALLS)


def test_parts_are_connected_and_not_small() -> None:
    points, triangles = string_of_balls()
    parts = shape_parts(points, triangles)
    a, b, c = points[triangles].transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    assert (np.bincount(parts, areas) >= LEAST_PART * areas.sum()).all()
    assert_connected(parts, triangles)


def test_no_region_crosses_a_part() -> None:
    points, triangles = string_of_balls()
    found = exoskeleton(points, triangles, 24)
    assert found.regions.min() == 0
    assert found.regions.max() == 23
    pieces = np.unique(np.stack([found.regions, found.parts], axis=1), axis=0)
    assert len(pieces) == 24
    assert_connected(found.regions, triangles)


def test_the_regions_of_a_box_are_its_sides() -> None:
    points, triangles = box()
    regions = shape_proxies(points, triangles, 6, teleport=True)
    assert np.bincount(regions).tolist() == [72] * 6
    for region in range(6):
        places = points[triangles[regions == region]]
        assert (np.ptp(places.reshape(-1, 3), axis=0) == 0.0).any()


def test_every_patch_has_a_triangle_even_if_triangles_have_the_same_middle() -> None:
    patches = _patches(np.ones(3), np.array([(0, 1), (1, 2), (2, 0)]), np.zeros(3))
    assert sorted(patches.tolist()) == [0, 1, 2]


def test_more_parts_than_proxies_have_one_region_each() -> None:
    points, triangles = string_of_balls()
    parts = shape_parts(points, triangles)
    assert (shape_proxies(points, triangles, 2, parts=parts) == parts).all()


@pytest.mark.parametrize("teleport", [False, True])
@pytest.mark.parametrize("count", [1, 6, 12])
def test_every_region_has_faces(count: int, teleport: bool) -> None:
    points, triangles = box()
    assert len(np.unique(shape_proxies(points, triangles, count, teleport=teleport))) == count


def assert_connected(labels: np.ndarray, triangles: np.ndarray) -> None:
    """Assert that the triangles of each label are connected across sides."""
    _, pairs = shared_sides(triangles)
    pairs = pairs[labels[pairs[:, 0]] == labels[pairs[:, 1]]]
    beside: dict[int, list[int]] = {}
    for one, other in [*pairs.tolist(), *pairs[:, ::-1].tolist()]:
        beside.setdefault(one, []).append(other)
    reached = set()
    for label in np.unique(labels):
        front = [int(np.flatnonzero(labels == label)[0])]
        while front:
            face = front.pop()
            if face not in reached:
                reached.add(face)
                front += beside.get(face, [])
    assert len(reached) == len(labels)
