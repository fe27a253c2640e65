# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices found by their place, and the mirror images of vertices."""

from __future__ import annotations

import numpy as np
import pytest
import seamwire_core as sw

SIZE = 6
TOLERANCE = 2e-5
"""How far from its mirror image a vertex may be where no edges are known."""


def centred(size: int = SIZE) -> np.ndarray:
    """Return the vertices of a grid, row by row, with its middle at the origin."""
    y, x = np.mgrid[:size, :size] - (size - 1) / 2
    return np.stack([x.ravel(), y.ravel(), np.zeros(size**2)], axis=1)


def grid_edges(size: int) -> np.ndarray:
    numbers = np.arange(size**2).reshape(size, size)
    across, up = np.stack([numbers[:, :-1], numbers[:, 1:]]), np.stack([numbers[:-1], numbers[1:]])
    return np.concatenate([across.reshape(2, -1), up.reshape(2, -1)], axis=1).T


def grid_triangles(size: int) -> np.ndarray:
    """Return two triangles for each square of that grid, from below left."""
    a = np.add.outer(size * np.arange(size - 1), np.arange(size - 1)).ravel()
    return np.stack([a, a + 1, a + size + 1, a, a + size + 1, a + size], axis=1).reshape(-1, 3)


def partners_of(
    points: np.ndarray,
    edges: np.ndarray | None = None,
    triangles: np.ndarray | None = None,
    axes: tuple[int, ...] = (0,),
) -> np.ndarray:
    return sw.mirror_partners(points, axes, edges, triangles)


def test_of_points_in_one_place_the_first_is_found() -> None:
    assert sw.nearest_vertices(np.zeros((500, 3)), np.zeros((2, 3)), 1e-3).tolist() == [0, 0]
    assert sw.nearest_vertices(np.empty((0, 3)), np.zeros((1, 3)), 1e-3).tolist() == [-1]


def test_every_place_has_a_reach_of_its_own() -> None:
    generator = np.random.default_rng(2)
    points = generator.uniform(-1.0, 1.0, (300, 3))
    places = np.concatenate([points + generator.normal(0.0, 0.02, points.shape), generator.uniform(-1, 1, (300, 3))])
    reach = 10.0 ** generator.uniform(-3.0, -0.5, len(places))
    gaps = np.linalg.norm(places[:, None] - points[None], axis=2)
    expected = np.where(gaps.min(axis=1) <= reach, gaps.argmin(axis=1), -1)
    assert (sw.nearest_vertices(points, places, reach) == expected).all()
    assert 100 < (expected >= 0).sum() < 500


@pytest.mark.parametrize("far", [1e4, 1e30, np.inf, np.nan])
def test_a_point_far_from_all_others_does_not_hide_them(far: float) -> None:
    points = np.vstack([centred(40) * 1e-3, [[far, 0.0, -far]]])
    with np.errstate(all="raise"):
        found = sw.nearest_vertices(points, points + 1e-4, 2e-4)
    assert (found[:-1] == np.arange(1600)).all()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("place", [0.0, 1e30, np.inf, -np.inf, np.nan, 1e300])
def test_points_without_a_place_or_all_in_one_are_no_fault(place: float) -> None:
    points = np.full((5, 3), place)
    found = sw.nearest_vertices(points, points, np.array([0.0, 1.0, np.inf, np.nan, -1.0]))
    assert found.tolist() == ([0, 0, 0, -1, -1] if abs(place) < 1e100 else [-1] * 5)


def test_vertices_have_partners_within_blenders_tolerance() -> None:
    points = centred()
    points[0, 1] += 0.9 * TOLERANCE
    points[6, 1] += 1.1 * TOLERANCE
    partners = partners_of(points)
    assert partners[0] == 5
    assert partners[6] == -1
    assert partners[12] == 17


def test_ninety_thousand_vertices_are_mirrored() -> None:
    size = 300
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, size), np.linspace(-1.0, 1.0, size))
    half = np.stack([x.ravel(), y.ravel(), np.sin(3.0 * y.ravel()) * np.abs(x.ravel())], axis=1)
    points = half[np.random.default_rng(0).permutation(len(half))].astype(np.float32).astype(np.float64)
    partners = partners_of(points)
    assert np.allclose(points[partners], points * [-1.0, 1.0, 1.0], atol=TOLERANCE)


def noisy(size: int, by: float) -> np.ndarray:
    """Return the grid with its vertices off their places by up to `by` edges along each axis."""
    return centred(size) + np.random.default_rng(3).uniform(-by, by, (size**2, 3))


def mirrored_numbers(size: int) -> np.ndarray:
    return np.arange(size**2).reshape(size, size)[:, ::-1].ravel()


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e4])
def test_partners_are_found_within_a_part_of_the_edges_around(scale: float) -> None:
    points = noisy(20, 0.06) * scale
    assert (partners_of(points, grid_edges(20)) == mirrored_numbers(20)).all()
    points[7] += [0.5 * scale, 0.0, 0.0]
    partners = partners_of(points, grid_edges(20))
    assert partners[[7, 12]].tolist() == [-1, -1]
    assert (partners >= 0).sum() == 398


def test_what_counts_are_the_edges_at_the_vertex() -> None:
    coarse, fine = centred(6), centred(6) * 0.1 + [0.0, 100.0, 0.0]
    points = np.vstack([coarse, fine])
    points[[0, 36]] += [0.0, 0.0, 0.1]  # a tenth of an edge there, a whole one here
    edges = np.vstack([grid_edges(6), grid_edges(6) + 36])
    partners = partners_of(points, edges)
    assert partners[0] == 5
    assert partners[36] == -1


def test_partners_are_one_to_one() -> None:
    points = noisy(20, 0.15)
    for axes in ((0,), (1,), (0, 1)):
        partners = partners_of(points, grid_edges(20), axes=axes)
        own = np.flatnonzero(partners >= 0)
        assert (partners[partners[own]] == own).all()
        assert 100 < len(own) < 400


def test_vertices_in_one_place_have_partners_of_their_own() -> None:
    count, edges = SIZE**2, grid_edges(SIZE)
    found = partners_of(np.vstack([centred()] * 3), np.vstack([edges, edges + count, edges + 2 * count]))
    assert found[[count, count + 1, count + 7]].tolist() == [count + 5, count + 4, count + 10]
    assert (np.sort(found) == np.arange(3 * count)).all()


def bent(size: int) -> np.ndarray:
    """Return the grid with what is right of the middle turned up, as an arm in a pose."""
    points = centred(size)
    right = np.maximum(points[:, 0] - 0.5, 0.0)
    points[:, 0] -= 0.7 * right
    points[:, 2] += 0.7 * right
    return points


def test_topology_needs_faces_of_any_kind_and_goes_around_what_is_different() -> None:
    size = 16
    triangles, edges = grid_triangles(size), grid_edges(size)
    # On the right, a quad is two triangles, and another is missing.
    edges = np.vstack([edges, [[3 * size + 12, 4 * size + 13]]])
    missing = 2 * (8 * (size - 1) + 11)
    triangles = np.delete(triangles, [missing, missing + 1], axis=0)
    assert (partners_of(bent(size), edges, triangles) == mirrored_numbers(size)).all()


def test_where_places_lie_about_a_part_topology_does_not() -> None:
    size = 16
    points = centred(size)
    # On top, the right side has moved by an edge: what lies at the image of a vertex there is its partner's neighbor.
    points[(points[:, 0] > 0.0) & (points[:, 1] > 4.0), 0] += 1.0
    by_place = partners_of(points, grid_edges(size))
    assert ((by_place >= 0) & (by_place != mirrored_numbers(size))).sum() >= 30
    assert (partners_of(points, grid_edges(size), grid_triangles(size)) == mirrored_numbers(size)).all()


@pytest.mark.parametrize("diagonal", [(0, 2), (1, 3)])
def test_topology_ends_where_faces_differ(diagonal: tuple[int, int]) -> None:
    length = 10
    x = np.arange(length) - 4.5
    rails = np.column_stack([np.concatenate([x, x]), np.repeat([0.0, 1.0], length), np.zeros(2 * length)])
    rails[rails[:, 0] > 1.0] += [0.3, 0.0, 0.4]
    low = np.arange(length - 1)
    quads = np.stack([low, low + 1, low + 1 + length, low + length], axis=1)
    sides = np.sort(np.vstack([quads[:, [0, 1]], quads[:, [1, 2]], quads[:, [2, 3]], quads[:, [3, 0]]]), axis=1)
    split = quads[6]  # next to the last but one
    triangles = np.vstack([np.delete(quads, 6, axis=0)[:, [0, 1, 2]], np.delete(quads, 6, axis=0)[:, [0, 2, 3]]])
    a, b = diagonal
    cut = [np.roll(split, -a)[:3], np.roll(split, -b)[:3]]
    edges = np.vstack([np.unique(sides, axis=0), np.sort(split[list(diagonal)])[None]])
    partners = partners_of(rails, edges, np.vstack([triangles, cut])).reshape(2, length)
    assert (partners[:, 3:7] == np.arange(2 * length).reshape(2, length)[:, ::-1][:, 3:7]).all()
    assert (partners[:, [0, 1, 2, 7, 8, 9]] == -1).all()


def test_parts_that_growing_does_not_come_to_are_mirrored_by_place() -> None:
    size, count = 8, 64
    left = centred(size) * 0.3 - [20.0, 0.0, 5.0]
    points = np.vstack([bent(size), left, left * [-1.0, 1.0, 1.0], [[30.0, 0.0, 0.0], [-30.0, 0.0, 0.0]]])
    edges = np.vstack([grid_edges(size) + count * part for part in range(3)])
    triangles = grid_triangles(size)
    triangles = np.vstack([triangles, triangles + count, triangles[:, ::-1] + 2 * count])
    partners = partners_of(points, edges, triangles)
    assert (partners[:count] == mirrored_numbers(size)).all()
    assert (partners[count : 3 * count] == np.roll(np.arange(count, 3 * count), count)).all()
    assert partners[3 * count :].tolist() == [3 * count + 1, 3 * count]


@pytest.mark.filterwarnings("error")
def test_topology_of_nothing_and_of_broken_meshes() -> None:
    none = np.empty((0, 2), dtype=np.int32), np.empty((0, 3), dtype=np.int32)
    assert partners_of(np.empty((0, 3)), *none).tolist() == []
    assert (partners_of(centred(), *none) == mirrored_numbers(6)).all()
    generator = np.random.default_rng(5)
    triangles = generator.integers(0, 36, (200, 3)).astype(np.int32)
    partners = partners_of(centred(), grid_edges(SIZE), triangles)
    assert (partners[partners] == np.arange(36)).all()


def test_vertices_and_axes_out_of_range_are_refused() -> None:
    for arguments, message in (
        (([0], [(0, 36)]), "edge 0: vertex 36 is out of range"),
        (([0], [(0, 1)], [(0, 1, -1)]), "triangle 0: vertex -1 is out of range"),
        (([3],), "axes: expected 0, 1 or 2, got 3"),
    ):
        with pytest.raises(ValueError, match=message):
            sw.mirror_partners(centred(), *arguments)
    with pytest.raises(ValueError, match="2 places, but 1 distances"):
        sw.nearest_vertices(centred(), centred()[:2], [1.0])
