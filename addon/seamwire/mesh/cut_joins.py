# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of an edit mesh joined again where cuts parted them.

Corners that stay keep their values exactly, in all layers. Nothing is interpolated.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bmesh
from mathutils import Vector
from mathutils.geometry import intersect_line_line_2d

from .edit_mesh import LABELS
from .unwrap import JOINED, UNWRAPPED

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

CUT_VERTS = ".seamwire_cut_vertex"
"""The layer of vertices that is 1 where a cut made them."""

CUT_EDGES = ".seamwire_cut_edge"
"""The layer of edges that is not 0 where a cut made them: those can be taken back. `_HOLDS` is one value, 1 all others.

The layer of vertices has another name, because Blender 5 loses one of two layers with the same name on undo and when it saves."""

_HOLDS = 2
"""The value of an edge that holds the end of a seam inside a face, where the cut that led on from there was taken back."""


def cut_layers(bm: bmesh.types.BMesh) -> tuple[bmesh.types.BMLayerItem, bmesh.types.BMLayerItem]:
    """Return the layers of vertices and of edges that tell what cuts made."""
    named = ((bm.verts.layers.int, CUT_VERTS), (bm.edges.layers.int, CUT_EDGES))
    of_verts, of_edges = (layers.get(name) or layers.new(name) for layers, name in named)
    for items in (bm.verts, bm.edges, bm.faces):
        items.ensure_lookup_table()
    return of_verts, of_edges


def mark_seams(bm: bmesh.types.BMesh, edges: Iterable[bmesh.types.BMEdge]) -> None:
    """Make seams of edges, which hold no ends of other seams then."""
    of_edges = bm.edges.layers.int[CUT_EDGES]
    for edge in edges:
        edge.seam = True
        edge[of_edges] = min(edge[of_edges], 1)


def holding(bm: bmesh.types.BMesh, verts: Iterable[bmesh.types.BMVert]) -> list[bmesh.types.BMEdge]:
    """Return the edges that hold ends of seams, from some vertices on."""
    of_edges = bm.edges.layers.int[CUT_EDGES]
    found: dict[bmesh.types.BMEdge, None] = {}
    waiting = list(verts)
    while waiting:
        vert = waiting.pop()
        new = [edge for edge in vert.link_edges if edge[of_edges] == _HOLDS and edge not in found]
        found.update(dict.fromkeys(new))
        waiting += [edge.other_vert(vert) for edge in new]
    return list(found)


def is_left_behind(bm: bmesh.types.BMesh, edge: bmesh.types.BMEdge) -> bool:
    """Whether a cut made an edge without a seam, or a vertex on the edge that only joins two edges without wires."""
    of_verts, of_edges = bm.verts.layers.int.get(CUT_VERTS), bm.edges.layers.int.get(CUT_EDGES)
    if of_verts is None or of_edges is None:
        return False
    return (bool(edge[of_edges]) and not edge.seam) or any(
        vert[of_verts] and _can_merge(bm, vert.link_edges) for vert in edge.verts
    )


def join(
    bm: bmesh.types.BMesh, edges: Collection[bmesh.types.BMEdge], kept: Collection[bmesh.types.BMVert] = ()
) -> int:
    """Join what cuts along some edges parted, and return how many of these edges went.

    Only edges that cuts made are removed. Seams and edges on hidden faces stay. A vertex that a cut made on an edge is removed if only
    that edge is left there, no wire uses it, and it is not among those `kept`.

    Edges cannot end inside faces. Where another seam would, the cut that leads on from its end cannot go: it holds the end, or an edge
    to a corner of the face does in its place.
    """
    of_verts, of_edges = bm.verts.layers.int[CUT_VERTS], bm.edges.layers.int[CUT_EDGES]
    unwrapped = bm.edges.layers.int.get(UNWRAPPED)
    cuts = [
        edge
        for edge in dict.fromkeys(edges)
        if edge[of_edges]
        and not edge.seam
        and len(edge.link_faces) == 2
        and not any(face.hide for face in edge.link_faces)
    ]
    verts = {vert for edge in edges for vert in edge.verts if vert[of_verts]}
    if unwrapped is not None:
        for face in {face for edge in cuts for face in edge.link_faces}:
            within = [edge for edge in face.edges if not edge.seam]
            for edge in within or face.edges:
                edge[unwrapped] = JOINED
    left = _without_joinable(cuts)
    for edge in left:
        edge[of_edges] = _HOLDS
    for vert in verts:
        if vert.is_valid and (end := _end_held_from(bm, vert)) and _hold_at_corner(bm, *end):
            left = _without_joinable(left)
    for vert in verts:
        if vert.is_valid and vert not in kept:
            _dissolve(bm, vert)
    return sum(not edge.is_valid for edge in cuts)


def _without_joinable(cuts: Iterable[bmesh.types.BMEdge]) -> list[bmesh.types.BMEdge]:
    """Join the faces on both sides of cuts where that removes nothing but cuts among these, and return the cuts that are left."""
    left = [edge for edge in cuts if edge.is_valid]
    while True:
        count, among = len(left), set(left)
        for edge in left:
            if edge.is_valid and among.issuperset(common := _common_edges(edge)) and _is_one_chain(edge, common):
                selected = all(face.select for face in edge.link_faces)
                face = bmesh.utils.face_join(list(edge.link_faces))
                if face is not None:
                    face.select = selected
        left = [edge for edge in left if edge.is_valid]
        if len(left) == count:
            return left


def _common_edges(edge: bmesh.types.BMEdge) -> list[bmesh.types.BMEdge]:
    """Return the edges that the two faces beside an edge share: Blender joins the faces over all of them."""
    one, other = edge.link_faces
    return [shared for shared in one.edges if other in shared.link_faces]


def _is_one_chain(edge: bmesh.types.BMEdge, common: Collection[bmesh.types.BMEdge]) -> bool:
    """Whether the two faces beside an edge meet along a single chain of edges only, and become one face without a hole."""
    one, other = edge.link_faces
    return len({*one.verts}.intersection(other.verts)) == len(common) + 1


def _end_held_from(
    bm: bmesh.types.BMesh, rim: bmesh.types.BMVert
) -> tuple[bmesh.types.BMVert, bmesh.types.BMEdge, bmesh.types.BMEdge] | None:
    """Return the end of a seam inside a face that is held from a vertex on the rim, the edge that holds it, and the last edge of the seam.

    The result is None if nothing is held from the vertex, or the vertex must stay.
    """
    of_verts, of_edges = bm.verts.layers.int[CUT_VERTS], bm.edges.layers.int[CUT_EDGES]
    holds = [edge for edge in rim.link_edges if edge[of_edges] == _HOLDS]
    others = [edge for edge in rim.link_edges if edge not in holds]
    if not rim[of_verts] or len(holds) != 1 or not _can_merge(bm, others):
        return None
    vert, last = holds[0].other_vert(rim), holds[0]
    while len(vert.link_edges) == 2:
        one, two = vert.link_edges
        following = two if one == last else one
        if following[of_edges] != _HOLDS:
            return vert, last, following
        vert, last = following.other_vert(vert), following
    return None


def _can_merge(bm: bmesh.types.BMesh, edges: Collection[bmesh.types.BMEdge]) -> bool:
    """Whether some edges at a vertex are two that can become one edge: no wire runs along them, and they hold nothing."""
    of_edges, labels = bm.edges.layers.int[CUT_EDGES], bm.edges.layers.int.get(LABELS)
    return len(edges) == 2 and not any(edge[of_edges] == _HOLDS or (labels and edge[labels]) for edge in edges)


def _hold_at_corner(
    bm: bmesh.types.BMesh, end: bmesh.types.BMVert, hold: bmesh.types.BMEdge, last: bmesh.types.BMEdge
) -> bool:
    """Hold the end of a seam by a new edge to a corner of the face, and return whether there is such a corner.

    The former edge can go then. Otherwise later cuts would run through the place where it meets the rim of the face, or make slivers
    beside it.
    """
    of_verts, of_edges = bm.verts.layers.int[CUT_VERTS], bm.edges.layers.int[CUT_EDGES]
    back = (last.other_vert(end).co - end.co).normalized()
    ways = [
        (back.dot((vert.co - end.co).normalized()), face, vert)
        for face in hold.link_faces
        for vert in face.verts
        if not vert[of_verts] and bm.edges.get((end, vert)) is None and _sees(face, end, vert)
    ]
    if not ways:
        return False
    _, face, corner = min(ways, key=lambda way: way[0])  # the straightest way on
    part, _ = bmesh.utils.face_split(face, end, corner)
    part.select = face.select
    bm.edges.get((end, corner))[of_edges] = _HOLDS
    return True


def _sees(face: bmesh.types.BMFace, one: bmesh.types.BMVert, other: bmesh.types.BMVert) -> bool:
    """Whether the straight line between two corners of a face that are not neighbors lies inside it."""
    face.normal_update()
    if not face.normal.length_squared:
        return False
    turn = face.normal.rotation_difference(Vector((0.0, 0.0, 1.0)))
    flat = {vert: (turn @ vert.co).xy for vert in face.verts}
    begin, end = flat[one], flat[other]
    middle, is_inside = 0.5 * (begin + end), False
    for edge in face.edges:
        a, b = (flat[vert] for vert in edge.verts)
        if one not in edge.verts and other not in edge.verts and intersect_line_line_2d(begin, end, a, b):
            return False
        if (a.y > middle.y) != (b.y > middle.y) and middle.x < a.x + (middle.y - a.y) * (b.x - a.x) / (b.y - a.y):
            is_inside = not is_inside
    return is_inside


def _dissolve(bm: bmesh.types.BMesh, vert: bmesh.types.BMVert) -> None:
    """Remove a vertex that a cut made on an edge, if only that edge is left there."""
    if not _can_merge(bm, vert.link_edges) or any(len(face.verts) < 4 for face in vert.link_faces):
        return
    one, two = vert.link_edges
    if bm.edges.get((one.other_vert(vert), two.other_vert(vert))) is None:
        bmesh.utils.vert_collapse_edge(vert, one)
