# SPDX-License-Identifier: GPL-3.0-or-later
"""Run pytest inside Blender: ``blender [--background] --factory-startup --python blender_tests/run.py -- PYTEST_ARGUMENTS``.

Expects the environment that ``scripts/blender-test`` sets: SEAMWIRE_BLENDER_PACKAGES, the folder that holds pytest and greenlet, and
BLENDER_USER_SCRIPTS, the folder that holds the add-on. SEAMWIRE_ADDON is the add-on's name where Blender gave it another one than
``seamwire``, as it does to extensions; the tests import it as ``seamwire`` all the same, and Seamwire Networks as ``seamwire_networks``.

In the background pytest simply runs; with a window in turns with Blender (see ``turns.py``). Tests are plain functions in both cases.
"""

import faulthandler
import os
import sys
from pathlib import Path

sys.path.insert(0, os.environ["SEAMWIRE_BLENDER_PACKAGES"])
sys.path.insert(0, str(Path(__file__).parent))

import bpy
import pytest
from enabling import enable_addons
from progress import plugins
from turns import leave, play


def run_pytest() -> int:
    """Run pytest with the arguments after ``--`` and return its exit code."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    options = ["-p", "no:cacheprovider", "--strict-markers"]
    return int(pytest.main([*options, *arguments], plugins(has_limit=not bpy.app.background)))


faulthandler.enable()
enable_addons()
if bpy.app.background:
    leave(run_pytest())
# Blender smooths the view by drawing it eight times, and here the processor draws: it took two thirds of the tests' time.
bpy.context.preferences.system.viewport_aa = "OFF"
play(run_pytest)
