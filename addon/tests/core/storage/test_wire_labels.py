# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks that live in the labels of a mesh's edges: what Blender does to a mesh happens to its wires."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest
from paper_mesh import PaperMesh
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.network import Network, Snap, linked
from seamwire.core.network.picks import Edge
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.storage.serialization import WAS_SEAM
from setting import use
from table import SIZE, Table, chain, courses, paper, wire


def drawn(*chains: Iterable[object], mesh: PaperMesh | None = None, **options: object) -> tuple[PaperMesh, Sketch]:
    """Return a mesh with chains through picks, and the session that drew them."""
    mesh = paper() if mesh is None else mesh
    table = Table(**options)
    session = table.session
    mesh.open(session)
    for picks in chains:
        for pick in picks:
            session.click(pick)
        session.end_chain()
    mesh.write(session, adopt=True)
    return mesh, session


def opened(mesh: PaperMesh, **options: object) -> Sketch:
    """Return a session on the table, in a Blender that was just started."""
    session = Table(**options).session
    mesh.open(session)
    return session


def found(mesh: PaperMesh) -> list[tuple[int, ...]]:
    return sorted(wire.vertices for wire in mesh.read().network.wires)


def lines(*chains: Iterable[int]) -> set[Edge]:
    return {edge for one in chains for edge in chain(*one)}


# Writing


def test_a_wire_is_seams_and_labels_and_comes_back() -> None:
    mesh, session = drawn((0, 3, 21))
    assert mesh.seams == set(mesh.labels) == lines((0, 1, 2, 3), (3, 9, 15, 21))
    again = opened(mesh)
    assert sorted(courses(again)) == sorted(courses(session))
    for now in again.wires:
        was = next(own for own in session.wires if own.vertices == now.vertices)
        for name in ("along", "start", "end", "closed", "marks", "heading", "follow", "strength", "stored", "images"):
            assert getattr(now, name) == getattr(was, name), name
        assert np.array_equal(now.points, was.points)
    assert not again.picture.can_undo


def test_what_is_written_twice_changes_nothing() -> None:
    mesh, session = drawn((0, 3, 21))
    plan = mesh.write(session)
    assert (plan.mark, plan.clear, plan.labels) == ([], [], {})
    plan = mesh.write(opened(mesh))
    assert (plan.mark, plan.clear, plan.labels) == ([], [], {})


def test_seams_that_were_there_before_stay_when_a_wire_goes() -> None:
    mesh, session = drawn((0, 3), mesh=paper(seams={(1, 2), (30, 31)}))
    assert mesh.seams == lines((0, 1, 2, 3), (30, 31))
    session = opened(mesh)
    session.drop(session.wires[0])
    plan = mesh.write(session)
    assert mesh.seams == {(1, 2), (30, 31)}
    assert sorted(plan.clear) == [(0, 1), (2, 3)]
    assert mesh.labels == {}
    assert mesh.text == ""


def test_a_seam_from_before_is_remembered_under_one_wire_after_another() -> None:
    mesh, _ = drawn((0, 3), mesh=paper(seams={(1, 2)}))
    _, session = drawn((1, 2), mesh=mesh)
    for vertices in ((0, 1, 2, 3), (1, 2)):
        session.drop(next(wire for wire in session.wires if wire.vertices == vertices))
        mesh.write(session, adopt=True)
        assert (1, 2) in mesh.seams
    assert mesh.seams == {(1, 2)}
    assert mesh.labels == {}


def test_wires_that_share_a_stretch_keep_it_until_the_last_of_them_goes() -> None:
    mesh, _ = drawn((0, 4), (1, 3), (2, 5))
    session = opened(mesh)
    assert found(mesh) == [(0, 1, 2, 3, 4), (1, 2, 3), (2, 3, 4, 5)]
    left = {(0, 1, 2, 3, 4): (1, 2, 3, 4, 5), (2, 3, 4, 5): (1, 2, 3), (1, 2, 3): ()}
    for vertices, rest in left.items():
        session.drop(next(wire for wire in session.wires if wire.vertices == vertices))
        mesh.write(session, adopt=True)
        assert mesh.seams == lines(rest)
        assert set(mesh.labels) == mesh.seams
        session = opened(mesh)


def test_wires_that_cross_are_two_wires() -> None:
    mesh, _ = drawn((12, 15), (2, 26))
    mesh.renumber(np.random.default_rng(5).permutation(SIZE**2))
    assert sorted(map(len, found(mesh))) == [4, 5]
    assert mesh.read().broken == frozenset()


# Mirror images


def mirrored() -> PaperMesh:
    mesh = paper(centred=True)
    session = Table(centred=True).session
    use(session, mirror=(0,))
    session.click(0)
    session.click(8)
    mesh.write(session)
    return mesh


def test_images_come_back_with_their_wire_and_go_with_it() -> None:
    mesh = mirrored()
    assert mesh.seams == lines((0, 1, 2, 8), (5, 4, 3, 9))
    session = opened(mesh, centred=True)
    (wire,) = session.wires
    assert (wire.mirror, sorted(wire.images)) == ((0,), chain(5, 4, 3, 9))
    assert [image.vertices for image in session.mirrored(wire)] == [(5, 4, 3, 9)]
    session.drop(wire)
    mesh.write(session)
    assert mesh.seams == set()
    assert mesh.labels == {}


def test_an_image_that_was_cleared_by_hand_is_none_and_the_wire_stays() -> None:
    mesh = mirrored()
    mesh.clear_seam((3, 4))
    session = opened(mesh, centred=True)
    assert sorted(session.wires[0].images) == [(3, 9), (4, 5)]
    plan = mesh.write(session)
    assert (plan.mark, plan.clear, set(plan.labels)) == ([], [], {(3, 4)})


def test_copies_of_a_mirrored_wire_have_their_own_images() -> None:
    mesh = mirrored()
    mesh.duplicate(range(SIZE**2), (0.0, 20.0, 0.0))
    session = opened(mesh, centred=True)
    first, second = sorted(session.wires, key=lambda wire: min(wire.vertices))
    assert sorted(first.images) == chain(5, 4, 3, 9)
    assert sorted(second.images) == chain(41, 40, 39, 45)
    mesh.write(session.drawn.without(first))
    assert mesh.seams == lines((36, 37, 38, 44), (41, 40, 39, 45))


def test_images_of_a_wire_of_which_nothing_is_left_are_plain() -> None:
    mesh = mirrored()
    mesh.delete_edges(chain(0, 1, 2, 8))
    mesh.write(opened(mesh))
    assert mesh.seams == lines((5, 4, 3, 9))
    assert mesh.labels == {}


# Clearing


def test_what_clears_an_edge_of_a_hidden_wire_takes_it_from_that() -> None:
    mesh, _ = drawn((0, 3))
    mesh.hide((0, 1))
    session = opened(mesh)
    use(session, clear=not session.options.clear)
    session.click(2)
    session.click(3)
    mesh.write(session)
    assert mesh.seams == set(mesh.labels) == lines((0, 1, 2))
    mesh.hidden.clear()
    mesh.write(opened(mesh))
    assert mesh.seams == lines((0, 1, 2))
    assert mesh.labels == {}


def test_a_wire_that_clears_leaves_the_rest_of_those_it_crosses_as_seams() -> None:
    mesh, session = drawn((0, 3), (12, 15))
    session = opened(mesh)
    use(session, clear=not session.options.clear)
    session.click(1)
    session.click(2)
    mesh.write(session, adopt=True)
    assert mesh.seams == lines((0, 1), (2, 3), (12, 13, 14, 15))
    assert set(mesh.labels) == lines((12, 13, 14, 15))
    assert courses(session) == [(12, 13, 14, 15)]
    assert mesh.plain_seams() == lines((0, 1), (2, 3))


def test_a_wire_and_what_clears_a_part_of_it_may_be_of_one_drawing() -> None:
    session = Table().session
    mesh = paper(seams={(7, 8)})
    session.click(0)
    session.click(3)
    session.end_chain()
    use(session, clear=not session.options.clear)
    session.click(1)
    session.click(2)
    session.start(7)
    session.click(8)
    mesh.write(session)
    assert mesh.seams == lines((0, 1), (2, 3)) == set(session.edges_to_mark())
    assert mesh.labels == {}


def test_what_is_left_of_a_cleared_wire_is_a_seam_under_others_too() -> None:
    mesh, session = drawn((0, 3), (2, 5))
    use(session, clear=not session.options.clear)
    session.click(0)
    session.click(1)
    mesh.write(session, adopt=True)
    assert found(mesh) == [(2, 3, 4, 5)]
    session.drop(session.wires[0])
    mesh.write(session)
    assert mesh.seams == lines((1, 2, 3))


# By hand


def test_what_is_left_of_a_broken_wire_stays_under_a_wire_that_goes() -> None:
    mesh, _ = drawn((0, 4), (1, 3))
    mesh.clear_seam((3, 4))
    session = opened(mesh)
    assert courses(session) == [(1, 2, 3)]
    mesh.write(session, adopt=True)
    session.drop(session.wires[0])
    mesh.write(session)
    assert mesh.seams == lines((0, 1, 2, 3))


# Hidden


def test_a_seam_cleared_by_hand_beside_a_hidden_part_of_its_wire_stays_cleared() -> None:
    mesh, _ = drawn((0, 3))
    mesh.hide((0, 1))
    mesh.clear_seam((2, 3))
    session = opened(mesh)
    session.click(12)
    session.click(15)
    mesh.write(session)
    assert (2, 3) not in mesh.seams


def test_of_two_copies_one_may_be_hidden_and_one_be_broken() -> None:
    mesh, _ = drawn((0, 3))
    mesh.duplicate(range(4), (0.0, -5.0, 0.0))
    mesh.duplicate(range(4), (0.0, -9.0, 0.0))
    mesh.hide((36, 37))
    mesh.clear_seam((40, 41))
    session = opened(mesh)
    assert courses(session) == [(0, 1, 2, 3)]
    session.drop(session.wires[0])
    mesh.write(session)
    assert mesh.seams == lines((36, 37, 38, 39), (41, 42, 43))
    assert set(mesh.labels) == lines((36, 37, 38, 39))


# Unknown, newer


def test_a_label_with_an_unknown_member_is_not_changed() -> None:
    mesh = paper(seams={(0, 1)})
    mesh.labels[0, 1] = mesh.archive.label_of([4711, WAS_SEAM])
    mesh.text = mesh.archive.text(mesh.labels.values())
    session = opened(mesh)
    plan = mesh.write(session)
    assert (plan.mark, plan.clear, plan.labels) == ([], [], {})


def test_unknown_labels_stay_untouched() -> None:
    mesh, _ = drawn((0, 3))
    mesh.labels[1, 2] = 4711
    mesh.labels[30, 31] = 4712
    mesh.seams.add((30, 31))
    session = opened(mesh)
    assert mesh.unknown() == 2
    assert session.wires == (), "its edge has lost its label"
    session.click(30)
    session.click(32)
    mesh.write(session, adopt=True)
    session.drop(session.wires[0])
    mesh.write(session)
    assert mesh.labels == {(1, 2): 4711, (30, 31): 4712}
    assert mesh.seams == lines((0, 1, 2, 3), (30, 31))


# Copies and joining


@pytest.mark.parametrize("turn", [-1.0, 1.0])
def test_a_copy_runs_as_what_it_was_made_of_however_it_was_moved(turn: float) -> None:
    mesh, _ = drawn((21, (15, 14), 12))
    copies = mesh.duplicate(range(SIZE**2))
    count = SIZE**2
    mesh.places[count:, :2] *= turn
    mesh.places[count:, 2] += 7.0
    wires = {wire.vertices: wire for wire in mesh.read().network.wires}
    for vertices in [one for one in wires if one[0] < count]:
        own, copy = wires[vertices], wires[tuple(copies[vertex] for vertex in vertices)]
        for name in ("start", "end", "heading"):
            pick = getattr(own, name)
            moved = tuple(copies[one] for one in pick) if isinstance(pick, tuple) else copies.get(pick)
            assert getattr(copy, name) == moved, name


# Other vertices


def check_chain(mesh: PaperMesh, where: np.ndarray) -> None:
    """Whether a chain through an edge seed is still one, whose seed takes both wires along."""
    wires = mesh.read().network.wires
    first = next(wire for wire in wires if wire.heading is None)
    second = next(wire for wire in wires if wire is not first)
    assert first.start == where[0]
    assert second.end == where[27]
    assert (first.end, second.start) == ((where[8], where[9]),) * 2
    assert second.heading == (where[8], where[9])
    network = Network(linked(wires))
    assert network.find(second.id).goes_on == (first.id, "end")
    assert network.after(network.find(first.id)).id == second.id
    assert {(wire.id, end) for wire, end in network.at(first.end)} == {(first.id, "end"), (second.id, "start")}


@pytest.mark.parametrize(
    "change",
    [
        lambda mesh: mesh.renumber(np.arange(SIZE**2)[::-1]),
        lambda mesh: mesh.renumber(np.random.default_rng(3).permutation(SIZE**2)),
        lambda mesh: mesh.delete_vertices([5, 12]),
        lambda mesh: np.arange(SIZE**2),
    ],
    ids=["backwards", "at random", "after others were deleted", "as they were"],
)
def test_with_other_numbers_edge_seeds_and_headings_are_the_same(change: Callable[[PaperMesh], np.ndarray]) -> None:
    mesh, _ = drawn((0, (8, 9), 27))
    check_chain(mesh, change(mesh))


def test_numbers_of_different_times_are_not_taken_for_each_other() -> None:
    mesh, session = drawn((0, (8, 9), 27), (30, 32))
    where = mesh.renumber(np.random.default_rng(8).permutation(SIZE**2))
    session = Table().session
    mesh.open(session)
    (last,) = [wire for wire in session.wires if wire.heading is not None]
    changed = last.changed(strength=3.0)
    network = replace(session.drawn, wires=tuple(changed if one is last else one for one in session.wires))
    mesh.write(network)
    for _ in range(2):
        wires = [wire for wire in mesh.read().network.wires if wire.start != int(where[30])]
        first, second = sorted(wires, key=lambda wire: wire.heading is not None)
        assert (first.end, second.start, second.heading) == ((where[8], where[9]),) * 3
        where = mesh.renumber(np.random.default_rng(9).permutation(SIZE**2))[where]


def test_the_same_number_of_vertices_moved_by_a_cell_is_the_same_mesh() -> None:
    mesh, _ = drawn((0, 3, 21))
    mesh.places[:, 0] += 1.0
    session = opened(mesh)
    assert sorted(courses(session)) == [(0, 1, 2, 3), (3, 9, 15, 21)]


@pytest.mark.parametrize("seeds", [(0, 3), (3, 0)])
def test_with_other_numbers_and_moved_along_itself_a_wire_has_its_direction(seeds: tuple[int, int]) -> None:
    mesh, _ = drawn(seeds)
    where = mesh.renumber(np.random.default_rng(1).permutation(SIZE**2))
    mesh.places[:, 0] += 20.0
    (wire,) = mesh.read().network.wires
    assert (wire.start, wire.end) == tuple(where[list(seeds)])


def test_of_wires_that_end_in_one_seed_each_goes_on_from_its_own() -> None:
    mesh = paper()
    session = Table().session
    for pick in (21, 3, 5):
        session.click(pick)
    session.end_chain()
    for begin in (0, 1):
        session.start(begin)
        session.click(Snap(3, "SEED"))
    mesh.write(session)
    again = opened(mesh)
    (wire,) = [wire for wire in again.wires if wire.heading is not None]
    assert wire.heading == (9, 3), "not (2, 3)"
    assert again.wire(again.network.find(wire.id).goes_on[0]).vertices == (21, 15, 9, 3)


# Subdivided


def test_the_edge_seed_between_subdivided_wires_is_one_seed() -> None:
    mesh, _ = drawn((0, (8, 9), 27))
    middles = mesh.subdivide([(8, 9)])
    first, second = sorted(mesh.read().network.wires, key=lambda wire: wire.heading is not None)
    assert first.end == second.start == (middles[8, 9], 9)
    assert second.heading == (middles[8, 9], 9)


def test_a_subdivided_loop_is_a_loop() -> None:
    session = Table().session
    session.loop((14, 15))
    mesh = paper()
    mesh.write(session)
    mesh.subdivide([(14, 15), (20, 26)])
    (wire,) = mesh.read().network.wires
    assert wire.closed
    assert len(wire.vertices) == 8
    assert (wire.kind, wire.through, wire.offers) == (None, None, ())


# Loops, and wires that touch themselves


@pytest.mark.parametrize("seed", [None, 1, 2])
def test_loops_come_back_with_what_they_were_taken_by(seed: int | None) -> None:
    session = Table().session
    session.loop((14, 15))
    mesh = paper()
    mesh.write(session)
    where = np.arange(SIZE**2)
    if seed:
        where = mesh.renumber(np.random.default_rng(seed).permutation(SIZE**2))
    (wire,) = mesh.read().network.wires
    assert wire.closed
    assert wire.vertices == tuple(where[list(session.wires[0].vertices)].tolist()), (
        "from where it began, in its direction"
    )
    through = tuple(sorted(where[[14, 15]].tolist()))
    assert (wire.kind, wire.through, wire.start, wire.end) == ("CLOSED", through, through, through)
    assert len(wire.points) == 7


def test_a_moved_copy_of_a_loop_goes_through_the_copy_of_the_edge() -> None:
    session = Table().session
    session.loop((14, 15))
    mesh = paper()
    mesh.write(session)
    copies = mesh.duplicate(range(SIZE**2), (2.0, 30.0, 0.0))
    throughs = {wire.through for wire in mesh.read().network.wires}
    assert throughs == {(14, 15), (copies[14], copies[15])}


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize(
    "vertices",
    [(0, 1, 2, 8, 14, 13, 7, 8), (2, 8, 14, 20, 19, 13, 14, 15, 16), (6, 7, 8, 2, 1, 7, 13, 12)],
    ids=["lollipop", "loop on the way", "crossing itself"],
)
def test_wires_that_touch_themselves_survive_other_numbers(vertices: tuple[int, ...], closed: bool) -> None:
    mesh = paper()
    if closed:
        vertices = (7, 8, 14, 20, 19, 13, 14, 15, 9, 8, 2, 1)  # an eight, and more
    mesh.write(Drawn((wire(*vertices, closed=closed),)))
    assert mesh.read().network.wires[0].vertices == vertices
    where = mesh.renumber(np.random.default_rng(4).permutation(SIZE**2))
    (again,) = mesh.read().network.wires
    assert sorted(again.edges()) == sorted(wire(*where[list(vertices)].tolist(), closed=closed).edges())
    if not closed:
        assert (again.start, again.end) == (where[vertices[0]], where[vertices[-1]])
    assert again.closed is closed


def test_an_open_wire_back_to_its_first_vertex_survives_other_numbers() -> None:
    mesh = paper()
    mesh.write(Drawn((wire(0, 1, 7, 6, 0, start=(0, 1)),)))
    mesh.delete_vertices([35])
    mesh.renumber(np.random.default_rng(4).permutation(SIZE**2 - 1))
    (again,) = mesh.read().network.wires
    assert not again.closed
    assert again.vertices[0] == again.vertices[-1]
    assert set(again.edges()) == mesh.seams


# Across the surface, strokes, scale


def test_a_curve_stays_while_its_vertices_do_and_comes_back_with_them() -> None:
    mesh = paper()
    session = Table("SURFACE").session
    session.click(0)
    session.click(9)
    lifted = session.wires[0].drawn(points=session.wires[0].points + np.array([0.0, 0.0, 0.25]))
    mesh.write(Drawn((lifted,)))
    assert np.allclose(mesh.read().network.wires[0].points, lifted.points)
    mesh.places[1, 1] += 0.5
    moved = mesh.read().network.wires[0]
    assert np.array_equal(moved.points, mesh.points[list(moved.vertices)]), "else it runs along its edges"
    opened(mesh)
    mesh.write(Drawn((moved,)))
    mesh.places[1, 1] -= 0.5
    assert np.allclose(mesh.read().network.wires[0].points, lifted.points)
