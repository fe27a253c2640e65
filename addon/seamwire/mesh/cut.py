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
from ..core.network.picks import FacePoint, undirected

if TYPE_CHECKING:
    from seamwire_core import CutCurve, CutPlan

    from ..core.base.mesh_arrays import Arrays
    from ..core.network.picks import Edge
    from .edit_mesh import Cage

    Node = tuple[tuple[int, ...], tuple[float, ...]]
    """Vertices, and the weight of each."""


class CutError(Refused):
    """A wire cannot be cut into the mesh."""


@dataclass(frozen=True)
class Cut:
    edges: tuple[Edge, ...]  # those that the wires run along
    seeds: Mapping[int | FacePoint, int]  # those asked for, with the numbers of their vertices
    vertices: int  # how many are new
    uncut: int  # how many faces could not be cut
    wires: int = 0  # how many were cut
    left_out: int = 0  # how many wires and mirror images were not cut, because they do not run over the mesh


def plan(arrays: Arrays, curves: Sequence[CutCurve]) -> CutPlan:
    """Find what curves cut. Raises `CutError` if nothing is cut."""
    found = native.load().plan_cuts(arrays.points, arrays.triangles, arrays.polygons, curves)
    if not len(found.along) and not found.across:
        for _, vertex in found.left_out:
            raise CutError(f"A wire does not run over the mesh near vertex {vertex}")
        raise CutError("Nothing to cut: every wire stays inside one face")
    return found


def rehearse(cage: Cage, what: CutPlan) -> None:
    """Cut a copy of an edit mesh, so that an error in splitting edges and faces comes before anything is changed."""
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
    try:
        seams, seed_verts, uncut = _carry_out(bm, what, list(seeds))
        new = [edge for edge in seams if not edge.seam]
        for edge in seams:
            edge.seam = True
        if crumb > 0.0:
            _join_crumbs(bm, new, crumb * sum(face.calc_area() for face in bm.faces))
            seams = [edge for edge in seams if edge.seam]
    finally:
        # Blender is told of changes even where they end on an error. Its update keeps the normals, and a face that was split while it was
        # drawn as a regular polygon has the wrong one.
        bm = cage.number_bmesh()
        bm.normal_update()
        bmesh.update_edit_mesh(cage.data, loop_triangles=True, destructive=True)
    bm = cage.number_bmesh()
    pairs = {undirected((edge.verts[0].index, edge.verts[1].index)) for edge in seams}
    # Those inside a face that could not be cut went.
    numbers = {seed: vert.index for seed, vert in seed_verts.items() if vert.is_valid}
    return Cut(tuple(sorted(pairs)), numbers, len(bm.verts) - before, uncut)


def _carry_out(
    bm: bmesh.types.BMesh, what: CutPlan, seeds: Sequence[int | FacePoint]
) -> tuple[list[bmesh.types.BMEdge], dict[int | FacePoint, bmesh.types.BMVert], int]:
    """Cut, and return the edges along the cuts, the seeds, and how many faces could not be cut."""
    for items in (bm.verts, bm.edges, bm.faces):
        items.ensure_lookup_table()
    rows = zip((what.vertices >= 0).sum(axis=1).tolist(), what.vertices.tolist(), what.weights.tolist(), strict=True)
    nodes: list[Node] = [(tuple(vertices[:count]), tuple(weights[:count])) for count, vertices, weights in rows]
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
    seams, node_of = [], {vert: nodes[node] for node, vert in vert_of.items()}
    for one, two in what.along.tolist():
        edge = bm.edges.get((vert_of[one], vert_of[two]))
        if edge is None:
            raise CutError(f"A wire does not run over the mesh near vertex {int(what.vertices[one, 0])}")
        seams.append(edge)
    uncut, left = 0, set()
    for polygon, cuts, is_folded in what.across:
        face, rim = faces[polygon]
        ends = [(vert_of[one], vert_of[two]) for one, two in cuts.tolist()]
        known = [bm.edges.get(segment) for segment in ends]
        edges = [
            edge or bm.edges.get(segment) or bm.edges.new(segment) for edge, segment in zip(known, ends, strict=True)
        ]
        if is_folded or not _split(face, edges):
            between = {vert: node_of[vert] for vert in {*face.verts, *itertools.chain(*ends)} - {*rim}}
            with _drawn(face, rim, between, corners):
                _split(face, edges)
        loose = {edge for edge in edges if not edge.link_faces}
        uncut += bool(loose)
        left |= loose.difference(known)
        seams += [edge for edge in edges if edge not in loose]
    # New edges in faces that could not be cut go, with the vertices that nothing else holds.
    loose = [edge for edge in left if not edge.link_faces]
    ends = {vert for edge in loose for vert in edge.verts}
    for edge in loose:
        bm.edges.remove(edge)
    for vert in ends:
        if not vert.link_edges:
            bm.verts.remove(vert)
    # New vertices, and the edges between them, that lie on selected faces and edges are selected.
    beside = [item for vert in new if vert.is_valid for item in (*vert.link_faces, *vert.link_edges) if item.select]
    for item in beside:
        item.select = True
    if beside:
        bm.select_flush_mode()
    return seams, seed_verts, uncut


def _join_crumbs(bm: bmesh.types.BMesh, cuts: Collection[bmesh.types.BMEdge], least: float) -> None:
    """Let cuts be no seams where they part islands of less than an area from one of more, over the longest border."""
    own, large = set(cuts), set()
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
    place = sum((weight * corner.co for corner, weight in zip(corners, weights, strict=True)), Vector())
    vert = bm.verts.new(place)
    vert.copy_from_vert_interp(corners[:2], weights[1] / (weights[0] + weights[1]))
    if len(corners) == 3:
        beside = bm.verts.new(place)
        beside.copy_from_vert_interp(corners[:2], weights[1] / (weights[0] + weights[1]))
        vert.copy_from_vert_interp([beside, corners[2]], weights[2])
        bm.verts.remove(beside)
    return vert


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
