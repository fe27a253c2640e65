# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawing in the real window: what is marked, what is seen, and that nothing is left behind."""

import math

import bmesh
import bpy
import pytest
import ui as driver
from desk import GREEN, ORANGE, RED, WHITE, Desk, near, shows
from mathutils import Euler
from scene import ADDON, add_grid, chain, seams, snapshot
from seamwire.core.session import Session
from seamwire.mesh import edit_mesh
from seamwire.mesh import object_session as board


def with_a_wire(desk: Desk) -> Session:
    """Start the tool and keep a wire along the middle row."""
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    return session


def test_wires_are_drawn_kept_and_marked(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    assert session.seed == 36
    ui.move(desk.at(40))
    ui.wait_until(lambda: session.active is not None)
    assert session.active.vertices == (36, 37, 38, 39, 40)
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), ORANGE)
    assert shows(pixels, desk.at(36), WHITE)
    assert not shows(pixels, desk.at(41, 42), ORANGE)
    ui.click(desk.at(40))
    ui.move(desk.at(44))
    ui.wait_until(lambda: session.active is not None)
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), RED), "kept"
    assert shows(pixels, desk.at(41, 42), ORANGE), "live"
    ui.click(desk.at(44))
    ui.click(desk.at(20), button="RIGHTMOUSE")
    assert session.seed is None
    ui.click(desk.at(0), ctrl=True)
    ui.click(desk.at(2))
    ui.wait_until(lambda: len(session.wires) == 3)
    assert desk.unchanged(), "nothing is written before the end"
    ui.key("RET")
    assert desk.left_clean()
    assert seams(desk.obj) == sorted(chain(*range(36, 45)) + chain(0, 1, 2))
    after = snapshot(desk.obj, with_seams=False)
    assert after == {key: value for key, value in desk.before.items() if key != "seams"}
    ui.move(desk.at(20))
    assert not shows(ui.pixels(), desk.at(36), WHITE), "the overlay is gone"


def test_the_result_is_one_step_of_undo(desk: Desk) -> None:
    bpy.ops.ed.undo_push(message="Before")  # calls from Python leave no steps of their own
    session, ui = desk.start(), desk.ui
    name = desk.obj.name
    ui.click(desk.at(0), ctrl=True)
    ui.click(desk.at(4))
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("RET")
    assert len(seams(desk.obj)) == 8
    ui.key("Z", ctrl=True)
    obj = bpy.data.objects[name]
    assert obj.mode == "EDIT"
    assert seams(obj) == []
    ui.key("Z", ctrl=True, shift=True)
    assert len(seams(bpy.data.objects[name])) == 8


def test_edges_are_lit_before_the_click_and_picked(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    middle = desk.at(36, 37)
    assert not shows(ui.pixels(), middle, WHITE)
    ui.move(middle)
    assert set(session.target.pick) == {36, 37}
    assert shows(ui.pixels(), middle, WHITE)
    ui.click(middle, ctrl=True)
    ui.click(desk.at(42, 43))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.edges_to_mark() == chain(*range(36, 44))


def test_escape_leaves_the_mesh_as_it_was(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    assert not desk.left_clean()
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(desk.at(60))
    ui.key("ESC")
    assert desk.running
    assert session.seed is None, "the live wire went first"
    assert len(session.wires) == 1
    ui.key("ESC")
    assert desk.running, "the kept wire would be lost: asked once more"
    ui.move(desk.at(61))
    ui.key("ESC")
    assert desk.left_clean()
    assert desk.unchanged()


def test_enter_without_a_wire_leaves_the_mesh_as_it_was(desk: Desk) -> None:
    desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    desk.ui.key("RET")
    assert desk.left_clean()
    assert desk.unchanged()


def test_the_wheel_toggles_over_the_mesh_and_zooms_beside_it(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20), ctrl=True)
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.other is not None)
    active, other = session.active.vertices, session.other.vertices
    distance = ui.view.view_distance
    ui.wheel(up=True)
    assert session.active.vertices == other
    assert ui.view.view_distance == distance
    inside = cone.at(*other[1:3])
    assert shows(ui.pixels(), inside, ORANGE)
    ui.wheel(up=False)
    assert session.active.vertices == active
    beside = (ui.region.width - 40.0, 40.0)
    ui.move(beside)
    assert session.target is None
    ui.wheel(up=True, at=beside)
    assert ui.view.view_distance < distance, "zoomed"
    ui.wheel(up=False, at=beside)
    ui.move(cone.at(61))
    ui.wheel(up=True)
    ui.click(cone.at(61))
    assert session.wires[0].vertices == other


def test_undo_and_redo_stay_inside_the_tool(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(40))
    ui.click(desk.at(76))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("Z", ctrl=True)
    assert [wire.end for wire in session.wires] == [40]
    ui.key("Z", ctrl=True, shift=True)
    assert [wire.end for wire in session.wires] == [40, 76]
    for _ in range(5):
        ui.key("Z", ctrl=True)
    assert session.wires == ()
    assert desk.running
    assert bpy.context.mode == "EDIT_MESH"
    assert desk.unchanged()


def test_blenders_undo_is_kept_away_in_other_editors_too(desk: Desk) -> None:
    desk.start()
    ui = desk.ui
    other = next(area for area in ui.window.screen.areas if area.type == "PROPERTIES")
    inside = (other.x + other.width // 2 - ui.region.x, other.y + other.height // 2 - ui.region.y)
    ui.move(inside)
    ui.key("Z", ctrl=True)
    assert desk.running
    assert bpy.context.mode == "EDIT_MESH"
    ui.key("ESC")
    assert desk.running, "keys over other editors are not the tool's"


def test_alt_shows_the_loop_and_an_alt_click_takes_it(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    edge = cone.at(40, 49)
    ui.wait_until(lambda: not session.computing)
    ui.move(edge)
    assert session.loop_preview is None
    ui.move(edge, alt=True)
    preview = session.loop_preview
    assert preview is not None
    assert (40, 49) in preview.edges()
    assert shows(ui.pixels(), cone.at(*preview.vertices[1:3]), GREEN)
    ui.click(edge, alt=True)
    assert session.edges_to_mark() == sorted(preview.edges())
    ui.move(edge)
    assert session.loop_preview is None
    assert session.seed is None


def test_a_double_click_on_an_edge_takes_its_loop(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    bpy.context.preferences.inputs.mouse_double_click_time = 1000  # redraws may be slow here
    edge = cone.at(40, 49)
    ui.wait_until(lambda: not session.computing)
    ui.move(edge)
    for _ in range(2):
        ui.event("LEFTMOUSE", "PRESS", ticks=1)
        ui.event("LEFTMOUSE", "RELEASE", ticks=1)
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.wires[0].closed
    assert (40, 49) in session.edges_to_mark()
    assert session.seed is None, "the first of the two clicks left nothing"
    ui.key("Z", ctrl=True)
    assert session.wires == ()


def test_e_switches_to_the_surface_and_back(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20), ctrl=True)
    ui.click(cone.at(24))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(cone.at(60))
    ui.key("E")
    assert session.along == "SURFACE"
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.active is not None)
    assert session.active.along == "SURFACE"
    assert session.active.vertices[0] == 24
    assert session.active.vertices[-1] == 61
    ui.move(cone.at(60))
    ui.wait_until(lambda: session.active is not None)
    ui.click(cone.at(60))
    ui.key("E")
    ui.move(cone.at(76))
    ui.wait_until(lambda: session.active is not None)
    assert session.active.along == "EDGES"
    assert session.active.vertices[0] == 60
    marked = session.edges_to_mark()
    assert {v for edge in marked for v in edge} >= {20, 24, 60}
    ui.key("RET")
    assert seams(cone.obj) == marked


def test_the_view_can_be_moved_while_drawing(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    before = ui.view.view_rotation.copy()
    centre = desk.at(40)
    ui.move(centre)
    ui.event("MIDDLEMOUSE", "PRESS", centre)
    for step in range(1, 4):
        ui.move((centre[0] + 12.0 * step, centre[1] + 8.0 * step))
    ui.event("MIDDLEMOUSE", "RELEASE")
    assert ui.view.view_rotation.rotation_difference(before).angle > 0.02
    assert desk.running
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.edges_to_mark() == chain(*range(36, 45)), "picked where it is seen now"
    ui.key("NUMPAD_7")
    assert desk.running


def test_keys_of_edit_mode_do_nothing_while_drawing(desk: Desk) -> None:
    desk.start()
    ui = desk.ui
    ui.move(desk.at(40))
    for key in ("A", "D", "I", "K", "L", "P", "O", "Q", "U", "Y", "TAB"):
        ui.key(key)
    ui.key("A", alt=True)
    ui.wheel(up=True, alt=True)
    assert desk.running
    assert desk.unchanged()


def test_wires_on_the_far_side_are_faint(desk: Desk) -> None:
    with_a_wire(desk)
    ui = desk.ui
    at = desk.at(37, 38)
    assert shows(ui.pixels(), at, RED)
    # A second sheet above the first, as seen from the eye, is in Blender's way and not in the drawing's.
    mesh = bpy.data.meshes.new("Cover")
    mesh.from_pydata([(-3, -3, 1), (3, -3, 1), (3, 3, 1), (-3, 3, 1)], [], [(0, 1, 2, 3)])
    cover = bpy.data.objects.new("Cover", mesh)
    bpy.context.collection.objects.link(cover)
    ui.wait(redraw=True)
    pixels = ui.pixels()
    assert not shows(pixels, at, RED)
    surroundings = near(pixels, (at[0], at[1] + 25.0)).mean(axis=0)
    faint = near(pixels, at, radius=1)
    assert (faint[:, 0] - faint[:, 1]).max() > (surroundings[0] - surroundings[1]) + 0.05, "reddish still"


def test_on_a_turned_and_unevenly_scaled_object_wires_lie_on_the_mesh(ui: driver.Ui) -> None:
    obj = add_grid(9)
    obj.scale = (0.5, 1.4, 2.0)
    obj.rotation_euler = Euler((0.3, -0.4, 0.6))
    obj.location = (0.2, 0.1, -3.0)
    bpy.context.view_layer.update()
    desk = Desk(ui, obj)
    session = desk.start()
    ui.view.view_location = obj.location
    ui.wait(redraw=True)
    ui.click(desk.at(36), ctrl=True)
    ui.move(desk.at(44))
    ui.wait_until(lambda: session.active is not None)
    assert session.active.vertices == tuple(range(36, 45))
    pixels = ui.pixels()
    for first in range(37, 43):
        assert shows(pixels, desk.at(first, first + 1), ORANGE)
    ui.key("ESC")
    assert desk.unchanged()


def test_leaving_edit_mode_ends_the_tool(desk: Desk) -> None:
    desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    desk.ui.move((300.0, 300.0))
    assert desk.left_clean()
    assert seams(desk.obj) == []


def test_changing_the_mesh_ends_the_tool(desk: Desk) -> None:
    with_a_wire(desk)
    ui = desk.ui
    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    bmesh.ops.delete(bm, geom=[bm.verts[80]], context="VERTS")
    bmesh.update_edit_mesh(desk.obj.data)
    ui.move((300.0, 300.0))
    assert desk.left_clean()
    assert seams(desk.obj) == []


def change_of(what: str, bm: bmesh.types.BMesh) -> None:
    if what == "a place":
        bm.verts[80].co.z += 0.1
    elif what == "an edge":
        bmesh.ops.rotate_edges(bm, edges=[bm.edges.get((bm.verts[40], bm.verts[41]))])
    elif what == "the order":
        for vertex in bm.verts:
            vertex.index = 80 - vertex.index
        bm.verts.sort()
    else:
        bm.faces.ensure_lookup_table()
        bm.faces[0].hide_set(True)


@pytest.mark.parametrize("what", ["a place", "an edge", "the order", "what is hidden"])
def test_changing_the_mesh_ends_the_tool_also_where_all_counts_stay(desk: Desk, what: str) -> None:
    with_a_wire(desk)
    ui = desk.ui
    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    change_of(what, bm)
    bmesh.update_edit_mesh(desk.obj.data)
    ui.wait()
    ui.move((300.0, 300.0))
    assert desk.left_clean()
    assert seams(desk.obj) == []


def test_a_change_that_is_not_found_yet_is_found_before_anything_is_marked(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(edit_mesh, "_PART", 8)
    session, ui = with_a_wire(desk), desk.ui
    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    change_of("what is hidden", bm)
    bmesh.update_edit_mesh(desk.obj.data)
    ui.wait()
    ui.move((300.0, 300.0))
    assert desk.running, "some of the mesh was looked at"
    ui.key("RET")
    assert desk.left_clean()
    assert seams(desk.obj) == []
    session = desk.start()
    ui.move(desk.at(40))
    ui.key("R")
    assert len(session.wires) == 1, "nothing is lost"


def test_while_nothing_else_changes_the_mesh_it_is_not_looked_through(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    session, ui = desk.start(), desk.ui
    looked = []
    monkeypatch.setattr(edit_mesh.Cage, "differences", lambda *_: iter([looked.append(1)]))
    for at in (36, 44, 53):
        ui.click(desk.at(at))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("Z", ctrl=True)
    ui.wait(2, redraw=True)
    assert not looked


def test_removing_the_object_ends_the_tool(desk: Desk) -> None:
    desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(desk.obj)
    desk.ui.move((300.0, 300.0))
    assert not desk.running


def test_an_error_ends_the_tool_and_leaves_the_mesh(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = with_a_wire(desk), desk.ui

    def fail(*_: object, **__: object) -> None:
        raise RuntimeError("as the test wants it")

    monkeypatch.setattr(session, "hover", fail)
    ui.move(desk.at(50))
    assert desk.left_clean()
    assert desk.unchanged()
    monkeypatch.undo()
    session = desk.start()
    assert desk.running, "the tool can be started again"
    ui.move(desk.at(40))
    ui.key("R")
    assert len(session.wires) == 1, "and what was drawn is not lost"


def test_an_error_while_drawing_the_overlay_ends_the_tool(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = desk.start(), desk.ui

    def fail() -> None:
        raise RuntimeError("as the test wants it")

    monkeypatch.setattr(session, "seeds", fail)
    ui.move(desk.at(36))
    ui.wait(redraw=True)
    ui.move(desk.at(40))
    assert desk.left_clean()
    assert desk.unchanged()


def test_disabling_the_addon_ends_the_tool(desk: Desk) -> None:
    import addon_utils

    desk.start()
    desk.ui.click(desk.at(36), ctrl=True)
    try:
        addon_utils.disable(ADDON)
        assert not desk.running
        desk.ui.move(desk.at(40))
        assert desk.unchanged()
    finally:
        addon_utils.enable(ADDON)


def test_the_tool_runs_once_at_a_time_and_only_in_edit_mode(desk: Desk) -> None:
    desk.start()
    with desk.ui.override():
        assert not bpy.ops.mesh.seamwire_draw.poll()
    desk.ui.move(desk.at(40))
    desk.ui.key("ESC")
    with desk.ui.override():
        assert bpy.ops.mesh.seamwire_draw.poll()


def test_wires_that_are_being_computed_come_when_they_are_ready(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    ready = [False]

    class Slow:
        """A live wire that is ready when the test says so."""

        def __init__(self, live: object) -> None:
            self.live = live

        def __getattr__(self, name: str) -> object:
            return getattr(self.live, name)

        def progress(self) -> float:
            return self.live.progress() if ready[0] else 0.25

        def wires(self, target: object) -> object:
            if ready[0]:
                self.live.wait()
                return self.live.wires(target)
            nothing = type("Nothing", (), {"points": [], "vertices": [], "length": math.inf, "final": False})()
            return type("Wires", (), {"wires": (nothing, nothing), "shorter": 0, "final": False})()

    make = board.maker_on
    monkeypatch.setattr(board, "maker_on", lambda surface: lambda along: Slow(make(surface)(along)))
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(44))
    assert session.computing
    assert session.waiting_clicks == 1
    assert session.wires == ()
    ready[0] = True
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.edges_to_mark() == chain(*range(36, 45))
    ui.wait_until(lambda: not session.computing)
