# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires cut into the faces of an edit mesh: edges split where they cross, faces split along them.

The library plans the cuts. They are made by the operations of Blender's knife, so attributes come out as the knife leaves them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bmesh
import numpy as np
from mathutils import Vector

from ..core.base import native
from ..core.base.refused import Refused
from ..core.network.picks import FacePoint, vertices_of
from .cut_joins import cut_layers, holding, is_left_behind, join, mark_seams
from .unwrap import UNWRAPPED

if TYPE_CHECKING:
    from seamwire_core import CutCurve, CutPlan

    from ..core.base.mesh_arrays import Arrays
    from ..core.network.picks import Edge, Pick
    from .edit_mesh import Cage

    Node = tuple[tuple[int, ...], tuple[float, ...]]
    """Vertices, and the weight of each."""

_RINGS = 3
"""How far one looks around a pick once vertices are found that stay: those of the face that it lies in may not be the first."""


class CutError(Refused):
    """A wire cannot be cut into the mesh."""


@dataclass(frozen=True)
class Cut:
    """The result of a cut."""

    edges: tuple[Edge, ...]  # those that the wires run along
    seeds: Mapping[int | FacePoint, int]  # those asked for, with the numbers of their vertices
    vertices: int  # how many are new
    uncut: int  # how many faces could not be cut
    wires: int = 0  # how many were cut
    left_out: int = 0  # how many wires and mirror images were not cut, because they do not run over the mesh


class PickedPlaces:
    """Where picks on visible faces are, whatever cuts are taken back afterwards; other parts of the mesh may lie at the same places."""

    def __init__(self, cage: Cage, picks: Iterable[Pick]) -> None:
        bm = cage.number_bmesh()
        # First of all: a new layer makes what was found before invalid.
        _add_unwrapped(bm)
        of_verts, _ = cut_layers(bm)
        self._verts: dict[Pick, bmesh.types.BMVert] = {}
        self._around: dict[Pick, list[bmesh.types.BMVert]] = {}
        for pick in picks:
            corners = [bm.verts[v] for v in (pick.corners if isinstance(pick, FacePoint) else vertices_of(pick))]
            if isinstance(pick, int):
                self._verts[pick] = corners[0]
            self._around[pick] = _verts_that_stay(corners, of_verts)

    def vertex(self, pick: Pick) -> int | None:
        """Return the number of a vertex that is there still; None of one that is not, and of another pick."""
        vert = self._verts.get(pick)
        return vert.index if vert is not None and vert.is_valid else None

    def faces(self, pick: Pick) -> list[int]:
        """Return the visible faces that a pick may lie in."""
        around = (face for vert in self._around[pick] if vert.is_valid for face in vert.link_faces)
        return sorted({face.index for face in around if not face.hide})


def _verts_that_stay(
    verts: Iterable[bmesh.types.BMVert], of_verts: bmesh.types.BMLayerItem
) -> list[bmesh.types.BMVert]:
    """Return the vertices near some that no cut made."""
    found = set(verts)
    waiting, rings = list(found), _RINGS
    while waiting and rings:
        rings -= any(not vert[of_verts] for vert in found)
        waiting = [vert for vert in {edge.other_vert(v) for v in waiting for edge in v.link_edges} if vert not in found]
        found.update(waiting)
    return [vert for vert in found if not vert[of_verts]]


def plan(arrays: Arrays, curves: Sequence[CutCurve]) -> CutPlan:
    """Find what curves cut. Raises `CutError` if nothing is cut."""
    found = native.load().plan_cuts(arrays.points, arrays.triangles, arrays.polygons, curves)
    if not len(found.along) and not found.across:
        for _, vertex in found.left_out:
            raise CutError(f"A wire does not run over the mesh near vertex {vertex}")
        raise CutError("Nothing to cut: every wire stays inside one face")
    return found


def rehearse(cage: Cage, what: CutPlan) -> None:
    """Cut a copy of an edit mesh, so that an error in splitting edges and faces comes before anything is changed.

    Taking cuts back, joining small islands and storing wires are not tried. The copy takes about 1 s for a million triangles.
    """
    bm = cage.number_bmesh().copy()
    try:
        _carry_out(bm, what, [])
    finally:
        bm.free()


def carry_out(cage: Cage, what: CutPlan, seeds: Iterable[int | FacePoint] = (), crumb: float = 0.0) -> Cut:
    """Cut an edit mesh as planned, and make seams of the cuts. Vertices, edges and faces have other numbers then.

    The numbers of `seeds`, vertices and points, are returned; of points, only those that the cuts go through have any. An island beside the
    cuts with less than the part `crumb` of the mesh's area becomes part of a larger one.
    """
    bm = cage.number_bmesh()
    before = len(bm.verts)
    with _changing(cage):
        seams, seed_verts, uncut = _carry_out(bm, what, list(seeds))
        new = [edge for edge in seams if not edge.seam]
        mark_seams(bm, seams)
        # The new cuts may lead on from where edges held the ends of other seams.
        passed = {vert for edge in seams for vert in edge.verts}
        join(bm, holding(bm, passed), passed)
        if crumb > 0.0:
            join(bm, _crumb_borders(bm, new, crumb * sum(face.calc_area() for face in bm.faces)))
            seams = [edge for edge in seams if edge.is_valid and edge.seam]
    bm = cage.number_bmesh()
    pairs = {(min(pair), max(pair)) for pair in ((edge.verts[0].index, edge.verts[1].index) for edge in seams)}
    # Those inside a face that could not be cut went.
    numbers = {seed: vert.index for seed, vert in seed_verts.items() if vert.is_valid}
    return Cut(tuple(sorted(pairs)), numbers, len(bm.verts) - before, uncut)


@contextmanager
def _changing(cage: Cage) -> Iterator[None]:
    """Tell Blender of changes, even where they end on an error."""
    try:
        yield
    finally:
        # Blender's update keeps the normals, and a face that was split while it was drawn as a regular polygon has the wrong one.
        cage.number_bmesh().normal_update()
        bmesh.update_edit_mesh(cage.data, loop_triangles=True, destructive=True)


def _carry_out(
    bm: bmesh.types.BMesh, what: CutPlan, seeds: Sequence[int | FacePoint]
) -> tuple[list[bmesh.types.BMEdge], dict[int | FacePoint, bmesh.types.BMVert], int]:
    """Cut, and return the edges along the cuts, the seeds, and how many faces could not be cut."""
    # First of all: a new layer makes what was found before invalid.
    of_verts, of_edges = cut_layers(bm)
    nodes = _nodes(what)
    corners = {vertex: bm.verts[vertex] for vertices, _ in nodes for vertex in vertices}
    seed_verts = {seed: bm.verts[seed] for seed in seeds if isinstance(seed, int)}
    faces = {polygon: (bm.faces[polygon], list(bm.faces[polygon].verts)) for polygon, _, _ in what.across}
    vert_of = {node: corners[vertices[0]] for node, (vertices, _) in enumerate(nodes) if len(vertices) == 1}
    # Points inside faces come first, because their faces are still whole.
    for node in np.flatnonzero(what.polygons >= 0).tolist():
        vertices, weights = nodes[node]
        vert_of[node] = _vert_inside(bm, [corners[vertex] for vertex in vertices], weights)
    for (a, b), between in what.splits:
        last, end, passed = corners[a], corners[b], 0.0
        for node in between:
            edge, weight = bm.edges.get((last, end)), nodes[node][1][1]
            _, last = bmesh.utils.edge_split(edge, last, (weight - passed) / (1.0 - passed))
            vert_of[node], passed = last, weight
    at_points = {seed: what.node_at(seed.corners, seed.weights) for seed in seeds if isinstance(seed, FacePoint)}
    seed_verts |= {seed: vert_of[node] for seed, node in at_points.items() if node is not None}
    new = [vert for node, vert in vert_of.items() if len(nodes[node][0]) > 1]
    for vert in new:
        vert[of_verts] = 1
    seams = list(_edges_along(bm, what, vert_of))
    node_of = {vert: nodes[node] for node, vert in vert_of.items()}
    uncut, left = 0, set()
    for polygon, cuts, is_folded in what.across:
        face, rim = faces[polygon]
        ends = [(vert_of[one], vert_of[two]) for one, two in cuts.tolist()]
        edges = _edges_between(bm, ends, of_edges)
        if is_folded or not _split(face, edges):
            between = {vert: node_of[vert] for vert in {*face.verts, *itertools.chain(*ends)} - {*rim}}
            with _drawn(face, rim, between, corners):
                _split(face, edges)
        loose = {edge for edge in edges if not edge.link_faces}
        uncut += bool(loose)
        left |= loose
        seams += [edge for edge in edges if edge not in loose]
    _remove_loose(bm, [edge for edge in left if edge[of_edges]])
    _spread_selection(bm, [vert for vert in new if vert.is_valid])
    return seams, seed_verts, uncut


def _nodes(what: CutPlan) -> list[Node]:
    """Return the nodes of a plan, without vertices that are not used."""
    counts = (what.vertices >= 0).sum(axis=1).tolist()
    rows = zip(counts, what.vertices.tolist(), what.weights.tolist(), strict=True)
    return [(tuple(vertices[:count]), tuple(weights[:count])) for count, vertices, weights in rows]


def _edges_along(
    bm: bmesh.types.BMesh, what: CutPlan, vert_of: Mapping[int, bmesh.types.BMVert]
) -> Iterator[bmesh.types.BMEdge]:
    """Yield the edges that cuts run along. Raises `CutError` if there is no such edge."""
    for one, two in what.along.tolist():
        edge = bm.edges.get((vert_of[one], vert_of[two]))
        if edge is None:
            raise CutError(f"A wire does not run over the mesh near vertex {int(what.vertices[one, 0])}")
        yield edge


def _remove_loose(bm: bmesh.types.BMesh, edges: Iterable[bmesh.types.BMEdge]) -> None:
    """Remove edges of faces that could not be cut, and the vertices that nothing else holds."""
    ends = set()
    for edge in edges:
        if not edge.link_faces:
            ends.update(edge.verts)
            bm.edges.remove(edge)
    for vert in ends:
        if not vert.link_edges:
            bm.verts.remove(vert)


def _spread_selection(bm: bmesh.types.BMesh, verts: Iterable[bmesh.types.BMVert]) -> None:
    """Select new vertices, and the edges between them, that lie on selected faces and edges."""
    selected = [item for vert in verts for item in (*vert.link_faces, *vert.link_edges) if item.select]
    for item in selected:
        item.select = True
    if selected:
        bm.select_flush_mode()


def _add_unwrapped(bm: bmesh.types.BMesh) -> None:
    """See that unwrapping can be told where faces were joined."""
    if bm.loops.layers.uv and bm.edges.layers.int.get(UNWRAPPED) is None:
        bm.edges.layers.int.new(UNWRAPPED)


def left_behind(cage: Cage, edges: Iterable[Edge]) -> list[Edge]:
    """Return those among some edges where a cut can be taken back, see `cut_joins.is_left_behind`."""
    bm = cage.number_bmesh()
    found = ((pair, bm.edges.get((bm.verts[pair[0]], bm.verts[pair[1]]))) for pair in edges)
    return [pair for pair, edge in found if edge is not None and is_left_behind(bm, edge)]


def take_back(cage: Cage, edges: Iterable[Edge]) -> int:
    """Join what cuts along some edges parted, see `cut_joins.join`, and return how many of these edges went.

    Edges that hold ends of these cuts go too. Vertices, edges and faces have other numbers then.
    """
    bm = cage.number_bmesh()
    with _changing(cage):
        _add_unwrapped(bm)
        cut_layers(bm)
        own = [edge for a, b in edges if (edge := bm.edges.get((bm.verts[a], bm.verts[b]))) is not None]
        return join(bm, [*own, *holding(bm, {vert for edge in own for vert in edge.verts})])


def _crumb_borders(
    bm: bmesh.types.BMesh, cuts: Collection[bmesh.types.BMEdge], least: float
) -> list[bmesh.types.BMEdge]:
    """Let cuts be no seams, and return them, where they part islands of less than an area from one of more, over the longest border."""
    own, large, gone = set(cuts), set(), []
    waiting = [face for edge in cuts for face in edge.link_faces if not face.hide]
    while waiting:
        crumb = _crumb_at(waiting[-1], least, large)
        borders = [
            border
            for border in _borders(crumb, own)
            if any(face not in crumb and not _crumb_at(face, least, large) for face in border[0].link_faces)
        ]
        if not borders:
            waiting.pop()
            continue
        border = max(borders, key=lambda edges: sum(edge.calc_length() for edge in edges))
        for edge in border:
            edge.seam = False
        own.difference_update(border)
        gone += border
    return gone


def _crumb_at(face: bmesh.types.BMFace, least: float, large: set[bmesh.types.BMFace]) -> set[bmesh.types.BMFace]:
    """Return the faces of the island with a face, none where it has a `least` area; those found of such islands become `large`."""
    found, waiting, area = {face}, [face], 0.0
    while waiting:
        here = waiting.pop()
        area += here.calc_area()
        if area >= least or here in large:
            large |= found
            return set()
        beside = {other for edge in here.edges if not edge.seam for other in edge.link_faces if not other.hide} - found
        found |= beside
        waiting += beside
    return found


def _borders(island: set[bmesh.types.BMFace], cuts: set[bmesh.types.BMEdge]) -> list[list[bmesh.types.BMEdge]]:
    """Return the cuts that part an island from others, in stretches between where seams branch or end."""
    left = {
        edge
        for face in island
        for edge in face.edges
        if edge in cuts and any(other not in island and not other.hide for other in edge.link_faces)
    }
    stretches = []
    while left:
        waiting = [left.pop()]
        stretches.append(stretch := [])
        while waiting:
            stretch.append(edge := waiting.pop())
            for vert in edge.verts:
                seams = [other for other in vert.link_edges if other.seam]
                if len(seams) == 2 and not vert.is_boundary:
                    following = left.intersection(seams)
                    left -= following
                    waiting += following
    return stretches


def _vert_inside(
    bm: bmesh.types.BMesh, corners: Sequence[bmesh.types.BMVert], weights: Sequence[float]
) -> bmesh.types.BMVert:
    """Make a vertex between two or three others, its attributes and shape keys interpolated."""
    place = sum((weight * corner.co for corner, weight in zip(corners, weights, strict=True)), Vector())
    vert = bm.verts.new(place)
    vert.copy_from_vert_interp(corners[:2], weights[1] / (weights[0] + weights[1]))
    if len(corners) == 3:
        beside = bm.verts.new(place)
        beside.copy_from_vert_interp(corners[:2], weights[1] / (weights[0] + weights[1]))
        vert.copy_from_vert_interp([beside, corners[2]], weights[2])
        bm.verts.remove(beside)
    return vert


def _edges_between(
    bm: bmesh.types.BMesh,
    segments: Iterable[tuple[bmesh.types.BMVert, bmesh.types.BMVert]],
    of_edges: bmesh.types.BMLayerItem,
) -> list[bmesh.types.BMEdge]:
    """Return the edges between pairs of vertices; new ones belong to no face."""
    edges = []
    for segment in segments:
        edge = bm.edges.get(segment)
        if edge is None:
            edge = bm.edges.new(segment)
            edge[of_edges] = 1
        edges.append(edge)
    return edges


def _split(face: bmesh.types.BMFace, edges: Sequence[bmesh.types.BMEdge]) -> bool:
    """Split a face along edges between its corners and vertices inside it; return whether Blender could do it."""
    selected = face.select
    try:
        parts = bmesh.utils.face_split_edgenet(face, edges)
    except ValueError:
        return False
    if selected:
        for part in parts:
            part.select = True
    return len(parts) > 1


@contextmanager
def _drawn(
    face: bmesh.types.BMFace,
    rim: Sequence[bmesh.types.BMVert],
    between: Mapping[bmesh.types.BMVert, Node],
    corners: Mapping[int, bmesh.types.BMVert],
) -> Iterator[None]:
    """Move a face's vertices to a regular polygon in the meantime, because Blender splits no face that is folded or has no area.

    The corners before its edges were split, `rim`, become the corners of the polygon. The other vertices lie between some of them.
    """
    before = {vert: vert.co.copy() for vert in (*rim, *between)}
    for number, vert in enumerate(rim):
        angle = 2.0 * math.pi * number / len(rim)
        vert.co = (math.cos(angle), math.sin(angle), 0.0)
    for vert, parts in between.items():
        vert.co = sum((weight * corners[vertex].co for vertex, weight in zip(*parts, strict=True)), Vector())
    face.normal_update()
    try:
        yield
    finally:
        for vert, place in before.items():
            vert.co = place
