# SPDX-License-Identifier: GPL-3.0-or-later
"""Enable the add-on under the name ``seamwire``, whatever name Blender gave it."""

import importlib
import pkgutil
import sys
import traceback

import addon_utils
from scene import ADDON
from turns import leave


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
