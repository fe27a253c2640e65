# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be done with a network after it was drawn: joins, closing, moving seeds, dropping, inserting, other ways."""

from __future__ import annotations

import pytest
from fake_live import FakeLive, grid_edges
from seamwire.network import Snap
from seamwire.session import Intent, Session
from seamwire.storage import dump, load
from table import SIZE, Table, chain


def corner(**options: object) -> Table:
    """A chain 0 - 3 - 21, from the left along the bottom and up."""
    table = Table(**options)
    for pick in (0, 3, 21):
        table.session.click(pick)
    return table


def courses(session: Session) -> list[tuple[int, ...]]:
    return [wire.vertices for wire in session.wires]


# Joining and closing


def test_a_click_on_a_wire_joins_it_there_and_ends_the_chain() -> None:
    session = corner().session
    session.start(30)
    bottom = session.wires[0]
    session.hover(Snap(1, "WIRE", bottom))
    assert session.intent is Intent.JOIN
    assert session.hovered_wire is bottom
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
    assert session.intent is Intent.JOIN
    session.click(Snap((4, 10), "SEAM"))
    assert session.seed is None
    assert len(session.wires) == 1


def test_a_chain_can_begin_on_a_wire() -> None:
    session = corner().session
    session.end_chain()
    session.hover(Snap(2, "WIRE", session.wires[0]))
    assert session.intent is Intent.BRANCH
    session.click(Snap(2, "WIRE", session.wires[0]))
    session.click(14)
    assert courses(session) == [(0, 1, 2), (2, 3), (3, 9, 15, 21), (2, 8, 14)]


def test_a_chain_goes_on_from_its_last_seed_in_its_direction() -> None:
    table = corner()
    session = table.session
    session.end_chain()
    session.hover(Snap(21, "SEED"))
    assert session.intent is Intent.CONTINUE
    assert session.hovered_seed == 21
    session.click(Snap(21, "SEED"))
    assert table.lives["EDGES"].seeded == ((15, 21), True)
    session.click(22)
    assert session.wires[-1].vertices == (21, 22)
    session.end_chain()
    session.click(Snap(0, "SEED"))
    assert table.lives["EDGES"].seeded == ((1, 0), True), "and from its first seed the other way"


def test_a_click_on_the_first_seed_closes_the_loop() -> None:
    session = corner().session
    assert session.closing_point == 0
    session.hover(Snap(0, "SEED"))
    assert session.intent is Intent.CLOSE
    session.click(Snap(0, "SEED"))
    assert session.wires[-1].start == 21
    assert session.wires[-1].end == 0
    assert session.seed is None
    assert session.closing_point is None


def test_close_does_the_same_wherever_the_cursor_is() -> None:
    session = corner().session
    session.hover(35)
    assert session.close()
    assert session.wires[-1].end == 0
    assert session.seed is None
    session.undo()
    assert session.seed == (15, 21)
    assert session.closing_point == 0


def test_closing_waits_for_its_wire() -> None:
    table = corner()
    table.lives["EDGES"].ready = (False, False)
    assert table.session.close()
    assert len(table.session.wires) == 2
    table.compute()
    assert len(table.session.wires) == 3
    assert table.session.seed is None


def test_a_chain_of_one_wire_is_not_closed_by_going_back_along_it() -> None:
    session = Table().session
    session.click(0)
    session.click(3)
    assert not session.close()
    assert "back" in session.message
    assert len(session.wires) == 1
    session.undo()
    session.click(9)
    assert session.toggle() is False
    assert session.close(), "where it comes back another way it is"
    assert courses(session) == [(0, 1, 2, 3, 9), (9, 8, 7, 6, 0)]


def test_without_a_chain_there_is_nothing_to_close() -> None:
    session = Table().session
    assert not session.close()
    session.click(0)
    assert not session.close()
    assert "draw a wire first" in session.message


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
    assert session.active is not None
    session.drop(session.wires[-1])
    assert session.seed == 21
    assert table.lives["EDGES"].seeded == (21, False), "there is no direction to go on in"
    assert session.active.vertices == (21, 22, 23)


def test_a_seed_put_into_a_wire_makes_two_of_it() -> None:
    session = corner().session
    first = session.wires[0]
    assert session.insert(first, 2)
    assert courses(session) == [(0, 1, 2), (2, 3), (3, 9, 15, 21)]
    assert session.wires[0].id == first.id
    assert session.edges_to_mark() == chain(0, 1, 2, 3, 9, 15, 21)
    assert session.undo()
    assert session.wires[0] is first


def test_an_edge_seed_in_a_wire_belongs_to_the_part_before_it() -> None:
    session = corner().session
    assert session.insert(session.wires[1], (15, 9))
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15), (15, 21)]
    assert session.seeds() == [0, 3, (9, 15), 21]


@pytest.mark.parametrize("pick", [0, 3, (2, 3), 20, (0, 6)])
def test_a_seed_is_not_put_at_a_wires_end_or_beside_it(pick: int | tuple[int, int]) -> None:
    session = corner().session
    assert not session.insert(session.wires[0], pick)
    assert "No seed can be put" in session.message
    assert len(session.wires) == 2


def test_a_seed_in_a_loop_cuts_it_opposite_as_well() -> None:
    session = Table().session
    session.loop((14, 15))
    assert session.insert(session.wires[0], 14)
    assert [wire.closed for wire in session.wires] == [False, False]
    assert session.seeds() == [14, 27]
    assert session.edges_to_mark() == chain(14, 15, 21, 27, 26, 20, 14)


def test_a_seed_in_a_loops_closing_edge_keeps_all_its_edges() -> None:
    session = Table().session
    session.loop((14, 15))
    assert session.insert(session.wires[0], (20, 14))
    assert session.edges_to_mark() == chain(14, 15, 21, 27, 26, 20, 14)
    assert session.wires[0].start == session.wires[1].end


def test_across_the_surface_a_seed_is_put_into_curve_and_chain() -> None:
    session = Table("SURFACE").session
    session.click(0)
    session.click(9)
    assert session.insert(session.wires[0], 2)
    first, second = session.wires
    assert first.vertices + second.vertices[1:] == (0, 1, 2, 3, 9)
    assert first.points[-1].tolist() == second.points[0].tolist() == [2.0, 0.0, 0.0]


def test_a_kept_wire_takes_its_other_way_and_back() -> None:
    session = Table().session
    session.click(0)
    session.click(7)
    assert session.toggle_kept(session.wires[0])
    assert courses(session) == [(0, 6, 7)]
    assert session.seed == (6, 7), "the chain goes on from the other way's last edge"
    assert session.toggle_kept(session.wires[0])
    assert courses(session) == [(0, 1, 7)]
    assert session.undo()
    assert courses(session) == [(0, 6, 7)]


def test_a_straight_wire_has_no_other_way() -> None:
    session = corner().session
    assert not session.toggle_kept(session.wires[0])
    assert "same edges" in session.message


def test_the_other_way_of_half_a_wire_is_computed() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(20)
    assert courses(session) == [(0, 1, 2, 8, 14, 20)]
    session.insert(session.wires[0], 8)
    assert session.toggle_kept(session.wires[0])
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
    session.insert(session.wires[0], 9)
    session.toggle_kept(session.wires[0])
    assert session.waiting_clicks == 1
    session.drop(session.wires[0])
    table.compute()
    assert courses(session) == [(9, 15, 21)]
    assert session.message == ""


def test_undo_takes_back_what_waits_for_a_wires_other_way() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(21)
    session.insert(session.wires[0], 9)
    session.toggle_kept(session.wires[0])
    assert session.undo()
    assert session.waiting_clicks == 0
    table.compute()
    assert len(session.wires) == 2
    assert session.wires[0].vertices == (0, 1, 2, 3, 9)


def test_a_stored_loop_has_no_other_way() -> None:
    table = Table()
    table.session.loop((14, 15))
    network, _ = load(dump(table.session.network, table.points), table.points, grid_edges(SIZE))
    session = Table().session
    session.resume(network)
    assert not session.toggle_kept(session.wires[0])
    assert "loop" in session.message


# Moving seeds


def test_a_dragged_seeds_wires_follow_on_both_sides() -> None:
    table = corner()
    session = table.session
    assert session.drag(3)
    assert session.dragging
    assert session.intent is Intent.MOVE
    assert session.drag_to(4)
    assert courses(session) == [(0, 1, 2, 3, 4), (4, 10, 16, 22, 21)]
    assert set(session.moved) == set(session.wires)
    assert session.network_revision == 2
    assert session.drag_to(2)
    assert session.drag_end()
    assert not session.dragging
    assert session.seeds() == [0, 2, 21]
    assert session.wires[1].heading == session.wires[0].last_edge
    assert len(table.lives["EDGES"].forks) == 2, "a live wire for each"
    assert session.network_revision == 3
    assert session.undo()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert session.redo()
    assert session.seeds() == [0, 2, 21]


def test_wires_arrive_and_leave_as_their_neighbours_do() -> None:
    table = corner()
    session = table.session
    session.click(23)
    session.drag(21)
    assert [fork.seeded for fork in table.lives["EDGES"].forks] == [((2, 3), True), (23, False)]
    session.drag_cancel()
    session.drag(3)
    assert [fork.seeded for fork in table.lives["EDGES"].forks[2:]] == [(0, False), ((22, 21), True)]
    session.drag_to(9)
    assert courses(session) == [(0, 1, 2, 3, 9), (9, 15, 21), (21, 22, 23)]


def test_around_an_edge_seed_wires_keep_their_direction() -> None:
    table = Table()
    session = table.session
    for pick in (0, (2, 3), 21):
        session.click(pick)
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    session.drag(0)
    assert table.lives["EDGES"].forks[0].seeded == ((3, 2), True), "the wire after it leaves over 3"
    session.drag_to(1)
    assert courses(session) == [(1, 2, 3), (3, 9, 15, 21)]
    session.drag_cancel()
    session.drag((3, 2))
    session.drag_to((8, 9))
    assert courses(session) == [(0, 1, 2, 8, 9), (9, 15, 21)], "the second leaves the edge where the first led over it"
    assert session.drag_end()
    assert session.wires[1].heading == (8, 9)
    assert session.seeds() == [0, (8, 9), 21]


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
    assert session.closing_point == 1
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
    assert len(session.moved) == 2, "from then on they move together"


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
    assert "drop it instead" in session.message
    assert courses(session) == [(0, 1, 2, 3)]
    assert not session.drag_end()
    assert courses(session) == [(0, 1, 2, 3)]
    assert not session.dragging


def test_a_seed_dragged_to_where_no_wire_leads_stays() -> None:
    session = corner(islands=(35,)).session
    session.drag(3)
    session.drag_to(4)
    assert not session.drag_to(35)
    assert session.message == "No wire from vertex 0 reaches vertex 35"
    session.drag_end()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]


def test_undo_during_a_drag_takes_back_the_drag_alone() -> None:
    session = corner().session
    session.drag(3)
    session.drag_to(4)
    assert session.can_undo
    assert session.undo()
    assert not session.dragging
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert not session.can_redo


def test_a_drag_that_is_not_computed_is_done_when_it_is() -> None:
    table = corner(fork_ready=(False, False))
    session = table.session
    session.drag(3)
    assert not session.drag_to(4)
    assert session.computing
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert session.drag_end()
    assert session.dragging, "it waits"
    table.compute()
    assert not session.dragging
    assert courses(session) == [(0, 1, 2, 3, 4), (4, 10, 16, 22, 21)]


def test_dragging_a_wire_puts_a_seed_there_in_one_step() -> None:
    session = corner().session
    session.end_chain()
    session.drag(Snap(2, "WIRE", session.wires[0]))
    session.drag_to(8)
    session.drag_end()
    assert courses(session) == [(0, 1, 2, 8), (8, 2, 3), (3, 9, 15, 21)]
    session.undo()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]


def test_there_must_be_a_seed_to_drag() -> None:
    session = corner().session
    assert not session.drag(20)
    assert not session.drag_to(21)
    assert not session.drag_end()
    assert not session.drag_cancel()


def test_surface_wires_follow_to_vertices_only() -> None:
    session = Table("SURFACE").session
    for pick in (0, 3, 21):
        session.click(pick)
    session.drag(3)
    assert not session.drag_to((3, 4))
    assert "vertices" in session.message
    assert session.drag_to(4)
    assert session.wires[1].points[0].tolist() == [4.0, 0.0, 0.0], "the curve runs from its start"
    session.drag_end()
    assert session.seeds() == [0, 4, 21]


def test_while_a_seed_is_dragged_a_toggled_wire_stays_with_its_metric() -> None:
    session = Table().session
    session.click(0)
    session.click(7)
    session.toggle_kept(session.wires[0])
    session.drag(7)
    session.drag_to(8)
    assert courses(session) == [(0, 6, 7, 8)]
    assert session.wires[0].alternative.vertices == (0, 1, 2, 8)


# Running to the end


def test_a_wire_runs_straight_on_to_the_boundary() -> None:
    session = Table().session
    session.click(0)
    session.hover(2)
    assert session.run_to_end(preview=True)
    assert session.end_preview.vertices == (0, 1, 2, 3, 4, 5)
    assert session.intent is Intent.RUN
    session.hover(12)
    assert session.end_preview.vertices == (0, 6, 12, 18, 24, 30), "the preview follows the cursor"
    assert session.click(12)
    assert courses(session) == [(0, 6, 12, 18, 24, 30)]
    assert session.seed is None
    assert session.undo()
    assert session.seed == 0


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
    assert "seed first" in session.message
    session.click(0)
    session.hover(None)
    assert not session.run_to_end()
    assert "Point" in session.message
    session.switch("SURFACE")
    assert not session.run_to_end(preview=True)
    assert "along edges" in session.message


def test_the_preview_of_the_end_can_be_let_go() -> None:
    session = corner().session
    session.hover(22)
    session.run_to_end(preview=True)
    assert session.stop_preview()
    assert session.end_preview is None
    assert session.click(22)
    assert courses(session)[-1] == (21, 22)


def test_running_on_waits_for_the_wire() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(2)
    assert session.run_to_end()
    assert session.waiting_clicks == 1
    table.compute()
    assert courses(session) == [(0, 1, 2, 3, 4, 5)]


# Marks, strength, metric


def test_a_clearing_wire_takes_edges_from_those_before_it() -> None:
    session = corner().session
    session.toggle_marking()
    session.start(2)
    session.click(9)
    assert session.wires[-1].marks is False
    assert session.edges_to_mark() == chain(0, 1, 2) + chain(9, 15, 21)
    assert session.edges_to_clear() == chain(2, 3, 9)
    session.toggle_marking()
    session.start(2)
    session.click(3)
    assert session.edges_to_clear() == [(3, 9)], "the later wire counts"


def test_strength_goes_in_steps_between_its_limits() -> None:
    table = Table()
    session = table.session
    assert session.strength == 10.0
    session.change_strength(2)
    assert session.strength == pytest.approx(15.625)
    assert table.lives["EDGES"].metrics == [("feature", 15.625, 99.0)]
    session.change_strength(50)
    assert session.strength == 100.0
    assert not session.change_strength(1)
    assert "most" in session.message
    session.change_strength(-100)
    assert session.strength == 1.0


def test_each_way_of_running_has_its_own_strength_and_both_the_metric() -> None:
    table = Table()
    session = table.session
    session.change_strength(1)
    session.set_metric("campen")
    session.switch("SURFACE")
    assert session.strength == 20.0
    assert table.lives["SURFACE"].metrics == [("campen", 20.0, 99.0)]
    session.switch("EDGES")
    assert session.strength == 12.5


def test_another_clamp_is_another_metric_for_both_ways() -> None:
    table = Table()
    session = table.session
    assert session.set_clamp(99.0)
    assert table.lives["EDGES"].metrics == []
    session.set_clamp(95.0)
    assert session.clamp == 95.0
    assert table.lives["EDGES"].metrics == [("feature", 10.0, 95.0)]
    session.switch("SURFACE")
    assert table.lives["SURFACE"].metrics == [("feature", 20.0, 95.0)]
    session.set_clamp(200.0)
    assert session.clamp == 100.0


def test_while_another_strength_is_computed_the_wires_stay_to_be_seen() -> None:
    table = Table(metric_ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(7)
    session.change_strength(1)
    assert session.computing
    assert session.active.vertices == (0, 1, 7)
    assert session.intent is Intent.WAIT
    session.click(7)
    assert session.wires == (), "but a click waits for the new ones"
    table.compute()
    assert courses(session) == [(0, 1, 7)]
    assert session.wires[0].strength == 12.5
    assert not session.computing


def test_a_kept_wire_remembers_the_strength_it_was_drawn_with() -> None:
    session = corner().session
    session.change_strength(1)
    assert [wire.strength for wire in session.wires] == [10.0, 10.0]


def test_nothing_is_changed_about_the_metric_while_a_seed_moves() -> None:
    session = corner().session
    session.drag(3)
    assert not session.change_strength(1)
    assert session.strength == 10.0


# What a click would do


def test_the_intent_follows_what_is_going_on() -> None:
    table = Table()
    session = table.session
    assert session.intent is Intent.NOTHING
    session.hover(0)
    assert session.intent is Intent.SEED
    session.click(0)
    assert session.intent is Intent.NOTHING, "the wire would end where it begins"
    session.hover(3)
    assert session.intent is Intent.KEEP
    session.hover(None)
    assert session.intent is Intent.NOTHING
    session.hover((14, 15), loop=True)
    assert session.intent is Intent.LOOP
    table.lives["EDGES"].ready = (False, False)
    session.hover(4)
    assert session.intent is Intent.WAIT


def test_a_preview_is_seen_and_not_kept() -> None:
    class Previewing(FakeLive):
        def wires(self, target: object) -> object:
            ready, self.ready = self.ready, (True, True)
            found = super().wires(target)
            self.ready = ready
            found.final = all(ready)
            for wire, final in zip(found.wires, ready, strict=True):
                wire.final = final
            return found

    live = Previewing(SIZE, ready=(False, False))
    table = Table()
    session = Session(lambda _: live, table.points)
    session.click(0)
    session.hover(7)
    assert session.active.vertices == (0, 1, 7)
    session.click(7)
    assert session.wires == ()
    live.ready = (True, True)
    session.poll()
    assert courses(session) == [(0, 1, 7)]
