# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wire with its way to the end."""

from __future__ import annotations

import pytest
from grid import Grid, wire
from seamwire.core.drawing.extension import Extension
from seamwire.core.drawing.wire import WireGesture
from seamwire.core.network.network import Network, Seed


def extension(network: Network, *seams: tuple[int, int]) -> Extension:
    drawing = Grid().drawing(network, seams)
    return Extension(drawing, WireGesture(drawing))


def test_the_live_wire_goes_on_as_it_runs_to_the_boundary() -> None:
    found = extension(Network(seed=Seed(6))).find(wire(6, 7, 8))
    assert found.vertices == (6, 7, 8, 9, 10, 11)


def test_without_a_live_wire_it_goes_on_from_the_edge_before_the_seed() -> None:
    one = extension(Network(seed=Seed((6, 7), forward=True, clicked=7)))
    found = one.find(None)
    assert found.vertices == (7, 8, 9, 10, 11)
    assert found.heading == (6, 7)
    assert found.marks
    assert one.commit().wires[0].vertices == found.vertices


def test_without_a_direction_it_is_refused() -> None:
    with pytest.raises(ValueError, match="Point at where the wire should run"):
        extension(Network(seed=Seed(0))).commit()


def test_it_ends_at_seams_and_kept_wires() -> None:
    network = Network((wire(9, 15, 21),), Seed(6))
    assert extension(network, (10, 16)).find(wire(6, 7)).vertices == (6, 7, 8, 9)
    network = Network(seed=Seed(6))
    assert extension(network, (10, 16)).find(wire(6, 7)).vertices == (6, 7, 8, 9, 10)
    assert extension(network).find(wire(6, 7)).vertices == (6, 7, 8, 9, 10, 11)


def test_showing_the_same_way_again_shows_nothing_new() -> None:
    one = extension(Network(seed=Seed((6, 7), forward=True, clicked=7)))
    assert not one.poll(), "nobody asks for it"
    one.wanted = True
    assert one.poll()
    assert not one.poll()
    one.cancel()
    assert one.wire is None
