# SPDX-License-Identifier: GPL-3.0-or-later
"""A pixel of a view, and the object that is looked for under it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .camera import Camera


@dataclass(frozen=True, eq=False)
class Sight:
    """A pixel of a view of an object.

    Parameters
    ----------
    camera
        How the view shows the world.
    matrix
        (4, 4) the object's matrix. It may rotate, scale and shear.
    cursor
        Pixels from the region's bottom left.
    scale
        Of the display.
    xray
        Whether to find what lies behind faces too.
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
