# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's menus show the add-on's entries without an error."""

from types import SimpleNamespace

import bpy
import pytest
from desk import Desk
from seamwire.ui import menus


@pytest.mark.smoke
@pytest.mark.every_blender
@pytest.mark.parametrize("name", ["VIEW3D_MT_edit_mesh_edges", "TOPBAR_MT_file_import", "TOPBAR_MT_file_export"])
def test_every_entry_is_an_operator_and_the_menu_draws_them(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    drawn: list[str] = []
    functions = getattr(bpy.types, name).draw._draw_funcs
    (ours,) = (i for i, function in enumerate(functions) if function.__module__ == menus.__name__)
    draw = functions[ours]

    def recorded(menu: bpy.types.Menu, context: bpy.types.Context) -> None:
        class Layout:
            """Blender's layout, noting the operators."""

            def __getattr__(self, kind: str) -> object:
                method = getattr(menu.layout, kind)

                def noting(*arguments: object, **options: object) -> object:
                    result = method(*arguments, **options)
                    drawn.extend(arguments[:1])
                    return result

                return noting

        draw(SimpleNamespace(layout=Layout()), context)

    monkeypatch.setitem(functions, ours, recorded)
    desk.ui.move(desk.at(40))
    with desk.ui.override():
        bpy.ops.wm.call_menu(name=name)
    desk.ui.wait_until(lambda: bool(drawn))
    desk.ui.key("ESC")
    operators = [getattr(getattr(bpy.ops, group), one) for group, one in (entry.split(".") for entry in drawn)]
    assert all(operator.get_rna_type() for operator in operators), "each entry has an operator"
