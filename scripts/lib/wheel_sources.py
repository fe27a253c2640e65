# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the C++ sources that wheels are built with into a folder: ``python wheel_sources.py FOLDER``.

Afterwards FOLDER/openmesh holds OpenMesh's sources (for SEAMWIRE_OPENMESH_SOURCES) and FOLDER/eigen Eigen's headers with their CMake
package (for Eigen3_ROOT). Runs on every system that wheels are built on; the packages and their checksums are in wheel-sources.txt.
"""

import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

REQUIREMENTS = Path(__file__).parent / "wheel-sources.txt"


def main() -> None:
    """Download and unpack, unless the folder is as this file and the list want it."""
    folder = Path(sys.argv[1])
    stamp = folder / "stamp"
    wanted = REQUIREMENTS.read_text("utf-8") + Path(__file__).read_text("utf-8")
    if stamp.exists() and stamp.read_text("utf-8") == wanted:
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as temporary:
        downloads = Path(temporary)
        pip = [sys.executable, "-m", "pip", "download", "-q", "--disable-pip-version-check"]
        # OpenMesh's sources are in the source package only.
        pip += ["--no-deps", "--no-binary", "openmesh", "-d", str(downloads), "-r", str(REQUIREMENTS)]
        subprocess.run(pip, check=True)
        (source,) = downloads.glob("openmesh-*.tar.gz")
        with tarfile.open(source) as archive:
            inside = f"{source.name.removesuffix('.tar.gz')}/OpenMesh/"
            wanted_files = (inside + "src/OpenMesh/Core/", inside + "LICENSE")
            for member in archive.getmembers():
                if member.isfile() and member.name.startswith(wanted_files):
                    target = folder / "openmesh" / member.name.removeprefix(inside)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    with archive.extractfile(member) as content:
                        target.write_bytes(content.read())
        (wheel,) = downloads.glob("cmeel_eigen-*.whl")
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(downloads / "eigen")
        shutil.move(downloads / "eigen" / "cmeel.prefix", folder / "eigen")
    stamp.write_text(wanted, "utf-8")


if __name__ == "__main__":
    main()
