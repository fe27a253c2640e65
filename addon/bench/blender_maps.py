# SPDX-License-Identifier: GPL-3.0-or-later
"""UV maps that Blender makes of the models of native/bench/auto_seams.py, for its folder of other methods' maps.

    blender --background --factory-startup --python addon/bench/blender_maps.py -- METHOD MODELS MAPS [NAME...]

METHOD is one of these:

- addon: Suggest Seamwires with its defaults, with the map;
- artist_abf: the artist's seams, unwrapped by Blender's angle-based method;
- smart: Smart UV Project at 66 degrees.

Writes MAPS/NAME.METHOD.npz for each model of the folder MODELS, or those named. Models are turned so that their front is -Y, as in
Blender's front view, and turned back in the files. Points may be added where wires are cut into faces.
"""

from __future__ import annotations

import math
import resource
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "native/bench"))

import addon_utils
import bpy
import numpy as np
from numpy.typing import NDArray
from uv_maps import Model, UvMap, read_frames

MARGIN = 0.001


def main() -> None:
    """Make the maps that the command line asks for."""
    method, models, maps, *names = sys.argv[sys.argv.index("--") + 1 :]
    folder = Path(models)
    frames = read_frames(folder)
    if method == "addon":
        addon_utils.enable("seamwire", default_set=True)
    for file in sorted(folder.glob("*.npz")):
        if names and file.stem not in names:
            continue
        model = Model.read(file, frames.get(file.stem))
        if method == "artist_abf" and model.artist_seams is None:
            continue
        uv_map = mapped(model, method)
        uv_map.write(Path(maps) / f"{model.name}.{method}.npz")
        print(f"   {model.name}: {uv_map.info['sec']:.1f} s")


def mapped(model: Model, method: str) -> UvMap:
    """Return the map that a method makes of a model."""
    mesh = mesh_of(model)
    if method == "artist_abf":
        mark(mesh, model.artist_seams)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    memory, began, processor = peak_memory(), time.perf_counter(), time.process_time()
    if method == "addon":
        bpy.ops.mesh.seamwire_suggest(unwrap=True)
    elif method == "artist_abf":
        bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=MARGIN)
    elif method == "smart":
        bpy.ops.uv.smart_project(angle_limit=math.radians(66.0), island_margin=MARGIN)
    else:
        raise ValueError(f"no method {method}")
    info = {
        "sec": time.perf_counter() - began,
        "cpu": time.process_time() - processor,
        "mem": peak_memory() - memory,
    }
    bpy.ops.object.mode_set(mode="OBJECT")
    triangles, uvs = triangles_of(mesh)
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    turned = points.reshape(-1, 3)[:, [0, 2, 1]].astype(np.float64) * [1.0, 1.0, -1.0]
    return UvMap(turned @ model.frame.axes, triangles, uvs, info)


def mesh_of(model: Model) -> bpy.types.Mesh:
    """Make a model the only object of the scene, its front at -Y and its up axis at Z."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    turned = model.points @ model.frame.axes.T  # right, up, front
    polygons = [corners.tolist() for corners in np.split(model.corners, model.start[1:-1])]
    mesh = bpy.data.meshes.new(model.name)
    mesh.from_pydata((turned[:, [0, 2, 1]] * [1.0, -1.0, 1.0]).tolist(), [], polygons)
    obj = bpy.data.objects.new(model.name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return mesh


def mark(mesh: bpy.types.Mesh, seams: NDArray[np.int64]) -> None:
    """Mark the edges between pairs of vertices (k, 2) as seams."""
    wanted = {frozenset(pair) for pair in seams.tolist()}
    for edge in mesh.edges:
        edge.use_seam = frozenset(edge.vertices) in wanted


def triangles_of(mesh: bpy.types.Mesh) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the vertices (m, 3) and the UVs (m, 3, 2) of Blender's triangles."""
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    corners, vertices = np.empty(3 * count, dtype=np.int32), np.empty(3 * count, dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", corners)
    mesh.loop_triangles.foreach_get("vertices", vertices)
    uvs = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    return vertices.reshape(-1, 3).astype(np.int64), uvs.reshape(-1, 2)[corners.reshape(-1, 3)].astype(np.float64)


def peak_memory() -> float:
    """Return the megabytes that this process needed at most."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main()
