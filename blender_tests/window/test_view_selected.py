# SPDX-License-Identifier: GPL-3.0-or-later
"""View Selected with nothing selected leaves wrong numbers in the edit mesh: nothing that the tool does may rely on them."""

import bmesh
import bpy
import numpy as np
import pytest
from desk import Desk, drag, draw
from scene import chain, mark_wires, seams
from seamwire.core.sketch.picture import Role
from seamwire.core.sketch.sketch import Sketch
from seamwire.mesh.registration import IS_OLD
from seamwire.mesh.settings import settings
from stored import agree

ROW = chain(*range(36, 45))


def numbers(desk: Desk) -> list[int]:
    """Return the numbers that the vertices say they have."""
    return [vertex.index for vertex in bmesh.from_edit_mesh(desk.obj.data).verts]


def view_selected(desk: Desk) -> None:
    """Press Numpad period with nothing selected. Some Blenders leave the numbers alone: here they are always wrong then."""
    ui = desk.ui
    with ui.override():
        bpy.ops.mesh.select_all(action="DESELECT")
    ui.move(desk.at(60))
    ui.key("NUMPAD_PERIOD")
    if numbers(desk) == list(range(len(numbers(desk)))):
        assert not IS_OLD
        for vertex in bmesh.from_edit_mesh(desk.obj.data).verts:
            vertex.index = 0


def choose(desk: Desk) -> Sketch:
    desk.choose()
    view_selected(desk)
    return desk.session


@pytest.mark.every_blender
def test_edges_and_vertices_are_hovered_and_drawn_along(desk: Desk) -> None:
    session = choose(desk)
    desk.ui.move(desk.at(40))
    assert session.target.pick == 40
    view_selected(desk)
    desk.ui.move(desk.at(40, 41))
    assert set(session.target.pick) == {40, 41}
    view_selected(desk)
    draw(desk, 36, 44)
    assert seams(desk.obj) == ROW
    assert agree(desk.obj)
    view_selected(desk)
    desk.ui.move(desk.at(38))
    assert session.picture.one(Role.HOVERED) is not None
    desk.ui.key("X")
    assert seams(desk.obj) == []


def test_a_chain_goes_on_when_it_is_pressed_within_it(desk: Desk) -> None:
    session, ui = choose(desk), desk.ui
    ui.click(desk.at(36))
    view_selected(desk)
    assert desk.running
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    view_selected(desk)
    ui.key("RET")
    assert seams(desk.obj) == ROW
    view_selected(desk)
    drag(desk, desk.at(44), desk.at(53))
    ui.wait_until(lambda: not desk.running)
    assert {36, 53} == {v for v in range(81) if sum(v in edge for edge in seams(desk.obj)) == 1}
    assert agree(desk.obj)


@pytest.mark.parametrize("finish", ["SNAP", "CUT", "SLIDE"])
def test_wires_across_the_surface_are_snapped_cut_and_slid(desk: Desk, finish: str) -> None:
    settings().along, settings().finish = "SURFACE", finish
    session, ui = choose(desk), desk.ui
    ui.click(desk.at(0))
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    view_selected(desk)
    ui.key("RET")
    assert not desk.running
    view_selected(desk)
    obj = desk.obj
    obj.update_from_editmode()
    assert agree(obj)
    places = np.array([vertex.co for vertex in obj.data.vertices])
    ends = [v for v in range(len(places)) if sum(v in edge for edge in seams(obj)) == 1]
    assert ends == [0, 44]
    length = sum(np.linalg.norm(places[a] - places[b]) for a, b in seams(obj))
    straight = np.linalg.norm(places[0] - places[44])
    assert length == pytest.approx(straight, rel=1e-5) if finish == "CUT" else length > straight - 1e-5
    assert len(places) > 81 if finish == "CUT" else len(places) == 81
    before = seams(obj)
    view_selected(desk)
    with ui.override():
        mark_wires(chains="72 80")
    assert seams(obj) == sorted({*before, *chain(*range(72, 81))})


@pytest.mark.every_blender
def test_islands_are_selected_and_stored(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    bm = bmesh.from_edit_mesh(desk.obj.data)
    # The faces below the middle row, with a hole of one face on top of a steep hill: a tube, which needs a cut.
    ring = {1 * 9 + 3, 1 * 9 + 4, 2 * 9 + 3, 2 * 9 + 4}
    for vertex in bm.verts:
        if vertex.index in ring:
            vertex.co.z += 3.0
    for edge in bm.edges:
        one, two = (vertex.index for vertex in edge.verts)
        edge.seam = (one // 9 == two // 9 == 4) or {one, two} <= ring
    bmesh.update_edit_mesh(desk.obj.data)
    desk.choose()
    monkeypatch.setattr(bpy.context.tool_settings, "mesh_select_mode", (False, False, True))
    view_selected(desk)
    with desk.ui.override():
        bpy.ops.mesh.seamwire_select_islands(which="TO_CUT")
    chosen = [face.select for face in bmesh.from_edit_mesh(desk.obj.data).faces]
    assert chosen == [row < 4 and (row, column) != (1, 3) for row in range(8) for column in range(8)]
    view_selected(desk)
    with desk.ui.override():
        bpy.ops.mesh.seamwire_store(what="ATTRIBUTE")
    bm = bmesh.from_edit_mesh(desk.obj.data)
    layer = bm.faces.layers.int["island"]
    assert [sum(face[layer] == island for face in bm.faces) for island in range(3)] == [32, 31, 1]
