# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on a hard surface offers: no hairpin first, the border of the part under the cursor, and the slit of a tube."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray
from polygon_meshes import arrays_of
from real_sessions import AROUND, ball, session_on
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import Edge, undirected
from seamwire.core.sketch.picture import Role
from seamwire.core.sketch.sketch import Sketch

pytest.importorskip("seamwire_core")

Polygons = list[tuple[int, ...]]


def prism(outline: NDArray[np.float64], height: float, rows: int = 1) -> tuple[NDArray[np.float64], Polygons]:
    """Return a prism with n-gons at both ends; vertex row * n + i."""
    n = len(outline)
    points = np.concatenate([outline + np.array([0.0, 0.0, z]) for z in np.linspace(0.0, height, rows + 1)])
    walls = [
        (row * n + i, row * n + (i + 1) % n, (row + 1) * n + (i + 1) % n, (row + 1) * n + i)
        for row, i in itertools.product(range(rows), range(n))
    ]
    return points, [tuple(range(n))[::-1], tuple(range(rows * n, (rows + 1) * n)), *walls]


def circle(count: int) -> NDArray[np.float64]:
    angles = np.arange(count) * 2.0 * np.pi / count
    return np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1)


def with_fans(points: NDArray[np.float64], polygons: Polygons, rows: int = 1) -> tuple[NDArray[np.float64], Polygons]:
    """Return a prism whose n-gons are fans around two more vertices, the last ones."""
    n = len(points) // (rows + 1)
    fans: Polygons = [(polygons[end][i - 1], polygons[end][i], len(points) + end) for end in (0, 1) for i in range(n)]
    return np.concatenate([points, [points[:n].mean(axis=0), points[-n:].mean(axis=0)]]), fans + polygons[2:]


def triangulated(polygons: Polygons) -> Polygons:
    """Return quads as two triangles each."""
    return [triangle for a, b, c, d in polygons for triangle in ((a, b, c), (a, c, d))]


def barrel(sides: int = 24) -> tuple[NDArray[np.float64], Polygons]:
    """Return a turned barrel: a wall of five rows, rims that stand out, lids that lie deeper; vertex row * sides + i."""
    wall = [(1.0 + 0.12 * np.sin(np.pi * step), 0.2 + 1.6 * step) for step in np.linspace(0.0, 1.0, 6)[1:-1]]
    profile = [(0.75, 0.1), (0.75, 0.0), (1.02, 0.0), (1.02, 0.2), (0.94, 0.2), *((r - 0.06, z) for r, z in wall)]
    profile += [(0.94, 1.8), (1.02, 1.8), (1.02, 2.0), (0.75, 2.0), (0.75, 1.9)]
    rows = len(profile) - 1
    points, polygons = prism(circle(sides), 1.0, rows)
    for row, (radius, height) in enumerate(profile):
        points[row * sides : (row + 1) * sides] = circle(sides) * radius + np.array([0.0, 0.0, height])
    return points, polygons


def session_of(points: NDArray[np.float64], polygons: Polygons) -> tuple[Sketch, Arrays]:
    arrays = arrays_of(points, polygons)
    return session_on(arrays.points, arrays.triangles, arrays.edges), arrays


def offers(session: Sketch, target: Snap) -> list[tuple[str, frozenset[Edge]]]:
    """Return the kinds and the edges of what is offered, in order."""
    session.hover(target, loop=True)
    session.wait()
    found = []
    for _ in session.picture.offered.kinds:
        loops = [shown.wire for shown in session.picture.wires if shown.role is Role.OFFER]
        found.append((session.picture.offered.kind, frozenset(edge for loop in loops for edge in loop.edges())))
        assert session.picture.offered.kind != "FLAT" or all(loop.closed for loop in loops)
        session.next_candidate()
    session.hover(None)
    return found


def border(polygon: tuple[int, ...]) -> frozenset[Edge]:
    return frozenset(undirected(pair) for pair in zip(polygon, polygon[1:] + polygon[:1], strict=True))


def ring_of(row: int, sides: int) -> frozenset[Edge]:
    return border(tuple(range(row * sides, (row + 1) * sides)))


def upright(i: int, first: int, last: int, sides: int) -> frozenset[Edge]:
    return frozenset((row * sides + i, (row + 1) * sides + i) for row in range(first, last))


def face_of(arrays: Arrays, *vertices: int) -> int:
    """Return a triangle with these vertices."""
    return int(np.flatnonzero([set(vertices) <= set(triangle) for triangle in arrays.triangles.tolist()])[0])


@pytest.mark.parametrize("fans", [False, True])
def test_inside_a_cap_its_border_comes_first(fans: bool) -> None:
    points, polygons = prism(circle(16), 2.0)
    session, arrays = session_of(*(with_fans(points, polygons) if fans else (points, polygons)))
    triangle = face_of(arrays, 18, 19, 33) if fans else int(np.flatnonzero(arrays.polygons == 1)[0])
    edges = [(18, 33), (18, 19)] if fans else [(18, 19)]
    for edge in edges:
        assert offers(session, Snap(edge, triangle=triangle, inside=True))[0] == ("FLAT", ring_of(1, 16))
    assert offers(session, Snap((18, 19), triangle=triangle))[0][1] == ring_of(1, 16)


@pytest.mark.parametrize("rows", [1, 4])
@pytest.mark.parametrize("way", ["n-gons", "fans", "triangles"])
def test_over_an_upright_edge_of_a_wall_the_slit_between_the_rims_comes_first(rows: int, way: str) -> None:
    points, polygons = prism(circle(16), 2.0, rows)
    if way != "n-gons":
        points, polygons = with_fans(points, polygons, rows)
    if way == "triangles":
        polygons = [*polygons[:32], *triangulated(polygons[32:])]
    session, _ = session_of(points, polygons)
    slit = upright(2, 0, rows, 16)
    low = 16 * (rows - 1) + 2
    assert offers(session, Snap((low, low + 16)))[0] == ("STRIP", slit)
    if way == "triangles":
        found = offers(session, Snap((low - 1, low + 16)))
        assert found[0][1] in {slit, upright(1, 0, rows, 16)}, "straight, though a diagonal is picked"
    found = offers(session, Snap((low, low + 1), crossing=(low, low + 16)))
    assert found[:2] == [("CLOSED", ring_of(rows - 1, 16)), ("CROSSING", slit)]


def trunk(sides: int) -> tuple[NDArray[np.float64], Polygons]:
    """Return a log that is open below. Its lid is a fan with a round rim; vertex row * sides + i."""
    profile = [(1.0, 0.0), (1.0, 0.9), (1.0, 1.8), (1.0, 2.7), (1.01, 3.54), (1.06, 3.8), (1.05, 3.89), (1.0, 3.96)]
    profile.append((0.88, 4.0))
    rows = len(profile) - 1
    points, polygons = with_fans(*prism(circle(sides), 4.0, rows), rows)
    points[:-2] = np.concatenate([circle(sides) * radius + np.array([0.0, 0.0, z]) for radius, z in profile])
    lower = len(points) - 2
    points[lower] = points[lower + 1]
    kept = [polygon for polygon in polygons if lower not in polygon]
    return points[:-1], [tuple(min(vertex, lower) for vertex in polygon) for polygon in kept]


@pytest.mark.parametrize("sides", [16, 32])
def test_on_the_wall_of_a_trunk_the_slit_comes_before_the_strip_over_the_lid(sides: int) -> None:
    session, _ = session_of(*trunk(sides))
    lower = 2 * sides + 2
    found = offers(session, Snap((lower, lower + sides)))
    assert found[0] == ("STRIP", upright(2, 0, 8, sides))
    assert found[1][0] == "PAST"
    assert offers(session, Snap((lower, lower + 1)))[0] == ("CLOSED", ring_of(2, sides))
    assert len(offers(session, Snap((8 * sides + 2, 9 * sides)))[0][1]) > 8, "on the lid there is no slit"


def test_fans_of_a_triangulated_wall_are_no_lids() -> None:
    points, polygons = trunk(32)
    split = []
    for number, corners in enumerate(polygons):
        shift = (number + number // 32) % 2  # diagonals alternate: vertices of the wall have 4 or 8 triangles
        turned = (*corners[shift:], *corners[:shift])
        split += [turned] if len(corners) == 3 else [turned[:3], (turned[0], turned[2], turned[3])]
    session, _ = session_of(points, split)
    found = offers(session, Snap((66, 98)))
    assert found[0] == ("STRIP", upright(2, 0, 8, 32))


@pytest.mark.parametrize("rows", [1, 4])
def test_inside_a_face_of_a_wall_the_nearest_rim_comes_first_and_the_slit_second(rows: int) -> None:
    session, arrays = session_of(*prism(circle(16), 2.0, rows))
    low = 16 * (rows - 1) + 2
    triangle = face_of(arrays, low, low + 1, low + 17)
    slit = upright(2, 0, rows, 16)
    rims = [ring_of(rows, 16), ring_of(0, 16)]
    found = offers(session, Snap((low, low + 16), triangle=triangle, inside=True))
    assert found[0][1] in rims
    assert found[1][1] == slit
    found = offers(session, Snap((low + 16, low + 17), crossing=(low + 16, low), triangle=triangle, inside=True))
    assert [edges for _, edges in found[:4]] == [rims[0], slit, rims[0] | rims[1], rims[1]]
    assert len({edges for _, edges in found}) == len(found)


def test_all_borders_of_a_wall_are_shown_and_taken_at_once() -> None:
    session, arrays = session_of(*prism(circle(16), 2.0))
    target = Snap((18, 19), crossing=(18, 2), triangle=face_of(arrays, 2, 3, 19), inside=True)
    session.hover(target, loop=True)
    session.wait()
    assert session.next_candidate()
    assert session.next_candidate()
    session.hover(target, loop=True)
    session.wait()
    assert session.picture.offered.number == 2, "the choice stays"
    assert session.loop(target)
    session.wait()
    rims = [ring_of(0, 16), ring_of(1, 16)]
    assert [frozenset(wire.edges()) for wire in session.wires] == rims
    assert all(wire.closed and not wire.beside for wire in session.wires)
    assert session.loop(target), "the second press of a double click"
    assert len(session.wires) == 2
    assert session.retrace(session.wires[1])
    session.wait()
    assert frozenset(session.wires[0].edges()) == rims[0]
    assert frozenset(session.wires[1].edges()) != rims[1]
    assert session.undo()
    assert session.undo()
    assert session.wires == ()


def test_a_barrel_offers_its_wall_its_lids_and_its_rims() -> None:
    session, arrays = session_of(*barrel())
    sides = 24
    middle = 6 * sides + 2
    assert offers(session, Snap((middle, middle + sides)))[0] == ("STRIP", upright(2, 4, 9, sides))
    triangle = face_of(arrays, middle, middle + 1, middle + 1 + sides)
    found = offers(session, Snap((middle, middle + sides), triangle=triangle, inside=True))
    rims = [ring_of(4, sides), ring_of(9, sides)]
    assert [edges for _, edges in found[:4]] == [rims[0], upright(2, 4, 9, sides), rims[0] | rims[1], rims[1]]
    lid = int(np.flatnonzero(arrays.polygons == 1)[0])
    assert offers(session, Snap((13 * sides, 13 * sides + 1), triangle=lid, inside=True))[0][1] == ring_of(13, sides)


def test_inside_a_face_of_a_ball_the_offers_are_those_of_the_edge() -> None:
    session = ball()
    edge = (4 * AROUND, 4 * AROUND + 1)
    crossing = (4 * AROUND, 5 * AROUND)
    found = [offers(session, Snap(edge, crossing=crossing, triangle=64, inside=inside)) for inside in (False, True)]
    assert found[0] == found[1]
    assert found[0][0] == ("CLOSED", ring_of(4, AROUND))
