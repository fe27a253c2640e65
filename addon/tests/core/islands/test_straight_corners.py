# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices in the middle of straight sides of faces."""

import numpy as np
from seamwire.core.islands.straight_corners import StraightCorners, find_straight
from seamwire.core.islands.uv_islands import Corners

POINTS = np.array(
    [(0, 0, 0), (1, 0, 0), (3, 0, 0), (4, 0, 0), (4, 2, 0), (0, 2, 0), (4, -2, 0), (0, -2, 0)], dtype=float
)
ABOVE, BELOW = (0, 1, 2, 3, 4, 5), (3, 2, 1, 0, 7, 6)
"""Two faces with the vertices 1 and 2 on their common side."""


def ring_of(*faces: tuple[int, ...]) -> Corners:
    sizes = [len(face) for face in faces]
    following = np.concatenate(
        [start + np.roll(np.arange(size), -1) for start, size in zip(np.cumsum([0, *sizes]), sizes, strict=False)]
    )
    vertices, owners = np.concatenate(faces).astype(np.int32), np.repeat(np.arange(len(faces)), sizes).astype(np.int64)
    return Corners(vertices, np.zeros_like(vertices), owners, following)


def found(
    ring: Corners, triangles: list[tuple[int, int, int]], seams: tuple[int, ...] = (), points: np.ndarray = POINTS
) -> StraightCorners:
    """`triangles` and `seams` are corners."""
    is_seam = np.isin(np.arange(len(ring.vertices)), seams)
    return find_straight(points, ring, is_seam, np.array(triangles, dtype=np.int64))


# Corners 0 to 5 are those of the face above, 6 to 11 those of the face below.
EARS = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (6, 7, 8), (6, 8, 9), (6, 9, 10), (6, 10, 11)]


def test_vertices_between_two_faces_fall_on_the_nearer_end_in_both() -> None:
    ring = ring_of(ABOVE, BELOW)
    straight = found(ring, EARS)
    onto = dict(zip(straight.corners.tolist(), straight.onto.tolist(), strict=True))
    assert onto == {1: 0, 2: 3, 7: 6, 8: 9}
    assert straight.vanish(np.array(EARS)).tolist() == [True, True, False, False] * 2
    in_map = straight.to_map(POINTS, ring, np.array(EARS))
    assert in_map.tolist() == [[0, 3, 4], [0, 4, 5], [6, 9, 10], [6, 10, 11]]


def test_left_out_corners_are_placed_on_the_line_between_the_ends() -> None:
    straight = found(ring_of(ABOVE, BELOW), EARS)
    uvs = np.zeros((12, 2))
    uvs[[0, 3, 6, 9]] = (0, 0), (8, 4), (8, 4), (0, 0)
    straight.place(uvs)
    assert uvs[[1, 2, 7, 8]].tolist() == [[2, 1], [6, 3], [6, 3], [2, 1]]


def test_a_side_is_cut_if_all_of_it_is_a_seam() -> None:
    ring = ring_of(ABOVE, BELOW)
    for seams, edges, left in (
        ((0, 1, 2, 6, 7, 8), [(0, 1), (1, 2), (2, 3), (3, 4)], [[0, 3], [3, 4]]),
        ((0, 8), [(0, 1), (3, 4)], [[3, 4]]),
        ((1, 7), [(1, 2), (3, 4)], [[3, 4]]),
    ):
        straight = found(ring, EARS, seams)
        assert straight.seams_in_map(ring.vertices, np.array(edges, dtype=np.int32)).tolist() == left


def test_corners_and_bent_vertices_and_those_of_other_edges_stay() -> None:
    bent = POINTS.copy()
    bent[[1, 2], 1] = 0.1
    assert not len(found(ring_of(ABOVE, BELOW), EARS, points=bent).corners)
    # Three faces meet at vertex 1.
    ring = ring_of(ABOVE, (3, 2, 1, 7, 6), (0, 7, 1))
    triangles = [*EARS[:4], (6, 7, 8), (6, 8, 9), (6, 9, 10), (11, 12, 13)]
    assert set(ring.vertices[found(ring, triangles).corners].tolist()) == {2}


def test_a_face_that_would_lose_all_triangles_keeps_its_corners() -> None:
    ring = ring_of((0, 1, 3), (3, 1, 0, 7, 6))
    assert not len(found(ring, [(0, 1, 2), (3, 4, 5), (3, 5, 6), (3, 6, 7)]).corners)


def test_a_straight_corner_gets_the_triangle_with_its_neighbors() -> None:
    ring = ring_of((0, 1, 3, 4))
    in_map = found(ring, [(0, 1, 3), (1, 2, 3)]).to_map(POINTS, ring, np.array([(0, 1, 3), (1, 2, 3)]))
    assert sorted(map(sorted, in_map.tolist())) == [[0, 1, 2], [0, 2, 3]]
    places = POINTS[ring.vertices[in_map]]
    assert (np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])[:, 2] >= 0.0).all()


def test_a_mesh_without_straight_corners_keeps_its_triangles() -> None:
    ring = ring_of((0, 3, 4, 5))
    triangles = np.array([(0, 1, 2), (0, 2, 3)])
    straight = found(ring, triangles.tolist())
    assert straight.to_map(POINTS, ring, triangles).tolist() == triangles.tolist()
    assert not straight.vanish(triangles).any()
