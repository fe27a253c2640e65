# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the add-on Seamwire. Its interface is everything that this add-on uses of it."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

MISSING = "Enable the add-on Seamwire"
"""What users read if it is not enabled."""


class ToolMissingError(ValueError):
    """Seamwire is not installed or not enabled."""


_addon: ModuleType | None = None


def find() -> ModuleType | None:
    """Return the interface of Seamwire, or None if it is not enabled."""
    global _addon
    if _addon is None or not _is_enabled(_addon):
        # Before the name of an extension stands the name of its repository.
        named = (module for name, module in tuple(sys.modules.items()) if name.rpartition(".")[2] == "seamwire")
        _addon = next(filter(_is_enabled, named), None)
    return None if _addon is None else import_module(f"{_addon.__name__}.interface")


def _is_enabled(module: ModuleType) -> bool:
    return getattr(module, "__addon_enabled__", False) and sys.modules.get(module.__name__) is module


def interface() -> ModuleType:
    """Return the interface of Seamwire.

    Raises
    ------
    ToolMissingError
        If it is not enabled.
    """
    found = find()
    if found is None:
        raise ToolMissingError(MISSING)
    return found
