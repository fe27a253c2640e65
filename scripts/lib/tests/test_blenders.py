# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender that cannot be had is skipped, one that was installed and does not start is a failure: scripts/blenders."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "blenders"

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or not Path("/usr/bin/blender").exists(), reason="scripts/setup was not here"
)


def get(cache: Path, name: str, **environment: str) -> tuple[int, str]:
    """Return the exit code and the line of ``scripts/blenders get NAME``."""
    done = subprocess.run(
        [SCRIPT, "get", name],
        env={**os.environ, "SEAMWIRE_BLENDERS": str(cache), **environment},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout.strip()


def test_one_that_does_not_start_is_a_failure(tmp_path: Path) -> None:
    # A file with the name of a library that Blender needs.
    libraries = tmp_path / "libraries"
    libraries.mkdir()
    (libraries / "libpython3.11.so.1.0").write_text("no library")
    code, line = get(tmp_path, "3.4", LD_LIBRARY_PATH=str(libraries))
    assert code == 1
    assert line.startswith("3.4: failed: it was installed, but does not start")
    assert not (tmp_path / "3.4").exists(), "so that it is tried anew"


def test_one_that_cannot_be_had_is_skipped(tmp_path: Path) -> None:
    code, line = get(tmp_path, "bpy-4.2", PIP_CONFIG_FILE=os.devnull, PIP_NO_INDEX="1")
    assert code == 75
    assert line.startswith("bpy-4.2: skipped: ")
    assert "bpy==4.2.*" in line, "the reason"
