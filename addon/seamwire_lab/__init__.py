# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire Lab: shows the metric in which Seamwire's wires are shortest paths."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

bl_info = {
    "name": "Seamwire Lab",
    "description": "See why Seamwire's wires run where they run. Needs the add-on Seamwire",
    "author": "The Seamwire authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Seamwire Lab",
    "category": "UV",
}
VERSION = bl_info["version"]  # Blender removes `bl_info` from extensions
SEAMWIRE_PARTS = ("lab_settings", "store_fields", "panel", "follower")
"""The modules that Seamwire registers, see `seamwire/ui/companions.py`."""

# After an update Blender reloads only this file. The parts must be imported again as well.
for _name in [name for name in sys.modules if name.startswith(f"{__name__}.")]:
    del sys.modules[_name]
    globals().pop(_name.rpartition(".")[2], None)


def register() -> None:
    """Let Seamwire register the parts if it is enabled. Otherwise it does so once it is enabled."""
    for interface in _interfaces():
        interface.join(sys.modules[__name__])


def unregister() -> None:
    """Remove the parts."""
    for interface in _interfaces():
        interface.leave(sys.modules[__name__])


def _interfaces() -> list[ModuleType]:
    """Return the interface of Seamwire if it is enabled. The name of its repository may stand before the name of an extension."""
    named = [module for name, module in tuple(sys.modules.items()) if name.rpartition(".")[2] == "seamwire"]
    enabled = {module.__name__ for module in named if getattr(module, "__addon_enabled__", False)}
    return [import_module(f"{name}.interface") for name in enabled]
