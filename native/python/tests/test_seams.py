# SPDX-License-Identifier: GPL-3.0-or-later
"""Planned seams as Python sees them."""

from __future__ import annotations

import gc
import threading

import meshes
import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray


@pytest.fixture(scope="module")
def torus() -> sw.Surface:
    return sw.Surface(*meshes.torus(20, 12))


@pytest.fixture(scope="module")
def planner(torus: sw.Surface) -> sw.SeamPlanner:
    return sw.SeamPlanner(torus, along="edges")


def edges_of(plan: sw.SeamPlan) -> np.ndarray:
    pairs = [np.column_stack([wire.vertices[:-1], wire.vertices[1:]]) for wire in plan.wires]
    return np.concatenate([np.empty((0, 2), dtype=np.int32), *pairs])


def test_a_plan_describes_islands_wires_and_a_map(torus: sw.Surface, planner: sw.SeamPlanner) -> None:
    plan = planner.plan(distortion=4.5, steps=200)
    np.testing.assert_array_equal(plan.islands, sw.face_segments(torus, edges_of(plan)))
    assert plan.island_count == plan.islands.max() + 1 == 1
    assert plan.islands_to_cut == 0
    assert plan.is_reached == (plan.energy <= 4.5)
    assert plan.cost > 0.0
    assert plan.steps > 0.0
    for wire in plan.wires:
        assert wire.seeds == (wire.vertices[0], wire.vertices[-1])
        assert wire.follow in {"min", "max"}
        np.testing.assert_array_equal(wire.points, torus.points[wire.vertices])
    assert plan.uvs is not None
    assert plan.uvs.shape == (len(torus.triangles), 3, 2)
    report = sw.measure_map(torus.points, torus.triangles, plan.uvs, plan.islands)
    assert not len(report.flipped)
    assert not len(report.overlapping)
    assert report.energy == pytest.approx(plan.energy, rel=0.02)


def test_a_lower_bound_needs_more_seams(planner: sw.SeamPlanner) -> None:
    discs, low, high = (planner.plan(distortion=bound, steps=200) for bound in (np.inf, 4.01, 5.0))
    assert low.cost > high.cost >= discs.cost > 0.0
    assert low.energy < high.energy <= discs.energy


def test_wires_across_the_surface_have_curves_of_their_own(torus: sw.Surface) -> None:
    plan = sw.SeamPlanner(torus).plan(distortion=np.inf)
    assert plan.wires
    for wire in plan.wires:
        assert wire.points.shape[1] == 3
        np.testing.assert_array_equal(wire.points[[0, -1]], torus.points[wire.vertices[[0, -1]]])


def test_given_seams_stay_and_weights_keep_seams_away(torus: sw.Surface) -> None:
    ring = closed_ring(20, 6)
    with_ring = sw.SeamPlanner(torus, along="edges", seams=ring).plan(distortion=np.inf)
    assert with_ring.islands_to_cut == 0
    given = {tuple(sorted(edge)) for edge in ring}
    assert not given & {tuple(sorted(edge)) for edge in edges_of(with_ring).tolist()}
    part, around_tube = np.ones((2, len(torus.points)))
    part[[0, 1, 2, 20, 21, 22]] = np.inf
    around_tube[5::20] = np.inf
    for weights, islands_to_cut in ((part, 0), (around_tube, 1)):
        away = sw.SeamPlanner(torus, along="edges", weights=weights).plan(distortion=4.5, steps=100)
        assert np.isfinite(weights[edges_of(away)]).all()
        assert away.islands_to_cut == islands_to_cut
        assert np.isfinite(away.energy)  # the tube that stays can be mapped, too
        assert away.is_reached


def test_seams_are_mirrored(torus: sw.Surface) -> None:
    plan = sw.SeamPlanner(torus, along="edges", mirror=2, front=(0.0, -1.0, 0.0)).plan(distortion=4.5, steps=200)
    assert plan.islands_to_cut == 0
    assert np.isfinite(plan.energy)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"mirror": 3}, "mirror is 3"),
        ({"front": (0.0, 0.0, 0.0)}, "front is not a direction"),
        ({"front": (1.0, 0.0)}, "front: expected 3 numbers, got 2"),
        ({"weights": [1.0, 2.0]}, "weights has 2 items"),
        ({"weights": [[1.0]]}, "weights"),
        ({"weights": np.full(240, -1.0)}, "weights: item 0 is not 0 or more"),
        ({"weights": np.full(240, np.nan)}, "weights: item 0"),
        ({"seams": [(0, 1000)]}, "out of range"),
        ({"along": "nowhere"}, "along"),
        ({"max_anisotropy": 0.5}, "anisotropy"),
    ],
)
def test_wrong_options_are_refused(torus: sw.Surface, arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.SeamPlanner(torus, **arguments)  # type: ignore[arg-type]


def test_the_length_of_a_direction_does_not_matter(torus: sw.Surface) -> None:
    def first_wire(length: float) -> NDArray[np.int32]:
        planner = sw.SeamPlanner(torus, along="edges", front=(0.0, -length, 0.0))
        return planner.plan(distortion=4.5, steps=50).wires[0].vertices

    for length in (1e-170, 1e160):
        np.testing.assert_array_equal(first_wire(length), first_wire(1.0))


def test_a_number_just_out_of_range_is_shown_in_full(planner: sw.SeamPlanner, torus: sw.Surface) -> None:
    with pytest.raises(ValueError, match=r"distortion is 3\.9999999999, not"):
        planner.plan(distortion=3.9999999999)
    with pytest.raises(ValueError, match="amount is -1e-09, not"):
        sw.PartFinder(torus).find(-1e-9)


@pytest.mark.parametrize("distortion", [4.0, 0.0, -np.inf, np.nan])
def test_a_bound_that_no_map_reaches_is_refused(planner: sw.SeamPlanner, distortion: float) -> None:
    with pytest.raises(ValueError, match="distortion is"):
        planner.plan(distortion=distortion)


def test_arrays_outlive_what_they_came_from(torus: sw.Surface) -> None:
    planner = sw.SeamPlanner(torus, along="edges")
    plan = planner.plan(distortion=5.0, steps=100)
    islands, vertices, points, uvs = plan.islands, plan.wires[0].vertices, plan.wires[0].points, plan.uvs
    copies = [array.copy() for array in (islands, vertices, points, uvs)]
    del plan, planner
    gc.collect()
    sw.SeamPlanner(torus, along="edges").plan(distortion=5.0, steps=100)
    for array, copy in zip((islands, vertices, points, uvs), copies, strict=True):
        np.testing.assert_array_equal(array, copy)


def test_another_thread_sees_the_best_plan_so_far(torus: sw.Surface) -> None:
    planner = sw.SeamPlanner(torus, along="edges")
    assert planner.best_so_far is None
    seen: list[sw.SeamPlan] = []

    def look(_: float) -> bool:
        best = planner.best_so_far
        if best is not None:
            seen.append(best)
        return not seen

    failed: list[BaseException] = []

    def work() -> None:
        try:
            planner.plan(distortion=4.01, progress=look)
        except sw.Cancelled as error:
            failed.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert failed, "the search is cancelled with the first plan that is found"
    best = planner.best_so_far
    assert best is not None
    assert best.islands_to_cut == 0
    assert best.uvs is None
    finished = planner.plan(distortion=np.inf)
    np.testing.assert_array_equal(planner.best_so_far.islands, finished.islands)


def test_progress_and_cancel(planner: sw.SeamPlanner) -> None:
    told: list[float] = []
    large = sw.Surface(*meshes.torus(160, 96))
    sw.SeamPlanner(large, progress=told.append)
    assert told
    assert all(0.0 <= fraction <= 1.0 for fraction in told)
    with pytest.raises(sw.Cancelled):
        sw.SeamPlanner(large, progress=lambda _: False)
    with pytest.raises(sw.Cancelled):
        planner.plan(progress=lambda _: False)


def test_the_stub_names_what_there_is(planner: sw.SeamPlanner) -> None:
    plan = planner.plan(distortion=np.inf)
    assert {name for name in dir(plan) if not name.startswith("_")} == {
        *("wires", "islands", "island_count", "islands_to_cut", "exposed_wires", "cost", "energy", "is_reached"),
        *("steps", "uvs"),
    }
    assert {name for name in dir(plan.wires[0]) if not name.startswith("_")} == {
        "seeds",
        "follow",
        "vertices",
        "points",
        "faces",
    }
    assert {name for name in dir(planner) if not name.startswith("_")} == {"plan", "best_so_far"}
    assert "SeamPlanner" in repr(planner)
    assert "islands" in repr(plan)
    assert "vertices" in repr(plan.wires[0])


def closed_ring(columns: int, row: int) -> list[tuple[int, int]]:
    return [(row * columns + i, row * columns + (i + 1) % columns) for i in range(columns)]


@pytest.mark.parametrize(
    ("mesh", "cuts", "missing"),
    [
        (meshes.grid(4), [], [0]),
        (meshes.torus(6, 5), [], [3]),
        (meshes.torus(6, 5), closed_ring(6, 2), [1]),
        (meshes.torus(24, 20), [*closed_ring(24, 5), *closed_ring(24, 15)], [1, 1]),
        (meshes.torus(6, 5), closed_ring(6, 2)[:1], [2]),
        (meshes.moebius(9), [], [0]),
        (meshes.moebius(9), [(8, 9)], [0, 0]),
        (meshes.joined(meshes.torus(6, 5), meshes.grid(2)), [], [3, 0]),
    ],
)
def test_how_many_cuts_segments_need(mesh: meshes.Mesh, cuts: list[tuple[int, int]], missing: list[int]) -> None:
    surface, edges = sw.Surface(*mesh), np.array(cuts, dtype=np.int32).reshape(-1, 2)
    assert sw.missing_cuts(surface, edges, sw.face_segments(surface, edges)).tolist() == missing


def test_segments_of_something_else_are_refused(torus: sw.Surface) -> None:
    whole = np.zeros(len(torus.triangles), dtype=np.int32)
    with pytest.raises(ValueError, match="segments has 3 items"):
        sw.missing_cuts(torus, np.empty((0, 2), dtype=np.int32), [0, 0, 0])
    with pytest.raises(ValueError, match="other cuts"):
        sw.missing_cuts(torus, np.empty((0, 2), dtype=np.int32), np.arange(len(whole)))
    with pytest.raises(ValueError, match="out of range"):
        sw.missing_cuts(torus, [(0, 10**6)], whole)


def test_one_sided_surfaces_are_mapped() -> None:
    plan = sw.SeamPlanner(sw.Surface(*meshes.moebius(40)), along="edges").plan()
    assert np.isfinite(plan.energy)
