# SPDX-License-Identifier: GPL-3.0-or-later
"""The corners of a mesh's faces, and areas in a UV map."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

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
        """(c,) the face of each."""
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    def of_triangles(self, arrays: Arrays) -> NDArray[np.int64]:
        """Return the corner that lies at each corner of the triangles, (m, 3)."""
        count = len(arrays.points)
        keys = self.faces * count + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = arrays.polygons[:, None].astype(np.int64) * count + arrays.triangles
        return order[np.searchsorted(keys, wanted.reshape(-1), sorter=order)].reshape(-1, 3)


def uv_areas(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the areas of triangles, (t, 3, 2)."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
