# SPDX-License-Identifier: GPL-3.0-or-later
"""Another Blender with its own settings, started by a test."""

import os
import subprocess
import sys

import bpy
import pytest
from scene import ADDON

# An extension is enabled without its wheels: Blender would remove them from a folder that the Blenders of other tests share.
_ARGUMENTS = ", refresh_handled=True" if ADDON.startswith("bl_ext.") else ""
_ENABLE = f"""
import addon_utils
def enable(addon):
    assert addon_utils.enable(addon{_ARGUMENTS}) is not None
"""


def run_fresh(code: str, *options: str, **environment: str) -> str:
    """Run code in a Blender that knows no add-on; return what it printed. The code enables add-ons with ``enable(name)``."""
    if not bpy.app.binary_path:
        pytest.skip("Blender as a Python module cannot be started again")
    command = [bpy.app.binary_path, "--background", "--factory-startup", *options, "--python-exit-code", "3"]
    done = subprocess.run(
        [*command, "--python-expr", _ENABLE + code],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
    )
    sys.stderr.write(done.stderr)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
