# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines, dots, tinted triangles and text on the GPU. Knows nothing of wires."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import blf
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.picking.picker import Camera
from .theme import HALO, Color, Style
from .viewport import clipping_planes

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    _Pass = tuple[gpu.types.GPUBatch | None, Color, float]
    """What to draw, its color and its width."""

_SOFT = ((1.0, 0.3), (0.75, 0.35), (0.5, 0.45))
"""Widths and opacities that together make a band fade towards its sides."""
_TURN = np.linspace(0.0, 2.0 * np.pi, 25)
_DISC = np.stack([np.cos(_TURN), np.sin(_TURN), np.zeros_like(_TURN)], axis=1)
_FONT = 0
_BORDERS = 8
"""The number of clipping borders to cache drawings for. Each view has its own border, or no border."""
_HIDDEN_DASH = 4.0
"""Pixels of a dash where the mesh lies before a line, and of the gap after it."""
_HIDDEN_WIDTH = 0.55
"""How wide a line is there, as part of its width elsewhere."""
_MOST_DASHED = 20_000
"""Segments that are dashed there: of more, each move of the view would take long."""
_MOST_DASHES = 200_000
OVER = 1.5
"""Pixels by which what is drawn over faces is nearer than they are."""


def sees_through(space: bpy.types.SpaceView3D) -> bool:
    """Whether a 3D view shows what lies behind faces, so that Blender leaves no depth of them."""
    shading = space.shading
    if shading.type == "WIREFRAME":
        return shading.show_xray_wireframe
    return shading.type == "SOLID" and shading.show_xray


@contextmanager
def blended(depth: str, unseen: bool = False) -> Iterator[None]:
    """Draw with opacity and a depth test, ``LESS_EQUAL``, ``GREATER`` or ``NONE``, and restore the state.

    `unseen` says to draw nothing but depth, which is left alone otherwise.
    """
    state = gpu.state
    before = state.blend_get(), state.depth_test_get(), state.depth_mask_get()
    state.blend_set("ALPHA")
    state.depth_test_set(depth)
    state.depth_mask_set(unseen)
    state.color_mask_set(*[not unseen] * 4)
    try:
        yield
    finally:
        state.color_mask_set(True, True, True, True)
        state.blend_set(before[0])
        state.depth_test_set(before[1])
        state.depth_mask_set(before[2])


class Eye:
    """From where an object is seen in the region that is being drawn.

    `model`, (4, 4), takes what is drawn to world coordinates, and `to_clip`, (4, 4), to clip coordinates.
    """

    def __init__(self, region_3d: bpy.types.RegionView3D, model: Matrix) -> None:
        self.size = gpu.state.viewport_get()[2:]
        self.scale = bpy.context.preferences.system.ui_scale
        self.is_orthographic = region_3d.window_matrix[3][3] != 0.0
        self.to_clip = np.array(region_3d.window_matrix @ region_3d.view_matrix @ model, dtype=np.float64)
        self._model_view = region_3d.view_matrix @ model
        self._pixel = 2.0 / (region_3d.window_matrix[1][1] * self.size[1])
        self._planes = clipping_planes(region_3d) @ np.array(model, dtype=np.float64)
        # Projects (n, 3) to (n, 2) pixels from the lower left corner of the region; NaN behind the viewer.
        self.on_screen = Camera(*self.size, self.to_clip).to_pixels
        # The view's clipping border in the coordinates of what is drawn. Empty without a border.
        self.border = self._planes.tobytes()
        # The same as long as all is seen at the same place on the screen.
        self.key = self.to_clip.tobytes() + bytes(str(self.size), "ascii")

    def shows(self, points: NDArray[np.float64]) -> NDArray[np.bool_] | None:
        """Return which of (n, 3) points lie inside the view's clipping border; None: it has none."""
        if not len(self._planes):
            return None
        return (points @ self._planes[:, :3].T + self._planes[:, 3] >= 0.0).all(axis=1)

    def lifted(self, pixels: float) -> Matrix:
        """Return the model-view matrix that brings all nearer to the viewer by the depth of a number of pixels.

        A line some pixels wide would sink into a surface that it lies on, by as much as the surface is steep. It is drawn a few pixels
        nearer at any distance. That keeps it out of the surface, but hides it behind thicker parts.
        """
        depth = pixels * self.scale * self._pixel
        if self.is_orthographic:
            return Matrix.Translation((0.0, 0.0, depth)) @ self._model_view
        # Towards the eye: what is seen stays in its place on the screen.
        return Matrix.Scale(1.0 - depth, 4) @ self._model_view

    @property
    def facing(self) -> NDArray[np.float64]:
        """The direction towards the viewer, (3,) of length 1, in the coordinates of what is drawn."""
        found = np.array(self._model_view, dtype=np.float64)[2, :3]
        return found / max(float(np.linalg.norm(found)), 1e-300)

    def pixel_sizes(self, depths: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how large a pixel is at depths (view coordinates, negative ahead)."""
        return np.full_like(depths, self._pixel) if self.is_orthographic else self._pixel * np.abs(depths)


class Within:
    """Keeps the part of a drawing within a view's clipping border, for the last few borders. `make` makes it for an eye."""

    def __init__(self, make: Callable[[Eye], Any]) -> None:
        self._make = make
        self._made: dict[bytes, Any] = {}

    def of(self, eye: Eye) -> Any:  # noqa: ANN401 - what `make` makes
        if eye.border not in self._made:
            if len(self._made) == _BORDERS:
                del self._made[next(iter(self._made))]
            self._made[eye.border] = self._make(eye)
        return self._made[eye.border]


class Made:
    """Keeps what was made, by name, until it is wanted for another key."""

    def __init__(self) -> None:
        self._made: dict[Hashable, tuple[object, Any]] = {}

    def of(self, name: Hashable, key: object, make: Callable[[], Any]) -> Any:  # noqa: ANN401 - what `make` makes
        if name not in self._made or self._made[name][0] != key:
            self._made[name] = key, make()
        return self._made[name][1]

    def clear(self) -> None:
        self._made.clear()


class Lines:
    """Segments of one style, ready to be drawn, by their ends, (k, 2, 3); those of a curve in order: dashes run on over its corners.

    They are drawn as far as the view's clipping border leaves them, under the depth test that is set.
    """

    def __init__(self, style: Style, ends: NDArray[np.float64]) -> None:
        self.style = style
        self._ends = ends
        self._shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
        self._plain = self._make(ends)
        self._dashed = Made()  # by the length of a dash
        self._within = Within(self._inside)

    def _inside(self, eye: Eye) -> Lines:
        inside = eye.shows(self._ends.mean(axis=1))
        return self if inside is None or inside.all() else Lines(self.style, self._ends[inside])

    def _make(self, ends: NDArray[np.float64]) -> gpu.types.GPUBatch | None:
        if not len(ends):
            return None  # Blender makes none of nothing
        return batch_for_shader(self._shader, "LINES", {"pos": ends.reshape(-1, 3).astype(np.float32)})

    def _in_dashes(self, eye: Eye, length: float) -> gpu.types.GPUBatch | None:
        return self._dashed.of(length, eye.key, lambda: self._make(dashes(self._ends, eye, length * eye.scale)))

    def draw(self, eye: Eye) -> None:
        lines = self._within.of(eye)
        lines._draw(eye, lines._passes(eye))

    def draw_hidden(self, eye: Eye, opacity: float) -> None:
        """Draw what the mesh lies before, in thin dashes: nobody should take it for a line on the surface."""
        lines, style = self._within.of(eye), self.style
        if style.soft or len(lines._ends) > _MOST_DASHED:
            lines._draw(eye, lines._passes(eye, opacity, rim=False))
            return
        color = (*style.color[:3], style.color[3] * opacity)
        lines._draw(eye, [(lines._in_dashes(eye, _HIDDEN_DASH), color, max(1.0, _HIDDEN_WIDTH * style.width))])

    def _passes(self, eye: Eye, opacity: float = 1.0, rim: bool = True) -> list[_Pass]:
        style = self.style
        batch = self._in_dashes(eye, style.dash) if style.dash else self._plain
        passes: list[_Pass] = [(batch, color, width) for color, width in layers(style, opacity, rim)]
        if style.dash and style.halo and rim:
            # Light dashes are seen on a light surface by the dark gaps between them.
            passes.insert(0, (self._plain, (*HALO[:3], HALO[3] * opacity), style.width + style.halo))
        return passes

    def _draw(self, eye: Eye, passes: Iterable[_Pass]) -> None:
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(eye.lifted(self.style.lift))
            self._shader.bind()
            self._shader.uniform_float("viewportSize", eye.size)
            for batch, color, width in passes:
                if batch is not None:
                    self._shader.uniform_float("lineWidth", width * eye.scale)
                    self._shader.uniform_float("color", color)
                    batch.draw(self._shader)


def layers(style: Style, opacity: float, rim: bool) -> list[tuple[Color, float]]:
    """Return colors and widths to draw one over the other: a dark rim, a ring, the line or the dot itself."""
    *rgb, alpha = style.color
    if style.soft:
        return [((*rgb, alpha * opacity * share), style.width * part) for part, share in _SOFT]
    found = []
    outside = style.width + (2.0 * style.ring[0] if style.ring else 0.0)
    if rim and style.halo:
        found.append(((*HALO[:3], HALO[3] * alpha * opacity), outside + style.halo))
    if style.ring:
        *ring, ring_alpha = style.ring[1]
        found.append(((*ring, ring_alpha * opacity), outside))
        if rim:
            found.append(((*HALO[:3], opacity), style.width + 2.0))
    return [*found, ((*rgb, alpha * opacity), style.width)]


def dashes(ends: NDArray[np.float64], eye: Eye, length: float) -> NDArray[np.float64]:
    """Cut segments, (k, 2, 3), into dashes, (d, 2, 3), of a length in pixels, as long as the gaps between them.

    If there were more than `_MOST_DASHES`, the segments come back as they are.
    """
    pixels = eye.on_screen(ends.reshape(-1, 3)).reshape(-1, 2, 2)
    sizes = np.nan_to_num(np.linalg.norm(pixels[:, 1] - pixels[:, 0], axis=1))
    after = np.cumsum(sizes)
    before = after - sizes
    first = np.floor(before / (2.0 * length)).astype(np.int64)
    counts = np.floor(after / (2.0 * length)).astype(np.int64) - first + 1
    if not len(ends) or counts.sum() > _MOST_DASHES:
        return ends
    owner = np.repeat(np.arange(len(ends)), counts)
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts) + first[owner]
    # Dash number i covers pixels 2 i to 2 i + 1 lengths from the beginning.
    size = np.maximum(sizes[owner], 1e-9)
    low = np.clip((2.0 * length * number - before[owner]) / size, 0.0, 1.0)
    high = np.clip((2.0 * length * number + length - before[owner]) / size, 0.0, 1.0)
    some = high > low
    owner, low, high = owner[some], low[some, None], high[some, None]
    along = ends[owner, 1] - ends[owner, 0]
    return np.stack([ends[owner, 0] + low * along, ends[owner, 0] + high * along], axis=1)


def draw_dots(style: Style, places: NDArray[np.float64], eye: Eye, opacity: float = 1.0, rim: bool = True) -> None:
    """Draw discs that face the viewer at places, (k, 3)."""
    view = np.array(eye.lifted(style.lift), dtype=np.float64)
    centres = places @ view[:3, :3].T + view[:3, 3]
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    with gpu.matrix.push_pop():
        gpu.matrix.load_matrix(Matrix.Identity(4))
        shader.bind()
        for color, width in layers(style, opacity, rim):
            radii = 0.5 * width * eye.scale * eye.pixel_sizes(centres[:, 2])
            edge = centres[:, None] + radii[:, None, None] * _DISC
            fans = np.stack([np.broadcast_to(centres[:, None], edge[:, 1:].shape), edge[:, :-1], edge[:, 1:]], axis=2)
            shader.uniform_float("color", color)
            batch_for_shader(shader, "TRIS", {"pos": fans.reshape(-1, 3).astype(np.float32)}).draw(shader)


def whole(triangles: NDArray[np.integer], inside: NDArray[np.bool_] | None) -> NDArray[np.integer]:
    """Return the triangles whose corners are all inside. `inside` is None if everything is."""
    return triangles if inside is None else triangles[inside[triangles].all(axis=1)]


class ColoredFaces:
    """Triangles of one mesh, drawn in a few colors; the vertices, (n, 3), are handed to the GPU once."""

    def __init__(self, points: NDArray[np.float64]) -> None:
        self._shader = gpu.shader.from_builtin("UNIFORM_COLOR")
        self._places = points
        form = gpu.types.GPUVertFormat()
        form.attr_add(id="pos", comp_type="F32", len=3, fetch_mode="FLOAT")
        self._points = gpu.types.GPUVertBuf(form, len(points))
        self._points.attr_fill("pos", np.ascontiguousarray(points, dtype=np.float32))
        self.fill(())

    def fill(self, pieces: Iterable[tuple[int, NDArray[np.integer]]]) -> None:
        """Draw other triangles from here on: pairs of the number of a color and triangles, (k, 3)."""
        self._pieces = list(pieces)
        self._within = Within(self._make)

    def _make(self, eye: Eye) -> list[tuple[int, gpu.types.GPUBatch]]:
        inside, made = eye.shows(self._places), []
        for color, triangles in self._pieces:
            seen = np.ascontiguousarray(whole(triangles, inside), dtype=np.uint32)
            if len(seen):
                indices = gpu.types.GPUIndexBuf(type="TRIS", seq=seen)
                made.append((color, gpu.types.GPUBatch(type="TRIS", buf=self._points, elem=indices)))
        return made

    def draw_over(self, eye: Eye, colors: Sequence[Color], lift: float = OVER) -> None:
        """Draw those that the view's clipping border leaves whole over the mesh, in the view that Blender is drawing now."""

        def draw(lift: float) -> None:
            with gpu.matrix.push_pop():
                gpu.matrix.load_matrix(eye.lifted(lift))
                self._shader.bind()
                for number, batch in self._within.of(eye):
                    self._shader.uniform_float("color", colors[number])
                    batch.draw(self._shader)

        draw_over(draw, lift)


def draw_over(draw: Callable[[float], None], lift: float = OVER) -> None:
    """Draw over the mesh, with opacity, by a number of pixels nearer to the viewer. `draw` takes the pixels to lift faces by."""
    if sees_through(bpy.context.space_data):
        # Else all layers of the mesh would be tinted, one over the other, and no wire would be seen to be hidden.
        with blended("LESS_EQUAL", unseen=True):
            draw(0.0)
    with blended("LESS_EQUAL"):
        draw(lift)


# On the screen: pixels of the region from its bottom left


def text_size(scale: float) -> float:
    return bpy.context.preferences.ui_styles[0].widget.points * scale


def set_text(size: float) -> None:
    """Make text of this size what `text_width` measures and `draw_text` draws."""
    blf.size(_FONT, size)


def text_width(text: str) -> float:
    return blf.dimensions(_FONT, text)[0]


def draw_text(text: str, at: tuple[float, float], color: Sequence[float], shadow: bool = True) -> None:
    blf.color(_FONT, *color)
    if shadow:
        # As Blender's own text in the viewport: dark under light text, light under dark.
        bright = sum(color[:3]) > 1.2
        blf.enable(_FONT, blf.SHADOW)
        blf.shadow(_FONT, 5, *((0.0, 0.0, 0.0, 0.8) if bright else (1.0, 1.0, 1.0, 0.6)))
        blf.shadow_offset(_FONT, 1, -1)
    blf.position(_FONT, round(at[0]), round(at[1]), 0.0)
    blf.draw(_FONT, text)
    blf.disable(_FONT, blf.SHADOW)


def draw_rectangle(low: tuple[float, float], high: tuple[float, float], color: Color, round_by: float = 0.0) -> None:
    """Fill a rectangle, its corners rounded by so many pixels."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    (left, bottom), (right, top) = low, high
    # Four arcs of seven points, counterclockwise from the right: around the corners, moved inwards.
    angles = np.add.outer(0.5 * np.pi * np.arange(4), np.linspace(0.0, 0.5 * np.pi, 7))
    x = np.array([right, left, left, right]) + round_by * np.array([-1, 1, 1, -1])
    y = np.array([top, top, bottom, bottom]) + round_by * np.array([-1, -1, 1, 1])
    rim = np.stack([x[:, None] + round_by * np.cos(angles), y[:, None] + round_by * np.sin(angles)], axis=2)
    rim = rim.reshape(-1, 2)
    middle = np.broadcast_to(((left + right) / 2, (bottom + top) / 2), rim.shape)
    fan = np.stack([middle, rim, np.roll(rim, -1, axis=0)], axis=1).reshape(-1, 2)
    shader.bind()
    shader.uniform_float("color", color)
    batch_for_shader(shader, "TRIS", {"pos": fan.astype(np.float32)}).draw(shader)
