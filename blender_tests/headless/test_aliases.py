# SPDX-License-Identifier: GPL-3.0-or-later
"""Old names of operators do what they did, and name their successors."""

from collections.abc import Callable
from types import SimpleNamespace

import bpy
import pytest
from scene import add_grid, edit, snapshot

pytestmark = pytest.mark.every_blender

ALIASES: tuple[tuple[str, dict[str, str], str, dict[str, str]], ...] = (
    ("seamwire_cut", {}, "seamwire_finish", {"finish": "CUT"}),
    ("seamwire_slide", {}, "seamwire_finish", {"finish": "SLIDE"}),
    ("seamwire_select_islands_to_cut", {}, "seamwire_select_islands", {"which": "TO_CUT"}),
    ("seamwire_worst_island", {"kind": "AREA"}, "seamwire_select_islands", {"which": "WORST", "kind": "AREA"}),
    ("seamwire_store_islands", {"kind": "MATERIALS"}, "seamwire_store", {"what": "MATERIALS"}),
)


def after(call: Callable[[], set[str]]) -> dict[str, object]:
    """Return a grid with a wire across it, and what an operator made of it."""
    obj = add_grid(9)
    obj.data.uv_layers.new()
    edit()
    bpy.ops.mesh.seamwire_mark(chains="0 44", along="SURFACE", strength=1.0)
    assert call() == {"FINISHED"}
    found = {"mesh": snapshot(obj), "selected": selected(obj)}
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
    return found


def selected(obj: bpy.types.Object) -> list[int]:
    """Return the numbers of the selected faces."""
    obj.update_from_editmode()
    return [polygon.index for polygon in obj.data.polygons if polygon.select]


@pytest.mark.parametrize(("old", "old_options", "new", "new_options"), ALIASES, ids=[alias[0] for alias in ALIASES])
def test_an_old_name_does_the_same_and_names_the_new_one(
    old: str, old_options: dict[str, str], new: str, new_options: dict[str, str], capfd: pytest.CaptureFixture[str]
) -> None:
    by_old = after(lambda: getattr(bpy.ops.mesh, old)(**old_options))
    told = capfd.readouterr().out
    assert f"mesh.{old} is deprecated and will be removed: use mesh.{new}(" in told
    assert by_old == after(lambda: getattr(bpy.ops.mesh, new)(**new_options))
    assert "deprecated" not in capfd.readouterr().out


@pytest.mark.parametrize("name", [*(alias[0] for alias in ALIASES), "seamwire_mark"])
def test_names_for_scripts_are_not_found_by_the_search(name: str) -> None:
    assert "INTERNAL" in getattr(bpy.types, f"MESH_OT_{name}").bl_options


@pytest.mark.parametrize("name", ["finish", "select_islands", "store", "suggest", "close_gaps", "unwrap", "draw"])
def test_operators_for_artists_are_found_by_the_search(name: str) -> None:
    assert "INTERNAL" not in getattr(bpy.types, f"MESH_OT_seamwire_{name}").bl_options


@pytest.mark.parametrize(
    ("name", "item"), [("finish", "finish"), ("select_islands", "which"), ("store", "what"), ("mark_seams_as", "kind")]
)
def test_menu_entries_of_one_operator_have_different_tooltips(name: str, item: str) -> None:
    operator = getattr(bpy.types, f"MESH_OT_seamwire_{name}")
    known = getattr(bpy.ops.mesh, f"seamwire_{name}").get_rna_type()
    items = known.properties[item].enum_items
    tips = {
        operator.description(bpy.context, SimpleNamespace(bl_rna=known, **{item: entry.identifier})) for entry in items
    }
    assert len(tips) == len(items) > 1
    assert all(tips)
