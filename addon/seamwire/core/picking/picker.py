# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click would take on the visible part of an edit mesh: a seed, a wire, a seam, a feature, or the plain mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..network.network import Snap
from ..network.picks import place_of
from .camera import Sight
from .drawn import DrawnPicker, stroke_at
from .features import FeaturePicker
from .plain import PlainPicker
from .surface import VisibleSurface

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..base.mesh_arrays import Arrays
    from ..drawing.session import Session
    from ..fields.crests import Crests
    from ..network.picks import Pick
    from ..network.strokes import Stroke
    from .camera import Camera
    from .surface import Bend


class Picker:
    """Finds what is under the cursor on one edit mesh.

    In all methods, `matrix` is the object's (4, 4) matrix, which may rotate, scale and shear. `cursor` is in pixels from the region's
    bottom left.

    Parameters
    ----------
    arrays
        The edit mesh.
    seams
        (s, 2) the edges that are seams and that no wire runs along.
    bend
        As in `VisibleSurface`.
    """

    def __init__(self, arrays: Arrays, seams: ArrayLike = (), bend: Bend | None = None) -> None:
        self._surface = VisibleSurface(arrays, bend)
        self._plain = PlainPicker(self._surface)
        self._features = FeaturePicker(self._surface)
        self._drawn = DrawnPicker(self._surface, seams)

    def wait(self) -> None:
        """Wait until the threads have finished."""
        self._surface.wait()

    def set_seams(self, seams: ArrayLike) -> None:
        """Take other edges, (s, 2), as the seams that no wire runs along."""
        self._drawn.set_seams(seams)

    def snap(
        self,
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        *,
        vertices_only: bool,
        edges_only: bool = False,
        anywhere: bool = False,
        session: Session | None = None,
        xray: bool = False,
        preferred: frozenset[int] = frozenset(),
        strength: NDArray[np.float64] | None = None,
        crests: Crests | None = None,
        scale: float = 1.0,
    ) -> Snap | None:
        """Return what a click would take: a seed before a wire, a wire before a seam, a seam before the plain mesh.

        Parameters
        ----------
        camera, matrix, cursor
            The camera of the view, the object and the pixel.
        vertices_only, edges_only
            Find vertices of the mesh alone, or edges.
        anywhere
            Of vertices alone, find only those that are meant. Otherwise find the point of the surface under the cursor.
        session
            Whose seeds and wires can be found. Without it, neither these nor seams are found.
        xray
            Find what lies behind faces too; the nearest on the screen.
        preferred
            Vertices that are taken before anything else of the plain mesh if they are as near as features may be.
        strength
            (n,) how strong the feature is at each vertex. The nearest corner is taken, where three sharp edges meet, and otherwise the
            strongest feature nearby.
        crests
            Ridges and valleys. What lies on one nearby is taken before anything else of the plain mesh.
        scale
            Of the display.
        """
        sight = Sight.of(camera, matrix, cursor, scale, xray)
        if sight is None:
            return None
        if session is not None:
            found = self._drawn.at(sight, session)
            if found is not None:
                return found
        if xray:
            pick = self._plain.through(sight, vertices_only)
        else:
            pick = self._plain.point_at(sight) if anywhere else None
            if pick is None:
                pick = self._plain.at(sight, vertices_only, edges_only)
        if pick is None:
            return None
        vertex = self._features.preferred_at(sight, pick, preferred) if preferred else None
        if vertex is not None:
            return Snap(vertex)
        corner = None if strength is None else self._features.corner_at(sight, pick)
        if corner is not None:
            return Snap(corner, "FEATURE")
        crest = None if crests is None else self._features.crest_at(sight, crests, anywhere)
        if crest is not None:
            return Snap(crest, "FEATURE")
        if edges_only and isinstance(pick, tuple):
            return self._plain.with_crossing(sight, pick)
        feature = None if strength is None else self._features.strongest_at(sight, pick, strength)
        return Snap(pick) if feature is None else Snap(feature, "FEATURE")

    def stroke_at(
        self,
        strokes: Sequence[Stroke],
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        xray: bool = False,
        scale: float = 1.0,
    ) -> Stroke | None:
        """Return the stroke under the cursor. `strokes` are given oldest first."""
        sight = Sight.of(camera, matrix, cursor, scale, xray)
        return None if sight is None else stroke_at(strokes, sight, self._surface)

    def seen_along(self, camera: Camera, matrix: ArrayLike, pick: Pick) -> tuple[float, float, float] | None:
        """Return the direction from the viewer to a pick, in the coordinates of the mesh, or None if it lies behind the viewer."""
        surface = self._surface
        sight = Sight.of(camera, matrix, (0.0, 0.0))
        if sight is None:
            return None
        pixel = sight.pixels((surface.to_object @ place_of(pick, surface.points))[None])[0]
        if not np.isfinite(pixel).all():
            return None
        near, far = surface.ray(sight, (float(pixel[0]), float(pixel[1])))
        x, y, z = (far - near).tolist()
        return x, y, z

    def depth(self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]) -> float | None:
        """Return how far the face under the cursor is from the near plane, in world units, or None beside the mesh."""
        sight = Sight.of(camera, matrix, cursor)
        hit = None if sight is None else self._surface.cast(sight, cursor)
        return None if hit is None else float(np.linalg.norm(sight.to_world(hit[1]) - camera.ray(cursor)[0]))

    def surface_at(
        self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]
    ) -> tuple[NDArray[np.float64], int] | None:
        """Return the point of the surface under the cursor, in the coordinates of the mesh, and its triangle."""
        sight = Sight.of(camera, matrix, cursor)
        hit = None if sight is None else self._surface.cast(sight, cursor)
        return None if hit is None else (self._surface.to_points @ hit[1], hit[0])
