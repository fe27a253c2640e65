# SPDX-License-Identifier: GPL-3.0-or-later
"""What `seamwire.mark` marks, and that it changes nothing else."""

import collections
import functools

import bmesh
import bpy
import numpy as np
import pytest
import seamwire
from scene import (
    add_grid,
    add_layers,
    add_object,
    add_suzanne,
    chain,
    changing,
    edit,
    ends,
    mark_wires,
    seams,
    snapshot,
)
from seamwire.core.base import native
from seamwire.mesh import edit_mesh


def mark(chains: str, along: str = "EDGES") -> object:
    return mark_wires(chains=chains, along=along)


def hide_faces(obj: bpy.types.Object, faces: set[int]) -> None:
    with changing(obj) as bm:
        for face in bm.faces:
            if face.index in faces:
                face.hide_set(True)


def test_edges_are_seeds_and_part_of_the_wire() -> None:
    obj = add_grid(9)
    edit()
    mark("36-37 42-43 80")
    marked = seams(obj)
    assert set(chain(*range(36, 44))) <= set(marked)
    assert ends(marked) == [36, 80]


def test_no_wire_takes_the_diagonal_of_a_polygon() -> None:
    # Four quads around the middle of the grid made one octagon: from one of its corners to the opposite one there is a
    # straight way through it, along diagonals only.
    obj = add_grid(5)
    edit()
    with changing(obj) as bm:
        bmesh.ops.dissolve_verts(bm, verts=[bm.verts[12]])
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    octagon = max(bm.faces, key=lambda face: len(face.verts))
    corners = [v.index for v in sorted(octagon.verts, key=lambda v: tuple(v.co))]
    assert len(corners) == 8
    mark(f"{corners[0]} {corners[-1]}")
    assert len(seams(obj)) == 4, "half around it"
    mark(f"{corners[0]} {corners[-1]}", "SURFACE")
    assert ends(seams(obj)) in ([], sorted((corners[0], corners[-1]))), "chains between the two corners only"


@pytest.mark.every_blender
@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_wires_do_not_enter_hidden_faces(along: str) -> None:
    # The faces of the middle column are hidden up to the topmost: the only way leads over the top row.
    obj = add_grid(6)
    edit()
    hide_faces(obj, {2, 7, 12, 17})
    bm = bmesh.from_edit_mesh(obj.data)
    hidden = {tuple(sorted(v.index for v in e.verts)) for e in bm.edges if e.hide}
    assert hidden == {(2, 3), (8, 9), (14, 15), (20, 21)}
    mark("2 3", along)
    marked = seams(obj)
    assert not hidden & set(marked)
    assert ends(marked) == [2, 3]
    assert {(26, 27), (32, 33)} & set(marked)


def test_lengths_are_those_that_are_seen() -> None:
    obj = add_suzanne()
    obj.rotation_euler = (0.3, 1.1, -0.7)
    obj.scale = (1.0, 4.0, 0.5)
    bpy.context.view_layer.update()
    edit()
    arrays = edit_mesh.read(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    world = np.array([obj.matrix_world @ v.co for v in bm.verts])
    a, b = arrays.edges.T
    seen = np.linalg.norm(world[a] - world[b], axis=1)
    read = np.linalg.norm(arrays.points[a] - arrays.points[b], axis=1)
    assert np.allclose(read, seen, rtol=1e-5), "Blender's matrices are of single precision"
    back = arrays.points @ arrays.to_object.T
    assert np.allclose(back, [v.co for v in bm.verts], atol=1e-6)


def test_a_flattened_object_is_read_without_its_matrix() -> None:
    obj = add_grid(3)
    obj.scale = (1.0, 1.0, 0.0)
    bpy.context.view_layer.update()
    edit()
    assert np.allclose(edit_mesh.read(obj).to_object, np.eye(3))
    assert mark("0 2")


@pytest.mark.every_blender
def test_modifiers_do_not_count() -> None:
    obj = add_grid(5)
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
    obj.modifiers.new("Mirror", "MIRROR")
    edit()
    mark("10 14")
    assert seams(obj) == chain(10, 11, 12, 13, 14)


def several() -> list[bpy.types.Object]:
    """Two grids in edit mode, and a third object that has the second one's mesh as well."""
    one, two = add_grid(5, name="One"), add_grid(5, name="Two")
    twin = bpy.data.objects.new("Twin", two.data)
    bpy.context.collection.objects.link(twin)
    twin.select_set(True)
    edit()
    return [one, two, twin]


def test_other_objects_in_edit_mode_are_marked_too() -> None:
    one, two, _ = several()
    mark_wires("10 14", obj=one)
    row = chain(10, 11, 12, 13, 14)
    assert (seams(one), seams(two)) == (row, [])
    mark_wires("20 24", obj=two)
    assert (seams(one), seams(two)) == (row, chain(20, 21, 22, 23, 24))


def test_an_object_in_object_mode_is_marked_and_all_is_as_it_was() -> None:
    obj, other = add_grid(5, name="Marked"), add_grid(5, name="Other")
    obj.select_set(False)
    assert mark_wires("10 14", obj=obj).marked == 4
    assert (obj.mode, other.mode) == ("OBJECT", "OBJECT")
    assert bpy.context.view_layer.objects.active == other
    assert (obj.select_get(), other.select_get()) == (False, True)
    assert (seams(obj), seams(other)) == (chain(10, 11, 12, 13, 14), [])


def test_functions_on_whole_objects_work_on_one_object_only() -> None:
    obj, other = add_grid(5, name="Marked"), add_grid(5, name="Other")
    mark_wires("10 14", obj=obj)
    seamwire.unwrap(obj, changed_only=False)
    assert obj.data.uv_layers and not other.data.uv_layers
    mark_wires("0 17", obj=other, along="SURFACE", metric="euclidean")
    assert not seamwire.unwrap(obj), "there is nothing to do"
    seamwire.cut(other)
    assert len(other.data.vertices) > 25 == len(obj.data.vertices)
    with pytest.raises(ValueError, match="No kept wire runs across the surface"):
        seamwire.cut(obj)


def test_an_option_that_there_is_not_or_that_has_a_wrong_value_changes_nothing() -> None:
    obj = add_grid(5)
    edit()
    before = snapshot(obj)
    with pytest.raises(TypeError, match="There is no option 'parst'"):
        seamwire.suggest(obj, parst=50)
    with pytest.raises(TypeError):
        seamwire.mark(obj, chians=[[0, 4]])
    with pytest.raises(ValueError, match="BEHIND"):
        seamwire.suggest(obj, front="BEHIND")
    with pytest.raises(ValueError, match="ROUND"):
        seamwire.unwrap(obj, method="ROUND")
    assert snapshot(obj) == before


def fail(*_: object, **__: object) -> None:
    raise ValueError("as the test wants it")


@pytest.mark.parametrize("finish", ["SNAP", "SLIDE", "CUT"])
def test_an_error_while_the_mesh_is_changed_is_told_apart_from_a_refusal(
    finish: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    obj = add_grid(5)
    edit()
    monkeypatch.setattr(edit_mesh, "live_unwrap", fail)
    with pytest.raises(RuntimeError, match="Stopped halfway: as the test wants it"):
        mark_wires("0 24", along="SURFACE", finish=finish)
    assert seams(obj) != []


def test_without_the_compiled_part_every_function_raises_import_error(monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_grid(5)
    monkeypatch.setattr(native, "load", lambda *_: (_ for _ in ()).throw(native.NativeError("missing")))
    for work in (lambda obj: seamwire.mark(obj, [[0, 4]]), seamwire.suggest, seamwire.unwrap, seamwire.cut):
        with pytest.raises(ImportError):
            work(obj)


def test_seams_are_suggested_for_an_object() -> None:
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.active_object
    assert seamwire.suggest(obj, islands=3, unwrap=False)
    assert obj.mode == "OBJECT"
    assert sum(edge.use_seam for edge in obj.data.edges) > 3


def test_objects_that_cannot_be_marked_are_refused() -> None:
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    bpy.context.collection.objects.link(lamp)
    for work in (lambda obj: seamwire.mark(obj, [[0, 1]]), seamwire.suggest, seamwire.unwrap, seamwire.cut):
        with pytest.raises(ValueError, match="Lamp has no mesh: it is of type LIGHT"):
            work(lamp)


def test_a_place_that_is_too_far_away_to_be_compared_is_refused() -> None:
    obj = add_grid(5)
    edit()
    with pytest.raises(ValueError, match=r"chains\[0\]\[1\]: The place \(1e\+20 0 0\) is too far from the mesh"):
        mark_wires(chains="3 (1e20 0 0)", along="SURFACE")
    assert seams(obj) == []


def test_what_is_there_already_is_said_and_nothing_is_done_again() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=8, end_fill_type="NOTHING")
    edit()
    assert mark_wires(loops="0-2")
    stored = bpy.context.object.data.seamwire_wires
    with pytest.raises(ValueError, match="The loop through edge 0-2 is there already"):
        mark_wires(loops="0-2")
    assert bpy.context.object.data.seamwire_wires == stored


def test_wires_run_along_edges_without_faces() -> None:
    obj = add_object([(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (3, 1, 0)], [(0, 1, 2)], [(2, 3), (3, 4)])
    edit()
    mark("0 4")
    marked = seams(obj)
    assert set(chain(2, 3, 4)) <= set(marked)
    assert ends(marked) == [0, 4]


def test_what_can_be_reached_is_marked_and_the_rest_said() -> None:
    obj = add_object(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (6, 1, 0)], [(0, 1, 2, 3), (4, 5, 6)]
    )
    edit()
    done = mark("0 1 5")
    assert (done.wires, done.marked, done.cleared) == (1, 1, 0)
    assert done.problems == ("chains[0]: No wire reaches vertex 5: it is not connected to the seed",)
    assert seams(obj) == [(0, 1)]


@pytest.mark.parametrize(
    ("chains", "options", "said"),
    [
        ([], {}, "There is nothing to draw"),
        ([[0, "one"]], {}, r"chains\[0\]\[1\]: 'one' is neither a vertex"),
        ([[0, 1.5]], {}, r"chains\[0\]\[1\]: 1.5 is neither"),
        ([[0, (1.0, 2.0)]], {}, "is neither"),
        ([[0, (1, 2, float("nan"))]], {}, "is neither"),
        ([[0, None]], {}, "None is neither"),
        ([[0, 1], [7]], {}, r"chains\[1\]: a chain needs at least two seeds"),
        ([[0, 25]], {}, r"chains\[0\]\[1\]: There is no vertex 25: the mesh has 25"),
        ([[0, 1], [2, 3, -1]], {}, r"chains\[1\]\[2\]: There is no vertex -1"),
        ([[0, 99999999999999999999]], {}, "no vertex 9999"),
        ([[0, (0, 2)]], {}, r"chains\[0\]\[1\]: There is no edge 0-2"),
        ([[0, 0]], {}, r"chains\[0\]\[1\]: the seed comes twice in a row"),
        ([[0, 1, (6, 7), (7, 6)]], {}, r"chains\[0\]\[3\]: the seed comes twice in a row"),
        ([[0, (6, 25)]], {}, "no vertex 25"),
        ([[(0, 1), 4]], {"along": "SURFACE"}, r"chains\[0\]\[0\]: across the surface, a seed is a vertex or a place"),
        ([[0, (0.1, 0.1, 0.0)]], {}, r"chains\[0\]\[1\]: along edges, a seed is a vertex or an edge"),
        ([[0, 24]], {}, "Vertex 24 is hidden"),
        ([[0, (19, 24)]], {}, "hidden"),
        ([[0, 1]], {"along": "BOTH"}, "along='BOTH': choose one of EDGES, SURFACE"),
        ([[0, 1]], {"metric": "campen"}, "metric='campen': choose one of feature, concave, euclidean"),
        ([[0, 1]], {"mirror": "W"}, "'W' is not an axis"),
        ([[0, 1]], {"along": "SURFACE", "take": "STRIP"}, "take needs along='EDGES'"),
        ([[0, 1]], {"loops": [7]}, r"loops\[0\]: along edges, a loop runs through an edge"),
        ([[0, 1]], {"strokes": [[1]]}, r"strokes\[0\]: a stroke needs at least two vertices"),
        ([[0, 1]], {"strokes": [[0, 99]]}, r"strokes\[0\]\[1\]: There is no vertex 99"),
        ([[0, 1]], {"avoid": [[1, 2], [(0, 1), 3]]}, r"avoid\[1\]\[0\]: a stroke runs through vertices"),
    ],
)
def test_wrong_arguments_are_said_and_nothing_is_marked(
    chains: list[list[object]], options: dict[str, object], said: str
) -> None:
    obj = add_grid(5)
    edit()
    hide_faces(obj, {15})
    before = snapshot(obj)
    with pytest.raises(ValueError, match=said):
        seamwire.mark(obj, chains, **options)
    assert snapshot(obj) == before


def test_numbers_of_numpy_are_seeds() -> None:
    obj = add_grid(5)
    edit()
    seamwire.mark(obj, [np.array([0, 2]), [(np.int64(12), np.int32(13)), 14]])
    assert seams(obj) == sorted(chain(0, 1, 2) + chain(12, 13, 14))
    seamwire.mark(obj, [np.array([[-1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])], along="SURFACE")
    assert set(chain(20, 21, 22)) <= set(seams(obj))


@pytest.mark.parametrize("size", [0, 1])
def test_a_mesh_without_edges_is_said(size: int) -> None:
    add_object([(0.0, 0.0, 0.0)] * size, [])
    edit()
    with pytest.raises(ValueError, match=r"no vertex|No face"):
        mark("0 0")


@pytest.mark.every_blender
def test_outside_edit_mode_the_operators_cannot_be_called() -> None:
    add_grid(3)
    assert not bpy.ops.mesh.seamwire_draw.poll()
    with pytest.raises(RuntimeError, match=r"poll\(\).*Needs a mesh in Edit Mode"):
        bpy.ops.mesh.seamwire_draw()


def test_mirrored_wires_are_marked_as_the_mesh_or_the_operator_says() -> None:
    obj = add_grid(9)
    edit()
    mark_wires(chains="9 11", mirror="X")
    both = sorted(chain(9, 10, 11) + chain(15, 16, 17))
    assert seams(obj) == both
    obj.data.use_mirror_y = True
    mark("1 2")
    assert seams(obj) == sorted([*both, (1, 2), (73, 74)])
    mark_wires(chains="4 5", mirror="")
    assert seams(obj) == sorted([*both, (1, 2), (4, 5), (73, 74)])


def test_across_the_surface_closed_cuts_are_taken_through_vertices_and_places() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=24, radius=0.3, depth=4.0, end_fill_type="TRIFAN")
    obj = bpy.context.active_object
    edit()
    bpy.ops.mesh.subdivide(number_cuts=15)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    middle = next(v.index for v in bm.verts if abs(v.co.z) < 1e-6)
    height = {v.index: v.co.z for v in bm.verts}
    mark = functools.partial(mark_wires, along="SURFACE")
    assert mark(loops=f"{middle} (0.3 0 1.2)")
    marked = seams(obj)
    for low, high in ((-0.4, 0.4), (0.8, 1.6)):
        ring = [edge for edge in marked if all(low < height[v] < high for v in edge)]
        count = collections.Counter(v for edge in ring for v in edge)
        assert len(ring) >= 24
        assert set(count.values()) == {2}, "it is closed"
    tip = next(v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.co.xy.length < 1e-6)
    with pytest.raises(ValueError, match="The shape suggests no closed cut here"):
        mark(loops=str(tip))
    with pytest.raises(ValueError, match="a seed is a vertex or a place, not an edge"):
        mark(loops="3-4")
    with pytest.raises(ValueError, match="take needs along"):
        mark(loops="3", take="STRIP")


@pytest.mark.every_blender
def test_live_unwrap_follows_the_seams_and_leaves_the_selection() -> None:
    obj = add_grid(9)
    add_layers(obj)
    edit()
    before = snapshot(obj, with_seams=False)
    mark("36 44")
    assert snapshot(obj, with_seams=False) == before, "UVs stay where the scene does not ask for more"
    bpy.context.tool_settings.use_edge_path_live_unwrap = True
    try:
        mark("4 76")
    finally:
        bpy.context.tool_settings.use_edge_path_live_unwrap = False
    after = snapshot(obj, with_seams=False)
    assert after["uv Kept"] != before["uv Kept"]
    del after["uv Kept"], before["uv Kept"]
    assert after == before
