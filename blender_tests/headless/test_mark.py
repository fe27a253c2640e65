# SPDX-License-Identifier: GPL-3.0-or-later
"""What ``mesh.seamwire_mark`` marks, and that it changes nothing else."""

import collections
import functools

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_grid, add_layers, add_object, add_suzanne, chain, edit, ends, head, seams, snapshot


def mark(chains: str, along: str = "EDGES") -> set[str]:
    return bpy.ops.mesh.seamwire_mark(chains=chains, along=along)


def hide_faces(obj: bpy.types.Object, faces: set[int]) -> None:
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if face.index in faces:
            face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_a_row_of_a_grid_is_marked_from_end_to_end(along: str) -> None:
    obj = add_grid(9)
    edit()
    assert mark("36 44", along) == {"FINISHED"}
    assert seams(obj) == chain(*range(36, 45))


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_chains_go_on_from_seed_to_seed(along: str) -> None:
    obj = add_grid(9)
    edit()
    mark("0 8 80; 36 38", along)
    assert seams(obj) == sorted(chain(*range(9)) + chain(*range(8, 81, 9)) + chain(36, 37, 38))


def test_edges_are_seeds_and_part_of_the_wire() -> None:
    obj = add_grid(9)
    edit()
    mark("36-37 42-43 80")
    marked = seams(obj)
    assert set(chain(*range(36, 44))) <= set(marked)
    assert ends(marked) == [36, 80]


@pytest.mark.every_blender
@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_on_suzanne_a_wire_joins_its_seeds_and_nothing_else_changes(along: str) -> None:
    obj = add_suzanne(levels=1)
    add_layers(obj)
    first, second, third = head(obj, 3)
    edit()
    before = snapshot(obj, with_seams=False)
    mark(f"{first} {second} {third}", along)
    marked = seams(obj)
    assert {first, second, third} <= {vertex for edge in marked for vertex in edge}
    assert ends(marked) == [first, third]
    assert snapshot(obj, with_seams=False) == before


def test_no_wire_takes_the_diagonal_of_a_polygon() -> None:
    # Four quads around the middle of the grid made one octagon: from one of its corners to the opposite one there is a
    # straight way through it, along diagonals only.
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bmesh.ops.dissolve_verts(bm, verts=[bm.verts[12]])
    bmesh.update_edit_mesh(obj.data)
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


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_a_turned_moved_and_scaled_object_gets_the_same_seams(along: str) -> None:
    plain = add_suzanne()
    seeds = " ".join(map(str, head(plain, 3)))
    edit()
    mark(seeds, along)
    bpy.ops.object.mode_set(mode="OBJECT")
    expected = seams(plain)
    plain.select_set(False)
    placed = add_suzanne()
    placed.location = (3.0, -2.0, 11.0)
    placed.rotation_euler = (0.3, 1.1, -0.7)
    placed.scale = (7.0, 7.0, 7.0)
    bpy.context.view_layer.update()
    edit()
    mark(seeds, along)
    assert seams(placed) == expected


def test_lengths_are_those_that_are_seen() -> None:
    from seamwire.mesh import edit_mesh

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
    from seamwire.mesh import edit_mesh

    obj = add_grid(3)
    obj.scale = (1.0, 1.0, 0.0)
    bpy.context.view_layer.update()
    edit()
    assert np.allclose(edit_mesh.read(obj).to_object, np.eye(3))
    assert mark("0 2") == {"FINISHED"}


@pytest.mark.every_blender
def test_modifiers_do_not_count() -> None:
    obj = add_grid(5)
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
    obj.modifiers.new("Mirror", "MIRROR")
    edit()
    mark("10 14")
    assert seams(obj) == chain(10, 11, 12, 13, 14)


def test_of_several_objects_in_edit_mode_only_the_active_one_is_marked() -> None:
    other = add_grid(5, name="Other")
    obj = add_grid(5, name="Active")
    edit()
    assert {o.name for o in bpy.context.objects_in_mode} == {"Other", "Active"}
    mark("10 14")
    assert seams(obj) == chain(10, 11, 12, 13, 14)
    assert seams(other) == []


def several() -> list[bpy.types.Object]:
    """Two grids in edit mode, and a third object that has the second one's mesh as well."""
    one, two = add_grid(5, name="One"), add_grid(5, name="Two")
    twin = bpy.data.objects.new("Twin", two.data)
    bpy.context.collection.objects.link(twin)
    twin.select_set(True)
    edit()
    return [one, two, twin]


@pytest.mark.parametrize(
    ("objects", "marked"),
    [
        ("*", ["One", "Two"]),
        ("One", ["One"]),
        ("One; Two", ["One", "Two"]),
        ("Two", ["Two"]),
        ("Two; One;", ["One", "Two"]),
        ("", ["Two"]),
    ],
)
def test_other_objects_in_edit_mode_are_named_and_each_mesh_is_marked_once(objects: str, marked: list[str]) -> None:
    one, two, _ = several()
    assert bpy.ops.mesh.seamwire_mark(chains="10 14", objects=objects) == {"FINISHED"}
    row = chain(10, 11, 12, 13, 14)
    assert {obj.name: seams(obj) for obj in (one, two)} == {
        name: row if name in marked else [] for name in ("One", "Two")
    }
    assert {obj.name for obj in (one, two) if obj.data.seamwire_wires} == set(marked)


def test_what_is_wrong_with_one_of_several_objects_is_said_with_its_name_and_none_is_marked() -> None:
    one, two, _ = several()
    with pytest.raises(RuntimeError, match="Not a mesh in Edit Mode: Three, Zero"):
        bpy.ops.mesh.seamwire_mark(chains="10 14", objects="One; Zero; Three")
    hide_faces(two, {15})
    with pytest.raises(RuntimeError, match="Two: Vertex 24 is hidden"):
        bpy.ops.mesh.seamwire_mark(chains="10 20; 20 24", objects="*")
    assert seams(one) == seams(two) == []


def test_a_place_that_is_too_far_away_to_be_compared_is_refused() -> None:
    obj = add_grid(5)
    edit()
    with pytest.raises(RuntimeError, match=r"The place \(1e\+20 0 0\) is too far from the mesh"):
        bpy.ops.mesh.seamwire_mark(chains="3 (1e20 0 0)", along="SURFACE")
    assert seams(obj) == []


def test_an_object_of_which_nothing_is_visible_keeps_no_other_from_being_marked() -> None:
    empty = bpy.data.objects.new("Empty", bpy.data.meshes.new("Empty"))
    bpy.context.collection.objects.link(empty)
    empty.select_set(True)
    one, two, _ = several()
    assert empty.mode == "EDIT"
    assert bpy.ops.mesh.seamwire_mark(chains="10 14", objects="*") == {"FINISHED"}
    assert seams(one) == seams(two) == chain(10, 11, 12, 13, 14)
    for names in ("One; Empty", "Empty; *"):
        with pytest.raises(RuntimeError, match="Empty: No edge of the mesh is visible"):
            bpy.ops.mesh.seamwire_mark(chains="20 24", objects=names)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    with pytest.raises(RuntimeError, match="No object has anything visible"):
        bpy.ops.mesh.seamwire_mark(chains="20 24", objects="*")


def test_what_is_there_already_is_said_and_nothing_is_done_again() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=8, end_fill_type="NOTHING")
    edit()
    assert bpy.ops.mesh.seamwire_mark(loops="0-2") == {"FINISHED"}
    stored = bpy.context.object.data.seamwire_wires
    with pytest.raises(RuntimeError, match="The loop through edge 0-2 is there already"):
        bpy.ops.mesh.seamwire_mark(loops="0-2")
    assert bpy.context.object.data.seamwire_wires == stored


def test_wires_stay_with_the_mesh() -> None:
    from seamwire.mesh.object_session import ObjectSession

    obj = add_grid(9)
    edit()
    mark("36 40 44")
    bpy.ops.mesh.seamwire_mark(loops="4-13", take="STRIP")
    assert obj.data.seamwire_wires.startswith("seamwire 1 ")
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.edges.layers.int[".seamwire"]
    labelled = sorted(tuple(sorted(v.index for v in e.verts)) for e in bm.edges if e[layer])
    assert labelled == seams(obj)
    wires = ObjectSession(obj).session.wires
    assert {wire.vertices for wire in wires} >= {(36, 37, 38, 39, 40), (40, 41, 42, 43, 44)}
    assert len(wires) == 3


def test_seams_that_were_there_stay() -> None:
    obj = add_grid(5)
    edit()
    mark("0 4")
    mark("2 22")
    assert seams(obj) == sorted(chain(0, 1, 2, 3, 4) + chain(2, 7, 12, 17, 22))


def test_wires_run_along_edges_without_faces() -> None:
    obj = add_object([(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (3, 1, 0)], [(0, 1, 2)], [(2, 3), (3, 4)])
    edit()
    mark("0 4")
    marked = seams(obj)
    assert set(chain(2, 3, 4)) <= set(marked)
    assert ends(marked) == [0, 4]


def test_what_can_be_reached_is_marked_and_the_rest_said(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_object(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (6, 1, 0)], [(0, 1, 2, 3), (4, 5, 6)]
    )
    edit()
    assert mark("0 1 5") == {"FINISHED"}
    assert seams(obj) == [(0, 1)]
    assert "Chain 1: No wire reaches vertex 5" in capfd.readouterr().out


@pytest.mark.parametrize(
    ("chains", "along", "said"),
    [
        ("", "EDGES", "no chains"),
        ("0 one", "EDGES", "'one'"),
        ("0 1; 7", "EDGES", "Chain 2"),
        ("0 25", "EDGES", "no vertex 25"),
        ("0 99999999999999999999", "EDGES", "no vertex 9999"),
        ("0 0-2", "EDGES", "no edge 0-2"),
        ("0 0", "EDGES", "'0' comes twice in a row: a wire needs two different ends"),
        ("0 1 6-7 7-6", "EDGES", "'7-6' comes twice in a row"),
        ("0 6-25", "EDGES", "no vertex 25"),
        ("0-1 4", "SURFACE", "Seeds across the surface must be vertices"),
        ("0 24", "EDGES", "Vertex 24 is hidden"),
        ("0 18-19", "EDGES", None),
        ("0 19-24", "EDGES", "hidden"),
    ],
)
def test_wrong_seeds_are_said_and_nothing_is_marked(chains: str, along: str, said: str | None) -> None:
    obj = add_grid(5)
    edit()
    hide_faces(obj, {15})
    before = snapshot(obj)
    if said is None:
        mark(chains, along)
        return
    with pytest.raises(RuntimeError, match=said):
        mark(chains, along)
    assert snapshot(obj) == before


def test_a_mesh_without_anything_visible_is_said() -> None:
    obj = add_grid(3)
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    with pytest.raises(RuntimeError, match="No edge of the mesh is visible"):
        mark("0 2")
    assert seams(obj) == []


@pytest.mark.parametrize("size", [0, 1])
def test_a_mesh_without_edges_is_said(size: int) -> None:
    add_object([(0.0, 0.0, 0.0)] * size, [])
    edit()
    with pytest.raises(RuntimeError, match=r"no vertex|No edge"):
        mark("0 0")


@pytest.mark.every_blender
def test_outside_edit_mode_the_operators_cannot_be_called() -> None:
    add_grid(3)
    assert not bpy.ops.mesh.seamwire_mark.poll()
    assert not bpy.ops.mesh.seamwire_draw.poll()
    with pytest.raises(RuntimeError, match=r"poll\(\).*Needs a mesh in Edit Mode"):
        mark("0 2")
    with pytest.raises(RuntimeError, match=r"poll\(\).*Needs a mesh in Edit Mode"):
        bpy.ops.mesh.seamwire_draw()


@pytest.mark.every_blender
def test_marking_is_one_step_of_undo() -> None:
    obj = add_grid(5)
    edit()
    bpy.ops.ed.undo_push(message="Before")
    name = obj.name
    bpy.ops.mesh.seamwire_mark("EXEC_DEFAULT", True, chains="0 4; 10 14")
    assert len(seams(obj)) == 8
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert obj.mode == "EDIT"
    assert seams(obj) == []
    bpy.ops.ed.redo()
    assert len(seams(bpy.data.objects[name])) == 8


def test_clearing_takes_seams_away_and_leaves_the_others() -> None:
    obj = add_grid(9)
    edit()
    mark("36 44")
    assert bpy.ops.mesh.seamwire_mark(chains="38 42", clear=True) == {"FINISHED"}
    assert seams(obj) == sorted(chain(36, 37, 38) + chain(42, 43, 44))


def test_mirrored_wires_are_marked_as_the_mesh_or_the_operator_says() -> None:
    obj = add_grid(9)
    edit()
    bpy.ops.mesh.seamwire_mark(chains="9 11", mirror={"X"})
    both = sorted(chain(9, 10, 11) + chain(15, 16, 17))
    assert seams(obj) == both
    obj.data.use_mirror_y = True
    mark("1 2")
    assert seams(obj) == sorted([*both, (1, 2), (73, 74)])
    bpy.ops.mesh.seamwire_mark(chains="4 5", mirror=set())
    assert seams(obj) == sorted([*both, (1, 2), (4, 5), (73, 74)])


def test_loops_are_taken_alone_or_beside_chains() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=12, depth=2.0, end_fill_type="NOTHING")
    obj = bpy.context.active_object
    edit()
    bpy.ops.mesh.subdivide(number_cuts=1)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    ring = [e for e in bm.edges if all(abs(v.co.z) < 1e-6 for v in e.verts)]
    a, b = (v.index for v in ring[0].verts)
    middle = sorted(tuple(sorted(v.index for v in e.verts)) for e in ring)
    assert bpy.ops.mesh.seamwire_mark(loops=f"{a}-{b}") == {"FINISHED"}
    assert seams(obj) == middle
    with pytest.raises(RuntimeError, match="not an edge"):
        bpy.ops.mesh.seamwire_mark(loops="7")


def test_across_the_surface_closed_cuts_are_taken_through_vertices_and_places() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=24, radius=0.3, depth=4.0, end_fill_type="TRIFAN")
    obj = bpy.context.active_object
    edit()
    bpy.ops.mesh.subdivide(number_cuts=15)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.index_update()
    middle = next(v.index for v in bm.verts if abs(v.co.z) < 1e-6)
    height = {v.index: v.co.z for v in bm.verts}
    mark = functools.partial(bpy.ops.mesh.seamwire_mark, along="SURFACE")
    assert mark(loops=f"{middle} (0.3 0 1.2)") == {"FINISHED"}
    marked = seams(obj)
    for low, high in ((-0.4, 0.4), (0.8, 1.6)):
        ring = [edge for edge in marked if all(low < height[v] < high for v in edge)]
        count = collections.Counter(v for edge in ring for v in edge)
        assert len(ring) >= 24
        assert set(count.values()) == {2}, "it is closed"
    tip = next(v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.co.xy.length < 1e-6)
    with pytest.raises(RuntimeError, match=f"Vertex {tip}: The shape suggests no closed cut here"):
        mark(loops=str(tip))
    with pytest.raises(RuntimeError, match="not through edge 3-4"):
        mark(loops="3-4")
    with pytest.raises(RuntimeError, match="Take applies only along edges"):
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
