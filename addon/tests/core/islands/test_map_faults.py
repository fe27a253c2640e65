# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with UV maps, and what rounding has turned over in them."""

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.islands.map_faults import NO_FAULTS, MapFaults, MappedSurface, find_faults, joined, turn_back
from seamwire.core.islands.uv_islands import signed_uv_areas


def squares(*corners: tuple[float, float], size: float = 0.2, unit: float = 1.0) -> MappedSurface:
    """Return separate squares, each an island of two triangles, with their low corners at some places of the map."""
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    points = np.concatenate(
        [np.pad(unit * square, ((0, 0), (0, 1))) + np.array([2.0 * unit * i, 0.0, 0.0]) for i in range(len(corners))]
    )
    triangles = np.concatenate([np.array([(0, 1, 2), (0, 2, 3)]) + 4 * i for i in range(len(corners))])
    edges = np.concatenate([np.array([(0, 1), (1, 2), (2, 3), (3, 0)]) + 4 * i for i in range(len(corners))])
    numbers = np.repeat(np.arange(len(corners)), 2)
    places = np.concatenate([size * square + corner for corner in corners])
    columns = (points, triangles.astype(np.int32), numbers, numbers, places[triangles].astype(np.float32))
    return MappedSurface(*columns, edges.astype(np.int32))


def test_islands_that_keep_apart_have_no_faults() -> None:
    surface = squares((0.0, 0.0), (0.2, 0.0), (0.5, 0.5))
    assert find_faults(surface) == NO_FAULTS, "two of them touch"
    assert surface.energy() == pytest.approx(4.0, abs=1e-5)
    assert surface.area == pytest.approx(3.0)


def test_islands_that_overlap_count_if_they_are_looked_at() -> None:
    surface = squares((0.0, 0.0), (0.1, 0.1), (0.5, 0.5))
    assert find_faults(surface) == MapFaults(overlapping=2)
    assert find_faults(surface, np.array([True, False, False])) == MapFaults(overlapping=1)
    assert find_faults(surface, np.array([False, False, True])) == NO_FAULTS


def test_a_face_that_doubles_another_one_is_measured_too() -> None:
    apart, stacked = squares((0.0, 0.0), (0.3, 0.0)), squares((0.0, 0.0), (0.0, 0.0))
    for surface, faults in ((apart, NO_FAULTS), (stacked, MapFaults(overlapping=2))):
        surface.triangles[2:] = surface.triangles[:2]
        assert find_faults(surface) == faults


def test_only_islands_that_lie_exactly_on_each_other_may_stack() -> None:
    assert find_faults(squares((0.1, 0.1), (0.1, 0.1), (0.5, 0.5))) == MapFaults(overlapping=2)
    assert find_faults(squares((0.1, 0.1), (0.1, 0.1), (0.5, 0.5)), may_stack=True) == NO_FAULTS
    assert find_faults(squares((0.1, 0.1), (0.101, 0.1), (0.5, 0.5)), may_stack=True) == MapFaults(overlapping=2)
    on_a_stack = squares((0.1, 0.1), (0.1, 0.1), (0.2, 0.2))
    assert find_faults(on_a_stack, may_stack=True) == MapFaults(overlapping=3)
    assert find_faults(on_a_stack, np.array([False, True, False]), may_stack=True) == MapFaults(overlapping=1)


def test_a_face_that_is_turned_over_in_a_stack_counts() -> None:
    surface = squares((0.1, 0.1), (0.1, 0.1))
    uvs = surface.uvs.copy()
    uvs[1::2, 2] = uvs[0, 1] + (0.1, -0.1)
    turned = MappedSurface(surface.points, surface.triangles, surface.polygons, surface.labels, uvs, surface.edges)
    assert find_faults(turned, may_stack=True).flipped == 2


def test_an_island_may_lie_in_the_uv_square_or_in_its_former_tile() -> None:
    surface = squares((0.0, 0.0), (1.1, 0.5), (1.9, 0.5))
    assert find_faults(surface) == MapFaults(outside=2)
    homes = np.array([(1.0, 0.0)] * 3)
    assert find_faults(surface, None, homes) == MapFaults(outside=1)


def test_faces_that_are_turned_over_or_have_no_number_count_once() -> None:
    surface = squares((0.2, 0.2), (0.7, 0.7))
    uvs = surface.uvs.copy()
    uvs[1, 2] = uvs[0, 1] + (0.1, -0.1)
    turned = MappedSurface(surface.points, surface.triangles, surface.polygons, surface.labels, uvs, surface.edges)
    assert find_faults(turned) == MapFaults(flipped=1, overlapping=1)
    uvs[:2] = np.nan
    assert find_faults(turned) == MapFaults(flipped=1)
    uvs[:] = np.nan
    assert find_faults(turned) == MapFaults(flipped=2)
    assert turned.energy() == np.inf


def test_a_face_whose_corners_lie_in_one_place_is_never_turned_over() -> None:
    surface = squares((0.2, 0.2), (0.7, 0.7))
    surface.points[4:] = surface.points[4]
    uvs = surface.uvs.copy()
    uvs[2:] = uvs[2, 0]
    shrunk = MappedSurface(*list(vars(surface).values())[:4], uvs, surface.edges)
    assert find_faults(shrunk) == NO_FAULTS
    uvs[2] = uvs[2, 0] + [(0.0, 0.0), (0.0, 0.1), (0.1, 0.0)]
    assert find_faults(shrunk) == NO_FAULTS
    uvs[3, 1] = np.nan
    assert find_faults(shrunk) == MapFaults(flipped=1), "it has no map at all"


def test_a_mirrored_island_is_good() -> None:
    surface = squares((0.0, 0.0), (0.5, 0.5))
    uvs = surface.uvs.copy()
    uvs[:2, :, 0] = 0.2 - uvs[:2, :, 0]
    assert find_faults(MappedSurface(*list(vars(surface).values())[:4], uvs, surface.edges)) == NO_FAULTS


def test_maps_of_several_meshes_of_any_size_share_the_square() -> None:
    large, small = squares((0.0, 0.0), (0.5, 0.5), unit=1e6), squares((0.6, 0.6), unit=1e-6)
    both = joined([large, small])
    assert (both.count, len(both.points), len(both.edges)) == (3, 12, 12)
    assert find_faults(both) == MapFaults(overlapping=2)
    assert find_faults(both, np.array([False, False, True])) == MapFaults(overlapping=1)
    assert find_faults(joined([large, squares((0.8, 0.0), unit=1e-6)])) == NO_FAULTS


def cap(height: float) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Return a triangle on a side of another one, thinner than float32 can hold at this place."""
    uvs = np.array([(0.7, 0.7), (0.9, 0.7), (0.8, 0.9), (0.8, 0.7 - height)], dtype=np.float32)
    return uvs, np.array([(0, 1, 2), (1, 0, 3)])


@pytest.mark.parametrize("height", [0.0, -6e-8, -5e-7])
def test_a_triangle_that_rounding_turned_over_is_turned_back(height: float) -> None:
    uvs, corners = cap(height)
    assert signed_uv_areas(uvs[corners].astype(np.float64)).min() <= 0.0
    moved, places = turn_back(uvs, corners, np.arange(4, dtype=np.int32), np.zeros(2, dtype=np.int32))
    assert len(moved) == 1
    assert places.dtype == np.float32
    assert np.abs(places - uvs[moved]).max() < 2e-6
    uvs[moved] = places
    assert signed_uv_areas(uvs[corners].astype(np.float64)).min() > 0.0


def test_corners_at_one_place_move_together_and_only_within_their_island() -> None:
    flat = np.array([(0.7, 0.7), (0.9, 0.7), (0.8, 0.9), (0.8, 0.7), (0.7, 0.5), (0.9, 0.5)], dtype=np.float32)
    vertices = np.array([(0, 1, 2), (1, 0, 3), (3, 0, 4), (3, 4, 5), (1, 3, 5)], dtype=np.int32)
    uvs, corners = flat[vertices.reshape(-1)], np.arange(15).reshape(5, 3)
    labels = np.zeros(5, dtype=np.int32)
    moved, places = turn_back(uvs, corners, vertices.reshape(-1), labels)
    assert len(moved) > 1
    assert len(set(vertices.reshape(-1)[moved].tolist())) == 1
    assert (places == places[0]).all()
    uvs[moved] = places
    assert signed_uv_areas(uvs[corners].astype(np.float64)).min() > 0.0
    labels[2:] = 1
    uvs = flat[vertices.reshape(-1)]
    moved, _ = turn_back(uvs, corners, vertices.reshape(-1), labels)
    assert set(moved.tolist()) <= set(range(6)), "the other island stays"


def test_what_was_turned_over_by_more_than_rounding_stays() -> None:
    uvs, corners = cap(-0.05)
    moved, _ = turn_back(uvs, corners, np.arange(4, dtype=np.int32), np.zeros(2, dtype=np.int32))
    assert len(moved) == 0


def test_a_mirrored_island_is_mended_too() -> None:
    uvs, corners = cap(0.0)
    uvs[:, 0] = 1.0 - uvs[:, 0]
    moved, places = turn_back(uvs, corners, np.arange(4, dtype=np.int32), np.zeros(2, dtype=np.int32))
    uvs[moved] = places
    assert signed_uv_areas(uvs[corners].astype(np.float64)).max() < 0.0
