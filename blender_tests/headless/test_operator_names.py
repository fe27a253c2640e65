# SPDX-License-Identifier: GPL-3.0-or-later
"""How artists find operators, and what menus say of them."""

from types import SimpleNamespace

import bpy
import pytest

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
