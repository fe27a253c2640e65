# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of the benchmark of parts, on seams with known answers: ``native/bench/parts.py``."""

from __future__ import annotations

import dataclasses
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))
import parts_report as report
from many_boxes import boxes
from seam_measures import Artist, SeamMeasures, SeamMesh
from seam_methods import Seams, cached, centered, from_blender, map_measures, ours, scan_measures, sharp
from uv_maps import Frame, Model, UvMap
from uv_pictures import Surface, best_view, draw_columns

Integers = NDArray[np.int64]
Line = list[int]


def model_of(points: object, quads: object) -> Model:
    quads = np.asarray(quads, dtype=np.int64)
    start = np.arange(0, quads.size + 1, 4)
    return Model("made", np.asarray(points, dtype=np.float64), start, quads.reshape(-1), Frame())


def grid(x: object, y: object) -> Model:
    """Return quads in the plane z = 0 between columns x and rows y."""
    columns, rows = np.meshgrid(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    points = np.stack([columns.reshape(-1), rows.reshape(-1), np.zeros(columns.size)], axis=1)
    width = columns.shape[1]
    first = (np.arange(len(rows) - 1)[:, None] * width + np.arange(width - 1)).reshape(-1)
    return model_of(points, np.stack([first, first + 1, first + width + 1, first + width], axis=1))


def cube() -> Model:
    points = [[x, y, z] for z in (-1.0, 1) for y in (-1.0, 1) for x in (-1.0, 1)]
    return model_of(points, [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])


def tube(around: int = 12, rows: int = 4) -> Model:
    """Return an open tube of quads around the z axis."""
    angle = 2 * np.pi * np.arange(around) / around
    points = [[np.cos(a), np.sin(a), z] for z in range(rows + 1) for a in angle]
    quads = [
        [r + i, r + (i + 1) % around, r + around + (i + 1) % around, r + around + i]
        for r in range(0, rows * around, around)
        for i in range(around)
    ]
    return model_of(points, quads)


def pairs(*lines: Line) -> Integers:
    return np.array([pair for line in lines for pair in pairwise(line)], dtype=np.int64)


def column(index: int, width: int = 11, rows: int = 11) -> Line:
    return [index + width * row for row in range(rows)]


def measured(model: Model, artist: Integers, seams: Integers, mirror: int | None = None) -> SeamMeasures:
    return Artist(SeamMesh(model), artist, mirror).measure(seams)


SQUARE = grid(range(11), range(11))


def test_the_artists_own_seams_agree_and_need_no_press() -> None:
    line = pairs(column(5))
    found = measured(SQUARE, line, line)
    assert (found.agree, found.lift, found.rlift, found.exact, found.exact_mean) == (1, 1, 1, 1, 1)
    assert (found.presses, found.tolerant, found.islands, found.islands_ratio) == (0, 0, 2, 1)


def test_no_seams_need_the_presses_of_drawing_from_nothing() -> None:
    found = measured(SQUARE, pairs(column(5)), pairs())
    assert (found.agree, found.exact, found.presses, found.tolerant, found.straightness) == (0, 0, 1, 1, None)


def test_lift_is_corrected_by_chance() -> None:
    found = measured(SQUARE, pairs(column(5)), pairs(column(5), column(2)))
    band = 2 * 0.015 * SQUARE.diagonal / 10  # the share of the square that is near one line
    assert found.lift == pytest.approx((0.5 - band) / (1 - band), abs=0.02)
    assert found.rlift == pytest.approx(1.0)
    assert found.agree == pytest.approx(2 * found.lift / (found.lift + 1))
    assert (found.exact, found.exact_mean) == (pytest.approx(0.5), pytest.approx(2 / 3))


def test_seams_that_are_less_near_than_chance_do_not_agree() -> None:
    assert measured(SQUARE, pairs(column(5)), pairs(column(2))).agree == 0


def test_a_wrong_chain_is_one_press_and_a_line_costs_its_length() -> None:
    drawing = 1 + 10 / (0.4 * SQUARE.diagonal)
    found = measured(SQUARE, pairs(column(5)), pairs(column(2)))
    assert found.presses == pytest.approx((1 + drawing) / drawing)
    assert found.tolerant == pytest.approx((1 + drawing) / drawing)
    half = measured(SQUARE, pairs(column(5)), pairs(column(5)[:6]))
    assert half.presses == pytest.approx((1 + 1) / drawing)  # the short rest costs the least that a chain does
    assert half.tolerant == 1.0, "half of the chain is near, which is too little, and the suggested half is right"


def test_a_tolerant_artist_accepts_the_other_side_of_a_chamfer() -> None:
    model = grid([0, 4, 4.1, 10], range(11))
    found = measured(model, pairs(column(1, 4)), pairs(column(2, 4)))
    assert found.tolerant == 0
    assert found.presses > 1
    assert (found.agree, found.exact) == (1, 0)


def test_kinks_cost_a_press_each_and_a_smooth_loop_costs_one() -> None:
    ring = [*range(12, 24), 12]
    around = pairs(ring)
    beside = pairs([12, 24])
    assert measured(tube(), around, beside).presses == 1 + 1
    corners, far = pairs([48, 49, 60, 59, 48]), pairs([12, 13])
    assert measured(SQUARE, corners, far).presses == pytest.approx((1 + 1 + 4 + 1) / (1 + 4 + 1))


def test_chains_end_at_junctions_of_all_seams() -> None:
    mesh = SeamMesh(SQUARE)
    cross = mesh.mask(pairs(column(5), list(range(55, 66))))
    assert sorted(len(chain) for chain in mesh.chains(cross)) == [6, 6, 6, 6]
    one = mesh.mask(pairs(column(5)))
    assert len(mesh.chains(one)) == 1
    assert len(mesh.chains(cross, one)) == 2


def test_islands_and_discs_of_a_box() -> None:
    mesh = SeamMesh(cube())
    lid, floor = pairs([4, 5, 7, 6, 4]), pairs([0, 1, 3, 2, 0])
    one, two = mesh.mask(lid), mesh.mask(np.concatenate([lid, floor]))
    assert (mesh.islands(one).max() + 1, mesh.not_discs(one)) == (2, 0)
    assert (mesh.islands(two).max() + 1, mesh.not_discs(two)) == (3, 1), "the wall is a ring"
    slit = mesh.mask(np.concatenate([lid, floor, pairs([0, 4])]))
    assert (mesh.islands(slit).max() + 1, mesh.not_discs(slit)) == (3, 0)
    nothing = mesh.mask(pairs())
    assert (mesh.islands(nothing).max() + 1, mesh.not_discs(nothing)) == (1, 1), "a closed surface is no disc"


def plate(height: float) -> tuple[Model, Integers]:
    """Return a plate of 400 quads on whose middle stands a plug with this height, and the border of its top."""
    flat = grid(range(21), range(21))
    quad = flat.corners.reshape(-1, 4)[210]
    top = np.arange(4) + len(flat.points)
    points = np.concatenate([flat.points, flat.points[quad] + [0, 0, height]])
    walls = [[quad[k], quad[(k + 1) % 4], top[(k + 1) % 4], top[k]] for k in range(4)]
    quads = np.concatenate([np.delete(flat.corners.reshape(-1, 4), 210, axis=0), [top], walls])
    return model_of(points, quads), pairs([*top, top[0]])


def test_a_small_flat_island_is_a_crumb_and_a_plug_with_a_rim_is_not() -> None:
    for height, crumbs in ((0.1, 1), (0.001, 1), (1.0, 0)):
        model, rim = plate(height)
        if height < 1:  # the top of a flat plug is nearly in the plane, and its walls are slopes
            model.points[-4:, :2] += (model.points[-4:, :2] - model.points[-4:, :2].mean(axis=0)) * -0.9
        mesh = SeamMesh(model)
        assert mesh.crumbs(mesh.mask(rim)) == crumbs


def test_loose_ends_are_counted_beyond_the_artists() -> None:
    slit = pairs(column(5)[2:8])
    assert SeamMesh(SQUARE).loose_ends(SeamMesh(SQUARE).mask(slit)) == 2
    assert SeamMesh(SQUARE).loose_ends(SeamMesh(SQUARE).mask(pairs(column(5)[:6]))) == 1, "one end is on the boundary"
    assert measured(SQUARE, slit, pairs(column(5))).loose_ends == -2


def test_straightness_is_measured_on_the_surface() -> None:
    def of(model: Model, seams: Integers) -> float | None:
        mesh = SeamMesh(model)
        return mesh.straightness(mesh.mask(seams))

    stairs = [12, 13, 24, 25, 36, 37, 48]
    assert of(SQUARE, pairs(column(5))) == 1
    assert of(SQUARE, pairs(stairs)) == 0
    assert of(SQUARE, pairs([12, 13, 14, 25, 36])) == pytest.approx(2 / 3)
    assert of(tube(), pairs([*range(12, 24), 12])) == 1, "a ring around a tube is straight on it"
    assert of(cube(), pairs([4, 5, 7, 6, 4])) == 0, "and the rim of a box turns at its corners"


def test_mirrored_seams() -> None:
    model = dataclasses.replace(SQUARE, points=SQUARE.points - [5.0, 5, 0])
    one, both = pairs(column(2)), pairs(column(2), column(8))
    assert measured(model, both, one, mirror=0).mirrored == 0
    assert measured(model, both, both, mirror=0).mirrored == 1
    assert measured(model, both, both).mirrored is None


def test_angles_and_sharp_edges_of_polygons() -> None:
    mesh = SeamMesh(cube())
    assert mesh.angles == pytest.approx(90.0)
    assert len(sharp(mesh, 45).pairs) == 12
    assert len(sharp(SeamMesh(SQUARE), 1).pairs) == 0
    assert Artist(mesh, pairs([4, 5, 7, 6, 4]), None).sharp == 1


def test_maps_of_seams() -> None:
    found = map_measures(cube(), sharp(SeamMesh(cube()), 45))
    assert found["energy"] == pytest.approx(4.0)
    assert (found["overlapping"], found["flips"], found["outside"]) == (0, 0, None)


def test_maps_of_blender_are_read_and_measured(tmp_path: Path) -> None:
    model = SQUARE
    order = np.arange(len(model.corners)).reshape(-1, 4)
    corners = order[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    uvs = model.points[model.corners, :2] / 5
    is_right = model.points[model.corners[order], 0].mean(axis=1) > 5.0
    uvs[order[is_right]] += [1.0, 0.0]
    file = tmp_path / "made.addon.npz"
    UvMap(model.points, model.corners[corners], uvs[corners], {"sec": 2}).write(file)
    seams = from_blender(model, file)
    assert (len(seams.pairs), seams.info["sec"], seams.is_cut) == (10, 2, False)
    found = map_measures(dataclasses.replace(model, points=centered(model.points)), seams)
    assert found["energy"] == pytest.approx(4.0)
    assert found["outside"] == 2 * 75, "three quarters of the map lie outside"
    assert found["used"] == pytest.approx(4.0), "the square covers four tiles"


def test_a_map_of_blender_with_more_points_is_cut(tmp_path: Path) -> None:
    file = tmp_path / "made.addon.npz"
    points = np.append(SQUARE.points, [[0.5, 0.5, 0.0]], axis=0)
    UvMap(points, SQUARE.triangles, points[SQUARE.triangles, :2]).write(file)
    assert from_blender(SQUARE, file).is_cut


def test_ours_are_cut_into_discs_and_kept_in_a_file(tmp_path: Path) -> None:
    model, calls = cube(), []

    def find() -> Seams:
        calls.append(1)
        return ours(model, 0.5)

    first, again = (cached(tmp_path / "ours/made.npz", find) for _ in range(2))
    mesh = SeamMesh(model)
    assert mesh.not_discs(mesh.mask(first.pairs)) == 0
    assert np.array_equal(first.pairs, again.pairs)
    assert again.info["sec"] >= again.info["first"] > 0
    assert len(calls) == 1


def result(method: str, model: str = "a", kind: str = "hard", **values: float) -> report.Result:
    return report.Result(model, method, kind, 5_000, 2, {"islands": 2, **values})


def test_classes_of_models() -> None:
    assert report.class_of("mh_male_casualsuit03", 0.9) == "clothes"
    assert report.class_of("gxr_hand_l_mesh_glove_l", 0.9) == "clothes"
    assert report.class_of("hatch", 0.51) == "hard"
    assert report.class_of("body", 0.5) == "organic"


def test_the_best_of_five_takes_each_number_from_its_best_amount() -> None:
    runs = [
        result(f"ours {amount:g}", agree=amount, tolerant=1 + amount, presses=1, exact=0, exact_mean=0)
        for amount in report.AMOUNTS
    ]
    (best,) = report.with_best(runs)
    assert (best.method, best["agree"], best["tolerant"]) == (report.BEST, 0.9, 1.1)
    assert report.with_best(runs[:4]) == [], "an amount is missing"


def test_goals_compare_models_that_all_methods_have() -> None:
    methods = (report.OURS, report.UVGAMI, report.SHARP_45)
    both = [result(method, agree=0.65 if method == report.OURS else 0.5) for method in methods]
    table = report.tables([*both, result(report.OURS, model="b", agree=0.1)])["parts-goals"]
    assert "| agreement, hard | 0.50 | 0.50 | 0.65 | >= 0.6 | yes |" in table
    assert "| agreement, organic | - | - | - | >= 0.36 | - |" in table


def test_shares_and_counts_of_models() -> None:
    results = [result("ours", energy=4.1, flips=0), result("ours", "b", energy=4.3, flips=3), result("ours", "c")]
    table = report.method_table(results, "maps")
    assert "| ours | 4.20 | 0.33 | - | 1 | - | - |" in table, "a model without a map is not within the bound"


def test_votes_of_a_blind_judge_are_counted_by_class() -> None:
    key = {"a": {"A": "ours", "B": "artist"}, "b": {"A": "artist", "B": "ours"}, "c": {"A": "ours", "B": "artist"}}
    kinds = {"a": "hard", "b": "organic", "c": "hard"}
    table = report.votes_table({"a": "A", "b": "A", "c": "A"}, key, kinds)
    assert table.splitlines()[2:] == ["| artist | 1 | 0 | 1 | 0 |", "| ours | 2 | 2 | 0 | 0 |"]


def test_many_boxes_have_valid_maps() -> None:
    model = boxes(9)
    seams = ours(model, 0.5)
    found = map_measures(model, seams)
    assert (len(model.points), found["overlapping"], found["flips"]) == (72, 0, 0)
    assert SeamMesh(model).not_discs(SeamMesh(model).mask(seams.pairs)) == 0


def test_no_table_has_more_than_seven_columns() -> None:
    for name in report.SECTIONS:
        assert len(report.SECTIONS[name]) <= 6


def test_the_best_view_shows_the_seams(tmp_path: Path) -> None:
    mesh = SeamMesh(cube())
    behind = pairs([0, 1, 3, 2, 0])  # the face at -z, which models do not show to the front
    mask = mesh.mask(behind)
    surface = Surface(mesh.points, mesh.model.triangles, np.repeat(mesh.islands(mask), 2), behind)
    azimuth, _ = view = best_view(surface, Frame())
    assert 90 < azimuth < 270
    draw_columns(tmp_path / "sheet.png", ["a", "b"], [("box", Frame(), [(view, surface), (view, None)])], 60)
    assert (tmp_path / "sheet.png").stat().st_size > 1000


def test_slits_in_flat_faces_of_a_scan_are_measured() -> None:
    model = grid(range(5), range(5))
    points = model.points.copy()
    points[points[:, 0] > 2, 2] = points[points[:, 0] > 2, 0] - 2  # bends at x = 2
    uvs = model.points[model.triangles, :2] / 8
    in_slit = (model.triangles == 7) & (model.points[model.triangles].mean(axis=1)[:, 1:2] > 1)
    uvs[in_slit] += 1e-3  # opens the edges around a vertex at (2, 1)
    found = scan_measures(UvMap(points, model.triangles, uvs, {"cpu": 0.032}))
    assert (found["triangles"], found["islands"], found["crumbs"]) == (32, 1, 0)
    assert found["ms"] == pytest.approx(1.0)
    assert found["used"] == pytest.approx(0.25, abs=1e-3)
    assert found["flat"] == 0.0, "the slits lie at the bend"
    flat = scan_measures(UvMap(model.points, model.triangles, uvs, {"cpu": 0.032}))
    assert flat["flat"] == pytest.approx(1.0)
