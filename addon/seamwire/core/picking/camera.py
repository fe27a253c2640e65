# SPDX-License-Identifier: GPL-3.0-or-later
"""How a region sees the world."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


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

    def to_pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project (n, 3) world points to (n, 2) pixels from the bottom left; NaN behind the viewer, or where clipped away."""
        clip = points @ self.perspective[:, :3].T + self.perspective[:, 3]
        shown = (points @ self.clipped[:, :3].T + self.clipped[:, 3] >= 0.0).all(axis=1)
        w = np.where((clip[:, 3] > 1e-9) & shown, clip[:, 3], np.nan)[:, None]
        return (clip[:, :2] / w * 0.5 + 0.5) * (self.width, self.height)
