# SPDX-License-Identifier: GPL-3.0-or-later
"""Which islands are copies of each other, and which corners correspond."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.islands.copies import ShapedIsland, find_copies, shaped_islands

# A bent strip of three quads and a triangle, without any symmetry.
POINTS = np.array(
    [(0, 0, 0), (1, 0, 0), (2.2, 0, 0), (3, 0, 1), (0, 1, 0.2), (1, 1, 0), (2, 1, 0), (3, 1.3, 1), (0.4, 2, 0)],
    dtype=float,
)
FACES = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 8)]


def shaped(pieces: list[tuple[NDArray[np.float64], list[tuple[int, ...]]]]) -> tuple[list[ShapedIsland], np.ndarray]:
    """Return the islands of separate pieces, and the vertex of each corner, numbered within its piece."""
    vertices, own, edges, following, labels = [], [], [], [], []
    numbers: dict[tuple[int, int], int] = {}
    base = 0
    for label, (points, faces) in enumerate(pieces):
        for face in faces:
            first = len(vertices)
            for i, vertex in enumerate(face):
                after = face[(i + 1) % len(face)]
                pair = (base + min(vertex, after), base + max(vertex, after))
                edges.append(numbers.setdefault(pair, len(numbers)))
                vertices.append(base + vertex)
                own.append(vertex)
                following.append(first + (i + 1) % len(face))
                labels.append(label)
        base += len(points)
    columns = (np.array(each) for each in (vertices, edges, following, labels))
    return shaped_islands(np.concatenate([points for points, _ in pieces]), *columns), np.array(own)


def rotated(points: NDArray[np.float64], dice: np.random.Generator) -> NDArray[np.float64]:
    turn, _ = np.linalg.qr(dice.normal(size=(3, 3)))
    return points @ (turn * np.sign(np.linalg.det(turn))) + 5.0 * dice.normal(size=3)


def shuffled(faces: list[tuple[int, ...]], dice: np.random.Generator) -> list[tuple[int, ...]]:
    """Return the same faces in another order, each with another first corner."""
    return [tuple(np.roll(faces[number], dice.integers(4)).tolist()) for number in dice.permutation(len(faces))]


def vertices_match(islands: list[ShapedIsland], own: np.ndarray, number: int) -> bool:
    """Whether an island is a copy of the first one, with the same vertex at each corner."""
    first, corners = find_copies([island.shape for island in islands])[number]
    return first == 0 and np.array_equal(own[islands[0].corners[corners]], own[islands[number].corners])


@pytest.mark.parametrize("seed", range(5))
def test_a_moved_copy_corresponds_corner_by_corner_in_any_order_of_faces(seed: int) -> None:
    dice = np.random.default_rng(seed)
    islands, own = shaped([(POINTS, FACES), (rotated(POINTS, dice), shuffled(FACES, dice))])
    assert vertices_match(islands, own, 1)


@pytest.mark.parametrize("seed", range(5))
def test_a_mirrored_copy_corresponds_too(seed: int) -> None:
    dice = np.random.default_rng(seed)
    faces = [face[::-1] for face in shuffled(FACES, dice)]
    islands, own = shaped([(POINTS, FACES), (rotated(POINTS * (-1.0, 1.0, 1.0), dice), faces)])
    assert vertices_match(islands, own, 1)


def test_islands_of_another_shape_are_no_copies() -> None:
    moved = POINTS.copy()
    moved[8] += (0.01, 0.0, 0.0)
    other_diagonal = POINTS.copy()
    other_diagonal[[0, 1, 4, 5], 2] += (0.3, 0.0, 0.0, 0.3)
    islands, _ = shaped([(POINTS, FACES), (moved, FACES), (other_diagonal, FACES), (1.01 * POINTS, FACES)])
    assert [first for first, _ in find_copies([island.shape for island in islands])] == [0, 1, 2, 3]
    islands, _ = shaped([(POINTS, FACES), (POINTS, [*FACES[:3], (0, 4, 8)])])
    assert [first for first, _ in find_copies([island.shape for island in islands])] == [0, 1]


def test_symmetric_islands_are_copies_and_each_finds_the_first_of_its_shape() -> None:
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    pieces = [(size * square, [(0, 1, 2, 3)]) for size in (1.0, 2.0, 1.0, 2.0, 1.0)]
    islands, _ = shaped(pieces)
    found = find_copies([island.shape for island in islands])
    assert [first for first, _ in found] == [0, 1, 0, 1, 0]
    assert all(sorted(corners.tolist()) == [0, 1, 2, 3] for _, corners in found)
