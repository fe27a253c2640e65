# SPDX-License-Identifier: GPL-3.0-or-later
"""The wire across the surface that is straight in the view: a section of the surface by a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..network.picks import FacePoint
from ..network.wires import Wire
from ..solver.solver import for_live

if TYPE_CHECKING:
    from ..network.picks import Pick
    from ..solver.solver import LiveWire

    Direction = tuple[float, float, float]


def straight_wire(live: LiveWire, begin: Pick, end: Pick, direction: Direction, follow: int) -> Wire | None:
    """Return the wire in the plane through two picks and along a direction, or None.

    Parameters
    ----------
    live
        Has the surface.
    begin, end
        Vertices, or points of triangles.
    direction
        From the viewer to the end, or any other of the plane.
    follow
        Which of the library's wires it is when its seeds are moved.
    """
    core, surface = native.load(), live.surface
    if surface is None:
        return None
    try:
        points, faces, _ = core.plane_section(surface, for_live(begin, "SURFACE"), for_live(end, "SURFACE"), direction)
    except ValueError:
        return None  # one lies behind the other
    if len(points) < 2:
        return None
    # Each point of the line with a triangle that it lies in.
    triangles = np.append(faces, faces[-1])
    ends = [None if isinstance(pick, FacePoint) else pick for pick in (begin, end)]
    chain = core.fit_chain(surface, points, triangles, *ends)
    vertices = tuple(int(v) for v in chain.vertices)
    inside = next((pick for pick in (begin, end) if isinstance(pick, FacePoint)), None)
    if len(vertices) < 2 and inside is not None:
        # Between points of one face there may be no edge to snap to.
        vertices = (next((pick for pick in ends if isinstance(pick, int)), inside.vertex),)
    elif len(vertices) < 2 or any(
        pick is not None and pick != vertices[at] for at, pick in zip((0, -1), ends, strict=True)
    ):
        return None
    return Wire("SURFACE", vertices, points, begin, end, faces, follow=follow)
