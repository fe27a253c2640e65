# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from . import native

if TYPE_CHECKING:
    import seamwire_core
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Arrays:
    """An edit mesh as the library needs it."""

    points: NDArray[
        np.float64
    ]  # (n, 3) stretched as the object's matrix stretches them: lengths are those that are seen
    triangles: NDArray[np.int32]  # (m, 3) the visible faces, cut as Blender does, but for those without area
    polygons: NDArray[np.int32]  # (m,) the face that each triangle is part of, ascending
    edges: NDArray[np.int32]  # (e, 2) the visible edges of the polygons, no diagonals
    to_object: NDArray[np.float64]  # (3, 3) takes `points` to object coordinates
    # Of the visible edges, (k, 2) each: seams, those that hidden faces have too, and those marked sharp and between materials.
    seams: NDArray[np.int32]
    partly_hidden: NDArray[np.int32]
    marked: tuple[NDArray[np.int32], ...] = ()

    @property
    def in_object(self) -> NDArray[np.float64]:
        """(n, 3) vertices in object coordinates, without the object's scale: those that Blender unwraps."""
        return self.points @ self.to_object.T

    @cached_property
    def surface(self) -> seamwire_core.Surface:
        """The library's surface of the mesh in object coordinates, without the object's scale. Any thread may ask."""
        return native.load().Surface(self.in_object, self.triangles, self.edges)

    def same_as(self, other: Arrays) -> bool:
        """Whether wires run on another mesh as they do on this one; its seams may be others."""
        names = ("points", "triangles", "edges", "to_object")
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in names)
