# SPDX-License-Identifier: GPL-3.0-or-later
"""Enabling and disabling the add-on, and what it says without its compiled part."""

import addon_utils
import bpy
import pytest
from scene import ADDON, add_grid, edit, seams

MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_context_menu", "IMAGE_MT_uvs")


def entries() -> list[int]:
    return [len(getattr(bpy.types, name)._dyn_ui_initialize()) for name in MENUS]


def test_disabling_leaves_nothing_and_enabling_brings_all_back() -> None:
    before = entries()
    try:
        for _ in range(5):
            addon_utils.disable(ADDON)
            assert [count + 1 for count in entries()] == before
            assert not hasattr(bpy.types, "MESH_OT_seamwire_draw")
            assert not hasattr(bpy.types, "MESH_OT_seamwire_mark")
            addon_utils.enable(ADDON)
            assert entries() == before
    finally:
        addon_utils.enable(ADDON)
    assert bpy.ops.mesh.seamwire_mark.get_rna_type().identifier == "MESH_OT_seamwire_mark"


def test_without_the_compiled_part_the_operator_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    from seamwire import native

    def fail() -> None:
        raise native.NativeError("Seamwire's compiled part is missing: install the package")

    monkeypatch.setattr(native, "load", fail)
    obj = add_grid(3)
    edit()
    with pytest.raises(RuntimeError, match="install the package"):
        bpy.ops.mesh.seamwire_mark(chains="0 2")
    assert seams(obj) == []
