# SPDX-License-Identifier: GPL-3.0-or-later
"""The visible part of an edit mesh, as rays meet it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.incidence import Incidence
from ..network.picks import FacePoint, vertices_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..base.mesh_arrays import Arrays
    from ..network.picks import Pick
    from .camera import Sight

Bend = Callable[["NDArray[np.float64]"], "NDArray[np.float64]"]
MAX_NEAR = 400
"""Vertices that are looked at near the cursor. Of more within a few pixels, as in a far view, nobody can tell which is meant."""


class VisibleSurface:
    """The visible part of an edit mesh, as rays meet it.

    Threads build the library's tree of the triangles and the tables of what meets at each vertex. A lookup before they are ready
    waits for the tables.

    Parameters
    ----------
    bend
        Takes the points of a curve on the mesh, (k, 3), to where they are seen on the surface. None: they are seen where they are.
    """

    def __init__(self, arrays: Arrays, bend: Bend | None = None) -> None:
        self._bend = bend
        self.points = arrays.points
        self.edges = arrays.edges
        self.triangles = arrays.triangles
        self.polygons = arrays.polygons
        self.to_object = arrays.to_object
        self.to_points = np.linalg.inv(arrays.to_object)
        self._rays = native.load().RayTree(arrays.points, arrays.triangles)
        # The rows of triangles, or of edges, at a vertex.
        self.triangles_at = Incidence(arrays.triangles, len(arrays.points))
        self.edges_at = Incidence(arrays.edges, len(arrays.points))

    def wait(self) -> None:
        """Wait until the threads have finished."""
        self._rays.wait()
        self.triangles_at.wait()
        self.edges_at.wait()

    def in_object(self, points: ArrayLike) -> NDArray[np.float64]:
        """Return (..., 3) points, as the mesh has them, in object coordinates."""
        return np.asarray(points) @ self.to_object.T

    def curve_in_object(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where the points of a curve on the mesh, (k, 3), are seen, in object coordinates."""
        return self.in_object(points if self._bend is None else self._bend(points))

    def pixels(self, sight: Sight, vertices: ArrayLike) -> NDArray[np.float64]:
        """Return where vertices are seen, (k, 2)."""
        return sight.pixels(self.in_object(self.points[vertices]))

    def ray(self, sight: Sight, pixel: tuple[float, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return both ends of the line that a pixel shows, in the coordinates of the points."""
        near, far = sight.from_world(np.array(sight.camera.ray(pixel))) @ self.to_points.T
        return near, far

    def cast(self, sight: Sight, pixel: tuple[float, float]) -> tuple[int, NDArray[np.float64]] | None:
        """Return the first visible triangle along the line that a pixel shows, and where, in object coordinates."""
        origin, end = self.ray(sight, pixel)
        hit = self._rays.first_hit(origin, end - origin)
        if hit is None or hit[1] > 1.0:  # behind the far plane
            return None
        return hit[0], self.to_object @ (origin + hit[1] * (end - origin))

    def can_pick(self, sight: Sight, place: NDArray[np.float64]) -> bool:
        """Return whether a place, (3,) in object coordinates, can be picked: with X-ray always, otherwise if it is visible."""
        return sight.xray or self.sees(sight, place)

    def sees(self, sight: Sight, place: NDArray[np.float64]) -> bool:
        """Return whether a place, (3,) in object coordinates, is visible.

        A face that is nearer by no more than a few pixels hides nothing, because the place may lie in a crease.
        """
        world = sight.to_world(place)
        pixel = sight.camera.to_pixels(world[None])[0]
        if np.isnan(pixel).any():
            return False
        at = (float(pixel[0]), float(pixel[1]))
        hit = self.cast(sight, at)
        if hit is None:
            return True
        near = sight.camera.ray(at)[0]
        before = np.linalg.norm(world - near) - np.linalg.norm(sight.to_world(hit[1]) - near)
        return bool(before <= 6.0 * sight.camera.pixel_size(world))

    def vertices_near(self, sight: Sight, pick: Pick, reach: float) -> dict[int, float]:
        """Return the vertices within reach of the cursor, in pixels, and how near they are, walking over the mesh from a pick."""
        frontier = sorted(set(pick.corners if isinstance(pick, FacePoint) else vertices_of(pick)))
        seen = set(frontier)
        near: dict[int, float] = {}
        while frontier and len(seen) < MAX_NEAR:
            gaps = np.linalg.norm(self.pixels(sight, frontier) - np.asarray(sight.cursor), axis=1)
            inside = {v: gap for v, gap in zip(frontier, gaps.tolist(), strict=True) if gap <= reach}
            near |= inside
            reached = self.edges[self.edges_at.rows(list(inside))]
            frontier = sorted(set(reached.reshape(-1).tolist()) - seen)
            seen.update(frontier)
        return near
