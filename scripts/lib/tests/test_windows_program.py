# SPDX-License-Identifier: GPL-3.0-or-later
"""How files are named for a program that runs under Wine."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

import windows_program


def test_whole_paths_get_windows_names(tmp_path: Path) -> None:
    inside = str(tmp_path).replace("/", "\\")
    name = windows_program.windows_name
    assert name(f"{tmp_path}/tests") == f"Z:{inside}\\tests"
    assert name(f"{tmp_path}/Nähte & Küche/test.py::test") == f"{tmp_path}/Nähte & Küche/test.py::test", (
        "no such folder"
    )
    (tmp_path / "Nähte & Küche").mkdir()
    assert name(f"{tmp_path}/Nähte & Küche/test.py::test") == f"Z:{inside}\\Nähte & Küche\\test.py::test"
    assert name(f"--junitxml={tmp_path}/report.xml") == f"--junitxml=Z:{inside}\\report.xml"


@pytest.mark.parametrize(
    "text", ["-q", "blender_tests/run.py", "0 2", "/no folder/of this/system", "import bpy; print('/tmp')"]
)
def test_other_arguments_stay(text: str) -> None:
    assert windows_program.windows_name(text) == text


def test_the_environment_has_what_the_tests_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BLENDER_USER_CONFIG", str(tmp_path))
    monkeypatch.setenv("SEAMWIRE_ADDON", "bl_ext.user_default.seamwire")
    monkeypatch.setenv("LD_LIBRARY_PATH", str(tmp_path))
    environment = windows_program.windows_environment(tmp_path)
    assert environment["BLENDER_USER_CONFIG"] == "Z:" + str(tmp_path).replace("/", "\\")
    assert environment["SEAMWIRE_ADDON"] == "bl_ext.user_default.seamwire"
    assert environment["WINEPREFIX"] == str(tmp_path / "prefix")
    assert "LD_LIBRARY_PATH" not in environment
