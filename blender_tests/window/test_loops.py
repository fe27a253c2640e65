# SPDX-License-Identifier: GPL-3.0-or-later
"""What one click on an edge takes: with Alt held the offers are shown, the wheel and W turn from one to the next."""

import bpy
import pytest
from desk import GREEN, Desk, said, shows, undo_steps
from scene import chain, changing, seams, set_seams
from seamwire.core.sketch.picture import Role


def offer(desk: Desk, *edge: int) -> tuple[float, float]:
    """With the tool chosen, point at an edge and hold Alt; return where that is."""
    place = desk.at(*edge)
    desk.choose()
    session = desk.session
    desk.ui.wait_until(lambda: not session.computing)
    desk.ui.move(place)
    desk.ui.event("LEFT_ALT", "PRESS", place, alt=True)
    # The first offers are there at once. The others come when the wires are computed.
    desk.ui.wait_until(lambda: session.picture.one(Role.OFFER) is not None and not session.computing)
    return place


def turn_to(desk: Desk, kind: str, up: bool = True) -> None:
    session = desk.session
    for _ in session.picture.offered.kinds:
        if session.picture.offered.kind != kind:
            desk.ui.wheel(up=up, alt=True)
    assert session.picture.offered.kind == kind


def take(desk: Desk, kind: str, *edge: int) -> list[tuple[int, int]]:
    """Take an offer with a click; return what is marked."""
    place = offer(desk, *edge)
    turn_to(desk, kind)
    shown = sorted(desk.session.picture.one(Role.OFFER).edges())
    desk.ui.click(place, alt=True)
    assert desk.left_clean()
    assert desk.session.edges_to_mark() == shown
    return seams(desk.obj)


@pytest.mark.smoke
def test_alt_shows_what_a_click_takes_and_w_and_the_wheel_turn_from_one_to_the_next(desk: Desk) -> None:
    place, ui = offer(desk, 40, 41), desk.ui
    session = desk.session
    kinds = session.picture.offered.kinds
    assert "STRIP" in kinds
    assert len(kinds) > 1
    frame, distance = bpy.context.scene.frame_current, ui.view.view_distance
    seen = [session.picture.offered.kind]
    for _ in kinds[1:]:
        ui.wheel(up=True, alt=True)
        seen.append(session.picture.offered.kind)
    assert seen == list(kinds)
    ui.key("W", alt=True)
    assert session.picture.offered.kind == kinds[0], "and round again"
    assert (bpy.context.scene.frame_current, ui.view.view_distance) == (frame, distance)
    assert f"1 of {len(kinds)}" in said()
    ui.event("LEFT_ALT", "RELEASE", place)
    assert not desk.running
    assert session.picture.one(Role.OFFER) is None
    assert desk.unchanged()


def test_alt_over_a_vertex_takes_the_nearest_edge(desk: Desk) -> None:
    desk.choose()
    ui, session = desk.ui, desk.session
    x, y = desk.at(40)
    ui.move((x + 3.0, y))
    assert session.target.pick == 40
    ui.event("LEFT_ALT", "PRESS", (x + 3.0, y), alt=True)
    assert session.target.pick == (40, 41)
    ui.event("LEFT_ALT", "RELEASE", (x + 3.0, y))


def stub(desk: Desk) -> None:
    """Mark a seam that ends in the middle row."""
    set_seams(desk.obj, (34, 43))


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_strip_is_taken_up_to_the_seams_in_one_step(desk: Desk, capfd: pytest.CaptureFixture[str]) -> None:
    stub(desk)
    bpy.ops.ed.undo_push(message="Before")
    assert take(desk, "STRIP", 40, 41) == sorted([*chain(*range(36, 44)), (34, 43)])
    assert undo_steps(capfd)[-1] == "Draw Seamwires"
    desk.ui.key("Z", ctrl=True)
    assert seams(desk.obj) == [(34, 43)]


def fold_in_the_middle(desk: Desk) -> None:
    """Fold the grid by 45 degrees along its middle column, where alone a part ends."""
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            edge.smooth = True
        for face in bm.faces:
            face.material_index = 0
        for vertex in bm.verts:
            vertex.co.z += max(vertex.co.x, 0.0)


def test_inside_a_face_the_border_of_its_part_comes_first(desk: Desk) -> None:
    fold_in_the_middle(desk)
    desk.ui.look_from_top(distance=1.0)
    corners = (38, 39, 47, 48)
    place = offer(desk, *corners)
    assert desk.session.picture.offered.kind == "FLAT"
    assert "Border of Part" in said()
    desk.ui.click(place, alt=True)
    assert {vertex % 9 for edge in seams(desk.obj) for vertex in edge} == {0, 1, 2, 3, 4}
    assert len(seams(desk.obj)) == 24
    desk.ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []
    offer(desk, *corners[:2])
    assert desk.session.picture.offered.kind != "FLAT", "near an edge its loops come first"


def test_an_offer_of_one_edge_is_seen_though_the_edge_is_highlighted(desk: Desk) -> None:
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            columns = {round(4.0 * (vertex.co.x + 1.0)) for vertex in edge.verts}
            edge.seam = columns in ({4}, {5})
    offer(desk, 40, 41)
    turn_to(desk, "STRIP")
    assert desk.session.picture.one(Role.OFFER).edges() == [(40, 41)]
    desk.ui.wait(2, redraw=True)
    assert shows(desk.ui.pixels(), desk.at(40, 41), GREEN)
