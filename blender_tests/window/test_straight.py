# SPDX-License-Identifier: GPL-3.0-or-later
"""Straight in View: across the surface the wire that is straight on the screen leads, and the wheel goes on to the others."""

import math
from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import ui as driver
from bpy_extras.view3d_utils import location_3d_to_region_2d
from desk import ORANGE, Desk, leave, shows
from mathutils import Vector
from scene import add_object, seams
from seamwire.core.network.wires import Wire
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited

SIDE = 33
START, END, THIRD = 4 * SIDE + 5, 26 * SIDE + 27, 27 * SIDE + 8


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    """A sheet with a hill, moved and stretched, seen in perspective from above."""
    points = [
        (x, y, 0.7 * math.exp(-4.0 * (x * x + y * y)) + 0.04 * math.sin(9.0 * x))
        for y in np.linspace(-1.0, 1.0, SIDE).tolist()
        for x in np.linspace(-1.0, 1.0, SIDE).tolist()
    ]
    faces = [
        (a, a + 1, a + SIDE + 1, a + SIDE) for row in range(SIDE - 1) for a in range(row * SIDE, row * SIDE + SIDE - 1)
    ]
    obj = add_object(points, faces)
    obj.location, obj.scale = (0.1, -0.05, 0.2), (1.1, 0.9, 1.3)
    bpy.context.view_layer.update()
    made = Desk(ui, obj)
    ui.view.view_perspective = "PERSP"
    settings().along = "SURFACE"
    settings().straight = True
    yield made
    leave(ui)


def bend_on_screen(desk: Desk, wire: Wire) -> float:
    """Return how many pixels a wire is off the straight line between its ends, as it is seen."""
    ui, matrix = desk.ui, desk.obj.matrix_world
    places = wire.points @ edited.front.mesh.arrays.to_object.T
    seen = np.array([location_3d_to_region_2d(ui.region, ui.view, matrix @ Vector(place)) for place in places])
    along = seen[-1] - seen[0]
    normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
    return float(np.abs((seen - seen[0]) @ normal).max())


def aim(desk: Desk) -> None:
    """Place a seed, and point at another vertex."""
    desk.ui.click(desk.at(START))
    desk.ui.move(desk.at(END))
    desk.ui.wait_until(lambda: not desk.session.computing and desk.session.picture.active is not None)


@pytest.mark.smoke
def test_it_is_straight_on_the_screen_and_a_click_keeps_it(desk: Desk) -> None:
    ui = desk.ui
    desk.choose()
    aim(desk)
    session = desk.session
    assert session.picture.choice.straight
    assert bend_on_screen(desk, session.picture.active) < 0.05
    middle = 0.5 * (np.array(desk.at(START)) + desk.at(END))
    assert shows(ui.pixels(), tuple(middle.tolist()), ORANGE)
    assert bend_on_screen(desk, session.picture.others[0]) > 3.0
    ui.click(desk.at(END))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert bend_on_screen(desk, session.wires[0]) < 0.05
    ui.click(desk.at(END), button="RIGHTMOUSE")
    ui.wait_until(lambda: not desk.running)
    assert len(seams(desk.obj)) == len(session.wires[0].edges())


def test_the_key_that_closes_a_chain_closes_it_straight(desk: Desk) -> None:
    ui = desk.ui
    desk.choose()
    aim(desk)
    session = desk.session
    ui.click(desk.at(END))
    ui.click(desk.at(THIRD))
    ui.wait_until(lambda: len(session.wires) == 2)
    ui.key("C")
    ui.wait_until(lambda: len(session.wires) == 3)
    assert bend_on_screen(desk, session.wires[2]) < 0.05
