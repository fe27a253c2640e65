# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with UV maps of one or several meshes."""

import numpy as np
import pytest
from seamwire.core.islands.map_faults import NO_FAULTS, MapFaults, MappedSurface, find_faults, joined


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


def test_a_map_without_faults_has_the_least_energy() -> None:
    surface = squares((0.0, 0.0), (0.2, 0.0), (0.5, 0.5))
    assert find_faults(surface) == NO_FAULTS
    assert surface.energy() == pytest.approx(4.0, abs=1e-5)
    assert surface.energy(2.0) > 4.1
    assert surface.area == pytest.approx(3.0)


def test_faces_without_a_place_have_no_energy() -> None:
    surface = squares((0.2, 0.2), (0.7, 0.7))
    surface.uvs[:2] = np.nan
    assert find_faults(surface) == MapFaults(flipped=1)
    assert surface.energy() == pytest.approx(4.0, abs=1e-5)
    surface.uvs[:] = np.nan
    assert surface.energy() == np.inf


def test_maps_of_several_meshes_of_any_size_share_the_square() -> None:
    large, small = squares((0.0, 0.0), (0.5, 0.5), unit=1e6), squares((0.6, 0.6), unit=1e-6)
    both = joined([large, small])
    assert (both.count, len(both.points), len(both.edges)) == (3, 12, 12)
    assert find_faults(both) == MapFaults(overlapping=2)
    assert find_faults(both, np.array([False, False, True])) == MapFaults(overlapping=1)
    assert find_faults(joined([large, squares((0.8, 0.0), unit=1e-6)])) == NO_FAULTS
