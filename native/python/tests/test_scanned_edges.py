# SPDX-License-Identifier: GPL-3.0-or-later
"""Who placed the edges of a mesh."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]
"""(n, 3) vertices and (m, 3) triangles."""


def halved(quads: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return (2 m, 3) the halves of quads, along diagonals that random numbers choose."""
    turns = np.random.default_rng(1).integers(0, 2, len(quads))
    turned = np.where(turns[:, None] == 1, np.roll(quads, 1, axis=1), quads)
    return np.concatenate([turned[:, [0, 1, 2]], turned[:, [0, 2, 3]]]).astype(np.int32)


def sheet(rows: int, columns: int, place: Callable[[NDArray, NDArray], tuple[NDArray, NDArray, NDArray]]) -> Mesh:
    """Return a grid of halved quads, laid where a function of two parameters from 0 to 1 says."""
    down, right = np.meshgrid(np.linspace(0.0, 1.0, rows), np.linspace(0.0, 1.0, columns), indexing="ij")
    numbers = np.arange(rows * columns).reshape(rows, columns)
    quads = np.stack([numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]], axis=-1).reshape(-1, 4)
    return np.stack(place(down, right), axis=-1).reshape(-1, 3), halved(quads)


def cylinder(twist: float = 0.0) -> Mesh:
    """Return a tube along z of square quads, whose edges turn around it by a part of its height where so given."""
    height = np.pi * 0.5

    def place(down: NDArray, right: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        around = 0.5 * np.pi * (right + twist * down)
        return np.cos(around), np.sin(around), height * (down - twist * right)

    return sheet(41, 41, place)


def ball() -> Mesh:
    """Return a ball of rings and segments, as artists start from."""
    return sheet(
        40,
        80,
        lambda down, right: (
            np.sin(np.pi * (0.02 + 0.96 * down)) * np.cos(2.0 * np.pi * right),
            np.sin(np.pi * (0.02 + 0.96 * down)) * np.sin(2.0 * np.pi * right),
            np.cos(np.pi * (0.02 + 0.96 * down)),
        ),
    )


def bumps(x: NDArray, y: NDArray) -> NDArray:
    """Return heights that bend in all directions."""
    random = np.random.default_rng(2)
    angles, phases = random.uniform(0.0, 2.0 * np.pi, (2, 40))
    waves = (np.sin(25.0 * (np.cos(a) * x + np.sin(a) * y) + p) for a, p in zip(angles, phases, strict=True))
    return 0.01 * sum(waves)


def range_scan() -> Mesh:
    """Return rows of measured points on a bumpy surface."""
    return sheet(60, 60, lambda down, right: (right, down, bumps(right, down)))


def smoothed(points: NDArray, quads: NDArray, steps: int) -> NDArray:
    """Return points, each half drawn to the middle of its neighbors some times."""
    starts = np.concatenate([quads[:, i] for i in range(4)])
    ends = np.concatenate([quads[:, (i + 1) % 4] for i in range(4)])
    starts, ends = np.concatenate([starts, ends]), np.concatenate([ends, starts])
    counts = np.bincount(starts, minlength=len(points))
    for _ in range(steps):
        middles = np.stack([np.bincount(starts, column[ends], len(points)) for column in points.T], axis=1)
        points = 0.5 * points + 0.5 * middles / counts[:, None]
    return points


def hull(cells: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the border of filled cells as quads, whose vertices are corners of the cells."""
    padded = np.pad(cells, 1)
    quads = []
    for axis, step in itertools.product(range(3), (-1, 1)):
        border = np.argwhere(padded & ~np.roll(padded, -step, axis=axis))
        one, other = np.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
        first = border + np.eye(3, dtype=int)[axis] * (step > 0)
        around = (first, first + one, first + one + other, first + other)
        quads.append(np.stack(around if step > 0 else around[::-1], axis=1))
    corners, numbers = np.unique(np.concatenate(quads).reshape(-1, 3), axis=0, return_inverse=True)
    return corners.astype(np.float64), numbers.reshape(-1, 4).astype(np.int32)


def divided(points: NDArray, quads: NDArray, parts: int) -> tuple[NDArray, NDArray]:
    """Return quads, each divided into parts * parts quads."""
    steps = np.linspace(0.0, 1.0, parts + 1)
    down, right = (part[None, :, :, None] for part in np.meshgrid(steps, steps, indexing="ij"))
    a, b, c, d = (points[quads[:, i]][:, None, None] for i in range(4))
    places = (1 - down) * ((1 - right) * a + right * b) + down * ((1 - right) * d + right * c)
    numbers = np.arange(places[..., 0].size).reshape(places.shape[:3])
    inner = np.stack([numbers[:, :-1, :-1], numbers[:, :-1, 1:], numbers[:, 1:, 1:], numbers[:, 1:, :-1]], axis=-1)
    _, first, merged = np.unique(places.reshape(-1, 3).round(6), axis=0, return_index=True, return_inverse=True)
    return places.reshape(-1, 3)[first], merged.reshape(-1)[inner.reshape(-1, 4)]


def figure() -> Mesh:
    """Return a body with a head, arms and legs of thin quads, whose loops meet in poles of three and five edges."""
    cells = np.zeros((5, 2, 7), dtype=bool)
    cells[1:4, :, 3:5] = cells[2, 0, 5:] = cells[0, 0, 4] = cells[4, 0, 4] = cells[1, 0, :3] = cells[3, 0, :3] = True
    points, quads = hull(cells)
    points, quads = divided(points * [0.5, 0.6, 1.0], quads, 5)
    return smoothed(points, quads, 8), halved(quads)


def rounded_cube() -> Mesh:
    points, quads = hull(np.ones((1, 1, 1), dtype=bool))
    points, quads = divided(points, quads, 20)
    return smoothed(points, quads, 30), halved(quads)


def marching_cubes() -> Mesh:
    """Return a smooth blob, made of cells of one size that do not know its shape."""
    x, y, z = np.meshgrid(*[np.linspace(-1.2, 1.2, 30)] * 3, indexing="ij")
    points, quads = hull(x**2 + 1.5 * y**2 + 2.0 * z**2 + 0.5 * np.sin(3.0 * x + 2.0 * y + z) < 0.9)
    return smoothed(points, quads, 4), halved(quads)


def isotropic() -> Mesh:
    """Return a noisy ball of nearly equilateral triangles."""
    golden = (1.0 + 5.0**0.5) / 2.0
    points = np.array([np.roll((0.0, a, b * golden), k) for k in range(3) for a in (-1, 1) for b in (-1, 1)])
    near = np.linalg.norm(points[:, None] - points, axis=2)
    triangles = np.array(
        [t for t in itertools.combinations(range(12), 3) if near[np.ix_(t, t)].max() < 2.1], dtype=np.int32
    )
    for _ in range(4):
        edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, number = np.unique(edges, axis=0, return_inverse=True)
        ab, bc, ca = (len(points) + number.reshape(-1, 3)).T
        a, b, c = triangles.T
        triangles = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
        points = np.concatenate([points, points[edges].mean(axis=1)])
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return points * np.random.default_rng(3).uniform(0.98, 1.02, (len(points), 1)), triangles.astype(np.int32)


def tilted_bar(length: float = 1.0) -> Mesh:
    """Return a bar of cells of one size, which mostly run along it, and step aside where it leaves their rows."""
    x, y, z = np.meshgrid(np.arange(60.0), np.arange(24.0), np.arange(24.0), indexing="ij")
    points, quads = hull((np.abs(y - 8.0 - 0.12 * x) < 4.0) & (np.abs(z - 9.0 - 0.09 * x) < 5.0))
    return smoothed(points, quads, 6) * [length, 1.0, 1.0], halved(quads)


PLACED_MESHES = (ball, cylinder, rounded_cube, figure)
SCANNED_MESHES = (isotropic, marching_cubes, range_scan, tilted_bar)


def fan(range_of_sizes: float, bumpy: float = 1.0) -> Mesh:
    """Return rows of squares around a center, larger ones farther away. Only a part of them is bumpy."""

    def place(down: NDArray, right: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        away, around = np.exp(range_of_sizes * (down - 1.0)), range_of_sizes * right
        x, y = away * np.cos(around), away * np.sin(around)
        return x, y, bumps(x, y) * (right < bumpy)

    return sheet(60, 60, place)


@pytest.mark.parametrize("make", PLACED_MESHES)
def test_what_artists_make_is_no_scan_when_it_is_triangulated(make: Callable[[], Mesh]) -> None:
    assert not sw.has_scanned_edges(*make())


@pytest.mark.parametrize("make", SCANNED_MESHES)
def test_edges_that_follow_nothing_or_have_one_length_are_scanned(make: Callable[[], Mesh]) -> None:
    assert sw.has_scanned_edges(*make())


def test_edges_of_very_different_lengths_and_flat_faces_are_an_artists() -> None:
    """Game models of machines have dense triangles around details, and large flat sides."""
    assert sw.has_scanned_edges(*fan(1.5))
    assert not sw.has_scanned_edges(*fan(2.5))
    assert not sw.has_scanned_edges(*fan(1.5, bumpy=0.6))
    assert not sw.has_scanned_edges(*tilted_bar(length=2.5))


def test_edges_around_a_tube_as_a_screw_do_not_follow_it() -> None:
    assert sw.has_scanned_edges(*cylinder(twist=1.0))


@pytest.mark.parametrize("make", [figure, marching_cubes, range_scan])
def test_the_answer_does_not_depend_on_where_a_mesh_lies_and_how_its_triangles_are_stored(
    make: Callable[[], Mesh],
) -> None:
    points, triangles = make()
    random = np.random.default_rng(4)
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
    stored = random.permutation(np.roll(triangles, 1, axis=1))
    stored[::2] = stored[::2, ::-1]
    moved = sw.has_scanned_edges(30.0 * points @ rotation + 5.0, stored)
    assert moved == sw.has_scanned_edges(points, triangles)


def test_a_mesh_of_few_triangles_or_mostly_of_quads_is_an_artists() -> None:
    points, triangles = isotropic()
    assert sw.has_scanned_edges(points, triangles[:2000])
    assert not sw.has_scanned_edges(points, triangles[:1999])
    half = len(triangles) // 2
    polygons = np.concatenate([np.arange(half) // 2, half + np.arange(half)])
    assert sw.has_scanned_edges(points, triangles, polygons)
    assert not sw.has_scanned_edges(points, triangles[:half], polygons[:half])
