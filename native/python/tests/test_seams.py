# SPDX-License-Identifier: GPL-3.0-or-later
"""Planned seams as Python sees them."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw


@pytest.fixture(scope="module")
def torus() -> sw.Surface:
    return sw.Surface(*meshes.torus(40, 24))


@pytest.fixture(scope="module")
def planner(torus: sw.Surface) -> sw.SeamPlanner:
    return sw.SeamPlanner(torus)


def test_islands_are_those_that_the_wires_enclose(torus: sw.Surface, planner: sw.SeamPlanner) -> None:
    plan = planner.plan()
    edges = np.concatenate([np.column_stack([wire.vertices[:-1], wire.vertices[1:]]) for wire in plan.wires])
    np.testing.assert_array_equal(plan.islands, sw.face_segments(torus, edges))
    assert plan.island_count == plan.islands.max() + 1 > 1
    assert plan.not_discs == 0
    assert plan.cost > 0.0
    for wire in plan.wires:
        assert wire.seeds == (wire.vertices[0], wire.vertices[-1])
        assert wire.follow in {"min", "max"}


def test_limits(torus: sw.Surface, planner: sw.SeamPlanner) -> None:
    assert planner.plan(islands=3).island_count == 3
    few, many = (planner.plan(max_spread=spread).island_count for spread in (0.6, 0.15))
    assert few < many
    assert planner.plan(max_spread=np.full(len(torus.triangles), 0.15)).island_count == many


def test_kept_wires_and_what_is_found_within_an_island(torus: sw.Surface, planner: sw.SeamPlanner) -> None:
    first = planner.plan(islands=3)
    within = first.islands == 0
    density = np.zeros(len(torus.points))
    density[torus.triangles[within]] = 1.0
    edges = np.concatenate([np.column_stack([wire.vertices[:-1], wire.vertices[1:]]) for wire in first.wires])
    seeds = np.unique([wire.seeds for wire in first.wires])
    more = planner.with_seeds(seeds_at=seeds, seeds=len(seeds) + 20, density=density, seams=edges)
    second = more.plan(max_spread=np.where(within, 0.1, 2.0), kept=first.wires, crumb_of_island=0.1)
    kept = {tuple(wire.vertices.tolist()) for wire in first.wires}
    assert kept < {tuple(wire.vertices.tolist()) for wire in second.wires}
    assert second.island_count > 3
    assert len(np.unique(second.islands[~within])) == 2
    with pytest.raises(ValueError, match="density"):
        sw.SeamPlanner(torus, density=[[1.0]])
    with pytest.raises(ValueError, match="crumb is 2"):
        planner.plan(crumb=2.0)


def test_a_plan_is_straightened_where_nothing_is_fixed(planner: sw.SeamPlanner) -> None:
    plan = planner.plan(max_spread=0.3, straightened=False)
    straight = planner.straightened(plan.wires, max_spread=0.3)
    assert straight.cost < plan.cost and straight.island_count == plan.island_count
    seeds = [seed for wire in plan.wires for seed in wire.seeds]
    same = planner.straightened(plan.wires, max_spread=0.3, fixed=seeds)
    np.testing.assert_array_equal(same.islands, plan.islands)
    with pytest.raises(ValueError, match="fixed"):
        planner.straightened(plan.wires, fixed=[-5])


def test_arrays_outlive_what_they_came_from(planner: sw.SeamPlanner) -> None:
    islands = planner.plan().islands
    vertices = planner.plan().wires[0].vertices
    again = planner.plan()
    np.testing.assert_array_equal(islands, again.islands)
    np.testing.assert_array_equal(vertices, again.wires[0].vertices)


def test_progress_and_cancel(torus: sw.Surface, planner: sw.SeamPlanner) -> None:
    told: list[float] = []
    sw.SeamPlanner(torus, progress=told.append)
    assert told
    assert all(0.0 <= fraction <= 1.0 for fraction in told)
    with pytest.raises(sw.Cancelled):
        sw.SeamPlanner(torus, progress=lambda _: False)
    with pytest.raises(sw.Cancelled):
        planner.plan(progress=lambda _: False)


def closed_ring(columns: int, row: int) -> list[tuple[int, int]]:
    return [(row * columns + i, row * columns + (i + 1) % columns) for i in range(columns)]


@pytest.mark.parametrize(
    ("mesh", "cuts", "missing"),
    [
        (meshes.grid(4), [], [0]),
        (meshes.torus(6, 5), [], [3]),
        (meshes.torus(6, 5), closed_ring(6, 2), [1]),
        (meshes.torus(6, 5), [*closed_ring(6, 1), *closed_ring(6, 3)], [1, 1]),
        (meshes.torus(6, 5), closed_ring(6, 2)[:1], [2]),
        (meshes.moebius(9), [], [1]),
        (meshes.moebius(9), [(8, 9)], [0]),
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


def test_one_sided_surfaces_are_cut() -> None:
    plan = sw.SeamPlanner(sw.Surface(*meshes.moebius(40))).plan(max_spread=2.0)
    assert plan.wires and plan.not_discs == 0


@pytest.mark.parametrize("along", ["edges", "surface"])
def test_wires_of_another_surface_are_refused(along: str) -> None:
    points, triangles = meshes.torus(20, 12)
    own = sw.SeamPlanner(sw.Surface(points, triangles), along=along)
    plan = own.plan(max_spread=0.3)
    assert plan.wires
    others = [sw.Surface(2 * points, triangles), sw.Surface(*meshes.torus(21, 12)), sw.Surface(*meshes.torus(6, 5))]
    for surface in others:
        planner = sw.SeamPlanner(surface, along=along)
        with pytest.raises(ValueError, match="wires: "):
            planner.straightened(plan.wires, may_start_on_others=False)
        with pytest.raises(ValueError, match="kept: "):
            planner.plan(kept=plan.wires)
    assert len(own.plan(kept=plan.wires).wires) >= len(plan.wires)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"images": np.roll(np.arange(960), 1)}, "images: the image of vertex 0 is 959, but the image of that is 958"),
        ({"along": "air"}, "along"),
        ({"max_anisotropy": 0.0}, "anisotropy"),
        ({"seeds": 0}, "seeds is 0"),
        ({"most_seeds": 3}, "most_seeds is 3"),
        ({"images": [0, 1]}, "images has 2"),
    ],
)
def test_refused_options(torus: sw.Surface, options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.SeamPlanner(torus, **options)


@pytest.mark.parametrize("spread", [-1.0, float("nan"), [0.1, 0.2], "far", [[0.1]]])
def test_refused_limits(planner: sw.SeamPlanner, spread: object) -> None:
    with pytest.raises(ValueError, match="max_spread"):
        planner.plan(max_spread=spread)
