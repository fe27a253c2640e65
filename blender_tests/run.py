# SPDX-License-Identifier: GPL-3.0-or-later
"""Run pytest inside Blender: ``blender [--background] --factory-startup --python blender_tests/run.py -- PYTEST_ARGUMENTS``.

Expects the environment that ``scripts/blender-test`` sets: SEAMWIRE_BLENDER_PACKAGES, the folder that holds pytest and greenlet, and
BLENDER_USER_SCRIPTS, the folder that holds the add-on. SEAMWIRE_ADDON is the add-on's name where Blender gave it another one than
``seamwire``, as it does to extensions; the tests import it as ``seamwire`` all the same.

In the background pytest simply runs; with a window in turns with Blender (see ``turns.py``). Tests are plain functions in both cases.
"""

import faulthandler
import importlib
import os
import pkgutil
import sys
import traceback
from pathlib import Path

sys.path.insert(0, os.environ["SEAMWIRE_BLENDER_PACKAGES"])
sys.path.insert(0, str(Path(__file__).parent))

import addon_utils
import bpy
import pytest
from progress import plugins
from turns import leave, play

ADDON = os.environ.get("SEAMWIRE_ADDON", "seamwire")


def enable_addon() -> None:
    """Enable the add-on and fail loudly where Blender would only print."""
    failures: list[str] = []
    module = addon_utils.enable(ADDON, default_set=True, handle_error=lambda _: failures.append(traceback.format_exc()))
    if module is None or failures:
        sys.stderr.write(f"The add-on {ADDON} could not be enabled.\n" + "".join(failures))
        leave(3)
    for part in pkgutil.walk_packages(module.__path__, f"{ADDON}."):
        importlib.import_module(part.name)
    for name in [name for name in sys.modules if name == ADDON or name.startswith(f"{ADDON}.")]:
        sys.modules["seamwire" + name.removeprefix(ADDON)] = sys.modules[name]


def run_pytest() -> int:
    """Run pytest with the arguments after ``--`` and return its exit code."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    options = ["-p", "no:cacheprovider", "--strict-markers"]
    return int(pytest.main([*options, *arguments], plugins(has_limit=not bpy.app.background)))


faulthandler.enable()
enable_addon()
if bpy.app.background:
    leave(run_pytest())
# Blender smooths the view by drawing it eight times, and here the processor draws: it took two thirds of the tests' time.
bpy.context.preferences.system.viewport_aa = "OFF"
play(run_pytest)
