# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on an edge offers, and what of it is shown."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from fake_live import FakeLive, grid_triangles
from numpy.typing import NDArray
from seamwire.core.offers import edge_loops
from seamwire.core.offers.edge_loops import EdgeLoops, PartSearch
from seamwire.core.sketch.sketch import Sketch
from table import SIZE, Table


def sketch(parts: PartSearch) -> Sketch:
    own = Table().session
    own.offering.parts = parts
    own.offering.edges = EdgeLoops(own.engines, own.stops, own.points, parts)
    return own


def kinds(own: Sketch) -> list[str | None]:
    return [offer.kind for offer in own.offering.offers]


def halves(go_on: threading.Event | None = None) -> PartSearch:
    """Return the grid as two parts, with the border along its third column; they are found when they may `go_on`."""
    triangles = grid_triangles(SIZE)
    labels = ((triangles % SIZE).max(axis=1) > 2).astype(np.int32)

    def find(*_: object) -> list[NDArray[np.int32]]:
        return [labels] if go_on is None or go_on.wait() else []

    return PartSearch(lambda: FakeLive(SIZE), len(triangles), find_parts=find)


def test_borders_of_parts_are_offered_last() -> None:
    edge = (2, 2 + SIZE)
    without, own = sketch(PartSearch(lambda: FakeLive(SIZE), 50)), sketch(halves())
    for each in (without, own):
        each.hover(edge, loop=True)
    assert kinds(own) == [*kinds(without), "FLAT", "FLAT"]
    rows = range(SIZE)
    sides = {(x, y) for x in range(3) for y in rows if x in {0, 2} or y in {0, SIZE - 1}}
    border = own.offering.offers[-2]
    assert {(vertex % SIZE, vertex // SIZE) for vertex in border.vertices} == sides, "the shorter one first"
    assert border.closed
    assert set(border.edges()) == own.offering.edges.part_border(edge[::-1])


def test_loops_do_not_wait_for_parts_and_a_motion_of_the_mouse_shows_parts_that_are_known_since(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(edge_loops, "AT_ONCE", 0)
    edge, go_on = (2, 2 + SIZE), threading.Event()
    own = sketch(halves(go_on))
    own.hover(edge, loop=True)
    while not own.offering.offers:
        own.poll()
    before = kinds(own)
    assert "FLAT" not in before
    assert own.offering.is_final
    own.hover(edge, loop=True)
    assert own.offering.is_final
    go_on.set()
    own.offering.parts.wait()
    assert own.offering.is_final
    own.hover(edge, loop=True)
    assert kinds(own) == [*before, "FLAT", "FLAT"]


def test_who_waits_for_the_offers_gets_the_parts_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_loops, "AT_ONCE", 0)
    edge, go_on = (2, 2 + SIZE), threading.Event()
    own = sketch(halves(go_on))
    own.hover(edge, loop=True)
    while not own.offering.offers:
        own.poll()
    go_on.set()
    own.wait()
    assert kinds(own)[-2:] == ["FLAT", "FLAT"]


def test_the_search_for_parts_ends_when_no_offers_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_loops, "AT_ONCE", 0)
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
    own = sketch(parts)
    own.hover(edge, loop=True)
    while not own.offering.offers:
        own.poll()
    own.hover(edge)
    assert ended.wait(10.0)
    assert not parts.is_complete
    own.hover(edge, loop=True)
    assert own.offering.offers, "the loops are known"
    own.wait()
    assert len(searches) == 2
    assert parts.is_complete
    assert "FLAT" in kinds(own)
