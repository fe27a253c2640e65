# SPDX-License-Identifier: GPL-3.0-or-later
"""What views show, as arrays: isolines, ellipses, many paths, invalid triangles."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw


def grid(n: int) -> sw.Surface:
    return sw.Surface(*meshes.grid(n))


def test_isolines_of_exact_distances_on_a_plane_are_chords_of_circles() -> None:
    surface = grid(40)
    curvature = sw.principal_curvatures(surface)
    middle = 20 * 41 + 20
    field = sw.distance_field(sw.embed(surface, sw.euclidean_metric(surface, curvature), max_error=0), middle)
    radii = [0.1, 0.2, 0.3, 0.45]
    segments, faces, levels = sw.isolines(surface, field.distances, radii)
    assert segments.shape[1:] == (2, 3)
    assert len(segments) == len(faces) == len(levels)
    away = np.linalg.norm(segments - surface.points[middle], axis=2)
    for level, radius in enumerate(radii):
        mine = levels == level
        # Linear along edges of up to h: off by h^2 / 8 r.
        assert np.abs(away[mine] - radius).max() <= (np.sqrt(2) / 40) ** 2 / (8 * radius) + 1e-12
        around = np.linalg.norm(np.diff(segments[mine], axis=1), axis=2).sum()
        assert around == pytest.approx(2 * np.pi * radius, rel=0.01)
    inside = surface.points[surface.triangles[faces]]
    assert (segments.min(1) >= inside.min(1) - 1e-12).all()
    assert (segments.max(1) <= inside.max(1) + 1e-12).all()


def waves(n: int) -> tuple[sw.Surface, np.ndarray]:
    """Return a sheet of two waves along x, and where their tops and bottoms are."""
    points, triangles = meshes.grid(n)
    points[:, 2] = 0.04 * np.cos(4 * np.pi * points[:, 0])
    return sw.Surface(1000.0 * points, triangles), 1000.0 * np.array([0.25, 0.5, 0.75])


def test_crest_lines_of_waves_are_ridges_on_tops_and_valleys_on_bottoms() -> None:
    surface, places = waves(40)
    lines = sw.crest_lines(surface, sw.smoothed_curvatures(surface, sw.principal_curvatures(surface)))
    assert len(lines.starts) == len(lines.strengths) + 1
    assert lines.starts[-1] == len(lines.points) == len(lines.edges) == len(lines.t) == len(lines.faces)
    assert (np.diff(lines.strengths) <= 0.0).all()
    middles = [lines.points[i:j].mean(axis=0)[0] for i, j in zip(lines.starts, lines.starts[1:], strict=False)]
    for place, sign in zip(places, (-1, 1, -1), strict=True):
        (line,) = np.flatnonzero(np.abs(middles - place) < 60)
        mine = slice(lines.starts[line], lines.starts[line + 1])
        assert np.abs(lines.points[mine, 0] - place).max() < 1000 / 40 / 2
        assert np.ptp(lines.points[mine, 1]) > 900
        assert (np.sign(lines.curvatures[mine]) == sign).all()
    ends = surface.points[lines.edges]
    there = ends[:, 0] + lines.t[:, None] * (ends[:, 1] - ends[:, 0])
    np.testing.assert_allclose(there, lines.points, atol=1e-9)
    inside = lines.faces >= 0
    assert (inside.sum(), (~inside).sum()) == (len(lines.points) - len(lines.strengths), len(lines.strengths))
    with pytest.raises(ValueError, match="read-only"):
        lines.points[0] = 0.0


def test_where_a_closed_chain_begins_makes_no_difference_to_crest_lines() -> None:
    around, across, lobes = 48, 24, 5
    _, triangles = meshes.torus(around, across)
    u = np.tile(np.arange(around), across) * 2 * np.pi / around
    v = np.arange(across).repeat(around) * 2 * np.pi / across
    # A ring that is sharp in some places only.
    off = np.exp(-((np.minimum(v, 2 * np.pi - v) / 0.35) ** 2))
    radius = 0.15 * (1 + 0.2 * (1 + np.cos(lobes * u)) * off)
    out = 0.4 + radius * np.cos(v)
    points = np.stack([out * np.cos(u), out * np.sin(u), radius * np.sin(v)], axis=1)
    strengths = []
    for shift in range(0, len(triangles), 97):
        surface = sw.Surface(points, np.roll(triangles, shift, axis=0))
        lines = sw.crest_lines(surface, sw.smoothed_curvatures(surface, sw.principal_curvatures(surface)))
        strengths.append(lines.strengths)
    assert len(strengths[0]) > 0
    for other in strengths:
        np.testing.assert_allclose(other, strengths[0], rtol=1e-9)


def test_crest_lines_are_none_on_a_torus_and_name_what_is_wrong(surface: sw.Surface, curvature: sw.Curvature) -> None:
    assert len(sw.crest_lines(surface, curvature).strengths) == 0
    assert len(sw.crest_lines(surface, curvature).points) == 0
    with pytest.raises(ValueError, match=r"least_drop is 2, not in \[0, 1\)"):
        sw.crest_lines(surface, curvature, least_drop=2.0)
    with pytest.raises(ValueError, match="curvature of 960 vertices for a surface of 9"):
        sw.crest_lines(grid(2), curvature)
    with pytest.raises(sw.Cancelled):
        sw.crest_lines(surface, curvature, progress=lambda _: False)


def test_a_plane_section_is_straight_as_seen_along_its_direction() -> None:
    surface, _ = waves(24)
    direction = np.array([0.2, -0.1, 1.0])
    start, end = 3, 25 * 25 - 4
    points, faces, length = sw.plane_section(surface, start, end, direction)
    np.testing.assert_array_equal(points[[0, -1]], surface.points[[start, end]])
    assert len(faces) == len(points) - 1
    assert length == pytest.approx(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    normal = np.cross(direction, points[-1] - points[0])
    np.testing.assert_allclose((points - points[0]) @ normal / np.linalg.norm(normal), 0.0, atol=1e-9)
    inside = sw.plane_section(surface, (40, (0.2, 0.3, 0.5)), (900, [0.4, 0.4, 0.2]), [0, 0, 2])
    assert np.isfinite(inside[2])
    assert inside[1][[0, -1]].tolist() == [40, 900]
    # Two sheets beside each other: nothing leads over.
    pair = sw.Surface(*meshes.joined(meshes.grid(2), meshes.grid(2)))
    none = sw.plane_section(pair, 0, 13, [0, 0, 1])
    assert (none[0].shape, none[1].shape, none[2]) == ((0, 3), (0,), np.inf)


@pytest.mark.parametrize(
    ("ends", "direction", "message"),
    [
        ((0, 0), [0, 0, 1], "both points are the same"),
        ((0, 1), [1, 0, 0], "it makes no plane with them"),
        ((0, 1), [0, 1], "direction: expected 3 numbers, got 2"),
        ((0, 9), [0, 0, 1], "to_point"),
    ],
)
def test_what_makes_no_plane_is_named(ends: tuple[int, int], direction: list, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.plane_section(grid(2), *ends, direction)


def test_ellipses_have_the_axes_of_their_tensors(metric: sw.Metric) -> None:
    norm, reach = metric.ellipses(), metric.ellipses("reach")
    values = np.linalg.eigvalsh(metric.tensors)[:, 1:]  # the least is the normal's, 0
    np.testing.assert_allclose(np.linalg.norm(norm, axis=2), values[:, ::-1], rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(reach, axis=2), values**-0.5, rtol=1e-9)
    for axes in (norm, reach):
        np.testing.assert_allclose(np.einsum("nac,nc->na", axes, metric.normals), 0.0, atol=1e-9)
        np.testing.assert_allclose(np.einsum("nc,nc->n", axes[:, 0], axes[:, 1]), 0.0, atol=1e-9)
    # A vector of the ellipse of reach has length 1 in the metric.
    for vectors in (reach[:, 0], reach[:, 1], (reach[:, 0] + reach[:, 1]) / np.sqrt(2)):
        np.testing.assert_allclose(np.einsum("na,nab,nb->n", vectors, metric.tensors, vectors), 1.0, rtol=1e-9)
    with pytest.raises(ValueError, match="of: expected 'norm' or 'reach', got 'ball'"):
        metric.ellipses("ball")


def test_many_paths_are_those_traced_one_by_one(field: sw.DistanceField) -> None:
    vertices = np.arange(0, len(field.distances), 3)
    points, starts, lengths = field.trace_many(vertices)
    assert starts[0] == 0
    assert starts[-1] == len(points)
    for i, vertex in enumerate(vertices):
        wire = field.trace(int(vertex))
        np.testing.assert_array_equal(points[starts[i] : starts[i + 1]], wire.points)
        assert lengths[i] == wire.length
    none = field.trace_many([])
    assert [len(part) for part in none] == [0, 1, 0]
    with pytest.raises(ValueError, match="out of range"):
        field.trace_many([0, len(field.distances)])


def test_metric_lengths_are_those_of_edges_that_are_not_bisected(
    surface: sw.Surface, metric: sw.Metric, embedding: sw.Embedding
) -> None:
    lengths = dict(zip(map(tuple, surface.edges.tolist()), sw.metric_lengths(surface, metric), strict=True))
    whole = [
        (lengths[min(a, b), max(a, b)], length)
        for (a, b), length in zip(embedding.edges.tolist(), embedding.lengths, strict=True)
        if (min(a, b), max(a, b)) in lengths
    ]
    assert len(whole) > 0.5 * len(lengths)
    ours, theirs = np.transpose(whole)
    np.testing.assert_allclose(ours, theirs, rtol=1e-12)
    with pytest.raises(ValueError, match="another surface"):
        sw.metric_lengths(grid(3), metric)


def test_an_embedding_takes_lengths_of_ones_own() -> None:
    surface = grid(12)
    plain = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    stretched = surface.points * (3.0, 1.0, 1.0)
    ends = stretched[plain.edges]
    own = plain.with_lengths(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
    away = np.linalg.norm(stretched - stretched[0], axis=1)
    np.testing.assert_allclose(sw.distance_field(own, 0).distances, away, atol=1e-12)
    before = np.linalg.norm(surface.points - surface.points[0], axis=1)
    np.testing.assert_allclose(sw.distance_field(plain, 0).distances, before, atol=1e-12)
    for wrong, why in (
        (plain.lengths[:-1], "edges"),
        (np.where(np.arange(len(plain.lengths)) == 0, 0.0, plain.lengths), "positive"),
        (np.where(np.arange(len(plain.lengths)) == 0, 9.0, plain.lengths), "triangle"),
        (1e200 * plain.lengths, "at most 1e76"),
        (1e-200 * plain.lengths, "at least 1e-76"),
    ):
        with pytest.raises(ValueError, match=why):
            plain.with_lengths(wrong)


def test_invalid_faces_are_those_that_are_bisected(
    surface: sw.Surface, metric: sw.Metric, embedding: sw.Embedding
) -> None:
    faces = sw.invalid_faces(surface, metric)
    assert len(faces) == embedding.invalid_before > 0
    pieces = np.bincount(embedding.source_face, minlength=len(surface.triangles))
    assert (pieces[faces] > 1).all()
    assert len(embedding.hole_faces) == len(embedding.repaired_faces) == 0
    few = sw.embed(surface, metric, max_faces_added=2, max_error=0)
    assert few.invalid_left > 0
    pieces = np.bincount(few.source_face, minlength=len(surface.triangles))
    assert set(few.hole_faces) <= set(faces) | set(np.flatnonzero(pieces > 1))


@pytest.mark.parametrize(
    ("values", "levels", "message"),
    [
        (np.zeros(3), [0.0], "values of 3 vertices given for a surface of 9"),
        (np.full(9, np.nan), [0.0], "the value of vertex 0 is not a number"),
        (np.zeros(9), [1.0, 0.0], "levels are not ascending: level 1 is 0, after 1"),
        (np.zeros((9, 1)), [0.0], r"values: expected real numbers of shape \(n,\), got shape \(9, 1\)"),
        (np.zeros(9), ["a"], "levels: expected real numbers"),
    ],
)
def test_wrong_values_and_levels_are_named(values: np.ndarray, levels: list, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.isolines(grid(2), values, levels)


@pytest.mark.parametrize("exponent", [-1000, -500, -200, 200, 500, 1000])
def test_nearest_points_do_not_depend_on_the_size_of_the_model(exponent: int) -> None:
    points, triangles = meshes.torus(12, 8)
    places = points[::3] * [1.5, 0.7, 2.0] + 0.1
    normals = np.random.default_rng(1).normal(size=places.shape)
    expected = sw.NearestPoints(points, triangles).find(places, normals)
    size = 2.0**exponent
    found = sw.NearestPoints(size * points, triangles).find(size * places, size * normals)
    np.testing.assert_array_equal(found[0], expected[0])
    np.testing.assert_allclose(found[1] / size, expected[1], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found[2] / size, expected[2], rtol=1e-12)


def test_a_place_far_from_tiny_triangles_has_a_distance() -> None:
    points, triangles = meshes.torus(12, 8)
    _, _, distances = sw.NearestPoints(1e-150 * points, triangles).find([[1e200, 0.0, 0.0]])
    np.testing.assert_allclose(distances, 1e200)
