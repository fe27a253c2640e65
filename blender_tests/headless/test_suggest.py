# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that are suggested: ``mesh.seamwire_suggest``."""

import math
import sys

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_grid, add_object, add_suzanne, edit, seams, snapshot
from seamwire.core.suggestion import seeds_for, spread_of
from seamwire.mesh import edit_mesh, seam_islands, unwrap, uv_map
from seamwire.mesh.seam_islands import island_count as islands
from seamwire.mesh.suggestion import Suggestion
from seamwire.operators import suggest
from stored import agree, chains, session_on

unwraps_large_islands = pytest.mark.skipif(
    sys.platform == "win32" and bpy.app.version < (4, 5),
    reason="Wine 8 lacks an OpenMP function that Blender 4.2's unwrap of large islands calls",
)


def open_islands(obj: bpy.types.Object) -> int:
    return len(seam_islands.faces_to_cut(obj)[1])


def stretch(obj: bpy.types.Object) -> float:
    """Return by how many times the worst island is stretched."""
    return max(2.0 ** seam_islands.worst_island(obj, kind).value for kind in ("ANGLE", "AREA"))


def length(obj: bpy.types.Object) -> float:
    """Return that of the seams."""
    verts = bmesh.from_edit_mesh(obj.data).verts
    verts.ensure_lookup_table()
    return sum((verts[a].co - verts[b].co).length for a, b in seams(obj))


@pytest.fixture
def suzanne() -> bpy.types.Object:
    """Suzanne in edit mode: a head and two eyes."""
    obj = add_suzanne()
    edit()
    return obj


def add_ball(name: str = "Ball") -> bpy.types.Object:
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=4, radius=1.0)
    mesh = bpy.data.meshes.new(name)
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


@pytest.mark.every_blender
def test_islands_are_discs_and_seams_are_wires(suzanne: bpy.types.Object) -> None:
    before = snapshot(suzanne, with_seams=False)
    assert open_islands(suzanne) > 0
    assert bpy.ops.mesh.seamwire_suggest() == {"FINISHED"}
    assert open_islands(suzanne) == 0
    assert agree(suzanne)
    assert len(chains(suzanne)) > 10
    assert snapshot(suzanne, with_seams=False) == before


def add_moebius(count: int = 24) -> bpy.types.Object:
    """Add a band of quads that is closed after half a turn."""
    points = []
    for i in range(count):
        angle = 2.0 * math.pi * i / count
        for across in (-0.3, 0.3):
            ring = 1.0 + across * math.cos(angle / 2)
            points.append((ring * math.cos(angle), ring * math.sin(angle), across * math.sin(angle / 2)))
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(count - 1)]
    return add_object(points, [*faces, (2 * count - 2, 1, 0, 2 * count - 1)], name="Moebius")


def test_a_band_that_is_closed_after_half_a_turn_is_cut() -> None:
    obj = add_moebius()
    edit()
    assert open_islands(obj) == 1
    assert bpy.ops.mesh.seamwire_suggest(limit="DISCS") == {"FINISHED"}
    assert open_islands(obj) == 0
    assert seams(obj)


def test_the_report_tells_of_the_islands_that_the_mesh_has(
    suzanne: bpy.types.Object, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    assert seam_islands.missing_cuts(suzanne).tolist() == [1, 0, 0]  # the head is a tube
    monkeypatch.setattr(Suggestion, "write", lambda _: None)  # as if a cut through faces had failed to part them
    assert bpy.ops.mesh.seamwire_suggest() == {"FINISHED"}
    assert "3 islands, 1 of them no disc, 1 more cut needed" in capfd.readouterr().out


def test_a_suggested_wire_can_be_dropped(suzanne: bpy.types.Object) -> None:
    bpy.ops.mesh.seamwire_suggest()
    mesh = session_on(suzanne)
    count = len(mesh.session.wires)
    mesh.session.drop(mesh.session.wires[0])
    mesh.write(mesh.plan())
    assert len(chains(suzanne)) == count - 1
    assert agree(suzanne)


def test_limits(suzanne: bpy.types.Object) -> None:
    found = {}
    for angle in (50.0, 90.0):
        bpy.ops.mesh.seamwire_suggest(angle=math.radians(angle))
        found[angle] = islands(suzanne)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.mark_seam(clear=True)
    assert found[50.0] > found[90.0]
    bpy.ops.mesh.seamwire_suggest(limit="ISLANDS", islands=9)
    assert islands(suzanne) == 9


def test_no_island_is_stretched_more_than_asked() -> None:
    obj = add_ball()
    edit()
    found = {}
    for most in (1.3, 1.1, 1.03):
        assert bpy.ops.mesh.seamwire_suggest(limit="STRETCH", stretch=most) == {"FINISHED"}
        assert stretch(obj) <= most
        assert open_islands(obj) == 0
        assert agree(obj)
        found[most] = islands(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.mark_seam(clear=True)
    assert found[1.03] > found[1.1] > found[1.3]


def test_an_objects_scale_stretches_no_uv_map() -> None:
    obj = add_ball()
    obj.scale = (1.0, 1.0, 3.0)
    bpy.context.view_layer.update()
    edit()
    assert bpy.ops.mesh.seamwire_suggest(limit="STRETCH", stretch=1.2) == {"FINISHED"}
    assert stretch(obj) <= 1.2
    assert islands(obj) < 20


@unwraps_large_islands
def test_seams_against_stretch_are_straight_where_that_keeps_the_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_suzanne(1)
    edit()
    found = {}
    for straightenings in (0, suggest._STRAIGHTENINGS):
        monkeypatch.setattr(suggest, "_STRAIGHTENINGS", straightenings)
        assert bpy.ops.mesh.seamwire_suggest(limit="STRETCH", stretch=1.2) == {"FINISHED"}
        assert stretch(obj) <= 1.2
        assert open_islands(obj) == 0
        found[straightenings] = (islands(obj), len(session_on(obj).session.wires), length(obj))
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.mark_seam(clear=True)
    (count, *detailed), (straight_count, *straight) = found.values()
    assert count == straight_count
    assert straight[0] < detailed[0] and straight[1] < detailed[1]


@unwraps_large_islands
@pytest.mark.parametrize("tries", [1, 2], ids=["given up", "all seeds fixed"])
def test_seams_that_stretch_islands_once_straight_stay_as_they_were(
    monkeypatch: pytest.MonkeyPatch, tries: int
) -> None:
    obj = add_suzanne(1)
    edit()
    straight_plans = []
    straighten, stretched = Suggestion.straighten, Suggestion.stretched

    def noted(self: Suggestion, *arguments: object, **options: object) -> None:
        straighten(self, *arguments, **options)
        straight_plans.append(self.plan)

    def stretched_if_straight(self: Suggestion, most: float) -> list[int]:
        return list(range(self.plan.island_count)) if self.plan in straight_plans else stretched(self, most)

    monkeypatch.setattr(Suggestion, "straighten", noted)
    monkeypatch.setattr(Suggestion, "stretched", stretched_if_straight)
    found = []
    for straightenings in (0, tries):
        monkeypatch.setattr(suggest, "_STRAIGHTENINGS", straightenings)
        assert bpy.ops.mesh.seamwire_suggest(limit="STRETCH", stretch=1.2) == {"FINISHED"}
        assert stretch(obj) <= 1.2
        found.append(seams(obj))
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.mark_seam(clear=True)
    assert len(straight_plans) == tries
    assert found[0] == found[1]


def test_open_islands_are_cut_into_discs_and_no_more(suzanne: bpy.types.Object) -> None:
    before = islands(suzanne)
    assert bpy.ops.mesh.seamwire_suggest(limit="DISCS") == {"FINISHED"}
    assert islands(suzanne) == before
    assert open_islands(suzanne) == 0
    assert bpy.ops.mesh.seamwire_suggest(limit="DISCS") == {"CANCELLED"}


def test_the_worst_island_is_parted_and_no_other() -> None:
    obj = add_ball()
    edit()
    with pytest.raises(RuntimeError, match="unwrap first"):
        bpy.ops.mesh.seamwire_suggest(limit="WORST")
    bpy.ops.mesh.seamwire_suggest(limit="ISLANDS", islands=4, unwrap=True)
    before, faces, was = islands(obj), set(seam_islands.worst_island(obj, "AREA").faces.tolist()), stretch(obj)
    old = set(seams(obj))
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=True) == {"FINISHED"}
    assert islands(obj) > before
    assert stretch(obj) < was
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for pair in set(seams(obj)) - old:
        around = {face.index for face in bm.edges.get([bm.verts[v] for v in pair]).link_faces}
        assert around <= faces


def unwrapped_ball(islands: int) -> bpy.types.Object:
    obj = add_ball()
    edit()
    bpy.ops.mesh.seamwire_suggest(limit="ISLANDS", islands=islands, unwrap=True)
    return obj


@unwraps_large_islands
def test_of_the_cuts_that_part_the_worst_island_the_one_that_lowers_its_stretch_most_is_taken() -> None:
    obj = add_suzanne(1)
    edit()
    bpy.ops.mesh.seamwire_suggest(limit="DISCS", unwrap=True)
    trial = Suggestion(obj, None, True, (24,), None)
    trial.prepare(lambda _: True)
    worst = trial.worst()
    trial.part(worst, 0, lambda _: True)
    found = []
    for plan in trial.partings:
        trial.use(plan)
        trial.write()
        saved = unwrap.SavedUvs(obj)
        unwrap.unwrap_changed(bpy.context)
        found.append((plan.island_count, trial.stretch_within(worst.faces)))
        saved.restore()
        trial.take_back()
    lower = [(count, stretched) for count, stretched in found if stretched < worst.value]
    fewest = lower[0][0]
    least = min(stretched for count, stretched in lower if count <= fewest + 1)
    assert least < lower[0][1] - 0.01
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=True) == {"FINISHED"}
    arrays = edit_mesh.read(obj)
    labels = seam_islands.labels_of(arrays)
    after = seam_islands.stretch_of(obj, arrays, labels)
    parts = np.unique(labels[np.isin(arrays.polygons, worst.faces)])
    assert np.maximum(after.angle, after.area)[parts].max() == pytest.approx(least, abs=1e-4)


@pytest.mark.parametrize("what", ["NONE_LOWERS", "MANY_ISLANDS", "FEW_ISLANDS"])
def test_there_is_more_to_choose_from_in_the_worst_island_where_that_is_needed(
    monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    obj = unwrapped_ball(3)
    was, numbers = stretch(obj), []
    part, stretch_within = Suggestion.part, suggest._stretch_within

    def noted(self: Suggestion, island: object, seeds: int, progress: object) -> None:
        part(self, island, seeds, progress)
        numbers.append(seeds)

    monkeypatch.setattr(Suggestion, "part", noted)
    if what == "NONE_LOWERS":
        monkeypatch.setattr(
            suggest, "_stretch_within", lambda *of: stretch_within(*of) if numbers[-1] > 0 else math.inf
        )
    if what == "MANY_ISLANDS":
        monkeypatch.setattr(suggest, "_FEW", -9)
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=True) == {"FINISHED"}
    assert numbers == {"NONE_LOWERS": [0, 12], "MANY_ISLANDS": [0, 12, 24, 48], "FEW_ISLANDS": [0]}[what]
    assert stretch(obj) < was


def test_unless_asked_to_unwrap_the_worst_island_is_parted_with_its_uvs_kept() -> None:
    obj = unwrapped_ball(3)
    before, old, edges_before = uv_map.read_uvs(obj), seams(obj), unwrap.SavedUvs(obj).remembered
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=False) == {"FINISHED"}
    assert set(seams(obj)) > set(old)
    assert np.array_equal(uv_map.read_uvs(obj), before)
    assert unwrap.SavedUvs(obj).remembered == edges_before


def test_another_object_without_uvs_gets_none_from_parting_the_worst_island() -> None:
    one = unwrapped_ball(3)
    bpy.ops.object.mode_set(mode="OBJECT")
    other = add_ball("Other")
    for obj in (one, other):
        obj.select_set(True)
    edit()
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=False) == {"FINISHED"}
    assert len(other.data.uv_layers) == 0
    assert seams(other)  # a ball is no disc


def test_where_no_cut_lowers_the_worst_stretch_nothing_changes() -> None:
    obj = add_grid(6)
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap()
    before = snapshot(obj)
    assert bpy.ops.mesh.seamwire_suggest(limit="WORST", unwrap=True) == {"CANCELLED"}
    assert snapshot(obj) == before


@pytest.mark.parametrize("limit", ["BEND", "ISLANDS", pytest.param("STRETCH", marks=unwraps_large_islands), "DISCS"])
def test_only_islands_with_selected_faces_are_parted(limit: str) -> None:
    obj = add_suzanne(1)
    edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No face is selected"):
        bpy.ops.mesh.seamwire_suggest(limit=limit, selected=True)
    labels = seam_islands.labels_of(edit_mesh.read(obj))
    head_and_eyes = islands(obj)
    assert head_and_eyes == 3
    polygons = edit_mesh.read(obj).polygons
    head = set(polygons[labels == 0].tolist())
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    bm.faces[min(head)].select = True
    bmesh.update_edit_mesh(obj.data)
    options = {"islands": 4} if limit == "ISLANDS" else {}
    bpy.ops.mesh.seamwire_suggest(limit=limit, selected=True, stretch=1.3, **options)
    bm = bmesh.from_edit_mesh(obj.data)
    assert seams(obj)
    assert {face.index for edge in bm.edges if edge.seam for face in edge.link_faces} <= head
    assert islands(obj) == {"ISLANDS": 2 + 4, "DISCS": 3}.get(limit, islands(obj))
    assert limit == "DISCS" or islands(obj) > head_and_eyes


def test_seams_that_are_there_stay_and_are_no_wires(suzanne: bpy.types.Object) -> None:
    bpy.ops.mesh.seamwire_mark(loops="0-8" if "0-8" in edges(suzanne) else edges(suzanne)[0])
    before = seams(suzanne)
    wires = chains(suzanne)
    assert before
    bpy.ops.mesh.seamwire_suggest()
    assert set(before) <= set(seams(suzanne))
    assert set(wires) <= set(chains(suzanne))
    assert agree(suzanne)


def edges(obj: bpy.types.Object) -> list[str]:
    return [f"{a}-{b}" for a, b in edit_mesh.read(obj).edges[:200].tolist()]


def test_wires_come_in_pairs_where_the_mesh_is_symmetric(suzanne: bpy.types.Object) -> None:
    def unpaired() -> int:
        images = session_on(suzanne).session.partners((0,))
        marked = {frozenset(edge) for edge in seams(suzanne)}
        return len([edge for edge in marked if frozenset(images[list(edge)].tolist()) not in marked])

    bpy.ops.mesh.seamwire_suggest(symmetric=True)
    assert unpaired() <= 0.05 * len(seams(suzanne))


def test_nothing_is_added_to_what_is_flat() -> None:
    obj = add_grid(6)
    edit()
    assert bpy.ops.mesh.seamwire_suggest() == {"CANCELLED"}
    assert seams(obj) == []


@pytest.mark.parametrize("finish", ["SNAP", "CUT"])
def test_across_the_surface(finish: str) -> None:
    obj = add_ball()
    edit()
    vertices = len(obj.data.vertices)
    assert bpy.ops.mesh.seamwire_suggest(limit="ISLANDS", islands=3, finish=finish) == {"FINISHED"}
    obj.update_from_editmode()
    assert (len(obj.data.vertices) > vertices) == (finish == "CUT")
    assert islands(obj) == 3
    assert open_islands(obj) == 0
    assert agree(obj)


@pytest.mark.parametrize("angle", [60.0, 45.0, 30.0])
def test_islands_are_those_planned_where_wires_run_side_by_side(angle: float) -> None:
    """On an uneven surface both metrics' wires leave a seed close to each other, and cross there."""
    obj = add_ball()
    dice = np.random.default_rng(2)
    for vertex in obj.data.vertices:
        vertex.co *= 1.0 + 0.05 * dice.random()
    edit()
    spread = spread_of(math.radians(angle))
    suggestion = Suggestion(obj, "SURFACE", True, (seeds_for(spread),), "CUT")
    suggestion.prepare(lambda _: True)
    suggestion.suggest(lambda _: True, spread)
    assert bpy.ops.mesh.seamwire_suggest(angle=math.radians(angle), along="SURFACE", finish="CUT") == {"FINISHED"}
    assert islands(obj) == suggestion.plan.island_count


@pytest.mark.every_blender
def test_unwraps_on_request() -> None:
    obj = add_ball()
    edit()
    bpy.ops.mesh.seamwire_suggest()
    assert seam_islands.worst_island(obj, "ANGLE") is None
    bpy.ops.mesh.seamwire_suggest(angle=math.radians(40.0), unwrap=True)
    assert stretch(obj) < 1.1


def test_several_objects_and_what_is_hidden() -> None:
    one, other = add_ball("One"), add_ball("Other")
    one.location.x = 5.0
    for obj in (one, other):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = one
    edit()
    bm = bmesh.from_edit_mesh(other.data)
    for face in bm.faces:
        face.hide_set(face.calc_center_median().z > 0.0)
    bmesh.update_edit_mesh(other.data)
    bpy.ops.mesh.seamwire_suggest()
    assert seams(one)
    heights = np.array([[bm.verts[v].co.z for v in edge] for edge in seams(other)])
    assert (heights.max(axis=1) < 0.2).all()


def test_what_hides_all_is_an_error() -> None:
    obj = add_grid(4)
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    with pytest.raises(RuntimeError, match="visible"):
        bpy.ops.mesh.seamwire_suggest()
    assert seams(obj) == []


def test_what_needs_no_seam_is_unwrapped_all_the_same_if_asked_for() -> None:
    obj = add_grid(5)
    edit()
    assert bpy.ops.mesh.seamwire_suggest() == {"CANCELLED"}
    assert not obj.data.uv_layers
    assert bpy.ops.mesh.seamwire_suggest(unwrap=True) == {"FINISHED"}
    assert seams(obj) == []
    assert np.ptp(uv_map.read_uvs(obj), axis=0).min() > 0.5
    assert bpy.ops.mesh.seamwire_suggest(unwrap=True) == {"CANCELLED"}, "nothing has changed since"
