# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be done with a network after it was drawn: joins, closing, dropping, inserting, other ways, ends."""

from __future__ import annotations

from dataclasses import replace

import pytest
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.network import Snap
from seamwire.core.sketch.picture import Intent, Role, SeedRole, ShownSeed
from setting import insert, use
from table import Table, chain, corner, courses, paper

# Joining and closing


def test_a_click_on_a_wire_joins_it_there_and_ends_the_chain() -> None:
    session = corner().session
    session.start(30)
    bottom = session.wires[0]
    session.hover(Snap(1, "WIRE", bottom))
    assert session.picture.intent is Intent.JOIN
    assert session.picture.one(Role.HOVERED) is bottom
    assert session.click(Snap(1, "WIRE", bottom))
    assert session.seed is None
    assert courses(session) == [(0, 1), (1, 2, 3), (3, 9, 15, 21), (30, 31, 25, 19, 13, 7, 1)]
    assert session.seeds() == [0, 1, 3, 21, 30], "the wires meet in one seed"
    assert session.undo()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)], "one step took the wire and the seed in the other"
    assert session.seed == 30


def test_a_join_at_a_wires_end_cuts_nothing() -> None:
    session = corner().session
    session.start(30)
    session.click(Snap(0, "WIRE", session.wires[0]))
    assert len(session.wires) == 3
    assert session.seed is None


def test_a_join_on_a_seam_ends_the_chain() -> None:
    session = Table(seams=[(4, 10)]).session
    session.click(0)
    session.hover(Snap((4, 10), "SEAM"))
    assert session.picture.intent is Intent.JOIN
    session.click(Snap((4, 10), "SEAM"))
    assert session.seed is None
    assert len(session.wires) == 1


def test_a_chain_goes_on_from_its_last_seed_in_its_direction() -> None:
    table = corner()
    session = table.session
    session.end_chain()
    session.hover(Snap(21, "SEED"))
    assert session.picture.intent is Intent.CONTINUE
    assert ShownSeed(21, SeedRole.HOVERED) in session.picture.seeds
    session.click(Snap(21, "SEED"))
    assert table.lives["EDGES"].seeded == ((15, 21), True)
    session.click(22)
    assert session.wires[-1].vertices == (21, 22)
    session.end_chain()
    session.click(Snap(0, "SEED"))
    assert table.lives["EDGES"].seeded == ((1, 0), True), "and from its first seed the other way"


def test_a_click_on_the_first_seed_closes_the_loop() -> None:
    session = corner().session
    assert session.network.closing_point == 0
    assert session.picture.seeds == (ShownSeed(3), ShownSeed(21, SeedRole.LIVE), ShownSeed(0, SeedRole.CLOSING))
    session.hover(Snap(0, "SEED"))
    assert session.picture.intent is Intent.CLOSE
    session.click(Snap(0, "SEED"))
    assert session.wires[-1].start == 21
    assert session.wires[-1].end == 0
    assert session.seed is None
    assert session.network.closing_point is None


def test_what_goes_on_from_a_wire_goes_on_from_its_second_part() -> None:
    session = corner().session
    assert session.wires[1].heading == (2, 3)
    insert(session, session.wires[0], 1)
    assert [wire.heading for wire in session.wires] == [None, (0, 1), (2, 3)]


def test_a_chain_whose_first_wire_was_removed_cannot_be_closed() -> None:
    session = corner().session
    session.drop(session.wires[0])
    assert [own.goes_on for own in session.network.requests] == [None]
    assert session.network.closing_point is None
    assert not session.close()


def test_a_chain_of_one_wire_is_not_closed_by_going_back_along_it() -> None:
    session = Table(boxes=True).session
    session.click(0)
    session.click(3)
    assert not session.close()
    assert "back" in session.reason
    assert len(session.wires) == 1
    session.undo()
    session.click(9)
    assert session.next_candidate() is False
    assert session.close(), "where it comes back another way it is"
    assert courses(session) == [(0, 1, 2, 3, 9), (9, 8, 7, 6, 0)]


def test_without_a_chain_there_is_nothing_to_close() -> None:
    session = Table().session
    assert not session.close()
    session.click(0)
    assert not session.close()
    assert "draw a wire first" in session.reason


def test_a_chain_that_began_on_an_edge_is_closed_over_its_other_end() -> None:
    session = Table().session
    for pick in ((0, 1), 3, 21, 18):
        session.click(pick)
    session.close()
    assert courses(session)[0] == (0, 1, 2, 3)
    assert courses(session)[-1] == (18, 12, 6, 0)
    assert session.wires[-1].end == (0, 1)


# Dropping, inserting, the other way


def test_a_dropped_wire_is_gone_and_undo_brings_it_back() -> None:
    session = corner().session
    before = session.network_revision
    assert session.drop(session.wires[0])
    assert courses(session) == [(3, 9, 15, 21)]
    assert session.network_revision > before
    assert session.undo()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert not session.drop(corner().session.wires[0]), "the wire of another drawing"


def test_dropping_the_last_wire_leaves_the_live_one_at_its_place() -> None:
    table = corner()
    session = table.session
    session.hover(23)
    assert session.picture.active is not None
    session.drop(session.wires[-1])
    assert session.seed == 21
    assert table.lives["EDGES"].seeded == (21, False), "there is no direction to go on in"
    assert session.picture.active.vertices == (21, 22, 23)


def test_an_edge_seed_in_a_wire_belongs_to_the_part_before_it() -> None:
    session = corner().session
    assert insert(session, session.wires[1], (15, 9))
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15), (15, 21)]
    assert session.seeds() == [0, 3, (9, 15), 21]


@pytest.mark.parametrize("pick", [0, 3, (2, 3), 20, (0, 6)])
def test_a_seed_is_not_put_at_a_wires_end_or_beside_it(pick: int | tuple[int, int]) -> None:
    session = corner().session
    assert not insert(session, session.wires[0], pick)
    assert len(session.wires) == 2


def test_a_seed_in_a_loop_cuts_it_opposite_as_well() -> None:
    session = Table().session
    session.loop((14, 15))
    assert insert(session, session.wires[0], 14)
    assert [wire.closed for wire in session.wires] == [False, False]
    assert session.seeds() == [14, 27]
    assert session.edges_to_mark() == chain(14, 15, 21, 27, 26, 20, 14)


def test_a_seed_in_a_loops_closing_edge_keeps_all_its_edges() -> None:
    session = Table().session
    session.loop((14, 15))
    assert insert(session, session.wires[0], (20, 14))
    assert session.edges_to_mark() == chain(14, 15, 21, 27, 26, 20, 14)
    assert session.wires[0].start == session.wires[1].end


def test_across_the_surface_a_seed_is_put_into_curve_and_chain() -> None:
    session = Table("SURFACE").session
    session.click(0)
    session.click(9)
    assert insert(session, session.wires[0], 2)
    first, second = session.wires
    assert first.vertices + second.vertices[1:] == (0, 1, 2, 3, 9)
    assert first.points[-1].tolist() == second.points[0].tolist() == [2.0, 0.0, 0.0]


def test_a_kept_wire_takes_its_other_way_and_back() -> None:
    session = Table().session
    session.click(0)
    session.click(7)
    assert session.retrace(session.wires[0])
    assert courses(session) == [(0, 6, 7)]
    assert session.seed == (6, 7), "the chain goes on from the other way's last edge"
    assert session.retrace(session.wires[0])
    assert courses(session) == [(0, 1, 7)]
    assert session.undo()
    assert courses(session) == [(0, 6, 7)]


def test_of_three_the_ways_of_half_a_wire_are_computed_and_come_in_the_same_order() -> None:
    table = Table(ready=(True, True, True), fork_ready=(False, False, False))
    session = table.session
    session.click(0)
    session.click(21)
    assert courses(session) == [(0, 1, 7, 8, 14, 15, 21)]
    insert(session, session.wires[0], 14)
    for expected in [(0, 1, 2, 8, 14), (0, 6, 12, 13, 14), (0, 1, 7, 8, 14)]:
        assert session.retrace(session.wires[0])
        table.compute()
        assert courses(session) == [expected, (14, 15, 21)]


def test_another_way_that_comes_to_an_edge_from_the_other_side_ends_where_the_next_wire_begins() -> None:
    session = Table(turned=True).session
    session.click(0)
    session.click((20, 21))
    session.click(33)
    assert courses(session) == [(0, 1, 2, 8, 14, 20, 21), (21, 27, 33)]
    assert session.retrace(session.wires[0])
    assert courses(session) == [(0, 6, 12, 18, 19, 20, 21), (21, 27, 33)]


def test_the_other_way_of_half_a_wire_is_computed() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(20)
    assert courses(session) == [(0, 1, 2, 8, 14, 20)]
    insert(session, session.wires[0], 8)
    assert session.retrace(session.wires[0])
    assert session.computing
    assert courses(session) == [(0, 1, 2, 8), (8, 14, 20)]
    table.compute()
    assert courses(session) == [(0, 6, 7, 8), (8, 14, 20)]
    assert session.wires[1].heading == (7, 8)
    session.undo()
    assert courses(session) == [(0, 1, 2, 8), (8, 14, 20)]


def test_dropping_waits_for_nothing_that_was_asked_of_the_wire() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(21)
    insert(session, session.wires[0], 9)
    session.retrace(session.wires[0])
    assert session.waiting == 1
    session.drop(session.wires[0])
    table.compute()
    assert courses(session) == [(9, 15, 21)]
    assert session.reason == ""


def test_undo_takes_back_what_waits_for_a_wires_other_way() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(21)
    insert(session, session.wires[0], 9)
    session.retrace(session.wires[0])
    assert session.undo()
    assert session.waiting == 0
    table.compute()
    assert len(session.wires) == 2
    assert session.wires[0].vertices == (0, 1, 2, 3, 9)


def test_a_stored_loop_that_no_click_took_has_no_other_way() -> None:
    session = Table().session
    session.loop((14, 15))
    drawn = replace(session.wires[0], kind=None, through=None)
    mesh = paper()
    mesh.write(Drawn((drawn,)))
    session = Table().session
    mesh.open(session)
    assert not session.retrace(session.wires[0])
    assert "loop" in session.reason


# Running to the end


def test_a_wire_runs_straight_on_to_the_boundary() -> None:
    session = Table().session
    session.click(7)
    session.hover(9)
    assert session.run_to_end(preview=True)
    assert session.picture.one(Role.EXTENSION).vertices == (7, 8, 9, 10, 11)
    assert session.picture.intent is Intent.RUN
    session.hover(19)
    assert session.picture.one(Role.EXTENSION).vertices == (7, 13, 19, 25, 31), "the preview follows the cursor"
    assert session.click(19)
    assert courses(session) == [(7, 13, 19, 25, 31)]
    assert session.seed is None
    assert session.undo()
    assert session.seed == 7


def test_along_the_boundary_a_wire_runs_all_the_way_around() -> None:
    session = Table().session
    session.click(1)
    session.hover(3)
    assert session.run_to_end()
    assert courses(session)[0][:7] == (1, 2, 3, 4, 5, 11, 17)
    assert len(courses(session)[0]) == 21


def test_it_ends_at_a_seam_and_at_another_wire() -> None:
    session = Table(seams=[(4, 10)]).session
    session.click(0)
    session.hover(1)
    assert session.run_to_end()
    assert courses(session) == [(0, 1, 2, 3, 4)]
    session.start(14)
    session.hover(8)
    session.run_to_end()
    assert courses(session)[-1] == (14, 8, 2)


def test_without_a_cursor_it_goes_on_from_the_last_edge() -> None:
    session = corner().session
    session.hover(None)
    assert session.run_to_end()
    assert courses(session)[-1] == (21, 27, 33)
    assert session.wires[-1].heading == (15, 21)


def test_without_a_direction_it_says_what_it_needs() -> None:
    session = Table().session
    assert not session.run_to_end()
    assert "seed first" in session.reason
    session.click(0)
    session.hover(None)
    assert not session.run_to_end()
    assert "Point" in session.reason
    use(session, along="SURFACE")
    assert not session.run_to_end(preview=True)
    assert "along edges" in session.reason


def test_the_preview_of_the_end_can_be_let_go() -> None:
    session = corner().session
    session.hover(22)
    session.run_to_end(preview=True)
    assert session.stop_preview()
    assert session.picture.one(Role.EXTENSION) is None
    assert session.click(22)
    assert courses(session)[-1] == (21, 22)


# The effect of a click
