# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a UV map as it is stored: faces that are turned over, islands that overlap, and islands outside the UV square."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.geometry import triangle_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    polygons: NDArray[np.int32]
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


def joined(surfaces: Sequence[MappedSurface]) -> MappedSurface:
    """Return maps that share the UV square as the map of one mesh. Each keeps the order of its triangles.

    All meshes get the same size, because faces that are tiny beside the whole mesh have no shape that can be measured.
    """
    if len(surfaces) == 1:
        return surfaces[0]
    points, triangles, polygons, labels, edges = [], [], [], [], []
    vertices = faces = islands = 0
    for each in surfaces:
        size = float(np.ptp(each.points, axis=0).max(initial=0.0))
        points.append(each.points / size if size > 0.0 else each.points)
        triangles.append(each.triangles + vertices)
        polygons.append(each.polygons + faces)
        labels.append(each.labels + islands)
        edges.append(each.edges + vertices)
        vertices += len(each.points)
        faces += int(each.polygons.max(initial=-1)) + 1
        islands += each.count
    columns = (points, triangles, polygons, labels, [each.uvs for each in surfaces], edges)
    return MappedSurface(*map(np.concatenate, columns))


def find_faults(
    surface: MappedSurface,
    chosen: NDArray[np.bool_] | None = None,
    homes: NDArray[np.float64] | None = None,
    *,
    may_stack: bool = False,
) -> MapFaults:
    """Measure what is wrong with some islands of a map. The surface is all that lies in the map.

    Only islands that are `chosen`, (count,), are looked at; the others count as what these may overlap. An island may lie in the UV square,
    or in the tile with the low corner that it has in `homes`, (count, 2). If islands `may_stack`, they may lie exactly on each other.
    """
    return MapFaults(
        *native.load().map_faults(
            surface.points,
            surface.triangles,
            surface.uvs,
            surface.labels,
            polygons=surface.polygons,
            edges=surface.edges,
            chosen=chosen,
            homes=homes,
            may_stack=may_stack,
        )
    )
