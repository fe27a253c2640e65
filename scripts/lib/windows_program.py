#!/usr/bin/python3 -P
# SPDX-License-Identifier: GPL-3.0-or-later
"""A Windows Python under Wine, behind a command line of this system: ``windows_program.py FOLDER [ARGUMENT OF PYTHON...]``.

FOLDER is one that ``scripts/lib/make_windows_python`` made. If arguments and the environment name files of this system by their whole
path, the program gets Windows' names of them. Its output, errors included, appears on the standard output, with the line ends of this
system. The exit code is that of the program.
"""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

_PATH = re.compile(r"^((?:--?[a-z-]+=)?)(/.*)$")


def windows_name(text: str) -> str:
    """Return the text with Windows' name in place of a whole path, alone or as the value of an option."""
    match = _PATH.match(text)
    if match is None or not Path(match[2].partition("::")[0]).parent.is_dir():
        return text
    return f"{match[1]}Z:" + match[2].replace("/", "\\")


def windows_environment(folder: Path) -> dict[str, str]:
    """Return the environment for a program in that folder's Windows."""
    names = {
        name: windows_name(value)
        for name, value in os.environ.items()
        if name.startswith(("BLENDER_", "SEAMWIRE_", "PYTHONPATH"))
    }
    own = {
        "WINEPREFIX": str(folder / "prefix"),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree,mshtml=",
        "PYTHONUTF8": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    kept = ("PATH", "HOME", "LANG", "LC_ALL")
    return {name: os.environ[name] for name in kept if name in os.environ} | names | own


def main() -> int:
    """Run the program; return its exit code."""
    folder = Path(sys.argv[1])
    arguments = [str(folder / "python" / "python.exe"), *map(windows_name, sys.argv[2:])]
    # Python has no standard streams there where they are files.
    with subprocess.Popen(
        ["wine", *arguments],
        env=windows_environment(folder),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ) as process:
        signal.signal(signal.SIGTERM, lambda *_: process.kill())
        for line in process.stdout:
            sys.stdout.buffer.write(line.replace(b"\r\n", b"\n"))
            sys.stdout.buffer.flush()
    return process.returncode


if __name__ == "__main__":
    sys.exit(main())
