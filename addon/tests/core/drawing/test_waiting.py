# SPDX-License-Identifier: GPL-3.0-or-later
"""Gestures that wait, one behind the other, and what they leave behind."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from fake_live import FakeLive, grid_points, grid_triangles
from seamwire.core.base.refused import Refused
from seamwire.core.drawing import wire
from seamwire.core.drawing.session import Session
from seamwire.core.fields.crests import Crests
from seamwire.core.network.network import Snap
from seamwire.core.network.wires import Wire
from seamwire.core.seams.seam_wires import waiting, wires_along
from seamwire.core.solver.solver import final
from seamwire.terms.choices import Along
from setting import insert, use
from table import SIZE, Table, courses

POINTS = grid_points(SIZE)
ROW = range(SIZE, 2 * SIZE)


def ridge() -> Crests:
    """Return one ridge, along the second row of vertices."""
    triangles = grid_triangles(SIZE).tolist()
    edges = [(v, v + 1) for v in ROW[:-1]] + [(ROW[-2], ROW[-1])]
    faces = [next(row for row, corners in enumerate(triangles) if {v, v + 1} <= set(corners)) for v in ROW[:-1]]
    return Crests(
        POINTS[list(ROW)],
        np.array(edges, dtype=np.int32),
        np.array([0.0] * (SIZE - 1) + [1.0]),
        np.array([*faces, -1], dtype=np.int32),
        np.ones(SIZE),
        np.array([0, SIZE], dtype=np.int32),
        np.ones(1),
    )


def with_ridge(*args: object, **options: object) -> Table:
    table = Table(*args, **options)
    table.session.cursor.use_crests(ridge(), True)
    return table


def make_ready(table: Table, *ready: bool) -> None:
    for live in table.lives.values():
        live.ready = ready
    table.session.poll()


def test_a_run_that_waits_does_not_take_the_wire_that_merely_finishes_first() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(14)
    session.run_to_end()
    make_ready(table, False, True)
    assert session.cursor.waiting == 1
    assert session.wires == ()
    make_ready(table, True, True)
    assert courses(session) == [(0, 1, 2, 8, 14, 20, 26, 32)]


def test_after_a_ridge_the_triangles_are_told_of_that_its_wires_lead_around() -> None:
    session = with_ridge("SURFACE", holes=(2, 1)).session
    session.hover(7, loop=True)
    session.click(7)
    assert "made valid" in session.drawing.warning
    session.hover(None)
    session.hover(7)
    assert "made valid" in session.picture.message, "a click makes the cursor point at something else"


def test_a_waiting_click_that_begins_a_chain_does_not_use_up_the_warning() -> None:
    table = Table("SURFACE", holes=(2, 1), ready=(False, False), metric_ready=(False, False))
    session = table.session
    session.loop(0)
    session.click(35)
    session.wait()
    assert "made valid" not in session.drawing.told
    session.click(7)
    session.wait()
    assert "made valid" in session.drawing.warning


def test_a_loop_that_was_given_up_leaves_nothing_to_compute() -> None:
    session = Table("SURFACE", metric_ready=(False, False)).session
    session.loop(8)
    session.undo()
    session.click(0)
    session.hover(21)
    session.poll()
    assert not session.cursor.computing
    assert session.picture.work.progress == 1.0


def test_a_refused_loop_computes_no_closed_cuts_later() -> None:
    session = Table().session
    assert not session.loop(9)
    use(session, along="SURFACE")
    assert session.drawing.engines._cuts is None


def test_a_refused_loop_leaves_the_bent_cut_that_is_shown() -> None:
    session = Table("SURFACE").session
    session.loop(24)
    session.hover(8, loop=True, bend=True)
    assert not session.loop((25, 31))
    assert session.picture.offered.kinds == ("ACROSS",)


def test_no_run_goes_ahead_of_a_line_that_waits() -> None:
    session = Table(fork_ready=(False, False)).session
    session.click(17)
    session.click((23, 22))
    session.line_begin(35)
    session.cursor.line_to(POINTS[[35, 34]], np.array([49, 49]), None)
    session.line_keep(session.cursor.line_release())
    assert session.cursor.waiting == 1
    assert not session.run_to_end()
    assert session.drawing.message == "The wire cannot be extended from here"
    assert len(session.wires) == 1


def test_a_stroke_is_drawn_while_a_moved_seed_waits(monkeypatch: pytest.MonkeyPatch) -> None:
    def straight(_live: object, begin: int, end: int, _seen: object, _follow: int) -> Wire:
        return Wire("SURFACE", (begin, end), POINTS[[begin, end]], begin, end)

    monkeypatch.setattr(wire, "straight_wire", straight)
    session = Table("SURFACE", ready=(True,) * 3, fork_ready=(False,) * 3).session
    use(session, straight=True)
    for pick in (0, 14):
        session.click(Snap(pick, seen_along=(0.0, 0.0, 1.0)))
    session.hover(Snap(28, seen_along=(0.0, 0.0, 1.0)))
    session.drag(Snap(14, "SEED"))
    session.cursor.drag_to(Snap(21, seen_along=(0.0, 0.0, 1.0)))
    session.drag_end()
    assert session.draw_stroke(vertices=[27, 28])
    assert session.network.strokes[0].acts_on == "both"


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_waiting_ends_if_the_library_never_comes_to_a_result(along: Along, monkeypatch: pytest.MonkeyPatch) -> None:
    table = Table(along, ready=(False, False))
    session = table.session
    session.click(0)
    session.click(8)
    session.click(20)
    monkeypatch.setattr(FakeLive, "wait", lambda _self, _seconds=None: True)
    session.wait()
    assert session.cursor.waiting == 0
    assert session.drawing.message == "The computation ended without a result: this step was dropped"
    assert session.wires == ()
    assert session.seed == 0
    session.click(8)
    table.compute()
    assert len(session.wires) == 1, "it goes on with what comes later"


def test_waiting_ends_without_a_word_if_nothing_waits(monkeypatch: pytest.MonkeyPatch) -> None:
    session = Table(ready=(False, False)).session
    session.click(0)
    session.hover(8)
    monkeypatch.setattr(FakeLive, "wait", lambda _self, _seconds=None: True)
    session.wait()
    assert not session.drawing.message
    assert session.seed == 0


def test_an_answer_that_is_never_final_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    live = FakeLive(SIZE, ready=(False, False))
    monkeypatch.setattr(FakeLive, "wait", lambda _self, _seconds=None: True)
    with pytest.raises(Refused):
        final(live, lambda: live.loop((0, 1)))
    live.seed(0)
    with pytest.raises(Refused):
        list(waiting(live, wires_along(live, [0, 1, 2], POINTS, 5.0)))


def test_undo_takes_back_a_held_line_before_a_click_that_waits() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.click(8)
    assert session.cursor.waiting == 1
    session.line_begin(30)
    assert session.undo()
    assert not session.cursor.held
    assert session.cursor.waiting == 1
    table.compute()
    assert len(session.wires) == 1


def with_a_waiting_click() -> Table:
    """Return a chain with one kept wire, and a click that waits for the second one."""
    table = Table()
    table.session.click(0)
    table.session.click(3)
    table.lives["EDGES"].ready = (False, False)
    table.session.click(21)
    assert table.session.cursor.waiting == 1
    assert len(table.session.wires) == 1
    return table


FIRST, SECOND = (0, 1, 2, 3), (3, 9, 15, 21)


@pytest.mark.parametrize(
    ("go_on", "kept"),
    [
        (lambda session: session.start(30), [FIRST, SECOND]),
        (lambda session: session.drop(session.wires[0]), [SECOND]),
        (lambda session: session.retrace(session.wires[0]), [FIRST, SECOND]),
        (lambda session: session.drag(Snap(0, "SEED")), [FIRST, SECOND]),
        (lambda session: session.redo(), [FIRST, SECOND]),
        (lambda session: use(session, along="SURFACE"), [FIRST, SECOND]),
        (lambda session: use(session, clear=True), [FIRST, SECOND]),
        (lambda session: use(session, mirror=(0,)), [FIRST, SECOND]),
        (lambda session: use(session, metric="euclidean"), [FIRST, SECOND]),
        (lambda session: use(session, strength_edges=2.0), [FIRST, SECOND]),
        (lambda session: session.end_chain(), [FIRST, SECOND]),
        (lambda session: session.end_chain(wait=False), [FIRST]),
    ],
    ids=[
        "new chain",
        "remove",
        "other path",
        "seed",
        "redo",
        "surface",
        "clear",
        "mirror",
        "metric",
        "strength",
        "end",
        "cancel",
    ],
)
def test_only_a_cancelled_chain_forgets_a_click_that_waits(go_on: Callable[[Session], object], kept: list) -> None:
    session = with_a_waiting_click().session
    go_on(session)
    assert session.cursor.waiting == 0
    assert courses(session) == kept


def test_settings_of_later_wires_do_not_reach_a_click_that_waits() -> None:
    table = with_a_waiting_click()
    session = table.session
    use(session, clear=True, mirror=(0,))
    assert session.wires[1].marks
    assert session.wires[1].mirror == ()
    session.click(35)
    session.wait()
    assert not session.wires[2].marks
    assert session.wires[2].mirror == (0,)


@pytest.mark.parametrize("change", [{"snap": True}, {"xray": True}, {"unwrap": True}])
def test_settings_that_draw_no_wires_do_not_wait(change: dict[str, object]) -> None:
    session = with_a_waiting_click().session
    use(session, **change)
    assert session.cursor.waiting == 1


def test_a_stroke_waits_behind_a_click() -> None:
    table = with_a_waiting_click()
    session = table.session
    assert session.draw_stroke(vertices=[34, 35])
    assert session.network.strokes == ()
    assert session.cursor.waiting == 2
    assert [stroke.vertices.tolist() for stroke in session.picture.strokes] == [[34, 35]], "it is shown while it waits"
    table.compute()
    assert len(session.picture.strokes) == 1
    assert [len(network) for network in (session.wires, session.network.strokes)] == [2, 1]
    assert session.undo()
    assert session.network.strokes == ()
    assert courses(session) == [FIRST, SECOND], "the stroke was drawn after the wire"


def test_a_loop_waits_behind_a_click() -> None:
    table = Table("SURFACE")
    session, live = table.session, table.lives["SURFACE"]
    session.click(0)
    live.ready = (False, False)
    session.click(3)
    assert session.loop(20)
    assert session.cursor.waiting == 2
    assert session.wires == (), "though the closed cut is computed already"
    live.ready = (True, True)
    session.poll()
    assert session.cursor.waiting == 0
    assert courses(session)[0] == FIRST
    assert len(session.wires) > 1


def test_a_stroke_is_removed_after_the_click_that_it_led() -> None:
    table = Table()
    session = table.session
    session.draw_stroke(vertices=[34, 35])
    session.click(0)
    table.lives["EDGES"].ready = (False, False)
    session.click(3)
    assert session.erase(session.network.strokes[0])
    assert courses(session) == [FIRST]
    assert session.undo()
    assert len(session.network.strokes) == 1
    assert courses(session) == [FIRST]


def test_the_chain_is_closed_by_a_key_after_the_click_that_waits() -> None:
    table = Table()
    session = table.session
    session.click(0)
    table.lives["EDGES"].ready = (False, False)
    session.click(15)
    assert session.close()
    session.wait()
    assert courses(session)[0][-1] == 15
    assert session.wires[-1].end == 0
    assert session.seed is None


def test_what_waits_tells_whether_a_chain_will_be_live() -> None:
    session = with_a_waiting_click().session
    assert session.cursor.will_be_live
    session.click(Snap(0, "SEED"))
    assert not session.cursor.will_be_live, "the second click closes the chain"
    session.loop((33, 34))
    assert not session.cursor.will_be_live
    session.click(35)
    assert session.cursor.will_be_live
    session.run_to_end()
    assert not session.cursor.will_be_live


def never(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the library come to no result."""
    monkeypatch.setattr(FakeLive, "wait", lambda _self, _seconds=None: True)


@pytest.mark.parametrize(
    "go_on",
    [
        lambda session: session.start(30),
        lambda session: session.drop(session.wires[0]),
        lambda session: session.end_chain(),
        lambda session: use(session, clear=True),
    ],
    ids=["new chain", "remove", "end", "setting"],
)
def test_a_click_without_a_result_is_told_of_whatever_comes_next(
    go_on: Callable[[Session], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    session = with_a_waiting_click().session
    never(monkeypatch)
    go_on(session)
    assert session.drawing.failure == "The computation ended without a result: this step was dropped"


def test_a_failure_is_forgotten_when_something_else_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    table = with_a_waiting_click()
    session = table.session
    never(monkeypatch)
    session.start(30)
    assert session.drawing.told == "The computation ended without a result: this step was dropped"
    table.compute()
    session.hover(32)
    session.click(32)
    assert not session.drawing.failure


def test_a_waiting_click_that_is_refused_is_told_of_when_the_chain_ends() -> None:
    table = Table(islands=(35,), ready=(False, False))
    session = table.session
    session.click(0)
    session.click(35)
    table.compute()
    assert session.cursor.waiting == 0
    session.end_chain()
    assert session.drawing.failure.startswith("No wire reaches")


def test_a_cancelled_chain_forgets_a_wire_that_waits_for_its_other_path() -> None:
    session = Table(ready=(True, True, True), fork_ready=(False, False, False)).session
    session.click(0)
    session.click(21)
    insert(session, session.wires[0], 14)
    before = courses(session)
    assert session.retrace(session.wires[0])
    assert session.cursor.waiting == 1
    session.end_chain(wait=False)
    assert session.cursor.waiting == 0
    assert courses(session) == before


@pytest.mark.parametrize(
    "go_on",
    [
        lambda session: session.click(35),
        lambda session: session.start(35),
        lambda session: session.loop((34, 35)),
        lambda session: session.draw_stroke(vertices=[34, 35]),
        lambda session: session.line_begin(35),
        lambda session: session.drag(Snap(0, "SEED")),
        lambda session: session.redo(),
        lambda session: session.end_chain(),
    ],
    ids=["click", "new chain", "loop", "stroke", "line", "seed", "redo", "end"],
)
def test_a_released_seed_stays_where_it_is_whatever_comes_next(go_on: Callable[[Session], object]) -> None:
    session = Table(fork_ready=(False, False)).session
    session.click(0)
    session.click(3)
    session.end_chain()
    session.drag(Snap(3, "SEED"))
    session.cursor.drag_to(Snap(4))
    session.drag_end()
    assert session.cursor.waiting == 1
    go_on(session)
    assert session.drawing.network.wires[0].vertices == (0, 1, 2, 3, 4)


def test_a_held_seed_goes_back_when_something_else_begins() -> None:
    session = Table().session
    session.click(0)
    session.click(3)
    session.end_chain()
    session.drag(Snap(3, "SEED"))
    session.cursor.drag_to(Snap(4))
    session.click(35)
    assert courses(session) == [FIRST]
