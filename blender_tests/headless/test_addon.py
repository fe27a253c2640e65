# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on says without its compiled part, and what enabling it reads."""

import sys
from pathlib import Path

import pytest
from fresh import run_fresh
from scene import ADDON, add_grid, edit, mark_wires, seams
from seamwire.mesh import registration

pytestmark = pytest.mark.every_blender


def test_without_the_compiled_part_the_operator_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    from seamwire.core.base import native

    def fail() -> None:
        raise native.NativeError("Seamwire's compiled part, seamwire_core, is missing")

    monkeypatch.setattr(native, "load", fail)
    obj = add_grid(3)
    edit()
    with pytest.raises(ImportError, match="Seamwire's compiled part"):
        mark_wires(chains="0 2")
    assert seams(obj) == []


def test_enabling_and_drawing_the_header_read_neither_numpy_nor_the_compiled_part() -> None:
    output = run_fresh(f"""
import sys, bpy
before = set(sys.modules)
enable({ADDON!r})
assert sys.modules[{ADDON!r} + ".mesh.settings"].settings().along == "AUTO"
assert sys.modules[{ADDON!r} + ".ui.toolbar"].along_of(bpy.context) == "EDGES"
print("Read:", sorted(dict.fromkeys(name.split(".")[0] for name in set(sys.modules) - before)))
""")
    read = next(line for line in output.splitlines() if line.startswith("Read:"))
    assert "numpy" not in read, "it takes longer than all else, and Blender's start would wait"
    assert "seamwire_core" not in read


def test_enabling_with_an_option_of_the_command_line_writes_no_preferences(tmp_path: Path) -> None:
    if ADDON.startswith("bl_ext."):
        pytest.skip("another Blender that disables an extension removes its wheels from under this one")
    code = f"""
import bpy, sys
assert {ADDON!r} not in bpy.context.preferences.addons
settings = sys.modules[{ADDON!r} + ".mesh.settings"]
print("Set:", settings.settings().along, settings.preferences().line_width)
settings.settings().along = "SURFACE"
assert settings.settings().along == "SURFACE"
bpy.ops.wm.save_userpref()
addon_utils.disable({ADDON!r}, default_set=True)
addon_utils.enable({ADDON!r}, default_set=True)
assert settings.preferences() == bpy.context.preferences.addons[{ADDON!r}].preferences
"""
    assert "Set: AUTO 1.0" in run_fresh(code, "--addons", ADDON, BLENDER_USER_CONFIG=str(tmp_path))
    stored = (tmp_path / "userpref.blend").read_bytes()
    assert ADDON.encode() not in stored, "nothing but settings of Blender"


def test_other_versions_of_blender_are_refused() -> None:
    for version in ((3, 3, 21), (3, 6, 23), (4, 1, 1)):
        with pytest.raises(RuntimeError, match=r"does not run in Blender .*: use Blender 3\.4, or 4\.2 or newer"):
            registration.check_version(version)
    for version in ((3, 4, 1), (4, 2, 0), (4, 5, 3), (5, 2, 2)):
        registration.check_version(version)


def test_blender_is_told_the_same_oldest_versions() -> None:
    package = Path(registration.__file__).parents[1]
    if not ADDON.startswith("bl_ext."):  # Blender reads no bl_info of an extension
        assert sys.modules[ADDON].bl_info["blender"][:2] == registration.OLD
    oldest = ".".join(map(str, registration.NEW))
    assert f'blender_version_min = "{oldest}.0"' in (package / "blender_manifest.toml").read_text("utf-8")
