# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a model in Blender: its seams, islands in colors, a checked texture, the UV layout. By Cycles, no display needed."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Vector

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray
    from seamwire.core.network.wires import Wire

FRONT, BACK = (-60.0, 18.0), (125.0, 18.0)
"""Azimuth and elevation of the cameras, degrees."""
BACKDROP = (0.93, 0.94, 0.95)
CLAY = (0.62, 0.64, 0.68)
WIRE = (0.95, 0.22, 0.03)
SEED = (1.0, 0.85, 0.10)
PALETTE = (
    (0.16, 0.42, 0.75),
    (0.93, 0.58, 0.13),
    (0.25, 0.62, 0.32),
    (0.80, 0.25, 0.27),
    (0.50, 0.36, 0.70),
    (0.95, 0.79, 0.28),
    (0.28, 0.68, 0.72),
    (0.88, 0.48, 0.65),
    (0.55, 0.40, 0.28),
    (0.62, 0.77, 0.35),
)


@dataclass(frozen=True)
class Marks:
    """The marks on a model.

    Parameters
    ----------
    wires
        The wires, between vertices.
    islands
        The island of each triangle.
    """

    wires: list[Wire]
    islands: NDArray[np.int32]


class Scene:
    """The model with its wires, seeds, light and cameras.

    Parameters
    ----------
    obj
        The unwrapped model, in object mode.
    network
        The marks on the model.
    triangles, polygon_of
        Its triangles and the polygon that each lies in.
    size
        Of a picture, in pixels.
    samples
        Of light, a pixel.
    seeds
        Whether seeds are shown.
    """

    def __init__(
        self,
        obj: bpy.types.Object,
        network: Marks,
        triangles: NDArray[np.int32],
        polygon_of: NDArray[np.int32],
        size: int = 720,
        samples: int = 64,
        seeds: bool = True,
    ) -> None:
        self._obj = obj
        self._size = size
        self._samples = samples
        self._mesh = obj.data
        self._made: list[bpy.types.ID] = []
        corners = np.array([vertex.co for vertex in self._mesh.vertices])
        used = corners[np.unique(triangles)]
        self._corners = used.ravel().tolist()
        self._centre = Vector((used.min(axis=0) + used.max(axis=0)) / 2)
        self._radius = float(np.linalg.norm(used - np.array(self._centre), axis=1).max())
        islands = np.zeros(len(self._mesh.polygons), dtype=np.int64)
        islands[polygon_of] = network.islands
        self._colors = np.array(PALETTE)[_coloring(network, triangles)][islands]
        self._paint()
        self._smooth()
        self._wires = self._make_wires(network)
        self._seeds = self._make_seeds(network) if seeds else []
        self._light()
        self._render_settings()

    def pictures(self, folder: Path, name: str, progress: Callable[[float], None]) -> None:
        """Render everything into NAME-*.png, and all of it side by side into NAME.png; `progress` receives the fraction done."""
        folder.mkdir(parents=True, exist_ok=True)
        clay, islands, checked = self._clay(), self._island_material(), self._checked()
        tiles = [
            ("wires-front", clay, FRONT, True),
            ("islands-front", islands, FRONT, False),
            ("wires-back", clay, BACK, True),
            ("islands-back", islands, BACK, False),
            ("checked", checked, FRONT, False),
        ]
        images = {}
        for tile, material, view, with_wires in tiles:
            self._show(material, with_wires)
            self._look_from(*view)
            progress(len(images) / len(tiles))
            images[tile] = self._render(folder / f"{name}-{tile}.png")
        images["uv"] = self._uv_layout(folder / f"{name}-uv.png")
        rows = [
            np.concatenate([images["wires-front"], images["islands-front"], images["uv"]], axis=1),
            np.concatenate([images["wires-back"], images["islands-back"], images["checked"]], axis=1),
        ]
        save(np.concatenate(rows[::-1], axis=0), folder / f"{name}.png")

    def islands(self, path: Path) -> NDArray[np.float32]:
        """Render the islands in their colors from the front into a file, and return the picture, bottom row first."""
        self._show(self._island_material(), False)
        self._look_from(*FRONT)
        return self._render(path)

    def strip(self, path: Path) -> None:
        """Render the model with its seams, with a checked texture, and its layout side by side into a file."""
        tiles = []
        for material, with_wires in ((self._island_material(), True), (self._checked(), False)):
            self._show(material, with_wires)
            self._look_from(*FRONT)
            tiles.append(self._render(path))
        tiles.append(self._uv_layout(path))
        save(np.concatenate(tiles, axis=1), path)

    def clean(self) -> None:
        """Leave the model in its islands' colors with its wires, ready to be worked on."""
        self._show(self._island_material(), True)
        for item in self._made:
            bpy.data.objects.remove(item)

    # The model

    def _paint(self) -> None:
        attribute = self._mesh.color_attributes.new("Segments", "FLOAT_COLOR", "CORNER")
        sides = np.array([polygon.loop_total for polygon in self._mesh.polygons])
        colors = np.ones((int(sides.sum()), 4), dtype=np.float32)
        colors[:, :3] = _linear(np.repeat(self._colors, sides, axis=0))
        attribute.data.foreach_set("color", colors.ravel())

    def _smooth(self) -> None:
        self._mesh.polygons.foreach_set("use_smooth", np.ones(len(self._mesh.polygons), dtype=bool))
        if hasattr(self._mesh, "use_auto_smooth"):
            self._mesh.use_auto_smooth = True
            self._mesh.auto_smooth_angle = radians(40)

    def _make_wires(self, network: Marks) -> bpy.types.Object:
        curve = bpy.data.curves.new("Seamwires", "CURVE")
        curve.dimensions = "3D"
        curve.bevel_depth = 0.006 * self._radius
        curve.bevel_resolution = 3
        curve.use_fill_caps = True
        for wire in network.wires:
            line = wire.points
            spline = curve.splines.new("POLY")
            spline.points.add(len(line) - 1)
            spline.points.foreach_set("co", np.concatenate([line, np.ones((len(line), 1))], axis=1).ravel())
        curve.materials.append(_material("Wire", WIRE, roughness=0.35))
        wires = bpy.data.objects.new("Seamwires", curve)
        bpy.context.scene.collection.objects.link(wires)
        return wires

    def _make_seeds(self, network: Marks) -> list[bpy.types.Object]:
        seeds = sorted({seed for wire in network.wires for seed in (wire.start, wire.end)})
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.016 * self._radius)
        ball = bpy.context.object
        ball.data.polygons.foreach_set("use_smooth", np.ones(len(ball.data.polygons), dtype=bool))
        ball.data.materials.append(_material("Seed", SEED, roughness=0.3))
        parent = bpy.data.objects.new("Seeds", None)
        bpy.context.scene.collection.objects.link(parent)
        for number, seed in enumerate(seeds):
            one = ball if number == 0 else bpy.data.objects.new("Seed", ball.data)
            if number > 0:
                bpy.context.scene.collection.objects.link(one)
            one.location = self._mesh.vertices[seed].co
            one.parent = parent
        return list(parent.children)

    def _show(self, material: bpy.types.Material, with_wires: bool) -> None:
        self._mesh.materials.clear()
        self._mesh.materials.append(material)
        for item in (self._wires, *self._seeds):
            item.hide_render = not with_wires
            item.hide_viewport = not with_wires

    # The materials

    def _clay(self) -> bpy.types.Material:
        return _material("Clay", CLAY, roughness=0.75)

    def _island_material(self) -> bpy.types.Material:
        material = bpy.data.materials.get("Segments")
        if material is None:
            material = _material("Segments", CLAY, roughness=0.7)
            nodes = material.node_tree.nodes
            attribute = nodes.new("ShaderNodeVertexColor")
            attribute.layer_name = "Segments"
            material.node_tree.links.new(attribute.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
        return material

    def _checked(self) -> bpy.types.Material:
        material = _material("Checked", CLAY, roughness=0.7)
        nodes, links = material.node_tree.nodes, material.node_tree.links
        checker = nodes.new("ShaderNodeTexChecker")
        checker.inputs["Scale"].default_value = 64.0
        checker.inputs["Color1"].default_value = (0.85, 0.85, 0.85, 1.0)
        checker.inputs["Color2"].default_value = (0.12, 0.22, 0.40, 1.0)
        coordinates = nodes.new("ShaderNodeTexCoord")
        links.new(coordinates.outputs["UV"], checker.inputs["Vector"])
        links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
        return material

    # Light, camera, rendering

    def _light(self) -> None:
        world = bpy.data.worlds.new("Studio")
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5
        bpy.context.scene.world = world
        self._sun = bpy.data.objects.new("Key", bpy.data.lights.new("Key", "SUN"))
        self._sun.data.energy = 2.0
        self._sun.data.angle = radians(12)
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        camera.data.lens = 85.0
        for item in (self._sun, camera):
            bpy.context.scene.collection.objects.link(item)
        bpy.context.scene.camera = camera

    def _look_from(self, azimuth: float, elevation: float) -> None:
        camera = bpy.context.scene.camera
        camera.data.type = "PERSP"
        flat, high = radians(azimuth), radians(elevation)
        towards = Vector((cos(flat) * cos(high), sin(flat) * cos(high), sin(high)))
        camera.rotation_euler = (-towards).to_track_quat("-Z", "Y").to_euler()
        camera.location = self._centre + 10 * self._radius * towards
        bpy.context.view_layer.update()
        camera.location, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), self._corners)
        distance = (camera.location - self._centre).length
        camera.location += 0.06 * distance * towards
        camera.data.clip_start, camera.data.clip_end = 0.01 * distance, 10.0 * distance
        # The light comes over the viewer's left shoulder.
        flat, high = radians(azimuth - 35.0), radians(elevation + 35.0)
        light = Vector((cos(flat) * cos(high), sin(flat) * cos(high), sin(high)))
        self._sun.rotation_euler = (-light).to_track_quat("-Z", "Y").to_euler()

    def _render_settings(self) -> None:
        scene = bpy.context.scene
        scene.render.engine = "CYCLES"
        scene.cycles.device = "CPU"
        scene.cycles.samples = self._samples
        scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
        scene.cycles.max_bounces = 3
        scene.render.resolution_x = scene.render.resolution_y = self._size
        scene.render.resolution_percentage = 100
        scene.render.film_transparent = True
        scene.view_settings.view_transform = "Standard"
        scene.render.image_settings.file_format = "PNG"
        scene.render.image_settings.color_mode = "RGBA"

    def _render(self, path: Path) -> NDArray[np.float32]:
        bpy.context.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        picture = load(path)
        # The pixels' colors are already multiplied by their alpha when Blender reads a straight PNG as premultiplied; blend either way.
        flat = picture[:, :, :3] * picture[:, :, 3:] + np.array(BACKDROP) * (1 - picture[:, :, 3:])
        save(flat, path)
        return flat

    # The UV layout

    def _uv_layout(self, path: Path) -> NDArray[np.float32]:
        """Draw the faces where the unwrapping puts them, and their edges over it."""
        mesh = self._mesh
        flat = np.empty(2 * len(mesh.loops), dtype=np.float32)
        mesh.uv_layers.active.data.foreach_get("uv", flat)
        flat = flat.reshape(-1, 2)
        sheet = bpy.data.meshes.new("UV layout")
        corners = [tuple(polygon.loop_indices) for polygon in mesh.polygons]
        sheet.from_pydata(np.concatenate([flat, np.zeros((len(flat), 1))], axis=1).tolist(), [], corners)
        attribute = sheet.color_attributes.new("Segments", "FLOAT_COLOR", "CORNER")
        colors = np.ones((len(sheet.loops), 4), dtype=np.float32)
        colors[:, :3] = _linear(np.repeat(self._colors, [len(corner) for corner in corners], axis=0))
        attribute.data.foreach_set("color", colors.ravel())
        material = bpy.data.materials.new("Flat")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        shade, output, source = (
            nodes.new(kind) for kind in ("ShaderNodeEmission", "ShaderNodeOutputMaterial", "ShaderNodeVertexColor")
        )
        source.layer_name = "Segments"
        links.new(source.outputs["Color"], shade.inputs["Color"])
        links.new(shade.outputs["Emission"], output.inputs["Surface"])
        sheet.materials.append(material)
        item = bpy.data.objects.new("UV layout", sheet)
        bpy.context.scene.collection.objects.link(item)
        shown = [one for one in bpy.context.scene.objects if one.type in {"MESH", "CURVE"} and not one.hide_render]
        for one in shown:
            one.hide_render = one is not item
        width = 1.06
        camera = bpy.context.scene.camera
        camera.data.type = "ORTHO"
        camera.data.ortho_scale = width
        camera.location = (0.5, 0.5, 1.0)
        camera.rotation_euler = (0.0, 0.0, 0.0)
        camera.data.clip_start, camera.data.clip_end = 0.1, 2.0
        picture = self._render(path)
        for one in shown:
            one.hide_render = False
        bpy.data.objects.remove(item)
        bpy.data.meshes.remove(sheet)
        _draw_lines(picture, (flat - 0.5) / width + 0.5, corners, self._size)
        save(picture, path)
        return picture


def _coloring(network: Marks, triangles: NDArray[np.int32]) -> NDArray[np.int64]:
    """Choose for each island a color of the palette that none of its neighbours has, where there is one."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owner = np.tile(network.islands, 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, owner = sides[order], owner[order]
    same = (sides[1:] == sides[:-1]).all(axis=1) & (owner[1:] != owner[:-1])
    neighbours: dict[int, set[int]] = {}
    for a, b in np.stack([owner[:-1][same], owner[1:][same]], axis=1).tolist():
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    colors = np.zeros(int(network.islands.max()) + 1, dtype=np.int64)
    used = [0] * len(PALETTE)
    done: set[int] = set()
    for island in range(len(colors)):
        taken = {int(colors[other]) for other in neighbours.get(island, set()) & done}
        colors[island] = min(range(len(PALETTE)), key=lambda color: (color in taken, used[color]))
        used[colors[island]] += 1
        done.add(island)
    return colors


def _linear(color: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn screen colors (sRGB) into the linear ones that Blender computes with."""
    return np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)


def _material(name: str, color: tuple[float, float, float], roughness: float) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*_linear(np.array(color)), 1.0)
    shader.inputs["Roughness"].default_value = roughness
    material.diffuse_color = (*color, 1.0)
    return material


def _draw_lines(
    picture: NDArray[np.float32], places: NDArray[np.float32], corners: list[tuple[int, ...]], size: int
) -> None:
    """Darken the pixels under the faces' edges; places are in the unit square."""
    starts = np.concatenate(corners)
    ends = np.concatenate([np.roll(corner, -1) for corner in corners])
    one, two = places[starts] * size, places[ends] * size
    # A point every half pixel; four subsamples of a pixel make the line soft.
    steps = max(2, int(2 * np.linalg.norm(two - one, axis=1).max(initial=1.0)) + 1)
    steps = min(steps, 400)
    hits = np.zeros((2 * size, 2 * size), dtype=bool)
    for share in np.linspace(0.0, 1.0, steps):
        at = (2 * (one + share * (two - one))).astype(np.int64).clip(0, 2 * size - 1)
        hits[at[:, 1], at[:, 0]] = True
    cover = hits.reshape(size, 2, size, 2).mean(axis=(1, 3))[:, :, None]
    # Where faces are smaller than the lines between them, lines would paint over everything.
    strength = 0.6 * min(1.0, 0.25 / max(float(cover[cover > 0].mean()) ** 2, 0.25)) if (cover > 0).any() else 0.0
    picture *= 1.0 - strength * cover


def load(path: Path) -> NDArray[np.float32]:
    """Read a picture, (height, width, 4), bottom row first."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def save(picture: NDArray[np.float32], path: Path) -> None:
    """Write a picture, (height, width, 3), bottom row first, as PNG."""
    height, width = picture.shape[:2]
    image = bpy.data.images.new("Picture", width, height)
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[:, :, :3] = picture[:, :, :3].clip(0.0, 1.0)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw = str(path)
    image.file_format = "PNG"
    image.save()
    bpy.data.images.remove(image)
