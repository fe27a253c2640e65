# SPDX-License-Identifier: GPL-3.0-or-later
"""One wire with the module that pip installed. A type checker reads this file too."""

from __future__ import annotations

import numpy as np
import seamwire_core as sw
from numpy.typing import NDArray


def grid(side: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the points and triangles of a flat square of `side` by `side` cells."""
    row = np.linspace(0, 1, side + 1)
    x, y = (part.ravel() for part in np.meshgrid(row, row, indexing="ij"))
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    halves = [corner[:, None] + [0, side + 1, side + 2], corner[:, None] + [0, side + 2, 1]]
    return np.stack([x, y, 0 * x], axis=1), np.concatenate(halves).astype(np.int32)


surface = sw.Surface(*grid(8))
field = sw.distance_field(sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface))), 0)
wire: sw.Wire | None = field.trace(80)
if wire is None:
    raise SystemExit("There is no wire across the unit square.")
length: float = wire.length
corners: NDArray[np.float64] = wire.points
if not np.isclose(length, np.sqrt(2)) or not np.allclose(corners[[0, -1]], [[0, 0, 0], [1, 1, 0]]):
    raise SystemExit(f"The wire across the unit square is {length:.3f} long, from {corners[0]} to {corners[-1]}.")
print(f"seamwire_core {sw.__version__}: a wire of {len(corners)} points, {length:.3f} long")
