# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be done with a network: within a chain by every key, and between chains, where kept wires are seams."""

from itertools import pairwise

import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, choose, drag, draw, said, second_window, undo_steps
from scene import chain, seams, snapshot
from seamwire.core.sketch.picture import Role
from seamwire.mesh.settings import preferences, settings
from seamwire.operators import steps
from seamwire.tool import keymaps
from seamwire.view.edited_objects import edited
from seamwire.words.hints import lines as corner_lines


def nothing_else_changed(desk: Desk) -> None:
    """Nothing but seams may have changed."""
    after = snapshot(desk.obj, with_seams=False)
    assert after == {key: value for key, value in desk.before.items() if key != "seams"}


# Within a chain


@pytest.mark.smoke
@pytest.mark.every_blender
def test_c_and_a_click_on_the_first_seed_close_the_chain_and_end_it(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    for vertex in (10, 16, 70):
        ui.click(desk.at(vertex))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("C")
    ui.wait_until(lambda: not desk.running)
    once = seams(desk.obj)
    assert len(session.wires) == 3
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == [], "one step"
    desk.start()
    for vertex in (10, 16, 70):
        ui.click(desk.at(vertex))
    ui.wait_until(lambda: len(desk.session.wires) == 2)
    ui.click(desk.at(10))
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == once


@pytest.mark.smoke
@pytest.mark.every_blender
def test_f_shows_the_wire_to_the_end_and_keeps_it(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.move(desk.at(38))
    ui.wait_until(lambda: session.picture.active is not None)
    ui.key("F")
    ui.wait_until(lambda: session.picture.one(Role.EXTENSION) is not None)
    assert session.picture.one(Role.EXTENSION).vertices[-1] == 44
    assert session.wires == ()
    ui.key("F")
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == chain(*range(36, 45))


@pytest.mark.smoke
@pytest.mark.every_blender
def test_clearing_takes_seams_away_and_breaks_the_wires_there(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    assert seams(desk.obj) == chain(*range(36, 45))
    settings().clear = True
    session = draw(desk, 38, 42, at_vertices=False)
    assert seams(desk.obj) == sorted(chain(36, 37, 38) + chain(42, 43, 44))
    assert [wire.edges() for wire in session.wires] == [chain(36, 37, 38), chain(42, 43, 44)], "what is left of it"
    desk.start()
    desk.ui.key("S")
    assert not settings().clear, "S turns it round within a chain"


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("end", ["RET", "ESC", "new chain", "mode"])
def test_s_and_e_end_with_the_chain_and_the_view_shows_them(desk: Desk, end: str) -> None:
    desk.choose()
    ui = desk.ui
    ui.click(desk.at(36), ctrl=True)
    ui.key("E")
    ui.key("S")
    assert settings().clear
    with second_window(ui):
        shown = [corner_lines(view.session.picture) for view in edited.views() if view.session.picture.front]
        assert len(shown) == 1, "all windows draw the same object"
        assert shown[0][-1] == "Clearing seams"
        assert shown[0][-2].startswith("Across the surface")
    assert "Clear" in said() or "Mark" in said()
    if end == "new chain":
        ui.click(desk.at(20), ctrl=True)
        assert desk.running
    elif end == "mode":
        with ui.override():
            bpy.ops.object.mode_set(mode="OBJECT")
        ui.wait_until(lambda: not desk.running)
    else:
        ui.key(end)
        ui.wait_until(lambda: not desk.running)
    assert not settings().clear
    assert settings().along == "AUTO"


def test_a_setting_that_the_header_changes_meanwhile_stays(desk: Desk) -> None:
    desk.start()
    desk.ui.move(desk.at(40))
    desk.ui.key("E")
    settings().along = "EDGES"
    desk.ui.key("ESC")
    desk.ui.wait_until(lambda: not desk.running)
    assert settings().along == "EDGES"
    settings().along = "AUTO"


@pytest.mark.smoke
@pytest.mark.every_blender
def test_w_takes_the_next_candidate_and_the_wheel_zooms(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20))
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.picture.others)
    active, other = session.picture.active.vertices, session.picture.others[0].vertices
    ui.key("W")
    assert session.picture.active.vertices == other
    ui.wheel(up=True, alt=True)
    assert session.picture.active.vertices == active
    distance = ui.view.view_distance
    ui.wheel(up=True)
    assert ui.view.view_distance < distance
    assert session.picture.active.vertices == active
    ui.wheel(up=False)
    ui.move(cone.at(61))
    ui.key("W")
    ui.click(cone.at(61))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert session.wires[0].vertices == other


def test_the_wheel_takes_the_next_candidate_where_it_is_given_to_it(cone: Desk) -> None:
    preferences().wheel_switches = True
    try:
        session, ui = cone.start(), cone.ui
        distance = ui.view.view_distance
        ui.wheel(up=True, at=cone.at(20))
        assert ui.view.view_distance < distance, "no wire is live"
        ui.click(cone.at(20))
        ui.move(cone.at(61))
        ui.wait_until(lambda: session.picture.others)
        other, distance = session.picture.others[0].vertices, ui.view.view_distance
        ui.wheel(up=True)
        assert session.picture.active.vertices == other
        assert ui.view.view_distance == distance
        ui.wheel(up=False, ctrl=True)
        assert ui.view.view_distance > distance
        ui.wheel(up=True, ctrl=True)
        assert ui.view.view_distance == pytest.approx(distance)
    finally:
        preferences().property_unset("wheel_switches")


@pytest.mark.smoke
@pytest.mark.every_blender
def test_shift_and_the_wheel_change_the_strength_and_say_it(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.move(cone.at(40))
    ui.wheel(up=True, shift=True)
    assert session.picture.strength == 12.5
    assert settings().strength_edges == 12.5
    assert "Strength 12.5" in said()
    ui.wheel(up=False, shift=True)
    assert session.picture.strength == 10.0
    settings().strength_edges = 40.0
    ui.move(cone.at(41))
    assert session.picture.strength == 40.0, "the header's setting reaches the chain"


@pytest.mark.smoke
@pytest.mark.every_blender
def test_v_and_e_switch_settings_that_the_header_shows(desk: Desk) -> None:
    desk.start()
    desk.ui.move(desk.at(40))
    desk.ui.key("V")
    assert settings().xray
    desk.ui.key("V")
    assert not settings().xray
    desk.ui.key("TAB", shift=True)
    assert settings().snap
    desk.ui.key("E")
    assert settings().along == "SURFACE"
    settings().along = "EDGES"
    desk.ui.move(desk.at(41))
    assert desk.session.options.along == "EDGES"
    assert desk.unchanged()


def test_keys_can_be_bound_anew(ui: driver.Ui, desk: Desk) -> None:
    def bind(key: str) -> None:
        # Blender may make the items anew whenever one has changed: none is kept.
        keys = keymaps.user_keymap(bpy.context.window_manager)
        next(item for item in keys.keymap_items if item.properties.action == "CLOSE").type = key

    bind("J")
    try:
        session = desk.start()
        for vertex in (10, 16, 70):
            ui.click(desk.at(vertex))
        ui.wait_until(lambda: len(session.wires) == 2)
        shown = desk.chain.hints()
        assert ("EVENT_J", "Close") in shown
        assert not any(icon == "EVENT_C" for icon, _ in shown)
        assert ("J", "Close Chain") in desk.chain.keys.groups()["Change the Wire"], "in the table of keys too"
        ui.key("J")
        ui.wait_until(lambda: not desk.running)
    finally:
        bind("C")
    assert len(session.wires) == 3


# Between chains


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_dragged_seed_takes_its_wires_along_in_one_step(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    session = desk.choose()
    draw(desk, 36, 40, 44)
    drag(desk, desk.at(40), desk.at(49))
    desk.ui.wait_until(lambda: not desk.running)
    assert 49 in session.seeds()
    assert 40 not in session.seeds()
    marked = seams(desk.obj)
    assert {v for edge in marked for v in edge} >= {36, 49, 44}
    assert undo_steps(capfd)[-1] == "Edit Seamwires"
    desk.ui.key("Z", ctrl=True)
    assert seams(desk.obj) == chain(*range(36, 45)), "one step"
    assert 40 in desk.session.seeds(), "the network follows Blender's undo"
    desk.ui.key("Z", ctrl=True, shift=True)
    assert seams(desk.obj) == marked
    assert 49 in desk.session.seeds()
    nothing_else_changed(desk)


@pytest.mark.smoke
def test_a_dragged_wire_gets_a_seed(desk: Desk) -> None:
    session = desk.choose()
    draw(desk, 36, 44)
    drag(desk, desk.at(40), desk.at(58))
    desk.ui.wait_until(lambda: not desk.running)
    assert 58 in session.seeds()
    assert len(session.wires) == 2
    desk.ui.key("Z", ctrl=True)
    assert len(desk.session.wires) == 1
    assert seams(desk.obj) == chain(*range(36, 45))


@pytest.mark.smoke
def test_clicks_begin_at_seeds_and_end_on_wires(desk: Desk) -> None:
    session, ui = desk.choose(), desk.ui
    draw(desk, 36, 44)
    ui.click(desk.at(36))
    assert session.seed is not None, "a click on a seed goes on from there"
    ui.click(desk.at(0))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.click(desk.at(0), button="RIGHTMOUSE")
    ui.click(desk.at(76))
    ui.move(desk.at(40))
    ui.wait_until(lambda: session.picture.active is not None)
    assert session.target.to == "WIRE"
    ui.click(desk.at(40))
    ui.wait_until(lambda: not desk.running)
    assert 40 in session.seeds(), "joined"
    assert set(chain(*range(36, 45)) + chain(*range(40, 77, 9))) <= set(seams(desk.obj))
    nothing_else_changed(desk)


@pytest.mark.parametrize("key", [pytest.param("X", marks=[pytest.mark.smoke, pytest.mark.every_blender]), "DEL"])
def test_x_and_delete_remove_the_wire_under_the_cursor(desk: Desk, key: str, capfd: pytest.CaptureFixture[str]) -> None:
    session, ui = desk.choose(), desk.ui
    draw(desk, 36, 44)
    draw(desk, 0, 8)
    ui.move(desk.at(40))
    assert session.picture.one(Role.HOVERED) is not None
    ui.key(key)
    assert seams(desk.obj) == chain(*range(9))
    assert undo_steps(capfd)[-1] == "Edit Seamwires"
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == sorted(chain(*range(9)) + chain(*range(36, 45)))
    nothing_else_changed(desk)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_kept_wire_takes_its_other_path(cone: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    session, ui = cone.choose(), cone.ui
    ui.click(cone.at(20))
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.picture.others)
    other = session.picture.others[0].vertices
    ui.click(cone.at(61))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    inside = session.wires[0].vertices[1]
    ui.move(cone.at(inside))
    assert session.picture.one(Role.HOVERED) is not None
    ui.key("W")
    ui.wait_until(lambda: not cone.running)
    assert session.wires[0].vertices == other
    assert seams(cone.obj) == sorted((min(a, b), max(a, b)) for a, b in pairwise(other))
    assert undo_steps(capfd)[-1] == "Edit Seamwires"


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_meshs_own_mirror_counts_and_m_sets_it(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    assert session.options.mirror == ()
    ui.move(desk.at(40))
    ui.key("M")
    assert session.options.mirror == (0,)
    assert desk.obj.data.use_mirror_x, "the option that Blender's tools heed"
    ui.key("M")
    assert session.options.mirror == (1,)
    ui.key("M")
    assert session.options.mirror == (0, 1)
    ui.key("M")
    assert session.options.mirror == ()
    ui.key("ESC")
    desk.obj.data.use_mirror_x = True
    choose(ui)
    draw(desk, 9, 11)
    assert seams(desk.obj) == sorted(chain(9, 10, 11) + chain(15, 16, 17))
    desk.obj.data.use_mirror_x = False
    drag(desk, desk.at(11), desk.at(20))
    ui.wait_until(lambda: not desk.running)
    ends = {v for edge in seams(desk.obj) for v in edge}
    assert {9, 20, 24, 17} <= ends, "what was mirrored stays so"
    ui.move(desk.at(10))
    ui.key("X")
    assert seams(desk.obj) == []


@pytest.mark.smoke
def test_gaps_in_seams_are_shown_until_they_are_closed(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    draw(desk, 4, 22)
    desk.ui.wait_until(lambda: edited.front.islands.newest.gaps == ())
    assert edited.front.islands.newest.count == 2, "as far from the row as the cut is long: a dart"
    draw(desk, 22, 31)
    desk.ui.move(desk.at(60))
    view = edited.front
    desk.ui.wait_until(lambda: view.islands.newest.gaps != ())
    (gap,) = view.islands.newest.gaps
    assert gap.path == (31, 40)
    before = desk.ui.pixels()
    with desk.ui.override():
        assert bpy.ops.mesh.seamwire_close_gaps() == {"FINISHED"}
    desk.ui.move(desk.at(61))
    desk.ui.wait_until(lambda: edited.front.islands.newest.count == 3)
    assert edited.front.islands.newest.gaps == ()
    assert np.abs(desk.ui.pixels() - before).max() > 0.2


def asked_to_delete(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return what grows when Blender opens its menu of what to delete."""
    asked: list[int] = []
    monkeypatch.setattr(
        bpy.types.VIEW3D_MT_edit_mesh_delete,
        "draw",
        lambda self, _context: (asked.append(1), self.layout.label(text="Delete"))[0],
    )
    return asked


@pytest.mark.every_blender
def test_w_and_x_act_on_a_wire_that_w_moved_away_until_the_mouse_moves(
    cone: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = asked_to_delete(monkeypatch)
    cone.choose()
    session, ui = draw(cone, 20, 61), cone.ui
    ways = [session.wires[0].vertices]
    middle = ways[0][len(ways[0]) // 2]
    ui.move(cone.at(middle))
    for _ in range(3):
        ui.key("W")
        ui.wait_until(lambda: not cone.running)
        ways.append(session.wires[0].vertices)
        assert session.picture.one(Role.HOVERED).vertices == ways[-1], "it is highlighted"
    assert middle not in ways[1], "the wire is elsewhere"
    assert ways[2] == ways[0], "the second W acts on the same wire"
    assert ways[3] == ways[1]
    ui.key("X")
    ui.wait_until(lambda: not cone.running)
    assert session.wires == ()
    assert seams(cone.obj) == []
    ui.wait(10, redraw=True)
    assert asked == []


@pytest.mark.parametrize("in_a_chain", [False, True])
def test_w_and_x_act_on_the_wire_that_w_moved_although_another_lies_below(cone: Desk, in_a_chain: bool) -> None:
    cone.choose()
    draw(cone, 20, 61)
    session, ui = draw(cone, 10, 16, at_vertices=False), cone.ui
    upper, lower = session.wires
    assert {13, 22} <= {*upper.vertices, *lower.vertices}
    ui.look_from_top(distance=25.0)  # six pixels from one row of vertices to the next
    place = cone.at(22)
    ui.move(place)
    assert session.picture.one(Role.HOVERED).id == upper.id
    if in_a_chain:
        cone.start()

    def press(key: str) -> None:
        ui.key(key)
        ui.wait_until(lambda: in_a_chain or not cone.running)
        ui.move((place[0] + 1.0, place[1]))  # a hand that rests

    for _ in range(3):
        before = session.drawn.find(upper).vertices
        press("W")
        ui.wait_until(lambda before=before: session.drawn.find(upper).vertices != before)
        assert session.picture.one(Role.HOVERED).id == upper.id, "it is highlighted"
        assert session.drawn.find(lower).vertices == lower.vertices
    press("X")
    assert [wire.id for wire in session.wires] == [lower.id]
    assert session.picture.one(Role.HOVERED).id == lower.id, "the next X removes it"
    press("X")
    assert session.wires == ()


def test_where_the_mouse_has_moved_since_x_is_blenders(cone: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = asked_to_delete(monkeypatch)
    cone.choose()
    session, ui = draw(cone, 20, 61), cone.ui
    way = session.wires[0].vertices
    place = cone.at(way[len(way) // 2])
    ui.move(place)
    ui.key("W")
    ui.wait_until(lambda: not cone.running)
    ui.move((place[0] + 60.0, place[1]))
    ui.move(place)
    ui.key("X")
    ui.wait_until(lambda: bool(asked))
    ui.key("ESC")
    assert len(session.wires) == 1


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("name", ["unwrap", "suggest"])
def test_the_buttons_of_the_header_keep_a_live_chain_first(
    desk: Desk, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    ui = desk.ui
    desk.choose()
    ui.click(desk.at(36), ctrl=True)
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(desk.session.wires) == 1)
    ui.move(desk.at(52))
    assert desk.running
    with ui.override():
        operator = getattr(bpy.ops.mesh, f"seamwire_{name}")
        assert operator("INVOKE_DEFAULT") == {"FINISHED" if name == "unwrap" else "RUNNING_MODAL"}
    assert not desk.running
    assert seams(desk.obj) == chain(*range(36, 45))
    ui.wait(5)
    ui.key("ESC")
    ui.wait_until(lambda: not steps.running)
    assert seams(desk.obj) == chain(*range(36, 45))
    assert "Draw Seamwires" in undo_steps(capfd)
