# SPDX-License-Identifier: GPL-3.0-or-later
"""Which 3D view of Blender's the mouse is in, and how it sees the world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.picking.picker import Camera

if TYPE_CHECKING:
    import bpy
    from numpy.typing import NDArray


_REST = 3
"""Pixels that a hand moves the mouse while it presses a key."""


def clipping_planes(region_3d: bpy.types.RegionView3D) -> NDArray[np.float64]:
    """Return the planes, (k, 4), of a view's clipping border (Alt+B); none where it is not clipped."""
    if not region_3d.use_clip_planes:
        return np.empty((0, 4))
    # Two more lie before and behind the view.
    return np.array(region_3d.clip_planes, dtype=np.float64)[:4]


@dataclass(frozen=True)
class Place:
    area: bpy.types.Area
    region: bpy.types.Region
    view: Camera  # how the view sees the world
    cursor: tuple[float, float]  # from the region's bottom left
    x: int  # in the window
    y: int

    def away(self, other: Place) -> int:
        """Return how far another place is, as Blender measures when a press becomes a drag."""
        return max(abs(self.x - other.x), abs(self.y - other.y))

    def is_as(self, other: Place) -> bool:
        """Whether a hand that rests has not left another place, and the view is the same."""
        return self.away(other) <= _REST and np.array_equal(self.view.perspective, other.view.perspective)


def place_of(window: bpy.types.Window, event: bpy.types.Event) -> Place | None:
    """Return the 3D view under the mouse, where no toolbar, sidebar or header lies over it."""
    x, y = event.mouse_x, event.mouse_y
    for area in window.screen.areas:
        if area.type != "VIEW_3D" or not contains(area, x, y):
            continue
        under = [region for region in area.regions if region.width > 1 and contains(region, x, y)]
        if any(region.type != "WINDOW" for region in under):
            return None
        for region in under:
            return place_in(area, region, (x - region.x, y - region.y))
    return None


def place_in(area: bpy.types.Area, region: bpy.types.Region, location: tuple[int, int]) -> Place:
    """Return a pixel of a 3D view, counted from the bottom left of its region."""
    windows = [one for one in area.regions if one.type == "WINDOW"]
    quads = area.spaces.active.region_quadviews  # a quad view has four, other views have none
    region_3d = quads[windows.index(region)] if quads else area.spaces.active.region_3d
    perspective = np.array(region_3d.perspective_matrix, dtype=np.float64)
    view = Camera(region.width, region.height, perspective, clipping_planes(region_3d))
    x, y = location
    return Place(area, region, view, (x + 0.5, y + 0.5), region.x + x, region.y + y)


def contains(box: bpy.types.Area | bpy.types.Region, x: int, y: int) -> bool:
    return box.x <= x < box.x + box.width and box.y <= y < box.y + box.height
