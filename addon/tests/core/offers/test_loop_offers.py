# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on an edge offers, and what of it is shown."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
from fake_live import grid_edges, grid_triangles
from grid import POINTS, SIZE, Grid, symmetry
from seamwire.core.network.network import Network
from seamwire.core.network.picks import undirected
from seamwire.core.network.stops import Stops
from seamwire.core.offers.edge_loops import LoopOffers, taken
from seamwire.core.offers.part_borders import PartBorders

EDGE = (14, 15)


def loops(grid: Grid) -> LoopOffers:
    return LoopOffers(grid.engines, Stops([], symmetry()), POINTS)


def test_each_offer_is_shown_in_turn() -> None:
    offers = loops(Grid())
    assert str(offers.advance()) == "No loop found yet"
    offers.aim(EDGE)
    assert offers.missing
    assert offers.show(EDGE, offers.find(EDGE, Network()))
    first = offers.wire
    assert set(offers.kinds) >= {"CLOSED", "STRIP"}
    assert str(offers.advance()) == ""
    assert offers.wire is not first
    for _ in offers.offers[1:]:
        offers.advance()
    assert offers.wire is first


def test_another_edge_or_none_lets_them_vanish() -> None:
    offers = loops(Grid())
    offers.aim(EDGE)
    offers.show(EDGE, offers.find(EDGE, Network()))
    assert not offers.aim(EDGE[::-1]), "the same edge"
    assert offers.wire is not None
    assert offers.aim(None)
    assert offers.wire is None
    assert not offers.missing


def halves() -> PartBorders:
    """Return the grid as two parts, with the border along its third column."""
    triangles = grid_triangles(SIZE)
    labels = (triangles % SIZE).max(axis=1) > 2
    return PartBorders(POINTS, triangles, grid_edges(SIZE), lambda: [labels.astype(np.int32)])


def test_borders_of_parts_are_offered_last() -> None:
    edge = (2, 2 + SIZE)
    without = loops(Grid()).find(edge, Network())
    offers = LoopOffers(Grid().engines, Stops([], symmetry()), POINTS, halves())
    found = offers.find(edge, Network())
    assert [one.kind for one in found] == [*(one.kind for one in without), "FLAT", "FLAT"]
    rows = range(SIZE)
    sides = {(x, y) for x in range(3) for y in rows if x in {0, 2} or y in {0, SIZE - 1}}
    assert {(vertex % SIZE, vertex // SIZE) for vertex in found[-2].vertices} == sides, "the shorter one first"
    assert found[-2].closed
    assert set(found[-2].edges()) == offers.part_border(edge[::-1])
    assert offers.part_border((0, 1)) == offers.part_border(edge)
    assert not offers.part_border((7, 8))


def test_until_parts_are_found_nothing_is_offered() -> None:
    parts = halves()
    go_on = threading.Event()
    parts._thread = threading.Thread(target=go_on.wait)
    parts._thread.start()
    offers = LoopOffers(Grid().engines, Stops([], symmetry()), POINTS, parts)
    offers.aim(EDGE)
    assert offers.find(EDGE, Network()) == ()
    offers.stop_waiting()
    assert not offers.final
    go_on.set()
    parts._thread.join()
    assert offers.find(EDGE, Network())
    assert offers.final


def test_nothing_is_offered_until_it_is_computed() -> None:
    grid = Grid(ready=(False, False))
    offers = loops(grid)
    offers.aim(EDGE)
    assert offers.find(EDGE, Network()) == ()
    assert not offers.final
    offers.stop_waiting()
    assert not offers.final, "it is asked for still"
    offers.aim(None)
    offers.stop_waiting()
    assert offers.final
    grid.lives["EDGES"].wait()
    assert offers.find(EDGE, Network())


def test_a_kept_loop_comes_first_and_what_else_there_is_after_it() -> None:
    offers = loops(Grid())
    found = offers.find(EDGE, Network())
    kept = taken(found, 0, marks=True)
    network = Network((kept,))
    assert network.taken_through(EDGE[::-1]) is kept
    assert kept.through == undirected(EDGE)
    assert [one.kind for one in offers.find(EDGE, network)] == [one.kind for one in found]
    stored = replace(kept, offers=())
    again = offers.find(EDGE, Network((stored,)))
    assert again[0].kind == kept.kind
    assert kept.kind not in {one.kind for one in again[1:]}
