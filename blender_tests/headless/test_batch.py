# SPDX-License-Identifier: GPL-3.0-or-later
"""``seamwire-batch`` with real Blenders: files of all formats in, the same out with seams, islands and UV maps."""

import csv
import json
import shlex
import shutil
import stat
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from scene import ADDON, add_grid, add_suzanne, edit, head, mark_wires

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "batch"))

from seamwire_batch import assets, cli, worker  # noqa: E402

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for crashes is a script for sh")


def blender() -> str:
    """Return what starts the Blender that runs this."""
    if bpy.app.binary_path:
        return shlex.quote(bpy.app.binary_path)
    return f"{shlex.quote(sys.executable)} {shlex.quote(str(ROOT / 'scripts/lib/bpy_blender.py'))}"


def run(folder: Path, *words: str) -> tuple[int, dict[str, dict[str, str]]]:
    """Run the command over the folder's assets; return its exit code and the table."""
    installed = [] if ADDON != "seamwire" else ["--addon", str(Path(sys.modules["seamwire"].__file__).parents[1])]
    out = folder / "out"
    command = [str(folder / "assets"), "--out", str(out), "--blender", blender(), *installed, *words]
    code = cli.main(command)
    with (out / "results.csv").open() as file:
        return code, {row["name"]: row for row in csv.DictReader(file)}


def export(folder: Path, names: list[str]) -> None:
    """Write what is in the scene as files of these names."""
    (folder / "assets").mkdir(exist_ok=True)
    for name in names:
        assets.EXPORTERS[Path(name).suffix](str(folder / "assets" / name))


@pytest.fixture
def network(tmp_path: Path) -> Path:
    """The network of a cut around a head, and its model as the scene."""
    obj = add_suzanne()
    edit()
    a, b, c = head(obj, 3)
    mark_wires(chains=f"{a} {b} {c} {a}")
    path = tmp_path / "net.json"
    bpy.ops.mesh.seamwire_save_network(filepath=str(path))
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.edges.foreach_set("use_seam", np.zeros(len(obj.data.edges), dtype=bool))
    obj.data.attributes.remove(obj.data.attributes[".seamwire"])
    obj.data.seamwire_wires = ""
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    return path


@pytest.mark.every_blender
def test_files_come_out_with_seams_islands_and_uvs(network: Path, tmp_path: Path) -> None:
    export(tmp_path, ["a.obj", "b.blend", "c.glb"])
    before = {path: path.read_bytes() for path in (tmp_path / "assets").iterdir()}
    code, rows = run(tmp_path, "--network", str(network), "--no-pictures", "--jobs", "2")
    assert code == 0, rows
    assert {path: path.read_bytes() for path in (tmp_path / "assets").iterdir()} == before
    assert {row["status"] for row in rows.values()} == {"done"}
    for row in rows.values():
        assert int(row["islands"]) >= 4, "two parts of the head, two eyes"
        assert 1.0 <= float(row["angle"]) < 2.0
    made = json.loads((tmp_path / "out" / "a.obj.json").read_text())
    assert made["format"] == "seamwire-network" and made["mesh"]["vertices"] == 507
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "b.blend"))
    mesh = next(obj for obj in bpy.data.objects if obj.type == "MESH").data
    assert sum(edge.use_seam for edge in mesh.edges) == int(rows["b.blend"]["seams"])
    assert "island" in mesh.attributes
    uvs = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    assert np.ptp(uvs) > 0.5


@pytest.mark.every_blender
@pytest.mark.skipif(not ADDON.startswith("bl_ext."), reason="only extensions have wheels")
def test_nothing_is_installed_where_the_blenders_of_the_user_look(
    network: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed = tmp_path / "extensions" / "user_default"
    shutil.copytree(Path(sys.modules["seamwire"].__file__).parents[1], installed)
    monkeypatch.setenv("BLENDER_USER_EXTENSIONS", str(tmp_path / "extensions"))
    export(tmp_path, ["a.blend"])
    code, rows = run(tmp_path, "--network", str(network), "--no-pictures")
    assert code == 0, rows
    assert not (tmp_path / "extensions" / ".local").exists()


def test_what_crashes_hangs_or_is_damaged_costs_itself_alone(network: Path, tmp_path: Path) -> None:
    export(tmp_path, ["a.obj"])
    folder = tmp_path / "assets"
    for name in ("crash.obj", "hang.obj"):
        (folder / name).write_bytes((folder / "a.obj").read_bytes())
    (folder / "damaged.glb").write_bytes(b"glTF no more")
    (folder / "empty.obj").write_bytes(b"# nothing\n")
    wrapper = tmp_path / "blender.sh"
    plain = f"{blender()} --background --factory-startup --python-expr"
    wrapper.write_text(
        "#!/bin/sh\n"
        'for job in "$@"; do :; done\n'
        f'grep -q \'"name": "crash\' "$job" && exec {plain} \'import ctypes; ctypes.string_at(0)\'\n'
        f'grep -q \'"name": "hang\' "$job" && exec {plain} \'import time; time.sleep(600)\'\n'
        f'exec {blender()} "$@"\n'
    )
    wrapper.chmod(wrapper.stat().st_mode | stat.S_IXUSR)
    words = ["--network", str(network), "--no-pictures", "--blender", str(wrapper), "--limit", "15"]
    code, rows = run(tmp_path, *words)
    assert code == 1
    assert {name: row["status"] for name, row in rows.items()} == {
        "a.obj": "done",
        "crash.obj": "crashed",
        "damaged.glb": "failed",
        "empty.obj": "failed",
        "hang.obj": "hung",
    }
    assert "cannot be read" in rows["damaged.glb"]["error"]
    assert "no mesh object" in rows["empty.obj"]["error"]
    assert {path.name for path in (tmp_path / "out").glob("*.obj")} == {"a.obj"}


@pytest.mark.every_blender
def test_seams_go_from_a_source_to_another_topology_with_pictures(tmp_path: Path, capfd: pytest.CaptureFixture) -> None:
    obj = add_grid(15, name="Sheet")
    edit()
    mark_wires(chains="105 119")
    bpy.ops.object.mode_set(mode="OBJECT")
    source = tmp_path / "source.blend"
    assets.EXPORTERS[".blend"](str(source))
    bpy.data.objects.remove(obj)
    add_grid(22, name="Sheet")
    add_grid(3, name="Other")
    export(tmp_path, ["two.blend"])
    code, rows = run(tmp_path, "--source", str(source), "--picture-size", "32")
    assert code == 0
    assert (rows["two.blend"]["objects"], rows["two.blend"]["islands"]) == ("1", "2")
    assert int(rows["two.blend"]["seams"]) >= 21
    picture = bpy.data.images.load(str(tmp_path / "out" / "sheet.png"))
    assert tuple(picture.size) == (2 * 3 * 32, 32)
    pixels = np.array(picture.pixels).reshape(32, -1, 4)[:, :96, :3]
    assert all(np.ptp(pixels[:, 32 * tile : 32 * tile + 32], axis=(0, 1)).max() > 0.2 for tile in range(3))


def test_arguments_of_operators_are_read_and_what_is_wrong_is_said(tmp_path: Path) -> None:
    add_grid(5)
    export(tmp_path, ["a.obj"])
    code, rows = run(tmp_path, "--mark", "chains=[[10, 14]]", "--mark", "mirror=Y", "--no-pictures")
    assert code == 0 and rows["a.obj"]["seams"] == "4"
    code, rows = run(tmp_path, "--mark", "chain=10 14", "--no-pictures")
    assert code == 1 and "unexpected keyword argument 'chain'" in rows["a.obj"]["error"]
    code, rows = run(tmp_path, "--mark", "chains=[[10, 99]]", "--no-pictures")
    assert code == 1 and "There is no vertex 99" in rows["a.obj"]["error"]
    code, rows = run(tmp_path, "--mark", "chains=[[10, 14]]", "--unwrap", "straight=false", "--no-pictures")
    assert code == 0 and rows["a.obj"]["islands"] == "2"
    code, rows = run(tmp_path, "--mark", "chains=[[10, 14]]", "--unwrap", "bent=false", "--no-pictures")
    assert code == 1 and "no argument bent" in rows["a.obj"]["error"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is limited on Linux only")
def test_what_takes_too_much_memory_fails_alone(tmp_path: Path) -> None:
    add_grid(600)
    export(tmp_path, ["large.blend"])
    bpy.data.objects.remove(bpy.data.objects["Grid"])
    add_grid(5)
    export(tmp_path, ["small.obj"])
    bpy.ops.wm.read_homefile(use_empty=True)
    (tmp_path / "assets" / "large.obj").unlink(missing_ok=True)
    code, rows = run(tmp_path, "--suggest", "-", "--no-pictures", "--memory", "250")
    assert code == 1
    assert rows["small.obj"]["status"] == "done"
    assert rows["large.blend"]["status"] == "memory"


@pytest.mark.every_blender
def test_what_is_wrong_with_the_map_in_the_file_is_a_warning(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # As if unwrapping had left the two halves on each other, four times as long as wide.
    obj = add_grid(5)
    layer = obj.data.uv_layers.new()
    for corner in obj.data.loops:
        x, y, _ = obj.data.vertices[corner.vertex_index].co
        layer.data[corner.index].uv = 0.8 * abs(x), 0.2 * y + 0.2
    for edge in obj.data.edges:
        edge.use_seam = all(abs(obj.data.vertices[v].co.x) < 1e-6 for v in edge.vertices)
    export(tmp_path, ["halves.blend"])
    monkeypatch.setattr(assets, "unwrap", lambda _obj, **_: None)
    job = {
        "asset": str(tmp_path / "assets" / "halves.blend"),
        "folder": str(tmp_path),
        "output": "made.blend",
        "name": "halves.blend",
        "way": "suggest",
        "arguments": {"distortion": "30"},
        "unwrap": {},
        "object": None,
        "pictures": False,
    }
    work = worker.Run(job)
    assert work.asset()["islands"] == 2
    assert "Grid: 2 islands overlap" in work.warnings
    assert "Grid: stretch 100 %, 30 % was not reached" in work.warnings
    work = worker.Run({**job, "arguments": {"distortion": "100"}})
    work.asset()
    assert not any("reached" in text for text in work.warnings)
