# SPDX-License-Identifier: GPL-3.0-or-later
"""What clicks take beside what lies plainly under the cursor: through the mesh, features, seams; and meshes that changed."""

from collections.abc import Iterator

import pytest
import ui as driver
from desk import ORANGE, Desk, leave, shows
from scene import add_grid, add_object, chain, seams
from seamwire.core.network.picks import vertices_of
from seamwire.view.edited_objects import edited


@pytest.fixture
def layers(ui: driver.Ui) -> Iterator[Desk]:
    """Two sheets, one of 81 vertices and below it one of 16, whose rows lie under the middles of the upper one's faces."""
    top = [(0.25 * x - 1.0, 0.25 * y - 1.0, 0.0) for y in range(9) for x in range(9)]
    low = [(0.5 * x - 0.875, 0.5 * y - 0.875, -1.0) for y in range(4) for x in range(4)]
    faces = [(y * 9 + x, y * 9 + x + 1, y * 9 + x + 10, y * 9 + x + 9) for y in range(8) for x in range(8)]
    faces += [(81 + y * 4 + x, 82 + y * 4 + x, 86 + y * 4 + x, 85 + y * 4 + x) for y in range(3) for x in range(3)]
    desk = Desk(ui, add_object(top + low, faces))
    yield desk
    leave(ui)


@pytest.mark.smoke
def test_v_lets_wires_be_drawn_on_the_far_side(layers: Desk) -> None:
    session, ui = layers.start(), layers.ui
    ui.move(layers.at(81))
    assert max(vertices_of(session.target.pick)) < 81
    ui.key("V")
    assert session.target.pick == 81, "without a motion of the mouse"
    ui.click(layers.at(81))
    ui.move(layers.at(84))
    ui.wait_until(lambda: session.picture.active is not None)
    assert shows(ui.pixels(), layers.at(82, 83), ORANGE), "seen through the upper sheet"
    ui.click(layers.at(84))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(layers.obj) == chain(81, 82, 83, 84)


@pytest.fixture
def roof(ui: driver.Ui) -> Iterator[Desk]:
    """A grid with a ridge along its middle column."""
    obj = add_grid(9)
    for v in obj.data.vertices:
        v.co.z = -abs(v.co.x)
    desk = Desk(ui, obj)
    ui.look_from_top(distance=9.0)
    yield desk
    leave(ui)


@pytest.mark.smoke
def test_snapping_takes_the_feature_near_the_cursor(roof: Desk) -> None:
    session, ui = roof.start(), roof.ui
    ui.wait_until(lambda: session.feature_strength() is not None)
    x, y = roof.at(40)
    beside, above = (x + 7.0, y + 1.0), (roof.at(67)[0] + 7.0, roof.at(67)[1] + 1.0)
    ui.move(beside)
    assert session.target.pick != 40
    ui.key("TAB", shift=True)
    ui.move((beside[0] + 1.0, beside[1]))
    assert (session.target.pick, session.target.to) == (40, "FEATURE")
    ui.click(beside)
    ui.click(above)
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(roof.obj) == chain(40, 49, 58, 67)


@pytest.mark.every_blender
def test_with_the_mirror_on_its_plane_is_hit_from_the_side(cone: Desk) -> None:
    """The plane lies on the silhouette there, and the next vertices are seen but a few pixels from it."""
    ui, mesh = cone.ui, cone.obj.data
    ui.look((0.5, 0.5, 0.5, 0.5), (0.0, 0.0, 0.5), 9.0)  # from the right: y to the right, z up
    session = cone.choose()
    x, y = beside = cone.at(41)
    assert 2.0 < cone.at(40)[1] - y < 9.0
    ui.move(beside)
    assert session.target.pick == 41
    mesh.use_mirror_x = True
    ui.wait_until(lambda: edited.front.mesh.symmetric is not None)
    for there in ((x + 1.0, y), beside):
        ui.move(there)
    assert session.target.pick == 40
    ui.click(beside)
    assert session.seed == 40
    ui.click(cone.at(59))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(cone.obj) == chain(40, 49, 58), "along the plane, with no gap"
