# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a UV map as it is stored: faces that are turned over, islands that overlap, and islands outside the UV square."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class MapFaults:
    """The numbers of faults of some islands of a UV map.

    Faces are flipped if they are turned over against their island, or have no area in the map. Islands overlap that cover a part of
    themselves or of another island. Islands are outside that lie neither in the UV square nor in the tile that they had before.
    """

    flipped: int = 0
    overlapping: int = 0
    outside: int = 0

    def __bool__(self) -> bool:
        return any((self.flipped, self.overlapping, self.outside))


NO_FAULTS = MapFaults()


@dataclass(frozen=True)
class MappedSurface:
    """The visible faces of a mesh with the UVs of the triangles' corners, (m, 3, 2).

    Edges are those of faces, without the diagonals that cut these into triangles. Labels are islands, numbered from 0.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    labels: NDArray[np.int32]
    uvs: NDArray[np.floating]
    edges: NDArray[np.int32]

    @property
    def count(self) -> int:
        """The number of islands."""
        return int(self.labels.max(initial=-1)) + 1

    @property
    def area(self) -> float:
        """The area on the model."""
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
