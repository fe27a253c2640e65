# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and loads ``seamwire_core``, the compiled part."""

from __future__ import annotations

import hashlib
import importlib
import shutil
import sys
import sysconfig
import tempfile
import zipfile
from importlib.machinery import PathFinder
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

NAME = "seamwire_core"
FOLDER = Path(__file__).parents[2] / "_native"
"""Where Blender 3.4, which does not install wheels itself, has the add-on's own copy."""
WHEELS = Path(__file__).parents[2] / "wheels"
"""The compiled part for each Python and system that this package is for, as the package brought them."""
IS_EXTENSION = __package__.startswith("bl_ext.")
"""Whether this is an extension of Blender 4.2 or later, which installs the wheel of an extension itself."""


class NativeError(ImportError):
    """The compiled part cannot be used."""


def load(folder: Path = FOLDER, wheels: Path = WHEELS) -> ModuleType:
    """Return the module: an installed one first, else the one in the add-on's own folder, unpacked there if need be.

    An extension has no such folder, because Blender installs the module itself. Raises NativeError if there is no module for this Python
    and system, or another version is already loaded.
    """
    if NAME in sys.modules:
        return _of_this_package(sys.modules[NAME], wheels)
    try:
        return _of_this_package(_import(), wheels)
    except NativeError:
        raise
    except ImportError as error:
        # A traceback that this function holds would keep all its callers, and what they made, in memory.
        installed = error.with_traceback(None)
    if IS_EXTENSION:
        fitting = _fitting(wheels)
        if fitting and _is_absent(installed):
            raise NativeError(
                f"Blender has not installed Seamwire's compiled part, {fitting[0].name}, or has removed it since: "
                "disable and enable the add-on"
            ) from installed
        raise _error(folder, wheels, installed) from installed
    return load_unpacked(folder, wheels, installed)


def load_unpacked(folder: Path, wheels: Path = WHEELS, *earlier: ImportError) -> ModuleType:
    """Return the module, unpacked into a folder. `earlier`: why it could not be imported otherwise. Raises NativeError like `load`."""
    place = _unpacked(folder, wheels)
    sys.path.insert(0, str(place))
    try:
        importlib.invalidate_caches()
        return _import()
    except ImportError as error:
        raise _error(place, wheels, *earlier, error) from error
    finally:
        sys.path.remove(str(place))


def _import() -> ModuleType:
    """Import the module, on Windows a copy of it: a loaded library cannot be overwritten there, so Blender could not update the add-on."""
    found = PathFinder.find_spec(NAME) if sys.platform == "win32" else None
    if found is None or found.origin is None or not found.origin.endswith(".pyd"):
        return importlib.import_module(NAME)
    try:
        copy = _copied(Path(found.origin))
    except OSError:
        # No room or no right to write: better one that cannot be updated while it runs than none.
        return importlib.import_module(NAME)
    spec = spec_from_file_location(NAME, copy)
    module = module_from_spec(spec)
    sys.modules[NAME] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[NAME]
        raise
    return module


def _copied(library: Path) -> Path:
    """Return a copy of the library in a folder named after its content; copies of others that nobody uses are removed."""
    content = library.read_bytes()
    folder = Path(tempfile.gettempdir()) / f"{NAME}-{hashlib.sha256(content).hexdigest()[:16]}"
    for other in folder.parent.glob(f"{NAME}-*"):
        if other != folder:
            shutil.rmtree(other, ignore_errors=True)
    copy = folder / library.name
    if not copy.exists() or copy.read_bytes() != content:
        with tempfile.TemporaryDirectory() as unfinished:
            whole = Path(unfinished) / library.name
            whole.write_bytes(content)
            folder.mkdir(exist_ok=True)
            whole.replace(copy)
    return copy


def _of_this_package(module: ModuleType, wheels: Path) -> ModuleType:
    # Python cannot let go of a compiled module: after an update in place the old one stays until Blender ends.
    versions = {wheel.stem.split("-")[1] for wheel in wheels.glob("*.whl")}
    if versions and module.__version__ not in versions:
        found = PathFinder.find_spec(NAME)
        place = found.origin if found and found.origin else module.__file__
        raise NativeError(
            f"Seamwire was updated to {', '.join(sorted(versions))} while its version {module.__version__} was in use: "
            f"restart Blender. If that does not help, remove the {NAME} in {Path(place).parent}"
        )
    return module


def _unpacked(folder: Path, wheels: Path) -> Path:
    fitting = _fitting(wheels)
    if not fitting:
        return folder
    # One folder a wheel: a later version is never written over a file that is in use.
    wheel = fitting[0]
    place = folder / wheel.stem
    if place.is_dir():
        return place
    try:
        folder.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as unfinished, zipfile.ZipFile(wheel) as archive:
            whole = Path(unfinished) / wheel.stem
            archive.extractall(whole)
            whole.replace(place)
    except OSError as error:
        # Another Blender may have been faster.
        if not place.is_dir():
            raise NativeError(f"Seamwire cannot unpack its compiled part to {folder}: {error.strerror}") from error
    return place


def _fitting(wheels: Path) -> list[Path]:
    """Return the wheels for this Python and processor, by their names: NAME-VERSION-PYTHON-ABI-PLATFORM."""
    start, end = f"cp{sys.version_info.major}{sys.version_info.minor}-", sysconfig.get_platform().split("-")[-1]
    names = ((wheel, wheel.stem.split("-", 2)[2]) for wheel in wheels.glob("*.whl"))
    return [wheel for wheel, name in names if name.startswith(start) and name.endswith(end)]


def _is_absent(error: ImportError) -> bool:
    # Only "No module named seamwire_core" means that the module is missing. Otherwise it was found but did not load.
    return isinstance(error, ModuleNotFoundError) and error.name == NAME


def _error(folder: Path, wheels: Path, *errors: ImportError) -> NativeError:
    here = f"Python {sys.version_info.major}.{sys.version_info.minor} on {sysconfig.get_platform()}"
    found = sorted(path.name for path in folder.glob(f"{NAME}*") if path.suffix in {".so", ".pyd", ".dll"})
    found += sorted(path.name for path in wheels.glob("*.whl"))
    for error in errors:
        if not _is_absent(error):
            return NativeError(f"Seamwire's compiled part does not load in this Blender ({here}): {error}")
    if found:
        return NativeError(
            f"Seamwire's compiled part was built for another Python or system ({', '.join(found)}), and this Blender "
            f"has {here}: install the Seamwire package made for it"
        )
    return NativeError(f"Seamwire's compiled part, {NAME}, is missing: install the Seamwire package made for {here}")
