# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire: live-wire seam drawing for Blender."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

bl_info = {
    "name": "Seamwire",
    "description": "Draw UV seams with live wires that follow the shape of the mesh",
    "author": "The Seamwire authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Edit Mode > Toolbar, Edge Menu and UV Menu",
    "category": "UV",
}
VERSION = bl_info["version"]  # Blender removes `bl_info` from extensions

# After an update Blender reloads only this file. The parts must be imported again as well.
for _name in [name for name in sys.modules if name.startswith(f"{__name__}.")]:
    del sys.modules[_name]

_PARTS = (
    "mesh.settings",
    "ui.preferences",
    "operators.seam_operators",
    "suggesting.suggest_seams",
    "operators.island_operators",
    "tool.running",
    "tool.draw",
    "view.handlers",
    "ui.toolbar",
    "ui.menus",
    "ui.companions",
)
_FOR_SCRIPTS = ("mark", "suggest", "unwrap", "cut")


def __getattr__(name: str) -> object:
    """Return a function for scripts, see `scripting`."""
    if name not in _FOR_SCRIPTS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(".scripting", __package__), name)


def register() -> None:
    """Add the preferences, the operators, the keys, the tool and the menu entries. If a part fails, remove the others again."""
    _changes()[0]()


def unregister() -> None:
    """Remove all of them, and drop prepared meshes."""
    _changes()[1]()


def _changes() -> tuple[Callable[[], None], Callable[[], None]]:
    registration, *others = (import_module(f".{part}", __package__) for part in ("mesh.registration", *_PARTS))
    return registration.together(
        (registration.check_version, _forget), *((part.register, part.unregister) for part in others)
    )


def _forget() -> None:
    objects = sys.modules.get(f"{__package__}.view.edited_objects")
    if objects is not None:
        objects.edited.clear()
