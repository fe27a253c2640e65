# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's slot in Blender's toolbar, and Blender's own beside it. Choosing tools needs a window: see ``window/test_toolbar.py``."""

import pytest
import traces
from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active
from scene import add_grid, edit
from seamwire.mesh.settings import TOOL
from toolbar import slots

pytestmark = pytest.mark.every_blender


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
