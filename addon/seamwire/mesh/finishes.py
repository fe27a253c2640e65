# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing asks of the mesh, done: wires slid onto, and cut into faces.

Functions take the session of an object and return the session that goes on: afterwards vertices may have other numbers. A vertex slides
over its faces: what corners hold and shape keys stay where they are on the surface. Edges are split where wires cross them, and faces
along wires, by the operations of Blender's knife, so attributes come out as the knife leaves them.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bmesh
import numpy as np
from mathutils import Vector

from ..core.base import native
from ..core.base.refused import Refused
from ..core.network.picks import FacePoint, undirected
from ..core.seams.seam_wires import wires_between
from ..core.seams.slide_plan import SlidFaces
from ..core.seams.slide_plan import plan as plan_slide
from ..words.reports import count, not_cut
from .edit_mesh import restored_after_errors
from .object_session import ObjectSession
from .registration import IS_OLD

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    import bpy
    from seamwire_core import CutCurve, CutPlan

    from ..core.network.picks import Edge
    from ..core.network.wires import Wire
    from ..core.offers.surface_loops import TakenCut
    from ..core.seams.slide_plan import Move
    from ..core.sketch.change import Change
    from ..terms.choices import Finish
    from .edit_mesh import Cage

    Node = tuple[tuple[int, ...], tuple[float, ...]]
    """Vertices, and the weight of each."""
    Value = Vector | float

_SAME = 6
"""Digits that corners around a vertex have in common where they hang together, as in one island of a UV map."""


class CutError(Refused):
    """A wire cannot be cut into the mesh."""


@dataclass(frozen=True)
class Cut:
    edges: tuple[Edge, ...]  # those that the wires run along
    vertices: int  # how many are new
    uncut: int  # how many faces could not be cut
    wires: int  # how many were cut
    left_out: int  # how many wires and mirror images were not cut, because they do not run over the mesh


def apply(mesh: ObjectSession, change: Change) -> tuple[ObjectSession, str]:
    """Let the mesh do what a change asks, once it has the wires: finish them.

    The session of the mesh ends if anything is done. Returns the session that goes on, and the report, an empty text if nothing was done.
    After an unexpected error the mesh is restored, with the wires along edges.
    """
    wires = [wire for wire in mesh.session.wires if change.finishes(wire)]
    if not wires:
        return mesh, ""
    told = []
    with restored_after_errors(mesh.obj):
        drawn = {wire.vertices: wire.finish for wire in wires}
        slid = [wire for wire in wires if wire.finish == "SLIDE"]
        if slid:
            mesh, moved = move(mesh, slid, "SLIDE")
            told.append(f"Slide: {count(len(slid), 'wire')}, {count(moved, 'vertex', 'vertices')} moved")
            wires = [wire for wire in mesh.session.wires if drawn.get(wire.vertices) == wire.finish]
        # Cuts come last, because they renumber.
        cuts = [wire for wire in wires if wire.cuts]
        if cuts:
            try:
                mesh, done = cut(mesh, plan_cut(mesh, cuts), cuts, kept=True)
            except CutError as error:
                told.append(f"not cut: {error}")
            else:
                if done.wires:
                    told.append(f"{count(done.wires, 'wire')} cut, {count(len(done.edges), 'edge')} marked")
                told += not_cut(done.uncut, done.left_out)
    return mesh, ", ".join(told)


def move(mesh: ObjectSession, wires: Collection[Wire], finish: Finish) -> tuple[ObjectSession, int]:
    """Slide the vertices of snapped wires, and of their mirror images, onto the wires. Also return the number of moved vertices."""
    if not wires or finish != "SLIDE":
        return mesh, 0
    own = {wire: [wire, *mesh.session.mirrored(wire)] for wire in wires}
    courses = [(image.vertices, image.points) for images in own.values() for image in images]
    seams = {edge for images in own.values() for image in images for edge in image.edges()}
    vertices = {vertex for chain, _ in courses for vertex in chain}
    verts, arrays = mesh.cage.number_bmesh().verts, mesh.arrays
    around = (face for vertex in vertices for face in verts[vertex].link_faces if not face.hide)
    corners = {face.index: [vert.index for vert in face.verts] for face in around}
    faces = SlidFaces(arrays.points, arrays.triangles, arrays.polygons, corners)
    moves = plan_slide(faces, courses, stiff_vertices(mesh.cage, vertices, seams))
    if not moves:
        return mesh, 0
    _slide(mesh.obj, mesh.cage, moves)
    # The stored wire has the positions of its vertices. It is written again with the same curve.
    after = ObjectSession(mesh.obj)
    curve_of = {wire.vertices: wire.points for wire in wires}
    drawn = after.session.drawn
    kept = [
        wire.changed(points=curve_of[wire.vertices], faces=None) if wire.vertices in curve_of else wire
        for wire in drawn.wires
    ]
    after.session.adopt(replace(drawn, wires=tuple(kept)), after.plain_seams)
    _go_on_with(after, mesh.session.offering.cuts.taken(mesh.session.drawn))
    after.write(after.plan())
    return after, len(moves)


def plan_cut(mesh: ObjectSession, wires: Iterable[Wire]) -> CutPlan:
    """Find what wires across the surface and their mirror images cut, and try it on a copy of the edit mesh.

    The plan leaves out wires that do not run over the mesh, by their numbers here, and mirror images, by higher numbers. Raises CutError
    if no wire runs over the mesh, or nothing is cut.
    """
    wires, arrays = list(wires), mesh.arrays
    images = [
        (number, image) for number, wire in enumerate(wires) for image in mesh.session.mirrored(wire, curves=True)
    ]
    curves = [_curve(wire) for wire in wires] + [_curve(image, number) for number, image in images]
    plan = native.load().plan_cuts(arrays.points, arrays.triangles, arrays.polygons, curves)
    if not len(plan.along) and not plan.across:
        for _, vertex in plan.left_out:
            raise CutError(f"A wire does not run over the mesh near vertex {vertex}")
        raise CutError("Nothing to cut: every wire stays inside one face")
    # An error in splitting edges and faces so comes before anything is changed. Joining small islands and storing wires are not tried.
    bm = mesh.cage.number_bmesh().copy()
    try:
        _cut_faces(bm, plan, [])
    finally:
        bm.free()
    return plan


def cut(
    mesh: ObjectSession,
    plan: CutPlan,
    wires: Collection[Wire],
    kept: bool = False,
    crumb: float = 0.0,
) -> tuple[ObjectSession, Cut]:
    """Cut the mesh as `plan_cut` has planned for these wires, and return the session that goes on.

    Wires that are cut become wires along edges, between the seeds of those across the surface. The others stay as they are. If the mesh has
    these wires already (`kept`), their snapped edges cease to be seams. An island beside the cuts with less than the part `crumb` of the
    mesh's area becomes part of a larger one.
    """
    taken = mesh.session.offering.cuts.taken(mesh.session.drawn)
    skipped = [number for number, _ in plan.left_out if number < len(wires)]
    wires = [wire for number, wire in enumerate(wires) if number not in skipped]
    if kept:
        for wire in wires:
            mesh.session.drop(wire)
        mesh.write(mesh.plan())
    seeds = {end for wire in wires for end in (wire.start, wire.end)}
    bm = mesh.cage.number_bmesh()
    before = len(bm.verts)
    try:
        cuts, seed_verts, uncut = _cut_faces(bm, plan, list(seeds))
        new = [edge for edge in cuts if not edge.seam]
        for edge in cuts:
            edge.seam = True
        if crumb > 0.0:
            _join_crumbs(bm, new, crumb * sum(face.calc_area() for face in bm.faces))
            cuts = [edge for edge in cuts if edge.seam]
    finally:
        # Blender is told of changes even where they end on an error. Its update keeps the normals, and a face that was split while it was
        # drawn as a regular polygon has the wrong one.
        mesh.cage.number_bmesh().normal_update()
        bmesh.update_edit_mesh(mesh.cage.data, loop_triangles=True, destructive=True)
    bm = mesh.cage.number_bmesh()
    edges = {undirected((edge.verts[0].index, edge.verts[1].index)) for edge in cuts}
    # Those inside a face that could not be cut went.
    numbers = {seed: vert.index for seed, vert in seed_verts.items() if vert.is_valid}
    made = len(bm.verts) - before
    after = ObjectSession(mesh.obj)
    claimed = {edge for wire in after.session.wires for edge in wire.claims()}
    after.take_over(_cut_wires(after, edges - claimed, wires, numbers))
    _go_on_with(after, taken)
    after.write(after.plan())
    return after, Cut(tuple(sorted(edges)), made, uncut, len(wires), len(plan.left_out))


def _go_on_with(mesh: ObjectSession, taken: Iterable[TakenCut]) -> None:
    own = (each.of(mesh.session.drawn) for each in taken)
    mesh.session.offering.cuts.recall(each for each in own if each is not None)


def _cut_wires(
    mesh: ObjectSession, edges: set[Edge], wires: Collection[Wire], seeds: Mapping[int | FacePoint, int]
) -> Iterator[Wire]:
    """Yield wires along edges that others were cut along, between their seeds; what is the image of one is no other."""
    pairs = np.array(sorted(edges), dtype=np.int32).reshape(-1, 2)
    between = list(wires_between(pairs, set(seeds.values()), mesh.arrays.points))
    origin = {frozenset((seeds.get(wire.start), seeds.get(wire.end))): wire for wire in wires}
    mirrors = {wire.mirror for wire in wires}
    shared = mirrors.pop() if len(mirrors) == 1 else ()
    planned = all(wire.planned for wire in wires)
    between.sort(key=lambda wire: frozenset((wire.start, wire.end)) not in origin)
    left = set(edges)
    for wire in between:
        if left.isdisjoint(wire.edges()):
            continue
        own = origin.get(frozenset((wire.start, wire.end)))
        left.difference_update(wire.edges())
        wire = replace(wire, finish="CUT", mirror=shared, images=(), planned=planned)
        if own is not None:
            wire = replace(wire, follow=own.follow, strength=own.strength, mirror=own.mirror, planned=own.planned)
        images = {edge for image in mesh.session.mirrored(wire) for edge in image.edges()}
        if left.issuperset(images):
            left.difference_update(images)
            yield replace(wire, images=None)
        else:
            yield replace(wire, mirror=())


def _curve(wire: Wire, image_of: int | None = None) -> CutCurve:
    """Return a wire across the surface as the library cuts it. It begins and ends at points in triangles, or where its edges do."""
    start, end = (
        (pick.triangle, pick.weights) if isinstance(pick, FacePoint) else vertex
        for pick, vertex in ((wire.start, wire.vertices[0]), (wire.end, wire.vertices[-1]))
    )
    return native.load().CutCurve(wire.points, start, end, wire.faces, image_of)


def stiff_vertices(cage: Cage, vertices: Iterable[int], seams: Collection[Edge]) -> set[int]:
    """Return those of some vertices that must stay: on sharp and creased edges, between materials, on seams other than those given."""
    bm = cage.number_bmesh()
    layers = bm.edges.layers
    crease = layers.crease.active if IS_OLD else layers.float.get("crease_edge")

    def holds(edge: bmesh.types.BMEdge) -> bool:
        return (
            not edge.smooth
            or (crease is not None and edge[crease] > 0.0)
            or len({face.material_index for face in edge.link_faces}) > 1
            or (edge.seam and undirected(tuple(vert.index for vert in edge.verts)) not in seams)
        )

    return {vertex for vertex in vertices if any(map(holds, bm.verts[vertex].link_edges))}


def _slide(obj: bpy.types.Object, cage: Cage, moves: Mapping[int, Move]) -> None:
    """Move vertices. What corners of faces hold follows as with Blender's own sliding: UVs, colors and other numbers."""
    bm = cage.number_bmesh()
    spans = {vertex: ([bm.verts[corner] for corner in move.corners], move.weights) for vertex, move in moves.items()}
    # All is read before anything is written: neighbors move as well.
    places = {vertex: _mean([corner.co for corner in corners], weights) for vertex, (corners, weights) in spans.items()}
    keys = [
        (layer, {vertex: _mean([corner[layer] for corner in own], weights) for vertex, (own, weights) in spans.items()})
        for layer in bm.verts.layers.shape.values()
    ]
    kinds = ("uv", "color", "float_color", "float", "float_vector")
    layers = [layer for kind in kinds for layer in getattr(bm.loops.layers, kind).values()]
    corners = [(layer, list(_of_corners(bm, moves, places, layer))) for layer in layers]
    follows = _keys_that_follow(obj)
    for vertex, place in places.items():
        vert = bm.verts[vertex]
        offset = place - vert.co
        for number, (layer, wanted) in enumerate(keys):
            if number != obj.active_shape_key_index:  # that is `vert.co`
                vert[layer] = wanted[vertex] - offset if number in follows else wanted[vertex]
        vert.co = place
    for layer, values in corners:
        for corner, value in values:
            if hasattr(corner[layer], "uv"):
                corner[layer].uv = value
            else:
                corner[layer] = value
    bm.normal_update()
    bmesh.update_edit_mesh(cage.data, loop_triangles=True, destructive=False)


def _mean(values: Sequence[Value], weights: Sequence[float]) -> Value:
    first, *rest = (value * weight for value, weight in zip(values, weights, strict=True))
    for value in rest:
        first = first + value
    return first


def _keys_that_follow(obj: bpy.types.Object) -> set[int]:
    """Return the numbers of the shape keys that Blender moves with the edited one: relative to it, in newer versions also indirectly."""
    keys = obj.data.shape_keys
    if keys is None or not keys.use_relative:
        return set()
    blocks = list(keys.key_blocks)
    edited = blocks[obj.active_shape_key_index]

    def leads_there(block: bpy.types.ShapeKey) -> bool:
        passed = []
        while block not in passed:
            passed.append(block)
            block = block.relative_key
            if block == edited:
                return True
            if IS_OLD:
                break
        return False

    return {number for number, block in enumerate(blocks) if block != edited and leads_there(block)}


def _read(corner: bmesh.types.BMLoop, layer: bmesh.types.BMLayerItem) -> Value:
    value = getattr(corner[layer], "uv", corner[layer])
    return value if isinstance(value, float) else Vector(value)


def _of_corners(
    bm: bmesh.types.BMesh, moves: Mapping[int, Move], places: Mapping[int, Vector], layer: bmesh.types.BMLayerItem
) -> Iterator[tuple[bmesh.types.BMLoop, Value]]:
    """Yield the corners around vertices that move, and what a layer has there.

    If the layer is continuous with the face that a vertex moves into, the value is interpolated there. Beyond a seam of the layer, each
    face's values are extrapolated to that place, and connected values are averaged.
    """
    for vertex, move in moves.items():
        inside = {corner.vert.index: _read(corner, layer) for corner in bm.faces[move.polygon].loops}
        there = _mean([inside[corner] for corner in move.corners], move.weights)
        groups: dict[tuple[float, ...], list[bmesh.types.BMLoop]] = defaultdict(list)
        for corner in bm.verts[vertex].link_loops:
            groups[_rounded(_read(corner, layer))].append(corner)
        for key, group in groups.items():
            value = there
            if key != _rounded(inside[vertex]):
                beyond = [_continued(corner, places[vertex], layer) for corner in group]
                value = _mean(beyond, [1.0 / len(beyond)] * len(beyond))
            for corner in group:
                yield corner, value


def _rounded(value: Value) -> tuple[float, ...]:
    return tuple(round(part, _SAME) for part in ((value,) if isinstance(value, float) else value))


def _continued(corner: bmesh.types.BMLoop, place: Vector, layer: bmesh.types.BMLayerItem) -> Value:
    three = (corner.link_loop_prev, corner, corner.link_loop_next)
    a, b, c = (np.array(one.vert.co) for one in three)
    # The weights whose mean is nearest to the place. Any of them may be negative.
    (s, t), *_ = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), np.array(place) - a, rcond=None)
    return _mean([_read(one, layer) for one in three], (1.0 - s - t, s, t))


def _cut_faces(
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
