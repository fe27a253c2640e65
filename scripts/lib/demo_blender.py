# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo inside Blender: ``blender --background --factory-startup --python scripts/lib/demo_blender.py -- FOLDER [MESH]``.

Opens a mesh, has ``mesh.seamwire_suggest`` mark a network of wires and unwrap, and writes NAME.blend and pictures into FOLDER.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "batch"))

import addon_utils
import bpy
import numpy as np
from seamwire_batch import pictures
from seamwire_batch.assets import IMPORTERS

MOST_TRIANGLES = 400_000


class DemoError(Exception):
    """What keeps the demo from going on, as a sentence for the person who called it."""


def tell(line: str) -> None:
    """Say what was done."""
    print(f"   {line}", flush=True)


def show(percent: float, doing: str) -> None:
    """Print how far the demo has come, for scripts/demo to show."""
    print(f"progress {percent:.0f} {doing}", flush=True)


def suzanne() -> bpy.types.Object:
    """Make Blender's monkey, subdivided twice."""
    bpy.ops.mesh.primitive_monkey_add()
    modifier = bpy.context.object.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 2
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.context.object.name = "Suzanne"
    return bpy.context.object


def load(path: Path) -> bpy.types.Object:
    """Read a mesh file, all its objects joined into one without a transformation."""
    if path.suffix.lower() not in {".obj", ".ply", ".stl"}:
        raise DemoError(f"{path.name}: only OBJ, PLY and STL files can be opened")
    try:
        IMPORTERS[path.suffix.lower()](str(path))
    except (RuntimeError, ValueError, OSError, IndexError, KeyError) as error:
        raise DemoError(f"{path.name} cannot be read: not a sound {path.suffix[1:].upper()} file") from error
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH" and len(obj.data.polygons) > 0]
    if not meshes:
        raise DemoError(f"{path.name}: no faces in it")
    for obj in bpy.context.scene.objects:
        obj.select_set(obj in meshes)
    bpy.context.view_layer.objects.active = meshes[0]
    if len(meshes) > 1:
        bpy.ops.object.join()
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    bpy.context.object.name = path.stem
    return bpy.context.object


def column(items: bpy.types.bpy_prop_collection, name: str, kind: type, width: int) -> np.ndarray:
    """Read one property of all elements."""
    values = np.empty(len(items) * width, dtype=kind)
    items.foreach_get(name, values)
    return values.reshape(-1, width)


def suggest(obj: bpy.types.Object) -> pictures.Marks:
    """Mark seams and unwrap with the add-on's operator; return the wires that the mesh has then, and see that the seams are theirs."""
    from seamwire.mesh.object_session import ObjectSession
    from seamwire.mesh.uv_islands import labels_of

    bpy.ops.object.mode_set(mode="EDIT")
    try:
        bpy.ops.mesh.seamwire_suggest()
        drawn = ObjectSession(obj)
        if not drawn.session.wires:
            raise DemoError("nothing to cut: the mesh unwraps without seams")
        network = pictures.Marks(list(drawn.session.wires), labels_of(drawn.arrays))
    except RuntimeError as error:
        raise DemoError(str(error).strip()) from error
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    marked = {tuple(sorted(edge.vertices)) for edge in obj.data.edges if edge.use_seam}
    wanted = {edge for wire in network.wires for edge in wire.edges()}
    if marked != wanted:
        raise DemoError(f"{len(marked)} edges are seams, not the {len(wanted)} that the wires run along")
    return network


def stretch(obj: bpy.types.Object, points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return for each triangle how many times longer its longest direction in the unwrapping is than its shortest."""
    from seamwire.core.islands.uv_maps import Stretch

    mesh = obj.data
    corners = column(mesh.loop_triangles, "loops", np.int32, 3)
    measured = Stretch(points, triangles, np.arange(len(triangles)), corners.astype(np.int64))
    measured.update(column(mesh.uv_layers.active.data, "uv", np.float32, 2))
    return 2.0**measured.angle


def run(folder: Path, path: Path | None) -> None:
    """Do the whole demo."""
    if addon_utils.enable("seamwire", default_set=True) is None:
        raise DemoError("the add-on could not be enabled")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    obj = suzanne() if path is None else load(path)
    mesh = obj.data
    mesh.calc_loop_triangles()
    if len(mesh.loop_triangles) > MOST_TRIANGLES:
        raise DemoError(f"{len(mesh.loop_triangles)} triangles: the demo takes {MOST_TRIANGLES} at most")
    tell(f"{obj.name}: {len(mesh.vertices)} vertices, {len(mesh.polygons)} faces")

    show(5, "planning seams and unwrapping")
    started = time.monotonic()
    network = suggest(obj)
    if any(wire.is_cut for wire in network.wires):
        where = f"cut into the faces, {len(mesh.vertices)} vertices now"
    else:
        across = any(wire.along == "SURFACE" for wire in network.wires)
        where = "across the surface" if across else "along edges"
    tell(
        f"{len(network.wires)} wires {where}, {network.islands.max() + 1} islands: "
        f"mesh.seamwire_suggest took {time.monotonic() - started:.1f} s"
    )
    mesh.calc_loop_triangles()
    points = column(mesh.vertices, "co", np.float32, 3).astype(np.float64)
    triangles = column(mesh.loop_triangles, "vertices", np.int32, 3)
    ratio = stretch(obj, points, triangles)
    tell(f"stretch {np.median(ratio):.2f} in the median, {np.percentile(ratio, 95):.2f} for 95 % of the triangles")

    started = time.monotonic()
    scene = pictures.Scene(
        obj,
        network,
        triangles,
        column(mesh.loop_triangles, "polygon_index", np.int32, 1).ravel(),
        samples=int(
            os.environ.get("SEAMWIRE_DEMO_SAMPLES", "16")
        ),  # nobody looks at the tests' pictures: they take fewer
    )
    scene.pictures(folder, obj.name, lambda fraction: show(40 + 60 * fraction, "rendering pictures"))
    tell(f"pictures made in {time.monotonic() - started:.1f} s")
    scene.clean()
    bpy.context.view_layer.objects.active = obj
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / f"{obj.name}.blend"), compress=True)
    (folder / "latest").write_text(str(folder / f"{obj.name}.blend"))


def main() -> int:
    """Run the demo with the arguments after ``--``."""
    folder, *rest = sys.argv[sys.argv.index("--") + 1 :]
    try:
        run(Path(folder), Path(rest[0]) if rest else None)
    except DemoError as error:
        tell(f"The demo ends here: {error}")
        return 1
    return 0


sys.exit(main())
