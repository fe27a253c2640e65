# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit mesh as arrays, seams back into it, and where Blender shows it.

Vertices, edges and faces carry the numbers that the edit mesh counts them by, hidden ones included; hidden faces and
edges are left out of what wires may run on. Modifiers such as an armature with *On Cage* show the mesh elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from functools import cached_property, partial
from types import MappingProxyType
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ..core.base import native
from ..core.base.geometry import barycentric, without_flat_triangles
from ..core.base.mesh_arrays import Arrays
from ..core.network.picks import vertices_of
from ..core.storage.wire_labels import EdgeLabels
from .registration import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Callable

    from mathutils import Matrix
    from numpy.typing import NDArray
    from seamwire_core import NearestPoints

    from ..core.network.picks import Pick

LABELS = ".seamwire"
"""The layer of the edges that holds their labels, see `core.storage.wire_labels`. Blender does not show names that begin so."""

_MOST_CURVES = 2_000
"""Curves whose triangles are remembered."""


class NothingVisibleError(ValueError):
    """There is nothing of the mesh of an object to work on: it has none, or all of it is hidden."""

    def __init__(self, obj: bpy.types.Object) -> None:
        super().__init__(f"No face is visible in {obj.name}: it has no faces, or all are hidden")


def edit_bmesh(data: bpy.types.Mesh) -> bmesh.types.BMesh:
    """Return the edit mesh of a mesh with right numbers, which operators such as View Selected leave wrong."""
    return _numbered(bmesh.from_edit_mesh(data))


def _numbered(bm: bmesh.types.BMesh) -> bmesh.types.BMesh:
    """Renumber vertices, edges and faces if any number is wrong, and return the edit mesh with its lookup tables."""
    for sequence in (bm.verts, bm.edges, bm.faces):
        sequence.ensure_lookup_table()
        sequence.index_update()
    return bm


class Cage:
    """The edit mesh of an object in edit mode, as long as its topology stays what it is. Outside edit mode, a copy that `write` stores."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self.data = obj.data
        self._is_edited = obj.mode == "EDIT"
        if self._is_edited:
            self._bm = edit_bmesh(obj.data)
        else:
            self._bm = bmesh.new()
            self._bm.from_mesh(obj.data)
            _numbered(self._bm)
        self._counts = self._count()

    def number_bmesh(self) -> bmesh.types.BMesh:
        """Return the edit mesh, each item with its number, see `edit_bmesh`. Call this again after each of Blender's operators."""
        return _numbered(self._bm)

    def _count(self) -> tuple[int, int, int]:
        return len(self._bm.verts), len(self._bm.edges), len(self._bm.faces)

    def intact(self) -> bool:
        return self._is_edited and self._bm.is_valid and self._count() == self._counts

    @property
    def vertex_count(self) -> int:
        """How many vertices the mesh had when it was read, hidden ones included."""
        return self._counts[0]

    def problem_with(self, pick: Pick) -> str:
        """Say in words what keeps a pick from being a seed; an empty string where nothing does."""
        count, bm = self._counts[0], self.number_bmesh()
        for vertex in vertices_of(pick):
            if not 0 <= vertex < count:
                return f"There is no vertex {vertex}: the mesh has {count}, numbered from 0"
            if bm.verts[vertex].hide:
                return f"Vertex {vertex} is hidden"
        if isinstance(pick, tuple):
            edge = _edge(bm, pick)
            if edge is None:
                return f"There is no edge {pick[0]}-{pick[1]}"
            if edge.hide:
                return f"Edge {pick[0]}-{pick[1]} is hidden"
        return ""

    def active_vertex(self) -> int | None:
        active = self.number_bmesh().select_history.active
        if not isinstance(active, bmesh.types.BMVert) or active.hide:
            return None
        return active.index

    def is_seam(self, pair: tuple[int, int]) -> bool:
        edge = _edge(self.number_bmesh(), pair)
        return edge is not None and edge.seam

    def labels(self, among: Iterable[tuple[int, int]] | None = None, was_read: bool = False) -> EdgeLabels:
        """Return the labelled edges in the order of their numbers.

        If edges are given that include all with a label, only these are looked at. After `read`, the mesh can tell which edges have one.
        """
        bm = self.number_bmesh()
        layer = bm.edges.layers.int.get(LABELS)
        if layer is None:
            return EdgeLabels.none()
        edges = bm.edges
        if among is not None:
            there = {edge.index: edge for pair in among if (edge := _edge(bm, pair)) is not None}
            edges = [there[number] for number in sorted(there)]
        elif was_read:
            edges = [edges[row] for row in np.flatnonzero(stored_labels(self.data)).tolist()]
        found = [(label, edge) for edge in edges if (label := edge[layer])]
        return EdgeLabels(
            np.array([[v.index for v in edge.verts] for _, edge in found], dtype=np.int64).reshape(-1, 2),
            np.array([label for label, _ in found], dtype=np.int64),
            np.array([edge.seam for _, edge in found], dtype=bool),
            np.array([edge.hide for _, edge in found], dtype=bool),
        )

    def write(
        self,
        mark: Iterable[tuple[int, int]],
        clear: Iterable[tuple[int, int]] = (),
        labels: Mapping[tuple[int, int], int] = MappingProxyType({}),
    ) -> tuple[int, int]:
        """Make edges seams, and others no seams, give edges other labels, and change nothing else. Return how many were changed of both.

        Raises ValueError where two vertices have no edge between them; then nothing is changed.
        """
        # Looked up twice: a new layer makes what was found before invalid.
        for pairs in (mark := list(mark), clear := list(clear), labels):
            self._found(pairs)
        layers = self.number_bmesh().edges.layers.int
        layer = layers.get(LABELS) or (layers.new(LABELS) if any(labels.values()) else None)
        new = [edge for edge in self._found(mark) if not edge.seam]
        old = [edge for edge in self._found(clear) if edge.seam]
        for edge in new:
            edge.seam = True
        for edge in old:
            edge.seam = False
        if layer is not None:
            for edge, label in zip(self._found(labels), labels.values(), strict=True):
                edge[layer] = label
            if labels and not any(labels.values()) and not any(edge[layer] for edge in self.number_bmesh().edges):
                self.number_bmesh().edges.layers.int.remove(layer)
        if new or old or labels:
            _numbered(self._bm)  # a layer that comes or goes takes the numbers away
            if self._is_edited:
                bmesh.update_edit_mesh(self.data, loop_triangles=False, destructive=False)
            else:
                self._bm.to_mesh(self.data)
        return len(new), len(old)

    def _found(self, pairs: Iterable[tuple[int, int]]) -> list[bmesh.types.BMEdge]:
        found, bm = [], self.number_bmesh()
        for pair in pairs:
            edge = _edge(bm, pair)
            if edge is None:
                raise ValueError(f"There is no edge {pair[0]}-{pair[1]} to mark")
            found.append(edge)
        return found


def stored_labels(data: bpy.types.Mesh) -> NDArray[np.int32]:
    """Return the label of each edge, (e,), in what Blender stored last of a mesh; nothing if no edge has any."""
    with copied(data) if data.is_editmode else nullcontext(data) as shared:
        attribute = shared.attributes.get(LABELS)
        return np.empty(0, np.int32) if attribute is None else column(attribute.data, "value", np.int32)


@contextmanager
def copied(data: bpy.types.Mesh) -> Iterator[bpy.types.Mesh]:
    """Copy a mesh, which itself shows no attributes in edit mode. In newer versions a copy shares the data and costs nothing."""
    shared = data.copy()
    try:
        yield shared
    finally:
        bpy.data.meshes.remove(shared)


def _edge(bm: bmesh.types.BMesh, pair: tuple[int, int]) -> bmesh.types.BMEdge | None:
    return bm.edges.get((bm.verts[pair[0]], bm.verts[pair[1]]))


def read(obj: bpy.types.Object) -> Arrays:
    obj.update_from_editmode()  # the mesh then has the edit mesh's data, by the same numbers
    with nullcontext(obj.data) if IS_OLD else copied(obj.data) as shared:
        columns, key = partial(_read_column, shared), obj.active_shape_key
        # The active shape key is edited and seen, and the mesh holds the basis. Without keys the index is what it was with them.
        is_basis = key is None or obj.active_shape_key_index == 0
        points = columns("points") if is_basis else column(key.data, "co", np.float32, 3)
        return _arrays(obj, obj.data, columns, points)


def read_evaluated(obj: bpy.types.Object) -> tuple[Arrays, NDArray[np.bool_]]:
    """Read the mesh of an object in object mode as it is seen. Also return which vertices were selected in edit mode, (n,)."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    data = evaluated.to_mesh()
    try:
        columns = partial(_read_column, data)
        return _arrays(obj, data, columns, columns("points")), columns("selected")
    finally:
        evaluated.to_mesh_clear()


def _arrays(
    obj: bpy.types.Object, data: bpy.types.Mesh, columns: Callable[[str], NDArray], points: NDArray[np.float32]
) -> Arrays:
    points = points.astype(np.float64)
    edges, visible = columns("edges"), ~columns("hidden edges")
    seams = edges[visible & columns("seams")]
    marked = tuple(edges[visible & marks] for marks in (columns("sharp edges"), _between_materials(data, columns)))
    edges = edges[visible]
    if len(edges) == 0:
        raise NothingVisibleError(obj)
    hidden, corners, count = columns("hidden faces"), columns("corners"), len(data.polygons)
    sizes = np.full(count, 3) if len(corners) == 3 * count else column(data.polygons, "loop_total", np.int32)
    # Into triangles as Blender does, but into none without area. Reading a million of them from Blender takes most of a second.
    if sizes.max(initial=0) > 4:
        data.calc_loop_triangles()
        polygons = column(data.loop_triangles, "polygon_index", np.int32)
        triangles = without_flat_triangles(points, column(data.loop_triangles, "vertices", np.int32, 3), polygons)
    else:
        triangles, polygons = native.load().triangulate(points, corners, sizes)
    partly_hidden = edges[:0]
    if hidden.any():
        visible = ~hidden[polygons]
        sides = triangles[~visible][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        keys = (np.sort(pairs, axis=1).astype(np.int64) @ [1 << 32, 1] for pairs in (edges, sides))
        partly_hidden = edges[np.isin(*keys)]
        triangles, polygons = triangles[visible], polygons[visible]
    stretch = visible_stretch(obj.matrix_world)
    return Arrays(points @ stretch, triangles, polygons, edges, np.linalg.inv(stretch), seams, partly_hidden, marked)


def _between_materials(data: bpy.types.Mesh, columns: Callable[[str], NDArray]) -> NDArray[np.bool_]:
    found = np.zeros(len(data.edges), dtype=np.bool_)
    if len(data.materials) > 1:
        edges = column(data.loops, "edge_index", np.int32)
        materials = np.repeat(columns("materials"), column(data.polygons, "loop_total", np.int32))
        order = np.argsort(edges, kind="stable")
        edges, materials = edges[order], materials[order]
        found[edges[1:][(edges[1:] == edges[:-1]) & (materials[1:] != materials[:-1])]] = True
    return found


_SOURCES = {
    "points": ("vertices", "co", ("position",), np.float32, 3),
    "selected": ("vertices", "select", (".select_vert",), np.bool_, 1),
    "edges": ("edges", "vertices", (".edge_verts",), np.int32, 2),
    "hidden edges": ("edges", "hide", (".hide_edge",), np.bool_, 1),
    "seams": ("edges", "use_seam", ("uv_seam", ".uv_seam"), np.bool_, 1),
    "sharp edges": ("edges", "use_edge_sharp", ("sharp_edge",), np.bool_, 1),
    "corners": ("loops", "vertex_index", (".corner_vert",), np.int32, 1),
    "materials": ("polygons", "material_index", ("material_index",), np.int32, 1),
    "hidden faces": ("polygons", "hide", (".hide_poly",), np.bool_, 1),
}
"""For each name the items and their property, the names of the attribute, and what it holds. In newer versions of Blender, all data of a
mesh is attributes, which are read ten times as fast as items."""


def _read_column(data: bpy.types.Mesh, name: str) -> NDArray:
    items, key, attributes, dtype, width = _SOURCES[name]
    items = getattr(data, items)
    if IS_OLD:
        return column(items, key, dtype, width)
    found = next((one for one in attributes if one in data.attributes), None)
    if found is None or not len(items):  # there may be no attribute where all values are 0
        return np.zeros((len(items), width) if width > 1 else len(items), dtype=dtype)
    return column(data.attributes[found].data, "vector" if found == "position" else "value", dtype, width)


def column(items: bpy.types.bpy_prop_collection, name: str, dtype: type, width: int = 1) -> NDArray:
    flat = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, flat)
    return flat if width == 1 else flat.reshape(-1, width)


def visible_stretch(matrix: Matrix) -> NDArray[np.float64]:
    """Return what an object's matrix does to lengths, without its rotation: the symmetric S, (3, 3), of the polar decomposition R S.

    It is the identity where scaling is uniform, for the library does not mind the size, and where the matrix flattens the object.
    """
    linear = np.array(matrix.to_3x3(), dtype=np.float64)
    values, vectors = np.linalg.eigh(linear.T @ linear)
    lengths = np.sqrt(np.maximum(values, 0.0))
    # The matrix is of single precision: a rotation alone is off by some 1e-7.
    if lengths[0] <= 1e-6 * lengths[2] or lengths[2] - lengths[0] <= 1e-5 * lengths[2]:
        return np.eye(3)
    return (vectors * lengths) @ vectors.T


@contextmanager
def restored_after_errors(obj: bpy.types.Object) -> Iterator[None]:
    obj.update_from_editmode()
    before = obj.data.copy()
    try:
        yield
    except Exception:
        bm = bmesh.from_edit_mesh(obj.data)
        mode = set(bm.select_mode)
        bm.clear()
        has_keys = before.shape_keys is not None
        bm.from_mesh(before, use_shape_key=has_keys, shape_key_index=obj.active_shape_key_index if has_keys else 0)
        bm.select_mode = mode
        _numbered(bm)
        bmesh.update_edit_mesh(obj.data)
        raise
    finally:
        bpy.data.meshes.remove(before)


def live_unwrap(context: bpy.types.Context) -> None:
    """Unwrap anew if the scene asks for it: Blender does so wherever it marks seams, and with nothing selected that does nothing else."""
    if context.tool_settings.use_edge_path_live_unwrap:
        with nothing_selected(context):
            bpy.ops.mesh.mark_seam(clear=False)


@contextmanager
def nothing_selected(context: bpy.types.Context) -> Iterator[None]:
    """Let nothing be selected at first, and restore the selections of all objects in edit mode afterwards."""
    selections = []
    objects = list(context.objects_in_mode_unique_data)
    # A million objects of Python take a second. Blender selects everything at once.
    meshes = [(bmesh.from_edit_mesh(obj.data), obj.data) for obj in objects]
    is_whole = all(
        (len(bm.verts), len(bm.edges), len(bm.faces)) == (data.total_vert_sel, data.total_edge_sel, data.total_face_sel)
        for bm, data in meshes
    )
    for obj in objects:
        bm = edit_bmesh(obj.data)
        sequences = () if is_whole else (bm.verts, bm.edges, bm.faces)
        items = [item for sequence in sequences for item in sequence if item.select]
        # Not iterated: Blender 4.3 cannot, on the Python 3.13 of Debian 13.
        history = [bm.select_history[i] for i in range(len(bm.select_history))]
        # The edit mesh is held, because its items end with the last that holds it.
        selections.append((obj.data, bm, items, history, bm.faces.active))
    try:
        bpy.ops.mesh.select_all(action="DESELECT")
        yield
    finally:
        bpy.ops.mesh.select_all(action="SELECT" if is_whole else "DESELECT")
        for data, _, items, history, active in selections:
            bm = edit_bmesh(data)
            for item in items:
                item.select = True
            bm.select_history.clear()
            for item in history:
                bm.select_history.add(item)
            bm.faces.active = active
            bmesh.update_edit_mesh(data, loop_triangles=False, destructive=False)


def select_faces(obj: bpy.types.Object, faces: NDArray[np.integer]) -> None:
    bm = edit_bmesh(obj.data)
    for face in faces.tolist():
        bm.faces[face].select = True
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


class Pose:
    """Where the vertices of an edit mesh are seen, and any point of its surface with them.

    `points`, (n, 3), are the vertices as they are seen, in the coordinates of the arrays. If the pose `is_bent`, they are seen elsewhere
    than the mesh has them.
    """

    def __init__(self, arrays: Arrays) -> None:
        self._arrays = arrays
        # Curves, (k, 3), with the triangle nearest to each point, (k,), and its barycentric coordinates, (k, 3).
        self._found: dict[int, tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]] = {}
        self.points: NDArray[np.float64] = arrays.points
        self.is_bent = False

    def follow(self, obj: bpy.types.Object) -> bool:
        seen = _cage_points(obj, len(self._arrays.points))
        if seen is None and not self.is_bent:
            return False
        points = self._arrays.points if seen is None else seen @ np.linalg.inv(self._arrays.to_object).T
        if np.array_equal(points, self.points):
            return False
        self.points, self.is_bent = points, seen is not None
        return True

    def places(self, curve: NDArray[np.float64]) -> NDArray[np.float64]:
        rest, corners = self._arrays.points, self._arrays.triangles
        if not self.is_bent or not len(curve) or not len(corners):
            return curve
        # The curve itself is held: its number alone could come again.
        if id(curve) not in self._found:
            if len(self._found) >= _MOST_CURVES:
                self._found.clear()
            rows, _, _ = self._tree.find(curve)
            weights, off = barycentric(rest[corners[rows]], curve)
            weights[~np.isfinite(off)] = 1.0 / 3.0
            self._found[id(curve)] = curve, rows, weights
        _, rows, weights = self._found[id(curve)]
        return np.einsum("kc,kcx->kx", weights, self.points[corners[rows]])

    def at_rest(self, place: NDArray[np.float64], triangle: int) -> NDArray[np.float64]:
        """Return where a point, (3,), that is seen in a triangle is on the mesh without modifiers."""
        if not self.is_bent:
            return place
        corners = self._arrays.triangles[triangle]
        (weights,), (off,) = barycentric(self.points[corners][None], place)
        return weights @ self._arrays.points[corners] if np.isfinite(off) else self._arrays.points[corners[0]]

    @cached_property
    def _tree(self) -> NearestPoints:
        return native.load().NearestPoints(self._arrays.points, self._arrays.triangles)


def _depsgraph_of(obj: bpy.types.Object) -> bpy.types.Depsgraph:
    """Return the evaluated data of a scene with the object. The context may be that of a window with another scene."""
    context = bpy.context
    if context.view_layer.objects.get(obj.name) != obj:
        for window in context.window_manager.windows:
            if window.view_layer.objects.get(obj.name) == obj:
                with context.temp_override(window=window):
                    return bpy.context.evaluated_depsgraph_get()
    return context.evaluated_depsgraph_get()


def _cage_points(obj: bpy.types.Object, count: int) -> NDArray[np.float64] | None:
    """Return the vertices of an edit cage as modifiers bend it, (count, 3), in object coordinates. None: as the mesh has them.

    Blender shows the cage after the last modifier with *On Cage*, and tells only what is left after all modifiers. Both are the same if
    that modifier is the last one and none has changed the number of vertices.
    """
    active = [modifier for modifier in obj.modifiers if modifier.show_viewport and modifier.show_in_editmode]
    if not active or not active[-1].show_on_cage:
        return None
    evaluated = obj.evaluated_get(_depsgraph_of(obj))
    data = evaluated.to_mesh()
    try:
        if len(data.vertices) != count:
            return None
        points = np.empty(3 * count, dtype=np.float32)
        data.vertices.foreach_get("co", points)
        return points.reshape(-1, 3).astype(np.float64)
    finally:
        evaluated.to_mesh_clear()
