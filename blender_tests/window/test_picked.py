# SPDX-License-Identifier: GPL-3.0-or-later
"""What clicks take beside what lies plainly under the cursor: through the mesh, features, seams; and meshes that changed."""

from collections.abc import Iterator
from types import SimpleNamespace

import bmesh
import pytest
import ui as driver
from desk import ORANGE, Desk, leave, shows
from scene import add_grid, add_object, chain, seams
from seamwire.core.drawing.picture import Role
from seamwire.core.solver.solver import kinds_of
from seamwire.operators.chain_state import running
from seamwire.ui import status_bar
from seamwire.view.edited_objects import edited


def said() -> str:
    return "; ".join(text for _, text in status_bar.hints(status_bar.status_of(running[0])))


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
    assert (
        max(
            session.cursor.target.pick
            if isinstance(session.cursor.target.pick, tuple)
            else [session.cursor.target.pick]
        )
        < 81
    )
    ui.key("V")
    ui.move(layers.at(82))
    ui.move(layers.at(81))
    assert session.cursor.target.pick == 81
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
    ui.wait_until(lambda: session.drawing.feature_strength() is not None)
    x, y = roof.at(40)
    beside, above = (x + 7.0, y + 1.0), (roof.at(67)[0] + 7.0, roof.at(67)[1] + 1.0)
    ui.move(beside)
    assert session.cursor.target.pick != 40
    ui.key("TAB", shift=True)
    ui.move((beside[0] + 1.0, beside[1]))
    assert (session.cursor.target.pick, session.cursor.target.to) == (40, "FEATURE")
    ui.click(beside)
    ui.click(above)
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(roof.obj) == chain(40, 49, 58, 67)


def test_wires_end_on_seams_that_are_there(desk: Desk) -> None:
    bm = bmesh.from_edit_mesh(desk.obj.data)
    bm.verts.ensure_lookup_table()
    for one, two in chain(*range(36, 45)):
        bm.edges.get((bm.verts[one], bm.verts[two])).seam = True
    bmesh.update_edit_mesh(desk.obj.data)
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(4))
    ui.move(desk.at(40))
    assert session.cursor.target.to == "SEAM"
    ui.wait_until(lambda: session.picture.active is not None and session.picture.one(Role.COMPUTING) is None)
    assert "Join" in said()
    ui.click(desk.at(40))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert not desk.running, "the chain has ended there"
    assert seams(desk.obj) == sorted(chain(*range(36, 45)) + chain(4, 13, 22, 31, 40))


def test_mirrored_wires_are_drawn_live(desk: Desk) -> None:
    desk.obj.data.use_mirror_x = True
    session, ui = desk.start(), desk.ui
    assert session.options.mirror == (0,)
    ui.click(desk.at(9))
    ui.move(desk.at(12))
    ui.wait_until(lambda: session.picture.active is not None)
    pixels, there = ui.pixels(), desk.at(15, 16)
    assert not shows(pixels, desk.at(24, 25), ORANGE)
    around = pixels[round(there[1]) - 3 : round(there[1]) + 4, round(there[0]), :3]
    assert (around[:, 0] - around[:, 2]).max() > 0.2, "its image, in the live wire's color"
    ui.click(desk.at(12))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(desk.obj) == sorted(chain(9, 10, 11, 12) + chain(14, 15, 16, 17))


@pytest.mark.every_blender
def test_with_the_mirror_on_its_plane_is_hit_from_the_side(cone: Desk) -> None:
    """The plane lies on the silhouette there, and the next vertices are seen but a few pixels from it."""
    ui, mesh = cone.ui, cone.obj.data
    ui.look((0.5, 0.5, 0.5, 0.5), (0.0, 0.0, 0.5), 9.0)  # from the right: y to the right, z up
    session = cone.choose()
    x, y = beside = cone.at(41)
    assert 2.0 < cone.at(40)[1] - y < 9.0
    ui.move(beside)
    assert session.cursor.target.pick == 41
    mesh.use_mirror_x = True
    ui.wait_until(lambda: edited.front.mesh.symmetric is not None)
    for there in ((x + 1.0, y), beside):
        ui.move(there)
    assert session.cursor.target.pick == 40
    ui.click(beside)
    assert session.seed == 40
    ui.click(cone.at(59))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(cone.obj) == chain(40, 49, 58), "along the plane, with no gap"


def test_escape_ends_work_that_takes_long(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = desk.start(), desk.ui
    ui.click(desk.at(36))
    ui.wait_until(lambda: not session.under_way.computing)
    engine = session.drawing.engines.get(session.options.along)
    wires = [
        SimpleNamespace(follow=kind, points=[], vertices=[], length=0.0, final=False) for kind in kinds_of("feature")
    ]
    answer = SimpleNamespace(wires=wires, active=0, settled=False, solved=False, final=False)

    class Endless:
        """Live wires that are never ready."""

        def __getattr__(self, name: str) -> object:
            return getattr(engine, name)

        def progress(self) -> float:
            return 0.25

        def wires(self, _target: object) -> object:
            return answer

    endless = Endless()
    monkeypatch.setitem(session.drawing.engines._lives, "EDGES", endless)
    ui.click(desk.at(44))
    assert session.under_way.waiting == 1
    assert "Computing 25 %, 1 click waiting" in said()
    ui.key("ESC")
    assert session.under_way.waiting == 0, "the click that waited is forgotten"
    assert desk.left_clean()
    assert desk.unchanged()
