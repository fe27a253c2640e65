# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing waits for the library: clicks, edits and undo work at once, and courses follow."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from fake_live import FakeLive, grid_points
from seamwire.core.network.network import Snap, Way
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.choices import Along
from setting import use
from table import SIZE, Table, courses

POINTS = grid_points(SIZE)


def late(along: Along = "EDGES", **options: object) -> Table:
    """Return a table where nothing is computed yet."""
    return Table(along, ready=(False, False), **options)


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_clicks_before_anything_is_computed_are_wires_that_come_later(along: Along) -> None:
    now, table = Table(along).session, late(along)
    session = table.session
    picks = [0, 3, 21, 23, 35]
    for pick in picks:
        assert session.click(pick)
        now.click(pick)
    assert len(session.network.requests) == 4
    assert session.wires == ()
    assert session.picture.missing == ((0, 3), (3, 21), (21, 23), (23, 35))
    assert session.waiting == 4
    session.wait()
    assert courses(session) == courses(now)
    assert [wire.heading for wire in session.wires] == [wire.heading for wire in now.wires]
    assert session.picture.missing == ()
    assert not session.computing


def test_one_click_after_the_other_goes_on_in_the_direction_of_the_wire_before() -> None:
    table = late()
    session = table.session
    for pick in (0, 14, (15, 21)):
        session.click(pick)
    assert session.seed == (15, 21), "in both directions"
    session.wait()
    assert session.wires[-1].heading == session.wires[0].last_edge
    assert session.seed == session.wires[-1].last_edge
    assert session.wires[-1].last_edge in {(15, 21), (21, 15)}


def test_undo_and_redo_of_what_is_not_computed() -> None:
    table = late()
    session = table.session
    for pick in (0, 3, 21):
        session.click(pick)
    assert session.undo()
    assert session.seed == 3
    assert session.waiting == 1
    table.compute()
    assert courses(session) == [(0, 1, 2, 3)]
    assert session.redo()
    assert session.waiting == 1
    session.wait()
    assert courses(session) == [(0, 1, 2, 3), (3, 9, 15, 21)]
    assert session.undo()
    assert session.redo()
    assert session.waiting == 0, "its course is known"


def test_settings_and_strokes_after_a_click_do_not_change_its_wire() -> None:
    table = late(metric_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(8)
    live = table.lives["EDGES"]
    use(session, strength_edges=3.0, clear=True)
    assert session.draw_stroke(vertices=[27, 28])
    assert live.metrics == []
    assert live.strokes == []
    session.wait()
    (wire,) = session.wires
    assert wire.marks
    assert wire.strength == 10.0


def test_a_wire_that_is_computed_can_take_another_way_before_it_is_final() -> None:
    table = Table(ready=(False, True), shorter=1)
    session = table.session
    session.click(0)
    session.click(8)
    assert courses(session) == [(0, 6, 7, 8)]
    assert session.waiting == 1
    assert session.retrace(session.wires[0])
    assert courses(session) == [(0, 6, 7, 8)], "until the other is known"
    session.wait()
    assert courses(session) == [(0, 1, 2, 8)]
    assert session.undo()
    session.wait()
    assert courses(session) == [(0, 6, 7, 8)]


def test_w_on_a_wire_with_one_way_says_so_and_keeps_the_wire() -> None:
    table = late()
    session = table.session
    session.click(0)
    session.click(3)
    session.wait()
    assert not session.retrace(session.wires[0])
    assert "same edges" in str(session.reason)
    assert courses(session) == [(0, 1, 2, 3)]


def test_a_seed_in_a_wire_that_is_not_final_parts_it() -> None:
    table = Table(ready=(False, True), shorter=1)
    session = table.session
    session.click(0)
    session.click(14)
    session.end_chain()
    (wire,) = session.wires
    assert wire.vertices == (0, 6, 12, 13, 14)
    session.click(Snap(12, "WIRE", wire))
    assert [(own.start, own.end) for own in session.network.requests] == [(0, 12), (12, 14)]
    assert courses(session) == [(0, 6, 12), (12, 13, 14)]
    session.wait()
    assert courses(session) == [(0, 6, 12), (12, 13, 14)]
    assert all(isinstance(own, Way) for own in session.network.requests)


def test_a_seed_is_moved_while_its_wire_is_not_final() -> None:
    table = late()
    session = table.session
    session.click(0)
    session.click(3)
    session.end_chain()
    assert session.drag(3) is False, "there is nothing to see yet"
    table.compute()
    assert session.drag(3)
    for live in table.lives["EDGES"].forks:
        live.ready = (False, False)
    session.drag_to(15)
    assert session.drag_end()
    assert session.network.requests[0].end == 15
    session.wait()
    assert courses(session)[0][-1] == 15


@pytest.mark.parametrize("is_late", [False, True])
def test_each_new_wire_is_checked_once_when_it_is_final(is_late: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    checked: list[int] = []
    monkeypatch.setattr(Sketch, "warn_of_images", lambda _, course: checked.extend(wire.id for wire in course.wires))
    session = (late() if is_late else Table()).session
    for act in (
        lambda: session.click(0),
        lambda: session.click(7),
        lambda: session.loop((20, 21)),
        lambda: session.retrace(session.wires[0]),
        session.undo,
        session.redo,
    ):
        act()
        session.wait()
    first, loop = session.wires
    assert checked == [first.id, loop.id, first.id], "drawn, taken, and led another way"


def test_a_wire_that_finds_no_way_is_told_of_and_the_others_stay() -> None:
    table = late(islands=(21,))
    session = table.session
    for pick in (0, 21, 3, 9):
        session.click(pick)
    session.wait()
    assert [str(report) for report in session.reports] == [
        "No wire from vertex 0 reaches vertex 21",
        "No wire from vertex 21 reaches vertex 3",
    ] or [str(report) for report in session.reports] == ["No wire from vertex 0 reaches vertex 21"]
    assert (0, 21) in session.picture.missing
    assert courses(session)[-1] == (3, 9)
    assert not session.computing


def test_a_moved_seed_whose_wire_finds_no_way_leaves_the_wire_where_it_was() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(3)
    session.end_chain()
    session.drag(3)
    session.drag_to(8)
    fork = table.lives["EDGES"].forks[-1]
    fork.islands = (8,)
    assert session.drag_end()
    session.wait()
    assert courses(session) == [(0, 1, 2, 3)]
    assert len(session.reports) == 1


def test_a_library_that_never_comes_to_a_result_ends_the_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    table = late()
    session = table.session
    for pick in (0, 8, 20):
        session.click(pick)
    monkeypatch.setattr(FakeLive, "wait", lambda _self, _seconds=None: True)
    session.wait()
    assert session.waiting == 0
    assert "without a result" in str(session.reports[-1])
    assert session.wires == ()


@pytest.mark.parametrize(
    "deed",
    [
        lambda session: session.start(30),
        lambda session: session.loop((14, 15)),
        lambda session: session.draw_stroke(vertices=[27, 28]),
        lambda session: session.end_chain(),
        lambda session: use(session, along="SURFACE"),
        lambda session: use(session, mirror=(0,)),
        lambda session: use(session, metric="concave"),
        lambda session: session.undo() and session.redo(),
        lambda session: session.line_begin(30) and session.cancel(),
    ],
    ids=["new chain", "loop", "stroke", "end", "surface", "mirror", "metric", "undo and redo", "line"],
)
def test_a_click_becomes_a_wire_whatever_comes_next(deed: Callable[[Sketch], object]) -> None:
    session = late().session
    session.click(0)
    session.click(3)
    deed(session)
    session.wait()
    assert (0, 1, 2, 3) in courses(session)
    assert session.reports == []


def test_a_line_that_is_not_computed_becomes_wires_that_can_be_edited() -> None:
    table = Table(fork_ready=(False, False))
    session = table.session
    session.line_begin(0)
    session.line_to(POINTS[[0, 1, 2, 8, 14]], np.array([0, 2, 4, 4, 14]), None)
    assert session.line_end()
    assert courses(session) == [(0, 1, 2, 8, 14)]
    session.wait()
    assert [edge for wire in session.wires for edge in wire.edges()] == [(0, 1), (1, 2), (2, 8), (8, 14)]
    last = session.wires[-1]
    assert session.drop(last)
    assert last.id not in {wire.id for wire in session.wires}
    assert session.undo()
    assert session.wires[-1].id == last.id


def test_the_end_keeps_wires_as_they_are_drawn_and_drops_the_others_with_a_report() -> None:
    table = Table(ready=(True, False), fork_ready=(False, False), shorter=1)
    session = table.session
    for pick in (0, 7, 8):
        session.click(pick)
    assert courses(session) == [(0, 1, 7)], "the other metric may be shorter, and the next wire is not there yet"
    assert session.picture.missing
    session.finish(wait=False)
    assert courses(session) == [(0, 1, 7)]
    assert len(session.network.requests) == 1
    assert session.waiting == 0
    assert "dropped" in session.reports[-1]


def test_wires_that_are_computed_at_the_same_moment_go_on_from_each_other() -> None:
    table = Table(ready=(False, False))
    session = table.session
    for pick in (0, 7, 9):
        session.click(pick)
    for live in (table.lives["EDGES"], *table.lives["EDGES"].forks):
        live.ready = (True, True)
    session.poll()
    assert session.waiting == 0
    assert courses(session) == [(0, 1, 7), (7, 8, 9)]
    assert session.wires[1].heading == (1, 7)
    assert [live.seeded for live in table.lives["EDGES"].forks].count(((1, 7), True)) == 1


def test_the_end_waits_for_all_wires() -> None:
    table = Table(ready=(False, False), fork_ready=(True, True))
    session = table.session
    for pick in (0, 7):
        session.click(pick)
    assert session.picture.missing == ((0, 7),)
    table.compute()
    session.finish()
    assert courses(session) == [(0, 1, 7)]
    assert session.reports == []
