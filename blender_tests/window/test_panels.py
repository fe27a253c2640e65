# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences and the tool's settings draw themselves where Blender shows them, without an error."""

from collections.abc import Callable

import bpy
import pytest
import ui as driver
from desk import Desk
from scene import ADDON
from seamwire.mesh.registration import IS_OLD
from seamwire.ui import preferences, toolbar


def recorded(function: Callable, calls: list[str]) -> Callable:
    """Return the function, noting where it was called to draw, and what it raised."""

    def record(*arguments: object) -> None:
        context = next(one for one in arguments if isinstance(one, bpy.types.Context))
        try:
            function(*arguments)
            calls.append(context.region.type)
        except Exception as error:
            calls.append(repr(error))
            raise

    return record


def noted(draw: Callable, calls: list[str]) -> Callable:
    """Return a panel's method that draws the same and notes where. Blender counts its arguments."""

    def draw_and_note(panel: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw(panel, context)
        calls.append(context.region.type)

    return draw_and_note


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_preferences_show_the_keys(ui: driver.Ui, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[str] = []
    monkeypatch.setattr(preferences, "draw_keys", recorded(preferences.draw_keys, calls))
    area = next(area for area in ui.window.screen.areas if area.type == "PROPERTIES")
    area.type = "PREFERENCES"
    try:
        bpy.context.preferences.active_section = "ADDONS"
        bpy.context.window_manager.addon_search = "Seamwire"
        ui.wait(4)
        if not preferences_expanded():
            with bpy.context.temp_override(window=ui.window, area=area):
                bpy.ops.preferences.addon_expand(module=ADDON)
        area.tag_redraw()
        ui.wait_until(lambda: bool(calls))
    finally:
        area.type = "PROPERTIES"
        bpy.context.window_manager.addon_search = ""
        ui.wait(2)
    assert set(calls) == {"WINDOW"}


def preferences_expanded() -> bool:
    """Whether Blender shows the add-on's preferences already."""
    import addon_utils

    module = next(module for module in addon_utils.modules() if module.__name__ == ADDON)
    return bool(addon_utils.module_bl_info(module).get("show_expanded"))


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_tools_settings_are_shown_in_its_header_and_in_the_properties(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[str] = []
    monkeypatch.setattr(toolbar, "draw_settings", recorded(toolbar.draw_settings, calls))
    ui = desk.ui
    with ui.override():
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    area = next(area for area in ui.window.screen.areas if area.type == "PROPERTIES")
    try:
        area.spaces.active.context = "TOOL"
        area.tag_redraw()
        ui.wait(2, redraw=True)
        ui.wait_until(lambda: {"TOOL_HEADER", "WINDOW"} <= set(calls))
    finally:
        area.spaces.active.context = "OBJECT"
        with ui.override():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
    assert set(calls) <= {"TOOL_HEADER", "WINDOW", "HEADER", "UI"}


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_views_are_shown_in_a_popover_and_the_groups_in_the_sidebar(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[str] = []
    ui = desk.ui
    panel = bpy.types.VIEW3D_PT_seamwire_overlays
    monkeypatch.setattr(panel, "draw", noted(panel.draw, calls))
    desk.choose()
    with ui.override():
        bpy.ops.wm.call_panel(name=panel.bl_idname)
    ui.wait_until(lambda: bool(calls))
    ui.key("ESC")
    ui.wait(2)
    if IS_OLD:
        return  # a script cannot choose the sidebar's tab
    groups: list[str] = []
    for name in toolbar.GROUPS:
        group = getattr(bpy.types, f"VIEW3D_PT_seamwire_{name.lower()}")
        monkeypatch.setattr(group, "draw", noted(group.draw, groups))
    ui.space.show_region_ui = True
    try:
        ui.wait(2, redraw=True)
        area = next(area for area in ui.window.screen.areas if area.type == "VIEW_3D")
        next(region for region in area.regions if region.type == "UI").active_panel_category = "Tool"
        ui.wait(2, redraw=True)
        ui.wait_until(lambda: len(groups) >= len(toolbar.GROUPS) - 1)  # one is closed
    finally:
        ui.space.show_region_ui = False
        ui.wait(2)
    assert set(groups) == {"UI"}
