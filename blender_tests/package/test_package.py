# SPDX-License-Identifier: GPL-3.0-or-later
"""The package, installed, updated and removed as a user does it, in user folders that nobody used before."""

import io
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from blender import Blender, printed

MARK = """
import bpy, importlib
bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4)
bpy.ops.object.mode_set(mode="EDIT")
importlib.import_module(ADDON).mark(bpy.context.object, [[0, 2]])
bpy.ops.object.mode_set(mode="OBJECT")
mesh = bpy.context.object.data
print("marked:", sorted(tuple(sorted(edge.vertices)) for edge in mesh.edges if edge.use_seam))
"""
MARKED = "[(0, 1), (1, 2)]"
"""Two edges of the grid's border, the straight way between their ends."""

ABSENT = """
import bpy, importlib.util
print("operator:", hasattr(bpy.types, "MESH_OT_seamwire_finish"))
print("enabled:", ADDON in bpy.context.preferences.addons)
"""


def changed(package: Path, target: Path, file: str, change: Callable[[str], str]) -> Path:
    """Write a copy of the package with one text file of it changed."""
    with zipfile.ZipFile(package) as source, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as copy:
        for entry in source.infolist():
            content = source.read(entry)
            if entry.filename == f"seamwire/{file}":
                before = content.decode()
                after = change(before)
                assert after != before
                content = after.encode()
            copy.writestr(entry.filename, content)
    return target


def without_traceback(output: str) -> str:
    """Return the output, which must hold no traceback."""
    assert "Traceback" not in output, output
    return output


VALIDATE = """
from bl_pkg.cli import blender_ext
print("faults:", blender_ext.main(["validate", {!r}]))
"""


def test_blender_finds_the_package_valid(blender: Blender, package: Path) -> None:
    if not blender.has_extensions:
        pytest.skip("this Blender does not validate packages")
    if blender.is_python_module:
        # It takes no commands; what they run is there.
        output = without_traceback(blender.run(VALIDATE.format(str(package)), as_set_up=False))
        assert printed(output, "faults") == ["0"]
    else:
        output = without_traceback(blender.start("--command", "extension", "validate", str(package)))
    assert "Success" in output
    # Blender itself warns of a system without a list of disks, as in a chroot.
    own = [line for line in output.splitlines() if "mounted file-systems" not in line]
    assert "warning" not in "\n".join(own).lower()


def test_installed_it_is_there_after_a_restart_and_marks_seams(installed: Blender) -> None:
    output = without_traceback(installed.run(MARK))
    assert printed(output, "marked") == [MARKED]


def test_its_own_compiled_part_is_what_runs(installed: Blender) -> None:
    output = installed.run(MARK + "import seamwire_core; print('file:', seamwire_core.__file__)")
    (file,) = map(installed.path, printed(output, "file"))
    if installed.is_windows:
        # There it is a copy, so that Blender can overwrite and remove what it installed.
        assert not file.is_relative_to(installed.user)
        (file,) = (path for path in installed.user.rglob(file.name) if path.read_bytes() == file.read_bytes())
    assert file.is_relative_to(installed.user)


@pytest.mark.parametrize("is_in_use", [False, True])
def test_removed_it_leaves_nothing(blender: Blender, package: Path, is_in_use: bool) -> None:
    blender.install(package)
    if is_in_use:
        without_traceback(blender.remove(MARK))
    else:
        blender.run(MARK)
        without_traceback(blender.remove())
    # Blender as a Python module does not read the settings: there the add-on is simply not enabled.
    output = without_traceback(blender.run(ABSENT, as_set_up=not blender.is_python_module))
    assert printed(output, "operator") == ["False"]
    assert printed(output, "enabled") == ["False"]
    assert not blender.addon_folder.exists()
    left = [path for path in blender.user.rglob("*") if "seamwire" in path.name]
    assert left == []


def test_a_later_version_takes_the_place_of_the_one_before(blender: Blender, package: Path, tmp_path: Path) -> None:
    """The new version's parts run, not those that the old one left in memory or on disk."""
    blender.install(package)
    assert printed(blender.run(MARK), "marked") == [MARKED]
    (blender.addon_folder / "left_over_from_the_old_version.py").write_text("")
    later = later_version(package, tmp_path)
    without_traceback(blender.install(later))
    output = without_traceback(blender.run(MARK + VERSION))
    assert printed(output, "marked") == [MARKED]
    assert printed(output, "label") == ["Mark Later"]
    assert not (blender.addon_folder / "left_over_from_the_old_version.py").exists()


VERSION = """
print("label:", bpy.ops.mesh.seamwire_finish.get_rna_type().name)
"""


LATER = "0.9.9"


def later_version(package: Path, folder: Path) -> Path:
    """Make a package of the later version whose operator has another label."""
    label = re.compile(r'(bl_idname = "mesh\.seamwire_finish"\s+bl_label = )"[^"]*"')
    step = changed(
        package, folder / "1.zip", "operators/seam_operators.py", lambda text: label.sub(r'\1"Mark Later"', text)
    )
    step = changed(
        step,
        folder / "2.zip",
        "__init__.py",
        lambda text: re.sub(r'"version": \(.*\)', f'"version": ({LATER.replace(".", ", ")})', text),
    )
    return changed(
        step,
        folder / f"seamwire-{LATER}.zip",
        "blender_manifest.toml",
        lambda text: re.sub(r'^version = ".*"', f'version = "{LATER}"', text, flags=re.M),
    )


def update_command(blender: Blender, package: Path) -> str:
    """Return what installs the package over the one that runs."""
    if blender.has_extensions:
        return (
            f"bpy.ops.extensions.package_install_files(filepath={str(package)!r}, repo='user_default', overwrite=True,"
            " enable_on_install=True)\n"
        )
    return (
        f"bpy.ops.preferences.addon_install(filepath={str(package)!r}, overwrite=True)\n"
        "bpy.ops.preferences.addon_enable(module='seamwire')\n"
    )


def test_updating_while_blender_runs_brings_the_new_version_without_a_restart(
    blender: Blender, package: Path, tmp_path: Path
) -> None:
    blender.install(package)
    update = update_command(blender, later_version(package, tmp_path))
    again = MARK.replace("import bpy\n", "bpy.ops.wm.read_homefile(use_empty=True)\n")
    output = without_traceback(blender.run(MARK + update + again + VERSION))
    assert printed(output, "marked") == [MARKED, MARKED]
    assert printed(output, "label") == ["Mark Later"]


def with_later_compiled_part(package: Path, later: Path, target: Path) -> Path:
    """Write a copy of a later package with a later compiled part, by its wheel's name and by what it says of itself."""
    now = package.name.split("-")[1]
    with zipfile.ZipFile(later) as source, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as copy:
        for entry in source.infolist():
            content = source.read(entry)
            if entry.filename.endswith(".whl"):
                content = later_wheel(content, now)
            elif entry.filename.endswith("blender_manifest.toml"):
                content = content.replace(f"seamwire_core-{now}-".encode(), f"seamwire_core-{LATER}-".encode())
            copy.writestr(entry.filename.replace(f"seamwire_core-{now}-", f"seamwire_core-{LATER}-"), content)
    return target


def later_wheel(content: bytes, now: str) -> bytes:
    """Return a wheel of this version as one of the later version."""
    said, says = (f"\0{version}\0".encode() for version in (now, LATER))
    assert len(said) == len(says)
    written = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as source, zipfile.ZipFile(written, "w") as copy:
        for entry in source.infolist():
            part = source.read(entry)
            if Path(entry.filename).suffix in {".so", ".pyd"}:
                assert part.count(said) == 1
                part = part.replace(said, says)
            copy.writestr(
                entry.filename.replace(f"-{now}.", f"-{LATER}."),
                part.replace(f"-{now}.".encode(), f"-{LATER}.".encode()),
            )
    return written.getvalue()


def test_an_update_of_a_compiled_part_in_use_asks_for_a_restart_and_works_after_it(
    blender: Blender, package: Path, tmp_path: Path
) -> None:
    """No system lets go of a loaded library, and Windows does not let it be overwritten or deleted either."""
    blender.install(package)
    later = with_later_compiled_part(package, later_version(package, tmp_path), tmp_path / "compiled.zip")
    again = TRY.replace("import bpy\n", "bpy.ops.wm.read_homefile(use_empty=True)\n")
    output = blender.run(MARK + update_command(blender, later) + again)
    assert printed(output, "marked") == [MARKED]
    (said,) = printed(output, "said")
    assert f"was updated to {LATER} while its version" in said
    assert "restart Blender" in said
    output = without_traceback(blender.run(MARK + VERSION))
    assert printed(output, "marked") == [MARKED]
    assert printed(output, "label") == ["Mark Later"]


def test_a_package_for_another_system_is_refused_in_words(blender: Blender, package: Path, tmp_path: Path) -> None:
    if not blender.has_extensions:
        pytest.skip("add-ons of this Blender do not tell what they run on")
    system = package.stem.split("-", 2)[2]
    other = changed(
        package,
        tmp_path / "other.zip",
        "blender_manifest.toml",
        lambda text: text.replace(f'"{system}"', '"windows-arm64"'),
    )
    _, output = blender.try_install(other)
    assert not blender.addon_folder.exists()
    if blender.is_windows:
        pytest.skip("it was refused; under Wine the words of Blender's installer do not reach the operator")
    assert re.search(
        rf"This platform \({system}\) isn't one of \(windows-arm64\)", without_traceback_but_ours(output)
    ), output


def without_traceback_but_ours(output: str) -> str:
    """Return the output, whose only traceback may be that of the test's own call of an operator that failed."""
    return re.sub(r"Traceback \(most recent call last\):\n  File \"<(?:string|--python-expr)>\".*\n", "", output)


TRY = """
import bpy
bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4)
bpy.ops.object.mode_set(mode="EDIT")
try:
    bpy.ops.mesh.seamwire_close_gaps()
except RuntimeError as error:
    print("said:", str(error).strip())
"""


def for_another_python(package: Path, target: Path) -> Path:
    """Write a copy of the package with one wheel, for a Python that no Blender has."""
    with zipfile.ZipFile(package) as source, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as copy:
        wheels = [entry for entry in source.infolist() if entry.filename.endswith(".whl")]
        name = re.sub(r"cp3\d+-cp3\d+", "cp399-cp399", wheels[0].filename)
        for entry in source.infolist():
            if entry not in wheels and not entry.filename.endswith("blender_manifest.toml"):
                copy.writestr(entry.filename, source.read(entry))
        copy.writestr(name, source.read(wheels[0]))
        manifest = source.read("seamwire/blender_manifest.toml").decode()
        own = name.removeprefix("seamwire/")
        copy.writestr(
            "seamwire/blender_manifest.toml",
            re.sub(r"wheels = \[.*\]", f'wheels = ["./{own}"]', manifest, flags=re.DOTALL),
        )
    return target


def test_a_package_for_another_python_says_so_in_words(blender: Blender, package: Path, tmp_path: Path) -> None:
    """Blender itself refuses to enable such an extension; as an add-on it is our operator that has to say it."""
    _, output = blender.try_install(for_another_python(package, tmp_path / "other.zip"))
    if blender.has_extensions:
        assert re.search(r"Python version \(3\.\d+\) isn't compatible with \(3\.99\)", output), output
        return
    output = without_traceback(output + blender.run(TRY))
    (said,) = printed(output, "said")
    assert "built for another Python or system" in said
