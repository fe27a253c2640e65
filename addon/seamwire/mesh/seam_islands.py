# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that the seams of an edit mesh make, and how much its active UV map stretches each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core import native
from ..core.stretch import Stretch
from . import edit_mesh, uv_map

if TYPE_CHECKING:
    import bpy
    from numpy.typing import NDArray


def labels_of(arrays: edit_mesh.Arrays) -> NDArray[np.int32]:
    """Return the island of each triangle, (m,): 0, 1, ..., largest first."""
    core = native.load()
    surface = core.Surface(arrays.points, arrays.triangles, arrays.edges)
    return np.asarray(core.face_segments(surface, arrays.seams))


@dataclass(frozen=True)
class Worst:
    """An island that is stretched.

    Parameters
    ----------
    value
        Octaves, see `core.stretch`.
    faces
        (k,) its faces.
    count
        How many islands its mesh has.
    """

    value: float
    faces: NDArray[np.int32]
    count: int


def worst_island(obj: bpy.types.Object, kind: str) -> Worst | None:
    """Find the island of an edit mesh that is stretched most; None: it has no UV map, or no visible face.

    Parameters
    ----------
    obj
        In edit mode.
    kind
        By ``ANGLE`` or ``AREA``.

    Raises
    ------
    ValueError, native.NativeError
        Where no edge is visible, or the compiled part is missing.
    """
    arrays = edit_mesh.read(obj)
    corners, uvs = uv_map.read(obj)
    if uvs is None or not len(arrays.triangles):
        return None
    labels = labels_of(arrays)
    stretch = Stretch(arrays.points, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
    stretch.update(uvs)
    islands = stretch.islands(labels)
    values = islands.angle if kind == "ANGLE" else islands.area
    number = int(values.argmax())
    return Worst(float(values[number]), np.unique(arrays.polygons[labels == number]), len(values))
