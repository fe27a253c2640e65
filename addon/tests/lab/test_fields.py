# SPDX-License-Identifier: GPL-3.0-or-later
"""What a metric sees of a mesh, computed by the library."""

from __future__ import annotations

import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from seamwire.core.base.newest import Newest
from seamwire.core.solver.solver import by_number, kinds_of
from seamwire.terms.choices import METRICS
from seamwire_lab.fields import ELLIPSES, PATHS, FieldMaker, FieldRequest, Paths, at_vertices, band_levels, spread

sw = pytest.importorskip("seamwire_core")

ALL = frozenset({"STRENGTH", "CONCAVITY", "ELLIPSES", "DISTANCE", "PATHS", "ISOLINES", "INVALID"})


def torus(nu: int = 40, nv: int = 24) -> tuple[np.ndarray, np.ndarray]:
    u, v = np.meshgrid(2 * np.pi * np.arange(nu) / nu, 2 * np.pi * np.arange(nv) / nv)
    ring = 0.35 + 0.15 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.15 * np.sin(v)], -1).reshape(-1, 3)
    i, j = (part.ravel() for part in np.meshgrid(np.arange(nu), np.arange(nv)))
    a, b = j * nu + i, j * nu + (i + 1) % nu
    c, d = (j + 1) % nv * nu + i, (j + 1) % nv * nu + (i + 1) % nu
    return points, np.stack([a, b, d, a, d, c], 1).reshape(-1, 3)


def maker(*mesh: np.ndarray) -> FieldMaker:
    return FieldMaker(sw, lambda: sw.Surface(*(mesh or torus())))


def test_all_that_is_shown_is_of_the_mesh_that_it_is_asked_for() -> None:
    points, _ = torus()
    made = maker().make(FieldRequest(ALL, strength=20.0, kind="max", source=3))
    assert made.strength.shape == made.concavity.shape == made.distance.shape == (len(points),)
    # Convex outside, k1 is 1 / r everywhere.
    assert made.concavity == pytest.approx(np.full(len(points), 1 / 0.15), rel=0.05)
    assert made.distance[3] == 0.0
    assert made.invalid.before > 0
    assert len(made.invalid.split) == made.invalid.before
    assert len(made.invalid.left) == len(made.invalid.repaired) == 0
    assert made.ellipses.anisotropy.max() == pytest.approx(20.0, rel=1e-6)
    sizes = np.linalg.norm(made.ellipses.axes, axis=2)
    assert sizes[:, 0] / sizes[:, 1] == pytest.approx(made.ellipses.anisotropy)
    assert np.median(np.sqrt(sizes.prod(axis=1))) <= 0.34 * made.ellipses.spacing
    assert sizes.max() <= 1.5001 * made.ellipses.spacing
    bands = np.linalg.norm(made.isolines.segments[:, 0] - made.isolines.segments[:, 1], axis=1)
    assert bands.max() < 0.1
    assert made.paths.lengths.max() == pytest.approx(made.distance.max(), rel=0.2)


@pytest.mark.parametrize("eye", [(0.0, 0.0, 1.0, 0.0), (3.0, 1.0, 2.0, 1.0), (0.1, -0.2, -5.0, 1.0)])
def test_a_silhouette_is_where_normals_are_square_to_the_view(eye: tuple[float, ...]) -> None:
    made = maker(*torus(160, 96)).make(FieldRequest(frozenset({"SILHOUETTE"})))
    pieces = made.silhouette.seen_from(np.array(eye))
    assert len(pieces) > 100
    middles = pieces.mean(axis=1)
    ring = np.hypot(middles[:, 0], middles[:, 1])
    normals = np.stack([middles[:, 0] * (1 - 0.35 / ring), middles[:, 1] * (1 - 0.35 / ring), middles[:, 2]], axis=1)
    towards = np.array(eye[:3]) - eye[3] * middles
    cosines = np.einsum("ij,ij->i", normals, towards)
    cosines /= np.linalg.norm(normals, axis=1) * np.linalg.norm(towards, axis=1)
    assert np.abs(cosines).max() < 0.01
    # Of a closed surface it is closed: each end is that of another piece.
    _, counts = np.unique(np.round(pieces.reshape(-1, 3), 12), axis=0, return_counts=True)
    assert (counts % 2 == 0).all()


def test_without_a_source_nothing_of_distances_is_made() -> None:
    made = maker().make(FieldRequest(ALL))
    assert made.distance is made.paths is made.isolines is None
    assert made.strength is not None


def test_what_is_asked_for_again_in_another_way_is_made_of_what_is_there() -> None:
    calls: list[str] = []

    class Counting:
        Cancelled = sw.Cancelled

        def __getattr__(self, name: str) -> object:
            calls.append(name)
            return getattr(sw, name)

    fields = FieldMaker(Counting(), lambda: sw.Surface(*torus()))
    first = FieldRequest(frozenset({"STRENGTH"}), source=3)
    fields.make(first)
    fields.make(replace(first, parts=frozenset({"PATHS"})))
    fields.make(replace(first, parts=frozenset({"PATHS", "ISOLINES"})))
    made = {name: calls.count(name) for name in ("principal_curvatures", "embed", "distance_field")}
    assert set(made.values()) == {1}
    fields.make(replace(first, parts=frozenset({"PATHS"}), source=4))
    fields.make(replace(first, parts=frozenset({"PATHS"}), strength=5.0))
    assert (calls.count("embed"), calls.count("distance_field")) == (2, 3)


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize("follow", ["min", "max"])
def test_distances_are_as_long_as_the_wires_of_the_same_settings(metric: str, follow: str) -> None:
    points, triangles = torus()
    live = sw.LiveWire(
        points, triangles, max_anisotropy=8.0, clamp_percentile=95.0, metric=metric, along="surface", max_error=0.0
    )
    live.seed(3)
    live.wait()
    wires, _ = by_number(live.wires(250))
    if follow == "max" and len(wires) == 1:
        pytest.skip("such a metric has one wire alone")
    wire = wires[("min", "max").index(follow)]
    kinds = kinds_of(metric)
    kind = kinds[min(("min", "max").index(follow), len(kinds) - 1)]
    made = maker().make(FieldRequest(frozenset({"DISTANCE"}), metric, 8.0, 95.0, kind, 3))
    assert made.distance[250] == pytest.approx(wire.length, rel=1e-9)


def test_strokes_are_part_of_the_metric_as_they_are_of_wires() -> None:
    points, triangles = torus()
    stroke = sw.Scribble(points[[83, 84, 85, 86]], vertices=[83, 84, 85, 86], rings=3)
    live = sw.LiveWire(points, triangles, max_anisotropy=8.0, along="surface", max_error=0.0)
    live.set_scribbles([stroke])
    live.seed(3)
    live.wait()
    wire = next(wire for wire in live.wires(250).wires if wire.follow == "min")
    plain = FieldRequest(frozenset({"DISTANCE"}), "feature", 8.0, 100.0, "min", 3)
    fields = maker()
    assert fields.make(replace(plain, strokes=(stroke,))).distance[250] == pytest.approx(wire.length, rel=1e-9)
    assert fields.make(plain).distance[250] != pytest.approx(wire.length, rel=1e-9)


def test_distances_are_from_points_of_triangles_and_from_edges_too() -> None:
    _, triangles = torus()
    middle = maker().make(FieldRequest(frozenset({"DISTANCE"}), source=(7, (0.2, 0.3, 0.5)))).distance
    assert 0.0 < middle[triangles[7]].min() < 0.1
    edge = maker().make(FieldRequest(frozenset({"DISTANCE"}), source=(0, 1))).distance
    assert edge[0] == edge[1] == 0.0


def test_the_newest_request_wins_and_a_thread_computes_it() -> None:
    mesh = torus(120, 80)
    fields = FieldMaker(sw, lambda: sw.Surface(*mesh), lambda: not thread.superseded)
    thread = Newest(fields.make, "test", (sw.Cancelled,))
    for source in range(6):
        thread.want(FieldRequest(frozenset({"DISTANCE"}), source=source))
    end = time.monotonic() + 30.0
    while thread.busy and time.monotonic() < end:
        time.sleep(0.01)
    assert thread.answer.request.source == 5
    assert thread.answer.distance[5] == 0.0
    thread.close()


def test_a_computation_ends_as_soon_as_it_is_told_to() -> None:
    fields = FieldMaker(sw, lambda: sw.Surface(*torus()), lambda: False)
    with pytest.raises(sw.Cancelled):
        fields.make(FieldRequest(frozenset({"DISTANCE"}), source=0))


def waves(n: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices and triangles of a sheet with a top at x = .5 and bottoms at .25 and .75."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
    points = np.stack([x / n, y / n, 0.04 * np.cos(4 * np.pi * x / n)], axis=1)
    i, j = (part.ravel() for part in np.meshgrid(np.arange(n), np.arange(n)))
    a, b, c, d = j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i, (j + 1) * (n + 1) + i + 1
    return points, np.stack([a, b, d, a, d, c], axis=1).reshape(-1, 3)


def test_vertices_beside_ridges_and_valleys_have_their_strengths_and_others_none() -> None:
    points, _ = waves()
    values = maker(*waves()).crests_at_vertices()
    top = np.abs(points[:, 0] - 0.5) < 0.03
    bottom = np.abs(points[:, 0] - 0.25) < 0.03
    assert values[top].max() > 1.0
    assert values[top].min() == 0.0
    assert values[bottom].min() < -1.0
    assert values[bottom].max() == 0.0
    assert (values[np.abs(points[:, 0] - 0.375) < 0.05] == 0.0).all()


def test_where_lines_pass_one_vertex_the_stronger_counts() -> None:
    # Two lines pass vertex 5. The second is a valley.
    crossed = SimpleNamespace(
        edges=np.array([[4, 5], [5, 6], [6, 7], [5, 8], [8, 9]], dtype=np.int32),
        t=np.array([0.9, 0.1, 0.4, 0.0, 1.0]),
        curvatures=np.array([2.0, 2.0, 2.0, -1.0, -1.0]),
        starts=np.array([0, 3, 5], dtype=np.int32),
        strengths=np.array([4.0, 1.5]),
    )
    assert at_vertices(crossed, 11).tolist() == [0, 0, 0, 0, 0, 4.0, 4.0, 0, 0, -1.5, 0]


def test_paths_in_pieces_join_no_two_paths() -> None:
    points = np.arange(21.0).reshape(7, 3)
    paths = Paths(points, np.array([0, 3, 3, 7]), np.array([1.0, np.inf, 2.0]))
    pieces, lengths = paths.segments()
    assert pieces.tolist() == [[points[i].tolist(), points[i + 1].tolist()] for i in (0, 1, 3, 4, 5)]
    assert lengths.tolist() == [1.0, 1.0, 2.0, 2.0, 2.0]


def test_chosen_points_are_few_and_spread_over_all() -> None:
    rng = np.random.default_rng(1)
    points = rng.normal(size=(20_000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    for count in (1, 10, PATHS, ELLIPSES):
        chosen, side = spread(points, count)
        assert 0 < len(chosen) <= count
        assert len(chosen) > 0.5 * count
        assert len(np.unique(chosen)) == len(chosen)
        # Nothing is farther from a chosen one than across a cube.
        far = np.linalg.norm(points[:500, None] - points[chosen], axis=2).min(axis=1)
        assert far.max() <= np.sqrt(3) * side
    every, side = spread(points[:50], 50)
    assert (len(every), side) == (50, 0.0)
    flat = np.zeros((100, 3))
    assert len(spread(flat, 5)[0]) == 1


@pytest.mark.parametrize(("largest", "step"), [(1.0, 0.05), (3.7, 0.2), (0.021, 0.001), (800.0, 50.0)])
def test_bands_are_evenly_spaced_at_round_numbers(largest: float, step: float) -> None:
    levels = band_levels(largest)
    assert levels[0] == pytest.approx(step)
    assert np.diff(levels) == pytest.approx(np.full(len(levels) - 1, step))
    assert levels[-1] <= largest < levels[-1] + 1.001 * step
    assert len(band_levels(0.0)) == 0
