# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept wires that take their other way."""

from __future__ import annotations

import pytest
from grid import SIZE, Grid, wire
from seamwire.core.drawing.retrace import Retrace
from seamwire.core.network.network import Network

CORNER = wire(0, 1, 7)


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


def test_of_a_wire_that_is_gone_by_then_nothing_is_left_to_do() -> None:
    drawing = Grid().drawing(Network((CORNER,)))
    retrace = Retrace(drawing, CORNER)
    drawing.network = Network()
    assert retrace.commit() is None


def test_a_target_that_is_not_there_any_more_is_told_of() -> None:
    lost = wire(SIZE**2 - 1, SIZE**2 - 2)
    retrace = Retrace(Grid().drawing(Network((lost,))), lost)
    retrace.lives()[0].wires = lambda target: (_ for _ in ()).throw(ValueError("no such vertex"))
    with pytest.raises(ValueError, match="no such vertex"):
        retrace.commit()
