# SPDX-License-Identifier: GPL-3.0-or-later
"""Loops, strips and strokes with the library's own live wires, on a cylinder, around poles, on triangles."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from real_sessions import AROUND, RINGS, ball, caps, halves, meridian, quads_between_rings, session_on, sides, tube
from seamwire.core.network.network import Snap
from seamwire.core.sketch.picture import Role
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from setting import use

core = pytest.importorskip("seamwire_core")


def hovered(session: Sketch, edge: tuple[int, int] | Snap) -> list[tuple[str, list[int]]]:
    session.hover(edge, loop=True)
    session.wait()
    found = []
    for _ in session.picture.offered.kinds:
        found.append((session.picture.offered.kind, sorted(session.picture.one(Role.OFFER).vertices)))
        session.next_candidate()
    return found


def test_around_a_tube_loop_and_strip_are_one() -> None:
    ring = list(range(4 * AROUND, 5 * AROUND))
    edge = (ring[0], ring[1])
    session = tube()
    assert hovered(session, edge) == [("CLOSED", ring)]
    assert session.loop(edge)
    assert session.wires[0].closed


@pytest.mark.parametrize("ready", [False, True])
def test_a_double_click_on_a_ball_takes_the_meridian_between_the_poles(ready: bool) -> None:
    session = ball(ready=ready)
    edge = (3 * AROUND + 2, 4 * AROUND + 2)
    session.click(edge)
    session.loop(edge)
    session.wait()
    (wire,) = session.wires
    while wire.kind == "CLOSED":  # a great circle through both poles is a loop, where the metric says so
        session.retrace(wire)
        (wire,) = session.wires
    assert not wire.closed
    assert sorted(wire.vertices) == [*meridian(2), AROUND * RINGS, AROUND * RINGS + 1]
    assert {wire.start, wire.end} == {AROUND * RINGS, AROUND * RINGS + 1}
    assert session.seed is None


def test_strips_end_at_seams_of_the_mesh() -> None:
    ring = [(4 * AROUND + i, 4 * AROUND + (i + 1) % AROUND) for i in range(AROUND)]
    session = ball(seams=ring)
    offers = dict(hovered(session, (2 * AROUND, 3 * AROUND)))
    assert offers["STRIP"] == sorted([*meridian(0)[:5], AROUND * RINGS])
    assert offers["WHOLE"] == sorted([*meridian(0), AROUND * RINGS, AROUND * RINGS + 1])


def test_a_way_past_poles_goes_straight_on_there_up_to_seams() -> None:
    ring = [(4 * AROUND + i, 4 * AROUND + (i + 1) % AROUND) for i in range(AROUND)]
    offers = dict(hovered(ball(seams=ring), (2 * AROUND, 3 * AROUND)))
    assert offers["PAST"] == sorted([*meridian(0)[:5], AROUND * RINGS, *meridian(AROUND // 2)[:5]])


def test_a_way_past_poles_that_meets_no_seam_closes_around_the_ball() -> None:
    session = ball()
    session.hover((2 * AROUND, 3 * AROUND), loop=True)
    session.wait()
    great_circle = {*meridian(0), *meridian(AROUND // 2), AROUND * RINGS, AROUND * RINGS + 1}
    shown = []
    for _ in session.picture.offered.kinds:
        shown.append((session.picture.one(Role.OFFER).closed, set(session.picture.one(Role.OFFER).vertices)))
        session.next_candidate()
    assert (True, great_circle) in shown


def test_a_ring_of_four_edges_around_a_limb_comes_first() -> None:
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    points = np.concatenate([np.column_stack([corners, np.full(4, z)]) for z in np.arange(6.0)])
    start = np.arange(4)
    square = np.stack([start, np.roll(start, -1), np.roll(start, -1) + 4, start + 4], axis=1)
    walls = np.concatenate([square + 4 * ring for ring in range(5)])
    quads = np.concatenate([walls, [[3, 2, 1, 0], [20, 21, 22, 23]]]).astype(np.int32)
    session = session_on(points, halves(quads), sides(quads))
    assert hovered(session, (8, 9)) == [("CLOSED", [8, 9, 10, 11])]
    assert hovered(session, (20, 21))[0] == ("CLOSED", [20, 21, 22, 23]), "around the end, where no strip runs"


def test_on_triangles_strips_run_straight() -> None:
    size = 9
    points, triangles = grid_points(size), grid_triangles(size)
    session = session_on(points, triangles, edges=None)
    middle = size // 2 * size + size // 2
    offers = dict(hovered(session, (middle, middle + 1)))
    assert offers["STRIP"] == list(range(size // 2 * size, size // 2 * size + size))
    diagonal = dict(hovered(session, (middle, middle + size + 1)))
    assert diagonal["STRIP"] == [i * (size + 1) for i in range(size)]


# Strokes

SIZE = 31
"""Side of the flat grid that strokes are drawn on, in vertices."""


def grid(**options: object) -> Sketch:
    return session_on(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE), **options)


def faces_under(points: NDArray[np.float64]) -> NDArray[np.int32]:
    cells = np.minimum(np.floor(points[:, :2]).astype(int), SIZE - 2)
    above = (points[:, 1] - cells[:, 1]) > (points[:, 0] - cells[:, 0])
    return (2 * (cells[:, 1] * (SIZE - 1) + cells[:, 0]) + above).astype(np.int32)


def bow() -> NDArray[np.float64]:
    """Return a half circle of radius 10 around the middle."""
    angles = np.linspace(np.pi, 0.0, 80)
    return np.column_stack([15.0 + 10.0 * np.cos(angles), 15.0 + 10.0 * np.sin(angles), np.zeros(80)])


def gate() -> NDArray[np.float64]:
    """Return a stroke up, across and down again along the grid's edges, from left to right of the middle."""
    corners = [(5.0, 15.0), (5.0, 23.0), (25.0, 23.0), (25.0, 15.0)]
    legs = [np.linspace(a, b, 40) for a, b in itertools.pairwise(corners)]
    return np.column_stack([np.concatenate(legs) + np.array([0.01, 0.02]), np.zeros(120)])


GATE = {(x, y) for x in (5, 25) for y in range(15, 24)} | {(x, 23) for x in range(5, 26)}
LEFT, RIGHT = 15 * SIZE + 5, 15 * SIZE + 25


def wire_between(session: Sketch, along: Along) -> NDArray[np.float64]:
    use(session, along=along)
    session.start(LEFT)
    session.hover(RIGHT)
    session.wait()
    points = session.picture.active.points.copy()
    session.end_chain()
    return points


@pytest.mark.parametrize("ready", [False, True])
def test_a_wire_follows_a_stroke_and_is_what_it_was_without(ready: bool) -> None:
    session = grid(ready=ready)
    before = wire_between(session, "SURFACE")
    assert np.abs(before[:, 1] - 15.0).max() < 1e-6
    assert session.draw_stroke(bow(), faces_under(bow()))
    followed = wire_between(session, "SURFACE")
    # Away from the ends, where the wire has found the stroke, within half an edge of the circle.
    inner = np.abs(followed[:, 0] - 15.0) < 8.0
    assert np.abs(np.hypot(*(followed[inner, :2] - 15.0).T) - 10.0).max() < 0.5
    assert session.undo()
    after = wire_between(session, "SURFACE")
    assert np.array_equal(after, before)


@pytest.mark.parametrize("ready", [False, True])
def test_along_edges_a_wire_follows_a_stroke_that_edges_can_follow(ready: bool) -> None:
    session = grid(ready=ready)
    session.draw_stroke(gate(), faces_under(gate()))
    assert set(map(tuple, wire_between(session, "EDGES")[:, :2])) == GATE


def test_strokes_reach_wires_whose_seeds_are_moved() -> None:
    session = grid()
    session.click(LEFT)
    session.click(RIGHT - 4)
    session.wait()
    session.end_chain()
    session.draw_stroke(gate(), faces_under(gate()))
    assert session.wires[0].points[:, 1].max() == 15.0, "a kept wire stays"
    session.drag(RIGHT - 4)
    session.drag_to(RIGHT)
    session.wait()
    session.drag_end()
    session.wait()
    assert set(map(tuple, session.wires[0].points[:, :2])) == GATE


@pytest.mark.parametrize(
    "points",
    [
        np.repeat(bow(), 130, axis=0)[:10_000] + np.array([1e-3, 0.0, 0.0]) * np.sin(np.arange(10_000))[:, None],
        np.vstack([bow(), bow()[::-1]]),
        np.vstack([bow(), bow()[:, [1, 0, 2]]]),
        np.array([[0.0, 0.0, 0.0], [30.0, 30.0, 0.0]]),
        np.array([[0.0, 0.1, 0.0], [30.0, 0.1, 0.0], [30.0, 30.0, 0.0], [0.0, 0.1, 0.0]]),
    ],
    ids=[
        "ten thousand points",
        "there and back",
        "crossing itself",
        "two points far apart",
        "closed along the boundary",
    ],
)
def test_any_stroke_on_the_mesh_leaves_wires_that_can_be_drawn(points: NDArray[np.float64]) -> None:
    session = grid()
    assert session.draw_stroke(points, faces_under(points))
    for along in ("EDGES", "SURFACE"):
        assert len(wire_between(session, along)) > 2
    assert session.reason == ""


@pytest.mark.parametrize("ready", [False, True])
def test_what_the_library_refuses_is_said_and_undone_without_a_loss(ready: bool) -> None:
    def off_mesh(stroke: object) -> object:
        return core.Scribble(stroke.points + np.array([0.0, 0.0, 40.0]), faces=stroke.faces)

    session = grid(ready=ready, make_stroke=off_mesh)
    session.click(LEFT)
    session.click(RIGHT)
    session.wait()
    session.hover(LEFT + 3 * SIZE)
    session.draw_stroke(gate(), faces_under(gate()))
    session.wait()
    assert "off the mesh" in session.reason
    assert not session.computing
    assert not session.click(LEFT + 3 * SIZE)
    assert len(session.wires) == 1
    assert session.undo()
    session.wait()
    assert session.reason == ""
    assert session.picture.active is not None
    assert session.click(LEFT + 3 * SIZE)


def plate_with_bung() -> Sketch:
    """Return a session on a box with a low bung of eight sides in the middle of its upper face.

    Vertices 0 to 7 are the rim of the bung, 8 to 15 the foot of its wall, and 40 is in its middle.
    """
    angles = np.arange(8) * np.pi / 4.0
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    square = 10.0 * circle / np.abs(circle).max(axis=1)[:, None]
    rings = [(0.7 * circle, 0.4), (0.8 * circle, 0.0), (3.0 * circle, 0.0), (square, 0.0), (square, -5.0)]
    points = np.vstack([*(np.column_stack([ring, np.full(8, z)]) for ring, z in rings), [0, 0, 0.4], [0, 0, -5.0]])
    quads = quads_between_rings(5, 8)[:, ::-1]
    fans = caps(5, 8)[:, ::-1]
    edges = np.unique(np.concatenate([sides(quads), sides(fans)]), axis=0)
    return session_on(points, np.concatenate([halves(quads), fans]), edges)


@pytest.mark.parametrize("inside", [False, True])
def test_on_a_bung_its_rim_comes_first(inside: bool) -> None:
    session = plate_with_bung()
    triangles = session.triangles.tolist()
    spoke, triangle = (0, 40), next(row for row, corners in enumerate(triangles) if {0, 40} <= set(corners))
    kind, vertices = hovered(session, Snap(spoke, triangle=triangle, inside=inside))[0]
    assert (kind, vertices) == ("FLAT", list(range(8)))
