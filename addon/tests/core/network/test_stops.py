# SPDX-License-Identifier: GPL-3.0-or-later
"""Where wires that run on have to stop."""

from seamwire.core.network.drawn import Drawn
from seamwire.core.network.stops import Stops
from table import symmetry, wire


def test_stops_are_the_vertices_of_seams_of_kept_wires_and_of_the_live_one() -> None:
    stops, network = Stops([(1, 0), (9, 15)], symmetry()), Drawn((wire(2, 3, 9),))
    assert stops.kept(network).tolist() == [0, 1, 2, 3, 9, 15]
    assert stops.of(network, wire(20, 21), (6, 7)).tolist() == [0, 1, 2, 3, 9, 15, 20, 21]
    assert stops.edges(network).tolist() == [[1, 0], [9, 15], [2, 3], [3, 9]]
