# SPDX-License-Identifier: GPL-3.0-or-later
"""Gestures on a table, each for itself: candidates, other ways of kept wires, ways to the end, dragged seeds."""

from __future__ import annotations

import pytest
from seamwire.core.drawing.drawing import Drawing
from seamwire.core.drawing.extension import Extension
from seamwire.core.drawing.retrace import Retrace
from seamwire.core.drawing.seed_drag import SeedDrag
from seamwire.core.drawing.wire import WireGesture
from seamwire.core.network.network import Network, Seed, Snap
from table import SIZE, Table, wire


def drawing(network: Network, **options: object) -> Drawing:
    made = Table(**options).session.drawing
    made.network = network
    return made


def three() -> tuple[Table, WireGesture]:
    """Return a table with three candidates, and those from vertex 0."""
    table = Table(ready=(True, True, True))
    table.session.drawing.network = Network(seed=Seed(0))
    candidates = WireGesture(table.session.drawing)
    candidates.sow(Seed(0), "EDGES")
    return table, candidates


def test_of_three_the_leading_one_is_active_and_the_others_come_forward_in_turn() -> None:
    _, candidates = three()
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
    table, candidates = three()
    candidates.chosen = 2
    table.lives["EDGES"].ready = (True, True)
    candidates.aim(Snap(14))
    assert candidates.chosen is None
    assert candidates.active.follow == 0


def test_a_target_that_is_not_there_any_more_is_told_of() -> None:
    lost = wire(SIZE**2 - 1, SIZE**2 - 2)
    retrace = Retrace(drawing(Network((lost,))), lost)
    retrace.lives()[0].wires = lambda target: (_ for _ in ()).throw(ValueError("no such vertex"))
    with pytest.raises(ValueError, match="no such vertex"):
        retrace.commit()


def test_showing_the_same_way_again_shows_nothing_new() -> None:
    on = drawing(Network(seed=Seed((6, 7), forward=True, clicked=7)))
    one = Extension(on, WireGesture(on))
    assert not one.poll(), "nobody asks for it"
    one.wanted = True
    assert one.poll()
    assert not one.poll()
    one.cancel()
    assert one.wire is None


def test_a_dragged_seed_takes_its_wires_along_once_they_are_computed() -> None:
    drag = SeedDrag(drawing(Network((wire(0, 1, 7),)), fork_ready=(False, False)), Snap(7))
    assert str(drag.aim(Snap(2))) == ""
    assert not drag.final
    assert not drag.poll()
    assert drag.commit() is drag
    drag.lives()[0].wait()
    assert drag.poll()
    assert [one.vertices for one in drag.moved] == [(0, 1, 2)]
    assert not drag.poll(), "nothing new"
    assert [one.vertices for one in drag.commit().wires] == [(0, 1, 2)]


def test_a_seed_that_was_not_moved_changes_nothing() -> None:
    assert SeedDrag(drawing(Network((wire(0, 1, 7),))), Snap(7)).commit() is None
