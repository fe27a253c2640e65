# SPDX-License-Identifier: GPL-3.0-or-later
"""Enabling and disabling the add-on, many times in a row."""

import pytest
import traces
from seamwire.ui import menus

pytestmark = pytest.mark.every_blender

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
