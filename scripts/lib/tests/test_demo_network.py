# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo's network cuts meshes into disks."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))

import demo_network

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]


def torus(around: int = 36, across: int = 16) -> Mesh:
    u, v = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across, indexing="ij")
    ring = 1.0 + 0.4 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))

    def number(a: NDArray, b: NDArray) -> NDArray:
        return (a % around) * across + b % across

    corners = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
    triangles = [np.stack([corners[k] for k in pick], axis=1) for pick in ((0, 1, 2), (0, 2, 3))]
    return points, np.concatenate(triangles).astype(np.int32)


def cube(cells: int = 6) -> Mesh:
    """Six square grids whose borders are the same vertices, without a symmetric numbering."""
    place: dict[tuple[int, ...], int] = {}
    triangles = []
    for axis in range(3):
        for side in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    square = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        at = [0, 0, 0]
                        at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = side, a, b
                        square.append(place.setdefault(tuple(at), len(place)))
                    if side == 0:
                        square.reverse()
                    triangles += [(square[0], square[1], square[2]), (square[0], square[2], square[3])]
    return np.array(list(place), dtype=np.float64) / cells, np.array(triangles, dtype=np.int32)


def two_parts() -> Mesh:
    points, triangles = cube()
    more, also = torus()
    return np.concatenate([points, more + 5.0]), np.concatenate([triangles, also + len(points)])


def all_edges(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


def euler_characteristics(triangles: NDArray[np.int32], seams: set[tuple[int, int]]) -> dict[int, int]:
    """V - E + F of each piece that the seams cut out, by walking from triangle to triangle."""
    beside: dict[tuple[int, int], list[int]] = {}
    for number, (a, b, c) in enumerate(triangles.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            beside.setdefault((min(edge), max(edge)), []).append(number)
    parent = {(t, v): (t, v) for t, corners in enumerate(triangles.tolist()) for v in corners}

    def root(item: tuple[int, int]) -> tuple[int, int]:
        while parent[item] != item:
            item = parent[item]
        return item

    piece = list(range(len(triangles)))
    links: dict[int, list[int]] = {}
    glued = []
    for edge, (one, *rest) in beside.items():
        if edge not in seams and len(rest) == 1:
            glued.append(one)
            links.setdefault(one, []).append(rest[0])
            links.setdefault(rest[0], []).append(one)
            for vertex in edge:
                parent[root((one, vertex))] = root((rest[0], vertex))
    seen: set[int] = set()
    for start in range(len(triangles)):
        todo = [start] if start not in seen else []
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                piece[at] = start
                todo += links.get(at, [])
    euler = dict.fromkeys(piece, 0)
    for number in piece:
        euler[number] += 1 - 3
    for triangle in glued:
        euler[piece[triangle]] += 1
    for triangle, _ in {root(item) for item in parent}:
        euler[piece[triangle]] += 1
    return euler


@pytest.mark.parametrize("along", ["edges", "surface"])
@pytest.mark.parametrize("mesh", [torus, cube, two_parts])
def test_every_segment_is_a_disk(mesh: Callable[[], Mesh], along: str) -> None:
    points, triangles = mesh()
    network = demo_network.plan(sw, points, triangles, all_edges(triangles), along, 10.0, lambda _: None)
    euler = euler_characteristics(triangles, network.edges())
    assert set(euler.values()) == {1}
    assert len(euler) == network.segments.max() + 1


def test_an_uncut_torus_is_no_disk() -> None:
    """The check above can fail: one piece, and its characteristic is 0."""
    assert euler_characteristics(torus()[1], set()) == {0: 0}


def test_wires_are_between_the_seeds_that_the_operator_is_given() -> None:
    points, triangles = torus()
    network = demo_network.plan(sw, points, triangles, all_edges(triangles), "edges", 10.0, lambda _: None)
    chains = [tuple(int(seed) for seed in chain.split()) for chain in network.chains().split(";")]
    assert chains == [(wire.vertices[0], wire.vertices[-1]) for wire in network.wires]


def test_a_flat_mesh_needs_no_wires() -> None:
    points, triangles = cube()
    flat = triangles[(points[triangles][:, :, 0] == 0.0).all(axis=1)]
    network = demo_network.plan(sw, points, flat, all_edges(flat), "edges", 10.0, lambda _: None)
    assert network.wires == []
