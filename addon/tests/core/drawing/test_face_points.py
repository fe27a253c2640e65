# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds inside triangles, with the library's own live wires: a square of two by two quads, where the ways are known."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import FacePoint, place_of
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.storage.serialization import Places, wire_record
from seamwire.terms.options import Options
from setting import use

core = pytest.importorskip("seamwire_core")

SIZE = 3
POINTS = grid_points(SIZE)
TRIANGLES = grid_triangles(SIZE)


def session(finish: str = "CUT") -> Sketch:
    """Return a session across the surface, by the shortest path."""
    surface = core.Surface(POINTS, TRIANGLES, grid_edges(SIZE))

    def make(way: str) -> object:
        return core.LiveWire(surface, along=way.lower(), metric="euclidean")

    made = Sketch(make, POINTS, Options(along="SURFACE"), edges=grid_edges(SIZE), triangles=TRIANGLES)
    use(made, finish=finish)
    return made


def at(x: float, y: float) -> FacePoint:
    """Return a point of the square."""
    square = int(y) * (SIZE - 1) + int(x)
    lower = (y % 1.0) <= (x % 1.0)
    return FacePoint.at(np.array([x, y, 0.0]), 2 * square + (not lower), TRIANGLES, POINTS)


def click(on: Sketch, *picks: object) -> None:
    for pick in picks:
        assert on.click(pick), on.told
        on.wait()


def ends(on: Sketch) -> list[tuple[list[float], list[float]]]:
    return [(wire.points[0][:2].round(9).tolist(), wire.points[-1][:2].round(9).tolist()) for wire in on.wires]


def test_wires_lead_straight_from_point_to_point() -> None:
    on = session()
    one, two, three = at(0.3, 0.2), at(1.7, 0.9), at(0.2, 1.8)
    click(on, one, two, three)
    assert ends(on) == [([0.3, 0.2], [1.7, 0.9]), ([1.7, 0.9], [0.2, 1.8])]
    for wire in on.wires:
        length = np.linalg.norm(np.diff(wire.points, axis=0), axis=1).sum()
        assert length == pytest.approx(np.linalg.norm(wire.points[-1] - wire.points[0]))
    assert [(wire.start, wire.end) for wire in on.wires] == [(one, two), (two, three)]
    assert on.seeds() == [one, two, three]
    assert on.wires[0].vertices[0] == 0 and on.wires[0].vertices[-1] == on.wires[1].vertices[0] == 5
    assert on.undo() and on.undo() and on.redo()
    assert on.seeds() == [one, two]


def test_a_chain_closes_at_the_point_where_it_began() -> None:
    on = session()
    click(on, at(0.3, 0.2), at(1.7, 0.2), at(1.0, 1.7))
    assert on.close()
    on.wait()
    assert ends(on)[-1] == ([1.0, 1.7], [0.3, 0.2])
    assert on.seed is None


def test_within_one_face_a_wire_marks_nothing_and_is_there() -> None:
    on = session()
    click(on, at(0.3, 0.1), at(0.4, 0.3))
    assert ends(on) == [([0.3, 0.1], [0.4, 0.3])]
    assert on.edges_to_mark() == []
    assert on.wires[0].vertices == (0,)
    click(on, at(1.6, 1.8))
    assert on.drawn.find(on.wires[0]) is not None
    assert on.drop(on.wires[0])


def test_where_it_is_not_to_be_cut_a_wire_that_meets_no_edge_is_not_kept() -> None:
    on = session("SNAP")
    one = at(0.3, 0.1)
    click(on, one)
    on.hover(0)
    on.wait()
    assert not on.click(0)
    assert "Too short to become a seam" in on.told
    assert on.wires == () and on.seed == one
    click(on, 2)
    on.end_chain()
    assert on.drag(2)
    on.drag_to(0)
    on.wait()
    assert on.drag_end()
    assert on.wires == (), "the mesh would not know of it"
    assert "A wire was removed" in on.told
    assert on.undo()
    assert on.told == ""
    assert [wire.vertices for wire in on.wires] == [(0, 1, 2)]


def test_along_edges_a_point_is_its_nearest_vertex() -> None:
    on = session()
    point = at(0.9, 0.8)
    click(on, 2, point)
    assert use(on, along="EDGES")
    on.hover(6)
    on.wait()
    assert on.picture.active is not None and on.picture.active.vertices[0] == point.vertex == 4
    click(on, 6)
    assert on.wires[-1].vertices[0] == on.wires[0].vertices[-1]
    use(on, along="SURFACE")
    on.start(8)
    use(on, along="EDGES")
    assert on.click(Snap(point, "SEED"))
    on.wait()
    assert on.wires[-1].vertices[-1] == 4


def test_over_a_mirror_a_wire_without_edges_has_its_image() -> None:
    centred = POINTS - (1.0, 1.0, 0.0)
    surface = core.Surface(centred, TRIANGLES, grid_edges(SIZE))
    on = Sketch(
        lambda way: core.LiveWire(surface, along=way.lower(), metric="euclidean"),
        centred,
        Options(along="SURFACE"),
        edges=grid_edges(SIZE),
        triangles=TRIANGLES,
    )
    use(on, finish="CUT")
    use(on, mirror=[0])
    click(on, *(FacePoint.at(np.array([x, y, 0.0]), 0, TRIANGLES, centred) for x, y in ((-0.7, -0.9), (-0.6, -0.7))))
    (image,) = on.mirrored(on.wires[0])
    assert image.vertices == (2,)
    assert image.points[:, 0] == pytest.approx(-on.wires[0].points[:, 0])


def test_what_is_stored_of_a_point_is_its_vertex() -> None:
    on = session()
    click(on, at(0.3, 0.2), at(1.7, 0.9))
    record = wire_record(on.wires[0], Places(POINTS, np.eye(3)))
    assert (record["start"], record["end"]) == (0, 5)


@pytest.mark.parametrize("corner", [(0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (1.5, 0.0, 0.0)])
def test_a_triangle_without_area_has_points_too(corner: tuple[float, float, float]) -> None:
    points = np.array([(0, 0, 0), (1, 0, 0), corner], dtype=float)
    point = FacePoint.at(np.array([0.7, 0.1, 0.0]), 0, np.array([(0, 1, 2)], dtype=np.int32), points)
    assert sum(point.weights) == pytest.approx(1.0)
    assert place_of(point, points) == pytest.approx([0.7, 0.0, 0.0])
