# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's operators in Blender's search, menus, toolbar and status bar, and that nothing is left when it is disabled."""

from dataclasses import replace
from types import SimpleNamespace

import bpy
import pytest
import traces
from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active
from scene import add_grid, edit
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.solver.solver import LiveMaker
from seamwire.mesh import edit_mesh
from seamwire.mesh.settings import TOOL
from seamwire.ui import menus
from seamwire.words.hints import hints
from seamwire.words.keys import Bindings
from toolbar import slots

pytestmark = pytest.mark.every_blender


@pytest.mark.parametrize("name", ["finish", "select_islands", "store", "suggest", "close_gaps", "unwrap", "draw"])
def test_operators_for_artists_are_found_by_the_search(name: str) -> None:
    assert "INTERNAL" not in getattr(bpy.types, f"MESH_OT_seamwire_{name}").bl_options


@pytest.mark.parametrize(("name", "item"), [("finish", "finish"), ("select_islands", "which"), ("store", "what")])
def test_menu_entries_of_one_operator_have_different_tooltips(name: str, item: str) -> None:
    operator = getattr(bpy.types, f"MESH_OT_seamwire_{name}")
    known = getattr(bpy.ops.mesh, f"seamwire_{name}").get_rna_type()
    items = known.properties[item].enum_items
    tips = {
        operator.description(bpy.context, SimpleNamespace(bl_rna=known, **{item: entry.identifier})) for entry in items
    }
    assert len(tips) == len(items) > 1
    assert all(tips)


def test_the_tool_has_a_slot_of_its_own_and_no_group_has_a_gap() -> None:
    assert [TOOL] in slots()
    assert not any(None in slot for slot in slots() if slot is not None)
    flat = [tool.idname for tool in VIEW3D_PT_tools_active._tools["EDIT_MESH"] if hasattr(tool, "idname")]
    assert TOOL in flat, "not in a group of one either, which would hide what the tool is called"


def test_no_separator_is_left_over() -> None:
    assert slots()[0] is not None
    assert slots()[-1] is not None
    assert not any(one is two is None for one, two in zip(slots(), slots()[1:], strict=False))


def test_without_it_the_toolbar_is_as_blender_made_it() -> None:
    add_grid(3)
    edit()
    with_tool = slots()
    traces.disable()
    try:
        assert slots() == [slot for slot in with_tool if slot != [TOOL]]
    finally:
        traces.enable()
    assert slots() == with_tool


@pytest.fixture
def session() -> Sketch:
    obj = add_grid(9)
    edit()
    arrays = edit_mesh.read(obj)
    session = Sketch(LiveMaker(arrays), arrays.points, edges=arrays.edges, triangles=arrays.triangles)
    session.wait()
    return session


def test_every_icon_is_one_of_blenders(session: Sketch) -> None:
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    session.click(0)
    session.click(4)
    session.wait()
    session.hover(40)
    session.click(4)  # refused, and said
    shown = [icon for icon, _ in hints(session.picture, Bindings(), message="A message")]
    session.follow(replace(session.options, along="SURFACE"))  # computing
    session.end_chain()
    shown += [icon for icon, _ in hints(session.picture, Bindings(), mirror_offer="X")]
    assert [icon for icon in shown if icon not in icons] == []


TIMES = 20


def test_enabled_and_disabled_many_times_it_leaves_nothing_behind() -> None:
    enabled = traces.traces()
    assert any("MESH_OT_seamwire_draw" in one for one in traces.ours(enabled))
    assert any("mesh.seamwire_finish" in one for one in traces.ours(enabled))
    for menu in (*menus.MENUS, menus.CONTEXT_MENU):
        assert sum(f"entries: {menu}:" in one for one in traces.ours(enabled)) == 1, menu
    traces.disable()
    try:
        disabled = traces.traces()
        assert traces.ours(disabled) == []
        for _ in range(TIMES):
            traces.enable()
            traces.disable()
        assert traces.difference(disabled, traces.traces()) == {}
    finally:
        traces.enable()
    assert traces.difference(enabled, traces.traces()) == {}
