# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults that users have reported of like tools, tried on this one."""

from __future__ import annotations

from collections.abc import Iterator

import bmesh
import bpy
import numpy as np
import pytest
from desk import Desk, draw
from scene import chain, changing, mark_wires, seams
from seamwire.core.sketch.picture import Role
from seamwire.mesh import uv_islands

ROW = chain(*range(36, 45))


def view_item(idname: str, button: str, value: str, **held: bool) -> tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]:
    """Add a key that moves the view, as the user does in the preferences."""
    keymap = bpy.context.window_manager.keyconfigs.user.keymaps["3D View"]
    return keymap, keymap.keymap_items.new(idname, button, value, head=True, **held)


@pytest.fixture
def right_button_turns() -> Iterator[None]:
    """Dragging with the right button turns the view, as in other programs; the menu that it opened has been given up."""
    keymap, item = view_item("view3d.rotate", "RIGHTMOUSE", "CLICK_DRAG")
    keymaps = bpy.context.window_manager.keyconfigs.user.keymaps.values()
    menus = [
        other
        for one in keymaps
        for other in one.keymap_items
        if other.type == "RIGHTMOUSE" and other.value == "PRESS" and other.active and other.idname == "wm.call_menu"
    ]
    for other in menus:
        other.active = False
    yield
    for other in menus:
        other.active = True
    keymap.keymap_items.remove(item)


@pytest.mark.usefixtures("right_button_turns")
def test_a_view_that_the_right_button_turns_is_turned_while_a_wire_is_live(desk: Desk) -> None:
    desk.choose()
    ui = desk.ui
    ui.click(desk.at(36))
    ui.move(desk.at(40))
    turned = ui.view.view_rotation.copy()
    ui.event("RIGHTMOUSE", "PRESS", desk.at(40))
    for step in range(1, 6):
        ui.move((desk.at(40)[0] + 8.0 * step, desk.at(40)[1] + 6.0 * step))
    ui.event("RIGHTMOUSE", "RELEASE")
    assert ui.view.view_rotation.rotation_difference(turned).angle > 0.02
    assert desk.running
    ui.look_from_top(distance=4.0)
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(desk.session.wires) == 1)
    ui.key("RET")
    assert seams(desk.obj) == ROW


def test_alt_and_the_middle_button_center_the_view_between_chains_and_within_one(desk: Desk) -> None:
    desk.choose()
    ui = desk.ui
    for press in (None, 36):
        if press is not None:
            ui.click(desk.at(press))
        before = ui.view.view_location.copy()
        at = desk.at(47)
        ui.move(at, alt=True)
        ui.event("MIDDLEMOUSE", "PRESS", at, alt=True)
        ui.event("MIDDLEMOUSE", "RELEASE", at, alt=True)
        ui.event("LEFT_ALT", "RELEASE", at)
        ui.wait(3, redraw=True)
        assert (ui.view.view_location - before).length > 0.05
        ui.look_from_top(distance=4.0)
    assert desk.running


def test_seams_and_wires_come_back_with_faces_that_were_deleted(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    ui = desk.ui
    bpy.ops.ed.undo_push(message="Drawn")
    with ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.delete(type="VERT")
    bpy.ops.ed.undo_push(message="Deleted")
    ui.wait(3, redraw=True)
    ui.move(desk.ui.on_screen((0.03, 0.04, 0.0)))
    ui.key("Z", ctrl=True)
    ui.move(desk.at(40))
    assert seams(desk.obj) == ROW
    assert desk.session.picture.one(Role.HOVERED) is not None


def test_undo_over_a_change_in_object_mode_and_back_leaves_a_mesh_to_be_drawn_on(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    ui = desk.ui
    ui.key("TAB")
    desk.obj.location.x += 0.25
    bpy.ops.ed.undo_push(message="Moved")
    for _ in range(2):
        ui.key("Z", ctrl=True)
    for _ in range(2):
        ui.key("Z", ctrl=True, shift=True)
    if desk.obj.mode != "EDIT":
        ui.key("TAB")
    draw(desk, 0, 8)
    assert set(chain(*range(9))) <= set(seams(desk.obj))


def test_islands_are_unwrapped_again_after_their_uvs_were_reset(desk: Desk) -> None:
    desk.choose()
    draw(desk, 36, 44)
    bm = bmesh.from_edit_mesh(desk.obj.data)
    for face in bm.faces:
        for loop in face.loops:
            loop[bm.loops.layers.uv.active].pin_uv = False
    with desk.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.unwrap()
        bpy.ops.mesh.seamwire_unwrap()
        bpy.ops.uv.reset()
        assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
    uvs = uv_islands.read_uvs(desk.obj)
    assert len(np.unique(uvs.round(4), axis=0)) >= 81, "no face lies on another"


def test_a_face_that_surrounds_another_one_can_be_cut_and_unwrapped(desk: Desk) -> None:
    """A face like a horseshoe with another face in its bay."""
    with desk.ui.override():
        with changing(desk.obj) as bm:
            horseshoe = [
                bm.faces[8 * row + column] for row, column in ((2, 2), (2, 3), (2, 4), (3, 2), (3, 4), (4, 2), (4, 4))
            ]
            bmesh.ops.dissolve_faces(bm, faces=horseshoe)
        assert mark_wires(chains="0 80", along="SURFACE", finish="CUT", metric="euclidean")
        assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
        bpy.ops.mesh.seamwire_select_islands(which="TO_CUT")
    desk.obj.update_from_editmode()
    assert not desk.obj.data.copy().validate()
