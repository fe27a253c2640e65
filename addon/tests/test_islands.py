# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands: their pieces, their hues, and the thread they are made on."""

import threading
import time

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.islands import IslandMaker, coloured, neighbours


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
    maker.want("a", cut_at(30, 4, 11, 20))
    found = maker.newest
    assert found.key == "a"
    assert found.count == 4
    assert found.cut
    together = np.concatenate([piece for _, piece in found.pieces])
    assert sorted(map(tuple, together.tolist())) == sorted(map(tuple, triangles.tolist()))
    for hue, piece in found.pieces:
        for triangle in piece.tolist():
            row = triangles.tolist().index(triangle)
            assert found.hues[found.labels[row]] == hue


def test_neighbours_are_those_that_meet_at_a_cut() -> None:
    triangles = strip(6)
    cuts = cut_at(6, 2, 4)
    pairs = neighbours(triangles, labelled(6)(cuts), cuts)
    assert pairs.tolist() == [[0, 1], [1, 2]]


def test_a_cut_inside_one_island_has_no_neighbours() -> None:
    triangles = strip(6)
    pairs = neighbours(triangles, np.zeros(12, dtype=np.int32), cut_at(6, 3))
    assert pairs.shape == (0, 2)


@pytest.mark.parametrize("count", [2, 7, 60])
def test_neighbours_have_different_hues(count: int) -> None:
    rng = np.random.default_rng(count)
    pairs = np.unique(np.sort(rng.integers(0, count, (2 * count, 2)), axis=1), axis=0).astype(np.int32)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    hues = coloured(count, pairs, np.zeros(count, dtype=np.int64), 12)
    degree = np.bincount(pairs.reshape(-1), minlength=count).max()
    assert degree < 12, "else twelve hues might not do"
    assert (hues[pairs[:, 0]] != hues[pairs[:, 1]]).all()


def test_more_neighbours_than_hues_are_no_error() -> None:
    pairs = np.array([(i, j) for i in range(20) for j in range(i + 1, 20)], dtype=np.int32)
    assert coloured(20, pairs, np.zeros(20, dtype=np.int64), 12).max() < 12


def test_few_islands_have_each_a_hue_of_their_own() -> None:
    none = np.empty((0, 2), dtype=np.int32)
    assert len(set(coloured(12, none, np.zeros(12, dtype=np.int64), 12).tolist())) == 12


def test_a_new_cut_recolours_only_what_it_cuts_off() -> None:
    maker = IslandMaker(strip(30), labelled(30))
    maker.want(1, cut_at(30, 10))
    first = maker.newest
    maker.want(2, cut_at(30, 10, 25))
    second = maker.newest
    before, after = first.hues[first.labels], second.hues[second.labels]
    assert (before[:50] == after[:50]).all()
    assert (before[50:] != after[50:]).all()


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
        maker.want(number, cut_at(count, *range(100, 100 + number)))
        assert maker.busy
    assert maker.newest is None
    go.set()
    finished(maker)
    assert maker.newest.key == 5
    assert maker.newest.count == 6
    assert len(asked) <= 2
    assert threading.get_ident() not in threads


def test_what_goes_wrong_on_the_thread_comes_out() -> None:
    def fail(_: NDArray[np.int32]) -> NDArray[np.int32]:
        raise RuntimeError("as the test wants it")

    maker = IslandMaker(strip(15_000), fail)
    maker.want(1, cut_at(15_000, 3))
    finished(maker)
    with pytest.raises(RuntimeError, match="as the test wants it"):
        _ = maker.newest


def test_nothing_comes_after_the_end() -> None:
    count = 15_000
    go = threading.Event()

    def slow(cuts: NDArray[np.int32]) -> NDArray[np.int32]:
        assert go.wait(20.0)
        return labelled(count)(cuts)

    maker = IslandMaker(strip(count), slow)
    maker.want(1, cut_at(count, 5))
    maker.close()
    go.set()
    finished(maker)
    assert maker.newest is None


def test_a_wrong_number_of_labels_is_refused() -> None:
    maker = IslandMaker(strip(4), lambda _: np.zeros(3, dtype=np.int32))
    with pytest.raises(ValueError, match="labels"):
        maker.want(1, cut_at(4, 2))


def test_no_triangles_are_no_segments() -> None:
    maker = IslandMaker(np.empty((0, 3), dtype=np.int32), lambda _: np.empty(0, dtype=np.int32))
    maker.want(1, [])
    assert maker.newest.count == 0
    assert maker.newest.pieces == ()
