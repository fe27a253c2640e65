# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains across the surface that are cut into the faces when they end."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from desk import Desk, drag, draw, shows, undo_steps
from scene import chain, changing, seams, snapshot
from seamwire.core.network.picks import FacePoint
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.picture import Role
from seamwire.mesh import finishes
from seamwire.mesh.object_session import ObjectSession
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited
from seamwire.words.reports import Notice, Notices
from stored import agree, chains, session_on


@pytest.fixture
def cutting(desk: Desk) -> Desk:
    """Wires across the surface are cut."""
    settings().along, settings().finish = "SURFACE", "CUT"
    return desk


def length(desk: Desk) -> float:
    """Return the length of all seams."""
    vertices = bpy.data.objects[desk.name].data.vertices
    desk.obj.update_from_editmode()
    return sum((vertices[a].co - vertices[b].co).length for a, b in seams(desk.obj))


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_chain_is_cut_when_it_ends_in_one_step_of_undo(cutting: Desk) -> None:
    session, ui = cutting.start(), cutting.ui
    count = len(cutting.obj.data.vertices)
    ui.click(cutting.at(0), ctrl=True)
    ui.move(cutting.at(44))
    ui.wait_until(lambda: session.picture.active is not None and session.picture.one(Role.COMPUTING) is None)
    alone = ui.pixels()
    settings().finish = "SNAP"
    ui.wait(redraw=True)
    snapped = ui.pixels()
    settings().finish = "CUT"
    ui.wait(redraw=True)
    assert np.abs(alone - snapped).max() > 0.2, "with the edges that it would snap to"
    assert np.array_equal(ui.pixels(), alone)
    ui.click(cutting.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert cutting.left_clean()
    assert agree(cutting.obj)
    straight = (cutting.obj.data.vertices[0].co - cutting.obj.data.vertices[44].co).length
    assert length(cutting) == pytest.approx(straight, rel=1e-6)
    ui.key("Z", ctrl=True)
    obj = bpy.data.objects[cutting.name]
    obj.update_from_editmode()
    assert len(obj.data.vertices) == count
    assert seams(obj) == []


@pytest.mark.oldest_and_newest
def test_what_is_drawn_stays_seen_after_a_cut_and_its_undo_though_the_mouse_rests(cutting: Desk) -> None:
    ui = cutting.ui
    with ui.override():
        bpy.ops.mesh.select_all(action="DESELECT")  # Blender's orange is not to be taken for ours
    cutting.choose()
    wire, end = cutting.ui.on_screen((-0.5, -0.75, 0.0)), cutting.at(44)
    ui.click(cutting.at(0))
    ui.click(end)
    ui.wait_until(lambda: len(cutting.session.wires) == 1)
    ui.key("RET")
    assert not cutting.running
    assert len(cutting.obj.data.vertices) > 81
    ui.wait_until(lambda: bool(edited.views()), seconds=3.0)
    assert len(edited.front.session.wires) == 1
    kept = edited.front.overlay._looks.kept.color[:3]
    assert shows(ui.pixels(), wire, kept)
    ui.key("Z", ctrl=True)
    assert edited.views(), "at once"
    assert edited.front.session.wires == ()
    assert not shows(ui.pixels(), wire, kept)


def test_drawing_goes_on_after_a_cut_on_the_mesh_as_it_is(cutting: Desk) -> None:
    session, ui = cutting.start(), cutting.ui
    ui.click(cutting.at(0), ctrl=True)
    ui.click(cutting.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.click(cutting.at(72), ctrl=True)  # another chain: the first one is cut
    assert length(cutting) > 0
    ui.click(cutting.at(80))
    ui.wait_until(lambda: not cutting.session.waiting and len(cutting.session.wires) == 2)
    ui.key("RET")
    assert cutting.left_clean()
    assert agree(cutting.obj)
    assert set(chain(*range(72, 81))) <= set(seams(cutting.obj))
    assert {(own[0], own[-1]) for own in chains(cutting.obj)} == {(0, 44), (72, 80)}


def test_a_line_elsewhere_ends_the_live_chain_and_both_are_cut_in_one_step(
    cutting: Desk, capfd: pytest.CaptureFixture[str]
) -> None:
    session, ui = cutting.start(), cutting.ui
    ui.click(cutting.at(0), ctrl=True)
    ui.click(cutting.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    drag(cutting, cutting.at(63), cutting.at(71))
    ui.wait_until(lambda: not cutting.running)
    assert agree(cutting.obj)
    assert [own[0] for own in chains(cutting.obj)] == [0, 63]
    straight = (cutting.obj.data.vertices[0].co - cutting.obj.data.vertices[44].co).length
    assert length(cutting) == pytest.approx(straight + 2.0, rel=0.02)
    assert undo_steps(capfd)[-2:] == ["Before", "Draw Seamwires"]


def test_a_wire_within_a_face_is_in_a_file_that_is_saved_within_the_chain(cutting: Desk, tmp_path: Path) -> None:
    session, ui = cutting.start(), cutting.ui
    arrays = edited.front.mesh.arrays
    cutting.chain.begin()
    cutting.chain.draw_on(edited.front)
    session.click(2)
    for weights in ((0.2, 0.2, 0.6), (0.1, 0.25, 0.65)):
        place = np.array(weights) @ arrays.points[arrays.triangles[20]]
        session.click(FacePoint.at(place, 20, arrays.triangles, arrays.points))
        session.wait()
    assert len(session.wires[-1].vertices) == 1
    path = str(tmp_path / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    assert len(session.wires) == 2, "it is not cut before it leads out of the face"
    session.click(44)
    session.wait()
    drawn = sum(np.linalg.norm(np.diff(wire.points, axis=0), axis=1).sum() for wire in session.wires)
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    with bpy.data.libraries.load(path, link=False) as (inside, wanted):
        wanted.meshes = inside.meshes
    (saved,) = (mesh for mesh in wanted.meshes if len(mesh.vertices) > 81)
    assert any(edge.use_seam for edge in saved.edges)
    ui.move(cutting.at(60))
    ui.key("ESC")
    ui.wait_until(lambda: not cutting.running)
    assert agree(cutting.obj)
    assert length(cutting) == pytest.approx(drawn, rel=1e-3), "both wires"


@pytest.mark.parametrize("where", ["before", "within", "after"])
def test_an_error_while_cutting_loses_no_wire_and_undo_leads_back(
    cutting: Desk, monkeypatch: pytest.MonkeyPatch, where: str
) -> None:
    reported: list[Notice] = []
    take = Notices.take

    def fail(*_: object) -> None:
        raise ZeroDivisionError("on purpose")

    def note(notices: Notices) -> list[Notice]:
        reported.extend(found := take(notices))
        return found

    monkeypatch.setattr(Notices, "take", note)
    failing = {
        "before": (finishes, "plan_cut"),
        "within": (finishes, "_cut_wires"),
        "after": (ObjectSession, "take_over"),
    }
    monkeypatch.setattr(*failing[where], fail)
    before = snapshot(cutting.obj, with_seams=False)
    session, ui = cutting.start(), cutting.ui
    ui.click(cutting.at(0), ctrl=True)
    ui.click(cutting.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    (error,) = [notice for notice in reported if notice.level == "ERROR"]
    assert "on purpose" in error.text
    assert cutting.left_clean()
    assert error.text.startswith("Wires are kept")
    assert seams(cutting.obj), "the wire, along edges"
    assert agree(cutting.obj)
    assert snapshot(cutting.obj, with_seams=False) == before
    ui.key("ESC")  # closes the report, which has opened below the mouse
    ui.wait(redraw=True)
    ui.key("Z", ctrl=True)
    obj = bpy.data.objects[cutting.name]
    obj.update_from_editmode()
    assert seams(obj) == []
    assert len(obj.data.vertices) == 81 and len(obj.data.edges) == 144


def test_a_click_is_where_one_clicks(cutting: Desk) -> None:
    session, ui = cutting.start(), cutting.ui
    corners = ((-0.63, -0.56, 0.0), (0.69, -0.6, 0.0), (0.08, 0.7, 0.0))
    ui.click(ui.on_screen(corners[0]), ctrl=True)
    for number, corner in enumerate(corners[1:], start=1):
        ui.click(ui.on_screen(corner))
        ui.wait_until(lambda number=number: len(session.wires) == number)
    for wire, corner in zip(session.wires, corners[1:], strict=True):
        assert wire.points[-1] == pytest.approx(corner, abs=0.01), "a pixel or so"
    near = ui.on_screen(corners[0])
    ui.move((near[0] + 4.0, near[1]))
    ui.wait_until(lambda: session.target is not None and session.target.to == "SEED")
    ui.click((near[0] + 4.0, near[1]))  # closes the chain, which ends it
    ui.wait_until(lambda: seams(cutting.obj) != [])
    assert cutting.left_clean()
    assert agree(cutting.obj)
    cutting.obj.update_from_editmode()
    vertices = np.array([v.co for v in cutting.obj.data.vertices])
    for corner in corners:
        assert np.linalg.norm(vertices - corner, axis=1).min() < 0.01
    count = np.bincount(np.array(seams(cutting.obj)).ravel())
    assert set(count[count > 0]) == {2}, "closed"


def soften(cutting: Desk) -> None:
    """Take away what vertices do not slide off: creases, sharp edges, borders between materials."""
    with changing(cutting.obj) as bm:
        for face in bm.faces:
            face.material_index = 0
        crease = (
            bm.edges.layers.crease.active
            if hasattr(bm.edges.layers, "crease")
            else bm.edges.layers.float["crease_edge"]
        )
        for edge in bm.edges:
            edge.smooth, edge[crease] = True, 0.0
    bpy.ops.ed.undo_push(message="Soft")


@pytest.mark.smoke
def test_a_chain_is_slid_when_it_ends_in_one_step_of_undo(cutting: Desk) -> None:
    soften(cutting)
    settings().finish = "SLIDE"
    session, ui = cutting.start(), cutting.ui
    places = np.array([v.co for v in cutting.obj.data.vertices])
    ui.click(cutting.at(20), ctrl=True)
    ui.click(cutting.at(33))  # one row up on the way to the sixth column
    ui.wait_until(lambda: len(session.wires) == 1)
    snapped = session.wires[0].vertices
    ui.key("RET")
    assert cutting.left_clean()
    assert agree(cutting.obj)
    assert set(seams(cutting.obj)) == set(chain(*snapped))
    wire = places[[20, 33]]
    steps = np.linalg.norm(np.diff(places[list(snapped)], axis=0), axis=1).sum()
    assert length(cutting) < 0.5 * (steps + np.linalg.norm(wire[1] - wire[0]))
    (kept,) = session_on(cutting.obj).session.wires
    assert kept.finish == "SLIDE"
    assert kept.along == "SURFACE"
    ui.key("Z", ctrl=True)
    obj = bpy.data.objects[cutting.name]
    obj.update_from_editmode()
    assert np.array_equal([v.co for v in obj.data.vertices], places)
    assert seams(obj) == []


def test_each_wire_is_finished_as_was_said_when_it_was_kept(cutting: Desk) -> None:
    soften(cutting)
    session, ui = cutting.start(), cutting.ui
    count = len(cutting.obj.data.vertices)
    settings().finish = "SNAP"
    ui.click(cutting.at(0), ctrl=True)
    ui.click(cutting.at(20))
    ui.wait_until(lambda: len(session.wires) == 1)
    settings().finish = "CUT"
    ui.click(cutting.at(53))
    ui.wait_until(lambda: len(session.wires) == 2)
    settings().finish = "SLIDE"
    ui.click(cutting.at(78))
    ui.wait_until(lambda: len(session.wires) == 3)
    before = np.array([v.co for v in cutting.obj.data.vertices])
    ui.key("RET")
    assert cutting.left_clean()
    assert agree(cutting.obj)
    assert sorted((wire.along, wire.finish) for wire in session_on(cutting.obj).session.wires) == [
        ("EDGES", "CUT"),
        ("SURFACE", "SLIDE"),
        ("SURFACE", "SNAP"),
    ]
    cutting.obj.update_from_editmode()
    after = np.array([v.co for v in cutting.obj.data.vertices])
    assert len(after) > count, "one was cut"
    assert np.abs(after[:count] - before).max() > 1e-3, "one was slid"


def drawn_cut(cutting: Desk, start: int, end: int) -> None:
    """Draw a wire with the tool and let it be cut."""
    cutting.choose()
    session = draw(cutting, start, end)
    assert not cutting.running, session.reason
    assert agree(cutting.obj)


def test_a_drag_of_a_cut_wire_that_is_given_up_changes_nothing(cutting: Desk) -> None:
    drawn_cut(cutting, 0, 44)
    before, ui = snapshot(cutting.obj), cutting.ui
    ui.move(cutting.at(44))
    ui.event("LEFTMOUSE", "PRESS", cutting.at(44))
    ui.move(cutting.at(61))
    ui.wait_until(lambda: any(wire.along == "SURFACE" for wire in cutting.session.holds(Dragging).moved))
    ui.key("ESC")
    ui.event("LEFTMOUSE", "RELEASE", cutting.at(61))
    assert cutting.left_clean()
    assert snapshot(cutting.obj) == before
    assert agree(cutting.obj)
