# SPDX-License-Identifier: GPL-3.0-or-later
"""Enable the add-on under the name ``seamwire``, whatever name Blender gave it, and Seamwire Networks as ``seamwire_networks``."""

import importlib
import pkgutil
import sys
import traceback

import addon_utils
from scene import ADDON
from turns import leave


def enable_addons() -> None:
    """Enable both add-ons, and fail loudly where Blender would only print."""
    for addon, own in ((ADDON, "seamwire"), (f"{ADDON}_networks", "seamwire_networks")):
        failures: list[str] = []
        module = addon_utils.enable(
            addon, default_set=True, handle_error=lambda _, to=failures: to.append(traceback.format_exc())
        )
        if module is None or failures:
            sys.stderr.write(f"The add-on {addon} could not be enabled.\n" + "".join(failures))
            leave(3)
        for part in pkgutil.walk_packages(module.__path__, f"{addon}."):
            importlib.import_module(part.name)
        for name in [name for name in sys.modules if name == addon or name.startswith(f"{addon}.")]:
            sys.modules[own + name.removeprefix(addon)] = sys.modules[name]
