# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the UV square maps use, and which island costs most of the rest.

All islands of a map share one texel density. So the longest island limits the scale of all islands.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..base.geometry import area_normals
from .uv_maps import uv_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from .uv_maps import MappedSurface

    Side = Literal["-x", "+x", "-y", "+y", "-z", "+z"]

_SIDE_TO_SIDE = 0.95
"""The length of an island that reaches from side to side of the square."""
_MOSTLY = 0.5
_OUTSIDE = 1e-3
"""A map may leave the square by so much and still count as packed into it."""
_CANDIDATES = 8
"""So many islands with much empty space around them are compared exactly."""
_ASIDE = 0.25
"""The distance from the middle of an object at which an island lies on a side, as a fraction of half the object's longest side."""


@dataclass(frozen=True)
class CostlyIsland:
    number: int  # in its map, from 0
    others: int = 0  # if it is long: how many others are about as long, and would limit the scale in its place
    empty: float | None = None  # if it is not long: the empty fraction of the box around it
    name: str = ""  # of its object, if there are several maps
    is_only: bool = False  # whether there is no other island
    side: Side | None = None  # the side of the object on which it lies; None near the middle


@dataclass(frozen=True)
class SquareUse:
    """The fraction of the UV square that maps cover, and the island that costs most of the rest. Faces that overlap count twice."""

    share: float
    costly: CostlyIsland | None = None


def square_use(maps: Sequence[MappedSurface]) -> SquareUse:
    """Measure how maps use the UV square together.

    An island is long if it reaches from side to side of the square, and most of the free space lies beside the box around it. Otherwise
    the island counts whose box has most free space, if that is most of the box. Islands in the free space of another island fill it.
    """
    uvs = np.concatenate([np.empty((0, 3, 2)), *(each.uvs for each in maps)]).astype(np.float64)
    starts = np.cumsum([0, *(each.count for each in maps)])
    islands = np.concatenate(
        [np.empty(0, dtype=np.int64), *(each.labels + start for each, start in zip(maps, starts, strict=False))]
    )
    is_placed = np.isfinite(uvs).all(axis=(1, 2))
    areas = np.where(is_placed, uv_areas(uvs), 0.0)
    share = float(areas.sum())
    found = _costliest(uvs[is_placed], islands[is_placed], areas[is_placed])
    if found is None:
        return SquareUse(share)
    island, others, empty = found
    mesh = int(np.searchsorted(starts, island, side="right")) - 1
    own, number = maps[mesh], int(island - starts[mesh])
    name = own.name if len(maps) > 1 else ""
    costly = CostlyIsland(number, others, empty, name, bool((islands == island).all()), _side_of(own, number))
    return SquareUse(share, costly)


def _costliest(
    uvs: NDArray[np.float64], islands: NDArray[np.int64], areas: NDArray[np.float64]
) -> tuple[int, int, float | None] | None:
    """Return the island that costs most, how many others are as long, and how empty its box is if it is not long."""
    if not len(uvs) or uvs.min() < -_OUTSIDE or uvs.max() > 1.0 + _OUTSIDE:
        return None
    order = np.argsort(islands, kind="stable")
    numbers, first = np.unique(islands[order], return_index=True)
    low = np.minimum.reduceat(uvs[order].min(axis=1), first)
    high = np.maximum.reduceat(uvs[order].max(axis=1), first)
    boxes = (high - low).prod(axis=1)
    middles = uvs.mean(axis=1)

    def free_in(row: int) -> float:
        inside = ((middles >= low[row]) & (middles <= high[row])).all(axis=1)
        return float(boxes[row] - areas[inside].sum())

    lengths = (high - low).max(axis=1)
    longest = int(lengths.round(3).argmax())
    loosest = np.argsort(np.add.reduceat(areas[order], first) - boxes, kind="stable")[:_CANDIDATES].tolist()
    worst = max(loosest, key=lambda row: round(free_in(row), 6))
    free = free_in(worst)
    is_empty = free > _MOSTLY * boxes[worst]
    beside = 1.0 - float(areas.sum()) - free_in(longest)
    if lengths[longest] >= _SIDE_TO_SIDE and not (is_empty and free > beside):
        others = int((lengths >= _SIDE_TO_SIDE * lengths[longest]).sum()) - 1
        return int(numbers[longest]), others, None
    return (int(numbers[worst]), 0, free / float(boxes[worst])) if is_empty else None


def _side_of(own: MappedSurface, number: int) -> Side | None:
    """Return the side of its object on which an island lies, by its center of area."""
    points = own.points @ own.to_scene.T
    rows = own.triangles[own.labels == number]
    weights = np.linalg.norm(area_normals(points, rows), axis=1)
    seen = points[np.unique(own.triangles)]
    low, high = seen.min(axis=0), seen.max(axis=0)
    if not weights.sum() > 0.0:
        return None
    away = np.average(points[rows].mean(axis=1), axis=0, weights=weights) - 0.5 * (low + high)
    axis = int(np.abs(away).argmax())
    if abs(away[axis]) < _ASIDE * 0.5 * (high - low).max():
        return None
    return f"{'+' if away[axis] > 0.0 else '-'}{'xyz'[axis]}"
