# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for parts, on a plate with two of them: which thread it runs on, and what ends it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np
import pytest
from fake_live import FakeLive, grid_triangles
from numpy.typing import NDArray
from seamwire.core.base.refused import Refused
from seamwire.core.offers import edge_loops
from seamwire.core.offers.edge_loops import PartSearch

SIZE = 6
"""Vertices along a side of the plate; vertex SIZE * row + column."""
BORDER = (2, 2 + SIZE)
"""An edge between both parts."""


def search(
    find_parts: Callable[..., object] = lambda *_: (), seams: Callable[..., object] = lambda: edge_loops.NO_SEAMS
) -> PartSearch:
    return PartSearch(lambda: FakeLive(SIZE), 2 * (SIZE - 1) ** 2, seams, find_parts)


def halves() -> NDArray[np.int32]:
    return ((grid_triangles(SIZE) % SIZE).max(axis=1) > 2).astype(np.int32)


def test_parts_are_found_anew_only_with_other_seams() -> None:
    seams, given = [np.array([[0, 1]], dtype=np.int32)], []

    def find(known: NDArray[np.int32], _: object) -> list[NDArray[np.int32]]:
        given.append(known.tolist())
        return [halves()]

    parts = search(find, lambda: seams[0])
    for _ in range(2):
        parts.renew()
        assert parts.ready()
    parts.stop()
    assert parts.ready()
    assert given == [[[0, 1]]], "a search that has ended is not stopped"
    seams[0] = np.array([[1, 2]], dtype=np.int32)
    parts.renew()
    assert not parts.is_complete
    assert not parts.finder.borders(BORDER)
    assert parts.ready()
    assert parts.is_complete
    assert given == [[[0, 1]], [[1, 2]]]


def test_a_search_that_was_stopped_leaves_nothing_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_loops, "AT_ONCE", 0)
    begun, counts = threading.Event(), []

    def find(_: object, goes_on: Callable[[], bool]) -> Iterator[NDArray[np.int32]]:
        begun.set()
        yield halves()
        while goes_on():
            pass
        counts.append(threading.active_count())

    parts = search(find)
    parts.ready()
    thread = parts._thread
    assert thread is not None
    assert begun.wait(10.0)
    parts.stop()
    parts.stop()
    thread.join(10.0)
    assert not thread.is_alive()
    assert len(counts) == 1
    assert not parts.is_complete
    assert not parts.finder.borders(BORDER)


@pytest.mark.parametrize("at_once", [True, False])
def test_an_error_ends_the_preparation_with_its_reason(at_once: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(_: FakeLive) -> None:
        raise MemoryError("too large")

    monkeypatch.setattr(edge_loops, "AT_ONCE", 5_000 if at_once else 0)
    parts = search()
    with monkeypatch.context() as broken:
        broken.setattr(FakeLive, "wait_for_surface", fail)
        if not at_once:
            with suppress(Refused):
                parts.ready()
            parts.wait()
        for _ in range(2):
            with pytest.raises(Refused, match="too large"):
                parts.ready()
    assert parts.is_complete


def test_an_error_while_parts_are_found_leaves_flat_faces() -> None:
    def find(*_: object) -> Iterator[NDArray[np.int32]]:
        raise RuntimeError("broken")
        yield

    parts = search(find)
    assert parts.ready()
    assert parts.is_complete
    assert not parts.finder.borders(BORDER)
