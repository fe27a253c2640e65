# SPDX-License-Identifier: GPL-3.0-or-later
"""Where points of the scene and of an object are seen in a 3D view, and which of them are near a pixel."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Camera:
    """How a region sees the world. Its size is in pixels.

    Attributes
    ----------
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
    """Points in object coordinates, (n, 3), and where they are seen, computed anew only when the camera or the object has moved."""

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


@dataclass(frozen=True, eq=False)
class Sight:
    """A pixel of a view of an object, from the region's bottom left. The object's (4, 4) matrix may rotate, scale and shear.

    `scale` is that of the display. With `xray`, what lies behind faces is found too.
    """

    camera: Camera
    matrix: NDArray[np.float64]
    cursor: tuple[float, float]
    scale: float = 1.0
    xray: bool = False

    @classmethod
    def of(
        cls, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float], scale: float = 1.0, xray: bool = False
    ) -> Sight | None:
        """Return the sight of an object, or None if its matrix flattens it so that nothing of it can be picked."""
        placed = np.array(matrix, dtype=np.float64)
        return None if abs(float(np.linalg.det(placed))) < 1e-30 else cls(camera, placed, cursor, scale, xray)

    @cached_property
    def inverse(self) -> NDArray[np.float64]:
        """(4, 4), takes world coordinates to object coordinates."""
        return np.linalg.inv(self.matrix)

    def to_world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take (..., 3) points from object coordinates to world coordinates."""
        return points @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def from_world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take (..., 3) points from world coordinates to object coordinates."""
        return points @ self.inverse[:3, :3].T + self.inverse[:3, 3]

    def pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where (k, 3) points in object coordinates are seen, (k, 2)."""
        return self.camera.to_pixels(self.to_world(points))


VERTEX_RADIUS = 12.0
"""Pixels around a vertex in which it is picked rather than its edge..."""
VERTEX_SHARE = 0.25
"""...but never over more than this part of the edge, so that every edge can be picked."""
_MAX_PIECES = 24
"""Pieces of curves under one cursor that are tried for one that is not hidden."""


class Segments:
    """Straight pieces of curves in object coordinates, (k, 3) each. A piece has the number of its curve, its owner."""

    def __init__(self, curves: list[NDArray[np.float64]]) -> None:
        none = np.empty((0, 3))
        self.starts = Projected(np.concatenate([none, *(curve[:-1] for curve in curves)]))
        self.ends = Projected(np.concatenate([none, *(curve[1:] for curve in curves)]))
        self.owners = np.repeat(np.arange(len(curves)), [max(len(curve) - 1, 0) for curve in curves])

    def near(self, sight: Sight, radius: float) -> Iterator[tuple[int, NDArray[np.float64]]]:
        """Yield owners and their points under the cursor, nearest first. An owner that lies there several times comes several times."""
        if not len(self.owners):
            return
        starts = np.stack(self.starts.seen(sight.camera, sight.matrix)[:2], axis=1)
        ends = np.stack(self.ends.seen(sight.camera, sight.matrix)[:2], axis=1)
        part, gaps = nearest_on_segments(sight.cursor, starts, ends)
        rows = np.flatnonzero(gaps <= radius)
        for row in rows[np.argsort(gaps[rows], kind="stable")][:_MAX_PIECES].tolist():
            start, end = self.starts.points[row], self.ends.points[row]
            # Halves on the screen are not halves in space where there is perspective; near enough for a few pixels.
            yield int(self.owners[row]), start + part[row] * (end - start)


def nearest_edge(
    cursor: tuple[float, float], starts: NDArray[np.float64], ends: NDArray[np.float64], scale: float = 1.0
) -> tuple[int, int | None]:
    """Return the segment nearest to a cursor, or -1, and which of its ends, 0 or 1, is meant because the cursor is so near to it, or None.

    Starts and ends, (k, 2), are pixels. An end that is not in front of the viewer is NaN.
    """
    _, gaps = nearest_on_segments(cursor, starts, ends)
    if not len(gaps) or np.isnan(gaps).all():
        return -1, None
    index = int(np.nanargmin(gaps))
    to_ends = np.linalg.norm(np.stack([starts[index], ends[index]]) - np.asarray(cursor), axis=1)
    end = int(np.argmin(to_ends))
    length = float(np.linalg.norm(ends[index] - starts[index]))
    radius = min(VERTEX_RADIUS * scale, VERTEX_SHARE * length)
    return index, end if to_ends[end] <= radius else None
