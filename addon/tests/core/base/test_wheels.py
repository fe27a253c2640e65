# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled part comes out of the wheel that fits, and a sentence where none does."""

import sys
import sysconfig
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from seamwire.core.base import native

HERE = f"cp{sys.version_info.major}{sys.version_info.minor}"


@pytest.fixture(autouse=True)
def no_module(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A name that nothing else on the path has, because these tests load their own modules."""
    monkeypatch.setattr(native, "NAME", "seamwire_core_of_a_test")
    path = sys.path.copy()
    yield
    sys.modules.pop("seamwire_core_of_a_test", None)
    assert sys.path == path


def add_wheel(folder: Path, version: str = "0.1.0", python: str = HERE, platform: str | None = None) -> Path:
    """Write a wheel whose module is plain Python and knows its version."""
    platform = platform or sysconfig.get_platform().replace("-", "_").replace(".", "_")
    folder.mkdir(exist_ok=True)
    path = folder / f"seamwire_core-{version}-{python}-{python}-{platform}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(f"{native.NAME}.py", f'__version__ = "{version}"\n')
        archive.writestr(f"seamwire_core-{version}.dist-info/METADATA", "")
    return path


def test_the_fitting_wheel_is_unpacked_and_loaded(tmp_path: Path) -> None:
    wheels, folder = tmp_path / "wheels", tmp_path / "_native"
    add_wheel(wheels, python="cp30")
    add_wheel(wheels, platform="plan9_vax")
    fitting = add_wheel(wheels)
    module = native.load(folder, wheels)
    assert Path(module.__file__) == folder / fitting.stem / f"{native.NAME}.py"
    assert [path.name for path in folder.iterdir()] == [fitting.stem]


def test_it_is_unpacked_once(tmp_path: Path) -> None:
    wheels, folder = tmp_path / "wheels", tmp_path / "_native"
    first = native.load(folder, add_wheel(wheels).parent)
    written = Path(first.__file__).stat().st_mtime_ns
    del sys.modules[native.NAME]
    assert Path(native.load(folder, wheels).__file__).stat().st_mtime_ns == written


def test_a_loaded_module_of_another_version_asks_for_a_restart(tmp_path: Path) -> None:
    wheels, folder = tmp_path / "wheels", tmp_path / "_native"
    old = add_wheel(wheels)
    native.load(folder, wheels)
    old.unlink()
    add_wheel(wheels, version="0.2.0")
    with pytest.raises(native.NativeError, match=r"updated to 0\.2\.0 .* 0\.1\.0 .* restart Blender"):
        native.load(folder, wheels)
    del sys.modules[native.NAME]
    assert native.load(folder, wheels).__version__ == "0.2.0"


def test_a_package_for_other_systems_says_which_is_needed(tmp_path: Path) -> None:
    wheel = add_wheel(tmp_path / "wheels", python="cp30")
    with pytest.raises(native.NativeError, match="built for another Python or system") as caught:
        native.load(tmp_path / "_native", tmp_path / "wheels")
    assert wheel.name in str(caught.value)
    assert f"{sys.version_info.major}.{sys.version_info.minor}" in str(caught.value)


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    add_wheel(tmp_path / "wheels")
    (tmp_path / "_native").write_text("a file where the folder should be")
    with pytest.raises(native.NativeError, match="cannot unpack"):
        native.load(tmp_path / "_native", tmp_path / "wheels")


def test_a_damaged_module_says_why_it_does_not_load(tmp_path: Path) -> None:
    (tmp_path / f"{native.NAME}.py").write_text("import no_such_module_at_all\n")
    with pytest.raises(native.NativeError, match=r"does not load in this Blender .*no_such_module_at_all"):
        native.load(tmp_path, tmp_path / "wheels")
