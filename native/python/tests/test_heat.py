# SPDX-License-Identifier: GPL-3.0-or-later
"""The heat method, beside exact distances."""

from __future__ import annotations

import time

import meshes
import numpy as np
import pytest
import seamwire_core as sw


@pytest.fixture(scope="module")
def heat_field(embedding: sw.Embedding) -> sw.DistanceField:
    return sw.distance_field(embedding, 3, method="heat")


def mean_error(distances: np.ndarray, exact: np.ndarray) -> float:
    """Return the mean of the relative errors where the distance is finite and not 0."""
    known = np.isfinite(exact) & (exact > 0)
    return float(np.mean(np.abs(distances[known] - exact[known]) / exact[known]))


def test_distances_are_near_the_exact_ones(field: sw.DistanceField, heat_field: sw.DistanceField) -> None:
    assert (field.method, heat_field.method) == ("exact", "heat")
    assert heat_field.seed == 3
    assert heat_field.distances[3] == 0.0
    assert not np.array_equal(heat_field.distances, field.distances)
    assert mean_error(heat_field.distances, field.distances) < 0.12


def test_wires_end_at_the_seed_and_are_no_shorter_than_geodesics(
    surface: sw.Surface, field: sw.DistanceField, heat_field: sw.DistanceField
) -> None:
    for vertex in (17, 200, 900):
        wire = heat_field.trace(vertex)
        np.testing.assert_allclose(wire.points[[0, -1]], surface.points[[3, vertex]])
        assert field.distances[vertex] * (1 - 1e-9) <= wire.length <= 1.4 * field.distances[vertex]
    points, starts, lengths = heat_field.trace_many([17, 200])
    assert len(points) == starts[-1]
    assert lengths[0] == heat_field.trace(17).length


def test_seeds_and_targets_may_lie_in_faces(embedding: sw.Embedding) -> None:
    seeds = [(10, [0.2, 0.3, 0.5]), 700]
    exact, heat = (sw.distance_field(embedding, seeds, method=method) for method in ("exact", "heat"))
    assert heat.seed == -1
    assert heat.distance(10, [0.2, 0.3, 0.5]) == pytest.approx(0.0, abs=1e-12)
    assert heat.distance(900, [0.1, 0.1, 0.8]) == pytest.approx(exact.distance(900, [0.1, 0.1, 0.8]), rel=0.25)
    assert heat.trace_to(900, [0.1, 0.1, 0.8]).length >= exact.distance(900, [0.1, 0.1, 0.8]) * (1 - 1e-9)


def test_other_parts_are_unreachable() -> None:
    points, triangles = meshes.torus(12, 8)
    both = sw.Surface(
        np.concatenate([points, points + np.array([3.0, 0.0, 0.0])]),
        np.concatenate([triangles, triangles + len(points)]),
    )
    embedding = sw.embed(both, sw.euclidean_metric(both, sw.principal_curvatures(both)), max_error=0)
    field = sw.distance_field(embedding, 0, method="heat")
    assert np.isfinite(field.distances[: len(points)]).all()
    assert np.isinf(field.distances[len(points) :]).all()
    assert field.trace(len(points)) is None


def test_distances_end_at_the_radius(embedding: sw.Embedding, heat_field: sw.DistanceField) -> None:
    near = sw.distance_field(embedding, 3, max_distance=0.2, method="heat")
    assert near.radius == 0.2
    expected = np.where(heat_field.distances > 0.2, np.inf, heat_field.distances)
    np.testing.assert_array_equal(near.distances, expected)


def test_closed_wires_and_their_bending_take_heat_fields(surface: sw.Surface) -> None:
    embedding = sw.embed(surface, sw.concave_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    field = sw.distance_field(embedding, 0, method="heat")
    cuts = field.closed_wires()
    assert cuts
    bent = field.bend(cuts[0]).through(5)
    assert bent is None or bent[0].length > 0


def test_another_name_is_refused(embedding: sw.Embedding) -> None:
    with pytest.raises(ValueError, match="method: expected 'exact' or 'heat', got 'fast'"):
        sw.distance_field(embedding, 3, method="fast")
    with pytest.raises(ValueError, match="seed"):
        sw.distance_field(embedding, -1, method="heat")


def test_the_embedding_keeps_the_factors(large: sw.Surface) -> None:
    embedding = sw.embed(large, sw.euclidean_metric(large, sw.principal_curvatures(large)), max_error=0)
    times = []
    for seed in (0, 5, 9):
        start = time.process_time()
        sw.distance_field(embedding, seed, method="heat")
        times.append(time.process_time() - start)
    assert min(times[1:]) < times[0] / 2


def test_progress_rises_and_cancels(large: sw.Surface) -> None:
    embedding = sw.embed(large, sw.euclidean_metric(large, sw.principal_curvatures(large)), max_error=0)
    with pytest.raises(sw.Cancelled):
        sw.distance_field(embedding, 0, method="heat", progress=lambda done: done < 0.5)
    fractions: list[float] = []
    sw.distance_field(embedding, 0, method="heat", progress=fractions.append)
    assert fractions == sorted(fractions)
    assert 0.5 <= fractions[-1] <= 1.0


def test_a_nearer_seed_counts_beside_one_in_the_same_face() -> None:
    points, triangles = meshes.grid(20)
    surface = sw.Surface(points, triangles)
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    # One seed in a corner of a long face, and one at its far end.
    face = len(triangles) // 2
    corner = int(triangles[face][2])
    near_corner = [0.02, 0.02, 0.96]
    exact, heat = (
        sw.distance_field(embedding, [(face, [0.96, 0.02, 0.02]), corner], method=method)
        for method in ("exact", "heat")
    )
    side = np.linalg.norm(points[triangles[face][0]] - points[corner])
    assert exact.distance(face, near_corner) < 0.1 * side
    assert heat.distance(face, near_corner) < 0.2 * side
