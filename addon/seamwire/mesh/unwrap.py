# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwrapping, for the islands alone whose seams have changed; all other UVs keep every bit.

An island has changed if its UVs are torn at an edge without a seam, are connected across a seam, or have no area.
New faces often have UVs of this kind, or are turned over, or overlap.
Torn and connected UVs can be intended, and unwrapping a flat island leaves a slit closed. Therefore a hidden edge layer stores the
seams of the last unwrap, where two faces meet. Edges that still agree with it do not count. Being a layer it goes with Blender's undo,
saving, joining.
Where a cut was taken back, nothing is torn any more that was: the layer tells that too.
"""

from __future__ import annotations

import zlib
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

import bmesh
import bpy
import numpy as np

from ..core.base import native
from ..core.base.geometry import triangle_areas
from ..core.islands.uv_maps import NO_FAULTS, MapFaults, uv_areas
from ..words.reports import ALL_HIDDEN
from . import edit_mesh, uv_islands

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    import seamwire_core
    from numpy.typing import NDArray

UNWRAPPED = ".seamwire_unwrapped"
"""The layer of the edges: twice a number that stands for the UV map, plus one where the edge was a seam; 0: not known, or `JOINED`."""
JOINED = 1
"""The value for edges around faces that were joined later. Their corners may belong to several islands in the map."""
STRAIGHT_COST = 0.05
"""How much a straight layout may add to an island's symmetric Dirichlet energy."""
UP = (0.0, 0.0, 1.0)
"""The direction of the object that points up in the map."""
MARGIN = 1.0 / 256.0
"""Between packed islands, as a share of the UV square's side."""


@dataclass(frozen=True)
class Unwrapped:
    """How many islands were unwrapped, how many keep their UVs, and the faults of the unwrapped ones in the UV maps of the meshes."""

    islands: int
    kept: int
    faults: MapFaults = NO_FAULTS
    unmapped: int = 0  # the hidden faces that have no area in these maps
    problems: Sequence[str] = ()  # why objects were left out
    objects: Sequence[bpy.types.Object] = ()  # the others


@dataclass(frozen=True)
class Layout:
    straight: bool = True  # strips and rectangles of quads lie along the axes, if that hardly stretches them
    upright: bool = True  # islands that are packed stand upright or are turned by quarters, otherwise in any direction
    stack: bool = False  # islands of the same shape, mirrored or not, lie on each other
    straight_cost: float = STRAIGHT_COST


Solved: TypeAlias = "tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]"
"""The corners of unwrapped islands, ascending, their places on the image that the UVs lie on, in any unit, and the island of each."""
_Copy: TypeAlias = "tuple[_Map, NDArray[np.int32], _Map, NDArray[np.int32]]"
"""An island that lies on another one: its map and its corners, and the other map and the corners below."""


class _Map:
    """The UV map of one edit mesh, by the islands that seams make. Those to unwrap are `changed`.

    The library maps `flat`, and Blender the others: all of them if its method is chosen, otherwise those with pins.
    """

    def __init__(self, obj: bpy.types.Object, every: bool, by_library: bool) -> None:
        self.obj = obj
        self._arrays = arrays = edit_mesh.read(obj)
        self.aspect = uv_islands.aspect(obj)
        with edit_mesh.copied(obj.data) as data:  # `read` has updated it
            self.corners, self._uvs = uv_islands.corners_of(data), uv_islands.uvs_of(data)
            pinned = uv_islands.pinned_of(data)
            self._seams = edit_mesh.column(data.edges, "use_seam", np.bool_)
            layer = data.attributes.get(UNWRAPPED)
            self._known = np.zeros(len(self._seams), dtype=np.int32)
            if layer is not None and len(layer.data) == len(self._seams):
                self._known = edit_mesh.column(layer.data, "value", np.int32)
        labels = uv_islands.labels_of(arrays)
        self.count = int(labels.max(initial=-1)) + 1
        self._of_face = np.full(len(self.corners.sizes), -1, dtype=np.int32)
        self._of_face[arrays.polygons] = labels
        # The map is made and measured for the triangles that Blender draws.
        drawn = self._drawn()
        labels = self._of_face[self.corners.faces[drawn[:, 0]]]
        self._triangles, self._labels = drawn[labels >= 0], labels[labels >= 0]
        triangles = np.concatenate([self._triangles, drawn[labels < 0]])
        columns = (self.corners.vertices, self.corners.edges, self.corners.sizes, triangles, self._of_face, self._seams)
        self.mesh = native.load().UnwrapMesh(arrays.in_object, *columns)
        self._areas = triangle_areas(arrays.in_object, self.corners.vertices[self._triangles])
        changed, self._densities = np.ones(self.count, dtype=bool), np.zeros(self.count)
        if self._uvs is not None:
            plain, seam = self._signs()
            memory = np.select([self._known == plain, self._known == seam, self._known == JOINED], [1, 2, 3])
            changed, self._densities = self.mesh.changes(self._uvs, memory)
        self.changed = np.arange(self.count) if every else np.flatnonzero(changed)
        self.with_pins = np.intersect1d(self.changed, self._labels[pinned[self._triangles].any(axis=1)])
        self._unpinned = np.setdiff1d(self.changed, self.with_pins)
        self.flat = self._unpinned if by_library else self.changed[:0]
        self._are_straight = np.zeros(self.count, dtype=bool)
        self.stacked: list[int] = []  # the islands that lie on others

    @property
    def before(self) -> NDArray[np.float64]:
        """The old map, (c, 2); zeros: there was no UV map."""
        return np.zeros((len(self.corners.vertices), 2)) if self._uvs is None else self._uvs.astype(np.float64)

    def _drawn(self) -> NDArray[np.int64]:
        """Return the corners of the triangles that Blender draws in edit mode, (t, 3), hidden ones included."""
        bm = edit_mesh.edit_bmesh(self.obj.data)  # kept, because its loops live as long
        found = (
            number
            for a, b, c in bm.calc_loop_triangles()
            for number in (a.face.index, a.vert.index, b.vert.index, c.vert.index)
        )
        table = np.fromiter(found, dtype=np.int32).reshape(-1, 4)
        return self.corners.of_triangles(replace(self._arrays, triangles=table[:, 1:], polygons=table[:, 0]))

    def _signs(self) -> tuple[int, int]:
        """Return the layer's values of edges without a seam, and of edges with one."""
        sign = 2 * (1 + zlib.crc32(self.obj.data.uv_layers.active.name.encode()) % (1 << 29))
        return sign, sign + 1

    def faces(self, islands: NDArray[np.integer]) -> NDArray[np.int64]:
        return np.flatnonzero(np.isin(self._of_face, islands))

    def flattened(self, start: NDArray[np.float64] | None, layout: Layout) -> Solved:
        """Flatten `flat`: without flips, and without overlaps where possible. Raises ValueError if a coordinate is not a number.

        `start`, (m, 3, 2), is a map to start from, in lengths on the model, where it is continuous; None: the present one. An island has
        several numbers where the seams do not part what is no surface.
        """
        places = None if self._uvs is None else self.before * (self.aspect, 1.0)
        if start is not None:
            places = np.zeros((len(self.corners.vertices), 2))
            places[self.corners.of_triangles(self._arrays)] = start
        corners, uvs, parts, self._are_straight = self.mesh.flatten(
            self.flat,
            start=places,
            straighten=layout.straight_cost if layout.straight else None,
            up=UP if layout.upright else None,
        )
        return corners, uvs, parts

    def unwrapped(self) -> Solved:
        corners = np.unique(self._triangles[np.isin(self._labels, self._unpinned)])
        uvs = uv_islands.read_uvs(self.obj)[corners] * (self.aspect, 1.0)
        return corners, uvs, self._of_face[self.corners.faces[corners]].astype(np.int64)

    def to_place(self, corners: NDArray[np.int64], density: float) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """Return what there is to place of unwrapped islands: copies and islands with pins need no place.

        These are triangles as rows of the islands' corners, (t, 3), all corners in the old map, (c, 2), and for each triangle, (t,), its
        wanted area in the map, and whether its island was laid out straight. A texel density is for islands that had none.
        """
        rows = np.isin(self._labels, np.setdiff1d(self._unpinned, self.stacked))
        labels = self._labels[rows]
        areas = np.where(self._densities > 0.0, self._densities, density)[labels] ** 2 * self._areas[rows]
        triangles = np.searchsorted(corners, self._triangles[rows])
        return triangles, self.before[corners], areas, self._are_straight[labels]

    def taken(self) -> NDArray[np.float64]:
        """Return the bounds in the map of the faces that stay, are hidden, or lie where Blender has put them because of pins, (b, 4)."""
        rows = ~np.isin(self._of_face[self.corners.faces], self._unpinned)
        starts = np.flatnonzero(np.diff(self.corners.faces[rows], prepend=-1))
        if self._uvs is None or not len(starts):
            return np.empty((0, 4))
        uvs = uv_islands.read_uvs(self.obj)[rows].astype(np.float64)
        return np.concatenate([np.minimum.reduceat(uvs, starts), np.maximum.reduceat(uvs, starts)], axis=1)

    def areas(self) -> NDArray[np.float64]:
        """Return the areas of the islands in the old map and on the model, (2, count)."""
        in_map = uv_areas(self.before[self._triangles])
        return np.stack([np.bincount(self._labels, areas, self.count) for areas in (in_map, self._areas)])

    def restore(self) -> None:
        if self._uvs is not None:
            self.write(np.arange(len(self._uvs)), self._uvs.astype(np.float64))
            bmesh.update_edit_mesh(self.obj.data, loop_triangles=False, destructive=False)

    def write(self, corners: NDArray[np.int64], uvs: NDArray[np.float64]) -> None:
        """Give corners, (c,), their places in the map, (c, 2)."""
        bm = edit_mesh.edit_bmesh(self.obj.data)
        layer = bm.loops.layers.uv.active
        places = dict(zip(corners.tolist(), uvs.tolist(), strict=True))
        starts = (np.cumsum(self.corners.sizes) - self.corners.sizes).tolist()
        for face in np.unique(self.corners.faces[corners]).tolist():
            for number, loop in enumerate(bm.faces[face].loops, start=starts[face]):
                if number in places:
                    loop[layer].uv = places[number]

    def mapped(self) -> tuple[seamwire_core.UnwrapMesh, NDArray[np.int64], NDArray[np.float32]]:
        return self.mesh, self.changed, uv_islands.read_uvs(self.obj)

    def unmapped(self) -> int:
        return self.mesh.count_unmapped(uv_islands.read_uvs(self.obj)) if (self._of_face < 0).any() else 0

    def turn_back(self) -> bool:
        """Turn back what rounding has turned over in changed islands without pins; return whether anything has moved."""
        corners, places = self.mesh.turn_back(uv_islands.read_uvs(self.obj), self._unpinned)
        self.write(corners, places)
        return len(corners) > 0

    def remember(self) -> None:
        """Let visible edges hold whether they were seams when they were unwrapped last."""
        bm = edit_mesh.edit_bmesh(self.obj.data)
        layer = bm.edges.layers.int.get(UNWRAPPED) or bm.edges.layers.int.new(UNWRAPPED)
        plain, seam = self._signs()
        # New faces may meet at edges that have one face so far.
        visible = self.corners.edges[self._of_face[self.corners.faces] >= 0]
        between = (np.bincount(visible, minlength=len(self._seams)) == 2).tolist()
        for edge in bm.edges:
            if not edge.hide:
                edge[layer] = (seam if edge.seam else plain) if between[edge.index] else 0
        bmesh.update_edit_mesh(self.obj.data, loop_triangles=False, destructive=False)


def unwrap_changed(
    context: bpy.types.Context,
    *,
    method: str = "SEAMWIRE",
    layout: Layout = Layout(),
    every: bool = False,
    starts: Mapping[bpy.types.Object, NDArray[np.float64]] = MappingProxyType({}),
) -> Unwrapped:
    """Unwrap the islands whose seams have changed, or all, of all objects in edit mode; selections stay.

    Where nothing stays, all flattened islands are packed. Else each new island gets the texel density it had, and a place near its old
    one, see ``seamwire_core.place_islands``. Blender unwraps and places islands with pinned corners, and with
    another `method` unwraps all.
    `starts` are maps of some objects to start from, (m, 3, 2), in lengths on the model, for all visible triangles.

    Raises ValueError or NativeError if there is nothing to unwrap, or it cannot be unwrapped; then nothing is changed.
    """
    maps, problems = [], []
    for obj in context.objects_in_mode_unique_data:
        try:
            found = _Map(obj, every, by_library=method == "SEAMWIRE")
            if not found.count:
                raise edit_mesh.NothingVisibleError(obj)
            maps.append(found)
        except edit_mesh.NothingVisibleError as error:
            problems.append(str(error))
        except ValueError as error:
            problems.insert(0, f"{obj.name}: {error}")
    if not maps:
        raise ValueError((*problems, ALL_HIDDEN)[0])
    unwrapped, faults = sum(len(found.changed) for found in maps), NO_FAULTS
    kept = sum(found.count for found in maps) - unwrapped
    if unwrapped:
        solved = {found: found.flattened(starts.get(found.obj), layout) for found in maps if len(found.flat)}
        with _with_uv_maps(context, maps):
            try:
                _unwrap_by_blender(context, maps, "ANGLE_BASED" if method == "SEAMWIRE" else method)
                copies = _find_copies(maps) if layout.stack else []
                _place(maps, solved, layout)
                _pile_up(copies)
                faults = _faults(maps)
                if faults.flipped and any([found.turn_back() for found in maps]):
                    _pile_up(copies)
                    faults = _faults(maps)
            except BaseException:
                for found in maps:
                    found.restore()
                raise
    for found in maps:
        if len(found.changed):
            found.remember()
    unmapped = sum(found.unmapped() for found in maps) if unwrapped else 0
    return Unwrapped(unwrapped, kept, faults, unmapped, problems, [found.obj for found in maps])


def faults_of(obj: bpy.types.Object, *, may_stack: bool = False) -> MapFaults:
    """Measure what is wrong with the UV map that an edit mesh has. If islands `may_stack`, they may lie exactly on each other."""
    found = _Map(obj, every=True, by_library=True)
    return MapFaults(*native.load().map_faults([(*found.mapped(), None)], may_stack=may_stack))


def _faults(maps: Sequence[_Map]) -> MapFaults:
    mapped = [(*found.mapped(), found.before) for found in maps]
    return MapFaults(*native.load().map_faults(mapped, may_stack=any(len(found.stacked) for found in maps)))


def _unwrap_by_blender(context: bpy.types.Context, maps: Sequence[_Map], method: str) -> None:
    """Unwrap the changed islands that are not `flat` with a method of Blender, and let it pack them; raises ValueError if it cannot."""
    faces = {found: found.faces(np.setdiff1d(found.changed, found.flat)) for found in maps}
    if not any(len(numbers) for numbers in faces.values()):
        return
    with edit_mesh.nothing_selected(context):
        for found, numbers in faces.items():
            bm = edit_mesh.edit_bmesh(found.obj.data)
            for face in numbers.tolist():
                bm.faces[face].select = True
        # Not in the UV editor, where its own selection counts.
        with context.temp_override(area=None, region=None):
            try:
                bpy.ops.uv.unwrap(method=method)
            except RuntimeError as error:
                raise ValueError(f"Blender could not unwrap: {str(error).strip()}") from error


def _place(maps: Sequence[_Map], solved: Mapping[_Map, Solved], layout: Layout) -> None:
    """Give unwrapped islands a place each: beside those that stay, or packed as a layout says where nothing stays."""
    taken = np.concatenate([found.taken() for found in maps])
    if len(taken):  # where nothing stays, Blender has packed its islands
        solved = {found: solved.get(found) or found.unwrapped() for found in maps if len(found.changed)}
    if not solved:
        return
    sums = sum(np.delete(found.areas(), found.changed, axis=1).sum(axis=1) for found in maps)
    if not (sums > 0.0).all():  # the islands may cover a quarter of the square
        sums = np.array([0.25, max(sum(found.areas()[1].sum() for found in maps), 1e-300)])
    density = float(np.sqrt(sums[0] / sums[1]))
    starts = np.cumsum([0, *(len(corners) for corners, _, _ in solved.values())])
    firsts = np.cumsum([0, *(int(labels.max(initial=-1)) + 1 for _, _, labels in solved.values())])
    places = np.concatenate([own for _, own, _ in solved.values()])
    labels = np.concatenate([own + first for (_, _, own), first in zip(solved.values(), firsts, strict=False)])
    parts = [found.to_place(corners, density) for found, (corners, _, _) in solved.items()]
    triangles = np.concatenate([own[0] + start for own, start in zip(parts, starts, strict=False)])
    numbers, rows, islands = np.unique(labels[triangles[:, 0]], return_index=True, return_inverse=True)
    aspects = np.repeat([found.aspect for found in solved], [len(own[0]) for own in parts])[rows]
    placements = np.zeros((firsts[-1], 2, 3))
    if len(taken):
        _, before, areas, straight = (np.concatenate(each) for each in zip(*parts, strict=True))
        areas = np.bincount(islands, areas, len(numbers))
        placements[numbers] = native.load().place_islands(
            before, places, triangles, islands, areas, taken=taken, aspects=aspects, straight=straight[rows]
        )
    else:
        turns = "quarters" if layout.upright else "any"
        packing = native.load().pack_islands(places[triangles], islands, margin=MARGIN, turns=turns, aspects=aspects)
        placements[numbers] = packing.placements
    placed = np.einsum("cij,cj->ci", placements[labels, :, :2], places) + placements[labels, :, 2]
    for (found, (corners, _, _)), own in zip(solved.items(), np.split(placed, starts[1:-1]), strict=True):
        found.write(corners, own)
        bmesh.update_edit_mesh(found.obj.data, loop_triangles=False, destructive=False)


def _find_copies(maps: Sequence[_Map]) -> list[_Copy]:
    """Find the islands that lie on others, for each width of the image that the UVs lie on."""
    copies: list[_Copy] = []
    for aspect in dict.fromkeys(found.aspect for found in maps):
        own = [found for found in maps if found.aspect == aspect]
        for mesh, label, corners, other, below in native.load().island_copies([(each.mesh, each.flat) for each in own]):
            own[mesh].stacked.append(label)
            copies.append((own[mesh], corners, own[other], below))
    return copies


def _pile_up(copies: Sequence[_Copy]) -> None:
    present = {other: uv_islands.read_uvs(other.obj) for _, _, other, _ in copies}
    for found in dict.fromkeys(copy[0] for copy in copies):
        own = [(corners, present[other][below]) for each, corners, other, below in copies if each is found]
        corners, uvs = map(np.concatenate, zip(*own, strict=True))
        found.write(corners, uvs.astype(np.float64))


@contextmanager
def _with_uv_maps(context: bpy.types.Context, maps: Sequence[_Map]) -> Iterator[None]:
    """Let objects that are unwrapped have a UV map, and other objects none that they had not; on an error all as before."""
    # Blender would make missing UV maps while it unwraps, and what is selected would be other items then.
    made = [found.obj.data for found in maps if not found.obj.data.uv_layers]
    for data in made:
        data.uv_layers.new()
    # It would make some, too, for objects of which nothing is selected.
    bare = [obj.data for obj in context.objects_in_mode_unique_data if not obj.data.uv_layers]
    try:
        yield
    except BaseException:
        bare += made
        raise
    finally:
        for data in bare:
            while data.uv_layers:  # in Blender 5 references to layers do not last
                data.uv_layers.remove(data.uv_layers[0])
