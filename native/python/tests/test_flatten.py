# SPDX-License-Identifier: GPL-3.0-or-later
"""UV maps from `flatten`, and what `measure_map` says of any map."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw


def test_a_square_stays_itself() -> None:
    points, triangles = meshes.grid(6)
    flat = sw.flatten(points, triangles)
    assert flat.uvs.shape == (72, 3, 2)
    assert flat.uvs.dtype == np.float64
    assert not flat.uvs.flags.writeable
    assert flat.energy == pytest.approx(4, abs=1e-6)
    assert flat.island_energies == pytest.approx([4], abs=1e-6)
    assert flat.island_areas == pytest.approx([1])
    assert (len(flat.overlapping), flat.opened.tolist()) == (0, [0])
    sides = np.linalg.norm(flat.uvs - np.roll(flat.uvs, 1, axis=1), axis=2)
    corners = points[triangles]
    np.testing.assert_allclose(sides, np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2), rtol=1e-3)


def test_islands_are_those_of_face_segments() -> None:
    points, triangles = meshes.torus(16, 8)
    cuts = [(16 * v + u, 16 * ((v + 1) % 8) + u) for u in (0, 3) for v in range(8)]
    flat = sw.flatten(points, triangles, cuts)
    np.testing.assert_array_equal(flat.islands, sw.face_segments(sw.Surface(points, triangles), cuts))
    assert flat.islands.dtype == np.int32
    assert len(flat.island_areas) == len(flat.island_energies) == len(flat.opened) == 2
    report = sw.measure_map(points, triangles, flat.uvs, flat.islands)
    assert report.energy == pytest.approx(flat.energy)
    assert len(report.flipped) == len(report.overlapping) == 0
    assert report.energies.shape == (256,)
    assert repr(flat) == "<Flattening: 256 triangles, 2 islands>"
    assert repr(report) == "<MapReport: 0 flipped triangles, 0 overlapping islands, 2 colliding islands>"


def test_handles_are_opened() -> None:
    flat = sw.flatten(*meshes.torus(16, 8))
    assert flat.opened[0] > 20


def test_a_barrier_can_be_left_out() -> None:
    angle = np.linspace(0, 3 * np.pi, 60)
    rows = [np.stack([r * np.cos(angle), r * np.sin(angle), 0.1 * angle], 1) for r in (0.5, 1.0)]
    points = np.concatenate(rows)
    i = np.arange(59)
    triangles = np.concatenate([np.stack([i, i + 60, i + 61], 1), np.stack([i, i + 61, i + 1], 1)])
    assert sw.flatten(points, triangles, keep_apart=False).overlapping.tolist() == [0]
    assert sw.flatten(points, triangles).overlapping.tolist() == []


def test_more_steps_and_a_smaller_tolerance_stretch_less() -> None:
    points, triangles = meshes.torus(16, 8)
    cuts = [(16 * v, 16 * ((v + 1) % 8)) for v in range(8)]
    none, few, usual = (sw.flatten(points, triangles, cuts, max_steps=steps) for steps in (0, 3, 100))
    assert none.energy > few.energy > usual.energy
    assert none.steps == 0
    assert few.steps < usual.steps
    rough = sw.flatten(points, triangles, cuts, tolerance=0.1)
    assert rough.steps < usual.steps
    assert rough.energy > usual.energy


def test_a_start_is_continued() -> None:
    points, triangles = meshes.torus(16, 8)
    first = sw.flatten(points, triangles)
    second = sw.flatten(points, triangles, start=first.uvs)
    np.testing.assert_allclose(second.uvs, first.uvs, atol=1e-3)
    np.testing.assert_array_equal(second.opened, first.opened)


def test_a_strip_of_quads_is_laid_out_straight_and_upright_if_asked_for() -> None:
    turns = np.linspace(0.0, 2.0, 13)
    ring = np.stack([np.cos(turns), np.sin(turns), np.zeros(13)], axis=1)
    points = np.concatenate([ring, 1.1 * ring + (0.0, 0.0, 1.0)])
    row = np.arange(12)
    triangles = np.concatenate(
        [np.stack([row, row + 1, row + 14], axis=1), np.stack([row, row + 14, row + 13], axis=1)]
    )
    flat = sw.flatten(points, triangles)
    assert flat.straight.tolist() == []
    straight = sw.flatten(points, triangles, straighten=0.05, up=(0.0, 0.0, -2.0))
    assert straight.straight.tolist() == [0]
    assert flat.energy < straight.energy <= flat.energy + 0.05
    places = np.unique(np.concatenate([triangles.reshape(-1, 1), straight.uvs.reshape(-1, 2)], axis=1), axis=0)
    assert len(places) == 26
    lower, upper = places[:13, 1:], places[13:, 1:]
    assert np.array_equal(lower[:, 0], upper[:, 0])
    assert (len(np.unique(lower[:, 1])), len(np.unique(upper[:, 1]))) == (1, 1)
    assert (lower[:, 1] > upper[:, 1]).all(), "up is down"
    assert sw.flatten(points, triangles, straighten=0.0).straight.tolist() == []


def test_the_length_of_the_up_direction_does_not_matter() -> None:
    points, triangles = meshes.grid(4)
    points = points @ [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]]
    expected = sw.flatten(points, triangles, up=(1.0, 2.0, 0.0)).uvs
    for length in (1e-170, 1e160):
        np.testing.assert_allclose(
            sw.flatten(points, triangles, up=(length, 2.0 * length, 0.0)).uvs, expected, atol=1e-12
        )


def test_measures_maps_that_others_made() -> None:
    points, triangles = meshes.grid(4)
    uvs = points[triangles][:, :, :2].copy()
    uvs[3] = uvs[3, ::-1]
    report = sw.measure_map(points, triangles, uvs, np.zeros(len(triangles), np.int64))
    assert report.flipped.tolist() == [3]
    assert report.overlapping.tolist() == [0]
    assert report.energies[3] == np.inf
    assert np.delete(report.energies, 3) == pytest.approx(4)
    assert sw.measure_map(points, triangles, 5 * points[triangles][:, :, :2]).energy == pytest.approx(4)


def test_the_energy_of_a_map_is_that_of_its_report() -> None:
    points, triangles = meshes.grid(4)
    uvs = points[triangles][:, :, :2] * (1, 3)
    uvs[3] = uvs[3, ::-1]
    islands = np.zeros(len(triangles), np.int64)
    energy = sw.map_energy(points, triangles, uvs, islands)
    assert energy == sw.measure_map(points, triangles, uvs, islands).energy
    # A stretch of 3 has 3 + 1/3 for each axis at the best scale.
    assert energy == pytest.approx(2 * (3 + 1 / 3))
    with pytest.raises(ValueError, match="uvs has 1 items: there are 32 triangles"):
        sw.map_energy(points, triangles, uvs[:1])
    with pytest.raises(sw.Cancelled):
        sw.map_energy(points, triangles, uvs, progress=lambda _: False)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"start": np.zeros((3, 3))}, "start: expected real numbers of shape"),
        ({"start": np.zeros((3, 3, 2))}, "start has 3 items: there are 8 triangles"),
        ({"start": np.full((8, 3, 2), np.nan)}, "not finite"),
        ({"start": "no"}, "start: expected real numbers"),
        ({"cuts": [(0, 99)]}, "cuts: vertex 99 is out of range"),
        ({"cuts": [0, 1]}, "cuts: expected"),
        ({"points": [(0, 0)]}, "points: expected"),
        ({"triangles": [(0, 1, 99)]}, "triangle 0: vertex 99"),
        ({"progress": 3}, "progress: expected a function"),
        ({"up": (0, 0)}, "up: expected"),
        ({"up": (0, 0, 0)}, "up is no direction"),
        ({"straighten": np.nan}, "straighten is negative or not finite"),
        ({"straighten": np.inf}, "straighten is negative or not finite"),
        ({"straighten": -1.0}, "straighten is negative or not finite"),
        ({"tolerance": -1.0}, "tolerance is negative"),
        ({"max_steps": -1}, "max_steps: expected a number that is not negative"),
    ],
)
def test_wrong_input_of_flatten(change: dict, message: str) -> None:
    points, triangles = meshes.grid(2)
    with pytest.raises(ValueError, match=message):
        sw.flatten(**{"points": points, "triangles": triangles, **change})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"uvs": np.zeros((8, 3))}, "uvs: expected real numbers of shape"),
        ({"uvs": np.zeros((7, 3, 2))}, "uvs has 7 items"),
        ({"uvs": np.full((8, 3, 2), np.inf)}, "triangle 0 has a UV that is not finite"),
        ({"islands": [0]}, "islands has 1 items"),
        ({"islands": [-1] * 8}, "islands: number -1 is out of range"),
    ],
)
def test_wrong_input_of_measure_map(change: dict, message: str) -> None:
    points, triangles = meshes.grid(2)
    with pytest.raises(ValueError, match=message):
        sw.measure_map(**{"points": points, "triangles": triangles, "uvs": points[triangles][:, :, :2], **change})


def cube() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the points, the triangles and the real edges of a cube of six quads."""
    points = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    quads = np.array([(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    triangles = quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    edges = np.unique(np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1), axis=0)
    return points, triangles, edges


def test_real_edges_keep_polygons_whole() -> None:
    points, triangles, edges = cube()
    flat = sw.flatten(points, triangles, edges=edges)
    # Corners 0 and 2 of each quad are in both of its triangles.
    np.testing.assert_array_equal(flat.uvs[::2, 0], flat.uvs[1::2, 0])
    np.testing.assert_array_equal(flat.uvs[::2, 2], flat.uvs[1::2, 1])
    report = sw.measure_map(points, triangles, flat.uvs, flat.islands, edges=edges)
    assert (len(report.flipped), len(report.overlapping)) == (0, 0)
    with pytest.raises(ValueError, match="edges: expected"):
        sw.flatten(points, triangles, edges=[1])
    with pytest.raises(ValueError, match="edge 0: vertex 99"):
        sw.measure_map(points, triangles, flat.uvs, edges=[(0, 99)])


def test_islands_on_other_islands_collide() -> None:
    points, triangles = meshes.grid(1)
    points = np.concatenate([points + np.array([place, 0, 0]) for place in (0.0, 1.0, 1.5, 5.0)])
    triangles = np.concatenate([triangles + 4 * i for i in range(4)])
    report = sw.measure_map(points, triangles, points[triangles][:, :, :2])
    assert report.colliding.tolist() == [1, 2]
    assert report.colliding.dtype == np.int32
    assert report.overlapping.tolist() == []


def test_measuring_can_be_cancelled() -> None:
    points, triangles = meshes.grid(30)
    with pytest.raises(sw.Cancelled):
        sw.measure_map(points, triangles, points[triangles][:, :, :2], progress=lambda _: False)


def placed(packing: sw.Packing, uvs: np.ndarray, islands: np.ndarray) -> np.ndarray:
    """Return the corners of triangles in the square, (m, 3, 2)."""
    placements = packing.placements[islands]
    return np.einsum("mij,mkj->mki", placements[:, :, :2], uvs) + placements[:, None, :, 2]


@pytest.mark.parametrize("turns", ["none", "quarters", "any"])
def test_packed_islands_lie_in_the_square_at_one_scale(turns: str) -> None:
    points, triangles, edges = cube()
    cuts = [(0, 1), (0, 2), (2, 3), (1, 3), (4, 5), (4, 6), (6, 7), (5, 7)]  # lids, and the walls around
    points[:, 2] *= 0.4
    flat = sw.flatten(points, triangles, [*cuts, (0, 4)], edges=edges)
    packing = sw.pack_islands(flat.uvs, flat.islands, margin=0.02, turns=turns)
    uvs = placed(packing, flat.uvs, flat.islands)
    report = sw.measure_map(points, triangles, uvs, flat.islands, edges=edges)
    assert (report.flipped.tolist(), report.overlapping.tolist(), report.colliding.tolist()) == ([], [], [])
    assert uvs.min() >= 0.01 - 1e-9
    assert uvs.max() <= 0.99 + 1e-9
    one, two = uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]
    area = 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum()
    assert packing.used == pytest.approx(area)
    assert area == pytest.approx(packing.scale**2 * flat.island_areas.sum(), rel=1e-6)
    assert packing.placements.shape == (3, 2, 3)


def test_packed_islands_are_turned_as_they_are_seen_on_a_wide_image() -> None:
    points, triangles = meshes.grid(1)
    uvs = points[triangles][:, :, :2] * (1.0, 3.0)
    packing = sw.pack_islands(uvs, [0, 0], aspects=[4.0])
    size = np.ptp(placed(packing, uvs, np.zeros(2, dtype=int)).reshape(-1, 2), axis=0) * (4.0, 1.0)
    assert sorted(size / packing.scale) == pytest.approx(sorted(np.ptp(uvs.reshape(-1, 2), axis=0)))
    assert size[0] > 2.0 * size[1], "it lies along the image"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"uvs": np.zeros((8, 3))}, "uvs: expected real numbers of shape"),
        ({"uvs": np.full((8, 3, 2), np.nan)}, "triangle 0 has a UV that is not finite"),
        ({"islands": [0]}, "islands has 1 items"),
        ({"islands": [8] * 8}, "islands: number 8 is out of range"),
        ({"margin": 0.3}, "margin is not between 0 and 0.25"),
        ({"turns": "some"}, "turns: expected 'none', 'quarters' or 'any', got 'some'"),
        ({"aspects": [1.0, 1.0]}, "aspects has 2 items: there are 1 islands"),
        ({"aspects": [0.0]}, "an aspect is not between"),
    ],
)
def test_wrong_input_of_pack_islands(change: dict, message: str) -> None:
    points, triangles = meshes.grid(2)
    with pytest.raises(ValueError, match=message):
        sw.pack_islands(**{"uvs": points[triangles][:, :, :2], "islands": [0] * 8, **change})


def test_only_islands_without_a_place_as_they_are_are_turned() -> None:
    dice = np.random.default_rng(4)
    bars = np.array([[(0, 0), (1, 0), (1, 0.2)], [(0, 0), (1, 0.2), (0, 0.2)]])
    walls = np.array([[(0, 0.2), (0.2, 0.2), (0.2, 1)], [(0, 0.2), (0.2, 1), (0, 1)]])
    # Two long islands cross, so one of them has to be turned. The others have room.
    long = [bars * (10.0, 1.0), bars * (0.5, 50.0)]
    uvs = np.concatenate([*long, *(np.concatenate([bars, walls]) * dice.uniform(0.5, 1.5, 2) for _ in range(24))])
    packing = sw.pack_islands(uvs, np.concatenate([[0, 0, 1, 1], np.repeat(np.arange(2, 26), 4)]))
    turned = np.flatnonzero(packing.placements[:, 0, 0] <= 0.0)
    assert len(turned) == 1
    assert turned[0] in {0, 1}
    assert packing.scale > 0.09
