# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks saved and loaded: ``mesh.seamwire_save_network``, ``mesh.seamwire_load_network``."""

from pathlib import Path

import bpy
import pytest
from scene import add_grid, add_suzanne, edit, head, mark_wires, seams, snapshot
from stored import agree, chains


@pytest.fixture
def drawn(tmp_path: Path) -> tuple[bpy.types.Object, Path]:
    """Suzanne with wires, a loop and a stroke, and the file of these."""
    obj = add_suzanne()
    edit()
    a, b, c, d, e = head(obj, 5)
    mark_wires(chains=f"{a} {b} {c}", strokes=f"{a} {d}")
    mark_wires(chains=f"{d} {e}", along="SURFACE", mirror={"X"})
    path = tmp_path / "net.json"
    assert bpy.ops.mesh.seamwire_save_network(filepath=str(path)) == {"FINISHED"}
    return obj, path


@pytest.mark.every_blender
def test_another_copy_of_the_mesh_gets_the_same_seams_and_wires(drawn: tuple[bpy.types.Object, Path]) -> None:
    obj, path = drawn
    wanted, wires = seams(obj), chains(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    copy = add_suzanne()
    edit()
    assert bpy.ops.mesh.seamwire_load_network(filepath=str(path)) == {"FINISHED"}
    assert seams(copy) == wanted
    assert chains(copy) == wires
    assert agree(copy)
    again = path.with_name("again.json")
    bpy.ops.mesh.seamwire_save_network(filepath=str(again))
    assert again.read_text().splitlines()[4:] == path.read_text().splitlines()[4:]
    before = snapshot(copy)
    bpy.ops.mesh.seamwire_load_network(filepath=str(path))
    assert snapshot(copy) == before, "what is there already is not drawn again"


def test_two_slashes_begin_a_path_beside_the_blend_file(drawn: tuple[bpy.types.Object, Path]) -> None:
    obj, path = drawn
    bpy.ops.wm.save_as_mainfile(filepath=str(path.with_name("model.blend")))
    beside = path.with_name("beside.json")
    assert bpy.ops.mesh.seamwire_save_network(filepath="//beside.json") == {"FINISHED"}
    assert beside.read_text() == path.read_text()
    obj = bpy.data.objects[obj.name]
    bpy.ops.mesh.select_all(action="SELECT")
    wanted = seams(obj)
    bpy.ops.mesh.mark_seam(clear=True)
    assert bpy.ops.mesh.seamwire_load_network(filepath="//beside.json") == {"FINISHED"}
    assert seams(obj) == wanted


def test_another_mesh_is_refused_and_stays_as_it_is(drawn: tuple[bpy.types.Object, Path]) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    grid = add_grid(9)
    edit()
    before = snapshot(grid)
    with pytest.raises(RuntimeError, match="to a mesh with 507 vertices, but this one has 81"):
        bpy.ops.mesh.seamwire_load_network(filepath=str(drawn[1]), place="NUMBERS")
    assert snapshot(grid) == before


def test_what_is_no_network_is_refused(drawn: tuple[bpy.types.Object, Path]) -> None:
    obj, path = drawn
    before = snapshot(obj)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(RuntimeError, match="Cannot read the file"):
        bpy.ops.mesh.seamwire_load_network(filepath=str(path))
    with pytest.raises(RuntimeError, match="Cannot read the file"):
        bpy.ops.mesh.seamwire_load_network(filepath=str(path.with_name("none.json")))
    assert snapshot(obj) == before


def test_a_file_that_cannot_be_written_leaves_nothing_behind(drawn: tuple[bpy.types.Object, Path]) -> None:
    folder = drawn[1].parent
    (folder / "taken.json").mkdir()
    with pytest.raises(RuntimeError, match="Cannot write the file"):
        bpy.ops.mesh.seamwire_save_network(filepath=str(folder / "taken.json"))
    assert sorted(path.name for path in folder.iterdir()) == ["net.json", "taken.json"]


def test_without_wires_there_is_nothing_to_save(tmp_path: Path) -> None:
    add_suzanne()
    edit()
    with pytest.raises(RuntimeError, match="No wires to save"):
        bpy.ops.mesh.seamwire_save_network(filepath=str(tmp_path / "none.json"))
    assert list(tmp_path.iterdir()) == []
