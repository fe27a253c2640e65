# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands: their pieces, their hues, and the thread they are made on."""

import threading
import time

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.islands.islands import IslandMaker


def strip(count: int) -> NDArray[np.int32]:
    """Return the triangles of a strip of squares; square i has vertices i, i + 1 below and the same above."""
    low, high = np.arange(count), np.arange(count) + count + 1
    one = np.stack([low, low + 1, high + 1], axis=1)
    two = np.stack([low, high + 1, high], axis=1)
    return np.stack([one, two], axis=1).reshape(-1, 3).astype(np.int32)


def cut_at(count: int, *columns: int) -> NDArray[np.int32]:
    return np.array([(c, c + count + 1) for c in columns], dtype=np.int32)


def labelled(count: int) -> object:
    def label(cuts: NDArray[np.int32]) -> NDArray[np.int32]:
        square = np.repeat(np.arange(count), 2)
        return np.searchsorted(np.sort(cuts[:, 0]), square, side="right").astype(np.int32)

    return label


def finished(maker: IslandMaker) -> None:
    end = time.monotonic() + 20.0
    while maker.busy:
        assert time.monotonic() < end
        time.sleep(0.005)


def test_pieces_are_all_triangles_once() -> None:
    triangles = strip(30)
    maker = IslandMaker(triangles, labelled(30))
    maker.ask("a", cut_at(30, 4, 11, 20))
    found = maker.answer
    assert found.key == "a"
    assert found.count == 4
    assert found.cut
    assert found.parted
    together = np.concatenate([piece for _, piece in found.pieces])
    assert sorted(map(tuple, together.tolist())) == sorted(map(tuple, triangles.tolist()))
    for hue, piece in found.pieces:
        for triangle in piece.tolist():
            row = triangles.tolist().index(triangle)
            assert found.hues[found.labels[row]] == hue


def test_the_cuts_that_islands_need_are_counted_by_what_is_given_for_that() -> None:
    def count(cuts: NDArray[np.int32], labels: NDArray[np.int32]) -> NDArray[np.int32]:
        return 10 * len(cuts) + np.arange(labels.max() + 1, dtype=np.int32)

    maker = IslandMaker(strip(30), labelled(30), count=count)
    maker.ask("a", cut_at(30, 4, 11))
    assert maker.answer.missing.tolist() == [20, 21, 22]
    maker = IslandMaker(strip(30), labelled(30))
    maker.ask("a", cut_at(30, 4, 11))
    assert maker.answer.missing.tolist() == [0, 0, 0]


def tinted(maker: IslandMaker, key: object, cuts: NDArray[np.int32]) -> NDArray[np.uint8]:
    """Return the hue of each triangle."""
    maker.ask(key, cuts)
    return maker.answer.hues[maker.answer.labels]


def test_of_what_a_cut_leaves_the_largest_keeps_the_hue() -> None:
    maker = IslandMaker(strip(30), labelled(30))
    whole = tinted(maker, 0, cut_at(30))
    ring = tinted(maker, 1, cut_at(30, 5, 11))
    assert (ring[22:] == whole[22:]).all()
    assert len({int(ring[0]), int(ring[15]), int(ring[40])}) == 3, "also what lies beyond it"


def test_a_large_mesh_is_done_on_a_thread_and_the_newest_request_wins() -> None:
    count = 15_000
    go = threading.Event()
    asked, threads = [], set()
    inner = labelled(count)

    def slow(cuts: NDArray[np.int32]) -> NDArray[np.int32]:
        asked.append(len(cuts))
        threads.add(threading.get_ident())
        assert go.wait(20.0)
        return inner(cuts)

    maker = IslandMaker(strip(count), slow)
    for number in range(1, 6):
        maker.ask(number, cut_at(count, *range(100, 100 + number)))
        assert maker.busy
    assert maker.answer is None
    go.set()
    finished(maker)
    assert maker.answer.key == 5
    assert maker.answer.count == 6
    assert len([number for number in asked if number]) <= 2, "without cuts it is asked once more"
    assert threading.get_ident() not in threads


def test_what_goes_wrong_on_the_thread_comes_out() -> None:
    def fail(_: NDArray[np.int32]) -> NDArray[np.int32]:
        raise RuntimeError("as the test wants it")

    maker = IslandMaker(strip(15_000), fail)
    maker.ask(1, cut_at(15_000, 3))
    end = time.monotonic() + 20.0
    with pytest.raises(RuntimeError, match="as the test wants it"):
        while maker.busy and time.monotonic() < end:
            maker.check()
            time.sleep(0.001)


def test_nothing_comes_after_the_end() -> None:
    count = 15_000
    go = threading.Event()

    def slow(cuts: NDArray[np.int32]) -> NDArray[np.int32]:
        assert go.wait(20.0)
        return labelled(count)(cuts)

    maker = IslandMaker(strip(count), slow)
    maker.ask(1, cut_at(count, 5))
    maker.close()
    go.set()
    finished(maker)
    assert maker.answer is None


def test_a_wrong_number_of_labels_is_refused() -> None:
    maker = IslandMaker(strip(4), lambda _: np.zeros(3, dtype=np.int32))
    with pytest.raises(ValueError, match="labels"):
        maker.ask(1, cut_at(4, 2))


def test_no_triangles_are_no_segments() -> None:
    maker = IslandMaker(np.empty((0, 3), dtype=np.int32), lambda _: np.empty(0, dtype=np.int32))
    maker.ask(1, [])
    assert maker.answer.count == 0
    assert maker.answer.pieces == ()
