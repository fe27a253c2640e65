# SPDX-License-Identifier: GPL-3.0-or-later
"""Files as they come, in the worker of ``seamwire-batch``: saved in any mode, with hidden parts, several scenes, and data of all kinds."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from scene import add_grid, edit

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "batch"))

from seamwire_batch import assets, worker

pytestmark = pytest.mark.every_blender


def work(path: Path, output: str = "", **more: object) -> tuple[worker.Run, dict[str, Any]]:
    """Work on an asset, and return the worker and the numbers. The written file is open afterwards."""
    folder = path.parent / "made"
    folder.mkdir(exist_ok=True)
    job = {
        "asset": str(path),
        "folder": str(folder),
        "output": output or path.name,
        "name": path.name,
        "way": "suggest",
        "arguments": {"islands": "2"},
        "unwrap": {},
        "object": None,
        "pictures": False,
        **more,
    }
    run = worker.Run(job)
    return run, run.asset()


def save(path: Path) -> Path:
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path


def mapped() -> set[str]:
    """Return the names of the open file's mesh objects that have a UV map with an area."""
    found = set()
    for obj in bpy.data.objects:
        obj.update_from_editmode()
        # In Edit Mode only a copy shows UVs.
        data = obj.data.copy() if obj.type == "MESH" else None
        if data is not None and data.uv_layers:
            uvs = np.zeros(2 * len(data.loops), dtype=np.float32)
            data.uv_layers.active.data.foreach_get("uv", uvs)
            if np.ptp(uvs) > 0.1:
                found.add(obj.name)
    return found


def modes() -> dict[str, str]:
    return {obj.name: obj.mode for obj in bpy.data.objects if obj.mode != "OBJECT"}


@pytest.mark.parametrize(
    "mode", ["SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT", "TEXTURE_PAINT", "EDIT", "POSE", "ARMATURE"]
)
def test_a_file_that_was_saved_in_a_mode_keeps_it(mode: str, tmp_path: Path) -> None:
    add_grid(5, name="Beside")
    add_grid(5, name="Sheet")
    if mode in {"POSE", "ARMATURE"}:
        bpy.ops.object.armature_add()
        mode = "POSE" if mode == "POSE" else "EDIT"
    elif mode == "EDIT":
        edit()
    bpy.ops.object.mode_set(mode=mode)
    before, active = modes(), bpy.context.view_layer.objects.active.name
    assert before
    run, numbers = work(save(tmp_path / "a.blend"))
    assert numbers["objects"] == 2 and mapped() == {"Beside", "Sheet"}, run.warnings
    assert modes() == before and bpy.context.view_layer.objects.active.name == active


def test_what_is_hidden_is_skipped_by_name_and_the_rest_is_done(tmp_path: Path) -> None:
    objects = {
        name: add_grid(5, name=name) for name in ("Seen", "Off", "Excluded", "Dark", "Eye", "Screen", "Faces", "Half")
    }
    bpy.context.view_layer.update()
    for name in ("Off", "Excluded", "Dark"):
        collection = bpy.data.collections.new(name)
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(objects[name])
        bpy.context.collection.objects.unlink(objects[name])
        in_layer = bpy.context.view_layer.layer_collection.children[collection.name]
        if name == "Off":
            collection.hide_viewport = True
        elif name == "Excluded":
            in_layer.exclude = True
        else:
            in_layer.hide_viewport = True
    objects["Eye"].hide_set(True)
    objects["Screen"].hide_viewport = True
    for name, count in (("Faces", 16), ("Half", 8)):
        objects[name].data.polygons.foreach_set("hide", np.arange(16) < count)
    path = save(tmp_path / "a.blend")
    run, numbers = work(path)
    assert numbers["objects"] == 2
    said = "\n".join(run.warnings)
    for name in ("Off", "Excluded", "Dark", "Eye", "Screen", "Faces"):
        assert any(text.startswith("Skipped: ") and name in text for text in run.warnings), said
    assert "Half: 8 of 16 faces are hidden and were not unwrapped" in said
    assert mapped() == {"Seen", "Half"}
    with pytest.raises(assets.AssetError, match="Eye cannot be edited: it is hidden"):
        work(path, object="Eye")


def test_a_mesh_without_area_fails_at_once(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("\n".join("v 1 1 1" if line.startswith("v ") else line for line in CUBE.splitlines()))
    with pytest.raises(assets.AssetError, match="a has no area: its faces are points or lines"):
        work(path)


def test_a_file_of_which_nothing_is_visible_fails_with_the_names(tmp_path: Path) -> None:
    for name in ("One", "Two"):
        add_grid(5, name=name).hide_viewport = True
    with pytest.raises(assets.AssetError, match=r"One cannot be edited: it is hidden.*Two cannot be edited"):
        work(save(tmp_path / "a.blend"))


def test_all_scenes_are_done(tmp_path: Path) -> None:
    first = add_grid(5, name="First")
    scene = bpy.data.scenes.new("Second scene")
    second = bpy.data.objects.new("Second", first.data.copy())
    scene.collection.objects.link(second)
    bpy.data.objects.new("Nowhere", first.data.copy()).use_fake_user = True
    path = save(tmp_path / "a.blend")
    run, numbers = work(path)
    assert numbers["objects"] == 2 and mapped() == {"First", "Second"}
    assert any("Nowhere is not in the view layer" in text and "no scene" in text for text in run.warnings)
    run, _ = work(path, "b.obj")
    assert "Not written, because only one scene can be: Second" in run.warnings


def test_linked_objects_and_overrides_are_skipped_by_name(tmp_path: Path) -> None:
    obj = add_grid(5, name="Far")
    library = str(tmp_path / "library.blend")
    bpy.data.libraries.write(library, {obj})
    bpy.data.objects.remove(obj)
    with bpy.data.libraries.load(library, link=True) as (_, into):
        into.objects = ["Far"]
    bpy.context.collection.objects.link(into.objects[0])
    override = into.objects[0].override_create()
    override.name = "Override"
    bpy.context.collection.objects.link(override)
    add_grid(5, name="Own")
    run, numbers = work(save(tmp_path / "a.blend"))
    assert numbers["objects"] == 1 and "Own" in mapped()
    for name in ("Far", "Override"):
        assert any(text.startswith(f"Skipped: {name} cannot be edited") for text in run.warnings), run.warnings


CUBE = """
v -1 -1 -1 1 0 0
v 1 -1 -1 1 0 0
v 1 1 -1 0 1 0
v -1 1 -1 0 1 0
v -1 -1 1 0 0 1
v 1 -1 1 0 0 1
v 1 1 1 1 1 1
v -1 1 1 1 1 1
g bottom
s 1
f 1 4 3 2
g top
s 2
f 5 6 7 8
g sides
s off
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def test_obj_keeps_vertex_colors_and_what_it_loses_is_said(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(CUBE)
    run, _ = work(path)
    (obj,) = bpy.data.objects
    assert len(obj.data.color_attributes) == 1
    text = (tmp_path / "made" / "a.obj").read_text()
    (lost,) = [text for text in run.warnings if text.startswith("Lost in the OBJ file: ")]
    assert "smoothing groups" in lost and "vertex colors" not in lost
    for name in ("top", "bottom", "sides"):
        assert f"g {name}\n" in text or "groups" in lost.replace("smoothing groups", "")


def test_obj_keeps_groups_of_separate_parts(tmp_path: Path) -> None:
    second = CUBE.replace("v 1", "v 9").replace("v -1", "v 7")
    faces = "\n".join(f"f {8 + a} {8 + b} {8 + c} {8 + d}" for a, b, c, d in ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5)))
    points = [line for line in second.splitlines() if line.startswith("v")]
    own = [line for line in CUBE.splitlines() if line[:2] in {"v ", "f "}]
    path = tmp_path / "a.obj"
    path.write_text("\n".join([*[line for line in own if line[0] == "v"], *points, "g one", *own[8:], "g two", faces]))
    run, _ = work(path)
    text = (tmp_path / "made" / "a.obj").read_text()
    assert "g one" in text and "g two" in text
    assert not any(text.startswith("Lost") for text in run.warnings), run.warnings


@pytest.mark.parametrize("suffix", ["obj", "fbx", "glb", "ply"])
def test_the_same_format_loses_nothing_or_says_so(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a.{suffix}"
    rich(path)
    assets.open_asset(path)
    color = any(len(mesh.color_attributes) for mesh in bpy.data.meshes)
    run, _ = work(path)
    assert any(len(mesh.color_attributes) for mesh in bpy.data.meshes) == color
    assert not any(text.startswith("Lost") for text in run.warnings), run.warnings


def test_what_another_format_cannot_keep_is_said(tmp_path: Path) -> None:
    path = save(tmp_path / "a.blend")
    rich(path)
    run, _ = work(path, "b.ply")
    (lost,) = [text for text in run.warnings if text.startswith("Lost in the PLY file: ")]
    for kind in ("materials", "shape keys", "all but one UV map", "vertex groups", "animation", "lights"):
        assert kind in lost
    assert "vertex colors" not in lost
    run, _ = work(path, "b.glb")
    (lost,) = [text for text in run.warnings if text.startswith("Lost in the GLB file: ")]
    assert "vertex groups" in lost and not any(kind in lost for kind in ("materials", "shape keys", "lights", "colors"))


def rich(path: Path) -> None:
    """Write a file of an object with all kinds of data that its format has."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = add_grid(5, name="Rich")
    for name in ("Map", "Second"):
        layer = obj.data.uv_layers.new(name=name)
        layer.data.foreach_set("uv", np.linspace(0.0, 1.0, 2 * len(obj.data.loops)))
    obj.data.color_attributes.new("Color", "BYTE_COLOR", "CORNER")
    obj.data.materials.append(bpy.data.materials.new("Red"))
    obj.data.materials.append(bpy.data.materials.new("Blue"))
    for face in obj.data.polygons:
        face.material_index = face.index % 2
    obj.vertex_groups.new(name="Group").add([0, 1, 5, 6], 1.0, "REPLACE")
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Up").data[3].co.z = 1.0
    obj.keyframe_insert("location", frame=1)
    obj.location.x = 1.0
    obj.keyframe_insert("location", frame=10)
    bpy.context.collection.objects.link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    bpy.context.view_layer.update()
    assets.EXPORTERS[path.suffix](str(path))


def test_numbers_with_decimal_commas_are_said(tmp_path: Path) -> None:
    texts: dict[str, str] = {
        "a.obj": CUBE.replace("v 1 -1", "v 1,0 -1,0").replace("v -1 ", "v -1,0 "),
        "a.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0,0 0,0 0,0\n1,0 0,0 0,0\n0,0 1,0 0,0\n3 0 1 2\n",
        "a.stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0,0 0,0\nvertex 1,0 0,0 0,0\nvertex 0,0 1,0 0,0\n"
        "endloop\nendfacet\nendsolid a\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
        with pytest.raises(assets.AssetError, match="its numbers have decimal commas"):
            work(tmp_path / name, "made.blend")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig"])
def test_a_text_that_blender_would_misread_is_said(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(CUBE.lstrip(), encoding=encoding)
    with pytest.raises(assets.AssetError, match=r"It cannot be read: it .*Save it as UTF-8"):
        work(path)
    path.write_text("# made elsewhere\n" + CUBE, encoding="utf-8-sig")
    work(path)
    assert mapped()


def test_an_asset_without_a_map_afterwards_is_a_failure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    add_grid(5, name="Sheet")
    path = save(tmp_path / "a.blend")
    with monkeypatch.context() as patch:
        patch.setattr(assets, "unwrap", lambda _obj, **_: None)
        with pytest.raises(assets.AssetError, match="no UV map"):
            work(path)

    def without_maps(to: str) -> None:
        bpy.ops.wm.obj_export(filepath=to, export_uv=False)

    writer: Callable[[str], None] = without_maps
    monkeypatch.setitem(assets.EXPORTERS, ".obj", writer)
    with pytest.raises(assets.AssetError, match="The written file has no UV map of Sheet"):
        work(path, "b.obj")
