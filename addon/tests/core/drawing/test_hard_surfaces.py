# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on an edge of a hard surface offers: no hairpin first, and always the border of the flat face under the cursor."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray
from polygon_meshes import arrays_of
from real_sessions import session_on
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.drawing.picture import Role
from seamwire.core.drawing.session import Session
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import Edge, undirected

pytest.importorskip("seamwire_core")

Polygons = list[tuple[int, ...]]
STEP = (0, 0, 0), (3, 0, 0), (3, 1, 0), (1, 1, 0), (1, 3, 0), (0, 3, 0)
"""The corners of a shape like an L."""


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


def bevelled_box(segments: int, bevel: float = 0.2) -> tuple[NDArray[np.float64], Polygons]:
    """Return a box of side 1 with round edges, whose corners are parts of balls."""
    side = 2 * (segments + 1)
    numbers: dict[tuple[float, ...], int] = {}

    def number(place: tuple[int, ...]) -> int:
        turns = [step - segments if step <= segments else step - segments - 1 for step in place]
        inner = np.where(np.array(place) <= segments, -0.5 + bevel, 0.5 - bevel)
        ways = np.tan(np.array(turns) / segments * np.pi / 4.0)
        point = inner + bevel * ways / np.linalg.norm(ways)
        return numbers.setdefault(tuple(np.round(point, 9).tolist()), len(numbers))

    polygons: Polygons = []
    for axis, end in itertools.product(range(3), (0, side - 1)):
        others = [other for other in range(3) if other != axis]
        for steps in itertools.product(range(side - 1), repeat=2):
            quad = []
            for offset in ((0, 0), (1, 0), (1, 1), (0, 1)):
                place = [end] * 3
                place[others[0]], place[others[1]] = steps[0] + offset[0], steps[1] + offset[1]
                quad.append(number(tuple(place)))
            polygons.append(tuple(quad if (end > 0) != (axis == 1) else quad[::-1]))
    return np.array(list(numbers)), polygons


def wavy_ball() -> tuple[NDArray[np.float64], Polygons]:
    """Return a ball of 15 rings of 32 vertices with waves, and a pole at either end."""
    around, rings = 32, 15
    turn, tilt = np.meshgrid(np.arange(around) * 2.0 * np.pi / around, np.linspace(0.0, np.pi, rings + 2)[1:-1])
    radius = 1.0 + 0.2 * np.sin(7.0 * turn) * np.sin(7.0 * tilt)
    parts = np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), -np.cos(tilt)
    points = np.stack([(radius * part).ravel() for part in parts], axis=1)
    polygons: Polygons = []
    for ring, i in itertools.product(range(rings - 1), range(around)):
        low, after = ring * around, (i + 1) % around
        polygons.append((low + i, low + after, low + around + after, low + around + i))
    top, pole = (rings - 1) * around, rings * around
    polygons += [((i + 1) % around, i, pole) for i in range(around)]
    polygons += [(top + i, top + (i + 1) % around, pole + 1) for i in range(around)]
    return np.concatenate([points, [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]]), polygons


def session_of(points: NDArray[np.float64], polygons: Polygons) -> tuple[Session, Arrays]:
    arrays = arrays_of(points, polygons)
    return session_on(arrays.points, arrays.triangles, arrays.edges), arrays


def offers(session: Session, target: Snap) -> list[tuple[str, frozenset[Edge]]]:
    """Return the kinds and the edges of what is offered, in order."""
    session.hover(target, loop=True)
    session.wait()
    found = []
    for _ in session.picture.offered.kinds:
        offer = session.picture.one(Role.OFFER)
        found.append((session.picture.offered.kind, frozenset(offer.edges())))
        session.next_candidate()
    session.hover(None)
    return found


def border(polygon: tuple[int, ...]) -> frozenset[Edge]:
    return frozenset(undirected(pair) for pair in zip(polygon, polygon[1:] + polygon[:1], strict=True))


def snaps(arrays: Arrays, edge: Edge) -> list[Snap]:
    """Return an edge as it is picked at either end, with each edge that crosses it there."""
    found = []
    for end, start in (edge, edge[::-1]):
        beside = {int(v) for pair in arrays.edges if end in pair for v in pair} - {end, start}
        found += [Snap(edge, crossing=(end, other)) for other in sorted(beside)]
    return found


@pytest.mark.parametrize("rim", [False, True])
@pytest.mark.parametrize("sides", [8, 32, 64])
def test_over_an_upright_edge_of_a_cylinder_the_strip_comes_first(sides: int, rim: bool) -> None:
    session, _ = session_of(*prism(circle(sides), 2.0))
    if rim:
        session.loop((sides, sides + 1))
        session.wait()
        assert session.wires[0].closed
    assert offers(session, Snap((2, sides + 2)))[0] == ("STRIP", {(2, sides + 2)})


@pytest.mark.parametrize("sides", [8, 32, 64])
def test_over_the_rim_of_a_cylinder_the_rim_comes_first_and_no_hairpin_crosses_it(sides: int) -> None:
    session, arrays = session_of(*prism(circle(sides), 2.0))
    rim = border(tuple(range(sides, 2 * sides)))
    for target in snaps(arrays, (sides + 2, sides + 3)):
        found = offers(session, target)
        assert found[0] == ("CLOSED", rim)
        assert all(len(edges) == 1 for kind, edges in found if kind == "CROSSING")


def test_on_a_wavy_ball_no_loop_of_a_few_edges_comes_first_or_crosses() -> None:
    session, arrays = session_of(*wavy_ball())
    for edge in (
        (438, 439),
        (352, 384),
    ):  # without the rule, the first has such a loop first, and the second has one that crosses
        for target in snaps(arrays, edge):
            found = offers(session, target)
            assert len(found[0][1]) > 6
            assert all(len(edges) > 6 for kind, edges in found if kind == "CROSSING")


def test_a_face_of_a_box_stays_the_first_offer() -> None:
    points, polygons = prism(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float), 1.0)
    session, _ = session_of(points, polygons)
    assert offers(session, Snap((0, 4)))[0][1] in {border(polygon) for polygon in polygons}


def shapes() -> list[object]:
    """Return meshes, and which polygons are flat faces by themselves."""
    found = [pytest.param(*prism(circle(n), 2.0), range(n + 2), id=f"cylinder of {n}") for n in (8, 32, 64)]
    found.append(pytest.param(*prism(np.array(STEP, dtype=float), 1.0), range(8), id="L"))
    for segments in (1, 2, 3, 8):
        points, polygons = bevelled_box(segments)
        flat = [i for i, quad in enumerate(polygons) if (np.ptp(points[list(quad)], axis=0) > 0.5).sum() == 2]
        assert len(flat) == 6
        found.append(pytest.param(points, polygons, flat, id=f"box with bevels of {segments}"))
    return found


@pytest.mark.parametrize(("points", "polygons", "flat"), shapes())
def test_the_border_of_the_flat_face_under_the_cursor_is_offered_at_each_of_its_edges(
    points: NDArray[np.float64], polygons: Polygons, flat: list[int]
) -> None:
    session, arrays = session_of(points, polygons)
    for number in list(flat)[:3]:
        triangle = int(np.flatnonzero(arrays.polygons == number)[-1])
        for edge in sorted(border(polygons[number]))[:5]:
            found = [edges for _, edges in offers(session, Snap(edge, triangle=triangle))]
            assert border(polygons[number]) in found


def test_over_an_edge_inside_a_flat_face_the_border_of_all_its_polygons_is_offered_last() -> None:
    points, polygons = prism(circle(8), 2.0, rows=3)
    session, arrays = session_of(points, polygons)
    triangle = int(np.flatnonzero(arrays.polygons == 2)[0])
    wall = border((0, 1, 9, 17, 25, 24, 16, 8))
    assert offers(session, Snap((8, 9), triangle=triangle))[-1] == ("FLAT", wall)
    assert offers(session, Snap((8, 9)))[-1][1] != wall, "the cursor is beside the mesh"


def test_a_border_that_was_taken_over_an_edge_inside_is_kept() -> None:
    points, polygons = prism(circle(8), 2.0, rows=3)
    session, arrays = session_of(points, polygons)
    target = Snap((8, 9), triangle=int(np.flatnonzero(arrays.polygons == 2)[0]))
    session.hover(target, loop=True)
    session.wait()
    for _ in range(session.picture.offered.kinds.index("FLAT")):
        session.next_candidate()
    assert session.loop(target)
    session.wait()
    assert frozenset(session.wires[0].edges()) == border((0, 1, 9, 17, 25, 24, 16, 8))
