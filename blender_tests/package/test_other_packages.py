# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages of Seamwire Lab and Seamwire Networks: installed before and after the tool, used, disabled and removed as a user does it."""

from pathlib import Path

import pytest
from blender import Blender, printed
from test_package import VALIDATE, without_traceback

ENABLE = """
import addon_utils
addon_utils.enable(ADDON + "{0}", default_set=True)
"""
"""Enables it in Blender as a Python module, which does not read the settings. Elsewhere it is enabled, and this changes nothing."""

USES = {
    "seamwire_lab": """
import bpy
bpy.ops.mesh.primitive_monkey_add()
bpy.ops.mesh.seamwire_lab_store(view="CONCAVITY")
values = bpy.context.object.data.attributes["concavity"]
print("works:", len({round(value.value, 3) for value in values.data}) > 100)
""",
    "seamwire_networks": """
import bpy, importlib, pathlib, tempfile
bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4)
bpy.ops.object.mode_set(mode="EDIT")
importlib.import_module(ADDON).mark(bpy.context.object, [[0, 2]])
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "net.json"
    bpy.ops.mesh.seamwire_save_network(filepath=str(file))
    bpy.ops.mesh.mark_seam(clear=True)
    bpy.ops.mesh.seamwire_load_network(filepath=str(file))
bpy.ops.object.mode_set(mode="OBJECT")
print("works:", sum(edge.use_seam for edge in bpy.context.object.data.edges) == 2)
""",
}
"""What prints "works: True" if the add-on works."""
OPERATORS = {"seamwire_lab": "lab_store", "seamwire_networks": "transfer"}


def use(name: str) -> str:
    return ENABLE.format(name.removeprefix("seamwire")) + USES[name]


def is_there(name: str) -> str:
    return f"import bpy\nprint('operator:', hasattr(bpy.types, 'MESH_OT_seamwire_{OPERATORS[name]}'))\n"


@pytest.fixture(params=USES)
def name(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def other(name: str, other_packages: dict[str, Path]) -> Path:
    """The package of the add-on."""
    return other_packages[name]


def test_blender_finds_it_valid(blender: Blender, other: Path) -> None:
    if not blender.has_extensions:
        pytest.skip("this Blender does not validate packages")
    if blender.is_python_module:
        output = without_traceback(blender.run(VALIDATE.format(str(other)), as_set_up=False))
        assert printed(output, "faults") == ["0"]
    else:
        output = without_traceback(blender.start("--command", "extension", "validate", str(other)))
    assert "Success" in output


def test_installed_after_the_tool_it_works_and_can_be_disabled(
    blender: Blender, package: Path, name: str, other: Path
) -> None:
    blender.install(package)
    without_traceback(blender.install(other, name))
    disable = f"addon_utils.disable(ADDON + {name.removeprefix('seamwire')!r}, default_set=True)\n"
    output = without_traceback(blender.run(use(name) + disable + is_there(name)))
    assert printed(output, "works") == ["True"]
    assert printed(output, "operator") == ["False"]


def test_without_the_tool_it_waits_and_works_once_that_is_installed(
    blender: Blender, package: Path, name: str, other: Path
) -> None:
    without_traceback(blender.install(other, name))
    if not blender.is_python_module:  # it would enable the tool
        assert printed(without_traceback(blender.run(is_there(name))), "operator") == ["False"]
    without_traceback(blender.install(package))
    output = without_traceback(blender.run(use(name)))
    assert printed(output, "works") == ["True"]


def test_removed_it_leaves_nothing(blender: Blender, package: Path, name: str, other: Path) -> None:
    blender.install(package)
    blender.install(other, name)
    without_traceback(blender.remove(use(name), name))
    left = [path for path in blender.user.rglob("*") if name in path.name]
    assert left == []
    output = without_traceback(blender.run(is_there(name)))
    assert printed(output, "operator") == ["False"]
