# SPDX-License-Identifier: GPL-3.0-or-later
"""UV maps as arrays: where the corners of faces lie, what is wrong there, and how much faces are stretched."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..base import native
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..base.mesh_arrays import Arrays


@dataclass(frozen=True)
class Corners:
    """The corners of a mesh's faces, face by face, hidden ones included.

    Each corner, (c,), has a vertex and the edge to the next corner of its face. Each face, (f,), has a number of corners.
    """

    vertices: NDArray[np.int32]
    edges: NDArray[np.int32]
    sizes: NDArray[np.int32]

    @cached_property
    def faces(self) -> NDArray[np.int64]:
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    def of_triangles(self, arrays: Arrays) -> NDArray[np.int64]:
        count = len(arrays.points)
        keys = self.faces * count + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = arrays.polygons[:, None].astype(np.int64) * count + arrays.triangles
        return order[np.searchsorted(keys, wanted.reshape(-1), sorter=order)].reshape(-1, 3)


def uv_areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


class MapFaults(NamedTuple):
    """The numbers of faults of some islands of a UV map.

    Faces are flipped if they are turned over against their island, or have no area in the map. Islands overlap that cover a part of
    themselves or of another island. Islands are outside that lie neither in the UV square nor in the tile that they had before.
    """

    flipped: int = 0
    overlapping: int = 0
    outside: int = 0

    def __bool__(self) -> bool:
        return any(self)


NO_FAULTS = MapFaults()


@dataclass(frozen=True)
class MappedSurface:
    """The visible faces of a mesh with the UVs of the triangles' corners, (m, 3, 2).

    Edges are those of faces, without the diagonals that cut these into triangles. Labels are islands, numbered from 0. The name is that of
    the object, and `to_scene` takes its coordinates to the axes of the scene.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    labels: NDArray[np.int32]
    uvs: NDArray[np.floating]
    edges: NDArray[np.int32]
    name: str = ""
    to_scene: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))

    @property
    def count(self) -> int:
        return int(self.labels.max(initial=-1)) + 1

    @property
    def area(self) -> float:
        return float(triangle_areas(self.points, self.triangles).sum())

    def energy(self, aspect: float = 1.0) -> float:
        """Return the mean symmetric Dirichlet energy E_d: 4 if nothing is stretched, infinite if there is nothing to measure.

        `aspect` is the width over the height of the image that the UVs lie on.
        """
        rows = np.flatnonzero(np.isfinite(self.uvs).all(axis=(1, 2)))
        if not len(rows):
            return np.inf
        numbers, uvs = np.unique(self.labels[rows], return_inverse=True)[1], self.uvs[rows] * (aspect, 1.0)
        return native.load().map_energy(self.points, self.triangles[rows], uvs, islands=numbers, edges=self.edges)


class Stretch:
    """How much a UV map stretches the faces of a mesh, in octaves, see ``seamwire_core.map_stretch``.

    `polygons`, (m,), are the faces that the triangles are part of, ascending. `corners`, (m, 3), are the rows of the UV map that belong to
    the triangles' corners.
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
