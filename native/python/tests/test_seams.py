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


@pytest.mark.parametrize(
    ("options", "message"),
    [
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
