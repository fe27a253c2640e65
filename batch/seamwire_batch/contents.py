# SPDX-License-Identifier: GPL-3.0-or-later
"""What the open file holds, besides seams: to find what a format does not keep, and meshes without a UV map."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

_OBJECTS = {
    "ARMATURE": "bones",
    "CAMERA": "cameras",
    "CURVE": "curves",
    "FONT": "texts",
    "LIGHT": "lights",
    "META": "metaballs",
    "SURFACE": "curved surfaces",
}
"""The names of other types of objects."""
_GROUP = "group "
_NO_GROUPS = {"", "default", "off", "(null)"}
"""Groups of OBJ files that stand for no group."""


def contents(path: Path) -> dict[str, int]:
    """Return how much of each kind of data the open file has, which was read from a path."""
    objects = {obj for scene in bpy.data.scenes for obj in scene.objects}
    for obj in objects:
        obj.update_from_editmode()
    meshes = {obj.data for obj in objects if obj.type == "MESH"}
    keys = {block for mesh in meshes if mesh.shape_keys is not None for block in mesh.shape_keys.key_blocks[1:]}
    animated: list[bpy.types.ID] = [*objects, *(obj.data for obj in objects if obj.data is not None)]
    animated += [mesh.shape_keys for mesh in meshes if mesh.shape_keys is not None]
    found = Counter(dict.fromkeys((_OBJECTS[obj.type] for obj in objects if obj.type in _OBJECTS), 1))
    found["animation"] = int(any(map(_is_animated, animated)))
    found["materials"] = len({slot.material for obj in objects for slot in obj.material_slots} - {None})
    found["vertex groups"] = len({group.name for obj in objects for group in obj.vertex_groups})
    found["shape keys"] = len({key.name for key in keys})
    found["UV maps"] = max((len(mesh.uv_layers) for mesh in meshes), default=0)
    found["vertex colors"] = int(any(len(mesh.color_attributes) for mesh in meshes))
    found["custom normals"] = int(any(mesh.has_custom_normals for mesh in meshes))
    found["sharp edges"] = int(any(_column(mesh.edges, "use_edge_sharp", bool).any() for mesh in meshes))
    loose = [_loose(mesh) for mesh in meshes]
    found["edges without faces"], found["points without edges"] = (
        (int(any(column)) for column in zip(*loose, strict=True)) if loose else (0, 0)
    )
    return {**found, **(_of_obj(path) if path.suffix.lower() == ".obj" else {})}


def lost(before: Mapping[str, int], after: Mapping[str, int]) -> list[str]:
    """Return the kinds of data of which a file has less than before. `before` and `after` are `contents`."""
    kinds = [kind for kind, number in before.items() if after.get(kind, 0) < number]
    # Blender reads the groups of faces in an OBJ file as vertex groups, and may write them to an OBJ file only.
    are_groups = any(kind.startswith(_GROUP) for kind in before)
    are_lost = (
        any(kind.startswith(_GROUP) for kind in kinds) if "smoothing groups" in after else "vertex groups" in kinds
    )
    if are_groups:
        kinds = [kind for kind in kinds if kind != "vertex groups" and not kind.startswith(_GROUP)]
        kinds += ["groups"] if are_lost else []
    # Each mesh gets a map, and every format has room for this one.
    return ["all but one UV map" if kind == "UV maps" else kind for kind in kinds]


def unmapped() -> set[str]:
    """Return the names of the mesh objects of all scenes that have faces, and no area in their active UV map."""
    objects = {obj for scene in bpy.data.scenes for obj in scene.objects if obj.type == "MESH"}
    return {obj.name for obj in objects if not _has_map(obj)}


def _has_map(obj: bpy.types.Object) -> bool:
    """Whether a mesh object has a UV map with an area, or needs none."""
    if obj.mode != "EDIT":
        return not len(obj.data.polygons) or _uv_area(obj.data) > 0.0
    # The mesh itself shows no UVs in Edit Mode.
    obj.update_from_editmode()
    mesh = obj.data.copy()
    try:
        return not len(mesh.polygons) or _uv_area(mesh) > 0.0
    finally:
        bpy.data.meshes.remove(mesh)


def _uv_area(mesh: bpy.types.Mesh) -> float:
    layer = mesh.uv_layers.active
    if layer is None or len(layer.data) != len(mesh.loops):
        return 0.0
    mesh.calc_loop_triangles()
    uvs = _column(layer.data, "uv", np.float32, 2)[_column(mesh.loop_triangles, "loops", np.int32, 3)]
    (a, b), (c, d) = (uvs[:, 1] - uvs[:, 0]).T.astype(np.float64), (uvs[:, 2] - uvs[:, 0]).T.astype(np.float64)
    return float(np.nan_to_num(np.abs(a * d - b * c)).sum())


def _is_animated(item: bpy.types.ID) -> bool:
    data = getattr(item, "animation_data", None)  # images, which empties show, have none
    return data is not None and (data.action is not None or len(data.nla_tracks) > 0)


def _loose(mesh: bpy.types.Mesh) -> tuple[bool, bool]:
    """Whether a mesh has edges without faces, and vertices without edges."""
    ends = _column(mesh.edges, "vertices", np.int32, 2)
    has_edge = np.zeros(len(mesh.vertices), dtype=bool)
    has_edge[ends] = True
    return len(np.unique(_column(mesh.loops, "edge_index", np.int32))) < len(ends), not has_edge.all()


def _column(items: bpy.types.bpy_prop_collection, name: str, dtype: type, width: int = 1) -> np.ndarray:
    flat = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, flat)
    return flat if width == 1 else flat.reshape(-1, width)


def _of_obj(path: Path) -> dict[str, int]:
    """Return what the text of an OBJ file has that Blender does not keep, or changes."""
    groups: Counter[str] = Counter()
    smoothing: Counter[str] = Counter()
    points = 0
    group = smooth = ""
    with path.open("rb") as file:
        for line in file:
            word, _, rest = line.strip().partition(b" ")
            if word == b"f":
                groups[group] += 1
                smoothing[smooth] += 1
            elif word == b"g":
                group = " ".join(rest.decode("utf-8", "replace").split())
            elif word == b"s":
                smooth = rest.strip().decode("ascii", "replace")
            points += word == b"p"
    named = [group for group in groups if group.lower() not in _NO_GROUPS]
    return {
        **{f"{_GROUP}{name}": groups[name] for name in named},
        "smoothing groups": len({number for number in smoothing if number not in {"", "0", "off"}}),
        "points": points,
    }
