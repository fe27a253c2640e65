# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuses Blender's modules, so that tests notice who asks for them, also inside a function or where a failure is caught."""

from __future__ import annotations

import sys
from importlib.abc import MetaPathFinder
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

BLENDERS = {"bpy", "bmesh", "gpu", "blf", "mathutils", "bpy_extras", "gpu_extras"}


class BlenderRefusal(MetaPathFinder):
    """A finder that finds nothing, and keeps the names of Blender's modules that it was asked for."""

    def __init__(self) -> None:
        self.asked: list[str] = []

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> None:
        if name.split(".")[0] in BLENDERS:
            self.asked.append(name)
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


refusal = BlenderRefusal()
sys.meta_path.insert(0, refusal)
