# SPDX-License-Identifier: GPL-3.0-or-later
"""What the packages of all systems hold."""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path, PurePosixPath

import pytest
import tomllib

sys.path.insert(0, str(Path(__file__).parents[1]))

import check_wheel
import pack_addon

VERSION = pack_addon.versions()["pyproject.toml"]


def add_wheel(folder: Path, python: str, tag: str, version: str = VERSION) -> Path:
    path = folder / f"seamwire_core-{version}-cp{python}-cp{python}-{tag}.whl"
    path.write_text(path.name)
    return path


@pytest.mark.parametrize("platform", check_wheel.TAGS)
def test_a_package_is_for_its_system_and_brings_the_wheels_that_it_names(tmp_path: Path, platform: str) -> None:
    wheels = [add_wheel(tmp_path, python, check_wheel.TAGS[platform]) for python in ("310", "313")]
    without_blender = add_wheel(tmp_path, "312", check_wheel.TAGS[platform])
    package = pack_addon.pack(tmp_path, [*wheels, without_blender], [platform])
    assert package.name == f"seamwire-{VERSION}-{platform}.zip"
    with zipfile.ZipFile(package) as archive:
        manifest = tomllib.loads(archive.read("seamwire/blender_manifest.toml").decode())
        assert (manifest["version"], manifest["platforms"]) == (VERSION, [platform])
        brought = [archive.read(str(PurePosixPath("seamwire") / name)).decode() for name in manifest["wheels"]]
        assert brought == [wheel.name for wheel in wheels]
        names = set(archive.namelist())
    assert {"seamwire/", "seamwire/__init__.py", "seamwire/LICENSE", "seamwire/core/base/native.py"} <= names
    assert all(name.startswith("seamwire/") for name in names)
    assert not any("__pycache__" in name or "_native" in name for name in names)


@pytest.mark.parametrize("name", ["seamwire_lab", "seamwire_networks"])
def test_another_add_on_is_packed_for_all_systems(tmp_path: Path, name: str) -> None:
    package = pack_addon.pack_other(tmp_path, pack_addon.ROOT / "addon" / name)
    assert package.name == f"{name}-{VERSION}.zip"
    with zipfile.ZipFile(package) as archive:
        manifest = tomllib.loads(archive.read(f"{name}/blender_manifest.toml").decode())
        names = archive.namelist()
    assert (manifest["id"], manifest["version"]) == (name, VERSION)
    assert "platforms" not in manifest
    assert {f"{name}/", f"{name}/__init__.py", f"{name}/LICENSE"} <= set(names)
    assert len(set(names)) == len(names)
    assert not any("__pycache__" in name for name in names)


def test_wheels_of_another_version_are_not_packed(tmp_path: Path) -> None:
    wheel = add_wheel(tmp_path, "311", "win_amd64", version="0.0.1")
    with pytest.raises(SystemExit, match=f"not wheels of seamwire_core {VERSION}: {wheel.name}"):
        pack_addon.pack(tmp_path, [wheel], ["windows-x64"])
    assert list(tmp_path.glob("*.zip")) == []
