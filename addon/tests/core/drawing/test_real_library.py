# SPDX-License-Identifier: GPL-3.0-or-later
"""A session with the library's own live wires."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_edges, grid_triangles
from numpy.typing import NDArray
from paper_mesh import PaperMesh
from real_sessions import session_on
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from seamwire.terms.options import Options
from setting import stronger, use

SIZE = 21


def ridge() -> NDArray[np.float64]:
    """Return a grid with a ridge along y, over x = 0; vertex y * SIZE + x."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, SIZE), np.linspace(-1.0, 1.0, SIZE))
    return np.stack([x.ravel(), y.ravel(), np.exp(-20.0 * x.ravel() ** 2)], axis=1)


def at(x: int, y: int) -> int:
    """Return the vertex `x` and `y` steps from the middle."""
    return (y + SIZE // 2) * SIZE + x + SIZE // 2


def draw(along: Along = "EDGES") -> Sketch:
    """Return a session on the ridge."""
    return session_on(ridge(), grid_triangles(SIZE), grid_edges(SIZE), options=Options(along=along))


def click(session: Sketch, *picks: object) -> None:
    for pick in picks:
        session.click(pick)
        session.wait()


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_another_strength_keeps_the_surface_and_its_curvatures(along: Along) -> None:
    session = draw(along)
    click(session, at(0, -8))
    surface = session.engines.get(along).surface
    strength = session.feature_strength()
    for steps in (1, -2):
        assert stronger(session, steps)
        assert np.shares_memory(session.feature_strength(), strength)
        session.wait()
        assert np.shares_memory(session.feature_strength(), strength)
        assert np.shares_memory(session.engines.get(along).surface.points, surface.points)


def test_a_dragged_seed_leads_its_wires() -> None:
    session = draw()
    click(session, at(-6, -6), at(0, 0), at(6, 6))
    before = session.edges_to_mark()
    assert session.drag(at(0, 0))
    session.drag_to(at(0, 2))
    session.wait()
    assert all(at(0, 2) in wire.vertices for wire in session.holds(Dragging).moved)
    assert session.holds(Dragging).moved[0].vertices[-1] == session.holds(Dragging).moved[1].vertices[0] == at(0, 2)
    assert session.drag_end()
    session.wait()
    assert session.seeds() == [at(-6, -6), at(0, 2), at(6, 6)]
    assert session.wires[1].heading == session.wires[0].last_edge
    for wire in session.wires:
        assert len(set(wire.vertices)) == len(wire.vertices)
    session.undo()
    assert session.edges_to_mark() == before


def test_an_edge_seed_is_passed_in_one_direction_wherever_it_is_dragged() -> None:
    session = draw()
    click(session, at(-8, 0), (at(0, 0), at(1, 0)), at(8, 0))
    session.drag((at(0, 0), at(1, 0)))
    for y in range(-4, 5):
        for edge in ((at(0, y), at(1, y)), (at(1, y), at(0, y)), (at(0, y), at(0, y + 1))):
            session.drag_to(edge)
            session.wait()
            one, two = session.wires
            assert one.vertices[-1] == two.vertices[0]
            assert set(one.last_edge) == set(edge)
            assert not set(one.edges()) & set(two.edges())


def test_across_the_surface_curves_follow_the_dragged_seed() -> None:
    session = draw("SURFACE")
    click(session, at(-6, -6), at(0, 0), at(6, 6))
    session.drag(at(0, 0))
    session.drag_to(at(2, -2))
    session.wait()
    session.drag_end()
    first, second = session.wires
    assert np.allclose(first.points[-1], ridge()[at(2, -2)])
    assert np.allclose(second.points[0], ridge()[at(2, -2)])
    assert np.allclose(second.points[-1], ridge()[at(6, 6)])


def test_wires_of_the_library_come_back_from_the_mesh_and_can_be_dragged() -> None:
    session = draw()
    mesh = PaperMesh(ridge(), grid_edges(SIZE))
    click(session, at(0, -8), at(0, 8))
    use(session, along="SURFACE")
    session.start(at(-6, -6))
    click(session, at(7, -4))
    mesh.write(session, adopt=True)
    mesh.hide((at(0, 0), at(0, 1)))
    again = draw()
    mesh.open(again)
    assert [wire.along for wire in again.wires] == ["SURFACE"], "the other one is not there while it is hidden"
    assert again.wires[0].vertices == session.wires[1].vertices
    assert np.allclose(again.wires[0].points, session.wires[1].points, atol=1e-5)
    assert len(again.wires[0].faces) == len(again.wires[0].points) - 1
    assert np.array_equal(again.wires[0].faces, session.wires[1].faces)
    mesh.hidden.clear()
    mesh.open(again)
    assert sorted(wire.vertices for wire in again.wires) == sorted(wire.vertices for wire in session.wires)
    assert again.drag(at(0, 8))
    again.drag_to(at(2, 8))
    again.wait()
    assert again.drag_end()
    assert at(2, 8) in again.seeds()
    mesh.write(again)
    assert mesh.seams == set(again.edges_to_mark())
