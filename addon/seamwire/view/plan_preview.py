# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws planned wires and the islands that they make over objects in edit mode, and finds them under the mouse."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..core.base import native
from ..core.base.newest import Newest
from ..core.islands.islands import IslandMaker
from ..core.picking.picker import Picker
from ..mesh import settings as chosen
from ..mesh.edit_mesh import Pose
from .edited_objects import edited
from .failures import failures
from .gpu_draw import OVER, ColoredFaces, Eye, Within, blended, draw_over, sees_through
from .overlay import Sheet, draw_corner, free_room
from .theme import Looks, hue_colors, looks_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from .theme import Color, Style
    from .viewport import Place

    Unfold = Callable[[], NDArray[np.float64] | None]


@functools.cache
def _checker_shader() -> gpu.types.GPUShader:
    """Return the shader of `CheckedFaces`, compiled once."""
    info = gpu.types.GPUShaderCreateInfo()
    info.push_constant("MAT4", "to_clip")
    info.push_constant("VEC4", "light")
    info.push_constant("VEC4", "dark")
    info.push_constant("VEC4", "facing")
    info.vertex_in(0, "VEC3", "pos")
    info.vertex_in(1, "VEC2", "square")
    passed = gpu.types.GPUStageInterfaceInfo("seamwire_checker")
    passed.smooth("VEC2", "place")
    passed.smooth("VEC3", "spot")
    info.vertex_out(passed)
    info.fragment_out(0, "VEC4", "color")
    info.vertex_source("void main() { place = square; spot = pos; gl_Position = to_clip * vec4(pos, 1.0); }")
    # Each coordinate is a wave with its zeros at the lines. Edges are as soft as a pixel; tiny squares fade out. Faces that are seen at an
    # angle are darker, as much as `facing.w` says, because the islands' colors cover the mesh's own shading.
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
          vec3 normal = cross(dFdx(spot), dFdy(spot));
          float slant = 1.0 - abs(dot(normal, facing.xyz)) / max(length(normal), 1e-30);
          float shadow = facing.w * slant, alpha = color.a + shadow * (1.0 - color.a);
          color = vec4(color.rgb * color.a / max(alpha, 1e-6), alpha);
        }
        """
    )
    return gpu.shader.create_from_info(info)


class CheckedFaces:
    """Triangles, by the points of their corners, (m, 3, 3), with a checker pattern. The corners lie there at (m, 3, 2), in squares."""

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

    def draw_over(self, eye: Eye, lift: float, shadow: float) -> None:
        """Draw what is seen of them over the mesh, as `ColoredFaces.draw_over`.

        `shadow`, from 0 to 1, says how dark faces are that are seen from the side.
        """
        batch = self._within.of(eye)
        if batch is None:
            return

        def draw(lift: float) -> None:
            self._shader.bind()
            self._shader.uniform_float("to_clip", gpu.matrix.get_projection_matrix() @ eye.lifted(lift))
            self._shader.uniform_float("light", _LIGHT)
            self._shader.uniform_float("dark", _DARK)
            self._shader.uniform_float("facing", (*eye.facing, shadow))
            batch.draw(self._shader)

        draw_over(draw, lift)


_TINT = 0.35
"""The least opacity of the islands: they are what a preview is for."""
_COVER = 0.9
"""The opacity where edges are as short as `_SHORT`: Blender draws edges and vertices over the whole mesh there."""
_SHORT, _LONG = 4.0, 12.0
"""Pixels of an edge at which the mesh's own shading is covered, and from which it is left."""
_SAMPLE = 256
"""How many edges are measured on the screen."""
_SHADOW = 0.7
_OVER_VERTICES = 12.0
"""Pixels by which faces are drawn nearer than the mesh, so that they cover its vertices, which Blender draws nearer too."""
_LIGHT: Color = (1.0, 1.0, 1.0, 0.2)
_DARK: Color = (0.0, 0.0, 0.0, 0.3)
"""The squares of the map. They leave the colors of the islands under them."""
_REACH = 10.0
"""Pixels beside a border in which it is found."""


@dataclass(frozen=True)
class Curves:
    """The curves that are drawn over an object, (k, 3) each, in object coordinates."""

    borders: Sequence[NDArray[np.float64]] = ()  # between parts
    dropped: Sequence[NDArray[np.float64]] = ()  # borders that the artist has dropped
    slits: Sequence[NDArray[np.float64]] = ()  # seams within parts; the mouse does not find them


@dataclass(frozen=True)
class Pointed:
    """A border, a triangle, or both, under the mouse."""

    obj: bpy.types.Object
    border: int | None  # counting on with those that were dropped
    triangle: int | None


class _ObjectPreview:
    def __init__(self, obj: bpy.types.Object, arrays: Arrays) -> None:
        core = native.load()
        self.obj = obj
        self._arrays = replace(arrays, points=arrays.in_object, to_object=np.eye(3))
        self._pose = Pose(self._arrays)
        self._pose.follow(obj)
        self._picker = self._posed_picker()  # threads prepare it
        self._islands = IslandMaker(arrays.triangles, lambda cuts: np.asarray(core.face_segments(arrays.surface, cuts)))
        self._curves = Curves()
        self._seen: list[NDArray[np.float64]] = []  # the curves that the mouse finds, where the mesh is seen
        self._lines: Sheet | None = None
        self._faces: ColoredFaces | None = None
        self._parts = 0  # counts other parts, whose maps are different ones
        self._maps: Newest[tuple[int, Unfold], tuple[int, NDArray[np.float64] | None]] = Newest(
            lambda request: (request[0], request[1]()), "seamwire map", (core.Cancelled,)
        )
        self._squares: NDArray[np.float64] | None = None
        self._checks: CheckedFaces | None = None
        self._tinted: object = None
        self._count = 0
        self.hovered: int | None = None

    @property
    def is_new(self) -> bool:
        found = self._islands.answer
        return self._take_map() or (found is not None and found.key != self._tinted)

    def _take_map(self) -> bool:
        """Show the newest map, if it is for the parts that are shown, and return whether it is new."""
        parts, squares = self._maps.answer or (None, None)
        is_new = parts == self._parts and squares is not self._squares
        if is_new:
            self._squares, self._checks = squares, None
        return is_new

    def follow(self, curves: Curves, cuts: NDArray[np.int32], unfold: Unfold | None) -> None:
        """Show other curves, and ask for the islands of the cuts, and for the map. The former map stays until there is another."""
        self.repose()
        if unfold is None:
            self._parts += 1
            self._squares = self._checks = None
        else:
            self._maps.want((self._parts, unfold))
        self._curves = curves
        self._place_curves()
        self._count += 1
        self._islands.ask(self._count, cuts)

    def repose(self) -> None:
        if self._pose.follow(self.obj):
            self._faces = self._tinted = self._checks = None
            self._picker = self._posed_picker()
            self._place_curves()

    def _place_curves(self) -> None:
        before, self._lines = self._seen, None
        self._seen = [self._pose.places(curve) for curve in (*self._curves.borders, *self._curves.dropped)]
        if len(before) != len(self._seen) or not all(map(np.array_equal, before, self._seen)):
            self.hovered = None  # other slits alone leave the highlight where it is

    def check(self) -> None:
        """Raise what went wrong while islands and maps were computed."""
        self._islands.check()
        self._maps.check()

    def close(self) -> None:
        self._islands.close()
        self._maps.close()

    # Under the mouse

    def _posed_picker(self) -> Picker:
        return Picker(replace(self._arrays, points=self._pose.points))

    def at(self, place: Place) -> tuple[float, Pointed] | None:
        """Return what is under the mouse, and how far away it is; None if it is nothing of the object."""
        scale, xray = bpy.context.preferences.system.ui_scale, sees_through(place.area.spaces.active)
        if not self.obj.visible_in_viewport_get(place.area.spaces.active):
            return None
        where = place.view, self.obj.matrix_world, place.cursor
        hit = self._picker.surface_at(*where)
        border, depth = self._picker.curve_at(self._seen, _REACH, *where, xray, scale) or (None, None)
        if hit is not None:
            return hit.depth, Pointed(self.obj, border, hit.triangle)
        return None if depth is None else (depth, Pointed(self.obj, border, None))

    # Drawing

    def draw(self, looks: Looks) -> None:
        eye = Eye(bpy.context.region_data, self.obj.matrix_world)
        found = self._islands.answer
        if self._faces is None:
            self._faces = ColoredFaces(self._pose.points)
        if found is not None and found.key != self._tinted:
            self._faces.fill(found.pieces)
            self._tinted = found.key
        cover = self._cover(eye)
        tint = max(looks.tint, _TINT)
        lift = OVER + cover * (_OVER_VERTICES - OVER)
        self._faces.draw_over(eye, hue_colors(tint + cover * max(0.0, _COVER - tint)), lift)
        if self._squares is not None or cover > 0.0:
            if self._checks is None:
                corners = self._pose.points[self._arrays.triangles]
                # Without a map all corners lie at one point of a square, so that only the shading is seen.
                self._checks = CheckedFaces(
                    corners, np.zeros((len(corners), 3, 2)) if self._squares is None else self._squares
                )
            self._checks.draw_over(eye, lift, _SHADOW * cover)
        if self._lines is None:
            self._lines = Sheet(self._pose)
            for style, curves in self._styled(looks):
                for curve in curves:
                    self._lines.curve(style, curve)
            self._lines.finish()
        for hidden in (True, False):
            with blended("GREATER" if hidden else "LESS_EQUAL"):
                self._lines.draw_lines(eye, hidden)

    def _cover(self, eye: Eye) -> float:
        """Return how much of the mesh is hidden by its own edges in a view, from 0 to 1."""
        edges = self._arrays.edges[:: len(self._arrays.edges) // _SAMPLE + 1]
        ends = eye.on_screen(self._pose.points[edges].reshape(-1, 3)).reshape(-1, 2, 2)
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        lengths = lengths[np.isfinite(lengths)]
        if not len(lengths):
            return 0.0
        return float(np.interp(np.median(lengths) / eye.scale, (_SHORT, _LONG), (1.0, 0.0)))

    def _styled(self, looks: Looks) -> Iterator[tuple[Style, Sequence[NDArray[np.float64]]]]:
        """Yield the curves in the order in which they are drawn."""
        if self.hovered is not None:
            yield looks.hovered, [[*self._curves.borders, *self._curves.dropped][self.hovered]]
        yield looks.mirrored, self._curves.slits  # thinner than borders, for clicks do not change them
        yield looks.clear, self._curves.dropped
        yield looks.kept, self._curves.borders

    def point(self, border: int | None) -> bool:
        if border == self.hovered:
            return False
        self.hovered, self._lines = border, None
        return True


class PlanPreview:
    """The drawing, in all 3D views, until it is closed."""

    def __init__(self) -> None:
        self._shown: dict[int, _ObjectPreview] = {}  # by the addresses of the objects
        self._handles: list[object] = []
        self._rows: Sequence[tuple[str, str]] = ()

    @property
    def is_open(self) -> bool:
        """Whether it is drawn. Any thread may ask."""
        return bool(self._handles)

    def show(
        self,
        obj: bpy.types.Object,
        arrays: Arrays,
        curves: Curves,
        cuts: NDArray[np.int32],
        unfold: Unfold | None = None,
    ) -> None:
        """Draw wires over an object, and tint the islands that they make, in place of what was drawn over it.

        With the wires, the edges `cuts`, (c, 2), are seams. `unfold` returns the map of the corners of its triangles, (m, 3, 2), in squares
        of a checker pattern. It is called on a thread. None: no map is drawn.
        """
        if not self._handles and not bpy.app.background:
            add = bpy.types.SpaceView3D.draw_handler_add
            self._handles += [
                add(self._draw, (), "WINDOW", "POST_VIEW"),
                add(self._draw_corner, (), "WINDOW", "POST_PIXEL"),
            ]
            edited.covered = True
        address = obj.as_pointer()
        if address not in self._shown:
            self._shown[address] = _ObjectPreview(obj, arrays)
        shown = self._shown[address]
        failures.take("preview")  # another plan is another try
        failures.attempt(("preview", "follow", address), partial(shown.follow, curves, cuts, unfold))
        edited.redraw()

    def tell(self, rows: Sequence[tuple[str, str]]) -> None:
        """Show text in the corner of the views, as `draw_corner` draws it."""
        if rows != self._rows:
            self._rows = rows
            edited.redraw()

    def at(self, place: Place) -> Pointed | None:
        """Return what is under the mouse, of the object that is nearest to the viewer."""
        found = [at for shown in self._shown.values() if (at := shown.at(place)) is not None]
        return min(found, key=lambda at: at[0])[1] if found else None

    def point(self, at: Pointed | None) -> None:
        changed = [shown.point(at.border if at and at.obj == shown.obj else None) for shown in self._shown.values()]
        if any(changed):
            edited.redraw()

    def poll(self) -> None:
        """Show islands that were computed, and follow the poses of the meshes."""
        for address, shown in self._shown.items():
            failures.attempt(("preview", "follow", address), shown.repose)
            failures.attempt(("preview", "islands", address), shown.check)
        changed = [shown.is_new for shown in self._shown.values()]  # each takes its map
        if any(changed):
            edited.redraw()

    def close(self) -> None:
        """Draw nothing any more."""
        if self._handles:
            edited.covered = False
            edited.redraw()
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        for shown in self._shown.values():
            shown.close()
        self._shown.clear()

    def _seen_here(self) -> dict[int, _ObjectPreview]:
        """Return what is seen in the view that Blender is drawing now, by the addresses of the objects."""
        space, layer = bpy.context.space_data, bpy.context.view_layer
        found = {}
        for address, shown in self._shown.items():
            with suppress(ReferenceError):  # the object may be gone
                is_in_scene = layer.objects.get(shown.obj.name) == shown.obj  # another window may show another scene
                if is_in_scene and space.overlay.show_overlays and shown.obj.visible_in_viewport_get(space):
                    found[address] = shown
        return found

    def _draw(self) -> None:
        looks = looks_of(bpy.context.preferences.themes[0].view_3d, chosen.preferences())
        for address, shown in self._seen_here().items():
            failures.attempt(("preview", "draw", address), partial(shown.draw, looks))

    def _draw_corner(self) -> None:
        looks = looks_of(bpy.context.preferences.themes[0].view_3d, chosen.preferences())
        if looks.text == "NONE" or not self._seen_here():
            return
        room = free_room(bpy.context.area, bpy.context.region)
        if room[2] <= 0.0:
            return
        with blended("NONE"):
            draw_corner(self._rows, room[:2], bpy.context.preferences.system.ui_scale)
