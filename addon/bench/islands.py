# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggested islands beside those of Smart UV Project and xatlas: ``scripts/bench-blender --islands STRETCH MESH...`` runs this.

Each is to stretch no island more than STRETCH times: the means over its area of how many times longer a triangle is one way than the
other in the UV map, and of how many times larger or smaller than the mean of the mesh. Ours takes that bound; of the others the coarsest
setting is used that keeps it, or comes nearest to it. A line each: islands, length of the seams (of the model
scaled to the unit cube), mean stretch by angle and by area, that of the worst island by either, and seconds, unwrapping included.
With ``--pictures`` before MESH, a picture a mesh in build/demo, the three from left to right.
"""

import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[2] / "batch"))

import addon_utils
import bpy
import numpy as np
from bench_meshes import load
from numpy.typing import NDArray
from seamwire_batch import pictures

PICTURES = Path(__file__).parents[2] / "build/demo"
SMART_ANGLES = (89.0, 80.0, 66.0, 50.0, 35.0, 20.0)
XATLAS_COSTS = (32.0, 16.0, 8.0, 4.0, 2.0, 1.0, 0.5)


@dataclass(frozen=True)
class Result:
    """What a method has made of a mesh."""

    islands: int
    length: float
    angle: float
    area: float
    worst: float
    seconds: float
    labels: NDArray[np.int32]

    def line(self) -> str:
        """Return it as a line of the table."""
        return (
            f"{self.islands:5} islands, seams {self.length:7.2f}, angle {self.angle:5.3f}, area {self.area:5.3f}, worst {self.worst:6.3f}, "
            f"{self.seconds:6.2f} s"
        )


class Measure:
    """Measures UV maps of one mesh.

    Parameters
    ----------
    points, triangles
        (n, 3) and (m, 3).
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32]) -> None:
        self._points, self._triangles = points, triangles
        self._vertices = triangles.ravel()
        corners = np.arange(triangles.size).reshape(-1, 3)
        self._following = np.roll(corners, -1, axis=1).ravel()
        sides = np.sort(np.stack([self._vertices, self._vertices[self._following]], axis=1), axis=1)
        _, edges = np.unique(sides, axis=0, return_inverse=True)
        self._edges = edges.ravel().astype(np.int32)
        self._corners = corners
        self._scale = 1.0 / np.ptp(points[np.unique(triangles)], axis=0).max()

    def __call__(self, uvs: NDArray[np.float32], seconds: float) -> Result:
        """Measure the UVs of the corners, (3 m, 2)."""
        from seamwire.core.stretch import Stretch
        from seamwire.core.uv_islands import families, split_edges

        pairs, torn = split_edges(self._vertices, self._edges, self._following, uvs)
        _, labels = np.unique(families(len(self._triangles), pairs[~torn] // 3), return_inverse=True)
        stretch = Stretch(self._points, self._triangles, np.arange(len(self._triangles)), self._corners)
        stretch.update(uvs)
        islands = stretch.islands(labels.astype(np.int32))
        begin = self._points[self._vertices[pairs[torn, 0]]]
        end = self._points[self._vertices[self._following[pairs[torn, 0]]]]
        angle, area = (2.0 ** float(np.average(one, weights=islands.areas)) for one in (islands.angle, islands.area))
        worst = 2.0 ** float(np.maximum(islands.angle, islands.area).max())
        length = float(np.linalg.norm(end - begin, axis=1).sum() * self._scale)
        return Result(len(islands.areas), length, angle, area, worst, seconds, labels.astype(np.int32))


def first_within(results: Iterable[Result], bound: float) -> Result:
    """Return the first result within the bound, coarse settings come first; or the one that comes nearest to it."""
    nearest = None
    for result in results:
        if nearest is None or result.worst < nearest.worst:
            nearest = result
        if result.worst <= bound:
            break
    return nearest


def uvs_after(
    obj: bpy.types.Object, work: Callable[..., object], **arguments: float | str
) -> tuple[NDArray[np.float32], float]:
    """Do something to the whole mesh in edit mode; return the UVs of the triangles' corners, and the seconds it took."""
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    began = time.perf_counter()
    work(**arguments)
    seconds = time.perf_counter() - began
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    mesh.calc_loop_triangles()
    loops = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", loops)
    uvs = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    return uvs.reshape(-1, 2)[loops], seconds


def xatlas_uvs(points: NDArray[np.float64], triangles: NDArray[np.int32], cost: float) -> tuple[NDArray, float]:
    """Unwrap with xatlas."""
    import xatlas

    atlas = xatlas.Atlas()
    atlas.add_mesh(points.astype(np.float32), triangles.astype(np.uint32))
    options = xatlas.ChartOptions()
    options.max_cost = cost
    began = time.perf_counter()
    atlas.generate(options)
    seconds = time.perf_counter() - began
    _, indices, uvs = atlas[0]
    return uvs[indices.ravel()].astype(np.float32), seconds


def draw(name: str, results: Iterable[Result], triangles: NDArray[np.int32]) -> None:
    """Render the islands of each result side by side."""
    tiles = []
    for result in results:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        obj = load(name)
        network = pictures.Network([], result.labels)
        scene = pictures.Scene(obj, network, triangles, polygons_of(obj.data), seeds=False)
        tiles.append(scene.islands(PICTURES / "islands.png"))
    pictures.save(np.concatenate(tiles, axis=1), PICTURES / f"islands-{Path(name).stem}.png")


def polygons_of(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    """Return the polygon of each of a mesh's triangles, (m,)."""
    mesh.calc_loop_triangles()
    return np.array([triangle.polygon_index for triangle in mesh.loop_triangles], dtype=np.int32)


def main() -> None:
    """Measure every mesh named on the command line."""
    bound, *names = sys.argv[sys.argv.index("--") + 1 :]
    drawn = names[0] == "--pictures"
    for name in names[drawn:]:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("seamwire", default_set=True)
        obj = load(name)
        mesh = obj.data
        while mesh.uv_layers:
            mesh.uv_layers.remove(mesh.uv_layers[0])
        mesh.calc_loop_triangles()
        triangles = np.array([triangle.vertices[:] for triangle in mesh.loop_triangles], dtype=np.int32)
        points = np.array([vertex.co[:] for vertex in mesh.vertices], dtype=np.float64)
        measure = Measure(points, triangles)
        ours = measure(
            *uvs_after(obj, bpy.ops.mesh.seamwire_suggest, limit="STRETCH", stretch=float(bound), finish="SNAP")
        )
        smarts = (
            measure(*uvs_after(obj, bpy.ops.uv.smart_project, angle_limit=np.radians(angle), island_margin=0.0))
            for angle in SMART_ANGLES
        )
        atlases = (measure(*xatlas_uvs(points, triangles, cost)) for cost in XATLAS_COSTS)
        print(f"{Path(name).stem}, {len(triangles)} triangles, bound {bound}")
        print(f"   ours              {ours.line()}")
        smart, atlas = (first_within(results, float(bound)) for results in (smarts, atlases))
        print(f"   Smart UV Project  {smart.line()}")
        print(f"   xatlas            {atlas.line()}", flush=True)
        if drawn:
            draw(name, (ours, smart, atlas), triangles)


main()
