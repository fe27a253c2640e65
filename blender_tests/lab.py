# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on Seamwire Lab in tests: its name in this Blender, its parts, and how to enable and disable it."""

from __future__ import annotations

import re
from importlib import import_module
from typing import TYPE_CHECKING

import addon_utils
import traces
from scene import ADDON

if TYPE_CHECKING:
    from types import ModuleType

LAB = f"{ADDON}_lab"
"""The add-on's name in this Blender."""


def part(name: str) -> ModuleType:
    """Return a module of the enabled add-on."""
    return import_module(f"{LAB}.{name}")


def enable_lab() -> None:
    """Enable the add-on as the preferences do."""
    failures: list[BaseException] = []
    assert addon_utils.enable(LAB, default_set=True, handle_error=failures.append) is not None, failures


def disable_lab() -> None:
    """Disable it as the preferences do."""
    addon_utils.disable(LAB, default_set=True)


def of_lab() -> list[str]:
    """Return everything of the add-on that is in Blender now."""
    return [one for one in traces.ours(traces.traces()) if re.search("seamwire_?lab", one.lower())]
