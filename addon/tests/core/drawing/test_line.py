# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines drawn by dragging, and the wires that are kept of them."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from real_sessions import session_on
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import FacePoint, undirected
from seamwire.core.sketch.picture import Intent, Role
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from seamwire.terms.options import Options
from setting import end_line, stronger, use
from table import Table

core = pytest.importorskip("seamwire_core")

SIZE = 16


def at(x: int, y: int) -> int:
    return y * SIZE + x


def hills() -> NDArray[np.float64]:
    points = grid_points(SIZE)
    points[:, 2] = 0.3 * np.cos(points[:, 0]) * np.sin(points[:, 1])
    return points


def session(along: Along = "EDGES", seams: object = (), **options: object) -> Sketch:
    made = session_on(
        hills(), grid_triangles(SIZE), grid_edges(SIZE), options=Options(along=along), seams=seams, **options
    )
    made.wait()
    return made


def on_surface(places: NDArray[np.float64], size: int = SIZE) -> NDArray[np.int32]:
    """Return the triangles below places of the grid, (k, 2)."""
    column, row = np.clip(places.astype(int), 0, size - 2).T
    inside = places - np.stack([column, row], 1)
    return (2 * (row * (size - 1) + column) + (inside[:, 1] > inside[:, 0])).astype(np.int32)


def line(*corners: tuple[float, float], wobble: float = 0.0, step: float = 0.15) -> tuple[NDArray, NDArray]:
    """Return points from corner to corner in x and y, and their triangles."""
    random = np.random.default_rng(0)
    places = []
    for start, end in itertools.pairwise(np.array(corners, dtype=float)):
        count = max(1, int(np.linalg.norm(end - start) / step))
        places += [start + (end - start) * part / count for part in range(count)]
    flat = np.array([*places, corners[-1]]) + random.uniform(-wobble, wobble, (len(places) + 1, 2))
    flat = np.clip(flat, 0.0, SIZE - 1.0)
    faces = on_surface(flat)
    points = hills()
    corner = grid_triangles(SIZE)[faces]
    weights = np.stack([_weights(place, points[three][:, :2]) for place, three in zip(flat, corner, strict=True)])
    return np.einsum("ij,ijk->ik", weights, points[corner]), faces


def _weights(place: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    v, w = np.linalg.solve((corners[1:] - corners[0]).T, place - corners[0])
    return np.array([1.0 - v - w, v, w])


def draw(
    drawing: Sketch, begin: Snap | int, drawn: tuple[NDArray, NDArray], end: Snap | int | None = None, moves: int = 5
) -> None:
    """Press, move the mouse so often, release, and wait."""
    drawing.line_begin(begin)
    points, faces = drawn
    for move in range(1, moves + 1):
        count = max(2, len(points) * move // moves)
        drawing.line_to(points[:count], faces[:count], end if move == moves else None)
    end_line(drawing)
    drawing.wait()


ROW = tuple(at(x, 5) for x in range(2, 10))
HOOK = (*ROW, *(at(9, y) for y in range(6, 11)))


def chain_of(drawing: Sketch) -> list[int]:
    """Return the vertices of all wires, which go on from each other."""
    chain: list[int] = [drawing.wires[0].vertices[0]]
    for wire in drawing.wires:
        assert wire.vertices[0] == chain[-1]
        chain += wire.vertices[1:]
    return chain


def test_a_line_is_kept_as_wires_along_its_edges_in_one_step() -> None:
    drawing = session()
    drawing.line_begin(ROW[0])
    assert drawing.picture.intent is Intent.DRAW
    points, faces = line((2, 5), (9, 5), (9, 10), wobble=0.2)
    half = len(points) // 2
    drawing.line_to(points[:half], faces[:half], None)
    shown = [wire.vertices for wire in drawing.picture.all(Role.FOLLOWING)]
    assert shown == [HOOK[: len(shown[0])]]
    assert 4 <= len(shown[0]) <= 8
    assert drawing.wires == ()
    np.testing.assert_array_equal(drawing.picture.line, points[:half])
    drawing.line_to(points, faces, None)
    assert [wire.vertices for wire in drawing.picture.all(Role.FOLLOWING)] == [HOOK]
    assert end_line(drawing)
    drawing.wait()
    assert chain_of(drawing) == list(HOOK)
    assert drawing.seed is None, "a line is a chain of its own"
    assert not drawing.is_held
    assert drawing.picture.all(Role.FOLLOWING) == ()
    assert drawing.undo()
    assert drawing.wires == ()
    assert not drawing.picture.can_undo
    assert drawing.redo()
    assert chain_of(drawing) == list(HOOK)


def test_its_wires_run_as_those_between_their_seeds_do() -> None:
    drawing = session()
    draw(drawing, ROW[0], line((2, 5), (9, 5), (9, 10)))
    assert 1 <= len(drawing.wires) <= 3
    before = {wire.id: wire.vertices for wire in drawing.wires}
    for wire in drawing.wires:
        # A seed that is moved away and back brings the same wires.
        assert drawing.drag(Snap(wire.end, "SEED"))
        drawing.drag_to(Snap(at(12, 12)))
        drawing.wait()
        drawing.drag_to(Snap(wire.end))
        drawing.wait()
        assert {own.id: own.vertices for own in drawing.wires} == before
        drawing.cancel()


def test_a_line_that_is_cancelled_leaves_all_as_it_was() -> None:
    drawing = session()
    drawing.click(at(1, 1))
    drawing.click(at(4, 1))
    drawing.wait()
    network = drawing.network
    drawing.line_begin(at(3, 7))
    drawing.line_to(*line((3, 7), (9, 7)), None)
    assert drawing.picture.all(Role.FOLLOWING)
    assert drawing.cancel()
    assert drawing.network == network
    assert drawing.picture.all(Role.FOLLOWING) == ()
    assert not drawing.cancel()
    assert not end_line(drawing)
    assert not drawing.line_to(*line((3, 7), (9, 7)), None)
    assert drawing.network == network


def test_a_line_begun_elsewhere_ends_the_chain_and_one_begun_at_its_seed_goes_on_with_it() -> None:
    drawing = session()
    for pick in (at(1, 1), at(4, 1)):
        drawing.click(pick)
        drawing.wait()
    assert drawing.goes_on_from(Snap(at(4, 1), "SEED"))
    assert not drawing.goes_on_from(Snap(at(1, 1), "SEED"))
    draw(drawing, Snap(at(4, 1), "SEED"), line((4, 1), (9, 1)))
    assert chain_of(drawing) == [at(x, 1) for x in range(1, 10)]
    assert drawing.seed is not None
    assert drawing.seed_place == at(9, 1)
    assert drawing.wires[1].heading == (at(3, 1), at(4, 1)), "its first wire goes on from the one before"
    drawing.click(at(9, 4))
    drawing.wait()
    assert chain_of(drawing)[-1] == at(9, 4)
    draw(drawing, at(2, 8), line((2, 8), (6, 8)))
    assert drawing.seed is None
    assert drawing.wires[-1].vertices[-1] == at(6, 8)


def test_a_line_from_a_chain_ends_it_on_a_seam_or_where_it_began() -> None:
    drawing = session(seams=[(at(9, y), at(9, y + 1)) for y in range(4)])
    drawing.click(at(4, 1))
    draw(drawing, Snap(at(4, 1), "SEED"), line((4, 1), (9, 1)), Snap((at(9, 1), at(9, 2)), "SEAM"))
    assert drawing.wires[-1].vertices[-1] == at(9, 1)
    assert drawing.seed is None
    drawing.click(at(2, 6))
    draw(drawing, Snap(at(2, 6), "SEED"), line((2, 6), (6, 6), (6, 10), (2, 10), (2, 6)))
    assert drawing.seed is None
    edges = {edge for wire in drawing.wires[1:] for edge in wire.edges()}
    assert len(edges) == 16


def test_an_edge_beyond_a_seam_or_a_wire_is_overshoot_and_two_are_not() -> None:
    drawing = session(seams=[(at(9, y), at(9, y + 1)) for y in range(SIZE - 1)])
    draw(drawing, at(4, 2), line((4, 2), (10.2, 2)))
    assert drawing.wires[-1].vertices[-1] == at(9, 2)
    draw(drawing, at(4, 4), line((4, 4), (11.2, 4)))
    assert drawing.wires[-1].vertices[-1] == at(11, 4)
    draw(drawing, at(7, 6), line((7, 6), (9, 6), (9, 9)))
    assert drawing.wires[-1].vertices[-1] == at(9, 9), "along a seam"
    draw(drawing, at(2, 12), line((2, 12), (2, 9)))
    draw(drawing, at(5, 10), line((5, 10), (0.9, 10)))
    assert drawing.wires[-1].vertices[-1] == at(2, 10), "of a wire drawn before"


def test_where_a_line_meets_a_wire_that_gets_a_seed() -> None:
    drawing = session()
    draw(drawing, ROW[0], line((2, 5), (9, 5)))
    kept = drawing.wires[0]
    draw(drawing, at(5, 9), line((5, 9), (5, 5)), Snap((at(5, 5), at(6, 5)), "WIRE", kept))
    assert at(5, 5) in drawing.seeds()
    assert sorted(len(wire.vertices) for wire in drawing.wires) == [4, 5, 5]
    edges = {edge for wire in drawing.wires for edge in wire.edges()}
    assert len(edges) == 11


def test_marking_mirror_and_strength_are_those_of_other_wires() -> None:
    points = hills()
    points[:, 0] -= (SIZE - 1) / 2
    drawing = session()
    use(drawing, clear=not drawing.options.clear)
    stronger(drawing, 2)
    draw(drawing, ROW[0], line((2, 5), (9, 5)))
    assert not drawing.wires[0].marks
    assert drawing.wires[0].strength == drawing.picture.strength
    assert drawing.edges_to_clear() == sorted(undirected(pair) for pair in itertools.pairwise(ROW))


def test_a_line_too_short_says_so_and_is_no_step() -> None:
    drawing = session()
    draw(drawing, ROW[0], line((2, 5), (2.2, 5)))
    assert drawing.wires == ()
    assert "farther" in drawing.told
    assert not drawing.picture.can_undo


def test_a_long_line_stays_as_it_was_but_for_its_end() -> None:
    drawing = session()
    rows = []
    for y in range(0, SIZE, 2):  # 8 rows of 15 edges, up and down beside each other, two edges between: 134
        rows += [(0, y), (SIZE - 1, y)] if y % 4 == 0 else [(SIZE - 1, y), (0, y)]
    back = [(x + 0.0, y) for x, y in ((0, 15), (15, 15))]
    drawn = line(*rows, *back, (15, 13), (1, 13), (1, 11), (14, 11), (14, 9), (1, 9), (1, 7), (14, 7), wobble=0.1)
    drawing.line_begin(at(0, 0))
    points, faces = drawn
    for count in range(2, len(points) + 1, 40):
        drawing.line_to(points[:count], faces[:count], None)
    drawing.line_to(points, faces, None)
    vertices = drawing.picture.all(Role.FOLLOWING)[0].vertices
    assert len(vertices) > 205
    assert vertices[:16] == tuple(range(16))
    assert vertices[-1] == at(14, 7)
    steps = np.abs(np.diff(vertices))
    assert set(steps.tolist()) <= {1, SIZE}


def test_a_line_drawn_before_the_mesh_is_known_is_fitted_when_it_is() -> None:
    table = Table(ready=(False, False))
    drawing = table.session
    drawing.line_begin(0)
    points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])
    drawing.line_to(points, np.zeros(3, dtype=np.int32), None)
    assert drawing.picture.all(Role.FOLLOWING) == ()
    end_line(drawing)
    assert drawing.waiting == 1
    assert drawing.wires == ()
    drawing.wait()
    assert [wire.vertices for wire in drawing.wires] == [(0, 1, 2)]


def test_nothing_waits_for_a_line_that_is_not_computed_yet() -> None:
    table = Table(fork_ready=(False, False))
    drawing = table.session
    three = np.array([0, 2, 4], dtype=np.int32)
    drawing.line_begin(0)
    drawing.line_to(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), three, None)
    end_line(drawing)
    table.lives["EDGES"].fork_ready = (True, True)
    drawing.line_begin(12)
    drawing.line_to(np.array([[0.0, 2, 0], [1, 2, 0], [2, 2, 0]]), three + 20, None)
    end_line(drawing)
    drawing.click(20)
    assert drawing.waiting == 1, "the first line, which is drawn as it was led"
    assert [wire.vertices for wire in drawing.wires] == [(0, 1, 2), (12, 13, 14)]
    drawing.wait()
    assert [wire.vertices for wire in drawing.wires] == [(0, 1, 2), (12, 13, 14)]
    assert drawing.seed == 20


# Across the surface


def apart(points: NDArray[np.float64], curve: NDArray[np.float64]) -> float:
    """Return how far the one of some points is from a curve that is farthest."""
    starts, along = curve[:-1], np.diff(curve, axis=0)
    square = np.maximum((along**2).sum(1), 1e-30)
    part = np.clip(((points[:, None] - starts) * along).sum(2) / square, 0.0, 1.0)
    return float(np.linalg.norm(points[:, None] - starts - part[..., None] * along, axis=2).min(1).max())


@pytest.mark.parametrize("finish", ["SNAP", "CUT"])
def test_across_the_surface_wires_keep_near_to_the_line(finish: str) -> None:
    drawing = session("SURFACE")
    use(drawing, finish=finish)
    points, faces = line((2, 5), (9, 5), (9, 10), (5, 12))
    begin = at(2, 5)
    drawing.line_begin(begin)
    for count in range(8, len(points) + 8, 8):
        drawing.line_to(points[:count], faces[:count], None)
        drawing.poll()
    end_line(drawing)
    drawing.wait()
    wires = drawing.wires
    assert 2 <= len(wires) <= 12
    assert all(one.end == other.start for one, other in itertools.pairwise(wires))
    assert (wires[0].start, wires[0].along, wires[0].finish) == (begin, "SURFACE", finish)
    assert isinstance(wires[-1].end, FacePoint) == (finish == "CUT")
    curve = np.concatenate([wire.points for wire in wires])
    # Half an edge; more where wires end at vertices alone. A little more still, for both are measured at some places only.
    most = 0.55 if finish == "CUT" else 0.9
    assert apart(points, curve) < most
    assert apart(curve, points) < most
    assert drawing.undo()
    assert drawing.wires == ()


def test_across_the_surface_a_line_where_the_live_wire_runs_is_one_wire() -> None:
    drawing = session("SURFACE")
    drawing.click(at(2, 5))
    drawing.hover(at(12, 9))
    drawing.wait()
    drawing.hover(at(12, 9))
    live = drawing.picture.active
    drawing.end_chain()
    steps = np.linspace(0.0, 1.0, 8)[:, None]
    dense = np.concatenate([a + steps * (b - a) for a, b in itertools.pairwise(live.points)])
    draw(drawing, at(2, 5), (dense, on_surface(np.clip(dense[:, :2], 0.0, SIZE - 1.0))), moves=7)
    assert len(drawing.wires) == 1
    assert (drawing.wires[0].start, drawing.wires[0].end) == (at(2, 5), at(12, 9))
    assert drawing.wires[0].like(live)


def test_across_the_surface_lines_end_where_they_are_led_to() -> None:
    drawing = session("SURFACE", seams=[(at(9, y), at(9, y + 1)) for y in range(4)])
    draw(drawing, at(2, 2), line((2, 2), (8.8, 2.4)), Snap(at(9, 3), "SEAM"))
    assert drawing.wires[-1].end == at(9, 3)
    assert drawing.line_begin(Snap((at(2, 2), at(3, 2)))) is False
    assert "not edge" in drawing.told


def test_across_the_surface_a_line_goes_on_from_the_live_wire() -> None:
    drawing = session("SURFACE")
    drawing.click(at(2, 2))
    drawing.click(at(5, 2))
    drawing.wait()
    draw(drawing, Snap(at(5, 2), "SEED"), line((5, 2), (9, 2), (9, 6)))
    assert drawing.wires[1].start == at(5, 2)
    assert drawing.seed == at(9, 6)
