# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of assets, opened and written; in Blender, whatever its version."""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bmesh
import bpy
import numpy as np


class AssetError(Exception):
    """What keeps a file from being used, as a sentence."""


_TEXTS = (".obj", ".ply", ".stl")
"""Formats that are text, or may be."""
_BEGINNING = 1 << 20
"""Bytes of a text that are looked at: numbers come soon in all of these formats."""
_DECIMAL_COMMA = re.compile(rb"^\s*(?:v|vt|vn|vertex)?\s*-?\d+,\d+(?:[eE][-+]?\d+)?\s+-?\d", re.MULTILINE)


def _open_blend(path: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)


def _import_obj(path: str) -> None:
    bpy.ops.wm.obj_import(filepath=path, import_vertex_groups=True)


def _import_ply(path: str) -> None:
    from seamwire.mesh.registration import IS_OLD

    (bpy.ops.import_mesh.ply if IS_OLD else bpy.ops.wm.ply_import)(filepath=path)
    _weld()


def _import_stl(path: str) -> None:
    from seamwire.mesh.registration import IS_OLD

    (bpy.ops.import_mesh.stl if IS_OLD else bpy.ops.wm.stl_import)(filepath=path)


def _import_fbx(path: str) -> None:
    # The older importer knows no FBX in text, and in Blender 5.0 it fails at lights.
    is_new = "fbx_import" in dir(bpy.ops.wm)
    (bpy.ops.wm.fbx_import if is_new else bpy.ops.import_scene.fbx)(filepath=path)


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
    bpy.ops.wm.obj_export(filepath=path, path_mode="ABSOLUTE", export_colors=True, export_vertex_groups=True)


def _export_ply(path: str) -> None:
    from seamwire.mesh.registration import IS_OLD

    if IS_OLD:
        bpy.ops.export_mesh.ply(filepath=path, use_uv_coords=True)
    else:
        bpy.ops.wm.ply_export(filepath=path, export_uv=True)


def _export_fbx(path: str) -> None:
    options = {"use_mesh_edges": True, "use_custom_props": True, "add_leaf_bones": False, "mesh_smooth_type": "FACE"}
    bpy.ops.export_scene.fbx(filepath=path, path_mode="ABSOLUTE", **options)


def _export_gltf(path: str) -> None:
    wanted = {
        "use_mesh_edges": True,
        "use_mesh_vertices": True,
        "export_cameras": True,
        "export_lights": True,
        "export_extras": True,
        "export_vertex_color": "ACTIVE",
    }
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    options = {name: value for name, value in wanted.items() if name in known}
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", **options)


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
        _check_text(path)
        bpy.ops.wm.read_homefile(use_empty=True)
    try:
        reader(str(path))
    except Exception as error:  # importers in Python raise whatever a damaged file makes them
        raise AssetError(f"It cannot be read: {_first_line(error)}") from error


def _check_text(path: Path) -> None:
    """Raise AssetError if Blender would misread a text without a word."""
    if path.suffix.lower() not in _TEXTS:
        return
    with path.open("rb") as file:
        start = file.read(_BEGINNING)
    if start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise AssetError("It cannot be read: it is UTF-16. Save it as UTF-8")
    # Blender takes the mark for a part of the first line. A comment may begin with anything.
    if start.startswith(codecs.BOM_UTF8) and start[3:].lstrip(b" \t")[:1] not in {b"#", b"\r", b"\n"}:
        raise AssetError("It cannot be read: it begins with a byte order mark. Save it as UTF-8 without one")
    is_text = path.suffix.lower() == ".obj" or b"format ascii" in start[:1000] or start.startswith(b"solid")
    if is_text and _DECIMAL_COMMA.search(start):
        raise AssetError("It cannot be read: its numbers have decimal commas. Export it with decimal points")


def write_asset(path: Path) -> None:
    """Write what is open; raises AssetError."""
    if path.suffix.lower() != ".blend" and bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")  # exporters read what Blender stored of a mesh last
    try:
        EXPORTERS[path.suffix.lower()](str(path))
    except (RuntimeError, OSError) as error:
        raise AssetError(f"It cannot be written: {_first_line(error)}") from error


@dataclass(frozen=True)
class MeshObjects:
    """The objects of the open file that seams can be on, one for each mesh, in the order of their names."""

    found: list[bpy.types.Object]
    skipped: dict[bpy.types.Object, str]  # why the meshes of other objects cannot have seams, as sentences

    @property
    def readable(self) -> list[bpy.types.Object]:
        """The objects whose meshes can be read. These may be hidden."""
        return [*self.found, *(obj for obj in self.skipped if obj.library is None and obj.data.library is None)]


def mesh_objects() -> MeshObjects:
    """Find the mesh objects with faces in all scenes of the open file."""
    from seamwire.mesh.edit_mesh import NothingVisibleError

    found: dict[bpy.types.Mesh, bpy.types.Object] = {}
    skipped: dict[bpy.types.Object, str] = {}
    for obj in sorted(bpy.data.objects, key=lambda obj: (obj.name, obj.library is not None)):
        if obj.type != "MESH" or obj.data in found or (obj.library is not None and not obj.users_scene):
            continue
        obj.update_from_editmode()
        if not len(obj.data.polygons):
            continue
        with shown(obj) as problem:
            if not problem and all(face.hide for face in obj.data.polygons):
                problem = str(NothingVisibleError(obj))
            if not problem and sum(face.area for face in obj.data.polygons) == 0.0:
                problem = f"{obj.name} has no area: its faces are points or lines"
            if problem:
                skipped[obj] = problem
            else:
                found[obj.data] = obj
    return MeshObjects(list(found.values()), {obj: why for obj, why in skipped.items() if obj.data not in found})


@contextmanager
def shown(obj: bpy.types.Object) -> Iterator[str]:
    """Have a scene and a view layer in the window in which an object can be edited, and yield an empty text.

    Otherwise nothing changes, and the text says why.
    """
    from seamwire.mesh.modes import problem_with

    window = bpy.context.window
    before = window.scene, window.view_layer
    problem = problem_with(obj)
    places = [(scene, layer) for scene in obj.users_scene for layer in scene.view_layers if (scene, layer) != before]
    is_found = not problem
    try:
        while places and not is_found:
            window.scene, window.view_layer = places.pop(0)
            is_found = not problem_with(obj)
        if not is_found:
            window.scene, window.view_layer = before
        yield "" if is_found else problem
    finally:
        window.scene, window.view_layer = before


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
