# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices in the middle of a straight side of two faces.

Blender may cut both faces such that the vertex is in a triangle without area, once on either side. No map has both triangles the right
way around. So the vertex is left out of the map, and then put on the straight line between its neighbors.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import relative_heights
from .uv_islands import Corners

if TYPE_CHECKING:
    from numpy.typing import NDArray

_STRAIGHT = 1e-4
"""How far a vertex may lie beside the line between its neighbors, as a part of the line."""
_NEARLY = 1e-2
"""The same, if both faces have only the triangle that it makes with these neighbors. Single precision bends short sides so far."""


@dataclass(frozen=True)
class StraightCorners:
    """Corners of faces that are left out of a map.

    Parameters
    ----------
    corners
        (s,) the corners.
    ends
        (s, 2) the next corners on both sides that stay in the map.
    shares
        (s,) how far along the side from the first end to the second they lie, from 0 to 1.
    onto
        (s,) the end that replaces each.
    is_cut
        (s,) whether all edges of the side between the ends are seams. A seam that ends at a left-out vertex ends before it in the map.
    stays
        Corners between two faces that lie on straight sides, but have triangles with an area.
    """

    corners: NDArray[np.int64]
    ends: NDArray[np.int64]
    shares: NDArray[np.float64]
    onto: NDArray[np.int64]
    is_cut: NDArray[np.bool_]
    stays: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))

    def without(self, triangles: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return triangles, (t, 3) corners, with each left-out corner replaced. Some have a corner twice then: they vanish."""
        if not len(self.corners):
            return triangles
        replaced = np.arange(max(int(triangles.max(initial=-1)), int(self.corners.max())) + 1)
        replaced[self.corners] = self.onto
        return replaced[triangles]

    def to_map(self, points: NDArray[np.float64], ring: Corners, triangles: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the triangles that a map is made of, (t, 3): without the left-out corners, and convex at the other straight ones.

        Where a straight corner has two triangles, it gets the flat one with its neighbors instead. A map that has this triangle the right
        way around has all triangles right that the face may be cut into there.
        """
        triangles = self.without(triangles[~self.vanish(triangles)]).copy()
        following, preceding = ring.following.copy(), ring.preceding
        following[self.ends[:, 0]], preceding[self.ends[:, 1]] = self.ends[:, 1], self.ends[:, 0]
        uses = np.bincount(triangles.reshape(-1), minlength=len(following))
        corners = np.setdiff1d(np.flatnonzero(uses == 2), self.stays)
        places = (points[ring.vertices[each]] for each in (preceding[corners], corners, following[corners]))
        corners = corners[_are_straight(*places, _STRAIGHT)]
        order = np.argsort(triangles.reshape(-1), kind="stable")
        first = np.searchsorted(triangles.reshape(-1)[order], corners)
        for corner, (one, other) in zip(
            corners.tolist(), (order[first[:, None] + np.arange(2)] // 3).tolist(), strict=True
        ):
            before, after = int(preceding[corner]), int(following[corner])
            rest = {*triangles[one].tolist(), *triangles[other].tolist()} - {before, corner, after}
            if uses[corner] != 2 or len(rest) != 1 or corner not in triangles[one] or corner not in triangles[other]:
                continue
            (third,) = rest
            triangles[one], triangles[other] = (before, corner, after), (before, after, third)
            uses[[corner, before, after, third]] += (-1, 1, 1, -1)
        return triangles

    def vanish(self, triangles: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return which triangles have a corner twice without the left-out corners, (t,)."""
        a, b, c = self.without(triangles).T
        return (a == b) | (b == c) | (c == a)

    def edges_in_map(self, vertices: NDArray[np.int32], edges: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return edges, (e, 2) vertices, with each left-out vertex replaced. `vertices`: (c,) the vertex of each corner."""
        replaced = np.arange(int(vertices.max(initial=-1)) + 1, dtype=np.int32)
        replaced = np.append(replaced, np.arange(len(replaced), int(edges.max(initial=-1)) + 1, dtype=np.int32))
        replaced[vertices[self.corners]] = vertices[self.onto]
        edges = replaced[edges]
        return edges[edges[:, 0] != edges[:, 1]]

    def seams_in_map(self, vertices: NDArray[np.int32], seams: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return seams as `edges_in_map` does, without the sides that only a part of is a seam."""
        seams = np.sort(self.edges_in_map(vertices, seams), axis=1)
        partly = {tuple(pair) for pair in np.sort(vertices[self.ends[~self.is_cut]], axis=1).tolist()}
        return seams[[tuple(pair) not in partly for pair in seams.tolist()]] if partly else seams

    def place(self, uvs: NDArray[np.float64]) -> None:
        """Put the left-out corners on their straight lines in a map, (c, 2) for all corners."""
        ends = uvs[self.ends]
        uvs[self.corners] = ends[:, 0] + self.shares[:, None] * (ends[:, 1] - ends[:, 0])


def find_straight(
    points: NDArray[np.float64], ring: Corners, is_seam: NDArray[np.bool_], triangles: NDArray[np.int64]
) -> StraightCorners:
    """Find the corners whose vertex has two edges and two faces, and lies between its neighbors.

    Points are (n, 3). `is_seam`, (c,), tells whether the edge to the next corner is a seam. The visible faces are drawn as triangles, (t,
    3) corners.
    """
    vertices, faces, following, preceding = ring.vertices, ring.faces, ring.following, ring.preceding
    uses = np.bincount(triangles.reshape(-1), minlength=len(vertices))
    used = np.flatnonzero(uses)
    order = used[np.argsort(vertices[used], kind="stable")]
    _, first, counts = np.unique(vertices[order], return_index=True, return_counts=True)
    pairs = order[first[counts == 2][:, None] + np.arange(2)]
    around = vertices[np.stack([preceding[pairs], following[pairs]], axis=2)]  # (k, 2, 2)
    are_ears = (uses[pairs] == 1).all(axis=1)
    found = (np.sort(around[:, 0], axis=1) == np.sort(around[:, 1], axis=1)).all(axis=1)
    found &= faces[pairs[:, 0]] != faces[pairs[:, 1]]
    found &= _are_straight(
        points[around[:, 0, 0]],
        points[vertices[pairs[:, 0]]],
        points[around[:, 0, 1]],
        np.where(are_ears, _NEARLY, _STRAIGHT),
    )
    # Else a triangle with an area keeps the vertex in its place.
    is_flat = relative_heights(points[vertices[triangles]]) <= _STRAIGHT
    flat_uses = np.bincount(triangles[is_flat].reshape(-1), minlength=len(vertices))
    needed = are_ears | (flat_uses[pairs] == uses[pairs]).all(axis=1)
    is_straight = np.zeros(len(vertices), dtype=bool)
    is_straight[pairs[found & needed]] = True
    stays = pairs[found & ~needed].reshape(-1)
    while True:
        straight = replace(_chains(points, ring, is_seam, is_straight), stays=stays)
        gone = np.setdiff1d(faces[triangles[:, 0]], faces[triangles[~straight.vanish(triangles), 0]])
        if not len(gone):
            return straight
        # A face without any triangle would have no place in the map.
        is_straight[np.isin(vertices, vertices[is_straight & np.isin(faces, gone)])] = False


def _are_straight(
    before: NDArray[np.float64],
    places: NDArray[np.float64],
    after: NDArray[np.float64],
    tolerance: NDArray[np.float64] | float,
) -> NDArray[np.bool_]:
    """Return which places, (k, 3), lie on the lines between others, up to a part of their lengths."""
    along = after - before
    beside = np.linalg.norm(np.cross(places - before, along), axis=1)
    is_between = np.einsum("ij,ij->i", places - before, after - places) >= 0.0
    return is_between & (beside <= tolerance * np.einsum("ij,ij->i", along, along))


def _chains(
    points: NDArray[np.float64], ring: Corners, is_seam: NDArray[np.bool_], is_straight: NDArray[np.bool_]
) -> StraightCorners:
    """Find the ends that stay on both sides of the straight corners. Faces with straight corners only keep them."""
    preceding, following = ring.preceding, ring.following
    rows = []
    for begin in np.flatnonzero(is_straight & ~is_straight[preceding]).tolist():
        chain = [begin]
        while is_straight[following[chain[-1]]]:
            chain.append(int(following[chain[-1]]))
        ends = int(preceding[begin]), int(following[chain[-1]])
        is_cut = bool(is_seam[[ends[0], *chain]].all())
        rows += [(corner, *ends, is_cut) for corner in chain]
    table = np.array(rows, dtype=np.int64).reshape(-1, 4)
    place, low, high = (points[ring.vertices[column]] for column in table.T[:3])
    to_low, to_high = np.linalg.norm(place - low, axis=1), np.linalg.norm(high - place, axis=1)
    whole = to_low + to_high
    shares = np.divide(to_low, whole, out=np.full(len(whole), 0.5), where=whole > 0.0)
    # Both faces of a vertex replace it by the same one.
    is_first = (to_low < to_high) | ((to_low == to_high) & (ring.vertices[table[:, 1]] < ring.vertices[table[:, 2]]))
    onto = np.where(is_first, table[:, 1], table[:, 2])
    return StraightCorners(table[:, 0], table[:, 1:3], shares, onto, table[:, 3] > 0)
