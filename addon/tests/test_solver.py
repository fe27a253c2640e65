# SPDX-License-Identifier: GPL-3.0-or-later
"""Live wires that are made on a thread."""

from __future__ import annotations

import threading

import pytest
from fake_live import FakeLive, grid_points
from seamwire.core.session import Session
from seamwire.core.solver import EventualLive, Eventually
from table import SIZE


class Slow:
    """Live wires that are made when the test says so."""

    def __init__(self) -> None:
        self.go = threading.Event()
        self.made: list[FakeLive] = []
        self.making = Eventually(self._make)
        self.live = EventualLive(self.making)

    def _make(self) -> FakeLive:
        self.go.wait(10.0)
        self.made.append(FakeLive(SIZE))
        return self.made[0]

    def finish(self) -> None:
        self.go.set()
        self.making.get()


def test_until_they_are_made_nothing_is_final_and_nothing_waits() -> None:
    slow = Slow()
    slow.live.seed(0)
    assert slow.live.progress() == 0.0
    found = slow.live.wires(7)
    assert not found.final
    assert len(found.wires[0].vertices) == len(found.wires[1].points) == 0
    assert not slow.live.loop((0, 1)).final
    assert len(slow.live.run_on((0, 1), []).vertices) == 0
    assert slow.live.feature_strength() is None
    assert not slow.made
    slow.finish()


def test_what_was_asked_for_before_is_done_then() -> None:
    slow = Slow()
    slow.live.seed(3)
    slow.live.seed((1, 2), forward=True)
    slow.live.set_metric("campen", max_anisotropy=5.0, clamp_percentile=99.0)
    fork = slow.live.fork()
    fork.seed(4)
    assert not fork.wires(5).final
    slow.finish()
    assert slow.live.wires(7).final
    assert slow.made[0].seeds == [((1, 2), True)]
    assert slow.made[0].metrics == [("campen", 5.0, 99.0)]
    assert fork.wires(5).wires[0].vertices.tolist() == [4, 5]
    assert slow.live.progress() == 1.0


def test_waiting_waits_for_the_making_too() -> None:
    slow = Slow()
    slow.live.seed(0)
    threading.Timer(0.05, slow.go.set).start()
    assert slow.live.wait()
    assert slow.live.wires(1).final


def test_what_making_raised_comes_out_at_every_call() -> None:
    def fail() -> FakeLive:
        raise RuntimeError("the mesh is made of cheese")

    live = EventualLive(Eventually(fail))
    for call in (lambda: live.wait(), lambda: live.progress(), lambda: live.wires(0), lambda: live.seed(0)):
        with pytest.raises(RuntimeError, match="cheese"):
            call()


def test_a_seed_that_was_none_is_refused_when_wires_are_asked_for() -> None:
    slow = Slow()
    slow.live.seed(SIZE**2)
    slow.finish()
    assert slow.live.progress() == 1.0
    with pytest.raises(ValueError, match="not part of the surface"):
        slow.live.wires(0)
    slow.live.seed(0)
    assert slow.live.wires(1).final


def test_a_session_draws_with_them_from_the_first_click_on() -> None:
    slow = Slow()
    session = Session(lambda _: slow.live, grid_points(SIZE))
    session.click(0)
    session.click(2)
    session.click(14)
    assert session.computing
    assert session.progress == 0.0
    assert session.waiting_clicks == 2
    slow.finish()
    session.poll()
    assert [wire.vertices for wire in session.wires] == [(0, 1, 2), (2, 8, 14)]
    assert not session.computing
