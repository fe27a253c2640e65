# SPDX-License-Identifier: GPL-3.0-or-later
"""What the planner is asked for, and wires of a plan."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from seamwire.core.base.geometry import length_of
from seamwire.core.network.strokes import Stroke, through_vertices
from seamwire.core.seams.seam_plan import (
    cut_edges,
    energy_of,
    keep_out,
    mean_stretch,
    planned_wires,
    stretch_of,
    stroke_weights,
)

SIDE = 9
"""Vertices along a side of the grid; vertex y * SIDE + x is column x of row y."""


def grid() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the points, triangles and edges of a grid of unit squares."""
    points = np.array([(x, y, 0.0) for y in range(SIDE) for x in range(SIDE)], dtype=np.float64)
    corners = [SIDE * y + x for y in range(SIDE - 1) for x in range(SIDE - 1)]
    quads = np.array([(c, c + 1, c + SIDE + 1, c + SIDE) for c in corners])
    triangles = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).astype(np.int32)
    edges = np.unique(np.sort(np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1), axis=0)
    return points, triangles, edges.astype(np.int32)


@pytest.mark.parametrize("stretch", [0.0, 0.05, 0.17, 0.6, 3.0])
def test_the_energy_of_a_stretch_is_that_of_a_triangle_stretched_so(stretch: float) -> None:
    long, short = 1.0 + stretch, 1.0 / (1.0 + stretch)
    assert energy_of(stretch) == pytest.approx(long**2 + short**2 + long**-2 + short**-2)
    assert stretch_of(energy_of(stretch)) == pytest.approx(stretch, abs=1e-7)


def test_the_energies_of_some_stretches() -> None:
    assert energy_of(0.17) == pytest.approx(4.2, abs=0.002)
    assert stretch_of(4.1) == pytest.approx(0.118, abs=0.0005)
    assert stretch_of(3.9999) == 0.0, "as rounding may leave it"
    assert stretch_of(math.inf) == math.inf


def test_the_stretch_of_several_maps_is_that_of_their_mean_energy() -> None:
    assert mean_stretch([energy_of(0.1)], [3.0]) == pytest.approx(0.1)
    mean = (energy_of(0.1) + 3.0 * energy_of(0.3)) / 4.0
    assert mean_stretch([energy_of(0.1), energy_of(0.3)], [1.0, 3.0]) == pytest.approx(stretch_of(mean))
    assert mean_stretch([], []) == 0.0


def planned(*vertices: int) -> SimpleNamespace:
    """Return a wire of a plan through vertices of the grid."""
    chain = np.array(vertices, dtype=np.int32)
    return SimpleNamespace(vertices=chain, points=grid()[0][chain], seeds=(int(chain[0]), int(chain[-1])), follow="max")


def test_wires_of_a_plan_have_the_coordinates_of_the_session() -> None:
    plan = SimpleNamespace(wires=[planned(0, 1, 2), planned(2, 11)])
    stretch = np.diag([2.0, 1.0, 1.0])
    one, other = planned_wires(plan, "EDGES", 10.0, stretch)
    assert (one.start, one.end, one.vertices) == (0, 2, (0, 1, 2))
    assert one.points.tolist() == [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0]]
    assert (other.along, other.strength, other.follow, other.marks, other.mirror) == ("EDGES", 10.0, 1, True, ())


def test_the_length_and_the_cuts_of_a_plan() -> None:
    plan = SimpleNamespace(wires=[planned(0, 1, 2), planned(2, 11)])
    assert sum(length_of(wire.points) for wire in plan.wires) == pytest.approx(3.0)
    assert sum(length_of(wire.points * (2.0, 5.0, 1.0)) for wire in plan.wires) == pytest.approx(9.0)
    seams = np.array([(30, 31)], dtype=np.int32)
    assert cut_edges(plan, seams).tolist() == [[30, 31], [0, 1], [1, 2], [2, 11]]
    assert cut_edges(SimpleNamespace(wires=[]), seams[:0]).shape == (0, 2)


def test_wires_are_kept_out_of_all_but_the_planned_triangles() -> None:
    points, triangles, _ = grid()
    left = (points[triangles][:, :, 0] <= 4.0).all(axis=1)
    weights = keep_out(triangles, left, len(points))
    assert np.array_equal(np.isfinite(weights), points[:, 0] <= 4.0), "wires may run along the border"
    assert (weights[np.isfinite(weights)] == 1.0).all()


def stroke(*vertices: int, **options: object) -> Stroke:
    return Stroke(*through_vertices(vertices, grid()[0]), **options)


def test_strokes_fade_ring_by_ring() -> None:
    points, _, edges = grid()
    row = 4 * SIDE
    weights = stroke_weights(points, edges, [stroke(row, row + 8)]).reshape(SIDE, SIDE)
    expected = 8.0 ** -np.array([0.0, 0.0, 1 / 3, 2 / 3, 1.0, 2 / 3, 1 / 3, 0.0, 0.0])
    assert weights == pytest.approx(np.repeat(expected[:, None], SIDE, axis=1))
    avoid = stroke_weights(points, edges, [stroke(row, row + 8, attracts=False)]).reshape(SIDE, SIDE)
    assert avoid == pytest.approx(1.0 / weights)
    both = stroke_weights(points, edges, [stroke(row, row + 8), stroke(row, row + 8, attracts=False)])
    assert both == pytest.approx(1.0)
    assert stroke_weights(points, edges, []).tolist() == [1.0] * len(points)


def test_strokes_with_a_radius_reach_as_far_as_that() -> None:
    points, _, edges = grid()
    row = 4 * SIDE
    weights = stroke_weights(points, edges, [stroke(row + 2, row + 6, radius=2.5)]).reshape(SIDE, SIDE)
    assert weights[:, 4] == pytest.approx(8.0 ** -np.maximum(1.0 - np.abs(np.arange(SIDE) - 4) / 2.5, 0.0))
    assert weights[4, 0] == pytest.approx(8.0**-0.2)
    assert weights[6, 0] == 1.0, "beyond its end the distance counts"
