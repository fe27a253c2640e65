# SPDX-License-Identifier: GPL-3.0-or-later
"""Run pytest inside Blender: ``blender [--background] --factory-startup --python blender_tests/run.py -- PYTEST_ARGUMENTS``.

Expects the environment that ``scripts/blender-test`` sets: SEAMWIRE_BLENDER_PACKAGES, the folder that holds pytest and greenlet, and
BLENDER_USER_SCRIPTS, the folder that holds the add-on. SEAMWIRE_ADDON is the add-on's name where Blender gave it another one than
``seamwire``, as it does to extensions; the tests import it as ``seamwire`` all the same.

In the background pytest simply runs. With a window it must not hold Blender's event loop, or no event would ever reach the tool: it
runs in a greenlet of its own that a timer resumes, and every wait of the test (``ui.wait()``, see ``ui.py``) switches back to Blender.
Tests are therefore plain functions in both cases.
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

ADDON = os.environ.get("SEAMWIRE_ADDON", "seamwire")


def leave(code: int) -> None:
    """End the process at once: Blender's own way out asks questions, and does not always hand on the exit code."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def enable_addon() -> None:
    """Enable the add-on and fail loudly where Blender would only print."""
    failures: list[str] = []
    module = addon_utils.enable(ADDON, default_set=True, handle_error=lambda _: failures.append(traceback.format_exc()))
    if module is None or failures:
        sys.stderr.write(f"The add-on {ADDON} could not be enabled.\n" + "".join(failures))
        leave(3)
    for part in pkgutil.iter_modules(module.__path__):
        importlib.import_module(f"{ADDON}.{part.name}")
    for name in [name for name in sys.modules if name == ADDON or name.startswith(f"{ADDON}.")]:
        sys.modules["seamwire" + name.removeprefix(ADDON)] = sys.modules[name]


def run_pytest() -> int:
    """Run pytest with the arguments after ``--`` and return its exit code."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return int(pytest.main(["-p", "no:cacheprovider", *arguments]))


def run_with_window() -> None:
    """Start pytest as soon as Blender's window stands, in turns with Blender's event loop."""
    import greenlet
    import ui

    # Blender's start-up makes its window and the first redraws before a timer fires, but the regions get their sizes a little later.
    ticks_before_start = 5
    main = greenlet.getcurrent()
    tests = greenlet.greenlet(run_pytest, parent=main)

    def tick() -> float:
        nonlocal ticks_before_start
        if ticks_before_start > 0:
            ticks_before_start -= 1
            return 0.0
        try:
            code = tests.switch()
        except BaseException:  # whatever it is, the process must end with a failure and not wait for its time limit
            traceback.print_exc()
            leave(3)
        if tests.dead:
            leave(code)
        return 0.0

    ui.prepare_blender(switch_to_blender=main.switch)
    bpy.app.timers.register(tick, persistent=True)


faulthandler.enable()
enable_addon()
if bpy.app.background:
    leave(run_pytest())
run_with_window()
