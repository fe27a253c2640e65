# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows keeps a library that is loaded from being overwritten or deleted: what is loaded is a copy, and an update asks for a restart."""

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
from seamwire.core.base import native
loaded = native.load(folder, wheels)
(file,) = folder.rglob("seamwire_core*.pyd")
file.write_bytes(b"")
shutil.rmtree(folder)
copy = Path(loaded.__file__)
try:
    copy.unlink()
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


IN_PLACE = """
import sys
from pathlib import Path
folder, wheels, addon = map(Path, sys.argv[1:])
sys.path[:] = [str(addon), *(entry for entry in sys.path if not list(Path(entry).glob("seamwire_core*")))]
from seamwire.core.base import native

def refuse(_):
    raise PermissionError("no right to write")

native._copied = refuse
print(Path(native.load(folder, wheels).__file__).is_relative_to(folder))
"""


TEMPORARY = "Анна Müller/Temp"
"""It is below the user's folder, whose name has any letters."""


def run(code: str, tmp_path: Path) -> list[str]:
    """Return the lines that the code printed in a Python with a separate temporary folder."""
    wheels, folder, temporary = tmp_path / "Räder und Nähte", tmp_path / "_native", tmp_path / TEMPORARY
    for made in (wheels, temporary / "seamwire_core-former"):
        made.mkdir(parents=True)
    shutil.copy(os.environ["SEAMWIRE_WHEEL"], wheels)
    arguments = [str(folder), str(wheels), str(Path(__file__).parents[3])]
    environment = {**os.environ, "TEMP": str(temporary), "TMP": str(temporary)}
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, encoding="utf-8", env=environment
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_an_update_of_what_is_loaded_asks_for_a_restart(tmp_path: Path) -> None:
    in_use, sentence = run(UPDATE, tmp_path)
    assert in_use == "it is in use"
    assert "was updated to 9.9.9 while its version" in sentence
    assert "restart Blender" in sentence
    (copy,) = (tmp_path / TEMPORARY).iterdir()
    assert copy.name != "seamwire_core-former", "copies that nobody uses are removed"


def test_where_no_copy_can_be_written_the_library_is_loaded_in_place(tmp_path: Path) -> None:
    assert run(IN_PLACE, tmp_path) == ["True"]
