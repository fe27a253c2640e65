# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire Lab: shows the metric in which Seamwire's wires are shortest paths."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from importlib import import_module

bl_info = {
    "name": "Seamwire Lab",
    "description": "See why Seamwire's wires run where they run",
    "author": "The Seamwire authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Seamwire Lab",
    "category": "UV",
}

# After an update Blender reloads only this file. The parts must be imported again as well.
for _name in [name for name in sys.modules if name.startswith(f"{__name__}.")]:
    del sys.modules[_name]

_PARTS = ("lab_settings", "store_fields", "panel", "follower")


def register() -> None:
    """Add the settings, the operator, the panel and the views. If a part fails, remove the others again."""
    with ExitStack() as undo:
        for name in _PARTS:
            part = import_module(f".{name}", __package__)
            part.register()
            undo.callback(part.unregister)
        undo.pop_all()


def unregister() -> None:
    """Remove all of them."""
    with ExitStack() as undo:
        for name in _PARTS:
            undo.callback(import_module(f".{name}", __package__).unregister)
