# SPDX-License-Identifier: GPL-3.0-or-later
"""What suggested islands may be like, and wires of a plan."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import seamwire_core as sw
from seamwire.core.suggestion import (
    best_along,
    best_finish,
    bordering_seeds,
    is_parted,
    mutual,
    narrowed,
    planned_wires,
    seeds_for,
    spread_of,
    spreads,
)

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=np.float64)
SIDES = np.array([(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
TRIANGLES = SIDES[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).astype(np.int32)


def test_images_whose_image_is_another_vertex_are_none() -> None:
    assert mutual(np.array([1, 0, 2, 4, 5, 4, -1])).tolist() == [1, 0, 2, -1, 5, 4, -1]


def cube_of_quads() -> sw.Surface:
    edges = np.sort(np.concatenate([SIDES[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    return sw.Surface(CUBE, TRIANGLES, np.unique(edges, axis=0))


def test_wires_run_along_edges_of_quads_and_across_triangles() -> None:
    assert best_along(np.array([0, 0, 1, 1, 2], dtype=np.int32)) == "EDGES"
    assert best_along(np.array([0, 0, 1, 2], dtype=np.int32)) == "SURFACE"


def test_a_cap_of_an_angle_spreads_as_far_as_its_normals() -> None:
    angle = np.radians(70.0)
    heights = np.random.default_rng(1).uniform(np.cos(angle), 1.0, 200_000)  # even on the sphere
    assert spread_of(angle) == pytest.approx(1.0 - heights.mean(), abs=2e-3)
    assert spread_of(0.5 * pi) == pytest.approx(0.5)
    assert spread_of(7.0) == spread_of(pi) == pytest.approx(1.0)


def test_spreads_of_islands() -> None:
    islands = np.array([0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2], dtype=np.int32)
    found = spreads(CUBE, TRIANGLES, islands)
    # One side; two opposite to it and beside it; three, two of them opposite.
    np.testing.assert_allclose(found, [0.0, 1.0 - np.sqrt(2.0) / 2.0, 1.0 - 1.0 / 3.0], atol=1e-12)


def test_only_stretched_islands_are_narrowed() -> None:
    islands = np.array([0, 0, 1, 2], dtype=np.int32)
    limits = narrowed(np.array([0.4, 0.1, 0.4, 0.1]), [0], islands, np.array([0.3, 0.2, 0.2]))
    assert limits[0] == limits[1] < 0.3
    assert limits[2:].tolist() == [0.4, 0.2], "the others may be as they are"


def test_an_island_is_parted_where_more_than_its_border_has_moved() -> None:
    before = np.array([0, 0, 0, 0, 1, 1, 1, 1], dtype=np.int32)
    areas = np.array([1.0, 1.0, 1.0, 0.01, 1.0, 1.0, 1.0, 1.0])
    assert is_parted(before, np.array([1, 1, 1, 0, 0, 0, 0, 0], dtype=np.int32), areas).tolist() == [False, False]
    assert is_parted(before, np.array([1, 1, 2, 2, 0, 0, 0, 0], dtype=np.int32), areas).tolist() == [True, False]
    assert is_parted(before, np.zeros(8, dtype=np.int32), areas).tolist() == [False, False]


def test_seeds_around_triangles_are_those_of_wires_along_them() -> None:
    wires = sw.SeamPlanner(cube_of_quads(), along="edges", max_anisotropy=10.0).plan(max_spread=0.1).wires
    below = (TRIANGLES < 4).all(axis=1)  # the side of vertices 0 to 3
    on_it = [wire for wire in wires if sum(v < 4 for v in wire.vertices) > 1]
    assert 0 < len(on_it) < len(wires)
    assert bordering_seeds(wires, TRIANGLES, below) == {seed for wire in on_it for seed in wire.seeds}
    assert bordering_seeds(wires, TRIANGLES, np.zeros(len(TRIANGLES), dtype=bool)) == set()


def test_more_islands_take_more_seeds() -> None:
    assert seeds_for(1.0) == seeds_for(0.42) == 24
    assert seeds_for(0.01) == 200
    assert seeds_for(1.0, islands=60) == 60
    assert seeds_for(0.0) == 400


def test_wires_of_a_plan() -> None:
    plan = sw.SeamPlanner(cube_of_quads(), along="edges", max_anisotropy=10.0).plan()
    wires = planned_wires(plan, "EDGES", 10.0)
    assert len(wires) == len(plan.wires) > 0
    for wire, planned in zip(wires, plan.wires, strict=True):
        assert (wire.start, wire.end) == planned.seeds == (wire.vertices[0], wire.vertices[-1])
        np.testing.assert_array_equal(wire.points, CUBE[list(wire.vertices)])
        assert (wire.along, wire.strength, wire.marks, wire.mirror) == ("EDGES", 10.0, True, ())
        assert wire.follow == ("min", "max").index(planned.follow)


def test_many_triangles_are_cut_and_quads_are_not() -> None:
    many = np.arange(6_000, dtype=np.int32)
    assert best_finish(many) == "CUT"
    assert best_finish(many[:500]) == "SNAP"
    assert best_finish(many // 2) == "SNAP"
