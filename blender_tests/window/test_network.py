# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be done with a network before it is final: every key and every drag, and what is marked in the end."""

from itertools import pairwise

import bpy
import ui as driver
from desk import Desk
from scene import chain, seams, snapshot
from seamwire.core.session import Session


def draw(desk: Desk, *vertices: int) -> Session:
    """Draw a chain with clicks, and end it."""
    session, before = desk.session, len(desk.session.wires)
    desk.ui.click(desk.at(vertices[0]), ctrl=True)
    for vertex in vertices[1:]:
        desk.ui.click(desk.at(vertex))
    desk.ui.wait_until(lambda: len(session.wires) >= before + len(vertices) - 1)
    desk.ui.click(desk.at(vertices[-1]), button="RIGHTMOUSE")
    assert session.seed is None
    return session


def finish(desk: Desk) -> list[tuple[int, int]]:
    """Press Enter; nothing but seams may have changed. Return them."""
    desk.ui.key("RET")
    assert desk.left_clean()
    after = snapshot(desk.obj, with_seams=False)
    assert after == {key: value for key, value in desk.before.items() if key != "seams"}
    return seams(desk.obj)


def drag(desk: Desk, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Press, move in steps, release."""
    ui = desk.ui
    ui.move(start)
    ui.event("LEFTMOUSE", "PRESS", start)
    for part in (0.3, 0.7, 1.0):
        ui.move((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))
    desk.ui.event("LEFTMOUSE", "RELEASE", end)


def test_a_plain_click_seeds_and_space_finishes(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    assert session.seed == 36
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.move(desk.at(44))
    ui.key("SPACE")
    assert desk.left_clean()
    assert seams(desk.obj) == chain(36, 37, 38, 39, 40), "the live wire was not kept"


def test_c_and_a_click_on_the_first_seed_close_the_loop(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    for vertex in (10, 16, 70):
        ui.click(desk.at(vertex), ctrl=vertex == 10)
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("C")
    ui.wait_until(lambda: len(session.wires) == 3)
    assert session.seed is None
    once = session.edges_to_mark()
    ui.key("Z", ctrl=True)
    assert len(session.wires) == 2
    ui.click(desk.at(10))
    ui.wait_until(lambda: len(session.wires) == 3)
    assert session.seed is None
    assert session.edges_to_mark() == once
    assert finish(desk) == once


def test_f_shows_the_way_to_the_end_and_keeps_it(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.move(desk.at(38))
    ui.wait_until(lambda: session.active is not None)
    ui.key("F")
    ui.wait_until(lambda: session.end_preview is not None)
    assert session.end_preview.vertices[-1] == 44
    assert session.wires == ()
    ui.key("ESC")
    assert session.end_preview is None, "Esc drops what is shown first"
    assert session.seed == 36
    ui.key("F")
    ui.key("F")
    ui.wait_until(lambda: len(session.wires) == 1)
    assert finish(desk) == chain(*range(36, 45))


def test_x_switches_to_clearing_seams(desk: Desk) -> None:
    session = desk.start()
    draw(desk, 36, 44)
    desk.ui.key("RET")
    assert seams(desk.obj) == chain(*range(36, 45))
    session = desk.start()
    desk.ui.move(desk.at(38))
    desk.ui.key("X")
    assert not session.marking
    draw(desk, 38, 42)
    assert session.edges_to_clear() == chain(38, 39, 40, 41, 42)
    assert seams(desk.obj) == chain(*range(36, 45))
    assert finish(desk) == sorted(chain(36, 37, 38) + chain(42, 43, 44))


def test_a_dragged_seed_takes_its_wires_along(desk: Desk) -> None:
    desk.start()
    session = draw(desk, 36, 40, 44)
    drag(desk, desk.at(40), desk.at(49))
    desk.ui.wait_until(lambda: not session.dragging)
    assert 49 in session.seeds()
    assert 40 not in session.seeds()
    marked = session.edges_to_mark()
    assert {v for edge in marked for v in edge} >= {36, 49, 44}
    desk.ui.key("Z", ctrl=True)
    assert session.edges_to_mark() == chain(*range(36, 45)), "one step"
    desk.ui.key("Z", ctrl=True, shift=True)
    assert finish(desk) == marked


def test_escape_lets_a_dragged_seed_go_back(desk: Desk) -> None:
    desk.start()
    session = draw(desk, 36, 40, 44)
    ui = desk.ui
    ui.move(desk.at(40))
    ui.event("LEFTMOUSE", "PRESS", desk.at(40))
    ui.move(desk.at(49))
    assert session.dragging
    ui.key("ESC")
    assert not session.dragging
    ui.event("LEFTMOUSE", "RELEASE", desk.at(49))
    assert session.edges_to_mark() == chain(*range(36, 45))
    assert desk.running


def test_a_dragged_wire_gets_a_seed(desk: Desk) -> None:
    desk.start()
    session = draw(desk, 36, 44)
    drag(desk, desk.at(40), desk.at(58))
    desk.ui.wait_until(lambda: not session.dragging)
    assert 58 in session.seeds()
    assert len(session.wires) == 2
    desk.ui.key("Z", ctrl=True)
    assert len(session.wires) == 1
    assert finish(desk) == chain(*range(36, 45))


def test_clicks_begin_at_seeds_and_end_on_wires(desk: Desk) -> None:
    desk.start()
    session, ui = draw(desk, 36, 44), desk.ui
    ui.click(desk.at(36))
    assert session.seed is not None, "a click on a seed goes on from there"
    ui.click(desk.at(0))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.click(desk.at(0), button="RIGHTMOUSE")
    ui.click(desk.at(76))
    ui.move(desk.at(40))
    ui.wait_until(lambda: session.active is not None)
    assert session.target.to == "WIRE"
    ui.click(desk.at(40))
    ui.wait_until(lambda: session.seed is None)
    assert 40 in session.seeds(), "joined"
    marked = session.edges_to_mark()
    assert set(chain(*range(36, 45)) + chain(*range(40, 77, 9))) <= set(marked)
    assert finish(desk) == marked


def test_wires_are_dropped(desk: Desk) -> None:
    desk.start()
    session, ui = draw(desk, 36, 44), desk.ui
    draw(desk, 0, 8)
    draw(desk, 72, 80)
    ui.click(desk.at(40), shift=True)
    assert len(session.wires) == 2
    ui.move(desk.at(4))
    ui.key("DEL")
    assert len(session.wires) == 1
    ui.key("BACK_SPACE")
    assert len(session.wires) == 2
    assert finish(desk) == sorted(chain(*range(9)) + chain(*range(72, 81)))


def test_a_kept_wire_is_toggled(cone: Desk) -> None:
    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20), ctrl=True)
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.other is not None)
    other = session.other.vertices
    ui.click(cone.at(61))
    ui.click(cone.at(61), button="RIGHTMOUSE")
    inside = session.wires[0].vertices[1]
    ui.move(cone.at(inside))
    assert session.hovered_wire is not None
    distance = ui.view.view_distance
    ui.wheel(up=True)
    assert ui.view.view_distance < distance, "the wheel zooms where no wire is live"
    ui.wheel(up=False)
    ui.move(cone.at(inside))
    ui.key("W")
    ui.wait_until(lambda: session.wires[0].vertices == other)
    assert finish(cone) == sorted((min(a, b), max(a, b)) for a, b in pairwise(other))


def test_w_toggles_and_the_wheel_does_what_the_preferences_say(cone: Desk) -> None:
    from seamwire.ui import preferences

    session, ui = cone.start(), cone.ui
    ui.click(cone.at(20), ctrl=True)
    ui.move(cone.at(61))
    ui.wait_until(lambda: session.other is not None)
    active, other = session.active.vertices, session.other.vertices
    ui.key("W")
    assert session.active.vertices == other
    ui.key("W")
    distance = ui.view.view_distance
    ui.wheel(up=True, ctrl=True)
    assert ui.view.view_distance < distance, "Ctrl and the wheel zoom"
    assert session.active.vertices == active
    ui.wheel(up=False, ctrl=True)
    preferences.get().always_zoom = True
    try:
        distance = ui.view.view_distance
        ui.wheel(up=True)
        assert ui.view.view_distance < distance
        assert session.active.vertices == active
    finally:
        preferences.get().always_zoom = False


def test_shift_and_the_wheel_change_the_strength_and_say_it(cone: Desk) -> None:
    from seamwire.operators import modal as drawing
    from seamwire.ui import menus as texts

    session, ui = cone.start(), cone.ui
    settings = bpy.context.window_manager.seamwire
    ui.move(cone.at(40))
    ui.wheel(up=True, shift=True)
    assert session.strength == 12.5
    assert settings.strength_edges == 12.5
    assert any("Strength 12.5" in text for _, text in texts.hints(drawing.running[0].status()))
    ui.wheel(up=False, shift=True)
    assert session.strength == 10.0
    settings.strength_edges = 40.0
    assert session.strength == 40.0, "the header's setting reaches the running tool"
    ui.click(cone.at(20))
    ui.click(cone.at(24))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert finish(cone) == chain(20, 21, 22, 23, 24)


def test_the_meshs_mirror_counts_and_m_offers_it(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    assert session.mirror_axes == ()
    ui.move(desk.at(40))
    ui.key("M")
    assert session.mirror_axes == (0,)
    draw(desk, 9, 11)
    assert session.edges_to_mark() == sorted(chain(9, 10, 11) + chain(15, 16, 17))
    ui.key("M")
    assert session.mirror_axes == (1,)
    ui.key("M")
    assert session.mirror_axes == (0, 1)
    ui.key("M")
    assert session.mirror_axes == ()
    assert session.edges_to_mark() == chain(9, 10, 11)
    assert not desk.obj.data.use_mirror_x, "the mesh's own option stays"
    desk.obj.data.use_mirror_x = True
    ui.move(desk.at(41))
    assert session.mirror_axes == (0,)
    assert finish(desk) == sorted(chain(9, 10, 11) + chain(15, 16, 17))


def test_v_and_g_switch_settings_that_the_header_shows(desk: Desk) -> None:
    desk.start()
    settings = bpy.context.window_manager.seamwire
    desk.ui.move(desk.at(40))
    desk.ui.key("V")
    assert settings.xray
    desk.ui.key("V")
    assert not settings.xray
    desk.ui.key("G")
    assert settings.snap
    desk.ui.key("E")
    assert settings.along == "SURFACE"
    settings.along = "EDGES"
    assert desk.session.along == "EDGES"
    assert desk.unchanged()


def test_keys_can_be_bound_anew(ui: driver.Ui, desk: Desk) -> None:
    from seamwire.operators import modal as drawing
    from seamwire.ui import keymap
    from seamwire.ui import menus as texts

    def bind(key: str) -> None:
        # Blender may make the items anew whenever one has changed: none is kept.
        keys = keymap.user_keymap(bpy.context.window_manager)
        next(item for item in keys.keymap_items if item.properties.action == "CLOSE").type = key

    bind("J")
    try:
        session = desk.start()
        for vertex in (10, 16, 70):
            ui.click(desk.at(vertex), ctrl=vertex == 10)
        ui.wait_until(lambda: len(session.wires) == 2)
        shown = texts.hints(drawing.running[0].status())
        assert ("EVENT_J", "Close") in shown
        assert not any(icon == "EVENT_C" for icon, _ in shown)
        assert ("J", "Close the loop") in drawing.running[0].keys.rows(), "in the help too"
        ui.key("C")
        assert len(session.wires) == 2
        ui.key("J")
        ui.wait_until(lambda: len(session.wires) == 3)
    finally:
        bind("C")
    assert len(finish(desk)) > 12


def test_enter_waits_for_the_clicks_that_wait(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.event("LEFTMOUSE", "PRESS", desk.at(44), ticks=1)
    ui.event("LEFTMOUSE", "RELEASE", desk.at(44), ticks=1)
    ui.key("RET")
    ui.wait_until(lambda: not desk.running)
    assert seams(desk.obj) == chain(*range(36, 45))
    assert len(session.wires) == 1
