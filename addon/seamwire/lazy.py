# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the add-on that are read when they are first used, so that Blender's start does not wait for them and for NumPy."""

from __future__ import annotations

from importlib import import_module


class Part:
    """Stands for one of the add-on's modules.

    Not importlib's LazyLoader: Blender looks at all that is in ``sys.modules``, which would read such a module at once.

    Parameters
    ----------
    name
        The module's.
    """

    def __init__(self, name: str) -> None:
        self._name = f"{__package__}.{name}"

    def __getattr__(self, name: str) -> object:
        """Return what the module has under a name."""
        return getattr(import_module(self._name), name)
