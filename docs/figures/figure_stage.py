# SPDX-License-Identifier: GPL-3.0-or-later
"""The stage of the paper's figures: meshes with colors, thick lines, ellipses and balls, rendered by Blender's Workbench.

Workbench needs a display, a virtual one will do, and no samples: pictures are clean and small.
"""

from __future__ import annotations

from math import cos, radians, sin
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import ArrayLike, NDArray

CLAY = (0.97, 0.97, 0.98)
INK = (0.08, 0.08, 0.10)
SEED = (0.15, 0.35, 0.95)
_AMBIENT = 0.38
_LIGHTS = (((-0.45, 0.55, 0.70), 0.52), ((0.75, 0.10, 0.55), 0.16), ((0.0, 0.0, 1.0), 0.0), ((0.0, 0.0, 1.0), 0.0))
"""Where each light comes from, in the viewer's axes, and its brightness."""
_SIDES = 8
"""Of a tube."""


class Stage:
    """One picture's objects, around a model that is scaled to fit the unit cube.

    Parameters
    ----------
    points
        (n, 3) the model's vertices.
    view
        Azimuth and elevation of the viewer, degrees.
    width
        Of the picture, pixels.
    ratio
        Its height as a part of the width; None: it is as high as the model needs.
    """

    def __init__(
        self, points: NDArray[np.float64], view: tuple[float, float], width: int, ratio: float | None = None
    ) -> None:
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes, *bpy.data.cameras])
        self._low = points.min(axis=0)
        self._scale = 1.0 / float(np.ptp(points, axis=0).max())
        self._middle = 0.5 * np.ptp(points, axis=0) * self._scale
        self._corners = self._placed(points)
        self._zoom = 1.0
        self._aim: NDArray[np.float64] | None = None
        self._view = view
        seen = self._corners @ np.array(turn(*view).to_matrix())
        wide, high, _ = np.ptp(seen, axis=0)
        if ratio is None:
            ratio = min(1.5, (high + 0.06 * wide) / (1.06 * wide))
        self._settings((width, int(np.ceil(width * ratio))))

    def _placed(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return (points - self._low) * self._scale - self._middle

    # What is on it

    def mesh(self, points: NDArray[np.float64], triangles: NDArray[np.integer], colors: ArrayLike = CLAY) -> None:
        """Add triangles with one color, (3,), one a vertex, (n, 3), or one a face, (m, 3); a face's are seen as flat."""
        colors = np.asarray(colors, dtype=np.float64)
        per_face = colors.ndim == 2 and len(colors) == len(triangles) and len(colors) != len(points)
        corner = np.repeat(colors, 3, axis=0) if per_face else np.broadcast_to(colors, (len(points), 3))[triangles]
        self._add(self._placed(points), triangles, corner.reshape(-1, 3), smooth=not per_face)

    def wireframe(self, points: NDArray[np.float64], edges: NDArray[np.integer], width: float = 0.0012) -> None:
        """Add edges as thin dark lines; width in sides of the unit cube."""
        ends = points[edges]
        self.segments(ends, np.broadcast_to(INK, (len(ends), 3)), width, sides=3)

    def segments(self, ends: NDArray[np.float64], colors: ArrayLike, width: float, sides: int = _SIDES) -> None:
        """Add straight pieces, (k, 2, 3), with a color each, as tubes."""
        ends = self._placed(ends.reshape(-1, 3)).reshape(-1, 2, 3)
        along = ends[:, 1] - ends[:, 0]
        lengths = np.linalg.norm(along, axis=1)
        ends, along = ends[lengths > 1e-9], along[lengths > 1e-9]
        colors = np.broadcast_to(np.asarray(colors, dtype=np.float64), (len(lengths), 3))[lengths > 1e-9]
        if not len(ends):
            return
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        # Ends reach a little over, so that a curve has no gaps at its corners.
        ends = ends + np.stack([-along, along], axis=1) * (0.3 * width)
        side = np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)])
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        other = np.cross(along, side)
        angle = 2.0 * np.pi * np.arange(sides) / sides
        ring = 0.5 * width * (np.cos(angle)[:, None, None] * side + np.sin(angle)[:, None, None] * other)
        points = (ends[:, :, None] + ring.transpose(1, 0, 2)[:, None]).reshape(-1, 3)
        at = np.arange(sides)
        quads = np.stack([at, (at + 1) % sides, sides + (at + 1) % sides, sides + at], axis=1)
        quads = (np.arange(len(ends))[:, None, None] * 2 * sides + quads).reshape(-1, 4)
        triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        owner = np.concatenate([np.repeat(np.arange(len(ends)), sides)] * 2)
        self._add(points, triangles, np.repeat(colors[owner], 3, axis=0), smooth=True)

    def line(self, points: NDArray[np.float64], color: ArrayLike, width: float = 0.008) -> None:
        """Add one curve, (p, 3)."""
        if len(points) > 1:
            self.segments(np.stack([points[:-1], points[1:]], axis=1), color, width)

    def balls(self, places: NDArray[np.float64], color: ArrayLike = SEED, radius: float = 0.011) -> None:
        """Add a ball at each place, (k, 3)."""
        around, across = np.meshgrid(2.0 * np.pi * np.arange(16) / 16, np.pi * np.arange(9) / 8)
        ball = np.stack(
            [np.sin(across) * np.cos(around), np.sin(across) * np.sin(around), np.cos(across)], axis=-1
        ).reshape(-1, 3)
        i, j = (part.ravel() for part in np.meshgrid(np.arange(16), np.arange(8)))
        a, b, c, d = j * 16 + i, j * 16 + (i + 1) % 16, (j + 1) * 16 + i, (j + 1) * 16 + (i + 1) % 16
        faces = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)])
        centres = self._placed(np.asarray(places, dtype=np.float64).reshape(-1, 3))
        points = (centres[:, None] + radius * ball).reshape(-1, 3)
        triangles = (np.arange(len(centres))[:, None, None] * len(ball) + faces).reshape(-1, 3)
        self._add(
            points, triangles, np.broadcast_to(np.asarray(color, dtype=np.float64), (3 * len(triangles), 3)), True
        )

    def ellipses(
        self,
        centres: NDArray[np.float64],
        normals: NDArray[np.float64],
        axes: NDArray[np.float64],
        colors: ArrayLike,
        lift: float = 0.003,
    ) -> None:
        """Add flat ellipses: centres and normals, (k, 3), semi-axes, (k, 2, 3), both in the model's coordinates, a color each."""
        count = len(centres)
        angle = 2.0 * np.pi * np.arange(32) / 32
        rims = centres[:, None] + np.einsum("kac,ia->kic", axes, np.stack([np.cos(angle), np.sin(angle)], axis=1))
        points = np.concatenate([centres[:, None], rims], axis=1).reshape(-1, 3)
        points = points + np.repeat(normals, 33, axis=0) * (lift / self._scale)
        at = np.arange(32)
        fan = np.stack([np.zeros_like(at), 1 + at, 1 + (at + 1) % 32], axis=1)
        triangles = (np.arange(count)[:, None, None] * 33 + fan).reshape(-1, 3)
        colors = np.broadcast_to(np.asarray(colors, dtype=np.float64), (count, 3))
        self._add(self._placed(points), triangles, np.repeat(colors, 32 * 3, axis=0), smooth=False)

    def look_at(self, place: NDArray[np.float64], zoom: float) -> None:
        """Look at a place in the model's coordinates from so many times as near."""
        self._aim, self._zoom = self._placed(np.asarray(place)), zoom

    def turn_to(self, normal: NDArray[np.float64]) -> None:
        """Look from where a normal points to, not from straight above or below."""
        x, y, z = np.asarray(normal) / max(float(np.linalg.norm(normal)), 1e-12)
        self._view = float(np.degrees(np.arctan2(y, x))), float(np.clip(np.degrees(np.arcsin(z)), -70.0, 70.0))

    def _add(self, points: NDArray, triangles: NDArray, corner_colors: NDArray, smooth: bool) -> None:
        from seamwire.mesh.registration import IS_OLD

        mesh = bpy.data.meshes.new("Part")
        count = len(triangles)
        mesh.vertices.add(len(points))
        mesh.vertices.foreach_set("co", np.ascontiguousarray(points, dtype=np.float32).ravel())
        mesh.loops.add(3 * count)
        mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(triangles, dtype=np.int32).ravel())
        mesh.polygons.add(count)
        mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
        if IS_OLD:
            mesh.polygons.foreach_set("loop_total", np.full(count, 3, dtype=np.int32))
        mesh.polygons.foreach_set("use_smooth", np.full(count, smooth))
        attribute = mesh.color_attributes.new("Color", "FLOAT_COLOR", "CORNER")
        colors = np.ones((3 * count, 4), dtype=np.float32)
        colors[:, :3] = _linear(corner_colors)
        attribute.data.foreach_set("color", colors.ravel())
        mesh.update(calc_edges=True)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("Part", mesh))

    # The picture

    def _settings(self, size: tuple[int, int]) -> None:
        scene = bpy.context.scene
        scene.render.engine = "BLENDER_WORKBENCH"
        scene.render.resolution_x, scene.render.resolution_y = size
        scene.render.resolution_percentage = 100
        scene.display.render_aa = "8"
        shading = scene.display.shading
        shading.light, shading.color_type = "STUDIO", "VERTEX"
        shading.show_cavity, shading.cavity_type = True, "WORLD"
        shading.cavity_ridge_factor, shading.cavity_valley_factor = 0.3, 1.0
        shading.show_shadows, shading.shadow_intensity = False, 0.25
        shading.show_specular_highlight = False
        _set_lights()
        scene.display.matcap_ssao_distance = 0.06
        scene.render.film_transparent = True
        scene.view_settings.view_transform = "Standard"
        scene.render.image_settings.file_format = "PNG"
        scene.render.image_settings.color_mode = "RGBA"

    def pixel(self, place: NDArray[np.float64]) -> tuple[int, int]:
        """Return the row and column of the picture where a place in the model's coordinates is."""
        turned, aim, extent = self._camera()
        right, up, _ = turned @ (self._placed(np.asarray(place)) - aim)
        render = bpy.context.scene.render
        width, height = render.resolution_x, render.resolution_y
        return round(0.5 * height - up / extent * width), round(0.5 * width + right / extent * width)

    def _camera(self) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
        """Return the viewer's axes, (3, 3), what is in the middle, and how wide the part is that is seen."""
        render = bpy.context.scene.render
        width, height = render.resolution_x, render.resolution_y
        turned = np.array(turn(*self._view).to_matrix().inverted())
        seen = self._corners @ turned.T
        low, top = seen.min(axis=0), seen.max(axis=0)
        aim = turned.T @ (0.5 * (low + top)) if self._aim is None else self._aim
        extent = max(top[0] - low[0], (top[1] - low[1]) * width / height)
        return turned, aim, 1.06 * extent / self._zoom

    def render(self, path: Path) -> NDArray[np.float64]:
        """Return the picture, (height, width, 3), top row first, on white."""
        turned, aim, extent = self._camera()
        return self._shot(path, turned, aim, extent)

    def render_part(self, path: Path, place: NDArray[np.float64], zoom: float, size: int) -> NDArray[np.float64]:
        """Return a square of the picture around a place in the model's coordinates, so many times larger, `size` pixels wide."""
        turned, _, extent = self._camera()
        render = bpy.context.scene.render
        before = render.resolution_x, render.resolution_y
        self._settings((size, size))
        picture = self._shot(path, turned, self._placed(np.asarray(place)), extent * size / before[0] / zoom)
        self._settings(before)
        return picture

    @staticmethod
    def _shot(path: Path, turned: NDArray[np.float64], aim: NDArray[np.float64], extent: float) -> NDArray[np.float64]:
        scene = bpy.context.scene
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(camera)
        scene.camera = camera
        camera.rotation_euler = Matrix(turned.T.tolist()).to_euler()
        camera.data.type = "ORTHO"
        width, height = scene.render.resolution_x, scene.render.resolution_y
        # The scale of an orthographic camera is of the longer side.
        camera.data.ortho_scale = extent * max(1.0, height / width)
        camera.location = Vector((aim + 4.0 * turned[2]).tolist())
        camera.data.clip_start, camera.data.clip_end = 0.1, 8.0
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(str(path))
        pixels = np.empty(width * height * 4, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        path.unlink()
        pixels = pixels.reshape(height, width, 4)[::-1].astype(np.float64)
        return pixels[..., :3] * pixels[..., 3:] + 1.0 - pixels[..., 3:]


def _set_lights() -> None:
    """Light the stage softly from the upper left: no part is so dark that its color is not seen."""
    system = bpy.context.preferences.system
    system.use_studio_light_edit = True
    system.light_ambient = (_AMBIENT,) * 3
    for light, (direction, brightness) in zip(system.solid_lights, _LIGHTS, strict=False):
        light.use = brightness > 0.0
        light.diffuse_color, light.specular_color = (brightness,) * 3, (0.0,) * 3
        light.direction, light.smooth = direction, 0.2


def turn(azimuth: float, elevation: float) -> Euler:
    """Return how a camera is turned that looks at the origin from azimuth and elevation, degrees."""
    flat, high = radians(azimuth), radians(elevation)
    towards = Vector((cos(flat) * cos(high), sin(flat) * cos(high), sin(high)))
    return (-towards).to_track_quat("-Z", "Y").to_euler()


def _linear(color: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn screen colors (sRGB) into the linear ones that Blender computes with."""
    return np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
