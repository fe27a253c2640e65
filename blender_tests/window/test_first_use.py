# SPDX-License-Identifier: GPL-3.0-or-later
"""What somebody meets who chooses the tool for the first time."""

import random
from collections.abc import Iterator
from itertools import count

import bpy
import keymaps
import pytest
import ui as driver
from desk import Desk, choose, draw, leave, reset_settings
from scene import add_grid, chain, edit, seams
from seamwire.mesh.settings import preferences, settings
from seamwire.tool import draw as operator
from seamwire.ui import menus
from seamwire.ui.toolbar import along_of
from seamwire.view import overlay
from seamwire.view.edited_objects import edited


@pytest.fixture
def scan(ui: driver.Ui) -> Iterator[driver.Ui]:
    """A rough surface of 6,962 triangles in edit mode, seen from above, with the tool as it comes."""
    reset_settings()
    dice = random.Random(1)
    for v in add_grid(60, name="Scan").data.vertices:
        v.co.z = 0.01 * dice.random()
    with ui.override():
        edit()
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.quads_convert_to_tris()
    ui.look_from_top(distance=4.0)
    choose(ui)
    yield ui
    leave(ui)


def point_at(ui: driver.Ui, place: tuple[float, float, float]) -> None:
    ui.move(ui.on_screen(place))
    ui.wait_until(lambda: edited.front is not None)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_scans_start_across_the_surface_until_the_artist_chooses(scan: driver.Ui) -> None:
    point_at(scan, (0.1, 0.1, 0.0))
    assert edited.front.session.options.along == "SURFACE"
    assert not isinstance(edited.front.session.target.pick, tuple)
    scan.click(scan.on_screen((0.1, 0.1, 0.0)))
    scan.key("E")
    assert settings().along == "EDGES"
    scan.key("ESC")
    point_at(scan, (-0.3, 0.1, 0.0))
    assert edited.front.session.options.along == "SURFACE", "the key was for the chain"
    settings().along = "EDGES"
    point_at(scan, (0.1, 0.1, 0.0))
    assert edited.front.session.options.along == "EDGES", "the artist has chosen"


def test_pointing_at_objects_changes_no_setting(scan: driver.Ui) -> None:
    with scan.override():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects["Scan"].location.x = -1.5
        add_grid(5, name="Model").location.x = 1.5
        bpy.data.objects["Scan"].select_set(True)
        edit()
    scan.look_from_top(distance=8.0)
    places = {"Scan": (-1.4, 0.1, 0.0), "Model": (1.6, 0.1, 0.0)}
    before = {name: getattr(settings(), name) for name in settings().bl_rna.properties.keys()}  # noqa: SIM118
    with scan.override():
        shown = along_of(bpy.context)
    for name in (*places, *places):
        scan.move(scan.on_screen(places[name]))
        scan.wait_until(lambda name=name: edited.front is not None and edited.front.name == name)
        assert edited.front.session.options.along == ("SURFACE" if name == "Scan" else "EDGES")
        assert {name: getattr(settings(), name) for name in before} == before
        with scan.override():
            assert along_of(bpy.context) == shown, "the header shows what the active object has"
    scan.click(scan.on_screen(places["Scan"]))
    scan.wheel(True, shift=True)
    assert settings().strength_surface > before["strength_surface"], "the strength of this wire"
    assert settings().strength_edges == before["strength_edges"]
    scan.key("ESC")
    settings().strength_surface = before["strength_surface"]


@pytest.fixture
def newcomer(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> Iterator[Desk]:
    """A grid with the tool chosen for the first time."""
    monkeypatch.setattr(operator, "_kept", count(1))
    preferences().text = "STEPS"
    bpy.context.preferences.is_dirty = False
    desk.choose()
    yield desk
    preferences().text = "INFORMATION"


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the panel with all keys, one for each time that Blender draws it."""
    names: list[str] = []
    draw_panel = menus.VIEW3D_PT_seamwire_help.draw

    def note(panel: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw_panel(panel, context)
        names.append(panel.bl_idname)

    monkeypatch.setattr(menus.VIEW3D_PT_seamwire_help, "draw", note)
    return names


def text_pixels(desk: Desk) -> int:
    """Count the bright pixels where the first steps are drawn, above the text that is always there."""
    desk.ui.move((desk.ui.region.width - 60.0, 60.0))
    left, bottom, _, _ = overlay.free_room(desk.ui.area, desk.ui.region)
    seen = desk.ui.screen()[bottom + 60 : bottom + 160, left : left + 300]
    return int((seen.min(axis=-1) > 0.85).sum())


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_first_steps_are_seen_until_they_are_turned_off(newcomer: Desk) -> None:
    assert text_pixels(newcomer) > 500
    preferences().text = "INFORMATION"
    assert text_pixels(newcomer) < 50
    choose(newcomer.ui, "builtin.select_box")
    newcomer.choose()
    assert text_pixels(newcomer) < 50


def test_clicks_go_through_the_first_steps_which_stay_in_a_chain(newcomer: Desk) -> None:
    ui = newcomer.ui
    left, bottom, _, _ = overlay.free_room(ui.area, ui.region)
    at = left + 60.0, bottom + 100.0
    x, y = newcomer.at(40)
    pixel = ui.on_screen((1.0, 0.0, 0.0))[0] - ui.on_screen((0.0, 0.0, 0.0))[0]
    ui.view.view_location = ((x - at[0]) / pixel, (y - at[1]) / pixel, 0.0)  # the mesh lies under the text
    ui.wait(2, redraw=True)
    ui.click(at)
    assert newcomer.running
    assert text_pixels(newcomer) > 500


@pytest.mark.every_blender
def test_after_a_few_chains_the_first_steps_are_gone(newcomer: Desk) -> None:
    for number in range(3):
        assert preferences().text == "STEPS"
        draw(newcomer, 9 * number, 9 * number + 8)
    assert preferences().text == "INFORMATION"
    assert bpy.context.preferences.is_dirty, "Blender is to save that"
    assert text_pixels(newcomer) < 50


@pytest.mark.smoke
@pytest.mark.every_blender
def test_a_chain_goes_on_after_the_panel_with_all_keys(desk: Desk, drawn: list[str]) -> None:
    session = desk.start()
    desk.ui.click(desk.at(20))
    desk.ui.move(desk.at(40))
    desk.ui.key("F1")
    desk.ui.wait(4, redraw=True)
    assert drawn
    assert desk.running
    desk.ui.key("ESC")
    desk.ui.wait(4)
    assert desk.running, "the key has closed the panel"
    desk.ui.click(desk.at(24))
    desk.ui.wait_until(lambda: len(session.wires) == 1)
    desk.ui.key("RET")
    assert seams(desk.obj) == chain(20, 21, 22, 23, 24)


@pytest.mark.every_blender
@pytest.mark.parametrize("keymap", keymaps.KEYMAPS)
def test_f1_shows_all_keys_before_the_first_click_in_each_keymap(desk: Desk, drawn: list[str], keymap: str) -> None:
    with keymaps.using(keymap):
        desk.choose()
        desk.ui.key("F1")
        desk.ui.wait(4, redraw=True)
        assert drawn
        desk.ui.key("ESC")
        desk.ui.wait(4)
        assert not desk.running
        del drawn[:]
        desk.start()
        desk.ui.click(desk.at(20))
        desk.ui.key("F1")
        desk.ui.wait(4, redraw=True)
        assert drawn
        desk.ui.key("ESC")
        desk.ui.wait(4)
        assert desk.running
        desk.ui.key("ESC")
        assert not desk.running


def test_a_button_that_is_held_comes_before_the_keys(desk: Desk, drawn: list[str]) -> None:
    desk.choose()
    desk.ui.event("LEFTMOUSE", "PRESS", desk.at(40), shift=True)
    desk.ui.move((desk.at(40)[0] + 30.0, desk.at(40)[1]), shift=True)
    desk.ui.key("F1")
    desk.ui.wait(4, redraw=True)
    assert not drawn
    assert desk.running
