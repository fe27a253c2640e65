# SPDX-License-Identifier: GPL-3.0-or-later
"""What one click on an edge offers: the closed loop, the strip, the whole strip. Live wires are fakes only where the time counts."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from real_sessions import halves, session_on
from seamwire.core.network.network import Snap
from seamwire.core.sketch.picture import Intent, Role
from seamwire.core.sketch.sketch import Sketch
from setting import insert, use
from table import SIZE, Table, paper

ROW = (12, 13, 14, 15, 16, 17)
COLUMN = (2, 8, 14, 20, 26, 32)
AROUND = (14, 15, 16, 17, 11, 5, 4, 3, 2, 1, 0, 6, 12, 13)
"""The closed loop of edge 14-15, around the two rows below."""


def grid(shift: float = 0.0, **options: object) -> Sketch:
    """Return a session with the library's own live wires, on squares; `shift` is added to x."""
    points = grid_points(SIZE) + np.array([shift, 0.0, 0.0])
    numbers = np.arange(SIZE**2, dtype=np.int32).reshape(SIZE, SIZE)
    corners = (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1])
    squares = np.stack([one.ravel() for one in corners], axis=1)
    return session_on(points, halves(squares), grid_edges(SIZE), **options)


def show(session: Sketch, edge: tuple[int, int], kind: str | None = None) -> tuple[int, ...]:
    """Show what a click on an edge offers, of a kind or the first; return its vertices."""
    session.hover(edge, loop=True)
    session.wait()
    while kind is not None and session.picture.offered.kind != kind:
        assert session.next_candidate()
    return shown(session)


def take(session: Sketch, edge: tuple[int, int], kind: str | None = None) -> bool:
    """Keep what a click on an edge offers, of a kind or the first; return whether that was done."""
    if kind is not None:
        show(session, edge, kind)
    is_done = session.loop(edge)
    session.wait()
    session.hover(None)
    return is_done


def shown(session: Sketch) -> tuple[int, ...]:
    return session.picture.one(Role.OFFER).vertices


def test_the_closed_loop_comes_first_then_the_strip() -> None:
    session = grid()
    assert show(session, (14, 15)) == AROUND
    assert session.picture.offered.kinds == ("CLOSED", "STRIP"), "the strip without stops is the strip"
    assert session.picture.intent is Intent.LOOP


def first_offer(edge: tuple[int, int], *before: tuple[tuple[int, int], str], **options: object) -> str:
    """Return what is offered first for an edge after offers of other edges were taken."""
    session = grid(**options)
    for other, kind in before:
        assert take(session, other, kind)
    show(session, edge)
    return session.picture.offered.kind


def test_what_was_taken_last_comes_first_again() -> None:
    assert first_offer((14, 15), ((30, 31), "STRIP")) == "STRIP"
    assert first_offer((14, 15)) == "CLOSED"


def test_a_loop_across_seams_comes_later() -> None:
    assert first_offer((14, 15), seams=[(16, 22)]) == "CLOSED", "across one"
    assert first_offer((14, 15), seams=[(16, 22), (10, 11), (7, 6), (13, 19), (3, 9)]) != "CLOSED"


def test_a_strip_ends_at_images_of_kept_wires() -> None:
    session = grid(shift=-2.5)
    use(session, mirror=[0])  # what is drawn on column 1 is on column 4 as well
    session.click(7)
    session.hover(25)
    session.wait()
    session.click(25)
    session.end_chain()
    assert show(session, (14, 15), "STRIP") == (13, 14, 15, 16)
    assert [16, 22] in session.seams.tolist(), "parts end there too"


def test_a_strip_ends_on_the_mirrors_plane_unless_it_runs_along_it() -> None:
    session = grid(shift=-2.0)
    use(session, mirror=[0])
    assert show(session, (15, 16), "STRIP") == (14, 15, 16, 17)
    assert show(session, (14, 20), "STRIP") == COLUMN
    use(session, mirror=[1])
    assert show(session, (15, 16), "STRIP") == ROW, "the plane is another one"


def test_toggling_goes_around_and_stays_while_the_edge_is_the_same() -> None:
    session = grid()
    show(session, (14, 15))
    kinds = []
    for _ in range(4):
        kinds.append(session.picture.offered.kind)
        before = session.revision
        assert session.next_candidate()
        assert session.revision > before
        show(session, (15, 14))
    assert kinds == ["CLOSED", "STRIP", "CLOSED", "STRIP"]
    assert session.picture.offered.kind == "CLOSED"
    session.next_candidate()
    show(session, (15, 16))
    assert session.picture.offered.kind == "CLOSED", "another edge begins with its default"


def test_a_kept_loop_takes_its_next_offer_in_place() -> None:
    session = grid()
    take(session, (14, 15))
    number = session.wires[0].id
    courses = []
    for _ in range(3):
        assert session.retrace(session.wires[0])
        session.wait()
        courses.append(session.wires[0].vertices)
        assert session.wires[0].id == number
    assert courses == [ROW, AROUND, ROW]
    for course in (AROUND, ROW, AROUND):
        assert session.undo()
        assert session.wires[0].vertices == course
    assert session.undo()
    assert session.wires == ()
    assert session.redo()
    assert session.retrace(session.wires[0])
    session.wait()
    assert session.wires[0].vertices == ROW


def test_over_a_kept_loops_edge_the_cursor_finds_its_offers_and_a_click_replaces_it() -> None:
    session = grid()
    take(session, (14, 15))
    assert show(session, (14, 15)) == AROUND
    assert take(session, (14, 15)), "the same again, as the second press of a double click"
    assert len(session.wires) == 1
    take(session, (14, 15), "STRIP")
    assert [wire.vertices for wire in session.wires] == [ROW]


def test_a_double_click_takes_its_first_click_back() -> None:
    session = grid()
    session.click(0)
    session.hover((14, 20))
    session.wait()
    session.click((14, 20))
    assert len(session.wires) == 1
    assert take(session, (14, 20))
    assert [wire.through for wire in session.wires] == [(14, 20)]
    assert session.seed == 0
    assert session.undo()
    assert session.wires == ()
    assert session.seed == 0


def test_a_strips_ends_are_seeds_that_can_be_moved_and_gone_on_from() -> None:
    session = grid()
    take(session, (14, 20), "STRIP")
    session.drag(32)
    session.drag_to(33)
    session.wait()
    assert session.drag_end()
    (wire,) = session.wires
    assert (wire.vertices[0], wire.vertices[-1]) == (2, 33)
    assert wire.kind is None
    assert wire.offers == ()
    session.undo()
    session.click(Snap(32, "SEED"))
    assert session.seed == (26, 32), "the wire goes on straight"


def test_what_goes_on_from_a_strip_stays_when_that_takes_its_next_offer() -> None:
    session = grid(seams=[(8, 9), (26, 25)])
    take(session, (14, 20), "STRIP")
    session.click(Snap(26, "SEED"))
    session.hover(28)
    session.wait()
    session.click(28)
    session.end_chain()
    before = session.wires[1].vertices
    assert session.wires[1].heading == (20, 26)
    while session.wires[0].vertices != COLUMN:
        assert session.retrace(session.wires[0])
        session.wait()
    assert session.wires[1].vertices == before
    assert session.wires[1].heading is None


def test_a_seed_in_a_strip_makes_two_ordinary_wires_of_it() -> None:
    session = grid()
    take(session, (14, 20), "STRIP")
    assert insert(session, session.wires[0], 14)
    assert [wire.vertices for wire in session.wires] == [(2, 8, 14), (14, 20, 26, 32)]
    assert [wire.offers for wire in session.wires] == [(), ()]


def test_a_single_offer_has_no_next() -> None:
    session = Table().session
    session.hover((14, 20), loop=True)
    assert session.picture.offered.kinds == ("STRIP",)
    assert not session.next_candidate()
    assert session.reason == "No other loop through this edge"
    session.hover(None)
    assert session.picture.offered.kinds == ()
    assert session.picture.offered.kind is None


def test_an_edge_that_is_none_is_refused_in_words() -> None:
    class NoEdge:
        def __getattr__(self, name: str) -> object:
            return getattr(live, name)

        def loop(self, edge: object) -> object:
            raise ValueError("there is no edge between the vertices 0 and 20")

    table = Table()
    live = table.lives["EDGES"]
    session = Sketch(lambda _: NoEdge(), table.points, edges=grid_edges(SIZE), triangles=grid_triangles(SIZE))
    assert not session.loop((0, 20))
    assert "no edge" in session.reason
    session.hover((0, 20), loop=True)
    assert session.picture.one(Role.OFFER) is None


COMPUTED = (14, 15, 21, 27, 26, 20)
"""The loop of edge 14-15 on a fake."""


def test_while_the_loop_is_computed_nothing_is_offered_yet() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.hover((14, 15), loop=True)
    assert session.picture.one(Role.OFFER) is None
    assert session.computing
    assert not session.next_candidate()
    assert session.reason == "No loop found yet"
    table.compute()
    assert shown(session) == COMPUTED


def test_a_loop_and_clicks_are_found_in_any_order() -> None:
    table = Table(ready=(False, False), islands=(21,))
    session = table.session
    session.click(0)
    session.click(21)
    session.loop((14, 15))
    session.click(3)
    assert session.waiting == 3
    session.wait()
    assert session.waiting == 0
    assert not session.computing
    assert session.wires[0].vertices == COMPUTED, "no wire reaches 21"
    assert [str(one) for one in session.reports] == ["No wire from vertex 0 reaches vertex 21"]


@pytest.mark.parametrize("order", [range(SIZE**2), range(SIZE**2)[::-1]])
@pytest.mark.parametrize("steps", [0, 1])
def test_a_stored_loop_or_strip_goes_through_the_same_offers_again(order: range, steps: int) -> None:
    table = Table()
    table.session.loop((14, 15))
    for _ in range(steps):
        table.session.retrace(table.session.wires[0])
    mesh = paper()
    mesh.write(table.session)
    where = mesh.renumber(order)
    assert mesh.read().network.wires[0].through == tuple(sorted(where[[14, 15]].tolist()))
    mesh.renumber(where)
    again = Table().session
    mesh.open(again)
    kept = again.wires[0]
    number = again.wires[0].id
    for _ in range(3):
        assert table.session.retrace(table.session.wires[0])
        assert again.retrace(again.wires[0])
        assert again.wires[0].vertices == table.session.wires[0].vertices
        assert again.wires[0].kind == table.session.wires[0].kind
        assert again.wires[0].id == number
    for _ in range(3):
        assert again.undo()
    assert again.wires[0] is kept


def test_a_stored_loops_offers_are_waited_for_across_the_surface_too() -> None:
    table = Table()
    table.session.loop((14, 15))
    mesh = paper()
    mesh.write(table.session)
    session = Table("SURFACE", ready=(False, False)).session
    mesh.open(session)
    session.retrace(session.wires[0])
    session.wait()
    assert session.wires[0].vertices == ROW


def test_loops_that_were_asked_for_on_an_edge_are_given_up_once_a_vertex_is_under_the_cursor() -> None:
    session = Table().session
    session.click(0)
    session.hover((14, 15), loop=True)
    session.click(7)
    session.use_crests(None, True)
    session.poll()
    assert not session.computing, "waiting would never end"
    session.hover((14, 15), loop=True)
    assert session.picture.offered.kinds
