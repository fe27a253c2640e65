# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives access to the interface of Seamwire, as in `from .tool import settings`. This add-on imports nothing else of Seamwire."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

interface: ModuleType | None = None
"""Seamwire sets it before it registers this add-on. Without Blender, Seamwire is on Python's path."""


def __getattr__(name: str) -> object:
    return getattr(interface or import_module("seamwire.interface"), name)
