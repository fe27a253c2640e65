# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's menus show the add-on's entries without an error."""

from types import SimpleNamespace

import bpy
import pytest
from desk import Desk
from seamwire.ui import menus


@pytest.mark.smoke
@pytest.mark.every_blender
def test_menus_draw_their_entries_and_each_entry_is_an_operator(desk: Desk) -> None:
    for name in ("VIEW3D_MT_edit_mesh_edges", "TOPBAR_MT_file_import", "TOPBAR_MT_file_export"):
        entries = entries_of(desk, name)
        assert any(entry.startswith("mesh.seamwire_") for entry in entries)
        for entry in entries:
            group, operator = entry.split(".")
            assert getattr(getattr(bpy.ops, group), operator).get_rna_type(), entry


def entries_of(desk: Desk, name: str) -> list[str]:
    """Open a menu and return the operators that the add-on draws in it."""
    drawn: list[str] = []
    functions = getattr(bpy.types, name).draw._draw_funcs
    (ours,) = (i for i, function in enumerate(functions) if function.__module__ == menus.__name__)
    draw = functions[ours]

    class Layout:
        """The menu's layout, which also notes the operators."""

        def __init__(self, layout: bpy.types.UILayout) -> None:
            self.layout = layout

        def __getattr__(self, kind: str) -> object:
            method = getattr(self.layout, kind)

            def noting(*arguments: str, **options: object) -> object:
                result = method(*arguments, **options)
                drawn.extend(arguments[:1])
                return result

            return noting

    functions[ours] = lambda menu, context: draw(SimpleNamespace(layout=Layout(menu.layout)), context)
    try:
        desk.ui.move(desk.at(40))
        with desk.ui.override():
            bpy.ops.wm.call_menu(name=name)
        desk.ui.wait_until(lambda: bool(drawn))
        desk.ui.key("ESC")
    finally:
        functions[ours] = draw
    return drawn
