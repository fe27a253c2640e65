# SPDX-License-Identifier: GPL-3.0-or-later
"""The wires from a seed to what is under the cursor."""

from __future__ import annotations

from grid import POINTS, Grid
from seamwire.core.base.messages import Message
from seamwire.core.drawing.candidates import CandidateWires
from seamwire.core.network.network import Network, Seed, Snap
from seamwire.terms.options import Options


def aimed(at: int, **options: object) -> tuple[CandidateWires, Message]:
    """Return the wires from vertex 0 to another, and the message."""
    candidates = CandidateWires(Grid(**options).engines, POINTS)
    candidates.sow(Seed(0), "EDGES")
    return candidates, candidates.aim(Snap(at), Network(seed=Seed(0)), Options())


def test_the_shorter_one_is_active_until_the_other_is_brought_forward() -> None:
    candidates, _ = aimed(8, shorter=1)
    assert candidates.active.vertices == (0, 6, 7, 8)
    assert str(candidates.advance()) == ""
    assert candidates.active.vertices == (0, 1, 2, 8)
    assert candidates.others[0].vertices == (0, 6, 7, 8)


def test_there_is_no_other_where_both_run_alike_or_nothing_is_computed() -> None:
    assert str(aimed(3)[0].advance()) == "All wires run along the same edges here"
    assert str(aimed(8, ready=(False, False))[0].advance()) == "No other candidate found yet"


def test_where_no_wire_leads_there_is_no_other_to_wait_for() -> None:
    candidates, message = aimed(35, islands=(35,))
    assert str(candidates.advance()) == str(message) == "No wire reaches vertex 35: it is not connected to the seed"


def test_the_one_that_is_there_is_shown_while_the_other_is_computed() -> None:
    candidates, _ = aimed(8, ready=(False, True))
    assert candidates.active.follow == 1
    assert candidates.active_final
    assert not candidates.decided, "the shorter one is not there yet"


THREE = (True, True, True)


def test_of_three_the_leading_one_is_active_and_the_others_come_forward_in_turn() -> None:
    candidates, _ = aimed(14, ready=THREE)
    seen = []
    for number in range(3):
        assert candidates.number == number
        assert len(candidates.others) == 2
        seen.append(candidates.active.follow)
        assert candidates.others[0].follow == (seen[-1] + 1) % 3
        assert str(candidates.advance()) == ""
    assert seen == [2, 0, 1]
    assert candidates.active.follow == 2


def test_a_wire_that_runs_as_an_earlier_one_is_passed_over() -> None:
    candidates, _ = aimed(7, ready=THREE)  # one step each way: the third runs as the first
    assert [wire.follow for wire in candidates.others] == [1]
    candidates.advance()
    assert candidates.active.follow == 1
    candidates.advance()
    assert candidates.active.vertices == (0, 1, 7)
    assert candidates.number == 0


def test_the_leading_one_is_taken_as_soon_as_it_is_there_and_the_others_only_if_brought_forward() -> None:
    candidates, _ = aimed(14, ready=(False, True, True))
    assert candidates.active.follow == 2
    assert candidates.decided
    candidates, _ = aimed(14, ready=(True, True, False))
    assert candidates.active.follow == 0
    assert not candidates.decided, "the leading one is not there yet"
    candidates.advance()
    assert candidates.active.follow == 1
    assert candidates.decided


def test_a_wire_that_another_metric_has_not_is_brought_forward_no_more() -> None:
    grid = Grid(ready=THREE)
    candidates = CandidateWires(grid.engines, POINTS)
    candidates.sow(Seed(0), "EDGES")
    candidates.chosen = 2
    grid.lives["EDGES"].ready = (True, True)
    candidates.aim(Snap(14), Network(seed=Seed(0)), Options())
    assert candidates.chosen is None
    assert candidates.active.follow == 0
