# SPDX-License-Identifier: GPL-3.0-or-later
"""Ridges and valleys in the window: one click draws wires along one, and seeds snap to them."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
import ui as driver
from desk import Desk, leave, said
from scene import add_object, seams
from seamwire.core.network.picks import FacePoint
from seamwire.mesh.settings import settings
from seamwire.tool.running import chains as running
from seamwire.view.edited_objects import edited

N = 60


def top(y: float) -> float:
    """Return where the ridge lies."""
    return 0.12 * math.sin(math.pi * y)


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    """A sheet seen from above, with one winding ridge from side to side and a valley at either hand."""
    points = []
    for j in range(N + 1):
        for i in range(N + 1):
            x, y = 2.0 * i / N - 1.0, 2.0 * j / N - 1.0
            points.append((x, y, 0.08 * math.cos(2.0 * math.pi * (x - top(y)))))
    faces = [
        (j * (N + 1) + i, j * (N + 1) + i + 1, (j + 1) * (N + 1) + i + 1, (j + 1) * (N + 1) + i)
        for j in range(N)
        for i in range(N)
    ]
    made = Desk(ui, add_object(points, faces))
    settings().along = "SURFACE"
    yield made
    leave(ui)


def beside(desk: Desk, y: float, pixels: float) -> tuple[float, float]:
    """Return a place on the screen beside the ridge."""
    x, height = desk.ui.on_screen((top(y), y, 0.08))
    return x + pixels, height


def shown_ridge() -> bool:
    return edited.front is not None and edited.front.crest_view.crests is not None


@pytest.mark.parametrize("finish", [pytest.param("SNAP", marks=pytest.mark.smoke), "CUT"])
def test_with_alt_a_click_on_a_ridge_that_is_seen_draws_wires_along_it(desk: Desk, finish: str) -> None:
    ui = desk.ui
    settings().finish = finish
    desk.choose()
    settings().show_crests = True
    ui.wait_until(shown_ridge)
    place = beside(desk, 0.1, 5.0)
    ui.move(place)
    ui.event("LEFT_ALT", "PRESS", place, alt=True)
    ui.wait_until(lambda: desk.session.picture.offered.kind == "RIDGE")
    assert "Add Ridge" in said()
    count = len(desk.obj.data.vertices)
    ui.click(place, alt=True)
    ui.wait_until(lambda: not running)
    ui.event("LEFT_ALT", "RELEASE", place)
    assert desk.left_clean()
    desk.obj.update_from_editmode()
    vertices = desk.obj.data.vertices
    assert (len(vertices) > count) == (finish == "CUT")
    on_seams = {vertex for edge in seams(desk.obj) for vertex in edge}
    curve = [vertices[vertex].co[:2] for vertex in on_seams if abs(vertices[vertex].co.y) < 0.9]
    assert max(y for _, y in curve) - min(y for _, y in curve) > 1.7
    assert max(abs(x - top(y)) for x, y in curve) < (1.5 if finish == "CUT" else 3.0) / N
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []


@pytest.mark.smoke
def test_seeds_snap_to_ridges_beside_the_cursor(desk: Desk) -> None:
    ui = desk.ui
    session = desk.start()
    place = beside(desk, 0.32, 7.0)
    ui.move(place)
    assert session.target.to == "MESH"
    ui.key("TAB", shift=True)
    ui.wait_until(shown_ridge)
    ui.move((place[0], place[1] + 1.0))
    assert session.target.to == "FEATURE"
    assert session.target.pick in edited.front.crest_view.crests.edges


def test_seeds_that_lie_anywhere_snap_onto_the_line_itself(desk: Desk) -> None:
    ui = desk.ui
    settings().finish = "CUT"
    session = desk.start()
    place = beside(desk, 0.33, 8.0)
    ui.move((place[0] + 20.0, place[1]))
    ui.key("TAB", shift=True)
    ui.move((place[0], place[1] + 2.0))
    ui.wait_until(shown_ridge)
    ui.move(place)
    ui.wait_until(lambda: session.target is not None and session.target.to == "FEATURE")
    pick = session.target.pick
    assert isinstance(pick, FacePoint)
    bm_points = np.array([desk.obj.data.vertices[v].co for v in pick.corners])
    x, y, _ = np.array(pick.weights) @ bm_points
    assert abs(x - top(y)) < 0.3 / N
    assert abs(y - 0.33) < 0.05


def test_where_neither_is_asked_for_nothing_is_computed(desk: Desk) -> None:
    desk.choose()
    desk.ui.move(beside(desk, 0.1, 3.0))
    desk.ui.wait(10)
    assert edited.front.crest_view.crests is None
    assert desk.unchanged()
