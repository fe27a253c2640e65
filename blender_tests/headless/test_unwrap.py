# SPDX-License-Identifier: GPL-3.0-or-later
"""What ``mesh.seamwire_unwrap`` unwraps, and that all else stays."""

from itertools import pairwise

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_grid, add_layers, add_object, add_suzanne, edit, snapshot
from seamwire.mesh import uv_map
from seamwire.mesh.seam_islands import island_count, worst_island
from seamwire.mesh.unwrap import UNWRAPPED, SavedUvs, unwrap_changed
from stored import session_on, write

ROWS = 9
OWN = "edges int .seamwire_unwrapped"


def add_hill() -> bpy.types.Object:
    """Add a grid of 9 x 9 vertices, curved, so that no unwrapping leaves it as it is."""
    obj = add_grid(ROWS)
    for v in obj.data.vertices:
        v.co.z = 0.5 * np.exp(-2.0 * v.co.length_squared) + 0.2 * v.co.x * v.co.y
    return obj


def mark(obj: bpy.types.Object, *chains: tuple[int, ...], seam: bool = True) -> None:
    """Make the edges between each vertex of chains and the next seams, or no seams."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for chain in chains:
        for a, b in pairwise(chain):
            bm.edges.get((bm.verts[a], bm.verts[b])).seam = seam
    bmesh.update_edit_mesh(obj.data)


def row(y: int) -> tuple[int, ...]:
    return tuple(range(ROWS * y, ROWS * y + ROWS))


def uvs(obj: bpy.types.Object) -> np.ndarray:
    """Return the UVs of an edit mesh, (f, 4, 2): its faces have four corners."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    return np.array([[loop[layer].uv[:] for loop in face.loops] for face in bm.faces])


def move(obj: bpy.types.Object, faces: slice, by: tuple[float, float], scale: float = 1.0) -> None:
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    for face in list(bm.faces)[faces]:
        for loop in face.loops:
            loop[layer].uv = [scale * value + offset for value, offset in zip(loop[layer].uv, by, strict=True)]
    bmesh.update_edit_mesh(obj.data)


def unwrap() -> set[str]:
    return bpy.ops.mesh.seamwire_unwrap()


def but_uvs(obj: bpy.types.Object) -> dict[str, object]:
    active = obj.data.uv_layers.active
    name = f"uv {active.name}" if active else ""
    return {key: value for key, value in snapshot(obj).items() if key not in {name, OWN}}


def boxes(places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return places.reshape(-1, 2).min(axis=0), places.reshape(-1, 2).max(axis=0)


def apart(one: np.ndarray, two: np.ndarray) -> bool:
    (low, high), (other_low, other_high) = boxes(one), boxes(two)
    return bool((high < other_low).any() or (other_high < low).any())


def density(obj: bpy.types.Object, faces: slice) -> float:
    places = uvs(obj)[faces]
    one, two = places[:, 2] - places[:, 0], places[:, 3] - places[:, 1]
    area = 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum()
    return float(np.sqrt(area / sum(face.calc_area() for face in list(bmesh.from_edit_mesh(obj.data).faces)[faces])))


@pytest.mark.every_blender
def test_a_mesh_without_uvs_is_unwrapped_and_packed_as_blender_does() -> None:
    found = []
    for name in ("ours", "blenders"):
        obj = add_hill()
        obj.name = name
        edit()
        mark(obj, row(3))
        if name == "ours":
            assert unwrap() == {"FINISHED"}
        else:
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.uv.unwrap()
        found.append(uvs(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
        obj.select_set(False)
    assert np.array_equal(*found)
    assert np.ptp(found[0]) > 0.5


@pytest.mark.every_blender
def test_only_the_islands_whose_seams_changed_are_unwrapped_and_the_others_keep_every_bit() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(3), row(6))
    assert unwrap() == {"FINISHED"}
    packed = [slice(0, 24), slice(24, 48), slice(48, 64)]
    for number, faces in enumerate(packed):
        low, _ = boxes(uvs(obj)[faces])
        move(obj, faces, (0.31 * number - 0.4 * low[0], 0.1 - 0.4 * low[1]), 0.4)
    before, kept = uvs(obj), density(obj, packed[1])
    mark(obj, tuple(range(ROWS * 3 + 4, ROWS * 6 + 5, ROWS)))
    assert unwrap() == {"FINISHED"}
    after = uvs(obj)
    for faces in (packed[0], packed[2]):
        assert np.array_equal(before[faces], after[faces])
    columns = np.arange(24, 48).reshape(3, 8)
    left, right = columns[:, :4].reshape(-1), columns[:, 4:].reshape(-1)
    assert not np.array_equal(before[left], after[left])
    parts = [after[left], after[right], after[packed[0]], after[packed[2]]]
    assert all(apart(one, two) for i, one in enumerate(parts) for two in parts[:i])
    assert density(obj, packed[1]) == pytest.approx(kept, rel=1e-3)
    low, high = boxes(after)
    assert (low >= 0.0).all()
    assert (high <= 1.0).all()


@pytest.mark.parametrize("even", [False, True])
def test_new_islands_are_as_dense_as_what_they_were_part_of_or_as_the_others(even: bool) -> None:
    obj = add_hill()
    edit()
    mark(obj, row(4))
    assert unwrap() == {"FINISHED"}
    lower, upper = slice(0, 32), slice(32, 64)
    move(obj, lower, (0.0, 0.0), 0.5)
    dense, thin = density(obj, upper), density(obj, lower)
    assert dense == pytest.approx(2.0 * thin, rel=0.1)
    mark(obj, tuple(range(4, ROWS * 4 + 5, ROWS)))
    unwrap_changed(bpy.context, [obj], even)
    assert density(obj, upper) == dense
    assert density(obj, lower) == pytest.approx(dense if even else thin, rel=1e-3)


@pytest.mark.every_blender
@pytest.mark.parametrize("has_map", [False, True])
def test_uvs_come_back_out_of_edit_mode_too_but_not_where_faces_are_others(has_map: bool) -> None:
    obj = add_hill()
    edit()
    if has_map:
        mark(obj, row(4))
        assert unwrap() == {"FINISHED"}
    before = uv_map.read_uvs(obj)
    mark(obj, row(6))
    saved = SavedUvs(obj)
    unwrap_changed(bpy.context, [obj])
    bpy.ops.object.mode_set(mode="OBJECT")
    saved.restore()
    after = uv_map.read_uvs(obj)
    assert np.array_equal(after, before) if has_map else after is None
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    then = uv_map.read_uvs(obj)
    saved.restore()
    assert not has_map or np.array_equal(uv_map.read_uvs(obj), then)


@pytest.mark.parametrize("has_map", [False, True])
def test_uvs_come_back_after_unwrapping_on_trial(has_map: bool) -> None:
    obj = add_hill()
    edit()
    if has_map:
        mark(obj, row(4))
        assert unwrap() == {"FINISHED"}
    mark(obj, row(6))
    before = snapshot(obj)
    saved = SavedUvs(obj)
    unwrap_changed(bpy.context, [obj])
    assert snapshot(obj) != before
    saved.restore()
    assert snapshot(obj) == before


def test_without_room_in_the_square_new_islands_lie_beside_it() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(2))
    assert unwrap() == {"FINISHED"}
    # The large island fills the square, the small one lies under it.
    low, high = boxes(uvs(obj)[16:])
    move(obj, slice(16, 64), tuple(-low / (high - low).min()), 1.0 / (high - low).min())
    low, high = boxes(uvs(obj)[:16])
    move(obj, slice(0, 16), tuple(0.3 - low))
    mark(obj, (4, 13, 22))
    assert unwrap() == {"FINISHED"}
    places = uvs(obj)[:16]
    assert apart(places, uvs(obj)[16:])
    assert boxes(places)[0][0] > 1.0


def test_nothing_is_done_twice() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(4))
    assert unwrap() == {"FINISHED"}
    before = snapshot(obj)
    assert unwrap() == {"CANCELLED"}
    assert snapshot(obj) == before


def test_a_slit_that_stays_closed_in_the_map_is_not_unwrapped_again() -> None:
    obj = add_grid(ROWS)
    edit()
    unwrap()
    mark(obj, (40, 41, 42))
    assert unwrap() == {"FINISHED"}
    # As unwrapping leaves a slit where all is flat, up to rounding.
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    for face in bm.faces:
        for loop in face.loops:
            loop[layer].uv = 0.5 * loop.vert.co.xy
    bmesh.update_edit_mesh(obj.data)
    places = uvs(obj)
    assert unwrap() == {"CANCELLED"}
    assert np.array_equal(uvs(obj), places)
    mark(obj, (37, 38, 39))
    assert unwrap() == {"FINISHED"}


def test_a_seam_that_is_cleared_joins_its_islands() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(3), row(6))
    unwrap()
    before = uvs(obj)
    mark(obj, row(3), seam=False)
    assert unwrap() == {"FINISHED"}
    after = uvs(obj)
    assert np.array_equal(before[48:], after[48:])
    # The corners of both rows of faces at what was a seam.
    assert after[16:24, 3] == pytest.approx(after[24:32, 0])


@pytest.mark.every_blender
@pytest.mark.parametrize("by_blender", [False, True])
def test_islands_that_were_parted_by_a_cut_are_unwrapped_as_one_once_it_is_taken_back(by_blender: bool) -> None:
    obj = add_hill()
    edit()
    bpy.ops.mesh.seamwire_unwrap()
    whole = worst_island(obj, "AREA").value
    # Across the faces, in their middle, from border to border: no edge is left that it went along.
    bpy.ops.mesh.seamwire_mark(chains="(-1 0.13 0) (1 0.13 0)", along="SURFACE", finish="CUT")
    assert island_count(obj) == 2
    if by_blender:
        bm = bmesh.from_edit_mesh(obj.data)
        bm.edges.layers.int.remove(bm.edges.layers.int[UNWRAPPED])
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.unwrap()
    else:
        assert unwrap() == {"FINISHED"}
    mesh = session_on(obj)
    before = mesh.session.network
    for wire in before.wires:
        mesh.session.drop(wire)
    write(mesh)
    assert mesh.finish_wires(before, set()).taken_back > 0
    assert island_count(obj) == 1
    assert worst_island(obj, "AREA").value > whole + 0.1
    assert unwrap() == {"FINISHED"}
    assert worst_island(obj, "AREA").value == pytest.approx(whole, abs=0.02)
    assert unwrap() == {"CANCELLED"}


@pytest.mark.every_blender
def test_uvs_that_blender_unwrapped_meanwhile_are_kept() -> None:
    obj = add_hill()
    edit()
    unwrap()
    mark(obj, row(3))
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap()
    places = uvs(obj)
    assert unwrap() == {"CANCELLED"}
    assert np.array_equal(uvs(obj), places)


@pytest.mark.every_blender
@pytest.mark.parametrize("sync", [False, True])
@pytest.mark.parametrize("mode", ["VERT", "EDGE", "FACE"])
def test_selections_hidden_faces_and_every_layer_stay(mode: str, sync: bool) -> None:
    obj = add_suzanne()
    add_layers(obj)
    obj.data.uv_layers.active_index = 0
    edit()
    bpy.context.tool_settings.use_uv_select_sync = sync
    bpy.ops.mesh.select_mode(type=mode)
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if face.index % 5 == 0:
            face.hide_set(True)
    bpy.ops.mesh.select_all(action="DESELECT")
    bm.faces.ensure_lookup_table()
    for face in list(bm.faces)[31:90:2]:
        if not face.hide:
            face.select = True
    bm.select_flush_mode()
    bm.faces.active = bm.faces[33]
    bmesh.update_edit_mesh(obj.data)
    before = but_uvs(obj)
    hidden = [[loop.index for loop in face.loops] for face in bm.faces if face.hide]
    layer = bm.loops.layers.uv.active
    kept = [tuple(loop[layer].uv) for face in bm.faces if face.hide for loop in face.loops]
    assert unwrap() == {"FINISHED"}
    after = but_uvs(obj)
    assert {name for name in before if before[name] != after[name]} == set()
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    assert len(hidden) > 50
    assert [tuple(loop[layer].uv) for face in bm.faces if face.hide for loop in face.loops] == kept
    bpy.context.tool_settings.use_uv_select_sync = False
    bpy.ops.mesh.select_mode(type="VERT")


@pytest.mark.every_blender
def test_pinned_corners_stay() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(4))
    unwrap()
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    bm.faces.ensure_lookup_table()
    for face in (bm.faces[0], bm.faces[7]):
        for loop in face.loops:
            loop[layer].pin_uv = True
    before = uvs(obj)
    mark(obj, (4, 13, 22))
    assert unwrap() == {"FINISHED"}
    after = uvs(obj)
    assert after[[0, 7]] == pytest.approx(before[[0, 7]], abs=1e-6)
    assert not np.array_equal(after[:32], before[:32])
    assert np.array_equal(after[32:], before[32:])


@pytest.mark.every_blender
def test_another_uv_map_is_unwrapped_for_itself() -> None:
    obj = add_hill()
    edit()
    mark(obj, row(4))
    unwrap()
    first = uvs(obj)
    obj.data.uv_layers.new(name="Other", do_init=False)
    obj.data.uv_layers.active_index = 1
    assert unwrap() == {"FINISHED"}
    obj.data.uv_layers.active_index = 0
    assert np.array_equal(uvs(obj), first)
    assert unwrap() == {"CANCELLED"}


def test_all_objects_in_edit_mode_are_unwrapped_among_each_other() -> None:
    objects = [add_hill() for _ in range(2)]
    for obj in objects:
        obj.select_set(True)
    edit()
    assert unwrap() == {"FINISHED"}
    first, second = (uvs(obj) for obj in objects)
    mark(objects[1], row(4))
    assert unwrap() == {"FINISHED"}
    assert np.array_equal(uvs(objects[0]), first)
    assert not np.array_equal(uvs(objects[1]), second)
    assert apart(uvs(objects[1])[:32], first)
    assert apart(uvs(objects[1])[32:], first)
    assert OWN.rpartition(" ")[2] in bmesh.from_edit_mesh(objects[0].data).edges.layers.int


@pytest.mark.every_blender
def test_undo_is_one_step() -> None:
    obj = add_hill()
    name = obj.name
    edit()
    mark(obj, row(4))
    unwrap()
    bpy.ops.ed.undo_push(message="before")
    before = uvs(obj)
    mark(obj, (4, 13, 22))
    bpy.ops.ed.undo_push(message="mark")
    assert bpy.ops.mesh.seamwire_unwrap("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not np.array_equal(uvs(bpy.data.objects[name]), before)
    bpy.ops.ed.undo()
    assert np.array_equal(uvs(bpy.data.objects[name]), before)
    assert unwrap() == {"FINISHED"}


def test_with_nothing_visible_the_error_says_so_and_nothing_changes() -> None:
    obj = add_hill()
    edit()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.hide()
    before = snapshot(obj)
    with pytest.raises(RuntimeError, match="nothing"):
        unwrap()
    assert snapshot(obj) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.select_set(False)
    add_object([(0, 0, 0), (1, 0, 0)], [], [(0, 1)])
    edit()
    with pytest.raises(RuntimeError, match="No face is visible"):
        unwrap()


def selected(obj: bpy.types.Object) -> list[int]:
    return [face.index for face in bmesh.from_edit_mesh(obj.data).faces if face.select]


@pytest.mark.every_blender
@pytest.mark.parametrize("mode", ["EDGE", "FACE"])
def test_the_worst_island_is_selected(mode: str) -> None:
    objects = [add_hill() for _ in range(2)]
    for obj in objects:
        obj.select_set(True)
    edit()
    bpy.ops.mesh.select_mode(type=mode)
    for obj in objects:
        mark(obj, row(4))
    unwrap()
    bm = bmesh.from_edit_mesh(objects[0].data)
    layer = bm.loops.layers.uv.active
    for face in list(bm.faces)[32:]:
        for loop in face.loops:
            loop[layer].uv.x *= 4.0
    bmesh.update_edit_mesh(objects[0].data)
    before = uvs(objects[0])
    assert bpy.ops.mesh.seamwire_worst_island() == {"FINISHED"}
    assert selected(objects[0]) == list(range(32, 64))
    assert selected(objects[1]) == []
    assert np.array_equal(uvs(objects[0]), before)
    move(objects[1], slice(0, 32), (0.0, 0.0), 9.0)
    assert bpy.ops.mesh.seamwire_worst_island(kind="AREA") == {"FINISHED"}
    assert selected(objects[1]) == list(range(32, 64)), "it is far smaller than the mean"
    bpy.ops.mesh.select_mode(type="VERT")


def test_without_uvs_there_is_no_worst_island() -> None:
    obj = add_hill()
    edit()
    before = snapshot(obj)
    with pytest.raises(RuntimeError, match="unwrap first"):
        bpy.ops.mesh.seamwire_worst_island()
    assert snapshot(obj) == before
