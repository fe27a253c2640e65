# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires that run straight on to their end."""

from __future__ import annotations

import pytest
from grid import POINTS, Grid, symmetry, wire
from seamwire.core.drawing.extension import Extension
from seamwire.core.network.network import Network, Seed
from seamwire.core.network.stops import Stops


def extension(*seams: tuple[int, int]) -> Extension:
    return Extension(Grid().engines, Stops(seams, symmetry()), POINTS)


def test_the_live_wire_goes_on_as_it_runs_to_the_boundary() -> None:
    found = extension().find(Network(seed=Seed(6)), wire(6, 7, 8), True)
    assert found.vertices == (6, 7, 8, 9, 10, 11)


def test_without_a_live_wire_it_goes_on_from_the_edge_before_the_seed() -> None:
    found = extension().find(Network(seed=Seed((6, 7), forward=True, clicked=7)), None, False)
    assert found.vertices == (7, 8, 9, 10, 11)
    assert found.heading == (6, 7)
    assert not found.marks


def test_without_a_direction_it_is_refused() -> None:
    with pytest.raises(ValueError, match="Point at where the wire should run"):
        extension().find(Network(seed=Seed(0)), None, True)


def test_it_ends_at_seams_and_kept_wires_until_they_are_others() -> None:
    stops = Stops([(10, 16)], symmetry())
    one = Extension(Grid().engines, stops, POINTS)
    network = Network((wire(9, 15, 21),), Seed(6))
    assert one.find(network, wire(6, 7), True).vertices == (6, 7, 8, 9)
    network = Network(seed=Seed(6))
    assert one.find(network, wire(6, 7), True).vertices == (6, 7, 8, 9, 10)
    stops.set_seams([])
    assert one.find(network, wire(6, 7), True).vertices == (6, 7, 8, 9, 10, 11)


def test_showing_the_same_way_again_shows_nothing_new() -> None:
    one = extension()
    assert not one.show(None)
    assert one.show(wire(0, 1, 2))
    assert not one.show(wire(0, 1, 2))
    assert one.show(wire(0, 1))
    assert one.show(None)
