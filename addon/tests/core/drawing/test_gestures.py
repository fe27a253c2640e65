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


def test_a_wire_takes_its_other_way_as_soon_as_that_is_computed() -> None:
    retrace = Retrace(Grid(fork_ready=(False, False)).drawing(Network((CORNER,))), CORNER)
    assert retrace.commit() is retrace
    (live,) = retrace.lives()
    live.wait()
    assert [one.vertices for one in retrace.commit().wires] == [(0, 6, 7)]


def test_where_both_ways_are_one_there_is_no_other() -> None:
    straight = wire(0, 1, 2)
    retrace = Retrace(Grid().drawing(Network((straight,))), straight)
    with pytest.raises(ValueError, match="All wires run along the same edges here"):
        retrace.commit()


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


def test_without_a_direction_it_is_refused() -> None:
    with pytest.raises(ValueError, match="Point at where the wire should run"):
        extension(Network(seed=Seed(0))).commit()


def way_on(network: Network, *seams: tuple[int, int]) -> tuple[int, ...]:
    """Return the vertices of the live wire from 6 to 7 with its way to the end."""
    drawing = Grid().drawing(network, seams)
    live = WireGesture(drawing)
    live.wires, live.finals = (wire(6, 7),), (True,)
    made = Extension(drawing, live)
    made.wanted = True
    assert made.poll()
    return made.wire.vertices


def test_it_ends_at_seams_and_kept_wires() -> None:
    assert way_on(Network((wire(9, 15, 21),), Seed(6)), (10, 16)) == (6, 7, 8, 9)
    assert way_on(Network(seed=Seed(6)), (10, 16)) == (6, 7, 8, 9, 10)
    assert way_on(Network(seed=Seed(6))) == (6, 7, 8, 9, 10, 11)


def test_showing_the_same_way_again_shows_nothing_new() -> None:
    one = extension(Network(seed=Seed((6, 7), forward=True, clicked=7)))
    assert not one.poll(), "nobody asks for it"
    one.wanted = True
    assert one.poll()
    assert not one.poll()
    one.cancel()
    assert one.wire is None


# Seeds that are dragged


def test_a_dragged_seed_takes_its_wires_along_once_they_are_computed() -> None:
    drag = SeedDrag(Grid(fork_ready=(False, False)).drawing(Network((CORNER,))), Snap(7))
    assert str(drag.aim(Snap(2))) == ""
    assert not drag.final
    assert not drag.poll()
    assert drag.commit() is drag
    drag.lives()[0].wait()
    assert drag.poll()
    assert [one.vertices for one in drag.moved] == [(0, 1, 2)]
    assert not drag.poll(), "nothing new"
    assert [one.vertices for one in drag.commit().wires] == [(0, 1, 2)]


def test_only_a_seed_is_dragged() -> None:
    with pytest.raises(ValueError, match="No seed to move at vertex 3"):
        SeedDrag(Grid().drawing(Network((CORNER,))), Snap(3))


def test_a_seed_that_was_not_moved_changes_nothing() -> None:
    assert SeedDrag(Grid().drawing(Network((CORNER,))), Snap(7)).commit() is None
