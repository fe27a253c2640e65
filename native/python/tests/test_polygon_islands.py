# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands of polygon meshes: their colors, changes, faults, copies and places in a UV map."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import seamwire_core as sw

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
PLAIN, SEAM, JOINED = 1, 2, 3


def unwrap_mesh(
    points: np.ndarray,
    faces: Sequence[Sequence[int]],
    islands: Sequence[int] | None = None,
    seams: Sequence[tuple[int, int]] = (),
    triangles: Sequence[tuple[int, int, int]] | None = None,
) -> tuple[sw.UnwrapMesh, np.ndarray, dict[tuple[int, int], int]]:
    """Return a mesh of faces that are cut into fans, the vertices of its corners, and the numbers of its edges."""
    numbers: dict[tuple[int, int], int] = {}
    edges = []
    for face in faces:
        for one, other in zip(face, [*face[1:], face[0]], strict=True):
            edges.append(numbers.setdefault((min(one, other), max(one, other)), len(numbers)))
    sizes = [len(face) for face in faces]
    starts = np.cumsum([0, *sizes[:-1]])
    if triangles is None:
        triangles = [
            (start, start + i, start + i + 1)
            for start, size in zip(starts, sizes, strict=True)
            for i in range(1, size - 1)
        ]
    marked = {(min(seam), max(seam)) for seam in seams}
    vertices = np.concatenate([np.array(face) for face in faces])
    islands = [0] * len(faces) if islands is None else islands
    mesh = sw.UnwrapMesh(points, vertices, edges, sizes, triangles, islands, [edge in marked for edge in numbers])
    return mesh, vertices, numbers


def grid(columns: int, rows: int = 1) -> tuple[np.ndarray, list[tuple[int, int, int, int]]]:
    """Return the points of a flat grid and its squares."""
    points = np.array([(x, y, 0.0) for y in range(rows + 1) for x in range(columns + 1)])
    first = [y * (columns + 1) + x for y in range(rows) for x in range(columns)]
    return points, [(v, v + 1, v + columns + 2, v + columns + 1) for v in first]


# Changes


@pytest.mark.parametrize("flipped", [False, True])
def test_an_island_has_changed_where_the_map_is_torn_at_either_end_of_an_edge(flipped: bool) -> None:
    points, faces = grid(2)
    faces[1] = faces[1][::-1] if flipped else faces[1]
    mesh, vertices, edges = unwrap_mesh(points, faces)
    uvs = 0.1 * points[vertices, :2]
    unknown = np.zeros(len(edges), dtype=int)
    assert mesh.changes(uvs, unknown)[0].tolist() == [False]
    for vertex in (1, 4):
        moved = uvs.copy()
        moved[4 + faces[1].index(vertex)] += (0.0, 0.01)
        assert mesh.changes(moved, unknown)[0].tolist() == [True]
        assert mesh.changes(moved, np.full(len(edges), PLAIN))[0].tolist() == [False], "it was torn on purpose"
    assert mesh.changes(uvs, np.full(len(edges), JOINED))[0].tolist() == [True]


def test_islands_that_hang_together_in_the_map_have_changed_and_share_a_density() -> None:
    points, faces = grid(3)
    mesh, vertices, edges = unwrap_mesh(points, faces, [0, 1, 2], [(1, 5), (2, 6)])
    uvs = 0.1 * points[vertices, :2]
    uvs[8:] = 0.2 * points[vertices[8:], :2]
    changed, densities = mesh.changes(uvs, np.zeros(len(edges), dtype=int))
    assert changed.tolist() == [True, True, False]
    assert densities == pytest.approx([0.1, 0.1, 0.2])
    memory = np.zeros(len(edges), dtype=int)
    memory[edges[1, 5]] = SEAM
    assert not mesh.changes(uvs, memory)[0].any()


def test_an_island_without_area_has_changed_and_has_no_density() -> None:
    points, faces = grid(2)
    mesh, vertices, edges = unwrap_mesh(points, faces, [0, 1], [(1, 4)])
    uvs = 0.1 * points[vertices, :2]
    uvs[4:] = 0.9
    changed, densities = mesh.changes(uvs, np.zeros(len(edges), dtype=int))
    assert changed.tolist() == [False, True]
    assert densities == pytest.approx([0.1, 0.0])
    uvs[4:] = np.nan
    assert mesh.changes(uvs, np.zeros(len(edges), dtype=int))[0].tolist() == [False, True]


def test_a_folded_island_has_changed_unless_half_of_it_is_folded_on_purpose() -> None:
    points, faces = grid(6)
    mesh, vertices, edges = unwrap_mesh(points, faces)
    for fold, is_intended in ((5, False), (3, True)):
        uvs = 0.1 * points[vertices, :2]
        uvs[:, 0] = np.minimum(uvs[:, 0], 0.2 * fold - uvs[:, 0])
        memory = np.zeros(len(edges), dtype=int)
        assert mesh.changes(uvs, memory)[0].tolist() == [not is_intended]
        memory[edges[1, 8]] = PLAIN
        assert mesh.changes(uvs, memory)[0].tolist() == [True]


def test_a_new_island_has_changed_if_it_overlaps() -> None:
    points, faces = grid(4)
    mesh, vertices, edges = unwrap_mesh(points, faces, [0, 0, 1, 1], [(2, 7)])
    uvs = 0.1 * points[vertices, :2]
    uvs[8:, 0] -= 0.1
    memory = np.zeros(len(edges), dtype=int)
    assert not mesh.changes(uvs, memory)[0].any(), "no island is known"
    memory[edges[1, 6]], memory[edges[2, 7]] = PLAIN, SEAM
    assert mesh.changes(uvs, memory)[0].tolist() == [False, True]


def test_hidden_polygons_without_a_place_are_counted() -> None:
    points, faces = grid(3)
    mesh, vertices, _ = unwrap_mesh(points, faces, [0, -1, -1])
    uvs = 0.1 * points[vertices, :2]
    assert mesh.count_unmapped(uvs) == 0
    uvs[8:] = 0.0
    assert mesh.count_unmapped(uvs) == 1


# Maps


def test_some_islands_are_flattened() -> None:
    points, faces = grid(4)
    mesh, vertices, _ = unwrap_mesh(points, faces, [0, 0, 1, -1], [(2, 7)])
    corners, uvs, parts, straight = mesh.flatten([0], straighten=0.05, up=(0, 1, 0))
    assert corners.tolist() == list(range(8))
    assert set(parts.tolist()) == {0}
    assert straight.tolist() == [True, False]
    lengths = np.linalg.norm(uvs[:, None] - uvs, axis=2)
    places = points[vertices[:8]]
    assert lengths == pytest.approx(np.linalg.norm(places[:, None] - places, axis=2), abs=1e-6)
    with pytest.raises(ValueError, match="islands: number 2"):
        mesh.flatten([2])


def test_vertices_on_straight_sides_are_put_on_the_line_between_their_neighbors() -> None:
    points = np.array(
        [(0, 0, 0), (1, 0, 0), (3, 0, 0), (4, 0, 0), (4, 2, 1), (0, 2, 1), (4, -2, 1), (0, -2, 1)], dtype=float
    )
    faces = [(0, 1, 2, 3, 4, 5), (3, 2, 1, 0, 7, 6)]
    for seams, count in ((), 1), ([(0, 1), (1, 2), (2, 3)], 2), ([(0, 1)], 1):
        mesh, _, _ = unwrap_mesh(points, faces, seams=seams)
        corners, uvs, parts, _ = mesh.flatten([0])
        assert corners.tolist() == list(range(12))
        assert len(set(parts.tolist())) == count
        for begin, shares in ((0, (0.25, 0.75)), (6, (0.25, 0.75))):
            for i, share in enumerate(shares, start=begin + 1):
                assert uvs[i] == pytest.approx(uvs[begin] + share * (uvs[begin + 3] - uvs[begin]))
        # Triangles without area in the map do not count if they have none on the model.
        assert sw.map_faults([(mesh, [0], 0.1 * uvs + 0.5, None)])[0] == 0
        bent = 0.1 * uvs + 0.5
        bent[[1, 2]] = 0.2 * bent[[0, 3]] + 0.8 * bent[[4, 4]]
        assert sw.map_faults([(mesh, [0], bent, None)])[0] == 1


def cap(height: float, mirrored: bool = False) -> tuple[sw.UnwrapMesh, np.ndarray]:
    """Return a triangle on a side of another one, and a map where it is thinner than float32 can hold."""
    mesh, vertices, _ = unwrap_mesh(np.array([(0, 0, 0), (2, 0, 0), (1, 2, 0), (1, -1, 0)]), [(0, 1, 2), (1, 0, 3)])
    uvs = np.array([(0.7, 0.7), (0.9, 0.7), (0.8, 0.9), (0.8, 0.7 - height)])
    uvs[:, 0] = 1.0 - uvs[:, 0] if mirrored else uvs[:, 0]
    return mesh, uvs[vertices].astype(np.float32)


def signed_areas(uvs: np.ndarray) -> np.ndarray:
    a, b, c = uvs.reshape(-1, 3, 2).astype(np.float64).swapaxes(0, 1)
    one, two = b - a, c - a
    return one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]


@pytest.mark.parametrize("height", [0.0, -6e-8, -5e-7])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_triangle_that_rounding_turned_over_is_turned_back(height: float, mirrored: bool) -> None:
    mesh, uvs = cap(height, mirrored)
    side = -1.0 if mirrored else 1.0
    assert (side * signed_areas(uvs)).min() <= 0.0
    corners, places = mesh.turn_back(uvs, [0])
    assert len(corners) in (1, 2)
    assert np.abs(places - uvs[corners]).max() < 2e-6
    assert np.array_equal(places, places.astype(np.float32))
    uvs[corners] = places
    assert (side * signed_areas(uvs)).min() > 0.0


def test_what_was_turned_over_by_more_than_rounding_and_other_islands_stay() -> None:
    mesh, uvs = cap(-0.05)
    assert len(mesh.turn_back(uvs, [0])[0]) == 0
    mesh, uvs = cap(0.0)
    assert len(mesh.turn_back(uvs, [])[0]) == 0


def test_corners_at_one_place_move_together_and_only_within_their_island() -> None:
    flat = np.array([(0.7, 0.7), (0.9, 0.7), (0.8, 0.9), (0.8, 0.7), (0.7, 0.5), (0.9, 0.5)], dtype=np.float32)
    faces = [(0, 1, 2), (1, 0, 3), (3, 0, 4), (3, 4, 5), (1, 3, 5)]
    for islands in ([0, 0, 0, 0, 0], [0, 0, 1, 1, 1]):
        mesh, vertices, _ = unwrap_mesh(np.pad(flat, ((0, 0), (0, 1))), faces, islands)
        uvs = flat[vertices]
        corners, places = mesh.turn_back(uvs, sorted(set(islands)))
        assert len(corners) > 1 or islands[-1]
        assert len(set(vertices[corners].tolist())) == 1
        assert (places == places[0]).all()
        assert set(corners.tolist()) <= set(range(6 if islands[-1] else 15)), "the other island stays"
        uvs[corners] = places
        assert signed_areas(uvs).min() > 0.0


# Faults


def squares(*corners: tuple[float, float], unit: float = 1.0) -> tuple[sw.UnwrapMesh, np.ndarray]:
    """Return squares, each an island of two triangles, and a map with their low corners at some places."""
    flat = np.pad(unit * SQUARE, ((0, 0), (0, 1)))
    points = np.concatenate([flat + unit * np.array([2.0 * i, 0.0, 0.0]) for i in range(len(corners))])
    faces = [tuple(range(4 * i, 4 * i + 4)) for i in range(len(corners))]
    mesh, _, _ = unwrap_mesh(points, faces, list(range(len(corners))))
    return mesh, np.concatenate([0.2 * SQUARE + corner for corner in corners]).astype(np.float32)


def faults(
    *corners: tuple[float, float],
    chosen: Sequence[int] = (0, 1, 2),
    uvs: np.ndarray | None = None,
    before: np.ndarray | None = None,
    may_stack: bool = False,
) -> tuple[int, int, int]:
    """Return the faults of some of these squares, or of another map of them."""
    mesh, own = squares(*corners)
    numbers = [number for number in chosen if number < len(corners)]
    return sw.map_faults([(mesh, numbers, own if uvs is None else uvs, before)], may_stack=may_stack)


def test_islands_that_keep_apart_have_no_faults() -> None:
    assert faults((0.0, 0.0), (0.2, 0.0), (0.5, 0.5)) == (0, 0, 0), "two of them touch"


def test_islands_that_overlap_count_if_they_are_looked_at() -> None:
    places = (0.0, 0.0), (0.1, 0.1), (0.5, 0.5)
    assert faults(*places) == (0, 2, 0)
    assert faults(*places, chosen=[0]) == (0, 1, 0)
    assert faults(*places, chosen=[2]) == (0, 0, 0)


def test_a_face_that_doubles_another_one_is_measured_too() -> None:
    points = np.pad(SQUARE, ((0, 0), (0, 1)))
    mesh, _, _ = unwrap_mesh(points, [(0, 1, 2, 3), (0, 1, 2, 3)], [0, 1])
    for second, found in (0.3, (0, 0, 0)), (0.0, (0, 2, 0)):
        uvs = np.concatenate([0.2 * SQUARE, 0.2 * SQUARE + (second, 0.0)])
        assert sw.map_faults([(mesh, [0, 1], uvs, None)]) == found


def test_only_islands_that_lie_exactly_on_each_other_may_stack() -> None:
    stacked = (0.1, 0.1), (0.1, 0.1)
    assert faults(*stacked, (0.5, 0.5)) == (0, 2, 0)
    assert faults(*stacked, (0.5, 0.5), may_stack=True) == (0, 0, 0)
    assert faults((0.1, 0.1), (0.101, 0.1), (0.5, 0.5), may_stack=True) == (0, 2, 0)
    assert faults(*stacked, (0.2, 0.2), may_stack=True) == (0, 3, 0)
    assert faults(*stacked, (0.2, 0.2), chosen=[1], may_stack=True) == (0, 1, 0)


def test_a_face_that_is_turned_over_in_a_stack_counts() -> None:
    uvs = squares((0.1, 0.1), (0.1, 0.1))[1]
    uvs[[3, 7]] = uvs[1] + (0.1, -0.1)
    assert faults((0.1, 0.1), (0.1, 0.1), uvs=uvs, may_stack=True)[0] == 2


def test_an_island_may_lie_in_the_uv_square_or_where_it_was() -> None:
    places = (0.0, 0.0), (1.1, 0.5), (1.9, 0.5)
    assert faults(*places) == (0, 0, 2)
    assert faults(*places, before=squares(*[(1.3, 0.3)] * 3)[1]) == (0, 0, 1)


def test_faces_that_are_turned_over_or_have_no_number_count_once() -> None:
    uvs = squares((0.2, 0.2), (0.7, 0.7))[1]
    uvs[3] = uvs[1] + (0.1, -0.1)
    assert faults((0.2, 0.2), (0.7, 0.7), uvs=uvs) == (1, 1, 0)
    uvs[:4] = np.nan
    assert faults((0.2, 0.2), (0.7, 0.7), uvs=uvs) == (1, 0, 0)
    uvs[:] = np.nan
    assert faults((0.2, 0.2), (0.7, 0.7), uvs=uvs) == (2, 0, 0)


def test_a_face_whose_corners_lie_in_one_place_is_never_turned_over() -> None:
    points = np.pad(np.concatenate([SQUARE, np.full((4, 2), 3.0)]), ((0, 0), (0, 1)))
    mesh, _, _ = unwrap_mesh(points, [(0, 1, 2, 3), (4, 5, 6, 7)], [0, 1])
    uvs = squares((0.2, 0.2), (0.7, 0.7))[1]
    for place in uvs[4], uvs[4] + (0.0, 0.1), uvs[4] - (0.1, 0.0):
        uvs[4:] = uvs[4]
        uvs[5] = place
        assert sw.map_faults([(mesh, [0, 1], uvs, None)]) == (0, 0, 0)
    uvs[5] = np.nan
    assert sw.map_faults([(mesh, [0, 1], uvs, None)]) == (1, 0, 0), "it has no map at all"


def test_a_mirrored_island_is_good() -> None:
    uvs = squares((0.0, 0.0), (0.5, 0.5))[1]
    uvs[:4, 0] = 0.2 - uvs[:4, 0]
    assert faults((0.0, 0.0), (0.5, 0.5), uvs=uvs) == (0, 0, 0)


def test_maps_of_several_meshes_of_any_size_share_the_square() -> None:
    large, uvs = squares((0.0, 0.0), (0.5, 0.5), unit=1e6)
    for place, found, alone in ((0.6, 0.6), (0, 2, 0), (0, 1, 0)), ((0.8, 0.0), (0, 0, 0), (0, 0, 0)):
        small, own = squares(place, unit=1e-6)
        assert sw.map_faults([(large, [0, 1], uvs, None), (small, [0], own, None)]) == found
        assert sw.map_faults([(large, [], uvs, None), (small, [0], own, None)]) == alone
    with pytest.raises(ValueError, match="maps: expected a sequence of"):
        sw.map_faults([(large, [0])])


# Copies: a bent strip of three quads and a triangle, without any symmetry.
POINTS = np.array(
    [(0, 0, 0), (1, 0, 0), (2.2, 0, 0), (3, 0, 1), (0, 1, 0.2), (1, 1, 0), (2, 1, 0), (3, 1.3, 1), (0.4, 2, 0)],
    dtype=float,
)
FACES = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 8)]
Pieces = list[tuple[np.ndarray, list[tuple[int, ...]]]]


def copies(pieces: Pieces) -> tuple[list[int], list[bool]]:
    """Return the first piece of the shape of each, and whether their corners have the same vertices."""
    faces, islands, base = [], [], 0
    for number, (points, own) in enumerate(pieces):
        faces += [tuple(base + vertex for vertex in face) for face in own]
        islands += [number] * len(own)
        base += len(points)
    mesh, vertices, _ = unwrap_mesh(np.concatenate([points for points, _ in pieces]), faces, islands)
    firsts, match = list(range(len(pieces))), [True] * len(pieces)
    owners = np.repeat(islands, [len(face) for face in faces])
    for one, island, corners, other, below in sw.island_copies([(mesh, np.arange(len(pieces)))]):
        assert one == other == 0
        assert (owners[corners] == island).all()
        firsts[island] = int(owners[below[0]])
        starts = np.cumsum([0, *(len(points) for points, _ in pieces)])
        match[island] = np.array_equal(vertices[corners] - starts[island], vertices[below] - starts[firsts[island]])
    return firsts, match


def rotated(points: np.ndarray, dice: np.random.Generator) -> np.ndarray:
    turn, _ = np.linalg.qr(dice.normal(size=(3, 3)))
    return points @ (turn * np.sign(np.linalg.det(turn))) + 5.0 * dice.normal(size=3)


def shuffled(faces: list[tuple[int, ...]], dice: np.random.Generator) -> list[tuple[int, ...]]:
    """Return the same faces in another order, each with another first corner."""
    return [tuple(np.roll(faces[number], dice.integers(4)).tolist()) for number in dice.permutation(len(faces))]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_moved_or_mirrored_copy_corresponds_corner_by_corner_in_any_order_of_faces(seed: int, mirrored: bool) -> None:
    dice = np.random.default_rng(seed)
    faces = [face[::-1] if mirrored else face for face in shuffled(FACES, dice)]
    copy = rotated(POINTS * (-1.0 if mirrored else 1.0, 1.0, 1.0), dice)
    assert copies([(POINTS, FACES), (copy, faces)]) == ([0, 0], [True, True])


def test_islands_of_another_shape_are_no_copies() -> None:
    moved = POINTS.copy()
    moved[8] += (0.01, 0.0, 0.0)
    other_diagonal = POINTS.copy()
    other_diagonal[[0, 1, 4, 5], 2] += (0.3, 0.0, 0.0, 0.3)
    assert copies([(POINTS, FACES), (moved, FACES), (other_diagonal, FACES), (1.01 * POINTS, FACES)])[0] == [0, 1, 2, 3]
    assert copies([(POINTS, FACES), (POINTS, [*FACES[:3], (0, 4, 8)])])[0] == [0, 1]


def test_symmetric_islands_are_copies_and_each_finds_the_first_of_its_shape() -> None:
    square = np.pad(SQUARE, ((0, 0), (0, 1)))
    assert copies([(size * square, [(0, 1, 2, 3)]) for size in (1.0, 2.0, 1.0, 2.0, 1.0)])[0] == [0, 1, 0, 1, 0]


def test_copies_are_found_among_several_meshes() -> None:
    meshes = [unwrap_mesh(POINTS, FACES)[0] for _ in range(3)]
    found = sw.island_copies([(meshes[0], [0]), (meshes[1], []), (meshes[2], [0])])
    assert [(mesh, island, first) for mesh, island, _, first, _ in found] == [(2, 0, 0)]
    with pytest.raises(ValueError, match="islands: expected a sequence of"):
        sw.island_copies([meshes[0]])


# Hues

RAINBOW = (4 + 5 * np.arange(12)) % 12


def strips(pairs: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return triangles, their islands and cuts, such that pairs of islands meet at cuts."""
    numbers = np.arange(len(pairs))[:, None]
    both = np.concatenate([4 * numbers + (0, 1, 2), 4 * numbers + (1, 0, 3)])
    alone = 4 * len(pairs) + np.arange(3 * count).reshape(-1, 3)
    islands = np.concatenate([pairs[:, 0], pairs[:, 1], np.arange(count)])
    return np.concatenate([both, alone]), islands, 4 * numbers + (0, 1)


def hues(count: int, pairs: np.ndarray, old: Sequence[int] | None = None) -> np.ndarray:
    """Return the hues of islands, (count,), of which pairs, (k, 2), are neighbors. They may have had other hues."""
    triangles, islands, cuts = strips(pairs, count)
    return sw.island_hues(triangles, islands, cuts, *(() if old is None else (islands, old)))


def gaps(found: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    return np.abs(RAINBOW[found[pairs[:, 0]]] - RAINBOW[found[pairs[:, 1]]])


def honeycomb(size: int) -> np.ndarray:
    """Return the pairs of neighbors among size x size cells, up to six each: as islands most often meet, by threes."""
    numbers = np.arange(size * size).reshape(size, size)
    ways = (numbers[:, :-1], numbers[:, 1:]), (numbers[:-1], numbers[1:]), (numbers[:-1, 1:], numbers[1:, :-1])
    return np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in ways])


@pytest.mark.parametrize("size", [2, 5, 20, 60])
def test_neighbors_have_hues_that_are_far_apart(size: int) -> None:
    pairs = np.random.default_rng(size).permutation(size * size)[honeycomb(size)]
    assert gaps(hues(size * size, pairs), pairs).min() >= 3


@pytest.mark.parametrize("count", [7, 60])
def test_neighbors_have_different_hues_however_many_there_are(count: int) -> None:
    pairs = np.random.default_rng(count).integers(0, count, (2 * count, 2))
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    assert gaps(hues(count, pairs), pairs).min() >= 2


def test_more_neighbors_than_hues_are_no_error() -> None:
    pairs = np.array([(i, j) for i in range(20) for j in range(i + 1, 20)])
    assert hues(20, pairs).max() < 12


def test_few_islands_have_each_a_hue_of_their_own() -> None:
    assert len(set(hues(12, np.empty((0, 2), dtype=int)).tolist())) == 12
    assert len(set(hues(3, np.array([(0, 0)])).tolist())) == 3, "a cut inside an island"


def test_of_neighbors_with_hues_too_much_alike_the_larger_keeps_its_own() -> None:
    close = np.flatnonzero(np.abs(RAINBOW - RAINBOW[0]) == 1)[0]
    pairs = np.array([[0, 1], [1, 2]])
    found = hues(3, pairs, [0, close, 7])
    assert found[[0, 2]].tolist() == [0, 7]
    assert gaps(found, pairs).min() >= 3


def test_wrong_hues_are_refused() -> None:
    with pytest.raises(ValueError, match="former_hues"):
        hues(1, np.empty((0, 2), dtype=int), [12])
    with pytest.raises(ValueError, match="islands has 1 items"):
        sw.island_hues([(0, 1, 2), (2, 1, 3)], [0], [])


# Places


def test_new_islands_are_placed_beside_what_stays() -> None:
    before = np.concatenate([0.25 * SQUARE + (0.5, 0.25), 0.25 * SQUARE + (0.5, 0.25)])
    after = np.concatenate([3.0 * SQUARE, SQUARE])
    triangles = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)]
    islands = [0, 0, 2, 2]
    placements = sw.place_islands(
        before, after, triangles, islands, [0.0625, 0.0, 0.0625], taken=[(0, 0, 0.1, 1)], straight=[True, False, False]
    )
    assert placements.shape == (3, 2, 3)
    assert (placements[1] == 0.0).all()
    first = after[:4] @ placements[0, :, :2].T + placements[0, :, 2]
    second = after[4:] @ placements[2, :, :2].T + placements[2, :, 2]
    assert np.ptp(first, axis=0) == pytest.approx(0.25)
    assert first == pytest.approx(before[:4], abs=2.0 / 512)
    assert (second.min(axis=0) > first.max(axis=0)).any() or (second.max(axis=0) < first.min(axis=0)).any()


def test_a_new_island_without_a_finite_place_is_refused() -> None:
    with pytest.raises(ValueError, match="corner 2 has no finite UV"):
        sw.place_islands(SQUARE[:3], [(0, 0), (1, 0), (1, np.nan)], [(0, 1, 2)], [0], [1.0])
    with pytest.raises(ValueError, match="straight: expected booleans"):
        sw.place_islands(SQUARE[:3], SQUARE[:3], [(0, 1, 2)], [0], [1.0], straight=[1])
