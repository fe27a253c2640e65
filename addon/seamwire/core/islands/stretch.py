# SPDX-License-Identifier: GPL-3.0-or-later
"""How much a UV map stretches the faces of a mesh, by angle and by area. Knows neither Blender nor the GPU."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Stretch:
    """The stretch of a mesh's faces, which follows their UVs.

    Parameters
    ----------
    points
        (n, 3) vertices.
    triangles
        (m, 3) what the faces are cut into.
    polygons
        (m,) the face that each triangle is part of, ascending.
    corners
        (m, 3) the rows of the UV map that belong to the triangles' corners.

    Attributes
    ----------
    angle, area
        (m,) the octaves of ``seamwire_core.map_stretch``.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        polygons: NDArray[np.int32],
        corners: NDArray[np.int64],
    ) -> None:
        self._mesh = points, triangles, polygons
        self._corners = corners
        self._areas = triangle_areas(points, triangles)
        self._uvs: NDArray[np.float32] | None = None
        self.angle = self.area = np.zeros(len(triangles))

    def update(self, uvs: NDArray[np.float32]) -> bool:
        """Follow a UV map, (c, 2); return whether it is another than before."""
        if not len(self._areas) or (self._uvs is not None and np.array_equal(uvs, self._uvs)):
            return False
        self.angle, self.area = native.load().map_stretch(*self._mesh, uvs[self._corners])
        self._uvs = np.array(uvs, dtype=np.float32)
        return True

    def values(self, kind: str) -> NDArray[np.float64]:
        """Return the stretch of the face of each triangle, (m,), in octaves by ``ANGLE`` or ``AREA``, zero and more."""
        return self.angle if kind == "ANGLE" else np.abs(self.area)

    def islands(self, labels: NDArray[np.int32], kind: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the stretch and the area on the model of the islands that labels, (m,), tell apart, (count,) each.

        The stretch is the mean of the faces, weighted by their areas, and zero for islands without area.
        """
        count = int(labels.max(initial=-1)) + 1
        areas = np.bincount(labels, self._areas, count)
        sums = np.bincount(labels, self.values(kind) * self._areas, count)
        return np.divide(sums, areas, out=np.zeros(count), where=areas > 0.0), areas
