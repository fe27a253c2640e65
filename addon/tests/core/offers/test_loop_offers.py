# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on an edge offers, and what of it is shown."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from fake_live import FakeLive, grid_triangles
from numpy.typing import NDArray
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.network import Snap
from seamwire.core.network.stops import Stops
from seamwire.core.offers import part_search
from seamwire.core.offers.edge_loops import LoopOffers
from seamwire.core.offers.part_search import PartSearch
from table import POINTS, SIZE, Table, symmetry


def loops(borders: PartSearch) -> LoopOffers:
    return LoopOffers(Table().session.engines, Stops([], symmetry()), POINTS, borders)


def halves(go_on: threading.Event | None = None) -> PartSearch:
    """Return the grid as two parts, with the border along its third column; they are found when they may `go_on`."""
    triangles = grid_triangles(SIZE)
    labels = ((triangles % SIZE).max(axis=1) > 2).astype(np.int32)

    def find(*_: object) -> list[NDArray[np.int32]]:
        return [labels] if go_on is None or go_on.wait() else []

    return PartSearch(lambda: FakeLive(SIZE), len(triangles), find_parts=find)


def test_borders_of_parts_are_offered_last() -> None:
    edge = (2, 2 + SIZE)
    without = loops(PartSearch(lambda: FakeLive(SIZE), 50)).find(edge, Drawn())
    offers = loops(halves())
    found = offers.find(edge, Drawn())
    assert [one.kind for one in found] == [*(one.kind for one in without), "FLAT", "FLAT"]
    rows = range(SIZE)
    sides = {(x, y) for x in range(3) for y in rows if x in {0, 2} or y in {0, SIZE - 1}}
    assert {(vertex % SIZE, vertex // SIZE) for vertex in found[-2].vertices} == sides, "the shorter one first"
    assert found[-2].closed
    assert set(found[-2].edges()) == offers.part_border(edge[::-1])


def test_loops_do_not_wait_for_parts_and_parts_join_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(part_search, "AT_ONCE", 0)
    edge, go_on = (2, 2 + SIZE), threading.Event()
    parts = halves(go_on)
    offers = loops(parts)
    offers.point_at(Snap(edge))
    offers.aim(edge)
    while not offers.find(edge, Drawn()):
        pass
    kinds = [offer.kind for offer in offers.find(edge, Drawn())]
    assert "FLAT" not in kinds
    assert offers.final
    offers.show(edge, offers.find(edge, Drawn()))
    offers.point_at(Snap(edge))
    assert offers.final
    go_on.set()
    offers.wait()
    assert not offers.final, "the parts are known since"
    assert [offer.kind for offer in offers.find(edge, Drawn())] == [*kinds, "FLAT", "FLAT"]
    assert offers.final


def test_a_motion_of_the_mouse_shows_parts_that_are_known_since(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(part_search, "AT_ONCE", 0)
    edge, go_on = (2, 2 + SIZE), threading.Event()
    parts = halves(go_on)
    offers = loops(parts)
    offers.point_at(Snap(edge))
    offers.aim(edge)
    while not (found := offers.find(edge, Drawn())):
        pass
    offers.show(edge, found)
    go_on.set()
    parts.wait()
    assert offers.final
    offers.point_at(Snap(edge))
    assert not offers.final


def test_the_search_for_parts_ends_when_no_offers_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(part_search, "AT_ONCE", 0)
    edge, searches, ended = (2, 2 + SIZE), [], threading.Event()

    def find(_: NDArray[np.int32], goes_on: Callable[[], bool]) -> Iterator[NDArray[np.int32]]:
        searches.append(goes_on)
        while len(searches) == 1 and goes_on():
            pass
        if goes_on():
            yield ((triangles % SIZE).max(axis=1) > 2).astype(np.int32)
        else:
            ended.set()

    triangles = grid_triangles(SIZE)
    parts = PartSearch(lambda: FakeLive(SIZE), len(triangles), find_parts=find)
    offers = loops(parts)
    offers.aim(edge)
    while not offers.find(edge, Drawn()):
        pass
    offers.aim(None)
    assert ended.wait(10.0)
    offers.wait()
    assert not parts.is_complete
    offers.aim(edge)
    assert offers.find(edge, Drawn()), "the loops are known"
    offers.wait()
    assert len(searches) == 2
    assert parts.is_complete
    assert "FLAT" in [offer.kind for offer in offers.find(edge, Drawn())]
