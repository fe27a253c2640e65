# SPDX-License-Identifier: GPL-3.0-or-later
"""Add-ons that extend this one, such as Seamwire Networks. Their parts are registered while both are enabled.

The name of such an add-on begins with `seamwire_`. It has `VERSION`, `SEAMWIRE_PARTS` and a module `tool`, and calls `join` and `leave` of
the interface when it is enabled and disabled.
"""

from __future__ import annotations

import sys
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from ..mesh.registration import together
from ..mesh.settings import ADDON
from ..tool.running import steps

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

_joined: dict[ModuleType, Callable[[], None]] = {}
"""What takes the parts of each add-on away again."""


def join(addon: ModuleType) -> None:
    """Register the parts of an add-on, if it belongs to this version."""
    name, interface = addon.__name__, import_module(f"{ADDON}.interface")
    if addon in _joined:
        return
    if sys.modules[ADDON].VERSION != addon.VERSION:
        print(f"{name} {addon.VERSION} does not fit {ADDON} {sys.modules[ADDON].VERSION}: update both")
        return
    if import_module(".tool", name).interface not in (None, interface):
        # This add-on was updated, so its classes are others.
        for module in [module for module in sys.modules if module.startswith(f"{name}.")]:
            del sys.modules[module]
            vars(addon).pop(module.rpartition(".")[2], None)
    import_module(".tool", name).interface = interface
    parts = [import_module(f".{part}", name) for part in addon.SEAMWIRE_PARTS]
    enter, leave_again = together(*((part.register, part.unregister) for part in parts))
    enter()
    _joined[addon] = leave_again


def leave(addon: ModuleType) -> None:
    for operator in tuple(steps):
        if type(operator).__module__.startswith(f"{addon.__name__}."):
            operator.end()
    _joined.pop(addon, lambda: None)()


def register() -> None:
    named = [module for name, module in tuple(sys.modules.items()) if name.rpartition(".")[2].startswith("seamwire_")]
    waiting = [one for one in named if getattr(one, "__addon_enabled__", False) and hasattr(one, "SEAMWIRE_PARTS")]
    together(*((partial(join, addon), partial(leave, addon)) for addon in waiting))[0]()


def unregister() -> None:
    together(*((None, partial(leave, addon)) for addon in _joined))[1]()
