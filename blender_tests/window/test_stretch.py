# SPDX-License-Identifier: GPL-3.0-or-later
"""The stretch of the UV map as heat over the model, and islands unwrapped when a chain ends."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bmesh
import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, draw, grid, leave, near, undo_steps
from mathutils import Vector
from scene import chain, changing, seams
from seamwire.core.islands.uv_maps import Stretch
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited
from seamwire.view.layers import HOT, StretchHeat, heat_colors
from seamwire.words.reports import Notice

LEFT, RIGHT = (20, 30), (24, 34)
"""Two corners of a face in the left half of the grid, and of one in the right half."""
COLD, RED = heat_colors()[0][:3], heat_colors()[-1][:3]


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    made = grid(ui)
    lay_out(made, 1.0)
    bpy.ops.ed.undo_push(message="Lay out")
    yield made
    leave(ui)


def lay_out(desk: Desk, right: float, left: float = 1.0) -> None:
    """Let the UVs be what is seen from above, so many times as wide right and left of the middle."""
    mesh = desk.obj.data
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.loops.layers.uv.active
    for face in bm.faces:
        wide = right if face.calc_center_median().x > 0.0 else left
        for loop in face.loops:
            loop[layer].pin_uv = False
            loop[layer].uv = (0.25 * wide * loop.vert.co.x, 0.25 * loop.vert.co.y)
    bmesh.update_edit_mesh(mesh)


def like(desk: Desk, pixels: np.ndarray, corners: tuple[int, int], color: tuple[float, ...]) -> bool:
    """Whether a face has a color's hue: it is drawn with opacity over a lit surface."""
    seen = near(pixels, desk.at(*corners)).mean(axis=0)
    others = [other[:3] for other in heat_colors()]
    return min(others, key=lambda other: _turn(seen, other)) in _nearest(color, others)


def _turn(one: np.ndarray, two: tuple[float, ...]) -> float:
    a, b = np.asarray(one) - np.mean(one), np.asarray(two) - np.mean(two)
    return float(1.0 - a @ b / max(np.linalg.norm(a) * np.linalg.norm(b), 1e-9))


def _nearest(color: tuple[float, ...], others: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    number = others.index(tuple(color))
    return others[max(0, number - 5) : number + 6]


def heat() -> StretchHeat:
    return edited.front.heat


def screen(desk: Desk) -> np.ndarray:
    desk.ui.move((desk.ui.region.width * 0.5, 40.0))
    desk.ui.wait()
    return desk.ui.screen()


def colored(pixels: np.ndarray, desk: Desk, corners: tuple[int, int]) -> bool:
    seen = near(pixels, desk.at(*corners)).mean(axis=0)
    return bool(np.ptp(seen) > 0.25)


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_stretched_faces_are_red_and_others_blue_where_overlays_are_shown(desk: Desk) -> None:
    desk.choose()
    lay_out(desk, right=2.0)
    settings().heat = "ANGLE"
    desk.ui.wait_until(lambda: heat().shown)
    desk.ui.wait_until(lambda: heat().values.max() > 0.9 * HOT)
    pixels = screen(desk)
    assert like(desk, pixels, LEFT, COLD)
    assert like(desk, pixels, RIGHT, RED)
    desk.ui.space.overlay.show_overlays = False
    assert not colored(screen(desk), desk, RIGHT)
    desk.ui.space.overlay.show_overlays = True
    settings().heat = "NONE"
    assert not colored(screen(desk), desk, RIGHT)


def test_a_map_that_changes_is_measured_once(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    measured = []
    update = Stretch.update

    def counting(stretch: Stretch, *uvs: object) -> bool:
        changed = update(stretch, *uvs)
        measured.append(changed)
        return changed

    monkeypatch.setattr(Stretch, "update", counting)
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            edge.seam = all(abs(v.co.x) < 1e-6 for v in edge.verts)
    desk.choose()
    settings().heat = "ANGLE"
    desk.ui.wait_until(lambda: bool(measured))
    assert measured[0]
    desk.ui.wait_until(lambda: edited.front.islands.newest is not None)
    measured.clear()
    lay_out(desk, right=2.0)
    desk.ui.wait_until(lambda: bool(measured))
    assert measured == [True]
    # Redraws, motions and waiting ask for nothing more.
    for step in range(20):
        desk.ui.move((200.0 + 5 * step, 200.0))
        desk.ui.wait(redraw=True)
    assert measured == [True]
    summary = heat().summary
    assert summary.count == 2
    assert summary.value == pytest.approx(1.0, abs=1e-4)
    assert summary.triangles.sum() == 64
    assert heat().legends()[0].lines == ("Stretch of angles", "Mean 1.41×", "Worst of 2 islands 2.00×, outlined")  # noqa: RUF001


def test_areas_are_compared_with_the_mean_and_a_missing_map_is_told_of(desk: Desk) -> None:
    desk.choose()
    lay_out(desk, right=3.0)
    settings().heat = "AREA"
    desk.ui.wait_until(lambda: heat().shown and heat().values.max() > 0.5)
    # 1 and 3 of a mean of 2.
    assert np.unique(heat().values.round(3)) == pytest.approx([np.log2(1.5), 1.0], abs=1e-3)
    mesh = desk.obj.data
    with desk.ui.override():
        while mesh.uv_layers:
            bpy.ops.mesh.uv_texture_remove()  # Blender 5.2 tells nobody of what Python removes
    desk.ui.move(desk.at(40))
    desk.ui.wait_until(lambda: heat().legends()[0].lines == ("No UV map: unwrap to see its stretch",))
    screen(desk)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_chain_unwraps_what_it_changed_in_its_own_step_of_undo(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    settings().unwrap = True
    settings().heat = "ANGLE"
    desk.choose()
    before = uvs(desk)
    draw(desk, 36, 44)
    assert undo_steps(capfd)[-2:] == ["Lay out", "Draw Seamwires"]
    after = uvs(desk)
    assert not np.array_equal(before, after)
    faces = after.reshape(8, 8, 4, 2)
    assert np.abs(faces[3, :, 3] - faces[4, :, 0]).max() > 5e-4, "torn at the seam"
    assert faces[2, :, 3] == pytest.approx(faces[3, :, 0])
    with desk.ui.override():
        bpy.ops.ed.undo()
    desk.ui.wait()
    assert np.array_equal(uvs(desk), before)


@pytest.mark.smoke
def test_saving_within_a_chain_takes_nothing_from_its_end(desk: Desk, tmp_path: Path, reports: list[Notice]) -> None:
    settings().unwrap = True
    settings().heat = "ANGLE"
    desk.choose()
    before, session = uvs(desk), desk.start()
    desk.ui.click(desk.at(36))
    desk.ui.click(desk.at(44))
    desk.ui.wait_until(lambda: len(session.wires) == 1)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"), copy=True)
    assert seams(desk.obj) == chain(*range(36, 45)), "saving marks them"
    assert np.array_equal(uvs(desk), before)
    desk.ui.click(desk.at(44), button="RIGHTMOUSE")
    desk.ui.wait_until(lambda: not desk.running)
    assert not np.array_equal(uvs(desk), before), "the end unwraps"
    assert [notice.text for notice in reports] == ["Draw Seamwires: 1 wire, 8 edges marked"]


@pytest.mark.smoke
def test_seams_that_a_script_marks_within_a_chain_are_not_the_chains(desk: Desk, reports: list[Notice]) -> None:
    desk.choose()
    session = desk.start()
    desk.ui.click(desk.at(36))
    desk.ui.click(desk.at(44))
    desk.ui.wait_until(lambda: len(session.wires) == 1)
    with changing(desk.obj) as bm:
        for vertex in range(4):
            bm.edges.get((bm.verts[vertex], bm.verts[vertex + 1])).seam = True
    desk.ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == sorted([*chain(*range(5)), *chain(*range(36, 45))])
    assert [notice.text for notice in reports] == [
        "Draw Seamwires: 1 wire, 8 edges marked",
        "The mesh was changed: the chain has ended",
    ]


@pytest.mark.smoke
def test_the_worst_island_is_one_key_away(desk: Desk) -> None:
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            edge.seam = all(abs(v.co.x) < 1e-6 for v in edge.verts)
    lay_out(desk, right=2.0)
    bpy.ops.mesh.select_mode(type="FACE")
    desk.choose()
    distance = desk.ui.view.view_distance
    desk.ui.key("W", shift=True, ctrl=True)
    desk.ui.wait(redraw=True)
    faces = bmesh.from_edit_mesh(desk.obj.data).faces
    assert all(face.select == (face.calc_center_median().x > 0.0) for face in faces)
    assert desk.ui.view.view_distance < distance
    assert desk.ui.view.view_location.x == pytest.approx(0.5, abs=1e-3)
    bpy.ops.mesh.select_mode(type="VERT")


@pytest.mark.parametrize("scale", [pytest.param(1.0, marks=pytest.mark.every_blender), -1.0])
def test_the_worst_island_is_turned_to_the_viewer(desk: Desk, scale: float) -> None:
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            edge.seam = all(abs(v.co.x) < 1e-6 for v in edge.verts)
        for vertex in bm.verts:  # a roof: its right half falls to the right
            vertex.co.z = -max(vertex.co.x, 0.0)
    lay_out(desk, right=2.0)
    desk.obj.scale.z = scale
    desk.choose()
    view = desk.ui.view
    normal = Vector((0.7071, 0.0, 0.7071 * scale))

    def towards_viewer() -> Vector:
        return view.view_rotation @ Vector((0.0, 0.0, 1.0))

    view.view_rotation = Vector((-1.0, 0.0, 0.0)).to_track_quat("Z", "Y")
    desk.ui.key("W", shift=True, ctrl=True)
    assert towards_viewer().angle(normal) < 0.01
    desk.ui.look_from_top()
    desk.ui.key("W", shift=True, ctrl=True)
    expected = Vector((0.0, 0.0, 1.0)) if scale > 0.0 else normal
    assert towards_viewer().angle(expected) < 0.01, "what is seen well is not turned"


def uvs(desk: Desk) -> np.ndarray:
    bm = bmesh.from_edit_mesh(desk.obj.data)
    layer = bm.loops.layers.uv.active
    return np.array([[loop[layer].uv[:] for loop in face.loops] for face in bm.faces])
