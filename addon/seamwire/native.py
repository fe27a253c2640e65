# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and loads ``seamwire_core``, the compiled part."""

from __future__ import annotations

import importlib
import sys
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

NAME = "seamwire_core"
FOLDER = Path(__file__).parent / "_native"
"""Where the add-on's own copy lies, in Blenders that do not install wheels themselves."""


class NativeError(ImportError):
    """The compiled part cannot be used; the text is a sentence for the artist."""


def load(folder: Path = FOLDER) -> ModuleType:
    """Return the module: an installed one first, else the one in the add-on's own folder.

    Raises
    ------
    NativeError
        Where there is none, or none for this Python and system.
    """
    if NAME in sys.modules:
        return sys.modules[NAME]
    try:
        return importlib.import_module(NAME)
    except ImportError as error:
        installed = error
    sys.path.insert(0, str(folder))
    try:
        importlib.invalidate_caches()
        return importlib.import_module(NAME)
    except ImportError as error:
        raise NativeError(_sentence(folder, installed, error)) from error
    finally:
        sys.path.remove(str(folder))


def _sentence(folder: Path, installed: ImportError, own: ImportError) -> str:
    python = f"Python {sys.version_info.major}.{sys.version_info.minor} on {sysconfig.get_platform()}"
    found = sorted(path.name for path in folder.glob(f"{NAME}*") if path.suffix in {".so", ".pyd", ".dll"})
    for error in (installed, own):
        # Only "No module named seamwire_core" means that there is none: anything else was found, and did not load.
        if not (isinstance(error, ModuleNotFoundError) and error.name == NAME):
            return f"Seamwire's compiled part does not load in this Blender ({python}): {error}"
    if found:
        return (
            f"Seamwire's compiled part was built for another Python or system ({', '.join(found)}), and this Blender "
            f"has {python}: install the Seamwire package made for it"
        )
    return f"Seamwire's compiled part, {NAME}, is missing: install the Seamwire package made for {python}"
