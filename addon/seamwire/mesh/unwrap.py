# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's unwrap, for the islands alone whose seams have changed; all other UVs keep every bit.

An island has changed where its UVs are torn over an edge that is no seam, or hang together over one that is, or have no area.
Both can be meant, and unwrapping a flat island leaves a slit closed: a hidden layer of the edges holds what was a seam when
they were unwrapped last, and while that is so, they are left alone. Being a layer it goes with Blender's undo, saving, joining.
Where a cut was taken back, nothing is torn any more that was: the layer tells that too.
"""

from __future__ import annotations

import zlib
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ..core.uv_islands import NewIsland, families, place, split_edges, uv_areas
from . import edit_mesh, uv_map
from .seam_islands import labels_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

UNWRAPPED = ".seamwire_unwrapped"
"""The layer of the edges: twice a number that stands for the UV map, plus one where the edge was a seam; 0: not known, or `JOINED`."""
JOINED = 1
"""What it holds of edges around faces that were joined since: their corners may be of several islands in the map."""


@dataclass(frozen=True)
class Unwrapped:
    """What was done.

    Parameters
    ----------
    islands
        How many were unwrapped.
    kept
        How many keep their UVs.
    """

    islands: int
    kept: int


class _Map:
    """The UV map of one edit mesh, by the islands that the seams make."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self.obj = obj
        self._arrays = arrays = edit_mesh.read(obj)
        self.corners, self._uvs = uv_map.read(obj)
        self._triangles = self.corners.of_triangles(arrays)
        self._labels = labels_of(arrays)
        self.count = int(self._labels.max(initial=-1)) + 1
        p = arrays.in_object[arrays.triangles]
        self._areas = 0.5 * np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
        self._of_face = np.full(int(self.corners.faces.max(initial=-1)) + 1, -1, dtype=np.int64)
        self._of_face[arrays.polygons] = self._labels
        self.changed = np.flatnonzero(self._find_changed())

    @property
    def bm(self) -> bmesh.types.BMesh:
        """The edit mesh, by its numbers."""
        return edit_mesh.edit_bmesh(self.obj.data)

    def _find_changed(self) -> NDArray[np.bool_]:
        self._families = np.arange(self.count)
        if self._uvs is None:
            return np.ones(self.count, dtype=bool)
        corners, bm = self.corners, self.bm
        layer = bm.edges.layers.int.get(UNWRAPPED)
        seams = np.array([edge.seam for edge in bm.edges], dtype=bool)
        known = np.array([edge[layer] for edge in bm.edges] if layer else np.zeros(len(seams)), dtype=np.int64)
        visible = self._of_face[corners.faces] >= 0
        pairs, torn = split_edges(corners.vertices, np.where(visible, corners.edges, -1), corners.following, self._uvs)
        islands = self._of_face[corners.faces[pairs]]
        self._families = families(self.count, islands[~torn])
        edges = corners.edges[pairs[:, 0]]
        odd = (torn != seams[edges]) & (known[edges] != self._signs(seams[edges]))
        odd |= known[edges] == JOINED
        areas = uv_areas(self._uvs[self._triangles].astype(np.float64))
        changed = np.bincount(self._labels, areas, self.count) <= 0.0
        # An island without area on the model cannot have one in the map.
        changed &= np.bincount(self._labels, self._areas, self.count) > 0.0
        changed[islands[odd]] = True
        return changed

    def _signs(self, seams: NDArray[np.bool_]) -> NDArray[np.int64]:
        """Return what the layer holds of edges that are seams, or are not."""
        name = self.obj.data.uv_layers.active.name
        return 2 * (1 + zlib.crc32(name.encode()) % (1 << 29)) + seams.astype(np.int64)

    def faces(self) -> NDArray[np.int64]:
        """Return the faces of the islands that have changed."""
        return np.flatnonzero(np.isin(self._of_face, self.changed))

    def staying(self) -> NDArray[np.float64]:
        """Return the bounds of the triangles that stay in the map, (b, 4); of hidden faces their own."""
        if self._uvs is None:
            return np.empty((0, 4))
        staying = ~np.isin(self._of_face[self.corners.faces], self.changed)
        starts = np.flatnonzero(np.diff(self.corners.faces[staying], prepend=-1))
        uvs = self._uvs[staying].astype(np.float64)
        if not len(starts):
            return np.empty((0, 4))
        return np.concatenate([np.minimum.reduceat(uvs, starts), np.maximum.reduceat(uvs, starts)], axis=1)

    def areas(self) -> NDArray[np.float64]:
        """Return the areas of the islands in the map as it was, and on the model, (2, count)."""
        in_map = np.zeros(len(self._labels))
        if self._uvs is not None:
            in_map = uv_areas(self._uvs[self._triangles].astype(np.float64))
        return np.stack([np.bincount(self._labels, areas, self.count) for areas in (in_map, self._areas)])

    def densities(self, fallback: float) -> NDArray[np.float64]:
        """Return the texel density of each island, (count,): what was one island in the map has one still."""
        sums = np.stack([np.bincount(self._families, areas, self.count) for areas in self.areas()])[:, self._families]
        known = (sums > 0.0).all(axis=0)
        return np.sqrt(np.divide(sums[0], sums[1], out=np.full(self.count, fallback**2), where=known))

    def new_islands(self, density: float, even: bool) -> list[tuple[NDArray[np.int64], NewIsland]]:
        """Return the corners of each island that was unwrapped and may be moved, and what it has become.

        `density` is for those that had no place; `even`: for all.
        """
        densities = np.full(self.count, density) if even else self.densities(density)
        after = uv_map.read_uvs(self.obj)
        before = np.zeros_like(after) if self._uvs is None else self._uvs
        islands = []
        pinned = self._pinned()
        order = np.argsort(self._labels, kind="stable")
        starts = np.searchsorted(self._labels[order], np.arange(self.count + 1))
        for label in self.changed.tolist():
            rows = order[starts[label] : starts[label + 1]]
            corners, triangles = np.unique(self._triangles[rows], return_inverse=True)
            if not pinned[corners].any():
                one, other = (uvs[corners].astype(np.float64) for uvs in (before, after))
                triangles = triangles.reshape(-1, 3)
                islands.append((corners, NewIsland(one, other, triangles, self._areas[rows], float(densities[label]))))
        return islands

    def _pinned(self) -> NDArray[np.bool_]:
        bm = self.bm
        layer = bm.loops.layers.uv.active
        pinned = np.zeros(len(self.corners.vertices), dtype=bool)
        starts = np.flatnonzero(np.diff(self.corners.faces, prepend=-1))
        for face in self.faces().tolist():
            for i, loop in enumerate(bm.faces[face].loops, start=starts[face]):
                pinned[i] = loop[layer].pin_uv
        return pinned

    def write(self, corners: NDArray[np.int64], uvs: NDArray[np.float64]) -> None:
        """Give corners their places in the map."""
        bm = self.bm
        layer = bm.loops.layers.uv.active
        starts = np.flatnonzero(np.diff(self.corners.faces, prepend=-1))
        faces = self.corners.faces[corners]
        for face, within, uv in zip(faces.tolist(), (corners - starts[faces]).tolist(), uvs.tolist(), strict=True):
            bm.faces[face].loops[within][layer].uv = uv

    def remember(self) -> None:
        """Let visible edges hold whether they were seams when they were unwrapped last."""
        bm = self.bm
        layer = bm.edges.layers.int.get(UNWRAPPED) or bm.edges.layers.int.new(UNWRAPPED)
        plain, seam = self._signs(np.array([False, True])).tolist()
        for edge in self.bm.edges:
            if not edge.hide:
                edge[layer] = seam if edge.seam else plain
        bmesh.update_edit_mesh(self.obj.data, loop_triangles=False, destructive=False)


def unwrap_changed(
    context: bpy.types.Context, objects: Sequence[bpy.types.Object] | None = None, even: bool = False
) -> Unwrapped:
    """Unwrap the islands whose seams have changed, of some objects in edit mode, else of all; selections stay.

    Where nothing stays, Blender's own packing is kept. Else each new island gets the texel density it had, and a place
    near its old one, see `core.uv_islands.place`; islands with pinned corners stay where Blender puts them. `even`: it gets the
    mean texel density of those that stay instead.

    Raises
    ------
    ValueError, native.NativeError
        Where there is nothing to unwrap, or Blender cannot; then nothing is changed.
    """
    maps, problem = [], ""
    for obj in context.objects_in_mode_unique_data if objects is None else objects:
        try:
            maps.append(_Map(obj))
        except ValueError as error:
            problem = f"{obj.name}: {error}"
    if not any(found.count for found in maps):
        raise ValueError(problem if not maps else "No face is visible: there is nothing to unwrap")
    maps = [found for found in maps if found.count]
    unwrapped = sum(len(found.changed) for found in maps)
    kept = sum(found.count for found in maps) - unwrapped
    if unwrapped:
        with _only_selected(context, maps):
            try:
                # Not the UV editor's own selection, where it is called from there.
                with context.temp_override(area=None, region=None):
                    bpy.ops.uv.unwrap()
            except RuntimeError as error:
                raise ValueError(f"Blender could not unwrap: {str(error).strip()}") from error
        _place(maps, even)
    for found in maps:
        if len(found.changed):
            found.remember()
    return Unwrapped(unwrapped, kept)


class SavedUvs:
    """The UVs of an object in edit mode, or that it has none, to come back to after unwrapping on trial.

    Attributes
    ----------
    remembered
        What the hidden layer holds of each edge; None: there is no such layer.
    """

    def __init__(self, obj: bpy.types.Object) -> None:
        self._obj, self._mesh = obj, obj.data
        self._uvs = uv_map.read_uvs(obj)
        bm = edit_mesh.edit_bmesh(obj.data)
        layer = bm.edges.layers.int.get(UNWRAPPED)
        self.remembered = None if layer is None else [edge[layer] for edge in bm.edges]

    def restore(self) -> None:
        """Give the object back what it had, out of edit mode its UVs; nothing where it, or its faces, are others now."""
        mesh = self._mesh
        try:
            if self._obj.data != mesh:
                return
        except ReferenceError:
            return
        now = uv_map.read_uvs(self._obj)
        if self._uvs is None:
            for made in list(mesh.uv_layers):
                mesh.uv_layers.remove(made)
        elif now is not None and len(now) == len(self._uvs):
            uv_map.write(self._obj, self._uvs)
        if self._obj.mode != "EDIT":
            return
        bm = edit_mesh.edit_bmesh(mesh)
        layer = bm.edges.layers.int.get(UNWRAPPED)
        if layer is not None and self.remembered is None:
            bm.edges.layers.int.remove(layer)
        elif layer is not None and len(bm.edges) == len(self.remembered):
            for edge, value in zip(bm.edges, self.remembered, strict=True):
                edge[layer] = value
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _place(maps: Sequence[_Map], even: bool) -> None:
    """Move new islands to where there is room among those that stay."""
    taken = np.concatenate([found.staying() for found in maps])
    if not len(taken):
        return
    in_map, on_model = sum(np.delete(found.areas(), found.changed, axis=1).sum(axis=1) for found in maps)
    density = float(np.sqrt(in_map / on_model)) if on_model > 0.0 else 0.0
    new = [(found, *island) for found in maps if len(found.changed) for island in found.new_islands(density, even)]
    for (found, corners, _), uvs in zip(new, place([island for _, _, island in new], taken), strict=True):
        found.write(corners, uvs)


@contextmanager
def _only_selected(context: bpy.types.Context, maps: Sequence[_Map]) -> Iterator[None]:
    """Have nothing selected but the faces of the islands that have changed."""
    # Blender would make missing UV maps while it unwraps, and what is selected would be other items then.
    made = [(found.obj.data, found.obj.data.uv_layers.new()) for found in maps if not found.obj.data.uv_layers]
    # It would make some, too, for objects of which nothing is selected.
    bare = [obj.data for obj in context.objects_in_mode_unique_data if not obj.data.uv_layers]
    selections = [edit_mesh.Selection(obj) for obj in context.objects_in_mode_unique_data]
    try:
        bpy.ops.mesh.select_all(action="DESELECT")
        for found in maps:
            bm = found.bm
            for face in found.faces().tolist():
                bm.faces[face].select = True
        yield
    except ValueError:
        for mesh, layer in made:
            mesh.uv_layers.remove(layer)
        raise
    finally:
        for mesh in bare:
            for layer in list(mesh.uv_layers):
                mesh.uv_layers.remove(layer)
        bpy.ops.mesh.select_all(action="DESELECT")
        for selection in selections:
            selection.restore()
