# SPDX-License-Identifier: GPL-3.0-or-later
"""The package of Seamwire Lab, installed, used, disabled and removed as a user does it, with and without the tool."""

from pathlib import Path

import pytest
from blender import Blender, printed
from test_package import VALIDATE, without_traceback

ENABLE = """
import addon_utils
addon_utils.enable(ADDON + "_lab", default_set=True)
"""
"""Enables it in Blender as a Python module, which does not read the settings. Elsewhere it is enabled, and this changes nothing."""

STORE = f"""
import bpy
{ENABLE}
bpy.ops.mesh.primitive_monkey_add()
try:
    bpy.ops.mesh.seamwire_lab_store(view="CONCAVITY")
except RuntimeError as error:
    print("said:", str(error).strip())
values = bpy.context.object.data.attributes.get("concavity")
print("stored:", values is not None and len({{round(value.value, 3) for value in values.data}}) > 100)
"""

DISABLE = """
addon_utils.disable(ADDON + "_lab", default_set=True)
print("operator:", hasattr(bpy.types, "MESH_OT_seamwire_lab_store"))
print("settings:", hasattr(bpy.types.WindowManager, "seamwire_lab"))
"""


def test_blender_finds_it_valid(blender: Blender, lab_package: Path) -> None:
    if not blender.has_extensions:
        pytest.skip("this Blender does not validate packages")
    if blender.is_python_module:
        output = without_traceback(blender.run(VALIDATE.format(str(lab_package)), as_set_up=False))
        assert printed(output, "faults") == ["0"]
    else:
        output = without_traceback(blender.start("--command", "extension", "validate", str(lab_package)))
    assert "Success" in output


def test_installed_after_the_tool_it_stores_a_view_and_can_be_disabled(
    blender: Blender, package: Path, lab_package: Path
) -> None:
    blender.install(package)
    without_traceback(blender.install(lab_package, "seamwire_lab"))
    output = without_traceback(blender.run(STORE + DISABLE))
    assert printed(output, "stored") == ["True"]
    assert printed(output, "operator") == printed(output, "settings") == ["False"]


def test_without_the_tool_it_says_what_is_missing_and_works_once_that_is_installed(
    blender: Blender, package: Path, lab_package: Path
) -> None:
    without_traceback(blender.install(lab_package, "seamwire_lab"))
    if not blender.is_python_module:  # it would enable the tool
        output = blender.run(STORE)
        assert "Enable the add-on Seamwire" in printed(output, "said")[0]
        assert printed(output, "stored") == ["False"]
    without_traceback(blender.install(package))
    output = without_traceback(blender.run(STORE))
    assert printed(output, "stored") == ["True"]


def test_removed_it_leaves_nothing(blender: Blender, package: Path, lab_package: Path) -> None:
    blender.install(package)
    blender.install(lab_package, "seamwire_lab")
    without_traceback(blender.remove(STORE, "seamwire_lab"))
    left = [path for path in blender.user.rglob("*") if "seamwire_lab" in path.name]
    assert left == []
    output = without_traceback(
        blender.run("import bpy\nprint('operator:', hasattr(bpy.types, 'MESH_OT_seamwire_lab_store'))")
    )
    assert printed(output, "operator") == ["False"]
