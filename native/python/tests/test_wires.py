# SPDX-License-Identifier: GPL-3.0-or-later
"""From a mesh to wires, on meshes that are well and on meshes that are not."""

from __future__ import annotations

from itertools import pairwise

import meshes
import numpy as np
import pytest
import seamwire_core as sw


def distance_to_triangles(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Distance of points (n, 3), known to be near the planes, to triangles (n, 3, 3), by barycentric coordinates."""
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    w = points - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    det = uu * vv - uv**2
    s = ((w * u).sum(1) * vv - (w * v).sum(1) * uv) / det
    t = ((w * v).sum(1) * uu - (w * u).sum(1) * uv) / det
    weights = np.clip(np.stack([1 - s - t, s, t], 1), 0, None)
    weights /= weights.sum(1, keepdims=True)
    return np.linalg.norm((weights[:, :, None] * corners).sum(1) - points, axis=1)


def sides(triangles: np.ndarray) -> np.ndarray:
    """Edges (m, 3, 2) of triangles, the smaller vertex first."""
    return np.sort(np.stack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]], 1), 2)


def everything_found(size: float) -> dict[str, np.ndarray]:
    """Return what the library finds on a rough torus of some size, in parts of that size."""
    points, triangles = meshes.torus(24, 16)
    points = size * (points + np.random.default_rng(1).normal(0.0, 0.004, points.shape))
    surface = sw.Surface(points, triangles)
    curvature = sw.smoothed_curvatures(surface, sw.principal_curvatures(surface), 0.05)
    metric = sw.concave_metric(surface, curvature)
    embedding = sw.embed(surface, metric, max_error=0)
    field = sw.distance_field(embedding, 0)
    wire, inner = field.trace(100), (55, (0.2, 0.3, 0.5))
    cut = field.closed_wires()[0]
    there, back = field.bend(cut).through(inner)
    stroke = {"points": wire.points[:-1], "faces": wire.faces}
    hit = sw.RayTree(points, triangles).first_hit(size * np.array((0.35, 0.01, 3.0)), (0.0, 0.0, -1.0))
    live = sw.LiveWire(surface)
    live.closed_wires(inner)
    assert live.wait()
    joints = [joint for cut in live.closed_wires(inner).cuts for joint in cut.joints]
    return {
        "curvature": curvature.k1 * size,
        "distances": field.distances / size,
        "distance": np.array(field.distance(*inner)) / size,
        "wire": wire.points / size,
        "length": np.array((wire.euclidean_length, wire.length)) / size,
        "to a point": field.trace_to(*inner).points / size,
        "edges": sw.snap_to_edges(surface, wire),
        "closed": cut.points / size,
        "bent": np.concatenate([there.points, back.points]) / size,
        "joints": np.array([(joint[0], *joint[1]) for joint in joints]),
        "crests": sw.crest_lines(surface, curvature).points / size,
        "fitted": sw.fit_chain(surface, **stroke).vertices,
        "stroke": sw.apply_scribbles(surface, metric, [sw.Scribble(**stroke)]).tensors,
        "wide stroke": sw.apply_scribbles(surface, metric, [sw.Scribble(**stroke, radius=0.1 * size)]).tensors,
        "hit": np.array((hit[0], hit[1] / size)),
        "islands": sw.SeamPlanner(surface, along="edges").plan(distortion=float("inf"), steps=50).islands,
    }


def test_models_of_any_size_are_alike() -> None:
    expected = everything_found(1.0)
    for exponent in (-240, 240):  # about 1e-72 and 1e72
        found = everything_found(2.0**exponent)
        for name, value in expected.items():
            np.testing.assert_allclose(found[name], value, rtol=1e-9, atol=1e-12, err_msg=f"{name}, 2^{exponent}")


def test_a_wire_of_another_surface_is_not_snapped() -> None:
    points, triangles = meshes.torus(16, 12)
    surface, larger = sw.Surface(points, triangles), sw.Surface(2 * points, triangles)
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    wire = sw.distance_field(embedding, 0).trace(100)
    assert len(sw.snap_to_edges(surface, wire)) > 2
    with pytest.raises(ValueError, match="the wire is not on this surface"):
        sw.snap_to_edges(larger, wire)


def test_a_cut_through_another_seed_is_not_bent() -> None:
    surface = sw.Surface(*meshes.torus(60, 30))
    embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
    here, there = sw.distance_field(embedding, 0), sw.distance_field(embedding, 3)
    (cut, *_) = here.closed_wires()
    here.bend(cut)
    with pytest.raises(ValueError, match="the cut does not lead through the seed of the field"):
        there.bend(cut)


def test_a_traced_wire_is_as_long_as_the_distance(field: sw.DistanceField) -> None:
    for vertex, distance in enumerate(field.distances):
        wire = field.trace(vertex)
        assert wire.length == pytest.approx(distance, rel=1e-9, abs=1e-300)
        assert (wire.from_vertex, wire.to_vertex) == (3, vertex)


def test_a_wire_lies_on_the_faces_it_names(surface: sw.Surface, field: sw.DistanceField) -> None:
    for vertex in range(len(surface.points)):
        wire = field.trace(vertex)
        np.testing.assert_array_equal(wire.points[[0, -1]], surface.points[[3, vertex]])
        assert len(wire.faces) == len(wire.points) - 1
        corners = surface.points[surface.triangles[wire.faces]]
        for ends in (wire.points[:-1], wire.points[1:]):
            assert distance_to_triangles(ends, corners).max(initial=0) < 1e-12
        steps = np.linalg.norm(np.diff(wire.points, axis=0), axis=1)
        assert wire.euclidean_length == pytest.approx(steps.sum(), rel=1e-12)


def rod(around: int = 24, rows: int = 60) -> sw.Surface:
    """Return a closed rod of radius 0.1 and length 1 along z; vertex `around * row + i` is on a row."""
    along = 1.2 * (np.arange(rows) + 0.5) / rows
    radius, height = np.minimum(0.1, np.minimum(along, 1.2 - along)), np.clip(along - 0.1, 0, 1)
    angle = 2 * np.pi * np.arange(around) / around
    side = np.stack(
        [np.outer(radius, np.cos(angle)), np.outer(radius, np.sin(angle)), np.repeat(height[:, None], around, 1)], -1
    )
    i, j = np.meshgrid(np.arange(around), np.arange(rows - 1))
    a, b = (j * around + i).ravel(), (j * around + (i + 1) % around).ravel()
    ends = np.arange(around)
    last, bottom = (rows - 1) * around, around * rows
    triangles = np.concatenate(
        [
            np.stack([a, b, b + around], 1),
            np.stack([a, b + around, a + around], 1),
            np.stack([np.full(around, bottom), (ends + 1) % around, ends], 1),
            np.stack([np.full(around, bottom + 1), last + ends, last + (ends + 1) % around], 1),
        ]
    )
    return sw.Surface(np.concatenate([side.reshape(-1, 3), [[0, 0, 0], [0, 0, 1]]]), triangles)


def concave_field(surface: sw.Surface, seed: object) -> sw.DistanceField:
    curvature = sw.smoothed_curvatures(surface, sw.principal_curvatures(surface))
    return sw.distance_field(sw.embed(surface, sw.concave_metric(surface, curvature), max_error=0), seed)


@pytest.mark.parametrize("seed", [24 * 30, (24 * 30, (0.2, 0.3, 0.5))])
def test_around_a_limb_the_closed_wire_is_its_ring(seed: object) -> None:
    surface = rod()
    loops = concave_field(surface, seed).closed_wires()
    assert 1 <= len(loops) <= 3
    ring = loops[0]
    assert ring.separates
    assert ring.turn < 0.2
    assert ring.euclidean_length == pytest.approx(2 * np.pi * 0.1, rel=0.02)
    assert len(ring.faces) == len(ring.points) - 1
    np.testing.assert_allclose(ring.points[0], ring.points[-1], atol=1e-12)
    assert np.ptp(ring.points[:, 2]) < 0.025
    corners = surface.points[surface.triangles[ring.faces]]
    for ends in (ring.points[:-1], ring.points[1:]):
        assert distance_to_triangles(ends, corners).max() < 1e-9


def test_the_closed_wire_around_a_handle_does_not_separate() -> None:
    loops = concave_field(sw.Surface(*meshes.torus(60, 30)), 0).closed_wires(1)
    assert [loop.separates for loop in loops] == [False]
    assert "handle" in repr(loops[0])


@pytest.mark.parametrize("second", [24 * 33 + 12, (2 * 24 * 34 + 30, (0.2, 0.3, 0.5))])
def test_a_closed_wire_is_bent_to_a_second_point_and_leads_around_still(second: object) -> None:
    surface = rod()
    field = concave_field(surface, 24 * 30)
    bent = field.bend(field.closed_wires()[0])
    there, back = bent.through(second)
    np.testing.assert_array_equal(there.points[-1], back.points[0])
    np.testing.assert_array_equal(there.points[0], back.points[-1])
    face, weights = second if isinstance(second, tuple) else (None, None)
    place = surface.points[second] if face is None else weights @ surface.points[surface.triangles[face]]
    np.testing.assert_allclose(there.points[-1], place, atol=1e-12)
    points = np.vstack([there.points, back.points])
    angles = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    assert abs(angles[-1] - angles[0]) == pytest.approx(2 * np.pi)
    assert bent.through(24 * 30) is None, "the seed itself"


def test_what_is_not_bent_is_refused() -> None:
    surface = rod()
    field = concave_field(surface, 24 * 30)
    cut = field.closed_wires()[0]
    bent = field.bend(cut)
    for second, why in ((99999, "second: vertex 99999 is out of range"), ((3, 4), "not an edge")):
        with pytest.raises(ValueError, match=why):
            bent.through(second)
    small = sw.Surface(*meshes.grid(3))
    with pytest.raises(ValueError, match="the cut is of another embedding"):
        concave_field(small, 0).bend(cut)
    with pytest.raises(sw.Cancelled):
        field.bend(cut, progress=lambda _: False)


def test_where_nothing_suggests_one_there_is_no_closed_wire() -> None:
    assert concave_field(sw.Surface(*meshes.grid(12)), 80).closed_wires() == []
    assert concave_field(rod(), 24 * 60).closed_wires() == [], "from the middle of an end"


def test_closed_wires_refuse_what_they_cannot_be() -> None:
    surface = sw.Surface(*meshes.torus(20, 10))
    field = concave_field(surface, 0)
    assert field.closed_wires(0) == []
    with pytest.raises(ValueError, match="count: expected a number that is not negative"):
        field.closed_wires(-1)
    with pytest.raises(ValueError, match="closed wires lead through one seed: the field has 2"):
        concave_field(surface, [0, 5]).closed_wires()
    with pytest.raises(sw.Cancelled):
        field.closed_wires(progress=lambda _: False)


def test_a_snapped_wire_is_a_simple_chain_in_the_faces_around_it(surface: sw.Surface, field: sw.DistanceField) -> None:
    all_edges = set(map(tuple, surface.edges.tolist()))
    of_face = sides(surface.triangles)
    for vertex in range(0, len(surface.points), 7):
        wire = field.trace(vertex)
        path = sw.snap_to_edges(surface, wire)
        assert (path[0], path[-1]) == (3, vertex)
        assert len(set(path.tolist())) == len(path)
        steps = set(map(tuple, np.sort(np.stack([path[:-1], path[1:]], 1), 1).tolist()))
        assert steps <= all_edges
        crossed = set(map(tuple, of_face[wire.faces].reshape(-1, 2).tolist()))
        near = [f for f in of_face.tolist() if any(tuple(e) in crossed for e in f)]
        assert steps <= {tuple(e) for f in near for e in f}


def test_on_a_plane_wires_are_straight() -> None:
    surface = sw.Surface(*meshes.grid(10))
    euclidean = sw.euclidean_metric(surface, sw.principal_curvatures(surface))
    field = sw.distance_field(sw.embed(surface, euclidean, max_error=0), 0)
    np.testing.assert_allclose(field.distances, np.linalg.norm(surface.points, axis=1), rtol=1e-12)


def test_lengths_are_in_the_units_of_the_points() -> None:
    points, triangles = meshes.torus(24, 16)
    fields = []
    for unit in (1.0, 256.0):  # a power of two, so that not even rounding differs
        surface = sw.Surface(points * unit, triangles)
        metric = sw.feature_metric(surface, sw.principal_curvatures(surface))
        fields.append(sw.distance_field(sw.embed(surface, metric, max_error=0), 0))
    np.testing.assert_allclose(fields[0].distances * 256.0, fields[1].distances, rtol=1e-12)
    np.testing.assert_allclose(fields[0].trace(99).points * 256.0, fields[1].trace(99).points, rtol=1e-12)


def test_the_embedding_is_a_refined_mesh_with_valid_triangles(surface: sw.Surface, embedding: sw.Embedding) -> None:
    assert embedding.invalid_before > 0
    assert embedding.faces_added > 0
    assert (embedding.invalid_left, embedding.hit_cap) == (0, False)
    n = len(surface.points)
    np.testing.assert_array_equal(embedding.points[:n], surface.points)
    assert len(embedding.triangles) == len(surface.triangles) + embedding.faces_added
    length = {tuple(sorted(e)): x for e, x in zip(embedding.edges.tolist(), embedding.lengths, strict=True)}
    assert len(length) == len(embedding.edges)
    lengths = np.array([[length[tuple(e)] for e in f] for f in sides(embedding.triangles).tolist()])
    assert (lengths.sum(1) > 2 * lengths.max(1)).all()
    corners = surface.points[surface.triangles[embedding.source_face]]
    for i in range(3):
        assert distance_to_triangles(embedding.points[embedding.triangles[:, i]], corners).max() < 1e-12


def test_the_cap_on_new_faces_leaves_holes(surface: sw.Surface, metric: sw.Metric) -> None:
    embedding = sw.embed(surface, metric, max_faces_added=10, max_error=0)
    assert embedding.hit_cap
    assert embedding.invalid_left > 0
    assert embedding.faces_added <= 12


def test_an_embedding_says_how_well_it_resolves_the_metric(surface: sw.Surface, metric: sw.Metric) -> None:
    plain = sw.embed(surface, metric, max_error=0)
    assert plain.estimated_error is plain.unmet is None
    added = plain.faces_added
    for max_error in (0.02, 0.005):
        embedding = sw.embed(surface, metric, max_error=max_error)
        assert embedding.estimated_error <= max_error
        assert embedding.unmet == 0
        assert embedding.mean_edge_length == pytest.approx(plain.mean_edge_length, rel=0.1)
        assert embedding.faces_added > added
        added = embedding.faces_added
    assert embedding.with_lengths(embedding.lengths).estimated_error is None


def test_edge_wires_are_chains_of_real_edges(surface: sw.Surface, metric: sw.Metric) -> None:
    edges = set(map(tuple, surface.edges.tolist()))
    chains = sw.edge_wires(surface, metric, (0, 1))
    for target in (500, (500, 501), 2):
        chain = chains.trace(target)
        vertices = chain.vertices.tolist()
        assert {0, 1} == set(vertices[:2])
        assert all(tuple(sorted(step)) in edges for step in pairwise(vertices))
        assert 0 < chain.length < np.inf
    forward = sw.edge_wires(surface, metric, (0, 1), forward=True)
    assert forward.trace(500).vertices[:2].tolist() == [0, 1]
    loop = sw.shortest_cycle(surface, metric, (0, 1)).vertices.tolist()
    assert {0, 1} <= set(loop)
    assert all(tuple(sorted(step)) in edges for step in zip(loop, loop[1:] + loop[:1], strict=True))


def moebius(n: int) -> meshes.Mesh:
    a = np.linspace(0, 2 * np.pi, n, endpoint=False)
    rows = [
        np.stack([(1 + s * np.cos(a / 2)) * np.cos(a), (1 + s * np.cos(a / 2)) * np.sin(a), s * np.sin(a / 2)], 1)
        for s in (-0.3, 0.3)
    ]
    triangles = []
    for i in range(n):
        low, high = (i + 1, n + i + 1) if i + 1 < n else (n, 0)
        triangles += [[i, low, high], [i, high, n + i]]
    return np.concatenate(rows), np.array(triangles)


def soup(seed: int) -> meshes.Mesh:
    """Random triangles among few vertices, some of them in one place."""
    random = np.random.default_rng(seed)
    points = random.random((12, 3))
    points[random.integers(12, size=3)] = points[random.integers(12, size=3)]
    return points, random.integers(12, size=(random.integers(1, 25), 3))


def fin() -> meshes.Mesh:
    """Return a grid with more faces on an inner edge."""
    points, triangles = meshes.grid(4)
    points = np.concatenate([points, [[0.5, 0.5, 1], [0.5, 0.5, -1]]])
    return points, np.concatenate([triangles, [[11, 12, 25], [11, 12, 26], [12, 11, 25]]])


def sewn_wrong() -> meshes.Mesh:
    """Return a torus with every third face turned over, and with faces repeated."""
    points, triangles = meshes.torus(12, 8)
    triangles = triangles.copy()
    triangles[::3] = triangles[::3, ::-1]
    return points, np.concatenate([triangles, triangles[:20], triangles[5:9, [1, 2, 0]]])


def flat() -> meshes.Mesh:
    """Return a grid with a row of cells without an area, and a needle."""
    points, triangles = meshes.grid(6)
    points = points.copy()
    points[21:28, 1] = points[14:21, 1]
    points[-1] = points[-2] + [1e-13, 0, 0]
    return points, triangles


def islands() -> meshes.Mesh:
    points, triangles = meshes.joined(meshes.grid(3), meshes.torus(8, 6))
    return np.concatenate([points, np.full((5, 3), 7.0)]), triangles


NASTY = {
    "a single triangle": (np.eye(3), np.array([[0, 1, 2]])),
    "all in one place": (np.ones((4, 3)), np.array([[0, 1, 2], [1, 2, 3]])),
    "all on a line": (np.arange(5.0)[:, None] * np.ones(3), np.array([[0, 1, 2], [1, 2, 3], [2, 3, 4]])),
    "Moebius": moebius(24),
    "fin": fin(),
    "sewn wrong": sewn_wrong(),
    "flat": flat(),
    "islands": islands(),
    "tiny": (meshes.torus(12, 8)[0] * 1e-70, meshes.torus(12, 8)[1]),
    "huge": (meshes.torus(12, 8)[0] * 1e70, meshes.torus(12, 8)[1]),
    "far away": (meshes.torus(12, 8)[0] + 1e12, meshes.torus(12, 8)[1]),
} | {f"soup {seed}": soup(seed) for seed in range(30)}


@pytest.mark.parametrize("name", NASTY)
def test_nasty_meshes_go_all_the_way(name: str) -> None:
    """What edges connect is reachable, and what is reachable is traced and snapped."""
    try:
        surface = sw.Surface(*NASTY[name])
    except ValueError as error:
        assert "empty" in str(error)  # soup of nothing but degenerate triangles
        return
    curvature = sw.principal_curvatures(surface)
    group = np.arange(len(surface.points))
    for _ in group:
        low = group[surface.edges].min(1)
        np.minimum.at(group, surface.edges[:, 0], low)
        np.minimum.at(group, surface.edges[:, 1], low)
    seed = int(surface.edges[0, 0])
    for metric in (
        sw.feature_metric(surface, curvature, gamma=0.1, clamp_percentile=99),
        sw.feature_metric(surface, curvature, follow="max", max_anisotropy=10),
        sw.euclidean_metric(surface, curvature),
    ):
        assert np.isfinite(metric.tensors).all()
        embedding = sw.embed(surface, metric, max_faces_added=20_000, max_error=0)
        assert np.isfinite(embedding.lengths).all()
        field = sw.distance_field(embedding, seed)
        chains = sw.edge_wires(surface, metric, seed)
        for vertex, distance in enumerate(field.distances):
            connected = group[vertex] == group[seed]
            assert (chains.trace(vertex) is not None) == connected
            if vertex not in embedding.unreachable:
                assert np.isfinite(distance) == connected
            wire = field.trace(vertex)
            assert (wire is None) == np.isinf(distance)
            if wire is not None:
                assert wire.length == pytest.approx(distance, rel=1e-9)
                path = sw.snap_to_edges(surface, wire)
                assert (path[0], path[-1]) == (seed, vertex)
        for edge in surface.edges[::5]:
            sw.shortest_cycle(surface, metric, edge)


def test_edges_alone_carry_wires() -> None:
    surface = sw.Surface(np.eye(4, 3), np.empty((0, 3), int), [[0, 1], [1, 2]])
    metric = sw.euclidean_metric(surface, sw.principal_curvatures(surface))
    wire = sw.distance_field(sw.embed(surface, metric, max_error=0), 0).trace(2)
    assert wire.length == pytest.approx(2 * np.sqrt(2))
    assert wire.faces.tolist() == [-1, -1]
    assert sw.snap_to_edges(surface, wire).tolist() == [0, 1, 2]
    assert sw.distance_field(sw.embed(surface, metric, max_error=0), 0).distances[3] == np.inf


def test_a_wire_of_another_surface_is_refused(field: sw.DistanceField) -> None:
    with pytest.raises(ValueError, match="not on this surface"):
        sw.snap_to_edges(sw.Surface(*meshes.grid(3)), field.trace(500))
