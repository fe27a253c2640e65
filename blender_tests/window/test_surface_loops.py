# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface: Alt over a point shows what a click takes, the wheel and W go through the best three."""

import math
from collections import Counter
from collections.abc import Iterator

import numpy as np
import pytest
import ui as driver
from desk import Desk, leave, said
from scene import add_object, seams
from seamwire.core.base.geometry import nearest_on_segments
from seamwire.core.sketch.picture import Role
from seamwire.mesh.settings import settings

AROUND, ROWS = 24, 41


def limb(ui: driver.Ui) -> Desk:
    """A closed rod along y with a waist in its middle, seen from above; vertex row * AROUND + 0 is on top of a row."""
    points, faces = [], []
    for row in range(ROWS):
        y = -1.0 + 2.0 * row / (ROWS - 1)
        radius = 0.3 - 0.1 * math.exp(-((y / 0.25) ** 2))
        for i in range(AROUND):
            angle = 2.0 * math.pi * i / AROUND
            points.append((radius * math.sin(angle), y, radius * math.cos(angle)))
    for row in range(ROWS - 1):
        for i in range(AROUND):
            a, b = row * AROUND + i, row * AROUND + (i + 1) % AROUND
            faces.append((a, a + AROUND, b + AROUND, b))
    points += [(0.0, -1.15, 0.0), (0.0, 1.15, 0.0)]
    last = (ROWS - 1) * AROUND
    for i in range(AROUND):
        j = (i + 1) % AROUND
        faces += [(i, j, len(points) - 2), (last + j, last + i, len(points) - 1)]
    return Desk(ui, add_object(points, faces))


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    made = limb(ui)
    settings().along = "SURFACE"
    yield made
    leave(ui)


WAIST = 20 * AROUND


def offer(desk: Desk, vertex: int) -> tuple[float, float]:
    """With the tool chosen, point at a vertex and hold Alt; return where that is."""
    desk.choose()
    place = desk.at(vertex)
    desk.ui.move(place)
    desk.ui.event("LEFT_ALT", "PRESS", place, alt=True)
    desk.ui.wait_until(lambda: not desk.session.computing)
    return place


@pytest.mark.smoke
@pytest.mark.every_blender
def test_shift_alt_shows_the_cut_bent_to_the_cursor_and_a_click_keeps_it_in_its_place(desk: Desk) -> None:
    ui = desk.ui
    place = offer(desk, WAIST)
    ui.click(place, alt=True)
    assert not desk.running
    straight = seams(desk.obj)
    second = WAIST + 6 * AROUND + 3
    away = desk.at(second)
    ui.event("LEFT_SHIFT", "PRESS", away, alt=True, shift=True)
    ui.event("MOUSEMOVE", "NOTHING", away, alt=True, shift=True)
    session = desk.session
    ui.wait_until(lambda: session.picture.one(Role.OFFER) is not None and not session.computing)
    assert session.picture.offered.bends
    assert "Bend Closed Cut" in said()
    assert len(session.wires) == 3, "until the click"
    ui.click(away, alt=True, shift=True)
    assert len(session.wires) == 4
    assert set(session.seeds()) >= {WAIST, second}
    ui.event("LEFT_SHIFT", "RELEASE", away, alt=True)
    ui.event("LEFT_ALT", "RELEASE", away)
    assert desk.left_clean()
    bent = seams(desk.obj)
    assert any(second in edge for edge in bent)
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == straight, "a step of Blender's undo brings back the cut as it was"
    ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []


SECONDS = (WAIST + 6 * AROUND + 3, WAIST - 4 * AROUND + 2)


def bend(desk: Desk, vertex: int) -> np.ndarray:
    """Bend the cut taken last to a vertex; return how it was shown."""
    ui, away = desk.ui, desk.at(vertex)
    ui.move(away)
    ui.event("LEFT_ALT", "PRESS", away, alt=True)
    ui.event("LEFT_SHIFT", "PRESS", away, alt=True, shift=True)
    ui.event("MOUSEMOVE", "NOTHING", away, alt=True, shift=True)
    ui.wait_until(lambda: desk.session.picture.one(Role.OFFER) is not None and not desk.session.computing)
    assert desk.session.picture.offered.bends
    shown = desk.session.picture.one(Role.OFFER).points
    ui.click(away, alt=True, shift=True)
    ui.event("LEFT_SHIFT", "RELEASE", away, alt=True)
    ui.event("LEFT_ALT", "RELEASE", away)
    assert desk.left_clean()
    return shown


def courses_when_bent(desk: Desk, finish: str) -> list[np.ndarray]:
    """Take a cut at the waist and bend it twice; return how it was shown bent."""
    settings().finish = finish
    place = offer(desk, WAIST)
    desk.ui.click(place, alt=True)
    desk.ui.event("LEFT_ALT", "RELEASE", place)
    assert desk.left_clean()
    return [bend(desk, second) for second in SECONDS]


def is_closed(marked: list[tuple[int, int]]) -> bool:
    return bool(marked) and set(Counter(v for edge in marked for v in edge).values()) == {2}


@pytest.mark.parametrize("finish", ["CUT", "SLIDE"])
def test_what_was_cut_into_the_faces_or_slid_is_bent_as_on_the_mesh_before(desk: Desk, finish: str) -> None:
    ui = desk.ui
    places = [np.array(vertex.co) for vertex in desk.obj.data.vertices]
    plain = courses_when_bent(desk, "SNAP")
    for _ in range(3):
        ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []
    settings().finish = finish
    place = offer(desk, WAIST)
    ui.click(place, alt=True)
    ui.event("LEFT_ALT", "RELEASE", place)
    marked = [seams(desk.obj)]
    for second, course in zip(SECONDS, plain, strict=True):
        shown = bend(desk, second)
        gaps = [nearest_on_segments(one, course[:-1], course[1:])[1].min() for one in shown]
        assert max(gaps) < 0.02, "around the same limb, through the same points"
        marked.append(seams(desk.obj))
        assert is_closed(marked[-1]) or finish == "SLIDE", "nothing of the cut before is left"
        desk.obj.update_from_editmode()
        ends = np.array([desk.obj.data.vertices[v].co for edge in marked[-1] for v in edge])
        for vertex in (WAIST, second):
            assert np.linalg.norm(ends - places[vertex], axis=1).min() < 0.03
    for before in reversed(marked[:-1]):
        ui.key("Z", ctrl=True)
        assert seams(desk.obj) == before
    bend(desk, SECONDS[1])
    assert seams(desk.obj) not in [[], marked[0]], "what undo brought back is bent elsewhere"


def test_after_undo_and_redo_of_three_cuts_the_last_one_is_bent(desk: Desk) -> None:
    """The cuts beside the waist lie where the shape suggests little: on a mesh that was cut others are found there."""
    settings().finish = "CUT"
    ui = desk.ui
    marked = []

    def others() -> list[tuple[float, ...]]:
        """Return where the seams of the first two cuts are."""
        obj = desk.obj
        obj.update_from_editmode()
        places = {tuple(round(x, 5) for x in obj.data.vertices[v].co) for edge in seams(obj) for v in edge}
        return sorted(place for place in places if place[1] < 0.1)

    for row in (20, 10, 30):
        place = offer(desk, row * AROUND)
        ui.click(place, alt=True)
        ui.event("LEFT_ALT", "RELEASE", place)
        assert desk.left_clean()
        marked.append(seams(desk.obj))
    for _ in range(3):
        ui.key("Z", ctrl=True)
    assert seams(desk.obj) == []
    for expected in marked:
        ui.key("Z", ctrl=True, shift=True)
        assert seams(desk.obj) == expected
    before, second = others(), 33 * AROUND + 3
    place = np.array(desk.obj.data.vertices[second].co)
    bend(desk, second)
    bent = seams(desk.obj)
    assert is_closed(bent)
    assert others() == before
    ends = np.array([desk.obj.data.vertices[v].co for edge in bent for v in edge])
    assert np.linalg.norm(ends - place, axis=1).min() < 0.03
