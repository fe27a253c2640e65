# SPDX-License-Identifier: GPL-3.0-or-later
"""Live wires as Python sees them."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import meshes
import numpy as np
import pytest
import seamwire_core as sw


def metric_of(surface: sw.Surface, curvature: sw.Curvature, follow: str) -> sw.Metric:
    """Return the metric of a wire across the surface, of the default strength."""
    if follow == "concave":
        return sw.concave_metric(surface, sw.smoothed_curvatures(surface, curvature, 0.01))
    return sw.feature_metric(surface, curvature, follow=follow, gamma=0.1)


def test_across_the_surface_gives_geodesics_and_their_edges(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live = sw.LiveWire(surface, max_error=0)
    live.seed(3)
    assert live.wait()
    assert live.progress() == 1
    found = live.wires(500)
    assert found.final
    assert found.settled
    assert [wire.follow for wire in found.wires] == ["concave", "min", "max"]
    assert [wire.metric.kind for wire in found.wires] == ["concave", "min", "max"]
    assert found.active == 0
    for wire in found.wires:
        metric = metric_of(surface, curvature, wire.follow)
        traced = sw.distance_field(sw.embed(surface, metric, max_error=0), 3).trace(500)
        np.testing.assert_array_equal(wire.points, traced.points)
        np.testing.assert_array_equal(wire.faces, traced.faces)
        np.testing.assert_array_equal(wire.vertices, sw.snap_to_edges(surface, traced))
        assert wire.length == traced.length


def test_from_point_to_point_within_faces(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live = sw.LiveWire(surface, max_error=0)
    seed, target = (40, (0.2, 0.5, 0.3)), (900, np.array([0.1, 0.8, 0.1]))
    live.seed(seed)
    live.wait()
    for wire in live.wires(target).wires:
        metric = metric_of(surface, curvature, wire.follow)
        traced = sw.distance_field(sw.embed(surface, metric, max_error=0), seed).trace_to(*target)
        np.testing.assert_array_equal(wire.points, traced.points)
        assert wire.length == traced.length
        assert [wire.vertices[0], wire.vertices[-1]] == [surface.triangles[40][1], surface.triangles[900][1]]


@pytest.mark.parametrize("through", [3, (40, (0.2, 0.5, 0.3))])
def test_closed_wires_are_those_of_the_field_in_pieces(
    surface: sw.Surface, curvature: sw.Curvature, through: object
) -> None:
    live = sw.LiveWire(surface, metric="concave")
    assert not live.closed_wires(through).final
    assert live.wait()
    found = live.closed_wires(through)
    assert found.final
    metrics = (
        sw.concave_metric(surface, sw.smoothed_curvatures(surface, curvature)),
        sw.euclidean_metric(surface, curvature),
    )
    loops = [sw.distance_field(sw.embed(surface, metric, max_error=0), through).closed_wires() for metric in metrics]
    assert found.cuts[0].id == (0, 0)
    assert len({cut.id for cut in found.cuts}) == len(found.cuts)
    for cut in found.cuts:
        metric, number = cut.id
        loop = loops[metric][number]
        assert cut.length == loop.length
        assert (cut.separates, cut.turn) == (loop.separates, loop.turn)
        assert (len(cut.pieces), len(cut.joints)) == (3, 2)
        lengths = [np.linalg.norm(np.diff(piece.points, axis=0), axis=1).sum() for piece in cut.pieces]
        assert sum(lengths) == pytest.approx(loop.euclidean_length)
        assert max(lengths) < 0.45 * sum(lengths)
        ends = [piece.points[[0, -1]] for piece in cut.pieces]
        for one, two, (face, weights) in zip(ends, ends[1:], cut.joints, strict=False):
            np.testing.assert_array_equal(one[1], two[0])
            np.testing.assert_allclose(weights @ surface.points[surface.triangles[face]], one[1], atol=1e-9)
        np.testing.assert_array_equal(ends[0][0], ends[-1][1])
        for piece, after in zip(cut.pieces, cut.pieces[1:] + cut.pieces[:1], strict=True):
            assert len(piece.faces) == len(piece.points) - 1
            assert piece.vertices[-1] == after.vertices[0]


@pytest.mark.parametrize("second", [300, (41, (0.2, 0.5, 0.3))])
def test_a_bent_wire_is_that_of_the_field_in_pieces(
    surface: sw.Surface, curvature: sw.Curvature, second: object
) -> None:
    live = sw.LiveWire(surface, metric="concave")
    assert not live.bent_wire(3, second).final
    assert live.wait()
    found = live.bent_wire(3, second)
    assert found.final
    (cut,) = found.cuts
    field = sw.distance_field(
        sw.embed(surface, sw.concave_metric(surface, sw.smoothed_curvatures(surface, curvature)), max_error=0), 3
    )
    there, back = field.bend(field.closed_wires()[0]).through(second)
    assert cut.length == there.length + back.length
    assert (len(cut.pieces), len(cut.joints)) == (4, 3)
    if isinstance(second, int):
        assert cut.joints[1] == second
    else:
        assert (cut.joints[1][0], tuple(cut.joints[1][1])) == second
    for piece, after in zip(cut.pieces, cut.pieces[1:] + cut.pieces[:1], strict=True):
        np.testing.assert_array_equal(piece.points[-1], after.points[0])
        assert piece.vertices[-1] == after.vertices[0]
    with pytest.raises(ValueError, match=r"second: .*not an edge"):
        live.bent_wire(3, (3, 4))
    with pytest.raises(ValueError, match="cut: expected a number that is not negative"):
        live.bent_wire(3, 300, (0, -1))
    with pytest.raises(ValueError, match="cut: expected the id of a LiveClosedWire"):
        live.bent_wire(3, 300, 0)


def test_closed_wires_lead_through_points_of_the_surface(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, max_error=0)
    with pytest.raises(ValueError, match="through: vertex 99999 is out of range"):
        live.closed_wires(99999)
    with pytest.raises(ValueError, match="not an edge"):
        live.closed_wires((3, 4))
    with pytest.raises(ValueError, match="across the surface, not along edges"):
        sw.LiveWire(surface, along="edges").closed_wires(3)


def test_what_is_no_point_of_a_face_is_refused(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, max_error=0)
    for wrong, why in (
        ((1920, (1, 0, 0)), "pick: face 1920 is out of range: there are 1920 faces"),
        ((5, (0.5, 0.6, -0.1)), "a barycentric coordinate is -0.1"),
        ((5, (0.5, 0.5, 0.5)), "sum is 1.5, not 1"),
        ((5, (0.5, 0.5)), "barycentric coordinates"),
    ):
        with pytest.raises(ValueError, match=why):
            live.seed(wrong)
    live.seed((5, (0.5, 0.2, 0.3)))
    with pytest.raises(ValueError, match="target: face -1 is out of range"):
        live.wires((-1, (1, 0, 0)))
    with pytest.raises(ValueError, match="along edges, wires connect vertices and edges"):
        sw.LiveWire(surface, along="edges").seed((5, (0.5, 0.2, 0.3)))


def test_along_edges_wires_connect_vertices_and_edges_only(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed(3)
    live.wait()
    assert live.wires(40).wires[0].vertices[0] == 3
    for place in ((5, (0.5, 0.2, 0.3)), (5, (1, 0, 0))):
        with pytest.raises(ValueError, match="target: along edges, wires connect vertices and edges"):
            live.wires(place)
        with pytest.raises(ValueError, match="seed: along edges, wires connect vertices and edges"):
            live.seed(place)
    assert live.wires(40).wires[0].vertices[0] == 3


def test_tells_what_became_of_its_embeddings(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live = sw.LiveWire(surface, max_anisotropy=30.0)
    live.seed(3)
    live.wait()
    for follow, told in zip(("min", "max"), live.embeddings()[1:], strict=True):
        embedding = sw.embed(
            surface, sw.feature_metric(surface, curvature, follow=follow, max_anisotropy=30.0), max_error=0
        )
        assert told is not None
        for name in ("invalid_left", "hit_cap", "clamped_edges", "worst_clamp"):
            assert getattr(told, name) == getattr(embedding, name)
    assert sw.LiveWire(surface, along="edges").embeddings() == (None, None)


def test_along_edges_gives_both_chains(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed((3, 4), forward=True)
    assert live.wait()
    for wire in live.wires((500, 501)).wires:
        metric = sw.feature_metric(surface, curvature, follow=wire.follow, max_anisotropy=10, clamp_percentile=99)
        chain = sw.edge_wires(surface, metric, (3, 4), forward=True).trace((500, 501))
        np.testing.assert_array_equal(wire.vertices, chain.vertices)
        np.testing.assert_array_equal(wire.points, surface.points[chain.vertices])
        assert wire.faces.shape == (0,)
        assert wire.length == chain.length
    metrics = [
        sw.feature_metric(surface, curvature, follow=follow, max_anisotropy=10, clamp_percentile=99)
        for follow in ("min", "max")
    ]
    loops = [sw.shortest_cycle(surface, metric, (3, 4)) for metric in metrics]
    live.loop((3, 4))
    assert live.wait()
    loop = live.loop((4, 3))
    assert loop.final
    assert loop.length == min(loop.length for loop in loops)
    assert loop.vertices.tolist() in [loop.vertices.tolist() for loop in loops]


def test_wires_come_without_waiting(large: sw.Surface) -> None:
    live = sw.LiveWire(large)
    live.seed(0)
    deadline = time.monotonic() + 60
    while not (both := live.wires(999)).final:
        for wire in both.wires:
            assert len(wire.points) > 0 or not wire.final
        assert 0 <= live.progress() <= 1
        assert time.monotonic() < deadline


def test_the_surface_may_go_before_the_wires() -> None:
    live = sw.LiveWire(sw.Surface(*meshes.torus(40, 24)))
    live.seed(0)
    live.wait()
    points = live.wires(100).wires[0].points
    copy = points.copy()
    del live
    np.testing.assert_array_equal(points, copy)


def test_it_may_go_in_the_middle_of_its_work(large: sw.Surface) -> None:
    for _ in range(3):
        live = sw.LiveWire(large)
        live.seed(0)
        del live


def test_waiting_ends_when_it_is_told_to(large: sw.Surface) -> None:
    live = sw.LiveWire(large)
    live.seed(0)
    for seconds in (0, 1e-3, -1, 0.0):
        assert not live.wait(seconds), "the work takes longer"
    assert live.wait(1e300)


def test_without_a_seed_there_are_no_wires(surface: sw.Surface) -> None:
    with pytest.raises(ValueError, match="no seed"):
        sw.LiveWire(surface, max_error=0).wires(0)


def test_edges_cannot_be_picked_across_the_surface(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, max_error=0)
    with pytest.raises(ValueError, match="vertex to vertex"):
        live.seed((0, 1))
    with pytest.raises(ValueError, match="along edges"):
        live.loop((0, 1))


def test_what_fails_on_a_thread_is_raised_to_the_caller(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, gamma=1e307)
    with pytest.raises(ValueError, match="too strong"):
        live.wait()


def test_the_metric_changes_in_the_background(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed(3)
    for metric, max_anisotropy in [
        ("feature", 30),
        ("campen", 5),
        ("pottmann_kovacs", 5),
        ("concave", 30),
        ("euclidean", None),
        ("concave", None),
        ("feature", None),
    ]:
        live.set_metric(metric, max_anisotropy=max_anisotropy)
        assert live.wait()
        fresh = sw.LiveWire(surface, along="edges", metric=metric, max_anisotropy=max_anisotropy)
        fresh.seed(3)
        assert fresh.wait()
        for got, expected in zip(live.wires(500).wires, fresh.wires(500).wires, strict=True):
            assert got.final
            assert got.length == expected.length
            np.testing.assert_array_equal(got.vertices, expected.vertices)
    for wrong in ({"metric": "manhattan"}, {"metric": "campen", "gamma": 2}, {"max_anisotropy": 0.5}):
        with pytest.raises(ValueError, match=r"metric|gamma|anisotropy"):
            live.set_metric(**wrong)


@pytest.mark.parametrize("along", ["surface", "edges"])
def test_in_the_euclidean_metric_there_is_one_wire(surface: sw.Surface, along: str) -> None:
    live = sw.LiveWire(surface, along=along, metric="euclidean")
    live.seed(3)
    assert live.wait()
    found = live.wires(500)
    assert len(found.wires) == 1
    assert found.final and found.settled and found.active == 0
    assert len(live.embeddings()) == 1


def test_a_wire_to_a_spike_is_there_at_once() -> None:
    live = sw.LiveWire(sw.Surface(*meshes.spike(1e-6)), metric="euclidean")
    live.seed(6)
    assert live.wait()
    live.wires((0, (0.2, 0.2, 0.6)))
    took = []
    for part in np.linspace(0.05, 0.45, 9):  # each is another point
        begin = time.thread_time()
        wire = live.wires((0, (part, part, 1 - 2 * part))).wires[0]
        took.append(time.thread_time() - begin)
        assert wire.length == pytest.approx(2 * part * np.sqrt(1.13), rel=1e-6)
    assert np.median(took) < 5e-3, "seconds of the processor"


def test_a_fork_has_a_seed_of_its_own(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed(3)
    fork = live.fork()
    with pytest.raises(ValueError, match="no seed"):
        fork.wires(500)
    fork.seed(77)
    assert live.wait()
    del live
    assert fork.wait()
    assert fork.wires(500).wires[0].vertices[0] == 77


def test_runs_on_straight(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, along="edges")
    assert live.wait()
    way = live.extend_straight((0, 1)).vertices
    assert way[0] == 1
    assert len(way) > 3
    np.testing.assert_array_equal(live.extend_straight((0, 1), [int(way[2]), 5]).vertices[:3], way[:3])
    assert len(live.extend_straight((0, 1), {int(way[2])}).vertices) == 3
    with pytest.raises(ValueError, match="stops"):
        live.extend_straight((0, 1), [10**6])


def test_strips_run_both_ways() -> None:
    n = 6
    points, triangles = meshes.torus(n, n)
    quads = [(n * v + u, n * v + (u + 1) % n) for v in range(n) for u in range(n)]
    quads += [(n * v + u, n * ((v + 1) % n) + u) for v in range(n) for u in range(n)]
    live = sw.LiveWire(sw.Surface(points, triangles, quads), along="edges")
    assert live.wait()
    ring = live.edge_loop((1, 2))
    assert ring.closed
    assert ring.vertices.dtype == np.int32
    assert ring.vertices.tolist() == [1, 2, 3, 4, 5, 0]
    part = live.edge_loop((1, 2), iter([0, 4]))
    assert not part.closed
    assert part.vertices.tolist() == [0, 1, 2, 3, 4]
    with pytest.raises(ValueError, match="no edge"):
        live.edge_loop((0, n + 1))
    with pytest.raises(ValueError, match="stops"):
        live.edge_loop((0, 1), [-1])


def test_tells_the_strength_of_features(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live = sw.LiveWire(surface, max_error=0)
    assert live.wait()
    strength = live.feature_strength()
    del live
    np.testing.assert_array_equal(strength, curvature.difference)


def test_segments_are_parted_by_rings() -> None:
    nu, nv = 24, 16
    points, triangles = meshes.torus(nu, nv)
    surface = sw.Surface(points, triangles)
    assert set(sw.face_segments(surface, np.empty((0, 2), np.int32))) == {0}
    cuts = [(nu * v + u, nu * ((v + 1) % nv) + u) for u in (0, 6) for v in range(nv)]
    labels = sw.face_segments(surface, np.array(cuts))
    assert labels.dtype == np.int32
    assert np.bincount(labels).tolist() == [18 * nv * 2, 6 * nv * 2]
    with pytest.raises(ValueError, match="out of range"):
        sw.face_segments(surface, [(0, 10**6)])


def test_scribbles_are_followed_and_forgotten(surface: sw.Surface) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed(0)
    assert live.wait()
    before = live.wires(300).wires[0].length
    stroke = surface.edges[:1].ravel()
    live.set_scribbles([sw.Scribble(surface.points[stroke], vertices=stroke)])
    assert live.wait()
    assert live.wires(300).wires[0].length != before
    live.set_scribbles([])
    assert live.wait()
    assert live.wires(300).wires[0].length == before


def building(n: int = 300, **options: object) -> sw.LiveWire:
    """Return live wires that build the surface of a torus of 2 n^2 triangles themselves."""
    return sw.LiveWire(*meshes.torus(n, n), **options)


def test_it_builds_the_surface_itself(surface: sw.Surface) -> None:
    for along in ("surface", "edges"):
        live = sw.LiveWire(surface.points, surface.triangles, along=along, max_error=0)
        fresh = sw.LiveWire(surface, along=along, max_error=0)
        for one in (live, fresh):
            one.seed(3)
            one.wires(500)
            assert one.wait()
        for got, expected in zip(live.wires(500).wires, fresh.wires(500).wires, strict=True):
            assert got.final
            assert got.length == expected.length
            np.testing.assert_array_equal(got.points, expected.points)
            np.testing.assert_array_equal(got.vertices, expected.vertices)
        assert fresh.surface is surface
        assert live.surface is live.surface
        np.testing.assert_array_equal(live.surface.edges, surface.edges)


def test_the_arrays_may_change_as_soon_as_it_is_made() -> None:
    points, triangles = meshes.torus(100, 80)
    given, edges = (points.copy(), triangles.copy()), np.array([(0, 1), (1, 2)])
    live = sw.LiveWire(*given, edges, along="edges")
    for array in (*given, edges):
        array[:] = 0
    assert live.wait_for_surface()
    np.testing.assert_array_equal(live.surface.points, points)
    np.testing.assert_array_equal(live.surface.triangles, triangles)
    assert live.surface.edges.tolist() == [[0, 1], [1, 2]]


def test_until_the_surface_is_there_nothing_is_final() -> None:
    live = building(along="edges")
    live.seed(0)
    answers = (
        live.progress(),
        live.wires(900).final,
        live.loop((0, 1)).final,
        len(live.extend_straight((0, 1)).vertices),
        len(live.edge_loop((0, 1)).vertices),
        live.feature_strength(),
    )
    if live.surface is not None:
        pytest.skip("this thread was kept away for so long that the surface is there")
    assert answers == (0, False, False, 0, 0, None)
    assert live.wait()
    assert live.wires(900).final
    assert live.loop((0, 1)).final


def test_both_ways_share_a_surface() -> None:
    live = building(60, along="edges")
    across = live.sibling(along="surface", max_anisotropy=5)
    fork = live.fork()
    across.seed(3)
    across.wires(900)
    assert across.wait()
    np.testing.assert_array_equal(across.surface.points, meshes.torus(60, 60)[0])
    assert live.wait()
    assert fork.wait()
    fresh = sw.LiveWire(live.surface, max_anisotropy=5)
    fresh.seed(3)
    fresh.wires(900)
    assert fresh.wait()
    assert across.wires(900).wires[0].length == fresh.wires(900).wires[0].length
    with pytest.raises(ValueError, match="along"):
        live.sibling(along="nowhere")


def test_it_may_go_while_the_surface_is_built() -> None:
    for _ in range(3):
        live = building(400)
        live.seed(0)
        del live


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the system does not list a process's threads")
def test_giving_one_up_does_not_wait_for_its_threads() -> None:
    points, triangles = meshes.grid(300)

    def count_threads() -> int:
        return len(list(Path("/proc/self/task").iterdir()))

    def settle() -> int:
        last = -1
        while last != (last := count_threads()):  # those of other tests may be ending
            time.sleep(0.05)
        return last

    def outlives() -> bool:
        before = settle()
        live = sw.LiveWire(points, triangles)
        live.seed(0)
        del live
        return count_threads() > before

    # The threads may be the faster ones once, not each time.
    assert any(outlives() for _ in range(10))


def test_every_call_raises_why_there_is_no_surface() -> None:
    points, triangles = meshes.torus(40, 24)
    triangles[7, 2] = len(points)
    with pytest.raises(ValueError, match="triangle 7: vertex 960 is out of range") as why:
        sw.Surface(points, triangles)
    live = sw.LiveWire(points, triangles, along="edges")
    for call in (
        live.wait,
        live.wait_for_surface,
        live.progress,
        live.fork,
        live.sibling,
        live.feature_strength,
        lambda: live.surface,
        lambda: live.seed(0),
        lambda: live.wires(0),
        lambda: live.loop((0, 1)),
        lambda: live.extend_straight((0, 1)),
        lambda: live.edge_loop((0, 1)),
        lambda: live.set_metric("euclidean"),
        lambda: live.set_scribbles([]),
    ):
        with pytest.raises(ValueError, match="triangle 7") as raised:
            call()
        assert str(raised.value) == str(why.value)


def test_a_seed_that_turns_out_to_be_none_is_refused_when_wires_are_asked_for() -> None:
    live = building(along="edges")
    try:
        live.seed((0, 777))
    except ValueError:
        pytest.skip("this thread was kept away for so long that the surface is there")
    assert live.wait()
    assert live.progress() == 1
    with pytest.raises(ValueError, match="no edge between the vertices 0 and 777"):
        live.wires(5)
    live.seed((0, 1))
    assert live.wait()
    assert live.wires(900).final


def test_what_can_be_told_without_a_surface_is_refused_at_once() -> None:
    points, triangles = meshes.torus(40, 24)
    for wrong, what in (
        ((points[:, :2], triangles), "points"),
        ((points, triangles[:, :2]), "triangles"),
        ((points, triangles, [0, 1]), "edges"),
        ((points, triangles.astype(float)), "triangles"),
        ((points, np.full((1, 3), 2**40)), "out of range"),
    ):
        with pytest.raises(ValueError, match=what):
            sw.LiveWire(*wrong)
    with pytest.raises(ValueError, match="anisotropy"):
        sw.LiveWire(points, triangles, max_anisotropy=0.5)
    with pytest.raises(TypeError):
        sw.LiveWire(points)
    live = building()
    with pytest.raises(ValueError, match="out of range"):
        live.seed(90_000)
    with pytest.raises(ValueError, match="no seed"):
        live.wires(0)


def test_across_the_surface_wires_are_final_once_they_are_refined(surface: sw.Surface, curvature: sw.Curvature) -> None:
    live, plain = sw.LiveWire(surface, max_error=0.0005), sw.LiveWire(surface, max_error=0)
    for each in (live, plain):
        each.seed(3)
        assert each.wait()
    early = live.wires(500)
    assert early.solved
    assert live.wait()
    found, unrefined = live.wires(500), plain.wires(500)
    assert found.final
    assert unrefined.final
    for wire, first in zip(found.wires, unrefined.wires, strict=True):
        assert wire.solved
        assert (wire.vertices[0], wire.vertices[-1]) == (3, 500)
        assert wire.length == pytest.approx(first.length, rel=0.2)
    assert any(wire.length != first.length for wire, first in zip(found.wires, unrefined.wires, strict=True))
    with pytest.raises(ValueError, match="max_error is 2"):
        sw.LiveWire(surface, max_error=2)
