# SPDX-License-Identifier: GPL-3.0-or-later
"""What ``mesh.seamwire_unwrap`` unwraps, and that all else stays."""

import math

import bmesh
import bpy
import numpy as np
import pytest
from maps import energy, flipped, in_square, overlapping_pairs, signed_areas, triangles
from scene import add_grid, add_layers, add_object, add_suzanne, changing, edit, set_seams, snapshot
from seamwire.core.base import native

ROWS = 9
OWN = "edges int .seamwire_unwrapped"


def add_hill() -> bpy.types.Object:
    """Add a grid of 9 x 9 vertices, curved, so that no unwrapping leaves it as it is."""
    obj = add_grid(ROWS)
    for v in obj.data.vertices:
        v.co.z = 0.5 * np.exp(-2.0 * v.co.length_squared) + 0.2 * v.co.x * v.co.y
    return obj


def row(y: int) -> tuple[int, ...]:
    return tuple(range(ROWS * y, ROWS * y + ROWS))


def uvs(obj: bpy.types.Object) -> np.ndarray:
    """Return the UVs of an edit mesh, (f, 4, 2): its faces have four corners."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    return np.array([[loop[layer].uv[:] for loop in face.loops] for face in bm.faces])


def move(obj: bpy.types.Object, faces: slice, by: tuple[float, float], scale: float = 1.0) -> None:
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.active
        for face in list(bm.faces)[faces]:
            for loop in face.loops:
                loop[layer].uv = [scale * value + offset for value, offset in zip(loop[layer].uv, by, strict=True)]


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
@pytest.mark.parametrize("method", ["ANGLE_BASED", "CONFORMAL"])
def test_with_blenders_methods_a_mesh_without_uvs_is_unwrapped_and_packed_as_blender_does(method: str) -> None:
    found = []
    for name in ("ours", "blenders"):
        obj = add_hill()
        obj.name = name
        edit()
        set_seams(obj, row(3))
        if name == "ours":
            assert bpy.ops.mesh.seamwire_unwrap(method=method) == {"FINISHED"}
        else:
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.uv.unwrap(method=method)
        found.append(uvs(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
        obj.select_set(False)
    assert np.array_equal(*found)
    assert np.ptp(found[0]) > 0.5


def cut_at(obj: bpy.types.Object, axis: str) -> None:
    """Make the edges seams whose faces lie on both sides of the plane through the origin across an axis."""
    with changing(obj) as bm:
        number = "xyz".index(axis)
        for edge in bm.edges:
            edge.seam = len({face.calc_center_median()[number] > 0.0 for face in edge.link_faces}) == 2


@pytest.mark.every_blender
def test_a_mesh_without_uvs_is_flattened_and_packed() -> None:
    obj = add_suzanne(1)
    obj.data.uv_layers.remove(obj.data.uv_layers[0])
    edit()
    cut_at(obj, "x")
    bpy.ops.mesh.select_all(action="DESELECT")
    with changing(obj) as bm:
        bm.faces[3].select = True
    assert unwrap() == {"FINISHED"}
    assert selected(obj) == [3]
    assert not flipped(obj)
    assert not overlapping_pairs(obj)
    assert in_square(obj)
    low, high = boxes(triangles(obj)[0])
    assert (high - low).max() > 0.9, "it fills the square one way"
    assert np.abs(signed_areas(triangles(obj)[0])).sum() > 0.4, "in rows a third is covered"


def test_uvs_are_squeezed_as_the_image_is_wide() -> None:
    image = bpy.data.images.new("Wide", 300, 100)
    material = bpy.data.materials.new("Wide")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    obj = add_hill()
    obj.data.materials.append(material)
    edit()
    for method in ("SEAMWIRE", "ANGLE_BASED"):
        assert bpy.ops.mesh.seamwire_unwrap(method=method, changed_only=False) == {"FINISHED"}
        assert energy(obj, aspect=3.0) < 4.3
    set_seams(obj, row(4))
    assert unwrap() == {"FINISHED"}
    assert energy(obj, aspect=3.0) < 4.3, "in a place of its own too"


def test_all_islands_are_unwrapped_if_asked_for() -> None:
    obj = add_hill()
    edit()
    set_seams(obj, row(3))
    unwrap()
    move(obj, slice(0, 24), (0.1, 0.1), 0.3)
    before = uvs(obj)
    assert unwrap() == {"CANCELLED"}
    assert bpy.ops.mesh.seamwire_unwrap(changed_only=False) == {"FINISHED"}
    assert density(obj, slice(0, 24)) == pytest.approx(density(obj, slice(24, 64)), rel=0.1)
    assert not np.array_equal(before, uvs(obj))


@pytest.mark.every_blender
def test_only_the_islands_whose_seams_changed_are_unwrapped_and_the_others_keep_every_bit() -> None:
    obj = add_hill()
    edit()
    set_seams(obj, row(3), row(6))
    assert unwrap() == {"FINISHED"}
    packed = [slice(0, 24), slice(24, 48), slice(48, 64)]
    for number, faces in enumerate(packed):
        low, _ = boxes(uvs(obj)[faces])
        move(obj, faces, (0.31 * number - 0.4 * low[0], 0.1 - 0.4 * low[1]), 0.4)
    before, kept = uvs(obj), density(obj, packed[1])
    set_seams(obj, tuple(range(ROWS * 3 + 4, ROWS * 6 + 5, ROWS)))
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


def test_only_changed_islands_are_flattened_from_the_map_that_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_hill()
    edit()
    asked = []
    flatten = native.load().UnwrapMesh.flatten

    def noted(mesh: object, islands: np.ndarray, **options: object) -> tuple[np.ndarray, ...]:
        flat = flatten(mesh, islands, **options)
        asked.append((options["start"], flat))
        return flat

    monkeypatch.setattr(native.load().UnwrapMesh, "flatten", noted)
    set_seams(obj, row(3))
    assert unwrap() == {"FINISHED"}
    assert asked[0][0] is None
    before = uvs(obj)
    set_seams(obj, row(6))
    assert unwrap() == {"FINISHED"}
    assert len(asked) == 2
    start, (corners, _, parts, _) = asked[1]
    assert len(corners) == 4 * 8 * 5
    assert len(set(parts.tolist())) == 2
    assert start == pytest.approx(before.reshape(-1, 2))


def test_a_slit_that_stays_closed_in_the_map_is_not_unwrapped_again() -> None:
    obj = add_grid(ROWS)
    edit()
    unwrap()
    set_seams(obj, (40, 41, 42))
    assert unwrap() == {"FINISHED"}
    # As unwrapping leaves a slit where all is flat, up to rounding.
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.active
        for face in bm.faces:
            for loop in face.loops:
                loop[layer].uv = 0.5 * loop.vert.co.xy
    places = uvs(obj)
    assert unwrap() == {"CANCELLED"}
    assert np.array_equal(uvs(obj), places)
    set_seams(obj, (37, 38, 39))
    assert unwrap() == {"FINISHED"}


def test_a_seam_that_is_cleared_joins_its_islands() -> None:
    obj = add_hill()
    edit()
    set_seams(obj, row(3), row(6))
    unwrap()
    before = uvs(obj)
    set_seams(obj, row(3), seam=False)
    assert unwrap() == {"FINISHED"}
    after = uvs(obj)
    assert np.array_equal(before[48:], after[48:])
    # The corners of both rows of faces at what was a seam.
    assert after[16:24, 3] == pytest.approx(after[24:32, 0])


@pytest.mark.every_blender
def test_uvs_that_blender_unwrapped_meanwhile_are_kept() -> None:
    obj = add_hill()
    edit()
    unwrap()
    set_seams(obj, row(3))
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
    with changing(obj) as bm:
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
    set_seams(obj, row(4))
    unwrap()
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    bm.faces.ensure_lookup_table()
    for face in (bm.faces[0], bm.faces[7]):
        for loop in face.loops:
            loop[layer].pin_uv = True
    before = uvs(obj)
    set_seams(obj, (4, 13, 22))
    assert unwrap() == {"FINISHED"}
    after = uvs(obj)
    assert after[[0, 7]] == pytest.approx(before[[0, 7]], abs=1e-6)
    assert not np.array_equal(after[:32], before[:32])
    assert np.array_equal(after[32:], before[32:])


def test_where_all_islands_are_new_they_keep_clear_of_one_with_pins() -> None:
    obj = add_hill()
    edit()
    set_seams(obj, row(4))
    unwrap()
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    bm.faces.ensure_lookup_table()
    for face in (bm.faces[0], bm.faces[7]):
        for loop in face.loops:
            loop[layer].pin_uv = True
            loop[layer].uv = (0.5 + 0.2 * loop.vert.co.x, 0.7 + 0.2 * loop.vert.co.y)
    set_seams(obj, (4, 13, 22), (58, 67, 76))
    assert unwrap() == {"FINISHED"}
    found = uvs(obj)
    assert found[[0, 7]].min() > 0.2, "the pinned faces stay"
    assert apart(found[:32], found[32:])


@pytest.mark.every_blender
def test_another_uv_map_is_unwrapped_for_itself() -> None:
    obj = add_hill()
    edit()
    set_seams(obj, row(4))
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
    set_seams(objects[1], row(4))
    assert unwrap() == {"FINISHED"}
    assert np.array_equal(uvs(objects[0]), first)
    assert not np.array_equal(uvs(objects[1]), second)
    assert not overlapping_pairs(*objects)
    assert OWN.rpartition(" ")[2] in bmesh.from_edit_mesh(objects[0].data).edges.layers.int


@pytest.mark.every_blender
def test_undo_is_one_step() -> None:
    obj = add_hill()
    name = obj.name
    edit()
    set_seams(obj, row(4))
    unwrap()
    bpy.ops.ed.undo_push(message="before")
    before = uvs(obj)
    set_seams(obj, (4, 13, 22))
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
    with pytest.raises(RuntimeError, match="No face is visible in Grid"):
        unwrap()
    assert snapshot(obj) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.select_set(False)
    add_object([(0, 0, 0), (1, 0, 0)], [], [(0, 1)])
    edit()
    with pytest.raises(RuntimeError, match="No face is visible"):
        unwrap()


def test_an_object_that_cannot_be_read_is_named_and_the_others_are_unwrapped(capfd: pytest.CaptureFixture[str]) -> None:
    broken, whole = add_hill(), add_hill()
    broken.name = "Broken"
    broken.data.uv_layers.new()
    broken.data.vertices[0].co.x = math.nan
    broken.select_set(True)
    edit()
    capfd.readouterr()
    assert unwrap() == {"FINISHED"}
    told = capfd.readouterr().out
    assert "Warning: Broken: " in told
    assert "1 island unwrapped" in told
    assert in_square(whole)


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
        set_seams(obj, row(4))
    unwrap()
    with changing(objects[0]) as bm:
        layer = bm.loops.layers.uv.active
        for face in list(bm.faces)[32:]:
            for loop in face.loops:
                loop[layer].uv.x *= 4.0
    before = uvs(objects[0])
    assert bpy.ops.mesh.seamwire_select_islands(which="WORST") == {"FINISHED"}
    assert selected(objects[0]) == list(range(32, 64))
    assert selected(objects[1]) == []
    assert np.array_equal(uvs(objects[0]), before)
    move(objects[1], slice(0, 32), (0.0, 0.0), 9.0)
    assert bpy.ops.mesh.seamwire_select_islands(which="WORST", kind="AREA") == {"FINISHED"}
    assert selected(objects[1]) == list(range(32, 64)), "it is far smaller than the mean"
    bpy.ops.mesh.select_mode(type="VERT")


def test_without_uvs_there_is_no_worst_island() -> None:
    obj = add_hill()
    edit()
    before = snapshot(obj)
    with pytest.raises(RuntimeError, match="unwrap first"):
        bpy.ops.mesh.seamwire_select_islands(which="WORST")
    assert snapshot(obj) == before


@pytest.mark.parametrize("name", ["seamwire_unwrap", "seamwire_suggest", "seamwire_select_islands", "seamwire_store"])
def test_an_object_that_is_hidden_beside_another_is_named(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    hidden, shown = add_grid(5, name="Hidden"), add_grid(5, name="Shown")
    hidden.select_set(True)
    edit()
    for face in bmesh.from_edit_mesh(hidden.data).faces:
        face.hide_set(True)
    bmesh.update_edit_mesh(hidden.data)
    set_seams(shown, range(10, 15))
    capfd.readouterr()
    getattr(bpy.ops.mesh, name)()
    told = capfd.readouterr().out
    assert "Warning: No face is visible in Hidden: it has no faces, or all are hidden\n" in told
    assert "Shown" not in told
