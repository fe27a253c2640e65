# SPDX-License-Identifier: GPL-3.0-or-later
"""The energy of UV maps."""

import numpy as np
import pytest
from seamwire.core.islands.uv_maps import MappedSurface


def test_the_energy_is_that_of_the_map_on_its_image() -> None:
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    triangles = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
    uvs = (0.2 * points[triangles, :2]).astype(np.float32)
    edges = np.array([(0, 1), (1, 2), (2, 3), (3, 0)], dtype=np.int32)
    surface = MappedSurface(points, triangles, np.array([0, 1], dtype=np.int32), uvs, edges)
    assert (surface.count, surface.area) == (2, pytest.approx(1.0))
    assert surface.energy() == pytest.approx(4.0, abs=1e-5)
    assert surface.energy(2.0) > 4.1
    uvs[0] = np.nan
    assert surface.energy() == pytest.approx(4.0, abs=1e-5), "a face without a place does not count"
    uvs[:] = np.nan
    assert surface.energy() == np.inf
