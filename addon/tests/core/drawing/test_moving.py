# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds that are moved, and the wires that follow them."""

from __future__ import annotations

import pytest
from seamwire.core.network.network import Snap
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.picture import Intent
from setting import use
from table import Table, corner, courses


def test_a_mirror_that_is_set_while_a_seed_is_dragged_stays() -> None:
    session = corner().session
    session.drag(3)
    session.drag_to(4)
    assert use(session, mirror=(0,))
    assert session.drag_end()
    assert session.drawn.mirror == session.options.mirror == (0,)


def test_wires_arrive_and_leave_as_their_neighbours_do() -> None:
    table = corner()
    session = table.session
    session.click(23)
    session.drag(21)
    assert [fork.seeded for fork in table.lives["EDGES"].forks] == [((2, 3), True), (23, False)]
    session.cancel()
    session.drag(3)
    assert [fork.seeded for fork in table.lives["EDGES"].forks[2:]] == [(0, False), ((22, 21), True)]
    session.drag_to(9)
    assert courses(session) == [(0, 1, 2, 3, 9), (9, 15, 21), (21, 22, 23)]


def test_the_seed_of_the_live_wire_moves_with_its_wire() -> None:
    table = corner()
    session = table.session
    session.drag(21)
    session.drag_to(22)
    session.drag_end()
    assert courses(session)[-1] == (3, 4, 10, 16, 22)
    assert session.seed == (16, 22)
    assert table.lives["EDGES"].seeded == ((16, 22), True)
    session.click(23)
    assert courses(session)[-1] == (22, 23)


def test_a_seed_without_wires_can_be_moved() -> None:
    session = Table().session
    session.click(0)
    session.drag(0)
    session.drag_to(7)
    session.drag_end()
    assert session.seed == 7
    assert session.seeds() == [7]
    session.undo()
    assert session.seed == 0


def test_the_first_seed_of_a_chain_can_be_moved_and_still_closes_it() -> None:
    session = corner().session
    session.drag(0)
    session.drag_to(1)
    session.drag_end()
    assert session.network.closing_point == 1
    session.close()
    assert session.wires[-1].end == 1


def test_a_seed_dragged_onto_another_one_becomes_one_with_it() -> None:
    session = corner().session
    session.start(30)
    session.click(33)
    session.end_chain()
    session.drag(33)
    session.drag_to(Snap(21, "SEED"))
    session.drag_end()
    assert session.seeds() == [0, 3, 21, 30]
    assert session.wires[-1].vertices[-1] == 21
    session.drag(21)
    session.drag_to(22)
    assert len(session.holds(Dragging).moved) == 2, "from then on they move together"


def test_a_seed_dragged_onto_its_neighbour_takes_the_wire_between_away() -> None:
    session = corner().session
    session.drag(3)
    session.drag_to(Snap(0, "SEED"))
    session.drag_end()
    assert courses(session) == [(0, 6, 12, 18, 19, 20, 21)]
    assert session.seeds() == [0, 21]


def test_an_only_wire_is_not_dragged_to_nothing() -> None:
    session = Table().session
    session.click(0)
    session.click(3)
    session.end_chain()
    session.drag(3)
    assert not session.drag_to(Snap(0, "SEED"))
    assert "remove it instead" in session.reason
    assert courses(session) == [(0, 1, 2, 3)]
    assert not session.drag_end()
    assert courses(session) == [(0, 1, 2, 3)]
    assert not session.holds(Dragging)


def test_a_seed_dragged_to_where_no_wire_leads_stays() -> None:
    session = corner(islands=(35,)).session
    session.drag(3)
    session.drag_to(4)
    assert not session.drag_to(35)
    assert session.reason == "No wire from vertex 0 reaches vertex 35"
    session.drag_end()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]


def test_undo_during_a_drag_takes_back_the_drag_alone() -> None:
    session = corner().session
    session.drag(3)
    session.drag_to(4)
    assert session.picture.can_undo
    assert session.undo()
    assert not session.holds(Dragging)
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert not session.picture.can_redo


@pytest.mark.parametrize("stale", [False, True])
def test_a_drag_that_is_not_computed_is_done_when_it_is(stale: bool) -> None:
    table = corner(fork_ready=(False, False), stale=stale)
    session = table.session
    session.drag(3)
    assert not session.drag_to(4)
    assert session.computing
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert session.drag_end()
    assert not session.holds(Dragging)
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)], "until others are known"
    table.compute()
    assert courses(session) == [(0, 1, 2, 3, 4), (4, 10, 16, 22, 21)]


def test_wires_that_are_computed_after_the_drag_meet_at_an_edge_as_well() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    for pick in (0, (20, 21), 33):
        session.click(pick)
    session.drag((20, 21))
    session.drag_to((25, 26))
    assert session.drag_end()
    table.compute()
    assert courses(session) == [(0, 1, 7, 13, 19, 25, 26), (26, 32, 33)]


def test_there_must_be_a_seed_to_drag() -> None:
    session = corner().session
    assert not session.drag(20)
    assert not session.drag_to(21)
    assert not session.drag_end()
    assert not session.cancel()


def test_while_a_seed_is_dragged_a_toggled_wire_stays_with_its_metric() -> None:
    session = Table().session
    session.click(0)
    session.click(7)
    session.retrace(session.wires[0])
    session.drag(7)
    session.drag_to(8)
    assert courses(session) == [(0, 6, 7, 8)]
    session.drag_end()
    session.retrace(session.wires[0])
    assert courses(session) == [(0, 1, 2, 8)]


def test_a_seed_that_is_pressed_and_released_where_it_is_is_not_shown_as_held() -> None:
    session = corner().session
    session.drag(3)
    assert session.picture.intent is Intent.MOVE
    assert session.drag_end()
    assert session.picture.intent is Intent.NOTHING
