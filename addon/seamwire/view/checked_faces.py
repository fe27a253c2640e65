# SPDX-License-Identifier: GPL-3.0-or-later
"""A checker pattern over a mesh, which shows a UV map that no object has yet."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from .gpu_draw import Within, draw_over

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .gpu_draw import Eye
    from .theme import Color


@functools.cache
def _checker_shader() -> gpu.types.GPUShader:
    """Return the shader of `CheckedFaces`, compiled once."""
    info = gpu.types.GPUShaderCreateInfo()
    info.push_constant("MAT4", "to_clip")
    info.push_constant("VEC4", "light")
    info.push_constant("VEC4", "dark")
    info.vertex_in(0, "VEC3", "pos")
    info.vertex_in(1, "VEC2", "square")
    passed = gpu.types.GPUStageInterfaceInfo("seamwire_checker")
    passed.smooth("VEC2", "place")
    info.vertex_out(passed)
    info.fragment_out(0, "VEC4", "color")
    info.vertex_source("void main() { place = square; gl_Position = to_clip * vec4(pos, 1.0); }")
    # Each coordinate is a wave with its zeros at the lines. Edges are as soft as a pixel; tiny squares fade out.
    info.fragment_source(
        """
        void main()
        {
          vec2 pixel = max(fwidth(place), vec2(1e-6));
          vec2 wave = 2.0 * abs(fract(0.5 * place) - 0.5) - 0.5;
          vec2 sides = clamp(2.0 * wave / pixel, -1.0, 1.0);
          float shade = sides.x * sides.y * (1.0 - smoothstep(0.3, 0.7, max(pixel.x, pixel.y)));
          color = shade > 0.0 ? light : dark;
          color.a *= abs(shade);
        }
        """
    )
    return gpu.shader.create_from_info(info)


class CheckedFaces:
    """Triangles with a checker pattern, handed to the GPU once.

    Parameters
    ----------
    corners
        (m, 3, 3) the points of their corners.
    squares
        (m, 3, 2) where the corners lie in the pattern, in squares.
    """

    def __init__(self, corners: NDArray[np.float64], squares: NDArray[np.float64]) -> None:
        self._shader = _checker_shader()

        def make(eye: Eye) -> gpu.types.GPUBatch | None:
            inside = eye.shows(corners.reshape(-1, 3))
            rows = slice(None) if inside is None else inside.reshape(-1, 3).all(axis=1)
            seen = np.ascontiguousarray(corners[rows].reshape(-1, 3), dtype=np.float32)
            if not len(seen):
                return None
            places = np.ascontiguousarray(squares[rows].reshape(-1, 2), dtype=np.float32)
            return batch_for_shader(self._shader, "TRIS", {"pos": seen, "square": places})

        self._within = Within(make)

    def draw_over(self, eye: Eye, light: Color, dark: Color) -> None:
        """Draw what is seen of them over the mesh, as `ColoredFaces.draw_over`, in the colors of the squares."""
        batch = self._within.of(eye)
        if batch is None:
            return

        def draw(lift: float) -> None:
            self._shader.bind()
            self._shader.uniform_float("to_clip", gpu.matrix.get_projection_matrix() @ eye.lifted(lift))
            self._shader.uniform_float("light", light)
            self._shader.uniform_float("dark", dark)
            batch.draw(self._shader)

        draw_over(draw)
