# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the mouse is: in which 3D view of a window, and at which of its pixels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .. import lazy

if TYPE_CHECKING:
    import bpy

    from . import viewport as views
else:
    views = lazy.Part("view.viewport")


@dataclass(frozen=True)
class Place:
    """A pixel of a 3D view.

    Parameters
    ----------
    area, region
        The view.
    view
        How it sees the world.
    cursor
        Pixels from the region's bottom left.
    x, y
        Pixels of the window.
    """

    area: bpy.types.Area
    region: bpy.types.Region
    view: views.View
    cursor: tuple[float, float]
    x: int
    y: int

    def away(self, other: Place) -> int:
        """Return how far another place is, as Blender measures when a press becomes a drag."""
        return max(abs(self.x - other.x), abs(self.y - other.y))


def place_of(window: bpy.types.Window, event: bpy.types.Event) -> Place | None:
    """Return the 3D view under the mouse, where no toolbar, sidebar or header lies over it."""
    x, y = event.mouse_x, event.mouse_y
    for area in window.screen.areas:
        if area.type != "VIEW_3D" or not _contains(area, x, y):
            continue
        under = [region for region in area.regions if region.width > 1 and _contains(region, x, y)]
        if any(region.type != "WINDOW" for region in under):
            return None
        for region in under:
            view = views.View.of(region, _region_3d(area, region))
            return Place(area, region, view, (x - region.x + 0.5, y - region.y + 0.5), x, y)
    return None


def _contains(box: bpy.types.Area | bpy.types.Region, x: int, y: int) -> bool:
    return box.x <= x < box.x + box.width and box.y <= y < box.y + box.height


def _region_3d(area: bpy.types.Area, region: bpy.types.Region) -> bpy.types.RegionView3D:
    """Return what a window region of a 3D view shows; a quad view has four."""
    space = area.spaces.active
    quads = space.region_quadviews
    if not quads:
        return space.region_3d
    windows = [one for one in area.regions if one.type == "WINDOW"]
    return quads[windows.index(region)]
