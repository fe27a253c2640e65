# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances against an established exact solver: pygeodesic, which is Surazhsky et al. (2005) in Kirsanov's code."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw
from pygeodesic import geodesic

Mesh = tuple[np.ndarray, np.ndarray]


def bumpy(mesh: Mesh, amount: float) -> Mesh:
    """Move every vertex off its place, always the same way, so that no two paths are equally short."""
    points, triangles = mesh
    random = np.random.default_rng(5)
    waves = np.sin(9 * points @ random.normal(size=(3, 3)) + random.uniform(0, 6, 3))
    return points + amount * waves + 0.1 * amount * random.normal(size=points.shape), triangles


def with_hole(mesh: Mesh) -> Mesh:
    """Leave out the triangles around one vertex and their neighbours; the points stay."""
    points, triangles = mesh
    near = np.unique(triangles[(triangles == len(points) // 2).any(1)])
    return points, triangles[~np.isin(triangles, near).any(1)]


MESHES = {
    "torus": meshes.torus(30, 20),
    "grid": meshes.grid(15),
    "bumpy torus": bumpy(meshes.torus(36, 24), 0.02),
    "very bumpy torus": bumpy(meshes.torus(30, 30), 0.06),
    "bumpy grid": bumpy(meshes.grid(18), 0.03),
    "torus with a hole": with_hole(bumpy(meshes.torus(32, 20), 0.02)),
    "torus with sharp folds": bumpy(meshes.torus(24, 40), 0.1),
}


@pytest.mark.parametrize("name", MESHES)
def test_euclidean_distances_are_those_of_pygeodesic(name: str) -> None:
    points, triangles = (np.asarray(a) for a in MESHES[name])
    surface = sw.Surface(points, triangles)
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    other = geodesic.PyGeodesicAlgorithmExact(points.astype(np.float64), triangles.astype(np.int32))
    used = np.unique(triangles)
    for seed in (int(used[0]), int(used[len(used) // 3]), int(used[-1])):
        field = sw.distance_field(embedding, seed)
        theirs = other.geodesicDistances(np.array([seed]))[0]
        np.testing.assert_allclose(field.distances[used], theirs[used], rtol=1e-9, atol=1e-12)
        traced = [field.trace(int(v)).length for v in used]
        np.testing.assert_allclose(traced, field.distances[used], rtol=1e-9, atol=1e-12)
