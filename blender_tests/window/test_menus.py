# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's menus show the add-on's entries and its submenu without an error."""

from collections.abc import Callable
from types import SimpleNamespace

import addon_utils
import bpy
import pytest
from desk import Desk
from scene import ADDON
from seamwire.ui import menus
from seamwire_networks import network_operators as networks

NETWORKS = f"{ADDON}_networks"
TOP = [
    "mesh.seamwire_choose_tool",
    "mesh.seamwire_suggest",
    "mesh.seamwire_close_gaps",
    "mesh.seamwire_unwrap",
    "VIEW3D_MT_seamwire_finish",
    "VIEW3D_MT_seamwire_network",
    "VIEW3D_MT_seamwire_islands",
    "VIEW3D_MT_seamwire_views",
]
NETWORK = [
    "mesh.seamwire_take_over",
    "mesh.seamwire_repeat",
    "mesh.seamwire_transfer",
    "mesh.seamwire_load_network",
    "mesh.seamwire_save_network",
]
"""With the entries of Seamwire Networks."""
BLENDERS = {
    "VIEW3D_MT_edit_mesh_edges": ["VIEW3D_MT_seamwire"],
    "VIEW3D_MT_uv_map": ["VIEW3D_MT_seamwire"],
    "VIEW3D_MT_edit_mesh_context_menu": ["mesh.seamwire_choose_tool"],
    "TOPBAR_MT_file_import": ["mesh.seamwire_load_network"],
    "TOPBAR_MT_file_export": ["mesh.seamwire_save_network"],
}


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("name", BLENDERS)
def test_blenders_menus_have_one_entry_of_ours(desk: Desk, name: str) -> None:
    functions = getattr(bpy.types, name).draw._draw_funcs
    own = {menus.__name__, networks.__name__}
    (ours,) = (i for i, function in enumerate(functions) if function.__module__ in own)
    drawn: list[str] = []
    draw = functions[ours]
    functions[ours] = noting(draw, drawn)
    try:
        open_menu(desk, name, drawn)
    finally:
        functions[ours] = draw
    assert drawn == BLENDERS[name]


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("name", ["VIEW3D_MT_seamwire", *menus.SUBMENUS])
def test_each_entry_of_our_menus_is_an_operator_a_menu_or_a_setting(
    desk: Desk, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[str] = []
    menu = getattr(bpy.types, name)
    monkeypatch.setattr(menu, "draw", noting(menu.draw, drawn))
    open_menu(desk, name, drawn)
    for entry in drawn:
        if isinstance(entry, str) and "." in entry:
            group, operator = entry.split(".")
            assert getattr(getattr(bpy.ops, group), operator).get_rna_type(), entry
    expected = {"VIEW3D_MT_seamwire": TOP, "VIEW3D_MT_seamwire_network": NETWORK}
    assert drawn == expected.get(name, drawn)


@pytest.mark.every_blender
def test_without_seamwire_networks_its_menu_tells_to_enable_it(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    addon_utils.disable(NETWORKS)
    try:
        menu = bpy.types.VIEW3D_MT_seamwire_network
        monkeypatch.setattr(menu, "draw", noting(menu.draw, told))
        open_menu(desk, "VIEW3D_MT_seamwire_network", told)
        assert told[:1] == NETWORK[:1]
        assert "enable Seamwire Networks" in told[1]
        assert len(told) == 2
    finally:
        monkeypatch.undo()
        addon_utils.enable(NETWORKS)


def noting(draw: Callable, drawn: list[str]) -> Callable:
    """Return what draws the same and notes the names of operators and menus, and the settings that it shows."""

    class Layout:
        """The menu's layout."""

        def __init__(self, layout: bpy.types.UILayout) -> None:
            object.__setattr__(self, "layout", layout)

        def __setattr__(self, name: str, value: object) -> None:
            setattr(self.layout, name, value)

        def __getattr__(self, kind: str) -> object:
            method = getattr(self.layout, kind)
            if not callable(method):
                return method

            def call(*arguments: str, **options: object) -> object:
                result = method(*arguments, **options)
                drawn.extend(arguments[:1] or ([options["text"]] if kind == "label" else []))
                return result

            return call

    def draw_and_note(menu: bpy.types.Menu, context: bpy.types.Context) -> None:
        drawn.clear()  # Blender draws a menu again when the mouse moves
        draw(SimpleNamespace(layout=Layout(menu.layout)), context)

    return draw_and_note


def open_menu(desk: Desk, name: str, drawn: list[str]) -> None:
    """Open a menu, wait until something was drawn, and close it."""
    desk.ui.move(desk.at(40))
    with desk.ui.override():
        bpy.ops.wm.call_menu(name=name)
    desk.ui.wait_until(lambda: bool(drawn))
    desk.ui.key("ESC")
    desk.ui.wait(2)
