# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as arrays, and the library's surface of it."""

from dataclasses import replace

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from seamwire.core.base.mesh_arrays import Arrays

pytest.importorskip("seamwire_core")


def test_a_mesh_has_one_surface_without_the_scale_of_its_object() -> None:
    triangles = grid_triangles(4)
    numbers = np.arange(len(triangles), dtype=np.int32)
    none = np.empty((0, 2), dtype=np.int32)
    to_object = np.diag([0.5, 1.0, 1.0])
    arrays = Arrays(grid_points(4), triangles, numbers, grid_edges(4), to_object, none, none)
    assert arrays.surface is arrays.surface
    assert np.array_equal(arrays.surface.points, grid_points(4) * (0.5, 1.0, 1.0))
    assert replace(arrays, to_object=np.eye(3)).surface is not arrays.surface
