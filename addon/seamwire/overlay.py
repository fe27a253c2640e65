# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what the session shows, on the surface, in every 3D view. Decides nothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix, Vector

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import Pick
    from .session import Session

Colour = tuple[float, float, float, float]


@dataclass(frozen=True)
class Style:
    """How a line or a dot looks; width in pixels at a display scale of 1."""

    colour: Colour
    width: float
    halo: float = 0.0
    hidden: float = 0.25
    lift: float = 4.0


ACTIVE = Style((1.0, 0.72, 0.05, 1.0), 4.0, halo=2.5)
OTHER = Style((0.5, 0.8, 1.0, 0.75), 2.0, halo=1.5, hidden=0.15)
KEPT = Style((1.0, 0.25, 0.15, 1.0), 3.5, halo=2.0)
MARKED = Style((1.0, 0.25, 0.15, 0.9), 2.5, halo=1.0, hidden=0.15, lift=3.0)
WILL_MARK = Style((1.0, 0.35, 0.3, 0.9), 2.5, halo=1.0, hidden=0.15, lift=3.0)
LOOP = Style((0.3, 1.0, 0.55, 1.0), 3.5, halo=2.5)
HOVER = Style((1.0, 1.0, 1.0, 1.0), 3.0, halo=2.0, lift=5.0)
SEED = Style((1.0, 1.0, 1.0, 1.0), 9.0, halo=3.5, hidden=0.35, lift=10.0)
HOVER_DOT = Style((1.0, 1.0, 1.0, 1.0), 7.0, halo=3.0, lift=11.0)
HALO: Colour = (0.02, 0.02, 0.03, 0.75)

_DISC = np.linspace(0.0, 2.0 * np.pi, 17)


class Overlay:
    """The drawing of one session over one object.

    Parameters
    ----------
    session
        What to show.
    obj
        Whose mesh it is.
    points
        (n, 3) the vertices as the session has them.
    to_object
        (3, 3) takes those to object coordinates.

    Notes
    -----
    An exception while drawing would be printed on every redraw: it is kept in `error` instead, and nothing more drawn.
    """

    def __init__(
        self, session: Session, obj: bpy.types.Object, points: NDArray[np.float64], to_object: NDArray[np.float64]
    ) -> None:
        self._session = session
        self._obj = obj
        self._points = points
        self._to_object = Matrix(to_object.tolist()).to_4x4()
        self._lines: list[tuple[Style, gpu.types.GPUBatch]] = []
        self._dots: list[tuple[Style, NDArray[np.float64]]] = []
        self._revision = -1
        self._line = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
        self._fill = gpu.shader.from_builtin("UNIFORM_COLOR")
        self._handle: object | None = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")
        self.error: Exception | None = None

    def remove(self) -> None:
        """Stop drawing."""
        if self._handle is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")
            self._handle = None

    def _draw(self) -> None:
        if self.error is not None:
            return
        try:
            self._draw_all(bpy.context.region_data)
        except Exception as error:
            self.error = error

    # What there is to draw

    def _build(self) -> None:
        session = self._session
        pieces: dict[Style, list[NDArray[np.float64]]] = {}

        def add_curve(style: Style, points: NDArray[np.float64]) -> None:
            pieces.setdefault(style, []).append(np.stack([points[:-1], points[1:]], axis=1).reshape(-1, 3))

        def add_edges(style: Style, edges: list[tuple[int, int]]) -> None:
            pieces.setdefault(style, []).append(self._points[np.array(edges).reshape(-1)])

        # What is added first lies below.
        for wire in session.wires:
            if wire.along == "SURFACE":
                add_edges(MARKED, wire.edges())
        for wire in session.wires:
            add_curve(KEPT, wire.points)
        if session.other is not None:
            add_curve(OTHER, session.other.points)
        if session.active is not None:
            if session.active.along == "SURFACE":
                add_edges(WILL_MARK, session.active.edges())
            add_curve(ACTIVE, session.active.points)
        if session.loop_preview is not None:
            add_curve(LOOP, session.loop_preview.points)
        target = None if session.target is None else session.target.pick
        if isinstance(target, tuple):
            add_edges(HOVER, [target])
        self._lines = [
            (style, batch_for_shader(self._line, "LINES", {"pos": np.concatenate(parts).astype(np.float32)}))
            for style, parts in pieces.items()
        ]
        self._dots = []
        seeds = [self._place(pick) for pick in session.seeds()]
        if seeds:
            self._dots.append((SEED, np.array(seeds)))
        if target is not None and not isinstance(target, tuple):
            self._dots.append((HOVER_DOT, self._points[[target]]))
        self._revision = session.revision

    def _place(self, pick: Pick) -> NDArray[np.float64]:
        """Return where a pick is shown: an edge by its middle."""
        return self._points[list(pick)].mean(axis=0) if isinstance(pick, tuple) else self._points[pick]

    # Drawing it

    def _draw_all(self, region_3d: bpy.types.RegionView3D) -> None:
        if self._revision != self._session.revision:
            self._build()
        before = gpu.state.blend_get(), gpu.state.depth_test_get(), gpu.state.depth_mask_get()
        gpu.state.blend_set("ALPHA")
        gpu.state.depth_mask_set(False)
        model = self._obj.matrix_world @ self._to_object
        scale = bpy.context.preferences.system.ui_scale
        try:
            for hidden in (True, False):
                gpu.state.depth_test_set("GREATER" if hidden else "LESS_EQUAL")
                for style, batch in self._lines:
                    self._draw_lines(style, batch, model, region_3d, hidden, scale)
                for style, places in self._dots:
                    self._draw_dots(style, places, model, region_3d, hidden, scale)
        finally:
            gpu.state.blend_set(before[0])
            gpu.state.depth_test_set(before[1])
            gpu.state.depth_mask_set(before[2])

    @staticmethod
    def _passes(style: Style, hidden: bool) -> list[tuple[Colour, float]]:
        """Return colours and widths to draw one over the other: a dark rim, then the line."""
        *rgb, alpha = style.colour
        if hidden:
            return [((*rgb, alpha * style.hidden), style.width)]
        rim = [((*HALO[:3], HALO[3] * alpha), style.width + style.halo)] if style.halo else []
        return [*rim, (style.colour, style.width)]

    def _draw_lines(
        self,
        style: Style,
        batch: gpu.types.GPUBatch,
        model: Matrix,
        region_3d: bpy.types.RegionView3D,
        hidden: bool,
        scale: float,
    ) -> None:
        viewport = gpu.state.viewport_get()
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(lifted(region_3d, viewport[3], style.lift * scale) @ model)
            self._line.bind()
            self._line.uniform_float("viewportSize", viewport[2:])
            for colour, width in self._passes(style, hidden):
                self._line.uniform_float("lineWidth", width * scale)
                self._line.uniform_float("color", colour)
                batch.draw(self._line)

    def _draw_dots(
        self,
        style: Style,
        places: NDArray[np.float64],
        model: Matrix,
        region_3d: bpy.types.RegionView3D,
        hidden: bool,
        scale: float,
    ) -> None:
        height = gpu.state.viewport_get()[3]
        view = lifted(region_3d, height, style.lift * scale) @ model
        centres = np.array([view @ Vector(place) for place in places])
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(Matrix.Identity(4))
            self._fill.bind()
            for colour, width in self._passes(style, hidden):
                radii = 0.5 * width * scale * pixel_sizes(region_3d, height, centres[:, 2])
                self._fill.uniform_float("color", colour)
                batch_for_shader(self._fill, "TRIS", {"pos": discs(centres, radii)}).draw(self._fill)


def pixel_sizes(region_3d: bpy.types.RegionView3D, height: float, depths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how large a pixel is at depths (view coordinates, negative ahead)."""
    size = 2.0 / (region_3d.window_matrix[1][1] * height)
    return np.full_like(depths, size) if _orthographic(region_3d) else size * np.abs(depths)


def lifted(region_3d: bpy.types.RegionView3D, height: float, pixels: float) -> Matrix:
    """Return the view matrix that brings all nearer to the viewer by the depth of a number of pixels.

    A line some pixels wide would sink into a surface that it lies on, by as much as the surface is steep. Drawing it
    nearer by a few pixels' worth, whatever the distance, keeps it out and shows nothing through a part that is thicker.
    """
    depth = pixels * 2.0 / (region_3d.window_matrix[1][1] * height)
    if _orthographic(region_3d):
        return Matrix.Translation((0.0, 0.0, depth)) @ region_3d.view_matrix
    # Towards the eye: what is seen stays in its place on the screen.
    return Matrix.Scale(1.0 - depth, 4) @ region_3d.view_matrix


def _orthographic(region_3d: bpy.types.RegionView3D) -> bool:
    return region_3d.window_matrix[3][3] != 0.0


def discs(centres: NDArray[np.float64], radii: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return triangles, (k, 3), of discs that face the viewer, in view coordinates."""
    rim = np.stack([np.cos(_DISC), np.sin(_DISC), np.zeros_like(_DISC)], axis=1)
    edge = centres[:, None] + radii[:, None, None] * rim
    fans = np.stack([np.broadcast_to(centres[:, None], edge[:, 1:].shape), edge[:, :-1], edge[:, 1:]], axis=2)
    return fans.reshape(-1, 3).astype(np.float32)
