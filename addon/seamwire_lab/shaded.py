# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles and lines on the GPU with a color for each vertex or segment."""

from __future__ import annotations

from typing import TYPE_CHECKING

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from .tool import Within, draw_over, whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .tool import Eye


class ShadedFaces:
    """Triangles of one mesh with a color at each vertex, handed to the GPU once.

    Parameters
    ----------
    points
        (n, 3).
    triangles
        (m, 3).
    colors
        (n, 4).
    """

    def __init__(
        self, points: NDArray[np.float64], triangles: NDArray[np.integer], colors: NDArray[np.float64]
    ) -> None:
        self._shader = gpu.shader.from_builtin("SMOOTH_COLOR")

        def make(eye: Eye) -> gpu.types.GPUBatch | None:
            seen = whole(triangles, eye.shows(points))
            if not len(seen):
                return None
            return batch_for_shader(
                self._shader,
                "TRIS",
                {"pos": np.ascontiguousarray(points, np.float32), "color": np.ascontiguousarray(colors, np.float32)},
                indices=np.ascontiguousarray(seen, dtype=np.uint32),
            )

        self._within = Within(make)

    def draw(self, eye: Eye, lift: float) -> None:
        """Draw those that the view's clipping border leaves whole, under the depth test that is set."""
        batch = self._within.of(eye)
        if batch is None:
            return
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(eye.lifted(lift))
            self._shader.bind()
            batch.draw(self._shader)

    def draw_over(self, eye: Eye) -> None:
        """Draw what is seen of them over the mesh, as `ColoredFaces.draw_over`."""
        draw_over(lambda lift: self.draw(eye, lift))


class ColoredLines:
    """Segments with a color each, handed to the GPU once.

    Parameters
    ----------
    ends
        (k, 2, 3).
    colors
        (k, 4).
    width
        In pixels at a display scale of 1.
    lift
        As `Style.lift`.
    """

    def __init__(self, ends: NDArray[np.float64], colors: NDArray[np.float64], width: float, lift: float = 3.0) -> None:
        self._shader = gpu.shader.from_builtin("POLYLINE_FLAT_COLOR")
        self._width, self._lift = width, lift

        def make(eye: Eye) -> gpu.types.GPUBatch | None:
            inside = eye.shows(ends.mean(axis=1))
            rows = np.arange(len(ends)) if inside is None else np.flatnonzero(inside)
            if not len(rows):
                return None
            return batch_for_shader(
                self._shader,
                "LINES",
                {
                    "pos": np.ascontiguousarray(ends[rows].reshape(-1, 3), np.float32),
                    "color": np.ascontiguousarray(np.repeat(colors[rows], 2, axis=0), np.float32),
                },
            )

        self._within = Within(make)

    def draw(self, eye: Eye) -> None:
        """Draw those that the view's clipping border leaves, under the depth test that is set."""
        batch = self._within.of(eye)
        if batch is None:
            return
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(eye.lifted(self._lift))
            self._shader.bind()
            self._shader.uniform_float("viewportSize", eye.size)
            self._shader.uniform_float("lineWidth", self._width * eye.scale)
            batch.draw(self._shader)
