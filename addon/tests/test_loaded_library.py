# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows keeps a library that is loaded from being overwritten or deleted: an update says what to do then."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = [
    pytest.mark.skipif(sys.platform != "win32", reason="about Windows; scripts/wine runs it"),
    pytest.mark.skipif("SEAMWIRE_WHEEL" not in os.environ, reason="SEAMWIRE_WHEEL names no wheel for Windows"),
]

UPDATE = """
import shutil, sys
from pathlib import Path
folder, wheels, addon = map(Path, sys.argv[1:])
sys.path[:] = [str(addon), *(entry for entry in sys.path if not list(Path(entry).glob("seamwire_core*")))]
from seamwire.core import native
loaded = native.load(folder, wheels)
file = Path(loaded.__file__)
try:
    file.unlink()
    print("it was deleted")
except PermissionError:
    print("it is in use")
assert native.load(folder, wheels) is loaded
(wheel,) = wheels.glob("*.whl")
wheel.rename(wheels / wheel.name.replace(f"-{loaded.__version__}-", "-9.9.9-"))
try:
    native.load(folder, wheels)
except native.NativeError as error:
    print(error)
"""


def test_an_update_of_what_is_loaded_asks_for_a_restart(tmp_path: Path) -> None:
    wheels, folder = tmp_path / "Räder und Nähte", tmp_path / "_native"
    wheels.mkdir()
    shutil.copy(os.environ["SEAMWIRE_WHEEL"], wheels)
    arguments = [str(folder), str(wheels), str(Path(__file__).parents[1])]
    done = subprocess.run([sys.executable, "-c", UPDATE, *arguments], capture_output=True, text=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    in_use, sentence = done.stdout.splitlines()
    assert in_use == "it is in use"
    assert "was updated to 9.9.9 while its version" in sentence
    assert "restart Blender" in sentence
