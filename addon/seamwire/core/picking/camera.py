# SPDX-License-Identifier: GPL-3.0-or-later
"""Where points of the scene are seen in a 3D view, and what a pixel of it shows."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Camera:
    """How a region sees the world.

    Parameters
    ----------
    width, height
        Size in pixels.
    perspective
        (4, 4), takes world coordinates to clip space.
    clipped
        (k, 4) the planes of Blender's clipping border: what lies on the negative side of one is not shown.
    """

    width: float
    height: float
    perspective: NDArray[np.float64]
    clipped: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 4)))

    def shows(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which of (n, 3) world points lie inside the clipping border."""
        return (points @ self.clipped[:, :3].T + self.clipped[:, 3] >= 0.0).all(axis=1)

    @cached_property
    def inverse(self) -> NDArray[np.float64]:
        """(4, 4), takes clip space to world coordinates."""
        return np.linalg.inv(self.perspective)

    def to_pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project (n, 3) world points to (n, 2) pixels from the bottom left; NaN behind the viewer, or where clipped away."""
        clip = points @ self.perspective[:, :3].T + self.perspective[:, 3]
        w = np.where((clip[:, 3] > 1e-9) & self.shows(points), clip[:, 3], np.nan)[:, None]
        return (clip[:, :2] / w * 0.5 + 0.5) * (self.width, self.height)

    def ray(self, cursor: tuple[float, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return two world points on the line that a pixel shows: on the near and the far plane, or the clipping border."""
        x, y = 2.0 * cursor[0] / self.width - 1.0, 2.0 * cursor[1] / self.height - 1.0
        ends = np.array([[x, y, -1.0, 1.0], [x, y, 1.0, 1.0]]) @ self.inverse.T
        near, far = ends[:, :3] / ends[:, 3:]
        for plane in self.clipped:
            first, last = near @ plane[:3] + plane[3], far @ plane[:3] + plane[3]
            if first < 0.0 <= last:
                near = near + first / (first - last) * (far - near)
            elif last < 0.0 <= first:
                far = near + first / (first - last) * (far - near)
        return near, far

    def pixel_size(self, point: NDArray[np.float64]) -> float:
        """Return how far apart two world points are that are seen a pixel apart, as far away as a point."""
        clip = self.perspective @ (*point, 1.0)
        beside = self.inverse @ np.add(clip, (2.0 / self.width * clip[3], 0.0, 0.0, 0.0))
        return float(np.linalg.norm(beside[:3] / beside[3] - point))


class Projected:
    """Points and where they are seen, computed anew only when the camera or the object has moved.

    Parameters
    ----------
    points
        (n, 3) in object coordinates.
    """

    def __init__(self, points: NDArray[np.float64]) -> None:
        self.points = points
        self._key: tuple[object, ...] = ()
        self._found: tuple[NDArray, ...] = ()

    def seen(self, camera: Camera, matrix: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        """Return x and y in pixels and the depth, larger farther away; NaN behind the viewer."""
        world = np.array(matrix, dtype=np.float64)
        key = (camera.width, camera.height, camera.perspective.tobytes(), camera.clipped.tobytes(), world.tobytes())
        if key != self._key:
            to_clip = (camera.perspective @ world).astype(self.points.dtype)
            clip = self.points @ to_clip[:, :3].T
            clip += to_clip[:, 3]
            with np.errstate(divide="ignore", invalid="ignore"):
                shown = clip[:, 3] > 1e-9
                if len(camera.clipped):
                    shown &= camera.shows(self.points @ world[:3, :3].T + world[:3, 3])
                w = np.where(shown, clip[:, 3], np.nan)
                self._found = tuple(
                    np.ascontiguousarray(part)
                    for part in (
                        (clip[:, 0] / w + 1.0) * (0.5 * camera.width),
                        (clip[:, 1] / w + 1.0) * (0.5 * camera.height),
                        clip[:, 2] / w,
                    )
                )
            self._key = key
        return self._found

    def near(self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float], radius: float) -> NDArray[np.int64]:
        """Return the rows of the points that are seen in a square around the cursor."""
        x, y, _ = self.seen(camera, matrix)
        rows = np.flatnonzero(np.abs(x - cursor[0]) <= radius)
        return rows[np.abs(y[rows] - cursor[1]) <= radius]
