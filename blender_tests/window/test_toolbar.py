# SPDX-License-Identifier: GPL-3.0-or-later
"""Choosing tools in the toolbar: Blender's tools and ours."""

import ctypes
from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import traces
import ui as driver
from scene import add_grid, edit
from seamwire.mesh.settings import TOOL, settings
from toolbar import slots


@pytest.fixture
def view(ui: driver.Ui) -> Iterator[driver.Ui]:
    """A 3D view in edit mode."""
    add_grid(3)
    ui.wait()
    with ui.override():
        edit()
    yield ui
    choose(ui, "builtin.select_box")


def choose(ui: driver.Ui, name: str, cycle: bool = False) -> str:
    """Choose a tool, as a click on its slot does or, to cycle, as its key pressed again does; return which is active then."""
    with ui.override():
        assert bpy.ops.wm.tool_set_by_id(name=name, cycle=cycle) == {"FINISHED"}
        return bpy.context.workspace.tools.from_space_view3d_mode("EDIT_MESH", create=False).idname


@pytest.mark.smoke
def test_every_tool_can_be_chosen_and_cycled(view: driver.Ui) -> None:
    with view.override():
        groups = [slot for slot in slots() if slot is not None]
    assert [TOOL] in groups
    for group in groups:
        for name in group:
            assert choose(view, name) == name
        seen = {choose(view, group[0], cycle=True) for _ in group}
        assert seen == set(group)


def test_every_slot_can_be_hovered(view: driver.Ui) -> None:
    toolbar = next(region for region in view.area.regions if region.type == "TOOLS")
    with view.override():
        view.space.show_region_toolbar = True
    view.wait(4, redraw=True)
    for up in range(toolbar.height - 4, 0, -12):
        # From the lower left corner of the view's own region.
        view.move((toolbar.x + 0.5 * toolbar.width - view.region.x, toolbar.y + up - view.region.y))
        view.wait(2, redraw=True)


@pytest.mark.parametrize("away", ["", "in object mode", "in another workspace"])
def test_disabled_while_it_is_chosen_it_leaves_a_view_that_works(
    view: driver.Ui, away: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert choose(view, TOOL) == TOOL
    home = view.window.workspace
    if away == "in object mode":
        switch_mode(view, "OBJECT")
    elif away == "in another workspace":
        show(view, bpy.data.workspaces["Scripting"])
    traces.disable()
    try:
        if away == "in object mode":
            switch_mode(view, "EDIT")
        elif away == "in another workspace":
            show(view, home)
        chosen = [tool for workspace in bpy.data.workspaces for tool in workspace.tools]
        assert TOOL not in {tool.idname for tool in chosen}
        view.wait(4, redraw=True)
        view.move((view.region.width * 0.4, view.region.height * 0.5))
        ctypes.CDLL(None).fflush(None)
        printed = "".join(capfd.readouterr())
        assert "empty keymap" not in printed
        assert "unknown gizmo group" not in printed
        assert choose(view, "builtin.knife", cycle=True) in {"builtin.knife", "builtin.bisect"}
        view.wait(2, redraw=True)
    finally:
        traces.enable()
    assert choose(view, TOOL) == TOOL


@pytest.mark.parametrize(("along", "is_full"), [("AUTO", False), ("SURFACE", True)])
def test_blenders_controls_have_room_beside_ours(view: driver.Ui, along: str, is_full: bool) -> None:
    choose(view, TOOL)
    settings().along = along
    if is_full:
        with view.override():
            bpy.ops.screen.screen_full_area()
    try:
        view.wait(4, redraw=True)
        area = next(area for area in view.window.screen.areas if area.type == "VIEW_3D")
        header = next(region for region in area.regions if region.type == "TOOL_HEADER")
        area.tag_redraw()
        view.wait(4)
        assert header.width <= 960
        x, y = view.window.x + header.x, view.window.y + header.y
        shown = driver.display()[y + 4 : y + header.height - 4, x : x + header.width]
        # A control that is cut off lies over the ground at the header's end.
        assert np.ptp(shown[:, -5:-2], axis=(0, 1)).max() < 0.02
        assert np.ptp(shown, axis=(0, 1)).max() > 0.5, "the header has controls"
    finally:
        settings().property_unset("along")
        if is_full:
            with bpy.context.temp_override(window=view.window, screen=view.window.screen, area=area):
                bpy.ops.screen.back_to_previous()
            view.wait(4, redraw=True)


def switch_mode(ui: driver.Ui, mode: str) -> None:
    with ui.override():
        bpy.ops.object.mode_set(mode=mode)
    ui.wait(4, redraw=True)


def show(ui: driver.Ui, workspace: bpy.types.WorkSpace) -> None:
    """Show another workspace, whose views are different areas."""
    ui.window.workspace = workspace
    ui.wait(8)
    driver.Ui.__init__(ui)
