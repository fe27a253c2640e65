# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that are suggested: ``mesh.seamwire_suggest``."""

import math
import re
from collections.abc import Callable

import bmesh
import bpy
import numpy as np
import pytest
from maps import energy, flipped, in_square, overlapping_pairs, triangles
from mathutils import Matrix
from scene import (
    add_grid,
    add_object,
    add_pillow,
    add_scan,
    add_suzanne,
    changing,
    edit,
    mark_wires,
    seams,
    snapshot,
)
from seamwire.core.base import native
from seamwire.core.islands.islands import IslandMaker
from seamwire.core.seams.seam_plan import PartChoice, PartEdits, edits_text, energy_of, stretch_of
from seamwire.core.seams.seam_wires import Gap, GapFinder
from seamwire.mesh import edit_mesh, seam_search, uv_islands
from seamwire.mesh.object_session import ObjectSession
from seamwire.view.object_view import ShownIslands
from stored import agree, chains, session_on
from stored import island_count as islands


def open_islands(obj: bpy.types.Object) -> int:
    return len(uv_islands.faces_to_cut(obj)[1])


def clear(obj: bpy.types.Object) -> None:
    """Let the mesh have neither seams nor UVs."""
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.mark_seam(clear=True)
    bpy.ops.mesh.select_all(action="DESELECT")
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])


def suggest(**options: object) -> set[str]:
    return bpy.ops.mesh.seamwire_suggest(**options)


def gaps_in(mesh: ObjectSession) -> tuple[Gap, ...]:
    """Return the gaps that the corner of the view counts."""
    arrays, make = mesh.arrays, mesh.make_live
    finder = GapFinder(make.wait, arrays.partly_hidden)
    maker = IslandMaker(arrays.triangles, make.face_segments, gaps=finder)
    shown = ShownIslands(maker, mesh.session, arrays.seams)
    shown.poll()
    while shown.busy:
        shown.poll()
    return shown.newest.gaps


def is_good_map(obj: bpy.types.Object) -> bool:
    """Whether no face is turned over in the UV map, no place is covered twice, and all lies in the square."""
    return not flipped(obj) and not overlapping_pairs(obj) and in_square(obj)


@pytest.fixture
def suzanne() -> bpy.types.Object:
    """Suzanne in edit mode: a head and two eyes."""
    obj = add_suzanne()
    edit()
    return obj


def add_ball(name: str = "Ball", subdivisions: int = 4) -> bpy.types.Object:
    """Add a sphere of triangles."""
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=subdivisions, radius=1.0)
    return add_bmesh(bm, name)


def add_bmesh(bm: bmesh.types.BMesh, name: str) -> bpy.types.Object:
    obj = add_object([], [], name=name)
    bm.to_mesh(obj.data)
    bm.free()
    return obj


def add_cube(cuts: int = 3) -> bpy.types.Object:
    bm = bmesh.new()
    bmesh.ops.create_cube(bm, size=2.0)
    bmesh.ops.subdivide_edges(bm, edges=list(bm.edges), cuts=cuts, use_grid_fill=True)
    return add_bmesh(bm, "Cube")


def add_tube(around: int = 24, along: int = 12) -> bpy.types.Object:
    """Add a cylinder along z without caps."""
    points = [
        (math.cos(2.0 * math.pi * i / around), math.sin(2.0 * math.pi * i / around), 4.0 * j / along - 2.0)
        for j in range(along + 1)
        for i in range(around)
    ]
    faces = [
        (around * j + i, around * j + (i + 1) % around, around * (j + 1) + (i + 1) % around, around * (j + 1) + i)
        for j in range(along)
        for i in range(around)
    ]
    return add_object(points, faces, name="Tube")


def add_tube_with_lids() -> bpy.types.Object:
    """Add a cylinder along z whose lids are single faces."""
    obj = add_tube()
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bmesh.ops.holes_fill(bm, edges=bm.edges, sides=0)
    bm.to_mesh(obj.data)
    bm.free()
    return obj


def rims_of(obj: bpy.types.Object) -> list[list[bmesh.types.BMEdge]]:
    """Return the edges around each lid of an object along z."""
    faces = bmesh.from_edit_mesh(obj.data).faces
    return [list(face.edges) for face in faces if abs(face.normal.z) > 0.9]


def add_torus() -> bpy.types.Object:
    bpy.ops.mesh.primitive_torus_add(major_segments=32, minor_segments=12)
    return bpy.context.active_object


SHAPES = {
    "cube": add_cube,
    "tube": add_tube,
    "torus": add_torus,
    "suzanne": add_suzanne,
    "ball": lambda: add_ball(subdivisions=3),
}


def used(obj: bpy.types.Object) -> float:
    """Return the area of all faces in the UV map."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.verify()
    corners = [[loop[layer].uv for loop in loops] for loops in bm.calc_loop_triangles()]
    return sum(abs((b - a).cross(c - a)) / 2.0 for a, b, c in corners)


@pytest.mark.every_blender
@pytest.mark.parametrize("parts", [0.0, 50.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_islands_are_discs_with_a_good_map_within_the_limit(
    shape: str, parts: float, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = SHAPES[shape]()
    edit()
    clear(obj)
    before = snapshot(obj, with_seams=False)
    assert suggest(parts=parts) == {"FINISHED"}
    assert open_islands(obj) == 0
    assert agree(obj)
    assert is_good_map(obj)
    assert energy(obj) < energy_of(0.17) + 0.02
    told = capfd.readouterr().out
    assert f"{islands(obj)} island" in told
    assert float(re.search(r"stretch ([\d.]+) %, no overlap", told)[1]) == pytest.approx(
        100.0 * stretch_of(energy(obj)), abs=0.6
    )
    assert float(re.search(r"([\d.]+) % of the UV square used", told)[1]) == pytest.approx(100.0 * used(obj), abs=0.6)
    after = snapshot(obj, with_seams=False)
    assert all(after[key] == before[key] for key in before if key not in {"uv layers"})


def add_sector() -> bpy.types.Object:
    """Add a flat strip of quads along an eighth of a ring. Laid out straight, it stretches by about 4 %."""
    turns = np.linspace(0.0, 0.25 * np.pi, 13)
    points = [(r * math.cos(t), r * math.sin(t), 0.0) for t in turns for r in (1.0, 1.15)]
    return add_object(points, [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(12)], name="Sector")


@pytest.mark.parametrize(("stretch", "is_straight"), [(17.0, True), (1.0, False)])
def test_strips_are_straight_only_within_the_limit(stretch: float, is_straight: bool) -> None:
    obj = add_sector()
    edit()
    assert suggest(distortion=stretch) == {"FINISHED"}
    assert (energy(obj) > 4.002) == is_straight
    assert energy(obj) < energy_of(0.01 * stretch)


def test_the_same_sphere_always_gets_the_same_seams() -> None:
    """Blender adds the faces of a sphere in another order each time."""
    found = set()
    for _ in range(12):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=10)
        edit()
        assert suggest() == {"FINISHED"}
        found.add(frozenset(seams(bpy.context.object)))
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(bpy.context.object)
    assert len(found) == 1


def turns(obj: bpy.types.Object) -> int:
    """Return the number of vertices of four edges at which a seam turns."""
    verts = bmesh.from_edit_mesh(obj.data).verts
    found = 0
    for vert in verts:
        ends = [edge for edge in vert.link_edges if edge.seam]
        if len(vert.link_edges) == 4 and len(ends) == 2:
            found += bool(set(ends[0].link_faces) & set(ends[1].link_faces))
    return found


FIRST_SHAPES = {
    "cube": (bpy.ops.mesh.primitive_cube_add, 1, 7),
    "cylinder": (bpy.ops.mesh.primitive_cylinder_add, 3, 65),
    "cone": (bpy.ops.mesh.primitive_cone_add, 2, 33),
    "torus": (bpy.ops.mesh.primitive_torus_add, 1, 60),
    "sphere": (bpy.ops.mesh.primitive_uv_sphere_add, 1, None),
}
"""What adds each of the shapes that everybody tries first, its islands and its seam edges."""


@pytest.mark.parametrize("shape", FIRST_SHAPES)
def test_first_shapes_get_few_seams_without_jogs(shape: str) -> None:
    add, count, edges = FIRST_SHAPES[shape]
    add()
    obj = bpy.context.view_layer.objects.active
    edit()
    clear(obj)
    assert suggest() == {"FINISHED"}
    assert islands(obj) == count
    assert edges in (None, len(seams(obj)))
    assert turns(obj) == 0
    assert is_good_map(obj)


@pytest.mark.parametrize("levels", [0, 1, 2])
def test_suzanne_has_few_islands_at_each_level_of_subdivision(levels: int) -> None:
    obj = add_suzanne(levels)
    edit()
    clear(obj)
    assert suggest() == {"FINISHED"}
    assert 4 <= islands(obj) <= 7, "ears, eyes, and a head"
    assert is_good_map(obj)


@pytest.mark.parametrize("along", [(0.0, 0.0, 0.0), (0.3, 0.5, 0.81)])
def test_a_mesh_without_area_is_refused_with_a_sentence(along: tuple[float, float, float]) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=16)
    obj = bpy.context.object
    for vertex in obj.data.vertices:
        vertex.co = (vertex.co.x * along[0], vertex.co.x * along[1], vertex.co.x * along[2])
    edit()
    with pytest.raises(RuntimeError, match=r"(area|face)"):
        suggest()


@pytest.mark.parametrize("finish", ["SNAP", "CUT"])
@pytest.mark.parametrize("unwrap", [False, True])
def test_live_unwrap_does_not_come_before_our_unwrap(
    finish: str, unwrap: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    called = []
    monkeypatch.setattr(edit_mesh, "live_unwrap", called.append)
    add_ball(subdivisions=2)
    edit()
    assert suggest(along="SURFACE", finish=finish, distortion=40.0, unwrap=unwrap) == {"FINISHED"}
    assert (len(called) > 0) == (not unwrap)


def test_uvs_from_before_there_were_seams_are_replaced_and_later_ones_kept() -> None:
    obj = add_suzanne()  # with the UVs that Blender gives her: no seam marks their islands
    edit()
    assert obj.data.uv_layers
    assert suggest(parts=0.0, distortion=40.0) == {"FINISHED"}
    assert is_good_map(obj)
    before = uv_islands.read_uvs(obj)
    arrays = edit_mesh.read(obj)
    corners, _ = uv_islands.read_map(obj)
    eyes = np.unique(corners.of_triangles(arrays)[uv_islands.labels_of(arrays) > 0])
    assert suggest(parts=0.0, distortion=28.0) == {"FINISHED"}
    after = uv_islands.read_uvs(obj)
    assert np.array_equal(after[eyes], before[eyes]), "they needed no seam"
    assert not np.array_equal(after, before)


def add_figure() -> bpy.types.Object:
    """Add a body with a head, hands and feet on narrow limbs: cubes side by side, subdivided, symmetric in x."""
    body = {(x, 0, z) for x in (-1, 0, 1) for z in range(4)}
    limbs = {(x, 0, 3) for x in range(-6, 7)} | {(x, 0, z) for x in (-1, 1) for z in range(-6, 0)}
    cells = body | limbs | {(0, 0, 4), (0, 0, 5)}
    bm = bmesh.new()
    vertices: dict[tuple[int, ...], bmesh.types.BMVert] = {}
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                beside = tuple(x + (2 * side - 1) * (i == axis) for i, x in enumerate(cell))
                if beside in cells:
                    continue
                places = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))[:: 2 * side - 1]:
                    place = list(cell)
                    place[axis] += side
                    place[(axis + 1) % 3] += u
                    place[(axis + 2) % 3] += v
                    places.append(tuple(place))
                for place in places:
                    if place not in vertices:
                        vertices[place] = bm.verts.new((place[0] - 0.5, place[1] - 0.5, place[2]))
                bm.faces.new([vertices[place] for place in places])
    for vertex in bm.verts:
        x, y, z = vertex.co
        if abs(x) > 4.6:  # hands
            vertex.co.yz = 2.0 * y, 3.5 + 2.0 * (z - 3.5)
        elif z > 5.1:  # the head
            vertex.co.xy = 2.0 * x, 2.0 * y
        elif z < -4.1:  # feet
            middle = math.copysign(1.0, x)
            vertex.co.xy = middle + 1.7 * (x - middle), 1.7 * y
    obj = add_bmesh(bm, "Figure")
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 1
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj


def test_there_are_at_least_so_many_islands_as_asked_for_or_the_report_says_why_not(
    capfd: pytest.CaptureFixture[str],
) -> None:
    obj = add_figure()
    edit()
    assert suggest(parts=0.0, islands=4, distortion=40.0) == {"FINISHED"}
    assert 4 <= islands(obj) <= 6
    assert open_islands(obj) == 0
    assert "fewer than" not in capfd.readouterr().out
    clear(obj)
    assert suggest(parts=0.0, islands=50, distortion=40.0) == {"FINISHED"}
    assert islands(obj) >= 50
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    cube = add_cube(cuts=0)
    edit()
    assert suggest(islands=9) == {"FINISHED"}
    assert islands(cube) == 6, "it has six faces"
    assert "fewer than 9" in capfd.readouterr().out


class Unreached:
    """A plan that claims to be beyond the limit."""

    def __init__(self, plan: object) -> None:
        self._plan = plan

    is_reached = False

    def __getattr__(self, name: str) -> object:
        return getattr(self._plan, name)


def test_what_the_report_says_of_the_limit_is_true_of_the_map_and_not_of_the_plan(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    plan = seam_search.Suggestion.plan

    def looser(self: seam_search.Suggestion, _energy: float, *arguments: object) -> None:
        plan(self, energy_of(0.6), *arguments)
        self.best = Unreached(self.best)

    monkeypatch.setattr(seam_search.Suggestion, "plan", looser)
    obj = add_ball(subdivisions=3)
    edit()
    assert suggest(distortion=9.0) == {"FINISHED"}
    told = capfd.readouterr().out
    assert f"Warning: {len(chains(obj))} wire" in told
    assert f"stretch {100.0 * stretch_of(energy(obj)):.0f} %, no overlap, 9 % was not reached" in told
    clear(obj)
    assert suggest(distortion=61.0) == {"FINISHED"}
    told = capfd.readouterr().out
    assert "Info: " in told
    assert "reached" not in told


def test_maps_that_cannot_be_made_have_no_stretch_in_the_report(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ValueError("as the test wants it")

    monkeypatch.setattr(seam_search, "unwrap_changed", fail)
    add_cube()
    edit()
    assert suggest(distortion=40.0) == {"FINISHED"}
    told = capfd.readouterr().out
    assert "Warning: as the test wants it" in told
    assert "stretch" not in told
    assert "overlap" not in told


def test_the_report_tells_of_the_islands_that_the_mesh_has(
    suzanne: bpy.types.Object, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    assert uv_islands.count_islands(suzanne) == 3
    # As if a cut through faces had failed to part them.
    monkeypatch.setattr(seam_search.Suggestion, "write", lambda *_: None)
    assert suggest() == {"FINISHED"}
    assert "3 islands" in capfd.readouterr().out


@pytest.mark.parametrize("count", [1, 3])
def test_only_islands_with_selected_faces_are_cut(count: int) -> None:
    bm = bmesh.new()
    for place in (-2.0, 2.0):
        matrix = Matrix.Translation((place, 0.0, 0.0))
        bmesh.ops.create_icosphere(bm, subdivisions=2, radius=1.0, matrix=matrix)
    obj = add_bmesh(bm, "Balls")
    edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No face is selected"):
        suggest(islands=count, selected=True)
    with changing(obj) as bm:
        next(face for face in bm.faces if face.calc_center_median().x > 0.0).select = True
    suggest(selected=True, islands=count, distortion=40.0)
    bm = bmesh.from_edit_mesh(obj.data)
    places = [vertex.co.x for edge in bm.edges if edge.seam for vertex in edge.verts]
    assert places and min(places) > 0.0
    assert open_islands(obj) == 1, "the other ball is"
    assert islands(obj) == count + 1


def test_seams_that_are_there_stay_and_are_no_wires(suzanne: bpy.types.Object) -> None:
    pair = edit_mesh.read(suzanne).edges[0].tolist()
    mark_wires(loops=f"{pair[0]}-{pair[1]}")
    before, wires = seams(suzanne), chains(suzanne)
    assert before
    suggest(distortion=40.0)
    assert set(before) <= set(seams(suzanne))
    assert set(wires) <= set(chains(suzanne))
    assert agree(suzanne)


@pytest.mark.parametrize("ends", ["150-109", "159-150", "98-182"])
def test_a_seam_over_the_brow_leads_to_no_small_island(suzanne: bpy.types.Object, ends: str) -> None:
    clear(suzanne)
    mark_wires(chains=ends.replace("-", " "), along="EDGES")
    marked = set(seams(suzanne))
    assert marked
    assert islands(suzanne) == 3, "the head and the eyes"
    assert suggest(parts=0.0, view_direction=(0.0, -1.0, 0.0)) == {"FINISHED"}
    assert marked < set(seams(suzanne))
    assert islands(suzanne) == 3
    assert is_good_map(suzanne)
    assert energy(suzanne) < energy_of(0.17) + 0.02


@pytest.fixture
def planners(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, object]]:
    """What planners are made with."""
    made: list[dict[str, object]] = []
    plain = native.load().SeamPlanner

    def noted(surface: object, **options: object) -> object:
        made.append(options)
        return plain(surface, **options)

    monkeypatch.setattr(native.load(), "SeamPlanner", noted)
    return made


def test_the_mirror_of_selected_islands_counts_only_if_they_are_symmetric(planners: list[dict[str, object]]) -> None:
    obj = add_suzanne()
    edit()
    arrays = edit_mesh.read(obj)
    labels = uv_islands.labels_of(arrays)
    for label in (0, 1):  # the head, and one of the eyes
        bpy.ops.mesh.select_all(action="DESELECT")
        edit_mesh.select_faces(obj, arrays.polygons[labels == label][:1])
        suggest(selected=True, unwrap=False, distortion=40.0)
    assert [options["mirror"] for options in planners] == [0, None]
    suggest(symmetric=False, unwrap=False, distortion=40.0)
    assert planners[-1]["mirror"] is None


def test_seams_are_hidden_from_the_front_in_the_objects_own_coordinates(planners: list[dict[str, object]]) -> None:
    obj = add_cube()
    obj.rotation_euler = (0.0, 0.0, 0.5 * math.pi)
    obj.scale = (1.0, 2.0, 1.0)
    bpy.context.view_layer.update()
    edit()
    for front, view, expected in (
        ("VIEW", (0.0, 0.0, 0.0), (-1.0, 0.0, 0.0)),  # without a window Blender's front, -y of the scene
        ("VIEW", (-3.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        ("FRONT", (-3.0, 0.0, 0.0), (-1.0, 0.0, 0.0)),
    ):
        suggest(front=front, view_direction=view, unwrap=False)
        assert planners[-1]["front"] == pytest.approx(expected, abs=1e-6)
    suggest(front="NONE", unwrap=False)
    assert planners[-1]["front"] is None


def test_strokes_and_selected_islands_weigh_the_wires(planners: list[dict[str, object]]) -> None:
    obj = add_grid(21)
    edit()
    mark_wires(chains="210 230")
    mark_wires(chains="0 1", strokes="45 50 55; ~385 390 395")
    suggest(unwrap=False)
    weights = planners[-1]["weights"]
    assert weights[[47, 393]] == pytest.approx([0.125, 8.0], rel=1e-6)
    assert weights[220] == 1.0
    bpy.ops.mesh.select_all(action="DESELECT")
    edit_mesh.select_faces(obj, np.array([0]))
    suggest(selected=True, unwrap=False)
    weights = planners[-1]["weights"]
    assert np.isinf(weights[231:]).all()
    assert np.isfinite(weights[:231]).all()
    assert weights[47] == pytest.approx(0.125, rel=1e-6)


def add_triangulated_pebble() -> bpy.types.Object:
    """Add a rounded cube of 6,348 triangles, squeezed into three sizes."""
    obj = add_cube(22)
    for v in obj.data.vertices:
        v.co = v.co.lerp(1.3 * v.co.normalized(), 0.7)
        v.co = (v.co.x, 0.7 * v.co.y, 0.4 * v.co.z)
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.quads_convert_to_tris()
    return obj


@pytest.mark.every_blender
@pytest.mark.parametrize(("make", "is_cut"), [(add_triangulated_pebble, False), (add_scan, True)])
def test_only_scans_get_vertices(make: Callable[[], bpy.types.Object], is_cut: bool) -> None:
    obj = make()
    edit()
    vertices = len(obj.data.vertices)
    assert suggest() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (len(obj.data.vertices) > vertices) == is_cut


def sides_of_islands(obj: bpy.types.Object) -> list[set[bool]]:
    """Return on which sides of the plane y = 0 the triangles of each island lie."""
    arrays = edit_mesh.read(obj)
    labels, places = uv_islands.labels_of(arrays), arrays.points[arrays.triangles].mean(axis=1)[:, 1]
    is_beside = np.abs(places) > 1e-6  # a corner of the outline lies on the plane
    return [set((places[is_beside & (labels == label)] < 0.0).tolist()) for label in range(labels.max() + 1)]


@pytest.mark.every_blender
def test_parts_by_is_an_argument() -> None:
    obj = add_pillow((" ##  ## ", "########", "########", " ###### ", "  ####  ", "   ##   "))
    edit()
    assert suggest(parts_by="PANELS", front="FRONT") == {"FINISHED"}
    assert sides_of_islands(obj) == [{True}, {False}]
    clear(obj)
    suggest(unwrap=False)
    assert sides_of_islands(obj) != [{True}, {False}], "a heart is no garment"
    prism = add_prism()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = prism
    edit()
    counts = {}
    for by in ("AUTO", "RIMS", "LIMBS", "PANELS"):
        clear(prism)
        suggest(parts_by=by, front="FRONT", distortion=1000.0, unwrap=False)
        counts[by] = islands(prism)
    assert counts["AUTO"] == counts["RIMS"] == 3
    assert counts["PANELS"] > 3
    clear(prism)
    with pytest.raises(TypeError):
        suggest(parts_by="SIDES")


@pytest.mark.parametrize("finish", ["SNAP", "SLIDE", "CUT"])
def test_across_the_surface(finish: str) -> None:
    obj = add_ball(subdivisions=3)
    edit()
    obj.update_from_editmode()
    vertices, places = len(obj.data.vertices), np.array([v.co[:] for v in obj.data.vertices])
    assert suggest(along="SURFACE", finish=finish) == {"FINISHED"}
    obj.update_from_editmode()
    assert (len(obj.data.vertices) > vertices) == (finish == "CUT")
    moved = np.abs(np.array([v.co[:] for v in obj.data.vertices])[:vertices] - places).max() > 1e-6
    assert moved == (finish == "SLIDE")
    assert open_islands(obj) == 0
    assert agree(obj)
    assert is_good_map(obj)


@pytest.mark.every_blender
def test_several_objects_and_what_is_hidden() -> None:
    one, other = add_cube(), add_ball("Other", 3)
    one.location.x = 5.0
    bpy.context.view_layer.objects.active = one
    edit()
    with changing(other) as bm:
        for face in bm.faces:
            face.hide_set(face.calc_center_median().z > 0.0)
    suggest(distortion=8.0)
    assert seams(one)
    heights = np.array([[bm.verts[v].co.z for v in edge] for edge in seams(other)])
    assert len(heights) and (heights.max(axis=1) < 0.3).all()
    together = np.concatenate([triangles(obj)[0] for obj in (one, other)])
    assert is_good_map(one)
    assert not flipped(other) and not overlapping_pairs(other)
    assert together.max() - together.min() > 0.5
    layer = bm.loops.layers.uv.active
    assert {tuple(loop[layer].uv) for face in bm.faces if face.hide for loop in face.loops} == {(0.0, 0.0)}


@pytest.mark.every_blender
def test_what_is_flat_needs_no_seam_and_gets_uvs(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_grid(5)
    edit()
    assert suggest(unwrap=False) == {"CANCELLED"}
    assert not obj.data.uv_layers
    assert suggest() == {"FINISHED"}
    assert "No seam needed: 1 island unwrapped" in capfd.readouterr().out
    assert seams(obj) == []
    assert np.ptp(uv_islands.read_uvs(obj), axis=0).min() > 0.9
    assert energy(obj) == pytest.approx(4.0, abs=1e-4)
    assert suggest() == {"CANCELLED"}, "nothing has changed since"
    assert "Nothing to add" in capfd.readouterr().out


def test_a_plan_without_seams_is_a_result_once_the_search_has_ended() -> None:
    objects = [add_grid(5), add_cube()]
    for obj in objects:
        obj.select_set(True)
    edit()
    options = seam_search.SearchOptions(None, None, True, None, 17.0, 1, True)
    search = seam_search.SeamSearch(bpy.context.objects_in_mode_unique_data, options, selected=False)
    search.choose(PartChoice(0.0, 17.0))
    assert [suggestion.best_so_far for suggestion in search] == [None, None]
    search.plan(lambda _: True)
    found = {suggestion.mesh.obj: suggestion.best_so_far for suggestion in search}
    assert all(plan is not None for plan in found.values())
    assert [len(found[obj].wires) > 0 for obj in objects] == [False, True]


def test_an_objects_scale_changes_nothing() -> None:
    obj = add_ball(subdivisions=3)
    obj.scale = (1.0, 1.0, 3.0)
    bpy.context.view_layer.update()
    edit()
    assert suggest(distortion=12.0) == {"FINISHED"}
    assert energy(obj) < energy_of(0.12) + 0.02
    for wire in session_on(obj).session.wires:
        vertices = np.array([bmesh.from_edit_mesh(obj.data).verts[v].co[:] for v in (wire.start, wire.end)])
        ends = np.asarray(wire.points)[[0, -1]] @ session_on(obj).arrays.to_object.T
        assert ends == pytest.approx(vertices, abs=1e-5)


@pytest.mark.parametrize("options", [{"along": "EDGES"}, {"finish": "CUT"}, {"finish": "SLIDE"}], ids=str)
@pytest.mark.parametrize("add", [lambda: add_cube(0), add_suzanne, add_figure], ids=["cube", "suzanne", "figure"])
def test_suggested_seams_have_no_gaps(add: Callable[[], bpy.types.Object], options: dict[str, str]) -> None:
    obj = add()
    edit()
    assert suggest(**{"along": "SURFACE", **options}) == {"FINISHED"}
    assert gaps_in(session_on(obj)) == ()


# Parts


def add_prism(sides: int = 7) -> bpy.types.Object:
    """Add a prism: its sides meet at 51 degrees, and two lids."""
    bm = bmesh.new()
    bmesh.ops.create_cone(bm, cap_ends=True, segments=sides, radius1=1.0, radius2=1.0, depth=1.6)
    return add_bmesh(bm, "Prism")


@pytest.mark.every_blender
@pytest.mark.parametrize(("parts", "expected"), [(0.0, 1), (50.0, 3), (100.0, 9)])
def test_parts_are_islands_and_their_borders_wires(parts: float, expected: int) -> None:
    obj = add_prism()
    edit()
    assert suggest(parts=parts) == {"FINISHED"}
    assert islands(obj) == expected
    assert open_islands(obj) == 0
    assert is_good_map(obj)
    assert agree(obj)


def test_a_closed_border_is_one_wire_that_can_be_dropped_as_a_whole() -> None:
    obj = add_prism()
    edit()
    suggest()
    mesh = session_on(obj)
    rims = [wire for wire in mesh.session.wires if wire.closed]
    assert [len(rim.vertices) for rim in rims] == [7, 7]
    mesh.session.drop(rims[0])
    mesh.write(mesh.plan())
    assert islands(obj) == 2
    assert agree(obj)


@pytest.mark.parametrize("finish", ["SNAP", "SLIDE", "CUT"])
def test_borders_run_along_edges_whatever_becomes_of_slits(finish: str) -> None:
    obj = add_tube_with_lids()
    edit()
    rims = [{frozenset(vert.index for vert in edge.verts) for edge in rim} for rim in rims_of(obj)]
    assert suggest(along="SURFACE", finish=finish) == {"FINISHED"}
    assert islands(obj) == 3
    marked = {frozenset(edge) for edge in seams(obj)}
    assert len(rims) == 2 and all(rim <= marked for rim in rims)
    assert is_good_map(obj)
    assert agree(obj)


def test_sharp_marks_and_borders_of_materials_count() -> None:
    obj = add_grid(9)
    edit()
    assert suggest(unwrap=False) == {"CANCELLED"}, "flat, so one part"
    for name in ("One", "Other"):
        obj.data.materials.append(bpy.data.materials.new(name))
    with changing(obj) as bm:
        for face in bm.faces:
            face.material_index = int(face.calc_center_median().x > 0.0)
    found = {frozenset(edge) for edge in edit_mesh.read(obj).marked[1].tolist()}
    assert len(found) == 8
    assert suggest(parts=100.0, unwrap=False) == {"FINISHED"}
    assert {frozenset(edge) for edge in seams(obj)} == found


def test_edits_of_clicks_are_arguments() -> None:
    obj = add_prism()
    edit()
    rim = rims_of(obj)[0]
    edges = frozenset(tuple(sorted(vert.index for vert in edge.verts)) for edge in rim)
    assert suggest(edits=edits_text({"Prism": PartEdits().drop(edges)}), unwrap=False) == {"FINISHED"}
    assert islands(obj) == 2
    clear(obj)
    assert suggest(parts=0.0, edits=edits_text({"Prism": PartEdits().keep(edges)}), unwrap=False) == {"FINISHED"}
    assert islands(obj) == 2
    clear(obj)
    assert suggest(edits=edits_text({"Other": PartEdits().drop(edges)}), unwrap=False) == {"FINISHED"}
    assert islands(obj) == 3, "another object has these edits"
    clear(obj)
    side = next(face.index for face in bmesh.from_edit_mesh(obj.data).faces if abs(face.normal.z) < 0.5)
    assert suggest(edits=edits_text({"Prism": PartEdits().part(side)}), unwrap=False) == {"FINISHED"}
    assert islands(obj) == 4
    with pytest.raises(RuntimeError):
        suggest(edits="no edits")


@pytest.mark.parametrize("selected", [False, True])
def test_only_selected_islands_get_borders(selected: bool) -> None:
    bm = bmesh.new()
    for place in (-2.0, 2.0):
        bmesh.ops.create_cube(bm, size=2.0, matrix=Matrix.Translation((place, 0.0, 0.0)))
    obj = add_bmesh(bm, "Cubes")
    edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        next(face for face in bm.faces if face.calc_center_median().x > 0.0).select = True
    assert suggest(parts=100.0, selected=selected, unwrap=False) == {"FINISHED"}
    assert islands(obj) == (7 if selected else 12)
