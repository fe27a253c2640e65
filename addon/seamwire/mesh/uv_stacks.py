# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands of the same shape that lie on each other in the UV map."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.islands.copies import ShapedIsland, find_copies
from . import uv_map

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import bpy
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Stack:
    """Copies of islands, and where they lie.

    Parameters
    ----------
    copies
        The islands of each object that lie on other islands.
    places
        Of each object corners of its copies, and the objects and corners on which they lie.
    """

    copies: Mapping[bpy.types.Object, NDArray[np.int64]]
    places: Mapping[bpy.types.Object, Sequence[tuple[NDArray[np.int64], bpy.types.Object, NDArray[np.int64]]]]

    def uvs(self) -> dict[bpy.types.Object, tuple[NDArray[np.int64], NDArray[np.float64]]]:
        """Return the corners of all copies, ascending, with the UVs of the islands that they lie on."""
        below = dict.fromkeys(obj for own in self.places.values() for _, obj, _ in own)
        present = {obj: uv_map.read_uvs(obj) for obj in below}
        found = {}
        for obj, own in self.places.items():
            corners = np.concatenate([mine for mine, _, _ in own])
            uvs = np.concatenate([present[other][theirs] for _, other, theirs in own]).astype(np.float64)
            order = np.argsort(corners)
            found[obj] = corners[order], uvs[order]
        return found


def stacked(islands: Sequence[tuple[bpy.types.Object, ShapedIsland]]) -> Stack:
    """Lay copies on the first island of their shape. The islands lie on images of one shape."""
    copies: dict[bpy.types.Object, list[int]] = {}
    places: dict[bpy.types.Object, list[tuple[NDArray[np.int64], bpy.types.Object, NDArray[np.int64]]]] = {}
    for number, (first, corners) in enumerate(find_copies([island.shape for _, island in islands])):
        if first == number:
            continue
        (obj, island), (other, below) = islands[number], islands[first]
        copies.setdefault(obj, []).append(island.label)
        places.setdefault(obj, []).append((island.corners, other, below.corners[corners]))
    return Stack({obj: np.array(labels) for obj, labels in copies.items()}, places)
