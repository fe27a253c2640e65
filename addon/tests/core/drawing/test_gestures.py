# SPDX-License-Identifier: GPL-3.0-or-later
"""Gestures on a grid, each for itself: candidates, other ways of kept wires, ways to the end, dragged seeds."""

from __future__ import annotations

import pytest
from grid import SIZE, Grid, wire
from seamwire.core.drawing.extension import Extension
from seamwire.core.drawing.retrace import Retrace
from seamwire.core.drawing.seed_drag import SeedDrag
from seamwire.core.drawing.wire import WireGesture
from seamwire.core.network.network import Network, Seed, Snap

CORNER, THREE = wire(0, 1, 7), (True, True, True)


# Wires from a seed to what is under the cursor


def test_of_three_the_leading_one_is_active_and_the_others_come_forward_in_turn() -> None:
    candidates = WireGesture(Grid(ready=THREE).drawing(Network(seed=Seed(0))))
    candidates.sow(Seed(0), "EDGES")
    candidates.aim(Snap(14))
    seen = []
    for number in range(3):
        assert candidates.number == number
        assert len(candidates.others) == 2
        seen.append(candidates.active.follow)
        assert candidates.others[0].follow == (seen[-1] + 1) % 3
        assert str(candidates.advance()) == ""
    assert seen == [2, 0, 1]
    assert candidates.active.follow == 2


def test_a_wire_that_another_metric_has_not_is_brought_forward_no_more() -> None:
    grid = Grid(ready=THREE)
    candidates = WireGesture(grid.drawing(Network(seed=Seed(0))))
    candidates.sow(Seed(0), "EDGES")
    candidates.chosen = 2
    grid.lives["EDGES"].ready = (True, True)
    candidates.aim(Snap(14))
    assert candidates.chosen is None
    assert candidates.active.follow == 0


# Kept wires that take their other way


def test_a_target_that_is_not_there_any_more_is_told_of() -> None:
    lost = wire(SIZE**2 - 1, SIZE**2 - 2)
    retrace = Retrace(Grid().drawing(Network((lost,))), lost)
    retrace.lives()[0].wires = lambda target: (_ for _ in ()).throw(ValueError("no such vertex"))
    with pytest.raises(ValueError, match="no such vertex"):
        retrace.commit()


# Ways to the end


def extension(network: Network, *seams: tuple[int, int]) -> Extension:
    drawing = Grid().drawing(network, seams)
    return Extension(drawing, WireGesture(drawing))


def test_showing_the_same_way_again_shows_nothing_new() -> None:
    one = extension(Network(seed=Seed((6, 7), forward=True, clicked=7)))
    assert not one.poll(), "nobody asks for it"
    one.wanted = True
    assert one.poll()
    assert not one.poll()
    one.cancel()
    assert one.wire is None


# Seeds that are dragged


def test_a_seed_that_was_not_moved_changes_nothing() -> None:
    assert SeedDrag(Grid().drawing(Network((CORNER,))), Snap(7)).commit() is None
