# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept wires that take their other way."""

from __future__ import annotations

import pytest
from grid import POINTS, SIZE, Grid, wire
from seamwire.core.drawing.retrace import Retraces, retraced
from seamwire.core.network.network import Network

CORNER = wire(0, 1, 7)


def test_a_wire_takes_its_other_way_as_soon_as_that_is_computed() -> None:
    grid = Grid(fork_ready=(False, False))
    retraces = Retraces(grid.engines, POINTS)
    network = Network((CORNER,))
    retraces.add(network, CORNER)
    assert list(retraces.poll()) == []
    assert len(retraces) == len(retraces.lives()) == 1
    retraces.lives()[0].wait()
    [(own, courses)] = retraces.poll()
    assert own is CORNER
    assert not retraces
    others = courses.others(own)
    assert [one.vertices for one in retraced(network, own, others).wires] == [(0, 6, 7)]


def test_where_both_ways_are_one_there_is_no_other() -> None:
    retraces = Retraces(Grid().engines, POINTS)
    straight = wire(0, 1, 2)
    retraces.add(Network((straight,)), straight)
    [(own, courses)] = retraces.poll()
    with pytest.raises(ValueError, match="All wires run along the same edges here"):
        retraced(Network((straight,)), own, courses.others(own))


def test_a_target_that_is_not_there_any_more_is_told_of() -> None:
    retraces = Retraces(Grid().engines, POINTS)
    lost = wire(SIZE**2 - 1, SIZE**2 - 2)
    retraces.add(Network((lost,)), lost)
    retraces.lives()[0].wires = lambda target: (_ for _ in ()).throw(ValueError("no such vertex"))
    [(own, error)] = retraces.poll()
    assert own is lost
    assert isinstance(error, ValueError)
    assert not retraces
