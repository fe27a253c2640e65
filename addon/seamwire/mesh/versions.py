# SPDX-License-Identifier: GPL-3.0-or-later
"""The versions of Blender that are supported: 3.4, as Debian 12 has it, and 4.2 to 5.x."""

from __future__ import annotations

import bpy

OLD = (3, 4)
"""The only supported version before `NEW`."""
NEW = (4, 2)
"""The oldest supported version that has extensions."""
IS_OLD = bpy.app.version[:2] < NEW
"""Whether this Blender is `OLD`. Where the two differ only in the name or the presence of a property, code asks for the property."""


def check(version: tuple[int, ...] = bpy.app.version) -> None:
    """Raise RuntimeError if a version of Blender is not supported."""
    if version[:2] != OLD and version[:2] < NEW:
        found, old, new = ("{}.{}".format(*number[:2]) for number in (version, OLD, NEW))
        raise RuntimeError(f"Seamwire does not run in Blender {found}: use Blender {old}, or {new} or newer")
