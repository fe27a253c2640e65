# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender shows an edit mesh that modifiers bend, such as an armature with *On Cage*."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.base import native
from ..core.base.geometry import barycentric

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from seamwire_core import NearestPoints

    from ..core.base.mesh_arrays import Arrays

_MOST_CURVES = 2_000
"""Curves whose triangles are remembered."""


class Pose:
    """Where the vertices of an edit mesh are seen, and any point of its surface with them.

    `points`, (n, 3), are the vertices as they are seen, in the coordinates of the arrays. If the pose `is_bent`, they are seen elsewhere
    than the mesh has them.
    """

    def __init__(self, arrays: Arrays) -> None:
        self._arrays = arrays
        # Curves, (k, 3), with the triangle nearest to each point, (k,), and its barycentric coordinates, (k, 3).
        self._found: dict[int, tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]] = {}
        self.points: NDArray[np.float64] = arrays.points
        self.is_bent = False

    def follow(self, obj: bpy.types.Object) -> bool:
        seen = _cage_points(obj, len(self._arrays.points))
        if seen is None and not self.is_bent:
            return False
        points = self._arrays.points if seen is None else seen @ np.linalg.inv(self._arrays.to_object).T
        if np.array_equal(points, self.points):
            return False
        self.points, self.is_bent = points, seen is not None
        return True

    def places(self, curve: NDArray[np.float64]) -> NDArray[np.float64]:
        rest, corners = self._arrays.points, self._arrays.triangles
        if not self.is_bent or not len(curve) or not len(corners):
            return curve
        # The curve itself is held: its number alone could come again.
        if id(curve) not in self._found:
            if len(self._found) >= _MOST_CURVES:
                self._found.clear()
            rows, _, _ = self._tree.find(curve)
            weights, off = barycentric(rest[corners[rows]], curve)
            weights[~np.isfinite(off)] = 1.0 / 3.0
            self._found[id(curve)] = curve, rows, weights
        _, rows, weights = self._found[id(curve)]
        return np.einsum("kc,kcx->kx", weights, self.points[corners[rows]])

    def at_rest(self, place: NDArray[np.float64], triangle: int) -> NDArray[np.float64]:
        """Return where a point, (3,), that is seen in a triangle is on the mesh without modifiers."""
        if not self.is_bent:
            return place
        corners = self._arrays.triangles[triangle]
        (weights,), (off,) = barycentric(self.points[corners][None], place)
        return weights @ self._arrays.points[corners] if np.isfinite(off) else self._arrays.points[corners[0]]

    @cached_property
    def _tree(self) -> NearestPoints:
        return native.load().NearestPoints(self._arrays.points, self._arrays.triangles)


def _depsgraph_of(obj: bpy.types.Object) -> bpy.types.Depsgraph:
    """Return the evaluated data of a scene with the object. The context may be that of a window with another scene."""
    context = bpy.context
    if context.view_layer.objects.get(obj.name) != obj:
        for window in context.window_manager.windows:
            if window.view_layer.objects.get(obj.name) == obj:
                with context.temp_override(window=window):
                    return bpy.context.evaluated_depsgraph_get()
    return context.evaluated_depsgraph_get()


def _cage_points(obj: bpy.types.Object, count: int) -> NDArray[np.float64] | None:
    """Return the vertices of an edit cage as modifiers bend it, (count, 3), in object coordinates. None: as the mesh has them.

    Blender shows the cage after the last modifier with *On Cage*, and tells only what is left after all modifiers. Both are the same if
    that modifier is the last one and none has changed the number of vertices.
    """
    active = [modifier for modifier in obj.modifiers if modifier.show_viewport and modifier.show_in_editmode]
    if not active or not active[-1].show_on_cage:
        return None
    evaluated = obj.evaluated_get(_depsgraph_of(obj))
    data = evaluated.to_mesh()
    try:
        if len(data.vertices) != count:
            return None
        points = np.empty(3 * count, dtype=np.float32)
        data.vertices.foreach_get("co", points)
        return points.reshape(-1, 3).astype(np.float64)
    finally:
        evaluated.to_mesh_clear()
