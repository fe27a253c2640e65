# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds and targets between the vertices."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw
from hypothesis import given, settings
from hypothesis import strategies as st

settings.register_profile("seamwire", deadline=None, max_examples=300, derandomize=True)
settings.load_profile("seamwire")

POINTS, TRIANGLES = meshes.torus(12, 8)
SURFACE = sw.Surface(POINTS, TRIANGLES)
CURVATURE = sw.principal_curvatures(SURFACE)
STRETCHED = sw.embed(SURFACE, sw.feature_metric(SURFACE, CURVATURE, max_anisotropy=20), max_error=0)
PLANE_POINTS, PLANE_TRIANGLES = meshes.grid(6)
PLANE = sw.Surface(PLANE_POINTS, PLANE_TRIANGLES)
FLAT = sw.embed(PLANE, sw.euclidean_metric(PLANE, sw.principal_curvatures(PLANE)), max_error=0)


def point_of(faces: int) -> st.SearchStrategy[tuple[int, tuple[float, float, float]]]:
    """Points of faces, on edges and at corners too."""
    part = st.sampled_from([0.0, 1.0]) | st.floats(0, 1)

    def split(face: int, s: float, t: float) -> tuple[int, tuple[float, float, float]]:
        return face, (s * t, s * (1 - t), 1 - s)

    return st.builds(split, st.integers(0, faces - 1), part, part)


def place(points: np.ndarray, triangles: np.ndarray, at: tuple[int, tuple[float, float, float]]) -> np.ndarray:
    """Return where a point of a face is."""
    return np.array(at[1]) @ points[triangles[at[0]]]


@given(a=point_of(len(PLANE_TRIANGLES)), b=point_of(len(PLANE_TRIANGLES)))
def test_on_a_plane_all_ways_are_straight(
    a: tuple[int, tuple[float, float, float]], b: tuple[int, tuple[float, float, float]]
) -> None:
    field = sw.distance_field(FLAT, a)
    from_, to = (place(PLANE_POINTS, PLANE_TRIANGLES, p) for p in (a, b))
    scale = 1 / np.ptp(PLANE_POINTS, axis=0).max()
    assert field.distance(*b) == pytest.approx(scale * np.linalg.norm(to - from_), abs=1e-14)
    wire = field.trace_to(*b)
    np.testing.assert_allclose(wire.points[[0, -1]], [from_, to], atol=1e-14)
    assert wire.length == pytest.approx(field.distance(*b), abs=1e-14)


@given(a=point_of(len(TRIANGLES)), b=point_of(len(TRIANGLES)), vertex=st.integers(0, len(POINTS) - 1))
def test_distances_are_a_metric(
    a: tuple[int, tuple[float, float, float]], b: tuple[int, tuple[float, float, float]], vertex: int
) -> None:
    from_a, from_b, both = (sw.distance_field(STRETCHED, seed) for seed in (a, b, [a, b]))
    there = from_a.distance(*b)
    assert there >= 0
    assert from_b.distance(*a) == pytest.approx(there, rel=1e-11, abs=1e-14)
    assert there <= from_a.distances[vertex] + from_b.distances[vertex] + 1e-13
    np.testing.assert_allclose(both.distances, np.minimum(from_a.distances, from_b.distances), rtol=1e-11, atol=1e-14)
    wire = from_a.trace_to(*b)
    assert wire.length == pytest.approx(there, rel=1e-11, abs=1e-14)
    ends = [place(POINTS, TRIANGLES, p) for p in (a, b)]
    np.testing.assert_allclose(wire.points[[0, -1]], ends, atol=1e-13)
    stopped = sw.distance_field(STRETCHED, a, targets=[b])
    assert stopped.distance(*b) == pytest.approx(there, rel=1e-11, abs=1e-14)
    assert sw.distance_field(STRETCHED, a, max_distance=there / 2).distance(*b) == (0 if there == 0 else np.inf)


def test_a_vertex_is_the_same_by_number_and_by_coordinates() -> None:
    expected = sw.distance_field(STRETCHED, int(TRIANGLES[5][1]))
    field = sw.distance_field(STRETCHED, (5, (0, 1, 0)))
    np.testing.assert_array_equal(field.distances, expected.distances)
    assert field.seed == -1 or field.seed == TRIANGLES[5][1]
    assert sw.distance_field(STRETCHED, [3, 4]).seed == -1
    assert expected.radius == np.inf
    assert sw.distance_field(STRETCHED, 3, max_distance=0.25).radius == 0.25


@pytest.mark.parametrize(
    ("seed", "message"),
    [
        ((len(TRIANGLES), (1, 0, 0)), "seed: face 192 is out of range: there are 192 faces"),
        ((3, (0.5, 0.6, -0.1)), "seed: a barycentric coordinate is -0.1, not finite and 0 or more"),
        ((3, (0.5, float("nan"), 0.5)), "seed: a barycentric coordinate is nan, not finite and 0 or more"),
        ((3, (0.5, 0.5, 0.5)), "seed: the barycentric coordinates' sum is 1.5, not 1"),
        ([0, (3, (0.5, 0.5))], "seed 1: barycentric coordinates: expected real numbers"),
        ([0, 96], "seed 1: vertex 96 is out of range: there are 96 vertices"),
        ([0, None], "seed 1: expected a vertex number, or a face number with three coordinates, got a NoneType"),
        ([], "seed: expected at least one"),
    ],
)
def test_what_is_no_seed_is_refused(seed: object, message: str) -> None:
    with pytest.raises(ValueError) as refusal:
        sw.distance_field(STRETCHED, seed)
    assert str(refusal.value).startswith(message)


def test_a_face_without_an_area_is_told_from_a_hole() -> None:
    # Three corners in a line: no metric makes a triangle of them, and none lies beside it.
    surface = sw.Surface([(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    assert len(embedding.hole_faces) == 0
    field = sw.distance_field(embedding, 3)
    for call in (field.distance, field.trace_to):
        with pytest.raises(ValueError, match="point: face 0 has no area"):
            call(0, (0.2, 0.3, 0.5))
    with pytest.raises(ValueError, match="seed: face 0 has no area"):
        sw.distance_field(embedding, (0, (0.2, 0.3, 0.5)))
    alone = sw.Surface([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
    hole = sw.embed(alone, sw.euclidean_metric(alone, sw.principal_curvatures(alone)), max_error=0)
    assert hole.hole_faces.tolist() == [0]
    with pytest.raises(ValueError, match="point: face 0 is a hole of the embedding there"):
        sw.distance_field(hole, 0).distance(0, (0.2, 0.3, 0.5))


def test_long_traces_can_be_cancelled() -> None:
    # Along a narrow strip, over 6000 triangles.
    count = 3000
    x = np.repeat(np.arange(count + 1.0), 2)
    points = np.stack([0.01 * x, np.tile([0.0, 1.0], count + 1), 0 * x], -1)
    first = 2 * np.arange(count, dtype=np.int32)[:, None, None]
    strip = sw.Surface(points, (first + np.array([(0, 2, 1), (1, 2, 3)], np.int32)).reshape(-1, 3))
    field = sw.distance_field(
        sw.embed(strip, sw.euclidean_metric(strip, sw.principal_curvatures(strip)), max_error=0), 0
    )
    far, last = len(points) - 1, len(strip.triangles) - 1
    calls = {
        "trace": lambda progress: field.trace(far, progress=progress),
        "trace_to": lambda progress: field.trace_to(last, (0.2, 0.3, 0.5), progress=progress),
        "trace_many": lambda progress: field.trace_many([far], progress=progress),
        "snap_to_edges": lambda progress: sw.snap_to_edges(strip, field.trace(far), progress=progress),
    }
    for name, call in calls.items():
        fractions: list[float] = []
        call(fractions.append)
        assert fractions, name
        with pytest.raises(sw.Cancelled):
            call(lambda _: False)


def test_what_is_no_target_is_refused() -> None:
    field = sw.distance_field(STRETCHED, 0)
    for call in (field.distance, field.trace_to):
        with pytest.raises(ValueError, match=r"sum is 0\.5, not 1"):
            call(0, (0.5, 0, 0))
        with pytest.raises(ValueError, match="face -1 is out of range"):
            call(-1, (1, 0, 0))
    with pytest.raises(ValueError, match="target 1: vertex 96 is out of range"):
        sw.distance_field(STRETCHED, 0, targets=[0, 96])
    with pytest.raises(ValueError, match="max_distance is -1, not 0 or more"):
        sw.distance_field(STRETCHED, 0, max_distance=-1)


def nested(depth: int) -> tuple[object, ...]:
    """Return a pair of a number and a pair of a number and so on."""
    pair: tuple[object, ...] = (0, 0)
    for _ in range(depth):
        pair = (0, pair)
    return pair


HOLDS_ITSELF: list[object] = [0, 0]
HOLDS_ITSELF[1] = HOLDS_ITSELF


@pytest.mark.parametrize(
    "point", [HOLDS_ITSELF, nested(300_000), nested(2)], ids=["holds itself", "deep", "three deep"]
)
def test_points_within_points_are_refused(point: object) -> None:
    calls = {
        "distance_field": lambda: sw.distance_field(FLAT, point),
        "several seeds": lambda: sw.distance_field(FLAT, [point, point]),
        "seed": lambda: sw.LiveWire(PLANE).seed(point),
        "CutCurve": lambda: sw.CutCurve(PLANE_POINTS[:2], point),
        "plane_section": lambda: sw.plane_section(PLANE, point, 0, (0, 0, 1)),
    }
    for call in calls.values():
        with pytest.raises(ValueError, match="expected"):
            call()
