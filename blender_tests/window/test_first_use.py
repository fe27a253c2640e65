# SPDX-License-Identifier: GPL-3.0-or-later
"""What somebody meets who chooses the tool for the first time."""

import random
from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, choose, draw, leave, reset_settings
from scene import add_grid, edit
from seamwire.mesh.settings import preferences, settings
from seamwire.operators import card as operator
from seamwire.ui.properties import along_of
from seamwire.view import card as drawing
from seamwire.view.edited_objects import edited
from seamwire.words import card as words


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
    assert settings().along == "EDGES", "the artist has chosen"


def test_the_way_that_was_chosen_stays_on_scans(scan: driver.Ui) -> None:
    settings().along = "EDGES"
    point_at(scan, (0.1, 0.1, 0.0))
    assert edited.front.session.options.along == "EDGES"


def test_modeled_meshes_start_along_edges_after_a_scan(scan: driver.Ui) -> None:
    point_at(scan, (0.1, 0.1, 0.0))
    assert edited.front.session.options.along == "SURFACE"
    with scan.override():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects["Scan"].hide_set(True)
        add_grid(5, name="Model")
        edit()
    point_at(scan, (0.1, 0.1, 0.0))
    scan.wait_until(lambda: edited.front.name == "Model")
    assert edited.front.session.options.along == "EDGES"


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


def test_a_grid_of_quads_starts_along_edges(desk: Desk) -> None:
    desk.choose()
    assert desk.session.options.along == "EDGES"


@pytest.fixture
def card(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> Iterator[Desk]:
    """A grid with the tool chosen for the first time."""
    monkeypatch.setattr(words, "guide", lambda: "file:///guide/index.md")
    preferences().show_card, preferences().chains_drawn = True, 0
    bpy.context.preferences.is_dirty = False
    choose(desk.ui)
    desk.ui.wait(3, redraw=True)
    yield desk
    preferences().show_card = False


def part(desk: Desk, name: str) -> tuple[float, float]:
    """Return the middle of a part of the card."""
    placed = drawing.placed(desk.ui.area, desk.ui.region)
    box = placed.box if name == "box" else getattr(placed, name)
    return box.left + 0.5 * box.width, box.bottom + 0.5 * box.height


def dark_pixels(desk: Desk) -> int:
    """Count the pixels of the card's ground around its middle."""
    x, y = (round(at) for at in part(desk, "box"))
    seen = desk.ui.screen()[y - 20 : y + 20, x - 60 : x + 60]
    return int((np.abs(seen - np.array((29, 29, 32)) / 255).max(axis=-1) < 0.02).sum())


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_card_is_seen_until_its_close_button_is_clicked(card: Desk) -> None:
    assert dark_pixels(card) > 500
    card.ui.click(part(card, "close"))
    assert not preferences().show_card
    assert bpy.context.preferences.is_dirty, "Blender is to save that"
    assert dark_pixels(card) < 50
    assert not card.running


def test_a_click_on_the_cards_link_opens_the_guide(card: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    card.ui.click(part(card, "link"))
    assert opened == ["file:///guide/index.md"]
    assert preferences().show_card
    assert not card.running


def test_clicks_and_the_wheel_go_through_the_card(card: Desk) -> None:
    ui = card.ui
    at = part(card, "box")
    x, y, _ = ui.view.view_location
    ui.view.view_location = (x - 1.2, y + 0.7, 0.0)  # the mesh lies under the card
    ui.wait(2, redraw=True)
    distance = ui.view.view_distance
    ui.wheel(True, at)
    assert ui.view.view_distance != distance
    ui.move(at)
    ui.click(at)
    assert card.running
    assert preferences().show_card, "it comes back when the chain has ended"
    ui.key("ESC")
    assert dark_pixels(card) > 500


def test_with_another_tool_there_is_no_card(card: Desk) -> None:
    assert dark_pixels(card) > 500
    choose(card.ui, "builtin.select_box")
    assert dark_pixels(card) < 50


def test_after_a_few_chains_the_card_is_gone(card: Desk) -> None:
    for number in range(3):
        assert preferences().show_card
        draw(card, 9 * number, 9 * number + 8)
    assert not preferences().show_card
    assert bpy.context.preferences.is_dirty, "Blender is to save that"
    assert dark_pixels(card) < 50


def test_in_a_quad_view_the_card_is_in_one_view(card: Desk) -> None:
    ui = card.ui
    with ui.override():
        bpy.ops.screen.region_quadview()
    try:
        ui.wait(4, redraw=True)
        views = [region for region in ui.area.regions if region.type == "WINDOW"]
        assert len(views) == 4
        with_card = []
        for region in views:
            with bpy.context.temp_override(window=ui.window, area=ui.area, region=region):
                with_card.append(operator.shows_in(bpy.context))
        assert with_card == [False, False, False, True], "in the user's view"
    finally:
        with ui.override():
            bpy.ops.screen.region_quadview()
        ui.wait(4)
