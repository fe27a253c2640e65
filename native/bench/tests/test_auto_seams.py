# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of the benchmark of automatic seams, on maps with known answers: ``native/bench/auto_seams.py``."""

from __future__ import annotations

import dataclasses
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))
from auto_seams import maps_of
from auto_seams_report import (
    COLUMNS,
    SECTIONS,
    Result,
    comparison_table,
    goal_table,
    median_table,
    model_table,
    tables_on,
    with_artist,
    with_tables,
)
from seam_planning import artist_map, in_own_process, peak_memory, planned_maps
from uv_maps import Frame, Model, UvMap, read_frames
from uv_measures import Measures, Reference, front_views, measure, stretch, symmetric_dirichlet_energy
from uv_pictures import Row, arranged, draw_sheet, layout_picture, surface_picture
from uv_rasters import coverage, front_view

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def grid(columns: int, rows: int) -> tuple[Floats, Integers]:
    """Return points (n, 3) of unit quads in the plane z = 0, centered, and the quads (q, 4)."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    points = np.stack([x.reshape(-1) - columns / 2, y.reshape(-1) - rows / 2, np.zeros(x.size)], axis=1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1)
    return points, np.stack([first, first + 1, first + columns + 2, first + columns + 1], axis=1)


def cube() -> tuple[Floats, Integers]:
    """Return the cube of side 2 around the origin."""
    points = np.array([[x, y, z] for z in (-1.0, 1) for y in (-1.0, 1) for x in (-1.0, 1)])
    return points, np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])


def model_of(points: Floats, quads: Integers, **given: object) -> Model:
    return Model("made", points, np.arange(0, quads.size + 1, 4), quads.reshape(-1), Frame(), **given)


def flat_map(model: Model, pulled_apart: Integers | tuple = ()) -> UvMap:
    """Return x and y as UVs, the given triangles moved to the right."""
    uvs = model.points[model.triangles][:, :, :2].copy()
    uvs[np.asarray(pulled_apart, dtype=np.int64), :, 0] += 100.0
    return UvMap(model.points, model.triangles, uvs)


def measured(model: Model, uv_map: UvMap) -> Measures:
    return measure(uv_map, Reference(model))


def test_an_isometric_map_without_seams_has_the_least_energy() -> None:
    model = model_of(*grid(8, 8))
    found = measured(model, flat_map(model))
    assert found.energy == pytest.approx(4.0, abs=1e-9)
    assert found.density == pytest.approx(1.0, abs=1e-9)
    assert (found.islands, found.seam, found.flips, found.overlapping, found.loose_ends) == (1, 0, 0, 0, 0)
    assert found.visibility is None
    assert found.packing == pytest.approx(1.0, abs=0.01)


def test_energy_of_a_stretched_map_does_not_depend_on_its_scale() -> None:
    model = model_of(*grid(4, 4))
    for scale in (0.01, 1.0, 30.0):
        uv_map = UvMap(model.points, model.triangles, flat_map(model).uvs * np.array([1.5, 1 / 1.5]) * scale)
        assert measured(model, uv_map).energy == pytest.approx(2 * (1.5**2 + 1.5**-2), abs=1e-6)


def test_energy_leaves_out_the_worst_thousandth_of_the_area() -> None:
    one, areas = np.ones(2000), np.ones(2000)
    spoiled = np.where(np.arange(2000) == 7, 1e-6, one)
    assert symmetric_dirichlet_energy(areas, one, spoiled) == pytest.approx(4.0, abs=1e-9)
    tenth = np.where(np.arange(2000) < 200, 0.5, one)
    tenth[:2] = 0.1
    # 2 sqrt(X Y), X the mean of s1^2 + s2^2 and Y that of s1^-2 + s2^-2, without the two worst triangles.
    growth, shrinkage = (1800 * 2 + 198 * 1.25) / 1998, (1800 * 2 + 198 * 5) / 1998
    assert symmetric_dirichlet_energy(areas, one, tenth) == pytest.approx(2 * np.sqrt(growth * shrinkage), abs=1e-9)


def test_a_map_twice_as_long_one_way_stretches_angles_and_no_areas() -> None:
    model = model_of(*grid(4, 4))
    for scale in (0.01, 1.0, 30.0):
        uv_map = UvMap(model.points, model.triangles, flat_map(model).uvs * np.array([2.0, 1.0]) * scale)
        found = measured(model, uv_map)
        assert (found.angles, found.angles_most) == (pytest.approx(2.0), pytest.approx(2.0))
        assert (found.areas, found.areas_most) == (pytest.approx(1.0), pytest.approx(1.0))


def test_stretch_of_areas_is_relative_to_the_whole_map() -> None:
    model = model_of(*grid(4, 4))
    uv_map = flat_map(model)
    uv_map.uvs[:16] *= 3.0  # half of the area is nine times larger: the mean is five times
    found = measured(model, uv_map)
    assert found.angles == pytest.approx(1.0)
    assert found.areas == pytest.approx(np.sqrt(9 / 5 * 5))
    assert found.areas_most == pytest.approx(5.0)


def test_a_triangle_without_uv_area_counts_as_stretched_32_times() -> None:
    angles, areas = stretch(np.ones(3), np.array([1.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    assert angles.tolist() == [1.0, 32.0, 32.0]
    assert areas == pytest.approx([3.0, 32.0, 32.0])


def test_a_cube_in_six_islands_is_cut_along_all_sharp_edges() -> None:
    points, quads = cube()
    model = model_of(points, quads)
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    corners = np.concatenate([square + np.array([2.0 * i, 0.0]) for i in range(6)])
    fans = np.arange(24).reshape(6, 4)[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    found = measured(model, UvMap(points, model.triangles, corners[fans]))
    assert found.islands == 6
    assert found.seam == pytest.approx(12 * 2 / np.sqrt(24))
    assert found.sharp == pytest.approx(1.0)
    assert found.mirrored == pytest.approx(1.0)
    assert found.energy == pytest.approx(4.0, abs=1e-9)
    assert (found.loose_ends, found.tiny, found.flips) == (0, 0, 0)
    assert found.packing == pytest.approx(6 / 11, abs=0.01)


def test_a_triangle_turned_over_is_a_flip() -> None:
    model = model_of(*grid(4, 4))
    uv_map = flat_map(model)
    uv_map.uvs[5] = uv_map.uvs[5, [1, 0, 2]]
    found = measured(model, uv_map)
    assert found.flips + found.islands >= 2  # torn out, it is a separate island
    whole = flat_map(model)
    moved = (whole.triangles == 12).nonzero()
    whole.uvs[moved] += [1.7, 0.0]  # vertex 12 is pushed across its neighbors
    assert measured(model, whole).flips > 0


def ring(turns: float, quads: int = 48) -> tuple[Model, UvMap]:
    """Return a strip and its map onto a ring that turns so often."""
    points, faces = grid(quads, 1)
    model = model_of(points, faces)
    angle = (points[:, 0] / quads + 0.5) * 2 * np.pi * turns
    radius = 6.0 + points[:, 1]
    uvs = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return model, UvMap(points, model.triangles, uvs[model.triangles])


def test_an_island_that_winds_around_itself_overlaps() -> None:
    model, uv_map = ring(0.8)
    assert (measured(model, uv_map).overlapping, measured(model, uv_map).overlap) == (0, 0)
    model, uv_map = ring(1.5)
    found = measured(model, uv_map)
    assert found.overlapping == 1
    assert found.overlap == pytest.approx(0.5, abs=0.03)  # half a turn lies on another one: 1/2 of what is covered
    assert found.packing is None


def slit_map(model: Model, slit: list[int]) -> UvMap:
    """Return a flat map that is open along edges of the row of vertices y = 0, the upper side moved up a little."""
    uv_map = flat_map(model)
    upper = model.points[model.triangles][:, :, 1].mean(axis=1) > 0
    for i, vertex in enumerate(slit):
        is_end = i in (0, len(slit) - 1) and not uv_map.boundary_vertices[vertex]
        if not is_end:
            uv_map.uvs[(model.triangles == vertex) & upper[:, None]] += [0.0, 0.1]
    return uv_map


def test_slits_end_inside_the_surface_or_at_its_boundary() -> None:
    model = model_of(*grid(8, 8))
    row = [4 * 9 + x for x in range(9)]
    inner = measured(model, slit_map(model, row[2:6]))
    assert (inner.islands, inner.loose_ends) == (1, 2)
    assert inner.seam == pytest.approx(3 / 8)
    open_slit = measured(model, slit_map(model, row[:6]))
    assert (open_slit.loose_ends, open_slit.seam) == (1, pytest.approx(5 / 8))


def test_precision_and_lift_compare_with_the_artists_seam() -> None:
    points, quads = grid(20, 20)
    row = [10 * 21 + x for x in range(21)]
    same = model_of(points, quads, seams=np.stack([row[:11], row[1:12]], axis=1))
    found = measured(same, slit_map(same, row[:12]))
    assert (found.precision, found.recall, found.lift) == (1.0, 1.0, 1.0)
    assert found.chance == pytest.approx(11 * 2 * 0.015 * 20 * np.sqrt(2) / 400, rel=0.15)
    far = model_of(points, quads, seams=np.array([[0, 1], [1, 2]]))
    found = measured(far, slit_map(far, row[:12]))
    assert found.precision == 0.0
    assert found.lift < 0


def test_without_seams_in_the_file_they_are_those_of_the_artists_map() -> None:
    points, quads = grid(4, 4)
    corner_uvs = points[quads.reshape(-1), :2].copy()
    corner_uvs[quads.size // 2 :] += [50.0, 0.0]
    model = model_of(points, quads, corner_uvs=corner_uvs)
    assert model.artist_seams.tolist() == [[10 + x, 11 + x] for x in range(4)]
    assert measured(model, model.published_map).lift == 1.0


def test_a_seam_behind_a_plate_is_hardly_visible() -> None:
    plate, quads = grid(8, 8)
    back = plate * [0.6, 0.6, 1.0] - [0.0, 0.0, 0.5]
    points, both = np.concatenate([plate, back]), np.concatenate([quads, quads + len(plate)])
    model = model_of(points, both)
    row = [4 * 9 + x for x in range(2, 7)]

    def visibility(slit: list[int]) -> float:
        uv_map = slit_map(model, slit)
        uv_map.uvs[len(uv_map.uvs) // 2 :, :, 0] += 40.0
        return measured(model, uv_map).visibility

    assert visibility([81 + v for v in row]) < 0.3 * visibility(row)


def test_views_cover_the_front_hemisphere_evenly() -> None:
    views = front_views(Frame(np.array([1.0, 0, 0])).axes)
    assert np.linalg.norm(views, axis=1) == pytest.approx(1.0)
    assert views[:, 0].min() > 0
    assert views.mean(axis=0) == pytest.approx([0.5, 0.0, 0.0], abs=0.03)  # as over the whole hemisphere


def capsule(around: int = 16, rows: int = 20) -> Model:
    """Return an upright capsule, one closed surface of quads and two fans: radius 1, length 4."""
    height = np.linspace(-2.0, 2.0, rows + 1)[1:-1]
    radius = np.sqrt(1 - np.maximum(np.abs(height) - 1, 0) ** 2)
    angle = 2 * np.pi * (np.arange(around) + 0.5) / around
    rings = np.stack(
        [np.outer(radius, np.sin(angle)), np.repeat(height[:, None], around, axis=1), np.outer(radius, np.cos(angle))],
        axis=2,
    ).reshape(-1, 3)
    points = np.concatenate([rings, [[0.0, -2, 0], [0, 2, 0]]])
    count, polygons = len(rings), []
    for i in range(around):
        j = (i + 1) % around
        polygons += [[r + i, r + j, r + around + j, r + around + i] for r in range(0, count - around, around)]
        polygons += [[j, i, count], [count - around + i, count - around + j, count + 1]]
    start = np.cumsum([0, *map(len, polygons)])
    return Model("capsule", points, start, np.concatenate(polygons), Frame())


def test_plans_of_the_library_keep_the_bound_behind_the_model() -> None:
    model = capsule(12, 14)
    maps = planned_maps(model, 0, {"ours": None, "ours tight": 4.05})
    assert set(maps) == {"ours", "tree", "ours tight"}
    reference = Reference(model)
    sides = set(map(tuple, model.edges.tolist()))
    for method, bound in (("ours", 4.2), ("ours tight", 4.05)):
        found = measure(maps[method], reference)
        assert found.energy <= bound + 0.001
        assert (found.flips, found.overlapping) == (0, 0)
        assert {tuple(sorted(seam)) for seam in maps[method].seams.tolist()} <= sides
        assert 0 < maps[method].info["first"] <= maps[method].info["sec"]
    ours, tight = measure(maps["ours"], reference), measure(maps["ours tight"], reference)
    assert ours.visibility < 0.85  # 1 is as visible as any place
    assert ours.seam <= tight.seam


def test_an_artists_seams_are_flattened() -> None:
    model = capsule()
    assert artist_map(model) is None
    back = [(16 * ring + 8, 16 * (ring + 1) + 8) for ring in range(18)]
    seamed = Model(model.name, model.points, model.start, model.corners, model.frame, np.array(back))
    found = measure(artist_map(seamed), Reference(seamed))
    assert (found.islands, found.flips, found.overlapping, found.lift) == (1, 0, 0, 1.0)
    assert 4 < found.energy < 6


def test_peak_memory_is_that_of_this_process() -> None:
    before = peak_memory()
    block = np.ones(8_000_000)
    assert peak_memory() >= before - 1
    assert in_own_process(peak_memory) < before + block.nbytes / 2**20


def test_pixels_on_a_shared_edge_are_covered_once() -> None:
    square = np.array([[[0.0, 0], [30, 0], [30, 20]], [[0, 0], [30, 20], [0, 20]]])
    counts = coverage(square, 40, 25)
    assert counts.sum() == 600
    assert counts.max() == 1


def test_the_nearer_triangle_is_drawn() -> None:
    points = np.array([[0.0, 0, 0], [20, 0, 0], [0, 20, 0], [0, 0, 3], [20, 0, 3], [0, 20, 3]])
    for order in ([0, 1, 2, 3, 4, 5], [3, 4, 5, 0, 1, 2]):
        drawn = front_view(points[order], np.array([[0, 1, 2], [3, 4, 5]]), 20, 20)
        assert set(drawn.triangle.reshape(-1)) == {-1, 1 if order[0] == 0 else 0}
        assert drawn.depth.max() == pytest.approx(3.0)


def test_islands_are_arranged_without_overlap_and_keep_their_shape() -> None:
    model = model_of(*grid(6, 6))
    uv_map = flat_map(model, np.arange(30, 72))
    uv_map.uvs[30:] -= [100.3, 0.2]
    assert measured(model, uv_map).packing is None
    beside = arranged(uv_map)
    assert measured(model, beside).packing is not None
    assert np.diff(beside.uvs, axis=1) == pytest.approx(np.diff(uv_map.uvs, axis=1))


def test_files_keep_models_and_maps(tmp_path: Path) -> None:
    points, quads = grid(3, 2)
    np.savez(tmp_path / "plate.npz", P=points, start=np.arange(0, 25, 4), lv=quads.reshape(-1), seams=[[0, 1]])
    (tmp_path / "frames.json").write_text(json.dumps({"plate": {"front": [1, 0, 0], "hard": True}}))
    frame = read_frames(tmp_path)["plate"]
    assert frame.is_hard
    assert frame.axes.tolist() == [[0, 0, -1], [0, 1, 0], [1, 0, 0]]
    model = Model.read(tmp_path / "plate.npz", frame)
    assert model.artist_seams.tolist() == [[0, 1]]
    assert len(model.edges) == 17
    UvMap(points, model.triangles, flat_map(model).uvs, {"sec": 2.0}).write(tmp_path / "plate.ours_4.1.npz")
    read = maps_of("plate", [tmp_path])["ours 4.1"]
    assert (read.triangles == model.triangles).all()
    assert (read.uvs == flat_map(model).uvs).all()
    assert read.info == {"sec": 2.0}


def test_tables_compare_models_that_both_methods_have() -> None:
    model = model_of(*grid(8, 8))
    row = [4 * 9 + x for x in range(9)]
    short, long = (measured(model, slit_map(model, row[:n])) for n in (3, 6))
    results = [
        Result("a", "ours", 9000, False, short, {"sec": 3.0}),
        Result("a", "ours 4.1", 9000, False, short, {}),
        Result("a", "optcuts", 9000, False, long, {}),
        Result("b", "optcuts", 9000, False, short, {}),
    ]
    lines = goal_table(results).splitlines()
    assert "| seam at E_d 4.1 / OptCuts | <= 0.9 | 0.40 | 1 of 1 | yes |" in lines
    assert "| loose ends, more than the artist | <= 0 | - | 0 of 0 | - |" in lines
    assert "| 4,000 to 14,000 triangles: seconds to the end | <= 10 | 3.00 | 1 of 1 | yes |" in lines
    assert "| on sharp edges, hard surface | >= 0.6 | - | 0 of 0 | - |" in lines
    assert f"| a | {short.areas:.3f} ({short.angles:.3f}) |" in comparison_table(results, "stretch").splitlines()
    assert model_table(results, "ours", "length").splitlines()[2].startswith("| a | 9000 | 1 | 0.25 | 4.00 |")
    missed = [Result("a", "ours 4.1", 9000, False, short, {"bound": 3.9}), *results[2:]]
    assert "| seam at E_d 4.1 / OptCuts | <= 0.9 | inf | 0 of 1 | no |" in goal_table(missed).splitlines()
    assert comparison_table(results, "programs").splitlines()[-1] == "| b | - | - | 0.25 (4.00) |"
    assert median_table(results, "length").splitlines()[-1].startswith("| optcuts | 2 | 1.0 | 0.44 |")


def test_medians_of_the_stretch_of_areas_have_the_largest_beside_them() -> None:
    model = model_of(*grid(8, 8))
    same = measured(model, flat_map(model))
    results = [
        Result(name, "ours", 9000, False, dataclasses.replace(same, areas=areas), {})
        for name, areas in (("a", 1.1), ("b", 1.02), ("c", 1.5))
    ]
    head, _, row = median_table(results, "stretch").splitlines()
    assert head == "| method | models | angles | areas | areas, largest | angles 95 % | areas 95 % |"
    assert row == "| ours | 3 | 1.000 | 1.100 | 1.500 | 1.00 | 1.00 |"
    assert with_artist(results) == []
    assert with_artist([*results, Result("b", "artist", 9000, False, same, {})])[0] == results[1]


def test_the_former_planner_has_separate_tables() -> None:
    model = model_of(*grid(8, 8))
    measures = measured(model, slit_map(model, [4 * 9 + x for x in range(4)]))
    results = [Result("a", method, 9000, False, measures, {}) for method in ("ours", "before", "before stretch")]
    for section in SECTIONS:
        present, former = (median_table(results, section, former=former).splitlines() for former in (False, True))
        assert [line.split(" | ")[0] for line in present[2:]] == ["| ours"]
        assert [line.split(" | ")[0] for line in former[2:]] == ["| before", "| before stretch"]
        assert present[0] == former[0]


def test_every_column_is_in_one_section_and_no_table_has_more_than_seven() -> None:
    assert sorted(title for titles in SECTIONS.values() for title in titles) == sorted(c.title for c in COLUMNS)
    model = model_of(*grid(8, 8))
    measures = measured(model, slit_map(model, [4 * 9 + x for x in range(4)]))
    results = [Result("a", "ours", 9000, False, measures, {})]
    for section in SECTIONS:
        for table in (model_table(results, "ours", section), median_table(results, section)):
            assert all(line.count(" | ") < 7 for line in table.splitlines())


def test_tables_of_a_page_are_renewed() -> None:
    page = "One\n<!-- begin a -->\nold\n<!-- end a -->\nTwo\n<!-- begin b -->\n<!-- end b -->\nThree\n"
    new = with_tables(page, {"b": "| 2 |", "a": "| 1 |"})
    assert "old" not in new
    assert tables_on(new) == ["a", "b"]
    assert new.split() == with_tables(new, {"a": "| 1 |", "b": "| 2 |"}).split()
    assert new.index("| 1 |") < new.index("Two") < new.index("| 2 |") < new.index("Three")
    with pytest.raises(ValueError, match="no place for the table c"):
        with_tables(page, {"c": ""})


def test_sheets_show_seams_checks_and_islands(tmp_path: Path) -> None:
    model = model_of(*grid(8, 8))
    uv_map = slit_map(model, [4 * 9 + x for x in range(6)])
    seams = surface_picture(uv_map, model.frame, (0.0, 0.0), 60)
    red = (seams[..., 0] > 0.5) & (seams[..., 1] < 0.3)
    assert red[:, :30].any()
    assert not red[:, 45:].any()  # the slit ends before
    checks = surface_picture(uv_map, model.frame, (0.0, 0.0), 60, checks=True)
    assert np.ptp(checks[20:40, 20:40]) > 0.3
    assert 0.85 < (layout_picture(uv_map, 60).min(axis=2) < 1).mean() < 1
    pytest.importorskip("matplotlib")
    draw_sheet(tmp_path / "sheet.png", [Row("A", uv_map), Row("B", uv_map)], model.frame, 50)
    assert (tmp_path / "sheet.png").read_bytes().startswith(b"\x89PNG")
