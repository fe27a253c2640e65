# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on says without its compiled part, and what enabling it reads."""

import subprocess
from pathlib import Path

import bpy
import pytest
from scene import ADDON, add_grid, edit, seams
from seamwire.mesh import settings

pytestmark = pytest.mark.every_blender


def test_without_the_compiled_part_the_operator_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    from seamwire.core.base import native

    def fail() -> None:
        raise native.NativeError("no-build", name="seamwire_core", version="3.11", system="linux")

    monkeypatch.setattr(native, "load", fail)
    obj = add_grid(3)
    edit()
    with pytest.raises(RuntimeError, match="Seamwire's compiled part"):
        bpy.ops.mesh.seamwire_mark(chains="0 2")
    assert seams(obj) == []


def test_enabling_reads_neither_numpy_nor_the_compiled_part() -> None:
    if not bpy.app.binary_path:
        pytest.skip("Blender as a Python module cannot be started again")
    code = f"""
import sys, addon_utils
before = set(sys.modules)
assert addon_utils.enable({ADDON!r}) is not None
print("Read:", sorted(dict.fromkeys(name.split(".")[0] for name in set(sys.modules) - before)))
"""
    command = [
        bpy.app.binary_path,
        "--background",
        "--factory-startup",
        "--python-exit-code",
        "3",
        "--python-expr",
        code,
    ]
    output = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120).stdout
    read = next(line for line in output.splitlines() if line.startswith("Read:"))
    assert "numpy" not in read, "it takes longer than all else, and Blender's start would wait"
    assert "seamwire_core" not in read


def test_without_an_entry_in_the_preferences_there_are_defaults(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(settings, "ADDON", "seamwire_unlisted")  # as after `blender --addons seamwire`
    source, target = add_grid(5, name="Source"), add_grid(5, name="Target")
    edit()
    assert settings.settings().along == "AUTO"
    assert settings.preferences().line_width == 1.0
    bpy.ops.mesh.seamwire_mark(chains="10 14", objects="Source")
    assert bpy.ops.mesh.seamwire_store(what="ATTRIBUTE") == {"FINISHED"}
    assert bpy.ops.mesh.seamwire_transfer(source="Source") == {"FINISHED"}
    assert seams(target) == seams(source) != []
    path = tmp_path / "net.json"
    assert bpy.ops.mesh.seamwire_save_network(filepath=str(path)) == {"FINISHED"}
    assert path.exists()
