# SPDX-License-Identifier: GPL-3.0-or-later
"""The wire that is straight in the view, with the library's own live wires, on a sheet with a hill."""

from __future__ import annotations

import numpy as np
import pytest
from real_sessions import session_on
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import FacePoint
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.options import Options
from setting import use

core = pytest.importorskip("seamwire_core")

SIDE = 25
DOWN = (0.0, 0.0, -2.0)
START, END = 3 * SIDE + 2, 19 * SIDE + 21


@pytest.fixture
def session() -> Sketch:
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(-1.0, 1.0, SIDE), np.linspace(-1.0, 1.0, SIDE)))
    points = np.stack([x, y, 0.7 * np.exp(-4.0 * (x**2 + y**2)) + 0.05 * np.sin(9.0 * x)], axis=1)
    rows = np.arange((SIDE - 1) * SIDE).reshape(SIDE - 1, SIDE)[:, :-1].ravel()
    lower, upper = np.stack([rows, rows + 1, rows + SIDE + 1]), np.stack([rows, rows + SIDE + 1, rows + SIDE])
    triangles = np.concatenate([lower.T, upper.T]).astype(np.int32)
    session = session_on(points, triangles, options=Options(along="SURFACE"))
    use(session, straight=True)
    return session


def off_plane(session: Sketch, points: np.ndarray, start: int = START, end: int = END) -> float:
    """Return how far points are, seen from above, from the line between two vertices."""
    a, b = session.points[[start, end], :2]
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
    return float(np.abs((points[:, :2] - a) @ normal).max())


def aim(session: Sketch, end: int = END, seen: tuple[float, float, float] | None = DOWN) -> None:
    session.start(START)
    session.hover(Snap(end, seen_along=seen))
    session.wait()


def test_it_leads_the_candidates_and_a_click_keeps_it(session: Sketch) -> None:
    aim(session)
    assert session.picture.choice.straight
    assert session.picture.choice.number == 0
    assert len(session.picture.others) >= 1
    assert off_plane(session, session.picture.active.points) < 1e-9
    assert min(off_plane(session, wire.points) for wire in session.picture.others) > 0.02
    assert session.click(Snap(END, seen_along=DOWN))
    (wire,) = session.wires
    assert off_plane(session, wire.points) < 1e-9
    chain = session.points[list(wire.vertices)]
    assert wire.vertices[0] == START
    assert wire.vertices[-1] == END
    assert off_plane(session, chain) < 2.0 / (SIDE - 1), "its seam keeps within an edge of it"
    assert session.undo()
    assert session.wires == ()


def test_it_is_there_at_once_while_others_are_computed(session: Sketch) -> None:
    session.engines.get("SURFACE").wait_for_surface()
    session.start(START)
    assert session.click(Snap(END, seen_along=DOWN))
    assert session.waiting == 0
    (wire,) = session.wires
    assert off_plane(session, wire.points) < 1e-9


def test_the_wire_that_closes_a_chain_is_straight_too(session: Sketch) -> None:
    aim(session)
    session.click(Snap(END, seen_along=DOWN))
    third = 19 * SIDE + 2
    session.hover(Snap(third, seen_along=DOWN))
    session.wait()
    session.click(Snap(third, seen_along=DOWN))
    session.wait()
    assert session.close(DOWN)
    session.wait()
    assert session.seed is None
    assert off_plane(session, session.wires[-1].points, third, START) < 1e-9


def test_the_wheel_goes_on_to_the_others_and_round(session: Sketch) -> None:
    aim(session)
    ways = [session.picture.active]
    for _ in range(len(session.picture.others)):
        assert session.next_candidate()
        ways.append(session.picture.active)
    assert not session.picture.choice.straight
    assert session.next_candidate()
    assert session.picture.choice.straight
    assert len({way.points.tobytes() for way in ways}) == len(ways)


def test_moved_it_becomes_a_wire_of_the_metric(session: Sketch) -> None:
    aim(session)
    session.click(Snap(END, seen_along=DOWN))
    session.end_chain()
    session.drag(END)
    session.drag_to(END + 2)
    session.wait()
    assert session.drag_end()
    (wire,) = session.wires
    assert wire.vertices[-1] == END + 2
    assert off_plane(session, wire.points, end=END + 2) > 0.01


def test_a_stroke_beside_it_is_for_all_wires(session: Sketch) -> None:
    aim(session)
    assert session.draw_stroke(vertices=[START, START + SIDE, START + 2 * SIDE])
    assert session.network.strokes[-1].acts_on == "both"


def test_it_follows_the_view(session: Sketch) -> None:
    aim(session)
    tilted = (0.3, 0.1, -1.0)
    session.hover(Snap(END, seen_along=tilted))
    session.wait()
    normal = np.cross(session.points[END] - session.points[START], tilted)
    normal /= np.linalg.norm(normal)
    assert session.picture.choice.straight
    assert np.abs((session.picture.active.points - session.points[START]) @ normal).max() < 1e-9


def test_switched_off_the_others_are_as_ever(session: Sketch) -> None:
    aim(session)
    others = session.picture.others
    use(session, straight=False)
    session.wait()
    assert not session.picture.choice.straight
    assert {wire.points.tobytes() for wire in (session.picture.active, *session.picture.others)} == {
        wire.points.tobytes() for wire in others
    }


@pytest.mark.parametrize("behind", [False, True], ids=["not looked at", "one behind the other"])
def test_where_there_is_none_the_others_are_as_ever(session: Sketch, behind: bool) -> None:
    seen = tuple((session.points[END] - session.points[START]).tolist())
    aim(session, seen=seen if behind else None)
    assert not session.picture.choice.straight
    assert session.picture.active is not None
    assert session.click(Snap(END))
    assert off_plane(session, session.wires[0].points) > 0.02


def test_points_of_faces_are_its_ends_too(session: Sketch) -> None:
    triangle = session.triangles[100]
    point = FacePoint(100, tuple(triangle.tolist()), (0.2, 0.3, 0.5))
    session.start(START)
    session.hover(Snap(point, seen_along=DOWN))
    session.wait()
    assert session.picture.choice.straight
    a, b = session.points[START, :2], (np.array(point.weights) @ session.points[triangle])[:2]
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
    assert np.abs((session.picture.active.points[:, :2] - a) @ normal).max() < 1e-9


@pytest.mark.parametrize("to_vertex", [False, True], ids=["to a point", "to a vertex"])
def test_between_near_points_it_is_offered_where_it_is_to_be_cut(session: Sketch, to_vertex: bool) -> None:
    use(session, finish="CUT")
    triangle = session.triangles[100]
    one, two = (FacePoint(100, tuple(triangle.tolist()), weights) for weights in ((0.6, 0.2, 0.2), (0.57, 0.22, 0.21)))
    end = int(triangle[0]) if to_vertex else two
    session.start(one)
    session.hover(Snap(end, seen_along=DOWN))
    session.wait()
    assert session.picture.choice.straight
    assert session.click(Snap(end, seen_along=DOWN))
    (wire,) = session.wires
    assert wire.vertices == (triangle[0],)
    assert (wire.start, wire.end) == (one, end)
    assert session.edges_to_mark() == []
    session.end_chain()
    use(session, finish="SNAP")
    session.start(one)
    session.hover(Snap(end, seen_along=DOWN))
    session.wait()
    assert not session.click(Snap(end, seen_along=DOWN))
    assert "Too short to become a seam" in session.reason
