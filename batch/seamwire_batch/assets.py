# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of assets, opened and written; in Blender, whatever its version."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import bmesh
import bpy
import numpy as np


class AssetError(Exception):
    """What keeps a file from being used, as a sentence."""


def _open_blend(path: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)


def _import_obj(path: str) -> None:
    bpy.ops.wm.obj_import(filepath=path)


def _import_ply(path: str) -> None:
    from seamwire.mesh.versions import IS_OLD

    (bpy.ops.import_mesh.ply if IS_OLD else bpy.ops.wm.ply_import)(filepath=path)
    _weld()


def _import_stl(path: str) -> None:
    from seamwire.mesh.versions import IS_OLD

    (bpy.ops.import_mesh.stl if IS_OLD else bpy.ops.wm.stl_import)(filepath=path)


def _import_fbx(path: str) -> None:
    bpy.ops.import_scene.fbx(filepath=path)


def _import_gltf(path: str) -> None:
    # Debian 12's Blender 3.4 asks NumPy 1.24 for a name that it had before.
    if "bool" not in vars(np):
        np.bool = np.bool_
    bpy.ops.import_scene.gltf(filepath=path)
    _weld()


def _weld() -> None:
    """Make one of vertices at one place.

    Formats that have a vertex for each normal and each place in a UV map part meshes there; seams run along edges of connected ones.
    """
    for mesh in bpy.data.meshes:
        bm = bmesh.new()
        bm.from_mesh(mesh)
        size = max((abs(part) for vertex in bm.verts for part in vertex.co), default=0.0)
        bmesh.ops.remove_doubles(bm, verts=bm.verts, dist=1e-7 * size)
        bm.to_mesh(mesh)
        bm.free()


IMPORTERS: Mapping[str, Callable[[str], None]] = {
    ".blend": _open_blend,
    ".obj": _import_obj,
    ".fbx": _import_fbx,
    ".glb": _import_gltf,
    ".ply": _import_ply,
    ".stl": _import_stl,
}
"""How files are read, by the ends of their names."""


# What lies beside an asset, textures say, stays there: it is named by its whole path.


def _save_blend(path: str) -> None:
    if bpy.data.filepath:
        bpy.ops.file.make_paths_absolute()
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=True, copy=True, relative_remap=False)


def _export_obj(path: str) -> None:
    bpy.ops.wm.obj_export(filepath=path, path_mode="ABSOLUTE")


def _export_ply(path: str) -> None:
    from seamwire.mesh.versions import IS_OLD

    if IS_OLD:
        bpy.ops.export_mesh.ply(filepath=path, use_uv_coords=True)
    else:
        bpy.ops.wm.ply_export(filepath=path, export_uv=True)


def _export_fbx(path: str) -> None:
    bpy.ops.export_scene.fbx(filepath=path, path_mode="ABSOLUTE")


def _export_gltf(path: str) -> None:
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB")


EXPORTERS: Mapping[str, Callable[[str], None]] = {
    ".blend": _save_blend,
    ".obj": _export_obj,
    ".fbx": _export_fbx,
    ".glb": _export_gltf,
    ".ply": _export_ply,
}
"""How files are written. STL knows no UV maps."""


def open_asset(path: Path) -> None:
    """Open a file in an empty scene; raises AssetError."""
    reader = IMPORTERS.get(path.suffix.lower())
    if reader is None:
        raise AssetError(f"{path.suffix or 'a file without an ending'} is no format that can be read")
    if not path.is_file():
        raise AssetError("The file is not there any more")
    if path.suffix.lower() != ".blend":
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    try:
        reader(str(path))
    except Exception as error:  # importers in Python raise whatever a damaged file makes them
        raise AssetError(f"It cannot be read: {_first_line(error)}") from error


def write_asset(path: Path) -> None:
    """Write what is open; raises AssetError."""
    try:
        EXPORTERS[path.suffix.lower()](str(path))
    except (RuntimeError, OSError) as error:
        raise AssetError(f"It cannot be written: {_first_line(error)}") from error


def mesh_objects() -> list[bpy.types.Object]:
    """Return the objects of the open file that seams can be on, one for each mesh, in the order of their names."""
    found: dict[bpy.types.Mesh, bpy.types.Object] = {}
    for obj in sorted(bpy.context.view_layer.objects, key=lambda obj: obj.name):
        if obj.type == "MESH" and len(obj.data.polygons) and obj.library is None and obj.data.library is None:
            found.setdefault(obj.data, obj)
    return list(found.values())


def unwrap(obj: bpy.types.Object, **options: object) -> None:
    """Unwrap all of an object along its seams, islands of one scale, packed; raises AssetError.

    `options`: further arguments of the operator.
    """
    import seamwire

    try:
        seamwire.unwrap(obj, **{"changed_only": False, **options})
    except ValueError as error:
        raise AssetError(f"It cannot be unwrapped: {_first_line(error)}") from error


def _first_line(error: Exception) -> str:
    """Return what was raised in an operator, without the traceback that Blender puts before it."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith((" ", "Location:"))]
    told = [line.removeprefix("Error: ") for line in lines if "Traceback (most" not in line]
    return told[0].strip() if told else type(error).__name__
