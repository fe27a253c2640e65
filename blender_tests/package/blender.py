# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender to install the package in, with separate user folders. Used from outside Blender.

``python blender.py PROGRAM NAME USER PACKAGE...`` installs packages there and enables the add-ons.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SECONDS = 120


class Blender:
    """A Blender whose add-ons and settings live in a folder made for it.

    Parameters
    ----------
    program
        What runs it: it takes Blender's arguments.
    name
        As in ``scripts/blenders``: 3.4, 4.3, bpy-4.2, windows-4.2, ...
    user
        Its user folder.
    """

    def __init__(self, program: Path, name: str, user: Path) -> None:
        self.program = program
        self.user = user
        self.is_windows = name.startswith("windows-")
        self.is_python_module = self.is_windows or name.startswith("bpy-")
        self.has_extensions = name != "3.4"
        self.addon = "bl_ext.user_default.seamwire" if self.has_extensions else "seamwire"
        for folder in ("config", "scripts", "datafiles", "extensions"):
            (user / folder).mkdir(parents=True, exist_ok=True)

    @property
    def addon_folder(self) -> Path:
        """Where the package's files go."""
        return self.user / ("extensions/user_default/seamwire" if self.has_extensions else "scripts/addons/seamwire")

    def start(self, *arguments: str) -> str:
        """Start it with these arguments, wait for its end, and return what it printed, errors too; its exit code must be 0."""
        code, output = self.try_start(*arguments)
        assert code == 0, f"exit code {code}: {output}"
        return output

    def try_start(self, *arguments: str) -> tuple[int, str]:
        """Start it, and return its exit code and what it printed."""
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("BLENDER_", "PYTHON"))}
        for folder in ("config", "scripts", "datafiles", "extensions"):
            environment[f"BLENDER_USER_{folder.upper()}"] = str(self.user / folder)
        process = subprocess.run(
            [self.program, *arguments],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=SECONDS,
            check=False,
        )
        return process.returncode, process.stdout

    def run(self, code: str, *, as_set_up: bool = True) -> str:
        """Run Python code in the background and return what it printed: with the user's settings, or with Blender's own.

        The code finds the add-on's name as ADDON. Blender as a Python module always starts with its own settings: where the user's are
        wanted, the add-on is enabled first.
        """
        before = f"ADDON = {self.addon!r}\n"
        if self.is_python_module and as_set_up:
            before += "import addon_utils\nassert addon_utils.enable(ADDON, default_set=True) is not None\n"
        with tempfile.TemporaryDirectory(prefix="seamwire-test-") as folder:
            file = Path(folder) / "code.py"
            file.write_text(before + code)
            settings = [] if as_set_up else ["--factory-startup"]
            return self.start("--background", *settings, "--python-exit-code", "3", "--python", str(file))

    def install(self, package: Path, addon: str = "seamwire") -> str:
        """Install the package of an add-on and enable it, as a user does. Returns what Blender printed."""
        code, output = self.try_install(package, addon)
        assert code == 0, f"exit code {code}: {output}"
        return output

    def try_install(self, package: Path, addon: str = "seamwire") -> tuple[int, str]:
        """Install the package; return Blender's exit code and what it printed."""
        if self.has_extensions and not self.is_python_module:
            return self.try_start("--command", "extension", "install-file", "-r", "user_default", "-e", str(package))
        if self.has_extensions:
            code = (
                f"bpy.ops.extensions.package_install_files(filepath={str(package)!r}, repo='user_default',"
                " enable_on_install=True)"
            )
        else:
            code = (
                f"bpy.ops.preferences.addon_install(filepath={str(package)!r}, overwrite=True);"
                f"bpy.ops.preferences.addon_enable(module={addon!r});"
                "bpy.ops.wm.save_userpref()"
            )
        return self.try_start("--background", "--python-exit-code", "3", "--python-expr", f"import bpy; {code}")

    def remove(self, after: str = "", addon: str = "seamwire") -> str:
        """Uninstall an add-on, as a user does; in the Blender that ran the code `after`, if there is any."""
        if self.has_extensions and not self.is_python_module and not after:
            return self.start("--command", "extension", "remove", f"user_default.{addon}")
        if self.has_extensions:
            code = (
                "import bpy\n"
                "repos = [repo.module for repo in bpy.context.preferences.extensions.repos]\n"
                f"bpy.ops.extensions.package_uninstall(repo_index=repos.index('user_default'), pkg_id={addon!r})\n"
                "bpy.ops.wm.save_userpref()\n"
            )
        else:
            # The operator redraws the area that its button is in.
            code = (
                "import bpy\n"
                "window = bpy.context.window_manager.windows[0]\n"
                "with bpy.context.temp_override(window=window, area=window.screen.areas[0]):\n"
                f"    bpy.ops.preferences.addon_remove(module={addon!r})\n"
                "bpy.ops.wm.save_userpref()\n"
            )
        return self.run(after + code)

    def path(self, printed: str) -> Path:
        """Return the path that this Blender printed as one of this system."""
        if not self.is_windows:
            return Path(printed)
        drive, inside = printed.split(":", 1)
        roots = {"Z": "", "C": str(self.program.parent / "prefix" / "drive_c")}
        return Path(roots[drive] + inside.replace("\\", "/"))


def printed(output: str, name: str) -> list[str]:
    """Return what the lines ``name: ...`` say, in order."""
    return re.findall(rf"^{name}: (.*)$", output, re.M)


if __name__ == "__main__":
    _program, _name, _user, *_packages = sys.argv[1:]
    for _package in map(Path, _packages):
        Blender(Path(_program), _name, Path(_user)).install(_package, _package.name.split("-")[0])
