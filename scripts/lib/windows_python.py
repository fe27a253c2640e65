# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts a Python for Windows x64 into a folder: ``windows_python.py PYTHON FOLDER``, such as 3.11.

FOLDER then has the DLLs, beside pythonXY.dll also pythonXY.def, a list of what that exports, to make an import library of, and in
FOLDER/DLLs Python's own extension modules. There is no python.exe, and no standard library. The package and its checksums are in
windows-python.txt.
"""

import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from binaries import read_portable

REQUIREMENTS = Path(__file__).parent / "windows-python.txt"


def main() -> None:
    """Download and unpack, unless the folder is as this file and the list want it."""
    python, folder = sys.argv[1], Path(sys.argv[2])
    stamp = folder / "stamp"
    wanted = REQUIREMENTS.read_text() + Path(__file__).read_text()
    if stamp.exists() and stamp.read_text() == wanted:
        return
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "DLLs").mkdir(parents=True)
    with tempfile.TemporaryDirectory() as downloads:
        pip = [sys.executable, "-m", "pip", "download", "-q", "--disable-pip-version-check", "--no-deps"]
        pip += ["--only-binary=:all:", "--implementation", "cp", "--python-version", python, "--platform", "win_amd64"]
        subprocess.run([*pip, "-d", downloads, "-r", str(REQUIREMENTS)], check=True)
        (wheel,) = Path(downloads).glob("*.whl")
        with zipfile.ZipFile(wheel) as archive:
            for name in archive.namelist():
                file = Path(name)
                if file.parent.name == "deploy_libs" and ".cp" not in file.stem:
                    target = folder / ("DLLs" if file.suffix == ".pyd" else "") / file.name
                    target.write_bytes(archive.read(name))
    library = f"python{python.replace('.', '')}"
    exports = read_portable(folder / f"{library}.dll").exports
    (folder / f"{library}.def").write_text("\n".join([f"LIBRARY {library}.dll", "EXPORTS", *exports, ""]))
    stamp.write_text(wanted)


if __name__ == "__main__":
    main()
