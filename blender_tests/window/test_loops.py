# SPDX-License-Identifier: GPL-3.0-or-later
"""What one click on an edge takes: with Alt held the offers are shown, the wheel and W turn from one to the next."""

import bpy
import ui as driver
from desk import GREEN, WHITE, Desk, shows
from scene import chain, seams
from seamwire.operators import modal as drawing
from seamwire.ui import menus as texts


def said() -> str:
    return "; ".join(text for _, text in texts.hints(drawing.running[0].status()))


def offer(desk: Desk, *edge: int) -> tuple[float, float]:
    """Point at an edge with Alt held; return where that is."""
    place = desk.at(*edge)
    session = desk.session
    desk.ui.wait_until(lambda: not session.computing)
    desk.ui.move(place, alt=True)
    desk.ui.wait_until(lambda: session.loop_preview is not None)
    return place


def turn_to(desk: Desk, kind: str, up: bool = True) -> None:
    session = desk.session
    for _ in session.loop_offers:
        if session.loop_choice != kind:
            desk.ui.wheel(up=up, alt=True)
    assert session.loop_choice == kind


def take(desk: Desk, kind: str, *edge: int) -> list[tuple[int, int]]:
    """Take an offer with a click, and finish; return what is marked."""
    place = offer(desk, *edge)
    turn_to(desk, kind)
    shown = sorted(desk.session.loop_preview.edges())
    desk.ui.click(place, alt=True)
    assert desk.session.edges_to_mark() == shown
    desk.ui.key("RET")
    assert desk.left_clean()
    return seams(desk.obj)


def test_the_wheel_and_w_turn_from_one_offer_to_the_next(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    offer(desk, 40, 41)
    kinds = session.loop_offers
    assert {"STRIP", "CLOSED"} <= set(kinds)
    frame, distance = bpy.context.scene.frame_current, ui.view.view_distance
    seen = [session.loop_choice]
    for _ in kinds[1:]:
        ui.wheel(up=True, alt=True)
        seen.append(session.loop_choice)
    assert seen == list(kinds)
    ui.key("W", alt=True)
    assert session.loop_choice == kinds[0], "and round again"
    assert (bpy.context.scene.frame_current, ui.view.view_distance) == (frame, distance)
    ui.move(desk.at(40, 41))
    assert session.loop_preview is None
    assert desk.unchanged()


def test_the_status_bar_says_which_offer_it_is_and_of_how_many(desk: Desk) -> None:
    session = desk.start()
    offer(desk, 40, 41)
    count = len(session.loop_offers)
    turn_to(desk, "STRIP")
    assert f"Take Strip, {session.loop_offers.index('STRIP') + 1} of {count}" in said()
    turn_to(desk, "CLOSED")
    assert f"Take Closed Loop, {session.loop_offers.index('CLOSED') + 1} of {count}" in said()
    desk.ui.move(desk.at(40, 41))
    assert "Take" not in said()


def test_a_strip_is_taken_up_to_the_seams(desk: Desk) -> None:
    import bmesh

    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    bm.edges.get((bm.verts[34], bm.verts[43])).seam = True  # a stub that ends in the row
    bmesh.update_edit_mesh(desk.obj.data)
    desk.start()
    assert take(desk, "STRIP", 40, 41) == sorted([*chain(*range(36, 44)), (34, 43)])


def test_a_whole_strip_is_taken_across_seams(desk: Desk) -> None:
    import bmesh

    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    bm.edges.get((bm.verts[34], bm.verts[43])).seam = True
    bmesh.update_edit_mesh(desk.obj.data)
    desk.start()
    assert take(desk, "WHOLE", 40, 41) == sorted([*chain(*range(36, 45)), (34, 43)])


def test_a_closed_loop_is_taken(desk: Desk) -> None:
    desk.start()
    marked = take(desk, "CLOSED", 40, 41)
    assert (40, 41) in marked
    ends = [vertex for edge in marked for vertex in edge]
    assert all(ends.count(vertex) == 2 for vertex in ends)


def test_a_taken_strip_is_changed_in_place(desk: Desk) -> None:
    session, ui = desk.start(), desk.ui
    place = offer(desk, 40, 41)
    turn_to(desk, "STRIP")
    ui.click(place, alt=True)
    assert session.edges_to_mark() == chain(*range(36, 45))
    ui.move(desk.at(38))
    ui.key("W")
    assert len(session.wires) == 1
    assert session.edges_to_mark() != chain(*range(36, 45))
    ui.key("Z", ctrl=True)
    assert session.edges_to_mark() == chain(*range(36, 45)), "one step"
    ui.key("RET")
    assert seams(desk.obj) == chain(*range(36, 45))


def test_alt_and_the_wheel_change_the_frame_where_nothing_is_offered(desk: Desk) -> None:
    desk.start()
    ui = desk.ui
    frame = bpy.context.scene.frame_current
    beside = (ui.region.width - 130.0, 40.0)
    ui.move(beside, alt=True)
    ui.wheel(up=False, alt=True)
    assert bpy.context.scene.frame_current == frame + 1, "as everywhere in Blender"
    ui.wheel(up=True, alt=True)
    assert bpy.context.scene.frame_current == frame
    assert desk.unchanged()


def test_the_offer_that_is_shown_is_seen(ui: driver.Ui, desk: Desk) -> None:
    desk.start()
    offer(desk, 40, 41)
    turn_to(desk, "STRIP")
    assert shows(ui.pixels(), desk.at(37, 38), GREEN)
    turn_to(desk, "CLOSED")
    pixels = ui.pixels()
    assert shows(pixels, desk.at(40, 40, 40, 41), WHITE), "what is under the cursor lies over what is offered"
    assert not shows(pixels, desk.at(37, 38), GREEN)
